#include "mapping/surface_uncertainty.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <random>

#include "mapping/plan_kd_tree.hpp"
#include "mapping/point_order.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {

namespace {

constexpr std::size_t kLeastPoints = 30;
constexpr std::size_t kMostForetold = 20'000;
constexpr std::size_t kParts = 10;
constexpr std::array<double, 3> kBlockSpacings{0.0, 2.0, 5.0};  // 0: points drawn by lot
// Of the noise in a point foretold and held against one more: three points at the corners of a triangle, with
// weights all over it, have half the variance of one on average.
constexpr double kSurfaceShare = 0.5 / 1.5;
constexpr double kDensitySide_m = 2.0;

constexpr Eigen::Index kTerms = 5;
using Features = Eigen::Matrix<double, kTerms, 1>;
using Normal = Eigen::Matrix<double, kTerms, kTerms>;

Features featuresOf(double distance_m, double slope) {
    const double s2 = slope * slope;
    const double d2 = distance_m * distance_m;
    return {1.0, distance_m, d2, s2 * distance_m, s2 * d2};
}

struct Foretold {
    Features features;
    double squared_error_m2;
    double distance_m;
};

double meanSpacing(const std::vector<Eigen::Vector3d>& points_m) {
    Eigen::Vector2d low = points_m.front().head<2>(), high = low;
    for (const Eigen::Vector3d& p : points_m) {
        low = low.cwiseMin(p.head<2>());
        high = high.cwiseMax(p.head<2>());
    }
    return std::sqrt(std::max((high - low).prod(), 1e-12) / static_cast<double>(points_m.size()));
}

// Part of each point; blocks are squares that go to a part as a whole.
std::vector<std::uint8_t> partsOf(const std::vector<Eigen::Vector3d>& points_m, double block_m,
                                  std::uint64_t seed) {
    const auto mixed = [](std::uint64_t bits) {
        std::mt19937_64 engine(bits);
        return engine();
    };
    std::vector<std::uint8_t> parts(points_m.size());
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        std::uint64_t key = i;
        if (block_m > 0.0) {
            const auto cell = [&](double x) {
                return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / block_m)));
            };
            key = cell(points_m[i].x()) * 0x9e3779b97f4a7c15ULL + cell(points_m[i].y());
        }
        parts[i] = static_cast<std::uint8_t>(mixed(key ^ (seed * 0xbf58476d1ce4e5b9ULL)) % kParts);
    }
    return parts;
}

// Slope of a surface about a place, from heights on either side.
double slopeAt(const HeightInterpolator& surface, const Eigen::Vector2d& place, double height_m,
               double reach_m) {
    const std::array<Eigen::Vector2d, 4> sides{
        place + Eigen::Vector2d(reach_m, 0.0), place - Eigen::Vector2d(reach_m, 0.0),
        place + Eigen::Vector2d(0.0, reach_m), place - Eigen::Vector2d(0.0, reach_m)};
    std::array<HeightEstimate, 4> h;
    surface.estimate(sides, h);
    const auto along = [&](double plus, double minus) {
        if (std::isfinite(plus) && std::isfinite(minus)) return (plus - minus) / (2.0 * reach_m);
        if (std::isfinite(plus)) return (plus - height_m) / reach_m;
        return std::isfinite(minus) ? (height_m - minus) / reach_m : 0.0;
    };
    return std::hypot(along(h[0].height_m, h[1].height_m), along(h[2].height_m, h[3].height_m));
}

