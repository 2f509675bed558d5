#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "io/read_survey.hpp"
#include "io/text_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string kFormat = "# format: array-log 1\n";

Result<ArrayLog> parse(std::string_view text) {
    SilentProgress progress;
    return parseArrayLog(text, "F01.csv", progress, {});
}

ArrayLog parsed(std::string_view text) {
    auto log = parse(text);
    EXPECT_TRUE(log) << log.error().text();
    return log ? std::move(*log) : ArrayLog{};
}

/// The error as the user sees it; empty when there is none.
std::string errorOf(std::string_view text) {
    const auto log = parse(text);
    if (log) return {};
    EXPECT_EQ(log.error().kind, ErrorKind::BadData);
    return log.error().text();
}

std::string notesOf(const ArrayLog& log) {
    std::string text;
    for (const std::string& note : log.read_report.notes) text += note + "\n";
    return text;
}

bool sameValues(const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    });
}

bool sameChannels(const ArrayLog& a, const ArrayLog& b) {
    return sameValues(a.time_s, b.time_s) &&
           std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), sameValues);
}

const std::string kSmallLog =
    "# format: array-log 1\n"
    "# device: test array\n"
    "# start_utc: 2024-05-17T08:30:00Z\n"
    "# sample_interval_s: 0.1\n"
    "# range_lever_arm_m: 0.1 -0.02 0.05\n"
    "# gnss_lever_arm_m: 0 0 0.3\n"
    "time_s,lat_deg,lon_deg,fix,roll_deg,gyr_z_dps,range_m\n"
    "0.000,23.182753000,113.399795000,4,1.50,-90.0,1.250\n"
    "0.100,,,,2.50,90.0,1.260\n"
    "0.200,23.182754000,113.399796000,5,-3.50,,\n"
    "0.300,,,,4.50,0.5,1.270\n";

// ---- what a good log says ----

TEST(ArrayLogReader, ReadsMetadataColumnsAndUnits) {
    const ArrayLog log = parsed(kSmallLog);
    EXPECT_EQ(log.device, "test array");
    EXPECT_EQ(log.start_utc, "2024-05-17T08:30:00Z");
    EXPECT_EQ(log.sample_interval_s, 0.1);
    EXPECT_EQ(log.range_lever_arm_m, Eigen::Vector3d(0.1, -0.02, 0.05));
    EXPECT_EQ(log.gnss_lever_arm_m, Eigen::Vector3d(0.0, 0.0, 0.3));
    EXPECT_THAT(log.time_s, ElementsAre(0.0, 0.1, 0.2, 0.3));
    EXPECT_EQ(log.value(Channel::Latitude, 2), 23.182754);
    EXPECT_EQ(log.value(Channel::Fix, 0), 4.0);
    EXPECT_EQ(log.value(Channel::Roll, 0), 1.5 * (kPi / 180.0));
    EXPECT_EQ(log.value(Channel::AngularRateZ, 0), -90.0 * (kPi / 180.0));
    EXPECT_FALSE(log.has(Channel::Pressure));
    EXPECT_EQ(log.read_report.rows_read, 4U);
    EXPECT_EQ(log.read_report.cut_off_line, 0U);
    EXPECT_THAT(log.read_report.notes, IsEmpty());
}

TEST(ArrayLogReader, EmptyFieldsAreMissing) {
    const ArrayLog log = parsed(kSmallLog);
    EXPECT_FALSE(present(log.value(Channel::Latitude, 1)));
    EXPECT_FALSE(present(log.value(Channel::Range, 2)));
    EXPECT_FALSE(present(log.value(Channel::AngularRateZ, 2)));
    EXPECT_TRUE(present(log.value(Channel::Range, 3)));
}

TEST(ArrayLogReader, EveryChannelIsFoundByItsColumnInItsUnit) {
    for (std::size_t i = 0; i < kChannelCount; ++i) {
        const auto channel = static_cast<Channel>(i);
        const ChannelInfo& info = kChannels[i];
        // A position needs both its coordinates.
        const std::string pair = channel == Channel::Latitude    ? "lon_deg"
                                 : channel == Channel::Longitude ? "lat_deg"
                                                                 : "x";
        const ArrayLog log = parsed(fmt::format("{}time_s,{},{}\n0,2,3\n", kFormat, info.column, pair));
        ASSERT_TRUE(log.has(channel)) << info.column;
        EXPECT_EQ(log.value(channel, 0), 2.0 * info.unit_factor) << info.column;
    }
}

