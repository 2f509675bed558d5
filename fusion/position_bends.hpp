#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fusion/sensor_readings.hpp"
#include "survey/array_log.hpp"

namespace terrawalk {

/// Acceleration at even steps of time, gravity removed, in the level frame that turns with the array:
/// forward, left, up.
struct LevelAcceleration {
    double from_s = 0.0;
    double step_s = 0.0;
    std::vector<Eigen::Vector3d> level_mps2;
    std::vector<Eigen::Matrix3d> level_from_body;
    std::vector<Eigen::Vector3d> filled_variance;  ///< (m/s^2)^2 of what was interpolated; 0 where measured
    [[nodiscard]] std::size_t size() const { return level_mps2.size(); }
    [[nodiscard]] double time(std::size_t i) const { return from_s + static_cast<double>(i) * step_s; }
};

/// Specific force of a log, levelled by its attitudes. Missing records are interpolated from the
/// autocovariance of the others (Wiener). Nothing where the log has no accelerometer.
[[nodiscard]] std::optional<LevelAcceleration> levelAcceleration(const ArrayLog& log,
                                                                 std::span<const EpochAttitude> attitudes);

/// What the accelerometer tells of the position at three knots in time, `step_s` apart:
///
///     p(t - step) - 2 p(t) + p(t + step) = bend_m - by_bias b + noise
///
/// with p the position averaged over a stride, east, north, up, and b the accelerometer's bias, body frame.
/// No velocity is needed, and nothing is summed up over longer than the kernel.
struct PositionBend {
    std::size_t knot = 0;  ///< of the middle
    Eigen::Vector3d bend_m = Eigen::Vector3d::Zero();
    Eigen::Matrix3d by_bias_s2 = Eigen::Matrix3d::Zero();
    double sigma_per_noise_s2 = 0.0;  ///< sigma for white noise of 1 m/s^2 in each record
    double filled_sigma_m = 0.0;      ///< from records that were missing, the greatest of the axes
};

/// Half the width of the average p [s]: steps of 1.4 to 2 Hz, and what a slow log makes of their harmonics,
/// fall out.
inline constexpr double kStrideAverage_s = 0.6;

/// The bend at each knot that has one knot `step_s` before and one after it, and accelerations all around.
/// @param yaw_rad  of each step of the series, counter-clockwise from east
/// Pure. Source: the second difference of a function is its second derivative under a triangle.
[[nodiscard]] std::vector<PositionBend> positionBends(const LevelAcceleration& series,
                                                      std::span<const double> yaw_rad,
                                                      std::span<const double> knot_times_s, double step_s);

/// Mean of positions about `time_s` under the same average of a stride; times rise. NaN where there are none.
[[nodiscard]] Eigen::Vector3d strideAverage(std::span<const double> times_s,
                                            std::span<const Eigen::Vector3d> positions, double time_s);

}  // namespace terrawalk
