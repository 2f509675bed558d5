#include <QApplication>
#include <QFile>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <fstream>
#include <optional>

#include "app/gui/error_words.hpp"
#include "app/gui/language.hpp"
#include "app/gui/report_words.hpp"
#include "app/pipeline/config.hpp"
#include "io/map_projection.hpp"
#include "io/output_folder.hpp"
#include "io/read_breaklines.hpp"
#include "io/read_dem.hpp"
#include "io/read_survey.hpp"
#include "mapping/delaunay_tin.hpp"
#include "survey/survey_edits.hpp"
#include "tests/gui/core_sentences.hpp"

namespace terrawalk::gui {

namespace {

QString translation(const char* source) {
    return QCoreApplication::translate("Report", source);
}

QString filled(QString pattern, const QStringList& values) {
    for (qsizetype i = 0; i < values.size(); ++i) pattern.replace(QString("%%1").arg(i + 1), values[i]);
    return pattern;
}

/// Whether no two English words follow one another: names and what libraries say in brackets aside.
bool isChinese(QString words) {
    static const QRegularExpression quoted(
        "\"[^\"]*\"|'[^']*'|`[^`]*`|（[^）]*）|syntax error.*|US survey foot");
    words.remove(quoted);
    static const QRegularExpression english("[a-z]{2,} [a-z]{2,}");
    return std::any_of(words.begin(), words.end(), [](QChar c) { return c.unicode() >= 0x4E00; }) &&
           !english.match(words).hasMatch();
}

/// What only the command line reaches: it speaks English.
bool forTheCommandLineAlone(const std::filesystem::path& file) {
    static const QStringList files{
        "accuracy_measure", "compare",        "contour_job",  "derive_job",    "difference_job",
        "experiment",       "las_reader",     "marks_on_map", "occupancy_job", "outage_measure",
        "ply_reader",       "point_cleaning", "profile_job",  "raster_input",  "read_points",
        "simulation",       "space_map",      "surface",      "text_table",    "point_table_reader",
        "tune_checkpoint",  "tune_jobs",      "validate_job", "volume_job",    "vector_points_reader",
        "walk_advice_job",  "write_survey"};
    return files.contains(QString::fromStdString(file.stem().string()));
}

/// Said of wrong calls, which no input leads to, or put together otherwise: known sentences say the whole.
const QStringList& notToBeTranslated() {
    static const QStringList texts{
        // wrong calls
        "name formats with --points, --mesh or --dem", "leave --hyperparameters out", "unknown filter",
        "the objective has no losses", "the search box has no dimensions or unequal ones",
        "bounds {} of the search box are {} and {}", "give finite bounds, the lower one first",
        "give generations or evaluations", "nsga2 needs two losses or more, this objective has one",
        "the record is of another search: optimiser, seed, budget, box or data differ", "start without it",
        "the record has {} islands, the search {}", "a binary value",
        "the surface has a vertex that is not finite", "the surface has a triangle without a vertex",
        "\"{}\" is no name for a file in the output folder", "the DEM has no place or no cell size",
        "a region without a cell", "give xmin,ymin,xmax,ymax with xmin < xmax and ymin < ymax",
        "a height's sigma of {} is none", "each point of a surface needs one sigma of the track",
        "each cell needs one variance of interpolation",
        // the file of a tuning alone
        "squared distance between the fused position over the last still seconds of a fixed-point run and "
        "its "
        "target mark, summed over the runs",
        "{} independent islands share the evaluations; the best of all is the answer",
        "population {} instead of {}: {} needs a multiple of four",
        "{} ended before its evaluations were spent and started again {} times",
        // put together
        "no {}; {}", "{} at {:.3f}, {:.3f}", "The heights have no standard errors{}: {}.",
        "the fixed-point run {} has no {} mark",
        "{} ended on its {} bound {}: the data ask for more than the box allows, or say nothing of it",
        "the barometer puts mark {} {:.1f} m {} its height at {:.0f} s: check the name and the coordinates "
        "of "
        "the mark",
        "holds something else than an earlier output: \"{}\"{}",
        "{}\", which is not Terrawalk's and would be replaced; move it away",
        "{} is off by {}, more than {:g} times the {}: a possible blunder. It is counted.",
        "{} {} and could not be compared: {}.",
        "The Vegetated Vertical Accuracy (VVA) was found to be RMSE_V = {} at {}.",
        "{} {} a small sample: the true error may differ a good deal from the figure found."};
    return texts;
}

/// Sources of the sentences that the window knows, with a mark where names and numbers come.
QString knownSentences() {
    QFile file(TERRAWALK_SOURCE_DIR "/resources/i18n/terrawalk_zh_CN.ts");
    if (!file.open(QIODevice::ReadOnly)) return {};
    QString texts = QString::fromUtf8(file.readAll());
    texts = texts.mid(texts.indexOf("<name>Report</name>"));
    texts.truncate(texts.indexOf("</context>"));
    static const QRegularExpression place("%[0-9]");
    return texts.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&").replace(place, "{}");
}

}  // namespace

/// What the core says of bad input, in the window's language.
class ErrorWordsTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void initTestCase() { QVERIFY(folder_.isValid()); }
    void init() { applyLanguage("zh_CN"); }
    void cleanup() { applyLanguage("en"); }

