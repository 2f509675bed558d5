#include "app/pipeline/crossover_misfit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace terrawalk {
namespace {

/// Two passes over a slope, along x and then along y, the second raised; they cross at the origin.
GroundTrack twoPasses(double raised_m, double pause_s) {
    GroundTrack track;
    for (int pass = 0; pass < 2; ++pass) {
        for (int k = -40; k <= 40; ++k) {
            GroundPoint point;
            point.epoch = static_cast<std::uint32_t>(track.points.size());
            point.time_s = pass * (16.2 + pause_s) + 0.2 * (k + 40);
            const double along_m = 0.15 * k;
            const Eigen::Vector2d en_m =
                pass == 0 ? Eigen::Vector2d(along_m, 0.0) : Eigen::Vector2d(0.0, along_m);
            point.enu_m << en_m, 0.3 * en_m.x() - 0.1 * en_m.y() + (pass == 0 ? 0.0 : raised_m);
            track.points.push_back(point);
        }
    }
    track.first_point = {0, track.points.size()};
    return track;
}

TEST(CrossoverMisfit, IsTheHeightBetweenThePassesOnASlope) {
    const CrossoverMisfit misfit = crossoverMisfit(twoPasses(0.2, 30.0));
    ASSERT_GE(misfit.crossovers, 1U);
    // The ridge on the slope of the fit keeps back a part of it, but both passes are centred on the place to
    // within half a spacing of points.
    EXPECT_NEAR(misfit.rms_m, 0.2, 0.05);
    EXPECT_NEAR(misfit.median_m, 0.2, 0.05);
}

TEST(CrossoverMisfit, IsNothingWhereThePassesAgree) {
    EXPECT_LT(crossoverMisfit(twoPasses(0.0, 30.0)).rms_m, 0.05);
}

TEST(CrossoverMisfit, CountsUsedPointsOfLaterPassesOnly) {
    EXPECT_EQ(crossoverMisfit(twoPasses(0.2, 0.0)).crossovers, 0U);  // the passes meet 16 s apart
    GroundTrack unused = twoPasses(0.2, 30.0);
    for (GroundPoint& point : unused.points) {
        if (point.time_s > 20.0) point.state = GroundPointState::Spike;
    }
    const CrossoverMisfit misfit = crossoverMisfit(unused);
    EXPECT_EQ(misfit.crossovers, 0U);
    EXPECT_TRUE(std::isnan(misfit.rms_m));
}

}  // namespace
}  // namespace terrawalk
