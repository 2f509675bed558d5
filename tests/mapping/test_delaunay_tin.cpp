#include <gmock/gmock.h>

#include <Eigen/LU>
#include <atomic>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <thread>

#include "mapping/delaunay_tin.hpp"
#include "mapping/edge_limit.hpp"
#include "tests/mapping/terrain_points.hpp"

namespace terrawalk {
namespace {

using test::kUtmOrigin_m;
using test::Points;
using test::RandomNumbers;
using testing::HasSubstr;

constexpr double kEverywhere_m = 1e8;  // a longest edge that leaves the convex hull whole

Result<DelaunayTin> buildTin(const Points& points, double longest_edge_m = kEverywhere_m) {
    SilentProgress progress;
    return DelaunayTin::build(points, {longest_edge_m}, progress, {});
}

bool sameBytes(const TriangleMesh& a, const TriangleMesh& b) {
    return a.vertices_m.size() == b.vertices_m.size() && a.triangles.size() == b.triangles.size() &&
           std::memcmp(a.vertices_m.data(), b.vertices_m.data(),
                       a.vertices_m.size() * sizeof(a.vertices_m[0])) == 0 &&
           std::memcmp(a.triangles.data(), b.triangles.data(), a.triangles.size() * sizeof(a.triangles[0])) ==
               0;
}

double planArea(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
    const Eigen::Vector3d ab = mesh.vertices_m[triangle[1]] - mesh.vertices_m[triangle[0]];
    const Eigen::Vector3d ac = mesh.vertices_m[triangle[2]] - mesh.vertices_m[triangle[0]];
    return 0.5 * (ab.x() * ac.y() - ab.y() * ac.x());
}

TEST(DelaunayTin, InterpolatesPlaneExactlyInsideHull) {
    const auto plane = [](double x, double y) {
        return 40.0 + 0.12 * (x - kUtmOrigin_m.x()) - 0.07 * (y - kUtmOrigin_m.y());
    };
    Points points = test::randomPoints(500, 100.0, 1, kUtmOrigin_m);
    for (const double x : {0.0, 100.0}) {
        for (const double y : {0.0, 100.0}) {
            points.emplace_back(kUtmOrigin_m + Eigen::Vector3d(x, y, 0.0));
        }
    }
    for (Eigen::Vector3d& point : points) {
        point.z() = plane(point.x(), point.y());
    }
    const auto tin = buildTin(points);
    ASSERT_TRUE(tin) << tin.error().text();
    EXPECT_NEAR(tin->area_m2(), 10'000.0, 1e-5);
    RandomNumbers random(2);
    for (int i = 0; i < 5000; ++i) {
        const double x = kUtmOrigin_m.x() + random.uniform(0.0, 100.0);
        const double y = kUtmOrigin_m.y() + random.uniform(0.0, 100.0);
        const auto height = tin->heightAt(x, y);
        ASSERT_TRUE(height);
        EXPECT_NEAR(*height, plane(x, y), 1e-9);
    }
}

// Whole-number coordinates below 2^12 keep the determinant of the circle test within 64 bits: exact.
TEST(DelaunayTin, HasNoPointInsideAnyCircumcircleAndCoversTheHull) {
    RandomNumbers random(3);
    std::set<std::pair<std::int64_t, std::int64_t>> places{{0, 0}, {0, 4095}, {4095, 0}, {4095, 4095}};
    while (places.size() < 300) {
        places.emplace(random.below(4096), random.below(4096));
    }
    Points points;
    for (const auto& [x, y] : places) {
        points.emplace_back(static_cast<double>(x), static_cast<double>(y), random.uniform(0.0, 1.0));
    }
    const auto tin = buildTin(points);
    ASSERT_TRUE(tin);
    EXPECT_EQ(tin->mesh().vertices_m.size(), points.size());
    EXPECT_DOUBLE_EQ(tin->area_m2(), 4095.0 * 4095.0);
    for (const auto& triangle : tin->mesh().triangles) {
        EXPECT_GT(planArea(tin->mesh(), triangle), 0.0) << "counter-clockwise";
        for (const auto& [px, py] : places) {
            std::array<std::array<std::int64_t, 3>, 3> m{};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::int64_t dx =
                    static_cast<std::int64_t>(tin->mesh().vertices_m[triangle[k]].x()) - px;
                const std::int64_t dy =
                    static_cast<std::int64_t>(tin->mesh().vertices_m[triangle[k]].y()) - py;
                m[k] = {dx, dy, dx * dx + dy * dy};
            }
            const std::int64_t in_circle = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                                           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                                           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
            ASSERT_LE(in_circle, 0);
        }
    }
}

TEST(DelaunayTin, DoesNotDependOnTheOrderOfPoints) {
    Points with_repeats = test::randomPoints(3000, 50.0, 4, kUtmOrigin_m);
    for (std::size_t i = 0; i < 300; ++i) {
        with_repeats.push_back(with_repeats[i] + Eigen::Vector3d(0.0, 0.0, 0.1 * static_cast<double>(i % 7)));
        with_repeats.push_back(with_repeats[i] + Eigen::Vector3d(0.0, 0.0, 0.37));
    }
    // Every cell of a regular grid has its four corners on one circle.
    for (Points points :
         {with_repeats, test::regularGrid(40, 30, 0.5), test::regularGrid(30, 40, 0.1, kUtmOrigin_m)}) {
        RandomNumbers random(5);
        const auto first = buildTin(points, 0.0);
        ASSERT_TRUE(first);
        for (int round = 0; round < 5; ++round) {
            test::shuffle(points, random);
            const auto again = buildTin(points, 0.0);
            ASSERT_TRUE(again);
            EXPECT_TRUE(sameBytes(first->mesh(), again->mesh()));
            EXPECT_EQ(first->longestEdge_m(), again->longestEdge_m());
            EXPECT_EQ(first->area_m2(), again->area_m2());
        }
    }
}

TEST(DelaunayTin, SignOfZeroDoesNotChangeTheBytes) {
    const auto a = buildTin({{0.0, 0.0, 0.0}, {1.0, 0.0, -0.0}, {0.0, 1.0, 0.0}, {-0.0, 0.0, -0.0}});
    const auto b = buildTin({{-0.0, -0.0, -0.0}, {0.0, 0.0, 0.0}, {1.0, -0.0, 0.0}, {0.0, 1.0, -0.0}});
    ASSERT_TRUE(a && b);
    EXPECT_TRUE(sameBytes(a->mesh(), b->mesh()));
}

TEST(DelaunayTin, MergesPointsAtOnePlaceIntoTheirMeanHeight) {
    const auto tin = buildTin({{0, 0, 1.0}, {4, 0, 2.0}, {0, 4, 3.0}, {0, 0, 2.0}, {0, 0, 6.0}});
    ASSERT_TRUE(tin);
    EXPECT_EQ(tin->mesh().vertices_m.size(), 3U);
    EXPECT_DOUBLE_EQ(tin->heightAt(0.0, 0.0).value(), 3.0);
}

TEST(DelaunayTin, KeepsPointsThatAreAlmostAtOnePlace) {
    Points points = test::regularGrid(5, 5, 1.0, kUtmOrigin_m);
    const std::size_t distinct = points.size();
    for (std::size_t i = 0; i < distinct; ++i) {
        Eigen::Vector3d neighbour = points[i];
        neighbour.x() = std::nextafter(neighbour.x(), 1e9);
        points.push_back(neighbour);
    }
    const auto tin = buildTin(points);
    ASSERT_TRUE(tin) << tin.error().text();
    EXPECT_EQ(tin->mesh().vertices_m.size(), 2 * distinct);
    for (const Eigen::Vector3d& point : points) {
        EXPECT_EQ(tin->heightAt(point.x(), point.y()), point.z());
    }
}

TEST(DelaunayTin, GivesTheHeightsOfItsVerticesAndEdgesExactly) {
    const Points points = test::randomPoints(400, 30.0, 6, kUtmOrigin_m);
    const auto tin = buildTin(points);
    ASSERT_TRUE(tin);
    for (const Eigen::Vector3d& point : points) {
        EXPECT_EQ(tin->heightAt(point.x(), point.y()), point.z());
    }
    // A point of an edge lies off it by the rounding of its coordinates, 2.3e-10 m here, and slopes are
    // mostly below 100. At the border it may lie outside.
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& triangle : tin->mesh().triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++edges[std::minmax(triangle[k], triangle[(k + 1) % 3])];
        }
    }
    for (const auto& [edge, triangles] : edges) {
        const Eigen::Vector3d middle =
            0.5 * (tin->mesh().vertices_m[edge.first] + tin->mesh().vertices_m[edge.second]);
        const auto height = tin->heightAt(middle.x(), middle.y());
        if (triangles == 2) {
            ASSERT_TRUE(height);
            EXPECT_NEAR(*height, middle.z(), 1e-6);
        }
    }
}

