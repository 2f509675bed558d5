#pragma once

#include <QString>

class QCoreApplication;

namespace terrawalk::gui {

/// Makes a language, "en" or "zh_CN", that of all texts made from now on. Others: English.
void applyLanguage(const QString& language);
/// What was chosen last, or what the system speaks.
[[nodiscard]] QString preferredLanguage();

}  // namespace terrawalk::gui
