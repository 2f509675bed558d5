#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "survey/ground_point.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

struct GroundPointTable {
    std::vector<GroundPoint> points;   ///< local ENU; plan sigmas and epochs are not in the file
    std::vector<std::string> run_ids;  ///< that GroundPoint::run counts, in the order of the file
};

/// Reads what writeGroundPointsCsv() wrote, columns in any order. A point without a place stays, not finite.
/// Errors: BadData with file and line; System; Cancelled.
[[nodiscard]] Result<GroundPointTable> readGroundPointsCsv(const std::filesystem::path& file,
                                                           Progress& progress, std::stop_token stop);

}  // namespace terrawalk
