#pragma once

#include <QPainter>
#include <QPalette>
#include <QRectF>
#include <vector>

#include "app/gui/map_scene.hpp"
#include "app/gui/map_transform.hpp"

namespace terrawalk::gui {

/// Scale bar at the lower left, north arrow at the upper right, legend below it: each on a panel that leaves
/// any map readable.
void drawFurniture(QPainter& painter, const MapScene& scene, const MapTransform& transform,
                   const QPalette& palette);
/// Where it draws.
[[nodiscard]] std::vector<QRectF> furnitureBoxes(const QFontMetricsF& metrics, const MapScene& scene,
                                                 const MapTransform& transform);

/// A ground that leaves text readable on any picture.
void drawPanel(QPainter& painter, const QRectF& box, const QPalette& palette);
/// Legends of the layer and of the tracks, one below the other.
void drawLegends(QPainter& painter, const MapScene& scene, QPointF upper_right, const QPalette& palette);
[[nodiscard]] std::vector<QRectF> legendBoxes(const QFontMetricsF& metrics, const MapScene& scene,
                                              QPointF upper_right);

}  // namespace terrawalk::gui
