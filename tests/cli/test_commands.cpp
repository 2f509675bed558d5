#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/cli/cli_support.hpp"

namespace terrawalk::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// The figures that a shipped survey must give stand in its expected.json: a path into report.json, a value,
/// and how far another machine's arithmetic may be off.
void expectFigures(const fs::path& sample, const json& report) {
    const json expected = json::parse(bytesOf(sample / "expected.json"));
    ASSERT_GE(expected.at("figures").size(), 5u);
    for (const json& figure : expected.at("figures")) {
        const auto pointer = json::json_pointer(figure.at("path").get<std::string>());
        ASSERT_TRUE(report.contains(pointer)) << pointer;
        EXPECT_NEAR(report.at(pointer).get<double>(), figure.at("value").get<double>(),
                    figure.at("tolerance").get<double>())
            << pointer;
    }
}

class SampleSurvey : public testing::TestWithParam<std::string> {};

TEST_P(SampleSurvey, GivesItsExpectedFigures) {
    const TemporaryFolder scratch;
    const fs::path sample = fs::path(TERRAWALK_SOURCE_DIR) / "sample_surveys" / GetParam();
    const auto outcome = terrawalk({"process", sample.string(), "-o", (scratch / "out").string()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("report.html"));
    expectFigures(sample, json::parse(bytesOf(scratch / "out/report.json")));
    const json manifest = json::parse(bytesOf(scratch / "out/manifest.json"));
    for (const json& product : manifest.at("products")) {
        EXPECT_TRUE(fs::is_regular_file(scratch / "out" / product.get<std::string>())) << product;
    }
}

TEST_P(SampleSurvey, IsWhatTheSimulatorMakesFromItsManifest) {
    const TemporaryFolder scratch;
    const fs::path sample = fs::path(TERRAWALK_SOURCE_DIR) / "sample_surveys" / GetParam();
    const json m = json::parse(bytesOf(sample / "manifest.json"));
    std::vector<std::string> command{"simulate", "-o", (scratch / "survey").string(), "-q"};
    const auto add = [&](const char* option, const char* key) {
        command.emplace_back(option);
        command.push_back(m.at(key).is_string() ? m.at(key).get<std::string>() : m.at(key).dump());
    };
    add("--seed", "seed");
    add("--terrain", "terrain");
    add("--faults", "faults");
    add("--gnss", "gnss");
    add("--noise-scale", "noise_scale");
    add("--area-east", "area_east_m");
    add("--area-north", "area_north_m");
    add("--line-spacing", "line_spacing_m");
    add("--interval", "sample_interval_s");
    add("--fixed-runs", "fixed_point_runs");
    add("--fixed-epochs", "fixed_point_epochs");
    add("--area-epochs", "area_epochs");
    add("--control-stops", "control_stops");
    add("--check-stops", "check_stops");
    add("--check-points", "check_points");
    for (const auto& [option, key] : {std::pair{"--range-lever-arm", "range_lever_arm_m"},
                                      std::pair{"--gnss-lever-arm", "gnss_lever_arm_m"}}) {
        command.emplace_back(option);
        for (const json& component : m.at(key)) command.push_back(component.dump());
    }
    if (!m.at("end_on_zero").get<bool>()) command.emplace_back("--end-anywhere");
    if (m.at("doppler_velocity").get<bool>()) command.emplace_back("--doppler");
    const auto outcome = terrawalk(command);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(bytesOf(scratch / "survey/survey.json"), bytesOf(sample / "survey.json"));
    EXPECT_EQ(bytesOf(scratch / "survey/control.csv"), bytesOf(sample / "control.csv"));
    EXPECT_EQ(readTree(scratch / "survey/logs"), readTree(sample / "logs"));
}

INSTANTIATE_TEST_SUITE_P(Shipped, SampleSurvey, testing::Values("quick_plot", "mango_orchard"));

TEST(Process, GivesTheSameBytesWithOneAndTwoThreadsTwice) {
    const TemporaryFolder scratch;
    for (const std::string run : {"1a", "2a", "1b", "2b"}) {
        const auto outcome = terrawalk({"process", quickPlot().string(), "-o", (scratch / run).string(),
                                        "--threads", run.substr(0, 1), "--quiet"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.out + outcome.err, "");
    }
    const auto first = readTree(scratch / "1a");
    EXPECT_GE(first.size(), 10u);
    for (const std::string run : {"2a", "1b", "2b"}) {
        const auto other = readTree(scratch / run);
        ASSERT_EQ(other.size(), first.size());
        for (const auto& [file, bytes] : first) EXPECT_TRUE(other.at(file) == bytes) << run << "/" << file;
    }
}

TEST(Process, RequestedAndUsedValuesStandInTheReport) {
    const TemporaryFolder scratch;
    const auto outcome = terrawalk({"process", quickPlot().string(), "-o", (scratch / "out").string(),
                                    "--set", "surface.cell_m=0.2", "--method", "raw"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json report = json::parse(bytesOf(scratch / "out/report.json"));
    EXPECT_EQ(report.at("surface").at("cell_m"), 0.2);
    std::map<std::string, std::pair<std::string, std::string>> settings;
    for (const json& s : report.at("settings")) settings[s.at("key")] = {s.at("requested"), s.at("used")};
    EXPECT_EQ(settings.at("surface.cell_m"), (std::pair<std::string, std::string>{"0.2", "0.2"}));
    EXPECT_EQ(settings.at("fusion.method").second, "raw");
    EXPECT_EQ(settings.at("surface.longest_edge_m").first, "default");
    EXPECT_GT(std::stod(settings.at("surface.longest_edge_m").second), 0.0);
}

TEST(Process, GivesAChineseReportWhenAsked) {
    const TemporaryFolder scratch;
    const auto outcome = terrawalk(
        {"process", quickPlot().string(), "-o", (scratch / "out").string(), "--set", "report.language=zh"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(bytesOf(scratch / "out/report.html"), HasSubstr("<html lang=\"zh-CN\">"));
    EXPECT_EQ(
        json::parse(bytesOf(scratch / "out/manifest.json")).at("configuration").at("report").at("language"),
        "zh");
}

TEST(Process, WithoutAFontForChineseThePaperIsInEnglishAndSaysSo) {
    const TemporaryFolder scratch;
    writeBytes(scratch / "fonts.conf",
               "<?xml version=\"1.0\"?><!DOCTYPE fontconfig SYSTEM \"fonts.dtd\">"
               "<fontconfig><dir>/usr/share/fonts/truetype/dejavu</dir></fontconfig>");
    const auto outcome = runProgram({"/usr/bin/env", "FONTCONFIG_FILE=" + (scratch / "fonts.conf").string(),
                                     TERRAWALK_PROGRAM, "process", quickPlot().string(), "-o",
                                     (scratch / "out").string(), "--set", "report.language=zh"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(bytesOf(scratch / "out/report.html"), HasSubstr("<html lang=\"zh-CN\">"));
    const auto paper = runProgram({"/usr/bin/pdftotext", (scratch / "out/report.pdf").string(), "-"});
    EXPECT_THAT(paper.out, AllOf(HasSubstr("This machine has no font for Chinese"), HasSubstr("Accuracy")));
}

TEST(Process, DemOpensInGdalWithPlaceSizeAndStatistics) {
    const TemporaryFolder scratch;
    ASSERT_EQ(terrawalk({"process", quickPlot().string(), "-o", (scratch / "out").string()}).exit_code, 0);
    GDALAllRegister();
    const auto dem = GDALDatasetUniquePtr(GDALDataset::Open((scratch / "out/dem.tif").c_str()));
    ASSERT_TRUE(dem);
    const json report = json::parse(bytesOf(scratch / "out/report.json"));
    const json& surface = report.at("surface");
    EXPECT_EQ(dem->GetRasterXSize(), surface.at("columns"));
    EXPECT_EQ(dem->GetRasterYSize(), surface.at("rows"));
    EXPECT_STREQ(dem->GetSpatialRef()->GetAuthorityCode(nullptr), "32649");
    EXPECT_EQ(dem->GetRasterBand(1)->GetNoDataValue(), -9999.0);
    double lowest = 0, highest = 0, mean = 0, sd = 0;
    ASSERT_EQ(dem->GetRasterBand(1)->GetStatistics(FALSE, FALSE, &lowest, &highest, &mean, &sd), CE_None);
    EXPECT_NEAR(lowest, surface.at("lowest_m"), 1e-6);
    EXPECT_NEAR(highest, surface.at("highest_m"), 1e-6);
    EXPECT_FALSE(fs::exists(scratch / "out/dem.tif.aux.xml"));
    // What the check marks say goes with the file.
    for (const json& group : report.at("accuracy")) {
        if (group.at("stage") != "surface" || group.at("role") != "check") continue;
        const json& height = group.at("up");
        EXPECT_EQ(dem->GetMetadataItem("CHECK_POINTS"), std::to_string(height.at("n").get<int>()));
        EXPECT_NEAR(std::stod(dem->GetMetadataItem("RMSE_V")), height.at("rmse_m").get<double>(), 5.1e-5);
        return;
    }
    FAIL() << "no check marks";
}

TEST(Process, JsonOutcomeNamesTheProducts) {
    const TemporaryFolder scratch;
    const auto outcome =
        terrawalk({"process", quickPlot().string(), "-o", (scratch / "out").string(), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json summary = json::parse(outcome.out);
    EXPECT_TRUE(fs::exists(summary.at("dem").get<std::string>()));
    EXPECT_TRUE(fs::exists(summary.at("report").get<std::string>()));
    EXPECT_EQ(summary.at("figures").size(), 3u);
}

TEST(Process, ManifestHashesAreThoseOfTheInputs) {
    const TemporaryFolder scratch;
    ASSERT_EQ(terrawalk({"process", quickPlot().string(), "-o", (scratch / "out").string()}).exit_code, 0);
    const json manifest = json::parse(bytesOf(scratch / "out/manifest.json"));
    const auto check = runProgram({"/usr/bin/sha256sum", (quickPlot() / "survey.json").string()});
    EXPECT_EQ(manifest.at("inputs").at(0).at("sha256"), check.out.substr(0, 64));
    EXPECT_GE(manifest.at("inputs").size(), 3u);
}

TEST(Process, AConfigurationPrintedByTheProgramGivesTheSameProducts) {
    const TemporaryFolder scratch;
    const auto printed = terrawalk({"config", "print", "--set", "surface.cell_m=0.25"});
    ASSERT_EQ(printed.exit_code, 0) << printed.err;
    writeBytes(scratch / "config.json", printed.out);
    EXPECT_EQ(terrawalk({"config", "validate", (scratch / "config.json").string()}).exit_code, 0);
    const auto validated = terrawalk({"config", "validate", (scratch / "config.json").string(), "--json"});
    EXPECT_EQ(json::parse(validated.out).at("valid"), true);
    ASSERT_EQ(terrawalk({"process", quickPlot().string(), "-o", (scratch / "a").string(), "--config",
                         (scratch / "config.json").string()})
                  .exit_code,
              0);
    ASSERT_EQ(terrawalk({"process", quickPlot().string(), "-o", (scratch / "b").string(), "--set",
                         "surface.cell_m=0.25"})
                  .exit_code,
              0);
    for (const char* file : {"dem.tif", "surface.ply", "residuals.csv"}) {
        EXPECT_TRUE(bytesOf(scratch / "a" / file) == bytesOf(scratch / "b" / file)) << file;
    }
}

TEST(Process, KeepsTheFilesOfOthersInAnEarlierOutput) {
    const TemporaryFolder scratch;
    const std::string out = (scratch / "out").string();
    ASSERT_EQ(terrawalk({"process", quickPlot().string(), "-o", out}).exit_code, 0);
    writeBytes(scratch / "out/map.qgz", "mine");
    ASSERT_EQ(terrawalk({"process", quickPlot().string(), "-o", out, "--set", "surface.cell_m=1"}).exit_code,
              0);
    EXPECT_EQ(bytesOf(scratch / "out/map.qgz"), "mine");
    EXPECT_EQ(json::parse(bytesOf(scratch / "out/report.json")).at("surface").at("cell_m"), 1.0);
}

// The paper's method from the log to the DEM: named in the report, untied to the stops, other than ours, and
// each of its filters other than the next.
TEST(Process, RunsThePapersMethodWithEachOfItsFilters) {
    const TemporaryFolder scratch;
    std::set<std::string> tracks;
    for (const std::string filter : {"ukf", "adaptive-ukf"}) {
        const auto outcome = terrawalk({"process", quickPlot().string(), "-o", (scratch / filter).string(),
                                        "--method", "aukf", "--set", "fusion.aukf.filter=" + filter});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const json report = json::parse(bytesOf(scratch / filter / "report.json"));
        EXPECT_THAT(report.at("method").get<std::string>(), HasSubstr("as published"));
        for (const json& residual : report.at("residuals")) {
            EXPECT_FALSE(residual.at("used_by_estimator").get<bool>()) << residual.dump();
        }
        tracks.insert(bytesOf(scratch / filter / "trajectory/S01.csv"));
    }
    EXPECT_EQ(tracks.size(), 2u);
}

TEST(Compare, PrintsAndWritesOneRowForEachMethod) {
    const TemporaryFolder scratch;
    const auto printed = terrawalk({"compare", quickPlot().string()});
    ASSERT_EQ(printed.exit_code, 0) << printed.err;
    EXPECT_THAT(printed.out, HasSubstr("aukf square-root-ukf"));
    const auto outcome = terrawalk({"compare", quickPlot().string(), "-o", (scratch / "out").string(),
                                    "--json", "--set", "fusion.aukf.noise.velocity_e_m2ps2=0.5"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json comparison = json::parse(outcome.out);
    EXPECT_TRUE(comparison.at("truth").get<bool>());
    EXPECT_EQ(comparison.at("methods").at(0).at("method"), "raw");
    EXPECT_GT(comparison.at("methods").at(0).at("area H [m]").get<double>(), 0.0);
    EXPECT_TRUE(fs::is_regular_file(scratch / "out/comparison.csv"));
    const json manifest = json::parse(bytesOf(scratch / "out/manifest.json"));
    EXPECT_EQ(manifest.at("configuration").at("fusion").at("aukf").at("noise").at("velocity_e_m2ps2"), 0.5);
    EXPECT_THAT(manifest.at("command").dump(), HasSubstr("velocity_e_m2ps2=0.5"));
    // A survey is no place for it.
    EXPECT_EQ(terrawalk({"compare", quickPlot().string(), "-o", quickPlot().string()}).exit_code, 2);
}

TEST(Inspect, TellsSensorsRatesAndFixes) {
    const auto text = terrawalk({"inspect", quickPlot().string()});
    ASSERT_EQ(text.exit_code, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("barometer"));
    const auto outcome = terrawalk({"inspect", (quickPlot() / "logs/S01.csv").string(), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json log = json::parse(outcome.out).at("logs").at(0);
    EXPECT_NEAR(log.at("interval_s").get<double>(), 0.2, 1e-9);
    EXPECT_GT(log.at("fixes").size(), 0u);
    EXPECT_EQ(log.at("sensors").at(0).at("sensor"), "GNSS position");
}

TEST(Simulate, GivesASurveyThatCanBeProcessed) {
    const TemporaryFolder scratch;
    const auto simulated = terrawalk({"simulate",
                                      "-o",
                                      (scratch / "s").string(),
                                      "--seed",
                                      "5",
                                      "--terrain",
                                      "gully",
                                      "--fixed-runs",
                                      "2",
                                      "--area-epochs",
                                      "900",
                                      "--area-east",
                                      "12",
                                      "--area-north",
                                      "12",
                                      "--check-points",
                                      "10",
                                      "--control-stops",
                                      "0",
                                      "--disturb",
                                      "no-barometer,flow-spikes"});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
    EXPECT_TRUE(fs::exists(scratch / "s/truth/terrain.tif"));
    EXPECT_EQ(json::parse(bytesOf(scratch / "s/manifest.json")).at("disturbances"),
              (json{"no-barometer", "flow-spikes"}));
    const auto processed = terrawalk({"process", (scratch / "s").string(), "-o", (scratch / "out").string()});
    EXPECT_EQ(processed.exit_code, 0) << processed.err;
}

TEST(Simulate, ExactSensorsGiveTheRampWithinWhatTheLogsCanHold) {
    const TemporaryFolder scratch;
    const auto simulated =
        terrawalk({"simulate", "-o", (scratch / "s").string(), "--terrain=ramp", "--faults=none",
                   "--noise-scale=0", "--gnss=rtk", "--fixed-runs=0", "--area-epochs=1500", "--area-east=15",
                   "--area-north=15", "--check-points=20", "--control-stops=0"});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
    const auto outcome =
        terrawalk({"process", (scratch / "s").string(), "-o", (scratch / "out").string(), "--method", "raw"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    bool compared = false;
    const json report = json::parse(bytesOf(scratch / "out/report.json"));
    for (const json& group : report.at("accuracy")) {
        if (group.at("quantity") != "surface height" || group.at("role") != "check") continue;
        compared = true;
        EXPECT_GE(group.at("up").at("n"), 15);
        // Heights start from the mark, and the tilted range finder sees the slope beside it: up to 15 cm away
        // at 1:9.
        EXPECT_LT(group.at("up").at("rmse_m"), 0.02);
    }
    EXPECT_TRUE(compared);
}

TEST(Usage, WrongRequestsExitWithTwo) {
    const TemporaryFolder scratch;
    const std::string out = (scratch / "out").string();
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {},
             {"fly"},
             {"process"},
             {"process", quickPlot().string(), "-o", out, "--unknown"},
             {"process", quickPlot().string(), "-o", out, "--set", "surface.cell=1"},
             {"process", quickPlot().string(), "-o", out, "--set", "surface.cell_m"},
             {"process", quickPlot().string(), "-o", out, "--set", "surface.cell_m=wide"},
             {"process", quickPlot().string(), "-o", out, "--set", "surface.cell_m=-1"},
             {"process", quickPlot().string(), "-o", out, "--method", "magic"},
             {"process", quickPlot().string(), "-o", out, "--threads", "-3"},
             {"simulate", "-o", out, "--terrain", "moon"},
             {"simulate", "-o", out, "--disturb", "flow-spikes,moon"},
             {"config"},
         }) {
        const auto outcome = terrawalk(command);
        EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(command);
        EXPECT_NE(outcome.err, "") << testing::PrintToString(command);
        EXPECT_FALSE(fs::exists(out)) << testing::PrintToString(command);
    }
}

TEST(Usage, AnUnknownParameterIsAnsweredWithTheNearest) {
    const auto outcome = terrawalk({"config", "print", "--set", "surface.cel_m=1"});
    EXPECT_THAT(outcome.err, HasSubstr("did you mean surface.cell_m"));
}

TEST(Usage, AFolderOfSomebodyElseIsLeftAlone) {
    const TemporaryFolder scratch;
    writeBytes(scratch / "thesis/chapter1.txt", "years of work");
    const auto outcome = terrawalk({"process", quickPlot().string(), "-o", (scratch / "thesis").string()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(readTree(scratch.path()).size(), 1u);
    EXPECT_EQ(bytesOf(scratch / "thesis/chapter1.txt"), "years of work");
}

TEST(Usage, ProductsNeverReplaceTheSurveyTheyComeFrom) {
    const TemporaryFolder scratch;
    fs::copy(quickPlot(), scratch / "survey", fs::copy_options::recursive);
    const auto before = readTree(scratch.path());
    for (const char* output : {"survey", "survey/", "survey/../survey"}) {
        const auto outcome =
            terrawalk({"process", (scratch / "survey").string(), "-o", (scratch / output).string()});
        EXPECT_EQ(outcome.exit_code, 2) << output;
        EXPECT_TRUE(readTree(scratch.path()) == before) << output;
    }
    // Another simulated survey is no earlier output either.
    const auto outcome = terrawalk({"process", quickPlot().string(), "-o", (scratch / "survey").string()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(readTree(scratch.path()) == before);
    // Within the survey's folder there is room for an output.
    EXPECT_EQ(terrawalk({"process", (scratch / "survey").string(), "-o", (scratch / "survey/out").string()})
                  .exit_code,
              0);
    EXPECT_EQ(readTree(scratch / "survey/logs"), readTree(quickPlot() / "logs"));
}

TEST(Process, RunsThatAreLeftOutStandForNoCell) {
    const TemporaryFolder scratch;
    const auto outcome = terrawalk({"process", quickPlot().string(), "-o", (scratch / "out").string(),
                                    "--set", "surface.fixed_point_runs=false"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json report = json::parse(bytesOf(scratch / "out/report.json"));
    for (const json& run : report.at("runs")) {
        EXPECT_EQ(run.at("ground_points_used").get<int>() > 0, run.at("kind") == "area") << run.at("id");
    }
}

// Whatever a command accepts stands in its help.
TEST(Usage, HelpNamesEveryMethodAndEveryExperiment) {
    const std::string process = terrawalk({"process", "--help"}).out;
    const std::string list = process.substr(process.find("fusion.method=NAME"));
    const auto parameters = json::parse(terrawalk({"config", "describe", "--json"}).out).at("parameters");
    const auto method = std::find_if(parameters.begin(), parameters.end(),
                                     [](const json& p) { return p.at("key") == "fusion.method"; });
    ASSERT_NE(method, parameters.end());
    std::stringstream names(method->at("permitted").get<std::string>());
    std::size_t methods = 0;
    for (std::string name; std::getline(names >> std::ws, name, ','); ++methods) {
        EXPECT_THAT(list.substr(0, list.find("--seed")), HasSubstr(name));
    }
    EXPECT_GE(methods, 4u);
    const std::string experiment = terrawalk({"experiment", "--help"}).out;
    std::stringstream lines(terrawalk({"experiment", "--list"}).out);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_THAT(experiment, HasSubstr(line.substr(0, line.find(' '))));
    }
}

TEST(Usage, HelpAndVersionExitWithZero) {
    EXPECT_EQ(terrawalk({"--help"}).exit_code, 0);
    EXPECT_EQ(terrawalk({"process", "--help"}).exit_code, 0);
    EXPECT_THAT(terrawalk({"--version"}).out, HasSubstr("Terrawalk 0."));
}

}  // namespace
}  // namespace terrawalk::test
