#include "app/pipeline/accuracy_measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "app/pipeline/ground_track.hpp"
#include "fusion/fuse_survey.hpp"
#include "fusion/random_numbers.hpp"
#include "mapping/delaunay_tin.hpp"

namespace terrawalk {

namespace {

constexpr std::size_t kCheckPoints = 500;
constexpr double kFarthestFromTrack_m = 2.0;
constexpr double kCoverageSigmas = 1.96;
constexpr std::uint64_t kCheckPointStream = 0x636865636bULL;

double square(double value) {
    return value * value;
}

/// Mean of what is added; NaN of nothing.
class Mean {
  public:
    void add(double value) {
        sum_ += value;
        ++count_;
    }
    [[nodiscard]] double value() const {
        return count_ == 0 ? std::numeric_limits<double>::quiet_NaN() : sum_ / static_cast<double>(count_);
    }

  private:
    double sum_ = 0.0;
    std::size_t count_ = 0;
};

void measureArray(const Trajectory& estimated, const Trajectory& truth, AccuracyMeasures& measures) {
    Mean horizontal, horizontal_square, height, height_square, bias;
    Mean normalized_u, normalized_h, covered_u, covered_h;
    for (std::size_t i = 0; i < truth.epochs.size(); ++i) {
        const Eigen::Vector3d error_m = estimated.epochs[i].position_enu_m - truth.epochs[i].position_enu_m;
        horizontal.add(error_m.head<2>().norm());
        horizontal_square.add(error_m.head<2>().squaredNorm());
        height.add(std::abs(error_m.z()));
        height_square.add(square(error_m.z()));
        bias.add(error_m.z());
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            const double variance_m2 = estimated.epochs[i].covariance(axis, axis);
            const double normalized = variance_m2 > 0.0 ? square(error_m[axis]) / variance_m2
                                                        : std::numeric_limits<double>::quiet_NaN();
            const double covered = normalized <= square(kCoverageSigmas) ? 1.0 : 0.0;
            (axis == 2 ? normalized_u : normalized_h).add(normalized);
            (axis == 2 ? covered_u : covered_h).add(covered);
        }
    }
    measures.mean_horizontal_error_m = horizontal.value();
    measures.rms_horizontal_error_m = std::sqrt(horizontal_square.value());
    measures.mean_height_error_m = height.value();
    measures.rms_height_error_m = std::sqrt(height_square.value());
    measures.height_bias_m = bias.value();
    measures.normalized_height_error = normalized_u.value();
    measures.normalized_horizontal_error = normalized_h.value();
    measures.height_coverage = covered_u.value();
    measures.horizontal_coverage = covered_h.value();
}

void measureEnds(const Survey& survey, const std::vector<FusedRun>& fused,
                 const std::vector<Trajectory>& truth, double still_s, AccuracyMeasures& measures) {
    Mean horizontal_square, height_square;
    for (std::size_t run = 0; run < survey.runs.size(); ++run) {
        if (survey.runs[run].kind != RunKind::FixedPoint) continue;
        const std::vector<TrajectoryEpoch>& epochs = truth[run].epochs;
        Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
        double count = 0.0;
        for (std::size_t i = 0; i < epochs.size(); ++i) {
            if (epochs[i].time_s < epochs.back().time_s - still_s) continue;
            sum_m += fused[run].trajectory.epochs[i].position_enu_m - epochs[i].position_enu_m;
            count += 1.0;
        }
        const Eigen::Vector3d error_m = sum_m / count;
        horizontal_square.add(error_m.head<2>().squaredNorm());
        height_square.add(square(error_m.z()));
        ++measures.fixed_point_runs;
    }
    measures.rms_end_horizontal_m = std::sqrt(horizontal_square.value());
    measures.rms_end_height_m = std::sqrt(height_square.value());
}

double squaredDistanceInPlan(const Eigen::Vector3d& a, const Eigen::Vector2d& b) {
    return (a.head<2>() - b).squaredNorm();
}

std::vector<Eigen::Vector2d> checkPoints(const Trajectory& truth, std::uint64_t seed) {
    Eigen::Array2d low_m = truth.epochs.front().position_enu_m.head<2>();
    Eigen::Array2d high_m = low_m;
    for (const TrajectoryEpoch& epoch : truth.epochs) {
        low_m = low_m.min(epoch.position_enu_m.head<2>().array());
        high_m = high_m.max(epoch.position_enu_m.head<2>().array());
    }
    RandomNumbers random{seed, kCheckPointStream};
    std::vector<Eigen::Vector2d> points;
    // A track that leaves most of its rectangle empty gets fewer points rather than no end.
    for (std::size_t tries = 0; tries < 100 * kCheckPoints && points.size() < kCheckPoints; ++tries) {
        const double e_m = random.uniform(low_m.x(), high_m.x());
        const double n_m = random.uniform(low_m.y(), high_m.y());
        const Eigen::Vector2d point_m(e_m, n_m);
        const bool near =
            std::any_of(truth.epochs.begin(), truth.epochs.end(), [&](const TrajectoryEpoch& epoch) {
                return squaredDistanceInPlan(epoch.position_enu_m, point_m) <= square(kFarthestFromTrack_m);
            });
        if (near) points.push_back(point_m);
    }
    return points;
}

std::vector<GroundPoint> usedPoints(const std::vector<GroundPoint>& points) {
    std::vector<GroundPoint> used;
    for (const GroundPoint& point : points) {
        if (point.state == GroundPointState::Used) used.push_back(point);
    }
    return used;
}

const GroundPoint& nearestSample(const std::vector<GroundPoint>& samples, const Eigen::Vector2d& at_m) {
    return *std::min_element(samples.begin(), samples.end(), [&](const GroundPoint& a, const GroundPoint& b) {
        return squaredDistanceInPlan(a.enu_m, at_m) < squaredDistanceInPlan(b.enu_m, at_m);
    });
}

Result<DelaunayTin> surfaceOf(const Survey& survey, const GroundTrack& track, const SurfaceOptions& options,
                              const std::stop_token& stop) {
    std::vector<Eigen::Vector3d> carrying_m;
    SilentProgress silent;
    auto points = surfacePoints(survey, track.points, options, silent, stop);
    if (!points) return tl::unexpected(points.error());
    for (const GroundPoint& point : usedPoints(std::move(*points))) carrying_m.push_back(point.enu_m);
    return DelaunayTin::build(carrying_m, options.tin, silent, stop);
}

/// What a check point is looked up in: the ground samples of the area walk, and the surface of all.
struct Ground {
    std::vector<GroundPoint> samples;
    DelaunayTin surface;
};

Result<Ground> groundOf(const Survey& survey, const GroundTrack& track, std::size_t area_run,
                        const SurfaceOptions& options, const std::stop_token& stop) {
    auto samples = usedPoints(pointsOfRun(track.points, track, area_run));
    if (samples.empty()) return badData("the area walk has no ground point that can be used");
    auto surface = surfaceOf(survey, track, options, stop);
    if (!surface) return tl::unexpected(surface.error());
    return Ground{std::move(samples), std::move(*surface)};
}

void measureGround(const Ground& fused, const Ground& truth, const SimulatedSurvey& simulated,
                   const std::vector<Eigen::Vector2d>& check_points, AccuracyMeasures& measures) {
    Mean sample_error, sample_floor, surface_error, surface_floor, normalized, covered;
    for (const Eigen::Vector2d& at_m : check_points) {
        const double terrain_m = simulated.terrain_height_m(at_m.x(), at_m.y());
        const GroundPoint& sample = nearestSample(fused.samples, at_m);
        const double error_m = sample.enu_m.z() - terrain_m;
        sample_error.add(std::abs(error_m));
        normalized.add(square(error_m / sample.sigma_u_m));
        covered.add(std::abs(error_m) <= kCoverageSigmas * sample.sigma_u_m ? 1.0 : 0.0);
        sample_floor.add(std::abs(nearestSample(truth.samples, at_m).enu_m.z() - terrain_m));
        const auto fused_m = fused.surface.heightAt(at_m.x(), at_m.y());
        const auto true_m = truth.surface.heightAt(at_m.x(), at_m.y());
        if (!fused_m || !true_m) continue;
        surface_error.add(std::abs(*fused_m - terrain_m));
        surface_floor.add(std::abs(*true_m - terrain_m));
        ++measures.surface_check_points;
    }
    measures.check_points = check_points.size();
    measures.check_point_error_m = sample_error.value();
    measures.check_point_floor_m = sample_floor.value();
    measures.check_point_ratio = measures.check_point_error_m / measures.check_point_floor_m;
    measures.surface_error_m = surface_error.value();
    measures.surface_floor_m = surface_floor.value();
    measures.surface_ratio = measures.surface_error_m / measures.surface_floor_m;
    measures.normalized_sample_error = normalized.value();
    measures.sample_coverage = covered.value();
}

std::vector<FusedRun> asFused(const std::vector<Trajectory>& truth) {
    std::vector<FusedRun> runs;
    for (const Trajectory& trajectory : truth) runs.push_back({trajectory, {}, {}});
    return runs;
}

std::optional<std::size_t> areaRun(const Survey& survey) {
    const auto found = std::find_if(survey.runs.begin(), survey.runs.end(),
                                    [](const Run& run) { return run.kind == RunKind::Area; });
    if (found == survey.runs.end()) return std::nullopt;
    return static_cast<std::size_t>(found - survey.runs.begin());
}

}  // namespace

