#include "fusion/fuse_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "fusion/simulation.hpp"
#include "tests/fusion/made_run.hpp"

namespace terrawalk {
namespace {

FusionOptions ukfOptions() {
    FusionOptions options;
    options.method = FusionMethod::Ukf;
    return options;
}

Result<FusedRun> fuse(const MadeRun& made, const FusionOptions& options = ukfOptions()) {
    SilentProgress progress;
    return fuseRun(made.survey, made.run(), options, progress, {});
}

FusedRun fused(const MadeRun& made, const FusionOptions& options = ukfOptions()) {
    auto result = fuse(made, options);
    if (!result) {
        ADD_FAILURE() << result.error().text();
        return {};
    }
    return std::move(*result);
}

FusionOptions rawOptions() {
    FusionOptions options = ukfOptions();
    options.method = FusionMethod::Raw;
    return options;
}

FusionOptions forwardOnly() {
    FusionOptions options = ukfOptions();
    options.smooth = false;
    return options;
}

double rmse(const MadeRun& made, const FusedRun& run, int first_axis, int last_axis, std::size_t from = 0) {
    double squares = 0.0;
    const auto& epochs = run.trajectory.epochs;
    for (std::size_t i = from; i < epochs.size(); ++i) {
        const Eigen::Vector3d error = epochs[i].position_enu_m - made.position_enu_m[i];
        for (int axis = first_axis; axis <= last_axis; ++axis) squares += error[axis] * error[axis];
    }
    return std::sqrt(squares / static_cast<double>(epochs.size() - from));
}
double horizontalRmse(const MadeRun& made, const FusedRun& run, std::size_t from = 0) {
    return rmse(made, run, 0, 1, from);
}
double verticalRmse(const MadeRun& made, const FusedRun& run, std::size_t from = 0) {
    return rmse(made, run, 2, 2, from);
}

const SensorUse* use(const FusedRun& run, std::string_view sensor) {
    const auto found = std::find_if(run.sensors.begin(), run.sensors.end(),
                                    [&](const SensorUse& u) { return u.sensor == sensor; });
    return found == run.sensors.end() ? nullptr : &*found;
}

std::size_t rejected(const FusedRun& run, std::string_view sensor, std::string_view reason) {
    const SensorUse* u = use(run, sensor);
    if (u == nullptr) return 0;
    for (const SensorUse::Rejection& rejection : u->rejections) {
        if (rejection.reason == reason) return rejection.count;
    }
    return 0;
}

testing::Matcher<const FusedRun&> HasNote(const std::string& part) {
    const auto has_part = testing::Contains(testing::HasSubstr(part));
    return testing::Field(&FusedRun::notes, testing::AnyOf(testing::Field(&RunNotes::limitations, has_part),
                                                           testing::Field(&RunNotes::details, has_part)));
}

void expectSound(const FusedRun& run) {
    for (const TrajectoryEpoch& epoch : run.trajectory.epochs) {
        ASSERT_TRUE(epoch.position_enu_m.allFinite());
        ASSERT_EQ(epoch.covariance, epoch.covariance.transpose());
        ASSERT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(epoch.covariance).eigenvalues().minCoeff(), 0.0);
    }
    for (const SensorUse& u : run.sensors) {
        std::size_t sum = u.used;
        for (const SensorUse::Rejection& rejection : u.rejections) sum += rejection.count;
        EXPECT_EQ(u.offered, sum) << u.sensor;
        EXPECT_LE(u.down_weighted, u.used) << u.sensor;
    }
}

TEST(FuseRun, GivesOneEpochForEachRowAndComesNearTheTruth) {
    const MadeRun made = makeRun();
    const FusedRun run = fused(made);
    ASSERT_EQ(run.trajectory.epochs.size(), made.run().log.size());
    EXPECT_EQ(run.trajectory.run_id, "S01");
    expectSound(run);
    // Flow noise of 0.05 m/s at 5 Hz adds 0.022 m per root second: 0.16 m after 54 s, and GNSS helps.
    EXPECT_LT(horizontalRmse(made, run), 0.5);
    EXPECT_LT(verticalRmse(made, run), 0.1);
    EXPECT_LT(horizontalRmse(made, run), 0.5 * horizontalRmse(made, fused(made, rawOptions())));
}

TEST(FuseRun, SmoothingIsNeverLessCertainAndOnTheWholeBetter) {
    double forward_squares = 0.0;
    double smooth_squares = 0.0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        MadeRun made = makeRun({.seed = seed});
        made.run().target = "T01";
        const FusedRun smooth = fused(made);
        const FusedRun forward = fused(made, forwardOnly());
        for (std::size_t i = 0; i < smooth.trajectory.epochs.size(); ++i) {
            const Matrix6d gained =
                forward.trajectory.epochs[i].covariance - smooth.trajectory.epochs[i].covariance;
            ASSERT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(gained).eigenvalues().minCoeff(), -1e-9);
        }
        forward_squares += std::pow(horizontalRmse(made, forward), 2);
        smooth_squares += std::pow(horizontalRmse(made, smooth), 2);
    }
    EXPECT_LT(smooth_squares, 0.8 * forward_squares);
}

TEST(FuseRun, IsDeterministic) {
    const MadeRun made = makeRun();
    const FusedRun a = fused(made);
    const FusedRun b = fused(made);
    for (std::size_t i = 0; i < a.trajectory.epochs.size(); ++i) {
        ASSERT_EQ(a.trajectory.epochs[i].position_enu_m, b.trajectory.epochs[i].position_enu_m);
        ASSERT_EQ(a.trajectory.epochs[i].covariance, b.trajectory.epochs[i].covariance);
    }
}

TEST(FuseRun, AStandingArrayStaysPut) {
    const MadeRun made = makeRun({.epochs = 600, .speed_mps = 0.0});
    const FusedRun run = fused(made);
    for (const TrajectoryEpoch& epoch : run.trajectory.epochs) {
        EXPECT_LT((epoch.position_enu_m - made.position_enu_m[0]).norm(), 0.5);
        EXPECT_LT(epoch.velocity_enu_mps.norm(), 0.2);
    }
}

