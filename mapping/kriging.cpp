// Ordinary kriging of the nearest points. Matheron, G.: Principles of geostatistics. Economic Geology 58
// (1963); the form with semivariances of Cressie, N.: Statistics for Spatial Data, 1993, section 3.2.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "mapping/interpolators.hpp"
#include "mapping/plan_kd_tree.hpp"
#include "mapping/variogram.hpp"

namespace terrawalk {
namespace {

/// Variance of a single height above the smooth surface when the fitted nugget is nothing, as a share of the
/// sill: keeps the system solvable where points nearly touch.
constexpr double kLeastNuggetShare = 1e-9;

constexpr std::size_t kLeastPoints = 30;  // fewer teach nothing
constexpr std::size_t kMostLeftOut = 2000;
constexpr std::size_t kAround = 4;  // times the neighbours: how far about a point left out places may lie
// A mean square beyond this says that the variogram does not fit at all.
constexpr double kLeastFactor = 0.05, kGreatestFactor = 20.0;

/// A point foretold from the others, and what its error should be: of the noise of heights, its own included,
/// and of the ground between them.
struct LeftOut {
    double squared_error_m2;
    double noise_m2;
    double structure_m2;
    double distance_m;  ///< to the nearest of the others
};

/// Factors of noise and structure: the line through the squared errors, then both by one factor that makes
/// the mean of squared error over variance one. A squared normal error has twice the square of its mean as
/// variance, so each counts by its own mean.
std::pair<double, double> learntFactors(const std::vector<LeftOut>& left_out) {
    double noise = 1.0, structure = 1.0;
    const auto expected_m2 = [&](const LeftOut& l) {
        return noise * l.noise_m2 + structure * l.structure_m2;
    };
    for (int round = 0; round < 8; ++round) {
        double nn = 0.0, ns = 0.0, ss = 0.0, ne = 0.0, se = 0.0;
        for (const LeftOut& l : left_out) {
            const double n = l.noise_m2 / expected_m2(l), s = l.structure_m2 / expected_m2(l);
            const double e = l.squared_error_m2 / expected_m2(l);
            nn += n * n;
            ns += n * s;
            ss += s * s;
            ne += n * e;
            se += s * e;
        }
        const double determinant = nn * ss - ns * ns;
        if (!(determinant > 1e-9 * nn * ss)) break;  // the two cannot be told apart
        noise = std::clamp((ss * ne - ns * se) / determinant, kLeastFactor, kGreatestFactor);
        structure = std::clamp((nn * se - ns * ne) / determinant, kLeastFactor, kGreatestFactor);
    }
    double mean = 0.0;
    for (const LeftOut& l : left_out) mean += l.squared_error_m2 / expected_m2(l);
    mean = std::clamp(mean / static_cast<double>(left_out.size()), kLeastFactor, kGreatestFactor);
    return {mean * noise, mean * structure};
}

class Kriging final : public HeightInterpolator {
  public:
    Kriging(PlacedHeights points, std::size_t neighbours)
        : points_(std::move(points)),
          tree_(points_.points_m),
          neighbours_(neighbours),
          variogram_(fitVariogram(empiricalVariogram(points_.points_m, 4 * neighbours))) {
        variogram_.nugget_m2 = std::max(variogram_.nugget_m2, kLeastNuggetShare * variogram_.sill_m2);
    }

    [[nodiscard]] bool hasVariance() const override { return true; }

    void estimate(std::span<const Eigen::Vector2d> places_m,
                  std::span<HeightEstimate> estimates) const override {
        Workspace workspace;
        for (std::size_t i = 0; i < places_m.size(); ++i) {
            tree_.nearest(places_m[i], neighbours_, workspace.near);
            estimates[i] = estimateAt(workspace);
        }
    }

    [[nodiscard]] std::optional<VarianceScale> varianceScale() const override { return scale_; }

    void learnVariance() {
        if (points_.points_m.size() < kLeastPoints) return;
        const std::vector<LeftOut> left_out = foretellLeftOut();
        VarianceScale scale;
        std::tie(scale.noise, scale.structure) = learntFactors(left_out);
        for (const LeftOut& l : left_out) {
            const double variance_m2 = scale.noise * l.noise_m2 + scale.structure * l.structure_m2;
            scale.left_out.add(std::sqrt(l.squared_error_m2), std::sqrt(variance_m2));
            scale.greatest_distance_m = std::max(scale.greatest_distance_m, l.distance_m);
        }
        scale_ = scale;
    }

  private:
    struct Workspace {
        std::vector<Neighbour> near;
        Eigen::MatrixXd system;
        Eigen::VectorXd right;
        Eigen::PartialPivLU<Eigen::MatrixXd> factor;
        double noise_m2 = 0.0;      ///< part of the variance of the last estimate
        double structure_m2 = 0.0;  ///< and the rest of it
    };

