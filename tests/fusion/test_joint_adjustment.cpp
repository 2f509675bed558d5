#include "fusion/joint_adjustment.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "fusion/fuse_survey.hpp"
#include "tests/fusion/measured_survey.hpp"
#include "tests/support/small_survey.hpp"

namespace terrawalk {
namespace {

FusedSurvey fused(const Survey& survey, const FusionOptions& options = {}) {
    SilentProgress progress;
    auto result = fuseSurvey(survey, options, progress, {});
    if (!result) throw std::runtime_error(result.error().text());
    return std::move(*result);
}

const FusedRun& runOf(const FusedSurvey& survey, const std::string& id) {
    return *std::find_if(survey.runs.begin(), survey.runs.end(),
                         [&](const FusedRun& run) { return run.trajectory.run_id == id; });
}

double worstDistance(const Trajectory& a, const Trajectory& b) {
    EXPECT_EQ(a.epochs.size(), b.epochs.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < std::min(a.epochs.size(), b.epochs.size()); ++i) {
        worst = std::max(worst, (a.epochs[i].position_enu_m - b.epochs[i].position_enu_m).norm());
    }
    return worst;
}

double rmsError(const FusedSurvey& survey, const SimulatedSurvey& simulated, std::size_t run, bool up) {
    double squares = 0.0;
    const auto& epochs = survey.runs[run].trajectory.epochs;
    for (std::size_t i = 0; i < epochs.size(); ++i) {
        const Eigen::Vector3d error =
            epochs[i].position_enu_m - simulated.truth[run].epochs[i].position_enu_m;
        squares += up ? error.z() * error.z() : error.head<2>().squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(epochs.size()));
}

std::size_t downWeighted(const FusedSurvey& survey, const std::string& source) {
    for (const NoiseFactor& noise : survey.adjustment.value().noise) {
        if (noise.source == source) return noise.down_weighted;
    }
    ADD_FAILURE() << "no " << source;
    return 0;
}

Survey withOriginMoved(const Survey& survey, const Eigen::Vector3d& origin_enu_m) {
    Survey moved = survey;
    const LocalFrame before = survey.frame();
    moved.zero_point = before.toGeodetic(origin_enu_m);
    const LocalFrame after = moved.frame();
    moved.marks.push_back({"OLD", Eigen::Vector3d::Zero(), 0.0, 0.0, MarkRole::Control});
    for (ControlMark& mark : moved.marks) mark.enu_m = after.toEnu(before.toGeodetic(mark.enu_m));
    const auto renamed = [](std::optional<std::string>& name) {
        if (name == std::string(kZeroMark)) name = "OLD";
    };
    for (terrawalk::Run& run : moved.runs) {
        renamed(run.start);
        renamed(run.target);
        for (Stop& stop : run.stops) {
            if (stop.point == kZeroMark) stop.point = "OLD";
        }
    }
    return moved;
}

bool sameBytes(const FusedSurvey& a, const FusedSurvey& b) {
    for (std::size_t r = 0; r < a.runs.size(); ++r) {
        for (std::size_t i = 0; i < a.runs[r].trajectory.epochs.size(); ++i) {
            const TrajectoryEpoch& x = a.runs[r].trajectory.epochs[i];
            const TrajectoryEpoch& y = b.runs[r].trajectory.epochs[i];
            if (std::memcmp(x.position_enu_m.data(), y.position_enu_m.data(), 3 * sizeof(double)) != 0 ||
                std::memcmp(x.covariance.data(), y.covariance.data(), 36 * sizeof(double)) != 0) {
                return false;
            }
        }
    }
    return a.adjustment->misfit_after_m == b.adjustment->misfit_after_m;
}

TEST(JointAdjustment, AnyNumberOfThreadsGivesTheSameBytes) {
    const SimulatedSurvey simulated = simulatedSurvey(smallField(1));
    std::vector<FusedSurvey> results;
    for (const std::size_t threads : {1U, 4U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        tbb::task_arena arena(static_cast<int>(threads));
        arena.execute([&] { results.push_back(fused(simulated.survey)); });
    }
    EXPECT_TRUE(sameBytes(results[0], results[1]));
}

TEST(JointAdjustment, TheOrderOfTheRunsDoesNotMatter) {
    const SimulatedSurvey simulated = simulatedSurvey(smallField(1));
    Survey reversed = simulated.survey;
    std::reverse(reversed.runs.begin(), reversed.runs.end());
    FusionOptions options;
    for (const bool crossovers : {false, true}) {
        options.joint.use_crossovers = crossovers;
        const FusedSurvey forward = fused(simulated.survey, options);
        const FusedSurvey backward = fused(reversed, options);
        for (const FusedRun& run : forward.runs) {
            const Trajectory& other = runOf(backward, run.trajectory.run_id).trajectory;
            // Without crossovers only rounding is left. The places where passes are compared lie along the
            // pass that comes first, so other ones are picked; the heights stay well within their sigma.
            if (!crossovers) {
                EXPECT_LT(worstDistance(run.trajectory, other), 1e-9);
            }
            for (std::size_t i = 0; crossovers && i < other.epochs.size(); ++i) {
                const TrajectoryEpoch& epoch = run.trajectory.epochs[i];
                ASSERT_LT((epoch.position_enu_m - other.epochs[i].position_enu_m).norm(),
                          0.6 * std::sqrt(epoch.covariance(2, 2)))
                    << run.trajectory.run_id << ' ' << i;
            }
        }
    }
}

// The same survey told from another zero point, where the first one is a mark like others.
TEST(JointAdjustment, TheZeroPointMayLieAnywhere) {
    const SimulatedSurvey simulated = simulatedSurvey(smallField(1));
    const Survey here = withOriginMoved(simulated.survey, Eigen::Vector3d::Zero());
    const Survey there = withOriginMoved(simulated.survey, {1000.0, -500.0, 10.0});
    const FusedSurvey near = fused(here);
    const FusedSurvey far = fused(there);
    // 1.1 km away up and north differ by 1.8e-4 rad: 5 mm over the field of 30 m in what counts as level and
    // as north to the models, whose own errors are some tenth of that.
    for (std::size_t r = 0; r < near.runs.size(); ++r) {
        for (std::size_t i = 0; i < near.runs[r].trajectory.epochs.size(); ++i) {
            const Eigen::Vector3d back_enu_m =
                here.frame().toEnu(there.frame().toGeodetic(far.runs[r].trajectory.epochs[i].position_enu_m));
            ASSERT_LT((back_enu_m - near.runs[r].trajectory.epochs[i].position_enu_m).norm(), 0.002);
        }
    }
}

TEST(JointAdjustment, PerfectSensorsLeaveTheTrackAsItWas) {
    for (const SimulatedTerrain terrain : {SimulatedTerrain::Ramp, SimulatedTerrain::TerracedOrchard}) {
        SimulationOptions options = smallField(2);
        options.terrain = terrain;
        options.gnss = GnssMode::Rtk;
        options.faults = FaultLevel::None;
        options.noise_scale = 0.0;
        const SimulatedSurvey perfect = simulatedSurvey(options);
        const FusedSurvey survey = fused(perfect.survey);
        for (std::size_t r = 0; r < survey.runs.size(); ++r) {
            // The array rises and falls by 0.012 m with each step, 0.0085 m RMS, too fast for knots a second
            // apart and too little for the sigma of a height; the plan has no such part.
            EXPECT_LT(worstDistance(survey.runs[r].trajectory, perfect.truth[r]), 0.025);
            EXPECT_LT(rmsError(survey, perfect, r, true), 0.012);
            EXPECT_LT(rmsError(survey, perfect, r, false), 0.004);
        }
    }
}

TEST(JointAdjustment, CrossoversHalveTheHeightErrorOfABadDay) {
    double with_m2 = 0.0;
    double without_m2 = 0.0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SimulationOptions bad_day = smallField(seed);
        bad_day.faults = FaultLevel::Severe;
        const SimulatedSurvey simulated = simulatedSurvey(bad_day);
        FusionOptions options;
        const FusedSurvey with = fused(simulated.survey, options);
        options.joint.use_crossovers = false;
        const FusedSurvey without = fused(simulated.survey, options);
        EXPECT_LT(with.adjustment->misfit_after_m, with.adjustment->misfit_before_m);
        EXPECT_EQ(without.adjustment->crossovers, 0U);
        const std::size_t area = simulated.survey.runs.size() - 1;
        with_m2 += std::pow(rmsError(with, simulated, area, true), 2);
        without_m2 += std::pow(rmsError(without, simulated, area, true), 2);
    }
    EXPECT_LT(with_m2, 0.5 * without_m2);
}

TEST(CrossoverCorrection, APreviewBringsPassesTogetherAndKeepsTheFiltersSigmas) {
    double preview_m2 = 0.0;
    double without_m2 = 0.0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SimulationOptions bad_day = smallField(seed);
        bad_day.faults = FaultLevel::Severe;
        const SimulatedSurvey simulated = simulatedSurvey(bad_day);
        FusionOptions options;
        options.joint.preview = true;
        const FusedSurvey preview = fused(simulated.survey, options);
        options.joint.use_crossovers = false;  // leaves the filter's tracks
        const FusedSurvey without = fused(simulated.survey, options);
        EXPECT_FALSE(preview.adjustment);
        const std::size_t area = simulated.survey.runs.size() - 1;
        for (std::size_t i = 0; i < preview.runs[area].trajectory.epochs.size(); i += 50) {
            EXPECT_EQ(preview.runs[area].trajectory.epochs[i].covariance,
                      without.runs[area].trajectory.epochs[i].covariance);
        }
        EXPECT_NE(preview.runs[area].notes.limitations.back().find("a preview"), std::string::npos);
        preview_m2 += std::pow(rmsError(preview, simulated, area, true), 2);
        without_m2 += std::pow(rmsError(without, simulated, area, true), 2);
    }
    EXPECT_LT(preview_m2, 0.9 * without_m2);
}

// A sigma whose weight is beyond the range of numbers leaves the adjustment without a solution.
TEST(CrossoverCorrection, StandsInWhereTheAdjustmentHasNoSolution) {
    const SimulatedSurvey simulated = simulatedSurvey(smallField(1));
    FusionOptions options;
    options.joint.ground_roughness_m = 1e-200;
    const FusedSurvey fallback = fused(simulated.survey, options);
    EXPECT_FALSE(fallback.adjustment);
    options.joint.preview = true;
    const FusedSurvey preview = fused(simulated.survey, options);
    ASSERT_EQ(fallback.runs.size(), preview.runs.size());
    for (std::size_t r = 0; r < fallback.runs.size(); ++r) {
        EXPECT_EQ(worstDistance(fallback.runs[r].trajectory, preview.runs[r].trajectory), 0.0);
        EXPECT_NE(fallback.runs[r].notes.limitations.back().find("has no solution"), std::string::npos);
    }
}

TEST(JointAdjustment, SigmasOfThePlanGrowWithTheJumpsOfGnss) {
    double calm = 0.0;
    double jumpy = 0.0;
    constexpr std::uint64_t kSeeds = 4;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        SimulationOptions day = smallField(seed);
        day.faults = FaultLevel::None;
        calm += fused(simulatedSurvey(day).survey).adjustment->plan_inflation / kSeeds;
        day.faults = FaultLevel::Severe;
        jumpy += fused(simulatedSurvey(day).survey).adjustment->plan_inflation / kSeeds;
    }
    EXPECT_GE(calm, 1.0);
    EXPECT_LT(calm, 1.1);
    EXPECT_GT(jumpy, 1.2);
}

