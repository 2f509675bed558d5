#include "mapping/surface_uncertainty.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace terrawalk {
namespace {

double rolling(double x, double y) {
    return 0.8 * std::sin(0.35 * x) * std::cos(0.3 * y) + 0.05 * x;
}

// Normal numbers by Box and Muller, the same on every machine.
double normal(std::mt19937_64& engine) {
    const auto uniform = [&] {
        return (static_cast<double>(engine() >> 11U) + 0.5) * 0x1.0p-53;
    };
    return std::sqrt(-2.0 * std::log(uniform())) * std::cos(6.283185307179586 * uniform());
}

std::vector<Eigen::Vector3d> scattered(std::size_t n, double noise_m, std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = 60.0 * static_cast<double>(engine() >> 11U) * 0x1.0p-53;
        const double y = 60.0 * static_cast<double>(engine() >> 11U) * 0x1.0p-53;
        points.emplace_back(x, y, rolling(x, y) + noise_m * normal(engine));
    }
    return points;
}

InterpolationErrorModel learnt(const std::vector<Eigen::Vector3d>& points) {
    SilentProgress silent;
    const auto model =
        learnInterpolationError(InterpolationMethod::Linear, points, {}, {}, {}, 1, silent, {});
    EXPECT_TRUE(model) << model.error().text();
    return *model;
}

ElevationGrid gridOf(const std::vector<Eigen::Vector3d>& points, double cell_m) {
    SilentProgress silent;
    const auto surface = fitInterpolator(InterpolationMethod::Linear, points, {}, {}, silent, {}).value();
    const auto side = static_cast<std::size_t>(std::lround(60.0 / cell_m));
    return interpolateGrid(*surface, {0.0, 60.0, cell_m, side, side}, {}, silent, {}).value().heights;
}

/// Root mean square height difference to the places all around.
double onSlope(double distance_m, double slope) {
    return distance_m * slope / std::sqrt(2.0);
}

TEST(InterpolationError, KnowsTheNoiseOfPointsOnAPlane) {
    std::mt19937_64 engine(5);
    std::vector<Eigen::Vector3d> points = scattered(4000, 0.0, 3);
    for (Eigen::Vector3d& p : points) p.z() = 0.1 * p.x() + 0.05 * normal(engine);
    const InterpolationErrorModel model = learnt(points);
    // Foretold from three points or so, whose noise is averaged, and held against one more: between one and
    // two variances. Nothing grows with distance on a plane.
    EXPECT_GT(model.coefficients[0], 0.0025);
    EXPECT_LT(model.coefficients[0], 0.0055);
    EXPECT_LT(model.variance_m2(3.0, onSlope(3.0, 0.1)), 2.0 * model.variance_m2(0.0, 0.0));
}

TEST(InterpolationError, GrowsWithDistanceOnRollingGround) {
    const InterpolationErrorModel model = learnt(scattered(3000, 0.0, 4));
    EXPECT_GT(model.variance_m2(4.0, onSlope(4.0, 0.2)), 4.0 * model.variance_m2(0.5, onSlope(0.5, 0.2)));
    EXPECT_GT(model.greatest_distance_m, 4.0);
    // Its own teachers, which are not normal but near.
    const double within = static_cast<double>(model.left_out.within) / static_cast<double>(model.left_out.n);
    EXPECT_GT(within, 0.9);
    EXPECT_LT(within, 0.99);
}

TEST(InterpolationError, IsTheSameForAnyOrderAndNumberOfThreads) {
    std::vector<Eigen::Vector3d> points = scattered(1500, 0.02, 6);
    const InterpolationErrorModel a = learnt(points);
    std::reverse(points.begin(), points.end());
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const InterpolationErrorModel b = learnt(points);
    EXPECT_EQ(a.coefficients, b.coefficients);
    EXPECT_EQ(a.left_out.within, b.left_out.within);
}