    void everySentenceKeepsItsNamesAndNumbers();
    void badInputIsToldInChinese_data();
    void badInputIsToldInChinese();
    void placeAndCureAreTold();
    void editsAreToldInChinese();
    void everySentenceOfTheCoreIsKnown();

  private:
    std::filesystem::path written(const std::string& name, const std::string& text) const {
        const auto file = std::filesystem::path(folder_.path().toStdString()) / name;
        std::ofstream(file) << text;
        return file;
    }
    QTemporaryDir folder_;
};

void ErrorWordsTest::everySentenceKeepsItsNamesAndNumbers() {
    const QStringList values{"S01", "X2", "X3", "X4", "X5", "X6", "X7"};
    for (const char* source : kErrorSentences) {
        // A longer sentence may not take one for itself, and none may lose a number.
        const QString english = filled(source, values);
        QCOMPARE(reportWords(english.toStdString()), filled(translation(source), values));
        for (int place = 1; place <= 7; ++place) {
            const QString mark = QString("%%1").arg(place);
            QCOMPARE(translation(source).contains(mark), QString(source).contains(mark));
        }
    }
    for (const char* source : kErrorWords)
        QVERIFY2(isChinese(translation(source)) || QString(source) == "null", source);
}

void ErrorWordsTest::badInputIsToldInChinese_data() {
    QTest::addColumn<QString>("kind");
    QTest::addColumn<QString>("text");
    const QString head = "# format: array-log 1\n";
    QTest::newRow("log: empty") << "log"
                                << "";
    QTest::newRow("log: no header") << "log" << head;
    QTest::newRow("log: no time") << "log" << head + "a,b\n1,2\n";
    QTest::newRow("log: no rows") << "log" << head + "time_s,range_m\n";
    QTest::newRow("log: column twice") << "log" << head + "time_s,range_m,range_m\n0,1,2\n";
    QTest::newRow("log: no number") << "log" << head + "time_s,range_m\n0,abc\n1,2\n";
    QTest::newRow("log: comma") << "log" << head + "time_s,range_m\n0,1,2\n1,2,3\n";
    QTest::newRow("log: latitude") << "log" << head + "time_s,lat_deg,lon_deg\n0,100,20\n1,10,20\n";
    QTest::newRow("log: clock") << "log" << head + "time_s,range_m\n100,1\n1,1\n";
    QTest::newRow("log: no time in a row") << "log" << head + "time_s,range_m\n,1\n1,1\n";
    QTest::newRow("log: format") << "log"
                                 << "# format: other 3\ntime_s,range_m\n0,1\n";
    QTest::newRow("log: interval") << "log" << head + "# sample_interval_s: -1\ntime_s,range_m\n0,1\n";
    QTest::newRow("log: lever arm") << "log" << head + "# range_lever_arm_m: 1 2\ntime_s,range_m\n0,1\n";
    QTest::newRow("marks: empty") << "marks"
                                  << "";
    QTest::newRow("marks: header") << "marks"
                                   << "a,b,c\n1,2,3\n";
    QTest::newRow("marks: role") << "marks"
                                 << "point,e_m,n_m,u_m,sigma_h_m,sigma_v_m,role\nA,1,2,3,.01,.01,boss\n";
    QTest::newRow("marks: twice") << "marks"
                                  << "point,e_m,n_m,u_m,sigma_h_m,sigma_v_m,role\n"
                                     "A,1,2,3,.01,.01,check\nA,1,2,3,.01,.01,check\n";
    QTest::newRow("marks: far")
        << "marks"
        << "point,e_m,n_m,u_m,sigma_h_m,sigma_v_m,role\nA,745000,2565000,3,.01,.01,check\n";
    QTest::newRow("project: no JSON") << "project"
                                      << "{\"format\": ";
    QTest::newRow("project: twice") << "project"
                                    << "{\"format\": \"a\", \"format\": \"b\"}";
    QTest::newRow("project: a list") << "project"
                                     << "[]";
    QTest::newRow("project: format") << "project"
                                     << "{\"format\": \"other\"}";
    QTest::newRow("project: no zero point") << "project"
                                            << "{\"format\": \"terrawalk-survey 1\"}";
    QTest::newRow("project: latitude")
        << "project"
        << "{\"format\": \"terrawalk-survey 1\", \"zero_point\": {\"lat_deg\": "
           "123, \"lon_deg\": 1, \"h_ell_m\": 2}, \"runs\": []}";
    QTest::newRow("project: kind")
        << "project"
        << "{\"format\": \"terrawalk-survey 1\", \"zero_point\": {\"lat_deg\": 12, \"lon_deg\": 1, "
           "\"h_ell_m\": 2}, \"runs\": [{\"id\": \"a\", \"kind\": \"walk\", \"log\": \"a.csv\"}]}";
    QTest::newRow("project: outside")
        << "project"
        << "{\"format\": \"terrawalk-survey 1\", \"zero_point\": {\"lat_deg\": 12, \"lon_deg\": 1, "
           "\"h_ell_m\": 2}, \"runs\": [{\"id\": \"a\", \"kind\": \"area\", \"log\": \"../a.csv\"}]}";
    QTest::newRow("lines: no lines") << "lines"
                                     << "x,y\n1,2\n";
    QTest::newRow("dem: no raster") << "dem"
                                    << "nothing";
    QTest::newRow("config: unknown") << "setting"
                                     << "surface.cell=1";
    QTest::newRow("config: value") << "setting"
                                   << "surface.cell_m=-4";
    QTest::newRow("config: word") << "setting"
                                  << "surface.method=best";
    QTest::newRow("config: no JSON") << "config"
                                     << "{";
    QTest::newRow("crs: unknown") << "crs"
                                  << "EPSG:1";
    QTest::newRow("crs: degrees") << "crs"
                                  << "EPSG:4326";
    QTest::newRow("crs: feet") << "crs"
                               << "EPSG:2229";
    QTest::newRow("crs: with heights") << "crs"
                                       << "EPSG:32649+5773";
    QTest::newRow("surface: no points") << "surface"
                                        << "";
    QTest::newRow("surface: on a line") << "surface"
                                        << "0 0 0 1 1 1 2 2 2 3 3 3";
    QTest::newRow("output: a file") << "output"
                                    << "";
    QTest::newRow("file: missing") << "missing"
                                   << "";
}