TEST(FuseRun, KeepsTiesAndMeetsTheStartMark) {
    MadeRun made = makeRun();
    made.run().target = "T01";
    const FusedRun run = fused(made);
    const TrajectoryEpoch& first = run.trajectory.epochs.front();
    const TrajectoryEpoch& last = run.trajectory.epochs.back();
    EXPECT_LT((first.position_enu_m - Eigen::Vector3d(0.0, 0.0, 1.2)).norm(), 0.1);
    EXPECT_LT((last.position_enu_m - made.position_enu_m.back()).norm(), 0.1);
    EXPECT_LT(std::sqrt(last.covariance(0, 0)), 0.1);
    ASSERT_NE(use(run, "mark tie"), nullptr);
    // 2.5 s and 1.6 s at 5 Hz, both ends included.
    EXPECT_EQ(use(run, "mark tie")->used, 13U + 9U);
}

TEST(FuseRun, ATieTellsAsMuchPerSecondAtAnyRate) {
    MadeRun slow = makeRun({.epochs = 300, .interval_s = 0.2});
    MadeRun fast = makeRun({.epochs = 3000, .interval_s = 0.02});
    const double slow_sigma = std::sqrt(fused(slow).trajectory.epochs[5].covariance(0, 0));
    const double fast_sigma = std::sqrt(fused(fast).trajectory.epochs[50].covariance(0, 0));
    EXPECT_NEAR(fast_sigma, slow_sigma, 0.25 * slow_sigma);
}

TEST(FuseRun, NeverLooksAtCheckMarks) {
    MadeRun made = makeRun();
    made.survey.marks[0].role = MarkRole::Check;
    made.run().target = "T01";
    made.run().stops.push_back({"T01", 20.0, 22.0});
    const FusedRun before = fused(made);
    made.survey.marks[0].enu_m += Eigen::Vector3d(500.0, -300.0, 40.0);
    const FusedRun after = fused(made);
    for (std::size_t i = 0; i < before.trajectory.epochs.size(); ++i) {
        ASSERT_EQ(before.trajectory.epochs[i].position_enu_m, after.trajectory.epochs[i].position_enu_m);
        ASSERT_EQ(before.trajectory.epochs[i].covariance, after.trajectory.epochs[i].covariance);
    }
}

TEST(FuseRun, TiesAFixedPointRunToItsTargetOnlyWhereAsked) {
    for (const bool tie : {false, true}) {
        FusionOptions options = ukfOptions();
        options.stands.tie_fixed_targets = tie;
        MadeRun made = makeRun();
        made.run().kind = RunKind::FixedPoint;
        made.run().target = "T01";
        const FusedRun before = fused(made, options);
        made.survey.marks[0].enu_m += Eigen::Vector3d(5.0, 5.0, 5.0);
        const FusedRun after = fused(made, options);
        EXPECT_EQ(
            before.trajectory.epochs.back().position_enu_m == after.trajectory.epochs.back().position_enu_m,
            !tie);
    }
}

TEST(FuseRun, RemovesTheLeverArmOfTheAntenna) {
    const MadeErrors no_errors{.gnss_m = 0.0,
                               .barometer_m = 0.0,
                               .flow_mps = 0.0,
                               .acceleration_mps2 = 0.0,
                               .range_m = 0.0,
                               .doppler_mps = 0.0};
    const MadeRun made =
        makeRun({.fix = fix_code::kRtkFixed, .gnss_lever_arm_m = {0.3, -0.2, 0.5}, .errors = no_errors});
    const FusedRun run = fused(made);
    EXPECT_LT(horizontalRmse(made, run), 0.02);
    EXPECT_LT(verticalRmse(made, run), 0.02);
}

TEST(FuseRun, UsesLatitudesWithoutEllipsoidalHeight) {
    const MadeErrors no_errors{.gnss_m = 0.0,
                               .barometer_m = 0.0,
                               .flow_mps = 0.0,
                               .acceleration_mps2 = 0.0,
                               .range_m = 0.0,
                               .doppler_mps = 0.0};
    const MadeRun made =
        makeRun({.fix = fix_code::kRtkFixed, .ellipsoidal_height = false, .errors = no_errors});
    const FusedRun run = fused(made);
    EXPECT_LT(horizontalRmse(made, run), 0.02);
    EXPECT_EQ(use(run, "GNSS height"), nullptr);
}

TEST(FuseRun, RejectsEpochsWithoutFixOrTexture) {
    MadeRun made = makeRun();
    for (std::size_t i = 100; i < 150; ++i) made.log().column(Channel::Fix)[i] = fix_code::kNone;
    for (std::size_t i = 200; i < 220; ++i) made.log().column(Channel::FlowQuality)[i] = 0.0;
    const FusedRun run = fused(made);
    EXPECT_EQ(rejected(run, "GNSS position", "no fix"), 50U);
    EXPECT_EQ(rejected(run, "optical flow", "no texture"), 20U);
    EXPECT_GT(use(run, "mean optical flow")->used, 0U);
    expectSound(run);
}

TEST(FuseRun, RejectsOutliersAndCountsThem) {
    MadeRun made = makeRun();
    const double clean = horizontalRmse(made, fused(made));
    const double clean_up = verticalRmse(made, fused(made));
    for (std::size_t i = 50; i < 250; i += 20) {
        made.log().column(Channel::Latitude)[i] += 100.0 / 111e3;
        made.log().column(Channel::Pressure)[i + 5] += 100.0;
        made.log().column(Channel::FlowForward)[i + 7] += 8.0;
    }
    const FusedRun run = fused(made);
    EXPECT_GE(rejected(run, "GNSS position", "beyond gate"), 10U);
    EXPECT_GE(rejected(run, "barometer", "beyond gate"), 10U);
    EXPECT_GE(rejected(run, "optical flow", "far from its neighbours"), 10U);
    EXPECT_LT(horizontalRmse(made, run), 1.2 * clean);
    EXPECT_LT(verticalRmse(made, run), 1.2 * clean_up);

    FusionOptions trusting = ukfOptions();
    trusting.robust.use = false;
    trusting.flow.screen = false;
    EXPECT_GT(horizontalRmse(made, fused(made, trusting)), 2.0 * clean);
}

