#include "mapping/surface_uncertainty.hpp"

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
constexpr double kTrackMemory_m = 8.0;
constexpr double kPointsInOneError = 10.0;  // errors of interpolation hang together over their area
constexpr double kOnePass_s = 20.0;
constexpr double kLeastDistance_m = 0.1;  // a point nearer weighs no more

constexpr Eigen::Index kTerms = 4;
using Features = Eigen::Matrix<double, kTerms, 1>;

double squared(double value) {
    return value * value;
}

Features featuresOf(double distance_m, double relief_m) {
    return {1.0, distance_m, squared(distance_m), squared(relief_m)};
}

/// Eight places in a circle, opposite ones four apart.
using Circle = std::array<Eigen::Vector2d, 8>;
using CircleHeights = std::array<double, 8>;

Circle circleAbout(const Eigen::Vector2d& middle_m, double reach_m) {
    const double x = std::sqrt(0.5);
    const Circle directions{Eigen::Vector2d(1.0, 0.0),  {x, x},   {0.0, 1.0},  {-x, x},
                            Eigen::Vector2d(-1.0, 0.0), {-x, -x}, {0.0, -1.0}, {x, -x}};
    Circle circle;
    for (std::size_t i = 0; i < circle.size(); ++i) circle[i] = middle_m + reach_m * directions[i];
    return circle;
}

struct Slope {
    double steepness = 0.0;  ///< root of its mean square
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
};

/// From one side of the circle to the other; where one is not known, from the middle.
Slope slopeAcross(const CircleHeights& heights_m, double middle_m, double reach_m) {
    const Circle directions = circleAbout(Eigen::Vector2d::Zero(), 1.0);
    double squares = 0.0;
    Slope slope;
    for (std::size_t i = 0; i < 4; ++i) {
        const double ahead = heights_m[i] - middle_m, behind = middle_m - heights_m[i + 4];
        double rise_m = 0.5 * (ahead + behind);
        if (!std::isfinite(behind)) rise_m = ahead;
        if (!std::isfinite(ahead)) rise_m = behind;
        if (!std::isfinite(rise_m)) continue;
        squares += squared(rise_m / reach_m);
        slope.gradient += 0.5 * rise_m / reach_m * directions[i];
    }
    slope.steepness = std::sqrt(0.5 * squares);  // each axis sees the slope times a cosine
    return slope;
}

double reliefOf(const CircleHeights& heights_m, double middle_m) {
    double sum = 0.0, known = 0.0;
    for (const double height_m : heights_m) {
        if (!std::isfinite(height_m)) continue;
        sum += squared(height_m - middle_m);
        known += 1.0;
    }
    return known > 0.0 ? std::sqrt(sum / known) : 0.0;
}

/// How far about a place the error in plan may have moved the ground: four places at that distance, two to a
/// side of each axis, have the variance of a normal error.
double leanReach(double plan_m, double least_m) {
    return std::max(std::sqrt(2.0) * plan_m, least_m);
}

struct TrackVariance {
    double height_m2 = 0.0;
    double plan_m2 = 0.0;
};

/// Of the sum of the track's errors at the points, each times its weight.
TrackVariance varianceOfSum(std::span<const CarryingPoint> points, std::span<const double> weights) {
    TrackVariance sum;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            const TrackSigma &a = points[i].track, &b = points[j].track;
            const double share =
                i == j ? weights[i] * weights[i]
                       : 2.0 * weights[i] * weights[j] *
                             trackCorrelation(a, b, (points[i].place_m - points[j].place_m).norm());
            sum.height_m2 += share * a.height_m * b.height_m;
            sum.plan_m2 += share * a.plan_m * b.plan_m;
        }
    }
    return {std::max(sum.height_m2, 0.0), std::max(sum.plan_m2, 0.0)};
}

