#include "mapping/accuracy.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>

#include "mapping/order_statistics.hpp"

namespace terrawalk {

namespace {

constexpr std::size_t kResamples = 4000;
constexpr std::size_t kLeastMarksForInterval = 5;
constexpr double kNormalMad = 1.4826;   // NMAD of a normal distribution is its sigma

/// Steele, Lea and Flood 2014; standard generators differ between libraries in what they make of a seed.
class SplitMix64 {
  public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
    /// An index below n; n must be below 2^32.
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(((next() >> 32U) * n) >> 32U); }

  private:
    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
        return z ^ (z >> 31U);
    }
    std::uint64_t state_;
};

struct SquaresOfMark {
    double sum = 0.0;
    double count = 0.0;
};

std::optional<ConfidenceInterval> bootstrapRmse(const std::vector<SquaresOfMark>& marks, std::uint64_t seed) {
    if (marks.size() < kLeastMarksForInterval) return std::nullopt;
    SplitMix64 random(seed);
    std::vector<double> rmse(kResamples);
    for (double& value : rmse) {
        SquaresOfMark total;
        for (std::size_t i = 0; i < marks.size(); ++i) {
            const SquaresOfMark& drawn = marks[random.below(marks.size())];
            total.sum += drawn.sum;
            total.count += drawn.count;
        }
        value = std::sqrt(total.sum / total.count);
    }
    std::sort(rmse.begin(), rmse.end());
    return ConfidenceInterval{quantileOfSorted(rmse, 0.025), quantileOfSorted(rmse, 0.975)};
}

ErrorStatistics statistics(const std::vector<double>& d, const std::vector<SquaresOfMark>& marks,
                           std::uint64_t seed) {
    assert(!d.empty());
    const auto n = static_cast<double>(d.size());
    ErrorStatistics s;
    s.n = d.size();
    s.marks = marks.size();
    s.mean_m = std::accumulate(d.begin(), d.end(), 0.0) / n;
    double squares = 0.0, deviations = 0.0, magnitudes = 0.0;
    for (const double value : d) {
        squares += value * value;
        deviations += (value - s.mean_m) * (value - s.mean_m);
        magnitudes += std::abs(value);
    }
    s.rmse_m = std::sqrt(squares / n);
    if (d.size() >= 2) s.sd_m = std::sqrt(deviations / (n - 1.0));
    s.mae_m = magnitudes / n;
    s.median_m = median(d);
    std::vector<double> from_median(d.size());
    std::transform(d.begin(), d.end(), from_median.begin(),
                   [&](double value) { return std::abs(value - s.median_m); });
    s.nmad_m = kNormalMad * median(std::move(from_median));
    s.largest_m =
        *std::max_element(d.begin(), d.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    s.rmse_95 = bootstrapRmse(marks, seed);
    return s;
}

template <class Value>
std::optional<ErrorStatistics> ofAxis(const std::vector<const Residual*>& residuals, std::uint64_t seed,
                                      Value value) {
    std::vector<MarkDifference> differences;
    for (const Residual* residual : residuals) {
        const double d = value(residual->difference_enu_m);
        if (std::isfinite(d)) differences.push_back({residual->mark, d});
    }
    if (differences.empty()) return std::nullopt;
    return errorStatistics(differences, seed);
}

std::optional<SigmaCoverage> heightCoverage(const std::vector<const Residual*>& residuals) {
    SigmaCoverage coverage;
    for (const Residual* residual : residuals) {
        const double d = residual->difference_enu_m.z(), sigma = residual->sigma_enu_m.z();
        if (!std::isfinite(d) || !std::isfinite(sigma)) continue;
        coverage.add(d, sigma);
    }
    if (coverage.n == 0) return std::nullopt;
    return coverage;
}

}  // namespace

ErrorStatistics errorStatistics(const std::vector<double>& differences_m, std::uint64_t seed) {
    std::vector<SquaresOfMark> marks;
    marks.reserve(differences_m.size());
    for (const double d : differences_m) marks.push_back({d * d, 1.0});
    return statistics(differences_m, marks, seed);
}

ErrorStatistics errorStatistics(const std::vector<MarkDifference>& differences, std::uint64_t seed) {
    std::vector<double> d;
    std::vector<SquaresOfMark> marks;
    std::map<std::string, std::size_t> index_of_mark;
    for (const auto& [mark, difference_m] : differences) {
        d.push_back(difference_m);
        const auto [at, is_new] = index_of_mark.try_emplace(mark, marks.size());
        if (is_new) marks.emplace_back();
        marks[at->second].sum += difference_m * difference_m;
        marks[at->second].count += 1.0;
    }
    return statistics(d, marks, seed);
}

std::vector<AccuracyGroup> accuracyGroups(const std::vector<Residual>& residuals, std::uint64_t seed) {
    constexpr std::array kStages{Stage::BeforeFusion, Stage::Fused, Stage::Surface};
    constexpr std::array kQuantities{Quantity::ArrayPosition, Quantity::NearestSample,
                                     Quantity::SurfaceHeight};
    constexpr std::array kRoles{MarkRole::Check, MarkRole::Control};

    std::vector<AccuracyGroup> groups;
    for (const Stage stage : kStages) {
        for (const Quantity quantity : kQuantities) {
            for (const MarkRole role : kRoles) {
                std::vector<const Residual*> members;
                for (const Residual& r : residuals) {
                    if (r.stage == stage && r.quantity == quantity && r.role == role &&
                        !r.used_by_estimator) {
                        members.push_back(&r);
                    }
                }
                AccuracyGroup group;
                group.stage = stage;
                group.quantity = quantity;
                group.role = role;
                using Vector = Eigen::Vector3d;
                group.east = ofAxis(members, seed, [](const Vector& d) { return d.x(); });
                group.north = ofAxis(members, seed, [](const Vector& d) { return d.y(); });
                group.up = ofAxis(members, seed, [](const Vector& d) { return d.z(); });
                group.horizontal = ofAxis(
                    members, seed, [](const Vector& d) { return std::sqrt(d.x() * d.x() + d.y() * d.y()); });
                group.up_coverage = heightCoverage(members);
                if (group.east || group.north || group.up) groups.push_back(std::move(group));
            }
        }
    }
    return groups;
}

double rmseWithMarkError_m(double rmse_fit_m, double sigma_marks_m) {
    return std::sqrt(rmse_fit_m * rmse_fit_m + sigma_marks_m * sigma_marks_m);
}

}  // namespace terrawalk
