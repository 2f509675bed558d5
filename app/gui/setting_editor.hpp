#pragma once

#include <QString>
#include <QWidget>

namespace terrawalk::gui {

class SurveySession;

/// One setting as a row's editor: a box to tick, a choice, or a number with its unit, as its permitted values
/// ask for. Follows the session, undo included.
class SettingEditor : public QWidget {
    Q_OBJECT
  public:
    SettingEditor(SurveySession& session, const QString& key, QWidget* parent = nullptr);
    [[nodiscard]] const QString& key() const { return key_; }

  private:
    void buildFlag();
    void buildChoice(const QStringList& names);
    void buildNumber();
    void showRefused(QWidget& field, bool refused);
    SurveySession& session_;
    QString key_;
};

/// Meaning, permitted values, default and key, for a tool tip.
[[nodiscard]] QString settingHelp(const QString& key);
/// The last words of a key, e.g. "longest edge" for "surface.longest_edge_m".
[[nodiscard]] QString settingLabel(const QString& key);
/// The unit that a key ends with, e.g. "m"; empty where there is none.
[[nodiscard]] QString settingUnit(const QString& key);

}  // namespace terrawalk::gui
