#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/pipeline/experiment.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using test::bytesOf;
using test::TemporaryFolder;
using testing::HasSubstr;

ExperimentReport quickReport(std::string_view name, const std::filesystem::path& output,
                             std::uint64_t seed = 3) {
    SilentProgress silent;
    ExperimentOptions options;
    options.quick = true;
    options.seed = seed;
    auto report = runExperiment(name, options, output, silent, {});
    EXPECT_TRUE(report) << report.error().text();
    return report ? std::move(*report) : ExperimentReport{};
}

std::size_t columnOf(const ExperimentTable& table, const std::string& name) {
    const auto found = std::find(table.columns.begin(), table.columns.end(), name);
    EXPECT_NE(found, table.columns.end()) << name;
    return static_cast<std::size_t>(found - table.columns.begin());
}

double number(const std::vector<Cell>& row, std::size_t column) {
    return std::get<double>(row.at(column));
}

class TuningExperiment : public testing::TestWithParam<const char*> {};

TEST_P(TuningExperiment, GivesTheSameFilesOnAnyNumberOfThreadsAndOthersWithAnotherSeed) {
    const TemporaryFolder scratch;
    const auto run = [&](std::size_t threads, std::uint64_t seed, const char* folder) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const ExperimentReport report = quickReport(GetParam(), scratch / folder, seed);
        EXPECT_TRUE(report.simulated);
        const ExperimentFiles files = experimentFiles(GetParam(), scratch / folder);
        EXPECT_THAT(bytesOf(files.svg), HasSubstr("simulated, seed " + std::to_string(seed)));
        return bytesOf(files.csv);
    };
    const std::string one = run(1, 3, "one");
    EXPECT_EQ(one, run(4, 3, "four"));
    EXPECT_NE(one, run(4, 4, "other"));
}
INSTANTIATE_TEST_SUITE_P(Quick, TuningExperiment, testing::Values("fig11", "fig12", "fig15"));

// The table is what the file holds, and every tuner beats the untuned filter on the runs that it saw.
TEST(Fig10, TheTableSumsUpTheRepeats) {
    const TemporaryFolder scratch;
    const ExperimentReport report = quickReport("fig10", scratch.path());
    std::map<std::string, std::vector<double>> losses;
    const std::size_t loss = columnOf(report.data, "loss [m2]");
    for (const auto& row : report.data.rows)
        losses[std::get<std::string>(row[0])].push_back(number(row, loss));
    ASSERT_EQ(losses.size(), 9U);
    for (const auto& row : report.summary.rows) {
        const std::string& tuner = std::get<std::string>(row[0]);
        std::vector<double> values = losses.at(tuner);
        ASSERT_EQ(values.size(), 2U) << tuner;
        std::sort(values.begin(), values.end());
        EXPECT_DOUBLE_EQ(number(row, columnOf(report.summary, "median")), 0.5 * (values[0] + values[1]))
            << tuner;
        EXPECT_EQ(number(row, columnOf(report.summary, "least")), values[0]) << tuner;
        EXPECT_LT(values[1], number(row, columnOf(report.summary, "untuned, on these"))) << tuner;
        EXPECT_EQ(number(row, columnOf(report.summary, "evaluations")), 200.0) << tuner;
    }
}

TEST(Fig13, TellsTimesAndCountsEvaluations) {
    const TemporaryFolder scratch;
    const ExperimentReport report = quickReport("fig13", scratch.path());
    ASSERT_EQ(report.summary.rows.size(), 7U);
    double least = HUGE_VAL;
    for (const auto& row : report.data.rows)
        least = std::min(least, number(row, columnOf(report.data, "loss [m2]")));
    for (const auto& row : report.data.rows) {
        EXPECT_GT(number(row, columnOf(report.data, "time [s]")), 0.0);
        EXPECT_EQ(number(row, columnOf(report.data, "evaluations")), 300.0);
        // A search came close exactly when its loss says so.
        const double reached = number(row, columnOf(report.data, "evaluations to within 5 % of the least"));
        const bool close = number(row, columnOf(report.data, "loss [m2]")) <= 1.05 * least;
        EXPECT_EQ(std::isfinite(reached), close);
    }
}

// The paper's filter, tuned or not, is not nearer to the ground than the truth's own track, and the program's
// own method is nearer than the sensors as they are.
TEST(Fig14, ErrorsStandInTheirOrder) {
    const TemporaryFolder scratch;
    const ExperimentReport report = quickReport("fig14", scratch.path());
    ASSERT_EQ(report.summary.rows.size(), 6U);
    for (std::size_t m = 0; m < 5; ++m) {
        const auto& row = report.summary.rows[m];
        EXPECT_GT(number(row, 1), number(row, 3));
        EXPECT_GT(number(row, 2), number(row, 4));
    }
    EXPECT_LT(number(report.summary.rows[5], 1), number(report.summary.rows[0], 1));
    EXPECT_LT(number(report.summary.rows[5], 2), number(report.summary.rows[0], 2));
    EXPECT_EQ(number(report.summary.rows[0], columnOf(report.summary, "paper 000 [m]")), 0.9121);
}

}  // namespace
}  // namespace terrawalk
