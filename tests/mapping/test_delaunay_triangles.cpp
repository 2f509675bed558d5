#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mapping/delaunay_triangles.hpp"
#include "tests/mapping/terrain_points.hpp"

namespace terrawalk {
namespace {

using test::kUtmOrigin_m;
using test::Points;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Peer = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;
using Triangles = std::set<std::array<std::uint32_t, 3>>;

std::array<std::uint32_t, 3> fromLowest(std::array<std::uint32_t, 3> t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

Triangles ofPeer(const Points& points) {
    Peer peer;
    for (std::size_t i = 0; i < points.size(); ++i) {
        peer.insert({points[i].x(), points[i].y()})->info() = static_cast<std::uint32_t>(i);
    }
    Triangles triangles;
    for (const auto face : peer.finite_face_handles()) {
        triangles.insert(
            fromLowest({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()}));
    }
    return triangles;
}

Triangles ours(const Points& points) {
    std::size_t off_line = 1;
    while (CGAL::orientation(Kernel::Point_2(points.front().x(), points.front().y()),
                             Kernel::Point_2(points[off_line].x(), points[off_line].y()),
                             Kernel::Point_2(points.back().x(), points.back().y())) == CGAL::COLLINEAR) {
        ++off_line;
    }
    SilentProgress progress;
    const auto found = delaunayTriangles(points, off_line, progress, {}).value();
    Triangles triangles;
    for (const auto& triangle : found) triangles.insert(fromLowest(triangle));
    EXPECT_EQ(triangles.size(), found.size());
    return triangles;
}

Points grid(std::size_t columns, std::size_t rows, double step_m) {
    Points points;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            points.emplace_back(kUtmOrigin_m + Eigen::Vector3d(step_m * static_cast<double>(column),
                                                               step_m * static_cast<double>(row), 0.0));
        }
    }
    return points;
}

TEST(DelaunayTriangles, AreThoseOfCgal) {
    EXPECT_EQ(ours(test::randomPoints(3, 10.0, 1)).size(), 1U);
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Points points = test::randomPoints(3000, 200.0, seed, kUtmOrigin_m);
        EXPECT_EQ(ours(points), ofPeer(points)) << seed;
    }
}

TEST(DelaunayTriangles, TellPointsOnOneCircleApartAsCgalDoes) {
    for (const double step_m : {1.0, 0.1}) {  // tenths of a metre are not on one circle to the last bit
        const Points points = grid(23, 17, step_m);
        EXPECT_EQ(ours(points), ofPeer(points)) << step_m;
    }
    // Whole-number points on circles of radius 25, 65 and 325 about one centre, and the centre.
    Points circle{kUtmOrigin_m};
    for (int x = -325; x <= 325; ++x) {
        for (int y = -325; y <= 325; ++y) {
            const int square = x * x + y * y;
            if (square == 625 || square == 4225 || square == 105625) {
                circle.push_back(kUtmOrigin_m + Eigen::Vector3d(x, y, 0.0));
            }
        }
    }
    ASSERT_GT(circle.size(), 100U);
    EXPECT_EQ(ours(circle), ofPeer(circle));
}

TEST(DelaunayTriangles, HoldOnStraightHullsAndLines) {
    // Two lines of a walk, far apart, and one point off a line that holds all others.
    Points lines = grid(200, 2, 1.0);
    for (std::size_t i = 0; i < lines.size(); ++i) lines[i].y() += i < 200 ? 0.0 : 500.0;
    EXPECT_EQ(ours(lines), ofPeer(lines));
    Points fan = grid(300, 1, 0.5);
    fan.insert(fan.begin() + 77, kUtmOrigin_m + Eigen::Vector3d(40.0, 1e-3, 0.0));
    EXPECT_EQ(ours(fan), ofPeer(fan));
    EXPECT_EQ(ours(fan).size(), 299U);
}

TEST(DelaunayTriangles, HoldForNeedlesAndClusters) {
    Points points = test::randomPoints(500, 1.0, 5);
    for (std::size_t i = 0; i < 500; ++i) {
        // A spiral whose turns come as near as rounding lets them.
        const double angle = 0.1 * static_cast<double>(i), radius = std::exp(-0.05 * static_cast<double>(i));
        points.emplace_back(1e6 + radius * std::cos(angle), -1e6 + radius * std::sin(angle), 0.0);
    }
    std::sort(points.begin(), points.end(),
              [](const auto& a, const auto& b) { return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y()); });
    points.erase(std::unique(points.begin(), points.end(),
                             [](const auto& a, const auto& b) { return a.x() == b.x() && a.y() == b.y(); }),
                 points.end());
    EXPECT_EQ(ours(points), ofPeer(points));
}

}  // namespace
}  // namespace terrawalk
