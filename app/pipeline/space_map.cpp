#include "app/pipeline/space_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/pipeline/raster_input.hpp"
#include "io/output_folder.hpp"
#include "mapping/order_statistics.hpp"
#include "mapping/profile.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

constexpr double kSameTime_s = 5e-4;  // times are written in thousandths
constexpr std::size_t kRaysBetweenStops = 4096;

/// Whether range and place of the hit are sound, on the ground or not.
bool isSoundHit(const GroundPoint& point) {
    switch (point.state) {
        case GroundPointState::Used:
        case GroundPointState::Thinned:
        case GroundPointState::Tilted:
        case GroundPointState::Spike:
        case GroundPointState::StatisticalOutlier:
        case GroundPointState::Isolated:
        case GroundPointState::AboveGround:
            return point.enu_m.allFinite();
        case GroundPointState::NoRange:
        case GroundPointState::RangeTooShort:
        case GroundPointState::RangeTooLong:
        case GroundPointState::WeakReturn:
        case GroundPointState::Saturated:
        case GroundPointState::PositionUnsure:
        case GroundPointState::RunLeftOut:
            return false;
    }
    return false;
}

const TrajectoryEpoch* epochAt(const Trajectory& trajectory, double time_s) {
    const auto found =
        std::lower_bound(trajectory.epochs.begin(), trajectory.epochs.end(), time_s - kSameTime_s,
                         [](const TrajectoryEpoch& epoch, double time) { return epoch.time_s < time; });
    if (found == trajectory.epochs.end() || found->time_s > time_s + kSameTime_s) return nullptr;
    return &*found;
}

Result<std::vector<LaserRay>> raysOf(const std::vector<GroundPoint>& points,
                                     const std::vector<Trajectory>& trajectories,
                                     const MapProjection& projection, const ElevationGrid& dem,
                                     OccupancySummary& summary, Progress& progress,
                                     const std::stop_token& stop) {
    std::vector<LaserRay> rays;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % kRaysBetweenStops == 0) {
            if (stop.stop_requested()) return cancelled();
            progress.report(static_cast<double>(i) / static_cast<double>(points.size()), "placing rays");
        }
        const GroundPoint& point = points[i];
        const TrajectoryEpoch* const epoch = epochAt(trajectories[point.run], point.time_s);
        if (!isSoundHit(point) || epoch == nullptr || !epoch->position_enu_m.allFinite()) {
            ++summary.left_out;
            continue;
        }
        const auto from_m = projection.toMap(epoch->position_enu_m);
        const auto hit_m = projection.toMap(point.enu_m);
        if (!from_m) return tl::unexpected(from_m.error());
        if (!hit_m) return tl::unexpected(hit_m.error());
        const auto ground_m = bilinearAt(dem, hit_m->head<2>());
        if (ground_m && hit_m->z() < *ground_m - summary.ground_layer_m) {
            // Light that came back on a detour: its way did not lead through the ground.
            ++summary.below_ground;
            ++summary.left_out;
            continue;
        }
        rays.push_back({*from_m, *hit_m});
    }
    summary.rays = rays.size();
    return rays;
}

void summarize(const SpaceAboveGround& above, OccupancySummary& summary) {
    std::vector<double> known;
    for (std::size_t i = 0; i < above.free_height.heights_m.size(); ++i) {
        const float free_m = above.free_height.heights_m[i];
        if (std::isnan(free_m)) continue;
        ++summary.ground_cells;
        if (free_m > 0.0F) known.push_back(free_m);
        summary.cells_with_obstacle += std::isnan(above.obstacle_height.heights_m[i]) ? 0 : 1;
    }
    summary.cells_known_free = known.size();
    if (!known.empty()) summary.median_free_height_m = median(std::move(known));
}

Result<void> writeTree(const Result<std::string>& bytes, const fs::path& file) {
    if (!bytes) return tl::unexpected(bytes.error());
    return writeTextFile(*bytes, file);
}

}  // namespace

Result<void> checkOptions(const SpaceMapOptions& options) {
    if (options.above.ground_layer_m >= 0.0 &&
        options.above.greatest_height_m > options.above.ground_layer_m) {
        return {};
    }
    return usageError("the ground layer must lie below the greatest height");
}

Result<SpaceMap> mapSpace(const std::vector<GroundPoint>& points, const std::vector<Trajectory>& trajectories,
                          const MapProjection& projection, const ElevationGrid& dem,
                          const SpaceMapOptions& options, Progress& progress, std::stop_token stop) {
    if (auto fits = checkOptions(options); !fits) return tl::unexpected(fits.error());
    OccupancyOptions occupancy = options.occupancy;
    const GridGeometry& g = dem.geometry;
    occupancy.origin_m = {std::round(g.centreX(g.columns / 2)), std::round(g.centreY(g.rows / 2)), 0.0};
    OccupancySummary summary;
    summary.origin_m = occupancy.origin_m;
    summary.voxel_m = occupancy.voxel_m;
    summary.greatest_range_m = occupancy.greatest_range_m;
    summary.ground_layer_m = options.above.ground_layer_m;
    summary.greatest_height_m = options.above.greatest_height_m;
    PartialProgress placing(progress, 0.0, 0.3), building(progress, 0.3, 0.7), climbing(progress, 0.7, 1.0);
    const auto rays = raysOf(points, trajectories, projection, dem, summary, placing, stop);
    if (!rays) return tl::unexpected(rays.error());
    if (rays->empty()) return badData("no ground point has a sound ray");
    const auto fits = checkMemoryFor(fmt::format("an octree of {} rays", rays->size()),
                                     occupancyMemory_bytes(*rays, occupancy), "choose larger voxels");
    if (!fits) return tl::unexpected(fits.error());
    auto space = SpaceOccupancy::build(*rays, occupancy, building, stop);
    if (!space) return tl::unexpected(space.error());
    auto above = space->aboveGround(dem, options.above, climbing, stop);
    if (!above) return tl::unexpected(above.error());
    summary.free_m3 = space->volume_m3(Space::Free);
    summary.occupied_m3 = space->volume_m3(Space::Occupied);
    summarize(*above, summary);
    return SpaceMap{std::move(*space), std::move(*above), summary};
}

std::vector<std::pair<std::string, FileWriter>> spaceWriters(const SpaceMap& map, const DemDescription& base,
                                                             std::stop_token stop) {
    const auto raster = [&map, base, stop](const ElevationGrid& grid, std::string title,
                                           std::string quantity) -> FileWriter {
        DemDescription description = base;
        description.title = std::move(title);
        description.quantity = std::move(quantity);
        description.unit = "m";
        description.metadata = {{"METHOD", fmt::format("OctoMap, voxels of {:g} m", map.summary.voxel_m)}};
        return [&grid, description, stop](const fs::path& file) {
            return writeDem(grid, description, file, stop);
        };
    };
    std::vector<std::pair<std::string, FileWriter>> writers{
        {"occupancy.bt",
         [&map](const fs::path& file) {
             return writeTree(map.space.binaryTree(), file);
         }},
        {"occupancy.ot",
         [&map](const fs::path& file) {
             return writeTree(map.space.fullTree(), file);
         }},
        {"free_height.tif",
         raster(map.above.free_height, "Free height above ground", "Space above ground known to be free")}};
    if (map.summary.cells_with_obstacle > 0) {
        writers.emplace_back("obstacle_height.tif",
                             raster(map.above.obstacle_height, "Lowest obstacle above ground",
                                    "Height of the lowest obstacle"));
    }
    return writers;
}

}  // namespace terrawalk
