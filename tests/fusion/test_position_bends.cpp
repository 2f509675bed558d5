#include "fusion/position_bends.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "survey/frames.hpp"

namespace terrawalk {
namespace {

constexpr double kStep_s = 0.2;
constexpr double kSlow_radps = 0.9;     // a turn
constexpr double kStride_radps = 10.6;  // 1.7 steps a second
constexpr double kSway_m = 1.5;
constexpr double kStride_m = 0.03;

/// A sway in all axes, with steps upon it.
Eigen::Vector3d way_m(double t) {
    return kSway_m * Eigen::Vector3d(std::sin(kSlow_radps * t), std::cos(0.7 * kSlow_radps * t),
                                     0.2 * std::sin(0.5 * kSlow_radps * t)) +
           kStride_m * std::sin(kStride_radps * t) * Eigen::Vector3d(0.3, -0.5, 1.0);
}

Eigen::Vector3d acceleration_mps2(double t) {
    constexpr double kHalf_s = 1e-3;
    return (way_m(t + kHalf_s) - 2.0 * way_m(t) + way_m(t - kHalf_s)) / (kHalf_s * kHalf_s);
}

struct Carried {
    ArrayLog log;
    std::vector<EpochAttitude> attitudes;
    std::vector<double> yaw_rad;
    std::vector<double> knots_s;
};

/// An array that is tilted and turned while it follows the way.
Carried carried(double duration_s, const Eigen::Vector3d& bias_mps2 = Eigen::Vector3d::Zero()) {
    Carried c;
    const auto n = static_cast<std::size_t>(std::lround(duration_s / kStep_s)) + 1;
    for (std::size_t i = 0; i < n; ++i) c.log.time_s.push_back(static_cast<double>(i) * kStep_s);
    for (const Channel channel : {Channel::AccelerationX, Channel::AccelerationY, Channel::AccelerationZ}) {
        c.log.channels[static_cast<std::size_t>(channel)].assign(n, kMissing);
    }
    for (std::size_t i = 0; i < n; ++i) {
        const double t = c.log.time_s[i];
        EpochAttitude epoch;
        epoch.attitude = {0.1 * std::sin(0.3 * t), 0.08 * std::cos(0.2 * t), 0.4 * t};
        epoch.tilt_known = epoch.heading_known = true;
        const Eigen::Vector3d force =
            rotationEnuFromBody(epoch.attitude).transpose() *
                (acceleration_mps2(t) + kStandardGravity_mps2 * Eigen::Vector3d::UnitZ()) +
            bias_mps2;
        c.log.column(Channel::AccelerationX)[i] = force.x();
        c.log.column(Channel::AccelerationY)[i] = force.y();
        c.log.column(Channel::AccelerationZ)[i] = force.z();
        c.attitudes.push_back(epoch);
        c.yaw_rad.push_back(epoch.attitude.yaw_rad);
    }
    for (double t = 0.0; t <= duration_s; t += 1.0) c.knots_s.push_back(t);
    return c;
}

/// The way averaged over a stride, by a sum much finer than the log.
Eigen::Vector3d averagedWay_m(double t) {
    constexpr double kFine_s = 0.002;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0.0;
    for (double s = -kStrideAverage_s; s <= kStrideAverage_s; s += kFine_s) {
        const double weight = kStrideAverage_s - std::abs(s);
        sum += weight * way_m(t + s);
        weights += weight;
    }
    return sum / weights;
}

std::vector<PositionBend> bendsOf(const Carried& c) {
    return positionBends(levelAcceleration(c.log, c.attitudes).value(), c.yaw_rad, c.knots_s, 1.0);
}

TEST(PositionBends, AreSecondDifferencesOfTheAveragedWay) {
    const Carried c = carried(60.0);
    const auto bends = bendsOf(c);
    ASSERT_GE(bends.size(), 55U);
    for (const PositionBend& bend : bends) {
        const double t = c.knots_s[bend.knot];
        const Eigen::Vector3d expected =
            averagedWay_m(t - 1.0) - 2.0 * averagedWay_m(t) + averagedWay_m(t + 1.0);
        // Steps of 3 cm at 1.7 Hz, seen five times a second, leave this much after the average.
        EXPECT_LT((bend.bend_m - expected).norm(), 0.004) << "t = " << t;
        EXPECT_EQ(bend.filled_sigma_m, 0.0);
    }
}

TEST(PositionBends, ABiasOfTheArrayShowsAsItsCoefficientsSay) {
    const Eigen::Vector3d bias(0.12, -0.3, 0.05);
    const auto without = bendsOf(carried(20.0));
    const auto with = bendsOf(carried(20.0, bias));
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t i = 0; i < with.size(); ++i) {
        EXPECT_LT((with[i].bend_m - with[i].by_bias_s2 * bias - without[i].bend_m).norm(), 1e-12);
        EXPECT_NEAR(with[i].by_bias_s2.row(2).norm(), 1.0, 0.02);  // a second squared, upright or nearly
    }
}

TEST(PositionBends, AMissingRecordIsForetoldAndOwnsUpToIt) {
    const Carried whole = carried(120.0);
    Carried holed = whole;
    holed.log.column(Channel::AccelerationY)[300] = kMissing;  // at 60 s
    const auto expected = bendsOf(whole);
    const auto bends = bendsOf(holed);
    ASSERT_EQ(bends.size(), expected.size());
    std::size_t touched = 0;
    for (std::size_t i = 0; i < bends.size(); ++i) {
        if (std::abs(whole.knots_s[bends[i].knot] - 60.0) >= 1.0 + kStrideAverage_s) {
            EXPECT_EQ(bends[i].bend_m, expected[i].bend_m);
            continue;
        }
        ++touched;
        EXPECT_GT(bends[i].filled_sigma_m, 0.0);
        EXPECT_LT((bends[i].bend_m - expected[i].bend_m).norm(), 4.0 * bends[i].filled_sigma_m);
        EXPECT_LT(bends[i].filled_sigma_m, 0.25);
    }
    EXPECT_EQ(touched, 3U);
}

TEST(PositionBends, ALongSilenceTellsNothing) {
    Carried c = carried(60.0);
    for (std::size_t i = 100; i < 200; ++i) c.log.column(Channel::AccelerationX)[i] = kMissing;
    for (const PositionBend& bend : bendsOf(c)) {
        if (std::abs(c.knots_s[bend.knot] - 30.0) < 5.0) {
            EXPECT_GT(bend.filled_sigma_m, 0.3) << bend.knot;
        }
    }
}

TEST(PositionBends, NothingWithoutAccelerometer) {
    Carried c = carried(10.0);
    c.log.channels[static_cast<std::size_t>(Channel::AccelerationZ)].clear();
    EXPECT_FALSE(levelAcceleration(c.log, c.attitudes));
    Carried empty = carried(10.0);
    for (double& x : empty.log.column(Channel::AccelerationX)) x = kMissing;
    EXPECT_FALSE(levelAcceleration(empty.log, empty.attitudes));
}

TEST(PositionBends, KnotsThatAreNotAStepApartHaveNone) {
    Carried c = carried(20.0);
    c.knots_s = {0.0, 2.0, 3.0, 4.0, 5.5, 6.5, 7.5, 20.0};
    std::vector<std::size_t> knots;
    for (const PositionBend& bend : bendsOf(c)) knots.push_back(bend.knot);
    EXPECT_EQ(knots, (std::vector<std::size_t>{2, 5}));
}

}  // namespace
}  // namespace terrawalk