TEST(FuseRun, DownWeightsWhatIsOddButNotImpossible) {
    MadeRun made = makeRun();
    for (std::size_t i = 50; i < 250; i += 10) made.log().column(Channel::Longitude)[i] += 4.5 / 102e3;
    const FusedRun run = fused(made);
    EXPECT_GE(use(run, "GNSS position")->down_weighted, 10U);
}

// 20 m, or 5 m of height, are no error of a sensor: someone has typed a mark wrong. It is named, whatever
// becomes of the track.
TEST(FuseRun, NamesAMarkThatTheSensorsContradict) {
    MadeRun made = makeRun();
    made.run().target = "T01";
    const auto contradicted = HasNote("check the name and the coordinates of the mark");
    EXPECT_THAT(fused(made), testing::Not(contradicted));
    MadeRun aside = made;
    aside.survey.marks[0].enu_m.x() += 20.0;
    EXPECT_THAT(fused(aside), HasNote("GNSS is"));
    EXPECT_THAT(fused(aside), HasNote("m away from mark T01"));
    MadeRun above = made;
    above.survey.marks[0].enu_m.z() += 5.0;
    EXPECT_THAT(fused(above), HasNote("the barometer puts mark T01 5.0 m below its height"));
    MadeRun both_good = makeRun({.fix = fix_code::kRtkFixed, .errors = {.gnss_m = 0.01}});
    both_good.run().target = "T01";
    EXPECT_THAT(fused(both_good), testing::Not(contradicted));
    both_good.survey.marks[0].enu_m.y() += 2.0;  // RTK tells less
    EXPECT_THAT(fused(both_good), contradicted);
}

TEST(FuseRun, SaysForHowLongGnssWasSilent) {
    MadeRun made = makeRun({.epochs = 900});
    EXPECT_THAT(fused(made), testing::Not(HasNote("no GNSS position for")));
    for (std::size_t i = 200; i < 600; ++i) made.log().column(Channel::Latitude)[i] = kMissing;
    EXPECT_THAT(fused(made), HasNote("no GNSS position for 80 s"));
}

// The filter starts on the wrong mark, 60 m off, so GNSS is right and is rejected at first.
TEST(FuseRun, LetsGnssInAgainWhenTheFilterWasWrong) {
    MadeRun made = makeRun({.epochs = 900});
    made.survey.marks.push_back({"WRONG", {60.0, 0.0, 0.0}, 0.01, 0.01, MarkRole::Control});
    made.run().start = "WRONG";
    const FusedRun run = fused(made, forwardOnly());
    EXPECT_GT(rejected(run, "GNSS position", "beyond gate"), 100U);
    EXPECT_LT(horizontalRmse(made, run, 300), 2.0);
    EXPECT_THAT(run, HasNote("let in again"));
    expectSound(fused(made));
}

void silenceGnss(MadeRun& made, std::size_t from, std::size_t to) {
    for (const Channel c : {Channel::Latitude, Channel::Longitude}) {
        for (std::size_t i = from; i < to; ++i) made.log().column(c)[i] = kMissing;
    }
}

// Two bad fixes with an outage between them are not a sensor that is right against the filter.
TEST(FuseRun, SilenceDoesNotCountAsRejection) {
    MadeRun made = makeRun({.epochs = 600});
    silenceGnss(made, 201, 400);
    made.log().column(Channel::Latitude)[200] += 200.0 / 111e3;
    made.log().column(Channel::Latitude)[400] += 200.0 / 111e3;
    const FusedRun run = fused(made, forwardOnly());
    EXPECT_EQ(rejected(run, "GNSS position", "beyond gate"), 2U);
    EXPECT_LT((run.trajectory.epochs[400].position_enu_m - made.position_enu_m[400]).norm(), 5.0);
}

TEST(FuseRun, SilenceDoesNotCountAsDivergence) {
    MadeRun made = makeRun({.epochs = 4000, .speed_mps = 0.02});
    silenceGnss(made, 501, 3500);
    made.log().column(Channel::Latitude)[500] += 500.0 / 111e3;
    made.log().column(Channel::Latitude)[3500] += 500.0 / 111e3;
    const FusedRun run = fused(made);
    EXPECT_EQ(rejected(run, "GNSS position", "beyond gate"), 2U);
}

TEST(FuseRun, OneRtkHeightDoesNotStandForTheWholeRun) {
    MadeRun made = makeRun({.epochs = 3000, .speed_mps = 0.1});
    made.erase(Channel::Pressure);
    for (double& acceleration : made.log().column(Channel::AccelerationZ)) acceleration += 0.1;
    for (std::size_t i = 0; i < 100; ++i) made.log().column(Channel::Fix)[i] = fix_code::kRtkFixed;
    const FusedRun run = fused(made);
    EXPECT_THAT(run, HasNote("GNSS height is used whatever the fix"));
    EXPECT_LT(verticalRmse(made, run), 1.0);
}

TEST(FuseRun, GnssHeightStandsInForASilentBarometer) {
    MadeRun made = makeRun({.epochs = 3000, .speed_mps = 0.1});
    for (std::size_t i = 500; i < 2500; ++i) made.log().column(Channel::Pressure)[i] = kMissing;
    for (double& acceleration : made.log().column(Channel::AccelerationZ)) acceleration += 0.1;
    const FusedRun run = fused(made);
    EXPECT_THAT(run, HasNote("barometer was silent for up to 400 s"));
    EXPECT_LT(verticalRmse(made, run), 1.5);
    // 400 s of silence less the first 30 s.
    ASSERT_NE(use(run, "GNSS height"), nullptr);
    EXPECT_NEAR(static_cast<double>(use(run, "GNSS height")->used), 1850.0, 3.0);
}

