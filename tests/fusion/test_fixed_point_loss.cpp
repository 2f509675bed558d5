#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

#include "fusion/fixed_point_loss.hpp"
#include "fusion/fuse_run.hpp"
#include "tests/fusion/measured_survey.hpp"
#include "tests/fusion/normal_numbers.hpp"

namespace terrawalk {
namespace {

const SimulatedSurvey& smallSurvey() {
    static const SimulatedSurvey kSurvey = [] {
        SimulationOptions simulation;
        simulation.fixed_point_runs = 4;
        simulation.area_epochs = 0;
        simulation.control_stops = 0;
        simulation.check_points = 3;
        return simulatedSurvey(simulation);
    }();
    return kSurvey;
}

FixedPointLoss prepared(const FusionOptions& options = {}) {
    auto loss = FixedPointLoss::prepare(smallSurvey().survey, options);
    EXPECT_TRUE(loss) << loss.error().text();
    return *loss;
}

std::vector<double> someCandidates(std::size_t n, std::size_t dimensions) {
    NormalNumbers normal(9);
    const CandidateBounds bounds = candidateBounds(dimensions);
    std::vector<double> candidates;
    for (std::size_t i = 0; i < n * dimensions; ++i) {
        const double share = 0.5 + 0.5 * std::erf(normal() / std::sqrt(2.0));
        const std::size_t k = i % dimensions;
        candidates.push_back(bounds.lower[k] + share * (bounds.upper[k] - bounds.lower[k]));
    }
    return candidates;
}

// The loss of one run, taken from the trajectory that the method itself gives.
SquaredError lossOfTrajectory(const Run& run, FusionOptions options) {
    options.method = FusionMethod::Aukf;
    SilentProgress progress;
    const auto fused = fuseRun(smallSurvey().survey, run, options, progress, {});
    EXPECT_TRUE(fused);
    const double from_s = run.log.time_s.back() - options.stands.target_s;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::vector<double> heights;
    double n = 0.0;
    for (std::size_t i = 0; i < run.log.size(); ++i) {
        if (run.log.time_s[i] < from_s) continue;
        const TrajectoryEpoch& epoch = fused->trajectory.epochs[i];
        sum += epoch.position_enu_m;
        n += 1.0;
        const double height_m = heightAboveGround(run.log, i, epoch.attitude, options.ties);
        if (present(height_m)) heights.push_back(height_m);
    }
    std::sort(heights.begin(), heights.end());
    const std::size_t k = heights.size();
    const double height_m = 0.5 * (heights[(k - 1) / 2] + heights[k / 2]);
    const Eigen::Vector3d d =
        sum / n - smallSurvey().survey.findMark(*run.target)->enu_m - height_m * Eigen::Vector3d::UnitZ();
    return {d.head<2>().squaredNorm(), d.z() * d.z()};
}

TEST(Candidate, IsTheOptionsInAnotherForm) {
    AukfOptions options;
    options.noise = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 10.0};
    options.unscented = {0.5, 3.0, 1.5};
    const std::vector<double> candidate = candidateOf(options, kAllDimensions);
    ASSERT_EQ(candidate.size(), 12U);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(candidate[i], -1.0 - static_cast<double>(i), 1e-12);
    EXPECT_NEAR(candidate[8], 1.0, 1e-12);
    const AukfOptions back = withCandidate({}, candidate);
    EXPECT_NEAR(back.noise.velocity_e_m2ps2, 1e-4, 1e-16);
    EXPECT_NEAR(back.noise.acceleration_u_m2ps4, 10.0, 1e-12);
    EXPECT_EQ(back.unscented.alpha, 0.5);
    EXPECT_EQ(back.unscented.kappa, 1.5);
    const CandidateBounds bounds = candidateBounds(kAllDimensions);
    for (std::size_t i = 0; i < 12; ++i) {
        EXPECT_LE(bounds.lower[i], candidate[i]);
        EXPECT_GE(bounds.upper[i], candidate[i]);
    }
}

TEST(FixedPointLoss, IsTheDistanceOfTheMethodsOwnTrajectory) {
    for (const FilterKind filter : {FilterKind::Ekf, FilterKind::Ckf, FilterKind::Ukf,
                                    FilterKind::SquareRootUkf, FilterKind::AdaptiveUkf}) {
        FusionOptions options;
        options.aukf.filter = filter;
        const FixedPointLoss loss = prepared(options);
        ASSERT_EQ(loss.runs().size(), 4U);
        const auto each = loss.runLosses(candidateOf(options.aukf, kNoiseDimensions));
        for (std::size_t r = 0; r < 4; ++r) {
            const SquaredError expected = lossOfTrajectory(smallSurvey().survey.runs[r], options);
            // Rounding of the positions is below 1e-8 m; the distances are metres.
            EXPECT_NEAR(each[r].horizontal_m2, expected.horizontal_m2, 1e-6);
            EXPECT_NEAR(each[r].vertical_m2, expected.vertical_m2, 1e-6);
        }
    }
}

TEST(FixedPointLoss, SumsOverTheRunsThatAreChosen) {
    const FixedPointLoss loss = prepared();
    const std::vector<double> candidate = candidateOf({}, kNoiseDimensions);
    const auto each = loss.runLosses(candidate);
    double total = 0.0;
    for (const SquaredError& e : each) total += e.total_m2();
    EXPECT_NEAR(loss.loss(candidate).total_m2(), total, 1e-12 * total);
    EXPECT_NEAR(loss.rmse(total), std::sqrt(total / 4.0), 1e-12);

    const FixedPointLoss rest = loss.without(1);
    ASSERT_EQ(rest.runs().size(), 3U);
    EXPECT_EQ(rest.runs()[1].id, loss.runs()[2].id);
    EXPECT_NEAR(rest.loss(candidate).total_m2(), total - each[1].total_m2(), 1e-12 * total);
    const std::vector<std::size_t> second{1};
    EXPECT_EQ(rest.over(second).loss(candidate).total_m2(), each[2].total_m2());
    EXPECT_EQ(rest.epochs() + loss.runs()[1].epochs, loss.epochs());
}

TEST(FixedPointLoss, DoesNotDependOnBatchOrThreads) {
    const FixedPointLoss loss = prepared();
    constexpr std::size_t kCandidates = 21;
    const std::vector<double> candidates = someCandidates(kCandidates, kAllDimensions);
    std::vector<double> together(2 * kCandidates);
    loss.losses(candidates, kAllDimensions, together);
    std::vector<double> on_one_thread(2 * kCandidates);
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        loss.losses(candidates, kAllDimensions, on_one_thread);
    }
    EXPECT_EQ(together, on_one_thread);
    for (std::size_t c = 0; c < kCandidates; ++c) {
        const SquaredError alone =
            loss.loss(std::span(candidates).subspan(c * kAllDimensions, kAllDimensions));
        EXPECT_EQ(alone.horizontal_m2, together[2 * c]);
        EXPECT_EQ(alone.vertical_m2, together[2 * c + 1]);
    }
    EXPECT_GT(std::set<double>(together.begin(), together.end()).size(), kCandidates);
}

