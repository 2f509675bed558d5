#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "mapping/triangle_walk.hpp"

namespace terrawalk {

/// Slopes at the vertices of a triangulation, for surfaces that are smooth.
struct VertexGradients {
    std::vector<Eigen::Vector2d> gradients;
    /// For each triangle and corner the gradient that holds there. The corners at a vertex share one, except
    /// across breaklines.
    std::vector<std::array<std::uint32_t, 3>> of_corner;
};

/// Least squares of a full quadratic through the vertex's height over its neighbours and theirs, weighted by
/// the inverse squared distance; of a plane where they are fewer than eight or badly spread. Neighbours
/// across a breakline do not count: each side of it has its own slope. Runs on TBB's threads; the same bytes
/// with any number.
/// @param breaks  for each triangle a bit for each side (that faces corner 0, 1, 2) that is a breakline;
///                empty: none
/// @param stop    when it was requested, the gradients are not all there: who asks looks at it next
[[nodiscard]] VertexGradients vertexGradients(const TriangleWalk& walk,
                                              const std::vector<std::uint8_t>& breaks = {},
                                              const std::stop_token& stop = {});

}  // namespace terrawalk
