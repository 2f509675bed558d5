#pragma once

#include <QPainter>
#include <QPalette>
#include <QRectF>
#include <vector>

#include "app/gui/map_scene.hpp"
#include "app/gui/terrain_frame.hpp"

namespace terrawalk::gui {

/// Coordinates along the near edges of the floor, and heights at a corner. Returns where the coordinates
/// stand.
std::vector<QRectF> drawAxes(QPainter& painter, const TerrainFrame& frame, const QPalette& palette);
/// Marks as pins; those behind the ground are faint.
/// @param reserved  where no names may stand, beside the furniture
void drawPins(QPainter& painter, const TerrainFrame& frame, const MapScene& map, std::vector<QRectF> reserved,
              const QPalette& palette);
/// How far the head of a pin stands above its foot on the screen: from above they are one.
[[nodiscard]] double pinHeight(const TerrainFrame& frame);
/// A ring about a place.
void drawPick(QPainter& painter, const TerrainFrame& frame, const Eigen::Vector3d& map_m);
/// A compass that turns with the view, legends below it, and by how much heights are stretched.
void drawTerrainFurniture(QPainter& painter, const TerrainFrame& frame, const MapScene& map,
                          const QPalette& palette);
/// Where it draws.
[[nodiscard]] std::vector<QRectF> terrainFurnitureBoxes(const QFontMetricsF& metrics,
                                                        const TerrainFrame& frame, const MapScene& map);

/// "× 2", or nothing where heights are as they are.
[[nodiscard]] QString exaggerationText(double exaggeration);

}  // namespace terrawalk::gui
