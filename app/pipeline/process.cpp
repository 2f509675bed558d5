#include "app/pipeline/process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "app/pipeline/ground_track.hpp"
#include "app/pipeline/inspect.hpp"
#include "app/pipeline/relief.hpp"
#include "app/pipeline/surface_model.hpp"
#include "app/pipeline/version.hpp"
#include "io/coordinate_system.hpp"
#include "io/map_projection.hpp"
#include "mapping/accuracy_statements.hpp"
#include "mapping/gridding.hpp"
#include "mapping/mark_residuals.hpp"
#include "mapping/order_statistics.hpp"
#include "mapping/point_cleaning.hpp"
#include "mapping/surface_uncertainty.hpp"

namespace terrawalk {

namespace {

struct Comparison {
    std::vector<Residual> residuals;
    std::vector<MissingResidual> missing;
    std::vector<std::string> limitations;
    void add(MarkResiduals more) {
        residuals.insert(residuals.end(), more.residuals.begin(), more.residuals.end());
        missing.insert(missing.end(), more.missing.begin(), more.missing.end());
    }
};

/// Marks whose heights the estimator knew: the adjustment takes passes over any control mark, a filter only
/// those it stood on.
std::set<std::string> usedMarks(const Survey& survey, const FusionOptions& fusion) {
    std::set<std::string> names = tiedMarks(survey, fusion.stands);
    if (fusion.method != FusionMethod::Terrawalk || !fusion.joint.use_crossovers) return names;
    for (const ControlMark& mark : survey.marks) {
        if (mark.role == MarkRole::Control) names.insert(mark.name);
    }
    return names;
}

/// What the height of each hit that is used is off by for itself: range and tilt. The track's error, which
/// its neighbours share, is not in it.
std::vector<double> ownSigmas(const std::vector<GroundPoint>& points, const std::vector<FusedRun>& runs) {
    std::vector<double> sigmas_m;
    for (const GroundPoint& point : points) {
        if (point.state != GroundPointState::Used) continue;
        const double track_m2 = runs[point.run].trajectory.epochs[point.epoch].covariance(2, 2);
        sigmas_m.push_back(std::sqrt(std::max(0.0, point.sigma_u_m * point.sigma_u_m - track_m2)));
    }
    return sigmas_m;
}

Result<std::vector<Eigen::Vector3d>> usedInMap(const std::vector<GroundPoint>& points,
                                               const MapProjection& projection) {
    std::vector<Eigen::Vector3d> used;
    for (const GroundPoint& point : points) {
        if (point.state == GroundPointState::Used) used.push_back(point.enu_m);
    }
    return projection.toMap(used);
}

double distanceWalked(const Trajectory& trajectory) {
    // Steps of a second, so that the noise of five positions a second does not lengthen the way.
    double distance_m = 0.0;
    std::size_t last = 0;
    for (std::size_t i = 1; i < trajectory.epochs.size(); ++i) {
        if (trajectory.epochs[i].time_s - trajectory.epochs[last].time_s < 1.0) continue;
        distance_m +=
            (trajectory.epochs[i].position_enu_m - trajectory.epochs[last].position_enu_m).head<2>().norm();
        last = i;
    }
    return distance_m;
}

std::vector<Eigen::Vector3d> drawnTrack(const Trajectory& trajectory) {
    constexpr std::size_t kGreatestVertices = 2000;
    const std::size_t step = std::max<std::size_t>(1, trajectory.epochs.size() / kGreatestVertices);
    std::vector<Eigen::Vector3d> track;
    for (std::size_t i = 0; i < trajectory.epochs.size(); i += step) {
        track.push_back(trajectory.epochs[i].position_enu_m);
    }
    return track;
}

RunReport reportRun(const Run& run, const FusedRun& fused, const std::vector<GroundPoint>& points) {
    RunReport report;
    report.id = run.id;
    report.kind = run.kind;
    report.rows_read = run.log.read_report.rows_read;
    report.epochs = run.log.size();
    report.repeated_lines = run.log.read_report.repeated_lines;
    report.late_lines = run.log.read_report.late_lines;
    report.cut_off_line = run.log.read_report.cut_off_line;
    report.duration_s = run.log.time_s.back() - run.log.time_s.front();
    report.distance_m = distanceWalked(fused.trajectory);
    const LogSummary looked_at = inspectLog(run.log, run.id);
    report.gaps = looked_at.gaps;
    report.longest_gap_s = looked_at.gaps > 0 ? looked_at.longest_gap_s : 0.0;
    report.fixes = looked_at.fixes;
    report.sensors = fused.sensors;
    report.notes = run.log.read_report.notes;
    for (const auto& notes : {fused.notes.limitations, fused.notes.details}) {
        report.notes.insert(report.notes.end(), notes.begin(), notes.end());
    }
    report.track_enu_m = drawnTrack(fused.trajectory);
    report.ground_points_used =
        static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [](const GroundPoint& point) {
            return point.state == GroundPointState::Used;
        }));
    report.ground_points_rejected = leftOutByReason(points);
    return report;
}

