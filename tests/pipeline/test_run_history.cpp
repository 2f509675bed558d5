#include <gtest/gtest.h>

#include <fstream>

#include "app/pipeline/run_history.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

PastRun runWith(const std::string& assignment, double rmse_m) {
    PastRun run{"2026-05-01T08:00:00.123Z", "Terrawalk 1", {}, {{"height_rmse_m", rmse_m}}};
    EXPECT_TRUE(applySetting(run.config, assignment));
    return run;
}

TEST(RunHistory, ComesBackAsItWasWritten) {
    const test::TemporaryFolder folder;
    const auto file = folder / "survey.runs.json";
    PastRun first = runWith("surface.cell_m=0.25", 0.125);
    ASSERT_TRUE(applySetting(first.config, R"(edits.runs=["S01"])"));
    first.config.tuning = TuningRecord{.survey = "plot", .method = "ukf", .decision = "better"};
    ASSERT_TRUE(writeRunHistory({first, runWith("fusion.method=ukf", 0.25)}, file));
    const auto read = readRunHistory(file);
    ASSERT_TRUE(read) << read.error().text();
    ASSERT_EQ(read->runs.size(), 2u);
    EXPECT_EQ(toJson(read->runs.front().config), toJson(first.config));
    EXPECT_EQ(read->runs.front().finished, first.finished);
    EXPECT_EQ(read->runs.front().program, first.program);
    EXPECT_EQ(read->runs.back().figures, (RunFigures{{"height_rmse_m", 0.25}}));
}

TEST(RunHistory, KeepsTheLastRunsOnly) {
    const test::TemporaryFolder folder;
    const auto file = folder / "survey.runs.json";
    std::vector<PastRun> runs;
    for (std::size_t i = 0; i < kPastRuns + 3; ++i)
        runs.push_back(runWith("surface.cell_m=1", static_cast<double>(i)));
    ASSERT_TRUE(writeRunHistory(runs, file));
    const auto read = readRunHistory(file);
    ASSERT_TRUE(read);
    ASSERT_EQ(read->runs.size(), kPastRuns);
    EXPECT_EQ(read->runs.front().figures.at("height_rmse_m"), 3.0);
}

TEST(RunHistory, NoFileIsNoRunAndAnotherFileIsAnError) {
    const test::TemporaryFolder folder;
    const auto none = readRunHistory(folder / "none.json");
    ASSERT_TRUE(none);
    EXPECT_TRUE(none->runs.empty());
    for (const char* bytes :
         {"", "[1]", "{}", R"({"format":"terrawalk-runs 1"})", R"({"format":7,"runs":[]})"}) {
        const auto file = folder / "bad.json";
        std::ofstream(file) << bytes;
        EXPECT_FALSE(readRunHistory(file)) << bytes;
    }
    EXPECT_FALSE(writeRunHistory({}, folder / "no" / "such" / "place.json"));
}

TEST(RunHistory, CountsRunsThatThisVersionCannotRead) {
    const test::TemporaryFolder folder;
    const auto file = folder / "survey.runs.json";
    std::ofstream(file) << R"({"format":"terrawalk-runs 1","runs":[1,{"finished":"x"},
        {"finished":"t","program":"p","figures":{},"settings":{"surface.gone":"1"}},
        {"finished":"t","program":"p","figures":{"later":1},"settings":{"surface.cell_m":"2"}}]})";
    const auto read = readRunHistory(file);
    ASSERT_TRUE(read) << read.error().text();
    ASSERT_EQ(read->runs.size(), 1u);
    EXPECT_EQ(read->left_out, 3u);
    EXPECT_EQ(read->runs.front().config.surface.cell_m, 2.0);
}

TEST(RunHistory, TellsBetterFromWorseAtTheDecimalsThatAreShown) {
    const RunFigures before{
        {"height_rmse_m", 0.1}, {"height_mean_m", -0.05}, {"area_m2", 200}, {"cell_m", 0.5}};
    const RunFigures now{
        {"height_rmse_m", 0.1004}, {"height_mean_m", 0.02}, {"area_m2", 190}, {"cell_m", 0.5}};
    const auto changes = figureChanges(before, now);
    ASSERT_EQ(changes.size(), 3u);  // the cell stayed
    EXPECT_EQ(changes[0].verdict, 0);
    EXPECT_EQ(changes[1].verdict, 1);  // nearer zero
    EXPECT_EQ(changes[2].kind.key, "area_m2");
    EXPECT_EQ(changes[2].verdict, 0);
    EXPECT_EQ(changes[0].change, 0.0);
    EXPECT_NEAR(figureChanges({{"height_rmse_m", 0.1276}}, {{"height_rmse_m", 0.3074}}).front().change, 0.179,
                1e-12);
    EXPECT_EQ(figureChanges(now, {{"height_rmse_m", 0.2}}).front().verdict, -1);
}

}  // namespace
}  // namespace terrawalk