// Few crossovers test the sigmas of a small field.
// Ionosphere and ephemeris move all positions of a day alike; the marks that the short runs end on tell it.
TEST(JointAdjustment, ABiasOfAllPositionsIsFoundOut) {
    SimulationOptions day;
    day.seed = 32;
    day.faults = FaultLevel::None;
    day.fixed_point_runs = 8;
    day.control_stops = 0;
    day.end_on_zero = false;
    const Survey survey = simulatedSurvey(day).survey;
    Survey shifted = survey;
    for (terrawalk::Run& run : shifted.runs) {
        for (double& latitude_deg : run.log.column(Channel::Latitude)) latitude_deg += 3.0 / 111e3;
    }
    const auto moved_m = [&](FusionOptions options) {
        options.joint.use_crossovers = false;  // have no part here
        return worstDistance(fused(survey, options).runs.back().trajectory,
                             fused(shifted, options).runs.back().trajectory);
    };
    FusionOptions unaware;
    unaware.lasting.gnss_bias_sigma_m = unaware.lasting.gnss_bias_run_sigma_m = 1e-4;
    const double by_unaware_m = moved_m(unaware);
    EXPECT_GT(by_unaware_m, 1.0);
    EXPECT_LT(moved_m({}), 0.3 * by_unaware_m);
}

