#include "fusion/simulation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "fusion/barometer.hpp"
#include "fusion/simulated_sensors.hpp"
#include "survey/mark_stands.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/small_survey.hpp"

namespace terrawalk {
namespace {

Result<SimulatedSurvey> trySimulate(const SimulationOptions& options) {
    SilentProgress progress;
    return simulateSurvey(options, progress, {});
}

SimulatedSurvey simulate(const SimulationOptions& options) {
    Result<SimulatedSurvey> result = trySimulate(options);
    if (!result) {
        ADD_FAILURE() << result.error().text();
        return {};
    }
    return std::move(*result);
}

SimulationOptions smallPlot() {
    SimulationOptions options = smallField(1);
    options.fixed_point_runs = 3;
    options.fixed_point_epochs = 130;
    return options;
}

SimulationOptions exactPlot() {
    SimulationOptions options = smallPlot();
    options.faults = FaultLevel::None;
    options.noise_scale = 0.0;
    options.doppler_velocity = true;
    options.range_lever_arm_m = {0.05, -0.02, -0.04};
    options.gnss_lever_arm_m = {-0.03, 0.01, 0.12};
    return options;
}

bool sameColumns(const ArrayLog& a, const ArrayLog& b, std::initializer_list<Channel> channels) {
    return std::all_of(channels.begin(), channels.end(),
                       [&](Channel c) { return sameBits(a.column(c), b.column(c)); });
}

bool sameLogs(const Survey& a, const Survey& b) {
    return std::equal(a.runs.begin(), a.runs.end(), b.runs.begin(), b.runs.end(),
                      [](const Run& x, const Run& y) {
                          for (std::size_t c = 0; c < kChannelCount; ++c) {
                              if (!sameBits(x.log.channels[c], y.log.channels[c])) return false;
                          }
                          return sameBits(x.log.time_s, y.log.time_s);
                      });
}

Attitude readAttitude(const ArrayLog& log, std::size_t i) {
    return {log.value(Channel::Roll, i), log.value(Channel::Pitch, i),
            yawFromHeading(log.value(Channel::Heading, i))};
}

Eigen::Vector3d readVector(const ArrayLog& log, Channel x, Channel y, Channel z, std::size_t i) {
    return {log.value(x, i), log.value(y, i), log.value(z, i)};
}

Eigen::Vector3d readGnss(const Survey& survey, const ArrayLog& log, std::size_t i) {
    return survey.frame().toEnu({log.value(Channel::Latitude, i), log.value(Channel::Longitude, i),
                                 log.value(Channel::EllipsoidalHeight, i)});
}

/// Mean and standard deviation of what is there.
struct Spread {
    double mean = 0.0;
    double sd = 0.0;
};
Spread spread(const std::vector<double>& values) {
    Spread s;
    for (const double v : values) s.mean += v;
    s.mean /= static_cast<double>(values.size());
    for (const double v : values) s.sd += (v - s.mean) * (v - s.mean);
    s.sd = std::sqrt(s.sd / static_cast<double>(values.size()));
    return s;
}

double autocovariance(const std::vector<double>& values, std::size_t lag) {
    const double mean = spread(values).mean;
    double sum = 0.0;
    for (std::size_t i = 0; i + lag < values.size(); ++i)
        sum += (values[i] - mean) * (values[i + lag] - mean);
    return sum / static_cast<double>(values.size() - lag);
}

// ---- what was asked for

TEST(Simulation, GivesTheSurveyOfThePaperByDefault) {
    const SimulatedSurvey simulated = simulate({});
    const Survey& survey = simulated.survey;
    EXPECT_THAT(survey.name, testing::HasSubstr("Simulated"));
    EXPECT_THAT(survey.notes, testing::Contains(testing::HasSubstr("not measured")));
    EXPECT_EQ(survey.crs, "EPSG:32649");
    ASSERT_EQ(survey.runs.size(), 17U);
    ASSERT_EQ(simulated.truth.size(), 17U);
    for (std::size_t r = 0; r < survey.runs.size(); ++r) {
        const terrawalk::Run& run = survey.runs[r];
        const bool fixed = r < 16;
        EXPECT_EQ(run.kind, fixed ? RunKind::FixedPoint : RunKind::Area);
        EXPECT_EQ(run.log.size(), fixed ? 259U : 9141U);
        EXPECT_EQ(run.start, "ZERO");
        EXPECT_EQ(run.stops.size(), fixed ? 0U : 4U);
        EXPECT_THAT(run.log.device,
                    testing::AllOf(testing::HasSubstr("simulated"), testing::HasSubstr("seed 1")));
        EXPECT_EQ(simulated.truth[r].run_id, run.id);
        ASSERT_EQ(simulated.truth[r].epochs.size(), run.log.size());
        for (std::size_t i = 0; i < run.log.size(); ++i) {
            EXPECT_EQ(simulated.truth[r].epochs[i].time_s, run.log.time_s[i]);
            if (i > 0) {
                EXPECT_GT(run.log.time_s[i], run.log.time_s[i - 1]);
            }
        }
    }
    EXPECT_EQ(survey.runs[0].id, "F01");
    EXPECT_EQ(survey.runs[0].target, "P01");
    EXPECT_EQ(survey.runs[16].id, "S01");
    EXPECT_EQ(survey.runs[16].target, "ZERO");
    std::map<MarkRole, int> roles;
    for (const ControlMark& mark : survey.marks) ++roles[mark.role];
    EXPECT_EQ(roles[MarkRole::Control], 16);
    EXPECT_EQ(roles[MarkRole::Check], 60);
    for (std::size_t k = 0; k < 16; ++k) {
        const double distance_m = survey.marks[k].enu_m.head<2>().norm();
        EXPECT_GT(distance_m, 9.5);
        EXPECT_LT(distance_m, 45.5);
    }
}

TEST(Simulation, LeavesOutWhatIsNotWanted) {
    SimulationOptions options = smallPlot();
    options.control_stops = 0;
    options.end_on_zero = false;
    options.check_points = 0;
    const SimulatedSurvey open = simulate(options);
    EXPECT_TRUE(open.survey.runs.back().stops.empty());
    EXPECT_FALSE(open.survey.runs.back().target);
    EXPECT_GT(open.truth.back().epochs.back().position_enu_m.head<2>().norm(), 2.0);
    EXPECT_EQ(open.survey.marks.size(), 3U);
    options.area_epochs = 0;
    EXPECT_EQ(simulate(options).survey.runs.size(), 3U);
    options.area_epochs = 1200;
    options.fixed_point_runs = 0;
    EXPECT_EQ(simulate(options).survey.runs.size(), 1U);
}

TEST(Simulation, MarksLieOnTheGroundWithinTheirSigma) {
    SimulationOptions options;
    options.area_epochs = 0;
    options.control_stops = 0;
    options.check_points = 400;
    options.terrain = SimulatedTerrain::Plain;  // level: an error sideways does not show as one in height
    options.mark_sigma_v_m = 0.02;
    const SimulatedSurvey simulated = simulate(options);
    std::vector<double> errors_m;
    for (const ControlMark& mark : simulated.survey.marks) {
        EXPECT_EQ(mark.sigma_v_m, 0.02);
        errors_m.push_back(mark.enu_m.z() - simulated.terrain_height_m(mark.enu_m.x(), mark.enu_m.y()));
    }
    EXPECT_NEAR(spread(errors_m).mean, 0.0, 4.0 * 0.02 / std::sqrt(416.0));
    EXPECT_NEAR(spread(errors_m).sd, 0.02, 4.0 * 0.02 / std::sqrt(2.0 * 416.0));

    options.noise_scale = 0.0;
    const SimulatedSurvey exact = simulate(options);
    for (const ControlMark& mark : exact.survey.marks)
        EXPECT_EQ(mark.enu_m.z(), exact.terrain_height_m(mark.enu_m.x(), mark.enu_m.y()));
}

TEST(Simulation, CheckPointsCoverTheWholeArea) {
    const SimulatedSurvey simulated = simulate({});
    std::map<std::pair<int, int>, int> quarters;
    for (const ControlMark& mark : simulated.survey.marks) {
        if (mark.role != MarkRole::Check) continue;
        EXPECT_LE(std::abs(mark.enu_m.x()), 25.0);
        EXPECT_LE(std::abs(mark.enu_m.y() - 20.0), 30.0);
        ++quarters[{mark.enu_m.x() > 0.0, mark.enu_m.y() > 20.0}];
    }
    ASSERT_EQ(quarters.size(), 4U);
    for (const auto& [quarter, count] : quarters) EXPECT_GE(count, 10);
}

TEST(Simulation, ArrayStandsStillOverEveryMarkItSaysItStandsOn) {
    SimulationOptions options = smallPlot();
    options.check_stops = 2;
    for (const FaultLevel faults : {FaultLevel::None, FaultLevel::Severe}) {
        options.faults = faults;
        const SimulatedSurvey simulated = simulate(options);
        EXPECT_EQ(simulated.survey.runs.back().stops.size(), 4U);
        for (std::size_t r = 0; r < simulated.survey.runs.size(); ++r) {
            const terrawalk::Run& run = simulated.survey.runs[r];
            const std::vector<MarkStand> stands = markStands(simulated.survey, run, {});
            ASSERT_EQ(stands.size(), 2U + run.stops.size());
            for (const MarkStand& stand : stands) {
                int epochs = 0;
                for (const TrajectoryEpoch& epoch : simulated.truth[r].epochs) {
                    if (epoch.time_s < stand.from_s || epoch.time_s > stand.to_s) continue;
                    ++epochs;
                    // Plumbing 2 cm and tremor 0.5 cm per axis, mark 0.5 cm: ten centimetres are four sigma.
                    EXPECT_LT((epoch.position_enu_m - stand.mark.enu_m).head<2>().norm(), 0.1) << run.id;
                    EXPECT_LT(epoch.velocity_enu_mps.norm(), 0.15) << run.id;
                }
                EXPECT_GE(epochs, 5) << run.id << ' ' << stand.mark.name;
            }
        }
    }
}

TEST(Simulation, PersonMovesAsPeopleDo) {
    for (const SimulatedTerrain terrain : {SimulatedTerrain::TerracedOrchard, SimulatedTerrain::Gully}) {
        for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
            SimulationOptions options;
            options.seed = seed;
            options.terrain = terrain;
            options.check_stops = 3;
            const SimulatedSurvey simulated = simulate(options);
            for (const Trajectory& truth : simulated.truth) {
                double walked_m = 0.0;
                double walked_s = 0.0;
                for (std::size_t i = 1; i < truth.epochs.size(); ++i) {
                    const TrajectoryEpoch& now = truth.epochs[i];
                    const double speed_mps = now.velocity_enu_mps.head<2>().norm();
                    const double step_s = now.time_s - truth.epochs[i - 1].time_s;
                    ASSERT_LT(speed_mps, 1.6) << truth.run_id << ' ' << now.time_s;
                    if (speed_mps > 0.3) {
                        walked_m += speed_mps * step_s;
                        walked_s += step_s;
                    }
                    const double turn_rad =
                        wrapAngle(now.attitude.yaw_rad - truth.epochs[i - 1].attitude.yaw_rad);
                    ASSERT_LT(std::abs(turn_rad) / step_s, 3.0) << truth.run_id << ' ' << now.time_s;
                    ASSERT_LT(std::abs(now.attitude.roll_rad), radians(25.0));
                    ASSERT_LT(std::abs(now.attitude.pitch_rad), radians(25.0));
                    const Eigen::Vector3d& p = now.position_enu_m;
                    const double above_m = p.z() - simulated.terrain_height_m(p.x(), p.y());
                    ASSERT_GT(above_m, 0.6);
                    ASSERT_LT(above_m, 2.0);
                }
                EXPECT_GT(walked_m / walked_s, 0.45) << truth.run_id;
                EXPECT_LT(walked_m / walked_s, 1.1) << truth.run_id;
            }
        }
    }
}

TEST(Simulation, AreaWalkCrossesItsOwnTrack) {
    const SimulatedSurvey simulated = simulate({});
    const std::vector<TrajectoryEpoch>& epochs = simulated.truth.back().epochs;
    int crossings = 0;
    const auto side = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
        return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    };
    std::vector<Eigen::Vector3d> way;
    for (std::size_t i = 50; i + 50 < epochs.size(); i += 5) way.push_back(epochs[i].position_enu_m);
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
        for (std::size_t j = i + 20; j + 1 < way.size(); ++j) {
            if ((way[i] - way[j]).head<2>().norm() > 3.0) continue;
            crossings += side(way[i], way[i + 1], way[j]) * side(way[i], way[i + 1], way[j + 1]) < 0.0 &&
                                 side(way[j], way[j + 1], way[i]) * side(way[j], way[j + 1], way[i + 1]) < 0.0
                             ? 1
                             : 0;
        }
    }
    EXPECT_GE(crossings, 15) << "a way back across twenty lines";
}

