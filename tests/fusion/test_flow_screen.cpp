#include "fusion/flow_screen.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "fusion/random_numbers.hpp"

namespace terrawalk {
namespace {

constexpr std::size_t kEpochs = 400;

struct Stretch {
    std::size_t from = 0, end = 0;
    [[nodiscard]] bool holds(std::size_t i) const { return i >= from && i < end; }
};

enum class Accelerometer { None, Shakes, Smooth };

// A walk of 80 s with a stand; the flow reads nothing to the last digit in each of `silent`.
ArrayLog walk(const Stretch& stand, const std::vector<Stretch>& silent, Accelerometer accelerometer) {
    RandomNumbers random({7});
    ArrayLog log;
    for (const Channel channel : {Channel::FlowForward, Channel::FlowLeft, Channel::FlowQuality,
                                  Channel::AccelerationX, Channel::AccelerationY, Channel::AccelerationZ}) {
        log.column(channel).assign(kEpochs, 0.0);
    }
    for (std::size_t i = 0; i < kEpochs; ++i) {
        log.time_s.push_back(0.2 * static_cast<double>(i));
        const bool stands = stand.holds(i);
        log.column(Channel::FlowForward)[i] = (stands ? 0.0 : 0.7) + 0.05 * random.normal();
        log.column(Channel::FlowLeft)[i] = 0.05 * random.normal();
        log.column(Channel::FlowQuality)[i] = 255.0;
        const double shaking = accelerometer == Accelerometer::Smooth || stands ? 0.05 : 1.0;
        log.column(Channel::AccelerationZ)[i] = 9.81 + shaking * random.normal();
        if (std::any_of(silent.begin(), silent.end(), [&](const Stretch& s) { return s.holds(i); })) {
            log.column(Channel::FlowForward)[i] = log.column(Channel::FlowLeft)[i] = 0.0;
        }
    }
    if (accelerometer == Accelerometer::None) {
        for (const Channel channel :
             {Channel::AccelerationX, Channel::AccelerationY, Channel::AccelerationZ}) {
            log.column(channel).clear();
        }
    }
    return log;
}

// Those of nothing that are left out, in epochs that a second of the other state does not reach.
void expectSilent(const ArrayLog& log, const Stretch& stretch, bool silent) {
    EpochAttitude attitude;
    attitude.heading_known = true;
    const FlowRejections rejections =
        flowRejections(log, std::vector<EpochAttitude>(log.size(), attitude), FlowOptions{});
    ASSERT_EQ(rejections.size(), log.size());
    for (std::size_t i = stretch.from + 6; i + 6 < stretch.end; ++i) {
        ASSERT_TRUE(rejections[i]) << i;
        EXPECT_EQ(*rejections[i], silent ? "zero amid motion" : "") << i;
    }
}

TEST(FlowScreen, AModuleThatSeesNothingForLongIsSilentWhileTheWalkShakes) {
    const Stretch silent{150, 300};  // 30 s
    const ArrayLog log = walk({}, {silent}, Accelerometer::Shakes);
    expectSilent(log, silent, true);
    expectSilent(log, {0, 150}, false);
    expectSilent(log, {300, kEpochs}, false);
}

TEST(FlowScreen, AStandReadsNothingToo) {
    const Stretch stand{150, 185};  // 7 s, as short as many a silence
    expectSilent(walk(stand, {stand}, Accelerometer::Shakes), stand, false);
}

TEST(FlowScreen, ASilenceFromAWalkIntoAStandEndsWithTheWalk) {
    const Stretch stand{200, 260};
    const ArrayLog log = walk(stand, {{150, 240}}, Accelerometer::Shakes);
    expectSilent(log, {150, 200}, true);
    expectSilent(log, {200, 240}, false);
}

TEST(FlowScreen, WithoutAShakingAccelerometerAShortSilenceWithinAWalkIsTold) {
    for (const Accelerometer accelerometer : {Accelerometer::None, Accelerometer::Smooth}) {
        expectSilent(walk({}, {{150, 190}}, accelerometer), {150, 190}, true);
        // As long as this, it may be a stand.
        expectSilent(walk({}, {{150, 300}}, accelerometer), {150, 300}, false);
        // A log begins with a stand.
        expectSilent(walk({0, 30}, {{0, 30}}, accelerometer), {0, 30}, false);
    }
}

TEST(FlowScreen, SaysWhyInTheOrderOfTheCauses) {
    ArrayLog log = walk({}, {}, Accelerometer::Shakes);
    log.column(Channel::FlowForward)[10] = log.column(Channel::FlowLeft)[10] = kMissing;
    log.column(Channel::FlowQuality)[11] = 0.0;
    log.column(Channel::FlowLeft)[12] = kMissing;
    log.column(Channel::FlowForward)[50] = 5.0;
    std::vector<EpochAttitude> attitudes(log.size());
    for (std::size_t i = 0; i < 100; ++i) attitudes[i].heading_known = true;
    const FlowRejections rejections = flowRejections(log, attitudes, FlowOptions{});
    EXPECT_FALSE(rejections[10]);
    EXPECT_EQ(rejections[11], "no texture");
    EXPECT_EQ(rejections[12], "one component missing");
    EXPECT_EQ(rejections[50], "far from its neighbours");
    EXPECT_EQ(rejections[51], "");
    EXPECT_EQ(rejections[200], "no attitude");
    FlowOptions trusting;
    trusting.screen = false;
    EXPECT_EQ(flowRejections(log, attitudes, trusting)[50], "");
    EXPECT_FALSE(flowRejections(ArrayLog{}, {}, trusting).size());
}

}  // namespace
}  // namespace terrawalk
