#pragma once

#include <QDialog>
#include <functional>
#include <vector>

#include "app/pipeline/run_history.hpp"

class QCheckBox;
class QLabel;
class QLayout;
class QPushButton;
class QTableWidget;

namespace terrawalk::gui {

class SurveySession;

/// The last runs of a survey, the newest above: their figures and what was set; goes back to one.
class RunsDialog : public QDialog {
    Q_OBJECT
  public:
    explicit RunsDialog(SurveySession& session, QWidget* parent = nullptr);

    /// How a person is asked whether files may go; a test answers in its place.
    std::function<bool(const QString& question)> sure;

  private:
    QTableWidget* buildRuns();
    QTableWidget* buildDifferences();
    QLayout* buildKeeping();
    void addRun(std::size_t run);
    void showChosen();
    void showKeeping();
    void removeKept();
    [[nodiscard]] qint64 keptBytes() const;
    [[nodiscard]] QString resultsWords(std::size_t run) const;
    [[nodiscard]] QString compareWords(std::size_t run) const;
    [[nodiscard]] std::size_t chosen() const;
    [[nodiscard]] bool isShown(std::size_t run) const;
    [[nodiscard]] QString changesSinceTheRunBefore(std::size_t run) const;
    SurveySession& session_;
    std::vector<FigureKind> kinds_;  ///< a column each
    QTableWidget* runs_ = nullptr;
    QTableWidget* differences_ = nullptr;
    QLabel* what_ = nullptr;
    QLabel* results_ = nullptr;
    QCheckBox* keep_ = nullptr;
    QLabel* kept_ = nullptr;
    QPushButton* remove_ = nullptr;
    QPushButton* go_back_ = nullptr;
    QPushButton* again_ = nullptr;
    QPushButton* compare_ = nullptr;
};

}  // namespace terrawalk::gui
