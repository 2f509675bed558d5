#include "io/mesh_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace terrawalk {

std::string oneLine(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; },
        ' ');
    return text;
}

Result<void> checkMesh(const TriangleMesh& mesh, const std::filesystem::path& file) {
    if (mesh.vertices_m.empty() || mesh.triangles.empty())
        return badData("the surface has no triangle", file);
    const std::size_t count = mesh.vertices_m.size();
    if (count > std::numeric_limits<std::int32_t>::max() ||
        mesh.triangles.size() > std::numeric_limits<std::int32_t>::max()) {
        return badData("the surface has more vertices or triangles than a mesh file can count", file);
    }
    if (!std::all_of(mesh.vertices_m.begin(), mesh.vertices_m.end(),
                     [](const auto& v) { return v.allFinite(); })) {
        return badData("the surface has a vertex that is not finite", file);
    }
    for (const auto& triangle : mesh.triangles) {
        if (*std::max_element(triangle.begin(), triangle.end()) >= count) {
            return badData("the surface has a triangle without a vertex", file);
        }
    }
    return {};
}

Eigen::Vector3d originOf(const std::vector<Eigen::Vector3d>& points_m) {
    Eigen::Vector3d low = points_m.front();
    Eigen::Vector3d high = low;
    for (const Eigen::Vector3d& point : points_m) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }
    const Eigen::Vector3d middle = 0.5 * (low + high);
    return middle.array().round();
}

std::string originText(const Eigen::Vector3d& origin_m) {
    // + 0.0 makes a negative zero positive.
    return fmt::format("{:.0f} {:.0f} {:.0f}", origin_m.x() + 0.0, origin_m.y() + 0.0, origin_m.z() + 0.0);
}

}  // namespace terrawalk