TEST(FuseRun, AHeightThatNothingMeasuresForLongIsHeldAndUnsure) {
    MadeRun made = makeRun({.epochs = 3000, .speed_mps = 0.1, .ellipsoidal_height = false});
    for (std::size_t i = 500; i < 2500; ++i) made.log().column(Channel::Pressure)[i] = kMissing;
    const FusedRun run = fused(made, forwardOnly());
    EXPECT_THAT(run, HasNote("the walk is taken to climb little"));
    const double sigma_m = std::sqrt(run.trajectory.epochs[2499].covariance(2, 2));
    EXPECT_GT(sigma_m, 5.0);
    EXPECT_LT(sigma_m, 100.0);
    expectSound(run);
}

double middleHeightSigma(const FusedRun& run) {
    return std::sqrt(run.trajectory.epochs[run.trajectory.epochs.size() / 2].covariance(2, 2));
}

// 60 s of fixes of 1.95 m that keep their error for 30 s hold two errors, not 300.
TEST(FuseRun, TheErrorOfTheBarometersZeroIsInItsHeights) {
    MadeRun made = makeRun();
    const FusedRun on_mark = fused(made);
    // A mean over a stand within one gust.
    EXPECT_GT(middleHeightSigma(on_mark), 0.12);
    EXPECT_LT(middleHeightSigma(on_mark), 0.3);
    made.run().start.reset();
    const double expected = 1.95 / std::sqrt(2.0);
    EXPECT_NEAR(middleHeightSigma(fused(made)), expected, 0.15 * expected);
    EXPECT_GT(middleHeightSigma(fused(made, rawOptions())), 0.9 * expected);
}

TEST(FuseRun, TheBarometersZeroDoesNotBlurRtkHeights) {
    MadeRun made = makeRun({.fix = fix_code::kRtkFixed, .errors = {.gnss_m = 0.01}});
    // The height above the mark is assumed, and so is the zero: 0.3 m.
    made.erase(Channel::Range);
    EXPECT_LT(middleHeightSigma(fused(made)), 0.15);
    made.erase(Channel::EllipsoidalHeight);
    EXPECT_GT(middleHeightSigma(fused(made)), 0.3);
}

TEST(FuseRun, ZeroesTheBarometerByMostFixesNotByTheirMean) {
    MadeRun made = makeRun({.errors = {.gnss_m = 0.2}});
    made.run().start.reset();
    for (std::size_t i = 0; i < 90; ++i) made.log().column(Channel::EllipsoidalHeight)[i] += 30.0;
    EXPECT_LT(verticalRmse(made, fused(made)), 0.4);
}

TEST(FuseRun, ZeroesTheBarometerByGnssRatherThanFarFromAMark) {
    MadeRun made = makeRun({.epochs = 600, .errors = {.gnss_m = 0.2}});
    for (std::size_t i = 0; i < 100; ++i) made.log().column(Channel::Pressure)[i] = kMissing;
    const FusedRun far = fused(made);
    EXPECT_THAT(far, HasNote("tied to the median GNSS height"));
    made.erase(Channel::EllipsoidalHeight);
    const FusedRun only = fused(made);
    EXPECT_THAT(only, HasNote("zeroed 17.6 s away from one"));
    // 17.6 s at half of 1.5 m/s.
    EXPECT_NEAR(middleHeightSigma(only), 0.75 * 17.6, 1.0);
}

TEST(FuseRun, AnUnknownHeadingLeavesTheLeverArmToItsVariance) {
    MadeRun made = makeRun(
        {.fix = fix_code::kRtkFixed, .gnss_lever_arm_m = {0.8, 0.6, 0.5}, .errors = {.gnss_m = 0.01}});
    const auto sigma = [](const FusedRun& run) {
        return std::sqrt(run.trajectory.epochs[150].covariance(0, 0));
    };
    const FusedRun raw_known = fused(made, rawOptions());
    EXPECT_NEAR(sigma(raw_known), std::hypot(0.02, radians(3.0) * 1.0), 0.003);
    made.erase(Channel::Heading);
    const FusedRun raw = fused(made, rawOptions());
    EXPECT_NEAR(sigma(raw), 1.0, 0.05);
    EXPECT_THAT(raw, HasNote("lever arm of the antenna is not removed"));
    // The antenna itself, 1 m away, and no further.
    const Eigen::Vector3d error = raw.trajectory.epochs[150].position_enu_m - made.position_enu_m[150];
    EXPECT_NEAR(error.head<2>().norm(), 1.0, 0.1);
    EXPECT_GT(sigma(fused(made)), 0.3);
}

MadeRun flowOnlyRun(double interval_s, double silent_s) {
    MadeRun made = makeRun({.epochs = static_cast<std::size_t>(std::lround(60.0 / interval_s)),
                            .interval_s = interval_s,
                            .doppler = true});
    ArrayLog& log = made.log();
    for (const Channel c : {Channel::Latitude, Channel::Longitude, Channel::EllipsoidalHeight, Channel::Fix,
                            Channel::AccelerationX, Channel::AccelerationY, Channel::AccelerationZ}) {
        made.erase(c);
    }
    // The column is there and empty.
    for (const Channel c : {Channel::GnssVelocityEast, Channel::GnssVelocityNorth, Channel::GnssVelocityUp}) {
        log.column(c).assign(log.size(), kMissing);
    }
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (log.time_s[i] > 20.0 && log.time_s[i] <= 20.0 + silent_s) {
            log.column(Channel::FlowForward)[i] = log.column(Channel::FlowLeft)[i] = kMissing;
        }
    }
    return made;
}

TEST(FuseRun, BridgesTheFlowForALimitedTime) {
    const FusedRun run = fused(flowOnlyRun(0.2, 30.0));
    // From 0.6 s to 10 s after the last reading at 20 s; rounding decides about the ends.
    EXPECT_NEAR(static_cast<double>(use(run, "mean optical flow")->used), 47.5, 1.0);
    EXPECT_THAT(run, HasNote("bridged by its recent mean for 10.0 s"));
}

