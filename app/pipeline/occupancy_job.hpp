#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "mapping/space_occupancy.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// What the laser knows of the space above the ground of a processed survey.
struct OccupancyRequest {
    std::filesystem::path input;   ///< folder that `process` wrote
    std::filesystem::path output;  ///< folder; empty: INPUT-occupancy
    OccupancyOptions options;      ///< the origin is set by the job
    FreeHeightOptions above;
};

struct OccupancyOutcome {
    OccupancyRequest request;
    std::string crs;
    Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< map coordinates of the octree's zero
    std::size_t rays = 0;
    std::size_t left_out = 0;      ///< ground points without a sound range, position or epoch
    std::size_t below_ground = 0;  ///< of them hits below the DEM by more than the ground layer
    double free_m3 = 0.0;
    double occupied_m3 = 0.0;
    std::size_t ground_cells = 0;
    std::size_t cells_known_free = 0;   ///< with free space right above the ground layer
    double median_free_height_m = 0.0;  ///< of those cells
    std::size_t cells_with_obstacle = 0;
    std::vector<std::filesystem::path> files;
};

/// Writes occupancy.bt, occupancy.ot, free_height.tif, obstacle_height.tif and occupancy.json. A ray runs
/// from the array's place in the trajectory to the ground point of the same time: the lever arm of the range
/// finder is not in the output folder, so that its first centimetres are off by it. Hits count that the
/// pipeline used, thinned, or left out as spike, outlier, plant or for the array's tilt; those for a bad
/// range or place do not. Errors: BadData; Usage for voxels that the octree cannot hold; System when the
/// memory does not suffice; Cancelled.
[[nodiscard]] Result<OccupancyOutcome> mapOccupancy(const OccupancyRequest& request, Progress& progress,
                                                    std::stop_token stop);

[[nodiscard]] std::string toText(const OccupancyOutcome& outcome);
[[nodiscard]] std::string toJson(const OccupancyOutcome& outcome);

}  // namespace terrawalk