TEST(DelaunayTin, HeightAgreesWithASearchThroughAllTriangles) {
    for (const double longest_edge_m : {kEverywhere_m, 3.0}) {
        const auto tin = buildTin(test::randomPoints(400, 30.0, 7), longest_edge_m);
        ASSERT_TRUE(tin);
        const TriangleMesh& mesh = tin->mesh();
        RandomNumbers random(8);
        int inside = 0;
        for (int i = 0; i < 5000; ++i) {
            const double x = random.uniform(-2.0, 32.0);
            const double y = random.uniform(-2.0, 32.0);
            std::optional<double> expected;
            for (const auto& triangle : mesh.triangles) {
                Eigen::Matrix3d corners;
                Eigen::Vector3d heights;
                for (int k = 0; k < 3; ++k) {
                    const Eigen::Vector3d& vertex = mesh.vertices_m[triangle[static_cast<std::size_t>(k)]];
                    corners.col(k) = Eigen::Vector3d(vertex.x(), vertex.y(), 1.0);
                    heights[k] = vertex.z();
                }
                const Eigen::Vector3d weights = corners.inverse() * Eigen::Vector3d(x, y, 1.0);
                if (weights.minCoeff() >= 0.0) {
                    expected = weights.dot(heights);
                }
            }
            const auto height = tin->heightAt(x, y);
            ASSERT_EQ(height.has_value(), expected.has_value()) << x << " " << y;
            if (height) {
                EXPECT_NEAR(*height, *expected, 1e-9);
                ++inside;
            }
        }
        EXPECT_GT(inside, 1000);
    }
}