TEST(JointAdjustment, AScaleOfTheFlowThatWandersIsFollowedWhereItDoes) {
    SimulationOptions day;
    day.seed = 812;
    day.area_east_m = 35.0;
    day.area_north_m = 35.0;
    day.fixed_point_runs = 6;
    day.area_epochs = 5500;
    day.gnss = GnssMode::Float;
    FusionOptions unaware;
    unaware.lasting.flow_scale_wander_sigma = 0.0;

    const SimulatedSurvey steady = simulatedSurvey(day);
    const std::size_t walk = steady.survey.runs.size() - 1;
    const FusedSurvey steady_result = fused(steady.survey);
    EXPECT_FALSE(steady_result.adjustment->flow_scale_wanders);
    EXPECT_EQ(worstDistance(steady_result.runs[walk].trajectory,
                            fused(steady.survey, unaware).runs[walk].trajectory),
              0.0);

    day.disturbances = {Disturbance::FlowScaleWander};
    const SimulatedSurvey wandering = simulatedSurvey(day);
    const FusedSurvey result = fused(wandering.survey);
    EXPECT_TRUE(result.adjustment->flow_scale_wanders);
    EXPECT_LT(rmsError(result, wandering, walk, false),
              0.8 * rmsError(fused(wandering.survey, unaware), wandering, walk, false));
}

