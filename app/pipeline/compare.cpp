#include "app/pipeline/compare.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "app/pipeline/ground_track.hpp"
#include "app/pipeline/jobs.hpp"
#include "app/pipeline/version.hpp"
#include "fusion/fuse_survey.hpp"
#include "io/output_folder.hpp"
#include "io/read_trajectory.hpp"
#include "mapping/delaunay_tin.hpp"
#include "mapping/mark_residuals.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kComparisonFormat = "terrawalk-comparison 1";

double squared(double x) {
    return x * x;
}

/// Sums of what is to be a mean, or the root of a mean.
struct Sum {
    std::size_t n = 0;
    double total = 0.0;

    void add(double value) {
        if (!std::isfinite(value)) return;
        total += value;
        ++n;
    }
    MeasuredError mean() const { return {n, n == 0 ? 0.0 : total / static_cast<double>(n)}; }
    MeasuredError root() const { return {n, std::sqrt(mean().error_m)}; }
};

/// Heights against check marks, by mark.
using CheckErrors = std::map<std::string, double>;

/// A method's outcome and what is still to be reduced to the marks that all methods reach.
struct Measured {
    MethodOutcome outcome;
    std::optional<CheckErrors> surface;
    std::optional<CheckErrors> nearest;
};

CheckErrors checkErrors(const MarkResiduals& residuals) {
    CheckErrors errors;
    for (const Residual& residual : residuals.residuals) {
        if (residual.role != MarkRole::Check || !std::isfinite(residual.difference_enu_m.z())) continue;
        errors[residual.mark] = residual.difference_enu_m.z();
    }
    return errors;
}

void measureStands(const Survey& survey, const GroundTrack& track, const StandOptions& stands, bool tied,
                   MethodOutcome& outcome) {
    Sum target_h, target_v, stop_h, stop_v;
    for (std::size_t i = 0; i < survey.runs.size(); ++i) {
        const Run& run = survey.runs[i];
        const auto residuals =
            positionResiduals(run, markStands(survey, run, stands), track.runs[i].trajectory,
                              pointsOfRun(track.points, track, i), Stage::Fused, tied);
        for (const Residual& residual : residuals.residuals) {
            if (residual.used_by_estimator) continue;
            const bool is_target = run.kind == RunKind::FixedPoint && run.target == residual.mark;
            (is_target ? target_h : stop_h).add(residual.difference_enu_m.head<2>().squaredNorm());
            (is_target ? target_v : stop_v).add(squared(residual.difference_enu_m.z()));
        }
    }
    outcome.target_horizontal = target_h.root();
    outcome.target_vertical = target_v.root();
    outcome.stop_horizontal = stop_h.root();
    outcome.stop_vertical = stop_v.root();
}

void measureTruth(const Survey& survey, const std::vector<FusedRun>& runs,
                  const std::vector<std::optional<Trajectory>>& truth, MethodOutcome& outcome) {
    constexpr double kSameTime_s = 0.0006;  // truth files have milliseconds
    Sum area_h, area_v, fixed_h, fixed_v, nees;
    for (std::size_t r = 0; r < runs.size(); ++r) {
        if (!truth[r]) continue;
        const bool is_area = survey.runs[r].kind == RunKind::Area;
        auto at = truth[r]->epochs.begin();
        for (const TrajectoryEpoch& epoch : runs[r].trajectory.epochs) {
            while (at != truth[r]->epochs.end() && at->time_s < epoch.time_s - kSameTime_s) ++at;
            if (at == truth[r]->epochs.end()) break;
            if (at->time_s > epoch.time_s + kSameTime_s) continue;
            const Eigen::Vector3d d = epoch.position_enu_m - at->position_enu_m;
            (is_area ? area_h : fixed_h).add(d.head<2>().squaredNorm());
            (is_area ? area_v : fixed_v).add(squared(d.z()));
            const Eigen::Matrix3d P = epoch.covariance.topLeftCorner<3, 3>();
            nees.add(d.dot(P.ldlt().solve(d)) / 3.0);
        }
    }
    outcome.area_horizontal = area_h.root();
    outcome.area_vertical = area_v.root();
    outcome.fixed_horizontal = fixed_h.root();
    outcome.fixed_vertical = fixed_v.root();
    outcome.nees = nees.mean();
}

// Of all runs, each reading counting the same.
std::vector<SensorConsistency> pooled(const std::vector<FusedRun>& runs) {
    std::vector<SensorConsistency> pool;
    for (const FusedRun& run : runs) {
        for (const SensorConsistency& sensor : run.consistency) {
            auto found = std::find_if(pool.begin(), pool.end(),
                                      [&](const SensorConsistency& p) { return p.sensor == sensor.sensor; });
            if (found == pool.end()) found = pool.insert(pool.end(), {sensor.sensor, 0, 0.0, 0.0});
            const auto before = static_cast<double>(found->n);
            const auto more = static_cast<double>(sensor.n);
            found->dof = (before * found->dof + more * sensor.dof) / (before + more);
            found->mean_nis = (before * found->mean_nis + more * sensor.mean_nis) / (before + more);
            found->n += sensor.n;
        }
    }
    return pool;
}

