#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "mapping/contours.hpp"

namespace terrawalk {
namespace {

using Eigen::Vector2d;

ElevationGrid gridOf(std::size_t columns, std::size_t rows, double cell, double west, double north,
                     const std::function<double(double, double)>& height) {
    ElevationGrid grid{{west, north, cell, columns, rows}, {}};
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            grid.heights_m.push_back(
                static_cast<float>(height(grid.geometry.centreX(column), grid.geometry.centreY(row))));
        }
    }
    return grid;
}

std::vector<Contour> contoursOf(const ElevationGrid& grid, const ContourOptions& options) {
    SilentProgress silent;
    auto set = contourLines(grid, options, silent, {});
    EXPECT_TRUE(set);
    return set ? std::move(set->contours) : std::vector<Contour>{};
}

double side(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
    return ((b - a).x() * (p - a).y() - (b - a).y() * (p - a).x()) / std::max((b - a).norm(), 1e-300);
}

/// How deep two pieces reach through each other: the least distance of their four ends from the other's line,
/// where all lie on opposite sides.
double crossingDepth(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
    const double s1 = side(a, b, c), s2 = side(a, b, d), s3 = side(c, d, a), s4 = side(c, d, b);
    if (!(s1 * s2 < 0.0) || !(s3 * s4 < 0.0)) return 0.0;
    return std::min({std::abs(s1), std::abs(s2), std::abs(s3), std::abs(s4)});
}

/// The deepest crossing of any two contours, found in buckets of a cell.
double deepestCrossing(const std::vector<Contour>& contours, const GridGeometry& g) {
    struct Piece {
        Vector2d a, b;
    };
    std::map<std::pair<long, long>, std::vector<Piece>> buckets;
    for (const Contour& contour : contours) {
        for (std::size_t i = 0; i + 1 < contour.vertices.size(); ++i) {
            const Piece piece{contour.vertices[i], contour.vertices[i + 1]};
            std::set<std::pair<long, long>> touched;
            for (const Vector2d& end : {piece.a, piece.b}) {
                const long x = std::lround((end.x() - g.west_m) / g.cell_m * 4);
                const long y = std::lround((g.north_m - end.y()) / g.cell_m * 4);
                for (long dx = -1; dx <= 1; ++dx) {
                    for (long dy = -1; dy <= 1; ++dy) touched.insert({x + dx, y + dy});
                }
            }
            for (const auto& key : touched) buckets[key].push_back(piece);
        }
    }
    double deepest = 0.0;
    for (const auto& [key, pieces] : buckets) {
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            for (std::size_t k = i + 1; k < pieces.size(); ++k) {
                deepest =
                    std::max(deepest, crossingDepth(pieces[i].a, pieces[i].b, pieces[k].a, pieces[k].b));
            }
        }
    }
    return deepest;
}

class RandomTerrain : public testing::TestWithParam<unsigned> {};

// White noise and terraces are as rough as ground can be; half of the surveys lie at UTM coordinates, where a
// double steps by 5e-10 m.
TEST_P(RandomTerrain, ContoursNeverCross) {
    std::mt19937 random(GetParam());
    std::uniform_real_distribution<double> noise(-1.0, 1.0), share(0.0, 1.0);
    const bool utm = GetParam() % 2 == 1;
    const ElevationGrid grid =
        gridOf(16, 14, 0.5, utm ? 745000.0 : 0.0, utm ? 2565000.0 : 0.0, [&](double x, double) {
            const double terrace = 2.0 * std::floor((x - (utm ? 745000.0 : 0.0)) / 3.0);
            if (share(random) < 0.05) return std::nan("");
            return terrace + noise(random);
        });
    ContourOptions options;
    options.interval = 0.1;
    options.smoothing_cells = GetParam() % 3 == 0 ? 0.0 : 0.8;
    const auto contours = contoursOf(grid, options);
    ASSERT_GT(contours.size(), 20U);
    EXPECT_LE(deepestCrossing(contours, grid.geometry), utm ? 2e-9 : 1e-14);
    // The test itself sees a crossing where there is one.
    std::vector<Contour> shifted = contours;
    for (const Contour& contour : contours) {
        shifted.push_back(contour);
        for (Vector2d& vertex : shifted.back().vertices) vertex.x() += 0.02;
    }
    EXPECT_GT(deepestCrossing(shifted, grid.geometry), 1e-4);
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomTerrain, testing::Range(1U, 9U));

