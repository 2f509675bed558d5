#include "app/pipeline/experiment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using test::bytesOf;
using test::TemporaryFolder;
using testing::HasSubstr;

const ExperimentOptions kQuick{.quick = true, .seed = 3};

ExperimentReport quickReport(std::string_view name, const std::filesystem::path& output,
                             const ExperimentOptions& options = kQuick) {
    SilentProgress silent;
    auto report = runExperiment(name, options, output, silent, {});
    EXPECT_TRUE(report) << report.error().text();
    return report ? std::move(*report) : ExperimentReport{};
}

/// The number in a column of the first row that begins with the given texts.
double valueOf(const ExperimentTable& table, const std::vector<std::string>& begin,
               const std::string& column) {
    const auto c = std::find(table.columns.begin(), table.columns.end(), column) - table.columns.begin();
    for (const auto& row : table.rows) {
        bool same = true;
        for (std::size_t k = 0; k < begin.size(); ++k)
            same = same && std::get<std::string>(row[k]) == begin[k];
        if (same) return std::get<double>(row[static_cast<std::size_t>(c)]);
    }
    ADD_FAILURE() << "no row " << begin.front();
    return 0.0;
}

class Repeatable : public testing::TestWithParam<const char*> {};

TEST_P(Repeatable, GivesTheSameFilesOnAnyNumberOfThreads) {
    const TemporaryFolder scratch;
    for (const std::size_t threads : {1U, 2U, 5U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        quickReport(GetParam(), scratch / std::to_string(threads));
    }
    quickReport(GetParam(), scratch / "other", {.quick = true, .seed = 4});
    const auto files = [&](const std::string& folder) {
        const ExperimentFiles f = experimentFiles(GetParam(), scratch / folder);
        return std::pair{bytesOf(f.csv), bytesOf(f.svg)};
    };
    EXPECT_EQ(files("1"), files("2"));
    EXPECT_EQ(files("1"), files("5"));
    EXPECT_NE(files("1").first, files("other").first);
    EXPECT_THAT(files("1").second, HasSubstr("seed 3, quick form"));
}

TEST_P(Repeatable, StopsWithoutFiles) {
    const TemporaryFolder scratch;
    std::stop_source source;
    source.request_stop();
    SilentProgress silent;
    const auto stopped = runExperiment(GetParam(), kQuick, scratch.path(), silent, source.get_token());
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::Cancelled);
    EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
}

INSTANTIATE_TEST_SUITE_P(Experiments, Repeatable, testing::Values("fig7", "fig8"));

TEST(Experiment, NamesAreUniqueAndExplained) {
    std::set<std::string_view> names;
    for (const Experiment& experiment : experiments()) {
        EXPECT_TRUE(names.insert(experiment.name).second) << experiment.name;
        EXPECT_FALSE(experiment.about.empty());
        EXPECT_NE(experiment.run, nullptr);
    }
    EXPECT_TRUE(names.contains("fig7"));
}

TEST(Experiment, RefusesAnUnknownNameAndAFolderThatCannotBe) {
    const TemporaryFolder scratch;
    SilentProgress silent;
    const auto unknown = runExperiment("fig99", kQuick, scratch.path(), silent, {});
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().kind, ErrorKind::Usage);
    test::writeBytes(scratch / "file", "in the way");
    const auto blocked = runExperiment("fig8", kQuick, scratch / "file", silent, {});
    ASSERT_FALSE(blocked);
    EXPECT_EQ(blocked.error().kind, ErrorKind::System);
}

TEST(Fig8, GoodPointsAreMoreEvenThanRandomOnesAndALevyFlight) {
    const TemporaryFolder scratch;
    const ExperimentReport report = quickReport("fig8", scratch.path());
    const auto mean = [&](const char* population) {
        return valueOf(report.summary, {population}, "mean discrepancy");
    };
    EXPECT_LT(mean("good points"), mean("random"));
    EXPECT_LT(mean("random"), mean("Levy flight"));
    EXPECT_EQ(valueOf(report.summary, {"good points"}, "SD"), 0.0);
    EXPECT_GT(valueOf(report.summary, {"random"}, "SD"), 0.0);
    EXPECT_EQ(report.data.rows.size(), 30U);
}

TEST(Fig7, ShiftTakesTheLeadFromThePlainSlimeMould) {
    const TemporaryFolder scratch;
    const ExperimentReport report = quickReport("fig7", scratch.path());
    const auto end = [&](const char* function, const char* optimiser) {
        return valueOf(report.summary, {function, optimiser}, "median end");
    };
    EXPECT_LT(end("Griewank", "SMA"), 1e-6);
    EXPECT_GT(end("Griewank, shifted", "SMA"), 0.1);
    EXPECT_LT(end("Levy 13, shifted", "ISMA, default form"), 1e-3 * end("Levy 13, shifted", "SMA"));
    // The curves in the file end where the table says.
    const auto& last = report.data.rows.back();
    EXPECT_EQ(std::get<double>(last[3]), end("Levy 13, shifted", "PSO"));
}

TEST(ExperimentTable, CsvQuotesTextAndKeepsEveryBit) {
    const ExperimentTable table{
        {"name, unit", "value"},
        {{std::string("say \"a\""), 0.1}, {Cell(), 1e-300}, {std::string("nan"), NAN}}};
    EXPECT_EQ(toCsv(table), "\"name, unit\",value\n\"say \"\"a\"\"\",0.1\n,1e-300\nnan,\n");
}

TEST(ExperimentReport, SaysSimulatedSeedAndNotes) {
    ExperimentReport report{.title = "T", .simulated = true};
    report.summary = {{"what", "error [m]", "paper"},
                      {{std::string("ours"), 0.123456, 0.2}, {std::string("x"), Cell(), Cell()}}};
    report.notes = {"a note"};
    const std::string text = toText(report, {.quick = false, .seed = 42});
    EXPECT_THAT(text, HasSubstr("simulated, seed 42"));
    EXPECT_THAT(text, HasSubstr("ours     0.1235    0.2"));
    EXPECT_THAT(text, HasSubstr("- a note"));
    const auto document = nlohmann::json::parse(toJson(report, {.seed = 42}, {"a.csv", "a.svg"}));
    EXPECT_EQ(document.at("seed"), 42);
    EXPECT_EQ(document.at("simulated"), true);
    EXPECT_EQ(document.at("rows").at(0).at("error [m]"), 0.123456);
    EXPECT_TRUE(document.at("rows").at(1).at("paper").is_null());
}

}  // namespace
}  // namespace terrawalk
