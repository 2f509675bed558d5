#pragma once

#include <QColor>
#include <QPainter>
#include <QPalette>
#include <QSet>
#include <QString>
#include <memory>

#include "app/gui/map_transform.hpp"
#include "app/gui/raster_picture.hpp"
#include "app/pipeline/process.hpp"
#include "app/pipeline/survey_map.hpp"

namespace terrawalk::gui {

enum class TrackColouring { Run, SigmaPlan, SigmaHeight };

/// Everything that the map shows. A value: the view draws it, others change it.
struct MapScene {
    std::shared_ptr<const SurveyMap> survey;
    std::shared_ptr<const Products> products;
    std::shared_ptr<const RasterPicture> raster;
    TrackColouring colouring = TrackColouring::Run;
    QSet<QString> hidden_runs;
    QSet<QString> hidden_marks;
    QString highlighted;  ///< run or mark that is selected elsewhere
    bool show_edges = true;

    /// Of all that there is, in map metres; empty where there is nothing.
    [[nodiscard]] QRectF extent_m() const;
};

/// The colour of the i-th run, told apart by readers who do not see all colours.
[[nodiscard]] QColor runColour(std::size_t index);

/// Greatest sigma of the colour ramp of the tracks; 0 where none tells its sigma.
[[nodiscard]] double greatestSigma(const MapScene& scene);
/// Times by which errors at marks are drawn longer than they are, a round number.
[[nodiscard]] double vectorScale(const MapScene& scene, const MapTransform& transform);

void drawTracks(QPainter& painter, const MapScene& scene, const MapTransform& transform);
void drawMarks(QPainter& painter, const MapScene& scene, const MapTransform& transform,
               const QPalette& palette);
void drawTerraceEdges(QPainter& painter, const MapScene& scene, const MapTransform& transform);

}  // namespace terrawalk::gui