TEST(DelaunayTin, HasNoHeightForPlacesThatAreNone) {
    const auto tin = buildTin(test::regularGrid(3, 3, 1.0));
    ASSERT_TRUE(tin);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(tin->heightAt(nan, 1.0));
    EXPECT_FALSE(tin->heightAt(1.0, inf));
    EXPECT_FALSE(tin->heightAt(-inf, -inf));
    EXPECT_FALSE(tin->heightAt(std::nextafter(2.0, 3.0), 1.0));
    EXPECT_TRUE(tin->heightAt(2.0, 1.0));
}

TEST(DelaunayTin, IsAskedFromSeveralThreadsAtOnce) {
    const auto tin = buildTin(test::randomPoints(2000, 30.0, 9));
    const auto alone = buildTin(test::randomPoints(2000, 30.0, 9));
    ASSERT_TRUE(tin && alone);
    std::atomic<int> differences = 0;
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < 4; ++thread) {
        threads.emplace_back([&, thread] {
            RandomNumbers random(static_cast<std::uint64_t>(thread));
            for (int i = 0; i < 500; ++i) {
                const double x = random.uniform(5.0, 25.0);
                const double y = random.uniform(5.0, 25.0);
                const auto height = tin->heightAt(x, y);
                differences += height.has_value() ? 0 : 1;
            }
        });
    }
    threads.clear();
    EXPECT_EQ(differences, 0);
    EXPECT_EQ(tin->heightAt(10.0, 10.0), alone->heightAt(10.0, 10.0));
}

