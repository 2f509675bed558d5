#include <cpl_error.h>
#include <cpl_minixml.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "io/markup_text.hpp"
#include "io/report_plots.hpp"
#include "io/report_text.hpp"
#include "io/svg.hpp"
#include "io/write_products.hpp"
#include "mapping/accuracy.hpp"
#include "mapping/accuracy_statements.hpp"
#include "tests/support/example_report.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/slack.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using test::exampleReport;
using test::ExampleSurvey;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

SurveyReport madeReport(const ExampleSurvey& survey = {}) {
    return withAccuracy(exampleReport(survey));
}

bool isWellFormedXml(const std::string& text) {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
    const std::unique_ptr<CPLXMLNode, decltype(&CPLDestroyXMLNode)> tree(CPLParseXMLString(text.c_str()),
                                                                         CPLDestroyXMLNode);
    const bool parsed = tree != nullptr && CPLGetLastErrorType() == CE_None;
    CPLPopErrorHandler();
    static const std::regex bare_ampersand("&(?!(amp|lt|gt|quot|#39);)");
    return parsed && !std::regex_search(text, bare_ampersand);
}

std::vector<std::string> fields(const std::string& line) {
    std::vector<std::string> out(1);
    for (const char c : line) c == ',' ? out.emplace_back() : (out.back() += c, std::string());
    return out;
}

std::vector<std::vector<std::string>> rowsOf(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    for (std::size_t at = 0; at < csv.size();) {
        const std::size_t end = csv.find('\n', at);
        rows.push_back(fields(csv.substr(at, end - at)));
        at = end + 1;
    }
    return rows;
}

