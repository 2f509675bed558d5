#include "survey/chinese_words.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "resources/resources.hpp"

namespace terrawalk {

namespace {

using Words = std::map<std::string, std::string, std::less<>>;

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}
bool isLower(char c) {
    return c >= 'a' && c <= 'z';
}

bool hasLetters(std::string_view text) {
    return std::any_of(text.begin(), text.end(), isLower);
}

// ---------------------------------------------------------------------------------------------- the table

std::string plain(std::string_view markup) {
    constexpr std::array<std::pair<std::string_view, char>, 5> kEntities{
        {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};
    std::string text;
    while (!markup.empty()) {
        const auto* const entity = std::find_if(kEntities.begin(), kEntities.end(),
                                                [&](const auto& e) { return markup.starts_with(e.first); });
        if (entity == kEntities.end()) {
            text += markup.front();
            markup.remove_prefix(1);
        } else {
            text += entity->second;
            markup.remove_prefix(entity->first.size());
        }
    }
    return text;
}

/// What stands between two tags, which are cut off the front with it.
std::string element(std::string_view& rest, std::string_view open, std::string_view close) {
    rest.remove_prefix(std::min(rest.find(open), rest.size()));
    if (rest.empty()) return {};
    rest.remove_prefix(open.size());
    const std::size_t end = rest.find(close);
    const std::string text = plain(rest.substr(0, end));
    rest.remove_prefix(std::min(end, rest.size()));
    return text;
}

Words readTable() {
    std::string_view rest = resources::chinese_texts;
    rest.remove_prefix(rest.find("<name>Report</name>"));
    rest = rest.substr(0, rest.find("</context>"));
    Words table;
    while (!rest.empty()) {
        std::string english = element(rest, "<source>", "</source>");
        std::string chinese = element(rest, "<translation>", "</translation>");
        if (!english.empty()) table.emplace(std::move(english), std::move(chinese));
    }
    return table;
}

const Words& table() {
    static const Words words = readTable();
    return words;
}

// ---------------------------------------------------------------------------------------------- sentences

/// A sentence with places for numbers and names, "%1 of %2".
struct Pattern {
    std::vector<std::string> texts;  ///< before, between and after the places
    std::vector<int> places;
    std::string_view chinese;
    std::size_t length = 0;
    bool counts = false;  ///< its only place takes nothing but a number
};

bool isPlace(std::string_view text, std::size_t at) {
    return text[at] == '%' && at + 1 < text.size() && isDigit(text[at + 1]);
}

/// "30 check marks": only a number makes it one.
bool isCount(std::string_view source) {
    constexpr std::array<std::string_view, 8> kCounts{"%1 mark",          "%1 check mark", "%1 control mark",
                                                      "%1 comparison",    "%1 marks",      "%1 check marks",
                                                      "%1 control marks", "%1 comparisons"};
    return std::find(kCounts.begin(), kCounts.end(), source) != kCounts.end();
}

std::vector<Pattern> readPatterns() {
    std::vector<Pattern> patterns;
    for (const auto& [english, chinese] : table()) {
        Pattern pattern{{""}, {}, chinese, english.size(), isCount(english)};
        for (std::size_t at = 0; at < english.size(); ++at) {
            if (!isPlace(english, at)) {
                pattern.texts.back() += english[at];
                continue;
            }
            pattern.places.push_back(english[++at] - '0');
            pattern.texts.emplace_back();
        }
        const bool says_something = std::any_of(pattern.texts.begin(), pattern.texts.end(), hasLetters);
        if (!pattern.places.empty() && says_something) patterns.push_back(std::move(pattern));
    }
    // The longest says the most; of equals the one with more places.
    std::stable_sort(patterns.begin(), patterns.end(), [](const Pattern& a, const Pattern& b) {
        return std::pair(a.length, a.places.size()) > std::pair(b.length, b.places.size());
    });
    return patterns;
}

const std::vector<Pattern>& patterns() {
    static const std::vector<Pattern> all = readPatterns();
    return all;
}

using Found = std::vector<std::string_view>;

/// What stands in the places from `place` on, each as short as can be; `rest` begins with the place.
bool findPlaces(const Pattern& pattern, std::size_t place, std::string_view rest, Found& found) {
    const std::string& next = pattern.texts[place + 1];
    if (place + 1 == pattern.places.size()) {
        if (rest.size() <= next.size() || !rest.ends_with(next)) return false;
        found.push_back(rest.substr(0, rest.size() - next.size()));
        return true;
    }
    for (std::size_t at = rest.find(next, 1); at != std::string_view::npos; at = rest.find(next, at + 1)) {
        found.push_back(rest.substr(0, at));
        if (findPlaces(pattern, place + 1, rest.substr(at + next.size()), found)) return true;
        found.pop_back();
    }
    return false;
}

bool isNumber(std::string_view text) {
    constexpr std::string_view kGroupGap = "\u202F";
    while (!text.empty()) {
        const bool gap = text.starts_with(kGroupGap);
        if (!gap && !isDigit(text.front()) && text.front() != '.') return false;
        text.remove_prefix(gap ? kGroupGap.size() : 1);
    }
    return true;
}

/// Chinese is written without blanks: those around what was put in go, but for numbers and Latin letters.
std::string withoutBlanksInChinese(std::string_view sentence) {
    constexpr std::size_t kWideBytes = 3;
    const auto is_wide = [&](std::size_t at) {
        return at < sentence.size() && static_cast<unsigned char>(sentence[at]) >= 0xE3;
    };
    std::string out;
    for (std::size_t at = 0; at < sentence.size(); ++at) {
        if (sentence[at] == ' ' && at >= kWideBytes && is_wide(at - kWideBytes) && is_wide(at + 1)) continue;
        out += sentence[at];
    }
    return out;
}

std::optional<std::string> translated(std::string_view english, int depth);

std::string translatedOrSame(std::string_view english, int depth) {
    return translated(english, depth).value_or(std::string(english));
}

std::optional<std::string> bySentence(std::string_view english, int depth) {
    for (const Pattern& pattern : patterns()) {
        if (!english.starts_with(pattern.texts.front()) || !english.ends_with(pattern.texts.back())) continue;
        Found found;
        if (!findPlaces(pattern, 0, english.substr(pattern.texts.front().size()), found)) continue;
        if (pattern.counts && !isNumber(found.front())) continue;
        std::string sentence;
        for (std::size_t at = 0; at < pattern.chinese.size(); ++at) {
            if (!isPlace(pattern.chinese, at)) {
                sentence += pattern.chinese[at];
                continue;
            }
            const int place = pattern.chinese[++at] - '0';
            const auto which = std::find(pattern.places.begin(), pattern.places.end(), place);
            if (which == pattern.places.end()) continue;
            sentence +=
                translatedOrSame(found[static_cast<std::size_t>(which - pattern.places.begin())], depth + 1);
        }
        return withoutBlanksInChinese(sentence);
    }
    return std::nullopt;
}

// ---------------------------------------------------------------------------------------------- joined texts

/// Whether two words of small letters follow one another: more than a name, a unit or a code.
bool isProse(std::string_view text) {
    bool word_before = false;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        const bool is_word = !word.empty() && std::all_of(word.begin(), word.end(), isLower);
        if (is_word && word_before) return true;
        word_before = is_word;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return false;
}

/// "weak return 12": words with their count.
std::optional<std::string> byCount(std::string_view english, int depth) {
    const std::size_t blank = english.rfind(' ');
    if (blank == std::string_view::npos || !isNumber(english.substr(blank + 1))) return std::nullopt;
    const auto words = translated(english.substr(0, blank), depth + 1);
    return words ? std::optional(*words + std::string(english.substr(blank))) : std::nullopt;
}

/// What joins parts: a colon once, the others again and again.
struct Joint {
    std::string_view english, chinese;
    bool once;
};

/// Parts that are joined, where each is known or no prose, and one at least is known.
std::optional<std::string> byParts(std::string_view english, const Joint& joint, int depth) {
    std::string sentence;
    bool any = false;
    for (std::string_view rest = english;;) {
        const std::size_t end =
            joint.once && !sentence.empty() ? std::string_view::npos : rest.find(joint.english);
        const std::string_view part = rest.substr(0, end);
        const auto known = translated(part, depth + 1);
        if (!known && isProse(part)) return std::nullopt;
        any = any || known;
        sentence += known.value_or(std::string(part));
        if (end == std::string_view::npos) break;
        sentence += joint.chinese;
        rest.remove_prefix(end + joint.english.size());
    }
    return any ? std::optional(sentence) : std::nullopt;
}

std::optional<std::string> joined(std::string_view english, int depth) {
    constexpr std::array<Joint, 3> kJoints{{{": ", "：", true}, {"; ", "；", false}, {", ", "，", false}}};
    for (const Joint& joint : kJoints) {
        if (english.find(joint.english) == std::string_view::npos) continue;
        if (auto sentence = byParts(english, joint, depth)) return sentence;
    }
    return byCount(english, depth);
}

/// Nothing where the text is not known.
std::optional<std::string> translated(std::string_view english, int depth) {
    constexpr int kDeepest = 4;
    if (const auto known = table().find(english); known != table().end()) return known->second;
    if (depth > kDeepest || !hasLetters(english)) return std::nullopt;
    if (auto sentence = bySentence(english, depth)) return sentence;
    if (auto sentence = joined(english, depth)) return sentence;
    if (english.ends_with('.')) {
        auto sentence = translated(english.substr(0, english.size() - 1), depth);
        return sentence ? std::optional(*sentence + "。") : std::nullopt;
    }
    // What begins a heading or a sentence here may stand within one elsewhere.
    if (english.front() < 'A' || english.front() > 'Z') return std::nullopt;
    std::string small(english);
    small.front() = static_cast<char>(small.front() - 'A' + 'a');
    return translated(small, depth + 1);
}

}  // namespace

std::string inChinese(std::string_view english) {
    return translatedOrSame(english, 0);
}

}  // namespace terrawalk
