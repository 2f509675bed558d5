#pragma once

#include <QString>
#include <QStringList>

namespace terrawalk::gui {

/// Surveys that were opened, the last one first; those that are gone are left out.
[[nodiscard]] QStringList recentSurveys();
/// The folder of the last file dialog.
[[nodiscard]] QString lastFolder();
void rememberFolder(const QString& path);
void rememberSurvey(const QString& path);

}  // namespace terrawalk::gui