TEST(InterpolationError, NeedsPoints) {
    SilentProgress silent;
    const auto few = learnInterpolationError(InterpolationMethod::Linear, scattered(20, 0.0, 1), {}, {}, {},
                                             1, silent, {});
    ASSERT_FALSE(few);
    EXPECT_EQ(few.error().kind, ErrorKind::BadData);
    std::stop_source stop;
    stop.request_stop();
    const auto stopped = learnInterpolationError(InterpolationMethod::Linear, scattered(2000, 0.0, 1), {}, {},
                                                 {}, 1, silent, stop.get_token());
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::Cancelled);
}

// Seeds of the surface that the model did not see decide: the truth is known in each cell.
TEST(SurfaceUncertainty, BandsHoldTheTruthOnGroundThatIsKnown) {
    for (const std::uint64_t seed : {11U, 12U, 13U}) {
        const std::vector<Eigen::Vector3d> points = scattered(2500, 0.05, seed);
        const ElevationGrid dem = gridOf(points, 0.5);
        SilentProgress silent;
        const auto u = surfaceUncertainty(dem, points, std::vector<TrackSigma>(points.size()),
                                          {learnt(points), {}}, silent, {});
        ASSERT_TRUE(u);
        SigmaCoverage coverage;
        for (std::size_t r = 0; r < dem.geometry.rows; ++r) {
            for (std::size_t c = 0; c < dem.geometry.columns; ++c) {
                const std::size_t i = r * dem.geometry.columns + c;
                if (std::isnan(dem.heights_m[i])) continue;
                const double error =
                    dem.heights_m[i] - rolling(dem.geometry.centreX(c), dem.geometry.centreY(r));
                coverage.add(error, u->sigmas_m[i]);
            }
        }
        // Smooth ground: errors grow slower near the points than the model can say, so it is a little wide.
        EXPECT_GT(static_cast<double>(coverage.within), 0.90 * static_cast<double>(coverage.n)) << seed;
        EXPECT_GT(coverage.mean_square, 0.3) << seed;
        EXPECT_LT(coverage.mean_square, 1.5) << seed;
    }
}

// Risers of a metre every eight metres, at a slope of one; treads lean and are a little rough.
double terraced(double x, double y) {
    const double along = x + 1.5 * std::sin(0.1 * y);
    const double step = std::floor(along / 8.0), in_step = along - 8.0 * step;
    return step + std::clamp(in_step - 7.0, 0.0, 1.0) + 0.03 * y +
           0.05 * std::sin(1.1 * x) * std::cos(0.9 * y);
}

// Passes side by side: next to one another along them, far apart across.
std::vector<Eigen::Vector3d> alongPasses(double apart_m, std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::vector<Eigen::Vector3d> points;
    for (double y = 0.0; y < 60.0; y += apart_m) {
        for (double x = 0.0; x < 60.0; x += 0.25) {
            points.emplace_back(x, y + 0.3 * std::sin(0.3 * x + y) + 0.02 * normal(engine), 0.0);
        }
    }
    return points;
}

using Ground = double (*)(double, double);

/// Share of the true heights at places drawn by lot within 1.96 sigma of what kriging says.
double shareHeld(std::vector<Eigen::Vector3d> points, Ground truth, double told_m, std::uint64_t seed) {
    constexpr double kNoise_m = 0.05;
    constexpr std::size_t kPlaces = 4000;
    std::mt19937_64 engine(seed + 100);
    for (Eigen::Vector3d& p : points) p.z() = truth(p.x(), p.y()) + kNoise_m * normal(engine);
    InterpolationOptions options;
    options.learn_variance = true;
    SilentProgress silent;
    const auto surface = fitInterpolator(InterpolationMethod::Kriging, points,
                                         std::vector<double>(points.size(), told_m), options, silent, {});
    EXPECT_TRUE(surface && (*surface)->varianceScale());
    EXPECT_NEAR((*surface)->varianceScale()->left_out.mean_square, 1.0, 1e-6);
    std::size_t held = 0;
    for (const Eigen::Vector3d& check : scattered(kPlaces, 0.0, seed + 1000)) {
        const Eigen::Vector2d place = 0.9 * check.head<2>() + Eigen::Vector2d(3.0, 3.0);  // inside the hull
        HeightEstimate estimate;
        (*surface)->estimate({&place, 1}, {&estimate, 1});
        const double off_m = std::abs(estimate.height_m - truth(place.x(), place.y()));
        held += off_m <= 1.96 * std::sqrt(estimate.variance_m2) ? 1 : 0;
    }
    return static_cast<double>(held) / static_cast<double>(kPlaces);
}

