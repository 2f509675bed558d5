#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/triangle_mesh.hpp"

namespace terrawalk {

struct TinOptions {
    /// Triangles with a longer edge (in plan) are left out, so that nothing is invented outside the walk.
    /// 0: from the points, see edge_limit.hpp.
    double longest_edge_m = 0.0;
};

/// Triangles over points, and the limit that they keep to.
struct GroundMesh {
    /// Only vertices that a triangle uses, in the order of a Hilbert curve. Each triangle begins with its
    /// lowest vertex index, and the triangles stand in rising order.
    TriangleMesh mesh;
    double longest_edge_m = 0.0;  ///< the limit that was used
    double area_m2 = 0.0;         ///< in plan
};

/// Triangulates, Delaunay in plan (CGAL, exact predicates). Points at the same place in plan become one at
/// their mean height. Any order of the points gives the same mesh, byte for byte, also where four points lie
/// on one circle. Pure; safe from any thread. Errors: BadData for a coordinate that is not finite or beyond
/// 1e9 m, for fewer than three distinct points, for points all on one line, and for a limit that leaves no
/// triangle; Usage for a limit below zero; Cancelled.
[[nodiscard]] Result<GroundMesh> triangulatePoints(const std::vector<Eigen::Vector3d>& points_m,
                                                   const TinOptions& options, Progress& progress,
                                                   std::stop_token stop);

/// The ground as triangles over the points, Delaunay in plan (CGAL, exact predicates). Any projected or local
/// frame in metres; large coordinates lose nothing. Immutable and cheap to copy; safe from any thread.
class DelaunayTin {
  public:
    /// Errors: as triangulatePoints().
    [[nodiscard]] static Result<DelaunayTin> build(const std::vector<Eigen::Vector3d>& points_m,
                                                   const TinOptions& options, Progress& progress,
                                                   std::stop_token stop);

    [[nodiscard]] const TriangleMesh& mesh() const;  ///< as in GroundMesh
    [[nodiscard]] double longestEdge_m() const;
    [[nodiscard]] double area_m2() const;

    /// Height by linear interpolation, edges and vertices included; nothing outside the triangles.
    [[nodiscard]] std::optional<double> heightAt(double x_m, double y_m) const;

  private:
    struct Surface;
    explicit DelaunayTin(std::shared_ptr<const Surface> surface);
    std::shared_ptr<const Surface> surface_;
};

}  // namespace terrawalk