Result<DelaunayTin> surfaceOf(const Survey& survey, const GroundTrack& track, const SurfaceOptions& options,
                              const std::stop_token& stop) {
    std::vector<Eigen::Vector3d> carrying_m;
    SilentProgress silent;
    const auto points = surfacePoints(survey, track.points, options, silent, stop);
    if (!points) return tl::unexpected(points.error());
    for (const GroundPoint& point : *points) {
        if (point.state == GroundPointState::Used) carrying_m.push_back(point.enu_m);
    }
    return DelaunayTin::build(carrying_m, options.tin, silent, stop);
}

// Fails only when it was cancelled; a method's own failure is its outcome.
Result<Measured> measure(const Survey& survey, const ComparedMethod& method,
                         const std::vector<std::optional<Trajectory>>& truth, const PipelineConfig& config,
                         Progress& progress, const std::stop_token& stop) {
    Measured measured;
    MethodOutcome& outcome = measured.outcome;
    outcome.name = method.name;
    const auto began = std::chrono::steady_clock::now();
    auto fused = fuseSurvey(survey, method.fusion, progress, stop);
    outcome.fusion_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (!fused) {
        if (fused.error().kind == ErrorKind::Cancelled) return tl::unexpected(fused.error());
        outcome.failure = fused.error().text();
        return measured;
    }
    measureTruth(survey, fused->runs, truth, outcome);
    outcome.consistency = pooled(fused->runs);
    const auto track = groundBelow(survey, std::move(fused->runs), config.ground, stop);
    if (!track) return tl::unexpected(track.error());
    const bool tied = tiesToMarks(method.fusion.method);
    measureStands(survey, *track, method.fusion.stands, tied, outcome);
    const auto tied_marks = tied ? tiedMarks(survey, method.fusion.stands) : std::set<std::string>{};
    measured.nearest =
        checkErrors(nearestSampleResiduals(survey, track->points, Stage::Fused, tied_marks,
                                           {.greatest_distance_m = config.report.nearest_sample_limit_m}));
    const auto surface = surfaceOf(survey, *track, config.surface, stop);
    if (surface) {
        const auto height = [&](const Eigen::Vector3d& place) -> std::optional<SurfaceHeight> {
            const auto height_m = surface->heightAt(place.x(), place.y());
            if (!height_m) return std::nullopt;
            return SurfaceHeight{*height_m};
        };
        measured.surface = checkErrors(surfaceResiduals(survey.marks, height, Stage::Surface, tied_marks));
    } else if (surface.error().kind == ErrorKind::Cancelled) {
        return tl::unexpected(surface.error());
    } else {
        outcome.failure = surface.error().text();
    }
    return measured;
}

// Marks that every method reaches, of those that have a surface at all.
std::set<std::string> commonMarks(const std::vector<Measured>& measured,
                                  std::optional<CheckErrors> Measured::*errors) {
    std::map<std::string, std::size_t> met;
    std::size_t methods = 0;
    for (const Measured& m : measured) {
        if (!(m.*errors)) continue;
        ++methods;
        for (const auto& [mark, error] : *(m.*errors)) ++met[mark];
    }
    std::set<std::string> common;
    for (const auto& [mark, n] : met) {
        if (n == methods) common.insert(mark);
    }
    return common;
}

void reduceToCommonMarks(std::vector<Measured>& measured) {
    const auto surface_marks = commonMarks(measured, &Measured::surface);
    const auto nearest_marks = commonMarks(measured, &Measured::nearest);
    for (Measured& m : measured) {
        Sum surface, nearest;
        for (const std::string& mark : surface_marks) {
            if (m.surface) surface.add(squared(m.surface->at(mark)));
        }
        for (const std::string& mark : nearest_marks) {
            if (m.nearest) nearest.add(std::abs(m.nearest->at(mark)));
        }
        m.outcome.check_surface = surface.root();
        m.outcome.check_nearest = nearest.mean();
    }
}

Cell cellOf(const MeasuredError& error) {
    if (error.n == 0) return {};
    return error.error_m;
}

