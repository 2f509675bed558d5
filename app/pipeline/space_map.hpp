#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "io/map_projection.hpp"
#include "io/write_products.hpp"
#include "mapping/space_occupancy.hpp"
#include "survey/elevation_grid.hpp"
#include "survey/ground_point.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey_report.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

// The space above the ground that the laser crossed: what `terrawalk process` and `terrawalk occupancy`
// share.

struct SpaceMap {
    SpaceOccupancy space;
    SpaceAboveGround above;
    OccupancySummary summary;
};

/// Error Usage for a ground layer that does not lie below the greatest height.
[[nodiscard]] Result<void> checkOptions(const SpaceMapOptions& options);

/// A ray runs from the array's place in the trajectory to the ground point of the same time: the lever arm of
/// the range finder is left out, so that its first centimetres are off by it. Hits count that the pipeline
/// used, thinned, or left out as spike, outlier, plant or for the array's tilt; those for a bad range or
/// place do not. Errors: BadData without a sound ray; Usage for voxels that the octree cannot hold; System
/// when the memory does not suffice; Cancelled.
/// @param trajectories  by GroundPoint::run
/// @param dem  map frame
[[nodiscard]] Result<SpaceMap> mapSpace(const std::vector<GroundPoint>& points,
                                        const std::vector<Trajectory>& trajectories,
                                        const MapProjection& projection, const ElevationGrid& dem,
                                        const SpaceMapOptions& options, Progress& progress,
                                        std::stop_token stop);

using FileWriter = std::function<Result<void>(const std::filesystem::path&)>;
/// File names and what writes them: occupancy.bt, occupancy.ot, free_height.tif, and obstacle_height.tif
/// where there is any obstacle. They refer to `map`, which has to live on.
/// @param base  of the DEM; quantity, title and method are filled in
[[nodiscard]] std::vector<std::pair<std::string, FileWriter>> spaceWriters(const SpaceMap& map,
                                                                           const DemDescription& base,
                                                                           std::stop_token stop);

}  // namespace terrawalk
