#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "survey/result.hpp"

namespace terrawalk {

/// A value of a JSON text, with the line on which it stands.
struct JsonNode {
    enum class Type { Null, Boolean, Number, String, Array, Object };
    Type type = Type::Null;
    std::size_t line = 0;
    bool boolean = false;
    double number = 0.0;
    std::string text;                ///< of a string
    std::vector<JsonNode> elements;  ///< of an array or an object
    std::vector<std::string> keys;   ///< of an object: keys[i] belongs to elements[i]

    /// The member of that key; null when there is none.
    [[nodiscard]] const JsonNode* find(std::string_view key) const;
};

/// Reads a JSON text (UTF-8). Errors: BadData with the line, for what is no JSON, for a key that stands twice
/// in an object, for more than 32 levels and for more than a million values.
[[nodiscard]] Result<JsonNode> parseJson(std::string_view text, const std::filesystem::path& file);

}  // namespace terrawalk