struct ErrorColumn {
    std::string_view name;
    MeasuredError MethodOutcome::*error;
};
constexpr std::array kErrorColumns{
    ErrorColumn{"target H [m]", &MethodOutcome::target_horizontal},
    ErrorColumn{"target V [m]", &MethodOutcome::target_vertical},
    ErrorColumn{"stop H [m]", &MethodOutcome::stop_horizontal},
    ErrorColumn{"stop V [m]", &MethodOutcome::stop_vertical},
    ErrorColumn{"check surface [m]", &MethodOutcome::check_surface},
    ErrorColumn{"check nearest [m]", &MethodOutcome::check_nearest},
    ErrorColumn{"area H [m]", &MethodOutcome::area_horizontal},
    ErrorColumn{"area V [m]", &MethodOutcome::area_vertical},
    ErrorColumn{"fixed H [m]", &MethodOutcome::fixed_horizontal},
    ErrorColumn{"fixed V [m]", &MethodOutcome::fixed_vertical},
};

// Sensors that any method tells of, in the order in which they are met.
std::vector<std::string> consistentSensors(const MethodComparison& comparison) {
    std::vector<std::string> sensors;
    for (const MethodOutcome& outcome : comparison.outcomes) {
        for (const SensorConsistency& sensor : outcome.consistency) {
            if (std::find(sensors.begin(), sensors.end(), sensor.sensor) == sensors.end()) {
                sensors.push_back(sensor.sensor);
            }
        }
    }
    return sensors;
}

std::string notesText(const MethodComparison& comparison) {
    std::string text =
        "target, stop: RMSE of the array on marks that the method is not tied to there; check: heights at "
        "the "
        "check marks that every method reaches, RMSE of the surface and mean absolute error of the nearest "
        "ground sample";
    text += comparison.has_truth
                ? "; area, fixed: RMSE of the array over all epochs against the simulated truth.\n"
                : ". The survey has no truth beside it.\n";
    text +=
        "NEES: squared error of the position in units of its covariance, over 3. NIS: squared innovations in "
        "units "
        "of theirs, over their degrees of freedom. 1 is honest, more is too sure. Empty: the method does not "
        "tell.\n";
    for (const MethodOutcome& outcome : comparison.outcomes) {
        if (!outcome.failure.empty()) text += fmt::format("{}: {}\n", outcome.name, outcome.failure);
    }
    return text;
}

Result<void> writeComparison(const MethodComparison& comparison, const PipelineConfig& config,
                             const Provenance& provenance, OutputFolder& folder) {
    const nlohmann::ordered_json manifest{{"format", kComparisonFormat},
                                          {"program", programVersion()},
                                          {"command", provenance.command},
                                          {"survey", comparison.survey_name},
                                          {"products", {"comparison.csv", "comparison.txt", kManifestName}},
                                          {"configuration", nlohmann::ordered_json::parse(toJson(config))}};
    for (const auto& [name, text] :
         {std::pair<std::string, std::string>{"comparison.csv", toCsv(fullTable(comparison))},
          {"comparison.txt", toText(comparison)},
          {std::string(kManifestName),
           manifest.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"}}) {
        const auto path = folder.pathFor(name);
        if (!path) return tl::unexpected(path.error());
        if (auto written = writeTextFile(text, *path); !written) return written;
    }
    return folder.commit();
}

}  // namespace

std::vector<ComparedMethod> comparedMethods(const FusionOptions& options) {
    std::vector<ComparedMethod> methods;
    for (const auto& [method, method_name] : kFusionMethodNames) {
        FusionOptions fusion = options;
        fusion.method = method;
        // The targets of fixed-point runs are what methods are compared at: no method may know them.
        fusion.stands.tie_fixed_targets = false;
        if (method != FusionMethod::Aukf) {
            methods.push_back({std::string(method_name), fusion});
            continue;
        }
        for (const auto& [filter, filter_name] : kFilterNames) {
            fusion.aukf.filter = filter;
            methods.push_back({fmt::format("{} {}", method_name, filter_name), fusion});
        }
    }
    return methods;
}

Result<std::vector<std::optional<Trajectory>>> readTruth(const Survey& survey) {
    std::vector<std::optional<Trajectory>> truth;
    for (const Run& run : survey.runs) {
        const fs::path file = survey.project_file.parent_path() / "truth" / (run.id + ".csv");
        std::error_code error;
        if (!fs::exists(file, error)) {
            truth.emplace_back();
            continue;
        }
        auto trajectory = readTrajectoryCsv(file);
        if (!trajectory) return tl::unexpected(trajectory.error());
        truth.emplace_back(std::move(*trajectory));
    }
    return truth;
}

Result<MethodComparison> compareMethods(const Survey& survey,
                                        const std::vector<std::optional<Trajectory>>& truth,
                                        const PipelineConfig& config, Progress& progress,
                                        std::stop_token stop) {
    MethodComparison comparison;
    comparison.survey_name = survey.name;
    comparison.has_truth =
        std::any_of(truth.begin(), truth.end(), [](const auto& t) { return t.has_value(); });
    const std::vector<ComparedMethod> methods = comparedMethods(config.fusion);
    std::vector<Measured> measured;
    for (std::size_t i = 0; i < methods.size(); ++i) {
        const auto share = [&](std::size_t done) {
            return static_cast<double>(done) / static_cast<double>(methods.size());
        };
        PartialProgress part(progress, share(i), share(i + 1));
        auto outcome = measure(survey, methods[i], truth, config, part, stop);
        if (!outcome) return tl::unexpected(outcome.error());
        measured.push_back(std::move(*outcome));
    }
    reduceToCommonMarks(measured);
    for (Measured& m : measured) comparison.outcomes.push_back(std::move(m.outcome));
    progress.report(1.0, "compared");
    return comparison;
}

ExperimentTable errorTable(const MethodComparison& comparison) {
    ExperimentTable table;
    table.columns.emplace_back("method");
    for (const ErrorColumn& column : kErrorColumns) table.columns.emplace_back(column.name);
    for (const MethodOutcome& outcome : comparison.outcomes) {
        std::vector<Cell>& row = table.rows.emplace_back();
        row.emplace_back(outcome.name);
        for (const ErrorColumn& column : kErrorColumns) row.push_back(cellOf(outcome.*column.error));
    }
    return table;
}

ExperimentTable consistencyTable(const MethodComparison& comparison) {
    const std::vector<std::string> sensors = consistentSensors(comparison);
    ExperimentTable table{{"method", "time [s]", "NEES"}, {}};
    for (const std::string& sensor : sensors) table.columns.push_back("NIS " + sensor);
    for (const MethodOutcome& outcome : comparison.outcomes) {
        std::vector<Cell>& row = table.rows.emplace_back();
        row.emplace_back(outcome.name);
        row.emplace_back(outcome.fusion_s);
        row.push_back(cellOf(outcome.nees));
        for (const std::string& name : sensors) {
            const auto found = std::find_if(outcome.consistency.begin(), outcome.consistency.end(),
                                            [&](const SensorConsistency& s) { return s.sensor == name; });
            row.emplace_back();
            if (found != outcome.consistency.end()) row.back() = found->mean_nis / found->dof;
        }
    }
    return table;
}

ExperimentTable fullTable(const MethodComparison& comparison) {
    ExperimentTable table = errorTable(comparison);
    const ExperimentTable consistency = consistencyTable(comparison);
    table.columns.insert(table.columns.end(), consistency.columns.begin() + 1, consistency.columns.end());
    for (const ErrorColumn& column : kErrorColumns) {
        table.columns.push_back("n " + std::string(column.name.substr(0, column.name.find(" ["))));
    }
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        std::vector<Cell>& row = table.rows[i];
        row.insert(row.end(), consistency.rows[i].begin() + 1, consistency.rows[i].end());
        for (const ErrorColumn& column : kErrorColumns) {
            row.emplace_back(static_cast<double>((comparison.outcomes[i].*column.error).n));
        }
    }
    return table;
}