TEST(JointAdjustment, SigmasOfHeightsHoldOnSmallFields) {
    constexpr std::uint64_t kSeeds = 12;
    for (const auto [gnss, barometer] :
         {std::pair{GnssMode::Single, true}, {GnssMode::Rtk, true}, {GnssMode::Single, false}}) {
        double normalized = 0.0;
        double count = 0.0;
        for (std::uint64_t seed = 21; seed < 21 + kSeeds; ++seed) {
            SimulationOptions day = smallField(seed);
            day.gnss = gnss;
            const SimulatedSurvey simulated = simulatedSurvey(day);
            FusionOptions options;
            options.barometer.use = barometer;
            const FusedSurvey result = fused(simulated.survey, options);
            const auto& epochs = result.runs.back().trajectory.epochs;
            const auto& truth = simulated.truth.back().epochs;
            for (std::size_t i = 0; i < epochs.size(); ++i) {
                const double error_m = epochs[i].position_enu_m.z() - truth[i].position_enu_m.z();
                normalized += error_m * error_m / epochs[i].covariance(2, 2);
                count += 1.0;
            }
        }
        EXPECT_GT(normalized / count, 0.5) << name(gnss) << " barometer " << barometer;
        EXPECT_LT(normalized / count, 2.0) << name(gnss) << " barometer " << barometer;
    }
}

// On this walk someone turns by 90 degrees on a mark between two records.
TEST(JointAdjustment, ATurnThatTheGyroMissedIsTakenFromTheCompass) {
    SimulationOptions day;
    day.seed = 802;
    day.area_east_m = 35.0;
    day.area_north_m = 35.0;
    day.fixed_point_runs = 6;
    day.area_epochs = 4000;
    day.faults = FaultLevel::None;
    const SimulatedSurvey simulated = simulatedSurvey(day);
    const std::size_t walk = simulated.survey.runs.size() - 1;
    const auto& truth = simulated.truth[walk].epochs;
    double sharpest_rad = 0.0;
    for (std::size_t i = 1; i < truth.size(); ++i) {
        const double turned = truth[i].attitude.yaw_rad - truth[i - 1].attitude.yaw_rad;
        sharpest_rad = std::max(sharpest_rad, std::abs(wrapAngle(turned)));
    }
    ASSERT_GT(sharpest_rad, radians(80.0));
    const FusedSurvey result = fused(simulated.survey);
    EXPECT_LT(rmsError(result, simulated, walk, false), 0.5);
    EXPECT_LT(rmsError(result, simulated, walk, true), 0.05);
}

