#include "app/pipeline/jobs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/pipeline/tune_jobs.hpp"
#include "app/pipeline/version.hpp"
#include "io/map_projection.hpp"
#include "io/output_folder.hpp"
#include "io/read_survey.hpp"
#include "io/write_products.hpp"
#include "io/write_survey.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

constexpr const char* kProjectFile = "survey.json";

fs::path projectFileOf(const fs::path& path) {
    std::error_code error;
    return fs::is_directory(path, error) ? path / kProjectFile : path;
}

/// Whether replacing the folder would take the file with it.
bool liesIn(const fs::path& file, const fs::path& folder) {
    std::error_code error;
    const fs::path inner = fs::weakly_canonical(file, error);
    const fs::path outer = fs::weakly_canonical(folder / "", error);
    const fs::path trimmed = outer.has_filename() ? outer : outer.parent_path();
    return !error &&
           std::mismatch(trimmed.begin(), trimmed.end(), inner.begin(), inner.end()).first == trimmed.end();
}

/// A folder for the products, apart from the survey that they come from.
Result<OutputFolder> outputFolder(const fs::path& project_file, const fs::path& output) {
    if (liesIn(project_file, output)) {
        return usageError(
            fmt::format("the survey {} lies in the output folder {}", project_file.string(), output.string()),
            "choose another folder for the output");
    }
    return OutputFolder::create(output);
}

Result<void> writeAndCommit(const Survey& survey, const Products& products, const Provenance& provenance,
                            OutputFolder& folder, Progress& progress, const std::stop_token& stop) {
    if (auto done = writeProducts(survey, products, provenance, folder, progress, stop); !done) return done;
    if (stop.stop_requested()) return cancelled();
    if (auto done = folder.commit(); !done) return done;
    progress.report(1.0, "done");
    return {};
}

/// True heights over everything that was walked, in the local frame.
ElevationGrid truthGrid(const SimulatedSurvey& simulated, double cell_m) {
    Eigen::Vector2d least = Eigen::Vector2d::Zero();
    Eigen::Vector2d greatest = Eigen::Vector2d::Zero();
    for (const Trajectory& run : simulated.truth) {
        for (const TrajectoryEpoch& epoch : run.epochs) {
            least = least.cwiseMin(epoch.position_enu_m.head<2>());
            greatest = greatest.cwiseMax(epoch.position_enu_m.head<2>());
        }
    }
    constexpr double kMargin_m = 2.0;
    ElevationGrid grid;
    GridGeometry& g = grid.geometry;
    g.cell_m = cell_m;
    g.west_m = std::floor((least.x() - kMargin_m) / cell_m) * cell_m;
    g.north_m = std::ceil((greatest.y() + kMargin_m) / cell_m) * cell_m;
    g.columns = static_cast<std::size_t>(std::ceil((greatest.x() + kMargin_m - g.west_m) / cell_m));
    g.rows = static_cast<std::size_t>(std::ceil((g.north_m - least.y() + kMargin_m) / cell_m));
    grid.heights_m.reserve(g.size());
    for (std::size_t row = 0; row < g.rows; ++row) {
        for (std::size_t column = 0; column < g.columns; ++column) {
            grid.heights_m.push_back(
                static_cast<float>(simulated.terrain_height_m(g.centreX(column), g.centreY(row))));
        }
    }
    return grid;
}

Result<void> writeTruth(const SimulatedSurvey& simulated, OutputFolder& folder,
                        std::vector<std::string>& files, const std::stop_token& stop) {
    for (const Trajectory& run : simulated.truth) {
        if (stop.stop_requested()) return cancelled();
        files.push_back("truth/" + run.run_id + ".csv");
        const auto path = folder.pathFor(files.back());
        if (!path) return tl::unexpected(path.error());
        if (auto done = writeTrajectoryCsv(run, *path); !done) return done;
    }
    files.emplace_back("truth/terrain.tif");
    const auto path = folder.pathFor(files.back());
    if (!path) return tl::unexpected(path.error());
    const auto frame = MapProjection::create(simulated.survey.frame(), "", "local");
    if (!frame) return tl::unexpected(frame.error());
    return writeDem(truthGrid(simulated, 0.5),
                    {.crs_wkt2 = frame->wkt2(),
                     .vertical_datum = "local",
                     .title = simulated.survey.name + ", true terrain",
                     .software = programVersion(),
                     .metadata = {}},
                    *path, stop);
}

