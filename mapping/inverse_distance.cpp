// Shepard, D.: A two-dimensional interpolation function for irregularly-spaced data. ACM National Conference,
// 1968; here over the nearest points only.

#include <cmath>
#include <utility>

#include "mapping/interpolators.hpp"
#include "mapping/plan_kd_tree.hpp"

namespace terrawalk {
namespace {

class InverseDistance final : public HeightInterpolator {
  public:
    InverseDistance(std::vector<Eigen::Vector3d> points_m, std::size_t neighbours, double power)
        : points_m_(std::move(points_m)), tree_(points_m_), neighbours_(neighbours), power_(power) {}

    void estimate(std::span<const Eigen::Vector2d> places_m,
                  std::span<HeightEstimate> estimates) const override {
        std::vector<Neighbour> near;
        for (std::size_t i = 0; i < places_m.size(); ++i) {
            tree_.nearest(places_m[i], neighbours_, near);
            estimates[i].height_m = mean(near);
        }
    }

  private:
    /// Distances count as shares of the nearest, so that no power of them overflows.
    [[nodiscard]] double mean(const std::vector<Neighbour>& near) const {
        const double base = points_m_[near.front().point].z();
        const double least = near.front().squared_distance_m2;
        if (least == 0.0) return base;
        double weights = 0.0;
        double above = 0.0;
        for (const Neighbour& neighbour : near) {
            const double share = least / neighbour.squared_distance_m2;
            const double weight = power_ == 2.0 ? share : std::pow(share, 0.5 * power_);
            weights += weight;
            above += weight * (points_m_[neighbour.point].z() - base);
        }
        return base + above / weights;
    }

    std::vector<Eigen::Vector3d> points_m_;
    PlanKdTree tree_;
    std::size_t neighbours_;
    double power_;
};

}  // namespace

InterpolatorPointer makeInverseDistance(std::vector<Eigen::Vector3d> points_m, std::size_t neighbours,
                                        double power) {
    return std::make_unique<InverseDistance>(std::move(points_m), neighbours, power);
}

InterpolatorPointer makeNearest(std::vector<Eigen::Vector3d> points_m) {
    return std::make_unique<InverseDistance>(std::move(points_m), 1, 2.0);
}

}  // namespace terrawalk
