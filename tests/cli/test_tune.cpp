#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/cli_support.hpp"

namespace terrawalk::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

std::vector<std::string> tuning(const fs::path& output, std::vector<std::string> more = {}) {
    std::vector<std::string> command{"tune", quickPlot().string(), "-o", output.string(), "--population",
                                     "10",   "--iterations",       "30"};
    command.insert(command.end(), more.begin(), more.end());
    return command;
}

// What a user does in a row: tune, look, process with the file.
TEST(Tune, ItsFileGoesIntoProcessAsItIs) {
    const TemporaryFolder scratch;
    const auto tuned = terrawalk(tuning(scratch / "params.json", {"--seed", "4"}));
    ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
    EXPECT_THAT(tuned.out, HasSubstr("loss after"));
    const json file = json::parse(bytesOf(scratch / "params.json"));
    const json& section = file.at("tuning");
    EXPECT_EQ(section.at("seed"), 4);
    EXPECT_EQ(section.at("optimiser"), "isma");
    EXPECT_LT(section.at("loss_after").get<double>(), section.at("loss_before").get<double>());
    EXPECT_EQ(section.at("evaluations").get<std::size_t>(),
              section.at("evaluations_spent").at("search").get<std::size_t>() +
                  section.at("evaluations_spent").at("left_out").get<std::size_t>() +
                  section.at("evaluations_spent").at("profile").get<std::size_t>());
    EXPECT_EQ(terrawalk({"config", "validate", (scratch / "params.json").string()}).exit_code, 0);

    const auto processed = terrawalk({"process", quickPlot().string(), "--config",
                                      (scratch / "params.json").string(), "-o", (scratch / "out").string()});
    ASSERT_EQ(processed.exit_code, 0) << processed.err;
    const json report = json::parse(bytesOf(scratch / "out/report.json"));
    EXPECT_EQ(report.at("tuning").at("seed"), 4);
    EXPECT_EQ(report.at("tuning").at("in_use"), true);
    EXPECT_EQ(report.at("tuning").at("loss_after"), section.at("loss_after"));
    const std::string html = bytesOf(scratch / "out/report.html");
    EXPECT_THAT(html, HasSubstr("Tuning"));
    // The error of the report at the end of the runs is the loss after tuning: the same filter ran. The
    // report takes medians of the stand, the loss means, so they agree only nearly.
    double sum_m2 = 0.0;
    for (const json& residual : report.at("residuals")) {
        if (residual.at("stage") != "fused" || residual.at("run").get<std::string>().front() != 'F') continue;
        if (residual.at("quantity") != "position on mark") continue;
        EXPECT_EQ(residual.at("used_by_estimator"), true) << residual;
        for (const json& d : residual.at("difference_enu_m")) sum_m2 += d.get<double>() * d.get<double>();
    }
    EXPECT_NEAR(sum_m2, section.at("loss_after").get<double>(), 0.3 * section.at("loss_after").get<double>());
}

TEST(Tune, TheSameCommandGivesTheSameBytesOnAnyNumberOfThreads) {
    const TemporaryFolder scratch;
    ASSERT_EQ(terrawalk(tuning(scratch / "a.json", {"--threads", "1"})).exit_code, 0);
    ASSERT_EQ(terrawalk(tuning(scratch / "b.json", {"--threads", "4"})).exit_code, 0);
    ASSERT_EQ(terrawalk(tuning(scratch / "c.json", {"--seed", "2"})).exit_code, 0);
    EXPECT_EQ(bytesOf(scratch / "a.json"), bytesOf(scratch / "b.json"));
    EXPECT_NE(bytesOf(scratch / "a.json"), bytesOf(scratch / "c.json"));
}

TEST(Tune, TwelveParametersAndOtherOptimisers) {
    const TemporaryFolder scratch;
    for (const char* kind : {"isma-printed", "sma", "pso", "ga", "sa", "nsga2", "abc", "sade", "cmaes"}) {
        const auto tuned =
            terrawalk({"tune", quickPlot().string(), "-o", (scratch / kind).string(), "--optimizer", kind,
                       "--population", "12", "--iterations", "5", "--parameters", "12", "--json"});
        ASSERT_EQ(tuned.exit_code, 0) << kind << ": " << tuned.err;
        EXPECT_EQ(json::parse(tuned.out).at("tuning").at("optimiser"), kind);
        const json file = json::parse(bytesOf(scratch / kind));
        EXPECT_EQ(file.at("tuning").at("parameters").size(), 12U);
        EXPECT_TRUE(file.at("fusion").at("aukf").contains("unscented"));
    }
}