Result<AccuracyMeasures> measureAccuracy(const SimulatedSurvey& simulated, const PipelineConfig& config,
                                         std::uint64_t seed, Progress& progress, std::stop_token stop) {
    const Survey& survey = simulated.survey;
    const std::optional<std::size_t> area = areaRun(survey);
    if (!area) return usageError("accuracy is measured on the area walk, and there is none");

    AccuracyMeasures measures;
    const auto began = std::chrono::steady_clock::now();
    auto fused = fuseSurvey(survey, config.fusion, progress, stop);
    measures.fusion_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (!fused) return tl::unexpected(fused.error());
    measureArray(fused->runs[*area].trajectory, simulated.truth[*area], measures);
    measureEnds(survey, fused->runs, simulated.truth, config.fusion.stands.target_s, measures);

    const auto fused_track = groundBelow(survey, std::move(fused->runs), config.ground, stop);
    if (!fused_track) return tl::unexpected(fused_track.error());
    const auto true_track = groundBelow(survey, asFused(simulated.truth), config.ground, stop);
    if (!true_track) return tl::unexpected(true_track.error());
    const auto fused_ground = groundOf(survey, *fused_track, *area, config.surface, stop);
    if (!fused_ground) return tl::unexpected(fused_ground.error());
    const auto true_ground = groundOf(survey, *true_track, *area, config.surface, stop);
    if (!true_ground) return tl::unexpected(true_ground.error());
    measureGround(*fused_ground, *true_ground, simulated, checkPoints(simulated.truth[*area], seed),
                  measures);
    return measures;
}

SimulationOptions accuracySimulation(std::uint64_t seed, FaultLevel faults, GnssMode gnss, bool ties) {
    SimulationOptions options;
    options.seed = seed;
    options.faults = faults;
    options.gnss = gnss;
    if (!ties) {
        options.control_stops = 0;
        options.end_on_zero = false;
    }
    return options;
}

}  // namespace terrawalk
