#pragma once

#include <QString>
#include <string_view>

#include "survey/result.hpp"

namespace terrawalk::gui {

/// What the core says, in the window's language: words, steps of work, and sentences with numbers and names
/// in them. What is not known to it stays as it is.
[[nodiscard]] QString reportWords(std::string_view words);

/// An error in the window's language, as Error::text() has it: "file:line: message; cure".
[[nodiscard]] QString errorWords(const Error& error);

}  // namespace terrawalk::gui
