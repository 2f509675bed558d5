#include "app/pipeline/outage_measure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/pipeline/accuracy_measure.hpp"
#include "app/pipeline/jobs.hpp"
#include "mapping/order_statistics.hpp"

namespace terrawalk {
namespace {

struct Walked {
    Survey survey;
    std::vector<Trajectory> truth;
};

/// Two minutes over a small field, with Doppler velocities.
Walked walked(double noise_scale) {
    SimulationOptions options = accuracySimulation(5, FaultLevel::None, GnssMode::Single, false);
    options.noise_scale = noise_scale;
    options.doppler_velocity = true;
    options.area_east_m = 15.0;
    options.area_north_m = 15.0;
    options.area_epochs = 700;
    options.fixed_point_runs = 0;
    options.check_points = 0;
    SilentProgress silent;
    auto simulated = simulateSurvey(options, silent, {});
    EXPECT_TRUE(simulated) << simulated.error().text();
    return {std::move(simulated->survey), std::move(simulated->truth)};
}

/// A single outage of 20 s, from 40 s on.
OutageOptions oneOutage() {
    OutageOptions options;
    options.lengths_s = {20.0};
    options.least_history_s = 40.0;
    options.every_s = 1000.0;
    return options;
}

std::vector<Outage> measured(const Walked& walk, const OutageOptions& options, bool with_truth = true) {
    SilentProgress silent;
    const auto outages =
        measureOutages(walk.survey, {}, options, with_truth ? &walk.truth : nullptr, silent, {});
    EXPECT_TRUE(outages) << outages.error().text();
    return *outages;
}

/// Sets GNSS far off where `when` holds.
void spoilGnss(ArrayLog& log, double from_s, double to_s) {
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (log.time_s[i] <= from_s || log.time_s[i] > to_s) continue;
        log.column(Channel::Latitude)[i] += 1e-4;
        log.column(Channel::GnssVelocityEast)[i] += 3.0;
    }
}

TEST(OutageMeasure, NothingOfGnssIsSeenWithinTheOutage) {
    Walked walk = walked(1.0);
    const Outage before = measured(walk, oneOutage()).front();
    EXPECT_EQ(before.start_s, 40.0);
    spoilGnss(walk.survey.runs[0].log, before.start_s, before.start_s + before.length_s);
    const Outage after = measured(walk, oneOutage()).front();
    EXPECT_EQ(before.error_m, after.error_m);
}

TEST(OutageMeasure, ForwardSeesNothingOfWhatFollows) {
    Walked walk = walked(1.0);
    const Outage before = measured(walk, oneOutage()).front();
    spoilGnss(walk.survey.runs[0].log, before.start_s + before.length_s, 1e9);
    const Outage after = measured(walk, oneOutage()).front();
    EXPECT_EQ(before.error(OutageMethod::Forward), after.error(OutageMethod::Forward));
    EXPECT_NE(after.error(OutageMethod::Smoothed), before.error(OutageMethod::Smoothed));
}

TEST(OutageMeasure, ExactSensorsKeepTheTrack) {
    OutageOptions options;
    options.lengths_s = {10.0, 30.0};
    options.every_s = 10.0;
    const std::vector<Outage> outages = measured(walked(0.0), options);
    EXPECT_GT(outages.size(), 15U);
    for (const Outage& outage : outages) {
        // Exact flow, held over each fifth of a second: behind by at most half a step at each end, and
        // turned as the walk turns in a step; rolling and pitching of the hand move the flow by centimetres.
        EXPECT_LT(outage.error(OutageMethod::IntegratedFlow), 0.5) << outage.start_s;
        EXPECT_LT(outage.error(OutageMethod::Forward), 0.5) << outage.start_s;
        EXPECT_LT(outage.error(OutageMethod::Smoothed), 0.5) << outage.start_s;
    }
    // A walk in lines of 15 m is back where it was when the last velocity has led 20 m away and more.
    EXPECT_GT(quantileOfSorted(outageErrors(outages, 30.0, OutageMethod::ConstantVelocity), 0.5), 10.0);
}

TEST(OutageMeasure, DopplerAgreesWithTheTruthWhereItIsExact) {
    OutageOptions options;
    options.lengths_s = {10.0};
    options.every_s = 10.0;
    const Walked walk = walked(0.0);
    const std::vector<Outage> truth = measured(walk, options, true);
    const std::vector<Outage> doppler = measured(walk, options, false);
    ASSERT_EQ(truth.size(), doppler.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
        // Trapezoids over 0.2 s: the step h^2/12 times the change of the acceleration, here below 2 m/s2, for
        // each fifth of a second, plus the gait between samples.
        EXPECT_NEAR(truth[i].error(OutageMethod::ConstantVelocity),
                    doppler[i].error(OutageMethod::ConstantVelocity), 0.05);
    }
}

TEST(OutageMeasure, LeavesOutStretchesWithoutReference) {
    Walked walk = walked(1.0);
    ArrayLog& log = walk.survey.runs[0].log;
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (log.time_s[i] > 50.0 && log.time_s[i] < 52.0) log.column(Channel::GnssVelocityEast)[i] = kMissing;
    }
    OutageOptions options;
    options.lengths_s = {10.0};
    options.every_s = 2.0;
    options.history_s = options.least_history_s;
    options.following_s = 1.0;
    for (const Outage& outage : measured(walk, options, false)) {
        EXPECT_TRUE(outage.start_s >= 51.9 || outage.start_s + 10.0 <= 50.1) << outage.start_s;
    }
}