Result<std::vector<Foretold>> foretell(InterpolationMethod method,
                                       const std::vector<Eigen::Vector3d>& points_m,
                                       const std::vector<double>& sigmas_m,
                                       const InterpolationOptions& options,
                                       const std::vector<std::uint8_t>& parts, std::uint8_t part,
                                       double spacing_m, std::size_t most, const std::stop_token& stop) {
    std::vector<Eigen::Vector3d> kept, out;
    std::vector<double> kept_sigmas;
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        if (parts[i] == part) {
            out.push_back(points_m[i]);
            continue;
        }
        kept.push_back(points_m[i]);
        if (!sigmas_m.empty()) kept_sigmas.push_back(sigmas_m[i]);
    }
    std::vector<Foretold> foretold;
    if (kept.size() < kLeastPoints || out.empty()) return foretold;
    SilentProgress silent;
    const auto surface = fitInterpolator(method, kept, kept_sigmas, options, silent, stop);
    if (!surface) return tl::unexpected(surface.error());
    const PlanKdTree tree(kept);
    std::vector<Neighbour> near;
    const std::size_t step = (out.size() + most - 1) / most;
    for (std::size_t i = 0; i < out.size(); i += step) {
        if (stop.stop_requested()) return cancelled();
        const Eigen::Vector2d place = out[i].head<2>();
        HeightEstimate estimate;
        (*surface)->estimate({&place, 1}, {&estimate, 1});
        if (!std::isfinite(estimate.height_m)) continue;
        tree.nearest(place, 1, near);
        const double distance_m = std::sqrt(near.front().squared_distance_m2);
        const double slope = slopeAt(**surface, place, estimate.height_m, 0.5 * spacing_m);
        const double error_m = estimate.height_m - out[i].z();
        foretold.push_back({featuresOf(distance_m, slope), error_m * error_m, distance_m});
    }
    return foretold;
}

// Least squares with weights, coefficients not below zero: of the ways to set some of them to zero,
// the one that fits best.
Features nonNegativeFit(const Normal& normal, const Features& right) {
    Features best = Features::Zero();
    double least = 0.0;  // of  x' N x - 2 x' r
    for (unsigned chosen = 1; chosen < 1U << kTerms; ++chosen) {
        std::vector<Eigen::Index> free;
        for (Eigen::Index k = 0; k < kTerms; ++k) {
            if ((chosen >> k) & 1U) free.push_back(k);
        }
        const Eigen::MatrixXd n = normal(free, free);
        const Eigen::VectorXd r = right(free);
        const Eigen::LDLT<Eigen::MatrixXd> factor(n);
        if (factor.info() != Eigen::Success) continue;
        const Eigen::VectorXd x = factor.solve(r);
        if (!x.allFinite() || (x.array() < 0.0).any()) continue;
        const double value = x.dot(n * x) - 2.0 * x.dot(r);
        if (value >= least) continue;
        least = value;
        best.setZero();
        for (std::size_t k = 0; k < free.size(); ++k) best[free[k]] = x[static_cast<Eigen::Index>(k)];
    }
    return best;
}

// A squared normal error has twice the square of its mean as variance, so each counts by its own mean.
Features fitModel(const std::vector<Foretold>& foretold) {
    double mean = 0.0;
    for (const Foretold& f : foretold) mean += f.squared_error_m2 / static_cast<double>(foretold.size());
    Features x = std::max(mean, 1e-12) * Features::Unit(0);
    for (int round = 0; round < 8; ++round) {
        Normal normal = Normal::Zero();
        Features right = Features::Zero();
        for (const Foretold& f : foretold) {
            const double expected = std::max(x.dot(f.features), 1e-3 * mean + 1e-12);
            const double weight = 1.0 / (expected * expected);
            normal += weight * f.features * f.features.transpose();
            right += weight * f.squared_error_m2 * f.features;
        }
        x = nonNegativeFit(normal, right);
    }
    return x;
}

double slopeOfGrid(const ElevationGrid& grid, std::size_t row, std::size_t column) {
    const double here = grid.at(row, column);
    const auto height = [&](std::size_t r, std::size_t c) {
        return r < grid.geometry.rows && c < grid.geometry.columns ? static_cast<double>(grid.at(r, c))
                                                                   : std::nan("");
    };
    const auto along = [&](double plus, double minus) {
        const double cell = grid.geometry.cell_m;
        if (!std::isnan(plus) && !std::isnan(minus)) return (plus - minus) / (2.0 * cell);
        if (!std::isnan(plus)) return (plus - here) / cell;
        return !std::isnan(minus) ? (here - minus) / cell : 0.0;
    };
    // Below zero wraps to what no grid has.
    return std::hypot(along(height(row, column + 1), height(row, column - 1)),
                      along(height(row - 1, column), height(row + 1, column)));
}

