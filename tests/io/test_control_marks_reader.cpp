#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "io/read_survey.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string kHeader = "point,e_m,n_m,u_m,sigma_h_m,sigma_v_m,role\n";
const std::string kTable =
    kHeader + "P01,1.5,-2.5,0.25,0.005,0.008,control\nP02,10,20,-1,0.006,0.009,check\n";

std::string errorOf(std::string_view text) {
    const auto table = parseControlMarks(text, "control.csv");
    return table ? std::string() : table.error().text();
}

TEST(ControlMarksReader, ReadsMarksWithTheirRoles) {
    const auto table = parseControlMarks(kTable, "control.csv");
    ASSERT_TRUE(table) << table.error().text();
    ASSERT_THAT(table->marks, SizeIs(2));
    EXPECT_EQ(table->marks[0].name, "P01");
    EXPECT_EQ(table->marks[0].enu_m, Eigen::Vector3d(1.5, -2.5, 0.25));
    EXPECT_EQ(table->marks[0].sigma_h_m, 0.005);
    EXPECT_EQ(table->marks[0].sigma_v_m, 0.008);
    EXPECT_EQ(table->marks[0].role, MarkRole::Control);
    EXPECT_EQ(table->marks[1].role, MarkRole::Check);
    EXPECT_THAT(table->notes, IsEmpty());
}

TEST(ControlMarksReader, OrderOfColumnsAndLineEndsChangeNothing) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        const std::string text =
            "\xEF\xBB\xBF"
            "# surveyed" +
            end + " role , n_m,e_m,\"point\",u_m,sigma_v_m,sigma_h_m" + end + end +
            "control,-2.5, 1.5 ,\"P01\",0.25,0.008,0.005" + end +
            "check,20,10,P02,-1,0.009,0.006";  // no line end
        const auto table = parseControlMarks(text, "control.csv");
        const auto expected = parseControlMarks(kTable, "control.csv");
        ASSERT_TRUE(table) << table.error().text();
        ASSERT_THAT(table->marks, SizeIs(2));
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_EQ(table->marks[i].name, expected->marks[i].name);
            EXPECT_EQ(table->marks[i].enu_m, expected->marks[i].enu_m);
            EXPECT_EQ(table->marks[i].sigma_h_m, expected->marks[i].sigma_h_m);
            EXPECT_EQ(table->marks[i].role, expected->marks[i].role);
        }
    }
}

TEST(ControlMarksReader, UnknownColumnsAreNoted) {
    const auto table = parseControlMarks(
        "point,e_m,n_m,u_m,sigma_h_m,sigma_v_m,role,remark\nA,1,2,3,0,0,check,\"in, shade\"\n", "c");
    ASSERT_TRUE(table) << table.error().text();
    ASSERT_THAT(table->notes, SizeIs(1));
    EXPECT_THAT(table->notes[0], HasSubstr("line 1: unknown column \"remark\""));
}

TEST(ControlMarksReader, HeaderIsRequiredWithAllColumns) {
    EXPECT_THAT(errorOf(""), HasSubstr("no header row"));
    EXPECT_THAT(errorOf("P01,1,2,3,0,0,control\n"), HasSubstr("control.csv:1: no column point"));
    EXPECT_THAT(errorOf("point,e_m,n_m,u_m,sigma_h_m,sigma_v_m\nP01,1,2,3,0,0\n"),
                HasSubstr("no column role"));
    EXPECT_THAT(errorOf("e_m," + kHeader), HasSubstr("column \"e_m\" stands twice"));
    EXPECT_THAT(errorOf(kHeader), HasSubstr("control.csv:1: no marks"));
}

