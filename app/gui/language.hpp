#pragma once

#include <QString>
#include <QStringList>

#include "survey/survey_report.hpp"

class QCoreApplication;

namespace terrawalk::gui {

/// Makes a language, "en" or "zh_CN", that of all texts made from now on. Others: English.
void applyLanguage(const QString& language);
/// A text of a context in Chinese, whatever the language of the window; empty where there is none.
[[nodiscard]] QString chineseOf(const char* context, const QString& english);
/// Sentences one after the other, with the space between them that the window's language has; empty ones are
/// left out.
[[nodiscard]] QString joinSentences(const QStringList& sentences);
/// What was chosen last, or what the system speaks.
[[nodiscard]] QString preferredLanguage();
/// That of the window, for the report.
[[nodiscard]] ReportLanguage reportLanguage();

}  // namespace terrawalk::gui
