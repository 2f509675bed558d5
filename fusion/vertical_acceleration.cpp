#include "fusion/vertical_acceleration.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "survey/frames.hpp"

namespace terrawalk {

namespace {

/// Vertical acceleration at even steps of time.
struct Series {
    double from_s = 0.0;
    double step_s = 0.0;
    std::vector<double> up_mps2;                ///< gravity removed; NaN where there was no record
    std::vector<Eigen::Vector3d> up_from_body;  ///< row of the rotation
    std::vector<double> filled_variance;        ///< of what was interpolated; 0 where measured
    std::size_t size() const { return up_mps2.size(); }
};

double usualStep(const std::vector<double>& times_s) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < times_s.size(); ++i) steps.push_back(times_s[i] - times_s[i - 1]);
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

std::optional<Series> measuredSeries(const ArrayLog& log, std::span<const EpochAttitude> attitudes) {
    if (!log.has(Channel::AccelerationX) || !log.has(Channel::AccelerationY) ||
        !log.has(Channel::AccelerationZ) || log.size() < 3) {
        return std::nullopt;
    }
    Series series;
    series.from_s = log.time_s.front();
    series.step_s = usualStep(log.time_s);
    constexpr double kMostSteps = 1e8;
    const double steps = (log.time_s.back() - series.from_s) / series.step_s;
    if (!(steps < kMostSteps)) return std::nullopt;
    const std::size_t n = static_cast<std::size_t>(std::lround(steps)) + 1;
    series.up_mps2.assign(n, std::numeric_limits<double>::quiet_NaN());
    series.up_from_body.assign(n, Eigen::Vector3d::UnitZ());
    for (std::size_t i = 0; i < log.size(); ++i) {
        const Eigen::Vector3d force(log.value(Channel::AccelerationX, i),
                                    log.value(Channel::AccelerationY, i),
                                    log.value(Channel::AccelerationZ, i));
        if (!force.allFinite()) continue;
        const auto j =
            static_cast<std::size_t>(std::lround((log.time_s[i] - series.from_s) / series.step_s));
        const Eigen::Vector3d up = rotationEnuFromBody(attitudes[i].attitude).row(2).transpose();
        series.up_from_body[j] = up;
        series.up_mps2[j] = up.dot(force) - kStandardGravity_mps2;
    }
    return series;
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

void fillGaps(Series& series) {
    const WienerInterpolation interpolation(series.up_mps2);
    std::vector<double> filled = series.up_mps2;
    series.filled_variance.assign(series.size(), 0.0);
    for (std::size_t i = 0; i < series.size(); ++i) {
        if (!std::isnan(series.up_mps2[i])) continue;
        const auto [value, variance] = interpolation.at(i);
        filled[i] = value;
        series.filled_variance[i] = variance;
        if (i > 0) series.up_from_body[i] = series.up_from_body[i - 1];
    }
    series.up_mps2 = std::move(filled);
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

std::optional<HeightBend> bendAt(const Series& series, double time_s, double step_s) {
    const double reach_s = step_s + kStrideAverage_s;
    const double first = std::ceil((time_s - reach_s - series.from_s) / series.step_s);
    const double last = std::floor((time_s + reach_s - series.from_s) / series.step_s);
    if (first < 0.0 || last >= static_cast<double>(series.size())) return std::nullopt;
    HeightBend bend;
    double filled = 0.0;
    for (auto j = static_cast<std::size_t>(first); j <= static_cast<std::size_t>(last); ++j) {
        const double t = series.from_s + static_cast<double>(j) * series.step_s - time_s;
        const double weight = bendKernel_s(t, step_s) * series.step_s;
        bend.bend_m += weight * series.up_mps2[j];
        bend.by_bias_s2 += weight * series.up_from_body[j];
        filled += weight * weight * series.filled_variance[j];
    }
    // Neighbouring bends share records; this is the white noise of bends that is as loud at low frequencies.
    bend.sigma_per_noise_s2 = std::sqrt(series.step_s * step_s * step_s * step_s);
    bend.filled_sigma_m = std::sqrt(filled);
    return bend;
}

}  // namespace

std::vector<HeightBend> heightBends(const ArrayLog& log, std::span<const EpochAttitude> attitudes,
                                    std::span<const double> knot_times_s, double step_s) {
    std::vector<HeightBend> bends;
    auto series = measuredSeries(log, attitudes);
    if (!series) return bends;
    fillGaps(*series);
    constexpr double kSlack = 1e-6;
    const auto stepped = [&](double from_s, double to_s) {
        return std::abs(to_s - from_s - step_s) < kSlack * step_s;
    };
    for (std::size_t k = 1; k + 1 < knot_times_s.size(); ++k) {
        if (!stepped(knot_times_s[k - 1], knot_times_s[k])) continue;
        if (!stepped(knot_times_s[k], knot_times_s[k + 1])) continue;
        auto bend = bendAt(*series, knot_times_s[k], step_s);
        if (!bend) continue;
        bend->knot = k;
        bends.push_back(*bend);
    }
    return bends;
}

double strideAverage(std::span<const double> times_s, std::span<const double> values, double time_s) {
    double sum = 0.0;
    double weights = 0.0;
    for (auto it = std::upper_bound(times_s.begin(), times_s.end(), time_s - kStrideAverage_s);
         it != times_s.end() && *it < time_s + kStrideAverage_s; ++it) {
        const double weight = kStrideAverage_s - std::abs(*it - time_s);
        sum += weight * values[static_cast<std::size_t>(it - times_s.begin())];
        weights += weight;
    }
    return weights > 0.0 ? sum / weights : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace terrawalk