TEST(SurfaceUncertainty, KrigingsOwnBandsAreNeitherNarrowNorWide) {
    for (const std::uint64_t seed : {31U, 32U}) {
        for (const Ground truth : {rolling, terraced}) {
            // Sigmas that are right, none, and a range finder that is twice as good as its maker says.
            for (const double told_m : {0.05, 0.0, 0.1}) {
                const double held = shareHeld(scattered(3000, 0.0, seed), truth, told_m, seed);
                EXPECT_GT(held, 0.90) << seed << " " << told_m;
                EXPECT_LT(held, 0.985) << seed << " " << told_m;
            }
        }
        const double held = shareHeld(alongPasses(2.0, seed), rolling, 0.05, seed);
        EXPECT_GT(held, 0.90) << seed << " passes";
        EXPECT_LT(held, 0.985) << seed << " passes";
    }
}

TEST(SurfaceUncertainty, TakesTheMethodsOwnVarianceWhereItHasOne) {
    std::vector<Eigen::Vector3d> points = scattered(500, 0.0, 22);
    for (Eigen::Vector3d& p : points) p.z() = 1.0;
    const ElevationGrid dem = gridOf(points, 1.0);
    const InterpolationError own{InterpolationErrorModel{}, std::vector<float>(dem.heights_m.size(), 0.04F)};
    SilentProgress silent;
    const std::vector<TrackSigma> track(points.size(), {0.15, 0.8});
    const auto u = surfaceUncertainty(dem, points, track, own, silent, {});
    ASSERT_TRUE(u);
    // The points that carry a cell share all but a little of the track's error.
    EXPECT_NEAR(u->sigmas_m[dem.geometry.cellAt(30.0, 30.0).value()], std::hypot(0.15, 0.2), 0.01);
    const InterpolationError short_one{InterpolationErrorModel{}, {0.04F}};
    EXPECT_EQ(surfaceUncertainty(dem, points, track, short_one, silent, {}).error().kind, ErrorKind::Usage);
}

// Tracks that differ as trackCorrelation() says: what they do to heights is theirs, and no error of the way
// between the points.
TEST(InterpolationError, TakesWhatTracksDifferByForTheirs) {
    constexpr double kTrack_m = 0.15, kNoise_m = 0.03;
    std::vector<Eigen::Vector3d> points;
    std::vector<TrackSigma> track;
    std::mt19937_64 engine(9);
    for (std::uint32_t pass = 0; pass < 20; ++pass) {
        // An error that forgets itself along the pass, as the correlation has it; passes are of runs apart.
        double error_m = kTrack_m * normal(engine);
        const double kept = std::exp(-0.5 / 8.0);
        for (int i = 0; i < 120; ++i) {
            error_m = kept * error_m + std::sqrt(1.0 - kept * kept) * kTrack_m * normal(engine);
            points.emplace_back(0.5 * i, 3.0 * pass, error_m + kNoise_m * normal(engine));
            track.push_back({kTrack_m, 0.0, pass, 0.5 * i});
        }
    }
    SilentProgress silent;
    const auto told =
        learnInterpolationError(InterpolationMethod::Linear, points, {}, track, {}, 1, silent, {}).value();
    const InterpolationErrorModel not_told = learnt(points);
    // Level ground: 3 m away there is nothing but noise and tracks.
    EXPECT_LT(told.variance_m2(3.0, 0.0), 0.5 * not_told.variance_m2(3.0, 0.0));
    EXPECT_GT(told.left_out.mean_square, 0.6);
    EXPECT_LT(told.left_out.mean_square, 1.4);
    EXPECT_EQ(
        learnInterpolationError(InterpolationMethod::Linear, points, {}, {TrackSigma{}}, {}, 1, silent, {})
            .error()
            .kind,
        ErrorKind::Usage);
}

