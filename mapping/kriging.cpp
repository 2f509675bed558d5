// Ordinary kriging of the nearest points. Matheron, G.: Principles of geostatistics. Economic Geology 58
// (1963); the form with semivariances of Cressie, N.: Statistics for Spatial Data, 1993, section 3.2.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "mapping/interpolators.hpp"
#include "mapping/order_statistics.hpp"
#include "mapping/plan_kd_tree.hpp"
#include "mapping/variogram.hpp"
#include "survey/frames.hpp"

namespace terrawalk {
namespace {

/// Variance of a single height above the smooth surface when the fitted nugget is nothing, as a share of the
/// sill: keeps the system solvable where points nearly touch.
constexpr double kLeastNuggetShare = 1e-9;

constexpr std::size_t kLeastPoints = 30;  // fewer teach nothing
constexpr std::size_t kMostLeftOut = 2000;
constexpr std::size_t kMostToLearnFrom = 400;
// Of four: nuggets that are tried, over what the ground differs by at the usual distance from a point.
constexpr int kLeastNuggetPower = -6, kGreatestNuggetPower = 3;
// Pairs of places for the range of the errors.
constexpr std::size_t kErrorPlaces = 48, kErrorRings = 12, kErrorDirections = 6;
constexpr double kErrorReach = 2.0;  // of neighbourhoods: beyond it two places share no point
constexpr std::size_t kAround = 4;   // times the neighbours: how far about a point left out places may lie
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

/// How well variances foretell the errors at points left out: mean of the logarithm of the variance, when all
/// of them are scaled so that the mean of squared error over variance is one. The smaller the better; twice
/// the negative logarithm of their normal density but for a constant.
struct LeftOutScore {
    double value = std::numeric_limits<double>::infinity();
    double scale = 1.0;
};

LeftOutScore scoreOf(const std::vector<LeftOut>& left_out) {
    double logarithms = 0.0, ratios = 0.0;
    for (const LeftOut& l : left_out) {
        const double variance_m2 = l.noise_m2 + l.structure_m2;
        if (!(variance_m2 > 0.0)) return {};
        logarithms += std::log(variance_m2);
        ratios += l.squared_error_m2 / variance_m2;
    }
    const auto count = static_cast<double>(left_out.size());
    const double scale = ratios / count;
    if (!(scale > 0.0) || !std::isfinite(scale)) return {};
    return {logarithms / count + std::log(scale), scale};
}

/// What kriging takes the heights for.
struct HeightModel {
    Variogram variogram;
    bool with_sigmas = true;  ///< a height's own sigma counts where it is above the nugget
    /// Part of the nugget that is ground too small to be seen between points: no error of the heights.
    double small_ground_m2 = 0.0;
};

class Kriging final : public HeightInterpolator {
  public:
    Kriging(PlacedHeights points, std::size_t neighbours)
        : points_(std::move(points)), tree_(points_.points_m), neighbours_(neighbours) {
        const std::vector<VariogramClass> classes = empiricalVariogram(points_.points_m, 4 * neighbours);
        for (const VariogramClass& c : classes) pairs_ += c.pairs;
        Variogram variogram = fitVariogram(classes);
        variogram.nugget_m2 = std::max(variogram.nugget_m2, kLeastNuggetShare * variogram.sill_m2);
        if (points_.points_m.size() >= kLeastPoints) variogram = learntNugget(variogram);
        model_ = {variogram, true, smallGround_m2(variogram)};
    }

    [[nodiscard]] bool hasVariance() const override { return true; }

    void estimate(std::span<const Eigen::Vector2d> places_m,
                  std::span<HeightEstimate> estimates) const override {
        Workspace workspace;
        for (std::size_t i = 0; i < places_m.size(); ++i) {
            tree_.nearest(places_m[i], neighbours_, workspace.near);
            estimates[i] = estimateAt(workspace.near, model_, workspace);
        }
    }

    [[nodiscard]] std::optional<VarianceScale> varianceScale() const override { return scale_; }

