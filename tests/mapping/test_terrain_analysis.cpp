#include <gdal_utils.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>

#include "io/gdal_support.hpp"
#include "mapping/dem_difference.hpp"
#include "mapping/drainage.hpp"
#include "mapping/profile.hpp"
#include "mapping/terrain_derivatives.hpp"
#include "mapping/weak_regions.hpp"
#include "survey/frames.hpp"

namespace terrawalk {
namespace {

ElevationGrid gridOf(std::size_t columns, std::size_t rows, double cell,
                     const std::function<double(double, double)>& height) {
    ElevationGrid grid{{0.0, cell * static_cast<double>(rows), cell, columns, rows}, {}};
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            grid.heights_m.push_back(
                static_cast<float>(height(grid.geometry.centreX(column), grid.geometry.centreY(row))));
        }
    }
    return grid;
}

ElevationGrid derived(const ElevationGrid& grid, Derivative derivative,
                      const DerivativeOptions& options = {}) {
    SilentProgress silent;
    auto result = derivativeOf(grid, derivative, options, silent, {});
    EXPECT_TRUE(result);
    return *result;
}

TEST(TerrainDerivatives, OfAPlaneAreExact) {
    const ElevationGrid plane = gridOf(9, 7, 0.5, [](double x, double y) { return 0.3 * x - 0.4 * y; });
    const double level_deg = degrees(std::atan(0.5));
    for (std::size_t row = 1; row < 6; ++row) {
        for (std::size_t column = 1; column < 8; ++column) {
            EXPECT_NEAR(derived(plane, Derivative::Slope).at(row, column), level_deg, 1e-4);
            EXPECT_NEAR(derived(plane, Derivative::Slope, {SlopeUnit::Percent, {}}).at(row, column), 50.0,
                        2e-4);
            // Down is west and north: atan2(-0.3, 0.4).
            EXPECT_NEAR(derived(plane, Derivative::Aspect).at(row, column),
                        360.0 - degrees(std::atan2(0.3, 0.4)), 2e-4);
            EXPECT_NEAR(derived(plane, Derivative::Curvature).at(row, column), 0.0, 8e-6);
            EXPECT_NEAR(derived(plane, Derivative::Roughness).at(row, column), 0.7, 1e-6);
        }
    }
    EXPECT_TRUE(std::isnan(derived(plane, Derivative::Slope).at(0, 3)));
    const ElevationGrid flat = gridOf(3, 3, 1.0, [](double, double) { return 5.0; });
    EXPECT_TRUE(std::isnan(derived(flat, Derivative::Aspect).at(1, 1)));
    EXPECT_TRUE(std::isnan(derived(flat, Derivative::PlanCurvature).at(1, 1)));
    EXPECT_EQ(derived(flat, Derivative::Slope).at(1, 1), 0.0F);
    EXPECT_EQ(derived(flat, Derivative::Hillshade).at(1, 1), std::round(1.0F + 254.0F * std::sqrt(0.5F)));
}

TEST(TerrainDerivatives, CurvatureOfAQuadraticIsExact) {
    const double a = -0.02, b = 0.05, c = 0.03;  // z = a x^2 / 2 + b y^2 / 2 + c x y
    const ElevationGrid hill =
        gridOf(9, 9, 2.0, [&](double x, double y) { return 0.5 * a * x * x + 0.5 * b * y * y + c * x * y; });
    const auto total = derived(hill, Derivative::Curvature);
    const auto along = derived(hill, Derivative::ProfileCurvature);
    const auto across = derived(hill, Derivative::PlanCurvature);
    for (std::size_t row = 1; row < 8; ++row) {
        for (std::size_t column = 1; column < 8; ++column) {
            const double x = hill.geometry.centreX(column), y = hill.geometry.centreY(row);
            const double p = a * x + c * y, q = b * y + c * x, g = p * p + q * q;
            EXPECT_NEAR(total.at(row, column), -(a + b), 1e-5);
            EXPECT_NEAR(along.at(row, column), -(a * p * p + b * q * q + 2 * c * p * q) / g, 1e-5);
            EXPECT_NEAR(across.at(row, column), -(a * q * q + b * p * p - 2 * c * p * q) / g, 1e-5);
        }
    }
    const ElevationGrid dome = gridOf(5, 5, 1.0, [](double x, double y) { return -(x * x + y * y); });
    EXPECT_GT(derived(dome, Derivative::Curvature).at(2, 2), 0.0F) << "convex ground counts as positive";
}

