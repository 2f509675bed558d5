#pragma once

#include <QFrame>
#include <QStringList>
#include <map>

#include "app/gui/steps.hpp"

class QFormLayout;
class QLabel;
class QToolButton;
class QVBoxLayout;

namespace terrawalk::gui {

class SurveySession;

/// A step: its name and state, its important settings, and the way to the others.
class StepCard : public QFrame {
    Q_OBJECT
  public:
    StepCard(SurveySession& session, const Step& step, QWidget* parent = nullptr);
    void setState(const QString& state, const QColor& colour);
    /// A widget below the settings.
    void addBody(QWidget* widget);
    /// A field with its name, in the columns of the settings.
    void addField(const QString& name, QWidget* field);
    /// What is added from now on unfolds below a button with that text.
    void beginFold(const QString& object_name, const QString& text);
    /// Which the longest name of an important setting needs.
    [[nodiscard]] int namesWidth_px() const;
    /// All cards give their names the same width, so that the fields stand in one column.
    void setNamesWidth(int width_px);
    void themeChanged();

  Q_SIGNALS:
    void furtherAsked();

  private:
    void addImportant(const Step& step);
    void showChanged();
    void unfold(bool unfolded);
    [[nodiscard]] QFormLayout& form();
    QLabel* addName(const QString& key, const QString& words);
    SurveySession& session_;
    QStringList further_keys_;
    QVBoxLayout* body_ = nullptr;
    QString icon_name_;
    QLabel* picture_ = nullptr;
    QLabel* state_ = nullptr;
    QFormLayout* form_ = nullptr;       ///< to which fields are added
    std::map<QString, QLabel*> names_;  ///< by key; of what is no setting by itself
    QToolButton* fold_ = nullptr;
    QWidget* folded_ = nullptr;
    QToolButton* further_ = nullptr;
};

}  // namespace terrawalk::gui
