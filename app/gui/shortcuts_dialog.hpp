#pragma once

#include <QAction>
#include <QDialog>
#include <QString>
#include <map>

namespace terrawalk::gui {

/// All keys of the window in one table.
class ShortcutsDialog : public QDialog {
    Q_OBJECT
  public:
    ShortcutsDialog(const std::map<QString, QAction*>& actions, const QList<QAction*>& tools,
                    QWidget* parent = nullptr);
};

}  // namespace terrawalk::gui