    [[nodiscard]] std::optional<double> errorRange(const ElevationGrid& heights) const override {
        std::vector<Eigen::Vector2d> places_m;
        for (const std::size_t cell : cellsSpread(heights, kErrorPlaces)) {
            const GridGeometry& g = heights.geometry;
            places_m.emplace_back(g.centreX(cell % g.columns), g.centreY(cell / g.columns));
        }
        std::vector<Foretold> at;
        std::vector<double> reaches_m;
        Workspace w;
        for (const Eigen::Vector2d& place : places_m) {
            at.push_back(foretoldAt(place, w));
            reaches_m.push_back(std::sqrt(at.back().near.back().squared_distance_m2));
        }
        if (at.empty()) return std::nullopt;
        const double ring_m = kErrorReach * median(std::move(reaches_m)) / static_cast<double>(kErrorRings);
        double integral_m2 = 0.0;
        for (std::size_t ring = 0; ring < kErrorRings; ++ring) {
            const double distance_m = (static_cast<double>(ring) + 0.5) * ring_m;
            double shared_m2 = 0.0, all_m2 = 0.0;
            for (std::size_t i = 0; i < at.size(); ++i) {
                for (std::size_t k = 0; k < kErrorDirections; ++k) {
                    const double turns = static_cast<double>(k) / static_cast<double>(kErrorDirections) +
                                         0.618034 * static_cast<double>(i + ring);
                    const double angle = 2.0 * kPi * turns;
                    const Eigen::Vector2d place =
                        at[i].place_m + distance_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
                    const auto cell = heights.geometry.cellAt(place.x(), place.y());
                    if (!cell || std::isnan(heights.heights_m[*cell])) continue;
                    const Foretold other = foretoldAt(place, w);
                    shared_m2 += covariance_m2(at[i], other);
                    all_m2 += std::sqrt(at[i].variance_m2 * other.variance_m2);
                }
            }
            if (all_m2 > 0.0) integral_m2 += shared_m2 / all_m2 * 2.0 * kPi * distance_m * ring_m;
        }
        // A spherical correlogram has a fifth of the area of the circle of its range.
        return std::sqrt(5.0 * std::max(integral_m2, 0.0) / kPi);
    }
    [[nodiscard]] std::optional<FittedVariogram> variogram() const override {
        return FittedVariogram{model_.variogram, pairs_};
    }

    void learnVariance() {
        if (points_.points_m.size() < kLeastPoints) return;
        const std::vector<LeftOut> left_out = foretell(pointsLeftOut(kMostLeftOut), model_);
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
        Eigen::VectorXd weights;  ///< of the neighbours, and last the multiplier
        Eigen::PartialPivLU<Eigen::MatrixXd> factor;
        double noise_m2 = 0.0;      ///< part of the variance of the last estimate
        double structure_m2 = 0.0;  ///< and the rest of it
    };

    /// A place, and what its height is made of.
    struct Foretold {
        Eigen::Vector2d place_m;
        std::vector<Neighbour> near;
        Eigen::VectorXd weights;
        double variance_m2 = 0.0;
    };

    [[nodiscard]] Foretold foretoldAt(const Eigen::Vector2d& place_m, Workspace& w) const {
        tree_.nearest(place_m, neighbours_, w.near);
        const double variance_m2 = estimateAt(w.near, model_, w).variance_m2;
        return {place_m, w.near, w.weights, variance_m2};
    }

    /// Of the errors at two places: each is a difference of heights that the variogram tells, and shares the
    /// noise of the heights that both are made of.
    [[nodiscard]] double covariance_m2(const Foretold& a, const Foretold& b) const {
        const auto structure_m2 = [&](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
            return model_.variogram.structureAt((p - q).norm());
        };
        double structure = -structure_m2(a.place_m, b.place_m), noise = 0.0;
        for (std::size_t j = 0; j < b.near.size(); ++j) {
            const Eigen::Vector2d place = points_.points_m[b.near[j].point].head<2>();
            structure += b.weights[static_cast<Eigen::Index>(j)] * structure_m2(a.place_m, place);
        }
        for (std::size_t i = 0; i < a.near.size(); ++i) {
            const std::uint32_t point = a.near[i].point;
            const Eigen::Vector2d place = points_.points_m[point].head<2>();
            const double weight = a.weights[static_cast<Eigen::Index>(i)];
            double others = structure_m2(place, b.place_m);
            for (std::size_t j = 0; j < b.near.size(); ++j) {
                const double share = b.weights[static_cast<Eigen::Index>(j)];
                if (b.near[j].point == point) {
                    noise += weight * share * errorVariance_m2(point, model_);
                } else {
                    others -= share * structure_m2(place, points_.points_m[b.near[j].point].head<2>());
                }
            }
            structure += weight * others;
        }
        return scale_ ? scale_->noise * noise + scale_->structure * structure : noise + structure;
    }

