#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "io/read_survey.hpp"
#include "io/write_survey.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// All channels, each with a value missing somewhere, and values that need rounding.
ArrayLog fullLog() {
    ArrayLog log;
    log.device = "array, \"one\" #2";
    log.start_utc = "2024-05-17T08:30:00Z";
    log.sample_interval_s = 0.1;
    log.range_lever_arm_m = {0.1, -0.02, 1.0 / 3.0};
    constexpr std::size_t epochs = 50;
    for (std::size_t i = 0; i < epochs; ++i) log.time_s.push_back(0.1 * static_cast<double>(i) + 1e-5);
    for (std::size_t c = 0; c < kChannelCount; ++c) {
        const auto channel = static_cast<Channel>(c);
        const bool whole =
            channel == Channel::Fix || channel == Channel::FlowQuality || channel == Channel::RangeStrength;
        for (std::size_t i = 0; i < epochs; ++i) {
            const double value = std::sin(static_cast<double>(i) + 0.1 * static_cast<double>(c));
            log.channels[c].push_back(whole ? static_cast<double>(i % 6)
                                            : std::abs(value) * kChannels[c].unit_factor);
        }
        // A position is there or not as a whole.
        const std::size_t gap = channel == Channel::Longitude ? 7 : 7 + c;
        log.channels[c][gap] = kMissing;
    }
    log.auxiliary.push_back({"state, \"coded\"", std::vector<double>(epochs, 1.0 / 3.0), 0});
    log.auxiliary[0].values[3] = kMissing;
    return log;
}

Survey fullSurvey() {
    Survey survey;
    survey.name = "H\xC3\xB6he \"one\"";
    survey.zero_point = {23.182753123, -113.399795456, 38.125};
    survey.crs = "EPSG:32649";
    survey.vertical_datum = "ellipsoid";
    survey.marks = {{"P01", {1.2345, -2.5, 0.25}, 0.005, 0.008, MarkRole::Control},
                    {"P, \"two\"", {10.0, 20.0, -1.0}, 0.0061, 0.0092, MarkRole::Check}};
    survey.runs.resize(2);
    survey.runs[0] = {"F01", RunKind::FixedPoint, "ZERO", "P01", {}, fullLog()};
    survey.runs[1] = {"S-01.a", RunKind::Area, std::nullopt, std::nullopt, {{"P, \"two\"", 1.5, 2.25}},
                      fullLog()};
    return survey;
}

Result<ArrayLog> readBack(const std::filesystem::path& file) {
    SilentProgress progress;
    return readArrayLog(file, progress, {});
}

/// Half a unit of the last decimal, and the rounding of a number of that size.
double tolerance(int decimals, double factor) {
    return (0.5 * std::pow(10.0, -decimals) + 1e-12) * factor;
}

TEST(SurveyWriter, LogSurvivesTheRoundTripToItsWrittenPrecision) {
    const test::TemporaryFolder folder;
    const ArrayLog log = fullLog();
    ASSERT_TRUE(writeArrayLog(log, folder / "F01.csv"));
    const auto back = readBack(folder / "F01.csv");
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_EQ(back->device, log.device);
    EXPECT_EQ(back->start_utc, log.start_utc);
    EXPECT_EQ(back->sample_interval_s, log.sample_interval_s);
    EXPECT_EQ(back->range_lever_arm_m, log.range_lever_arm_m);
    EXPECT_EQ(back->gnss_lever_arm_m, log.gnss_lever_arm_m);
    ASSERT_EQ(back->size(), log.size());
    const std::array<int, kChannelCount> decimals{9, 9, 3, 0, 3, 3, 4, 4, 4, 2, 2, 4, 4,
                                                  0, 4, 4, 4, 4, 4, 4, 4, 4, 4, 3, 0};
    for (std::size_t i = 0; i < log.size(); ++i) {
        EXPECT_NEAR(back->time_s[i], log.time_s[i], tolerance(3, 1.0));
        for (std::size_t c = 0; c < kChannelCount; ++c) {
            const double written = log.channels[c][i];
            const double read = back->channels[c][i];
            ASSERT_EQ(present(read), present(written)) << kChannels[c].column << ' ' << i;
            if (!present(written)) continue;
            ASSERT_NEAR(read, written, tolerance(decimals[c], kChannels[c].unit_factor))
                << kChannels[c].column;
        }
    }
    ASSERT_THAT(back->auxiliary, SizeIs(1));
    EXPECT_EQ(back->auxiliary[0].name, log.auxiliary[0].name);
    EXPECT_EQ(back->auxiliary[0].values[0], 1.0 / 3.0);
    EXPECT_FALSE(present(back->auxiliary[0].values[3]));
    EXPECT_THAT(back->read_report.late_lines, IsEmpty());
    EXPECT_EQ(back->read_report.cut_off_line, 0U);
}

TEST(SurveyWriter, SecondRoundTripChangesNoByte) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(writeArrayLog(fullLog(), folder / "a.csv"));
    ASSERT_TRUE(writeArrayLog(*readBack(folder / "a.csv"), folder / "b.csv"));
    EXPECT_EQ(test::bytesOf(folder / "a.csv"), test::bytesOf(folder / "b.csv"));
}

