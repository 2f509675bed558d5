#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "mapping/constrained_tin.hpp"
#include "mapping/delaunay_tin.hpp"
#include "tests/mapping/terrain_points.hpp"

namespace terrawalk {
namespace {

using test::Points;
using test::RandomNumbers;
using testing::AllOf;
using testing::HasSubstr;

constexpr double kEverywhere_m = 1e8;

Result<ConstrainedTin> build(const Points& points, const std::vector<Breakline>& lines,
                             ConstrainedTinOptions options = {kEverywhere_m, 0.001}) {
    SilentProgress progress;
    return buildConstrainedTin(points, lines, options, progress, {});
}

bool hasEdge(const TriangleMesh& mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Eigen::Vector3d& p = mesh.vertices_m[triangle[corner]];
            const Eigen::Vector3d& q = mesh.vertices_m[triangle[(corner + 1) % 3]];
            if ((p == a && q == b) || (p == b && q == a)) return true;
        }
    }
    return false;
}

double heightAt(const HeightInterpolator& surface, double x, double y) {
    const std::vector<Eigen::Vector2d> place{{x, y}};
    std::vector<HeightEstimate> estimate(1);
    surface.estimate(place, estimate);
    return estimate.front().height_m;
}

double heightAt(const ConstrainedTin& tin, InterpolationMethod method, double x, double y) {
    return heightAt(**fitInterpolator(method, std::make_shared<const ConstrainedTin>(tin)), x, y);
}

TEST(ConstrainedTin, IsTheDelaunayTinWithoutBreaklines) {
    const Points points = test::randomPoints(2000, 50.0, 1);
    SilentProgress progress;
    const auto plain = DelaunayTin::build(points, {kEverywhere_m}, progress, {});
    const auto constrained = build(points, {}, {kEverywhere_m, 0.0});
    ASSERT_TRUE(plain && constrained);
    EXPECT_EQ(constrained->mesh.triangles, plain->mesh().triangles);
    EXPECT_EQ(constrained->groundMesh().vertices_m.size(), plain->mesh().vertices_m.size());
    EXPECT_NEAR(constrained->area_m2, plain->area_m2(), 1e-9 * plain->area_m2());
}

TEST(ConstrainedTin, KeepsEveryPieceOfABreaklineAndTheHeightsAlongIt) {
    const Breakline line{
        {{5.0, 5.0, 10.0}, {45.0, 20.0, 12.0}, {40.0, 45.0, 11.0}}, BreaklineKind::Hard, "wall"};
    const auto tin = build(test::randomPoints(500, 50.0, 2), {line});
    ASSERT_TRUE(tin) << tin.error().text();
    EXPECT_TRUE(hasEdge(tin->mesh, line.vertices_m[0], line.vertices_m[1]));
    EXPECT_TRUE(hasEdge(tin->mesh, line.vertices_m[1], line.vertices_m[2]));
    for (const InterpolationMethod method : {InterpolationMethod::Linear}) {
        EXPECT_NEAR(heightAt(*tin, method, 25.0, 12.5), 11.0, 1e-9);
    }
}

TEST(ConstrainedTin, GivesTheSameBytesForAnyOrderOfPointsAndLinesAndAnyDirection) {
    Points points = test::randomPoints(800, 50.0, 3);
    std::vector<Breakline> lines{
        {{{5, 5, 1}, {45, 6, 2}}, BreaklineKind::Hard, "a"},
        {{{5, 15, 1}, {25, 16, 3}, {45, 14, 2}}, BreaklineKind::Soft, "b"},
        {{{1, 1, 0}, {49, 1, 0}, {49, 49, 0}, {1, 49, 0}}, BreaklineKind::Boundary, "c"}};
    const auto one = build(points, lines);
    RandomNumbers random(4);
    test::shuffle(points, random);
    std::swap(lines[0], lines[2]);
    for (Breakline& line : lines) std::reverse(line.vertices_m.begin(), line.vertices_m.end());
    const auto other = build(points, lines);
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->mesh.triangles, other->mesh.triangles);
    EXPECT_EQ(one->breaks, other->breaks);
    EXPECT_EQ(one->ground, other->ground);
    ASSERT_EQ(one->mesh.vertices_m.size(), other->mesh.vertices_m.size());
    EXPECT_EQ(std::memcmp(one->mesh.vertices_m.data(), other->mesh.vertices_m.data(),
                          one->mesh.vertices_m.size() * sizeof(Eigen::Vector3d)),
              0);
}