TEST(FuseRun, BridgingTellsAsMuchPerSecondAtAnyRate) {
    const auto sigmaAt = [](double interval_s) {
        MadeRun made = flowOnlyRun(interval_s, 9.0);
        made.erase(Channel::GnssVelocityEast);
        const FusedRun run = fused(made, forwardOnly());
        return std::sqrt(
            run.trajectory.epochs[static_cast<std::size_t>(std::lround(28.0 / interval_s))].covariance(3, 3));
    };
    EXPECT_NEAR(sigmaAt(0.02), sigmaAt(0.2), 0.1 * sigmaAt(0.2));
}

TEST(FuseRun, TheFirstFixesCountOnce) {
    MadeRun made = makeRun({.epochs = 5, .speed_mps = 0.0});
    made.run().start.reset();
    made.erase(Channel::FlowForward);
    // Five fixes within a second share one error.
    EXPECT_GT(std::sqrt(fused(made).trajectory.epochs[0].covariance(0, 0)), 1.2);
}

// 5 km from the zero point the level surface lies 1.96 m below the tangent plane.
TEST(FuseRun, BarometricHeightsFollowTheLevelSurface) {
    MadeRun made =
        makeRun({.fix = fix_code::kRtkFixed, .errors = {.gnss_m = 0.0, .barometer_m = 0.0, .range_m = 0.0}});
    const MadeRun near = made;
    // The same walk from a zero point 5 km away: the same heights, and so the same pressures.
    const GeodeticPosition start = made.survey.zero_point;
    made.survey.zero_point = LocalFrame(start).toGeodetic({0.0, -5000.0, 0.0});
    made.survey.zero_point.h_ell_m = start.h_ell_m;
    made.run().start.reset();
    FusionOptions options = ukfOptions();
    options.gnss.use_height = GnssHeightUse::Never;
    made.survey.marks.push_back({"FAR", made.survey.frame().toEnu(start), 0.005, 0.005, MarkRole::Control});
    made.run().start = "FAR";
    const FusedRun run = fused(made, options);
    const LocalFrame far_frame = made.survey.frame();
    const LocalFrame near_frame = near.survey.frame();
    const std::size_t last = run.trajectory.epochs.size() - 1;
    const Eigen::Vector3d truth = far_frame.toEnu(near_frame.toGeodetic(near.position_enu_m[last]));
    EXPECT_NEAR(run.trajectory.epochs[last].position_enu_m.z(), truth.z(), 0.02);
}

// Velocity sensors are never let in by force: the filter forgets its velocity within seconds.
TEST(FuseRun, FindsBackToFlowAfterAJumpWithoutGnss) {
    MadeRun made = makeRun({.epochs = 600});
    for (const Channel c :
         {Channel::Latitude, Channel::Longitude, Channel::EllipsoidalHeight, Channel::Fix}) {
        made.erase(c);
    }
    for (std::size_t i = 100; i < 150; ++i) made.log().column(Channel::FlowForward)[i] = 9.0;
    const FusedRun run = fused(made, forwardOnly());
    const auto& epochs = run.trajectory.epochs;
    EXPECT_GT(rejected(run, "optical flow", "beyond gate"), 10U);
    EXPECT_NEAR(epochs[300].velocity_enu_mps.norm(), 1.0, 0.2);
}

TEST(FuseRun, GivesUpWithRunAndTimeWhenGnssAndTrackPartForGood) {
    MadeRun made = makeRun({.epochs = 900});
    for (std::size_t i = 150; i < 900; ++i) {
        made.log().column(Channel::Latitude)[i] += 0.02 * static_cast<double>(i - 149);
    }
    const auto result = fuse(made);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::BadData);
    EXPECT_THAT(result.error().text(), testing::HasSubstr("S01"));
    EXPECT_THAT(result.error().text(), testing::ContainsRegex("diverged at [0-9.]+ s"));
}

TEST(FuseRun, BridgesGapsAndSaysHowSureItIs) {
    MadeRun made = makeRun({.epochs = 600});
    // Rows 200 to 349 are lost: 30 s.
    ArrayLog& log = made.log();
    const auto cut = [](auto& column) {
        if (!column.empty()) column.erase(column.begin() + 200, column.begin() + 350);
    };
    cut(log.time_s);
    for (std::vector<double>& column : log.channels) cut(column);
    cut(made.position_enu_m);
    // GNSS takes its time as well, so that the first row shows what the gap alone has done.
    for (std::size_t i = 200; i < 220; ++i) log.column(Channel::Latitude)[i] = kMissing;
    const FusedRun run = fused(made);
    expectSound(run);
    EXPECT_LT(horizontalRmse(made, run), 1.0);
    const FusedRun forward = fused(made, forwardOnly());
    EXPECT_GT(forward.trajectory.epochs[200].covariance(0, 0),
              2.0 * forward.trajectory.epochs[199].covariance(0, 0));
}

TEST(FuseRun, StaysSoundThroughTenThousandEpochsWithSensorsComingAndGoing) {
    MadeRun made = makeRun({.epochs = 10000, .speed_mps = 0.02});
    NormalNumbers random(3);
    ArrayLog& log = made.log();
    for (const Channel c : {Channel::Latitude, Channel::Pressure, Channel::FlowForward, Channel::Roll,
                            Channel::Heading, Channel::AccelerationY, Channel::Range, Channel::Fix}) {
        std::vector<double>& column = log.column(c);
        for (std::size_t i = 0; i < column.size();) {
            const auto length = static_cast<std::size_t>(1.0 + 400.0 * std::pow(random.uniform(), 4.0));
            const bool missing = random.uniform() < 0.4;
            for (std::size_t k = 0; k < length && i < column.size(); ++k, ++i) {
                if (missing) column[i] = kMissing;
            }
        }
    }
    expectSound(fused(made));
}

