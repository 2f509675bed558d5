#pragma once

#include <QColor>
#include <QPainter>
#include <QPalette>
#include <QPolygonF>
#include <QString>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/gui/map_transform.hpp"
#include "app/gui/mark_names.hpp"
#include "app/gui/raster_picture.hpp"
#include "app/gui/selection.hpp"
#include "app/gui/view_state.hpp"
#include "app/pipeline/process.hpp"
#include "app/pipeline/survey_map.hpp"

namespace terrawalk::gui {

/// What a person is drawing: map metres.
struct MapSketch {
    QPolygonF vertices_m;
    bool closed = false;  ///< a ring
    QString label;        ///< stands at the last vertex, e.g. a length
};

/// Everything that the map shows. A value: the view draws it, others change it.
struct MapScene {
    std::shared_ptr<const SurveyMap> survey;
    std::shared_ptr<const Products> products;
    std::shared_ptr<const RasterPicture> raster;
    ViewChoice shown;
    QString highlighted;                                   ///< run or mark that is selected elsewhere
    std::shared_ptr<const std::vector<Contour>> contours;  ///< null: none yet
    std::vector<TrackStretch> stretches;                   ///< selected
    MapSketch sketch;
    std::optional<QPointF> place_m;  ///< that a person asked about

    /// Of all that there is, in map metres; empty where there is nothing.
    [[nodiscard]] QRectF extent_m() const;
};

/// The colour of the i-th run, told apart by readers who do not see all colours.
[[nodiscard]] QColor runColour(std::size_t index);

/// Ends of the colour ramp of the tracks; nothing where they have no values, or one colour for each run or
/// fix.
struct ValueRange {
    double low = 0.0;
    double high = 1.0;
};
[[nodiscard]] std::optional<ValueRange> trackRange(const MapScene& scene);
/// The colour of one track at each of its places, by the scene's colouring.
using TrackInk = std::function<QRgb(std::size_t)>;
[[nodiscard]] TrackInk trackInk(const MapScene& scene, std::size_t track);
/// Kinds of fix that occur in the shown tracks, with their colours.
[[nodiscard]] std::vector<std::pair<QString, QColor>> fixClasses(const MapScene& scene);
/// The place on a track that is nearest to a point on the screen.
struct TrackHit {
    std::size_t track = 0;
    std::size_t index = 0;
    double distance_px = 0.0;
};
[[nodiscard]] std::optional<TrackHit> nearestOnTracks(const MapScene& scene, const MapTransform& transform,
                                                      QPointF screen_px, const QString& only_run = {});
/// Passes of the shown tracks through a rectangle of the screen, each from its first epoch within to its
/// last.
[[nodiscard]] std::vector<TrackStretch> stretchesWithin(const MapScene& scene, const MapTransform& transform,
                                                        const QRectF& screen_px);
/// The mark whose symbol lies under a point on the screen; empty where there is none.
[[nodiscard]] QString markAt(const MapScene& scene, const MapTransform& transform, QPointF screen_px);
/// Times by which errors at marks are drawn longer than they are, a round number.
[[nodiscard]] double vectorScale(const MapScene& scene, const MapTransform& transform);

/// Of a ground point, by whether it carries the surface, stands back for another, or was refused.
[[nodiscard]] QRgb pointColour(GroundPointState state);
/// Kinds of ground points that occur, with their colours; none where points are not shown.
[[nodiscard]] std::vector<std::pair<QString, QColor>> pointClasses(const MapScene& scene);
/// Of a drawn line.
[[nodiscard]] QColor lineColour(BreaklineKind kind);
inline const QColor kEdgeInk(70, 35, 20);  ///< of terraces
inline const QColor kExcludedInk(110, 110, 110);

void drawPoints(QPainter& painter, const MapScene& scene, const MapTransform& transform);
void drawTracks(QPainter& painter, const MapScene& scene, const MapTransform& transform);
/// Excluded stretches of tracks, and the selected one.
void drawStretches(QPainter& painter, const MapScene& scene, const MapTransform& transform);
inline const QColor kMarkInk(20, 24, 28);
/// Square, triangle or dot: zero mark, control or check.
void drawMarkSymbol(QPainter& painter, QPointF at, const ControlMark& mark, bool highlighted,
                    const QColor& colour);
/// Symbols of the shown marks on the screen; none where marks are not shown.
[[nodiscard]] std::vector<MarkName> markNames(const MapScene& scene, const MapTransform& transform);
/// @param names  of this frame, see placeMarkNames()
void drawMarks(QPainter& painter, const MapScene& scene, const MapTransform& transform,
               const MarkNames& names, const QPalette& palette);
void drawTerraceEdges(QPainter& painter, const MapScene& scene, const MapTransform& transform);
/// @param names  that labels keep clear of
void drawContours(QPainter& painter, const MapScene& scene, const MapTransform& transform,
                  const MarkNames& names, const QPalette& palette);
/// Where keys point.
void drawCross(QPainter& painter, QPointF at);
/// Of the sign at a place that was asked about.
[[nodiscard]] QRectF placeBox(QPointF at);
/// Drawn lines, the sketch, and the place that was asked about.
void drawEdits(QPainter& painter, const MapScene& scene, const MapTransform& transform,
               const QPalette& palette);

}  // namespace terrawalk::gui
