#pragma once

#include <QString>
#include <QWidget>

class QLabel;
class QLineEdit;
class QToolButton;

namespace terrawalk::gui {

class SurveySession;

/// One setting as a row's editor: a box to tick, a choice, or a number with its unit, as its permitted values
/// ask for. Follows the session, undo included.
class SettingEditor : public QWidget {
    Q_OBJECT
  public:
    SettingEditor(SurveySession& session, const QString& key, QWidget* parent = nullptr);
    [[nodiscard]] const QString& key() const { return key_; }
    /// The button that takes the default back shows only where there is something to take back; this keeps
    /// its place free, so that editors in a table end in one line.
    void keepRoomForReset();

  protected:
    void changeEvent(QEvent* event) override;

  private:
    void buildFlag();
    void buildChoice(const QStringList& names);
    void buildNumber();
    void buildReset();
    void themeChanged();
    void showUnit(QLineEdit& field) const;
    void showRefused(QWidget& field, bool refused);
    SurveySession& session_;
    QString key_;
    QToolButton* reset_ = nullptr;
};

/// Shows by weight and colour that the setting of that name has not its default.
void markChanged(QLabel& name, bool changed);
/// Meaning, permitted values, default and key, for a tool tip.
[[nodiscard]] QString settingHelp(const QString& key);
/// The words of a key but its first, e.g. "longest edge" for "surface.longest_edge_m".
[[nodiscard]] QString settingLabel(const QString& key);
[[nodiscard]] QString settingLabelInEnglish(const QString& key);
/// The same below a heading that says the group, e.g. "Longest edge".
[[nodiscard]] QString settingName(const QString& key);
/// The same with the heading before it, e.g. "GNSS › Sigma fixed".
[[nodiscard]] QString settingTitle(const QString& key);
/// A value with its unit, or the name of a choice.
[[nodiscard]] QString settingValueWords(const QString& key, const QString& value);
/// The unit that a key ends with, e.g. "m"; empty where there is none.
[[nodiscard]] QString settingUnit(const QString& key);

}  // namespace terrawalk::gui
