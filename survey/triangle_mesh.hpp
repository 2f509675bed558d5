#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace terrawalk {

/// Triangles over vertices in the map frame [m]. Each triangle is counter-clockwise seen from above.
struct TriangleMesh {
    std::vector<Eigen::Vector3d> vertices_m;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace terrawalk