// ---- seeds and streams

TEST(Simulation, SameSeedGivesTheSameBitsAndAnotherSeedDoesNot) {
    SimulationOptions options = smallPlot();
    const SimulatedSurvey one = simulate(options);
    const SimulatedSurvey again = simulate(options);
    EXPECT_TRUE(sameLogs(one.survey, again.survey));
    for (std::size_t i = 0; i < one.survey.marks.size(); ++i)
        EXPECT_EQ(one.survey.marks[i].enu_m, again.survey.marks[i].enu_m);
    EXPECT_EQ(one.terrain_height_m(3.3, 7.7), again.terrain_height_m(3.3, 7.7));
    options.seed = 2;
    const SimulatedSurvey other = simulate(options);
    EXPECT_FALSE(sameLogs(one.survey, other.survey));
    EXPECT_NE(one.survey.marks[0].enu_m, other.survey.marks[0].enu_m);
}

TEST(Simulation, OneSensorsOptionsLeaveTheOthersAlone) {
    SimulationOptions options = smallPlot();
    const SimulatedSurvey single = simulate(options);
    options.gnss = GnssMode::Rtk;
    options.doppler_velocity = true;
    const SimulatedSurvey rtk = simulate(options);
    for (std::size_t r = 0; r < single.survey.runs.size(); ++r) {
        const ArrayLog& a = single.survey.runs[r].log;
        const ArrayLog& b = rtk.survey.runs[r].log;
        EXPECT_TRUE(sameColumns(a, b,
                                {Channel::Pressure, Channel::FlowForward, Channel::Roll, Channel::Heading,
                                 Channel::AccelerationX, Channel::AngularRateZ, Channel::Range}));
        EXPECT_FALSE(sameColumns(a, b, {Channel::Latitude}));
    }
    // Another number of runs sends them to other targets; what does not depend on the way stays.
    options.fixed_point_runs = 2;
    const SimulatedSurvey fewer = simulate(options);
    EXPECT_TRUE(sameColumns(rtk.survey.runs[0].log, fewer.survey.runs[0].log, {Channel::Temperature}));
    EXPECT_TRUE(sameColumns(rtk.survey.runs[3].log, fewer.survey.runs[2].log, {Channel::Temperature}));
}