    /// Points spread evenly over the list, each foretold from the others.
    [[nodiscard]] std::vector<LeftOut> foretellLeftOut() const {
        std::vector<LeftOut> left_out;
        Workspace w;
        std::vector<Neighbour> at_place;
        const std::size_t count = points_.points_m.size();
        const std::size_t step = (count + kMostLeftOut - 1) / kMostLeftOut;
        for (std::size_t i = 0; i < count; i += step) {
            const auto point = static_cast<std::uint32_t>(i);
            tree_.nearest(points_.points_m[i].head<2>(), kAround * neighbours_, w.near);
            std::erase_if(w.near, [&](const Neighbour& n) { return n.point == point; });
            // A place that could lie anywhere about here: how far it is from a point, so far a point left out
            // shall be. Points along a track are next to one another, places between two passes are not.
            const Eigen::Vector2d place =
                0.5 * (points_.points_m[i] + points_.points_m[w.near.back().point]).head<2>();
            tree_.nearest(place, 1, at_place);
            const double wanted_m = std::sqrt(at_place.front().squared_distance_m2);
            const auto off_m = [&](const Neighbour& n) {
                return std::abs(std::sqrt(n.squared_distance_m2) - wanted_m);
            };
            const auto first =
                std::min_element(w.near.begin(), w.near.end(),
                                 [&](const Neighbour& a, const Neighbour& b) { return off_m(a) < off_m(b); });
            w.near.erase(w.near.begin(), first);
            if (w.near.size() > neighbours_) w.near.resize(neighbours_);
            const double error_m = estimateAt(w).height_m - points_.points_m[i].z();
            left_out.push_back({error_m * error_m, w.noise_m2 + errorVariance_m2(point), w.structure_m2,
                                std::sqrt(w.near.front().squared_distance_m2)});
        }
        return left_out;
    }

    [[nodiscard]] double distance_m(std::uint32_t a, std::uint32_t b) const {
        return (points_.points_m[a] - points_.points_m[b]).head<2>().norm();
    }

    /// What a height differs from the smooth surface by: the nugget, and its own sigma where it is larger.
    [[nodiscard]] double errorVariance_m2(std::uint32_t point) const {
        const double sigma_m = points_.sigmas_m.empty() ? 0.0 : points_.sigmas_m[point];
        return std::max(variogram_.nugget_m2, sigma_m * sigma_m);
    }

    /// The smooth surface is estimated, without nugget: a height with an error is not held.
    [[nodiscard]] HeightEstimate estimateAt(Workspace& w) const {
        const auto count = static_cast<Eigen::Index>(w.near.size());
        w.system.setOnes(count + 1, count + 1);
        w.right.setOnes(count + 1);
        for (Eigen::Index i = 0; i < count; ++i) {
            const std::uint32_t point = w.near[static_cast<std::size_t>(i)].point;
            for (Eigen::Index j = 0; j < i; ++j) {
                const double structure =
                    variogram_.structureAt(distance_m(point, w.near[static_cast<std::size_t>(j)].point));
                w.system(i, j) = w.system(j, i) = structure;
            }
            w.system(i, i) = -errorVariance_m2(point);
            w.right[i] =
                variogram_.structureAt(std::sqrt(w.near[static_cast<std::size_t>(i)].squared_distance_m2));
        }
        w.system(count, count) = 0.0;
        w.factor.compute(w.system);
        const Eigen::VectorXd weights = w.factor.solve(w.right);
        const double base = points_.points_m[w.near.front().point].z();
        HeightEstimate estimate{base, weights[count]};
        for (Eigen::Index i = 0; i < count; ++i) {
            const std::uint32_t point = w.near[static_cast<std::size_t>(i)].point;
            estimate.height_m += weights[i] * (points_.points_m[point].z() - base);
            estimate.variance_m2 += weights[i] * w.right[i];
        }
        w.noise_m2 = 0.0;
        for (Eigen::Index i = 0; i < count; ++i) {
            w.noise_m2 +=
                weights[i] * weights[i] * errorVariance_m2(w.near[static_cast<std::size_t>(i)].point);
        }
        w.structure_m2 = std::max(estimate.variance_m2 - w.noise_m2, 0.0);
        estimate.variance_m2 = std::max(estimate.variance_m2, 0.0);
        if (scale_) estimate.variance_m2 = scale_->noise * w.noise_m2 + scale_->structure * w.structure_m2;
        return estimate;
    }

    PlacedHeights points_;
    PlanKdTree tree_;
    std::size_t neighbours_;
    Variogram variogram_;
    std::optional<VarianceScale> scale_;
};

}  // namespace

Result<InterpolatorPointer> makeKriging(PlacedHeights points, std::size_t neighbours, bool learn_variance,
                                        Progress& progress, const std::stop_token& stop) {
    progress.report(0.0, "fitting the variogram");
    if (stop.stop_requested()) return cancelled();
    auto kriging = std::make_unique<Kriging>(std::move(points), neighbours);
    if (learn_variance) kriging->learnVariance();
    return kriging;
}

}  // namespace terrawalk
