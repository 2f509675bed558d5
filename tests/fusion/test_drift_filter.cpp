#include "fusion/drift_filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "fusion/drift_model.hpp"
#include "fusion/flow_screen.hpp"
#include "fusion/fuse_run.hpp"
#include "tests/fusion/made_run.hpp"
#include "tests/fusion/normal_numbers.hpp"

namespace terrawalk {
namespace {

FusionOptions terrawalkOptions() {
    FusionOptions options;
    options.method = FusionMethod::Terrawalk;
    return options;
}

Result<RunFusion> fuse(const MadeRun& made, const FusionOptions& options = terrawalkOptions()) {
    SilentProgress progress;
    return fuseRunInFull(made.survey, made.run(), options, progress, {});
}

RunFusion fused(const MadeRun& made, const FusionOptions& options = terrawalkOptions()) {
    auto result = fuse(made, options);
    if (!result) {
        ADD_FAILURE() << result.error().text();
        return {};
    }
    return std::move(*result);
}

const SensorUse* use(const FusedRun& run, std::string_view sensor) {
    for (const SensorUse& u : run.sensors) {
        if (u.sensor == sensor) return &u;
    }
    return nullptr;
}

double worstError(const MadeRun& made, const RunFusion& run) {
    double worst = 0.0;
    for (std::size_t i = 0; i < made.position_enu_m.size(); ++i) {
        worst =
            std::max(worst, (run.fused.trajectory.epochs[i].position_enu_m - made.position_enu_m[i]).norm());
    }
    return worst;
}

void expectSound(const RunFusion& run, std::size_t epochs) {
    ASSERT_EQ(run.fused.trajectory.epochs.size(), epochs);
    ASSERT_EQ(run.gnss_gated.size(), epochs);
    for (const TrajectoryEpoch& epoch : run.fused.trajectory.epochs) {
        ASSERT_TRUE(epoch.position_enu_m.allFinite());
        const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(epoch.covariance);
        ASSERT_GT(eigen.eigenvalues().minCoeff(), 0.0);
    }
}

DriftEstimate someState(double size) {
    NormalNumbers normal(7);
    DriftEstimate state;
    DriftMatrix A;
    for (int i = 0; i < kDriftStates; ++i) {
        for (int j = 0; j < kDriftStates; ++j) A(i, j) = size * normal();
    }
    state.covariance = A * A.transpose() + size * size * DriftMatrix::Identity();
    state.mean[kVelocityEast] = 0.9;
    state.mean[kVelocityNorth] = -0.4;
    state.mean[kFlowScale] = 1.05;
    state.mean[kCompassError] = 0.03;
    state.mean[kIronSin] = -0.04;
    state.mean[kIronCos] = 0.02;
    return state;
}

double flowOf(const DriftVector& x, const Eigen::Vector2d& d, double yaw) {
    const double e = x[kCompassError] + x[kIronSin] * std::sin(yaw) + x[kIronCos] * std::cos(yaw);
    return x[kFlowScale] * d.dot(Eigen::Rotation2Dd(e) * x.head<2>());
}

TEST(DriftModel, ARowIsTheKalmanUpdate) {
    const DriftEstimate before = someState(0.5);
    DriftRow row;
    row.direction[kUp] = row.direction[kBarometerDrift] = row.direction[kGust] = 1.0;
    row.value = 0.7;
    row.variance = 0.2;
    const DriftEstimate after = updated(before, row);
    // Information form, another way to the same posterior.
    const DriftMatrix information =
        before.covariance.inverse() + row.direction * row.direction.transpose() / row.variance;
    const DriftVector b =
        before.covariance.inverse() * before.mean + row.direction * row.value / row.variance;
    EXPECT_LT((after.covariance - information.inverse()).norm(), 1e-9 * before.covariance.norm());
    EXPECT_LT((after.mean - information.ldlt().solve(b)).norm(), 1e-8);
}

TEST(DriftModel, TheFlowRowIsItsGradientWhenTheStateIsSure) {
    const DriftEstimate state = someState(1e-4);
    const Eigen::Vector2d along(std::cos(0.5), std::sin(0.5));
    const double yaw = 0.7;
    const DriftRow row = linearisedFlow(state, along, yaw, 1.2, 0.01, {});
    for (int i = 0; i < kDriftStates; ++i) {
        const DriftVector step = 1e-6 * DriftVector::Unit(i);
        const double slope =
            (flowOf(state.mean + step, along, yaw) - flowOf(state.mean - step, along, yaw)) / 2e-6;
        EXPECT_NEAR(row.direction[i], slope, 1e-6) << i;
    }
    EXPECT_NEAR(innovation(state, row), 1.2 - flowOf(state.mean, along, yaw), 1e-6);
    EXPECT_NEAR(row.variance, 0.01, 1e-9);
}

// The transform is right to third order: with spreads of 0.1 what it leaves out is some 0.1^4, and 200000
// draws tell mean and variance of the flow to 0.3 %.
TEST(DriftModel, TheFlowRowHasTheMomentsOfAMonteCarlo) {
    DriftEstimate state = someState(0.05);
    const Eigen::Vector2d along(0.6, 0.8);
    const double yaw = -1.1;
    const DriftRow row = linearisedFlow(state, along, yaw, 0.0, 0.0, {});
    const DriftMatrix L = state.covariance.llt().matrixL();
    NormalNumbers normal(3);
    const int n = 200000;
    double sum = 0.0;
    double squares = 0.0;
    for (int k = 0; k < n; ++k) {
        DriftVector z;
        for (int i = 0; i < kDriftStates; ++i) z[i] = normal();
        const double flow = flowOf(state.mean + L * z, along, yaw);
        sum += flow;
        squares += flow * flow;
    }
    const double mean = sum / n;
    const double variance = squares / n - mean * mean;
    const double sigma = std::sqrt(variance);
    EXPECT_NEAR(-innovation(state, row), mean, 0.01 * sigma);
    EXPECT_NEAR(innovationVariance(state, row), variance, 0.02 * variance);
    // The second order is there: the flow at the mean state is another one.
    EXPECT_GT(std::abs(flowOf(state.mean, along, yaw) - mean), 0.03 * sigma);
}

TEST(DriftModel, OneLongStepIsManyShortOnes) {
    const FusionOptions options;
    const GnssErrorStep gnss{false, 1.2, 1.9};
    const DriftTransition whole = driftTransition(options, 10.0, gnss);
    DriftTransition parts = driftTransition(options, 0.1, gnss);
    const DriftTransition step = parts;
    for (int k = 1; k < 100; ++k) {
        parts.F = (step.F * parts.F).eval();
        parts.Q = (step.F * parts.Q * step.F.transpose() + step.Q).eval();
    }
    EXPECT_LT((whole.F - parts.F).norm(), 1e-9);
    EXPECT_LT((whole.Q - parts.Q).norm(), 1e-9 * whole.Q.norm());
}

TEST(DriftModel, ANewKindOfFixForgetsTheGnssErrorAlone) {
    const DriftTransition step = driftTransition({}, 0.2, {true, 0.3, 0.4});
    const DriftEstimate before = someState(0.5);
    const DriftMatrix P = step.F * before.covariance * step.F.transpose() + step.Q;
    EXPECT_EQ((step.F * before.mean).tail<3>(), Eigen::Vector3d::Zero());
    EXPECT_NEAR(P(kGnssErrorEast, kGnssErrorEast), 0.09, 1e-15);
    EXPECT_NEAR(P(kGnssErrorUp, kGnssErrorUp), 0.16, 1e-15);
    EXPECT_EQ((P.block<3, 12>(kGnssErrorEast, 0).norm()), 0.0);
    EXPECT_NEAR(P(kFlowScale, kIronSin), before.covariance(kFlowScale, kIronSin), 1e-15);
}

// The errors of single fixes of the first half must not be carried over to RTK.
TEST(DriftFilter, AChangeToRtkPullsTheTrackIn) {
    MadeRun made = makeRun({.errors = {.gnss_m = 0.01}});
    made.run().start.reset();
    for (std::size_t i = 0; i < made.log().size(); ++i) {
        if (i < 150) {
            made.log().column(Channel::Latitude)[i] += 2.0 / 111000.0;
        } else {
            made.log().column(Channel::Fix)[i] = fix_code::kRtkFixed;
        }
    }
    const RunFusion run = fused(made);
    expectSound(run, made.log().size());
    const auto& epochs = run.fused.trajectory.epochs;
    EXPECT_LT((epochs[160].position_enu_m - made.position_enu_m[160]).head<2>().norm(), 0.1);
    // Backwards, flow carries the RTK position into the time of the biased fixes.
    EXPECT_LT((epochs[100].position_enu_m - made.position_enu_m[100]).head<2>().norm(), 0.7);
}

// Without noise only the sway of roll and pitch between readings, the acceleration within an epoch and the
// pull of the prior at the turns are left.
TEST(DriftFilter, ReproducesARunWithoutErrors) {
    MadeRun made = makeRun({.errors = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}});
    made.run().target = "T01";
    EXPECT_LT(worstError(made, fused(made)), 0.08);
}

TEST(DriftFilter, LearnsTheScaleOfTheFlowAndTheErrorOfTheCompass) {
    MadeRun made = makeRun({.epochs = 900, .errors = {.gnss_m = 0.01}});
    made.run().target = "T01";
    for (double& fix : made.log().column(Channel::Fix)) fix = fix_code::kRtkFixed;
    for (std::size_t i = 400; i < 600; ++i) made.log().column(Channel::Latitude)[i] = kMissing;
    for (double& heading_rad : made.log().column(Channel::Heading)) heading_rad += radians(5.0);
    for (double& flow : made.log().column(Channel::FlowForward)) flow *= 1.15;
    FusionOptions forward = terrawalkOptions();
    forward.smooth = false;
    const auto error = [&](const RunFusion& run) {
        return (run.fused.trajectory.epochs[599].position_enu_m - made.position_enu_m[599]).head<2>().norm();
    };
    // 40 m of outage: uncorrected, 15 % of scale and 5 degrees are 7 m.
    EXPECT_LT(error(fused(made, forward)), 0.8);
    forward.method = FusionMethod::Ukf;
    EXPECT_GT(error(fused(made, forward)), 4.0);
}

TEST(DriftFilter, SmoothingIsNeverLessCertain) {
    MadeRun made = makeRun();
    made.run().target = "T01";
    for (std::size_t i = 100; i < 200; ++i) made.log().column(Channel::Fix)[i] = fix_code::kRtkFloat;
    FusionOptions forward = terrawalkOptions();
    forward.smooth = false;
    const RunFusion filtered = fused(made, forward);
    const RunFusion smooth = fused(made);
    for (std::size_t i = 0; i < made.log().size(); ++i) {
        const Matrix6d gained =
            filtered.fused.trajectory.epochs[i].covariance - smooth.fused.trajectory.epochs[i].covariance;
        ASSERT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(gained).eigenvalues().minCoeff(), -1e-9) << i;
    }
}