double number(const std::string& text) {
    double value = kMissing;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

/// The cells of a row of the accuracy table, as plain text with plain minus signs.
std::vector<std::string> htmlRow(const std::string& html, const std::string& id) {
    const std::size_t begin = html.find("<tr id=\"" + id + "\">");
    if (begin == std::string::npos) return {};
    const std::string row = html.substr(begin, html.find("</tr>", begin) - begin);
    static const std::regex cell("<td class=\"[a-z]+\">([^<]*)</td>");
    std::vector<std::string> cells;
    for (std::sregex_iterator it(row.begin(), row.end(), cell), end; it != end; ++it) {
        cells.push_back(std::regex_replace((*it)[1].str(), std::regex("\u2212"), "-"));
    }
    return cells;
}

std::string threeDecimals(double value) {
    return fmt::format("{:.3f}", value + 0.0);
}

// ---------------------------------------------------------------------------------------------- agreement

TEST(Report, CsvJsonAndPageTellTheSameNumbers) {
    const SurveyReport report = madeReport();
    const auto rows = rowsOf(residualsCsv(report.residuals));
    const auto json = nlohmann::json::parse(reportJson(report));
    const std::string html = reportHtml(report);

    // Columns: 0 stage, 1 quantity, 2 mark, 3 role, 8..10 differences, 14 used by the estimator.
    std::size_t compared = 0;
    for (const auto& group : json.at("accuracy")) {
        for (const auto& [axis, column] :
             std::map<std::string, std::size_t>{{"east", 8}, {"north", 9}, {"up", 10}}) {
            std::vector<MarkDifference> differences;
            for (const auto& row : rows) {
                if (row[0] == group["stage"] && row[1] == group["quantity"] && row[3] == group["role"] &&
                    row[14] == "false" && !row[column].empty()) {
                    differences.push_back({row[2], number(row[column])});
                }
            }
            if (differences.empty()) {
                EXPECT_TRUE(group[axis].is_null());
                continue;
            }
            ++compared;
            const ErrorStatistics s = errorStatistics(differences, report.seed);
            const auto& told = group[axis];
            constexpr double csv_rounding =
                1e-6;  // half a micrometre for each difference, doubled by the NMAD
            EXPECT_EQ(told["n"], s.n);
            EXPECT_EQ(told["marks"], s.marks);
            EXPECT_NEAR(told["mean_m"], s.mean_m, csv_rounding);
            EXPECT_NEAR(told["sd_m"], *s.sd_m, csv_rounding);
            EXPECT_NEAR(told["rmse_m"], s.rmse_m, csv_rounding);
            EXPECT_NEAR(told["rmse_95_m"][0], s.rmse_95->low_m, csv_rounding);
            EXPECT_NEAR(told["rmse_95_m"][1], s.rmse_95->high_m, csv_rounding);
            EXPECT_NEAR(told["mae_m"], s.mae_m, csv_rounding);
            EXPECT_NEAR(told["median_m"], s.median_m, csv_rounding);
            EXPECT_NEAR(told["nmad_m"], s.nmad_m, 2 * csv_rounding);
            EXPECT_NEAR(told["largest_m"], s.largest_m, csv_rounding);

            std::string id =
                fmt::format("{}-{}-{}-{}", group["role"].get<std::string>(),
                            group["stage"].get<std::string>(), group["quantity"].get<std::string>(), axis);
            std::replace(id.begin(), id.end(), ' ', '-');
            const auto metres = [&](const char* key) {
                return threeDecimals(told[key].get<double>());
            };
            const auto no_negative_zero = [](std::string text) {
                return text == "-0.000" ? "0.000" : text;
            };
            EXPECT_THAT(htmlRow(html, id),
                        ElementsAre(axis, fmt::format("{}", s.n), fmt::format("{}", s.marks),
                                    no_negative_zero(metres("mean_m")), metres("sd_m"), metres("rmse_m"),
                                    threeDecimals(told["rmse_95_m"][0]) + " \u2026 " +
                                        threeDecimals(told["rmse_95_m"][1]),
                                    metres("mae_m"), metres("largest_m")))
                << id;
            EXPECT_EQ(told["error95_95_m"].is_null(), s.marks < 72);
            EXPECT_EQ(told["error95_95_note"],
                      s.marks < 72 ? nlohmann::json(fmt::format("not determined with {} marks", s.marks))
                                   : nlohmann::json(nullptr));
            const auto interval = [&](const char* key) {
                return no_negative_zero(threeDecimals(told[key][0])) + " \u2026 " +
                       no_negative_zero(threeDecimals(told[key][1]));
            };
            EXPECT_THAT(
                htmlRow(html, id + "-robust"),
                ElementsAre(axis, no_negative_zero(metres("median_m")), interval("median_95_m"),
                            metres("nmad_m"), interval("nmad_95_m"), metres("error68_m"), metres("error95_m"),
                            told["error95_95_m"].is_null() ? told["error95_95_note"].get<std::string>()
                                                           : interval("error95_95_m")))
                << id;
        }
    }
    EXPECT_EQ(compared, 12U);  // up at check marks: 3; control: 3 heights and twice 3 axes
}

/// What the exported CSV says by definitions written down a second time, here: Hoehle and Hoehle 2009, the
/// ASPRS standard and the NSSDA.
struct Recomputed {
    double mean = 0.0, sd = 0.0, rmse = 0.0, mae = 0.0, median = 0.0, nmad = 0.0, error68 = 0.0,
           error95 = 0.0;

    explicit Recomputed(std::vector<double> d) {
        const auto n = static_cast<double>(d.size());
        for (const double x : d) {
            mean += x / n;
            mae += std::fabs(x) / n;
            rmse += x * x / n;
        }
        for (const double x : d) sd += (x - mean) * (x - mean) / (n - 1.0);
        rmse = std::sqrt(rmse);
        sd = std::sqrt(sd);
        median = at(d, 0.5);
        std::vector<double> sizes = d, distances = d;
        for (double& x : sizes) x = std::fabs(x);
        for (double& x : distances) x = std::fabs(x - median);
        nmad = 1.4826 * at(distances, 0.5);
        error68 = at(sizes, 0.683);
        error95 = at(sizes, 0.95);
    }
    /// Between the order statistics at 0, 1/(n-1), 2/(n-1), ...
    static double at(std::vector<double> values, double p) {
        std::sort(values.begin(), values.end());
        const double place = p * static_cast<double>(values.size() - 1);
        const auto below = static_cast<std::size_t>(std::floor(place));
        const double share = place - static_cast<double>(below);
        return share == 0.0 ? values[below] : values[below] * (1.0 - share) + values[below + 1] * share;
    }
    void expectToldIn(const nlohmann::json& told) const {
        constexpr double kCsvRounding = 2e-6;
        for (const auto& [key, value] : std::map<std::string, double>{{"mean_m", mean},
                                                                      {"sd_m", sd},
                                                                      {"rmse_m", rmse},
                                                                      {"mae_m", mae},
                                                                      {"median_m", median},
                                                                      {"nmad_m", nmad},
                                                                      {"error68_m", error68},
                                                                      {"error95_m", error95}}) {
            EXPECT_NEAR(told.at(key), value, kCsvRounding) << key;
        }
        for (const char* interval : {"median_95_m", "nmad_95_m", "error95_95_m"}) {
            if (told.at(interval).is_null()) continue;
            EXPECT_LE(told.at(interval)[0], told.at(interval)[1]);
        }
    }
};

/// Surface heights at check marks on every kind of slope, some among plants, one blunder.
SurveyReport reportWithSlopes() {
    SurveyReport report = exampleReport({});
    std::size_t i = 0;
    for (Residual& r : report.residuals) {
        if (r.stage != Stage::Surface) continue;
        r.slope = 0.015 * static_cast<double>(i % 40);
        r.cover = i % 3 == 0 ? GroundCover::Vegetated : i % 3 == 1 ? GroundCover::Open : GroundCover::Unknown;
        if (i == 20) r.difference_enu_m.z() = 4.0;
        ++i;
    }
    return withAccuracy(report);
}

TEST(Report, FiguresFollowFromTheExportedCsv) {
    const SurveyReport report = reportWithSlopes();
    const auto rows = rowsOf(residualsCsv(report.residuals));
    const auto json = nlohmann::json::parse(reportJson(report));
    const auto column = [&](const std::string& name) {
        return static_cast<std::size_t>(std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin());
    };
    const std::size_t d_up = column("d_u_m"), slope = column("slope"), cover = column("cover"),
                      used = column("used_by_estimator"), blunder = column("possible_blunder");
    const auto counted = [&](const nlohmann::json& group, std::size_t axis) {
        std::vector<double> d;
        for (const auto& row : rows) {
            if (row[0] == group.at("stage") && row[1] == group.at("quantity") && row[3] == group.at("role") &&
                row[used] == "false" && !row[axis].empty()) {
                d.push_back(number(row[axis]));
            }
        }
        return d;
    };
    for (const auto& group : json.at("accuracy")) {
        const Recomputed up(counted(group, d_up));
        up.expectToldIn(group.at("up"));
        EXPECT_NEAR(group.at("nssda_vertical_m"), 1.96 * up.rmse, 4e-6);
        const auto east = counted(group, column("d_e_m")), north = counted(group, column("d_n_m"));
        if (east.empty()) {
            EXPECT_TRUE(group.at("nssda_horizontal_m").is_null());
            continue;
        }
        const double x = Recomputed(east).rmse, y = Recomputed(north).rmse;
        if (std::min(x, y) / std::max(x, y) >= 0.6) {
            EXPECT_NEAR(group.at("nssda_horizontal_m"), 2.4477 * 0.5 * (x + y), 1e-5);
        } else {
            EXPECT_TRUE(group.at("nssda_horizontal_m").is_null());
        }
    }

    std::map<std::string, std::vector<double>> strata;
    std::vector<std::pair<double, double>> sloping;  // slope, difference
    std::size_t flagged = 0;
    for (const auto& row : rows) {
        if (row[0] != "surface" || row[3] != "check" || row[used] != "false") continue;
        const double s = number(row[slope]), d = number(row[d_up]);
        strata[s < 0.1   ? "tread, slope below 10 %"
               : s < 0.3 ? "slope of 10 to 30 %"
                         : "riser, slope of 30 % and more"]
            .push_back(d);
        if (!row[cover].empty()) strata[row[cover]].push_back(d);
        sloping.emplace_back(s, d);
        if (row[blunder] == "true") {
            ++flagged;
            EXPECT_EQ(d, 4.0);
        }
    }
    EXPECT_EQ(flagged, 1U);
    ASSERT_EQ(json.at("strata").size(), 5U);
    for (const auto& stratum : json.at("strata")) {
        ASSERT_TRUE(strata.contains(stratum.at("name"))) << stratum.at("name");
        const auto& d = strata.at(stratum.at("name"));
        EXPECT_EQ(stratum.at("up").at("n"), d.size());
        Recomputed(d).expectToldIn(stratum.at("up"));
    }

    // The stands of this survey are on control marks only.
    double plan = 0.0, leaked = 0.0, all = 0.0;
    for (const char* axis : {"d_e_m", "d_n_m"}) {
        plan += 0.5 * std::pow(Recomputed(counted({{"stage", "fused"},
                                                   {"quantity", std::string(name(Quantity::ArrayPosition))},
                                                   {"role", "control"}},
                                                  column(axis)))
                                   .rmse,
                               2.0);
    }
    for (const auto& [s, d] : sloping) {
        leaked += plan * s * s;
        all += d * d;
    }
    const auto& leakage = json.at("slope_leakage");
    EXPECT_NEAR(leakage.at("plan_rmse_m"), std::sqrt(plan), 2e-6);
    EXPECT_NEAR(leakage.at("rmse_m"), std::sqrt(leaked / static_cast<double>(sloping.size())), 2e-6);
    EXPECT_NEAR(leakage.at("share"), leaked / all, 1e-5);
}

std::string withoutBlanks(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c != ' ' && c != '\n' && c != '\f') out += c;
    }
    return out;
}