TEST(Simulation, FaultsChangeWhatIsReadAndNotWhereThePersonWalked) {
    SimulationOptions options = smallPlot();
    options.faults = FaultLevel::None;
    const SimulatedSurvey none = simulate(options);
    options.faults = FaultLevel::Severe;
    const SimulatedSurvey severe = simulate(options);
    for (std::size_t r = 0; r < none.truth.size(); ++r) {
        std::map<double, Eigen::Vector3d> walked;
        for (const TrajectoryEpoch& epoch : none.truth[r].epochs) walked[epoch.time_s] = epoch.position_enu_m;
        std::size_t compared = 0;
        for (const TrajectoryEpoch& epoch : severe.truth[r].epochs) {
            const auto same_time = walked.find(epoch.time_s);
            if (same_time == walked.end()) continue;  // rows lost on the way are made up for at the end
            EXPECT_EQ(same_time->second, epoch.position_enu_m);
            ++compared;
        }
        EXPECT_GT(compared, none.truth[r].epochs.size() * 9 / 10);
    }
}

// ---- exact sensors

class ExactSensors : public testing::TestWithParam<SimulatedTerrain> {};
INSTANTIATE_TEST_SUITE_P(Kinds, ExactSensors,
                         testing::Values(SimulatedTerrain::TerracedOrchard, SimulatedTerrain::Gully,
                                         SimulatedTerrain::Ramp),
                         [](const testing::TestParamInfo<SimulatedTerrain>& kind) {
                             return "Terrain" + std::to_string(static_cast<int>(kind.param));
                         });

