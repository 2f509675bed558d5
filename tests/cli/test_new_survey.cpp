#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/cli_support.hpp"

namespace terrawalk::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

TEST(NewCommand, MakesASurveyThatProcessTakes) {
    const TemporaryFolder scratch;
    fs::copy(quickPlot() / "logs", scratch / "walk");
    fs::copy_file(quickPlot() / "control.csv", scratch / "walk/marks.csv");
    const std::string project = (scratch / "walk/survey.json").string();
    const auto made =
        terrawalk({"new", (scratch / "walk/F01.csv").string(), (scratch / "walk/S01.csv").string(), "--marks",
                   (scratch / "walk/marks.csv").string(), "-o", project, "--zero", "23.182753,113.399795,38",
                   "--json"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const json told = json::parse(made.out);
    EXPECT_EQ(told.at("runs").size(), 2u);
    EXPECT_EQ(told.at("runs")[0].at("target"), "P01");
    EXPECT_EQ(told.at("runs")[1].at("kind"), "area");
    const auto processed = terrawalk({"process", project, "-o", (scratch / "out").string(), "--quiet"});
    EXPECT_EQ(processed.exit_code, 0) << processed.err;
    EXPECT_TRUE(fs::exists(scratch / "out/dem.tif"));

    const auto again = terrawalk({"new", (scratch / "walk").string()});
    EXPECT_EQ(again.exit_code, 2) << "never over a survey that is there";
    EXPECT_THAT(again.err, HasSubstr("survey.json"));
    EXPECT_EQ(terrawalk({"new", (scratch / "walk").string(), "--replace", "-q"}).exit_code, 0);
}

TEST(NewCommand, AKilledOneLeavesTheOldSurveyOrTheNewOne) {
    const TemporaryFolder scratch;
    const fs::path walk = scratch / "walk";
    fs::copy(quickPlot() / "logs", walk);
    const auto make = [&](const char* name, const std::function<void(pid_t)>& meanwhile) {
        return terrawalk({"new", walk.string(), "--replace", "-q", "--name", name}, meanwhile);
    };
    ASSERT_EQ(make("one", {}).exit_code, 0);
    const std::string one = readTree(walk).at("survey.json");
    const auto timed = make("another", {});
    ASSERT_EQ(timed.exit_code, 0);
    const std::string another = readTree(walk).at("survey.json");
    ASSERT_NE(one, another);
    KillNearTheEnd killer(timed.seconds);
    for (int round = 0; round < 60 && killer.hits() < 8; ++round) {
        killer.learn(make(round % 2 == 0 ? "one" : "another", killer));
        const std::string found = readTree(walk).at("survey.json");
        EXPECT_TRUE(found == one || found == another) << "round " << round;
    }
    EXPECT_EQ(killer.hits(), 8u);
}

TEST(NewCommand, SaysWhatIsWrong) {
    const TemporaryFolder scratch;
    writeBytes(scratch / "S01.csv", "time_s,lat_deg\n0,95\n");
    writeBytes(scratch / "S02.csv", "time_s,lat_deg\n0,x\n");
    const auto bad = terrawalk({"new", scratch.path().string()});
    EXPECT_EQ(bad.exit_code, 3);
    EXPECT_THAT(bad.err, HasSubstr("S01.csv:2:"));
    EXPECT_THAT(bad.err, HasSubstr("S02.csv:2:")) << "all of them, so that one round is enough";
    EXPECT_FALSE(fs::exists(scratch / "survey.json"));
    EXPECT_EQ(terrawalk({"new"}).exit_code, 2);
    EXPECT_EQ(terrawalk({"new", (scratch / "none.csv").string()}).exit_code, 3);
    EXPECT_EQ(terrawalk({"new", scratch.path().string(), "--target", "F01"}).exit_code, 2);
    EXPECT_EQ(terrawalk({"new", scratch.path().string(), "--zero", "99,0,0"}).exit_code, 2);
}

}  // namespace
}  // namespace terrawalk::test
