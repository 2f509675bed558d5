#include "io/text_input.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "io/json_node.hpp"
#include "io/short_decimal.hpp"

namespace terrawalk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

double correctlyRounded(const std::string& text) {
    double value = std::nan("");
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

TEST(ShortDecimal, EqualsCorrectlyRoundedParsingBitByBit) {
    std::mt19937_64 random(20240517);
    std::size_t taken = 0;
    for (int i = 0; i < 300'000; ++i) {
        std::string text = random() % 2 == 0 ? "-" : "";
        const std::size_t whole = random() % 11;
        const std::size_t decimals = random() % 11 + (whole == 0 ? 1 : 0);
        for (std::size_t k = 0; k < whole; ++k) text += static_cast<char>('0' + random() % 10);
        if (decimals > 0) text += '.';
        for (std::size_t k = 0; k < decimals; ++k) text += static_cast<char>('0' + random() % 10);
        double value = 0.0;
        const char* const end = readShortDecimal(text.c_str(), value);
        if (end == nullptr) continue;  // too many digits to be exact
        ++taken;
        ASSERT_EQ(end, text.c_str() + text.size()) << text;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(correctlyRounded(text)))
            << text;
    }
    EXPECT_GT(taken, 200'000U);
}

TEST(ShortDecimal, LeavesToOthersWhatIsNotExactOrNoNumber) {
    double value = 0.0;
    EXPECT_NE(readShortDecimal("9007199254740992", value), nullptr);  // 2^53
    EXPECT_EQ(readShortDecimal("9007199254740993", value), nullptr);
    EXPECT_EQ(readShortDecimal("00000000000000000001", value), nullptr);  // 20 digits
    EXPECT_NE(readShortDecimal("0.000000000000000001", value), nullptr);
    EXPECT_EQ(value, 1e-18);
    for (const char* text : {"", "-", ".", "-.", "x", "+1", "e5", " 1"}) {
        EXPECT_EQ(readShortDecimal(text, value), nullptr) << text;
    }
}

TEST(ParseNumber, TakesTheWholeTextOrNothing) {
    EXPECT_EQ(parseNumber("1.25"), 1.25);
    EXPECT_EQ(parseNumber("+1e3"), 1000.0);
    for (const char* text : {"", "+", "+-1", "1,5", "1.0x", " 1", "nan", "inf", "1e999", "0x1"}) {
        EXPECT_FALSE(parseNumber(text)) << text;
    }
}

TEST(SplitCsvLine, FollowsQuotesAndTrimsBlanks) {
    EXPECT_THAT(*splitCsvLine(" a ,\"b, \"\"c\"\"\" ,,d e"), ElementsAre("a", "b, \"c\"", "", "d e"));
    EXPECT_THAT(*splitCsvLine(""), ElementsAre(""));
    EXPECT_THAT(*splitCsvLine("5\" nail,\"a\"b"), ElementsAre("5\" nail", "\"a\"b"));
    EXPECT_FALSE(splitCsvLine("a,\"b"));
}

TEST(Utf8, IsToldFromOtherBytes) {
    for (const char* text : {"", "plain", "h\xC3\xB6he", "\xE9\xAB\x98", "\xF0\x9F\x8C\x8D"})
        EXPECT_TRUE(isUtf8(text));
    for (const char* text :
         {"\xF6", "\xC0\xAF", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE9\xAB", "\xFF"}) {
        EXPECT_FALSE(isUtf8(text));
    }
}

TEST(InQuotes, CutsLongTextBetweenCharacters) {
    EXPECT_EQ(inQuotes("abc"), "\"abc\"");
    std::string text(39, 'a');
    text +=
        "\xC3\xB6"
        "bc";
    EXPECT_EQ(inQuotes(text), fmt::format("\"{}...\"", std::string(39, 'a')));
    EXPECT_LE(inQuotes(std::string(1000, '\x80')).size(), 45U);
}

TEST(Json, KnowsTheLineOfEveryValue) {
    const auto root =
        parseJson("{\n\"a\": 1,\r\n\"b\": [true,\n  2.5\n , \"x\"],\r\"c\": {\"d\":\nnull}\n}\n", "p.json");
    ASSERT_TRUE(root) << root.error().text();
    EXPECT_EQ(root->line, 1U);
    EXPECT_EQ(root->find("a")->line, 2U);
    const JsonNode& list = *root->find("b");
    EXPECT_EQ(list.line, 3U);
    EXPECT_EQ(list.elements[0].line, 3U);
    EXPECT_EQ(list.elements[1].line, 4U);
    EXPECT_EQ(list.elements[2].line, 5U);
    EXPECT_EQ(root->find("c")->line, 6U);
    EXPECT_EQ(root->find("c")->find("d")->line, 7U);
    EXPECT_EQ(root->find("absent"), nullptr);
}

TEST(Json, ErrorsNameTheLine) {
    const auto errorOf = [](std::string_view text) {
        const auto root = parseJson(text, "p.json");
        return root ? std::string() : root.error().text();
    };
    EXPECT_THAT(errorOf(""), HasSubstr("p.json:1: no valid JSON: syntax error"));
    EXPECT_THAT(errorOf("{\n\"a\": 1,\n}"), HasSubstr("p.json:3: no valid JSON: syntax error"));
    EXPECT_THAT(errorOf("{\"a\": 1}\n x"), HasSubstr("p.json:2: no valid JSON"));
    EXPECT_THAT(errorOf("[1e999]"), HasSubstr("p.json:1: no valid JSON: number overflow"));
    EXPECT_THAT(errorOf("[\"\xFF\"]"), HasSubstr("p.json:1: no valid JSON"));
    EXPECT_THAT(errorOf("{\"a\": 1,\n\"a\": 2}"), HasSubstr("p.json:2: the key \"a\" stands twice"));
}

TEST(Json, DepthAndSizeAreLimited) {
    EXPECT_TRUE(parseJson(std::string(32, '[') + std::string(32, ']'), "p.json"));
    EXPECT_FALSE(parseJson(std::string(33, '[') + std::string(33, ']'), "p.json"));
    std::string deep_object;
    for (int i = 0; i < 100'000; ++i) deep_object += "{\"a\":";
    for (const std::string& text :
         {std::string(100'000, '['), std::string(100'000, '[') + std::string(100'000, ']'), deep_object}) {
        const auto root = parseJson(text, "p.json");
        ASSERT_FALSE(root);
        EXPECT_THAT(root.error().text(), HasSubstr("nested too deeply"));
    }
    std::string many = "[0";
    for (int i = 0; i < 1'000'000; ++i) many += ",0";
    EXPECT_FALSE(parseJson(many + "]", "p.json"));
}

}  // namespace
}  // namespace terrawalk
