#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include <cmath>

#include "mapping/volume.hpp"
#include "tests/support/random_numbers.hpp"
#include "tests/support/slack.hpp"

namespace terrawalk {
namespace {

ElevationGrid level(std::size_t columns, std::size_t rows, double cell_m, float height_m) {
    return {{0.0, 0.0, cell_m, columns, rows}, std::vector<float>(columns * rows, height_m)};
}

TEST(Volume, PartsAddUpAndUnknownCellsCountForNothing) {
    ElevationGrid grid = level(4, 1, 2.0, 0.0F);
    grid.heights_m = {1.5F, -0.5F, kNoHeight, 0.0F};
    const VolumeResult result = volumeOf(grid, {}).value();
    EXPECT_DOUBLE_EQ(result.above.volume_m3, 6.0);
    EXPECT_DOUBLE_EQ(result.below.volume_m3, 2.0);
    EXPECT_DOUBLE_EQ(result.net_m3, 4.0);
    EXPECT_DOUBLE_EQ(result.area_m2, 12.0);
    EXPECT_DOUBLE_EQ(result.above.area_m2, 4.0);
    EXPECT_EQ(result.cells, 3u);
    EXPECT_EQ(result.net_sigma_m3, 0.0);
}

TEST(Volume, IndependentErrorsGrowWithTheRootCommonOnesWithTheCount) {
    const ElevationGrid grid = level(20, 30, 0.5, 1.0F);
    EXPECT_NEAR(volumeOf(grid, {{0.1F}, 0.0, 0.0}).value().net_sigma_m3, 0.25 * 0.1 * std::sqrt(600.0), 1e-7);
    EXPECT_NEAR(volumeOf(grid, {{0.0F}, 0.0, 0.02}).value().net_sigma_m3, 0.25 * 0.02 * 600.0, 1e-9);
    EXPECT_NEAR(volumeOf(grid, {{0.1F}, 0.0, 0.02}).value().net_sigma_m3,
                0.25 * std::hypot(0.1 * std::sqrt(600.0), 0.02 * 600.0), 1e-7);
}

double byAllPairs(const ElevationGrid& grid, const std::vector<float>& sigmas, double range_m) {
    double sum = 0.0;
    const GridGeometry& g = grid.geometry;
    for (std::size_t a = 0; a < g.size(); ++a) {
        for (std::size_t b = 0; b < g.size(); ++b) {
            const double distance = std::hypot(g.centreX(a % g.columns) - g.centreX(b % g.columns),
                                               g.centreY(a / g.columns) - g.centreY(b / g.columns));
            const double h = distance / range_m;
            if (h < 1.0) sum += double{sigmas[a]} * double{sigmas[b]} * (1.0 - 1.5 * h + 0.5 * h * h * h);
        }
    }
    return g.cell_m * g.cell_m * std::sqrt(sum);
}

TEST(Volume, CountsEveryPairOfCorrelatedCells) {
    const ElevationGrid grid = level(40, 25, 0.5, 1.0F);
    test::RandomNumbers random(1);
    std::vector<float> sigmas;
    for (std::size_t i = 0; i < grid.heights_m.size(); ++i) {
        sigmas.push_back(static_cast<float>(random.uniform(0.05, 0.15)));
    }
    // Up to eight cells a block is one cell: exact.
    EXPECT_NEAR(volumeOf(grid, {sigmas, 3.0, 0.0}).value().net_sigma_m3, byAllPairs(grid, sigmas, 3.0), 1e-9);
    // Larger blocks see a little more correlation, never less.
    const double exact = byAllPairs(grid, sigmas, 16.0);
    const double blocked = volumeOf(grid, {sigmas, 16.0, 0.0}).value().net_sigma_m3;
    EXPECT_GT(blocked, 0.999 * exact);
    EXPECT_LT(blocked, 1.03 * exact);
}

// Simulated: heights with independent errors and a common one, a thousand times; 95 % bars hold the truth.
TEST(Volume, ErrorBarsHoldTheTrueVolume) {
    test::RandomNumbers random(2);
    constexpr int kTrials = 1000;
    int held = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        ElevationGrid grid = level(15, 10, 1.0, 0.0F);
        const double common = 0.01 * random.normal();
        for (float& height : grid.heights_m)
            height = static_cast<float>(2.0 + common + 0.1 * random.normal());
        const VolumeResult result = volumeOf(grid, {{0.1F}, 0.0, 0.01}).value();
        held += std::abs(result.net_m3 - 300.0) <= 1.96 * result.net_sigma_m3 ? 1 : 0;
    }
    // Binomial: 0.95 within four standard deviations of 0.0069.
    EXPECT_NEAR(held / static_cast<double>(kTrials), 0.95, 0.028);
}

TEST(Volume, StopsWithinASecondOnTenMillionCells) {
    // The dearest case: blocks of one cell, each with the three hundred around it.
    ElevationGrid grid{{0.0, 0.0, 1.0, 3200, 3200}, std::vector<float>(3200 * 3200, 1.0F)};
    std::stop_source stop;
    const auto start = std::chrono::steady_clock::now();
    std::jthread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        stop.request_stop();
    });
    const auto result = volumeOf(grid, {{0.1F}, 8.0, 0.0}, stop.get_token());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    ASSERT_FALSE(result) << "it was done before it could be stopped: " << took.count() << " s";
    EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
    EXPECT_LT(took.count(), 0.3 + 1.0 * test::kSlack);
}

}  // namespace
}  // namespace terrawalk