// The map is drawn smaller where the words leave no room for all of it, and half a page would stay empty.
TEST(ReportPdf, TheMapStandsOnTheFirstPage) {
    const test::TemporaryFolder folder;
    for (const std::size_t marks : {12UL, 80UL}) {
        ASSERT_TRUE(writeReportPdf(madeReport({.check_marks = marks}), folder / "report.pdf"));
        const auto read = test::runProgram(
            {"/usr/bin/pdftotext", "-f", "1", "-l", "1", (folder / "report.pdf").string(), "-"});
        ASSERT_EQ(read.exit_code, 0) << read.err;
        EXPECT_THAT(read.out, HasSubstr("Map of the walk")) << marks;
        EXPECT_THAT(read.out, HasSubstr("both axes to one scale")) << marks;
    }
}

TEST(ReportPdf, SaysWhatThePageSays) {
    const SurveyReport report = reportWithSlopes();
    const test::TemporaryFolder folder;
    ASSERT_TRUE(writeReportPdf(report, folder / "report.pdf"));
    const auto read =
        test::runProgram({"/usr/bin/pdftotext", "-layout", (folder / "report.pdf").string(), "-"});
    ASSERT_EQ(read.exit_code, 0) << read.err;
    const std::string text = withoutBlanks(read.out);
    for (const KeyFigure& figure : report.figures) {
        EXPECT_THAT(text, HasSubstr(withoutBlanks(figure.value)));
    }
    // Every error measure of the page, row by row. (Sentences that run over two pages have a page's foot
    // between.)
    const std::string html = reportHtml(report);
    static const std::regex anchor("<tr id=\"([^\"]+)\">");
    std::size_t measured = 0;
    for (std::sregex_iterator it(html.begin(), html.end(), anchor), end; it != end; ++it) {
        std::string row;
        for (const std::string& cell : htmlRow(html, (*it)[1].str())) row += cell;
        row = withoutBlanks(std::regex_replace(row, std::regex("-"), "\u2212"));
        EXPECT_THAT(text, HasSubstr(row)) << (*it)[1].str();
        ++measured;
    }
    EXPECT_GT(measured, 20U);
}

