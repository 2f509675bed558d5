#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/natural_neighbor_coordinates_2.h>
#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <random>

#include "mapping/height_interpolator.hpp"
#include "mapping/plan_kd_tree.hpp"
#include "mapping/variogram.hpp"
#include "tests/mapping/terrain_points.hpp"

namespace terrawalk {
namespace {

using test::kUtmOrigin_m;
using test::Points;
using test::RandomNumbers;
using Method = InterpolationMethod;
using Surface = std::unique_ptr<const HeightInterpolator>;

Result<Surface> fit(Method method, const Points& points, const std::vector<double>& sigmas_m = {},
                    const InterpolationOptions& options = {}) {
    SilentProgress progress;
    return fitInterpolator(method, points, sigmas_m, options, progress, {});
}

std::vector<HeightEstimate> estimates(const HeightInterpolator& surface,
                                      const std::vector<Eigen::Vector2d>& places_m) {
    std::vector<HeightEstimate> found(places_m.size());
    surface.estimate(places_m, found);
    return found;
}

double heightAt(const HeightInterpolator& surface, double x, double y) {
    return estimates(surface, {{x, y}}).front().height_m;
}

Points withHeights(Points points, const std::function<double(double, double)>& height) {
    for (Eigen::Vector3d& point : points) point.z() = height(point.x(), point.y());
    return points;
}

/// Random points over a square of 100 m with its corners, so that the hull is the square.
Points squareOfPoints(std::size_t count, std::uint64_t seed) {
    Points points = test::randomPoints(count, 100.0, seed, kUtmOrigin_m);
    for (const double x : {0.0, 100.0}) {
        for (const double y : {0.0, 100.0}) points.emplace_back(kUtmOrigin_m + Eigen::Vector3d(x, y, 1.0));
    }
    return points;
}

std::vector<Eigen::Vector2d> placesIn(double low_m, double high_m, std::size_t count, std::uint64_t seed) {
    RandomNumbers random(seed);
    std::vector<Eigen::Vector2d> places_m;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = random.uniform(low_m, high_m);
        const double y = random.uniform(low_m, high_m);
        places_m.emplace_back(kUtmOrigin_m.head<2>() + Eigen::Vector2d(x, y));
    }
    return places_m;
}

class EachMethod : public testing::TestWithParam<Method> {};

TEST_P(EachMethod, KeepsLevelGroundLevel) {
    const auto surface =
        fit(GetParam(), withHeights(squareOfPoints(300, 1), [](double, double) { return 123.25; }));
    ASSERT_TRUE(surface) << surface.error().text();
    for (const HeightEstimate& estimate : estimates(**surface, placesIn(0.0, 100.0, 200, 2))) {
        EXPECT_DOUBLE_EQ(estimate.height_m, 123.25);
    }
}

TEST_P(EachMethod, KeepsAPlane) {
    const Method method = GetParam();
    // These three take means of neighbours.
    if (method == Method::Nearest || method == Method::InverseDistance || method == Method::Kriging)
        GTEST_SKIP() << "no plane";
    const auto plane = [](double x, double y) {
        return 0.3 * (x - kUtmOrigin_m.x()) - 0.2 * (y - kUtmOrigin_m.y());
    };
    const auto surface = fit(method, withHeights(squareOfPoints(300, 1), plane));
    ASSERT_TRUE(surface) << surface.error().text();
    for (const Eigen::Vector2d& place : placesIn(20.0, 80.0, 200, 2)) {
        EXPECT_NEAR(heightAt(**surface, place.x(), place.y()), plane(place.x(), place.y()), 1e-6);
    }
}

TEST_P(EachMethod, GivesTheSameBytesForAnyOrderOfThePointsAndAnyNumberOfThreads) {
    Points points = squareOfPoints(3000, 3);
    const GridGeometry geometry{kUtmOrigin_m.x(), kUtmOrigin_m.y() + 100.0, 0.7, 142, 142};
    SilentProgress progress;
    const auto grid = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const auto surface = fit(GetParam(), points);
        EXPECT_TRUE(surface) << surface.error().text();
        return *interpolateGrid(**surface, geometry, {}, progress, {});
    };
    const InterpolatedGrid one = grid(1);
    RandomNumbers random(4);
    test::shuffle(points, random);
    const InterpolatedGrid other = grid(4);
    ASSERT_EQ(one.heights.heights_m.size(), geometry.size());
    EXPECT_EQ(std::memcmp(one.heights.heights_m.data(), other.heights.heights_m.data(),
                          geometry.size() * sizeof(float)),
              0);
    ASSERT_EQ(one.variances_m2.size(), other.variances_m2.size());
    if (!one.variances_m2.empty()) {
        EXPECT_EQ(std::memcmp(one.variances_m2.data(), other.variances_m2.data(),
                              one.variances_m2.size() * sizeof(float)),
                  0);
    }
}