/// What gdaldem makes of the same heights.
std::vector<float> gdaldem(const ElevationGrid& grid, const char* processing) {
    GDALAllRegister();
    const auto columns = static_cast<int>(grid.geometry.columns), rows = static_cast<int>(grid.geometry.rows);
    GdalDataset source(
        GetGDALDriverManager()->GetDriverByName("MEM")->Create("", columns, rows, 1, GDT_Float32, nullptr));
    std::array<double, 6> transform{
        grid.geometry.west_m, grid.geometry.cell_m, 0.0, grid.geometry.north_m, 0.0, -grid.geometry.cell_m};
    source->SetGeoTransform(transform.data());
    source->GetRasterBand(1)->SetNoDataValue(-9999.0);
    std::vector<float> heights = grid.heights_m;
    for (float& height : heights) {
        if (std::isnan(height)) height = -9999.0F;
    }
    EXPECT_EQ(source->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, columns, rows, heights.data(), columns, rows,
                                                 GDT_Float32, 0, 0, nullptr),
              CE_None);
    std::array<char*, 3> arguments{const_cast<char*>("-of"), const_cast<char*>("MEM"), nullptr};
    GDALDEMProcessingOptions* const options = GDALDEMProcessingOptionsNew(arguments.data(), nullptr);
    GdalDataset made(GDALDataset::FromHandle(
        GDALDEMProcessing("", GDALDataset::ToHandle(source.get()), processing, nullptr, options, nullptr)));
    GDALDEMProcessingOptionsFree(options);
    std::vector<float> values(grid.geometry.size(), kNoHeight);
    EXPECT_NE(made, nullptr);
    if (!made) return values;
    EXPECT_EQ(made->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, columns, rows, values.data(), columns, rows,
                                               GDT_Float32, 0, 0, nullptr),
              CE_None);
    const auto no_data = static_cast<float>(made->GetRasterBand(1)->GetNoDataValue());
    for (float& value : values) {
        if (value == no_data) value = kNoHeight;
    }
    return values;
}

TEST(TerrainDerivatives, AgreeWithGdaldem) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, 0.2);
    ElevationGrid grid = gridOf(60, 50, 0.5, [&](double x, double y) {
        return 40.0 + 2.0 * std::sin(x / 3.0) + std::cos(y / 2.0) + noise(random);
    });
    for (std::size_t i = 0; i < grid.heights_m.size(); i += 97) grid.heights_m[i] = kNoHeight;
    struct Case {
        Derivative derivative;
        const char* name;
        double tolerance;
    };
    // gdaldem works in floats: gradients near 1 from heights near 40 are off by some 1e-5. Its hillshade is
    // rounded by truncation of the sum with a half.
    for (const Case& c :
         {Case{Derivative::Slope, "slope", 2e-3}, Case{Derivative::Aspect, "aspect", 0.05},
          Case{Derivative::Hillshade, "hillshade", 1.0}, Case{Derivative::Roughness, "roughness", 1e-5}}) {
        const auto ours = derived(grid, c.derivative);
        const auto theirs = gdaldem(grid, c.name);
        std::size_t compared = 0;
        for (std::size_t i = 0; i < theirs.size(); ++i) {
            ASSERT_EQ(std::isnan(ours.heights_m[i]), std::isnan(theirs[i])) << c.name << " " << i;
            if (std::isnan(theirs[i])) continue;
            const double d = ours.heights_m[i] - theirs[i];
            EXPECT_LE(std::abs(c.derivative == Derivative::Aspect ? std::remainder(d, 360.0) : d),
                      c.tolerance)
                << c.name;
            ++compared;
        }
        EXPECT_GT(compared, 2000U);
    }
}

TEST(TerrainDerivatives, AreTheSameWithAnyNumberOfThreads) {
    const ElevationGrid grid =
        gridOf(70, 90, 1.0, [](double x, double y) { return std::sin(x) * std::cos(y); });
    for (const auto& [derivative, text] : kDerivatives) {
        const auto many = derived(grid, derivative);
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        const auto serial = derived(grid, derivative);
        EXPECT_EQ(std::memcmp(many.heights_m.data(), serial.heights_m.data(), 4 * many.heights_m.size()), 0)
            << text;
    }
}

