#include "fusion/position_bends.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "survey/frames.hpp"

namespace terrawalk {

namespace {

/// One component of a vector at each step; NaN where there was no record.
std::vector<double> component(const std::vector<Eigen::Vector3d>& values, Eigen::Index axis) {
    std::vector<double> result;
    result.reserve(values.size());
    for (const Eigen::Vector3d& v : values) result.push_back(v[axis]);
    return result;
}

/// Interpolates missing values from those around them, by the autocovariance of the series.
class WienerInterpolation {
  public:
    explicit WienerInterpolation(const std::vector<double>& values) : values_(values) {
        double sum = 0.0;
        double count = 0.0;
        for (const double v : values) {
            if (std::isnan(v)) continue;
            sum += v;
            count += 1.0;
        }
        mean_ = count > 0.0 ? sum / count : 0.0;
        for (std::size_t lag = 0; lag < covariance_.size(); ++lag) {
            double products = 0.0;
            double pairs = 0.0;
            for (std::size_t i = 0; i + lag < values.size(); ++i) {
                const double product = (values[i] - mean_) * (values[i + lag] - mean_);
                if (std::isnan(product)) continue;
                products += product;
                pairs += 1.0;
            }
            // Longer lags have fewer pairs: tapering keeps the matrices positive.
            const double taper = 1.0 - static_cast<double>(lag) / static_cast<double>(2 * covariance_.size());
            covariance_[lag] = pairs > 0.0 ? taper * products / pairs : 0.0;
        }
    }

    struct Value {
        double value = 0.0;
        double variance = 0.0;
    };
    Value at(std::size_t index) const {
        std::array<std::size_t, 2 * kSide> near{};
        std::size_t n = 0;
        for (std::size_t i = index < kSide ? 0 : index - kSide; i <= index + kSide && i < values_.size();
             ++i) {
            if (i != index && !std::isnan(values_[i])) near[n++] = i;
        }
        const double variance = covariance_[0];
        if (n == 0 || variance <= 0.0) return {mean_, variance};
        const auto lag = [](std::size_t a, std::size_t b) {
            return a < b ? b - a : a - b;
        };
        const auto size = static_cast<Eigen::Index>(n);
        Eigen::MatrixXd among(size, size);
        Eigen::VectorXd with(size);
        Eigen::VectorXd known(size);
        for (Eigen::Index i = 0; i < size; ++i) {
            const std::size_t a = near[static_cast<std::size_t>(i)];
            for (Eigen::Index j = 0; j < size; ++j) {
                among(i, j) = covariance_[lag(a, near[static_cast<std::size_t>(j)])];
            }
            among(i, i) += kWhiteShare * variance;
            with[i] = covariance_[lag(a, index)];
            known[i] = values_[a] - mean_;
        }
        const Eigen::VectorXd weights = among.ldlt().solve(with);
        const double left = std::clamp(variance - weights.dot(with), 0.01 * variance, variance);
        return {mean_ + weights.dot(known), left};
    }

  private:
    static constexpr std::size_t kSide = 8;
    static constexpr double kWhiteShare = 0.01;
    const std::vector<double>& values_;
    double mean_ = 0.0;
    std::array<double, 2 * kSide + 1> covariance_{};
};

void fillGaps(LevelAcceleration& series) {
    series.filled_variance.assign(series.size(), Eigen::Vector3d::Zero());
    std::vector<bool> missing(series.size());
    for (std::size_t i = 0; i < series.size(); ++i) missing[i] = !series.level_mps2[i].allFinite();
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const std::vector<double> measured = component(series.level_mps2, axis);
        const WienerInterpolation interpolation(measured);
        for (std::size_t i = 0; i < series.size(); ++i) {
            if (!missing[i]) continue;
            const auto [value, variance] = interpolation.at(i);
            series.level_mps2[i][axis] = value;
            series.filled_variance[i][axis] = variance;
        }
    }
    for (std::size_t i = 1; i < series.size(); ++i) {
        if (missing[i]) series.level_from_body[i] = series.level_from_body[i - 1];
    }
}

/// Second difference with step `step_s` of a function and an average of a stride, as weights of the
/// function's second derivative: two triangles folded into each other, a spline of third degree.
double bendKernel_s(double t_s, double step_s) {
    constexpr std::array<double, 3> kDifference{1.0, -2.0, 1.0};
    double sum = 0.0;
    for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
            const double t = std::abs(t_s + i * step_s + j * kStrideAverage_s);
            sum += kDifference[static_cast<std::size_t>(i + 1)] *
                   kDifference[static_cast<std::size_t>(j + 1)] * t * t * t / 12.0;
        }
    }
    return sum / (kStrideAverage_s * kStrideAverage_s);
}

