#include "app/pipeline/compare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "app/pipeline/jobs.hpp"
#include "fusion/fuse_survey.hpp"
#include "io/read_trajectory.hpp"
#include "io/write_products.hpp"
#include "tests/support/small_survey.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::vector<std::optional<Trajectory>> asTruth(const SimulatedSurvey& simulated) {
    return {simulated.truth.begin(), simulated.truth.end()};
}

const MethodOutcome& outcomeOf(const MethodComparison& comparison, const std::string& name) {
    const auto found = std::find_if(comparison.outcomes.begin(), comparison.outcomes.end(),
                                    [&](const MethodOutcome& o) { return o.name == name; });
    if (found == comparison.outcomes.end()) throw std::runtime_error("no method " + name);
    return *found;
}

MethodComparison compared(const SimulatedSurvey& simulated,
                          const std::vector<std::optional<Trajectory>>& truth) {
    SilentProgress silent;
    auto comparison = compareMethods(simulated.survey, truth, {}, silent, {});
    if (!comparison) throw std::runtime_error(comparison.error().text());
    return std::move(*comparison);
}

TEST(Compare, HasEveryMethodAndEveryFilterOnce) {
    FusionOptions options;
    options.gnss.sigma_single_m = 3.25;
    std::set<std::string> names;
    for (const ComparedMethod& method : comparedMethods(options)) {
        EXPECT_TRUE(names.insert(method.name).second) << method.name;
        EXPECT_EQ(method.fusion.gnss.sigma_single_m, 3.25);
    }
    EXPECT_EQ(names.size(), kFusionMethodNames.size() - 1 + kFilterNames.size());
    EXPECT_TRUE(names.contains("raw"));
    EXPECT_TRUE(names.contains("aukf square-root-ukf"));
}

TEST(Compare, MeasuresTheArrayAgainstTheTruth) {
    const SimulatedSurvey simulated = simulatedSurvey(smallField());
    const MethodComparison comparison = compared(simulated, asTruth(simulated));
    EXPECT_TRUE(comparison.has_truth);
    for (const ComparedMethod& method : comparedMethods({})) {
        SilentProgress silent;
        const auto fused = fuseSurvey(simulated.survey, method.fusion, silent, {});
        ASSERT_TRUE(fused);
        double sum = 0.0;
        double n = 0.0;
        for (std::size_t r = 0; r < simulated.survey.runs.size(); ++r) {
            if (simulated.survey.runs[r].kind != RunKind::Area) continue;
            const auto& epochs = fused->runs[r].trajectory.epochs;
            for (std::size_t i = 0; i < epochs.size(); ++i) {
                sum += (epochs[i].position_enu_m - simulated.truth[r].epochs[i].position_enu_m)
                           .head<2>()
                           .squaredNorm();
                n += 1.0;
            }
        }
        const MethodOutcome& outcome = outcomeOf(comparison, method.name);
        EXPECT_EQ(outcome.failure, "");
        EXPECT_NEAR(outcome.area_horizontal.error_m, std::sqrt(sum / n), 1e-9) << method.name;
        EXPECT_EQ(outcome.area_horizontal.n, 1200U);
        EXPECT_EQ(outcome.fixed_vertical.n, 240U);
        EXPECT_EQ(outcome.target_horizontal.n, 2U);
        EXPECT_GT(outcome.nees.error_m, 0.0);
        EXPECT_EQ(outcome.consistency.empty(), method.fusion.method != FusionMethod::Aukf);
        // All were compared at the same marks.
        EXPECT_EQ(outcome.check_surface.n, comparison.outcomes.front().check_surface.n);
        EXPECT_GE(outcome.check_surface.n, 4U);
    }
}

// A method that is tied to a mark shows nothing there; one that is not shows its error.
TEST(Compare, CountsNoMarkThatTheMethodWasTiedTo) {
    const SimulatedSurvey simulated = simulatedSurvey(smallField());
    const MethodComparison comparison = compared(simulated, asTruth(simulated));
    EXPECT_EQ(outcomeOf(comparison, "ukf").stop_horizontal.n, 0U);
    EXPECT_GT(outcomeOf(comparison, "raw").stop_horizontal.n, 0U);
    EXPECT_GT(outcomeOf(comparison, "aukf ukf").stop_horizontal.n, 0U);
}

