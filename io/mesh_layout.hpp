#pragma once

#include <bit>
#include <cstring>
#include <filesystem>
#include <string>

#include "survey/result.hpp"
#include "survey/triangle_mesh.hpp"

namespace terrawalk {

// What the writers of meshes and points share.

static_assert(std::endian::native == std::endian::little,
              "binary writers copy numbers as they lie in memory");

/// Copies a number as it lies in memory; returns where the next one goes.
template <class T>
char* put(char* to, T value) {
    std::memcpy(to, &value, sizeof value);
    return to + sizeof value;
}

/// A header line ends at a line feed, so a name may hold none.
[[nodiscard]] std::string oneLine(std::string text);

/// BadData for a mesh that no reader could use: no triangle, a vertex that is not finite, a triangle without
/// a vertex, more of them than a mesh file can count.
[[nodiscard]] Result<void> checkMesh(const TriangleMesh& mesh, const std::filesystem::path& file);

/// Middle of the points in whole metres: offsets from it are small enough for float, and it prints exactly.
/// @param points_m  at least one
[[nodiscard]] Eigen::Vector3d originOf(const std::vector<Eigen::Vector3d>& points_m);
[[nodiscard]] std::string originText(const Eigen::Vector3d& origin_m);

}  // namespace terrawalk