void ErrorWordsTest::badInputIsToldInChinese() {
    QFETCH(QString, kind);
    QFETCH(QString, text);
    const std::string bytes = text.toStdString();
    SilentProgress quiet;
    std::optional<Error> error;
    const auto take = [&error](const auto& result) {
        if (!result) error = result.error();
    };
    PipelineConfig config;
    if (kind == "log") take(parseArrayLog(bytes, "S01.csv", quiet, {}));
    if (kind == "marks") take(parseControlMarks(bytes, "control.csv"));
    if (kind == "project") take(readSurvey(written("survey.json", bytes), quiet, {}));
    if (kind == "lines") take(readBreaklines(written("lines.txt", bytes), quiet, {}));
    if (kind == "dem") take(readDem(written("dem.tif", bytes), {}));
    if (kind == "setting") take(applySetting(config, bytes));
    if (kind == "config") take(applyConfigFile(config, written("config.json", bytes)));
    if (kind == "crs") take(MapProjection::create(LocalFrame({23.0, 113.0, 10.0}), bytes, "ellipsoid"));
    if (kind == "output") take(OutputFolder::create(written("taken", "a file")));
    if (kind == "missing") take(readArrayLog(folder_.filePath("none.csv").toStdString(), quiet, {}));
    if (kind == "surface") {
        std::vector<Eigen::Vector3d> points;
        const QStringList numbers = text.split(' ', Qt::SkipEmptyParts);
        for (qsizetype i = 0; i + 2 < numbers.size(); i += 3)
            points.emplace_back(numbers[i].toDouble(), numbers[i + 1].toDouble(), numbers[i + 2].toDouble());
        take(DelaunayTin::build(points, {}, quiet, {}));
    }
    QVERIFY2(error, "the input was taken");
    const QString message = reportWords(error->message), cure = reportWords(error->cure);
    QVERIFY2(isChinese(message), qPrintable(message + " | " + QString::fromStdString(error->message)));
    QVERIFY2(cure.isEmpty() || isChinese(cure), qPrintable(cure));
}

