#pragma once

#include <QList>
#include <QObject>
#include <QSet>
#include <QString>
#include <memory>
#include <utility>

#include "app/pipeline/height_change.hpp"
#include "survey/survey_edits.hpp"

namespace terrawalk::gui {

/// What the ground is coloured by.
enum class RasterLayer { None, Height, Uncertainty, Density, Source, Change };
enum class TrackColouring { Run, Fix, Speed, Height, SigmaPlan, SigmaHeight, Residual };

/// What is shown of a survey and how, alike on the map and in three dimensions. A value.
struct ViewChoice {
    RasterLayer layer = RasterLayer::Height;
    TrackColouring colouring = TrackColouring::Run;
    QSet<QString> hidden_runs;
    QSet<QString> hidden_marks;
    bool tracks = true;
    bool points = false;  ///< ground points
    bool marks = true;
    bool contours = true;
    bool edges = true;  ///< of terraces
    /// Drawn lines and excluded stretches are shown.
    std::shared_ptr<const SurveyEdits> edits = std::make_shared<const SurveyEdits>();
    std::shared_ptr<const HeightChange> change;  ///< for its layer
    bool operator==(const ViewChoice&) const = default;
};

/// The one choice that all views follow. Lives in the window's thread.
class ViewState : public QObject {
    Q_OBJECT
  public:
    using QObject::QObject;
    [[nodiscard]] const ViewChoice& now() const { return now_; }
    /// Says so once, where it is another.
    void set(ViewChoice choice);
    void setLayer(RasterLayer layer);
    void setColouring(TrackColouring colouring);
    void setRunVisible(const QString& run, bool visible);
    void setMarkVisible(const QString& mark, bool visible);
    /// One of the flags of ViewChoice.
    void setShown(bool ViewChoice::*what, bool shown);
    void setEdits(const SurveyEdits& edits);
    /// Shows the layer, too; without a change the heights come back.
    void setChange(std::shared_ptr<const HeightChange> change);

    /// Layers that the results have; others cannot be chosen.
    void setAvailable(const QList<RasterLayer>& layers);
    [[nodiscard]] bool available(RasterLayer layer) const { return available_.contains(layer); }

  Q_SIGNALS:
    void changed();
    void availableChanged();

  private:
    ViewChoice now_;
    QList<RasterLayer> available_{RasterLayer::None};
};

[[nodiscard]] QList<std::pair<RasterLayer, QString>> layerNames();
[[nodiscard]] QList<std::pair<TrackColouring, QString>> colouringNames();

}  // namespace terrawalk::gui