TEST(DriftFilter, DropsAJumpOfGnssAndSaysSo) {
    MadeRun made = makeRun({.errors = {.gnss_m = 0.25}});
    for (std::size_t i = 150; i < 170; ++i) made.log().column(Channel::Latitude)[i] += 30.0 / 111000.0;
    const RunFusion run = fused(made);
    for (std::size_t i = 0; i < run.gnss_gated.size(); ++i) {
        EXPECT_EQ(run.gnss_gated[i], i >= 150 && i < 170) << i;
    }
    const SensorUse* gnss = use(run.fused, "GNSS position");
    ASSERT_NE(gnss, nullptr);
    ASSERT_EQ(gnss->rejections.size(), 1U);
    EXPECT_EQ(gnss->rejections[0].reason, "beyond gate");
    EXPECT_EQ(gnss->rejections[0].count, 20U);
    EXPECT_LT(worstError(made, run), 2.0);
}

TEST(DriftFilter, LetsABarometerInAgainThatJumpedForGood) {
    MadeRun made = makeRun({.epochs = 900, .speed_mps = 0.3});
    for (std::size_t i = 300; i < 900; ++i) made.log().column(Channel::Pressure)[i] += 600.0;  // 50 m
    const RunFusion run = fused(made);
    const SensorUse* barometer = use(run.fused, "barometer");
    ASSERT_NE(barometer, nullptr);
    EXPECT_GT(barometer->used, 700U);
    EXPECT_LT(barometer->used, 800U);
    EXPECT_THAT(run.fused.notes.details, testing::Contains(testing::HasSubstr("let in again")));
    // The jump is the barometer's; the walk climbs 2.7 m, and of that the filter knows little.
    const auto& epochs = run.fused.trajectory.epochs;
    EXPECT_LT(std::abs(epochs[899].position_enu_m.z() - made.position_enu_m[899].z()), 3.0);
}

