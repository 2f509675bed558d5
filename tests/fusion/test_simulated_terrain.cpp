#include "fusion/simulated_terrain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fusion/simulated_walk.hpp"

namespace terrawalk {
namespace {

class EveryTerrain : public testing::TestWithParam<SimulatedTerrain> {};
INSTANTIATE_TEST_SUITE_P(Kinds, EveryTerrain,
                         testing::Values(SimulatedTerrain::TerracedOrchard, SimulatedTerrain::Gully,
                                         SimulatedTerrain::Plain, SimulatedTerrain::Ridge,
                                         SimulatedTerrain::Ramp),
                         [](const testing::TestParamInfo<SimulatedTerrain>& kind) {
                             return "Kind" + std::to_string(static_cast<int>(kind.param));
                         });

TEST_P(EveryTerrain, IsExactlyZeroAtTheZeroPoint) {
    for (const std::uint64_t seed : {1U, 2U, 99U})
        EXPECT_EQ(TerrainModel(GetParam(), seed).height_m(0.0, 0.0), 0.0);
}

TEST_P(EveryTerrain, IsContinuousAndNowhereSteeperThanAFootCanStand) {
    const TerrainModel terrain(GetParam(), 3);
    constexpr double kStep_m = 0.01;
    for (double n_m = -15.0; n_m < 55.0; n_m += 0.7) {
        for (double e_m = -30.0; e_m < 30.0; e_m += 0.7) {
            const double here_m = terrain.height_m(e_m, n_m);
            ASSERT_TRUE(std::isfinite(here_m));
            // Risers are steepest: 1.16 m over 0.9 m, 1.875 times as steep in the middle, and the bend on
            // top.
            ASSERT_LT(std::abs(terrain.height_m(e_m, n_m + kStep_m) - here_m), 2.8 * kStep_m);
            ASSERT_LT(std::abs(terrain.height_m(e_m + kStep_m, n_m) - here_m), 1.5 * kStep_m);
        }
    }
}

TEST_P(EveryTerrain, IsDefinedFarFromTheSite) {
    const TerrainModel terrain(GetParam(), 3);
    EXPECT_TRUE(std::isfinite(terrain.height_m(1e6, -1e6)));
}

TEST(SimulatedTerrain, RampIsAPlane) {
    const TerrainModel ramp(SimulatedTerrain::Ramp, 5);
    for (double n_m = -40.0; n_m <= 40.0; n_m += 3.7) {
        for (double e_m = -40.0; e_m <= 40.0; e_m += 3.7)
            EXPECT_NEAR(ramp.height_m(e_m, n_m), 0.10 * e_m + 0.05 * n_m, 1e-14);
    }
}

TEST(SimulatedTerrain, TerracesClimbByAboutAMetreAndAreNearlyLevel) {
    const TerrainModel terrain(SimulatedTerrain::TerracedOrchard, 1);
    for (const double e_m : {-20.0, 0.0, 17.0}) {
        double last_m = 0.0;
        int treads = 0;
        bool on_tread = false;
        double tread_begins_m = 0.0;
        for (double n_m = -10.0; n_m < 50.0; n_m += 0.05) {
            const bool steep = terrain.slope(e_m, n_m) > 0.4;
            if (steep && on_tread && n_m - tread_begins_m > 3.0) {
                const double tread_m = terrain.height_m(e_m, 0.5 * (n_m + tread_begins_m));
                if (treads > 0) {
                    EXPECT_GT(tread_m - last_m, 0.6);
                    EXPECT_LT(tread_m - last_m, 1.4);
                }
                last_m = tread_m;
                ++treads;
            }
            if (!steep && !on_tread) tread_begins_m = n_m;
            on_tread = !steep;
        }
        EXPECT_GE(treads, 8) << "60 m hold ten terraces of 6 m";
    }
}

TEST(SimulatedTerrain, DiffersFromSeedToSeed) {
    const TerrainModel one(SimulatedTerrain::Plain, 1);
    const TerrainModel other(SimulatedTerrain::Plain, 2);
    EXPECT_NE(one.height_m(12.3, 4.5), other.height_m(12.3, 4.5));
}

TEST(ValueNoise, StaysBetweenItsBoundsAndVaries) {
    double least = 1.0;
    double greatest = -1.0;
    double sum = 0.0;
    int n = 0;
    for (double y = -50.0; y < 50.0; y += 0.37) {
        for (double x = -50.0; x < 50.0; x += 0.37) {
            const double value = valueNoise(x, y, 8);
            least = std::min(least, value);
            greatest = std::max(greatest, value);
            sum += value;
            ++n;
        }
    }
    EXPECT_GE(least, -1.0);
    EXPECT_LE(greatest, 1.0);
    EXPECT_LT(least, -0.9);
    EXPECT_GT(greatest, 0.9);
    // 10000 lattice values of variance 1/3 decide the mean.
    EXPECT_NEAR(sum / n, 0.0, 4.0 * std::sqrt(1.0 / 3.0 / 10000.0));
}

TEST(DistanceToGround, MeetsThePlaneWhereGeometrySays) {
    const TerrainModel ramp(SimulatedTerrain::Ramp, 1);
    const Eigen::Vector3d origin_m(3.0, -7.0, 2.0);
    const Eigen::Vector3d normal(-0.10, -0.05, 1.0);  // the plane holds ZERO
    for (const Eigen::Vector3d& toward : {Eigen::Vector3d(0.0, 0.0, -1.0), Eigen::Vector3d(0.2, 0.1, -1.0),
                                          Eigen::Vector3d(-0.3, 0.25, -1.0)}) {
        const Eigen::Vector3d direction = toward.normalized();
        EXPECT_NEAR(distanceToGround_m(ramp, origin_m, direction, 12.0),
                    -normal.dot(origin_m) / normal.dot(direction), 1e-10);
    }
}

TEST(DistanceToGround, IsInfiniteBeyondReach) {
    const TerrainModel ramp(SimulatedTerrain::Ramp, 1);
    EXPECT_TRUE(std::isinf(distanceToGround_m(ramp, {0.0, 0.0, 30.0}, {0.0, 0.0, -1.0}, 12.0)));
}

TEST(SmoothPath, StartsAndEndsAtRestOnItsEndsAndKeepsToStraightLines) {
    const SmoothPath path({{0.0, 0.0}, {10.0, 0.0}, {10.0, 5.0}});
    EXPECT_LT((path.at(0.0) - Eigen::Vector2d(0.0, 0.0)).norm(), 1e-12);
    EXPECT_LT((path.at(-3.0) - Eigen::Vector2d(0.0, 0.0)).norm(), 1e-12);
    EXPECT_LT((path.at(path.length_m()) - Eigen::Vector2d(10.0, 5.0)).norm(), 1e-12);
    EXPECT_LT(std::abs(path.at(5.0).y()), 1e-12);
    // At rest: the way starts with the cube of the parameter.
    EXPECT_LT((path.at(0.01) - path.at(0.0)).norm(), 1e-6);
    // One metre of parameter is one metre of way on the straight.
    EXPECT_NEAR((path.at(6.0) - path.at(5.0)).norm(), 1.0, 1e-12);
}

}  // namespace
}  // namespace terrawalk
