#include <gtest/gtest.h>

#include "app/pipeline/inspect.hpp"

namespace terrawalk {
namespace {

// Ten seconds at 5 Hz with a gap of three seconds; GNSS in every second epoch, first fixed, then float.
ArrayLog exampleLog() {
    ArrayLog log;
    log.file = "S01.csv";
    auto& latitude = log.column(Channel::Latitude);
    auto& fix = log.column(Channel::Fix);
    auto& roll = log.column(Channel::Roll);
    for (int i = 0; i < 50; ++i) {
        log.time_s.push_back(0.2 * i + (i >= 25 ? 3.0 : 0.0));
        latitude.push_back(i % 2 == 0 ? 23.0 : kMissing);
        fix.push_back(i % 2 == 0 ? (i < 25 ? 4.0 : 5.0) : kMissing);
        roll.push_back(radians(i == 0 ? -2.0 : 1.0));
    }
    log.read_report.rows_read = 51;
    log.read_report.repeated_lines = {7};
    return log;
}

TEST(Inspect, CountsEpochsRatesAndGaps) {
    const LogSummary s = inspectLog(exampleLog(), "S01");
    EXPECT_EQ(s.epochs, 50u);
    EXPECT_NEAR(s.interval_s, 0.2, 1e-9);
    EXPECT_EQ(s.gaps, 1u);
    EXPECT_NEAR(s.longest_gap_s, 3.2, 1e-9);
    ASSERT_EQ(s.sensors.size(), 2u);
    EXPECT_EQ(s.sensors[0].sensor, "GNSS position");
    EXPECT_EQ(s.sensors[0].epochs, 25u);
    EXPECT_NEAR(s.sensors[0].rate_hz, 2.5, 1e-9);
    EXPECT_NEAR(s.sensors[0].longest_gap_s, 3.4, 1e-9);
    EXPECT_EQ(s.missing.size(), 7u);
}

TEST(Inspect, ShowsAnglesInTheFilesUnit) {
    const LogSummary s = inspectLog(exampleLog(), "S01");
    EXPECT_EQ(s.sensors[1].sensor, "attitude");
    EXPECT_NEAR(s.sensors[1].least, -2.0, 1e-9);
    EXPECT_NEAR(s.sensors[1].greatest, 1.0, 1e-9);
}

TEST(Inspect, SharesFixesByCode) {
    const auto fixes = fixShares(exampleLog());
    ASSERT_EQ(fixes.size(), 2u);
    EXPECT_EQ(fixes[0].reason, "RTK fixed");
    EXPECT_EQ(fixes[0].count, 13u);
    EXPECT_EQ(fixes[1].reason, "RTK float");
    EXPECT_EQ(fixes[1].count, 12u);
}

TEST(Inspect, AnEmptyLogHasNothingAndDoesNotFail) {
    const LogSummary s = inspectLog({}, "");
    EXPECT_TRUE(s.sensors.empty());
    EXPECT_FALSE(toText(s).empty());
}

}  // namespace
}  // namespace terrawalk
