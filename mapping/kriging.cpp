// Ordinary kriging of the nearest points. Matheron, G.: Principles of geostatistics. Economic Geology 58
// (1963); the form with semivariances of Cressie, N.: Statistics for Spatial Data, 1993, section 3.2.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "mapping/interpolators.hpp"
#include "mapping/plan_kd_tree.hpp"
#include "mapping/variogram.hpp"

namespace terrawalk {
namespace {

/// Variance of a single height above the smooth surface when the fitted nugget is nothing, as a share of the
/// sill: keeps the system solvable where points nearly touch.
constexpr double kLeastNuggetShare = 1e-9;

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

  private:
    struct Workspace {
        std::vector<Neighbour> near;
        Eigen::MatrixXd system;
        Eigen::VectorXd right;
        Eigen::PartialPivLU<Eigen::MatrixXd> factor;
    };

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
        estimate.variance_m2 = std::max(estimate.variance_m2, 0.0);
        return estimate;
    }

    PlacedHeights points_;
    PlanKdTree tree_;
    std::size_t neighbours_;
    Variogram variogram_;
};

}  // namespace

Result<InterpolatorPointer> makeKriging(PlacedHeights points, std::size_t neighbours, Progress& progress,
                                        const std::stop_token& stop) {
    progress.report(0.0, "fitting the variogram");
    if (stop.stop_requested()) return cancelled();
    return std::make_unique<Kriging>(std::move(points), neighbours);
}

}  // namespace terrawalk
