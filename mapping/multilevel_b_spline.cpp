// Lee, S., Wolberg, G., Shin, S. Y.: Scattered data interpolation with multilevel B-splines. IEEE
// Transactions on Visualization and Computer Graphics 3 (1997): the BA algorithm, and MBA with refinement.

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "mapping/interpolators.hpp"

namespace terrawalk {
namespace {

constexpr std::size_t kPointsBetweenChecks = 65536;
constexpr double kMostControlPoints = 1e9;

/// Uniform cubic B-splines at 0 <= t < 1. Section 3.1.
std::array<double, 4> basis(double t) {
    const double u = 1.0 - t;
    return {u * u * u / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
            (-3.0 * t * t * t + 3.0 * t * t + 3.0 * t + 1.0) / 6.0, t * t * t / 6.0};
}

/// columns x rows cells over the square domain, with (columns + 3) x (rows + 3) control heights; the first is
/// phi(-1, -1) of the paper.
struct Lattice {
    Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();
    double spacing_m = 1.0;
    std::size_t columns = 1;
    std::size_t rows = 1;
    std::vector<double> control_m;

    [[nodiscard]] std::size_t width() const { return columns + 3; }
    [[nodiscard]] std::size_t height() const { return rows + 3; }
};

struct LatticePlace {
    std::size_t first;  ///< index of the control height at the cell's lower left
    std::array<double, 4> x;
    std::array<double, 4> y;
};

/// Places outside count as on the border.
LatticePlace placeIn(const Lattice& lattice, const Eigen::Vector2d& place_m) {
    const auto within = [](double cells, std::size_t count) {
        const double clamped = std::clamp(cells, 0.0, static_cast<double>(count));
        const std::size_t cell = std::min(static_cast<std::size_t>(clamped), count - 1);
        return std::pair(cell, clamped - static_cast<double>(cell));
    };
    const auto [column, s] =
        within((place_m.x() - lattice.origin_m.x()) / lattice.spacing_m, lattice.columns);
    const auto [row, t] = within((place_m.y() - lattice.origin_m.y()) / lattice.spacing_m, lattice.rows);
    return {row * lattice.width() + column, basis(s), basis(t)};
}

double valueAt(const Lattice& lattice, const Eigen::Vector2d& place_m) {
    const LatticePlace p = placeIn(lattice, place_m);
    double value = 0.0;
    for (std::size_t l = 0; l < 4; ++l) {
        const double* const row = lattice.control_m.data() + p.first + l * lattice.width();
        value += p.y[l] * (p.x[0] * row[0] + p.x[1] * row[1] + p.x[2] * row[2] + p.x[3] * row[3]);
    }
    return value;
}

/// Control heights that approximate the residuals in least squares, each for the points about it. Eqs 3-5.
Result<void> approximate(Lattice& lattice, const std::vector<Eigen::Vector3d>& points_m,
                         const std::vector<double>& residuals_m, const std::stop_token& stop) {
    std::vector<double> weights(lattice.width() * lattice.height(), 0.0);
    lattice.control_m.assign(weights.size(), 0.0);
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        if (i % kPointsBetweenChecks == 0 && stop.stop_requested()) return cancelled();
        const LatticePlace p = placeIn(lattice, points_m[i].head<2>());
        std::array<double, 4> xx{}, yy{};
        for (std::size_t k = 0; k < 4; ++k) {
            xx[k] = p.x[k] * p.x[k];
            yy[k] = p.y[k] * p.y[k];
        }
        const double squares =
            std::accumulate(xx.begin(), xx.end(), 0.0) * std::accumulate(yy.begin(), yy.end(), 0.0);
        for (std::size_t l = 0; l < 4; ++l) {
            for (std::size_t k = 0; k < 4; ++k) {
                const double squared = xx[k] * yy[l];
                const std::size_t at = p.first + l * lattice.width() + k;
                weights[at] += squared;
                lattice.control_m[at] += squared * (p.x[k] * p.y[l] * residuals_m[i] / squares);
            }
        }
    }
    for (std::size_t at = 0; at < weights.size(); ++at) {
        lattice.control_m[at] = weights[at] > 0.0 ? lattice.control_m[at] / weights[at] : 0.0;
    }
    return {};
}

/// The same surface on a lattice of half the spacing. Section 4.2. Along one axis: a fine control height that
/// lies on a coarse one takes (1, 6, 1) / 8 of it and its neighbours, one between two takes half of each.
Lattice refined(const Lattice& coarse) {
    Lattice fine{coarse.origin_m, 0.5 * coarse.spacing_m, 2 * coarse.columns, 2 * coarse.rows, {}};
    fine.control_m.resize(fine.width() * fine.height());
    // Fine index f stands for position f - 1 in halves; 2 c - 1 lies on coarse index c.
    const auto along = [](std::size_t f, auto value) {
        const std::size_t c = (f + 1) / 2;
        return f % 2 == 1 ? (value(c - 1) + 6.0 * value(c) + value(c + 1)) / 8.0
                          : 0.5 * (value(c) + value(c + 1));
    };
    std::vector<double> stretched(fine.width() * coarse.height());
    for (std::size_t row = 0; row < coarse.height(); ++row) {
        for (std::size_t f = 0; f < fine.width(); ++f) {
            stretched[row * fine.width() + f] =
                along(f, [&](std::size_t c) { return coarse.control_m[row * coarse.width() + c]; });
        }
    }
    for (std::size_t f = 0; f < fine.height(); ++f) {
        for (std::size_t column = 0; column < fine.width(); ++column) {
            fine.control_m[f * fine.width() + column] =
                along(f, [&](std::size_t c) { return stretched[c * fine.width() + column]; });
        }
    }
    return fine;
}

/// The slope that all points have in common. Near their middle, so that map coordinates cost no digits.
struct Plane {
    Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
    [[nodiscard]] double at(const Eigen::Vector2d& place_m) const {
        return middle_m.z() + slope.dot(place_m - middle_m.head<2>());
    }
};

/// Least squares; level where the points lie on a line.
Plane planeThrough(const std::vector<Eigen::Vector3d>& points_m) {
    Plane plane;
    for (const Eigen::Vector3d& point : points_m) plane.middle_m += point - points_m.front();
    plane.middle_m = points_m.front() + plane.middle_m / static_cast<double>(points_m.size());
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const Eigen::Vector3d& point : points_m) {
        const Eigen::Vector3d off_m = point - plane.middle_m;
        normal += off_m.head<2>() * off_m.head<2>().transpose();
        right += off_m.z() * off_m.head<2>();
    }
    const double determinant = normal.determinant(), trace = normal.trace();
    if (determinant > 1e-9 * trace * trace) plane.slope = normal.inverse() * right;
    return plane;
}

