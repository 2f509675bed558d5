#include "mapping/ground_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "survey/upper_median.hpp"

namespace terrawalk {
namespace {

constexpr std::size_t kNeighboursOnSide = 15;
constexpr std::size_t kLeastNeighbours = 5;
constexpr double kSigmaPerMad = 1.4826;  // of a normal distribution

double square(double value) {
    return value * value;
}

double sigmaRange(double range_m, const GroundPointOptions& options) {
    return range_m <= options.range_near_m ? options.sigma_range_near_m
                                           : options.sigma_range_far_share * range_m;
}

/// Where the ray ends, as seen from the array, and its derivatives. Frame: ENU.
struct Ray {
    Eigen::Vector3d offset_enu_m;
    Eigen::Vector3d by_range;
    Eigen::Vector3d by_roll_m;  // per radian
    Eigen::Vector3d by_pitch_m;
    Eigen::Vector3d by_heading_m;
    double tilt_rad;
};

Ray castRay(const Attitude& attitude, const Eigen::Vector3d& lever_arm_m, double range_m) {
    const Eigen::Matrix3d R_enu_body = rotationEnuFromBody(attitude);
    // Each angle turns the offset about its own axis of Rz(yaw) Ry(-pitch) Rx(roll).
    const Eigen::Vector3d roll_axis_enu = R_enu_body.col(0);
    const Eigen::Vector3d pitch_axis_enu(std::sin(attitude.yaw_rad), -std::cos(attitude.yaw_rad), 0.0);
    Ray ray;
    ray.offset_enu_m = R_enu_body * (lever_arm_m - range_m * Eigen::Vector3d::UnitZ());
    ray.by_range = -R_enu_body.col(2);
    ray.by_roll_m = roll_axis_enu.cross(ray.offset_enu_m);
    ray.by_pitch_m = pitch_axis_enu.cross(ray.offset_enu_m);
    ray.by_heading_m = -Eigen::Vector3d::UnitZ().cross(ray.offset_enu_m);
    ray.tilt_rad = std::acos(std::clamp(R_enu_body(2, 2), -1.0, 1.0));
    return ray;
}

Eigen::Vector3d sigmas(const TrajectoryEpoch& epoch, const Ray& ray, double sigma_range_m) {
    const Eigen::Vector3d position_variance = epoch.covariance.diagonal().head<3>();
    const Eigen::Vector3d variance =
        position_variance + ray.by_range.cwiseAbs2() * square(sigma_range_m) +
        (ray.by_roll_m.cwiseAbs2() + ray.by_pitch_m.cwiseAbs2()) * square(epoch.sigma_tilt_rad) +
        ray.by_heading_m.cwiseAbs2() * square(epoch.sigma_heading_rad);
    return variance.cwiseSqrt();
}

bool positionUnsure(const TrajectoryEpoch& epoch, const GroundPointOptions& options) {
    const auto within = [&](Eigen::Index axis, double greatest_sigma_m) {
        const double variance_m2 = epoch.covariance(axis, axis);
        return variance_m2 >= 0.0 && variance_m2 <= square(greatest_sigma_m);
    };
    const bool sure = epoch.position_enu_m.allFinite() && within(0, options.greatest_sigma_m) &&
                      within(1, options.greatest_sigma_m) && within(2, options.greatest_sigma_u_m);
    return !sure;
}

GroundPointState stateOf(double range_m, double strength, const Ray& ray, const TrajectoryEpoch& epoch,
                         const GroundPointOptions& options) {
    if (range_m < options.least_range_m) {
        return GroundPointState::RangeTooShort;
    }
    if (range_m > options.greatest_range_m) {
        return GroundPointState::RangeTooLong;
    }
    if (strength < options.least_strength) {
        return GroundPointState::WeakReturn;
    }
    if (strength > options.greatest_strength) {
        return GroundPointState::Saturated;
    }
    if (!(ray.tilt_rad <= options.greatest_tilt_rad)) {
        return GroundPointState::Tilted;
    }
    if (positionUnsure(epoch, options)) {
        return GroundPointState::PositionUnsure;
    }
    return GroundPointState::Used;
}

GroundPoint groundPoint(const ArrayLog& log, std::size_t i, const TrajectoryEpoch& epoch,
                        const GroundPointOptions& options) {
    GroundPoint point;
    point.epoch = static_cast<std::uint32_t>(i);
    point.time_s = epoch.time_s;
    const double range_m = log.value(Channel::Range, i);
    if (!std::isfinite(range_m)) {
        point.enu_m.setConstant(kMissing);
        point.sigma_e_m = point.sigma_n_m = point.sigma_u_m = kMissing;
        point.state = GroundPointState::NoRange;
        return point;
    }
    const Ray ray = castRay(epoch.attitude, log.range_lever_arm_m, range_m);
    const Eigen::Vector3d sigma_m = sigmas(epoch, ray, sigmaRange(range_m, options));
    point.enu_m = epoch.position_enu_m + ray.offset_enu_m;
    point.sigma_e_m = sigma_m.x();
    point.sigma_n_m = sigma_m.y();
    point.sigma_u_m = sigma_m.z();
    point.state = stateOf(range_m, log.value(Channel::RangeStrength, i), ray, epoch, options);
    return point;
}

/// A good point along the track.
struct TrackPoint {
    std::size_t index;
    double time_s;
    double path_m;
    double height_m;
};

std::vector<TrackPoint> goodTrackPoints(const std::vector<GroundPoint>& points,
                                        const Trajectory& trajectory) {
    std::vector<TrackPoint> track;
    double path_m = 0.0;
    const TrajectoryEpoch* previous = nullptr;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const TrajectoryEpoch& epoch = trajectory.epochs[i];
        if (!epoch.position_enu_m.allFinite()) {
            continue;
        }
        if (previous != nullptr) {
            path_m += (epoch.position_enu_m - previous->position_enu_m).head<2>().norm();
        }
        previous = &epoch;
        if (points[i].state == GroundPointState::Used) {
            track.push_back({i, epoch.time_s, path_m, points[i].enu_m.z()});
        }
    }
    return track;
}

/// Scratch space that is used again for each point.
struct Scratch {
    std::vector<TrackPoint> side;
    std::vector<double> values;
};

/// Slope of the ground along the track, the median over all pairs. Level where the neighbours lie too close
/// together to say what the ground does at the point, or in one place because the array stands still.
double slopeTowards(const TrackPoint& point, Scratch& scratch) {
    const std::vector<TrackPoint>& side = scratch.side;
    const double nearest_m = std::abs(side.front().path_m - point.path_m);
    const double farthest_m = std::abs(side.back().path_m - point.path_m);
    if (farthest_m - nearest_m < 0.5 * farthest_m) {
        return 0.0;
    }
    std::vector<double>& slopes = scratch.values;
    slopes.clear();
    for (std::size_t i = 0; i < side.size(); ++i) {
        for (std::size_t j = i + 1; j < side.size(); ++j) {
            if (side[j].path_m != side[i].path_m) {
                slopes.push_back((side[j].height_m - side[i].height_m) / (side[j].path_m - side[i].path_m));
            }
        }
    }
    return slopes.empty() ? 0.0 : upperMedian(slopes);
}

/// How far a point stands above the line through its neighbours on one side, in robust spreads; nothing when
/// there are too few neighbours. The side begins with the nearest.
std::optional<double> spreadsAboveSide(const TrackPoint& point, Scratch& scratch, double floor_m) {
    const std::vector<TrackPoint>& side = scratch.side;
    if (side.size() < kLeastNeighbours) {
        return std::nullopt;
    }
    const double slope = slopeTowards(point, scratch);
    std::vector<double>& values = scratch.values;
    values.clear();
    for (const TrackPoint& neighbour : side) {
        values.push_back(neighbour.height_m - slope * (neighbour.path_m - point.path_m));
    }
    const double line_m = upperMedian(values);
    for (double& value : values) {
        value = std::abs(value - line_m);
    }
    const double spread_m = std::max(kSigmaPerMad * upperMedian(values), floor_m);
    return (point.height_m - line_m) / spread_m;
}

bool isSpike(const std::vector<TrackPoint>& track, std::size_t i, const GroundPointOptions& options,
             Scratch& scratch) {
    const auto near = [&](const TrackPoint& neighbour) {
        return std::abs(neighbour.path_m - track[i].path_m) <= options.spike_window_m &&
               std::abs(neighbour.time_s - track[i].time_s) <= options.spike_window_s;
    };
    scratch.side.clear();
    for (std::size_t j = i; j > 0 && scratch.side.size() < kNeighboursOnSide && near(track[j - 1]); --j) {
        scratch.side.push_back(track[j - 1]);
    }
    const std::optional<double> before = spreadsAboveSide(track[i], scratch, options.spike_floor_m);
    scratch.side.clear();
    for (std::size_t j = i + 1; j < track.size() && scratch.side.size() < kNeighboursOnSide && near(track[j]);
         ++j) {
        scratch.side.push_back(track[j]);
    }
    const std::optional<double> after = spreadsAboveSide(track[i], scratch, options.spike_floor_m);
    if (!before && !after) {
        return false;
    }
    const double from_before = before.value_or(after.value_or(0.0));
    const double from_after = after.value_or(from_before);
    return std::min(from_before, from_after) > options.spike_sigma ||
           std::max(from_before, from_after) < -options.spike_sigma;
}

void markSpikes(std::vector<GroundPoint>& points, const Trajectory& trajectory,
                const GroundPointOptions& options, const std::stop_token& stop) {
    const std::vector<TrackPoint> track = goodTrackPoints(points, trajectory);
    Scratch scratch;
    for (std::size_t i = 0; i < track.size(); ++i) {
        if (i % 1024 == 0 && stop.stop_requested()) return;
        if (isSpike(track, i, options, scratch)) {
            points[track[i].index].state = GroundPointState::Spike;
        }
    }
}

}  // namespace

std::vector<GroundPoint> groundPoints(const Run& run, std::uint32_t run_index, const Trajectory& trajectory,
                                      const GroundPointOptions& options, std::stop_token stop) {
    assert(trajectory.epochs.size() == run.log.size());
    std::vector<GroundPoint> points;
    points.reserve(trajectory.epochs.size());
    for (std::size_t i = 0; i < trajectory.epochs.size(); ++i) {
        points.push_back(groundPoint(run.log, i, trajectory.epochs[i], options));
        points.back().run = run_index;
    }
    if (options.spike_sigma > 0.0) {
        markSpikes(points, trajectory, options, stop);
    }
    return points;
}

}  // namespace terrawalk
