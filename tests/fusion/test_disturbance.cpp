#include "fusion/disturbance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "fusion/simulation.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/small_survey.hpp"

namespace terrawalk {
namespace {

Survey survey(const SimulationOptions& options) {
    return simulatedSurvey(options).survey;
}

SimulationOptions fieldWithDoppler() {
    SimulationOptions options = smallField();
    options.doppler_velocity = true;
    return options;
}

Survey disturbed(Survey survey, Disturbance disturbance, std::uint64_t seed = 3) {
    disturb(survey, disturbance, seed);
    return survey;
}

std::set<Channel> changedChannels(const Survey& before, const Survey& after) {
    std::set<Channel> changed;
    for (std::size_t run = 0; run < before.runs.size(); ++run) {
        for (std::size_t c = 0; c < kChannelCount; ++c) {
            if (!sameBits(before.runs[run].log.channels[c], after.runs[run].log.channels[c])) {
                changed.insert(static_cast<Channel>(c));
            }
        }
    }
    return changed;
}

std::set<Channel> ownChannels(Disturbance disturbance) {
    const std::set<Channel> position{Channel::Latitude, Channel::Longitude, Channel::EllipsoidalHeight};
    std::set<Channel> receiver{Channel::Fix,
                               Channel::GnssHorizontalAccuracy,
                               Channel::GnssVerticalAccuracy,
                               Channel::GnssVelocityEast,
                               Channel::GnssVelocityNorth,
                               Channel::GnssVelocityUp};
    receiver.insert(position.begin(), position.end());
    const std::set<Channel> inertial{Channel::AccelerationX, Channel::AccelerationY, Channel::AccelerationZ,
                                     Channel::AngularRateX,  Channel::AngularRateY,  Channel::AngularRateZ};
    const std::set<Channel> flow{Channel::FlowForward, Channel::FlowLeft};
    switch (disturbance) {
        case Disturbance::GnssOutliers:
        case Disturbance::GnssOffset:
        case Disturbance::GnssOffsetOfRun:
        case Disturbance::GnssDrift:
            return position;
        case Disturbance::GnssLate:
            return receiver;
        case Disturbance::BarometerRamp:
        case Disturbance::BarometerSteps:
        case Disturbance::BarometerGusts:
            return {Channel::Pressure};
        case Disturbance::NoBarometer:
            return {Channel::Pressure, Channel::Temperature};
        case Disturbance::FlowScaleWander:
        case Disturbance::FlowSpikes:
            return flow;
        case Disturbance::FlowZeros:
        case Disturbance::NoFlow:
            return {Channel::FlowForward, Channel::FlowLeft, Channel::FlowQuality};
        case Disturbance::HeadingOffset:
        case Disturbance::HeadingSteps:
            return {Channel::Heading};
        case Disturbance::RangeShort:
            return {Channel::Range};
        case Disturbance::ScatteredSilence: {
            std::set<Channel> all = receiver;
            all.insert(inertial.begin(), inertial.end());
            all.insert({Channel::Pressure, Channel::Temperature, Channel::FlowForward, Channel::FlowLeft,
                        Channel::FlowQuality, Channel::Heading});
            return all;
        }
        case Disturbance::HeavyTails: {
            std::set<Channel> all = inertial;
            all.insert({Channel::Pressure, Channel::FlowForward, Channel::FlowLeft, Channel::Heading,
                        Channel::Range});
            return all;
        }
    }
    return {};
}

TEST(Disturbance, EachChangesItsOwnChannelsAndNoOther) {
    const Survey before = survey(fieldWithDoppler());
    for (const auto& [disturbance, text] : kDisturbanceNames) {
        EXPECT_EQ(changedChannels(before, disturbed(before, disturbance)), ownChannels(disturbance)) << text;
    }
}

TEST(Disturbance, TheSeedDecides) {
    const Survey before = survey(fieldWithDoppler());
    for (const auto& [disturbance, text] : kDisturbanceNames) {
        const Survey once = disturbed(before, disturbance, 1);
        EXPECT_TRUE(changedChannels(once, disturbed(before, disturbance, 1)).empty()) << text;
    }
    EXPECT_FALSE(changedChannels(disturbed(before, Disturbance::GnssDrift, 1),
                                 disturbed(before, Disturbance::GnssDrift, 2))
                     .empty());
}

TEST(Disturbance, TheSimulatorPutsThemInAndSaysSo) {
    SimulationOptions options = fieldWithDoppler();
    const Survey before = survey(options);
    options.disturbances = {Disturbance::FlowSpikes, Disturbance::HeadingOffset};
    const Survey after = survey(options);
    EXPECT_EQ(changedChannels(before, after),
              (std::set<Channel>{Channel::FlowForward, Channel::FlowLeft, Channel::Heading}));
    EXPECT_THAT(after.notes,
                testing::IsSupersetOf({"Disturbed: flow-spikes.", "Disturbed: heading-offset."}));
}

TEST(Disturbance, ReadingsThatAreMissingStayMissing) {
    const Survey before = survey(fieldWithDoppler());
    for (const auto& [disturbance, text] : kDisturbanceNames) {
        if (disturbance == Disturbance::GnssLate) continue;  // it moves gaps with the rest
        const Survey after = disturbed(before, disturbance);
        for (std::size_t run = 0; run < before.runs.size(); ++run) {
            for (std::size_t c = 0; c < kChannelCount; ++c) {
                const auto channel = static_cast<Channel>(c);
                for (std::size_t i = 0; i < before.runs[run].log.size(); ++i) {
                    if (present(before.runs[run].log.value(channel, i))) continue;
                    ASSERT_FALSE(present(after.runs[run].log.value(channel, i))) << text;
                }
            }
        }
    }
}

TEST(Disturbance, LogsWithoutTheSensorStayAsTheyAre) {
    Survey bare = survey(fieldWithDoppler());
    for (auto& run : bare.runs) {
        for (auto& column : run.log.channels) column.clear();
    }
    for (const auto& [disturbance, text] : kDisturbanceNames) {
        EXPECT_TRUE(changedChannels(bare, disturbed(bare, disturbance)).empty()) << text;
    }
}

/// Positions of the area walk after less before, where both are there.
std::vector<Eigen::Vector3d> moved(const Survey& before, const Survey& after, std::size_t run) {
    const LocalFrame frame = before.frame();
    std::vector<Eigen::Vector3d> by_m;
    const auto enu = [&](const ArrayLog& log, std::size_t i) {
        return frame.toEnu({log.value(Channel::Latitude, i), log.value(Channel::Longitude, i),
                            log.value(Channel::EllipsoidalHeight, i)});
    };
    for (std::size_t i = 0; i < before.runs[run].log.size(); ++i) {
        if (!present(before.runs[run].log.value(Channel::Latitude, i))) continue;
        by_m.push_back(enu(after.runs[run].log, i) - enu(before.runs[run].log, i));
    }
    return by_m;
}

TEST(Disturbance, PositionsMoveByWhatIsStated) {
    const Survey before = survey(fieldWithDoppler());
    const Survey offset = disturbed(before, Disturbance::GnssOffset);
    for (std::size_t run = 0; run < before.runs.size(); ++run) {
        for (const Eigen::Vector3d& by_m : moved(before, offset, run)) {
            ASSERT_NEAR(by_m.head<2>().norm(), 3.0, 1e-6);
            ASSERT_NEAR(by_m.z(), 4.0, 1e-6);
        }
    }
    const auto outliers = moved(before, disturbed(before, Disturbance::GnssOutliers), before.runs.size() - 1);
    double off = 0.0;
    double square_m2 = 0.0;
    for (const Eigen::Vector3d& by_m : outliers) {
        if (by_m.norm() < 1e-6) continue;
        off += 1.0;
        square_m2 += by_m.squaredNorm() / 3.0;
    }
    EXPECT_NEAR(off / static_cast<double>(outliers.size()), 0.1, 0.02);
    EXPECT_NEAR(std::sqrt(square_m2 / off), 6.0, 0.6);
}

TEST(Disturbance, ALateReceiverSaysWhatItReadBefore) {
    const Survey before = survey(fieldWithDoppler());
    const Survey late = disturbed(before, Disturbance::GnssLate);
    const ArrayLog& then = before.runs.back().log;
    const ArrayLog& now = late.runs.back().log;
    EXPECT_EQ(now.value(Channel::Fix, 0), fix_code::kNone);
    EXPECT_FALSE(present(now.value(Channel::Latitude, 0)));
    std::size_t compared = 0;
    for (std::size_t i = 2; i < then.size(); ++i) {
        if (std::abs(then.time_s[i] - then.time_s[i - 2] - 0.4) > 1e-9) continue;  // a row is lost between
        if (!present(then.value(Channel::Latitude, i - 2))) continue;
        ASSERT_EQ(now.value(Channel::Latitude, i), then.value(Channel::Latitude, i - 2));
        ++compared;
    }
    EXPECT_GT(compared, 1000U);
}

TEST(Disturbance, FlowIsZeroForATenthAndHitsAreShortForATwentieth) {
    const Survey before = survey(SimulationOptions{.seed = 5});
    const auto share = [&](Disturbance disturbance, Channel channel) {
        const Survey after = disturbed(before, disturbance);
        double changed = 0.0;
        double all = 0.0;
        for (std::size_t run = 0; run < before.runs.size(); ++run) {
            for (std::size_t i = 0; i < before.runs[run].log.size(); ++i) {
                const double was = before.runs[run].log.value(channel, i);
                if (!present(was)) continue;
                all += 1.0;
                if (after.runs[run].log.value(channel, i) != was) changed += 1.0;
            }
        }
        return changed / all;
    };
    EXPECT_NEAR(share(Disturbance::FlowZeros, Channel::FlowForward), 0.1, 0.08);
    EXPECT_NEAR(share(Disturbance::FlowSpikes, Channel::FlowForward), 0.02, 0.01);
    EXPECT_NEAR(share(Disturbance::RangeShort, Channel::Range), 0.05, 0.015);
    EXPECT_NEAR(share(Disturbance::ScatteredSilence, Channel::Pressure), 0.5, 0.1);
}

}  // namespace
}  // namespace terrawalk