// The points lie where doubles of map coordinates step by 5e-10 m; slopes here are below 1.
TEST_P(EachMethod, HoldsItsPointsButForThoseThatSmooth) {
    if (GetParam() == Method::BSpline) GTEST_SKIP() << "approximates";
    const Points points = squareOfPoints(500, 5);
    const auto surface = fit(GetParam(), points);
    ASSERT_TRUE(surface) << surface.error().text();
    if (GetParam() == Method::Kriging) {
        // Heights are noise here: a nugget is right, and the surface must lie within the noise's range.
        for (const HeightEstimate& estimate : estimates(**surface, placesIn(0.0, 100.0, 100, 6))) {
            EXPECT_GT(estimate.height_m, -2.5);
            EXPECT_LT(estimate.height_m, kUtmOrigin_m.z() + 7.5);
        }
        return;
    }
    for (const Eigen::Vector3d& point : points) {
        EXPECT_NEAR(heightAt(**surface, point.x(), point.y()), point.z(), 1e-8);
    }
}

TEST_P(EachMethod, AnswersOnDegenerateInputWithHeightsOrAnError) {
    const bool triangles = GetParam() == Method::Linear || GetParam() == Method::NaturalNeighbour ||
                           GetParam() == Method::SibsonC1 || GetParam() == Method::CloughTocher;
    EXPECT_FALSE(fit(GetParam(), {}));
    const std::map<std::string, Points> inputs{
        {"one point", {{1.0, 2.0, 3.0}}},
        {"one place", {{1.0, 2.0, 3.0}, {1.0, 2.0, 5.0}}},
        {"two points", {{0.0, 0.0, 1.0}, {1.0, 0.0, 2.0}}},
        {"on one line", {{0.0, 0.0, 1.0}, {1.0, 1.0, 2.0}, {2.0, 2.0, 3.0}, {5.0, 5.0, 1.0}}},
    };
    for (const auto& [what, points] : inputs) {
        const auto surface = fit(GetParam(), points);
        EXPECT_EQ(static_cast<bool>(surface), !triangles) << what;
        if (surface) {
            EXPECT_TRUE(std::isfinite(heightAt(**surface, 1.0, 1.5))) << what;
        } else {
            EXPECT_EQ(surface.error().kind, ErrorKind::BadData) << what;
        }
    }
    // Four points of a square on one circle, the fifth in its centre twice; a regular grid.
    const auto cross = fit(GetParam(), {{0, 0, 1}, {2, 0, 2}, {2, 2, 3}, {0, 2, 4}, {1, 1, 0}, {1, 1, 10}});
    ASSERT_TRUE(cross) << cross.error().text();
    EXPECT_TRUE(std::isfinite(heightAt(**cross, 0.5, 1.0)));
    const auto regular = fit(GetParam(), test::regularGrid(20, 20, 1.0));
    ASSERT_TRUE(regular);
    for (double x = 0.0; x <= 19.0; x += 0.25) {
        EXPECT_TRUE(std::isfinite(heightAt(**regular, x, 19.0 - x))) << x;
    }
    EXPECT_FALSE(fit(GetParam(), {{0, 0, 1}, {2, 0, 2}, {0, 2, std::nan("")}}));
}

