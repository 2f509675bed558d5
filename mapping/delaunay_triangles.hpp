#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// The Delaunay triangles of points in plan, counter-clockwise, each from its lowest
/// index on, in rising order. Where four
/// points lie on one circle they are told apart as CGAL does (Devillers and Teillaud 2003), so that the
/// triangles do not depend on the order of the points. Predicates are exact, CGAL's where plain arithmetic
/// does not suffice; the structure is one of plain index arrays, which takes a third of the memory of CGAL's
/// own. Pure; safe from any thread. Errors: Cancelled.
/// @param points_m  different places, finite, at least three and not all on one line; neighbours in the list
///                  should be neighbours on the ground, for speed
/// @param off_line  index of a point that makes a triangle with the first and the last
/// Source: Bowyer 1981 and Watson 1981, in the order of Amenta, Choi and Rote 2003.
[[nodiscard]] Result<std::vector<std::array<std::uint32_t, 3>>> delaunayTriangles(
    const std::vector<Eigen::Vector3d>& points_m, std::size_t off_line, Progress& progress,
    std::stop_token stop);

}  // namespace terrawalk