/// By inverse squared distance; their sum is one.
std::vector<double> carryingWeights(std::span<const CarryingPoint> near) {
    std::vector<double> weights;
    double sum = 0.0;
    for (const CarryingPoint& point : near) {
        weights.push_back(1.0 / (point.squared_distance_m2 + squared(kLeastDistance_m)));
        sum += weights.back();
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

/// A point left out, and what its error says.
struct Foretold {
    Features features;
    double squared_error_m2;
    double distance_m;
    double tracks_m2;  ///< variance of what the tracks may differ by
};

/// Points with what the track says of each.
struct TrackedPoints {
    std::vector<Eigen::Vector3d> points_m;
    std::vector<double> sigmas_m;  ///< empty, or one for each
    std::vector<TrackSigma> track;
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

/// In curve order, so that the order given does not matter. Of points at one place the track of one.
TrackedPoints inPlace(const std::vector<Eigen::Vector3d>& points_m, const std::vector<double>& sigmas_m,
                      const std::vector<TrackSigma>& track) {
    PlacedHeights placed = placedHeights(points_m, sigmas_m);
    TrackedPoints points{std::move(placed.points_m), std::move(placed.sigmas_m), {}};
    points.track.resize(points.points_m.size());
    if (track.empty()) return points;
    const PlanKdTree tree(points_m);
    std::vector<Neighbour> here;
    for (std::size_t i = 0; i < points.points_m.size(); ++i) {
        tree.nearest(points.points_m[i].head<2>(), 1, here);
        points.track[i] = track[here.front().point];
    }
    return points;
}

CircleHeights heightsAround(const HeightInterpolator& surface, const Eigen::Vector2d& place, double reach_m) {
    std::array<HeightEstimate, 8> estimates;
    surface.estimate(circleAbout(place, reach_m), estimates);
    CircleHeights heights_m;
    std::transform(estimates.begin(), estimates.end(), heights_m.begin(),
                   [](const HeightEstimate& e) { return e.height_m; });
    return heights_m;
}

void carryingPoints(const PlanKdTree& tree, const TrackedPoints& points, const Eigen::Vector2d& place,
                    std::vector<Neighbour>& near, std::vector<CarryingPoint>& carrying) {
    tree.nearest(place, kCarryingPoints, near);
    carrying.clear();
    for (const Neighbour& n : near) {
        carrying.push_back(
            {points.points_m[n.point].head<2>(), n.squared_distance_m2, points.track[n.point]});
    }
}

Result<std::vector<Foretold>> foretell(InterpolationMethod method, const TrackedPoints& points,
                                       const InterpolationOptions& options,
                                       const std::vector<std::uint8_t>& parts, std::uint8_t part,
                                       std::size_t most, const std::stop_token& stop) {
    TrackedPoints kept;
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < points.points_m.size(); ++i) {
        if (parts[i] == part) {
            out.push_back(i);
            continue;
        }
        kept.points_m.push_back(points.points_m[i]);
        kept.track.push_back(points.track[i]);
        if (!points.sigmas_m.empty()) kept.sigmas_m.push_back(points.sigmas_m[i]);
    }
    std::vector<Foretold> foretold;
    if (kept.points_m.size() < kLeastPoints || out.empty()) return foretold;
    SilentProgress silent;
    const auto surface = fitInterpolator(method, kept.points_m, kept.sigmas_m, options, silent, stop);
    if (!surface) return tl::unexpected(surface.error());
    const PlanKdTree tree(kept.points_m);
    std::vector<Neighbour> near;
    std::vector<CarryingPoint> carrying;
    const std::size_t step = (out.size() + most - 1) / most;
    for (std::size_t i = 0; i < out.size(); i += step) {
        if (stop.stop_requested()) return cancelled();
        const Eigen::Vector3d& point = points.points_m[out[i]];
        const Eigen::Vector2d place = point.head<2>();
        HeightEstimate estimate;
        (*surface)->estimate({&place, 1}, {&estimate, 1});
        if (!std::isfinite(estimate.height_m)) continue;
        carryingPoints(tree, kept, place, near, carrying);
        const double distance_m = std::sqrt(near.front().squared_distance_m2);
        const double relief_m = reliefOf(heightsAround(**surface, place, distance_m), estimate.height_m);
        // What was foretold less what it is held against.
        std::vector<double> weights = carryingWeights(carrying);
        const double plan_m = points.track[out[i]].plan_m;
        carrying.push_back({place, 0.0, points.track[out[i]]});
        weights.push_back(-1.0);
        const TrackVariance tracks = varianceOfSum(carrying, weights);
        const double reach_m = leanReach(plan_m, kLeastDistance_m);
        const double slope =
            slopeAcross(heightsAround(**surface, place, reach_m), estimate.height_m, reach_m).steepness;
        foretold.push_back({featuresOf(distance_m, relief_m), squared(estimate.height_m - point.z()),
                            distance_m, tracks.height_m2 + squared(slope) * tracks.plan_m2});
    }
    return foretold;
}

/// The likeliest coefficients above zero, if errors are normal: steps that multiply, each of which makes them
/// likelier (Févotte, Bertin and Durrieu 2009, Itakura-Saito divergence).
Features fitModel(const std::vector<Foretold>& foretold) {
    constexpr int kSteps = 300;
    double mean = 0.0;
    Features mean_features = Features::Zero();
    for (const Foretold& f : foretold) {
        mean += f.squared_error_m2 / static_cast<double>(foretold.size());
        mean_features += f.features / static_cast<double>(foretold.size());
    }
    const double least = 1e-6 * mean + 1e-18;
    Features x = std::max(mean, 1e-12) * (kTerms * mean_features).cwiseMax(1e-12).cwiseInverse();
    for (int step = 0; step < kSteps; ++step) {
        Features seen = Features::Zero(), expected = Features::Constant(1e-300);
        for (const Foretold& f : foretold) {
            const double variance = std::max(x.dot(f.features) + f.tracks_m2, least);
            seen += f.squared_error_m2 / (variance * variance) * f.features;
            expected += f.features / variance;
        }
        x = x.cwiseProduct(seen.cwiseQuotient(expected).cwiseSqrt());
    }
    return x;
}

/// Between the four cell centres around; NaN where one of them that counts is.
double heightOfGrid(const ElevationGrid& grid, const Eigen::Vector2d& place) {
    const GridGeometry& g = grid.geometry;
    const double column = (place.x() - g.centreX(0)) / g.cell_m, row = (g.centreY(0) - place.y()) / g.cell_m;
    if (!(column >= 0.0 && row >= 0.0 && column <= static_cast<double>(g.columns - 1) &&
          row <= static_cast<double>(g.rows - 1))) {
        return std::nan("");
    }
    const auto c = static_cast<std::size_t>(column), r = static_cast<std::size_t>(row);
    const double x = column - std::floor(column), y = row - std::floor(row);
    double height_m = 0.0;
    const auto add = [&](double weight, std::size_t at_row, std::size_t at_column) {
        if (weight > 0.0) height_m += weight * static_cast<double>(grid.at(at_row, at_column));
    };
    add((1.0 - x) * (1.0 - y), r, c);
    add(x * (1.0 - y), r, c + 1);
    add((1.0 - x) * y, r + 1, c);
    add(x * y, r + 1, c + 1);
    return height_m;
}

CircleHeights heightsAround(const ElevationGrid& grid, const Eigen::Vector2d& place, double reach_m) {
    CircleHeights heights_m;
    const Circle circle = circleAbout(place, reach_m);
    std::transform(circle.begin(), circle.end(), heights_m.begin(),
                   [&](const Eigen::Vector2d& at) { return heightOfGrid(grid, at); });
    return heights_m;
}

/// Variances of cells and what makes them hang together, summed.
struct ErrorSums {
    double cells = 0.0;
    double track_m2 = 0.0;
    double lean_m2 = 0.0;
    double interpolation_m2 = 0.0;
    double steepness2 = 0.0;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();

    void add(const CellSigma& sigma) {
        cells += 1.0;
        track_m2 += squared(sigma.track_m);
        lean_m2 += squared(sigma.lean_m);
        interpolation_m2 += squared(sigma.interpolation_m);
        steepness2 += squared(sigma.slope);
        gradient += sigma.gradient;
    }
    void add(const ErrorSums& other) {
        cells += other.cells;
        track_m2 += other.track_m2;
        lean_m2 += other.lean_m2;
        interpolation_m2 += other.interpolation_m2;
        steepness2 += other.steepness2;
        gradient += other.gradient;
    }
};

/// Range of the spherical correlogram, whose integral over the plane is pi range^2 / 5, that gives the mean
/// of all heights the variance that its parts give it, each with an integral of its own.
double correlationRange(const ErrorSums& sums, double cell_area_m2, std::size_t points) {
    const double near_m2 = 2.0 * kPi * squared(kTrackMemory_m) * kOtherPassCorrelation;
    const double track_m2 =
        kEverywhereCorrelation * sums.cells * cell_area_m2 + (1.0 - kEverywhereCorrelation) * near_m2;
    const double interpolation_m2 =
        kPointsInOneError * sums.cells * cell_area_m2 / static_cast<double>(points);
    // An error in plan lifts what rises one way and lowers what falls: the mean slope alone has no opposite.
    const double one_way = sums.steepness2 > 0.0
                               ? std::min(1.0, sums.gradient.squaredNorm() / sums.cells / sums.steepness2)
                               : 0.0;
    const double total_m2 = sums.track_m2 + sums.lean_m2 + sums.interpolation_m2;
    if (!(total_m2 > 0.0)) return 0.0;
    const double integral_m2 = ((sums.track_m2 + one_way * sums.lean_m2) * track_m2 +
                                (sums.interpolation_m2 + (1.0 - one_way) * sums.lean_m2) * interpolation_m2) /
                               total_m2;
    return std::sqrt(5.0 * integral_m2 / kPi);
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

TrackSigma trackSigmaOf(const GroundPoint& point, const Trajectory& trajectory) {
    return {std::sqrt(trajectory.epochs[point.epoch].covariance(2, 2)),
            std::sqrt(0.5 * (squared(point.sigma_e_m) + squared(point.sigma_n_m))), point.run, point.time_s};
}

double trackCorrelation(const TrackSigma& a, const TrackSigma& b, double apart_m) {
    const bool one_pass = a.run == b.run && std::abs(a.time_s - b.time_s) < kOnePass_s;
    const double near = (one_pass ? 1.0 : kOtherPassCorrelation) * std::exp(-apart_m / kTrackMemory_m);
    return kEverywhereCorrelation + (1.0 - kEverywhereCorrelation) * near;
}

double InterpolationErrorModel::variance_m2(double distance_m, double relief_m) const {
    const Features f = featuresOf(distance_m, relief_m);
    double variance = kSurfaceShare * coefficients[0];
    for (Eigen::Index k = 1; k < kTerms; ++k) variance += coefficients[static_cast<std::size_t>(k)] * f[k];
    return variance;
}

Result<InterpolationErrorModel> learnInterpolationError(
    InterpolationMethod method, const std::vector<Eigen::Vector3d>& points_m,
    const std::vector<double>& sigmas_m, const std::vector<TrackSigma>& track,
    const InterpolationOptions& options, std::uint64_t seed, Progress& progress, std::stop_token stop) {
    if (points_m.size() < kLeastPoints) {
        return badData("too few points to learn how far interpolation is off", {}, 0,
                       "walk farther, or keep more points");
    }
    if (!track.empty() && track.size() != points_m.size()) {
        return usageError("each point of a surface needs one sigma of the track", "");
    }
    const TrackedPoints points = inPlace(points_m, sigmas_m, track);
    const double spacing_m = meanSpacing(points.points_m);
    const std::size_t jobs = kBlockSpacings.size() * kParts;
    std::vector<std::vector<std::uint8_t>> parts;
    for (const double spacings : kBlockSpacings) {
        parts.push_back(partsOf(points.points_m, spacings * spacing_m, seed));
    }
    std::vector<Result<std::vector<Foretold>>> found(jobs, std::vector<Foretold>{});
    std::atomic<std::size_t> done{0};
    parallelFor(jobs, [&](std::size_t job) {
        if (stop.stop_requested()) {
            found[job] = cancelled();
            return;
        }
        found[job] = foretell(method, points, options, parts[job / kParts],
                              static_cast<std::uint8_t>(job % kParts), kMostForetold / kParts, stop);
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
        model.left_out.add(std::sqrt(f.squared_error_m2), std::sqrt(x.dot(f.features) + f.tracks_m2));
    }
    return model;
}

double CellSigma::total_m() const {
    return std::sqrt(track_m * track_m + lean_m * lean_m + interpolation_m * interpolation_m);
}

CellSigma cellSigma(const ElevationGrid& heights, std::size_t row, std::size_t column,
                    std::span<const CarryingPoint> near, const InterpolationErrorModel& model) {
    const Eigen::Vector2d centre(heights.geometry.centreX(column), heights.geometry.centreY(row));
    const double height_m = heights.at(row, column);
    const TrackVariance track = varianceOfSum(near, carryingWeights(near));
    CellSigma sigma;
    sigma.distance_m = std::sqrt(near.front().squared_distance_m2);
    const double reach_m = leanReach(std::sqrt(track.plan_m2), heights.geometry.cell_m);
    const Slope slope = slopeAcross(heightsAround(heights, centre, reach_m), height_m, reach_m);
    sigma.slope = slope.steepness;
    sigma.gradient = slope.gradient;
    sigma.track_m = std::sqrt(track.height_m2);
    sigma.lean_m = sigma.slope * std::sqrt(track.plan_m2);
    const double relief_m = reliefOf(heightsAround(heights, centre, sigma.distance_m), height_m);
    sigma.interpolation_m = std::sqrt(model.variance_m2(sigma.distance_m, relief_m));
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
        const TrackedPoints points{points_m, {}, track};
        std::vector<ErrorSums> row_sums(g.rows);
        std::atomic<std::size_t> rows_done{0};
        parallelFor(g.rows, [&](std::size_t row) {
            if (stop.stop_requested()) return;
            std::vector<Neighbour> near;
            std::vector<CarryingPoint> carrying;
            for (std::size_t column = 0; column < g.columns; ++column) {
                const std::size_t cell = row * g.columns + column;
                if (std::isnan(heights.heights_m[cell])) continue;
                carryingPoints(tree, points, {g.centreX(column), g.centreY(row)}, near, carrying);
                CellSigma sigma = cellSigma(heights, row, column, carrying, model);
                if (!variances_m2.empty()) {
                    sigma.interpolation_m = std::sqrt(static_cast<double>(variances_m2[cell]));
                }
                result.sigmas_m[cell] = static_cast<float>(sigma.total_m());
                row_sums[row].add(sigma);
                const bool tested = sigma.distance_m <= model.greatest_distance_m;
                result.sources[cell] = static_cast<std::uint8_t>(
                    counts[cell] > 0 ? CellSource::Measured
                                     : (tested ? CellSource::Interpolated : CellSource::Extrapolated));
            }
            progress.report(static_cast<double>(++rows_done) / static_cast<double>(g.rows),
                            "propagating uncertainty");
        });
        ErrorSums sums;
        for (const ErrorSums& row : row_sums) sums.add(row);
        result.correlation_range_m = correlationRange(sums, squared(g.cell_m), points_m.size());
    } catch (const std::bad_alloc&) {
        return systemError("not enough memory for the uncertainty of the grid", {});
    }
    if (stop.stop_requested()) return cancelled();
    return result;
}

}  // namespace terrawalk