// Points of each cell.
std::vector<std::uint32_t> countPoints(const GridGeometry& g, const std::vector<Eigen::Vector3d>& points_m) {
    std::vector<std::uint32_t> counts(g.size(), 0);
    for (const Eigen::Vector3d& p : points_m) {
        if (const auto cell = g.cellAt(p.x(), p.y())) ++counts[*cell];
    }
    return counts;
}

// Sums over windows of 2 k + 1 cells by running sums along rows, then along columns.
std::vector<float> densityOf(const GridGeometry& g, const std::vector<std::uint32_t>& counts) {
    const auto k =
        static_cast<std::ptrdiff_t>(std::max(0.0, std::round(0.5 * (kDensitySide_m / g.cell_m - 1.0))));
    const auto running = [&](const auto& in, auto& out, std::size_t first, std::size_t step, std::size_t n) {
        double sum = 0.0;
        const auto at = [&](std::ptrdiff_t i) {
            return first + static_cast<std::size_t>(i) * step;
        };
        const auto size = static_cast<std::ptrdiff_t>(n);
        for (std::ptrdiff_t i = 0; i < std::min(k, size); ++i) sum += static_cast<double>(in[at(i)]);
        for (std::ptrdiff_t i = 0; i < size; ++i) {
            if (i + k < size) sum += static_cast<double>(in[at(i + k)]);
            if (i - k - 1 >= 0) sum -= static_cast<double>(in[at(i - k - 1)]);
            out[at(i)] = static_cast<float>(sum);
        }
    };
    std::vector<float> rows(g.size()), density(g.size());
    for (std::size_t r = 0; r < g.rows; ++r) running(counts, rows, r * g.columns, 1, g.columns);
    for (std::size_t c = 0; c < g.columns; ++c) running(rows, density, c, g.columns, g.rows);
    const double side_m = static_cast<double>(2 * k + 1) * g.cell_m;
    for (float& d : density) d = static_cast<float>(d / (side_m * side_m));
    return density;
}

}  // namespace

double InterpolationErrorModel::variance_m2(double distance_m, double slope) const {
    const Features f = featuresOf(distance_m, slope);
    double variance = kSurfaceShare * coefficients[0];
    for (Eigen::Index k = 1; k < kTerms; ++k) variance += coefficients[static_cast<std::size_t>(k)] * f[k];
    return variance;
}

Result<InterpolationErrorModel> learnInterpolationError(InterpolationMethod method,
                                                        const std::vector<Eigen::Vector3d>& points_m,
                                                        const std::vector<double>& sigmas_m,
                                                        const InterpolationOptions& options,
                                                        std::uint64_t seed, Progress& progress,
                                                        std::stop_token stop) {
    if (points_m.size() < kLeastPoints) {
        return badData("too few points to learn how far interpolation is off", {}, 0,
                       "walk farther, or keep more points");
    }
    // Parts go by the place, so that the order given does not matter.
    const PlacedHeights placed = placedHeights(points_m, sigmas_m);
    const std::vector<Eigen::Vector3d>& points = placed.points_m;
    const double spacing_m = meanSpacing(points);
    const std::size_t jobs = kBlockSpacings.size() * kParts;
    std::vector<std::vector<std::uint8_t>> parts;
    for (const double spacings : kBlockSpacings) parts.push_back(partsOf(points, spacings * spacing_m, seed));
    std::vector<Result<std::vector<Foretold>>> found(jobs, std::vector<Foretold>{});
    std::atomic<std::size_t> done{0};
    parallelFor(jobs, [&](std::size_t job) {
        if (stop.stop_requested()) {
            found[job] = cancelled();
            return;
        }
        found[job] =
            foretell(method, points, placed.sigmas_m, options, parts[job / kParts],
                     static_cast<std::uint8_t>(job % kParts), spacing_m, kMostForetold / kParts, stop);
        progress.report(static_cast<double>(++done) / static_cast<double>(jobs),
                        "learning interpolation errors");
    });
    std::vector<Foretold> foretold;
    for (const auto& part : found) {
        if (!part) return tl::unexpected(part.error());
        foretold.insert(foretold.end(), part->begin(), part->end());
    }
    if (foretold.size() < kLeastPoints) {
        return badData("too few points lie between others to learn how far interpolation is off", {}, 0,
                       "walk farther, or keep more points");
    }
    const Features x = fitModel(foretold);
    InterpolationErrorModel model;
    std::copy(x.begin(), x.end(), model.coefficients.begin());
    for (const Foretold& f : foretold) {
        model.greatest_distance_m = std::max(model.greatest_distance_m, f.distance_m);
        model.left_out.add(std::sqrt(f.squared_error_m2), std::sqrt(x.dot(f.features)));
    }
    return model;
}

