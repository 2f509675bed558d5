#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mapping/mark_residuals.hpp"

namespace terrawalk {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

ControlMark mark(std::string name, const Eigen::Vector3d& enu_m, MarkRole role = MarkRole::Check) {
    return {std::move(name), enu_m, 0.03, 0.04, role};
}

GroundPoint point(double time_s, const Eigen::Vector3d& enu_m,
                  GroundPointState state = GroundPointState::Used, std::uint32_t run = 0) {
    GroundPoint p;
    p.run = run;
    p.epoch = static_cast<std::uint32_t>(time_s * 10.0);
    p.time_s = time_s;
    p.enu_m = enu_m;
    p.sigma_e_m = 0.4;
    p.sigma_n_m = 0.5;
    p.sigma_u_m = 0.3;
    p.state = state;
    return p;
}

Run run(std::string id) {
    Run r;
    r.id = std::move(id);
    return r;
}

MarkStand stand(StandPlace place, ControlMark m, double from_s, double to_s, bool may_tie) {
    return {place, std::move(m), from_s, to_s, may_tie};
}

// ---------------------------------------------------------------------------------------------- position on
// mark

/// An array exactly above each of the points, with their sigmas.
Trajectory trajectoryOver(const std::vector<GroundPoint>& points) {
    Trajectory trajectory;
    for (const GroundPoint& p : points) {
        TrajectoryEpoch epoch;
        epoch.time_s = p.time_s;
        epoch.position_enu_m = p.enu_m + 1.2 * Eigen::Vector3d::UnitZ();
        epoch.covariance(0, 0) = p.sigma_e_m * p.sigma_e_m;
        epoch.covariance(1, 1) = p.sigma_n_m * p.sigma_n_m;
        trajectory.epochs.push_back(epoch);
    }
    return trajectory;
}

MarkResiduals residualsBelow(const Run& of, const std::vector<MarkStand>& stands,
                             std::vector<GroundPoint> points, Stage stage, bool tied) {
    for (std::size_t i = 0; i < points.size(); ++i) points[i].epoch = static_cast<std::uint32_t>(i);
    return positionResiduals(of, stands, trajectoryOver(points), points, stage, tied);
}

TEST(PositionResiduals, AreProductMinusMarkOnEachAxis) {
    const std::vector<GroundPoint> points{point(1.0, {10.5, 19.0, 3.25}), point(2.0, {10.5, 19.0, 3.25})};
    const auto out =
        residualsBelow(run("F01"), {stand(StandPlace::Target, mark("P", {10, 20, 3}), 0, 5, false)}, points,
                       Stage::Fused, true);
    ASSERT_EQ(out.residuals.size(), 1U);
    const Residual& r = out.residuals[0];
    EXPECT_EQ(r.difference_enu_m, Eigen::Vector3d(0.5, -1.0, 0.25));
    EXPECT_EQ(r.run, "F01");
    EXPECT_EQ(r.mark, "P");
    EXPECT_EQ(r.quantity, Quantity::ArrayPosition);
    EXPECT_FALSE(r.used_by_estimator);
}

TEST(PositionResiduals, SigmaIsThatOfOnePointAndOfTheMark) {
    std::vector<GroundPoint> points;
    for (int i = 0; i < 100; ++i) points.push_back(point(0.01 * i, {0, 0, 0}));
    const auto out =
        residualsBelow(run("F01"), {stand(StandPlace::Target, mark("P", {0, 0, 0}), 0, 5, false)}, points,
                       Stage::Fused, true);
    EXPECT_NEAR(out.residuals[0].sigma_enu_m.x(), std::hypot(0.4, 0.03), 1e-15);
    EXPECT_NEAR(out.residuals[0].sigma_enu_m.y(), std::hypot(0.5, 0.03), 1e-15);
    EXPECT_NEAR(out.residuals[0].sigma_enu_m.z(), std::hypot(0.3, 0.04), 1e-15);
}

TEST(PositionResiduals, SingleBadRangesDoNoHarm) {
    std::vector<GroundPoint> points;
    for (int i = 0; i < 8; ++i) points.push_back(point(i, {0, 0, i == 3 ? -900.0 : 0.125}));
    const auto out = residualsBelow(run("F01"), {stand(StandPlace::Stop, mark("P", {0, 0, 0}), 0, 7, false)},
                                    points, Stage::Fused, true);
    EXPECT_EQ(out.residuals[0].difference_enu_m.z(), 0.125);
}

TEST(PositionResiduals, TakeEpochsOfTheStandWithASoundRangeOnly) {
    const double missing = kMissing;
    const std::vector<GroundPoint> points{point(0.9, {0, 0, 50}),
                                          point(1.0, {0, 0, 1}, GroundPointState::Thinned),
                                          point(1.5, {missing, missing, missing}, GroundPointState::NoRange),
                                          point(1.6, {0, 0, 50}, GroundPointState::Spike),
                                          point(1.7, {0, 0, 50}, GroundPointState::WeakReturn),
                                          point(2.0, {0, 0, 3}, GroundPointState::PositionUnsure),
                                          point(2.1, {0, 0, 50})};
    const auto out = residualsBelow(run("F01"), {stand(StandPlace::Stop, mark("P", {0, 0, 0}), 1, 2, false)},
                                    points, Stage::Fused, true);
    EXPECT_EQ(out.residuals[0].difference_enu_m.z(), 2.0);
}

TEST(PositionResiduals, AreFlaggedWhereTheEstimatorWasTied) {
    const std::vector<MarkStand> stands{
        stand(StandPlace::Stop, mark("C", {0, 0, 0}, MarkRole::Control), 0, 5, true),
        stand(StandPlace::Target, mark("T", {0, 0, 0}, MarkRole::Control), 0, 5, false)};
    const std::vector<GroundPoint> points{point(1.0, {0, 0, 0})};
    const auto tied = residualsBelow(run("F01"), stands, points, Stage::Fused, true);
    EXPECT_TRUE(tied.residuals[0].used_by_estimator);
    EXPECT_FALSE(tied.residuals[1].used_by_estimator);
    const auto raw = residualsBelow(run("F01"), stands, points, Stage::BeforeFusion, false);
    EXPECT_FALSE(raw.residuals[0].used_by_estimator);
}

TEST(PositionResiduals, LeaveOutTheStartFromWhichHeightsAreCounted) {
    const std::vector<GroundPoint> points{point(1.0, {0, 0, 0})};
    const auto zeroed = residualsBelow(
        run("F01"), {stand(StandPlace::Start, mark("ZERO", {0, 0, 0}, MarkRole::Control), 0, 5, true)},
        points, Stage::BeforeFusion, false);
    EXPECT_THAT(zeroed.residuals, IsEmpty());
    EXPECT_THAT(zeroed.missing, IsEmpty());
    const auto check =
        residualsBelow(run("F01"), {stand(StandPlace::Start, mark("K", {0, 0, 0}), 0, 5, false)}, points,
                       Stage::BeforeFusion, false);
    EXPECT_EQ(check.residuals.size(), 1U);
}

TEST(PositionResiduals, NameStandsWithoutASoundRange) {
    const auto out =
        residualsBelow(run("F07"), {stand(StandPlace::Target, mark("P", {0, 0, 0}), 1, 2, false)},
                       {point(1.5, {0, 0, 0}, GroundPointState::Tilted)}, Stage::Fused, true);
    EXPECT_THAT(out.residuals, IsEmpty());
    ASSERT_EQ(out.missing.size(), 1U);
    EXPECT_EQ(out.missing[0].mark, "P");
    EXPECT_EQ(out.missing[0].run, "F07");
}

TEST(PositionResiduals, ATiltedLaserDoesNotShiftThePlanPosition) {
    std::vector<GroundPoint> points{point(1.0, {10.2, 19.9, 3.0})};
    points[0].epoch = 0;
    Trajectory trajectory = trajectoryOver(points);
    trajectory.epochs[0].position_enu_m = {10, 20, 4.2};
    const auto out =
        positionResiduals(run("F01"), {stand(StandPlace::Target, mark("P", {10, 20, 3}), 0, 5, false)},
                          trajectory, points, Stage::Fused, true);
    EXPECT_EQ(out.residuals[0].difference_enu_m, Eigen::Vector3d::Zero());
}

// ---------------------------------------------------------------------------------------------- nearest
// sample

Survey surveyWith(std::vector<ControlMark> marks) {
    Survey survey;
    survey.marks = std::move(marks);
    survey.runs = {run("F01"), run("S01")};
    return survey;
}

/// The same by looking at every pair, to hold the sweep against.
std::vector<double> bruteForce(const Survey& survey, const std::vector<GroundPoint>& points, double limit_m) {
    std::vector<double> differences;
    for (const ControlMark& m : survey.marks) {
        const GroundPoint* best = nullptr;
        double best_m = limit_m;
        for (const GroundPoint& p : points) {
            const double d = (p.enu_m - m.enu_m).head<2>().norm();
            if (p.state == GroundPointState::Used && (best == nullptr ? d <= best_m : d < best_m)) {
                best = &p;
                best_m = d;
            }
        }
        if (best != nullptr) differences.push_back(best->enu_m.z() - m.enu_m.z());
    }
    return differences;
}

TEST(NearestSample, AgreesWithLookingAtEveryPair) {
    // A low-discrepancy sequence spreads points and marks without a random generator.
    const auto spread = [](int i, double step) {
        return std::fmod(i * step, 1.0) * 60.0;
    };
    std::vector<ControlMark> marks;
    std::vector<GroundPoint> points;
    for (int i = 1; i <= 80; ++i) {
        marks.push_back(
            mark(fmt::format("K{}", i), {spread(i, 0.7548776662), spread(i, 0.5698402910), 0.1 * i}));
    }
    for (int i = 1; i <= 3000; ++i) {
        points.push_back(point(i, {spread(i, 0.6180339887), spread(i, 0.4142135624), 0.01 * i},
                               i % 7 == 0 ? GroundPointState::Spike : GroundPointState::Used));
    }
    const Survey survey = surveyWith(marks);
    for (const double limit_m : {0.3, 1.0, 3.0}) {
        const auto out =
            nearestSampleResiduals(survey, points, Stage::Fused, {}, {.greatest_distance_m = limit_m});
        std::vector<double> differences;
        for (const Residual& r : out.residuals) differences.push_back(r.difference_enu_m.z());
        EXPECT_EQ(differences, bruteForce(survey, points, limit_m)) << limit_m;
        EXPECT_EQ(out.residuals.size() + out.missing.size(), marks.size());
    }
}

TEST(NearestSample, IsMeasuredInPlan) {
    const auto out =
        nearestSampleResiduals(surveyWith({mark("K", {0, 0, 0})}),
                               {point(1, {1.0, 0, 0.2}), point(2, {0.5, 0, 900.0})}, Stage::Fused, {});
    EXPECT_EQ(out.residuals.at(0).difference_enu_m.z(), 900.0);
    EXPECT_TRUE(std::isnan(out.residuals[0].difference_enu_m.x()));
}

TEST(NearestSample, BeyondTheLimitIsMissing) {
    const Survey survey = surveyWith({mark("near", {0, 0, 0}), mark("far", {3.0001, 0, 0})});
    const auto out = nearestSampleResiduals(survey, {point(1, {0, 0, 0})}, Stage::BeforeFusion, {});
    ASSERT_EQ(out.residuals.size(), 1U);
    ASSERT_EQ(out.missing.size(), 1U);
    EXPECT_EQ(out.missing[0].mark, "far");
    EXPECT_EQ(out.missing[0].stage, Stage::BeforeFusion);
    const Survey edge = surveyWith({mark("at the limit", {3.0, 0, 0})});
    EXPECT_EQ(nearestSampleResiduals(edge, {point(1, {0, 0, 0})}, Stage::Fused, {}).residuals.size(), 1U);
}

TEST(NearestSample, DoesNotDependOnTheOrderOfThePoints) {
    std::vector<GroundPoint> points{point(3, {1, 0, 30}), point(2, {-1, 0, 20}), point(1, {0, 1, 10}),
                                    point(0.5, {0, -1, 5}, GroundPointState::Used, 1)};
    const Survey survey = surveyWith({mark("K", {0, 0, 0})});
    const auto forward = nearestSampleResiduals(survey, points, Stage::Fused, {});
    std::reverse(points.begin(), points.end());
    const auto backward = nearestSampleResiduals(survey, points, Stage::Fused, {});
    EXPECT_EQ(forward.residuals.at(0).difference_enu_m.z(), 10.0);
    EXPECT_EQ(backward.residuals.at(0).difference_enu_m.z(), 10.0);
    EXPECT_EQ(forward.residuals[0].run, "F01");
}

TEST(NearestSample, FlagsMarksToWhichTheEstimatorWasTied) {
    const Survey survey =
        surveyWith({mark("A", {0, 0, 0}, MarkRole::Control), mark("B", {0, 0, 0}, MarkRole::Control)});
    const auto out = nearestSampleResiduals(survey, {point(1, {0, 0, 0})}, Stage::Fused, {"B"});
    EXPECT_FALSE(out.residuals.at(0).used_by_estimator);
    EXPECT_TRUE(out.residuals.at(1).used_by_estimator);
}

TEST(NearestSample, SigmaHoldsTheGroundBetweenPointAndMark) {
    const auto hillside = [](const Eigen::Vector3d& place) -> std::optional<SurfaceHeight> {
        if (place.x() > 100.0) return std::nullopt;
        return SurfaceHeight{7.0 - 0.5 * place.x(), 0.1, 0.5};
    };
    const ControlMark on_slope = mark("K", {2.0, 0, 0});
    const std::vector<GroundPoint> points{point(1, {1.0, 0, 0.5})};
    const auto sigma = [&](const ControlMark& m, const SurfaceHeightAt& surface_height) {
        const auto out =
            nearestSampleResiduals(surveyWith({m}), points, Stage::Fused, {}, {}, surface_height);
        return out.residuals.at(0).sigma_enu_m.z();
    };
    const double plan_m = std::sqrt(0.5 * (0.4 * 0.4 + 0.5 * 0.5));
    const double expected_m =
        std::sqrt(0.3 * 0.3 + std::pow(0.5 * plan_m, 2) + 0.5 * 0.5 + std::pow(on_slope.sigma_v_m, 2));
    EXPECT_NEAR(sigma(on_slope, hillside), expected_m, 1e-12);
    EXPECT_TRUE(std::isnan(sigma(on_slope, {}))) << "nothing is known of the ground between";
    const auto nowhere = [](const Eigen::Vector3d&) {
        return std::optional<SurfaceHeight>();
    };
    EXPECT_TRUE(std::isnan(sigma(on_slope, nowhere)));
}

TEST(NearestSample, OfNothingIsNothing) {
    EXPECT_THAT(nearestSampleResiduals(surveyWith({}), {point(1, {0, 0, 0})}, Stage::Fused, {}).residuals,
                IsEmpty());
    EXPECT_EQ(nearestSampleResiduals(surveyWith({mark("K", {0, 0, 0})}), {}, Stage::Fused, {}).missing.size(),
              1U);
}

// ---------------------------------------------------------------------------------------------- surface

TEST(SurfaceResiduals, AreExactOnAPlaneAndNameMarksOutside) {
    const auto plane = [](const Eigen::Vector3d& place) -> std::optional<SurfaceHeight> {
        if (place.x() > 100.0) return std::nullopt;
        return SurfaceHeight{0.5 * place.x() - 0.25 * place.y() + 1.0, place.z() == 1.0 ? kMissing : 0.3};
    };
    const auto out =
        surfaceResiduals({mark("on", {4, 8, 1.0}), mark("below", {4, 8, 0.5}), mark("outside", {200, 0, 0})},
                         plane, Stage::Surface, {"below"});
    ASSERT_EQ(out.residuals.size(), 2U);
    EXPECT_EQ(out.residuals[0].difference_enu_m.z(), 0.0);
    EXPECT_EQ(out.residuals[1].difference_enu_m.z(), 0.5);
    EXPECT_FALSE(out.residuals[0].used_by_estimator);
    EXPECT_TRUE(out.residuals[1].used_by_estimator);
    EXPECT_TRUE(std::isnan(out.residuals[0].sigma_enu_m.z()));
    EXPECT_DOUBLE_EQ(out.residuals[1].sigma_enu_m.z(),
                     std::hypot(0.3, mark("", Eigen::Vector3d::Zero()).sigma_v_m));
    ASSERT_EQ(out.missing.size(), 1U);
    EXPECT_EQ(out.missing[0].mark, "outside");
}

TEST(TiedMarks, AreThoseThatTheStandsAllow) {
    Survey survey =
        surveyWith({mark("C", {0, 0, 0}, MarkRole::Control), mark("T", {1, 0, 0}, MarkRole::Control),
                    mark("K", {2, 0, 0}, MarkRole::Check)});
    survey.runs[0].kind = RunKind::FixedPoint;
    survey.runs[0].start = "C";
    survey.runs[0].target = "T";
    survey.runs[0].log.time_s = {0.0, 50.0};
    survey.runs[1].stops = {{"K", 1.0, 2.0}};
    survey.runs[1].log.time_s = {0.0, 50.0};
    EXPECT_THAT(tiedMarks(survey, {}), ElementsAre("C", "T"));
    EXPECT_THAT(tiedMarks(survey, {.tie_fixed_targets = false}), ElementsAre("C"));
}

}  // namespace
}  // namespace terrawalk