// Errors that the simulator does not make and sensors do.
struct OddSensor {
    const char* name;
    void (*spoil)(ArrayLog& log);
};

void scaleGyro(ArrayLog& log) {
    for (const Channel c : {Channel::AngularRateX, Channel::AngularRateY, Channel::AngularRateZ}) {
        for (double& rate : log.column(c)) rate = 1.04 * rate + radians(1.0);
    }
}

void stopGyro(ArrayLog& log) {
    for (const Channel c : {Channel::AngularRateX, Channel::AngularRateY, Channel::AngularRateZ}) {
        for (double& rate : log.column(c)) rate = 0.0;
    }
}

void zeroFlow(ArrayLog& log) {
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (i % 100 < 12) log.column(Channel::FlowForward)[i] = log.column(Channel::FlowLeft)[i] = 0.0;
    }
}

void spikeFlow(ArrayLog& log) {
    for (std::size_t i = 0; i < log.size(); i += 20) log.column(Channel::FlowForward)[i] += 3.0;
}

void disturbCompass(ArrayLog& log) {
    for (std::size_t i = 0; i < log.size(); ++i) {
        double& yaw = log.column(Channel::Heading)[i];
        if (i % 500 >= 400) yaw = wrapAngle(yaw + radians(30.0));
    }
}

void delayCompass(ArrayLog& log) {
    std::vector<double>& yaw = log.column(Channel::Heading);
    for (std::size_t i = yaw.size(); i-- > 3;) yaw[i] = yaw[i - 3];
}

TEST(JointAdjustment, OddSensorsAreFoundOut) {
    constexpr double kLargestRms_m = 0.7;  // 0.54 with the sensors as they are
    static constexpr OddSensor kSensors[] = {
        {"gyro scale and bias", scaleGyro},
        {"gyro stuck", stopGyro},
        {"flow of nothing", zeroFlow},
        {"flow with spikes", spikeFlow},
        {"iron beside the path", disturbCompass},
        {"compass comes behind", delayCompass},
    };
    SimulationOptions day;
    day.seed = 5;
    day.area_east_m = 30.0;
    day.area_north_m = 30.0;
    day.fixed_point_runs = 4;
    day.area_epochs = 3000;
    const SimulatedSurvey simulated = simulatedSurvey(day);
    const std::size_t walk = simulated.survey.runs.size() - 1;
    for (const OddSensor& sensor : kSensors) {
        Survey survey = simulated.survey;
        for (terrawalk::Run& run : survey.runs) sensor.spoil(run.log);
        EXPECT_LT(rmsError(fused(survey), simulated, walk, false), kLargestRms_m) << sensor.name;
    }
}

// Eight seconds of ranges cut short by a hand: false ground that crosses true ground.
TEST(JointAdjustment, FalseGroundIsDownWeightedAndCounted) {
    SimulationOptions options = smallField(1);
    options.faults = FaultLevel::None;
    const SimulatedSurvey simulated = simulatedSurvey(options);
    Survey bad = simulated.survey;
    std::vector<double>& range_m = bad.runs.back().log.column(Channel::Range);
    for (std::size_t i = 700; i < 740; ++i) range_m[i] -= 0.8;
    const FusedSurvey good = fused(simulated.survey);
    const FusedSurvey worse = fused(bad);
    const auto downWeightedOfGround = [](const FusedSurvey& survey) {
        return downWeighted(survey, "crossovers") + downWeighted(survey, "ground climb");
    };
    EXPECT_GT(downWeightedOfGround(worse), downWeightedOfGround(good));
    double worst_m = 0.0;
    for (std::size_t i = 0; i < range_m.size(); ++i) {
        worst_m = std::max(worst_m, std::abs(good.runs.back().trajectory.epochs[i].position_enu_m.z() -
                                             worse.runs.back().trajectory.epochs[i].position_enu_m.z()));
    }
    EXPECT_LT(worst_m, 0.5 * 0.8);
}

// Asks to stop at its n-th report of the adjustment and counts what comes after.
class StopAt final : public Progress {
  public:
    explicit StopAt(int n) : left_(n) {}
    void report(double, std::string_view step) override {
        if (step != "adjusting all runs") return;
        if (source.stop_requested()) ++after;
        if (left_-- == 0) source.request_stop();
    }
    void message(Severity, std::string_view) override {}
    std::stop_source source;
    int after = 0;

