#pragma once

#include <QString>
#include <QStringList>

namespace terrawalk::gui {

/// The name of a setting in the language of the window; as it is where that has none.
[[nodiscard]] QString settingWords(const QString& english);
/// What a setting means, in that language.
[[nodiscard]] QString settingMeaning(const QString& key);
/// A value that can be chosen, as a person says it, e.g. "Natural neighbour" for "natural-neighbour".
[[nodiscard]] QString choiceWords(const QString& value);

/// Of the groups that settings stand in, in their order: the key up to its last dot.
[[nodiscard]] QStringList settingPrefixes();
[[nodiscard]] QString settingPrefix(const QString& key);
/// A group's heading.
[[nodiscard]] QString settingGroupWords(const QString& prefix);
/// All that a person may look for a setting by, in lower case: key, name, meaning and heading, in both
/// languages.
[[nodiscard]] QString settingSearchText(const QString& key);

}  // namespace terrawalk::gui
