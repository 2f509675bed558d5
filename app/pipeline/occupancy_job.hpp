#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "mapping/space_occupancy.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey_report.hpp"

namespace terrawalk {

/// What the laser knows of the space above the ground of a processed survey.
struct OccupancyRequest {
    std::filesystem::path input;   ///< folder that `process` wrote
    std::filesystem::path output;  ///< folder; empty: INPUT-occupancy
    SpaceMapOptions map;
};

struct OccupancyOutcome {
    OccupancyRequest request;
    std::string crs;
    OccupancySummary summary;
    std::vector<std::filesystem::path> files;
};

/// Writes the files of spaceWriters() and occupancy.json. Errors: as mapSpace(); BadData for files of the
/// folder that cannot be read.
[[nodiscard]] Result<OccupancyOutcome> mapOccupancy(const OccupancyRequest& request, Progress& progress,
                                                    std::stop_token stop);

[[nodiscard]] std::string toText(const OccupancyOutcome& outcome);
[[nodiscard]] std::string toJson(const OccupancyOutcome& outcome);

}  // namespace terrawalk
