#pragma once

#include <filesystem>
#include <stop_token>

#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/triangle_mesh.hpp"

namespace terrawalk {

/// Reads the triangles of a binary PLY file such as writePly() makes, its origin added. Errors: BadData for
/// another form of PLY, faces that are no triangles, or a damaged file; System; Cancelled.
[[nodiscard]] Result<TriangleMesh> readMeshPly(const std::filesystem::path& file, Progress& progress,
                                               std::stop_token stop);

}  // namespace terrawalk
