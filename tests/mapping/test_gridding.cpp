#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "mapping/delaunay_tin.hpp"
#include "mapping/gridding.hpp"
#include "tests/mapping/terrain_points.hpp"

namespace terrawalk {
namespace {

using test::kUtmOrigin_m;
using test::Points;
using test::RandomNumbers;
using testing::HasSubstr;

DelaunayTin tinOf(const Points& points, double longest_edge_m = 1e8) {
    SilentProgress progress;
    return DelaunayTin::build(points, {longest_edge_m}, progress, {}).value();
}

ElevationGrid gridOf(const TriangleMesh& mesh, const GridGeometry& geometry) {
    SilentProgress progress;
    return rasterize(mesh, geometry, progress, {}).value();
}

TriangleMesh triangleOver(double west, double south, double east, double north) {
    return {{{west, south, 1.0}, {east, south, 2.0}, {east, north, 3.0}}, {{0, 1, 2}}};
}

/// Half a unit in the last place of a float near that height.
double floatRounding(double height_m) {
    return std::abs(height_m) * 0x1p-24 + 1e-9;
}

struct Agreement {
    std::size_t with_height = 0;
    std::size_t presence_differs = 0;
    double greatest_difference_m = 0.0;  ///< beyond the rounding of a float
};
Agreement agreement(const ElevationGrid& grid, const DelaunayTin& tin) {
    Agreement result;
    for (std::size_t row = 0; row < grid.geometry.rows; ++row) {
        for (std::size_t column = 0; column < grid.geometry.columns; ++column) {
            const float height = grid.at(row, column);
            const auto expected = tin.heightAt(grid.geometry.centreX(column), grid.geometry.centreY(row));
            if (std::isnan(height) == expected.has_value()) {
                ++result.presence_differs;
            } else if (expected) {
                ++result.with_height;
                result.greatest_difference_m =
                    std::max(result.greatest_difference_m,
                             std::abs(static_cast<double>(height) - *expected) - floatRounding(*expected));
            }
        }
    }
    return result;
}

TEST(SuggestCellSize, IsTheLargestOfTheSeriesWithinHalfTheSpacing) {
    EXPECT_EQ(suggestCellSize(100.0, 100), 0.5);  // spacing 1
    EXPECT_EQ(suggestCellSize(400.0, 100), 1.0);  // 2
    EXPECT_EQ(suggestCellSize(399.0, 100), 0.5);
    EXPECT_EQ(suggestCellSize(3000.0, 6000), 0.2);     // 0.71
    EXPECT_EQ(suggestCellSize(0.01, 1), 0.05);         // 0.1
    EXPECT_EQ(suggestCellSize(1.0, 1'000'000), 0.01);  // the finest
    EXPECT_EQ(suggestCellSize(1e8, 4), 2000.0);        // 5000
}

TEST(GridCovering, SnapsToMultiplesWithoutDrift) {
    RandomNumbers random(1);
    for (int i = 0; i < 2000; ++i) {
        // Whole tenths of a metre, so that the expected corner is the double nearest to the decimal number.
        const double west_tenths = 7'450'000.0 + static_cast<double>(random.below(100'000));
        const double south_tenths = 25'650'000.0 + static_cast<double>(random.below(100'000));
        const double columns = 1.0 + static_cast<double>(random.below(50));
        const double rows = 1.0 + static_cast<double>(random.below(50));
        const auto on_edges =
            gridCovering(triangleOver(west_tenths / 10.0, south_tenths / 10.0, (west_tenths + columns) / 10.0,
                                      (south_tenths + rows) / 10.0),
                         0.1);
        const auto inside = gridCovering(
            triangleOver((west_tenths + 0.3) / 10.0, (south_tenths + 0.9) / 10.0,
                         (west_tenths + columns - 0.4) / 10.0, (south_tenths + rows - 0.01) / 10.0),
            0.1);
        ASSERT_TRUE(on_edges && inside);
        EXPECT_EQ(on_edges->west_m, west_tenths / 10.0);
        EXPECT_EQ(on_edges->north_m, (south_tenths + rows) / 10.0);
        EXPECT_EQ(on_edges->columns, static_cast<std::size_t>(columns))
            << "half-open: no column beyond the east";
        EXPECT_EQ(on_edges->rows, static_cast<std::size_t>(rows));
        EXPECT_EQ(*on_edges, *inside);
    }
}

TEST(GridCovering, HoldsTheWholeMeshForAnyCellSize) {
    for (const double cell_m : {0.01, 0.03, 0.05, 0.1, 0.2, 0.25, 0.3, 0.7, 1.0, 2.0, 5.0, 37.5}) {
        const double west = kUtmOrigin_m.x() + 1.2345, south = kUtmOrigin_m.y() + 7.8912;
        const auto geometry = gridCovering(triangleOver(west, south, west + 11.1, south + 17.3), cell_m);
        ASSERT_TRUE(geometry);
        const double east_edge = geometry->west_m + static_cast<double>(geometry->columns) * cell_m;
        const double south_edge = geometry->north_m - static_cast<double>(geometry->rows) * cell_m;
        const double rounding = 1e-6 * cell_m + 1e-9;
        EXPECT_LE(geometry->west_m, west + rounding);
        EXPECT_GT(geometry->west_m + cell_m, west - rounding);
        EXPECT_GE(east_edge, west + 11.1 - rounding);
        EXPECT_LT(east_edge - cell_m, west + 11.1 + rounding);
        EXPECT_LE(south_edge, south + rounding);
        EXPECT_GE(geometry->north_m, south + 17.3 - rounding);
        EXPECT_NEAR(std::remainder(geometry->west_m, cell_m), 0.0, 1e-8);
        EXPECT_NEAR(std::remainder(geometry->north_m, cell_m), 0.0, 1e-8);
    }
}

TEST(GridCovering, WorksAcrossZero) {
    const auto geometry = gridCovering(triangleOver(-1.2, -3.4, 2.1, -0.3), 0.5);
    ASSERT_TRUE(geometry);
    EXPECT_EQ(*geometry, (GridGeometry{-1.5, 0.0, 0.5, 8, 7}));
}

TEST(GridCovering, RefusesGridsThatAreTooLargeAndNamesOneThatIsNot) {
    const TriangleMesh mesh = triangleOver(0.0, 0.0, 10'000.0, 20'000.0);
    const auto refused = gridCovering(mesh, 0.2);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::BadData);
    EXPECT_THAT(refused.error().cure, HasSubstr("0.5 m or coarser"));
    const auto coarser = gridCovering(mesh, 0.5);
    ASSERT_TRUE(coarser);
    EXPECT_EQ(coarser->size(), 800'000'000U);
}

TEST(GridCovering, HonoursTheLimitExactly) {
    const TriangleMesh mesh = triangleOver(0.0, 0.0, 10.0, 10.0);
    EXPECT_TRUE(gridCovering(mesh, 1.0, 100));
    const auto refused = gridCovering(mesh, 1.0, 99);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().cure, HasSubstr("2 m or coarser"));
}

TEST(GridCovering, RefusesImpossibleCellsAndEmptyMeshes) {
    for (const double cell_m :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const auto refused = gridCovering(triangleOver(0.0, 0.0, 1.0, 1.0), cell_m);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    }
    EXPECT_FALSE(gridCovering(TriangleMesh{}, 1.0));
    EXPECT_FALSE(gridCovering(triangleOver(0.0, 0.0, 1e9, 1.0), 1e-12)) << "indices that no double holds";
}

TEST(Rasterize, PlaneHasNoHalfCellShift) {
    const auto plane = [](double x, double y) {
        return 40.0 + 0.5 * (x - kUtmOrigin_m.x()) - 0.3 * (y - kUtmOrigin_m.y());
    };
    Points points = test::randomPoints(500, 40.0, 2, kUtmOrigin_m);
    for (Eigen::Vector3d& point : points) {
        point.z() = plane(point.x(), point.y());
    }
    const DelaunayTin tin = tinOf(points);
    for (const double cell_m : {0.1, 0.5, 1.0}) {
        const ElevationGrid grid = gridOf(tin.mesh(), gridCovering(tin.mesh(), cell_m).value());
        std::size_t with_height = 0;
        for (std::size_t row = 0; row < grid.geometry.rows; ++row) {
            for (std::size_t column = 0; column < grid.geometry.columns; ++column) {
                if (!std::isnan(grid.at(row, column))) {
                    const double expected = plane(grid.geometry.centreX(column), grid.geometry.centreY(row));
                    ASSERT_NEAR(grid.at(row, column), expected, 1e-6 + floatRounding(expected));
                    ++with_height;
                }
            }
        }
        EXPECT_NEAR(static_cast<double>(with_height) * cell_m * cell_m, tin.area_m2(), 2.0 * 160.0 * cell_m);
    }
}

TEST(Rasterize, AgreesWithHeightAtEveryCentre) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Eigen::Vector3d origin = seed % 2 == 0 ? kUtmOrigin_m : Eigen::Vector3d(-13.0, -7.0, 0.0);
        const DelaunayTin tin =
            tinOf(test::randomPoints(30 * seed, 20.0, seed, origin), seed % 3 == 0 ? 3.0 : 1e8);
        for (const double cell_m : {0.07, 0.1, 0.5, 3.0}) {
            const ElevationGrid grid = gridOf(tin.mesh(), gridCovering(tin.mesh(), cell_m).value());
            const Agreement result = agreement(grid, tin);
            EXPECT_EQ(result.presence_differs, 0U) << seed << " " << cell_m;
            EXPECT_LE(result.greatest_difference_m, 1e-6) << seed << " " << cell_m;
            EXPECT_GT(result.with_height, 0U);
        }
    }
}

// Whole and half numbers: centres fall exactly on edges, vertices and the border.
TEST(Rasterize, AgreesWithHeightAtWhereCentresFallOnEdgesAndVertices) {
    for (const double spacing_m : {0.5, 1.0, 1.5, 2.0}) {
        for (const double offset_m : {0.0, 0.25, 0.5}) {
            const DelaunayTin tin =
                tinOf(test::regularGrid(15, 11, spacing_m, Eigen::Vector3d(offset_m, offset_m, 0.0)));
            for (const double cell_m : {0.25, 0.5, 1.0}) {
                GridGeometry geometry = gridCovering(tin.mesh(), cell_m).value();
                geometry.west_m -= cell_m;  // a frame of empty cells around it
                geometry.north_m += cell_m;
                geometry.columns += 2;
                geometry.rows += 2;
                const Agreement result = agreement(gridOf(tin.mesh(), geometry), tin);
                EXPECT_EQ(result.presence_differs, 0U) << spacing_m << " " << offset_m << " " << cell_m;
                EXPECT_LE(result.greatest_difference_m, 1e-6);
            }
        }
    }
}

// Here no coordinate is exact in binary; each vertex must fill its own cell all the same, also at the border.
TEST(Rasterize, PointsOnCellCentresFillTheirCells) {
    const Points points = test::regularGrid(60, 45, 0.1, kUtmOrigin_m + Eigen::Vector3d(0.05, 0.05, 0.0));
    const DelaunayTin tin = tinOf(points);
    const ElevationGrid grid = gridOf(tin.mesh(), gridCovering(tin.mesh(), 0.1).value());
    ASSERT_EQ(grid.geometry.columns, 60U);
    ASSERT_EQ(grid.geometry.rows, 45U);
    for (std::size_t row = 0; row < 45; ++row) {
        for (std::size_t column = 0; column < 60; ++column) {
            const double expected = points[(44 - row) * 60 + column].z();
            ASSERT_NEAR(grid.at(row, column), expected, 1e-6 + floatRounding(expected))
                << row << " " << column;
        }
    }
}

TEST(Rasterize, LeavesGapsBetweenTrianglesEmpty) {
    Points points = test::regularGrid(5, 5, 1.0);
    for (const Eigen::Vector3d& point : test::regularGrid(5, 5, 1.0, Eigen::Vector3d(20.0, 0.0, 0.0))) {
        points.push_back(point);
    }
    const DelaunayTin tin = tinOf(points, 2.0);
    const ElevationGrid grid = gridOf(tin.mesh(), gridCovering(tin.mesh(), 0.5).value());
    EXPECT_EQ(agreement(grid, tin).presence_differs, 0U);
    EXPECT_EQ(agreement(grid, tin).with_height, 2U * 8U * 8U);
}

TEST(Rasterize, WindingAndOrderOfCornersDoNotMatter) {
    const DelaunayTin tin = tinOf(test::randomPoints(200, 20.0, 3));
    const GridGeometry geometry = gridCovering(tin.mesh(), 0.1).value();
    const ElevationGrid grid = gridOf(tin.mesh(), geometry);
    TriangleMesh turned = tin.mesh();
    for (auto& triangle : turned.triangles) {
        std::swap(triangle[0], triangle[2]);
    }
    const ElevationGrid again = gridOf(turned, geometry);
    EXPECT_EQ(std::memcmp(grid.heights_m.data(), again.heights_m.data(), geometry.size() * sizeof(float)), 0);
}

TEST(Rasterize, LongSliversStayWithinTheirHeights) {
    // A fan of 4000 slivers from one point, each across all rows: also the case in which bands grow.
    TriangleMesh fan;
    fan.vertices_m.emplace_back(0.0, 0.0, 10.0);
    for (int i = 0; i <= 4000; ++i) {
        fan.vertices_m.emplace_back(0.01 * i, 500.0, i % 2 == 0 ? 0.0 : 20.0);
        if (i > 0) {
            fan.triangles.push_back({0U, static_cast<std::uint32_t>(i + 1), static_cast<std::uint32_t>(i)});
        }
    }
    const ElevationGrid grid = gridOf(fan, gridCovering(fan, 0.1).value());
    std::size_t with_height = 0;
    for (const float height : grid.heights_m) {
        if (!std::isnan(height)) {
            ++with_height;
            ASSERT_GE(height, -1e-4F);
            ASSERT_LE(height, 20.0001F);
        }
    }
    EXPECT_NEAR(static_cast<double>(with_height), 0.5 * 400.0 * 5000.0, 5000.0);
}

TEST(Rasterize, GivesTheSameBytesWithAnyNumberOfThreads) {
    const DelaunayTin tin = tinOf(test::randomPoints(20'000, 100.0, 4, kUtmOrigin_m));
    const GridGeometry geometry = gridCovering(tin.mesh(), 0.1).value();
    std::vector<ElevationGrid> grids;
    for (const std::size_t threads : {1U, 2U, 2U, 5U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        grids.push_back(gridOf(tin.mesh(), geometry));
        EXPECT_EQ(std::memcmp(grids.front().heights_m.data(), grids.back().heights_m.data(),
                              geometry.size() * sizeof(float)),
                  0);
    }
}

TEST(Rasterize, DoesNotDependOnTheOrderOfPoints) {
    Points points = test::regularGrid(40, 40, 0.5, kUtmOrigin_m);
    const DelaunayTin tin = tinOf(points);
    RandomNumbers random(5);
    test::shuffle(points, random);
    const DelaunayTin again = tinOf(points);
    const GridGeometry geometry = gridCovering(tin.mesh(), 0.2).value();
    ASSERT_EQ(geometry, gridCovering(again.mesh(), 0.2).value());
    EXPECT_EQ(std::memcmp(gridOf(tin.mesh(), geometry).heights_m.data(),
                          gridOf(again.mesh(), geometry).heights_m.data(), geometry.size() * sizeof(float)),
              0);
}

TEST(Rasterize, FillsAWindowThatIsNotThatOfTheMesh) {
    const DelaunayTin tin = tinOf(test::randomPoints(300, 20.0, 6));
    for (const GridGeometry& window :
         {GridGeometry{5.0, 12.0, 0.1, 37, 53}, GridGeometry{-10.0, 30.0, 0.5, 100, 100},
          GridGeometry{100.0, 100.0, 1.0, 5, 5}, GridGeometry{10.0, 10.0, 0.1, 1, 1}}) {
        const Agreement result = agreement(gridOf(tin.mesh(), window), tin);
        EXPECT_EQ(result.presence_differs, 0U);
        EXPECT_LE(result.greatest_difference_m, 1e-6);
    }
    EXPECT_TRUE(gridOf(tin.mesh(), GridGeometry{}).heights_m.empty());
    EXPECT_TRUE(std::isnan(gridOf({}, GridGeometry{0.0, 0.0, 1.0, 1, 1}).at(0, 0)));
}

TEST(Rasterize, StopsWhenAsked) {
    const DelaunayTin tin = tinOf(test::randomPoints(1000, 20.0, 7));
    SilentProgress progress;
    std::stop_source source;
    source.request_stop();
    const auto grid =
        rasterize(tin.mesh(), gridCovering(tin.mesh(), 0.1).value(), progress, source.get_token());
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace terrawalk
