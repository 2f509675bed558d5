#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace terrawalk {

/// A number above zero.
inline CLI::Validator aboveZero() {
    return {[](const std::string& text) {
                double value = 0.0;
                return CLI::detail::lexical_cast(text, value) && value > 0.0
                           ? std::string()
                           : "must be above zero, not " + text;
            },
            "POSITIVE"};
}

/// Takes one of some names, in any case, and tells all of them otherwise.
template <class Enum>
CLI::Validator oneOf(const std::map<std::string, Enum>& by_name, const std::string& list) {
    return {[by_name, list](std::string& text) {
                const auto found = by_name.find(CLI::detail::to_lower(text));
                if (found == by_name.end()) return "must be one of " + list + ", not " + text;
                text = std::to_string(static_cast<std::underlying_type_t<Enum>>(found->second));
                return std::string();
            },
            "NAME"};
}

/// An option that takes one of some names.
template <class Enum, std::size_t n>
CLI::Option* addChoice(CLI::App& command, const std::string& option, Enum& value,
                       const std::array<std::pair<Enum, std::string_view>, n>& names,
                       const std::string& meaning) {
    std::map<std::string, Enum> by_name;
    std::string list;
    for (const auto& [choice, text] : names) {
        by_name.emplace(text, choice);
        list += (list.empty() ? "" : ", ") + std::string(text);
    }
    return command.add_option(option, value, meaning + ": " + list)
        ->transform(oneOf(by_name, list))
        ->option_text("NAME [" + std::string(name(value)) + "]");
}

/// An option that takes several of some names, with commas between them.
template <class Enum, std::size_t n>
CLI::Option* addChoices(CLI::App& command, const std::string& option, std::vector<Enum>& values,
                        const std::array<std::pair<Enum, std::string_view>, n>& names,
                        const std::string& meaning) {
    std::map<std::string, Enum> by_name;
    std::string list;
    for (const auto& [choice, text] : names) {
        by_name.emplace(text, choice);
        list += (list.empty() ? "" : ", ") + std::string(text);
    }
    return command.add_option(option, values, meaning + ": " + list)
        ->transform(oneOf(by_name, list))
        ->delimiter(',')
        ->allow_extra_args(false)
        ->option_text("NAME,...");
}

}  // namespace terrawalk
