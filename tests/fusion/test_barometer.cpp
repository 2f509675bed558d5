#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fusion/barometer.hpp"
#include "fusion/phase_range.hpp"
#include "tests/fusion/normal_numbers.hpp"

namespace terrawalk {
namespace {

TEST(IsaHeight, MeetsThePublishedTable) {
    // ICAO standard atmosphere: pressures at 0, 1000 and 2000 m, given to a pascal (0.1 m).
    EXPECT_NEAR(isaHeight(101325.0), 0.0, 1e-9);
    EXPECT_NEAR(isaHeight(89875.0), 1000.0, 0.1);
    EXPECT_NEAR(isaHeight(79495.0), 2000.0, 0.1);
}

TEST(IsaHeight, IsMissingWithoutAPositivePressure) {
    EXPECT_TRUE(std::isnan(isaHeight(0.0)));
    EXPECT_TRUE(std::isnan(isaHeight(-5.0)));
    EXPECT_TRUE(std::isnan(isaHeight(std::nan(""))));
}

TEST(IsaPressure, IsTheInverseOfIsaHeight) {
    for (const double height_m : {-300.0, 0.0, 0.001, 38.0, 2500.0, 10000.0}) {
        EXPECT_NEAR(isaHeight(isaPressure(height_m)), height_m, 1e-8);
    }
}

TEST(PressureHeightFit, RecoversScaleAndOffsetOfAWarmDay) {
    std::vector<PressureAtHeight> readings;
    for (int i = 0; i < 16; ++i) {
        const double height_m = -4.0 + 0.9 * i;
        readings.push_back({isaPressure((height_m + 38.0) / 1.05), height_m});
    }
    const auto fit = fitPressureToHeight(readings);
    ASSERT_TRUE(fit) << fit.error().text();
    EXPECT_NEAR(fit->scale, 1.05, 1e-9);
    EXPECT_NEAR(fit->offset_m, -38.0, 1e-7);
    EXPECT_NEAR(fit->rmse_m, 0.0, 1e-8);
    EXPECT_NEAR(fit->height(readings[3].pressure_pa), readings[3].height_m, 1e-8);
}

TEST(PressureHeightFit, IsTheLeastSquaresLine) {
    NormalNumbers normal(1);
    std::vector<PressureAtHeight> readings;
    for (int i = 0; i < 40; ++i) {
        readings.push_back({isaPressure(0.5 * i) + 2.0 * normal(), 0.5 * i});
    }
    const auto fit = fitPressureToHeight(readings);
    ASSERT_TRUE(fit);
    const auto sum = [&](double scale, double offset_m) {
        double squares = 0.0;
        for (const PressureAtHeight& r : readings) {
            squares += std::pow(r.height_m - offset_m - scale * isaHeight(r.pressure_pa), 2);
        }
        return squares;
    };
    const double least = sum(fit->scale, fit->offset_m);
    EXPECT_NEAR(std::sqrt(least / 40.0), fit->rmse_m, 1e-12);
    for (const double step : {-1e-3, 1e-3}) {
        EXPECT_GT(sum(fit->scale + step, fit->offset_m), least);
        EXPECT_GT(sum(fit->scale, fit->offset_m + step), least);
    }
}

TEST(PressureHeightFit, RefusesWhatFitsNoLine) {
    EXPECT_FALSE(fitPressureToHeight(std::vector<PressureAtHeight>{{101325.0, 0.0}}));
    EXPECT_FALSE(fitPressureToHeight(std::vector<PressureAtHeight>{{101325.0, 0.0}, {101325.0, 1.0}}));
    EXPECT_FALSE(fitPressureToHeight(std::vector<PressureAtHeight>{{101325.0, 0.0}, {-1.0, 1.0}}));
}

TEST(PhaseRange, FollowsEquationOne) {
    // A 10 MHz modulation travels 29.98 m in one period, there and back.
    EXPECT_NEAR(unambiguousRange(10e6), 14.9896229, 1e-7);
    EXPECT_NEAR(rangeFromPhase(2.0 * kPi, 10e6), unambiguousRange(10e6), 1e-12);
    EXPECT_NEAR(rangeFromPhase(kPi / 2.0, 10e6), unambiguousRange(10e6) / 4.0, 1e-12);
    EXPECT_EQ(rangeFromPhase(0.0, 10e6), 0.0);
}

}  // namespace
}  // namespace terrawalk
