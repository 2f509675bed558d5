#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_support.hpp"

namespace terrawalk::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kHeader = "time_s,lat_deg,lon_deg,fix,pressure_pa,roll_deg,pitch_deg,heading_deg,range_m\n";

std::string row(int i, const std::string& range = "1.2") {
    return fmt::format("{:.1f},{:.9f},{:.9f},4,{:.2f},0.1,0.2,90.0,{}\n", 0.2 * i,
                       23.182753 + 1e-7 * (i % 40), 113.399795 + 1e-7 * i, 101000.0, range);
}

std::string rows(int n, const std::string& range = "1.2") {
    std::string text;
    for (int i = 0; i < n; ++i) text += row(i, range);
    return text;
}

std::string log(int n = 300) {
    return "# format: array-log 1\n" + kHeader + rows(n);
}

const std::string kControl =
    "point,e_m,n_m,u_m,sigma_h_m,sigma_v_m,role\nP01,5,5,0.5,0.005,0.005,control\nC01,2,2,0,0.005,0.005,"
    "check\n";

std::string project(const std::string& runs, const std::string& more = R"("control": "control.csv", )") {
    return "{\n\"format\": \"terrawalk-survey 1\",\n\"name\": \"bad\",\n"
           "\"zero_point\": {\"lat_deg\": 23.182753, \"lon_deg\": 113.399795, \"h_ell_m\": 38.0},\n" +
           more + "\n\"runs\": [\n" + runs + "\n]\n}\n";
}

const std::string kAreaRun = R"({"id": "S01", "kind": "area", "log": "logs/S01.csv", "start": "ZERO"})";

struct BadCase {
    std::string name;
    std::string blamed;  ///< "file:line" or "file" that the message must hold
    std::function<void(const fs::path&)> damage;
};

void PrintTo(const BadCase& c, std::ostream* out) {
    *out << c.name;
}

class BadInput : public testing::TestWithParam<BadCase> {};

