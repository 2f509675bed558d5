#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "io/replacing_file.hpp"
#include "io/write_products.hpp"

namespace terrawalk {

namespace {

static_assert(std::endian::native == std::endian::little,
              "the PLY writer copies numbers as they lie in memory");

/// A header line ends at a line feed, so a name may hold none.
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

/// Middle of the mesh in whole metres: offsets from it are small enough for float, and it prints exactly.
Eigen::Vector3d originOf(const TriangleMesh& mesh) {
    Eigen::Vector3d low = mesh.vertices_m.front();
    Eigen::Vector3d high = low;
    for (const Eigen::Vector3d& vertex : mesh.vertices_m) {
        low = low.cwiseMin(vertex);
        high = high.cwiseMax(vertex);
    }
    const Eigen::Vector3d middle = 0.5 * (low + high);
    return middle.array().round();
}

std::string originText(const Eigen::Vector3d& origin_m) {
    // + 0.0 makes a negative zero positive.
    return fmt::format("{:.0f} {:.0f} {:.0f}", origin_m.x() + 0.0, origin_m.y() + 0.0, origin_m.z() + 0.0);
}

template <class T>
char* put(char* to, T value) {
    std::memcpy(to, &value, sizeof value);
    return to + sizeof value;
}

}  // namespace

Result<void> writePly(const TriangleMesh& mesh, const std::string& crs_name,
                      const std::filesystem::path& file) {
    if (auto checked = checkMesh(mesh, file); !checked) return checked;
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    const Eigen::Vector3d origin_m = originOf(mesh);
    auto written = out->write(
        fmt::format("ply\nformat binary_little_endian 1.0\n"
                    "comment Terrawalk surface; map coordinates in metres are origin_m + x y z\n"
                    "comment crs {}\ncomment origin_m {}\n"
                    "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
                    "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                    oneLine(crs_name), originText(origin_m), mesh.vertices_m.size(), mesh.triangles.size()));
    for (std::size_t i = 0; written && i < mesh.vertices_m.size(); ++i) {
        const Eigen::Vector3f offset_m = (mesh.vertices_m[i] - origin_m).cast<float>();
        std::array<char, 12> record{};
        put(put(put(record.data(), offset_m.x()), offset_m.y()), offset_m.z());
        written = out->write({record.data(), record.size()});
    }
    for (std::size_t i = 0; written && i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        std::array<char, 13> record{3};
        put(put(put(record.data() + 1, a), b), c);
        written = out->write({record.data(), record.size()});
    }
    if (!written) return written;
    return out->commit();
}

Result<void> writeObj(const TriangleMesh& mesh, const std::string& crs_name,
                      const std::filesystem::path& file) {
    if (auto checked = checkMesh(mesh, file); !checked) return checked;
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    const Eigen::Vector3d origin_m = originOf(mesh);
    auto written = out->write(fmt::format(
        "# Terrawalk surface; map coordinates in metres are origin_m + x y z\n# crs {}\n# origin_m {}\n",
        oneLine(crs_name), originText(origin_m)));
    std::array<char, 1200> line{};  // a double of any size with 4 decimals takes at most 315 characters
    const auto writeLine = [&](const char* end) {
        return out->write({line.data(), static_cast<std::size_t>(end - line.data())});
    };
    for (std::size_t i = 0; written && i < mesh.vertices_m.size(); ++i) {
        const Eigen::Vector3d offset_m = mesh.vertices_m[i] - origin_m;
        written = writeLine(fmt::format_to(line.data(), FMT_COMPILE("v {:.4f} {:.4f} {:.4f}\n"), offset_m.x(),
                                           offset_m.y(), offset_m.z()));
    }
    for (std::size_t i = 0; written && i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        written = writeLine(fmt::format_to(line.data(), FMT_COMPILE("f {} {} {}\n"), std::uint64_t{a} + 1,
                                           std::uint64_t{b} + 1, std::uint64_t{c} + 1));
    }
    if (!written) return written;
    return out->commit();
}

}  // namespace terrawalk
