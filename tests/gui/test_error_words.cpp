#include <QApplication>
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

void ErrorWordsTest::placeAndCureAreTold() {
    const Error error{ErrorKind::BadData, "no column e_m", "control.csv", 3, "write control or check"};
    QCOMPARE(errorWords(error), QString::fromUtf8("control.csv:3：没有列 e_m；请写 control 或 check"));
    applyLanguage("en");
    QCOMPARE(errorWords(error), QString::fromStdString(error.text()));
}

}  // namespace terrawalk::gui

int main(int argc, char** argv) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication app(argc, argv);
    terrawalk::gui::ErrorWordsTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "test_error_words.moc"