TEST(FuseRun, ALateSensorAndHalfRateGnssAreUsedWhereTheyAre) {
    MadeRun made = makeRun({.ellipsoidal_height = false});
    ArrayLog& log = made.log();
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (i % 2 == 1) log.column(Channel::Latitude)[i] = log.column(Channel::Fix)[i] = kMissing;
        if (i < 100) log.column(Channel::Pressure)[i] = kMissing;
    }
    const FusedRun run = fused(made);
    EXPECT_EQ(use(run, "GNSS position")->offered, 150U);
    EXPECT_EQ(use(run, "barometer")->offered, 200U);
    EXPECT_THAT(run, HasNote("barometer was silent on the marks"));
    EXPECT_LT(horizontalRmse(made, run), 0.6);
    expectSound(run);
}

TEST(FuseRun, WithoutFlowItStillFollowsGnss) {
    MadeRun made = makeRun();
    made.erase(Channel::FlowForward);
    const FusedRun run = fused(made);
    EXPECT_THAT(run, HasNote("no optical flow"));
    EXPECT_LT(horizontalRmse(made, run), 1.0);
    expectSound(run);
}

TEST(FuseRun, WithoutBarometerItUsesGnssHeight) {
    MadeRun made = makeRun();
    made.erase(Channel::Pressure);
    const FusedRun run = fused(made);
    EXPECT_THAT(run, HasNote("no barometer"));
    EXPECT_GT(use(run, "GNSS height")->used, 0U);
    EXPECT_LT(verticalRmse(made, run), 1.5);
    expectSound(run);
}

TEST(FuseRun, WithoutAnyHeightItSaysSoAndIsUnsure) {
    MadeRun made = makeRun({.ellipsoidal_height = false});
    made.erase(Channel::Pressure);
    const FusedRun run = fused(made);
    EXPECT_THAT(run, HasNote("nothing in the log measures height"));
    EXPECT_GT(std::sqrt(run.trajectory.epochs[150].covariance(2, 2)), 9.0);
    EXPECT_LT(std::sqrt(run.trajectory.epochs[150].covariance(2, 2)), 12.0);
    expectSound(run);
}

TEST(FuseRun, WithoutHeadingItDoesWithoutFlow) {
    MadeRun made = makeRun();
    made.erase(Channel::Heading);
    const FusedRun run = fused(made);
    EXPECT_THAT(run, HasNote("no heading"));
    EXPECT_EQ(use(run, "optical flow")->used, 0U);
    EXPECT_GT(run.trajectory.epochs[0].sigma_heading_rad, 1.0);
    EXPECT_LT(horizontalRmse(made, run), 1.0);
    expectSound(run);
}

TEST(FuseRun, HoldsAMissingAttitudeWithALargerSigma) {
    MadeRun made = makeRun();
    for (std::size_t i = 100; i < 130; ++i) made.log().column(Channel::Roll)[i] = kMissing;
    const FusedRun run = fused(made);
    const auto& epochs = run.trajectory.epochs;
    EXPECT_EQ(epochs[110].attitude.roll_rad, epochs[99].attitude.roll_rad);
    EXPECT_GT(epochs[110].sigma_tilt_rad, epochs[99].sigma_tilt_rad);
    EXPECT_THAT(run, HasNote("roll missing in 30 of 300 epochs"));
    EXPECT_GT(rejected(run, "accelerometer", "no attitude"), 10U);
}

TEST(FuseRun, WithoutGnssItWalksByFlowFromTheMark) {
    MadeRun made = makeRun();
    for (const Channel c :
         {Channel::Latitude, Channel::Longitude, Channel::EllipsoidalHeight, Channel::Fix}) {
        made.erase(c);
    }
    const FusedRun run = fused(made);
    EXPECT_THAT(run, HasNote("no GNSS position"));
    EXPECT_LT(horizontalRmse(made, run), 0.5);
    const FusedRun raw = fused(made, rawOptions());
    EXPECT_THAT(raw, HasNote("summed up"));
    EXPECT_LT(horizontalRmse(made, raw), 0.6);
}

TEST(FuseRun, WithoutGnssAndMarkTheOriginIsTheStart) {
    MadeRun made = makeRun();
    made.run().start.reset();
    for (const Channel c :
         {Channel::Latitude, Channel::Longitude, Channel::EllipsoidalHeight, Channel::Fix}) {
        made.erase(c);
    }
    const FusedRun run = fused(made);
    EXPECT_THAT(run, HasNote("the run starts at the origin"));
    EXPECT_THAT(run, HasNote("ground below the start of the run is height 0"));
    EXPECT_LT(run.trajectory.epochs[0].position_enu_m.head<2>().norm(), 0.1);
    EXPECT_NEAR(run.trajectory.epochs[0].position_enu_m.z(), 1.2, 0.15);
}

TEST(FuseRun, WithoutMarkTheBarometerIsTiedToTheGnssHeight) {
    MadeRun made = makeRun();
    made.run().start.reset();
    const FusedRun run = fused(made);
    EXPECT_THAT(run, HasNote("tied to the median GNSS height"));
    // The mean of 300 heights of 1.5 m noise: 0.09 m.
    EXPECT_LT(verticalRmse(made, run), 0.4);
    EXPECT_LT(horizontalRmse(made, run), 1.0);
}

TEST(FuseRun, WithoutMarkAndHeightTheGroundAtTheStartIsZero) {
    MadeRun made = makeRun({.ellipsoidal_height = false});
    made.run().start.reset();
    const FusedRun run = fused(made);
    EXPECT_THAT(run, HasNote("ground below the start of the run is height 0"));
    EXPECT_LT(verticalRmse(made, run), 0.15);
}

