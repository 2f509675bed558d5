#pragma once

#include <QAction>
#include <QDialog>
#include <QString>
#include <map>

namespace terrawalk::gui {

/// Property of an action whose text changes: what it always means.
inline constexpr const char* kPlainMeaning = "plain_meaning";

/// All keys of the window in one table.
class ShortcutsDialog : public QDialog {
    Q_OBJECT
  public:
    ShortcutsDialog(const std::map<QString, QAction*>& actions, const QList<QAction*>& tools,
                    QWidget* parent = nullptr);
};

}  // namespace terrawalk::gui
