#pragma once

#include <QWidget>
#include <memory>

#include "app/gui/plot_data.hpp"
#include "app/gui/selection.hpp"
#include "app/pipeline/process.hpp"
#include "app/pipeline/survey_map.hpp"
#include "survey/survey.hpp"

class QComboBox;
class QLabel;
class QListWidget;
class QPushButton;

namespace terrawalk::gui {

class PlotCanvas;

/// All plots of a survey: a list at the left, one plot at a time, of one run at a time. The stretch that is
/// selected anywhere is shaded here, and a drag here selects one everywhere.
class PlotsView : public QWidget {
    Q_OBJECT
  public:
    explicit PlotsView(Selection& selection, QWidget* parent = nullptr);

    void show(std::shared_ptr<const Survey> survey, std::shared_ptr<const SurveyMap> map,
              std::shared_ptr<const Products> products);
    using QWidget::show;
    void setTuning(std::shared_ptr<const TuningData> tuning);
    void setPlot(PlotKind kind);
    /// Nothing happens for what is no run.
    void setRun(const QString& run);
    [[nodiscard]] PlotKind plot() const { return kind_; }
    [[nodiscard]] QString run() const;
    [[nodiscard]] PlotCanvas& canvas() { return *canvas_; }

  public Q_SLOTS:
    void themeChanged();

  Q_SIGNALS:
    /// @param sensor  as EditedSensor is named: "all", "gnss" and so on
    void excludeAsked(const std::vector<terrawalk::gui::TrackStretch>& stretches, const QString& sensor);
    void excludeMarkAsked(const QString& mark);
    /// Of other files shall be shown.
    void searchesAsked();

  private:
    void fillList();
    void renew();
    void shadeSelection();
    [[nodiscard]] bool ofMarks() const;
    [[nodiscard]] bool markSelected() const;
    [[nodiscard]] std::vector<TrackStretch> shownStretches() const;
    [[nodiscard]] std::size_t runNumber() const;

    Selection& selection_;
    std::shared_ptr<const Survey> survey_;
    std::shared_ptr<const Products> products_;
    std::shared_ptr<const TuningData> tuning_;
    PlotKind kind_ = PlotKind::GnssPosition;
    QListWidget* list_ = nullptr;
    QLabel* title_ = nullptr;
    QComboBox* runs_ = nullptr;
    QComboBox* sensors_ = nullptr;
    QPushButton* exclude_ = nullptr;
    QPushButton* open_ = nullptr;
    QLabel* readout_ = nullptr;
    QLabel* note_ = nullptr;
    PlotCanvas* canvas_ = nullptr;
};

}  // namespace terrawalk::gui
