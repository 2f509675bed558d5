#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/pipeline/config.hpp"
#include "app/pipeline/tune_file.hpp"
#include "app/pipeline/tune_trace.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TuneOutcome searched() {
    TuneOutcome outcome;
    outcome.method = "aukf";
    outcome.options.optimiser = OptimiserKind::Pso;
    outcome.options.seed = 7;
    outcome.loss_meaning = "squared distances";
    outcome.loss_unit = "m2";
    outcome.components = {"horizontal"};
    outcome.before = {9.0};
    outcome.after = {2.5};
    outcome.convergence = {{10, 8.0}, {50, 3.0}, {200, 2.5}};
    return outcome;
}

TEST(TuneTrace, IsReadBackFromTheTunedFile) {
    const test::TemporaryFolder scratch;
    test::writeBytes(scratch / "params.json", tuneFileText(searched(), "field"));
    const auto trace = readTuneTrace(scratch / "params.json");
    ASSERT_TRUE(trace.has_value()) << trace.error().text();
    EXPECT_EQ(trace->optimiser, "pso");
    EXPECT_EQ(trace->seed, 7u);
    EXPECT_EQ(trace->loss, "squared distances, m2");
    ASSERT_EQ(trace->convergence.size(), 3u);
    EXPECT_EQ(trace->convergence[1].evaluations, 50u);
    EXPECT_EQ(trace->convergence[1].best_loss, 3.0);
}

// Settings with a trace are still the same settings.
TEST(TuneTrace, TravelsWithSavedSettingsAndChangesNothingOfThem) {
    const test::TemporaryFolder scratch;
    PipelineConfig config;
    config.tuning = tuningRecord(searched(), "field");
    const std::string plain = toJson(config);
    const std::string traced = withTrace(plain, traceOf(searched()));
    EXPECT_THAT(traced, HasSubstr("convergence"));
    test::writeBytes(scratch / "s.json", traced);
    const auto trace = readTuneTrace(scratch / "s.json");
    ASSERT_TRUE(trace.has_value());
    EXPECT_EQ(trace->convergence.size(), 3u);
    PipelineConfig read;
    ASSERT_TRUE(applyConfigFile(read, scratch / "s.json").has_value());
    EXPECT_EQ(toJson(read), plain);
    EXPECT_EQ(withTrace(toJson(PipelineConfig{}), traceOf(searched())), toJson(PipelineConfig{}));
}

TEST(TuneTrace, FilesWithoutOneAreRefusedByName) {
    const test::TemporaryFolder scratch;
    for (const char* bytes : {"", "[]", "{", "{\"tuning\": 3}", "{\"tuning\": {\"program\": \"x\"}}"}) {
        test::writeBytes(scratch / "other.json", bytes);
        const auto trace = readTuneTrace(scratch / "other.json");
        ASSERT_FALSE(trace.has_value()) << bytes;
        EXPECT_THAT(trace.error().text(), HasSubstr("other.json"));
    }
    EXPECT_FALSE(readTuneTrace(scratch / "none.json").has_value());
}

TEST(EndLosses, AreGroupedByOptimiserForOneLoss) {
    std::vector<TuneTrace> traces{{"aukf", "isma", 1, "a", {{1, 3.0}, {2, 2.0}}},
                                  {"aukf", "pso", 1, "a", {{1, 5.0}}},
                                  {"ukf", "isma", 1, "another", {{1, 0.1}}},
                                  {"aukf", "isma", 2, "a", {{9, 1.5}}}};
    const OptimiserTable table = endLosses(traces);
    EXPECT_EQ(table.quantity, "a");
    ASSERT_EQ(table.optimisers.size(), 2u);
    EXPECT_EQ(table.optimisers[0].optimiser, "isma");
    EXPECT_THAT(table.optimisers[0].losses, ElementsAre(2.0, 1.5));
    EXPECT_TRUE(endLosses({}).optimisers.empty());
}

TEST(OptimiserTable, IsReadFromAnExperimentAndRefusesOthersWithTheLine) {
    const test::TemporaryFolder scratch;
    test::writeBytes(scratch / "fig13.csv",
                     "tuner,repeat,time [s],evaluations,loss [m2]\nISMA,1,3,500,2.5\n\"SMA, old\",1,4,500,3\n"
                     "ISMA,2,3,500,2.25\n");
    const auto table = readOptimiserTable(scratch / "fig13.csv");
    ASSERT_TRUE(table.has_value()) << table.error().text();
    EXPECT_EQ(table->quantity, "loss [m2]");
    ASSERT_EQ(table->optimisers.size(), 2u);
    EXPECT_THAT(table->optimisers[0].losses, ElementsAre(2.5, 2.25));
    EXPECT_EQ(table->optimisers[1].optimiser, "SMA, old");
    for (const auto& [bytes, blamed] : {std::pair{"a,b\n", "other.csv:1"},
                                        {"a,b,c\nx,1\n", "other.csv:2"},
                                        {"a,b,c\nx,1,y\n", "other.csv:2"},
                                        {"t,e,loss\n0,1,2\n", "other.csv:2"},
                                        {"a,b,c\n", "no rows"},
                                        {"", "other.csv"}}) {
        test::writeBytes(scratch / "other.csv", bytes);
        const auto other = readOptimiserTable(scratch / "other.csv");
        ASSERT_FALSE(other.has_value()) << bytes;
        EXPECT_THAT(other.error().text(), HasSubstr(blamed));
    }
}

}  // namespace
}  // namespace terrawalk