Drainage drained(const ElevationGrid& grid) {
    SilentProgress silent;
    auto result = drainageOf(grid, {FlowRouting::D8, FlowRouting::DInfinity}, silent, {});
    EXPECT_TRUE(result);
    return std::move(*result);
}

TEST(Drainage, OfAPlaneGathersDownTheSlope) {
    const ElevationGrid plane = gridOf(12, 8, 0.5, [](double x, double) { return 2.0 * x; });
    const Drainage water = drained(plane);
    for (std::size_t row = 0; row < 8; ++row) {
        for (std::size_t column = 0; column < 12; ++column) {
            for (const ElevationGrid& area : water.accumulations) {
                EXPECT_FLOAT_EQ(area.at(row, column), 0.25F * static_cast<float>(12 - column));
            }
            EXPECT_EQ(water.wet_depth.at(row, column), 0.0F);
        }
    }
}

TEST(Drainage, ABowlFillsToItsLowestRim) {
    const ElevationGrid bowl = gridOf(21, 21, 1.0, [](double x, double y) {
        return std::hypot(x - 10.5, y - 10.5) + (y < 1.0 ? -0.5 : 0.0);
    });
    double spill = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 21; ++i) {
        for (const float rim : {bowl.at(0, i), bowl.at(20, i), bowl.at(i, 0), bowl.at(i, 20)}) {
            spill = std::min(spill, double{rim});
        }
    }
    const Drainage water = drained(bowl);
    float greatest = 0.0F;
    for (std::size_t row = 1; row < 20; ++row) {
        for (std::size_t column = 1; column < 20; ++column) {
            const double height = bowl.at(row, column);
            EXPECT_NEAR(water.wet_depth.at(row, column), std::max(0.0, spill - height), 1e-5);
        }
    }
    for (const float area : water.accumulations[0].heights_m) greatest = std::max(greatest, area);
    EXPECT_GT(greatest, 0.5F * 21 * 21) << "the bowl leaves through one cell";
}

/// Planchon and Darboux 2001, the slow and plain way: lower a flood step by step until nothing moves.
std::vector<double> filledSlowly(const ElevationGrid& grid) {
    const auto rows = static_cast<std::ptrdiff_t>(grid.geometry.rows);
    const auto columns = static_cast<std::ptrdiff_t>(grid.geometry.columns);
    const auto at = [&](std::ptrdiff_t r, std::ptrdiff_t c) {
        return r < 0 || c < 0 || r >= rows || c >= columns
                   ? std::nan("")
                   : double{grid.at(static_cast<std::size_t>(r), static_cast<std::size_t>(c))};
    };
    std::vector<double> water(grid.heights_m.size(), 1e9);
    for (bool moved = true; moved;) {
        moved = false;
        for (std::ptrdiff_t r = 0; r < rows; ++r) {
            for (std::ptrdiff_t c = 0; c < columns; ++c) {
                double& here = water[static_cast<std::size_t>(r * columns + c)];
                double lowest = 1e9;
                for (std::ptrdiff_t i = 0; i < 9; ++i) {
                    const std::ptrdiff_t nr = r + i / 3 - 1, nc = c + i % 3 - 1;
                    if (i == 4) continue;
                    lowest = std::min(lowest, std::isnan(at(nr, nc))
                                                  ? -1e9
                                                  : water[static_cast<std::size_t>(nr * columns + nc)]);
                }
                const double level = std::max(at(r, c), lowest);
                if (level < here) {
                    here = level;
                    moved = true;
                }
            }
        }
    }
    return water;
}

TEST(Drainage, FillsAsTheSlowMethodDoesAndLosesNoWater) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> noise(0.0, 1.0);
    ElevationGrid grid =
        gridOf(30, 26, 1.0, [&](double x, double y) { return 0.02 * x + 0.01 * y + noise(random); });
    for (std::size_t i = 5; i < grid.heights_m.size(); i += 83) grid.heights_m[i] = kNoHeight;
    const Drainage water = drained(grid);
    const std::vector<double> slow = filledSlowly(grid);
    double known = 0.0, greatest = 0.0;
    for (std::size_t i = 0; i < grid.heights_m.size(); ++i) {
        ASSERT_EQ(std::isnan(water.wet_depth.heights_m[i]), std::isnan(grid.heights_m[i]));
        if (std::isnan(grid.heights_m[i])) continue;
        EXPECT_NEAR(water.wet_depth.heights_m[i], slow[i] - grid.heights_m[i], 1e-6);
        EXPECT_GE(water.accumulations[0].heights_m[i], 1.0F);
        known += 1.0;
        greatest = std::max(greatest, double{water.accumulations[0].heights_m[i]});
    }
    EXPECT_LE(greatest, known);
    EXPECT_GT(greatest, 10.0);
}