std::string toText(const MethodComparison& comparison) {
    return fmt::format("{}\n\n{}\n{}\n{}", printable(comparison.survey_name), toText(errorTable(comparison)),
                       toText(consistencyTable(comparison)), notesText(comparison));
}

std::string toJson(const MethodComparison& comparison, const fs::path& output) {
    nlohmann::ordered_json document{
        {"format", kComparisonFormat},
        {"survey", comparison.survey_name},
        {"truth", comparison.has_truth},
        {"methods", nlohmann::ordered_json::parse(toJson(fullTable(comparison)))}};
    for (std::size_t i = 0; i < comparison.outcomes.size(); ++i) {
        const std::string& failure = comparison.outcomes[i].failure;
        if (!failure.empty()) document["methods"][i]["failure"] = failure;
    }
    if (!output.empty()) document["csv"] = (output / "comparison.csv").string();
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Result<MethodComparison> compareSurvey(const fs::path& path, const PipelineConfig& config,
                                       const Provenance& provenance, const fs::path& output,
                                       Progress& progress, std::stop_token stop) {
    // A folder that may not be replaced is said at once, not after the work.
    std::optional<OutputFolder> folder;
    if (!output.empty()) {
        auto created = OutputFolder::create(output, kComparisonFormat);
        if (!created) return tl::unexpected(created.error());
        folder = std::move(*created);
    }
    PartialProgress reading(progress, 0.0, 0.1);
    const auto survey = openSurvey(path, reading, stop, config.edits);
    if (!survey) return tl::unexpected(survey.error());
    const auto truth = readTruth(*survey);
    if (!truth) return tl::unexpected(truth.error());
    PartialProgress comparing(progress, 0.1, 1.0);
    auto comparison = compareMethods(*survey, *truth, config, comparing, stop);
    if (!comparison || !folder) return comparison;
    if (auto done = writeComparison(*comparison, config, provenance, *folder); !done) {
        return tl::unexpected(done.error());
    }
    return comparison;
}

}  // namespace terrawalk