/// What the runs had to do without, each once with the runs that it holds for.
std::vector<std::string> sharedLimitations(const std::vector<FusedRun>& runs) {
    std::vector<std::pair<std::string, std::vector<std::string>>> notes;
    for (const FusedRun& run : runs) {
        for (const std::string& note : run.notes.limitations) {
            auto found =
                std::find_if(notes.begin(), notes.end(), [&](const auto& n) { return n.first == note; });
            if (found == notes.end()) found = notes.insert(notes.end(), {note, {}});
            const std::string& id = run.trajectory.run_id;
            if (found->second.empty() || found->second.back() != id) found->second.push_back(id);
        }
    }
    std::vector<std::string> sentences;
    for (const auto& [note, ids] : notes) {
        const bool all = ids.size() == runs.size();
        std::string sentence = all ? note : fmt::format("{} (runs {})", note, fmt::join(ids, ", "));
        sentence.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence.front())));
        sentences.push_back(sentence + ".");
    }
    return sentences;
}

/// What the logs and the project leave open, run by run: long silences, and a start that may not be used.
std::vector<std::string> oddities(const Survey& survey, const std::vector<RunReport>& runs) {
    constexpr double kNotableGap_s = 5.0;
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (runs[i].longest_gap_s > kNotableGap_s) {
            sentences.push_back(fmt::format("Run {} has no records for {:.1f} s: the track there is a guess.",
                                            runs[i].id, runs[i].longest_gap_s));
        }
        const auto start = survey.runs[i].start ? survey.findMark(*survey.runs[i].start) : std::nullopt;
        if (start && start->role == MarkRole::Check) {
            sentences.push_back(
                fmt::format("Run {} starts on check mark {}, which the estimator may not use: it begins as "
                            "if nothing were known.",
                            runs[i].id, start->name));
        }
    }
    return sentences;
}

/// A zero point typed wrong, or a receiver that writes zeros, must not become a terrain model of half the
/// Earth.
Result<void> checkPlace(const Survey& survey) {
    constexpr double kFarthest_m = 100e3;
    constexpr std::size_t kSamples = 500;
    const LocalFrame frame = survey.frame();
    for (const Run& run : survey.runs) {
        std::vector<double> distances_m;
        const std::size_t step = std::max<std::size_t>(1, run.log.size() / kSamples);
        for (std::size_t i = 0; i < run.log.size(); i += step) {
            const GeodeticPosition position{run.log.value(Channel::Latitude, i),
                                            run.log.value(Channel::Longitude, i), survey.zero_point.h_ell_m};
            if (present(position.lat_deg)) distances_m.push_back(frame.toEnu(position).norm());
        }
        if (distances_m.empty()) continue;
        const double distance_m = median(std::move(distances_m));
        if (distance_m > kFarthest_m) {
            return badData(fmt::format("the GNSS positions of run {} lie {:.0f} km from the zero point",
                                       run.id, distance_m / 1000.0),
                           run.log.file, 0, "check zero_point in the project file");
        }
    }
    return {};
}