TEST(Contours, OfAConeAreCirclesWithHighGroundToTheLeft) {
    const ElevationGrid grid =
        gridOf(81, 81, 0.5, -20.25, 20.25, [](double x, double y) { return 30.0 - std::hypot(x, y); });
    ContourOptions options;
    options.interval = 3.0;
    options.smoothing_cells = 0.0;
    const auto contours = contoursOf(grid, options);
    std::size_t rings = 0;
    for (const Contour& contour : contours) {
        const double radius = 30.0 - contour.level;
        EXPECT_EQ(contour.is_index, std::fmod(contour.level, 15.0) == 0.0);
        if (radius < 2.0 || radius > 19.0) continue;
        ++rings;
        EXPECT_TRUE(contour.closed);
        EXPECT_EQ(contour.vertices.front(), contour.vertices.back());
        double twice_area = 0.0;
        for (std::size_t i = 0; i + 1 < contour.vertices.size(); ++i) {
            const Vector2d& a = contour.vertices[i];
            const Vector2d& b = contour.vertices[i + 1];
            twice_area += a.x() * b.y() - a.y() * b.x();
            // Fourth-order interpolation of r with f'''' below 3 / r^3 at a step of half a metre.
            EXPECT_NEAR(a.norm(), radius, 0.02);
        }
        EXPECT_GT(twice_area, 0.0) << "counter-clockwise about the top";
    }
    EXPECT_EQ(rings, 6U);
}

TEST(Contours, LeaveOutWhereHeightsAreMissingAndKeepTheLevelsOfAPlane) {
    ElevationGrid grid =
        gridOf(30, 20, 1.0, 0.0, 20.0, [](double x, double y) { return 0.25 * x + 0.1 * y; });
    for (std::size_t row = 5; row < 12; ++row) grid.heights_m[row * 30 + 14] = kNoHeight;
    ContourOptions options;
    options.interval = 0.5;
    options.base = 0.05;
    options.smoothing_cells = 0.0;
    const auto contours = contoursOf(grid, options);
    ASSERT_FALSE(contours.empty());
    for (const Contour& contour : contours) {
        EXPECT_NEAR(std::remainder(contour.level - 0.05, 0.5), 0.0, 1e-12);
        for (const Vector2d& v : contour.vertices) {
            // Floats near 7 step by 5e-7; the slope is a quarter.
            EXPECT_NEAR(0.25 * v.x() + 0.1 * v.y(), contour.level, 2e-6);
            const bool beside_hole =
                v.x() > 13.5 + 1e-9 && v.x() < 15.5 - 1e-9 && v.y() < 15.5 - 1e-9 && v.y() > 7.5 + 1e-9;
            EXPECT_FALSE(beside_hole) << v.transpose();
        }
    }
}

TEST(Contours, AreTheSameWithAnyNumberOfThreads) {
    std::mt19937 random(5);
    std::normal_distribution<double> noise;
    const ElevationGrid grid = gridOf(60, 70, 0.5, 0, 0, [&](double x, double y) {
        return 3 * std::sin(x / 5) * std::cos(y / 7) + 0.2 * noise(random);
    });
    ContourOptions options;
    options.interval = 0.25;
    const auto many = contoursOf(grid, options);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto serial = contoursOf(grid, options);
    ASSERT_EQ(many.size(), serial.size());
    for (std::size_t i = 0; i < many.size(); ++i) {
        EXPECT_EQ(many[i].level, serial[i].level);
        ASSERT_EQ(many[i].vertices, serial[i].vertices);
    }
}