TEST(OutageMeasure, RefusesASurveyWithoutDopplerVelocity) {
    Walked walk = walked(1.0);
    walk.survey.runs[0].log.column(Channel::GnssVelocityEast).clear();
    SilentProgress silent;
    const auto outages = measureOutages(walk.survey, {}, {}, nullptr, silent, {});
    ASSERT_FALSE(outages);
    EXPECT_EQ(outages.error().kind, ErrorKind::BadData);
}

TEST(OutageMeasure, StopsWhenAsked) {
    const Walked walk = walked(1.0);
    std::stop_source stop;
    stop.request_stop();
    SilentProgress silent;
    const auto outages = measureOutages(walk.survey, {}, {}, &walk.truth, silent, stop.get_token());
    ASSERT_FALSE(outages);
    EXPECT_EQ(outages.error().kind, ErrorKind::Cancelled);
}

// A real flight whose data are not part of the project.
TEST(OutageMeasure, RealFlightStaysNearTheDopplerTrack) {
    const std::filesystem::path folder = std::filesystem::path(TERRAWALK_SHARED_DATA) / "paddock_flight";
    if (!std::filesystem::exists(folder / "survey.json"))
        GTEST_SKIP() << "no paddock_flight data at " << folder;
    SilentProgress silent;
    const auto survey = openSurvey(folder, silent, {});
    ASSERT_TRUE(survey) << survey.error().text();
    OutageOptions options;
    options.every_s = 150.0;
    const auto outages = measureOutages(*survey, {}, options, nullptr, silent, {});
    ASSERT_TRUE(outages) << outages.error().text();
    for (const double length_s : options.lengths_s) {
        SCOPED_TRACE(length_s);
        const auto median_m = [&](OutageMethod method) {
            return median(outageErrors(*outages, length_s, method));
        };
        // Flight at 2.8 m/s in rounds: the flow must hold the track to a small share of the way, which the
        // last velocity cannot.
        EXPECT_LT(median_m(OutageMethod::Forward), 0.1 * 2.8 * length_s);
        EXPECT_LT(median_m(OutageMethod::Smoothed), 0.1 * 2.8 * length_s);
        EXPECT_GT(median_m(OutageMethod::ConstantVelocity), 5.0 * median_m(OutageMethod::Forward));
    }
}

}  // namespace
}  // namespace terrawalk
