#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "survey/elevation_grid.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/triangle_mesh.hpp"

namespace terrawalk {

struct TinOptions {
    double longest_edge_m = 0.0;  ///< triangles with a longer edge (in plan) are left out; 0: from the points
};

/// The ground as triangles over the points, Delaunay in plan. Immutable; safe from any thread.
class DelaunayTin {
  public:
    /// Triangulates; points at the same place in plan become one at their mean height. Any order of the points
    /// gives the same surface. Errors: BadData for fewer than three points or all on one line; Cancelled.
    [[nodiscard]] static Result<DelaunayTin> build(const std::vector<Eigen::Vector3d>& points_m,
                                                   const TinOptions& options, Progress& progress,
                                                   std::stop_token stop);

    [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
    [[nodiscard]] double longestEdge_m() const { return longest_edge_m_; }  ///< the limit that was used
    [[nodiscard]] double area_m2() const { return area_m2_; }
    /// Height by linear interpolation; nothing outside the triangles.
    [[nodiscard]] std::optional<double> heightAt(double x_m, double y_m) const;

  private:
    DelaunayTin() = default;
    TriangleMesh mesh_;
    double longest_edge_m_ = 0.0;
    double area_m2_ = 0.0;
};

}  // namespace terrawalk
