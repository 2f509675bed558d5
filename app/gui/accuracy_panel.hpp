#pragma once

#include <QWidget>
#include <memory>

#include "app/gui/accuracy_model.hpp"
#include "app/gui/selection.hpp"
#include "app/pipeline/process.hpp"

class QHBoxLayout;
class QLabel;
class QTableView;
class QTableWidget;

namespace terrawalk::gui {

/// How good the result is: the figures that matter, errors by group and mark by mark, and what the marks can
/// and cannot say.
class AccuracyPanel : public QWidget {
    Q_OBJECT
  public:
    explicit AccuracyPanel(Selection& selection, QWidget* parent = nullptr);
    /// @param products  null: says what to do first
    void show(std::shared_ptr<const Products> products);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void fillFigures(const SurveyReport& report);
    void fillMarks(const SurveyReport& report);
    void fillWords(const SurveyReport& report);
    Selection& selection_;
    AccuracyModel model_;
    QWidget* empty_ = nullptr;
    QWidget* content_ = nullptr;
    QHBoxLayout* figures_ = nullptr;
    QTableView* groups_ = nullptr;
    QTableWidget* marks_ = nullptr;
    QLabel* words_ = nullptr;
};

}  // namespace terrawalk::gui