std::optional<PositionBend> bendAt(const LevelAcceleration& series, std::span<const double> yaw_rad,
                                   double time_s, double step_s) {
    const double reach_s = step_s + kStrideAverage_s;
    const double first = std::ceil((time_s - reach_s - series.from_s) / series.step_s);
    const double last = std::floor((time_s + reach_s - series.from_s) / series.step_s);
    if (first < 0.0 || last >= static_cast<double>(series.size())) return std::nullopt;
    PositionBend bend;
    Eigen::Vector3d filled = Eigen::Vector3d::Zero();
    for (auto j = static_cast<std::size_t>(first); j <= static_cast<std::size_t>(last); ++j) {
        const double weight = bendKernel_s(series.time(j) - time_s, step_s) * series.step_s;
        Eigen::Matrix3d enu_from_level = Eigen::Matrix3d::Identity();
        enu_from_level.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(yaw_rad[j]).toRotationMatrix();
        bend.bend_m += weight * enu_from_level * series.level_mps2[j];
        bend.by_bias_s2 += weight * enu_from_level * series.level_from_body[j];
        filled += weight * weight * series.filled_variance[j];
    }
    // Neighbouring bends share records; this is the white noise of bends that is as loud at low frequencies.
    bend.sigma_per_noise_s2 = std::sqrt(series.step_s * step_s * step_s * step_s);
    bend.filled_sigma_m = std::sqrt(filled.maxCoeff());
    return bend;
}

}  // namespace

std::optional<LevelAcceleration> levelAcceleration(const ArrayLog& log,
                                                   std::span<const EpochAttitude> attitudes) {
    if (!log.has(Channel::AccelerationX) || !log.has(Channel::AccelerationY) ||
        !log.has(Channel::AccelerationZ) || log.size() < 3) {
        return std::nullopt;
    }
    LevelAcceleration series;
    series.from_s = log.time_s.front();
    series.step_s = usualStep_s(log);
    constexpr double kMostSteps = 1e7;
    const double steps = (log.time_s.back() - series.from_s) / series.step_s;
    if (!(steps < kMostSteps)) return std::nullopt;
    const std::size_t n = static_cast<std::size_t>(std::lround(steps)) + 1;
    series.level_mps2.assign(n, Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
    series.level_from_body.assign(n, Eigen::Matrix3d::Identity());
    bool any = false;
    for (std::size_t i = 0; i < log.size(); ++i) {
        const Eigen::Vector3d force(log.value(Channel::AccelerationX, i),
                                    log.value(Channel::AccelerationY, i),
                                    log.value(Channel::AccelerationZ, i));
        if (!force.allFinite()) continue;
        any = true;
        const auto j = static_cast<std::size_t>(std::lround((log.time_s[i] - series.from_s) / series.step_s));
        Attitude tilt = attitudes[i].attitude;
        tilt.yaw_rad = 0.0;
        series.level_from_body[j] = rotationEnuFromBody(tilt);
        series.level_mps2[j] =
            series.level_from_body[j] * force - kStandardGravity_mps2 * Eigen::Vector3d::UnitZ();
    }
    if (!any) return std::nullopt;
    fillGaps(series);
    return series;
}

std::vector<PositionBend> positionBends(const LevelAcceleration& series, std::span<const double> yaw_rad,
                                        std::span<const double> knot_times_s, double step_s) {
    std::vector<PositionBend> bends;
    constexpr double kSlack = 1e-6;
    const auto stepped = [&](double from_s, double to_s) {
        return std::abs(to_s - from_s - step_s) < kSlack * step_s;
    };
    for (std::size_t k = 1; k + 1 < knot_times_s.size(); ++k) {
        if (!stepped(knot_times_s[k - 1], knot_times_s[k])) continue;
        if (!stepped(knot_times_s[k], knot_times_s[k + 1])) continue;
        auto bend = bendAt(series, yaw_rad, knot_times_s[k], step_s);
        if (!bend) continue;
        bend->knot = k;
        bends.push_back(*bend);
    }
    return bends;
}

Eigen::Vector3d strideAverage(std::span<const double> times_s, std::span<const Eigen::Vector3d> positions,
                              double time_s) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0.0;
    for (auto it = std::upper_bound(times_s.begin(), times_s.end(), time_s - kStrideAverage_s);
         it != times_s.end() && *it < time_s + kStrideAverage_s; ++it) {
        const double weight = kStrideAverage_s - std::abs(*it - time_s);
        sum += weight * positions[static_cast<std::size_t>(it - times_s.begin())];
        weights += weight;
    }
    if (weights == 0.0) return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    return sum / weights;
}

}  // namespace terrawalk