TEST(DriftFilter, AGapOfHalfAnHourLeavesTheRestWhole) {
    MadeRun made = makeRun();
    for (std::size_t i = 150; i < 300; ++i) made.log().time_s[i] += 1800.0;
    const RunFusion run = fused(made);
    expectSound(run, made.log().size());
    const auto& epochs = run.fused.trajectory.epochs;
    EXPECT_LT((epochs[299].position_enu_m - made.position_enu_m[299]).head<2>().norm(), 3.0);
}

TEST(DriftFilter, NamesWhyItDiverges) {
    MadeRun made = makeRun({.epochs = 3000});
    for (const Channel c : {Channel::Latitude, Channel::FlowForward, Channel::FlowLeft}) {
        auto& column = made.log().column(c);
        std::fill(column.begin() + 100, column.end(), kMissing);
    }
    const auto run = fuse(made);
    ASSERT_FALSE(run);
    EXPECT_EQ(run.error().kind, ErrorKind::BadData);
    EXPECT_THAT(run.error().text(), testing::HasSubstr("the position is known to no better than"));
}

class WithoutSensor : public testing::TestWithParam<std::vector<Channel>> {};

TEST_P(WithoutSensor, StaysSound) {
    MadeRun made = makeRun();
    for (const Channel c : GetParam()) made.erase(c);
    expectSound(fused(made), made.log().size());
}