/// Why there is not a single ground point, in the words of the most frequent reason.
Error noGroundPoints(const Survey& survey, const std::vector<GroundPoint>& points) {
    std::array<std::size_t, kGroundPointStateCount> counts{};
    for (const GroundPoint& point : points) ++counts[static_cast<std::size_t>(point.state)];
    // Where points were thinned there were some; that is no reason to have none.
    counts[static_cast<std::size_t>(GroundPointState::Thinned)] = 0;
    const auto most = std::max_element(counts.begin() + 1, counts.end()) - counts.begin();
    const bool left_out = static_cast<GroundPointState>(most) == GroundPointState::RunLeftOut;
    if (counts[static_cast<std::size_t>(most)] == 0) {
        return badData(
                   fmt::format("{} epochs in all give too few ground points for a surface", points.size()),
                   survey.project_file, 0, "walk farther")
            .value();
    }
    return badData(
               fmt::format("the survey gives too few ground points for a surface (most frequent reason: "
                           "{}, {} of {} epochs)",
                           name(static_cast<GroundPointState>(most)), counts[static_cast<std::size_t>(most)],
                           points.size()),
               survey.project_file, 0,
               left_out ? "set surface.fixed_point_runs=true" : "look at the log with `terrawalk inspect`")
        .value();
}

/// Bad data without a file is the survey's own.
Error blaming(const Survey& survey, Error error) {
    if (error.kind == ErrorKind::BadData && error.file.empty()) error.file = survey.project_file;
    return error;
}

struct Surface {
    std::vector<GroundPoint> ground_points;  ///< all of them
    std::size_t carrying_points = 0;
    SurfaceModel model;
    MethodChoice choice;
};

SurfaceModelOptions modelOptions(const PipelineConfig& config) {
    return {.method = config.surface.method,
            .cross_validate = config.surface.cross_validate,
            .terrace_edges = config.surface.terrace_edges,
            .longest_edge_m = config.surface.tin.longest_edge_m,
            .seed = config.seed};
}

Result<Surface> makeSurface(const Survey& survey, const GroundTrack& track, const SurfaceOptions& options,
                            const SurfaceModelOptions& model, const MapProjection& projection,
                            Progress& progress, const std::stop_token& stop) {
    PartialProgress cleaning(progress, 0.0, 0.2);
    auto chosen = surfacePoints(survey, track.points, options, cleaning, stop);
    if (!chosen) return tl::unexpected(chosen.error());
    auto points = usedInMap(*chosen, projection);
    if (!points) return tl::unexpected(blaming(survey, points.error()));
    if (points->size() < 3) return tl::unexpected(noGroundPoints(survey, *chosen));
    const SurfaceInput input{std::move(*points), ownSigmas(*chosen, track.runs), survey.breaklines};
    PartialProgress triangulating(progress, 0.2, 0.4), judging(progress, 0.4, 0.9),
        fitting(progress, 0.9, 1.0);
    auto ground = triangulateGround(input, model, triangulating, stop);
    if (!ground) return tl::unexpected(blaming(survey, ground.error()));
    auto choice = chooseMethod(input, *ground, model, judging, stop);
    if (!choice) return tl::unexpected(blaming(survey, choice.error()));
    SilentProgress silent;
    ground = groundFor(choice->method, std::move(*ground), input, model, silent, stop);
    if (!ground) return tl::unexpected(blaming(survey, ground.error()));
    auto fitted = SurfaceModel::fit(input, std::move(*ground), choice->method, model, fitting, stop);
    if (!fitted) return tl::unexpected(blaming(survey, fitted.error()));
    return Surface{std::move(*chosen), input.points_m.size(), std::move(*fitted), std::move(*choice)};
}

