#include "app/pipeline/accuracy_measure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace terrawalk {
namespace {

SimulationOptions smallSurvey(double noise_scale) {
    SimulationOptions options = accuracySimulation(3, FaultLevel::None, GnssMode::Single, true);
    options.noise_scale = noise_scale;
    options.area_east_m = 15.0;
    options.area_north_m = 15.0;
    options.area_epochs = 1000;
    options.fixed_point_runs = 4;
    options.control_stops = 1;
    options.check_points = 0;
    return options;
}

SimulatedSurvey simulated(const SimulationOptions& options) {
    SilentProgress silent;
    auto survey = simulateSurvey(options, silent, {});
    EXPECT_TRUE(survey) << survey.error().text();
    return std::move(*survey);
}

AccuracyMeasures measured(const SimulatedSurvey& survey, const PipelineConfig& config = {}) {
    SilentProgress silent;
    const auto measures = measureAccuracy(survey, config, 3, silent, {});
    EXPECT_TRUE(measures) << measures.error().text();
    return *measures;
}

TEST(AccuracyMeasure, ExactSensorsReachTheFloor) {
    const AccuracyMeasures m = measured(simulated(smallSurvey(0.0)));
    // What remains is the filter's lag behind steps and turns, well below its own noise of 0.06 m and more.
    EXPECT_LT(m.mean_horizontal_error_m, 0.1);
    EXPECT_LT(m.mean_height_error_m, 0.05);
    // A sample moved by those errors is off by its height error and by the slope, here mostly below a half,
    // times its plan error.
    EXPECT_NEAR(m.check_point_error_m, m.check_point_floor_m, 0.1);
    EXPECT_NEAR(m.surface_error_m, m.surface_floor_m, 0.1);
    EXPECT_EQ(m.check_point_ratio, m.check_point_error_m / m.check_point_floor_m);
    EXPECT_LT(m.rms_end_horizontal_m, 0.1);
    EXPECT_EQ(m.check_points, 500U);
    EXPECT_GT(m.surface_check_points, 400U);
    EXPECT_EQ(m.fixed_point_runs, 4U);
    // Noise is learnt from the residuals, so sigmas shrink with it, but a normal error may pass 1.96 of them.
    EXPECT_GT(m.height_coverage, 0.95);
}

TEST(AccuracyMeasure, FindsAKnownError) {
    SimulatedSurvey survey = simulated(smallSurvey(0.0));
    const AccuracyMeasures without = measured(survey);
    for (Trajectory& truth : survey.truth) {
        for (TrajectoryEpoch& epoch : truth.epochs) epoch.position_enu_m += Eigen::Vector3d(0.6, -0.8, 0.25);
    }
    const AccuracyMeasures with = measured(survey);
    // The triangle inequality bounds what the errors without the shift can change.
    EXPECT_NEAR(with.mean_horizontal_error_m, 1.0, without.mean_horizontal_error_m);
    EXPECT_NEAR(with.rms_horizontal_error_m, 1.0, without.rms_horizontal_error_m);
    EXPECT_NEAR(with.mean_height_error_m, 0.25, without.mean_height_error_m);
    EXPECT_NEAR(with.height_bias_m, without.height_bias_m - 0.25, 1e-9);
    EXPECT_NEAR(with.rms_end_horizontal_m, 1.0, without.rms_end_horizontal_m);
    EXPECT_NEAR(with.rms_end_height_m, 0.25, without.rms_end_height_m);
    // The estimate and the terrain stay, so only the floor moves, if for nothing but other check points.
    EXPECT_GT(with.check_point_floor_m, without.check_point_floor_m + 0.1);
    EXPECT_GT(with.normalized_height_error, without.normalized_height_error);
}

TEST(AccuracyMeasure, FloorsDoNotDependOnTheMethod) {
    const SimulatedSurvey survey = simulated(smallSurvey(1.0));
    PipelineConfig raw;
    raw.fusion.method = FusionMethod::Raw;
    const AccuracyMeasures sensors = measured(survey, raw);
    const AccuracyMeasures fused = measured(survey);
    EXPECT_EQ(sensors.check_point_floor_m, fused.check_point_floor_m);
    EXPECT_NE(sensors.check_point_error_m, fused.check_point_error_m);
}

TEST(AccuracyMeasure, TheSameEachTime) {
    const SimulatedSurvey survey = simulated(smallSurvey(1.0));
    const AccuracyMeasures first = measured(survey);
    const AccuracyMeasures second = measured(survey);
    EXPECT_EQ(first.check_point_error_m, second.check_point_error_m);
    EXPECT_EQ(first.surface_error_m, second.surface_error_m);
    EXPECT_EQ(first.normalized_horizontal_error, second.normalized_horizontal_error);
}

TEST(AccuracyMeasure, WithoutTiesTheRunKnowsItsStartOnly) {
    SimulationOptions options = smallSurvey(1.0);
    options.control_stops = 0;
    options.end_on_zero = false;
    const SimulationOptions asked = accuracySimulation(3, FaultLevel::None, GnssMode::Single, false);
    EXPECT_EQ(asked.control_stops, options.control_stops);
    EXPECT_EQ(asked.end_on_zero, options.end_on_zero);
    const SimulatedSurvey survey = simulated(options);
    const auto& area = survey.survey.runs.back();
    EXPECT_EQ(area.start, "ZERO");
    EXPECT_FALSE(area.target);
    EXPECT_TRUE(area.stops.empty());
}

TEST(AccuracyMeasure, RefusesASurveyWithoutAreaWalk) {
    SimulationOptions options = smallSurvey(1.0);
    options.area_epochs = 0;
    options.control_stops = 0;
    SilentProgress silent;
    const auto measures = measureAccuracy(simulated(options), {}, 3, silent, {});
    ASSERT_FALSE(measures);
    EXPECT_EQ(measures.error().kind, ErrorKind::Usage);
}

TEST(AccuracyMeasure, StopsWhenAsked) {
    const SimulatedSurvey survey = simulated(smallSurvey(1.0));
    std::stop_source stop;
    stop.request_stop();
    SilentProgress silent;
    const auto measures = measureAccuracy(survey, {}, 3, silent, stop.get_token());
    ASSERT_FALSE(measures);
    EXPECT_EQ(measures.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace terrawalk
