#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "survey/elevation_grid.hpp"

namespace terrawalk {

/// Value of the grid between its cell centres, bilinear; nothing outside them or where one of the centres
/// that count has no value. Pure.
[[nodiscard]] std::optional<double> bilinearAt(const ElevationGrid& grid, const Eigen::Vector2d& at);

struct ProfilePoint {
    double distance = 0.0;  ///< along the line
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    std::optional<double> height;
    std::optional<double> sigma;
};

/// Heights along a polyline: at its vertices and between them at most `step` apart.
/// @param sigmas  one sigma of the heights on cells of any geometry; null: none
/// @param step    > 0
[[nodiscard]] std::vector<ProfilePoint> profileAlong(const ElevationGrid& heights,
                                                     const ElevationGrid* sigmas,
                                                     const std::vector<Eigen::Vector2d>& line, double step);

/// A point beside a line: how far along its foot lies, and how far it stands off, positive to the left.
struct LineOffset {
    double distance = 0.0;
    double offset = 0.0;
};
/// Of the nearest piece of the line; the first of equally near ones.
/// @param line  at least two vertices
[[nodiscard]] LineOffset offsetFrom(const std::vector<Eigen::Vector2d>& line, const Eigen::Vector2d& point);

}  // namespace terrawalk