TEST(SurveyWriter, ColumnsThatTheLogLacksAreLeftOut) {
    const test::TemporaryFolder folder;
    ArrayLog log;
    log.time_s = {0.0, 0.1};
    log.column(Channel::Range) = {1.25, kMissing};
    ASSERT_TRUE(writeArrayLog(log, folder / "a.csv"));
    EXPECT_EQ(test::bytesOf(folder / "a.csv"),
              "# format: array-log 1\ntime_s,range_m\n0.000,1.250\n0.100,\n");
}

TEST(SurveyWriter, SurveySurvivesTheRoundTrip) {
    const test::TemporaryFolder folder;
    const Survey survey = fullSurvey();
    const auto written = writeSurvey(survey, folder.path());
    ASSERT_TRUE(written) << written.error().text();
    SilentProgress progress;
    const auto back = readSurvey(folder / "survey.json", progress, {});
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_THAT(back->notes, IsEmpty());
    EXPECT_EQ(back->name, survey.name);
    EXPECT_EQ(back->zero_point.lat_deg, survey.zero_point.lat_deg);
    EXPECT_EQ(back->zero_point.lon_deg, survey.zero_point.lon_deg);
    EXPECT_EQ(back->zero_point.h_ell_m, survey.zero_point.h_ell_m);
    EXPECT_EQ(back->crs, survey.crs);
    EXPECT_EQ(back->vertical_datum, survey.vertical_datum);
    ASSERT_THAT(back->marks, SizeIs(2));
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(back->marks[i].name, survey.marks[i].name);
        EXPECT_EQ(back->marks[i].enu_m, survey.marks[i].enu_m);
        EXPECT_EQ(back->marks[i].sigma_h_m, survey.marks[i].sigma_h_m);
        EXPECT_EQ(back->marks[i].sigma_v_m, survey.marks[i].sigma_v_m);
        EXPECT_EQ(back->marks[i].role, survey.marks[i].role);
    }
    ASSERT_THAT(back->runs, SizeIs(2));
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(back->runs[i].id, survey.runs[i].id);
        EXPECT_EQ(back->runs[i].kind, survey.runs[i].kind);
        EXPECT_EQ(back->runs[i].start, survey.runs[i].start);
        EXPECT_EQ(back->runs[i].target, survey.runs[i].target);
        EXPECT_EQ(back->runs[i].log.size(), survey.runs[i].log.size());
    }
    ASSERT_THAT(back->runs[1].stops, SizeIs(1));
    EXPECT_EQ(back->runs[1].stops[0].from_s, 1.5);
    EXPECT_EQ(back->runs[1].stops[0].to_s, 2.25);
    EXPECT_THAT(test::readTree(folder.path()), SizeIs(4));  // nothing temporary is left
}

TEST(SurveyWriter, WithoutMarksThereIsNoControlFile) {
    const test::TemporaryFolder folder;
    Survey survey = fullSurvey();
    survey.marks.clear();
    survey.crs.clear();
    survey.runs.erase(survey.runs.begin());
    survey.runs[0].stops.clear();
    ASSERT_TRUE(writeSurvey(survey, folder.path()));
    EXPECT_FALSE(std::filesystem::exists(folder / "control.csv"));
    SilentProgress progress;
    const auto back = readSurvey(folder / "survey.json", progress, {});
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_EQ(back->crs, "");
}

TEST(SurveyWriter, WhatTheReaderWouldRefuseIsNotWritten) {
    const test::TemporaryFolder folder;
    const auto errorOf = [&](const ArrayLog& log) {
        const auto written = writeArrayLog(log, folder / "a.csv");
        EXPECT_FALSE(std::filesystem::exists(folder / "a.csv"));
        return written ? std::string() : written.error().text();
    };
    EXPECT_THAT(errorOf(ArrayLog{}), HasSubstr("without rows"));
    ArrayLog log = fullLog();
    log.time_s[4] = log.time_s[3] + 0.0004;
    EXPECT_THAT(errorOf(log), HasSubstr("epoch 4 is not a millisecond after"));
    log = fullLog();
    log.column(Channel::Range)[2] = INFINITY;
    EXPECT_THAT(errorOf(log), HasSubstr("column range_m: epoch 2 is infinite"));
    log = fullLog();
    log.column(Channel::Range).pop_back();
    EXPECT_THAT(errorOf(log), HasSubstr("49 values for 50 epochs"));
    log = fullLog();
    log.device = "a\nb";
    EXPECT_THAT(errorOf(log), HasSubstr("line end"));

    Survey survey = fullSurvey();
    survey.runs[1].id = "../x";
    EXPECT_FALSE(writeSurvey(survey, folder.path()));
    survey = fullSurvey();
    survey.runs[1].id = survey.runs[0].id;
    EXPECT_FALSE(writeSurvey(survey, folder.path()));
    survey = fullSurvey();
    survey.name = "\xFF";
    EXPECT_FALSE(writeSurvey(survey, folder.path()));
    EXPECT_THAT(test::readTree(folder.path()), IsEmpty());
}

TEST(SurveyWriter, DiskErrorsAreReported) {
    const auto nowhere = writeArrayLog(fullLog(), "/nonexistent/folder/a.csv");
    ASSERT_FALSE(nowhere);
    EXPECT_EQ(nowhere.error().kind, ErrorKind::System);
    const auto survey = writeSurvey(fullSurvey(), "/nonexistent/folder");
    ASSERT_FALSE(survey);
    EXPECT_EQ(survey.error().kind, ErrorKind::System);
}

}  // namespace
}  // namespace terrawalk
