#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "fusion/sensor_readings.hpp"
#include "survey/array_log.hpp"

namespace terrawalk {

/// What the accelerometer tells of the height at three knots in time, `step_s` apart:
///
///     h(t - step) - 2 h(t) + h(t + step) = bend_m - by_bias . b + noise
///
/// with h the height of the array averaged over a stride and b the accelerometer's bias, body frame. No
/// velocity is needed, and nothing is summed up over longer than the kernel.
struct HeightBend {
    std::size_t knot = 0;  ///< of the middle
    double bend_m = 0.0;
    Eigen::Vector3d by_bias_s2 = Eigen::Vector3d::Zero();
    double sigma_per_noise_s2 = 0.0;  ///< sigma for white noise of 1 m/s^2 in each record
    double filled_sigma_m = 0.0;      ///< from records that were missing and are interpolated
};

/// Half the width of the average h [s]: a step of 1.4 to 2 Hz, and what a slow log makes of its harmonics,
/// falls out.
inline constexpr double kStrideAverage_s = 0.6;

/// The bend at each knot that has one knot `step_s` before and one after it, and accelerations all around.
/// Missing records are interpolated from the autocovariance of the others (Wiener). Heights are along the
/// local vertical; the attitudes tilt the specific force. Pure.
[[nodiscard]] std::vector<HeightBend> heightBends(const ArrayLog& log,
                                                  std::span<const EpochAttitude> attitudes,
                                                  std::span<const double> knot_times_s, double step_s);

/// Mean of values at `time_s` under the same average of a stride; times rise, NaN where there are none.
[[nodiscard]] double strideAverage(std::span<const double> times_s, std::span<const double> values,
                                   double time_s);

}  // namespace terrawalk