TEST(DelaunayTin, RefusesWhatHasNoSurface) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    Points line;
    for (int i = 0; i < 100'000; ++i) {  // seconds, were it given to the triangulation
        line.emplace_back(0.25 * i, 0.5 * i, 1.0);
    }
    const std::vector<std::pair<Points, const char*>> cases{
        {{}, "at least three"},
        {{{1, 2, 3}}, "at least three"},
        {{{1, 2, 3}, {4, 5, 6}}, "at least three"},
        {{{1, 2, 3}, {4, 5, 6}, {1, 2, 9}, {4, 5, 6}}, "there are 2"},
        {line, "one straight line"},
        {{{0, 0, 0}, {1, 0, 0}, {0, nan, 0}}, "ground point 3 of 3"},
        {{{0, 0, 0}, {1, 0, nan}, {0, 1, 0}}, "ground point 2 of 3"},
        {{{0, inf, 0}, {1, 0, 0}, {0, 1, 0}}, "ground point 1 of 3"},
        {{{0, 0, 0}, {1e300, 0, 0}, {-1e300, 1, 0}}, "no place on Earth"},
    };
    for (const auto& [points, text] : cases) {
        const auto tin = buildTin(points, 0.0);
        ASSERT_FALSE(tin);
        EXPECT_EQ(tin.error().kind, ErrorKind::BadData);
        EXPECT_THAT(tin.error().text(), HasSubstr(text));
    }
}

