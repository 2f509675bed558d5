#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/pipeline/process.hpp"
#include "tests/support/small_survey.hpp"

namespace terrawalk {
namespace {

using testing::Contains;
using testing::HasSubstr;

class Edits : public testing::Test {
  protected:
    static Products made(const SurveyEdits& edits) {
        static const Survey survey = simulatedSurvey(smallField()).survey;
        PipelineConfig config;
        config.surface.cross_validate = false;
        config.edits = edits;
        auto edited = withEdits(survey, edits);
        if (!edited) throw std::runtime_error(edited.error().text());
        SilentProgress silent;
        auto products = process(*edited, config, silent, {});
        if (!products) throw std::runtime_error(products.error().text());
        return std::move(*products);
    }
    static std::size_t usedBetween(const Products& products, std::uint32_t run, double from_s, double to_s) {
        return static_cast<std::size_t>(std::count_if(
            products.ground_points.begin(), products.ground_points.end(), [&](const GroundPoint& p) {
                return p.run == run && p.time_s >= from_s && p.time_s <= to_s &&
                       p.state != GroundPointState::NoRange;
            }));
    }
};

TEST_F(Edits, StretchLeavesNoGroundPointsAndTheReportSaysSo) {
    const Products before = made({});
    const auto& last = before.trajectories.back();
    const double from_s = last.epochs[300].time_s, to_s = last.epochs[400].time_s;
    const auto run = static_cast<std::uint32_t>(before.trajectories.size() - 1);
    ASSERT_GT(usedBetween(before, run, from_s, to_s), 50u);
    for (const EditedSensor sensor : {EditedSensor::Range, EditedSensor::All}) {
        const Products after = made({.stretches = {{last.run_id, from_s, to_s, sensor}}});
        EXPECT_EQ(usedBetween(after, run, from_s, to_s), 0u);
        EXPECT_EQ(after.trajectories.back().epochs.size(), last.epochs.size());
        EXPECT_THAT(after.report.warnings, Contains(HasSubstr("Left out by hand")));
    }
}

// Twenty seconds without any reading: the track there is unsure, and honestly so.
TEST_F(Edits, TrackOfAnExcludedStretchIsLessSure) {
    const Products before = made({});
    const auto& last = before.trajectories.back();
    const Products after =
        made({.stretches = {{last.run_id, last.epochs[300].time_s, last.epochs[400].time_s}}});
    EXPECT_GT(after.trajectories.back().epochs[350].covariance(0, 0),
              1.5 * last.epochs[350].covariance(0, 0));
}

TEST_F(Edits, MarkCountsNeitherAsControlNorAsCheck) {
    const Products before = made({});
    const std::string mark = before.report.marks.front().name;
    const Products after = made({.marks = {mark}});
    for (const Residual& residual : after.report.residuals) EXPECT_NE(residual.mark, mark);
    EXPECT_EQ(after.report.marks.size() + 1, before.report.marks.size());
}

TEST_F(Edits, DrawnLineIsKeptByTheSurface) {
    const Products before = made({});
    const GridGeometry& g = before.dem.geometry;
    const double x = g.centreX(g.columns / 2), y = g.centreY(g.rows / 2);
    const Breakline hole{{{x - 2, y - 2, kMissing},
                          {x + 2, y - 2, kMissing},
                          {x + 2, y + 2, kMissing},
                          {x - 2, y + 2, kMissing}},
                         BreaklineKind::Hole,
                         {}};
    const Products after = made({.lines = {hole}});
    EXPECT_FALSE(std::isnan(before.dem.heights_m[*g.cellAt(x, y)]));
    EXPECT_TRUE(std::isnan(after.dem.heights_m[*after.dem.geometry.cellAt(x, y)]));
    EXPECT_EQ(after.report.surface.breaklines, 1u);
}

}  // namespace
}  // namespace terrawalk