INSTANTIATE_TEST_SUITE_P(
    DriftFilter, WithoutSensor,
    testing::Values(std::vector<Channel>{Channel::Latitude, Channel::Longitude},
                    std::vector<Channel>{Channel::FlowForward, Channel::FlowLeft},
                    std::vector<Channel>{Channel::Pressure},
                    std::vector<Channel>{Channel::Pressure, Channel::EllipsoidalHeight},
                    std::vector<Channel>{Channel::Roll, Channel::Pitch, Channel::Heading},
                    std::vector<Channel>{Channel::Range}, std::vector<Channel>{Channel::Fix}));

TEST(DriftFilter, StopsWhenAskedTo) {
    const MadeRun made = makeRun();
    std::stop_source source;
    source.request_stop();
    SilentProgress progress;
    const auto run = fuseRunInFull(made.survey, made.run(), terrawalkOptions(), progress, source.get_token());
    ASSERT_FALSE(run);
    EXPECT_EQ(run.error().kind, ErrorKind::Cancelled);
}

// Flow that is noisier than said must weigh less; the truth of the factor is 4 in variance.
TEST(DriftModel, TheNoiseFactorFollowsTheInnovations) {
    for (const auto& [noise_mps, least, most] : {std::tuple{0.055, 0.5, 1.6}, std::tuple{0.165, 2.5, 4.0}}) {
        const MadeRun made = makeRun({.epochs = 3000, .speed_mps = 0.0, .errors = {.flow_mps = noise_mps}});
        const FusionOptions options = terrawalkOptions();
        RunNotes notes;
        const auto attitudes = epochAttitudes(made.run().log, options.attitude, notes);
        RunReference reference;
        reference.has_horizontal = reference.has_height = true;
        FusionOptions reading = options;
        reading.accelerometer.use = false;
        const LocalFrame frame = made.survey.frame();
        const FlowRejections flow = flowRejections(made.run().log, attitudes, reading.flow);
        const ReadingContext context{made.run().log, reading, frame, attitudes, reference, flow};
        DriftModel model(context);
        RunFilter filter(context, made.run(), model);
        for (std::size_t i = 0; i < made.run().log.size(); ++i) ASSERT_FALSE(filter.step(i));
        EXPECT_GT(model.noiseFactor(Sensor::OpticalFlow), least);
        EXPECT_LE(model.noiseFactor(Sensor::OpticalFlow), most);
    }
}

}  // namespace
}  // namespace terrawalk
