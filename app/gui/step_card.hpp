#pragma once

#include <QFrame>
#include <QStringList>

#include "app/gui/steps.hpp"

class QFormLayout;
class QLabel;
class QToolButton;
class QVBoxLayout;

namespace terrawalk::gui {

class SurveySession;

/// A step: its name and state, its important settings, and the others folded away.
class StepCard : public QFrame {
    Q_OBJECT
  public:
    StepCard(SurveySession& session, const Step& step, QWidget* parent = nullptr);
    void setState(const QString& state, const QColor& colour);
    /// A widget below the settings.
    void addBody(QWidget* widget);
    void setUnfolded(bool unfolded);
    void themeChanged();

  private:
    void buildFurther();
    SurveySession& session_;
    QStringList further_keys_;
    QVBoxLayout* body_ = nullptr;
    QString icon_name_;
    QLabel* picture_ = nullptr;
    QLabel* state_ = nullptr;
    QToolButton* fold_ = nullptr;
    QWidget* further_ = nullptr;  ///< made when it is first unfolded: there may be a hundred settings
};

}  // namespace terrawalk::gui
