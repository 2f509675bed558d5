#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/pipeline/process.hpp"
#include "fusion/simulation.hpp"
#include "tests/support/small_survey.hpp"

namespace terrawalk {
namespace {

using testing::Contains;
using testing::HasSubstr;

struct Damage {
    std::string name;
    std::function<void(Survey&)> inflict;
    std::vector<std::string> said;  ///< what the limitations must hold
};

void PrintTo(const Damage& damage, std::ostream* out) {
    *out << damage.name;
}

using Channels = std::vector<Channel>;

const Channels kGnss{Channel::Latitude, Channel::Longitude, Channel::EllipsoidalHeight, Channel::Fix};
const Channels kFlow{Channel::FlowForward, Channel::FlowLeft, Channel::FlowQuality};
const Channels kAttitude{Channel::Roll,         Channel::Pitch,        Channel::Heading,
                         Channel::AngularRateX, Channel::AngularRateY, Channel::AngularRateZ};

void erase(Survey& survey, const Channels& channels) {
    for (terrawalk::Run& run : survey.runs) {
        for (const Channel channel : channels) run.log.column(channel).clear();
    }
}

void oneRun(Survey& survey) {
    survey.runs.erase(survey.runs.begin(), survey.runs.end() - 1);
}

void noMarks(Survey& survey) {
    survey.marks.clear();
    survey.control_file.clear();
    oneRun(survey);  // the others lead to marks
    survey.runs.front().start.reset();
    survey.runs.front().target.reset();
    survey.runs.front().stops.clear();
}

// Half an hour passes between two records of the area walk.
void gap(Survey& survey) {
    std::vector<double>& time_s = survey.runs.back().log.time_s;
    for (std::size_t i = time_s.size() / 2; i < time_s.size(); ++i) time_s[i] += 1800.0;
    for (Stop& stop : survey.runs.back().stops) {
        if (stop.from_s < time_s[time_s.size() / 2 - 1]) continue;
        stop.from_s += 1800.0;
        stop.to_s += 1800.0;
    }
}

std::vector<Damage> damages() {
    return {
        {"OneRun", oneRun, {}},
        {"NoMarks", noMarks, {"no marks measured by total station"}},
        {"NoFlow", [](Survey& s) { erase(s, kFlow); }, {"optical flow"}},
        {"NoBarometer", [](Survey& s) { erase(s, {Channel::Pressure}); }, {"No barometer"}},
        {"NoAttitude",
         [](Survey& s) { erase(s, kAttitude); },
         {"No roll", "No pitch", "No heading", "optical flow"}},
        {"NoGnss", [](Survey& s) { erase(s, kGnss); }, {"No GNSS position"}},
        {"GapOfHalfAnHour", gap, {"no records for 1800"}},
        {"NoFlowNoBarometer",
         [](Survey& s) {
             erase(s, kFlow);
             erase(s, {Channel::Pressure});
         },
         {"optical flow", "No barometer"}},
        {"GnssAndRangeAlone",
         [](Survey& s) {
             noMarks(s);
             erase(s, kFlow);
             erase(s, kAttitude);
             erase(s, {Channel::Pressure, Channel::AccelerationX, Channel::AccelerationY,
                       Channel::AccelerationZ});
             gap(s);
         },
         {"no marks measured by total station", "optical flow", "No barometer", "No heading",
          "No accelerometer", "no records for 1800"}},
    };
}

void expectFinite(const Products& products, const Survey& survey) {
    ASSERT_EQ(products.trajectories.size(), survey.runs.size());
    for (std::size_t r = 0; r < survey.runs.size(); ++r) {
        ASSERT_EQ(products.trajectories[r].epochs.size(), survey.runs[r].log.size());
        for (const TrajectoryEpoch& epoch : products.trajectories[r].epochs) {
            ASSERT_TRUE(epoch.position_enu_m.allFinite());
            ASSERT_TRUE(epoch.velocity_enu_mps.allFinite());
            ASSERT_TRUE(epoch.covariance.allFinite());
            ASSERT_GT(epoch.covariance.diagonal().head<3>().minCoeff(), 0.0);
            ASSERT_TRUE(std::isfinite(epoch.attitude.yaw_rad));
            ASSERT_TRUE(std::isfinite(epoch.sigma_heading_rad));
        }
    }
}

class MissingSensors : public testing::TestWithParam<Damage> {};

// By the default method. The walk is 15 m wide: a track 60 m from the truth would be drawn, not measured.
TEST_P(MissingSensors, GiveAFiniteTrackAndAReportThatSaysSo) {
    SimulatedSurvey made = simulatedSurvey(smallField());
    GetParam().inflict(made.survey);
    SilentProgress silent;
    const auto products = process(made.survey, {}, silent, {});
    ASSERT_TRUE(products) << products.error().text();
    expectFinite(*products, made.survey);
    for (const std::string& text : GetParam().said) {
        EXPECT_THAT(products->report.limitations, Contains(HasSubstr(text)));
    }
    const auto with_height = std::count_if(products->dem.heights_m.begin(), products->dem.heights_m.end(),
                                           [](float height_m) { return std::isfinite(height_m); });
    EXPECT_GT(with_height, 1000);
    double worst_m = 0.0;
    const Trajectory& truth = made.truth.back();
    const Trajectory& track = products->trajectories.back();
    for (std::size_t i = 0; i < track.epochs.size(); ++i) {
        worst_m = std::max(worst_m, (track.epochs[i].position_enu_m - truth.epochs[i].position_enu_m).norm());
    }
    EXPECT_LT(worst_m, 60.0);
}

INSTANTIATE_TEST_SUITE_P(Each, MissingSensors, testing::ValuesIn(damages()),
                         [](const auto& tested) { return tested.param.name; });

SimulatedSurvey longWalk() {
    SimulationOptions options;
    options.seed = 12;
    options.area_east_m = 20;
    options.area_north_m = 20;
    options.fixed_point_runs = 0;
    options.sample_interval_s = 0.5;
    options.area_epochs = 4800;  // 40 minutes
    options.control_stops = 0;
    options.check_points = 12;
    SilentProgress silent;
    auto made = simulateSurvey(options, silent, {});
    if (!made) throw std::runtime_error(made.error().text());
    return std::move(*made);
}

void silence(Survey& survey, const Channels& channels) {
    ArrayLog& log = survey.runs.back().log;
    for (const Channel channel : channels) {
        std::vector<double>& column = log.column(channel);
        if (column.empty()) continue;
        std::fill(column.begin() + 600, column.begin() + 4200, kMissing);
    }
}

TEST(Silence, OfGnssForHalfAnHourIsBridgedByTheFlowAndSaid) {
    SimulatedSurvey made = longWalk();
    silence(made.survey, kGnss);
    SilentProgress silent;
    const auto products = process(made.survey, {}, silent, {});
    ASSERT_TRUE(products) << products.error().text();
    expectFinite(*products, made.survey);
    EXPECT_THAT(products->report.limitations, Contains(HasSubstr("o GNSS position for 1802 s")));
    const auto& epochs = products->trajectories.back().epochs;
    double worst_m = 0.0;
    double squared_over_variance = 0.0;
    for (std::size_t i = 0; i < epochs.size(); ++i) {
        const Eigen::Vector2d error_m =
            (epochs[i].position_enu_m - made.truth.back().epochs[i].position_enu_m).head<2>();
        worst_m = std::max(worst_m, error_m.norm());
        squared_over_variance += 0.5 *
                                 (std::pow(error_m.x(), 2) / epochs[i].covariance(0, 0) +
                                  std::pow(error_m.y(), 2) / epochs[i].covariance(1, 1)) /
                                 static_cast<double>(epochs.size());
    }
    // 1.2 km of walk; 1 % of it.
    EXPECT_LT(worst_m, 12.0);
    // The track owns up to what it does not know: 1 were perfect; one outage holds few independent errors.
    EXPECT_LT(squared_over_variance, 10.0);
}

TEST(Silence, OfAllThatTellsAPositionIsNamedAndNothingIsDrawn) {
    SimulatedSurvey made = longWalk();
    silence(made.survey, kGnss);
    silence(made.survey, kFlow);
    SilentProgress silent;
    const auto products = process(made.survey, {}, silent, {});
    ASSERT_FALSE(products);
    EXPECT_EQ(products.error().kind, ErrorKind::BadData);
    EXPECT_THAT(products.error().text(), HasSubstr("S01"));
    EXPECT_THAT(products.error().text(), HasSubstr("the filter diverged at"));
}

}  // namespace
}  // namespace terrawalk