TEST(SurfaceUncertainty, AddsTheTrackWithoutAveragingItAway) {
    std::vector<Eigen::Vector3d> points = scattered(2500, 0.0, 21);
    for (Eigen::Vector3d& p : points) p.z() = 0.5 * p.x();
    const ElevationGrid dem = gridOf(points, 0.5);
    const InterpolationErrorModel exact;  // of nothing but the track
    SilentProgress silent;
    const auto u = surfaceUncertainty(dem, points, std::vector<TrackSigma>(points.size(), {0.3, 0.8}),
                                      {exact, {}}, silent, {});
    ASSERT_TRUE(u);
    const auto cell = dem.geometry.cellAt(30.0, 30.0);
    ASSERT_TRUE(cell);
    // One pass, and points within a metre or two: they share all but a tenth of their variance.
    const double all_m = std::hypot(0.3, 0.5 * 0.8);
    EXPECT_LE(u->sigmas_m[*cell], all_m + 1e-6);
    EXPECT_GT(u->sigmas_m[*cell], 0.95 * all_m);
}

TEST(SurfaceUncertainty, BetweenTwoPassesTheirTracksCountTogether) {
    std::vector<Eigen::Vector3d> points;
    std::vector<TrackSigma> track;
    for (std::uint32_t pass = 0; pass < 2; ++pass) {
        for (int i = 0; i < 60; ++i) {
            points.emplace_back(i + 0.25, 20.25 + 2.0 * pass, 1.0);
            track.push_back({0.2, 0.0, pass, 1.0 * i});
        }
    }
    const ElevationGrid dem = gridOf(points, 0.5);
    SilentProgress silent;
    const auto u = surfaceUncertainty(dem, points, track, {InterpolationErrorModel{}, {}}, silent, {});
    ASSERT_TRUE(u);
    const double on_pass = u->sigmas_m[dem.geometry.cellAt(30.25, 20.25).value()];
    const double between = u->sigmas_m[dem.geometry.cellAt(30.25, 21.25).value()];
    EXPECT_NEAR(on_pass, 0.2, 0.01);
    // Half and half, 2 m apart, with 0.6 exp(-2 / 8) in common: 0.2 sqrt(0.73), a little less for four
    // points.
    EXPECT_NEAR(between, 0.2 * std::sqrt(0.5 * (1.0 + kOtherPassCorrelation * std::exp(-0.25))), 0.01);
}

TEST(SurfaceUncertainty, KnowsOverWhatDistanceErrorsHangTogether) {
    const std::vector<Eigen::Vector3d> points = scattered(3600, 0.0, 8);  // one a square metre
    const ElevationGrid dem = gridOf(points, 0.5);
    const auto rangeOf = [&](double track_m, double noise_m2) {
        InterpolationErrorModel model;
        model.coefficients = {noise_m2, 0.0, 0.0, 0.0};
        SilentProgress silent;
        return surfaceUncertainty(dem, points, std::vector<TrackSigma>(points.size(), {track_m, 0.0}),
                                  {model, {}}, silent, {})
            ->correlation_range_m;
    };
    // The integral of the spherical correlogram, pi R^2 / 5, is that of what passes share, 0.6 exp(-d / 8),
    // with the common part over the whole area; or ten square metres.
    double area_m2 = 0.0;
    for (const float height : dem.heights_m) area_m2 += std::isnan(height) ? 0.0 : 0.25;
    const double near_m2 = 2.0 * kPi * 64.0 * kOtherPassCorrelation;
    const double track_m2 = kEverywhereCorrelation * area_m2 + (1.0 - kEverywhereCorrelation) * near_m2;
    EXPECT_NEAR(rangeOf(0.1, 0.0), std::sqrt(5.0 * track_m2 / kPi), 1e-6);
    EXPECT_NEAR(rangeOf(0.0, 0.01), std::sqrt(50.0 / kPi), 0.1);
    const double both = rangeOf(0.1, 0.01);
    EXPECT_GT(both, rangeOf(0.0, 0.01));
    EXPECT_LT(both, rangeOf(0.1, 0.0));
    EXPECT_EQ(rangeOf(0.0, 0.0), 0.0);
}

