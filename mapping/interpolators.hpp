#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/height_interpolator.hpp"
#include "mapping/point_order.hpp"
#include "survey/triangle_mesh.hpp"

namespace terrawalk {

// The methods behind fitInterpolator(), one maker each. Points in curve order at different places. A mesh is
// the Delaunay triangulation of all points. What was made after a stop was requested is of no use.

using InterpolatorPointer = std::unique_ptr<const HeightInterpolator>;

[[nodiscard]] InterpolatorPointer makeLinear(std::shared_ptr<const TriangleMesh> mesh);
/// @param smooth  with gradients (Sibson's C1 form)
[[nodiscard]] InterpolatorPointer makeNaturalNeighbour(std::shared_ptr<const TriangleMesh> mesh, bool smooth,
                                                       const std::stop_token& stop);
/// @param breaks  breaklines as vertexGradients() takes them: there the surface may have a fold
[[nodiscard]] InterpolatorPointer makeCloughTocher(std::shared_ptr<const TriangleMesh> mesh,
                                                   std::vector<std::uint8_t> breaks,
                                                   const std::stop_token& stop);
[[nodiscard]] InterpolatorPointer makeInverseDistance(std::vector<Eigen::Vector3d> points_m,
                                                      std::size_t neighbours, double power);
[[nodiscard]] InterpolatorPointer makeNearest(std::vector<Eigen::Vector3d> points_m);
[[nodiscard]] Result<InterpolatorPointer> makeKriging(PlacedHeights points, std::size_t neighbours,
                                                      bool learn_variance, Progress& progress,
                                                      const std::stop_token& stop);
/// @param spacing  of the finest lattice, share of the mean point spacing
[[nodiscard]] Result<InterpolatorPointer> makeBSpline(const std::vector<Eigen::Vector3d>& points_m,
                                                      double spacing, Progress& progress,
                                                      const std::stop_token& stop);

}  // namespace terrawalk