TEST(DelaunayTin, TriangulatesALineWithOnePointOffIt) {
    Points points;
    for (int i = 0; i < 100'000; ++i) {
        points.emplace_back(0.25 * i, 0.5 * i, 1.0);
    }
    points.emplace_back(5000.0, 0.0, 1.0);
    const auto tin = buildTin(points);
    ASSERT_TRUE(tin);
    EXPECT_EQ(tin->mesh().triangles.size(), 99'999U);
}

TEST(DelaunayTin, LeavesOutTrianglesAboveTheLimitAndTheirVertices) {
    Points points = test::regularGrid(4, 4, 1.0);
    points.emplace_back(50.0, 50.0, 0.0);
    const auto tin = buildTin(points, 1.5);
    ASSERT_TRUE(tin);
    EXPECT_EQ(tin->longestEdge_m(), 1.5);
    EXPECT_EQ(tin->mesh().vertices_m.size(), 16U);
    EXPECT_EQ(tin->mesh().triangles.size(), 18U);
    EXPECT_DOUBLE_EQ(tin->area_m2(), 9.0);
    EXPECT_FALSE(tin->heightAt(10.0, 10.0));

    const auto nothing = buildTin(points, 0.5);
    ASSERT_FALSE(nothing);
    EXPECT_THAT(nothing.error().text(), HasSubstr("within 0.5 m"));
    for (const double impossible : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
        const auto refused = buildTin(points, impossible);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    }
}

TEST(DelaunayTin, StopsWhenAsked) {
    class StopAtFirstReport final : public Progress {
      public:
        std::stop_source source;
        void report(double, std::string_view) override { source.request_stop(); }
        void message(Severity, std::string_view) override {}
    };
    StopAtFirstReport progress;
    const auto tin =
        DelaunayTin::build(test::randomPoints(100'000, 100.0, 10), {}, progress, progress.source.get_token());
    ASSERT_FALSE(tin);
    EXPECT_EQ(tin.error().kind, ErrorKind::Cancelled);
}

// ---------------------------------------------------------------------------------------------- longest edge

class EdgeLimitOfWalk : public testing::TestWithParam<test::WalkStyle> {};

/// Share of the places in a rectangle, with a margin of half a metre, that have a height.
double filledShare(const DelaunayTin& tin, double west, double south, double width, double length) {
    int filled = 0;
    int all = 0;
    for (double x = west + 0.5; x < west + width - 0.4; x += 0.37) {
        for (double y = south + 0.5; y < south + length - 0.4; y += 0.37, ++all) {
            filled += tin.heightAt(x, y).has_value() ? 1 : 0;
        }
    }
    return static_cast<double>(filled) / all;
}

TEST_P(EdgeLimitOfWalk, FillsBetweenLines) {
    RandomNumbers random(11);
    Points points;
    test::walkRectangle(points, 0.0, 0.0, 36.0, 50.0, GetParam(), random);
    const auto tin = buildTin(points, 0.0);
    ASSERT_TRUE(tin);
    EXPECT_EQ(filledShare(*tin, 0.0, 0.0, 36.0, 50.0), 1.0) << tin->longestEdge_m();
    EXPECT_GE(tin->longestEdge_m(), 1.8 * GetParam().line_spacing_m) << "bridges a line walked astray";
}

TEST_P(EdgeLimitOfWalk, LeavesTheBayOfAnLEmpty) {
    RandomNumbers random(12);
    const double arm = 3.0 * GetParam().line_spacing_m;
    Points points;
    test::walkRectangle(points, 0.0, 0.0, arm, 80.0, GetParam(), random);
    test::walkRectangle(points, arm, 0.0, 60.0, arm, GetParam(), random);
    const auto tin = buildTin(points, 0.0);
    ASSERT_TRUE(tin);
    EXPECT_EQ(filledShare(*tin, 0.0, 0.0, arm, 80.0), 1.0) << tin->longestEdge_m();
    // A triangle across the inner corner reaches at most the limit over the root of two along each arm.
    const double corner = tin->longestEdge_m();
    EXPECT_EQ(filledShare(*tin, arm + corner, arm + 0.5, 60.0 - corner, 79.0 - arm), 0.0);
    EXPECT_LE(tin->longestEdge_m(), 3.5 * GetParam().line_spacing_m);
}

TEST_P(EdgeLimitOfWalk, LeavesTheBayOfAUEmpty) {
    RandomNumbers random(13);
    const double arm = 2.0 * GetParam().line_spacing_m;
    const double bay = 8.0 * GetParam().line_spacing_m;
    Points points;
    test::walkRectangle(points, 0.0, 0.0, arm, 80.0, GetParam(), random);
    test::walkRectangle(points, arm, 0.0, bay, arm, GetParam(), random);
    test::walkRectangle(points, arm + bay, 0.0, arm, 80.0, GetParam(), random);
    const auto tin = buildTin(points, 0.0);
    ASSERT_TRUE(tin);
    EXPECT_EQ(filledShare(*tin, 0.0, 0.0, arm, 80.0), 1.0) << tin->longestEdge_m();
    EXPECT_EQ(filledShare(*tin, arm + bay, 0.0, arm, 80.0), 1.0) << tin->longestEdge_m();
    EXPECT_EQ(filledShare(*tin, arm + 0.5, arm + tin->longestEdge_m(), bay - 1.0, 79.0 - arm), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Spacings, EdgeLimitOfWalk,
                         testing::Values(test::WalkStyle{1.0, 0.2, 0.1}, test::WalkStyle{3.0, 0.2, 0.1},
                                         test::WalkStyle{6.0, 0.2, 0.1}, test::WalkStyle{3.0, 0.5, 0.25},
                                         test::WalkStyle{3.0, 0.03, 0.08}, test::WalkStyle{3.0, 0.2, 0.0}));

TEST(EdgeLimit, IsNotSwayedByACrowdStandingStill) {
    RandomNumbers random(14);
    Points points;
    test::walkRectangle(points, 0.0, 0.0, 30.0, 50.0, {}, random);
    const auto without = buildTin(points, 0.0);
    for (int i = 0; i < 20'000; ++i) {  // more points than the walk has
        points.emplace_back(10.0 + 0.2 * random.normal(), 10.0 + 0.2 * random.normal(), 1.0);
    }
    const auto with = buildTin(points, 0.0);
    ASSERT_TRUE(without && with);
    EXPECT_NEAR(with->longestEdge_m(), without->longestEdge_m(), 0.2 * without->longestEdge_m());
}

TEST(EdgeLimit, FillsScatteredPoints) {
    const auto tin = buildTin(test::randomPoints(20'000, 100.0, 15), 0.0);
    ASSERT_TRUE(tin);
    EXPECT_EQ(filledShare(*tin, 5.0, 5.0, 90.0, 90.0), 1.0);
    EXPECT_LT(tin->longestEdge_m(), 6.0 * std::sqrt(10'000.0 / 20'000.0));
}

TEST(EdgeLimit, KeepsALoneTriangle) {
    const auto tin = buildTin({{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}, 0.0);
    ASSERT_TRUE(tin);
    EXPECT_EQ(tin->mesh().triangles.size(), 1U);
}

TEST(EdgeLimit, OfNothingIsZero) {
    EXPECT_EQ(longestEdgeLimit({}, 0), 0.0);
    EXPECT_EQ(longestEdgeLimit({{1.0, 0.0}}, 3), 0.0);
}

}  // namespace
}  // namespace terrawalk