TEST(FuseRun, AStopTellsWhereARunWithoutGnssBegan) {
    MadeRun made = makeRun();
    made.run().start.reset();
    made.run().target = "T01";
    for (const Channel c :
         {Channel::Latitude, Channel::Longitude, Channel::EllipsoidalHeight, Channel::Fix}) {
        made.erase(c);
    }
    const FusedRun run = fused(made);
    EXPECT_THAT(run, HasNote("placed backwards"));
    EXPECT_LT(horizontalRmse(made, run), 0.7);
}

TEST(FuseRun, WithoutRangeTheHeightOverTheMarkIsAssumed) {
    MadeRun made = makeRun();
    made.erase(Channel::Range);
    const FusedRun run = fused(made);
    EXPECT_THAT(run, HasNote("no range while the array stood on ZERO"));
    EXPECT_LT(verticalRmse(made, run), 0.4);
}

TEST(FuseRun, TakesDopplerVelocity) {
    MadeRun made = makeRun({.doppler = true});
    made.erase(Channel::FlowForward);
    const FusedRun run = fused(made);
    EXPECT_GT(use(run, "GNSS velocity")->used, 290U);
    double squares = 0.0;
    for (std::size_t i = 20; i < 280; ++i) {
        squares +=
            (run.trajectory.epochs[i].velocity_enu_mps - made.velocity_enu_mps[i]).head<2>().squaredNorm();
    }
    EXPECT_LT(std::sqrt(squares / 260.0), 0.15);
}

TEST(FuseRun, TheYawRowIsOffUnlessAskedFor) {
    const MadeRun made = makeRun();
    EXPECT_EQ(use(fused(made), "heading row"), nullptr);
    FusionOptions options = ukfOptions();
    options.yaw_row.use = true;
    const FusedRun run = fused(made, options);
    ASSERT_NE(use(run, "heading row"), nullptr);
    EXPECT_GT(use(run, "heading row")->used, 200U);
    EXPECT_GT(rejected(run, "heading row", "too slow"), 10U);
    EXPECT_LT(horizontalRmse(made, run), 0.5);
}

TEST(FuseRun, TheMountOffsetOfTheYawRowUndoesATurnedArray) {
    MadeRun made = makeRun();
    made.erase(Channel::FlowForward);
    made.erase(Channel::AccelerationX);
    FusionOptions options = ukfOptions();
    options.yaw_row.use = true;
    const FusedRun straight = fused(made, options);
    // A quarter turn to the left: the heading falls by 90 degrees, the walk stays as it is.
    for (double& heading_rad : made.log().column(Channel::Heading)) heading_rad -= 0.5 * kPi;
    const FusedRun turned = fused(made, options);
    options.yaw_row.mount_offset_deg = 90.0;
    const FusedRun undone = fused(made, options);
    const auto apart = [&](const FusedRun& run) {
        double largest_m = 0.0;
        for (std::size_t i = 0; i < run.trajectory.epochs.size(); ++i) {
            largest_m = std::max(largest_m, (run.trajectory.epochs[i].position_enu_m -
                                             straight.trajectory.epochs[i].position_enu_m)
                                                .norm());
        }
        return largest_m;
    };
    EXPECT_LT(apart(undone), 1e-9);
    EXPECT_GT(apart(turned), 0.5);
}

TEST(FuseRun, EachSensorCanBeSwitchedOff) {
    const MadeRun made = makeRun({.fix = fix_code::kRtkFloat, .doppler = true});
    FusionOptions options = ukfOptions();
    options.gnss.use_position = false;
    options.gnss.use_velocity = false;
    options.gnss.use_height = GnssHeightUse::Never;
    options.barometer.use = false;
    options.accelerometer.use = false;
    const FusedRun run = fused(made, options);
    for (const auto* sensor :
         {"GNSS position", "GNSS velocity", "GNSS height", "barometer", "accelerometer"}) {
        EXPECT_EQ(use(run, sensor), nullptr) << sensor;
    }
    EXPECT_GT(use(run, "optical flow")->used, 0U);
}

TEST(FuseRun, GnssHeightFollowsTheOption) {
    FusionOptions options = ukfOptions();
    const MadeRun single = makeRun();
    EXPECT_EQ(rejected(fused(single), "GNSS height", "no RTK fix"), 300U);
    options.gnss.use_height = GnssHeightUse::Always;
    EXPECT_GT(use(fused(single, options), "GNSS height")->used, 200U);
    const MadeRun rtk = makeRun({.fix = fix_code::kRtkFixed, .errors = {.gnss_m = 0.01}});
    EXPECT_GT(use(fused(rtk), "GNSS height")->used, 290U);
    EXPECT_LT(verticalRmse(rtk, fused(rtk)), 0.03);
}

TEST(FuseRun, RefusesALogThatTellsNoPosition) {
    MadeRun made = makeRun();
    for (const Channel c : {Channel::Latitude, Channel::Longitude, Channel::FlowForward}) made.erase(c);
    for (const FusionMethod method : {FusionMethod::Raw, FusionMethod::Ukf}) {
        FusionOptions options = ukfOptions();
        options.method = method;
        const auto result = fuse(made, options);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().kind, ErrorKind::BadData);
        EXPECT_THAT(result.error().text(), testing::HasSubstr("nothing in the log tells a position"));
    }
}

TEST(FuseRun, StopsWhenAskedTo) {
    const MadeRun made = makeRun();
    std::stop_source source;
    source.request_stop();
    SilentProgress progress;
    const auto result = fuseRun(made.survey, made.run(), ukfOptions(), progress, source.get_token());
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
}

// A filter without bias states must not be carried away by the bias of its accelerometer.
TEST(FuseRun, ABiasedAccelerometerDoesNotBeatTheBarometer) {
    MadeRun made = makeRun({.epochs = 3000, .speed_mps = 0.1});
    for (double& acceleration : made.log().column(Channel::AccelerationZ)) acceleration += 0.1;
    const FusedRun run = fused(made);
    EXPECT_LT(verticalRmse(made, run), 0.2);
    EXPECT_GT(use(run, "barometer")->used, 2900U);
}

