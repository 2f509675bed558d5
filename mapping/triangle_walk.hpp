#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "survey/triangle_mesh.hpp"

namespace terrawalk {

inline constexpr std::uint32_t kNoTriangle = 0xFFFF'FFFFU;

/// Which triangle lies across which edge, and the way from one triangle to the one below a place. For
/// triangles that cover a convex region without gap, counter-clockwise, each from its lowest vertex on, in
/// rising order, as DelaunayTin gives them. Keeps a reference to the mesh. Immutable; safe from any thread.
class TriangleWalk {
  public:
    explicit TriangleWalk(const TriangleMesh& mesh);

    [[nodiscard]] const TriangleMesh& mesh() const { return *mesh_; }
    /// The triangle across the edge that faces corner `corner`; kNoTriangle at the border.
    [[nodiscard]] std::uint32_t across(std::uint32_t triangle, std::size_t corner) const {
        return across_[triangle][corner];
    }
    /// The corner of `triangle` that faces its neighbour `other`.
    [[nodiscard]] std::size_t cornerFacing(std::uint32_t triangle, std::uint32_t other) const {
        const std::array<std::uint32_t, 3>& next = across_[triangle];
        return next[0] == other ? 0 : next[1] == other ? 1 : 2;
    }
    /// A triangle that has the vertex as a corner.
    [[nodiscard]] std::uint32_t triangleAt(std::uint32_t vertex) const { return triangle_at_[vertex]; }

    /// A triangle not far from the place, to start from.
    [[nodiscard]] std::uint32_t startNear(const Eigen::Vector2d& place_m) const;
    /// The triangle that holds the place, edges included; kNoTriangle outside. The way goes on from `start`,
    /// which becomes the last triangle that it met.
    [[nodiscard]] std::uint32_t locate(const Eigen::Vector2d& place_m, std::uint32_t& start) const;

    /// Shares of the three corners in a place, sum 1. Inside the triangle none is below zero but by rounding.
    [[nodiscard]] Eigen::Vector3d barycentric(std::uint32_t triangle, const Eigen::Vector2d& place_m) const;

  private:
    const TriangleMesh* mesh_;
    std::vector<std::array<std::uint32_t, 3>> across_;
    std::vector<std::uint32_t> triangle_at_;
};

}  // namespace terrawalk