void ErrorWordsTest::editsAreToldInChinese() {
    Survey survey;
    survey.marks = {{.name = "P01"}, {.name = "P02"}};
    for (const char* id : {"S01", "S02"}) {
        survey.runs.push_back({.id = id});
        survey.runs.back().log.time_s = {0.0, 1.0, 2.0};
    }
    SurveyEdits edits;
    for (const auto& [sensor, name] : kEditedSensors) edits.stretches.push_back({"S01", 0.0, 1.5, sensor});
    edits.runs = {"S02"};
    edits.marks = {"P01"};
    edits.lines = {Breakline{{{0, 0, 0}, {1, 1, 1}}, BreaklineKind::Hard, {}}};
    auto edited = withEdits(survey, edits);
    QVERIFY(edited.has_value());
    edits.lines.push_back(edits.lines.front());
    const auto more = withEdits(survey, edits);
    QVERIFY(more.has_value());
    edited->notes.push_back(more->notes.back());
    QCOMPARE(edited->notes.size(), kEditedSensors.size() + 4);
    for (const std::string& note : edited->notes) {
        const QString words = reportWords(note);
        QVERIFY2(isChinese(words), qPrintable(words));
    }
    QVERIFY(reportWords(edited->notes.front()).contains("0.0"));
    QCOMPARE(reportWords("drawn line 1 and drawn line 2 cross at 3.250, 4.250"),
             QString::fromUtf8("绘制线 1 与绘制线 2 在 3.250, 4.250 处相交"));
}

void ErrorWordsTest::placeAndCureAreTold() {
    const Error error{ErrorKind::BadData, "no column e_m", "control.csv", 3, "write control or check"};
    QCOMPARE(errorWords(error), QString::fromUtf8("control.csv:3：没有列 e_m；请写 control 或 check"));
    applyLanguage("en");
    QCOMPARE(errorWords(error), QString::fromStdString(error.text()));
}

// Sentences are found in the sources, so that a new one cannot reach a Chinese window in English. Pieces that
// are put together count where a known sentence holds them.
void ErrorWordsTest::everySentenceOfTheCoreIsKnown() {
    const auto sentences = test::coreSentences(TERRAWALK_SOURCE_DIR);
    QVERIFY(sentences.size() > 500);
    const QString known = knownSentences();
    QVERIFY(known.contains("no such file"));
    static const QRegularExpression place("\\{[^}]*\\}");
    QStringList missing;
    for (const auto& [file, sentence] : sentences) {
        if (forTheCommandLineAlone(file)) continue;
        const QString text = QString::fromStdString(sentence).trimmed();
        QString piece = text;
        piece.replace(place, "{}");
        if (isChinese(reportWords(test::withExamples(text.toStdString()))) || known.contains(piece)) continue;
        if (!notToBeTranslated().contains(text))
            missing << QString::fromStdString(file.string()) + ": " + text;
    }
    QVERIFY2(missing.isEmpty(), qPrintable("\n" + missing.join("\n")));
}

}  // namespace terrawalk::gui

int main(int argc, char** argv) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication app(argc, argv);
    terrawalk::gui::ErrorWordsTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "test_error_words.moc"
