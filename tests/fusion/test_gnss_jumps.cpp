#include "fusion/gnss_jumps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fusion/random_numbers.hpp"
#include "survey/frames.hpp"

namespace terrawalk {
namespace {

// A walk of 40 s on a circle at 0.8 m/s that sways with the gait; noise of 1 cm.
std::vector<GnssReading> walk(double noise_m = 0.01) {
    RandomNumbers random({7});
    std::vector<GnssReading> readings;
    for (int i = 0; i < 200; ++i) {
        const double t = 0.2 * i;
        const Eigen::Vector2d noise(random.normal(), random.normal());
        const Eigen::Vector2d at(10.0 * std::cos(0.08 * t), 10.0 * std::sin(0.08 * t));
        const Eigen::Vector2d gait(0.03 * std::sin(2.0 * kPi * t), 0.0);
        readings.push_back({t, at + gait + noise_m * noise, noise_m, kFixedClass});
    }
    return readings;
}

void shift(std::vector<GnssReading>& readings, std::size_t from, std::size_t end, double east_m) {
    for (std::size_t i = from; i < end; ++i) readings[i].en_m.x() += east_m;
}

void expectDoubted(const std::vector<GnssReading>& readings, std::size_t from, std::size_t end) {
    const std::vector<double> jumps = gnssJumps(readings);
    ASSERT_EQ(jumps.size(), readings.size());
    for (std::size_t i = 0; i < jumps.size(); ++i) EXPECT_EQ(jumps[i] > 0.0, i >= from && i < end) << i;
}

TEST(GnssJumps, AWalkHasNone) {
    expectDoubted(walk(), 0, 0);
    expectDoubted(walk(0.3), 0, 0);
}

TEST(GnssJumps, AStretchThatStandsOffIsDoubtedByTheSizeOfItsJump) {
    std::vector<GnssReading> readings = walk();
    shift(readings, 60, 90, 0.4);
    expectDoubted(readings, 60, 90);
    EXPECT_NEAR(gnssJumps(readings)[75], 0.4, 0.1);
}

TEST(GnssJumps, TheShorterSideOfASingleJumpIsDoubted) {
    std::vector<GnssReading> readings = walk();
    shift(readings, 150, readings.size(), -0.5);
    expectDoubted(readings, 150, readings.size());
    readings = walk();
    shift(readings, 50, readings.size(), -0.5);
    expectDoubted(readings, 0, 50);
}

// Otherwise all that follows would be doubted, up to the next jump.
TEST(GnssJumps, AWayBackMayBeFainterThanTheJump) {
    std::vector<GnssReading> readings = walk(0.001);
    for (int i = 60; i < 90; ++i) readings[static_cast<std::size_t>(i)].en_m.y() += 0.3 - 0.004 * (i - 60);
    expectDoubted(readings, 60, 90);
}

// Two wrong fixes, and little between them.
TEST(GnssJumps, AShortReturnBetweenTwoStretchesIsRight) {
    std::vector<GnssReading> readings = walk();
    shift(readings, 60, 90, 0.6);
    shift(readings, 96, 130, -0.5);
    const std::vector<double> jumps = gnssJumps(readings);
    for (std::size_t i = 0; i < jumps.size(); ++i) {
        EXPECT_EQ(jumps[i] > 0.0, (i >= 60 && i < 90) || (i >= 96 && i < 130)) << i;
    }
}

TEST(GnssJumps, ASmallStepThatDoesNotComeBackIsGait) {
    std::vector<GnssReading> readings = walk(0.001);
    shift(readings, 60, readings.size(), 0.2);
    expectDoubted(readings, 0, 0);
}

// Robust rows deal with it.
TEST(GnssJumps, ASingleOutlierIsNoStretch) {
    std::vector<GnssReading> readings = walk();
    shift(readings, 100, 101, 3.0);
    expectDoubted(readings, 0, 0);
    shift(readings, 60, 90, 0.4);  // nor does it hide one
    shift(readings, 75, 76, -2.0);
    expectDoubted(readings, 60, 90);
}

// Half an hour of positions that drift by a metre and more.
std::vector<GnssReading> driftingWalk() {
    RandomNumbers random({8});
    std::vector<GnssReading> readings;
    Eigen::Vector2d drift = Eigen::Vector2d::Zero();
    for (int i = 0; i < 9000; ++i) {
        const double t = 0.2 * i;
        drift = 0.996 * drift + 0.1 * Eigen::Vector2d(random.normal(), random.normal());
        const Eigen::Vector2d noise(random.normal(), random.normal());
        const Eigen::Vector2d at(30.0 * std::cos(0.03 * t), 30.0 * std::sin(0.03 * t));
        readings.push_back({t, at + drift + 0.3 * noise, 0.3, kSingleClass});
    }
    return readings;
}

std::ptrdiff_t doubted(const std::vector<GnssReading>& readings) {
    const std::vector<double> jumps = gnssJumps(readings);
    return std::count_if(jumps.begin(), jumps.end(), [](double jump_m) { return jump_m > 0.0; });
}

// Their steps once made levels that most of a walk seemed to stand off from.
TEST(GnssJumps, ManyOutliersMakeNoStretches) {
    std::vector<GnssReading> readings = driftingWalk();
    EXPECT_EQ(doubted(readings), 0);
    RandomNumbers random({9});
    for (GnssReading& reading : readings) {
        const Eigen::Vector2d outlier(random.normal(), random.normal());
        if (random.normal() > 1.28) reading.en_m += 6.0 * outlier;
    }
    EXPECT_LT(doubted(readings), 180);  // 2 %
}

TEST(GnssJumps, ALastingJumpWithoutAnRtkFixIsBelieved) {
    std::vector<GnssReading> readings = driftingWalk();
    shift(readings, 4000, 4050, 4.0);
    EXPECT_EQ(doubted(readings), 50);
    shift(readings, 6000, readings.size(), 4.0);
    EXPECT_EQ(doubted(readings), 50);
}

// Where noise is worse than stated, its steps are not jumps.
TEST(GnssJumps, NoiseThatIsUnderstatedMakesNone) {
    std::vector<GnssReading> readings = walk(0.3);
    for (GnssReading& reading : readings) reading.white_m = 0.01;
    expectDoubted(readings, 0, 0);
}

TEST(GnssJumps, OtherKindsOfFixAndGapsAreNotCompared) {
    std::vector<GnssReading> readings = walk();
    shift(readings, 60, 90, 1.0);
    for (std::size_t i = 60; i < 90; ++i) readings[i].fix_class = kFloatClass;
    expectDoubted(readings, 0, 0);
    readings = walk();
    for (std::size_t i = 100; i < readings.size(); ++i) readings[i].time_s += 5.0;
    shift(readings, 100, readings.size(), 6.0);
    expectDoubted(readings, 0, 0);
}

TEST(GnssJumps, FewReadingsOrNoneAreTakenAsTheyAre) {
    EXPECT_TRUE(gnssJumps(std::vector<GnssReading>{}).empty());
    std::vector<GnssReading> two = walk();
    two.resize(2);
    expectDoubted(two, 0, 0);
}

TEST(GnssJumps, TheNoteCountsStretchesAndTheirTime) {
    ArrayLog log;
    for (int i = 0; i < 6; ++i) log.time_s.push_back(0.5 * i);
    EXPECT_TRUE(gnssJumpsNote(log, std::vector<double>(6, 0.0)).empty());
    const std::string note = gnssJumpsNote(log, std::vector<double>{0.0, 0.4, 0.4, 0.0, 0.7, 0.0});
    EXPECT_NE(note.find("0.70 m"), std::string::npos) << note;
    EXPECT_NE(note.find("2 times, for 2 s"), std::string::npos) << note;
}

}  // namespace
}  // namespace terrawalk
