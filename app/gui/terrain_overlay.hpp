#pragma once

#include <QPalette>
#include <optional>

#include "app/gui/map_scene.hpp"
#include "app/gui/selection.hpp"
#include "app/gui/terrain_frame.hpp"

namespace terrawalk::gui {

/// Of the stretch that is selected, on any ground.
[[nodiscard]] QColor selectedColour();

/// The floor, with lines at round coordinates.
struct FloorGrid {
    double step_m = 10.0;
    double west_m = 0.0, east_m = 0.0, south_m = 0.0, north_m = 0.0;  ///< on the map
};
/// Multiples of the step between two ends.
[[nodiscard]] std::vector<double> wholeSteps(double from, double to, double step);
[[nodiscard]] FloorGrid floorGrid(const TerrainScene& scene);

/// What the map chose to show: tracks, excluded stretches, edges of terraces and drawn lines laid on the
/// surface, ground points where they were measured; and the grid of the floor. Pure.
/// @param points_map_m  one for each ground point of the products
[[nodiscard]] SceneOverlay sceneOverlay(const TerrainScene& scene, const MapScene& map,
                                        const std::vector<Eigen::Vector3d>& points_map_m,
                                        const QPalette& palette);

}  // namespace terrawalk::gui
