#include "tests/gui/core_sentences.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string_view>

namespace terrawalk::test {

namespace fs = std::filesystem;

namespace {

enum class Kind { Word, Text, Sign };
struct Token {
    Kind kind;
    std::string text;
};

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Of a character above U+007F.
std::string utf8(unsigned long code) {
    const auto six_bits = [code](int shift) {
        return static_cast<char>(0x80U | ((code >> shift) & 0x3FU));
    };
    if (code < 0x800) return {static_cast<char>(0xC0U | (code >> 6U)), six_bits(0)};
    return {static_cast<char>(0xE0U | (code >> 12U)), six_bits(6), six_bits(0)};
}

/// What stands between the quotation marks that begin at `at`, which moves behind them.
std::string quoted(std::string_view source, std::size_t& at) {
    const char mark = source[at++];
    std::string text;
    while (at < source.size() && source[at] != mark) {
        if (source[at] != '\\') {
            text += source[at++];
        } else if (source[at + 1] == 'u') {
            text += utf8(std::stoul(std::string(source.substr(at + 2, 4)), nullptr, 16));
            at += 6;
        } else {
            text += source[at + 1];
            at += 2;
        }
    }
    ++at;
    return text;
}

/// Comments and preprocessor lines left out, texts side by side joined.
std::vector<Token> tokensOf(std::string_view source) {
    std::vector<Token> tokens;
    for (std::size_t at = 0; at < source.size();) {
        const char c = source[at];
        const bool line_start = at == 0 || source[at - 1] == '\n';
        if (source.substr(at, 2) == "//" || (c == '#' && line_start)) {
            at = std::min(source.find('\n', at), source.size());
        } else if (c == '"') {
            std::string text = quoted(source, at);
            if (!tokens.empty() && tokens.back().kind == Kind::Text) {
                tokens.back().text += text;
            } else {
                tokens.push_back({Kind::Text, std::move(text)});
            }
        } else if (c == '\'') {
            tokens.push_back({Kind::Sign, quoted(source, at)});
        } else if (isWordCharacter(c)) {
            std::string word;
            // A digit may hold a quotation mark: 10'000.
            while (at < source.size() &&
                   (isWordCharacter(source[at]) ||
                    (source[at] == '\'' && std::isdigit(static_cast<unsigned char>(word.front())) != 0)))
                word += source[at++];
            tokens.push_back({Kind::Word, std::move(word)});
        } else {
            if (std::isspace(static_cast<unsigned char>(c)) == 0)
                tokens.push_back({Kind::Sign, std::string(1, c)});
            ++at;
        }
    }
    return tokens;
}

/// Functions, lambdas and types that make errors, notes and warnings of the texts that they are given.
bool makesSentences(const Token& token) {
    constexpr std::array<std::string_view, 16> kMakers{
        "badData", "usageError", "systemError", "Error",    "bad",  "refused", "refuse",  "failed",
        "fail",    "problem",    "noteAt",      "noteHeld", "note", "warn",    "warning", "push_back"};
    return token.kind == Kind::Word && std::find(kMakers.begin(), kMakers.end(), token.text) != kMakers.end();
}

bool isSign(const Token& token, std::string_view signs) {
    return token.kind == Kind::Sign && token.text.size() == 1 &&
           signs.find(token.text.front()) != std::string_view::npos;
}

bool hasTwoWords(const std::string& text) {
    static const std::regex words("[a-z]{2,}[,:;]? [a-z{]");
    return std::regex_search(text, words);
}

/// Behind the bracket that closes the one at `open`.
std::size_t behindBrackets(const std::vector<Token>& tokens, std::size_t open) {
    int depth = 0;
    std::size_t at = open;
    do {
        if (isSign(tokens[at], "({")) ++depth;
        if (isSign(tokens[at], ")}")) --depth;
        ++at;
    } while (depth > 0 && at < tokens.size());
    return at;
}

std::vector<std::string> sentencesIn(const std::vector<Token>& tokens) {
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        if (!makesSentences(tokens[i]) || !isSign(tokens[i + 1], "({")) continue;
        const std::size_t end = behindBrackets(tokens, i + 1);
        const auto first = tokens.begin() + static_cast<std::ptrdiff_t>(i),
                   last = tokens.begin() + static_cast<std::ptrdiff_t>(end);
        // A definition, not a call.
        if (std::any_of(first, last, [](const Token& t) { return isSign(t, ";"); })) continue;
        for (std::size_t k = i + 1; k + 1 < end; ++k) {
            if (tokens[k].kind != Kind::Text) continue;
            std::string text = tokens[k].text;
            if (isSign(tokens[k - 1], "+")) text = "{}" + text;
            if (isSign(tokens[k + 1], "+")) text += "{}";
            if (hasTwoWords(text)) sentences.push_back(std::move(text));
        }
    }
    return sentences;
}

}  // namespace

std::vector<CoreSentence> coreSentences(const fs::path& sources) {
    std::vector<fs::path> files;
    for (const char* folder : {"survey", "fusion", "mapping", "io", "app/pipeline"}) {
        for (const auto& entry : fs::directory_iterator(sources / folder)) {
            const auto extension = entry.path().extension();
            if (extension == ".cpp" || extension == ".hpp") files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    std::vector<CoreSentence> all;
    std::set<std::string> met;
    for (const fs::path& file : files) {
        std::ifstream stream(file);
        const std::string source{std::istreambuf_iterator<char>(stream), {}};
        for (std::string& text : sentencesIn(tokensOf(source))) {
            if (met.insert(text).second) all.push_back({fs::relative(file, sources), std::move(text)});
        }
    }
    return all;
}

std::string withExamples(const std::string& sentence) {
    std::string out;
    int places = 0;
    for (std::size_t at = 0; at < sentence.size(); ++at) {
        if (sentence[at] != '{') {
            out += sentence[at];
            continue;
        }
        const std::size_t close = sentence.find('}', at);
        const bool number = sentence.substr(at, close - at).find_first_of("fgd") != std::string::npos;
        out += number ? std::to_string(++places) + ".25" : "X" + std::to_string(++places);
        at = std::min(close, sentence.size() - 1);
    }
    return out;
}

}  // namespace terrawalk::test
