#pragma once

#include <cstdint>
#include <memory>
#include <stop_token>
#include <vector>

#include "mapping/height_interpolator.hpp"
#include "survey/breakline.hpp"
#include "survey/triangle_mesh.hpp"

namespace terrawalk {

struct ConstrainedTinOptions {
    /// As in TinOptions; but 0 takes no limit where a boundary is given, which says it better.
    double longest_edge_m = 0.0;
    /// Points closer together than this become one at their mean height, and points that close to a vertex of
    /// a breakline give way to it: a step of centimetres within a millimetre is no ground.
    double near_m = 0.001;
};

/// Triangles that follow breaklines (constrained Delaunay triangulation, CGAL, exact predicates).
struct ConstrainedTin {
    TriangleMesh mesh;                 ///< over the convex hull of all; order as in DelaunayTin
    std::vector<std::uint8_t> breaks;  ///< for each triangle a bit for each side, facing corner 0, 1, 2, that
                                       ///< is part of a hard breakline, a boundary or a hole
    std::vector<std::uint8_t> ground;  ///< 1 for a triangle that counts: inside, in no hole, within the limit
    double longest_edge_m = 0.0;       ///< the limit that was used; infinite for none
    double area_m2 = 0.0;              ///< of the ground, in plan
    std::size_t merged = 0;            ///< points that went into a neighbour

    /// The triangles that count, with their vertices.
    [[nodiscard]] TriangleMesh groundMesh() const;
};

/// Any order of points and lines gives the same triangles, byte for byte. Errors: BadData for coordinates out
/// of range, for lines with fewer than two vertices (rings: three), for two lines that cross without a common
/// vertex, with both names and the place, for two that meet at different heights, for fewer than three places
/// or all on one line, and when nothing is left; Usage for options out of range; Cancelled.
[[nodiscard]] Result<ConstrainedTin> buildConstrainedTin(const std::vector<Eigen::Vector3d>& points_m,
                                                         const std::vector<Breakline>& breaklines,
                                                         const ConstrainedTinOptions& options,
                                                         Progress& progress, std::stop_token stop);

/// Whether a method keeps to breaklines; the others take points alone.
[[nodiscard]] bool followsBreaklines(InterpolationMethod method);

/// A surface over the triangles. Errors: Usage for a method other than Linear and CloughTocher, which alone
/// keep to triangles; Cancelled.
[[nodiscard]] Result<std::unique_ptr<const HeightInterpolator>> fitInterpolator(
    InterpolationMethod method, std::shared_ptr<const ConstrainedTin> tin, std::stop_token stop = {});

}  // namespace terrawalk
