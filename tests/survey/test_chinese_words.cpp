#include <gtest/gtest.h>

#include "survey/chinese_words.hpp"

namespace terrawalk {
namespace {

TEST(ChineseWords, FindsWordsAndSentencesWithNumbersAndNames) {
    EXPECT_EQ(inChinese("before fusion"), "融合前");
    EXPECT_EQ(inChinese("Before fusion"), "融合前");
    EXPECT_EQ(inChinese("30 check marks"), "30 个检核点");
    EXPECT_EQ(inChinese("no GNSS position for 12 s"), "有 12 s 没有 GNSS 位置");
    // What stands in a place is looked up too, and no blank parts it from what follows.
    EXPECT_EQ(inChinese("heading missing in 3 of 259 epochs; the last value is held"),
              "航向在 259 个历元中缺失 3 个；沿用前值");
}

TEST(ChineseWords, TakesJoinedTextsApart) {
    EXPECT_EQ(inChinese("range too long 12, weak return 5"), "测距过长 12，回波弱 5");
    EXPECT_EQ(inChinese("S01: no GNSS position for 12 s"), "S01：有 12 s 没有 GNSS 位置");
    EXPECT_EQ(inChinese("C01, fused: +0.012 m"), "C01，融合后：+0.012 m");
    EXPECT_EQ(inChinese("No GNSS position for 12 s (runs F01, F02)."),
              "有 12 s 没有 GNSS 位置（测线 F01, F02）。");
}

TEST(ChineseWords, LeavesWhatItDoesNotKnow) {
    for (const char* text : {"", "S01", "12.5", "F01, F02", "Terraced mango orchard", "a: b; c, d", "%1",
                             "a sentence that nobody knows", "surface, of a kind"}) {
        EXPECT_EQ(inChinese(text), text);
    }
}

}  // namespace
}  // namespace terrawalk
