#include "app/pipeline/occupancy_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/pipeline/raster_input.hpp"
#include "app/pipeline/survey_output.hpp"
#include "app/pipeline/version.hpp"
#include "io/output_folder.hpp"
#include "io/read_ground_points.hpp"
#include "io/read_trajectory.hpp"
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

class RayMaker {
  public:
    RayMaker(const SurveyOutput& survey, const DemFile& dem, double ground_layer_m, OccupancyOutcome& outcome)
        : survey_(survey), dem_(dem), ground_layer_m_(ground_layer_m), outcome_(outcome) {}

    Result<std::vector<LaserRay>> make(const GroundPointTable& table, Progress& progress,
                                       const std::stop_token& stop) {
        std::vector<Trajectory> trajectories;
        for (const std::string& id : table.run_ids) {
            auto trajectory = readTrajectoryCsv(survey_.folder / "trajectory" / (id + ".csv"));
            if (!trajectory) return tl::unexpected(trajectory.error());
            trajectories.push_back(std::move(*trajectory));
        }
        std::vector<LaserRay> rays;
        for (std::size_t i = 0; i < table.points.size(); ++i) {
            if (i % kRaysBetweenStops == 0) {
                if (stop.stop_requested()) return cancelled();
                progress.report(static_cast<double>(i) / static_cast<double>(table.points.size()),
                                "placing rays");
            }
            const GroundPoint& point = table.points[i];
            const TrajectoryEpoch* const epoch = epochAt(trajectories[point.run], point.time_s);
            if (!isSoundHit(point) || epoch == nullptr || !epoch->position_enu_m.allFinite()) {
                ++outcome_.left_out;
                continue;
            }
            const auto from_m = survey_.projection.toMap(epoch->position_enu_m);
            const auto hit_m = survey_.projection.toMap(point.enu_m);
            if (!from_m) return tl::unexpected(from_m.error());
            if (!hit_m) return tl::unexpected(hit_m.error());
            const auto ground_m = bilinearAt(dem_.grid, hit_m->head<2>());
            if (ground_m && hit_m->z() < *ground_m - ground_layer_m_) {
                // Light that came back on a detour: its way did not lead through the ground.
                ++outcome_.below_ground;
                ++outcome_.left_out;
                continue;
            }
            rays.push_back({*from_m, *hit_m});
        }
        outcome_.rays = rays.size();
        return rays;
    }

  private:
    static const TrajectoryEpoch* epochAt(const Trajectory& trajectory, double time_s) {
        const auto found =
            std::lower_bound(trajectory.epochs.begin(), trajectory.epochs.end(), time_s - kSameTime_s,
                             [](const TrajectoryEpoch& epoch, double time) { return epoch.time_s < time; });
        if (found == trajectory.epochs.end() || found->time_s > time_s + kSameTime_s) return nullptr;
        return &*found;
    }
    const SurveyOutput& survey_;
    const DemFile& dem_;
    double ground_layer_m_;
    OccupancyOutcome& outcome_;
};

void summarize(const SpaceAboveGround& above, OccupancyOutcome& outcome) {
    std::vector<double> known;
    for (std::size_t i = 0; i < above.free_height.heights_m.size(); ++i) {
        const float free_m = above.free_height.heights_m[i];
        if (std::isnan(free_m)) continue;
        ++outcome.ground_cells;
        if (free_m > 0.0F) known.push_back(free_m);
        outcome.cells_with_obstacle += std::isnan(above.obstacle_height.heights_m[i]) ? 0 : 1;
    }
    outcome.cells_known_free = known.size();
    if (!known.empty()) outcome.median_free_height_m = median(std::move(known));
}

Result<void> writeTree(const Result<std::string>& bytes, const fs::path& file, OccupancyOutcome& outcome) {
    if (!bytes) return tl::unexpected(bytes.error());
    outcome.files.push_back(file);
    return writeTextFile(*bytes, file);
}

Result<void> writeFiles(const SpaceOccupancy& space, const SpaceAboveGround& above, const DemFile& dem,
                        const fs::path& folder, OccupancyOutcome& outcome, const std::stop_token& stop) {
    if (auto done = writeTree(space.binaryTree(), folder / "occupancy.bt", outcome); !done) return done;
    if (auto done = writeTree(space.fullTree(), folder / "occupancy.ot", outcome); !done) return done;
    const std::string method = fmt::format("OctoMap, voxels of {:g} m", outcome.request.options.voxel_m);
    outcome.files.push_back(folder / "free_height.tif");
    auto done = writeDem(
        above.free_height,
        describeDerived(dem, "Free height above ground", "Space above ground known to be free", "m", method),
        outcome.files.back(), stop);
    if (!done) return done;
    if (outcome.cells_with_obstacle > 0) {
        outcome.files.push_back(folder / "obstacle_height.tif");
        done = writeDem(above.obstacle_height,
                        describeDerived(dem, "Lowest obstacle above ground", "Height of the lowest obstacle",
                                        "m", method),
                        outcome.files.back(), stop);
        if (!done) return done;
    } else {
        std::error_code ignored;
        fs::remove(folder / "obstacle_height.tif", ignored);  // that of an earlier run would lie
    }
    outcome.files.push_back(folder / "occupancy.json");
    return writeTextFile(toJson(outcome), outcome.files.back());
}

}  // namespace