// The undamaged survey works: otherwise none of the cases below would show anything.
TEST(GoodInput, TheSurveyThatTheBadCasesDamageIsGood) {
    const TemporaryFolder scratch;
    writeBytes(scratch / "s/survey.json", project(kAreaRun));
    writeBytes(scratch / "s/control.csv", kControl);
    writeBytes(scratch / "s/logs/S01.csv", log());
    const auto outcome = terrawalk({"process", (scratch / "s").string(), "-o", (scratch / "out").string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_P(BadInput, GivesOneLineExitCodeThreeAndLeavesNothingBehind) {
    const TemporaryFolder scratch;
    writeBytes(scratch / "s/survey.json", project(kAreaRun));
    writeBytes(scratch / "s/control.csv", kControl);
    writeBytes(scratch / "s/logs/S01.csv", log());
    GetParam().damage(scratch / "s");
    const auto outcome =
        terrawalk({"process", (scratch / "s/survey.json").string(), "-o", (scratch / "out").string()});
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(GetParam().blamed));
    EXPECT_LT(outcome.err.size(), 500u);
    for (const auto& entry : fs::directory_iterator(scratch.path())) {
        EXPECT_EQ(entry.path().filename(), "s") << "left behind";
    }
}

std::function<void(const fs::path&)> put(const std::string& file, const std::string& bytes) {
    return [=](const fs::path& folder) {
        writeBytes(folder / file, bytes);
    };
}

std::function<void(const fs::path&)> drop(const std::string& file) {
    return [=](const fs::path& folder) {
        fs::remove(folder / file);
    };
}

std::vector<BadCase> badCases() {
    const std::string base = "# format: array-log 1\n" + kHeader;
    std::string with_nan = log();
    with_nan.replace(with_nan.find("101000.00"), 9, "nan");
    return {
        {"MissingProject", "survey.json", drop("survey.json")},
        {"EmptyProject", "survey.json", put("survey.json", "")},
        {"TruncatedProject", "survey.json:", put("survey.json", project(kAreaRun).substr(0, 150))},
        {"BinaryProject", "survey.json", put("survey.json", std::string("\x89PNG\r\n\x1a\n\0\0\0", 11))},
        {"ProjectIsAList", "survey.json", put("survey.json", "[1, 2]")},
        {"DeepProject", "survey.json", put("survey.json", std::string(200000, '['))},
        {"WrongFormat", "survey.json",
         put("survey.json", R"({"format": "terrawalk-survey 9", "name": "x", "runs": []})")},
        {"NoRuns", "survey.json", put("survey.json", project(""))},
        {"UnknownCrs", "survey.json", put("survey.json", project(kAreaRun, R"("crs": "EPSG:999999",)"))},
        {"GeographicCrs", "survey.json", put("survey.json", project(kAreaRun, R"("crs": "EPSG:4326",)"))},
        {"UnknownDatum", "survey.json",
         put("survey.json", project(kAreaRun, R"("vertical_datum": "moon",)"))},
        {"ClimbingPath", "survey.json",
         put("survey.json", project(R"({"id": "S01", "kind": "area", "log": "../../etc/passwd"})"))},
        {"AbsolutePath", "survey.json",
         put("survey.json", project(R"({"id": "S01", "kind": "area", "log": "/etc/passwd"})"))},
        {"RunNamedTwice", "survey.json", put("survey.json", project(kAreaRun + ",\n" + kAreaRun))},
        {"RunIdClimbs", "survey.json",
         put("survey.json", project(R"({"id": "../S01", "kind": "area", "log": "logs/S01.csv"})"))},
        {"FixedPointWithoutTarget", "survey.json",
         put("survey.json",
             project(R"({"id": "F01", "kind": "fixed-point", "log": "logs/S01.csv", "start": "ZERO"})"))},
        {"UnknownMark", "survey.json",
         put("survey.json",
             project(R"({"id": "S01", "kind": "area", "log": "logs/S01.csv", "start": "P77"})"))},
        {"ZeroPointFarFromTheLogs", "S01.csv",
         [](const fs::path& folder) {
             std::string text = project(kAreaRun);
             text.replace(text.find("23.182753"), 9, "40.000000");
             writeBytes(folder / "survey.json", text);
         }},
        {"AbsurdPressure", "S01.csv:53",
         put("logs/S01.csv", base + rows(50) + "10.0,23.18,113.4,4,1e308,0,0,0,1\n")},
        {"MissingControl", "control.csv", drop("control.csv")},
        {"EmptyControl", "control.csv", put("control.csv", "")},
        {"MarkNamedTwice", "control.csv:4", put("control.csv", kControl + "")},
        {"ControlNan", "control.csv:2",
         put("control.csv",
             "point,e_m,n_m,u_m,sigma_h_m,sigma_v_m,role\nP01,nan,5,0.5,0.005,0.005,control\n")},
        {"UnknownRole", "control.csv:2",
         put("control.csv", "point,e_m,n_m,u_m,sigma_h_m,sigma_v_m,role\nP01,1,5,0.5,0.005,0.005,boss\n")},
        {"MissingLog", "S01.csv", drop("logs/S01.csv")},
        {"EmptyLog", "S01.csv", put("logs/S01.csv", "")},
        {"HeaderOnly", "S01.csv", put("logs/S01.csv", base)},
        {"NoHeader", "S01.csv:1", put("logs/S01.csv", rows(100))},
        {"BinaryLog", "S01.csv", put("logs/S01.csv", std::string(5000, '\0'))},
        {"NanInLog", "S01.csv:3", put("logs/S01.csv", with_nan)},
        {"TextInLog", "S01.csv:53",
         put("logs/S01.csv", base + rows(50) + "10.0,here,113.4,4,101000,0,0,0,1\n")},
        {"ShortRow", "S01.csv:53", put("logs/S01.csv", base + rows(50) + "10.0,23.1\n" + row(60))},
        {"LatitudeOffTheEarth", "S01.csv:53",
         put("logs/S01.csv", base + rows(50) + "10.0,123.1,113.4,4,101000,0,0,0,1\n")},
        {"ClockJumpsBack", "S01.csv",
         put("logs/S01.csv", base + "1000.0,23.182753,113.399795,4,101000,0,0,0,1\n" + rows(100))},
        {"NoGroundPointAtAll", "", put("logs/S01.csv", base + rows(300, ""))},
        {"NothingTellsAPosition", "",
         [](const fs::path& folder) {
             writeBytes(folder / "survey.json",
                        project(R"({"id": "S01", "kind": "area", "log": "logs/S01.csv"})"));
             std::string text = "time_s,temperature_c\n";
             for (int i = 0; i < 200; ++i) text += fmt::format("{:.1f},20\n", 0.2 * i);
             writeBytes(folder / "logs/S01.csv", text);
         }},
    };
}

std::vector<BadCase> completed(std::vector<BadCase> cases) {
    for (BadCase& c : cases) {
        if (c.name == "MarkNamedTwice") {
            c.damage = put("control.csv", kControl + "P01,5,5,0.5,0.005,0.005,control\n");
        }
    }
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Each, BadInput, testing::ValuesIn(completed(badCases())),
                         [](const auto& tested) { return tested.param.name; });

TEST(OddInput, AZeroPointOnTheDateLineIsRead) {
    const TemporaryFolder scratch;
    std::string text = project(kAreaRun, R"("crs": "EPSG:32660",)");
    text.replace(text.find("113.399795"), 10, "180.0");
    writeBytes(scratch / "s/survey.json", text);
    std::string east = log();
    for (std::size_t at = 0; (at = east.find("113.39", at)) != std::string::npos;)
        east.replace(at, 10, "179.999995");
    writeBytes(scratch / "s/logs/S01.csv", east);
    const auto outcome = terrawalk({"process", (scratch / "s").string(), "-o", (scratch / "out").string()});
    EXPECT_EQ(outcome.signal, 0);
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
}

TEST(OddInput, ControlCodesOfAFileNeverReachTheTerminal) {
    const TemporaryFolder scratch;
    std::string text = project(kAreaRun);
    text.replace(text.find("\"bad\""), 5, "\"bad\\u001b[31m\\u0007\"");
    writeBytes(scratch / "s/survey.json", text);
    writeBytes(scratch / "s/control.csv", kControl);
    writeBytes(scratch / "s/logs/S01.csv", "# device: \x1b[31mred\n" + log());
    const auto processed = terrawalk({"process", (scratch / "s").string(), "-o", (scratch / "out").string()});
    const auto inspected = terrawalk({"inspect", (scratch / "s").string()});
    ASSERT_EQ(processed.exit_code, 0) << processed.err;
    for (const std::string& printed :
         {processed.out, processed.err, inspected.out, inspected.err, bytesOf(scratch / "out/figures.txt")}) {
        EXPECT_EQ(printed.find('\x1b'), std::string::npos);
        EXPECT_EQ(printed.find('\x07'), std::string::npos);
    }
}

TEST(OddInput, ASilenceInTheLogStandsInTheReport) {
    const TemporaryFolder scratch;
    writeBytes(scratch / "s/survey.json", project(kAreaRun));
    writeBytes(scratch / "s/control.csv", kControl);
    std::string text = "# format: array-log 1\n" + kHeader + rows(150);
    for (int i = 600; i < 750; ++i) text += row(i);
    writeBytes(scratch / "s/logs/S01.csv", text);
    const auto outcome = terrawalk({"process", (scratch / "s").string(), "-o", (scratch / "out").string()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto report = nlohmann::json::parse(bytesOf(scratch / "out/report.json"));
    EXPECT_EQ(report.at("runs").at(0).at("gaps"), 1);
    EXPECT_NEAR(report.at("runs").at(0).at("longest_gap_s").get<double>(), 90.2, 1e-6);
    EXPECT_THAT(report.at("limitations").dump(), HasSubstr("no records for 90.2 s"));
}

TEST(OddInput, OddButHarmlessLogsAreReadAndCounted) {
    const TemporaryFolder scratch;
    writeBytes(scratch / "s/survey.json", project(kAreaRun));
    writeBytes(scratch / "s/control.csv", kControl);
    std::string text = "\xef\xbb\xbf# format: array-log 1\r\n" + kHeader;
    for (int i = 0; i < 300; ++i) {
        if (i == 100) text += row(99);  // repeated
        if (i != 200) text += row(i);   // 200 comes late
        if (i == 201) text += row(200);
    }
    text += "60.0,23.18";  // cut off
    writeBytes(scratch / "s/logs/S01.csv", text);
    const auto outcome = terrawalk({"process", (scratch / "s").string(), "-o", (scratch / "out").string()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto run = nlohmann::json::parse(bytesOf(scratch / "out/report.json")).at("runs").at(0);
    EXPECT_EQ(run.at("repeated_lines"), nlohmann::json({103}));
    EXPECT_EQ(run.at("late_lines"), nlohmann::json({205}));
    EXPECT_EQ(run.at("cut_off_line"), 304);
    EXPECT_EQ(run.at("epochs"), 300);
}

}  // namespace
}  // namespace terrawalk::test