TEST(Drainage, WaterOfAFlatLeavesIt) {
    ElevationGrid flat = gridOf(15, 15, 1.0, [](double, double) { return 3.0; });
    flat.heights_m[7 * 15 + 7] = 2.0F;  // a pit in the middle
    const Drainage water = drained(flat);
    EXPECT_FLOAT_EQ(water.wet_depth.at(7, 7), 1.0F);
    // The 56 cells of the edge drain to the outside: together they hold every cell.
    double out = 0.0;
    for (std::size_t i = 0; i < 15; ++i) {
        out += water.accumulations[0].at(0, i) + water.accumulations[0].at(14, i);
        if (i > 0 && i < 14) out += water.accumulations[0].at(i, 0) + water.accumulations[0].at(i, 14);
    }
    EXPECT_DOUBLE_EQ(out, 225.0);
}

TEST(DInfinity, SplitsWaterByTheAngleBetweenTwoNeighbours) {
    // Falls to the west by 1 and to the south by tan(a) in a cell: a / 45 degrees of the water goes
    // southwest.
    const double angle_rad = radians(20.0), part = 20.0 / 45.0;
    const ElevationGrid plane =
        gridOf(40, 40, 1.0, [&](double x, double y) { return x + std::tan(angle_rad) * y; });
    const ElevationGrid area = drained(plane).accumulations[1];
    // Along the eastern rim water comes from nowhere, in the second column from one cell, and so on.
    for (std::size_t row = 20; row < 39; ++row) {
        for (std::size_t column = 30; column < 40; ++column) {
            EXPECT_NEAR(area.at(row, column), 40.0 - static_cast<double>(column), 1e-3);
        }
    }
    // Nothing comes from the north to the first row, and only the straight part from the east.
    EXPECT_NEAR(area.at(0, 38), 1.0 + (1.0 - part), 1e-5);
    EXPECT_NEAR(area.at(0, 37), 1.0 + (1.0 - part) * (2.0 - part), 1e-5);
    EXPECT_NEAR(area.at(1, 38), 2.0, 1e-5);
}

/// Relative spread of the area on a ring about the middle, and its mean there.
std::pair<double, double> onRing(const ElevationGrid& area, double middle, double radius) {
    double n = 0.0, sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < area.heights_m.size(); ++i) {
        const double x = area.geometry.centreX(i % area.geometry.columns) - middle;
        const double y = area.geometry.centreY(i / area.geometry.columns) - middle;
        if (std::abs(std::hypot(x, y) - radius) > 2.0) continue;
        n += 1.0;
        sum += area.heights_m[i];
        squares += double{area.heights_m[i]} * area.heights_m[i];
    }
    return {std::sqrt(squares / n - sum * sum / (n * n)) / (sum / n), sum / n};
}

TEST(DInfinity, RunsOffAConeWithoutStripes) {
    const double middle = 60.5;
    const ElevationGrid cone =
        gridOf(121, 121, 1.0, [&](double x, double y) { return -std::hypot(x - middle, y - middle); });
    const Drainage water = drained(cone);
    const auto [stripes, d8_mean] = onRing(water.accumulations[0], middle, 45.0);
    const auto [spread, mean] = onRing(water.accumulations[1], middle, 45.0);
    // Over each metre of a circle runs the water of half a radius of ground. Where it runs at an angle of up
    // to 45 degrees to an axis, it crosses the cells of a column, which are a metre apart along that column:
    // the radius over two times the cosine. Its mean over the angles has the factor sin(45) / (pi / 4), its
    // spread is 0.097; the ring is 4 m wide.
    EXPECT_NEAR(mean, 22.5 * std::sin(0.25 * M_PI) / (0.25 * M_PI), 0.02 * 20.3);
    EXPECT_LT(spread, 0.12);
    EXPECT_NEAR(d8_mean, mean, 0.5 * mean) << "as much water, in stripes";
    EXPECT_GT(stripes, 3.0 * spread);
}

