#include "app/pipeline/occupancy_job.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/pipeline/raster_input.hpp"
#include "app/pipeline/space_map.hpp"
#include "app/pipeline/survey_output.hpp"
#include "app/pipeline/version.hpp"
#include "io/output_folder.hpp"
#include "io/read_ground_points.hpp"
#include "io/read_trajectory.hpp"
#include "io/report_text.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

Result<std::vector<Trajectory>> readTrajectories(const fs::path& folder,
                                                 const std::vector<std::string>& run_ids) {
    std::vector<Trajectory> trajectories;
    for (const std::string& id : run_ids) {
        auto trajectory = readTrajectoryCsv(folder / "trajectory" / (id + ".csv"));
        if (!trajectory) return tl::unexpected(trajectory.error());
        trajectories.push_back(std::move(*trajectory));
    }
    return trajectories;
}

Result<void> writeFiles(const SpaceMap& map, const DemFile& dem, const fs::path& folder,
                        OccupancyOutcome& outcome, const std::stop_token& stop) {
    for (const auto& [name, write] : spaceWriters(map, describeDerived(dem, {}, {}, "m", {}), stop)) {
        outcome.files.push_back(folder / name);
        if (auto done = write(outcome.files.back()); !done) return done;
    }
    if (map.summary.cells_with_obstacle == 0) {
        std::error_code ignored;
        fs::remove(folder / "obstacle_height.tif", ignored);  // that of an earlier run would lie
    }
    outcome.files.push_back(folder / "occupancy.json");
    return writeTextFile(toJson(outcome), outcome.files.back());
}

}  // namespace

Result<OccupancyOutcome> mapOccupancy(const OccupancyRequest& request, Progress& progress,
                                      std::stop_token stop) {
    if (auto fits = checkOptions(request.map); !fits) return tl::unexpected(fits.error());
    const auto survey = openSurveyOutput(request.input);
    if (!survey) return tl::unexpected(survey.error());
    PartialProgress reading(progress, 0.0, 0.2);
    const auto table = readGroundPointsCsv(request.input / "ground_points.csv", reading, stop);
    if (!table) return tl::unexpected(table.error());
    const auto dem = readDem(request.input / "dem.tif", stop);
    if (!dem) return tl::unexpected(dem.error());

    const auto trajectories = readTrajectories(request.input, table->run_ids);
    if (!trajectories) return tl::unexpected(trajectories.error());
    PartialProgress mapping(progress, 0.2, 0.9);
    auto map =
        mapSpace(table->points, *trajectories, survey->projection, dem->grid, request.map, mapping, stop);
    if (!map) {
        Error error = map.error();
        if (error.kind == ErrorKind::BadData && error.file.empty()) {
            error.file = request.input / "ground_points.csv";
        }
        return tl::unexpected(error);
    }
    OccupancyOutcome outcome{request, survey->projection.name(), map->summary, {}};

    progress.report(0.9, "writing");
    fs::path folder = request.output;
    if (folder.empty()) {
        folder = request.input.has_filename() ? request.input : request.input.parent_path();
        folder += "-occupancy";
    }
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return systemError("cannot make the folder: " + error.message(), folder);
    if (auto done = writeFiles(*map, *dem, folder, outcome, stop); !done) {
        return tl::unexpected(done.error());
    }
    progress.report(1.0, "done");
    return outcome;
}

std::string toText(const OccupancyOutcome& o) {
    std::string text;
    for (const auto& [word, line] : inWords(o.summary)) text += fmt::format("{:<12}{}\n", word, line);
    for (const fs::path& file : o.files) text += "Written to " + printable(file.string()) + "\n";
    return text;
}

std::string toJson(const OccupancyOutcome& o) {
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const fs::path& file : o.files) files.push_back(file.filename().string());
    nlohmann::ordered_json document{
        {"format", "terrawalk-occupancy 1"}, {"program", programVersion()}, {"crs", o.crs}};
    document.update(nlohmann::ordered_json::parse(occupancyJson(o.summary)));
    document["files"] = files;
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