/// Rise over run between places half a metre to all sides: wide enough that a riser is one and a stone is
/// not.
double slopeAt(const SurfaceModel& surface, const Eigen::Vector3d& place) {
    constexpr double kReach_m = 0.5;
    const auto west = surface.heightAt(place.x() - kReach_m, place.y());
    const auto east = surface.heightAt(place.x() + kReach_m, place.y());
    const auto south = surface.heightAt(place.x(), place.y() - kReach_m);
    const auto north = surface.heightAt(place.x(), place.y() + kReach_m);
    if (!west || !east || !south || !north) return kMissing;
    return std::hypot(*east - *west, *north - *south) / (2.0 * kReach_m);
}

/// Height of the surface at a place, taken back from the map's height datum to the place's.
SurfaceHeightAt heightOf(const SurfaceModel& surface, const MapProjection& projection,
                         const GridGeometry* grid = nullptr,
                         const SurfaceUncertainty* uncertainty = nullptr) {
    return [&surface, &projection, grid,
            uncertainty](const Eigen::Vector3d& place) -> std::optional<SurfaceHeight> {
        const auto at = projection.toMap(place);
        if (!at) return std::nullopt;
        const auto height_m = surface.heightAt(at->x(), at->y());
        if (!height_m) return std::nullopt;
        SurfaceHeight height{*height_m - at->z() + place.z()};
        height.slope = slopeAt(surface, *at);
        const auto cell = uncertainty != nullptr ? grid->cellAt(at->x(), at->y()) : std::nullopt;
        if (cell) height.sigma_m = uncertainty->sigmas_m[*cell];
        return height;
    };
}

/// Positions on marks and nearest samples of one track.
/// @param surface_height  what the ground between marks and samples is taken from
void compareTrack(const Survey& survey, const GroundTrack& track, const PipelineConfig& config,
                  const SurfaceHeightAt& surface_height, Stage stage, bool tied, Comparison& comparison) {
    for (std::size_t i = 0; i < survey.runs.size(); ++i) {
        const Run& run = survey.runs[i];
        comparison.add(positionResiduals(run, markStands(survey, run, config.fusion.stands),
                                         track.runs[i].trajectory, pointsOfRun(track.points, track, i), stage,
                                         tied));
    }
    const std::set<std::string> tied_marks =
        tied ? usedMarks(survey, config.fusion) : std::set<std::string>{};
    comparison.add(nearestSampleResiduals(survey, track.points, stage, tied_marks,
                                          {.greatest_distance_m = config.report.nearest_sample_limit_m},
                                          surface_height));
}

std::string inWords(const SurfaceModel& surface) {
    const std::string triangles =
        surface.ground().constrained ? "constrained Delaunay triangulation" : "Delaunay triangulation";
    if (surface.method() == InterpolationMethod::Linear) {
        return triangles + ", linear interpolation at cell centres";
    }
    return fmt::format("{} at cell centres, within the {}", name(surface.method()), triangles);
}

SurfaceReport reportSurface(const Surface& surface, const PipelineConfig& config, std::size_t breaklines,
                            const ElevationGrid& dem, const MapProjection& projection) {
    const GroundTriangles& ground = surface.model.ground();
    SurfaceReport report;
    report.method = inWords(surface.model);
    report.method_requested = config.surface.method ? std::string(name(*config.surface.method)) : "auto";
    report.method_used = name(surface.model.method());
    report.comparison = comparisonOf(surface.choice.validation);
    report.breaklines = breaklines;
    report.terrace_edges = summaryOf(ground.terrace_edges);
    report.notes = ground.notes;
    if (!surface.choice.note.empty()) report.notes.push_back(surface.choice.note);
    if (const auto& scale = surface.model.varianceScale()) report.notes.push_back(inWords(*scale));
    report.variogram = summaryOf(surface.model.variogram());
    report.points = surface.carrying_points;
    report.triangles = ground.mesh.triangles.size();
    report.longest_edge_m = ground.longest_edge_m;
    report.area_m2 = ground.area_m2;
    report.cell_m = dem.geometry.cell_m;
    report.columns = dem.geometry.columns;
    report.rows = dem.geometry.rows;
    report.crs = projection.name();
    report.vertical_datum = projection.heightReference();
    for (const float height : dem.heights_m) {
        if (std::isnan(height)) continue;
        const double h = height;
        report.lowest_m = report.cells_with_height == 0 ? h : std::min(report.lowest_m, h);
        report.highest_m = report.cells_with_height == 0 ? h : std::max(report.highest_m, h);
        ++report.cells_with_height;
    }
    return report;
}