TEST(ConstrainedTin, LeavesOutWhatIsOutsideTheBoundaryAndInHoles) {
    const Breakline boundary{
        {{10, 10, 0}, {40, 10, 0}, {40, 40, 0}, {10, 40, 0}}, BreaklineKind::Boundary, "b"};
    const Breakline hole{{{20, 20, 0}, {30, 20, 0}, {30, 30, 0}, {20, 30, 0}}, BreaklineKind::Hole, "h"};
    const auto tin = build(test::randomPoints(1000, 50.0, 5), {boundary, hole}, {0.0, 0.001});
    ASSERT_TRUE(tin) << tin.error().text();
    EXPECT_NEAR(tin->area_m2, 30.0 * 30.0 - 10.0 * 10.0, 1e-6);
    const auto alone = build({}, {boundary});
    ASSERT_TRUE(alone) << alone.error().text();
    EXPECT_NEAR(alone->area_m2, 900.0, 1e-9);
}

TEST(ConstrainedTin, FoldsAtHardLinesAndStaysSmoothAtSoftOnes) {
    // Two planes that meet at x = 25, with points on either side and a line along the fold.
    Points points;
    RandomNumbers random(6);
    for (int i = 0; i < 600; ++i) {
        const double x = random.uniform(0.0, 50.0);
        points.emplace_back(x, random.uniform(0.0, 50.0), std::abs(x - 25.0));
    }
    Breakline fold{{}, BreaklineKind::Hard, "fold"};
    for (double y = 0.0; y <= 50.0; y += 2.0) fold.vertices_m.emplace_back(25.0, y, 0.0);
    const auto worst = [&](const std::vector<Breakline>& lines, InterpolationMethod method) {
        const auto tin = build(points, lines);
        EXPECT_TRUE(tin);
        const auto surface = fitInterpolator(method, std::make_shared<const ConstrainedTin>(*tin));
        double greatest = 0.0;
        for (double x = 20.0; x <= 30.0; x += 0.1) {
            greatest = std::max(greatest, std::abs(heightAt(**surface, x, 25.5) - std::abs(x - 25.0)));
        }
        return greatest;
    };
    EXPECT_LT(worst({fold}, InterpolationMethod::Linear), 1e-9);
    EXPECT_LT(worst({fold}, InterpolationMethod::CloughTocher), 1e-9);
    EXPECT_GT(worst({}, InterpolationMethod::CloughTocher), 0.05);
    fold.kind = BreaklineKind::Soft;
    EXPECT_GT(worst({fold}, InterpolationMethod::CloughTocher), 0.02);
}

TEST(ConstrainedTin, NamesLinesThatCrossAndThePlace) {
    const Points points = test::randomPoints(50, 50.0, 7);
    const auto crossed = build(points, {{{{0, 0, 1}, {40, 40, 1}}, BreaklineKind::Hard, "line 4"},
                                        {{{0, 40, 1}, {40, 0, 1}}, BreaklineKind::Hard, "line 9"}});
    ASSERT_FALSE(crossed);
    EXPECT_EQ(crossed.error().kind, ErrorKind::BadData);
    EXPECT_THAT(crossed.error().text(),
                AllOf(HasSubstr("line 4"), HasSubstr("line 9"), HasSubstr("20.000, 20.000")));
    const auto loop =
        build(points, {{{{0, 0, 1}, {40, 40, 1}, {40, 0, 1}, {0, 40, 1}}, BreaklineKind::Soft, "line 2"}});
    EXPECT_THAT(loop.error().text(), HasSubstr("line 2 crosses itself"));
    // With a common vertex of one height they may.
    const auto joined = build(points, {{{{0, 0, 1}, {20, 20, 1}, {40, 40, 1}}, BreaklineKind::Hard, "a"},
                                       {{{0, 40, 1}, {20, 20, 1}, {40, 0, 1}}, BreaklineKind::Hard, "b"}});
    EXPECT_TRUE(joined) << joined.error().text();
    const auto apart = build(points, {{{{0, 0, 1}, {20, 20, 1}, {40, 40, 1}}, BreaklineKind::Hard, "a"},
                                      {{{0, 40, 1}, {20, 20, 2}, {40, 0, 1}}, BreaklineKind::Hard, "b"}});
    EXPECT_THAT(apart.error().text(), HasSubstr("meet at 20.000, 20.000"));
}

