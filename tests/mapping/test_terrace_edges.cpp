#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "mapping/constrained_tin.hpp"
#include "mapping/delaunay_tin.hpp"
#include "mapping/gridding.hpp"
#include "mapping/plan_cells.hpp"
#include "mapping/step_model.hpp"
#include "mapping/terrace_edges.hpp"
#include "tests/mapping/terrain_points.hpp"

namespace terrawalk {
namespace {

using test::Points;
using test::RandomNumbers;
using Ground = std::function<double(double x, double y)>;

constexpr double kSide_m = 30.0;
constexpr double kTread_m = 6.0;
constexpr double kFace_m = 0.6;  // in plan; the middle of each face lies at half a tread and whole treads on

/// Level treads that climb to the north by a step each, and wind a little.
Ground terraces(double step_m) {
    return [step_m](double x, double y) {
        const double along_m = y - 0.8 * std::sin(x / 6.0) + 0.5 * kTread_m;
        const double tread = std::floor(along_m / kTread_m);
        const double into_m = along_m - tread * kTread_m - (kTread_m - kFace_m);
        return step_m * (tread + std::max(0.0, into_m / kFace_m));
    };
}
/// How far a place lies from the middle of the nearest face, northward.
double fromFace_m(const Eigen::Vector3d& at_m) {
    const double along_m = at_m.y() - 0.8 * std::sin(at_m.x() / 6.0) + 0.5 * kTread_m + 0.5 * kFace_m;
    return along_m - kTread_m * std::round(along_m / kTread_m);
}

Points pointsOn(const Ground& ground, double per_m2, double sigma_m, std::uint64_t seed) {
    RandomNumbers random(seed);
    Points points;
    for (int i = 0; i < static_cast<int>(per_m2 * kSide_m * kSide_m); ++i) {
        const double x = random.uniform(0.0, kSide_m), y = random.uniform(0.0, kSide_m);
        points.emplace_back(x, y, ground(x, y) + sigma_m * random.normal());
    }
    return points;
}

Result<TerraceEdges> find(const Points& points, const TerraceEdgeOptions& options = {}) {
    SilentProgress progress;
    return findTerraceEdges(points, {}, options, progress, {});
}

double lengthOf(const TerraceEdges& found) {
    double length_m = 0.0;
    for (const TerraceEdge& edge : found.edges) length_m += edge.length_m;
    return length_m;
}

TEST(TerraceEdges, LieOnTheRisersWithTheirHeight) {
    constexpr double kStep_m = 0.8;
    const auto found = find(pointsOn(terraces(kStep_m), 2.0, 0.03, 1));
    ASSERT_TRUE(found) << found.error().message;
    // Five risers cross the square.
    EXPECT_GT(lengthOf(*found), 0.93 * 5.0 * kSide_m);
    for (const TerraceEdge& edge : found->edges) {
        EXPECT_NEAR(edge.step_m, kStep_m, 0.1);
        EXPECT_LT(edge.location_sigma_m, 0.25);
        ASSERT_EQ(edge.toe_m.size(), edge.top_m.size());
        for (std::size_t i = 0; i < edge.toe_m.size(); ++i) {
            const Eigen::Vector3d middle_m = 0.5 * (edge.toe_m[i] + edge.top_m[i]);
            EXPECT_LT(std::abs(fromFace_m(middle_m)), 0.5) << middle_m.transpose();
            EXPECT_GT(edge.top_m[i].y(), edge.toe_m[i].y()) << "the top edge lies uphill";
            EXPECT_GT(edge.top_m[i].z(), edge.toe_m[i].z());
        }
    }
}

/// The farthest that each edge goes to the east.
std::vector<double> eastEnds(const TerraceEdges& found) {
    std::vector<double> ends_m;
    for (const TerraceEdge& edge : found.edges) {
        double end_m = 0.0;
        for (const Eigen::Vector3d& at_m : edge.toe_m) end_m = std::max(end_m, at_m.x());
        ends_m.push_back(end_m);
    }
    return ends_m;
}

TEST(TerraceEdges, GoOnToTheEndOfTheGround) {
    const auto found = find(pointsOn(terraces(1.0), 4.0, 0.02, 15));
    ASSERT_TRUE(found);
    const std::vector<double> ends_m = eastEnds(*found);
    ASSERT_EQ(ends_m.size(), 5U);
    // Points are half a metre apart: so far may the last one be from the side of the square.
    for (const double end_m : ends_m) EXPECT_GT(end_m, kSide_m - 0.5);
}

TEST(TerraceEdges, EndWhereTheRiserEndsThoughTheGroundSoonDoes) {
    // Treads and faces as far as that, and one even slope from there to the side of the square.
    for (const double riser_end_m : {20.0, 26.0, 28.5, 29.0}) {
        const Ground stepped = terraces(1.0);
        const Ground ground = [&](double x, double y) {
            const double share = std::clamp(riser_end_m + 0.5 - x, 0.0, 1.0);
            const double slope = (y - 0.8 * std::sin(x / 6.0)) / kTread_m;
            return share * stepped(x, y) + (1.0 - share) * slope;
        };
        const auto found = find(pointsOn(ground, 4.0, 0.02, 16));
        ASSERT_TRUE(found);
        const std::vector<double> ends_m = eastEnds(*found);
        ASSERT_EQ(ends_m.size(), 5U);
        for (const double end_m : ends_m) EXPECT_LT(end_m, riser_end_m + 0.5) << riser_end_m;
    }
}

struct Errors {
    double near_m;
    double elsewhere_m;
};
Errors errorsOf(const TriangleMesh& mesh, const Ground& ground) {
    SilentProgress progress;
    const auto geometry = gridCovering(GridExtent{1.0, 1.0, kSide_m - 1.0, kSide_m - 1.0}, 0.2);
    const auto dem = rasterize(mesh, *geometry, progress, {});
    double near = 0.0, elsewhere = 0.0;
    std::size_t near_count = 0, count = 0;
    for (std::size_t i = 0; i < geometry->size(); ++i) {
        if (std::isnan(dem->heights_m[i])) continue;
        const double x = geometry->centreX(i % geometry->columns),
                     y = geometry->centreY(i / geometry->columns);
        const double off_m = dem->heights_m[i] - ground(x, y);
        const bool is_near = std::abs(fromFace_m({x, y, 0.0})) < 1.0 + 0.5 * kFace_m;
        (is_near ? near : elsewhere) += off_m * off_m;
        ++(is_near ? near_count : count);
    }
    return {std::sqrt(near / static_cast<double>(near_count)),
            std::sqrt(elsewhere / static_cast<double>(count))};
}

TEST(TerraceEdges, LowerTheErrorNearRisersByAThirdAndDoNotRaiseItElsewhere) {
    const Ground ground = terraces(1.0);
    for (const std::uint64_t seed : {11, 12, 13}) {
        const Points points = pointsOn(ground, 1.0, 0.05, seed);
        const auto found = find(points);
        ASSERT_TRUE(found);
        SilentProgress progress;
        const auto plain = DelaunayTin::build(points, {}, progress, {});
        // That it can be built shows as well that no two of the lines cross.
        const auto edged =
            buildConstrainedTin(points, softBreaklines(found->edges), {plain->longestEdge_m()}, progress, {});
        ASSERT_TRUE(edged) << edged.error().message;
        const Errors before = errorsOf(plain->mesh(), ground), after = errorsOf(edged->groundMesh(), ground);
        EXPECT_LT(after.near_m, 0.67 * before.near_m) << seed;
        EXPECT_LT(after.elsewhere_m, 1.02 * before.elsewhere_m) << seed;
    }
}

TEST(TerraceEdges, DoNotDependOnTheOrderOfThePointsOrOnThreads) {
    Points points = pointsOn(terraces(0.8), 1.0, 0.05, 21);
    const auto expected = find(points);
    ASSERT_TRUE(expected);
    ASSERT_FALSE(expected->edges.empty());
    RandomNumbers random(22);
    test::shuffle(points, random);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto found = find(points);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->edges.size(), expected->edges.size());
    for (std::size_t i = 0; i < found->edges.size(); ++i) {
        EXPECT_EQ(found->edges[i].toe_m, expected->edges[i].toe_m);
        EXPECT_EQ(found->edges[i].top_m, expected->edges[i].top_m);
    }
}

TEST(TerraceEdges, AreNotSeenWhereThereAreNone) {
    const Ground level = [](double, double) {
        return 3.0;
    };
    const Ground slope = [](double x, double y) {
        return 0.4 * x + 0.1 * y;
    };
    const Ground hills = [](double x, double y) {
        return 1.5 * std::sin(x / 5.0) * std::cos(y / 6.0);
    };
    for (const Ground& ground : {level, slope, hills}) {
        for (const double sigma_m : {0.0, 0.05, 0.3}) {
            for (const std::uint64_t seed : {31, 32}) {
                const auto found = find(pointsOn(ground, 1.5, sigma_m, seed));
                ASSERT_TRUE(found);
                EXPECT_TRUE(found->edges.empty()) << sigma_m << " " << seed;
            }
        }
    }
}

TEST(TerraceEdges, AreAtLeastAsHighAsAskedFor) {
    const Points points = pointsOn(terraces(0.35), 2.0, 0.02, 41);
    EXPECT_TRUE(find(points)->edges.empty());
    TerraceEdgeOptions lower;
    lower.least_step_m = 0.25;
    EXPECT_GT(lengthOf(*find(points, lower)), 0.5 * 5.0 * kSide_m);
}

TEST(TerraceEdges, AreTheSameInFeet) {
    constexpr double kFoot_m = 0.3048;
    Points points = pointsOn(terraces(0.8), 1.0, 0.05, 45);
    const auto metres = find(points);
    for (Eigen::Vector3d& point : points) point /= kFoot_m;
    TerraceEdgeOptions options;
    options.metres_per_unit = kFoot_m;
    const auto feet = find(points, options);
    ASSERT_TRUE(metres && feet);
    ASSERT_FALSE(metres->edges.empty());
    // Rounding may end an edge a step earlier or later, no more.
    EXPECT_NEAR(lengthOf(*feet) * kFoot_m, lengthOf(*metres), 0.02 * lengthOf(*metres));
    EXPECT_NEAR(feet->longest_edge_m * kFoot_m, metres->longest_edge_m, 1e-6);
    EXPECT_NEAR(feet->edges.front().step_m * kFoot_m, metres->edges.front().step_m, 0.01);
}

TEST(TerraceEdges, DoNotCrossLinesThatAreThere) {
    const Points points = pointsOn(terraces(1.0), 1.0, 0.03, 46);
    // Straight across all risers, and a ring about the middle.
    const double unknown = std::nan("");
    const std::vector<Breakline> lines{
        {{{11.0, 0.5, unknown}, {13.0, 29.5, unknown}}, BreaklineKind::Hard, "path"},
        {{{18.0, 8.0, unknown}, {26.0, 8.0, unknown}, {22.0, 22.0, unknown}}, BreaklineKind::Hole, "pond"}};
    SilentProgress progress;
    const auto found = findTerraceEdges(points, lines, {}, progress, {});
    ASSERT_TRUE(found);
    EXPECT_GT(lengthOf(*found), 60.0);
    std::vector<Breakline> all = softBreaklines(found->edges);
    all.insert(all.end(), lines.begin(), lines.end());
    const auto tin = buildConstrainedTin(points, all, {found->longest_edge_m}, progress, {});
    EXPECT_TRUE(tin) << tin.error().message;
    all = softBreaklines(find(points)->edges);
    all.insert(all.end(), lines.begin(), lines.end());
    EXPECT_FALSE(buildConstrainedTin(points, all, {}, progress, {})) << "they would cross";
}

TEST(TerraceEdges, NeedPoints) {
    EXPECT_TRUE(find({})->edges.empty());
    Points points = pointsOn(terraces(1.0), 0.03, 0.0, 51);
    ASSERT_LT(points.size(), 30U);
    EXPECT_TRUE(find(points)->edges.empty());
    TerraceEdgeOptions impossible;
    impossible.least_step_m = 0.0;
    EXPECT_EQ(find(points, impossible).error().kind, ErrorKind::Usage);
    points.front().z() = std::nan("");
    EXPECT_EQ(find(points).error().kind, ErrorKind::BadData);
}

TEST(TerraceEdges, AreGivenUpWhenAsked) {
    std::stop_source stop;
    stop.request_stop();
    SilentProgress progress;
    const auto found =
        findTerraceEdges(pointsOn(terraces(1.0), 1.0, 0.0, 61), {}, {}, progress, stop.get_token());
    EXPECT_EQ(found.error().kind, ErrorKind::Cancelled);
}

StepWindow exactWindow(const StepFit& truth) {
    RandomNumbers random(71);
    StepWindow window;
    window.scale = {2.0, 3.0, 1e-4};
    for (int i = 0; i < 80; ++i) {
        WindowPoint p{random.uniform(-3.0, 3.0), random.uniform(-2.0, 2.0), 0.0, random.uniform(0.2, 1.0)};
        p.z = truth.height_m(p);
        window.points.push_back(p);
    }
    return window;
}

TEST(StepModel, FitsItsOwnHeightsExactly) {
    StepFit truth;
    truth.shape = {0.3, 0.1, 0.02, 0.5};
    truth.middle_m = 0.2;
    truth.along_slope = 0.03;
    truth.lower_slope = -0.05;
    truth.upper_slope = 0.08;
    truth.step_m = 0.9;
    const StepFit fit = fitStep(exactWindow(truth), truth.shape);
    // The prior on slopes, (1e-4 / 0.3)^2 against sums near 10, moves them by 1e-8 or so.
    EXPECT_NEAR(fit.middle_m, truth.middle_m, 1e-6);
    EXPECT_NEAR(fit.along_slope, truth.along_slope, 1e-6);
    EXPECT_NEAR(fit.lower_slope, truth.lower_slope, 1e-6);
    EXPECT_NEAR(fit.upper_slope, truth.upper_slope, 1e-6);
    EXPECT_NEAR(fit.step_m, truth.step_m, 1e-6);
    EXPECT_LT(fit.squares_m2, 1e-7);
}

TEST(StepModel, FindsPlaceAndCourseOfAStep) {
    StepFit truth;
    truth.shape = {0.25, 0.1, 0.0, 0.6};
    truth.step_m = 1.0;
    StepSearch search;
    search.place_m = 0.6;
    search.course = 0.3;
    search.bend_pm = 0.03;
    search.greatest_width_m = 1.5;
    const StepWindow window = exactWindow(truth);
    const FoundStep found = searchStep(window, StepShape{}, search);
    // The last grid is 0.2 x 0.6 / 4 = 0.03 fine.
    EXPECT_NEAR(found.fit.shape.place_m, truth.shape.place_m, 0.1);
    EXPECT_NEAR(found.fit.step_m, truth.step_m, 0.1);
    EXPECT_GT(gainOf(found.window, found.fit), 50.0) << "no quadratic surface comes near";
}

TEST(PlanCells, FindsWhatASearchThroughAllFinds) {
    const Points points = test::randomPoints(500, 20.0, 81);
    const PlanCells cells(points, 1.7);
    for (const Eigen::Vector2d& at_m : {Eigen::Vector2d(10.0, 10.0), Eigen::Vector2d(0.0, 19.0)}) {
        std::size_t found = 0, expected = 0;
        cells.within(at_m, 3.0, [&](const Eigen::Vector3d& point) {
            EXPECT_LE((point.head<2>() - at_m).norm(), 3.0);
            ++found;
        });
        for (const Eigen::Vector3d& point : points) expected += (point.head<2>() - at_m).norm() <= 3.0;
        EXPECT_EQ(found, expected);
        EXPECT_GT(found, 5U);
    }
}

}  // namespace
}  // namespace terrawalk