// A terrace wall of a metre between two level treads that carry noise about a level.
TEST(Contours, OnLevelGroundFollowNoNoiseWithinTheStandardErrors) {
    std::mt19937 random(11);
    std::normal_distribution<double> noise(0.0, 0.02);
    const ElevationGrid grid = gridOf(
        80, 60, 0.5, 0, 30, [&](double x, double) { return (x < 20.0 ? 1.01 : 2.01) + noise(random); });
    const ElevationGrid sigmas = gridOf(80, 60, 0.5, 0, 30, [](double, double) { return 0.03; });
    const auto lengthAt = [](const std::vector<Contour>& contours, double level) {
        double length = 0.0;
        for (const Contour& contour : contours) {
            if (std::abs(contour.level - level) > 1e-9) continue;
            for (std::size_t i = 0; i + 1 < contour.vertices.size(); ++i) {
                length += (contour.vertices[i + 1] - contour.vertices[i]).norm();
            }
        }
        return length;
    };
    ContourOptions options;
    options.interval = 0.25;
    const auto plain = contoursOf(grid, options);
    options.sigmas = &sigmas;
    const auto within = contoursOf(grid, options);
    EXPECT_LT(lengthAt(within, 1.0), 0.25 * lengthAt(plain, 1.0));
    EXPECT_LE(deepestCrossing(within, grid.geometry), 0.0);
    // Along the wall a line for each level, in its place.
    EXPECT_NEAR(lengthAt(within, 1.5), 29.5, 0.5);
    for (const Contour& contour : within) {
        if (contour.level != 1.5) continue;
        for (const Vector2d& vertex : contour.vertices) EXPECT_NEAR(vertex.x(), 20.0, 0.1);
    }
    options.smoothing_cells = 0.0;
    EXPECT_EQ(lengthAt(contoursOf(grid, options), 1.0),
              lengthAt(contoursOf(grid, {.interval = 0.25, .smoothing_cells = 0.0}), 1.0));
}

TEST(Contours, RefuseWhatMakesNoSense) {
    SilentProgress silent;
    const ElevationGrid grid = gridOf(3, 3, 1, 0, 3, [](double x, double) { return 1000 * x; });
    EXPECT_FALSE(contourLines(grid, {.interval = 0.0}, silent, {}));
    EXPECT_FALSE(contourLines(grid, {.interval = -1.0}, silent, {}));
    const auto many = contourLines(grid, {.interval = 1e-3}, silent, {});
    ASSERT_FALSE(many);
    EXPECT_EQ(many.error().kind, ErrorKind::Usage);
    std::stop_source stop;
    stop.request_stop();
    const auto stopped = contourLines(grid, {.interval = 1.0}, silent, stop.get_token());
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::Cancelled);
    EXPECT_TRUE(contoursOf(gridOf(1, 9, 1, 0, 9, [](double, double y) { return y; }), {}).empty());
    EXPECT_TRUE(contoursOf(gridOf(4, 4, 1, 0, 4, [](double, double) { return 2.0; }), {}).empty());
}

TEST(GaussianSmoothed, KeepsPlanesInsideAndGapsAsTheyAre) {
    ElevationGrid grid = gridOf(40, 30, 1, 0, 30, [](double x, double y) { return 0.5 * x - 0.25 * y; });
    const ElevationGrid smooth = *gaussianSmoothed(grid, 1.5);
    for (std::size_t row = 5; row < 25; ++row) {
        for (std::size_t column = 5; column < 35; ++column) {
            EXPECT_NEAR(smooth.at(row, column), grid.at(row, column), 1e-5);
        }
    }
    grid.heights_m[7] = kNoHeight;
    EXPECT_TRUE(std::isnan(gaussianSmoothed(grid, 1.5)->heights_m[7]));
    EXPECT_FALSE(std::isnan(gaussianSmoothed(grid, 1.5)->heights_m[8]));
}

}  // namespace
}  // namespace terrawalk