TEST(ArrayLogReader, AnyOrderOfColumnsGivesTheSameLog) {
    const std::vector<std::string> names{"time_s", "lat_deg", "lon_deg", "fix", "heading_deg", "range_m"};
    const std::vector<std::vector<std::string>> rows{{"0.0", "23.1", "113.2", "4", "350.25", "1.25"},
                                                     {"0.2", "", "", "", "351.25", ""},
                                                     {"0.1", "23.2", "113.3", "5", "", "1.5"},
                                                     {"0.3", "23.3", "113.4", "1", "1.75", "1.75"}};
    const auto textFor = [&](const std::vector<std::size_t>& order) {
        std::string text = kFormat;
        const auto line = [&](const std::vector<std::string>& fields) {
            for (std::size_t c = 0; c < order.size(); ++c) text += (c ? "," : "") + fields[order[c]];
            text += "\n";
        };
        line(names);
        for (const auto& row : rows) line(row);
        for (int k = 4; k < 40; ++k) {
            line({fmt::format("{:.1f}", 0.1 * k), "", "", "", "", fmt::format("{:.2f}", 0.01 * k)});
        }
        return text;
    };
    std::vector<std::size_t> order(names.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const ArrayLog expected = parsed(textFor(order));
    ASSERT_EQ(expected.size(), 40U);
    do {
        const ArrayLog log = parsed(textFor(order));
        ASSERT_TRUE(sameChannels(log, expected)) << textFor(order);
        ASSERT_EQ(log.read_report.late_lines, expected.read_report.late_lines);
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST(ArrayLogReader, LineEndsAndByteOrderMarkChangeNothing) {
    const ArrayLog expected = parsed(kSmallLog);
    for (const std::string line_end : {"\r\n", "\r"}) {
        std::string text;
        for (const char c : kSmallLog) text += c == '\n' ? line_end : std::string(1, c);
        EXPECT_TRUE(sameChannels(parsed(text), expected));
        EXPECT_TRUE(sameChannels(parsed("\xEF\xBB\xBF" + text), expected));
    }
}

TEST(ArrayLogReader, LinesAreCountedAlikeForAllLineEnds) {
    for (const std::string line_end : {"\n", "\r\n", "\r"}) {
        std::string text;
        for (const char c : std::string("# device: x\n\ntime_s,range_m\n0,1\n\n# comment\n1,abc\n")) {
            text += c == '\n' ? line_end : std::string(1, c);
        }
        EXPECT_THAT(errorOf(text), HasSubstr("F01.csv:7: column range_m: \"abc\""));
    }
}

TEST(ArrayLogReader, BlanksQuotesAndOtherNumberFormsAreTolerated) {
    const ArrayLog log = parsed(kFormat +
                                " \"time_s\" , range_m ,\"flow_vx_mps\"\n"
                                " 0.0 , \"1.25\" , +.5 \n"
                                "\t1e0,1.25e+2,-5.\n"
                                "  2 ,  , \"\" \n"
                                "3.0000000000000000000000001,00000000000000000000000001.5,-0\n");
    EXPECT_THAT(log.time_s, ElementsAre(0.0, 1.0, 2.0, 3.0));
    EXPECT_EQ(log.value(Channel::Range, 0), 1.25);
    EXPECT_EQ(log.value(Channel::Range, 1), 125.0);
    EXPECT_FALSE(present(log.value(Channel::Range, 2)));
    EXPECT_EQ(log.value(Channel::Range, 3), 1.5);
    EXPECT_EQ(log.value(Channel::FlowForward, 0), 0.5);
    EXPECT_EQ(log.value(Channel::FlowForward, 1), -5.0);
    EXPECT_FALSE(present(log.value(Channel::FlowForward, 2)));
}

TEST(ArrayLogReader, CommentsAndBlankLinesBetweenRowsAreSkippedAndCounted) {
    const ArrayLog log = parsed(kFormat + "time_s,range_m\n\n0,1\n  \n# note: 5\n  # more\n1,2\n\n");
    EXPECT_THAT(log.time_s, ElementsAre(0.0, 1.0));
    EXPECT_EQ(log.read_report.rows_read, 2U);
    EXPECT_THAT(errorOf(kFormat + "time_s\n0\n\n\nx\n"), HasSubstr("F01.csv:6: column time_s: \"x\""));
}

TEST(ArrayLogReader, UnknownColumnsAreKeptAndNotedOnce) {
    const ArrayLog log =
        parsed(kFormat + "time_s,light,\"state, coded\"\n0,5.5,\"idle, \"\"ok\"\"\"\n1,,7\n2,nan,\n");
    ASSERT_THAT(log.auxiliary, SizeIs(2));
    EXPECT_EQ(log.auxiliary[0].name, "light");
    EXPECT_EQ(log.auxiliary[0].values[0], 5.5);
    EXPECT_FALSE(present(log.auxiliary[0].values[1]));
    EXPECT_FALSE(present(log.auxiliary[0].values[2]));
    EXPECT_EQ(log.auxiliary[0].not_numeric, 1U);
    EXPECT_EQ(log.auxiliary[1].name, "state, coded");
    EXPECT_EQ(log.auxiliary[1].values[1], 7.0);
    EXPECT_EQ(log.auxiliary[1].not_numeric, 1U);
    EXPECT_THAT(log.read_report.notes, SizeIs(2));
    EXPECT_THAT(notesOf(log), HasSubstr("unknown column \"light\""));
}

TEST(ArrayLogReader, UnknownMetadataIsNotedOnce) {
    const ArrayLog log = parsed(kFormat + "# operator: A\n# operator: B\n# just a comment\ntime_s\n0\n");
    EXPECT_THAT(log.read_report.notes, SizeIs(1));
    EXPECT_THAT(notesOf(log), HasSubstr("line 2: unknown metadata key \"operator\""));
}

TEST(ArrayLogReader, FormatMayBeAbsentWithANoteButNotWrong) {
    EXPECT_THAT(notesOf(parsed("time_s\n0\n")), HasSubstr("no format line"));
    EXPECT_THAT(errorOf("# device: x\n# format: array-log 2\ntime_s\n0\n"),
                HasSubstr("F01.csv:2: format is \"array-log 2\"; it must be array-log 1"));
    EXPECT_THAT(errorOf("# format:\ntime_s\n0\n"), HasSubstr("F01.csv:1: format is \"\""));
}

TEST(ArrayLogReader, DamagedMetadataIsRefused) {
    const auto with = [](const std::string& line) {
        return errorOf(kFormat + "# " + line + "\ntime_s\n0\n");
    };
    EXPECT_THAT(with("sample_interval_s: -1"), HasSubstr("F01.csv:2: sample_interval_s \"-1\""));
    EXPECT_THAT(with("sample_interval_s: fast"), HasSubstr("no positive number"));
    EXPECT_THAT(with("range_lever_arm_m: 1 2"), HasSubstr("is no vector"));
    EXPECT_THAT(with("range_lever_arm_m: 1 2 x"), HasSubstr("is no vector"));
    EXPECT_THAT(with("range_lever_arm_m: 1 2 3 4"), HasSubstr("more than three"));
    EXPECT_THAT(with("gnss_lever_arm_m: 0 0 300"), HasSubstr("longer than 10 m"));
    EXPECT_THAT(with("start_utc: yesterday"), HasSubstr("no ISO 8601 time"));
    EXPECT_THAT(with("start_utc: 2024-13-01T00:00:00Z"), HasSubstr("no ISO 8601 time"));
    EXPECT_THAT(with("device: x\n# device: y"), HasSubstr("F01.csv:3: metadata key device stands twice"));
    EXPECT_THAT(with("device: \xFF"), HasSubstr("no UTF-8"));
}

TEST(ArrayLogReader, UsualFormsOfIso8601AreAccepted) {
    for (const std::string time :
         {"2024-05-17", "2024-05-17T08:30Z", "2024-05-17 08:30:00", "2024-05-17T08:30:00.250Z",
          "2024-05-17T08:30:00+08:00", "2024-05-17T08:30:00-0330", "2016-12-31T23:59:60Z"}) {
        EXPECT_EQ(parsed(kFormat + "# start_utc: " + time + "\ntime_s\n0\n").start_utc, time);
    }
}

// ---- what is refused, with line, reason and cure ----

TEST(ArrayLogReader, HeaderIsRequired) {
    EXPECT_THAT(errorOf(""), HasSubstr("F01.csv: the file is empty"));
    EXPECT_THAT(errorOf("\xEF\xBB\xBF"), HasSubstr("no header row"));
    EXPECT_THAT(errorOf("# format: array-log 1\n"), HasSubstr("F01.csv:1: no header row"));
    EXPECT_THAT(errorOf("0.0,23.1,113.4\n0.1,,\n"), HasSubstr("F01.csv:1: no header row before the data"));
    EXPECT_THAT(errorOf("lat_deg,lon_deg\n1,2\n"), HasSubstr("no column time_s"));
    EXPECT_THAT(errorOf("time_s,range_m\n"), HasSubstr("F01.csv:1: no data rows"));
    EXPECT_THAT(errorOf("time_s,range_m\n\n# x\n"), HasSubstr("no data rows"));
}

TEST(ArrayLogReader, ColumnNamesAreUniqueAndNotEmpty) {
    EXPECT_THAT(errorOf("time_s,range_m,range_m\n0,1,2\n"), HasSubstr("column \"range_m\" stands twice"));
    EXPECT_THAT(errorOf("time_s,aux,aux\n0,1,2\n"), HasSubstr("column \"aux\" stands twice"));
    EXPECT_THAT(errorOf("time_s,range_m,\n0,1,\n"), HasSubstr("column 3 has no name"));
    EXPECT_THAT(errorOf("time_s,\"range_m\n0,1\n"), HasSubstr("a quotation mark is not closed"));
}

TEST(ArrayLogReader, WhatIsNoFiniteNumberIsRefusedWithColumnAndValue) {
    for (const std::string value : {"nan", "NaN", "inf", "-inf", "infinity", "abc", "1.2.3", "0x10", "1e999",
                                    "--1", "1 2", "-", ".", "e5", "1e", "\"1\"2", "+-1"}) {
        const std::string error = errorOf(kFormat + "time_s,range_m,fix\n0,1,1\n1," + value + ",1\n");
        EXPECT_THAT(error, HasSubstr("F01.csv:4: column range_m: ")) << value;
        EXPECT_THAT(error, HasSubstr("is no finite number; give a number")) << value;
    }
}

TEST(ArrayLogReader, QuotedValuesAreShortAndPrintable) {
    const std::string error = errorOf("time_s,range_m\n0,\x1b[2J" + std::string(5000, 'x') + "\n");
    EXPECT_LT(error.size(), 250U);
    EXPECT_EQ(error.find('\x1b'), std::string::npos);
}

TEST(ArrayLogReader, RowsHaveAsManyFieldsAsTheHeader) {
    EXPECT_THAT(errorOf("time_s,range_m,fix\n0,1,1\n1,2\n2,3,1\n"),
                HasSubstr("F01.csv:3: 2 fields, but the header has 3"));
    EXPECT_THAT(errorOf("time_s,range_m\n0,1\n1,2,3\n2,3\n"), HasSubstr("F01.csv:3: more fields than the 2"));
    EXPECT_THAT(errorOf("time_s,range_m\n0,1\n1,2,\n2,3\n"), HasSubstr("F01.csv:3: more fields"));
    EXPECT_THAT(errorOf("time_s,range_m\n0,1\n1,2,3"),
                HasSubstr("F01.csv:3: more fields"));  // no cut adds fields
    EXPECT_THAT(errorOf("time_s,range_m\n0,\"1\n1,2\n"),
                HasSubstr("F01.csv:2: column range_m: the quotation mark"));
}

TEST(ArrayLogReader, EveryRowNeedsAPossibleTime) {
    EXPECT_THAT(errorOf("time_s,range_m\n0,1\n,2\n"),
                HasSubstr("F01.csv:3: column time_s: the time is missing"));
    EXPECT_THAT(errorOf("time_s\n1700000000\n"), HasSubstr("no time since the log's start"));
    EXPECT_THAT(errorOf("time_s\nnan\n"), HasSubstr("column time_s: \"nan\""));
}

TEST(ArrayLogReader, ValuesOutsideTheirRangeAreRefused) {
    const auto with = [](const std::string& column, const std::string& value) {
        return errorOf(kFormat + "time_s," + column + "\n0,0\n1," + value + "\n");
    };
    EXPECT_THAT(with("lat_deg", "90.001"), HasSubstr("F01.csv:4: column lat_deg: 90.001: a latitude lies"));
    EXPECT_THAT(with("lat_deg", "-91"), HasSubstr("a latitude lies"));
    EXPECT_THAT(with("lon_deg", "180.5"), HasSubstr("a longitude lies"));
    EXPECT_THAT(with("lon_deg", "-200"), HasSubstr("a longitude lies"));
    EXPECT_THAT(with("fix", "1.5"), HasSubstr("F01.csv:4: column fix: 1.5: a fix is a whole number"));
    EXPECT_THAT(with("fix", "-1"), HasSubstr("a fix is"));
    EXPECT_THAT(with("fix", "10"), HasSubstr("a fix is"));
    EXPECT_THAT(with("gnss_h_acc_m", "-0.1"), HasSubstr("an accuracy lies between 0 and 1000 km"));
    EXPECT_THAT(with("pressure_pa", "1e308"), HasSubstr("no air has 10 bar"));
    EXPECT_THAT(with("acc_x_mps2", "-1e200"), HasSubstr("no hand bears 1000 g"));
    EXPECT_THAT(with("gnss_v_acc_m", "-0.1"), HasSubstr("an accuracy lies between 0 and 1000 km"));
    EXPECT_THAT(with("flow_quality", "256"), HasSubstr("a flow quality lies"));
    EXPECT_EQ(with("lat_deg", "90"), "");
    EXPECT_EQ(with("lon_deg", "-180"), "");
    EXPECT_EQ(with("fix", "9"), "");
}

TEST(ArrayLogReader, FirstErrorOfTheFileIsReported) {
    EXPECT_THAT(errorOf("time_s,fix,range_m\n0,1,1\n1,77,1\n2,1,abc\n"), HasSubstr("F01.csv:3: column fix"));
    EXPECT_THAT(errorOf("time_s,fix,range_m\n0,1,1\n1,1,abc\n2,77,1\n"),
                HasSubstr("F01.csv:3: column range_m"));
    EXPECT_THAT(errorOf("time_s,fix,range_m\n100,1,1\n0,1,1\n2,77,1\n"), HasSubstr("F01.csv:3: the clock"));
}

TEST(ArrayLogReader, BinaryFilesAreRefused) {
    EXPECT_THAT(errorOf(std::string(1000, '\0')), HasSubstr("F01.csv:1: NUL byte"));
    EXPECT_THAT(errorOf("time_s\n0\n1\n" + std::string(5, '\0')), HasSubstr("F01.csv:4: NUL byte"));
    EXPECT_THAT(errorOf("time_s\n0\n1\n" + std::string(2'000'000, '\0')), HasSubstr("F01.csv:4: NUL byte"));
    EXPECT_THAT(errorOf(std::string("\xFF\xFEt\0i\0", 6)), HasSubstr("UTF-16"));
    EXPECT_THAT(errorOf("\x89PNG\r\n\x1a\n"), HasSubstr("no UTF-8"));
}

TEST(ArrayLogReader, AbsurdlyLongLinesAreRefused) {
    const std::string longest(kLongestLine, ' ');
    const std::string endless(3 * kBlockBytes, 'x');
    EXPECT_THAT(errorOf("time_s\n0" + longest + "\n1\n"), HasSubstr("F01.csv:2: the line is longer"));
    EXPECT_THAT(errorOf("time_s\n0\n#" + longest + "\n1\n"), HasSubstr("F01.csv:3: the line is longer"));
    EXPECT_THAT(errorOf(longest + "time_s\n0\n"), HasSubstr("F01.csv:1: the line is longer"));
    EXPECT_THAT(errorOf(endless), HasSubstr("F01.csv:1: the line is longer"));
    EXPECT_THAT(errorOf("time_s\n0\n" + endless), HasSubstr("F01.csv:3: the line is longer"));
}

// ---- positions ----

TEST(ArrayLogReader, HalfAPositionIsMissingAndNoted) {
    const ArrayLog log = parsed(kFormat + "time_s,lat_deg,lon_deg\n0,1,2\n1,1,\n2,,2\n");
    EXPECT_TRUE(present(log.value(Channel::Latitude, 0)));
    for (const std::size_t i : {1U, 2U}) {
        EXPECT_FALSE(present(log.value(Channel::Latitude, i)));
        EXPECT_FALSE(present(log.value(Channel::Longitude, i)));
    }
    EXPECT_THAT(notesOf(log), HasSubstr("2 rows give only one of latitude and longitude"));
    const ArrayLog half = parsed(kFormat + "time_s,lat_deg\n0,1\n");
    EXPECT_FALSE(half.has(Channel::Latitude));
    EXPECT_THAT(notesOf(half), HasSubstr("only one of the columns"));
}

// ---- time ----

/// Rows 0.0, 0.1, ... on lines 3, 4, ...; range tells the line.
std::vector<std::string> steadyRows(std::size_t count) {
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < count; ++i)
        rows.push_back(fmt::format("{:.1f},{}", 0.1 * static_cast<double>(i), i + 3));
    return rows;
}
std::string logOf(const std::vector<std::string>& rows) {
    return fmt::format("{}time_s,range_m\n{}\n", kFormat, fmt::join(rows, "\n"));
}

TEST(ArrayLogReader, RepeatedTimesAreDroppedAndTheirLinesKept) {
    std::vector<std::string> rows = steadyRows(10);
    rows.insert(rows.begin() + 5, "0.4,77");  // line 8
    rows.insert(rows.begin() + 6, "0.4,78");  // line 9
    const ArrayLog log = parsed(logOf(rows));
    EXPECT_EQ(log.size(), 10U);
    EXPECT_EQ(log.read_report.rows_read, 12U);
    EXPECT_THAT(log.read_report.repeated_lines, ElementsAre(8U, 9U));
    EXPECT_THAT(log.read_report.late_lines, IsEmpty());
    EXPECT_EQ(log.value(Channel::Range, 4), 7.0);  // the first one stays
}

TEST(ArrayLogReader, LateRowsArePutInOrder) {
    std::vector<std::string> rows = steadyRows(100);
    std::swap(rows[10], rows[11]);                                         // line 14 is late by one
    std::rotate(rows.begin() + 40, rows.begin() + 41, rows.begin() + 60);  // line 62 is late by 19 rows
    rows.push_back("2.0,999");  // late, and its time is taken: repeated, line 103
    const ArrayLog log = parsed(logOf(rows));
    EXPECT_EQ(log.size(), 100U);
    EXPECT_THAT(log.read_report.late_lines, ElementsAre(14U, 62U));
    EXPECT_THAT(log.read_report.repeated_lines, ElementsAre(103U));
    const ArrayLog expected = parsed(logOf(steadyRows(100)));
    EXPECT_TRUE(sameChannels(log, expected));
}

TEST(ArrayLogReader, FivePerCentOfLateRowsAreTheLimit) {
    const auto withLate = [](std::size_t late) {
        std::vector<std::string> rows = steadyRows(100);
        for (std::size_t i = 0; i < late; ++i) std::swap(rows[10 * i], rows[10 * i + 1]);
        return logOf(rows);
    };
    EXPECT_THAT(parsed(withLate(5)).read_report.late_lines, SizeIs(5));
    EXPECT_THAT(errorOf(withLate(6)), HasSubstr("F01.csv:4: 6 of 100 rows are out of order, more than 5 %"));
}

TEST(ArrayLogReader, ClockMayJumpForwardButNotFarBack) {
    std::vector<std::string> rows = steadyRows(100);  // up to 9.9
    rows.push_back("1000.0,1");
    EXPECT_EQ(parsed(logOf(rows)).size(), 101U);
    rows.push_back("940.0,1");
    EXPECT_EQ(parsed(logOf(rows)).size(), 102U);
    rows.back() = "939.9,1";
    EXPECT_THAT(errorOf(logOf(rows)),
                HasSubstr("F01.csv:104: the clock jumps back from 1000 s (line 103) to 939.9 s"));
}

TEST(ArrayLogReader, LogWrittenTwiceIsRefused) {
    std::vector<std::string> rows = steadyRows(20);
    const std::vector<std::string> again = rows;
    rows.insert(rows.end(), again.begin(), again.end());
    EXPECT_THAT(errorOf(logOf(rows)), HasSubstr("out of order"));
}

TEST(ArrayLogReader, AuxiliaryColumnsFollowTheOrderOfTime) {
    std::string text = kFormat + "aux,time_s\n";
    for (int i = 0; i < 40; ++i) {
        const int k = i == 20 ? 21 : i == 21 ? 20 : i;
        text += fmt::format("{},{}\n", 10 * k, k);
    }
    const ArrayLog log = parsed(text);
    for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(log.auxiliary[0].values[i], 10.0 * log.time_s[i]);
}

// ---- cut-off logs ----

TEST(ArrayLogReader, LastRowWithoutLineEndIsDroppedUnlessItsNumberIsWhole) {
    const std::string rows = kFormat + "time_s,range_m\n0.0,1.25\n0.1,1.26\n";
    for (const std::string cut :
         {"0", "0.2", "0.2,", "0.2,1", "0.2,1.", "0.2,1.2", "0.2,-", "0.2,\"1.2", "0.2,1.234"}) {
        const ArrayLog log = parsed(rows + cut);
        EXPECT_EQ(log.size(), 2U) << cut;
        EXPECT_EQ(log.read_report.cut_off_line, 5U) << cut;
        EXPECT_EQ(log.read_report.rows_read, 3U) << cut;
    }
    const ArrayLog whole = parsed(rows + "0.2,1.27");
    EXPECT_EQ(whole.size(), 3U);
    EXPECT_EQ(whole.read_report.cut_off_line, 0U);
    EXPECT_THAT(notesOf(whole), HasSubstr("line 5: the last row has no line end; it is kept"));
}

TEST(ArrayLogReader, NothingIsToldFromNumbersWithVaryingDecimals) {
    EXPECT_EQ(parsed("time_s,range_m\n0,1.2\n1,1.25\n2,1.25").read_report.cut_off_line, 4U);
    EXPECT_EQ(parsed("time_s,range_strength\n0,1000\n1,1001\n2,1002").read_report.cut_off_line, 4U);
}

TEST(ArrayLogReader, OnlyRowCutOffIsNoData) {
    EXPECT_THAT(errorOf("time_s,range_m\n0,1.25"), HasSubstr("F01.csv:2: the only row is cut off"));
}

TEST(ArrayLogReader, TruncationAtEveryByteGivesRowsOfTheWholeLogOrAnError) {
    const ArrayLog whole = parsed(kSmallLog);
    std::size_t errors = 0;
    for (std::size_t length = 0; length < kSmallLog.size(); ++length) {
        const auto log = parse(std::string_view(kSmallLog).substr(0, length));
        if (!log) {
            ++errors;
            EXPECT_FALSE(log.error().message.empty());
            continue;
        }
        ASSERT_LE(log->size(), whole.size());
        for (std::size_t i = 0; i < log->size(); ++i) {
            ASSERT_EQ(log->time_s[i], whole.time_s[i]) << length;
            for (std::size_t c = 0; c < kChannelCount; ++c) {
                const auto channel = static_cast<Channel>(c);
                const double value = log->value(channel, i);
                const double expected = whole.value(channel, i);
                ASSERT_TRUE(value == expected || (!present(value) && !present(expected))) << length;
            }
        }
    }
    const std::size_t first_row_end = kSmallLog.find("1.250\n") + 6;
    EXPECT_EQ(errors, first_row_end);  // every length that ends before the first row does
}

// ---- large logs: blocks ----

TEST(ArrayLogReader, LogsOfManyBlocksAreReadWhole) {
    std::string lf = kFormat + "time_s,range_m,aux\n";
    std::string crlf = lf;
    constexpr std::size_t rows = 60'000;  // of about 20 bytes: more than four blocks
    for (std::size_t i = 0; i < rows; ++i) {
        const std::string row = fmt::format("{:.3f},{:.{}f},{}", 0.001 * static_cast<double>(i),
                                            0.1 * static_cast<double>(i), i % 7, i);
        lf += row + "\n";
        crlf += row + "\r\n";
    }
    ASSERT_GT(lf.size(), 4 * kBlockBytes);
    const ArrayLog log = parsed(lf);
    ASSERT_EQ(log.size(), rows);
    for (std::size_t i = 0; i < rows; ++i) ASSERT_EQ(log.auxiliary[0].values[i], static_cast<double>(i));
    EXPECT_TRUE(sameChannels(parsed(crlf), log));
    std::string cr = lf;
    std::replace(cr.begin(), cr.end(), '\n', '\r');
    EXPECT_TRUE(sameChannels(parsed(cr), log));
    EXPECT_THAT(errorOf(lf + "60.0,abc,1\n"), HasSubstr(fmt::format("F01.csv:{}: column range_m", rows + 3)));
    EXPECT_THAT(errorOf(cr + "60.0,abc,1\r"), HasSubstr(fmt::format("F01.csv:{}: column range_m", rows + 3)));
    EXPECT_THAT(errorOf(crlf + "60.0,abc,1\r\n"),
                HasSubstr(fmt::format("F01.csv:{}: column range_m", rows + 3)));
}

TEST(ArrayLogReader, BlockEndsFallOnEveryPlaceOfALine) {
    // A head whose length grows byte by byte moves the end of the first block through a row and its line end.
    std::string rows;
    for (std::size_t i = 0; rows.size() < kBlockBytes + 1000; ++i) {
        rows += fmt::format("{:.2f},1.5\r\n", 0.01 * static_cast<double>(i));
    }
    const ArrayLog expected = parsed(kFormat + "time_s,range_m\r\n" + rows);
    for (std::size_t padding = 0; padding < 20; ++padding) {
        const std::string head = kFormat + "#" + std::string(padding, '-') + "\ntime_s,range_m\r\n";
        const ArrayLog log = parsed(head + rows);
        ASSERT_TRUE(sameChannels(log, expected)) << padding;
        ASSERT_THAT(errorOf(head + rows + "x,1\n"),
                    HasSubstr(fmt::format("F01.csv:{}:", expected.size() + 4)));
    }
}

TEST(ArrayLogReader, HeaderMayLieBeyondTheFirstBlock) {
    std::string text = kFormat;
    while (text.size() < kBlockBytes + 100) text += "# a comment without a colon\n";
    EXPECT_EQ(parsed(text + "time_s\n0\n1\n").size(), 2U);
}

// ---- files, progress, cancelling ----

TEST(ArrayLogReader, ReadsFilesLikeMemory) {
    const test::TemporaryFolder folder;
    test::writeBytes(folder / "F01.csv", kSmallLog);
    SilentProgress progress;
    const auto log = readArrayLog(folder / "F01.csv", progress, {});
    ASSERT_TRUE(log) << log.error().text();
    EXPECT_EQ(log->file, folder / "F01.csv");
    EXPECT_TRUE(sameChannels(*log, parsed(kSmallLog)));
}

TEST(ArrayLogReader, WhatIsNoRegularFileIsRefusedWithoutWaiting) {
    const test::TemporaryFolder folder;
    SilentProgress progress;
    const auto errorFor = [&](const std::filesystem::path& file) {
        const auto log = readArrayLog(file, progress, {});
        return log ? std::string() : log.error().text();
    };
    EXPECT_THAT(errorFor(folder / "absent.csv"), HasSubstr("absent.csv: no such file"));
    EXPECT_THAT(errorFor(folder.path()), HasSubstr("this is a folder"));
    EXPECT_THAT(errorFor("/dev/zero"), HasSubstr("no regular file"));
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(errorFor(folder / "pipe"), HasSubstr("no regular file"));
    test::writeBytes(folder / "empty.csv", "");
    EXPECT_THAT(errorFor(folder / "empty.csv"), HasSubstr("empty.csv: the file is empty"));
}

TEST(ArrayLogReader, UnreadableFileIsASystemError) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
    const test::TemporaryFolder folder;
    test::writeBytes(folder / "F01.csv", kSmallLog);
    std::filesystem::permissions(folder / "F01.csv", std::filesystem::perms::none);
    SilentProgress progress;
    const auto log = readArrayLog(folder / "F01.csv", progress, {});
    ASSERT_FALSE(log);
    EXPECT_EQ(log.error().kind, ErrorKind::System);
}

class RecordingProgress final : public Progress {
  public:
    explicit RecordingProgress(std::stop_source* stop_at_first = nullptr) : stop_(stop_at_first) {}
    void report(double fraction, std::string_view) override {
        fractions.push_back(fraction);
        if (stop_ != nullptr) stop_->request_stop();
    }
    void message(Severity, std::string_view) override {}
    std::vector<double> fractions;

  private:
    std::stop_source* stop_;
};

std::string logOfSomeBlocks() {
    std::string text = kFormat + "time_s\n";
    for (int i = 0; text.size() < 5 * kBlockBytes; ++i) text += fmt::format("{}\n", i);
    return text;
}

TEST(ArrayLogReader, ProgressRisesToOne) {
    RecordingProgress progress;
    ASSERT_TRUE(parseArrayLog(logOfSomeBlocks(), "F01.csv", progress, {}));
    EXPECT_GE(progress.fractions.size(), 5U);
    EXPECT_TRUE(std::is_sorted(progress.fractions.begin(), progress.fractions.end()));
    EXPECT_NEAR(progress.fractions.back(), 1.0, 1e-12);
}

TEST(ArrayLogReader, StopsBetweenBlocks) {
    std::stop_source stop;
    RecordingProgress progress(&stop);
    const auto log = parseArrayLog(logOfSomeBlocks(), "F01.csv", progress, stop.get_token());
    ASSERT_FALSE(log);
    EXPECT_EQ(log.error().kind, ErrorKind::Cancelled);
    EXPECT_THAT(progress.fractions, SizeIs(1));
}

}  // namespace
}  // namespace terrawalk