// Ctrl-C while it searches, twice, then to the end.
TEST(Tune, CtrlCLeavesACheckpointFromWhichItEndsWithTheSameBytes) {
    const TemporaryFolder scratch;
    // One candidate at a time is slow enough that the signals find it at work.
    const auto command = [&](const char* output, bool resume) {
        std::vector<std::string> words{"tune",         quickPlot().string(),
                                       "-o",           (scratch / output).string(),
                                       "--optimizer",  "ga",
                                       "--population", "20",
                                       "--iterations", "700"};
        if (resume) words.emplace_back("--resume");
        return words;
    };
    const auto interrupt = [](pid_t program) {
        std::this_thread::sleep_for(std::chrono::milliseconds(700));
        kill(program, SIGINT);
    };
    ASSERT_EQ(terrawalk(command("whole.json", false)).exit_code, 0);
    const auto cut = terrawalk(command("cut.json", false), interrupt);
    ASSERT_EQ(cut.exit_code, 4) << cut.err;
    EXPECT_THAT(cut.err, HasSubstr("--resume"));
    EXPECT_FALSE(fs::exists(scratch / "cut.json"));
    ASSERT_TRUE(fs::exists(scratch / "cut.json.checkpoint"));
    const auto kept = fs::file_size(scratch / "cut.json.checkpoint");
    // Without --resume the work is not thrown away.
    const auto forgot = terrawalk(command("cut.json", false));
    EXPECT_EQ(forgot.exit_code, 2);
    EXPECT_THAT(forgot.err, HasSubstr("--resume"));
    const auto again = terrawalk(command("cut.json", true), interrupt);
    if (again.exit_code == 4) {
        EXPECT_GT(fs::file_size(scratch / "cut.json.checkpoint"), kept);
        ASSERT_EQ(terrawalk(command("cut.json", true)).exit_code, 0);
    } else {
        ASSERT_EQ(again.exit_code, 0) << again.err;
    }
    EXPECT_EQ(bytesOf(scratch / "cut.json"), bytesOf(scratch / "whole.json"));
    EXPECT_FALSE(fs::exists(scratch / "cut.json.checkpoint"));
}

TEST(Tune, WrongRequestsAreRefusedWithTheirCure) {
    const TemporaryFolder scratch;
    const std::string output = (scratch / "p.json").string();
    const auto refused = [&](std::vector<std::string> more) {
        return terrawalk(tuning(scratch / "p.json", std::move(more)));
    };
    EXPECT_EQ(refused({"--optimizer", "magic"}).exit_code, 2);
    EXPECT_EQ(refused({"--parameters", "10"}).exit_code, 2);
    EXPECT_EQ(refused({"--population", "3"}).exit_code, 2);
    const auto method = refused({"--method", "raw"});
    EXPECT_EQ(method.exit_code, 2);
    EXPECT_THAT(method.err, HasSubstr("--method"));
    const auto nothing_kept = refused({"--resume"});
    EXPECT_EQ(nothing_kept.exit_code, 3);
    EXPECT_THAT(nothing_kept.err, HasSubstr("without --resume"));
    EXPECT_TRUE(fs::is_empty(scratch.path()));

    ASSERT_EQ(terrawalk({"simulate", "-o", (scratch / "walk").string(), "--fixed-runs", "0", "--area-epochs",
                         "1500", "--area-east", "15", "--area-north", "15", "--control-stops", "0", "-q"})
                  .exit_code,
              0);
    const auto no_runs = terrawalk({"tune", (scratch / "walk").string(), "-o", output});
    EXPECT_EQ(no_runs.exit_code, 3);
    EXPECT_THAT(no_runs.err, HasSubstr("fixed"));
    EXPECT_FALSE(fs::exists(scratch / "p.json"));
    EXPECT_EQ(terrawalk({"process", quickPlot().string(), "--population", "10", "-o", output}).exit_code, 2);
}

// The report says what ran, and the products are those of the set that it names.
TEST(ProcessTune, UsesTheTunedSetOnlyWhereItHoldsOutBetter) {
    const TemporaryFolder scratch;
    const auto process = [&](const char* output, std::vector<std::string> more) {
        std::vector<std::string> command{
            "process", quickPlot().string(), "-o", (scratch / output).string(), "--method", "aukf"};
        command.insert(command.end(), more.begin(), more.end());
        const auto outcome = terrawalk(command);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    };
    process("plain", {});
    // A filter that believes every single position can be improved on all runs; the seed's few evaluations
    // may or may not do so for the default.
    const std::vector<std::string> loose{"--set", "fusion.aukf.noise.position_e_m2=10", "--set",
                                         "fusion.aukf.noise.position_n_m2=10"};
    for (const std::vector<std::string>& start : {std::vector<std::string>{}, loose}) {
        std::vector<std::string> options{"--tune", "--population", "10", "--iterations", "30", "--seed", "4"};
        options.insert(options.end(), start.begin(), start.end());
        process("tuned", options);
        process("without", start);
        const json report = json::parse(bytesOf(scratch / "tuned/report.json"));
        const json& section = report.at("tuning");
        EXPECT_EQ(section.at("seed"), 4);
        EXPECT_EQ(section.at("in_use"), section.at("holds_out_better"));
        const bool same_track =
            bytesOf(scratch / "tuned/trajectory/S01.csv") == bytesOf(scratch / "without/trajectory/S01.csv");
        EXPECT_EQ(same_track, !section.at("in_use").get<bool>()) << section.at("decision");
        const json manifest = json::parse(bytesOf(scratch / "tuned/manifest.json"));
        EXPECT_THAT(manifest.at("command").dump(), HasSubstr("--tune"));
        fs::remove_all(scratch / "tuned");
        fs::remove_all(scratch / "without");
    }
}

}  // namespace
}  // namespace terrawalk::test