/// Whether the method can follow the survey's breaklines, and whether they lie in the map's own frame.
Result<void> checkBreaklines(const Survey& survey, const PipelineConfig& config,
                             const MapProjection& projection) {
    if (auto fits = checkMethod(modelOptions(config), !survey.breaklines.empty()); !fits) return fits;
    if (survey.breakline_crs.empty()) return {};
    const auto own = describeCrs(projection.wkt2());
    if (!own) return tl::unexpected(own.error());
    return checkBreaklineCrs(survey.breaklines, survey.breakline_crs, own->name, survey.breakline_file);
}

struct GridUncertainty {
    InterpolationError interpolation;
    SurfaceUncertainty cells;
};

/// The variance that the method tells, where it tells one; else what left-out points say of it.
Result<InterpolationError> interpolationError(const Surface& surface, std::vector<float> variances_m2,
                                              const std::vector<Eigen::Vector3d>& points_m,
                                              const std::vector<TrackSigma>& track,
                                              const PipelineConfig& config, Progress& progress,
                                              const std::stop_token& stop) {
    InterpolationError error;
    if (const auto& scale = surface.model.varianceScale()) {
        error.model.greatest_distance_m = scale->greatest_distance_m;
        error.model.left_out = scale->left_out;
        error.variances_m2 = std::move(variances_m2);
        return error;
    }
    auto model = learnInterpolationError(surface.model.method(), points_m, {}, track,
                                         modelOptions(config).interpolation, config.seed, progress, stop);
    if (!model) return tl::unexpected(model.error());
    error.model = *model;
    return error;
}

/// Standard errors of the DEM, from the tracks' covariances and the error of interpolation.
Result<GridUncertainty> uncertaintyOf(const Surface& surface, const std::vector<FusedRun>& runs,
                                      const ElevationGrid& dem, std::vector<float> variances_m2,
                                      const PipelineConfig& config, const MapProjection& projection,
                                      Progress& progress, const std::stop_token& stop) {
    const auto points = usedInMap(surface.ground_points, projection);
    if (!points) return tl::unexpected(points.error());
    std::vector<TrackSigma> track;
    for (const GroundPoint& point : surface.ground_points) {
        if (point.state != GroundPointState::Used) continue;
        track.push_back(trackSigmaOf(point, runs[point.run].trajectory));
    }
    PartialProgress learning(progress, 0.0, 0.8), propagating(progress, 0.8, 1.0);
    auto error = interpolationError(surface, std::move(variances_m2), *points, track, config, learning, stop);
    if (!error) return tl::unexpected(error.error());
    auto cells = surfaceUncertainty(dem, *points, track, *error, propagating, stop);
    if (!cells) return tl::unexpected(cells.error());
    return GridUncertainty{std::move(*error), std::move(*cells)};
}

/// One sigma of interpolation where a point lies.
double errorAtPoint(const GridUncertainty& uncertainty) {
    const InterpolationError& error = uncertainty.interpolation;
    if (error.variances_m2.empty()) return std::sqrt(error.model.variance_m2(0.0, 0.0));
    std::vector<double> measured;
    for (std::size_t i = 0; i < error.variances_m2.size(); ++i) {
        const auto source = static_cast<CellSource>(uncertainty.cells.sources[i]);
        if (source == CellSource::Measured) measured.push_back(error.variances_m2[i]);
    }
    return measured.empty() ? 0.0 : std::sqrt(median(std::move(measured)));
}

