#include "io/chinese_page.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "io/markup_text.hpp"
#include "survey/chinese_words.hpp"

namespace terrawalk {

namespace {

/// The reverse of escapedMarkup().
std::string unescaped(std::string_view markup) {
    constexpr std::array<std::pair<std::string_view, char>, 5> kEntities{
        {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}}};
    std::string text;
    while (!markup.empty()) {
        const auto* const entity = std::find_if(kEntities.begin(), kEntities.end(),
                                                [&](const auto& e) { return markup.starts_with(e.first); });
        const bool found = entity != kEntities.end();
        text += found ? entity->second : markup.front();
        markup.remove_prefix(found ? entity->first.size() : 1);
    }
    return text;
}

std::string chinese(std::string_view markup) {
    // Statements of ASPRS and NSSDA begin so; their wording is the standards' own.
    constexpr std::string_view kPrescribed = "Tested ";
    const std::string english = unescaped(markup);
    const std::string words = inChinese(english);
    if (words == english) return std::string(markup);
    return escapedMarkup(english.starts_with(kPrescribed) ? words + "\uff08" + english + "\uff09" : words);
}

/// A tag with what readers hear of a drawing.
std::string chineseTag(std::string_view tag) {
    constexpr std::string_view kLabel = "aria-label=\"", kLanguage = "lang=\"en\"";
    std::string out(tag);
    if (const std::size_t at = tag.find(kLabel); at != std::string_view::npos) {
        const std::size_t begin = at + kLabel.size(), end = tag.find('"', begin);
        out.replace(begin, end - begin, chinese(tag.substr(begin, end - begin)));
    }
    if (const std::size_t at = tag.find(kLanguage); at != std::string_view::npos)
        out.replace(at, kLanguage.size(), "lang=\"zh-CN\"");
    return out;
}

/// Whether what stands in an element stays as it is.
bool stays(std::string_view tag) {
    return tag.starts_with("<style") || tag.find(" translate=\"no\"") != std::string_view::npos;
}

}  // namespace

std::string chinesePage(std::string_view page) {
    std::string out;
    bool as_it_is = false;
    while (!page.empty()) {
        const bool is_tag = page.front() == '<';
        const std::size_t end = is_tag ? page.find('>') + 1 : std::min(page.find('<'), page.size());
        const std::string_view part = page.substr(0, end);
        if (is_tag) {
            as_it_is = stays(part);
            out += chineseTag(part);
        } else {
            out += as_it_is ? std::string(part) : chinese(part);
        }
        page.remove_prefix(end);
    }
    return out;
}

}  // namespace terrawalk