double CellSigma::total_m() const {
    return std::sqrt(track_m * track_m + lean_m * lean_m + interpolation_m * interpolation_m);
}

CellSigma cellSigma(const ElevationGrid& heights, std::size_t row, std::size_t column,
                    std::span<const CarryingPoint> near, const InterpolationErrorModel& model) {
    const double cell_m = heights.geometry.cell_m;
    double weights = 0.0, height_m = 0.0, plan_m = 0.0;
    for (const CarryingPoint& point : near) {
        const double weight = 1.0 / (point.squared_distance_m2 + 0.25 * cell_m * cell_m);
        weights += weight;
        height_m += weight * point.track.height_m;
        plan_m += weight * point.track.plan_m;
    }
    CellSigma sigma;
    sigma.distance_m = std::sqrt(near.front().squared_distance_m2);
    sigma.slope = slopeOfGrid(heights, row, column);
    sigma.track_m = height_m / weights;
    sigma.lean_m = sigma.slope * plan_m / weights;
    sigma.interpolation_m = std::sqrt(model.variance_m2(sigma.distance_m, sigma.slope));
    return sigma;
}

Result<SurfaceUncertainty> surfaceUncertainty(const ElevationGrid& heights,
                                              const std::vector<Eigen::Vector3d>& points_m,
                                              const std::vector<TrackSigma>& track,
                                              const InterpolationError& interpolation, Progress& progress,
                                              std::stop_token stop) {
    if (track.size() != points_m.size() || points_m.empty()) {
        return usageError("each point of a surface needs one sigma of the track", "");
    }
    const GridGeometry& g = heights.geometry;
    const InterpolationErrorModel& model = interpolation.model;
    const std::vector<float>& variances_m2 = interpolation.variances_m2;
    if (!variances_m2.empty() && variances_m2.size() != g.size()) {
        return usageError("each cell needs one variance of interpolation", "");
    }
    SurfaceUncertainty result;
    try {
        const std::vector<std::uint32_t> counts = countPoints(g, points_m);
        result.density_per_m2 = densityOf(g, counts);
        result.sigmas_m.assign(g.size(), kNoHeight);
        result.sources.assign(g.size(), static_cast<std::uint8_t>(CellSource::None));
        const PlanKdTree tree(points_m);
        std::atomic<std::size_t> rows_done{0};
        parallelFor(g.rows, [&](std::size_t row) {
            if (stop.stop_requested()) return;
            std::vector<Neighbour> near;
            std::vector<CarryingPoint> carrying;
            for (std::size_t column = 0; column < g.columns; ++column) {
                const std::size_t cell = row * g.columns + column;
                if (std::isnan(heights.heights_m[cell])) continue;
                tree.nearest({g.centreX(column), g.centreY(row)}, kCarryingPoints, near);
                carrying.clear();
                for (const Neighbour& n : near) carrying.push_back({n.squared_distance_m2, track[n.point]});
                CellSigma sigma = cellSigma(heights, row, column, carrying, model);
                if (!variances_m2.empty()) {
                    sigma.interpolation_m = std::sqrt(static_cast<double>(variances_m2[cell]));
                }
                result.sigmas_m[cell] = static_cast<float>(sigma.total_m());
                const bool tested = sigma.distance_m <= model.greatest_distance_m;
                result.sources[cell] = static_cast<std::uint8_t>(
                    counts[cell] > 0 ? CellSource::Measured
                                     : (tested ? CellSource::Interpolated : CellSource::Extrapolated));
            }
            progress.report(static_cast<double>(++rows_done) / static_cast<double>(g.rows),
                            "propagating uncertainty");
        });
    } catch (const std::bad_alloc&) {
        return systemError("not enough memory for the uncertainty of the grid", {});
    }
    if (stop.stop_requested()) return cancelled();
    return result;
}

}  // namespace terrawalk
