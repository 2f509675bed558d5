#pragma once

#include <QString>

namespace terrawalk::gui {

/// The name of a setting in the language of the window; as it is where that has none.
[[nodiscard]] QString settingWords(const QString& english);

}  // namespace terrawalk::gui
