#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>

#include "io/write_exchange.hpp"
#include "survey/triangle_mesh.hpp"

namespace terrawalk::test {

/// Terraces at UTM coordinates, some hundred metres wide.
inline TriangleMesh terraces() {
    TriangleMesh mesh;
    constexpr std::uint32_t kSide = 12;
    for (std::uint32_t row = 0; row < kSide; ++row) {
        for (std::uint32_t column = 0; column < kSide; ++column) {
            mesh.vertices_m.emplace_back(745000.12341 + 9.7 * column, 2565000.65433 + 8.3 * row,
                                         38.0 + 1.5 * (row / 3) + 0.0137 * column);
        }
    }
    for (std::uint32_t row = 0; row + 1 < kSide; ++row) {
        for (std::uint32_t column = 0; column + 1 < kSide; ++column) {
            const std::uint32_t a = row * kSide + column;
            mesh.triangles.push_back({a, a + 1, a + kSide});
            mesh.triangles.push_back({a + 1, a + kSide + 1, a + kSide});
        }
    }
    return mesh;
}

/// Of two runs, a fifth of them spikes.
inline MapPoints somePoints() {
    MapPoints points;
    points.run_ids = {"F01", "S,01"};
    for (std::uint32_t i = 0; i < 500; ++i) {
        MapPoint point;
        point.map_m = {745645.33188 + 0.731 * i, 2565768.06474 - 0.377 * i, 38.12345 + 0.01 * std::sin(i)};
        point.sigma_u_m = 0.02 + 0.0001 * i;
        point.time_s = 0.2 * i;
        point.run = i % 2;
        point.state = i % 5 == 0 ? GroundPointState::Spike : GroundPointState::Used;
        points.points.push_back(point);
    }
    return points;
}

/// The origin that a header or comment states.
inline Eigen::Vector3d originIn(const std::string& text) {
    std::istringstream words(text.substr(text.rfind("origin_m ") + 9));
    Eigen::Vector3d origin;
    words >> origin.x() >> origin.y() >> origin.z();
    if (words.fail()) throw std::runtime_error("no origin in: " + text);
    return origin;
}

}  // namespace terrawalk::test