TEST_P(ExactSensors, PutEveryGroundPointOnTheTerrain) {
    SimulationOptions options = exactPlot();
    options.terrain = GetParam();
    const SimulatedSurvey simulated = simulate(options);
    for (const terrawalk::Run& run : simulated.survey.runs) {
        for (std::size_t i = 0; i < run.log.size(); ++i) {
            // From the log alone: antenna to array, array to range finder, range finder to the ground.
            const Eigen::Matrix3d rotation = rotationEnuFromBody(readAttitude(run.log, i));
            const Eigen::Vector3d array_m =
                readGnss(simulated.survey, run.log, i) - rotation * run.log.gnss_lever_arm_m;
            const Eigen::Vector3d beam_m =
                run.log.range_lever_arm_m - run.log.value(Channel::Range, i) * Eigen::Vector3d::UnitZ();
            const Eigen::Vector3d ground_m = array_m + rotation * beam_m;
            ASSERT_NEAR(ground_m.z(), simulated.terrain_height_m(ground_m.x(), ground_m.y()), 1e-6)
                << run.id << ' ' << i;
        }
    }
}

TEST_P(ExactSensors, ReadTheTruePositionAttitudeAndVelocity) {
    SimulationOptions options = exactPlot();
    options.terrain = GetParam();
    options.gnss_lever_arm_m.setZero();
    const SimulatedSurvey simulated = simulate(options);
    for (std::size_t r = 0; r < simulated.truth.size(); ++r) {
        const ArrayLog& log = simulated.survey.runs[r].log;
        for (std::size_t i = 0; i < log.size(); ++i) {
            const TrajectoryEpoch& truth = simulated.truth[r].epochs[i];
            ASSERT_LT((readGnss(simulated.survey, log, i) - truth.position_enu_m).norm(), 1e-7);
            // Pressure falls by 12 Pa/m: 1e-11 of 1e5 Pa are 1e-7 m.
            ASSERT_NEAR(isaHeight(log.value(Channel::Pressure, i)) - 38.0, truth.position_enu_m.z(), 1e-6);
            const Attitude attitude = readAttitude(log, i);
            ASSERT_NEAR(attitude.roll_rad, truth.attitude.roll_rad, 1e-12);
            ASSERT_NEAR(attitude.pitch_rad, truth.attitude.pitch_rad, 1e-12);
            ASSERT_NEAR(wrapAngle(attitude.yaw_rad - truth.attitude.yaw_rad), 0.0, 1e-12);
            ASSERT_GE(log.value(Channel::Heading, i), 0.0);
            ASSERT_LT(log.value(Channel::Heading, i), 2.0 * kPi);
            const double yaw_rad = attitude.yaw_rad;
            const double forward_mps = log.value(Channel::FlowForward, i);
            const double left_mps = log.value(Channel::FlowLeft, i);
            ASSERT_NEAR(std::cos(yaw_rad) * forward_mps - std::sin(yaw_rad) * left_mps,
                        truth.velocity_enu_mps.x(), 1e-9);
            ASSERT_NEAR(std::sin(yaw_rad) * forward_mps + std::cos(yaw_rad) * left_mps,
                        truth.velocity_enu_mps.y(), 1e-9);
            const Eigen::Vector3d doppler_mps = readVector(
                log, Channel::GnssVelocityEast, Channel::GnssVelocityNorth, Channel::GnssVelocityUp, i);
            ASSERT_LT((doppler_mps - truth.velocity_enu_mps).norm(), 1e-12);
        }
    }
}