UncertaintySummary summaryOf(const GridUncertainty& uncertainty) {
    UncertaintySummary summary;
    std::vector<double> sigmas;
    for (const float sigma : uncertainty.cells.sigmas_m) {
        if (!std::isnan(sigma)) sigmas.push_back(sigma);
    }
    std::sort(sigmas.begin(), sigmas.end());
    if (!sigmas.empty()) {
        summary.median_m = quantileOfSorted(sigmas, 0.5);
        summary.error95_m = quantileOfSorted(sigmas, 0.95);
    }
    for (const std::uint8_t source : uncertainty.cells.sources) {
        const auto kind = static_cast<CellSource>(source);
        if (kind == CellSource::Measured) ++summary.measured;
        if (kind == CellSource::Interpolated) ++summary.interpolated;
        if (kind == CellSource::Extrapolated) ++summary.extrapolated;
    }
    const InterpolationErrorModel& model = uncertainty.interpolation.model;
    summary.coefficients = model.coefficients;
    summary.own_variance = !uncertainty.interpolation.variances_m2.empty();
    summary.at_point_m = errorAtPoint(uncertainty);
    summary.greatest_distance_m = model.greatest_distance_m;
    summary.correlation_range_m = uncertainty.cells.correlation_range_m;
    summary.left_out = model.left_out;
    return summary;
}

/// The sensors as they are against the marks, by the same measures as the fused track and its surface, so
/// that before and after can be compared.
/// @param product  the surface after fusion: the best that is known of the ground
Result<Comparison> compareBeforeFusion(const Survey& survey, const PipelineConfig& config,
                                       const SurfaceModel& product, const MapProjection& projection,
                                       Progress& progress, const std::stop_token& stop) {
    FusionOptions as_measured = config.fusion;
    as_measured.method = FusionMethod::Raw;
    const auto track = trackGround(survey, as_measured, config.ground, progress, stop);
    if (!track) return tl::unexpected(track.error());
    Comparison comparison;
    compareTrack(survey, *track, config, heightOf(product, projection), Stage::BeforeFusion, false,
                 comparison);
    // What the raw track misses says nothing of the product, so it is not told.
    comparison.missing.clear();
    SilentProgress silent;
    SurfaceModelOptions model = modelOptions(config);
    model.method = product.method();
    model.cross_validate = false;
    const auto surface = makeSurface(survey, *track, config.surface, model, projection, silent, stop);
    if (surface) {
        comparison.add(
            {surfaceResiduals(survey.marks, heightOf(surface->model, projection), Stage::BeforeFusion, {})
                 .residuals,
             {}});
    } else if (surface.error().kind == ErrorKind::BadData) {
        comparison.limitations.push_back(
            "Before fusion there is no surface to compare with: " + surface.error().message + ".");
    } else {
        return tl::unexpected(surface.error());
    }
    return comparison;
}

/// Marks that the parameters were tuned on are no test of what came out. Another survey's mark of the same
/// name is another mark.
void markTunedOn(const Survey& survey, const TuningRecord& tuning, std::vector<Residual>& residuals) {
    constexpr double kSameMark_m = 0.001;
    std::set<std::string> tuned_on;
    for (const ControlMark& mark : tuning.marks) {
        const auto own = survey.findMark(mark.name);
        if (own && (own->enu_m - mark.enu_m).norm() < kSameMark_m) tuned_on.insert(mark.name);
    }
    for (Residual& residual : residuals) {
        if (residual.stage != Stage::BeforeFusion && tuned_on.contains(residual.mark)) {
            residual.used_by_estimator = true;
        }
    }
}

std::string filterName(FilterKind filter) {
    switch (filter) {
        case FilterKind::Ekf:
            return "extended Kalman filter";
        case FilterKind::Ckf:
            return "cubature Kalman filter";
        case FilterKind::Ukf:
            return "unscented Kalman filter";
        case FilterKind::SquareRootUkf:
            return "square-root unscented Kalman filter";
        case FilterKind::AdaptiveUkf:
            return "unscented Kalman filter with adaptive measurement noise";
    }
    return {};
}