  private:
    int left_;
};

TEST(JointAdjustment, StopsInAnyRoundWithoutAnother) {
    const SimulatedSurvey simulated = simulatedSurvey(smallField(1));
    const int rounds = FusionOptions{}.joint.rounds + 2;
    for (int n = 0; n < rounds; ++n) {
        StopAt progress(n);
        const auto result = fuseSurvey(simulated.survey, {}, progress, progress.source.get_token());
        ASSERT_FALSE(result) << n;
        EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
        EXPECT_EQ(progress.after, 0) << n;
    }
    StopAt never(rounds);
    EXPECT_TRUE(fuseSurvey(simulated.survey, {}, never, never.source.get_token()));
}

/// The noise of the flow in its own coefficients once made its scale 3 % too large: tracks shrank.
TEST(JointAdjustment, NoiseOfTheFlowDoesNotShrinkTheTrack) {
    double scale = 0.0;
    constexpr int kSeeds = 3;
    for (std::uint64_t seed = 31; seed < 31 + kSeeds; ++seed) {
        SimulationOptions options;
        options.seed = seed;
        options.faults = FaultLevel::None;
        options.fixed_point_runs = 4;
        SilentProgress progress;
        const auto simulated = simulateSurvey(options, progress, {});
        ASSERT_TRUE(simulated);
        const FusedSurvey result = fused(simulated->survey);
        const auto& truth = simulated->truth.back().epochs;
        const auto& track = result.runs.back().trajectory.epochs;
        Eigen::Vector2d mean = Eigen::Vector2d::Zero();
        for (const auto& epoch : truth) mean += epoch.position_enu_m.head<2>();
        mean /= static_cast<double>(truth.size());
        double way = 0.0, off = 0.0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const double east_m = truth[i].position_enu_m.x() - mean.x();
            way += east_m * east_m;
            off += east_m * (track[i].position_enu_m.x() - truth[i].position_enu_m.x());
        }
        scale += off / way / kSeeds;
    }
    EXPECT_LT(std::abs(scale), 0.01);
}

TEST(JointAdjustment, AWrongRtkFixOfFiveSecondsDoesNotMoveTheTrack) {
    SimulationOptions options = smallField();
    options.gnss = GnssMode::Rtk;
    options.faults = FaultLevel::None;
    SimulatedSurvey made = simulatedSurvey(options);
    ArrayLog& log = made.survey.runs.back().log;
    constexpr std::size_t kFrom = 500;
    constexpr std::size_t kEnd = 525;
    constexpr double kJump_m = 0.5;
    for (std::size_t i = kFrom; i < kEnd; ++i) log.column(Channel::Latitude)[i] += kJump_m / 110600.0;
    const FusedSurvey survey = fused(made.survey);
    const FusedRun& run = survey.runs.back();
    double worst_m = 0.0;
    for (std::size_t i = kFrom; i < kEnd; ++i) {
        const Eigen::Vector3d error =
            run.trajectory.epochs[i].position_enu_m - made.truth.back().epochs[i].position_enu_m;
        worst_m = std::max(worst_m, error.head<2>().norm());
    }
    EXPECT_LT(worst_m, 0.3 * kJump_m);
    const std::string begin = "GNSS stands off by up to ";
    const auto note =
        std::find_if(run.notes.details.begin(), run.notes.details.end(),
                     [&](const std::string& detail) { return detail.find(begin) != std::string::npos; });
    ASSERT_NE(note, run.notes.details.end());
    EXPECT_NEAR(std::stod(note->substr(note->find(begin) + begin.size())), kJump_m, 0.1);
    const auto gnss = std::find_if(run.sensors.begin(), run.sensors.end(),
                                   [](const SensorUse& use) { return use.sensor == "GNSS position"; });
    ASSERT_NE(gnss, run.sensors.end());
    // Some of them the filter drops, the others count for less.
    EXPECT_GE(gnss->down_weighted + gnss->offered - gnss->used, kEnd - kFrom - 2);
}

}  // namespace
}  // namespace terrawalk