std::vector<double> listed(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

std::vector<std::string> disturbanceNames(const SimulationOptions& options) {
    std::vector<std::string> names;
    for (const Disturbance disturbance : options.disturbances) names.emplace_back(name(disturbance));
    return names;
}

std::string simulationManifest(const SimulationOptions& o, const Survey& survey,
                               std::vector<std::string> files) {
    files.emplace_back("manifest.json");
    const nlohmann::ordered_json manifest{{"format", kSimulationFormat},
                                          {"program", programVersion()},
                                          {"simulated", true},
                                          {"survey", survey.name},
                                          {"seed", o.seed},
                                          {"terrain", name(o.terrain)},
                                          {"faults", name(o.faults)},
                                          {"gnss", name(o.gnss)},
                                          {"noise_scale", o.noise_scale},
                                          {"disturbances", disturbanceNames(o)},
                                          {"area_east_m", o.area_east_m},
                                          {"area_north_m", o.area_north_m},
                                          {"line_spacing_m", o.line_spacing_m},
                                          {"sample_interval_s", o.sample_interval_s},
                                          {"fixed_point_runs", o.fixed_point_runs},
                                          {"fixed_point_epochs", o.fixed_point_epochs},
                                          {"area_epochs", o.area_epochs},
                                          {"control_stops", o.control_stops},
                                          {"check_stops", o.check_stops},
                                          {"check_points", o.check_points},
                                          {"end_on_zero", o.end_on_zero},
                                          {"doppler_velocity", o.doppler_velocity},
                                          {"range_lever_arm_m", listed(o.range_lever_arm_m)},
                                          {"gnss_lever_arm_m", listed(o.gnss_lever_arm_m)},
                                          {"products", files}};
    return manifest.dump(2) + "\n";
}

}  // namespace

Result<Survey> openSurvey(const fs::path& path, Progress& progress, std::stop_token stop,
                          const SurveyEdits& edits) {
    auto survey = readSurvey(projectFileOf(path), progress, std::move(stop));
    if (!survey || edits.empty()) return survey;
    return withEdits(std::move(*survey), edits);
}

Result<Products> processSurvey(const fs::path& path, const PipelineConfig& config,
                               const Provenance& provenance, const fs::path& output, Progress& progress,
                               std::stop_token stop, const std::optional<TuneOptions>& tuning) {
    // A folder that may not be replaced is said at once, not after the work.
    auto folder = outputFolder(projectFileOf(path), output);
    if (!folder) return tl::unexpected(folder.error());
    // A search takes far longer than all the rest.
    const double search = tuning ? 0.9 : 0.0;
    const auto after = [&](double share) {
        return search + share * (1.0 - search);
    };
    PartialProgress reading(progress, 0.0, 0.2 * (1.0 - search));
    const auto survey = openSurvey(path, reading, stop, config.edits);
    if (!survey) return tl::unexpected(survey.error());
    Result<PipelineConfig> chosen = config;
    PartialProgress searching(progress, 0.2 * (1.0 - search), after(0.2));
    if (tuning) chosen = tunedWhereBetter(*survey, config, *tuning, searching, stop);
    if (!chosen) return tl::unexpected(chosen.error());
    PartialProgress processing(progress, after(0.2), after(0.8));
    auto products = process(*survey, *chosen, processing, stop);
    if (!products) return products;
    // Tuned values were used, not requested.
    const std::vector<UsedSetting> settings = settingsReport(config, products->used);
    std::copy(settings.begin(), settings.end(), products->report.settings.begin());
    PartialProgress writing(progress, after(0.8), 1.0);
    if (auto done = writeAndCommit(*survey, *products, provenance, *folder, writing, stop); !done) {
        return tl::unexpected(done.error());
    }
    return products;
}

Result<void> saveProducts(const Survey& survey, const Products& products, const Provenance& provenance,
                          const fs::path& output, Progress& progress, std::stop_token stop) {
    auto folder = outputFolder(survey.project_file, output);
    if (!folder) return tl::unexpected(folder.error());
    return writeAndCommit(survey, products, provenance, *folder, progress, stop);
}

Result<void> simulateSurveyFolder(const SimulationOptions& options, const fs::path& output,
                                  Progress& progress, std::stop_token stop) {
    auto folder = OutputFolder::create(output, kSimulationFormat);
    if (!folder) return tl::unexpected(folder.error());
    PartialProgress simulating(progress, 0.0, 0.6);
    const auto simulated = simulateSurvey(options, simulating, stop);
    if (!simulated) return tl::unexpected(simulated.error());
    progress.report(0.6, "writing the survey");
    const auto project = folder->pathFor(kProjectFile);
    if (!project) return tl::unexpected(project.error());
    if (auto done = writeSurvey(simulated->survey, project->parent_path()); !done) return done;
    std::vector<std::string> files{kProjectFile};
    if (!simulated->survey.marks.empty()) files.emplace_back("control.csv");
    for (const Run& run : simulated->survey.runs) files.push_back("logs/" + run.id + ".csv");
    if (auto done = writeTruth(*simulated, *folder, files, stop); !done) return done;
    const auto manifest = folder->pathFor("manifest.json");
    if (!manifest) return tl::unexpected(manifest.error());
    if (auto done =
            writeTextFile(simulationManifest(options, simulated->survey, std::move(files)), *manifest);
        !done) {
        return done;
    }
    if (stop.stop_requested()) return cancelled();
    return folder->commit();
}

Result<std::vector<LogSummary>> inspectFiles(const fs::path& path, Progress& progress, std::stop_token stop) {
    const fs::path file = projectFileOf(path);
    std::vector<LogSummary> summaries;
    if (file.extension() == ".json") {
        const auto survey = readSurvey(file, progress, stop);
        if (!survey) return tl::unexpected(survey.error());
        for (const Run& run : survey->runs) summaries.push_back(inspectLog(run.log, run.id));
    } else {
        const auto log = readArrayLog(file, progress, stop);
        if (!log) return tl::unexpected(log.error());
        summaries.push_back(inspectLog(*log, ""));
    }
    return summaries;
}

}  // namespace terrawalk