TEST(ControlMarksReader, BadRowsAreRefusedWithTheirLine) {
    const auto withRow = [](const std::string& row) {
        return errorOf(kTable + row + "\n");
    };
    EXPECT_THAT(withRow("P01,5,5,5,0,0,check"),
                HasSubstr("control.csv:4: mark \"P01\" stands twice, first on line 2"));
    EXPECT_THAT(withRow(",5,5,5,0,0,check"), HasSubstr("has no name"));
    EXPECT_THAT(withRow("P03,nan,5,5,0,0,check"),
                HasSubstr("control.csv:4: column e_m: \"nan\" is no finite number"));
    EXPECT_THAT(withRow("P03,5,,5,0,0,check"), HasSubstr("column n_m: \"\""));
    EXPECT_THAT(withRow("P03,5,5,inf,0,0,check"), HasSubstr("column u_m: \"inf\""));
    EXPECT_THAT(withRow("P03,5,5,5,-0.1,0,check"), HasSubstr("column sigma_h_m: a sigma cannot be negative"));
    EXPECT_THAT(withRow("P03,5,5,5,0,-0.1,check"), HasSubstr("column sigma_v_m: a sigma cannot be negative"));
    EXPECT_THAT(withRow("P03,5,5,5,0,0,"), HasSubstr("column role: \"\" is no role; write control or check"));
    EXPECT_THAT(withRow("P03,5,5,5,0,0,Control"), HasSubstr("\"Control\" is no role"));
    EXPECT_THAT(withRow("P03,5,5,5,0,0"), HasSubstr("6 fields, but the header has 7"));
    EXPECT_THAT(withRow("P03,1,5,5,5,5,5,0,check"), HasSubstr("9 fields"));
    EXPECT_THAT(withRow("P03,540123.4,5,5,0,0,check"), HasSubstr("not map coordinates"));
    EXPECT_THAT(withRow("P03,\"5,5,5,0,0,check"), HasSubstr("quotation mark"));
    EXPECT_THAT(withRow(std::string("P03\0,5,5,5,0,0,check", 20)), HasSubstr("no UTF-8 text"));
    EXPECT_THAT(withRow("P\xFF,5,5,5,0,0,check"), HasSubstr("no UTF-8 text"));
}

TEST(ControlMarksReader, ZeroIsTheZeroPointOnly) {
    const auto table = parseControlMarks(kTable + "ZERO,0,0,0,0,0,control\n", "control.csv");
    ASSERT_TRUE(table) << table.error().text();
    EXPECT_THAT(table->marks, SizeIs(2));
    EXPECT_THAT(table->notes, SizeIs(1));
    EXPECT_THAT(errorOf(kTable + "ZERO,0,0,0.1,0,0,control\n"),
                HasSubstr("control.csv:4: ZERO is the zero point"));
    EXPECT_THAT(errorOf(kTable + "ZERO,0,0,0,0,0,check\n"), HasSubstr("ZERO is the zero point"));
}

TEST(ControlMarksReader, TruncationAtEveryByteGivesWholeMarksOrAnError) {
    for (std::size_t length = 0; length < kTable.size(); ++length) {
        const auto table = parseControlMarks(std::string_view(kTable).substr(0, length), "control.csv");
        if (table) {
            EXPECT_THAT(table->marks, SizeIs(testing::AnyOf(1, 2))) << length;
            EXPECT_EQ(table->marks[0].enu_m, Eigen::Vector3d(1.5, -2.5, 0.25));
        } else {
            EXPECT_FALSE(table.error().message.empty());
        }
    }
}

TEST(ControlMarksReader, FileMustBeAFileOfSensibleSize) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(readControlMarks(folder / "absent.csv").error().text(), HasSubstr("no such file"));
    EXPECT_THAT(readControlMarks(folder.path()).error().text(), HasSubstr("this is a folder"));
    EXPECT_THAT(readControlMarks("/dev/zero").error().text(), HasSubstr("no regular file"));
    test::writeBytes(folder / "large.csv", "");
    std::filesystem::resize_file(folder / "large.csv", (std::uintmax_t{64} << 20U) + 1);
    EXPECT_THAT(readControlMarks(folder / "large.csv").error().text(), HasSubstr("larger than 64 MB"));
}

}  // namespace
}  // namespace terrawalk
