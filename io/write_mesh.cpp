#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "io/mesh_layout.hpp"
#include "io/replacing_file.hpp"
#include "io/write_products.hpp"

namespace terrawalk {

Result<void> writePly(const TriangleMesh& mesh, const std::string& crs_name,
                      const std::filesystem::path& file) {
    if (auto checked = checkMesh(mesh, file); !checked) return checked;
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    const Eigen::Vector3d origin_m = originOf(mesh.vertices_m);
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
    const Eigen::Vector3d origin_m = originOf(mesh.vertices_m);
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