TEST(ReportPdf, IsTheSameBytesTwiceAndWhateverTheSurveyHolds) {
    EXPECT_EQ(reportPdf(madeReport()).value(), reportPdf(madeReport()).value());
    for (const SurveyReport& report :
         {SurveyReport{}, withAccuracy({}), madeReport({.check_marks = 0}),
          madeReport({.fixed_point_runs = 1, .area_epochs = 0, .check_marks = 1, .control_marks = 0})}) {
        const auto pdf = reportPdf(report);
        ASSERT_TRUE(pdf) << pdf.error().text();
        EXPECT_THAT(*pdf, StartsWith("%PDF-"));
    }
}

TEST(Report, FirstFigureIsThatOfTheTable) {
    const SurveyReport report = madeReport();
    const auto cells = htmlRow(reportHtml(report), "check-surface-surface-height-up");
    ASSERT_GT(cells.size(), 5U);
    EXPECT_EQ(report.figures.at(0).value, cells[5] + " m");
}

TEST(Report, IsTheSameBytesTwice) {
    const SurveyReport a = madeReport(), b = madeReport();
    EXPECT_EQ(reportHtml(a), reportHtml(b));
    EXPECT_EQ(reportJson(a), reportJson(b));
    EXPECT_EQ(residualsCsv(a.residuals), residualsCsv(b.residuals));
}

TEST(Report, FilesHoldTheText) {
    const SurveyReport report = madeReport({.fixed_point_runs = 1, .area_epochs = 100, .check_marks = 3});
    const test::TemporaryFolder folder;
    ASSERT_TRUE(writeReportHtml(report, folder / "report.html"));
    ASSERT_TRUE(writeReportJson(report, folder / "report.json"));
    ASSERT_TRUE(writeResidualsCsv(report.residuals, folder / "residuals.csv"));
    EXPECT_EQ(test::bytesOf(folder / "report.html"), reportHtml(report));
    EXPECT_EQ(test::bytesOf(folder / "report.json"), reportJson(report));
    EXPECT_EQ(test::bytesOf(folder / "residuals.csv"), residualsCsv(report.residuals));
    EXPECT_FALSE(writeReportHtml(report, folder / "no such folder" / "report.html"));
}

// ---------------------------------------------------------------------------------------------- page

TEST(ReportPage, CheckerSeesBrokenXml) {
    EXPECT_TRUE(isWellFormedXml("<a b=\"c\"><d/>x &amp; y</a>"));
    EXPECT_FALSE(isWellFormedXml("<a><b></a></b>"));
    EXPECT_FALSE(isWellFormedXml("<a>x & y</a>"));
}

TEST(ReportPage, IsWellFormedWhateverTheSurveyHolds) {
    for (const ExampleSurvey& survey :
         {ExampleSurvey{}, ExampleSurvey{.fixed_point_runs = 0, .check_marks = 0, .control_marks = 0},
          ExampleSurvey{.fixed_point_runs = 1, .area_epochs = 0, .check_marks = 1, .control_marks = 0},
          ExampleSurvey{.check_marks = 0}, ExampleSurvey{.check_marks = 400, .sigma_before_m = 30.0}}) {
        const SurveyReport report = madeReport(survey);
        EXPECT_TRUE(isWellFormedXml(reportHtml(report))) << survey.check_marks;
    }
    EXPECT_TRUE(isWellFormedXml(reportHtml(withAccuracy({}))));
    EXPECT_TRUE(isWellFormedXml(reportHtml({})));
}

TEST(ReportPage, HoldsNoScriptAndFetchesNothing) {
    const std::string html = reportHtml(madeReport());
    EXPECT_THAT(html, AllOf(Not(HasSubstr("<script")), Not(HasSubstr("http:")), Not(HasSubstr("https:")),
                            Not(HasSubstr("url(")), Not(HasSubstr("@import")), Not(HasSubstr("src="))));
}

TEST(ReportPage, EscapesNamesOfHostileFiles) {
    const std::string hostile = "<script>alert('x')</script>\"&\x01\xff\u202E";
    SurveyReport report = exampleReport({.fixed_point_runs = 2, .area_epochs = 50, .check_marks = 12});
    report.survey_name = report.program_version = report.method = hostile;
    report.warnings = report.limitations = {hostile};
    report.settings.push_back({hostile, hostile, hostile});
    report.inputs.push_back({hostile, 1, hostile});
    report.surface.method = report.surface.crs = report.surface.vertical_datum = hostile;
    for (RunReport& run : report.runs) {
        run.id = hostile;
        run.notes = {hostile};
        run.fixes.push_back({hostile, 3});
        run.ground_points_rejected.push_back({hostile, 3});
        run.sensors.push_back({hostile, 3, 2, 1, {{hostile, 1}}});
    }
    for (ControlMark& mark : report.marks) mark.name = hostile;
    for (Residual& r : report.residuals) r.mark = r.run = hostile;
    for (MissingResidual& m : report.missing_residuals) m.mark = m.run = hostile;
    report = withAccuracy(report);

    const std::string html = reportHtml(report);
    EXPECT_TRUE(isWellFormedXml(html));
    EXPECT_THAT(html, AllOf(Not(HasSubstr("<script")), Not(HasSubstr("\xff")), Not(HasSubstr("\x01")),
                            Not(HasSubstr("\u202E")),
                            HasSubstr("&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;&quot;&amp;\uFFFD")));
    EXPECT_EQ(nlohmann::json::parse(reportJson(report))["survey"],
              "<script>alert('x')</script>\"&\x01\uFFFD\u202E");
}

