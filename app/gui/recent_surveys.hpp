#pragma once

#include <QString>
#include <QStringList>

namespace terrawalk::gui {

/// Surveys that were opened, the last one first; those that are gone are left out.
[[nodiscard]] QStringList recentSurveys();
void rememberSurvey(const QString& path);

}  // namespace terrawalk::gui