TEST(FixedPointLoss, IsFiniteAllOverTheBox) {
    const FixedPointLoss loss = prepared();
    std::vector<double> candidates = someCandidates(64, kAllDimensions);
    const CandidateBounds bounds = candidateBounds(kAllDimensions);
    candidates.insert(candidates.end(), bounds.lower.begin(), bounds.lower.end());
    candidates.insert(candidates.end(), bounds.upper.begin(), bounds.upper.end());
    std::vector<double> losses(2 * 66);
    loss.losses(candidates, kAllDimensions, losses);
    for (const double l : losses) EXPECT_TRUE(std::isfinite(l));
}

TEST(FixedPointLoss, IsInfiniteWhereTheFilterDiverges) {
    for (const FilterKind filter : {FilterKind::Ukf, FilterKind::SquareRootUkf}) {
        FusionOptions options;
        options.aukf.filter = filter;
        std::vector<double> candidate = candidateOf({}, kNoiseDimensions);
        candidate[3] = 400.0;  // 10^400 is infinite
        const SquaredError error = prepared(options).loss(candidate);
        EXPECT_EQ(error.horizontal_m2, std::numeric_limits<double>::infinity());
        EXPECT_EQ(error.total_m2(), std::numeric_limits<double>::infinity());
    }
}

TEST(FixedPointLoss, NeverTouchesACheckMark) {
    Survey survey = smallSurvey().survey;
    const std::string target = *survey.runs[2].target;
    const auto mark = std::find_if(survey.marks.begin(), survey.marks.end(),
                                   [&](const ControlMark& m) { return m.name == target; });
    mark->role = MarkRole::Check;
    const auto loss = FixedPointLoss::prepare(survey, {});
    ASSERT_TRUE(loss);
    ASSERT_EQ(loss->runs().size(), 3U);
    for (const FixedPointRun& run : loss->runs()) EXPECT_NE(run.target, target);
    for (ControlMark& m : survey.marks) m.role = MarkRole::Check;
    const auto none = FixedPointLoss::prepare(survey, {});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().kind, ErrorKind::BadData);
}

}  // namespace
}  // namespace terrawalk