TEST(ReportPage, WithoutMarksSaysThatNoAccuracyCouldBeStated) {
    const std::string html =
        reportHtml(madeReport({.fixed_point_runs = 0, .check_marks = 0, .control_marks = 0}));
    EXPECT_THAT(html, AllOf(HasSubstr("No accuracy can be stated"), HasSubstr("not known"),
                            HasSubstr("What could not be checked"),
                            Not(HasSubstr("<tbody class=\"group\">\n<tr id=\"check"))));
}

TEST(ReportPage, ShowsNoNumberThatIsNone) {
    SurveyReport report = madeReport({.check_marks = 1, .control_marks = 0});
    report.residuals[0].difference_enu_m.setConstant(kMissing);
    report.residuals[0].mark_enu_m.setConstant(kMissing);
    report.marks[0].enu_m.setConstant(kMissing);
    report.runs[0].track_enu_m[3].setConstant(kMissing);
    report.runs[0].distance_m = HUGE_VAL;
    report.surface.area_m2 = kMissing;
    report.surface.lowest_m = kMissing;
    const std::string html = reportHtml(withAccuracy(report));
    EXPECT_TRUE(isWellFormedXml(html));
    std::smatch found;
    EXPECT_FALSE(std::regex_search(html, found, std::regex(".{0,40}[^a-z](nan|inf)[^a-z].{0,40}")))
        << found.str();
}

TEST(ReportPage, ListsLinesOfRepeatedAndLateRows) {
    const std::string html = reportHtml(madeReport());
    EXPECT_THAT(html, AllOf(HasSubstr("repeated time dropped, lines 112, 2841\u20132843, 7710."),
                            HasSubstr("late rows put in order, lines 4011\u20134012.")));
}

TEST(ReportPage, PutsChangedSettingsFirst) {
    const std::string html = reportHtml(madeReport());
    EXPECT_LT(html.find("dem.cell_m"), html.find("fusion.method"));
    EXPECT_THAT(html, HasSubstr("Settings: 5 in all, 2 other than default"));
}

TEST(ReportPage, KeepsTiedComparisonsOutOfTablesAndPlots) {
    SurveyReport report = exampleReport({.check_marks = 0, .control_marks = 1});
    for (Residual& r : report.residuals) r.used_by_estimator = true;
    report = withAccuracy(report);
    EXPECT_THAT(report.accuracy, IsEmpty());
    EXPECT_EQ(heightErrorPlot(report), "");
    EXPECT_EQ(standErrorPlot(report), "");
    EXPECT_EQ(planErrorPlot(report), "");
    EXPECT_EQ(heightHistogram(report), "");
    EXPECT_THAT(reportHtml(report), HasSubstr("no, used"));
}

TEST(ReportPage, OfHundredsOfMarksTakesAMoment) {
    const SurveyReport report = madeReport({.check_marks = 800});
    const auto start = std::chrono::steady_clock::now();
    const std::string html = reportHtml(report);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2 * test::kSlack));
    EXPECT_LT(html.size(), 3'000'000U);
}

// ---------------------------------------------------------------------------------------------- Chinese

/// A report of everything that a page can tell.
SurveyReport fullReport() {
    SurveyReport report = reportWithSlopes();
    report.adjustment = AdjustmentSummary{};
    report.adjustment->crossovers = 120;
    report.adjustment->crossover_test = {100, 95, 0.9};
    report.adjustment->left_out = {10, 0.3, 0.1};
    report.adjustment->plan_inflation = 1.3;
    report.adjustment->noise = {{"barometer drift", 80, 1.2, 3}, {"GNSS noise, plan, single", 900, 1.6, 40}};
    report.surface.uncertainty = UncertaintySummary{};
    report.surface.uncertainty->own_variance = true;
    report.surface.variogram = VariogramSummary{"spherical", 0.01, 0.4, 12.0, std::nullopt, 4000};
    report.surface.breaklines = 2;
    report.occupancy = OccupancySummary{};
    report.tuning = TuningRecord{.survey = "Orchard",
                                 .method = "aukf",
                                 .optimiser = "isma",
                                 .left_out_before = 2.0,
                                 .left_out_after = 1.5,
                                 .decision =
                                     "The search found nothing better than the values that it started "
                                     "from; these stay.",
                                 .marks = {{"P01"}, {"P02"}}};
    report.runs.front().cut_off_line = 12;
    report.runs.front().notes = {"no GNSS position for 12 s",
                                 "heading missing in 3 of 259 epochs; the last "
                                 "value is held"};
    report.warnings = {"line 4: unknown key speed is not used"};
    report.language = ReportLanguage::Chinese;
    return report;
}

/// The page without what stays as it is: style, names and codes, English that a standard prescribes.
std::string proseOf(std::string html) {
    const std::size_t style = html.find("<style>");
    html.erase(style, html.find("</style>") - style);
    html = std::regex_replace(html, std::regex("<[^>]* translate=\"no\"[^>]*>[^<]*"), "<");
    html = std::regex_replace(html, std::regex("\uff08Tested [^<]*"), "");
    return std::regex_replace(html, std::regex("<[^>]*>"), "\n");
}

