#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "survey/result.hpp"

namespace terrawalk {

// Points in one order and one form, whatever order they came in: what makes surfaces independent of it.
// Any map or local frame, one linear unit. All pure; safe from any thread.

/// Error BadData for the first coordinate that is not finite or lies beyond 1e9 from the origin.
[[nodiscard]] Result<void> checkCoordinates(const std::vector<Eigen::Vector3d>& points_m);

/// Indices of the points along a Hilbert curve over their square, then by coordinates. Points with the same
/// three coordinates stand in no certain order. Coordinates finite; fewer than 2^32 points, at least one.
[[nodiscard]] std::vector<std::uint32_t> curveOrder(const std::vector<Eigen::Vector3d>& points_m);

/// The points themselves in that order. Minus zero becomes zero, since the two compare equal and differ in
/// their bytes.
[[nodiscard]] std::vector<Eigen::Vector3d> inCurveOrder(const std::vector<Eigen::Vector3d>& points_m);

/// Points at the same place in plan, neighbours in curve order, become one at their mean height.
void mergeSamePlaces(std::vector<Eigen::Vector3d>& points_m);

/// Heights at places that differ in plan, in curve order.
struct PlacedHeights {
    std::vector<Eigen::Vector3d> points_m;
    std::vector<double> sigmas_m;  ///< of the heights; empty where none were given
};
/// Curve order and merge in one. The sigma of n heights with independent errors: root of the summed squares
/// over n.
/// @param sigmas_m  empty, or one for each point
[[nodiscard]] PlacedHeights placedHeights(const std::vector<Eigen::Vector3d>& points_m,
                                          const std::vector<double>& sigmas_m);

}  // namespace terrawalk