TEST(DInfinity, LosesNoWaterOfAFunnelOrOfRoughGround) {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> noise(0.0, 1.0);
    ElevationGrid funnel =
        gridOf(61, 61, 1.0, [](double x, double y) { return std::hypot(x - 30.5, y - 30.5); });
    funnel.heights_m[30 * 61 + 30] = kNoHeight;  // the hole that everything runs into
    const ElevationGrid area = drained(funnel).accumulations[1];
    double into_hole = 0.0;
    for (const auto& [row, column] :
         {std::pair{29, 29}, {29, 30}, {29, 31}, {30, 29}, {30, 31}, {31, 29}, {31, 30}, {31, 31}}) {
        into_hole += area.at(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
    }
    // Diagonal cells about the hole still hand their water to those that lie nearer to it.
    EXPECT_GE(into_hole, 61.0 * 61.0 - 1.0 - 1e-2);

    const ElevationGrid rough =
        gridOf(50, 50, 1.0, [&](double x, double y) { return 0.02 * x + 0.01 * y + noise(random); });
    for (const ElevationGrid& a : drained(rough).accumulations) {
        double greatest = 0.0;
        for (const float value : a.heights_m) {
            EXPECT_GE(value, 1.0F);
            greatest = std::max(greatest, double{value});
        }
        EXPECT_LE(greatest, 2500.0);
        EXPECT_GT(greatest, 50.0);
    }
}

TEST(TerrainAnalysis, StopsWhenAskedTo) {
    const ElevationGrid grid = gridOf(40, 40, 1.0, [](double x, double y) { return x * y; });
    SilentProgress silent;
    std::stop_source stop;
    stop.request_stop();
    const auto slope = derivativeOf(grid, Derivative::Slope, {}, silent, stop.get_token());
    ASSERT_FALSE(slope);
    EXPECT_EQ(slope.error().kind, ErrorKind::Cancelled);
    const auto water = drainageOf(grid, {FlowRouting::D8}, silent, stop.get_token());
    ASSERT_FALSE(water);
    EXPECT_EQ(water.error().kind, ErrorKind::Cancelled);
}

TEST(DemDifference, MarksChangeBeyondItsSigmaAlone) {
    const GridGeometry geometry{0.0, 2.0, 1.0, 3, 2};
    const ElevationGrid later{geometry, {1.0F, 1.3F, 0.6F, 1.1F, kNoHeight, 1.5F}};
    const ElevationGrid earlier{geometry, {1.0F, 1.0F, 1.0F, 1.0F, 1.0F, kNoHeight}};
    const DemDifference d = demDifference(later, earlier, {{0.1F}, 0.0, 0.0}).value();
    EXPECT_THAT(std::vector<float>(d.significance.heights_m.begin(), d.significance.heights_m.begin() + 4),
                testing::ElementsAre(0.0F, 1.0F, -1.0F, 0.0F));
    EXPECT_TRUE(std::isnan(d.significance.heights_m[4]));
    EXPECT_TRUE(std::isnan(d.change.heights_m[5]));
    EXPECT_EQ(d.raised, 1U);
    EXPECT_EQ(d.lowered, 1U);
    EXPECT_NEAR(d.all.net_m3, 0.3 - 0.4 + 0.1, 1e-6);
    EXPECT_NEAR(d.all.net_sigma_m3, 0.1 * std::sqrt(4.0), 1e-7);
    EXPECT_NEAR(d.significant.net_m3, -0.1, 1e-6);
    EXPECT_NEAR(d.significant.net_sigma_m3, 0.1 * std::sqrt(2.0), 1e-7);
    // A shared error makes every cell less sure.
    EXPECT_EQ(demDifference(later, earlier, {{0.1F}, 0.0, 0.2}).value().raised, 0U);
}

TEST(DemDifference, OneUnchangedCellInTwentyIsMarkedWrongly) {
    std::mt19937 random(17);
    std::normal_distribution<double> noise(0.0, 0.05);
    const ElevationGrid earlier = gridOf(200, 200, 1.0, [&](double, double) { return noise(random); });
    const ElevationGrid later = gridOf(200, 200, 1.0, [&](double, double) { return noise(random); });
    const auto d =
        demDifference(later, earlier, {{static_cast<float>(std::sqrt(2.0) * 0.05)}, 0.0, 0.0}).value();
    // 5 % of 40000, four sigma of a binomial wide.
    EXPECT_NEAR(static_cast<double>(d.raised + d.lowered), 2000.0, 4.0 * std::sqrt(40000 * 0.05 * 0.95));
}

TEST(Profile, FollowsAPlaneAndTellsItsGaps) {
    ElevationGrid plane = gridOf(20, 20, 1.0, [](double x, double y) { return 0.5 * x + 0.25 * y; });
    const ElevationGrid sigmas = gridOf(20, 20, 1.0, [](double x, double) { return 0.01 * x; });
    const std::vector<Eigen::Vector2d> line{{2.0, 2.0}, {12.0, 2.0}, {12.0, 9.5}};
    const auto profile = profileAlong(plane, &sigmas, line, 0.7);
    EXPECT_EQ(profile.front().at, line.front());
    EXPECT_EQ(profile.back().at, line.back());
    EXPECT_DOUBLE_EQ(profile.back().distance, 17.5);
    bool corner = false;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const ProfilePoint& p = profile[i];
        ASSERT_TRUE(p.height);
        EXPECT_NEAR(*p.height, 0.5 * p.at.x() + 0.25 * p.at.y(), 2e-6);
        EXPECT_NEAR(p.sigma.value(), 0.01 * p.at.x(), 1e-7);
        EXPECT_LE(p.distance, i == 0 ? 0.0 : profile[i - 1].distance + 0.7 + 1e-12);
        corner = corner || p.at == line[1];
    }
    EXPECT_TRUE(corner);
    plane.heights_m[17 * 20 + 6] = kNoHeight;
    const auto gap = profileAlong(plane, nullptr, line, 0.5);
    EXPECT_TRUE(std::any_of(gap.begin(), gap.end(), [](const ProfilePoint& p) { return !p.height; }));
    EXPECT_FALSE(bilinearAt(plane, {0.2, 5.0})) << "outside the outer cell centres";
    EXPECT_TRUE(bilinearAt(plane, {0.5, 19.5}));
    EXPECT_NEAR(*bilinearAt(plane, {19.5, 0.5}), 9.875, 1e-6);
}