TEST(ExactSensorsOnTheMove, InertialReadingsAreTheDerivativesOfTheMotion) {
    SimulationOptions options = exactPlot();
    options.sample_interval_s = 0.01;
    options.fixed_point_epochs = 4000;
    options.area_epochs = 0;
    options.control_stops = 0;
    const SimulatedSurvey simulated = simulate(options);
    const double h = options.sample_interval_s;
    for (std::size_t r = 0; r < simulated.truth.size(); ++r) {
        const ArrayLog& log = simulated.survey.runs[r].log;
        const std::vector<TrajectoryEpoch>& truth = simulated.truth[r].epochs;
        for (std::size_t i = 1; i + 1 < log.size(); ++i) {
            const Eigen::Matrix3d rotation = rotationEnuFromBody(truth[i].attitude);
            const Eigen::Vector3d force =
                readVector(log, Channel::AccelerationX, Channel::AccelerationY, Channel::AccelerationZ, i);
            const Eigen::Vector3d acceleration =
                rotation * force - Eigen::Vector3d(0.0, 0.0, kStandardGravity_mps2);
            const Eigen::Vector3d second_difference =
                (truth[i + 1].position_enu_m - 2.0 * truth[i].position_enu_m + truth[i - 1].position_enu_m) /
                (h * h);
            // h^2/12 times the fourth derivative: 12 mm of bounce at 12 rad/s give 0.002; steps on risers
            // some more.
            ASSERT_LT((acceleration - second_difference).norm(), 0.02) << i;
            const Eigen::Vector3d first_difference =
                (truth[i + 1].position_enu_m - truth[i - 1].position_enu_m) / (2.0 * h);
            ASSERT_LT((truth[i].velocity_enu_mps - first_difference).norm(), 0.002);
            const Eigen::Vector3d rate =
                readVector(log, Channel::AngularRateX, Channel::AngularRateY, Channel::AngularRateZ, i);
            const Eigen::Matrix3d turned = rotation.transpose() * rotationEnuFromBody(truth[i + 1].attitude) -
                                           rotation.transpose() * rotationEnuFromBody(truth[i - 1].attitude);
            const Eigen::Vector3d turn_rate =
                Eigen::Vector3d(turned(2, 1) - turned(1, 2), turned(0, 2) - turned(2, 0),
                                turned(1, 0) - turned(0, 1)) /
                (4.0 * h);
            ASSERT_LT((rate - turn_rate).norm(), 0.002);
        }
    }
}

TEST(ExactSensorsOnTheMove, HeadingIsClockwiseFromNorthAndFlowPointsForward) {
    SimulationOptions options = exactPlot();
    const SimulatedSurvey simulated = simulate(options);
    const ArrayLog& log = simulated.survey.runs.back().log;
    int eastward = 0;
    int westward = 0;
    for (std::size_t i = 0; i < log.size(); ++i) {
        const Eigen::Vector3d v = simulated.truth.back().epochs[i].velocity_enu_mps;
        if (v.head<2>().norm() < 0.4 || std::abs(v.y()) > 0.1) continue;
        const double heading_deg = degrees(log.value(Channel::Heading, i));
        (v.x() > 0.0 ? eastward : westward) += 1;
        EXPECT_NEAR(heading_deg, v.x() > 0.0 ? 90.0 : 270.0, 45.0);
        EXPECT_GT(log.value(Channel::FlowForward, i), 0.25);
    }
    EXPECT_GT(eastward, 100);
    EXPECT_GT(westward, 100);
}

// ---- sizes of the errors, on an array that lies still 1.2 m above a ramp

struct StillArray {
    TerrainModel terrain{SimulatedTerrain::Ramp, 1};
    LocalFrame frame{GeodeticPosition{23.182753, 113.399795, 38.0}};
    SimulationOptions options;
    std::vector<WalkSample> samples;

    explicit StillArray(FaultLevel faults, std::size_t epochs = 60'000) : samples(epochs) {
        options.faults = faults;
        options.sample_interval_s = 1.0;
        for (std::size_t i = 0; i < epochs; ++i) {
            samples[i].time_s = static_cast<double>(i);
            samples[i].position_m = {0.0, 0.0, 1.2};
        }
    }
    [[nodiscard]] ArrayLog log(std::uint64_t run = 1) const {
        return senseWalk(samples, terrain, frame, options, run, static_cast<double>(samples.size()), {});
    }
};

TEST(SensorErrors, GnssErrorIsGaussMarkovOfTheTablesSize) {
    const StillArray still(FaultLevel::None);
    const ArrayLog log = still.log();
    std::array<std::vector<double>, 3> errors_m;
    for (std::size_t i = 0; i < log.size(); ++i) {
        const Eigen::Vector3d error_m =
            still.frame.toEnu({log.value(Channel::Latitude, i), log.value(Channel::Longitude, i),
                               log.value(Channel::EllipsoidalHeight, i)}) -
            still.samples[i].position_m;
        for (int axis = 0; axis < 3; ++axis)
            errors_m[static_cast<std::size_t>(axis)].push_back(error_m[axis]);
        EXPECT_EQ(log.value(Channel::Fix, i), fix_code::kSingle);
    }
    // 600 correlation times: the variance of such a process is known to sqrt(2 / 600 * ...) = 6 %, four times
    // that is 12 % of its root.
    const GnssErrors sizes = gnssErrors(fix_code::kSingle);
    EXPECT_NEAR(std::hypot(sizes.slow_h_m, sizes.white_h_m), 1.5 / 1.1774, 0.01) << "1.5 m CEP, Table 3";
    double correlation = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double slow_m = axis < 2 ? sizes.slow_h_m : sizes.slow_v_m;
        const double white_m = axis < 2 ? sizes.white_h_m : sizes.white_v_m;
        EXPECT_NEAR(spread(errors_m[axis]).sd, std::hypot(slow_m, white_m), 0.12 * slow_m);
        EXPECT_NEAR(spread(errors_m[axis]).mean, 0.0, 4.0 * slow_m * std::sqrt(2.0 / 600.0));
        correlation += autocovariance(errors_m[axis], 100) / (slow_m * slow_m) / 3.0;
        // From one epoch to the next only white noise and a hundredth of the slow variance.
        std::vector<double> steps_m;
        for (std::size_t i = 1; i < errors_m[axis].size(); ++i)
            steps_m.push_back(errors_m[axis][i] - errors_m[axis][i - 1]);
        const double step_variance =
            2.0 * white_m * white_m + 2.0 * slow_m * slow_m * (1.0 - std::exp(-0.01));
        EXPECT_NEAR(spread(steps_m).sd, std::sqrt(step_variance), 0.02 * std::sqrt(step_variance));
    }
    EXPECT_NEAR(correlation, std::exp(-1.0), 0.12) << "at a lag of one correlation time";
}

