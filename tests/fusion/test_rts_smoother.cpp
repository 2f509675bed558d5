#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

#include "fusion/rts_smoother.hpp"
#include "tests/fusion/normal_numbers.hpp"

namespace terrawalk {
namespace {

// One draw of the very model that the filter assumes, and the filter's answer to it.
struct MatchedRun {
    std::vector<double> time_s;
    std::vector<Vector9d> truth;
    std::vector<StateEstimate> filtered;
    std::vector<PackedEstimate> packed_filtered;
};

MatchedRun matchedRun(std::uint64_t seed, std::size_t epochs) {
    NormalNumbers normal(seed);
    const auto draw = [&](const Matrix9d& P) -> Vector9d {
        Vector9d z;
        for (int i = 0; i < 9; ++i) z[i] = normal();
        const Matrix9d L = P.llt().matrixL();
        return L * z;
    };
    MatchedRun run;
    StateEstimate state;
    state.covariance = Matrix9d::Identity();
    Vector9d x = draw(state.covariance);
    double time_s = 0.0;
    const ProcessOptions options;
    for (std::size_t k = 0; k < epochs; ++k) {
        if (k > 0) {
            // Irregular, with a gap of 4 s.
            const double dt_s = k == epochs / 2 ? 4.0 : 0.1 + 0.2 * normal.uniform();
            time_s += dt_s;
            const Transition step = transition(options, dt_s);
            x = step.F * x + draw(step.Q);
            state = predicted(state, step);
        }
        const auto measure = [&](StateBlock block, int axis, double sigma) {
            state = updated(state, {block, Eigen::Vector3d::Unit(axis),
                                    x[offset(block) + axis] + sigma * normal(), sigma * sigma});
        };
        if (k % 3 == 0) measure(StateBlock::Position, 0, 1.0);
        if (k % 3 == 0) measure(StateBlock::Position, 1, 1.0);
        measure(StateBlock::Position, 2, 0.3);
        if (k % 4 != 1) measure(StateBlock::Velocity, 0, 0.1);
        if (k % 4 != 1) measure(StateBlock::Velocity, 1, 0.1);
        for (int axis = 0; axis < 3; ++axis) measure(StateBlock::Acceleration, axis, 0.5);
        run.time_s.push_back(time_s);
        run.truth.push_back(x);
        run.filtered.push_back(state);
        run.packed_filtered.push_back(packed(state));
    }
    return run;
}

double nees(const StateEstimate& state, const Vector9d& truth) {
    const Vector9d error = state.mean - truth;
    return error.dot(state.covariance.ldlt().solve(error));
}

TEST(Packing, ComesBackTheSame) {
    const MatchedRun run = matchedRun(1, 5);
    const StateEstimate back = unpacked(packed(run.filtered.back()));
    EXPECT_EQ(back.mean, run.filtered.back().mean);
    EXPECT_EQ(back.covariance, run.filtered.back().covariance);
}

// What the response promises, against a filter and smoother whose height readings are all a metre higher.
TEST(Smoother, CarriesTheResponseToTheHeightReference) {
    constexpr std::size_t kEpochs = 60;
    const ProcessOptions options;
    std::vector<double> time_s;
    std::vector<PackedEstimate> low;
    std::vector<PackedEstimate> high;
    StateEstimate at_low;
    StateEstimate at_high;
    Vector9d response = Vector9d::Zero();
    for (std::size_t k = 0; k < kEpochs; ++k) {
        time_s.push_back(0.3 * static_cast<double>(k));
        if (k > 0) {
            const Transition step = transition(options, 0.3);
            at_low = predicted(at_low, step);
            at_high = predicted(at_high, step);
            response = (step.F * response).eval();
        }
        // Readings from the height reference, and now and then one that has a height of its own.
        const bool moves = k % 10 != 7;
        LinearRow row{StateBlock::Position, Eigen::Vector3d::UnitZ(), 0.1 * static_cast<double>(k), 0.2};
        const double shift = moves ? 1.0 : 0.0;
        response += gain(at_low, row) * (shift - response[offset(StateBlock::Position) + 2]);
        at_low = updated(at_low, row);
        row.value += shift;
        at_high = updated(at_high, row);
        low.push_back(packed(at_low));
        low.back().height_response = response;
        high.push_back(packed(at_high));
    }
    low = smoothed(std::move(low), time_s, options, {}, {});
    high = smoothed(std::move(high), time_s, options, {}, {});
    for (std::size_t k = 0; k < kEpochs; ++k) {
        EXPECT_LT((high[k].mean - low[k].mean - low[k].height_response).norm(), 1e-9);
    }
    EXPECT_GT(low[30].height_response[offset(StateBlock::Position) + 2], 0.5);
    EXPECT_LT(low[30].height_response[offset(StateBlock::Position) + 2], 1.0);
}

// Over N independent runs the sum of NEES is chi-square with 9 N degrees of freedom: mean 9 N, variance 18 N.
TEST(FilterAndSmoother, AreAsSureAsTheyMayBeOnAMatchedModel) {
    constexpr int kRuns = 300;
    double filter_last = 0.0;
    double filter_middle = 0.0;
    double smoother_middle = 0.0;
    double smoother_first = 0.0;
    for (int r = 0; r < kRuns; ++r) {
        const MatchedRun run = matchedRun(100 + static_cast<std::uint64_t>(r), 80);
        const auto smooth = smoothed(run.packed_filtered, run.time_s, ProcessOptions{}, {}, {});
        filter_last += nees(run.filtered.back(), run.truth.back());
        filter_middle += nees(run.filtered[40], run.truth[40]);
        smoother_middle += nees(unpacked(smooth[40]), run.truth[40]);
        smoother_first += nees(unpacked(smooth[0]), run.truth[0]);
    }
    const double four_sigma = 4.0 * std::sqrt(18.0 / kRuns);
    EXPECT_NEAR(filter_last / kRuns, 9.0, four_sigma);
    EXPECT_NEAR(filter_middle / kRuns, 9.0, four_sigma);
    EXPECT_NEAR(smoother_middle / kRuns, 9.0, four_sigma);
    EXPECT_NEAR(smoother_first / kRuns, 9.0, four_sigma);
}

TEST(Smoother, IsNeverLessCertainThanTheFilterAndNearerToTheTruth) {
    const MatchedRun run = matchedRun(7, 600);
    const auto smooth = smoothed(run.packed_filtered, run.time_s, ProcessOptions{}, {}, {});
    ASSERT_EQ(smooth.size(), run.filtered.size());
    double filter_squares = 0.0;
    double smoother_squares = 0.0;
    for (std::size_t k = 0; k < smooth.size(); ++k) {
        const StateEstimate s = unpacked(smooth[k]);
        const Matrix9d gained = run.filtered[k].covariance - s.covariance;
        EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix9d>(gained).eigenvalues().minCoeff(), -1e-10);
        EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix9d>(s.covariance).eigenvalues().minCoeff(), 0.0);
        filter_squares +=
            (run.filtered[k].mean - run.truth[k]).segment<3>(offset(StateBlock::Position)).squaredNorm();
        smoother_squares += (s.mean - run.truth[k]).segment<3>(offset(StateBlock::Position)).squaredNorm();
    }
    EXPECT_LT(smoother_squares, 0.7 * filter_squares);
    EXPECT_EQ(unpacked(smooth.back()).mean, run.filtered.back().mean);
}

// What the filter added by hand in an epoch must be process noise to the smoother, or the two contradict each
// other.
TEST(Smoother, TakesInflationsForProcessNoise) {
    MatchedRun run = matchedRun(9, 40);
    const std::vector<Inflation> inflations{{20, StateBlock::Position, Eigen::Vector3d(1e6, 1e6, 1e6)}};
    const Transition plain = transition(ProcessOptions{}, run.time_s[20] - run.time_s[19]);
    const Transition with = transitionInto(20, run.time_s, ProcessOptions{}, inflations);
    EXPECT_EQ(with.F, plain.F);
    EXPECT_NEAR(with.Q(3, 3) - plain.Q(3, 3), 1e6, 1e-6);
    EXPECT_EQ(transitionInto(21, run.time_s, ProcessOptions{}, inflations).Q,
              transition(ProcessOptions{}, run.time_s[21] - run.time_s[20]).Q);
}

}  // namespace
}  // namespace terrawalk
