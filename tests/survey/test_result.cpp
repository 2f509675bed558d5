#include <gtest/gtest.h>

#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {
namespace {

TEST(Error, NamesFileLineCauseAndCure) {
    const auto error = badData("'x' is not a number", "logs/F01.csv", 17, "leave the field empty").value();
    EXPECT_EQ(error.text(), "logs/F01.csv:17: 'x' is not a number; leave the field empty");
}

TEST(Error, IsOneLineWithoutControlCodesWhateverAFileHolds) {
    const auto text = badData("field '\x1b[31m\n\xff\xc3(\xc3\xa9'").value().text();
    EXPECT_EQ(text, "field '\\x1b[31m\\x0a\\xff\\xc3(\xc3\xa9'");
}

TEST(Survey, KnowsTheZeroMarkAndItsOwn) {
    Survey survey;
    survey.marks.push_back({.name = "P01", .enu_m = {1, 2, 3}, .role = MarkRole::Check});
    EXPECT_EQ(survey.findMark("ZERO")->enu_m.norm(), 0.0);
    EXPECT_EQ(survey.findMark("P01")->role, MarkRole::Check);
    EXPECT_FALSE(survey.findMark("P02"));
}

}  // namespace
}  // namespace terrawalk