Result<OccupancyOutcome> mapOccupancy(const OccupancyRequest& request, Progress& progress,
                                      std::stop_token stop) {
    if (!(request.above.ground_layer_m >= 0.0) ||
        !(request.above.greatest_height_m > request.above.ground_layer_m)) {
        return usageError("the ground layer must lie below the greatest height");
    }
    const auto survey = openSurveyOutput(request.input);
    if (!survey) return tl::unexpected(survey.error());
    PartialProgress reading(progress, 0.0, 0.2);
    const auto table = readGroundPointsCsv(request.input / "ground_points.csv", reading, stop);
    if (!table) return tl::unexpected(table.error());
    const auto dem = readDem(request.input / "dem.tif", stop);
    if (!dem) return tl::unexpected(dem.error());

    OccupancyOutcome outcome{request, survey->projection.name()};
    PartialProgress placing(progress, 0.2, 0.4);
    const auto rays =
        RayMaker(*survey, *dem, request.above.ground_layer_m, outcome).make(*table, placing, stop);
    if (!rays) return tl::unexpected(rays.error());
    if (rays->empty()) return badData("no ground point has a sound ray", request.input / "ground_points.csv");
    OccupancyOptions options = request.options;
    const GridGeometry& g = dem->grid.geometry;
    options.origin_m = {std::round(g.centreX(g.columns / 2)), std::round(g.centreY(g.rows / 2)), 0.0};
    outcome.origin_m = options.origin_m;
    const auto fits = checkMemoryFor(fmt::format("an octree of {} rays", rays->size()),
                                     occupancyMemory_bytes(*rays, options), "choose larger voxels");
    if (!fits) return tl::unexpected(fits.error());
    PartialProgress building(progress, 0.4, 0.7);
    const auto space = SpaceOccupancy::build(*rays, options, building, stop);
    if (!space) return tl::unexpected(space.error());
    PartialProgress climbing(progress, 0.7, 0.9);
    const auto above = space->aboveGround(dem->grid, request.above, climbing, stop);
    if (!above) return tl::unexpected(above.error());
    outcome.free_m3 = space->volume_m3(Space::Free);
    outcome.occupied_m3 = space->volume_m3(Space::Occupied);
    summarize(*above, outcome);

    progress.report(0.9, "writing");
    fs::path folder = request.output;
    if (folder.empty()) {
        folder = request.input.has_filename() ? request.input : request.input.parent_path();
        folder += "-occupancy";
    }
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return systemError("cannot make the folder: " + error.message(), folder);
    if (auto done = writeFiles(*space, *above, *dem, folder, outcome, stop); !done) {
        return tl::unexpected(done.error());
    }
    progress.report(1.0, "done");
    return outcome;
}

std::string toText(const OccupancyOutcome& o) {
    const auto share = [&](std::size_t n) {
        return 100.0 * static_cast<double>(n) / static_cast<double>(std::max<std::size_t>(1, o.ground_cells));
    };
    std::string text = fmt::format(
        "Rays        {}; {} ground points left out, {} of them below the ground\n"
        "Space       {:.1f} m3 free, {:.1f} m3 occupied, in voxels of {:g} m about {:.0f} {:.0f} {:.0f}\n"
        "Free        right above the ground in {} of {} cells ({:.1f} %), there to {:.2f} m (median)\n"
        "Obstacles   above the ground in {} cells ({:.1f} %)\n",
        o.rays, o.left_out, o.below_ground, o.free_m3, o.occupied_m3, o.request.options.voxel_m,
        o.origin_m.x(), o.origin_m.y(), o.origin_m.z(), o.cells_known_free, o.ground_cells,
        share(o.cells_known_free), o.median_free_height_m, o.cells_with_obstacle,
        share(o.cells_with_obstacle));
    for (const fs::path& file : o.files) text += "Written to " + printable(file.string()) + "\n";
    return text;
}

std::string toJson(const OccupancyOutcome& o) {
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const fs::path& file : o.files) files.push_back(file.filename().string());
    const nlohmann::ordered_json document{
        {"format", "terrawalk-occupancy 1"},
        {"program", programVersion()},
        {"crs", o.crs},
        {"octree_origin_m", {o.origin_m.x(), o.origin_m.y(), o.origin_m.z()}},
        {"voxel_m", o.request.options.voxel_m},
        {"greatest_range_m", o.request.options.greatest_range_m},
        {"ground_layer_m", o.request.above.ground_layer_m},
        {"greatest_height_m", o.request.above.greatest_height_m},
        {"rays", o.rays},
        {"ground_points_left_out", o.left_out},
        {"hits_below_ground", o.below_ground},
        {"free_m3", o.free_m3},
        {"occupied_m3", o.occupied_m3},
        {"ground_cells", o.ground_cells},
        {"cells_known_free", o.cells_known_free},
        {"median_free_height_m", o.median_free_height_m},
        {"cells_with_obstacle", o.cells_with_obstacle},
        {"files", files}};
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