TEST_P(EachMethod, StopsWhenAsked) {
    const auto surface = fit(GetParam(), squareOfPoints(100, 7));
    ASSERT_TRUE(surface);
    std::stop_source stop;
    stop.request_stop();
    SilentProgress progress;
    const auto refit =
        fitInterpolator(GetParam(), squareOfPoints(100, 7), {}, {}, progress, stop.get_token());
    ASSERT_FALSE(refit);
    EXPECT_EQ(refit.error().kind, ErrorKind::Cancelled);
    const auto grid = interpolateGrid(**surface, {kUtmOrigin_m.x(), kUtmOrigin_m.y() + 100.0, 1.0, 100, 100},
                                      {}, progress, stop.get_token());
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().kind, ErrorKind::Cancelled);
}

INSTANTIATE_TEST_SUITE_P(Interpolation, EachMethod,
                         testing::Values(Method::Linear, Method::NaturalNeighbour, Method::SibsonC1,
                                         Method::CloughTocher, Method::InverseDistance, Method::Nearest,
                                         Method::Kriging, Method::BSpline),
                         [](const auto& test_case) {
                             std::string text(name(test_case.param));
                             std::erase(text, '-');
                             return text;
                         });

class OverTriangles : public testing::TestWithParam<Method> {};

TEST_P(OverTriangles, ReproducesPlanesInsideTheHullAndKnowsNothingOutside) {
    const auto plane = [](double x, double y) {
        return 40.0 + 0.12 * (x - kUtmOrigin_m.x()) - 0.07 * (y - kUtmOrigin_m.y());
    };
    const auto surface = fit(GetParam(), withHeights(squareOfPoints(500, 8), plane));
    ASSERT_TRUE(surface) << surface.error().text();
    const auto places_m = placesIn(0.0, 100.0, 2000, 9);
    const auto found = estimates(**surface, places_m);
    for (std::size_t i = 0; i < places_m.size(); ++i) {
        EXPECT_NEAR(found[i].height_m, plane(places_m[i].x(), places_m[i].y()), 1e-6);
    }
    EXPECT_TRUE(std::isnan(heightAt(**surface, kUtmOrigin_m.x() - 0.01, kUtmOrigin_m.y() + 50.0)));
    EXPECT_TRUE(std::isfinite(heightAt(**surface, kUtmOrigin_m.x(), kUtmOrigin_m.y() + 50.0)));
}

INSTANTIATE_TEST_SUITE_P(Interpolation, OverTriangles,
                         testing::Values(Method::Linear, Method::NaturalNeighbour, Method::SibsonC1,
                                         Method::CloughTocher));

TEST(NaturalNeighbour, MeetsTheCoordinatesOfCgal) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    Points points = squareOfPoints(400, 10);
    for (Eigen::Vector3d& point : points) point -= kUtmOrigin_m;
    CGAL::Delaunay_triangulation_2<Kernel> triangulation;
    std::map<Kernel::Point_2, double> height_at;
    for (const Eigen::Vector3d& point : points) {
        triangulation.insert({point.x(), point.y()});
        height_at[{point.x(), point.y()}] = point.z();
    }
    const auto surface = fit(Method::NaturalNeighbour, points);
    ASSERT_TRUE(surface);
    RandomNumbers random(11);
    for (int i = 0; i < 1000; ++i) {
        const Kernel::Point_2 place(random.uniform(10.0, 90.0), random.uniform(10.0, 90.0));
        std::vector<std::pair<Kernel::Point_2, double>> coordinates;
        const auto found =
            CGAL::natural_neighbor_coordinates_2(triangulation, place, std::back_inserter(coordinates));
        ASSERT_TRUE(found.third);
        double expected = 0.0;
        for (const auto& [point, weight] : coordinates) expected += weight / found.second * height_at[point];
        EXPECT_NEAR(heightAt(**surface, place.x(), place.y()), expected, 1e-8);
    }
}