TEST(ConstrainedTin, MergesPointsThatNearlyTouchAndTrustsTheLine) {
    Points points = test::regularGrid(5, 5, 10.0);
    for (Eigen::Vector3d& p : points) p.z() = 0.0;
    points.emplace_back(20.0004, 20.0, 1.0);  // a metre above its neighbour in 0.4 mm
    points.emplace_back(5.0003, 5.0, 7.0);
    const Breakline line{{{5, 5, 0}, {15, 5, 0}}, BreaklineKind::Hard, "line"};
    const auto tin = build(points, {line});
    ASSERT_TRUE(tin) << tin.error().text();
    EXPECT_EQ(tin->merged, 2u);
    EXPECT_NEAR(heightAt(*tin, InterpolationMethod::Linear, 20.0, 20.0), 0.5, 1e-3);
    EXPECT_NEAR(heightAt(*tin, InterpolationMethod::Linear, 5.0, 5.0), 0.0, 1e-9);
}

TEST(ConstrainedTin, DrapesLinesWithoutHeights) {
    Points points = test::randomPoints(400, 50.0, 8);
    for (Eigen::Vector3d& p : points) p.z() = 0.1 * p.x();
    const double none = std::nan("");
    const auto tin = build(points, {{{{10, 10, none}, {40, 30, none}}, BreaklineKind::Soft, "line"}});
    ASSERT_TRUE(tin) << tin.error().text();
    EXPECT_NEAR(heightAt(*tin, InterpolationMethod::Linear, 25.0, 20.0), 2.5, 1e-9);
}

TEST(ConstrainedTin, RefusesWhatMakesNoSurface) {
    EXPECT_FALSE(build({}, {}));
    EXPECT_FALSE(build({{1, 1, 1}}, {}));
    EXPECT_FALSE(build({{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {3, 3, 4}}, {}));
    const Points points = test::randomPoints(50, 50.0, 9);
    EXPECT_FALSE(build(points, {{{{1, 1, 1}}, BreaklineKind::Hard, "short"}}));
    EXPECT_FALSE(build(points, {{{{1, 1, 1}, {2, 2, 2}}, BreaklineKind::Hole, "no ring"}}));
    EXPECT_EQ(build(points, {}, {-1.0, 0.0}).error().kind, ErrorKind::Usage);
    const auto tin = build(points, {});
    EXPECT_EQ(fitInterpolator(InterpolationMethod::Kriging, std::make_shared<const ConstrainedTin>(*tin))
                  .error()
                  .kind,
              ErrorKind::Usage);
    // Lines through points, over one another and along a border of the hull.
    const auto grid =
        build(test::regularGrid(6, 6, 1.0), {{{{0, 0, 0}, {5, 5, 0}}, BreaklineKind::Hard, "a"},
                                             {{{1, 1, 0}, {4, 4, 0}}, BreaklineKind::Hard, "b"},
                                             {{{0, 0, 0}, {5, 0, 0}}, BreaklineKind::Soft, "c"}});
    EXPECT_TRUE(grid) << grid.error().text();
}

}  // namespace
}  // namespace terrawalk
