#include <gtest/gtest.h>

#include <cmath>

#include "fusion/process_model.hpp"

namespace terrawalk {
namespace {

constexpr int kV = offset(StateBlock::Velocity);
constexpr int kP = offset(StateBlock::Position);
constexpr int kA = offset(StateBlock::Acceleration);

TEST(Transition, IsNewtonsLawWhenAccelerationDoesNotDecay) {
    ProcessOptions options;
    options.acceleration_time_constant_s = 0.0;
    Vector9d x;
    x << 1.0, 0.0, 0.0, 5.0, 0.0, 0.0, 0.4, 0.0, 0.0;
    const Vector9d after = transition(options, 3.0).F * x;
    EXPECT_NEAR(after[kP], 5.0 + 3.0 + 0.5 * 0.4 * 9.0, 1e-12);
    EXPECT_NEAR(after[kV], 1.0 + 0.4 * 3.0, 1e-12);
    EXPECT_NEAR(after[kA], 0.4, 1e-15);
}

TEST(Transition, TwoStepsMakeOneOfTheirSum) {
    ProcessOptions options;
    for (const double tau_s : {0.0, 0.3, 1.0, 100.0}) {
        options.acceleration_time_constant_s = tau_s;
        const Transition first = transition(options, 0.13);
        const Transition second = transition(options, 0.31);
        const Transition whole = transition(options, 0.44);
        EXPECT_LT((second.F * first.F - whole.F).norm(), 1e-13) << tau_s;
        const Matrix9d Q = second.F * first.Q * second.F.transpose() + second.Q;
        // The rule's error is 2^8 (dt / tau)^9 (4!)^4 / (9 (8!)^3) tau q: 2e-10 at the longest step, half of
        // tau.
        EXPECT_LT((Q - whole.Q).norm(), 2e-10) << tau_s;
    }
}

TEST(Transition, NoiseOfConstantAccelerationHasItsClosedForm) {
    ProcessOptions options;
    options.acceleration_time_constant_s = 0.0;
    options.longest_step_s = 10.0;
    const ProcessNoiseOptions& noise = options.noise;
    const double t = 0.7;
    const Matrix9d Q = transition(options, t).Q;
    const double qp = noise.position_e_m2ps, qv = noise.velocity_e_m2ps3, qa = noise.acceleration_e_m2ps5;
    EXPECT_NEAR(Q(kP, kP), qp * t + qv * std::pow(t, 3) / 3.0 + qa * std::pow(t, 5) / 20.0, 1e-15);
    EXPECT_NEAR(Q(kP, kV), qv * t * t / 2.0 + qa * std::pow(t, 4) / 8.0, 1e-15);
    EXPECT_NEAR(Q(kP, kA), qa * std::pow(t, 3) / 6.0, 1e-15);
    EXPECT_NEAR(Q(kV, kV), qv * t + qa * std::pow(t, 3) / 3.0, 1e-15);
    EXPECT_NEAR(Q(kA, kA), qa * t, 1e-15);
}

TEST(Transition, EachOfTheNineDensitiesDrivesItsOwnState) {
    double ProcessNoiseOptions::*const terms[9] = {
        &ProcessNoiseOptions::velocity_e_m2ps3,     &ProcessNoiseOptions::velocity_n_m2ps3,
        &ProcessNoiseOptions::velocity_u_m2ps3,     &ProcessNoiseOptions::position_e_m2ps,
        &ProcessNoiseOptions::position_n_m2ps,      &ProcessNoiseOptions::position_u_m2ps,
        &ProcessNoiseOptions::acceleration_e_m2ps5, &ProcessNoiseOptions::acceleration_n_m2ps5,
        &ProcessNoiseOptions::acceleration_u_m2ps5};
    const Matrix9d before = transition(ProcessOptions{}, 0.01).Q;
    for (int i = 0; i < 9; ++i) {
        ProcessOptions options;
        options.noise.*terms[i] += 1.0;
        const Matrix9d change = transition(options, 0.01).Q - before;
        int row = 0;
        int column = 0;
        change.cwiseAbs().maxCoeff(&row, &column);
        EXPECT_EQ(row, i);
        EXPECT_EQ(column, i);
        EXPECT_NEAR(change(i, i), 0.01, 2e-4);
    }
}

TEST(Transition, LongGapsAreSteppedToTheStationaryAcceleration) {
    ProcessOptions options;
    options.acceleration_time_constant_s = 1.0;
    options.noise.acceleration_e_m2ps5 = 0.5;
    const Transition gap = transition(options, 120.0);
    // A first-order Gauss-Markov process settles at q tau / 2.
    EXPECT_NEAR(gap.Q(kA, kA), 0.25, 1e-9);
    EXPECT_NEAR(gap.F(kA, kA), std::exp(-120.0), 1e-60);
    EXPECT_NEAR(gap.F(kV, kA), 1.0, 1e-12);
    EXPECT_EQ(gap.Q, gap.Q.transpose());
}

}  // namespace
}  // namespace terrawalk