// The slopes come from quadratics, so a quadratic surface is met exactly; so is the cubic over it.
TEST(CloughTocher, ReproducesQuadratics) {
    const auto quadratic = [](double x, double y) {
        const double u = x - kUtmOrigin_m.x();
        const double v = y - kUtmOrigin_m.y();
        return 2.0 + 0.3 * u - 0.1 * v + 0.004 * u * u - 0.002 * u * v + 0.003 * v * v;
    };
    const auto surface = fit(Method::CloughTocher, withHeights(squareOfPoints(500, 12), quadratic));
    ASSERT_TRUE(surface);
    const auto places_m = placesIn(5.0, 95.0, 1000, 13);
    const auto found = estimates(**surface, places_m);
    for (std::size_t i = 0; i < places_m.size(); ++i) {
        EXPECT_NEAR(found[i].height_m, quadratic(places_m[i].x(), places_m[i].y()), 1e-6);
    }
}

// Sibson (1981): the C1 form reproduces spherical quadratics.
TEST(SibsonC1, ReproducesSphericalQuadratics) {
    const auto bowl = [](double x, double y) {
        const double u = x - kUtmOrigin_m.x() - 40.0;
        const double v = y - kUtmOrigin_m.y() - 60.0;
        return 7.0 + 0.2 * u - 0.1 * v + 0.003 * (u * u + v * v);
    };
    const auto surface = fit(Method::SibsonC1, withHeights(squareOfPoints(500, 14), bowl));
    ASSERT_TRUE(surface);
    const auto places_m = placesIn(10.0, 90.0, 1000, 15);
    const auto found = estimates(**surface, places_m);
    for (std::size_t i = 0; i < places_m.size(); ++i) {
        EXPECT_NEAR(found[i].height_m, bowl(places_m[i].x(), places_m[i].y()), 1e-6);
    }
}

// Along a straight line the change of slope from step to step shrinks with the step where a surface is
// smooth, and stays where it folds.
TEST(CloughTocher, IsSmoothAcrossEdgesWhereTheTinFolds) {
    Points points = squareOfPoints(60, 16);
    for (Eigen::Vector3d& point : points) point -= kUtmOrigin_m;
    const auto greatestBend = [&](Method method, double step) {
        const auto surface = fit(method, points);
        std::vector<Eigen::Vector2d> line;
        for (double x = 5.0; x < 95.0; x += step) line.emplace_back(x, 50.0);
        const auto found = estimates(**surface, line);
        double greatest = 0.0;
        for (std::size_t i = 2; i < found.size(); ++i) {
            const double bend = found[i].height_m - 2.0 * found[i - 1].height_m + found[i - 2].height_m;
            greatest = std::max(greatest, std::abs(bend) / step);
        }
        return greatest;
    };
    EXPECT_GT(greatestBend(Method::Linear, 1e-3), 0.5 * greatestBend(Method::Linear, 1e-2));
    EXPECT_LT(greatestBend(Method::CloughTocher, 1e-3), 0.2 * greatestBend(Method::CloughTocher, 1e-2));
}

TEST(Kriging, HasLittleVarianceAtAPointAndMoreFartherAway) {
    const auto smooth = [](double x, double y) {
        return std::sin(x / 20.0) * std::cos(y / 15.0);
    };
    const Points points = withHeights(test::regularGrid(30, 30, 2.0), smooth);
    const auto surface = fit(Method::Kriging, points);
    ASSERT_TRUE(surface);
    EXPECT_TRUE((*surface)->hasVariance());
    const auto found = estimates(**surface, {{20.0, 20.0}, {21.0, 21.0}, {70.0, 70.0}});
    EXPECT_NEAR(found[0].height_m, smooth(20.0, 20.0), 2e-5);
    EXPECT_LT(found[0].variance_m2, 0.2 * found[1].variance_m2);
    EXPECT_LT(found[1].variance_m2, 0.1 * found[2].variance_m2);
    EXPECT_NEAR(found[1].height_m, smooth(21.0, 21.0), 0.01);
}

TEST(Kriging, TrustsAHeightTheLessTheGreaterItsSigma) {
    Points points = withHeights(test::regularGrid(10, 10, 1.0), [](double x, double) { return 0.1 * x; });
    points[55].z() += 1.0;
    std::vector<double> sigmas_m(points.size(), 0.01);
    const auto held = fit(Method::Kriging, points, sigmas_m);
    sigmas_m[55] = 100.0;
    const auto ignored = fit(Method::Kriging, points, sigmas_m);
    ASSERT_TRUE(held && ignored);
    const Eigen::Vector3d at = points[55];
    const double true_height = at.z() - 1.0;
    EXPECT_GT(heightAt(**held, at.x(), at.y()) - true_height, 0.2);
    EXPECT_LT(std::abs(heightAt(**ignored, at.x(), at.y()) - true_height), 0.02);
}