TEST(ReportInChinese, LeavesNoSentenceInEnglish) {
    std::vector<SurveyReport> reports{
        fullReport(),
        SurveyReport{},
        withAccuracy({}),
        madeReport({.check_marks = 0}),
        madeReport({.fixed_point_runs = 0, .check_marks = 0, .control_marks = 0}),
        madeReport({.fixed_point_runs = 1, .area_epochs = 0, .check_marks = 1, .control_marks = 0}),
        madeReport({.check_marks = 400, .sigma_before_m = 30.0})};
    for (SurveyReport& report : reports) {
        report.language = ReportLanguage::Chinese;
        report.program_version = "0.1.0";
        if (!report.survey_name.empty()) report.survey_name = "Orchard";
        // Sentences that no code of the program says.
        if (!report.runs.empty()) report.runs.back().notes.clear();
        std::erase_if(report.limitations,
                      [](const std::string& s) { return s.starts_with("The GNSS base"); });
        if (report.method.starts_with("unscented")) report.method = "9-state unscented Kalman filter";
        if (report.surface.method.ends_with("interpolation")) report.surface.method += " at cell centres";
        if (!report.surface.vertical_datum.empty())
            report.surface.vertical_datum = "Heights are metres above the WGS 84 ellipsoid.";
        for (RunReport& run : report.runs) {
            for (SensorUse& use : run.sensors) use.rejections = {{"beyond gate", 3}, {"no texture", 5}};
            if (!run.sensors.empty()) run.sensors.pop_back();
        }
        const std::string html = reportHtml(report);
        EXPECT_TRUE(isWellFormedXml(html));
        EXPECT_THAT(html, HasSubstr("<html lang=\"zh-CN\">"));
        const std::string prose = proseOf(html);
        static const std::regex english(".*[a-z]{2,} [a-z]{2,}.*");
        for (std::sregex_iterator it(prose.begin(), prose.end(), english), end; it != end; ++it)
            ADD_FAILURE() << it->str();
    }
}

TEST(ReportInChinese, TellsTheSameNumbers) {
    SurveyReport report = fullReport();
    const std::string chinese = reportHtml(report);
    report.language = ReportLanguage::English;
    const std::string english = reportHtml(report);
    static const std::regex anchor("<tr id=\"([^\"]+)\">");
    std::size_t rows = 0;
    for (std::sregex_iterator it(english.begin(), english.end(), anchor), end; it != end; ++it, ++rows) {
        const auto told = htmlRow(english, (*it)[1].str()), again = htmlRow(chinese, (*it)[1].str());
        ASSERT_EQ(told.size(), again.size());
        for (std::size_t i = 1; i < told.size(); ++i) {
            if (!told[i].starts_with("not determined")) {
                EXPECT_EQ(told[i], again[i]);
            }
        }
    }
    EXPECT_GT(rows, 10U);
    EXPECT_EQ(reportJson(report), reportJson(fullReport()));
}

TEST(ReportInChinese, LeavesNamesAsTheyAre) {
    SurveyReport report = exampleReport({.fixed_point_runs = 2, .area_epochs = 50, .check_marks = 12});
    report.language = ReportLanguage::Chinese;
    report.survey_name = "Terrain model";
    report.runs.front().id = "surface";
    report.marks.back().name = "check";
    for (Residual& r : report.residuals) r.mark = "check";
    const std::string html = reportHtml(withAccuracy(report));
    EXPECT_THAT(html,
                AllOf(HasSubstr(">Terrain model</h1>"), HasSubstr(">surface</span>"),
                      HasSubstr(">surface</th>"), HasSubstr(">check</th>"), HasSubstr(">check</text>")));
}

TEST(ReportInChinese, KeepsTheWordingOfTheStandards) {
    const std::string html = reportHtml(fullReport());
    EXPECT_THAT(html,
                AllOf(HasSubstr("\u4f4d\u7f6e\u7cbe\u5ea6\u6807\u51c6"), HasSubstr("\uff08Tested with ")));
}

TEST(ReportInChinese, ReadsOnPaper) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(writeReportPdf(fullReport(), folder / "report.pdf"));
    EXPECT_EQ(test::bytesOf(folder / "report.pdf"), reportPdf(fullReport()).value());
    const auto read =
        test::runProgram({"/usr/bin/pdftotext", "-layout", (folder / "report.pdf").string(), "-"});
    ASSERT_EQ(read.exit_code, 0) << read.err;
    EXPECT_THAT(withoutBlanks(read.out),
                AllOf(HasSubstr("\u672a\u80fd\u68c0\u6838\u7684\u5185\u5bb9"), HasSubstr("Testedwith"),
                      HasSubstr("\u878d\u5408\u65b9\u6cd5")));
}

// ---------------------------------------------------------------------------------------------- map