TEST(Profile, TellsWhereAMarkStandsBesideTheLine) {
    const std::vector<Eigen::Vector2d> line{{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}};
    const LineOffset left = offsetFrom(line, {4.0, 1.5});
    EXPECT_DOUBLE_EQ(left.distance, 4.0);
    EXPECT_DOUBLE_EQ(left.offset, 1.5);
    const LineOffset right = offsetFrom(line, {12.0, 6.0});
    EXPECT_DOUBLE_EQ(right.distance, 16.0);
    EXPECT_DOUBLE_EQ(right.offset, -2.0);
    EXPECT_DOUBLE_EQ(offsetFrom(line, {-3.0, 4.0}).offset, 5.0);
}

TEST(WeakRegions, AreRankedByWhatAWalkWouldGain) {
    ElevationGrid sigmas = gridOf(20, 10, 2.0, [](double, double) { return 0.05; });
    const auto set = [&](std::size_t row, std::size_t column, float sigma) {
        sigmas.heights_m[row * 20 + column] = sigma;
    };
    for (std::size_t i = 0; i < 6; ++i) set(2, 3 + i, 0.2F);   // long and fairly bad
    for (std::size_t i = 0; i < 4; ++i) set(6, 10 + i, 0.5F);  // short and very bad
    set(7, 14, 0.5F);                                          // touches by a corner only
    set(0, 0, kNoHeight);
    const WeakRegions found = weakRegions(sigmas, {0.1, 5.0});
    ASSERT_EQ(found.regions.size(), 2U);
    EXPECT_EQ(found.regions[0].cells, 4U);
    EXPECT_NEAR(found.regions[0].gain, 4 * 4.0 * (0.25 - 0.01), 1e-6);
    EXPECT_EQ(found.regions[1].cells, 6U);
    EXPECT_NEAR(found.regions[1].mean_sigma, 0.2, 1e-7);
    EXPECT_EQ(found.labels[6 * 20 + 10], 1);
    EXPECT_EQ(found.labels[2 * 20 + 3], 2);
    EXPECT_EQ(found.labels[7 * 20 + 14], 0) << "too small";
    EXPECT_EQ(found.labels[0], 0);
    EXPECT_EQ(weakRegions(sigmas, {0.1, 0.0}).regions.size(), 3U);
    EXPECT_TRUE(weakRegions(sigmas, {0.6, 0.0}).regions.empty());
}

}  // namespace
}  // namespace terrawalk