// The slope hides the noise from pairs of points: only points left out tell it.
TEST(Kriging, LearnsTheNoiseOfHeightsOnASlope) {
    constexpr double kNoise_m = 0.05;
    Points points = squareOfPoints(2000, 41);
    const auto slope = [](double x, double y) {
        return 0.3 * x - 0.1 * y;
    };
    points = withHeights(std::move(points), slope);
    std::mt19937_64 engine(42);
    std::normal_distribution<double> normal(0.0, kNoise_m);
    for (Eigen::Vector3d& point : points) point.z() += normal(engine);
    const auto surface = fit(Method::Kriging, points);
    ASSERT_TRUE(surface);
    const auto fitted = (*surface)->variogram();
    ASSERT_TRUE(fitted);
    EXPECT_GT(fitted->variogram.nugget_m2, 0.5 * kNoise_m * kNoise_m);
    EXPECT_LT(fitted->variogram.nugget_m2, 2.0 * kNoise_m * kNoise_m);
    EXPECT_GT(fitted->pairs, 1000u);
    double squares_m2 = 0.0;
    std::size_t held = 0;
    const std::vector<Eigen::Vector2d> places_m = placesIn(10.0, 90.0, 500, 43);
    const std::vector<HeightEstimate> found = estimates(**surface, places_m);
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double off_m = found[i].height_m - slope(places_m[i].x(), places_m[i].y());
        squares_m2 += off_m * off_m / static_cast<double>(found.size());
        held += std::abs(off_m) <= 1.96 * std::sqrt(found[i].variance_m2) ? 1 : 0;
    }
    // Sixteen points share in a height; an exact surface would carry the noise of one.
    EXPECT_LT(std::sqrt(squares_m2), 0.5 * kNoise_m);
    EXPECT_GT(held, 450u);
    EXPECT_FALSE((*fit(Method::Linear, points))->variogram());
}

TEST(Variogram, FindsTheModelThatItsClassesComeFrom) {
    for (const Variogram truth : {Variogram{VariogramModel::Spherical, 0.1, 2.0, 12.0, 1.0},
                                  Variogram{VariogramModel::Exponential, 0.05, 1.0, 20.0, 1.0},
                                  Variogram{VariogramModel::Power, 0.2, 3.0, 30.0, 1.5}}) {
        std::vector<VariogramClass> classes;
        for (double d = 0.5; d <= 30.0; d += 0.5) {
            classes.push_back({d, truth.nugget_m2 + truth.structureAt(d), 100});
        }
        const Variogram found = fitVariogram(classes);
        EXPECT_EQ(found.model, truth.model) << name(truth.model);
        for (const VariogramClass& c : classes) {
            EXPECT_NEAR(found.nugget_m2 + found.structureAt(c.distance_m), c.semivariance_m2,
                        0.02 * c.semivariance_m2);
        }
    }
    EXPECT_GT(fitVariogram({}).sill_m2, 0.0);
}

/// Terraces 6 m deep with risers of a metre over 0.9 m, on a slope that bends.
double terraces(double x, double y) {
    const double along = y + 3.0 * std::sin(x / 12.0) + 0.3 * x;
    const double step = std::floor(along / 6.0);
    const double t = std::clamp((along - 6.0 * step - 5.1) / 0.9, 0.0, 1.0);
    return step + t * t * (3.0 - 2.0 * t) + 0.02 * along + 0.06 * std::sin(x / 3.0) * std::cos(y / 4.0);
}

