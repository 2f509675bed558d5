#pragma once

#include <QWidget>
#include <map>

#include "app/gui/steps.hpp"

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QSpinBox;

namespace terrawalk::gui {

class FigureTable;
class StepCard;
class SurveySession;

/// The way from logs to a DEM, from above to below, and the button that goes it.
class StepsPanel : public QWidget {
    Q_OBJECT
  public:
    explicit StepsPanel(SurveySession& session, QWidget* parent = nullptr);

    void themeChanged();
    /// As it is chosen here.
    void tune();

  Q_SIGNALS:
    void openAsked();
    void exportAsked();
    void commandAsked();
    void accuracyAsked();
    void runsAsked();
    /// All settings are to be shown, from those of that step on.
    void settingsAsked(terrawalk::gui::StepKind step);

  private:
    void fillCards();
    void buildCheck(StepCard& card);
    void buildSearch(StepCard& card);
    void buildBudget(StepCard& card);
    QPushButton* addButton(StepCard& card, const QString& name, const QString& text, const QString& tip);
    QWidget* buildFooter();
    void showState();
    void showProgress(double fraction, const QString& step, double seconds_left);
    void showHistory();
    SurveySession& session_;
    std::map<StepKind, StepCard*> cards_;
    QPushButton* tune_ = nullptr;
    QComboBox* optimiser_ = nullptr;
    QSpinBox* repeats_ = nullptr;
    QSpinBox* population_ = nullptr;
    QSpinBox* iterations_ = nullptr;
    QSpinBox* restarts_ = nullptr;
    QPushButton* export_ = nullptr;
    QPushButton* command_ = nullptr;
    QPushButton* accuracy_ = nullptr;
    QPushButton* process_ = nullptr;
    QPushButton* cancel_ = nullptr;
    QPushButton* history_ = nullptr;
    FigureTable* figures_ = nullptr;
    QLabel* figure_ = nullptr;
    QLabel* figure_detail_ = nullptr;
    QLabel* doing_ = nullptr;
    QProgressBar* bar_ = nullptr;
};

/// Seconds as a person says them, e.g. "about 2 min"; empty below zero.
[[nodiscard]] QString timeLeft(double seconds);

}  // namespace terrawalk::gui