TEST(FuseRun, AFarRangeWhereNothingCameBackIsNoHeightOverTheMark) {
    MadeRun made = makeRun();
    for (std::size_t i = 0; i < 10; ++i) made.log().column(Channel::Range)[i] = 65.535;
    EXPECT_NEAR(fused(made).trajectory.epochs[0].position_enu_m.z(), 1.2, 0.15);
}

TEST(FuseRun, RangesCutShortInHalfOfAStandLeaveTheTieWhole) {
    MadeRun made = makeRun();
    std::size_t stood = 0;
    while (made.log().time_s[stood] <= FusionOptions{}.stands.start_s) ++stood;
    stood -= stood % 2;
    for (std::size_t i = 0; i < stood; i += 2) made.log().column(Channel::Range)[i] = 0.15;
    if (made.log().time_s[stood] <= FusionOptions{}.stands.start_s) {
        made.log().column(Channel::Range)[stood] = kMissing;
    }
    const FusedRun run = fused(made);
    expectSound(run);
    EXPECT_NEAR(run.trajectory.epochs[0].position_enu_m.z(), 1.2, 0.15);
}

// Simulated surveys with the slow GNSS error of 100 s. Mean squared error over variance, ideally 1; two
// surveys hold few independent errors, so the bounds are wide. Believing each epoch anew must come out as the
// lie that it is.
TEST(FuseRun, OwnsUpToTimeCorrelatedErrors) {
    SilentProgress progress;
    FusionOptions naive = ukfOptions();
    naive.gnss.correlation_s = 0.0;
    double honest_nees = 0.0;
    double naive_nees = 0.0;
    for (std::uint64_t seed = 21; seed <= 22; ++seed) {
        SimulationOptions options;
        options.seed = seed;
        options.fixed_point_runs = 0;
        options.control_stops = 0;
        options.area_epochs = 4000;
        options.area_east_m = 30.0;
        options.area_north_m = 30.0;
        const auto simulated = simulateSurvey(options, progress, {});
        ASSERT_TRUE(simulated) << simulated.error().text();
        const terrawalk::Run& walk = simulated->survey.runs.front();
        const auto nees = [&](const FusionOptions& how) {
            const auto run = fuseRun(simulated->survey, walk, how, progress, {});
            EXPECT_TRUE(run);
            double sum = 0.0;
            for (std::size_t i = 0; run && i < run->trajectory.epochs.size(); ++i) {
                const TrajectoryEpoch& epoch = run->trajectory.epochs[i];
                const Eigen::Vector3d error =
                    epoch.position_enu_m - simulated->truth[0].epochs[i].position_enu_m;
                sum += 0.5 * (error.x() * error.x() / epoch.covariance(0, 0) +
                              error.y() * error.y() / epoch.covariance(1, 1));
            }
            return sum / static_cast<double>(walk.log.size());
        };
        honest_nees += 0.5 * nees(ukfOptions());
        naive_nees += 0.5 * nees(naive);
    }
    EXPECT_GT(honest_nees, 0.1);
    EXPECT_LT(honest_nees, 3.0);
    EXPECT_GT(naive_nees, 5.0 * honest_nees);
}

TEST(RawMode, HoldsTheLatestGnssPositionAndReadsTheBarometer) {
    MadeRun made = makeRun();
    ArrayLog& log = made.log();
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (i % 5 != 0) log.column(Channel::Latitude)[i] = kMissing;
    }
    const FusedRun raw = fused(made, rawOptions());
    const auto& epochs = raw.trajectory.epochs;
    for (std::size_t i = 10; i < 15; ++i) {
        EXPECT_EQ(epochs[i].position_enu_m.x(), epochs[10].position_enu_m.x());
        EXPECT_GE(epochs[i].covariance(0, 0),
                  epochs[10].covariance(0, 0) + 0.05 * static_cast<double>(i - 10));
    }
    EXPECT_NEAR(std::sqrt(epochs[10].covariance(0, 0)), FusionOptions{}.gnss.sigma_single_m, 1e-12);
    EXPECT_LT(verticalRmse(made, raw), 0.1);
    EXPECT_EQ(use(raw, "GNSS position")->used, 60U);
}

TEST(RawMode, AHeldPositionAgesAlikeAtAnyRate) {
    const auto sigmaAfterTwoSeconds = [](double interval_s) {
        MadeRun made =
            makeRun({.epochs = static_cast<std::size_t>(20.0 / interval_s) + 1U, .interval_s = interval_s});
        ArrayLog& log = made.log();
        for (std::size_t i = 0; i < log.size(); ++i) {
            if (log.time_s[i] > 10.0 + 1e-6) log.column(Channel::Latitude)[i] = kMissing;
        }
        const FusedRun raw = fused(made, rawOptions());
        const auto at = static_cast<std::size_t>(std::lround(12.0 / interval_s));
        return std::sqrt(raw.trajectory.epochs[at].covariance(0, 0));
    };
    const FusionOptions options = ukfOptions();
    const double expected = std::hypot(options.gnss.sigma_single_m, 2.0 * options.initial.walking_speed_mps);
    EXPECT_NEAR(sigmaAfterTwoSeconds(0.2), expected, 1e-9);
    EXPECT_NEAR(sigmaAfterTwoSeconds(0.02), expected, 1e-9);
}

TEST(RawMode, RefusesTheSameReadingsAsTheFilter) {
    MadeRun made = makeRun({.doppler = true});
    made.erase(Channel::FlowForward);
    made.erase(Channel::FlowLeft);
    for (std::size_t i = 100; i < 150; ++i) made.log().column(Channel::Fix)[i] = fix_code::kNone;
    for (std::size_t i = 200; i < 210; ++i) made.log().column(Channel::Pressure)[i] = -5.0;
    for (const FusedRun& run : {fused(made), fused(made, rawOptions())}) {
        EXPECT_EQ(rejected(run, "GNSS velocity", "no fix"), 50U);
        EXPECT_EQ(rejected(run, "barometer", "pressure not positive"), 10U);
    }
}

}  // namespace
}  // namespace terrawalk
