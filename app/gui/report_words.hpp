#pragma once

#include <QString>
#include <string_view>

namespace terrawalk::gui {

/// A word or label of the reports in the window's language; what is not known to it stays as it is.
[[nodiscard]] QString reportWords(std::string_view words);

}  // namespace terrawalk::gui
