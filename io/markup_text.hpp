#pragma once

#include <string>
#include <string_view>

namespace terrawalk {

/// Text as it may stand in HTML, SVG and XML, in elements and in quoted attributes. Markup is escaped. Bytes
/// that are no UTF-8, control characters and marks that turn the direction of writing become U+FFFD: names
/// come from files of anybody.
[[nodiscard]] std::string escapedMarkup(std::string_view text);

/// The first `most` characters (not bytes) of UTF-8 text, with an ellipsis where something was cut.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t most);

/// The number of characters, near enough to judge the room that text takes.
[[nodiscard]] std::size_t characterCount(std::string_view text);

/// Fixed decimals with a true minus sign, never a negative zero; an en dash where the value is not finite.
[[nodiscard]] std::string fixedDecimals(double value, int decimals);

/// Whole numbers in groups of three, parted by narrow no-break spaces.
[[nodiscard]] std::string groupedDigits(std::size_t value);

/// A field of a CSV file, quoted where RFC 4180 asks for it.
[[nodiscard]] std::string csvField(std::string_view text);

/// Bytes as base64 text, RFC 4648, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace terrawalk