std::string methodName(const FusionOptions& options) {
    if (options.method == FusionMethod::Raw) return "raw sensors, no fusion";
    if (options.method == FusionMethod::Aukf) {
        return "9-state " + filterName(options.aukf.filter) + " as published (Xie et al. 2024), forward only";
    }
    if (options.method == FusionMethod::Terrawalk && options.joint.preview) {
        return "adaptive unscented Kalman filter with error states, then crossovers in a second stage (a "
               "preview)";
    }
    if (options.method == FusionMethod::Terrawalk) {
        return "adaptive unscented Kalman filter with error states, then joint adjustment of all runs with "
               "their crossovers";
    }
    return options.smooth ? "9-state unscented Kalman filter, Rauch-Tung-Striebel smoothed"
                          : "9-state unscented Kalman filter";
}

}  // namespace

Result<Products> process(const Survey& survey, const PipelineConfig& config, Progress& progress,
                         std::stop_token stop) {
    if (auto placed = checkPlace(survey); !placed) return tl::unexpected(placed.error());
    const auto projection = MapProjection::create(survey.frame(), survey.crs, survey.vertical_datum);
    if (!projection) return tl::unexpected(blaming(survey, projection.error()));

    if (auto checked = checkBreaklines(survey, config, *projection); !checked) {
        return tl::unexpected(checked.error());
    }
    if (config.surface.map_space) {
        if (auto fits = checkOptions(config.surface.space); !fits) return tl::unexpected(fits.error());
    }
    PartialProgress fusing(progress, 0.0, 0.5);
    auto fused = trackGround(survey, config.fusion, config.ground, fusing, stop);
    if (!fused) return tl::unexpected(fused.error());

    PartialProgress modelling(progress, 0.5, 0.7);
    progress.report(0.5, "making the surface");
    Products products;
    products.used = config;
    if (RadiusOutlierOptions& radius = products.used.surface.cleaning.radius; radius.use) {
        radius.radius_m = isolationRadius_m(ofChosenRuns(survey, fused->points, config.surface), radius);
    }
    auto surface = makeSurface(survey, *fused, products.used.surface, modelOptions(config), *projection,
                               modelling, stop);
    if (!surface) return tl::unexpected(surface.error());
    const GroundTriangles& ground = surface->model.ground();

    const bool is_fused = config.fusion.method != FusionMethod::Raw;
    const bool tied = tiesToMarks(config.fusion.method);
    Result<Comparison> comparison;
    if (is_fused) {
        PartialProgress following(progress, 0.7, 0.85);
        comparison = compareBeforeFusion(survey, config, surface->model, *projection, following, stop);
        if (!comparison) return tl::unexpected(comparison.error());
    }
    compareTrack(survey, *fused, config, heightOf(surface->model, *projection),
                 is_fused ? Stage::Fused : Stage::BeforeFusion, tied, *comparison);
    products.used.surface.tin.longest_edge_m = ground.longest_edge_m;
    products.used.surface.method = surface->model.method();
    if (config.surface.cell_m == 0.0) {
        products.used.surface.cell_m = suggestCellSize(ground.area_m2, surface->carrying_points);
    }
    const auto geometry = gridCovering(ground.mesh, products.used.surface.cell_m);
    if (!geometry) return tl::unexpected(blaming(survey, geometry.error()));
    PartialProgress gridding(progress, 0.85, 0.9);
    auto dem = surface->model.grid(*geometry, gridding, stop);
    if (!dem) return tl::unexpected(dem.error());
    products.dem = std::move(dem->heights);
    PartialProgress propagating(progress, 0.9, 0.97), mapping(progress, 0.97, 1.0);
    auto uncertainty = uncertaintyOf(*surface, fused->runs, products.dem, std::move(dem->variances_m2),
                                     config, *projection, propagating, stop);
    if (!uncertainty && uncertainty.error().kind != ErrorKind::BadData) {
        return tl::unexpected(uncertainty.error());
    }
    std::optional<UncertaintySummary> uncertainty_summary;
    if (uncertainty) {
        uncertainty_summary = summaryOf(*uncertainty);
        products.uncertainty = std::move(uncertainty->cells);
    }
    const SurfaceUncertainty* const sigmas = products.uncertainty ? &*products.uncertainty : nullptr;
    MarkResiduals at_marks =
        surfaceResiduals(survey.marks, heightOf(surface->model, *projection, &*geometry, sigmas),
                         Stage::Surface, tied ? usedMarks(survey, config.fusion) : std::set<std::string>{});
    if (config.surface.cleaning.above_ground.use) {
        for (Residual& residual : at_marks.residuals) {
            const auto mark = survey.findMark(residual.mark);
            if (mark) residual.cover = coverAt(*mark, surface->ground_points);
        }
    }
    comparison->add(std::move(at_marks));
    products.terrace_edges = ground.terrace_edges;

    products.ground_points = std::move(surface->ground_points);
    SurveyReport& report = products.report;
    report.survey_name = survey.name;
    report.program_version = versionNumber();
    report.seed = config.seed;
    report.language = config.report.language;
    report.settings = settingsReport(config, products.used);
    report.settings.push_back({"survey.crs", survey.crs.empty() ? "none" : survey.crs, projection->name()});
    report.settings.push_back(
        {"survey.vertical_datum", survey.vertical_datum, projection->heightReference()});
    report.method = methodName(config.fusion);
    report.adjustment = fused->adjustment;
    for (std::size_t i = 0; i < survey.runs.size(); ++i) {
        report.runs.push_back(
            reportRun(survey.runs[i], fused->runs[i], pointsOfRun(products.ground_points, *fused, i)));
    }
    report.surface = reportSurface(*surface, config, survey.breaklines.size(), products.dem, *projection);
    if (report.surface.cells_with_height == 0) {
        return badData(
            fmt::format("no cell of {:g} m has its centre on the surface", products.dem.geometry.cell_m),
            survey.project_file, 0, "choose a smaller surface.cell_m");
    }
    report.surface.uncertainty = uncertainty_summary;
    report.marks = survey.marks;
    report.residuals = std::move(comparison->residuals);
    report.tuning = config.tuning;
    if (config.tuning && config.tuning->in_use) markTunedOn(survey, *config.tuning, report.residuals);
    report.missing_residuals = std::move(comparison->missing);
    auto relief = reliefPicture(surface->model, *projection, products.ground_points);
    if (!relief) return tl::unexpected(relief.error());
    report.relief = std::move(*relief);
    report.limitations = sharedLimitations(fused->runs);
    for (const auto& more : {comparison->limitations, oddities(survey, report.runs)}) {
        report.limitations.insert(report.limitations.end(), more.begin(), more.end());
    }
    if (!uncertainty) {
        report.limitations.push_back(fmt::format(
            "The heights have no standard errors{}: {}.",
            config.surface.multiband ? ", and there is no multiband file" : "", uncertainty.error().message));
    }
    report.warnings = survey.notes;
    report.warnings.insert(report.warnings.end(), projection->warnings().begin(),
                           projection->warnings().end());
    report.vertical_class_m = config.report.vertical_class_m;
    report = withAccuracy(std::move(report));

    products.surface = ground.mesh;
    products.crs_wkt2 = projection->wkt2();
    for (FusedRun& run : fused->runs) {
        products.trajectories.push_back(std::move(run.trajectory));
        // Methods that filter many epochs at once tell the sums alone.
        if (run.innovations.empty()) {
            for (SensorConsistency& sums : run.consistency) run.innovations.push_back({std::move(sums), {}});
        }
        products.innovations.push_back(std::move(run.innovations));
    }
    if (config.surface.map_space) {
        auto space = mapSpace(products.ground_points, products.trajectories, *projection, products.dem,
                              config.surface.space, mapping, stop);
        if (!space) return tl::unexpected(blaming(survey, space.error()));
        report.occupancy = space->summary;
        products.space = std::make_shared<const SpaceMap>(std::move(*space));
    }
    progress.report(1.0, "processed");
    return products;
}

}  // namespace terrawalk