TEST(SurveyMap, HasOneScaleForBothAxes) {
    // A square of 40 m has to be drawn square.
    SurveyReport report;
    report.runs.emplace_back().track_enu_m = {{0, 0, 0}, {40, 0, 0}, {40, 40, 0}};
    const std::string svg = surveyMap(report);
    std::smatch m;
    ASSERT_TRUE(std::regex_search(
        svg, m,
        std::regex("<polyline points=\"([0-9.]+),([0-9.]+) ([0-9.]+),([0-9.]+) ([0-9.]+),([0-9.]+)\"")));
    const double east_px = number(m[3]) - number(m[1]), north_px = number(m[4]) - number(m[6]);
    EXPECT_GT(east_px, 100.0);
    EXPECT_NEAR(east_px, north_px, 0.2);  // pixels are rounded to a tenth
    EXPECT_EQ(number(m[2]), number(m[4]));
}

TEST(SurveyMap, ScaleBarIsTrue) {
    SurveyReport report;
    report.runs.emplace_back().track_enu_m = {{0, 0, 0}, {40, 0, 0}};
    const std::string svg = surveyMap(report);
    std::smatch line, bar, words;
    ASSERT_TRUE(std::regex_search(svg, line, std::regex("<polyline points=\"([0-9.]+),[0-9.]+ ([0-9.]+),")));
    ASSERT_TRUE(std::regex_search(svg, bar, std::regex("width=\"([0-9.]+)\" height=\"4\" class=\"ink\"")));
    ASSERT_TRUE(std::regex_search(svg, words, std::regex(">([0-9]+) m</text>")));
    const double px_per_m = (number(line[2]) - number(line[1])) / 40.0;
    EXPECT_NEAR(number(bar[1]) / px_per_m, number(words[1]), 0.1 / px_per_m * 3);
}

TEST(SurveyMap, OfASinglePointOrOfNothingIsHarmless) {
    SurveyReport report;
    EXPECT_EQ(surveyMap(report), "");
    report.marks.push_back({"P", {1e6, -1e6, 0}, 0, 0, MarkRole::Check});
    EXPECT_THAT(surveyMap(report), HasSubstr(">P</text>"));
}

// ---------------------------------------------------------------------------------------------- json and csv

TEST(ReportJson, KeysStandInTheirOrderAndMissingIsNull) {
    SurveyReport report = madeReport({.check_marks = 2, .control_marks = 0});
    const auto json = nlohmann::ordered_json::parse(reportJson(report));
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.push_back(key);
    EXPECT_THAT(keys, ElementsAre("format", "survey", "program_version", "method", "seed", "figures",
                                  "statements", "limitations", "warnings", "headline", "accuracy", "strata",
                                  "slope_leakage", "slope_leakage_unknown", "vertical_class", "residuals",
                                  "missing_residuals", "marks", "adjustment", "surface", "occupancy", "runs",
                                  "tuning", "settings", "inputs"));
    EXPECT_TRUE(json["tuning"].is_null());
    EXPECT_TRUE(json["vertical_class"].is_null());
    EXPECT_EQ(json["format"], "terrawalk-report 1");
    EXPECT_TRUE(json["residuals"][0]["difference_enu_m"][0].is_null());
    EXPECT_TRUE(json["residuals"][0]["sigma_enu_m"][2].is_null());
    EXPECT_TRUE(json["accuracy"][0]["east"].is_null());
    EXPECT_TRUE(json["accuracy"][0]["up"]["rmse_95_m"].is_null());
    EXPECT_TRUE(json["runs"][0]["cut_off_line"].is_null());
    EXPECT_THAT(json["warnings"], IsEmpty());
    EXPECT_TRUE(json["warnings"].is_array());
}

// What was tuned, by whom, on what, and whether it was used.
TEST(Report, TellsOfATuning) {
    SurveyReport report = madeReport();
    EXPECT_THAT(reportHtml(report), Not(HasSubstr("id=\"tuning\"")));
    report.tuning = TuningRecord{.survey = "Orchard <1>",
                                 .method = "aukf",
                                 .optimiser = "isma",
                                 .seed = 77,
                                 .evaluations = 12345,
                                 .loss_before = 56.644,
                                 .loss_after = 43.953,
                                 .left_out_before = 56.644,
                                 .left_out_after = HUGE_VAL,
                                 .in_use = false,
                                 .decision = "Not adopted, for a reason.",
                                 .warnings = {"a warning"},
                                 .marks = {{"P01"}, {"P02"}}};
    const std::string html = reportHtml(report);
    EXPECT_TRUE(isWellFormedXml(html));
    for (const char* told : {"id=\"tuning\"", "Orchard &lt;1&gt;", "seed 77", "12\u202f345", "43.953",
                             "not used", "Not adopted, for a reason.", "a warning", "P01, P02"}) {
        EXPECT_THAT(html, HasSubstr(told));
    }
    const auto json = nlohmann::json::parse(reportJson(report)).at("tuning");
    EXPECT_EQ(json.at("seed"), 77);
    EXPECT_EQ(json.at("in_use"), false);
    EXPECT_EQ(json.at("loss_after"), 43.953);
    EXPECT_TRUE(json.at("left_out_after").is_null());
    EXPECT_THAT(json.at("marks"), ElementsAre("P01", "P02"));
}

TEST(ReportJson, NumbersReadBackToTheSameBits) {
    const SurveyReport report = madeReport();
    const auto json = nlohmann::json::parse(reportJson(report));
    for (std::size_t i = 0; i < report.residuals.size(); ++i) {
        const double told = json["residuals"][i]["difference_enu_m"][2];
        EXPECT_EQ(told, report.residuals[i].difference_enu_m.z());
    }
    EXPECT_EQ(json["accuracy"][0]["up"]["rmse_m"].get<double>(), report.accuracy[0].up->rmse_m);
    EXPECT_EQ(json["headline"]["stage"], "surface");
}