class MultilevelBSpline final : public HeightInterpolator {
  public:
    MultilevelBSpline(Lattice lattice, Plane plane)
        : lattice_(std::move(lattice)), plane_(std::move(plane)) {}

    void estimate(std::span<const Eigen::Vector2d> places_m,
                  std::span<HeightEstimate> estimates) const override {
        for (std::size_t i = 0; i < places_m.size(); ++i) {
            estimates[i].height_m = plane_.at(places_m[i]) + valueAt(lattice_, places_m[i]);
        }
    }

  private:
    Lattice lattice_;
    Plane plane_;
};

struct Plan {
    Lattice coarsest;
    int levels;
};

Result<Plan> planFor(const std::vector<Eigen::Vector3d>& points_m, double spacing) {
    Eigen::Vector2d low = points_m.front().head<2>();
    Eigen::Vector2d high = low;
    for (const Eigen::Vector3d& point : points_m) {
        low = low.cwiseMin(point.head<2>());
        high = high.cwiseMax(point.head<2>());
    }
    const Eigen::Vector2d extent = high - low;
    const double longest = extent.maxCoeff();
    Plan plan{{low, longest > 0.0 ? longest : 1.0, 1, 1, {}}, 1};
    if (longest == 0.0) return plan;
    // Points on a line have no area: there the spacing is along it.
    const auto count = static_cast<double>(points_m.size());
    const double mean_spacing = std::max(std::sqrt(extent.x() * extent.y() / count), longest / count);
    plan.coarsest.spacing_m = std::max(extent.minCoeff(), longest / 16.0);
    plan.coarsest.columns =
        static_cast<std::size_t>(std::max(1.0, std::ceil(extent.x() / plan.coarsest.spacing_m)));
    plan.coarsest.rows =
        static_cast<std::size_t>(std::max(1.0, std::ceil(extent.y() / plan.coarsest.spacing_m)));
    for (double fine = plan.coarsest.spacing_m; fine > spacing * mean_spacing; fine *= 0.5) ++plan.levels;
    const double cells = std::ldexp(1.0, plan.levels - 1);
    const double controls = (cells * static_cast<double>(plan.coarsest.columns) + 3.0) *
                            (cells * static_cast<double>(plan.coarsest.rows) + 3.0);
    if (controls > kMostControlPoints) {
        return badData(fmt::format("a B-spline over these points needs {:.0f} control points", controls), {},
                       0, "choose a greater spacing of its lattice, or another method");
    }
    return plan;
}

}  // namespace

Result<InterpolatorPointer> makeBSpline(const std::vector<Eigen::Vector3d>& points_m, double spacing,
                                        Progress& progress, const std::stop_token& stop) {
    const auto plan = planFor(points_m, spacing);
    if (!plan) return tl::unexpected(plan.error());
    // What no lattice holds: counted from the plane, which is where an empty place ends up.
    const Plane plane = planeThrough(points_m);
    std::vector<double> residuals_m(points_m.size());
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        residuals_m[i] = points_m[i].z() - plane.at(points_m[i].head<2>());
    }

    Lattice level = plan->coarsest;
    Lattice sum;
    for (int k = 0; k < plan->levels; ++k) {
        progress.report(static_cast<double>(k) / plan->levels, "fitting the B-spline");
        if (auto done = approximate(level, points_m, residuals_m, stop); !done) {
            return tl::unexpected(done.error());
        }
        for (std::size_t i = 0; i < points_m.size(); ++i) {
            residuals_m[i] -= valueAt(level, points_m[i].head<2>());
        }
        if (k == 0) {
            sum = level;
        } else {
            sum = refined(sum);
            for (std::size_t at = 0; at < sum.control_m.size(); ++at)
                sum.control_m[at] += level.control_m[at];
        }
        level = Lattice{level.origin_m, 0.5 * level.spacing_m, 2 * level.columns, 2 * level.rows, {}};
    }
    return std::make_unique<MultilevelBSpline>(std::move(sum), plane);
}

}  // namespace terrawalk