    /// Cells with a height, spread evenly over the list of them.
    [[nodiscard]] static std::vector<std::size_t> cellsSpread(const ElevationGrid& heights,
                                                              std::size_t most) {
        const auto known = [&](std::size_t cell) {
            return !std::isnan(heights.heights_m[cell]);
        };
        std::size_t count = 0;
        for (std::size_t cell = 0; cell < heights.heights_m.size(); ++cell) count += known(cell) ? 1 : 0;
        std::vector<std::size_t> spread;
        const std::size_t wanted = std::min(count, most);
        std::size_t seen = 0;
        for (std::size_t cell = 0; cell < heights.heights_m.size() && spread.size() < wanted; ++cell) {
            if (!known(cell)) continue;
            // The middle of each of so many equal parts.
            if (seen++ == (2 * spread.size() + 1) * count / (2 * wanted)) spread.push_back(cell);
        }
        return spread;
    }

    /// A point, and those that it shall be foretold from, the nearest first.
    struct PointLeftOut {
        std::uint32_t point;
        std::vector<Neighbour> others;
    };

    /// Points spread evenly over the list.
    [[nodiscard]] std::vector<PointLeftOut> pointsLeftOut(std::size_t most) const {
        std::vector<PointLeftOut> left_out;
        std::vector<Neighbour> at_place;
        const std::size_t count = points_.points_m.size();
        const std::size_t step = (count + most - 1) / most;
        for (std::size_t i = 0; i < count; i += step) {
            PointLeftOut out{static_cast<std::uint32_t>(i), {}};
            tree_.nearest(points_.points_m[i].head<2>(), kAround * neighbours_, out.others);
            std::erase_if(out.others, [&](const Neighbour& n) { return n.point == out.point; });
            // A place that could lie anywhere about here: how far it is from a point, so far a point left out
            // shall be. Points along a track are next to one another, places between two passes are not.
            const Eigen::Vector2d place =
                0.5 * (points_.points_m[i] + points_.points_m[out.others.back().point]).head<2>();
            tree_.nearest(place, 1, at_place);
            const double wanted_m = std::sqrt(at_place.front().squared_distance_m2);
            const auto off_m = [&](const Neighbour& n) {
                return std::abs(std::sqrt(n.squared_distance_m2) - wanted_m);
            };
            const auto first =
                std::min_element(out.others.begin(), out.others.end(),
                                 [&](const Neighbour& a, const Neighbour& b) { return off_m(a) < off_m(b); });
            out.others.erase(out.others.begin(), first);
            if (out.others.size() > neighbours_) out.others.resize(neighbours_);
            left_out.push_back(std::move(out));
        }
        return left_out;
    }

    [[nodiscard]] std::vector<LeftOut> foretell(const std::vector<PointLeftOut>& points,
                                                const HeightModel& model) const {
        std::vector<LeftOut> left_out;
        Workspace w;
        for (const PointLeftOut& out : points) {
            const double error_m =
                estimateAt(out.others, model, w).height_m - points_.points_m[out.point].z();
            const double own_m2 = errorVariance_m2(out.point, model) - model.small_ground_m2;
            left_out.push_back({error_m * error_m, w.noise_m2 + own_m2, w.structure_m2,
                                std::sqrt(out.others.front().squared_distance_m2)});
        }
        return left_out;
    }