TEST(ResidualsCsv, QuotesNamesAndLeavesMissingEmpty) {
    Residual r;
    r.mark = "P \"1\", north";
    r.run = "two\nlines";
    r.mark_enu_m = {1.0, -2.5, 1e-9};
    r.difference_enu_m.z() = -1e-9;
    r.used_by_estimator = true;
    EXPECT_EQ(residualsCsv({r}),
              "stage,quantity,mark,role,run,mark_e_m,mark_n_m,mark_u_m,d_e_m,d_n_m,d_u_m,sigma_e_m,sigma_n_m,"
              "sigma_u_m,"
              "used_by_estimator,slope,cover,possible_blunder\n"
              "fused,surface height,\"P \"\"1\"\", "
              "north\",check,\"two\nlines\",1.000000,-2.500000,0.000000,,,0.000000,,,,"
              "true,,,false\n");
}

// ---------------------------------------------------------------------------------------------- text and
// ticks

TEST(NiceTicks, AreRoundAndInside) {
    const Ticks ticks = niceTicks(-0.33, 0.41, 8);
    EXPECT_EQ(ticks.step, 0.1);
    EXPECT_EQ(ticks.decimals, 1);
    ASSERT_EQ(ticks.values.size(), 8U);
    EXPECT_NEAR(ticks.values.front(), -0.3, 1e-12);
    EXPECT_EQ(ticks.values[3], 0.0);
    EXPECT_NEAR(ticks.values.back(), 0.4, 1e-12);
}

TEST(NiceTicks, KeepTicksThatFallOnTheEnds) {
    EXPECT_THAT(niceTicks(0.0, 10.0, 5).values, ElementsAre(0, 2, 4, 6, 8, 10));
    EXPECT_THAT(niceTicks(0.0, 0.3, 3).values.size(), 4U);
}

TEST(NiceTicks, HoldAtEveryScale) {
    for (int power = -8; power <= 8; ++power) {
        const double scale = std::pow(10.0, power);
        for (const double span : {1.0, 1.7, 2.3, 4.9, 9.99}) {
            const Ticks ticks = niceTicks(0.13 * scale, (0.13 + span) * scale, 6);
            EXPECT_GE(ticks.values.size(), 2U) << span * scale;
            EXPECT_LE(ticks.values.size(), 7U) << span * scale;
            EXPECT_EQ(ticks.decimals,
                      std::max(0, static_cast<int>(-std::floor(std::log10(ticks.step) + 1e-9))));
            for (const double value : ticks.values) {
                EXPECT_GE(value, 0.13 * scale * (1 - 1e-8));
                EXPECT_LE(value, (0.13 + span) * scale * (1 + 1e-8));
            }
        }
    }
}

TEST(NiceTicks, OfNoRangeAreNone) {
    EXPECT_THAT(niceTicks(1.0, 1.0, 5).values, IsEmpty());
    EXPECT_THAT(niceTicks(2.0, 1.0, 5).values, IsEmpty());
    EXPECT_THAT(niceTicks(kMissing, 1.0, 5).values, IsEmpty());
    EXPECT_THAT(niceTicks(0.0, HUGE_VAL, 5).values, IsEmpty());
    EXPECT_EQ(niceStep(-1.0), 1.0);
}

TEST(MarkupText, BrokenUtf8BecomesReplacementCharacters) {
    EXPECT_EQ(escapedMarkup("\xC3\xA9\xE6\x9F\xB3\xF0\x9F\x8C\xB1"), "\xC3\xA9\xE6\x9F\xB3\xF0\x9F\x8C\xB1");
    EXPECT_EQ(escapedMarkup("a\xC3"), "a\uFFFD");                         // cut off
    EXPECT_EQ(escapedMarkup("\xC0\xAF"), "\uFFFD\uFFFD");                 // overlong
    EXPECT_EQ(escapedMarkup("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD");       // surrogate
    EXPECT_EQ(escapedMarkup("\xF4\x90\x80\x80").substr(0, 3), "\uFFFD");  // beyond Unicode
    EXPECT_EQ(escapedMarkup(std::string_view("\0\x1b", 2)), "\uFFFD\uFFFD");
}

TEST(MarkupText, IsCutBetweenCharacters) {
    EXPECT_EQ(shortened("\u00e9\u00e9\u00e9\u00e9", 3), "\u00e9\u00e9\u2026");
    EXPECT_EQ(shortened("\u00e9\u00e9\u00e9", 3), "\u00e9\u00e9\u00e9");
}

TEST(MarkupText, NumbersHaveATrueMinusAndNoNegativeZero) {
    EXPECT_EQ(fixedDecimals(-1.23456, 3), "\u22121.235");
    EXPECT_EQ(fixedDecimals(-0.0004, 3), "0.000");
    EXPECT_EQ(fixedDecimals(kMissing, 3), "\u2013");
    EXPECT_EQ(groupedDigits(9141), "9\u202F141");
    EXPECT_EQ(groupedDigits(999), "999");
    EXPECT_EQ(groupedDigits(1234567), "1\u202F234\u202F567");
}

}  // namespace
}  // namespace terrawalk