// Beside a riser the error in plan counts on the tread, too; and single points that stand off do not make a
// slope of level ground.
TEST(SurfaceUncertainty, LeansOverTheReachOfTheErrorInPlan) {
    const auto leanAt = [](const std::vector<Eigen::Vector3d>& points, double plan_m, double x) {
        const ElevationGrid dem = gridOf(points, 0.25);
        const auto cell = dem.geometry.cellAt(x, 30.1).value();
        const CarryingPoint near{{x, 30.1}, 0.0, {0.0, plan_m}};
        return cellSigma(dem, cell / dem.geometry.columns, cell % dem.geometry.columns, {&near, 1}, {})
            .lean_m;
    };
    std::mt19937_64 engine(4);
    std::vector<Eigen::Vector3d> riser, level;
    for (double y = 0.0; y <= 60.0; y += 0.5) {
        for (double x = 0.0; x <= 60.0; x += 0.5) {
            riser.emplace_back(x, y, x < 30.0 ? 0.0 : 1.0);
            level.emplace_back(x, y, 0.05 * normal(engine));
        }
    }
    EXPECT_GT(leanAt(riser, 0.7, 29.1), 0.2);  // the face begins 0.4 m on
    EXPECT_LT(leanAt(riser, 0.7, 27.1), 1e-6);
    double squares = 0.0;
    for (double x = 10.1; x < 50.0; x += 1.0) squares += std::pow(leanAt(level, 0.7, x), 2);
    // Differences of 0.05 sqrt(2) over 2 m, in two axes, times 0.7 m: 0.035 m; between points less.
    EXPECT_LT(std::sqrt(squares / 40.0), 0.035);
}

TEST(SurfaceUncertainty, TellsWhereCellsCameFrom) {
    // Two rows of points 8 m apart.
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 60; ++i) {
        points.emplace_back(i + 0.25, 20.25, 1.0);
        points.emplace_back(i + 0.25, 28.25, 1.0);
    }
    const ElevationGrid dem = gridOf(points, 0.5);
    InterpolationErrorModel model;
    model.coefficients = {0.0, 0.01, 0.0, 0.0};
    model.greatest_distance_m = 3.0;
    SilentProgress silent;
    const auto u =
        surfaceUncertainty(dem, points, std::vector<TrackSigma>(points.size()), {model, {}}, silent, {});
    ASSERT_TRUE(u);
    const auto source = [&](double x, double y) {
        return static_cast<CellSource>(u->sources[dem.geometry.cellAt(x, y).value()]);
    };
    EXPECT_EQ(source(30.25, 20.25), CellSource::Measured);
    EXPECT_EQ(source(30.25, 22.25), CellSource::Interpolated);
    EXPECT_EQ(source(30.25, 24.25), CellSource::Extrapolated);
    EXPECT_EQ(source(30.25, 40.25), CellSource::None);
    EXPECT_TRUE(std::isnan(u->sigmas_m[dem.geometry.cellAt(30.25, 40.25).value()]));
    // One point each metre within a square of 2.5 m: five cells either way hold two or three points.
    EXPECT_NEAR(u->density_per_m2[dem.geometry.cellAt(30.25, 20.25).value()], 2.5 / 6.25, 0.1);
    EXPECT_EQ(u->density_per_m2[dem.geometry.cellAt(30.25, 24.25).value()], 0.0F);
    EXPECT_EQ(surfaceUncertainty(dem, points, {}, {model, {}}, silent, {}).error().kind, ErrorKind::Usage);
}

}  // namespace
}  // namespace terrawalk