    /// Pairs of points tell how the ground goes on far away, but next to a point its slope hides what single
    /// heights are off by. So the nugget is the one of a row, refined once, that foretells points left out
    /// best, and the scale of nugget and sill that of their errors. Sigmas have no say: they may be wrong.
    [[nodiscard]] Variogram learntNugget(const Variogram& shape) const {
        const std::vector<PointLeftOut> points = pointsLeftOut(kMostToLearnFrom);
        std::vector<double> distances_m;
        for (const PointLeftOut& out : points) {
            distances_m.push_back(std::sqrt(out.others.front().squared_distance_m2));
        }
        const double usual_m2 = shape.structureAt(median(std::move(distances_m)));
        Variogram best = shape;
        LeftOutScore best_score;
        const auto attempt = [&](double nugget_m2) {
            HeightModel tried{shape, false, 0.0};
            tried.variogram.nugget_m2 = std::max(nugget_m2, kLeastNuggetShare * shape.sill_m2);
            const LeftOutScore score = scoreOf(foretell(points, tried));
            if (!(score.value < best_score.value)) return;
            best = tried.variogram;
            best_score = score;
        };
        attempt(0.0);
        for (int power = kLeastNuggetPower; power <= kGreatestNuggetPower; ++power) {
            attempt(usual_m2 * std::pow(4.0, power));
        }
        const double coarse_m2 = best.nugget_m2;
        for (const double factor : {0.5, 2.0}) attempt(factor * coarse_m2);
        best.nugget_m2 *= best_score.scale;
        best.sill_m2 *= best_score.scale;
        return best;
    }

    [[nodiscard]] double distance_m(std::uint32_t a, std::uint32_t b) const {
        return (points_.points_m[a] - points_.points_m[b]).head<2>().norm();
    }

    /// What a height differs from the smooth surface by: the nugget, and its own sigma where it is larger.
    [[nodiscard]] double errorVariance_m2(std::uint32_t point, const HeightModel& model) const {
        const double sigma_m = points_.sigmas_m.empty() || !model.with_sigmas ? 0.0 : points_.sigmas_m[point];
        return std::max(model.variogram.nugget_m2, sigma_m * sigma_m);
    }

    /// What of the nugget the sigmas of the heights leave over is ground that is too small to be seen.
    /// Without sigmas all of it counts as error of the heights.
    [[nodiscard]] double smallGround_m2(const Variogram& variogram) const {
        double sum_m2 = 0.0;
        for (const double sigma_m : points_.sigmas_m) sum_m2 += sigma_m * sigma_m;
        if (sum_m2 == 0.0) return 0.0;
        return std::max(0.0, variogram.nugget_m2 - sum_m2 / static_cast<double>(points_.sigmas_m.size()));
    }

    /// The smooth surface is estimated, without nugget: a height with an error is not held.
    [[nodiscard]] HeightEstimate estimateAt(const std::vector<Neighbour>& near, const HeightModel& model,
                                            Workspace& w) const {
        const auto count = static_cast<Eigen::Index>(near.size());
        w.system.setOnes(count + 1, count + 1);
        w.right.setOnes(count + 1);
        for (Eigen::Index i = 0; i < count; ++i) {
            const std::uint32_t point = near[static_cast<std::size_t>(i)].point;
            for (Eigen::Index j = 0; j < i; ++j) {
                const double structure =
                    model.variogram.structureAt(distance_m(point, near[static_cast<std::size_t>(j)].point));
                w.system(i, j) = w.system(j, i) = structure;
            }
            w.system(i, i) = -errorVariance_m2(point, model);
            w.right[i] =
                model.variogram.structureAt(std::sqrt(near[static_cast<std::size_t>(i)].squared_distance_m2));
        }
        w.system(count, count) = 0.0;
        w.factor.compute(w.system);
        w.weights = w.factor.solve(w.right);
        const Eigen::VectorXd& weights = w.weights;
        const double base = points_.points_m[near.front().point].z();
        HeightEstimate estimate{base, weights[count]};
        for (Eigen::Index i = 0; i < count; ++i) {
            const std::uint32_t point = near[static_cast<std::size_t>(i)].point;
            estimate.height_m += weights[i] * (points_.points_m[point].z() - base);
            estimate.variance_m2 += weights[i] * w.right[i];
        }
        w.noise_m2 = 0.0;
        for (Eigen::Index i = 0; i < count; ++i) {
            w.noise_m2 +=
                weights[i] * weights[i] * errorVariance_m2(near[static_cast<std::size_t>(i)].point, model);
        }
        w.structure_m2 = std::max(estimate.variance_m2 - w.noise_m2, 0.0) + model.small_ground_m2;
        estimate.variance_m2 = w.noise_m2 + w.structure_m2;
        if (scale_) estimate.variance_m2 = scale_->noise * w.noise_m2 + scale_->structure * w.structure_m2;
        return estimate;
    }

    PlacedHeights points_;
    PlanKdTree tree_;
    std::size_t neighbours_;
    std::size_t pairs_ = 0;
    HeightModel model_;
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