TEST(Compare, DoesWithoutTruth) {
    const SimulatedSurvey simulated = simulatedSurvey(smallField());
    const MethodComparison comparison =
        compared(simulated, std::vector<std::optional<Trajectory>>(simulated.survey.runs.size()));
    EXPECT_FALSE(comparison.has_truth);
    EXPECT_EQ(comparison.outcomes.front().area_horizontal.n, 0U);
    EXPECT_EQ(comparison.outcomes.front().nees.n, 0U);
    EXPECT_THAT(toText(comparison), HasSubstr("no truth"));
}

TEST(Compare, WritesTheSameTableAsTextCsvAndJson) {
    const test::TemporaryFolder scratch;
    SilentProgress silent;
    SimulationOptions options;
    options.area_east_m = 15;
    options.area_north_m = 15;
    options.line_spacing_m = 2;
    options.fixed_point_runs = 2;
    options.fixed_point_epochs = 120;
    options.area_epochs = 1200;
    options.control_stops = 2;
    options.check_points = 12;
    ASSERT_TRUE(simulateSurveyFolder(options, scratch / "survey", silent, {}));
    const auto comparison =
        compareSurvey(scratch / "survey", {}, {{"terrawalk", "compare"}}, scratch / "out", silent, {});
    ASSERT_TRUE(comparison) << comparison.error().text();
    EXPECT_TRUE(comparison->has_truth);
    EXPECT_EQ(test::bytesOf(scratch / "out/comparison.txt"), toText(*comparison));
    const std::string csv = test::bytesOf(scratch / "out/comparison.csv");
    EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
              1 + comparison->outcomes.size());
    const json document = json::parse(toJson(*comparison, scratch / "out"));
    ASSERT_EQ(document.at("methods").size(), comparison->outcomes.size());
    EXPECT_EQ(document.at("methods")[0].at("method"), "raw");
    EXPECT_EQ(document.at("methods")[1].at("area H [m]"), comparison->outcomes[1].area_horizontal.error_m);
    EXPECT_EQ(document.at("methods")[0].at("n fixed V"), 240.0);
    EXPECT_TRUE(json::parse(test::bytesOf(scratch / "out/manifest.json")).contains("configuration"));

    // What was read back is the truth of the simulator to the tenth of a millimetre that its files hold.
    const auto survey = openSurvey(scratch / "survey", silent, {});
    ASSERT_TRUE(survey);
    const auto truth = readTruth(*survey);
    ASSERT_TRUE(truth);
    const auto simulated = simulateSurvey(options, silent, {});
    ASSERT_TRUE(simulated);
    for (std::size_t r = 0; r < simulated->truth.size(); ++r) {
        ASSERT_TRUE((*truth)[r]);
        ASSERT_EQ((*truth)[r]->epochs.size(), simulated->truth[r].epochs.size());
        const TrajectoryEpoch& read = (*truth)[r]->epochs.back();
        const TrajectoryEpoch& made = simulated->truth[r].epochs.back();
        EXPECT_LT((read.position_enu_m - made.position_enu_m).lpNorm<Eigen::Infinity>(), 0.51e-4);
        EXPECT_LT(std::abs(wrapAngle(read.attitude.yaw_rad - made.attitude.yaw_rad)), radians(0.51e-4));
    }

    test::writeBytes(scratch / "survey/truth/F01.csv", "time_s,e_m\n0,1\n");
    const auto broken = compareSurvey(scratch / "survey", {}, {}, {}, silent, {});
    ASSERT_FALSE(broken);
    EXPECT_THAT(broken.error().text(), HasSubstr("F01.csv:1: no column n_m"));
}

// One method that cannot cope ends none of the others.
TEST(Compare, TellsWhyAMethodFails) {
    SimulatedSurvey simulated = simulatedSurvey(smallField());
    PipelineConfig config;
    config.fusion.divergence.largest_sigma_m = 1e-6;  // the smoothed filter gives up at once
    SilentProgress silent;
    const auto comparison = compareMethods(simulated.survey, asTruth(simulated), config, silent, {});
    ASSERT_TRUE(comparison) << comparison.error().text();
    EXPECT_THAT(outcomeOf(*comparison, "ukf").failure, HasSubstr("diverged"));
    EXPECT_EQ(outcomeOf(*comparison, "aukf ukf").failure, "");
    EXPECT_GT(outcomeOf(*comparison, "aukf ukf").check_surface.n, 0U);
    EXPECT_THAT(toText(*comparison), HasSubstr("ukf: "));
}

TEST(Compare, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    SilentProgress silent;
    const SimulatedSurvey simulated = simulatedSurvey(smallField());
    const auto comparison =
        compareMethods(simulated.survey, asTruth(simulated), {}, silent, source.get_token());
    ASSERT_FALSE(comparison);
    EXPECT_EQ(comparison.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace terrawalk