TEST(SensorErrors, WhiteNoiseIsOfTheTablesSize) {
    const StillArray still(FaultLevel::None);
    const ArrayLog log = still.log();
    const SensorErrors sizes = sensorErrors(FaultLevel::None);
    // 60000 values: a standard deviation is known to 0.3 %; 1.2 % are four times that.
    const auto expectSpread = [&](Channel c, double mean, double sd) {
        const Spread s = spread(log.column(c));
        EXPECT_NEAR(s.mean, mean, 4.0 * sd / std::sqrt(60'000.0))
            << kChannels[static_cast<std::size_t>(c)].column;
        EXPECT_NEAR(s.sd, sd, 0.012 * sd) << kChannels[static_cast<std::size_t>(c)].column;
        EXPECT_NEAR(autocovariance(log.column(c), 1), 0.0, 4.0 * sd * sd / std::sqrt(60'000.0))
            << kChannels[static_cast<std::size_t>(c)].column;
    };
    // Table 2: 6 cm at 2 sigma, rounded to 1 cm.
    expectSpread(Channel::Range, 1.2, std::hypot(0.03, 0.01 / std::sqrt(12.0)));
    expectSpread(Channel::Roll, 0.0, radians(0.05));
    expectSpread(Channel::Pitch, 0.0, radians(0.05));
    expectSpread(Channel::FlowForward, 0.0, sizes.flow_white_mps);
    expectSpread(Channel::FlowLeft, 0.0, sizes.flow_white_mps);
    expectSpread(Channel::AccelerationX, 0.0, sizes.accelerometer_white_mps2);
    expectSpread(Channel::AccelerationZ, kStandardGravity_mps2, sizes.accelerometer_white_mps2);
    expectSpread(Channel::AngularRateY, 0.0, sizes.gyro_white_radps);
    expectSpread(Channel::Heading, 0.5 * kPi, radians(0.5));
    std::vector<double> heights_m;
    for (const double p : log.column(Channel::Pressure)) heights_m.push_back(isaHeight(p) - 38.0);
    EXPECT_NEAR(spread(heights_m).mean, 1.2, 4.0 * sizes.barometer_white_m / std::sqrt(60'000.0));
    EXPECT_NEAR(spread(heights_m).sd, sizes.barometer_white_m, 0.012 * sizes.barometer_white_m);
    for (const double range_m : log.column(Channel::Range))
        ASSERT_NEAR(range_m * 100.0, std::round(range_m * 100.0), 1e-9) << "1 cm, Table 2";
}

TEST(SensorErrors, NoiseScaleMultipliesThem) {
    StillArray still(FaultLevel::None, 20'000);
    const double once = spread(still.log().column(Channel::Roll)).sd;
    still.options.noise_scale = 3.0;
    EXPECT_NEAR(spread(still.log().column(Channel::Roll)).sd, 3.0 * once, 1e-12);
}

TEST(SensorErrors, BarometerDriftGrowsWithTheRootOfTime) {
    const StillArray still(FaultLevel::Severe);
    const SensorErrors sizes = sensorErrors(FaultLevel::Severe);
    const ArrayLog log = still.log();
    for (const std::size_t minutes : {5U, 20U}) {
        const std::size_t lag = 60 * minutes;
        double sum = 0.0;
        std::size_t n = 0;
        for (std::size_t i = 0; i + lag < log.size(); ++i) {
            const double from = log.value(Channel::Pressure, i);
            const double to = log.value(Channel::Pressure, i + lag);
            if (!present(from) || !present(to)) continue;
            sum += std::pow(isaHeight(to) - isaHeight(from), 2);
            ++n;
        }
        const double drift = sizes.barometer_drift_m_per_sqrt_min * sizes.barometer_drift_m_per_sqrt_min;
        const double others = std::pow(sizes.barometer_gust_m, 2) + std::pow(sizes.barometer_white_m, 2);
        const double expected = drift * static_cast<double>(minutes) + 2.0 * others;
        // 1000 minutes hold 50 independent stretches of 20: 20 % on the variance, twice that is allowed.
        EXPECT_NEAR(sum / static_cast<double>(n), expected, 0.4 * expected) << minutes;
    }
}

TEST(SensorErrors, RtkIsAsGoodAsItsFix) {
    StillArray still(FaultLevel::None);
    for (const auto& [mode, fix] :
         {std::pair{GnssMode::Rtk, fix_code::kRtkFixed}, {GnssMode::Float, fix_code::kRtkFloat}}) {
        still.options.gnss = mode;
        const ArrayLog log = still.log();
        const GnssErrors sizes = gnssErrors(fix);
        std::vector<double> heights_m;
        for (std::size_t i = 0; i < log.size(); ++i) {
            ASSERT_EQ(log.value(Channel::Fix, i), fix);
            heights_m.push_back(log.value(Channel::EllipsoidalHeight, i));
        }
        const double sd_m = std::hypot(sizes.slow_v_m, sizes.white_v_m);
        EXPECT_NEAR(spread(heights_m).sd, sd_m, 0.12 * sd_m);
        EXPECT_NEAR(spread(log.column(Channel::GnssVerticalAccuracy)).mean, sd_m, 0.15 * sd_m)
            << "the receiver's own estimate";
    }
}

TEST(SensorErrors, OutageLeavesTheMiddleFifthWithoutPosition) {
    StillArray still(FaultLevel::None, 1000);
    still.options.gnss = GnssMode::Outage;
    still.options.doppler_velocity = true;
    const ArrayLog log = still.log();
    for (std::size_t i = 0; i < log.size(); ++i) {
        const bool out = i >= 400 && i < 600;
        const int expected =
            out ? fix_code::kNone : (i >= 600 && i < 615 ? fix_code::kRtkFloat : fix_code::kRtkFixed);
        EXPECT_EQ(log.value(Channel::Fix, i), expected) << i;
        for (const Channel c : {Channel::Latitude, Channel::EllipsoidalHeight, Channel::GnssVerticalAccuracy,
                                Channel::GnssVelocityEast})
            EXPECT_EQ(present(log.value(c, i)), !out) << i;
    }
}

// ---- faults

/// Shares of the epochs in which something is not as it should be.
struct FaultShares {
    double missing = 0.0;
    double flow_lost = 0.0;
    double range_lost = 0.0;
    double range_short = 0.0;
    double lost_rows = 0.0;
    double gnss_far_off = 0.0;
};

FaultShares faultShares(FaultLevel level) {
    SimulationOptions options;
    options.faults = level;
    options.range_lever_arm_m = {0.03, 0.0, -0.02};
    const SimulatedSurvey simulated = simulate(options);
    const terrawalk::Run& run = simulated.survey.runs.back();
    const auto n = static_cast<double>(run.log.size());
    FaultShares shares;
    for (std::size_t i = 0; i < run.log.size(); ++i) {
        const TrajectoryEpoch& truth = simulated.truth.back().epochs[i];
        const double range_m = run.log.value(Channel::Range, i);
        const double height_m =
            truth.position_enu_m.z() -
            simulated.terrain_height_m(truth.position_enu_m.x(), truth.position_enu_m.y());
        shares.missing += present(run.log.value(Channel::Pressure, i)) ? 0.0 : 1.0 / n;
        shares.flow_lost += run.log.value(Channel::FlowQuality, i) == 0.0 ? 1.0 / n : 0.0;
        shares.range_lost += range_m > 12.0 ? 1.0 / n : 0.0;
        shares.range_short += range_m < height_m - 0.15 ? 1.0 / n : 0.0;
        if (present(run.log.value(Channel::Latitude, i))) {
            const double off_m = (readGnss(simulated.survey, run.log, i) - truth.position_enu_m).norm();
            shares.gnss_far_off += off_m > 7.0 ? 1.0 / n : 0.0;
        }
    }
    shares.lost_rows = 1.0 - (n - 1.0) * options.sample_interval_s / run.log.time_s.back();
    return shares;
}

TEST(Faults, AreAbsentMildAndSevereInThisOrder) {
    const FaultShares none = faultShares(FaultLevel::None);
    const FaultShares mild = faultShares(FaultLevel::Mild);
    const FaultShares severe = faultShares(FaultLevel::Severe);
    const auto expectOrder = [](double a, double b, double c, double least_b, double most_c,
                                const char* what) {
        EXPECT_NEAR(a, 0.0, 1e-9) << what;
        EXPECT_GT(b, least_b) << what;
        EXPECT_GT(c, 1.3 * b) << what;
        EXPECT_LT(c, most_c) << what;
    };
    expectOrder(none.missing, mild.missing, severe.missing, 0.003, 0.035, "missing fields");
    expectOrder(none.flow_lost, mild.flow_lost, severe.flow_lost, 0.03, 0.5, "flow drop-outs");
    expectOrder(none.range_lost, mild.range_lost, severe.range_lost, 0.001, 0.04, "ranges without return");
    expectOrder(none.lost_rows, mild.lost_rows, severe.lost_rows, 0.0002, 0.02, "lost rows");
    // Steep ground and noise shorten ranges at every level; grass does so beyond that.
    EXPECT_GT(mild.range_short, none.range_short + 0.02);
    EXPECT_GT(severe.range_short, 1.3 * mild.range_short);
    EXPECT_GT(severe.gnss_far_off, none.gnss_far_off);
}

TEST(Faults, FlowWithoutTextureSaysSo) {
    const SimulatedSurvey simulated = simulate(smallPlot());
    int drops = 0;
    for (const terrawalk::Run& run : simulated.survey.runs) {
        for (std::size_t i = 0; i < run.log.size(); ++i) {
            if (run.log.value(Channel::FlowQuality, i) != 0.0) continue;
            ++drops;
            EXPECT_EQ(run.log.value(Channel::FlowForward, i), 0.0);
            EXPECT_EQ(run.log.value(Channel::FlowLeft, i), 0.0);
        }
    }
    EXPECT_GT(drops, 10);
}

TEST(Faults, RangeStrengthTellsLostAndBlockedRanges) {
    SimulationOptions options;
    options.faults = FaultLevel::Severe;
    const ArrayLog log = simulate(options).survey.runs.back().log;
    int lost = 0;
    int blocked = 0;
    for (std::size_t i = 0; i < log.size(); ++i) {
        const double range_m = log.value(Channel::Range, i);
        const double strength = log.value(Channel::RangeStrength, i);
        if (!present(range_m)) continue;
        if (range_m > kRangeGreatest_m) {
            ++lost;
            EXPECT_EQ(range_m, kNoReturnRange_m);
            EXPECT_LT(strength, 20.0);
        } else if (range_m < kRangeLeast_m) {
            ++blocked;
        } else {
            EXPECT_GE(strength, 20.0);
            EXPECT_LT(strength, 2000.0);
        }
    }
    EXPECT_GT(lost, 50);
    EXPECT_GT(blocked, 5);
}

TEST(Faults, LostRowsLeaveGapsAndKeepTheCount) {
    const std::vector<std::uint64_t> whole = keptTicks(100, 0.0, 1, 1);
    EXPECT_EQ(whole.front(), 0U);
    EXPECT_EQ(whole.back(), 99U);
    const std::vector<std::uint64_t> torn = keptTicks(10'000, 0.01, 1, 1);
    EXPECT_EQ(torn.size(), 10'000U);
    EXPECT_EQ(torn.front(), 0U);
    // About 101 lost: 4 sigma are 40.
    EXPECT_NEAR(static_cast<double>(torn.back()) - 9'999.0, 101.0, 40.0);
    EXPECT_TRUE(std::is_sorted(torn.begin(), torn.end(), std::less_equal<>()));
}

// ---- what cannot be

TEST(Simulation, RefusesWhatCannotBeWalkedAndSaysWhy) {
    const auto refuses = [](auto change, const char* says) {
        SimulationOptions options = smallPlot();
        change(options);
        const Result<SimulatedSurvey> result = trySimulate(options);
        ASSERT_FALSE(result) << says;
        EXPECT_EQ(result.error().kind, ErrorKind::Usage);
        EXPECT_THAT(result.error().text(), testing::HasSubstr(says));
        EXPECT_FALSE(result.error().cure.empty());
    };
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    refuses([](SimulationOptions& o) { o.area_epochs = 400; }, "too few to walk");
    refuses([](SimulationOptions& o) { o.area_epochs = 1; }, "too few to walk");
    refuses([](SimulationOptions& o) { o.fixed_point_epochs = 40; }, "too few to stand");
    refuses([](SimulationOptions& o) { o.fixed_point_epochs = 0; }, "too few to stand");
    refuses([](SimulationOptions& o) { o.control_stops = 4; }, "4 stops on control marks");
    refuses([](SimulationOptions& o) { o.check_stops = 13; }, "13 stops on check marks");
    refuses([](SimulationOptions& o) { o.area_epochs = 0; }, "stops need an area walk");
    refuses([](SimulationOptions& o) { o.fixed_point_runs = 0, o.area_epochs = 0, o.control_stops = 0; },
            "nothing");
    refuses([](SimulationOptions& o) { o.area_east_m = 1.0; }, "area");
    refuses([](SimulationOptions& o) { o.area_north_m = kNan; }, "area");
    refuses([](SimulationOptions& o) { o.line_spacing_m = 0.0; }, "lines");
    refuses([](SimulationOptions& o) { o.sample_interval_s = 0.0; }, "sample interval");
    refuses([](SimulationOptions& o) { o.noise_scale = -1.0; }, "noise scale");
    refuses([](SimulationOptions& o) { o.mark_sigma_v_m = -0.1; }, "sigma");
    refuses([](SimulationOptions& o) { o.range_lever_arm_m.x() = kNan; }, "lever arm");
    refuses([](SimulationOptions& o) { o.area_epochs = 1'000'000'000; }, "too large");
}

TEST(Simulation, TheEpochsItAsksForAreEnough) {
    SimulationOptions options = smallPlot();
    options.area_epochs = 400;
    const Result<SimulatedSurvey> refused = trySimulate(options);
    ASSERT_FALSE(refused);
    options.area_epochs = std::stoul(refused.error().cure.substr(std::string("ask for ").size()));
    EXPECT_GT(options.area_epochs, 400U);
    EXPECT_TRUE(trySimulate(options));
}

TEST(Simulation, StopsWhenTold) {
    std::stop_source stop;
    stop.request_stop();
    SilentProgress progress;
    const Result<SimulatedSurvey> result = simulateSurvey(smallPlot(), progress, stop.get_token());
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace terrawalk