// A hundred thousand points a third of a metre apart: the edges of terraces are what a plain TIN loses.
TEST(SmoothMethods, LoseLessAtTheEdgesOfTerracesThanTheTin) {
    RandomNumbers random(21);
    const auto draw = [&](std::size_t count) {
        Points points;
        for (std::size_t i = 0; i < count; ++i) {
            const double x = random.uniform(0.0, 105.0);
            const double y = random.uniform(0.0, 105.0);
            points.emplace_back(x, y, terraces(x, y));
        }
        return points;
    };
    const Points points = draw(100'000);
    Points checks = draw(5'000);
    std::erase_if(checks, [](const Eigen::Vector3d& p) {
        return p.head<2>().minCoeff() < 1.0 || p.head<2>().maxCoeff() > 104.0;
    });
    const auto rmse = [&](Method method) {
        const auto surface = fit(method, points);
        double squares = 0.0;
        for (const Eigen::Vector3d& p : checks) {
            squares += std::pow(heightAt(**surface, p.x(), p.y()) - p.z(), 2);
        }
        return std::sqrt(squares / static_cast<double>(checks.size()));
    };
    const double tin = rmse(Method::Linear);
    EXPECT_GT(tin, 0.01);
    EXPECT_LT(rmse(Method::SibsonC1), 0.85 * tin);
    EXPECT_LT(rmse(Method::Kriging), 0.75 * tin);
}

TEST(BSpline, ComesCloserToItsPointsAsTheLatticeGetsFiner) {
    const auto waves = [](double x, double y) {
        return std::sin((x - kUtmOrigin_m.x()) / 7.0) + std::cos((y - kUtmOrigin_m.y()) / 9.0);
    };
    const Points points = withHeights(squareOfPoints(2000, 17), waves);
    const auto missAt = [&](double spacing) {
        InterpolationOptions options;
        options.b_spline_spacing = spacing;
        const auto surface = fit(Method::BSpline, points, {}, options);
        double sum = 0.0;
        for (const Eigen::Vector3d& point : points) {
            sum += std::pow(heightAt(**surface, point.x(), point.y()) - point.z(), 2);
        }
        return std::sqrt(sum / static_cast<double>(points.size()));
    };
    const double coarse = missAt(4.0);
    EXPECT_GT(coarse, 0.02);
    EXPECT_LT(missAt(0.5), 0.1 * coarse);
}

TEST(PlanKdTree, FindsWhatASearchOverAllFinds) {
    const Points points = test::randomPoints(500, 10.0, 18);
    const PlanKdTree tree(points);
    RandomNumbers random(19);
    std::vector<Neighbour> found;
    for (int i = 0; i < 100; ++i) {
        const double x = random.uniform(-1.0, 11.0);
        const Eigen::Vector2d place(x, random.uniform(-1.0, 11.0));
        std::vector<double> distances;
        for (const Eigen::Vector3d& point : points) {
            distances.push_back((point.head<2>() - place).squaredNorm());
        }
        tree.nearest(place, 7, found);
        ASSERT_EQ(found.size(), 7u);
        std::vector<double> sorted = distances;
        std::sort(sorted.begin(), sorted.end());
        for (std::size_t k = 0; k < 7; ++k) {
            EXPECT_DOUBLE_EQ(found[k].squared_distance_m2, sorted[k]);
            EXPECT_DOUBLE_EQ(distances[found[k].point], sorted[k]);
        }
    }
}

TEST(InterpolateGrid, FillsTheWantedCellsOnly) {
    const Points points = squareOfPoints(200, 20);
    const auto surface = fit(Method::Nearest, points);
    const GridGeometry geometry{kUtmOrigin_m.x(), kUtmOrigin_m.y() + 10.0, 1.0, 10, 10};
    std::vector<float> wanted(100, kNoHeight);
    wanted[37] = 0.0F;
    SilentProgress progress;
    const auto grid = interpolateGrid(**surface, geometry, wanted, progress, {});
    ASSERT_TRUE(grid);
    for (std::size_t cell = 0; cell < 100; ++cell) {
        EXPECT_EQ(std::isnan(grid->heights.heights_m[cell]), cell != 37) << cell;
    }
    EXPECT_FLOAT_EQ(grid->heights.at(3, 7),
                    static_cast<float>(heightAt(**surface, geometry.centreX(7), geometry.centreY(3))));
    EXPECT_FALSE(interpolateGrid(**surface, geometry, {1.0F}, progress, {}));
}

}  // namespace
}  // namespace terrawalk
