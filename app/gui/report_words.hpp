#pragma once

#include <QString>
#include <string_view>

namespace terrawalk::gui {

/// What the core says, in the window's language: words, steps of work, and sentences with numbers and names
/// in them. What is not known to it stays as it is.
[[nodiscard]] QString reportWords(std::string_view words);

}  // namespace terrawalk::gui
