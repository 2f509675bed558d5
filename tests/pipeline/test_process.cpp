#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <fmt/format.h>

#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <mutex>
#include <stdexcept>

#include "app/pipeline/jobs.hpp"
#include "app/pipeline/process.hpp"
#include "tests/support/small_survey.hpp"

namespace terrawalk {
namespace {

Products processed(const Survey& survey, const PipelineConfig& config) {
    SilentProgress silent;
    auto products = process(survey, config, silent, {});
    if (!products) throw std::runtime_error(products.error().text());
    return std::move(*products);
}

// Exact sensors on an exact plane: every cell of the DEM lies on it. What stays is the rounding of float
// heights.
TEST(Process, ARampSurvivesFromTheLogsToTheDem) {
    SimulationOptions options = smallField();
    options.terrain = SimulatedTerrain::Ramp;
    options.faults = FaultLevel::None;
    options.noise_scale = 0;
    options.gnss = GnssMode::Rtk;
    SimulatedSurvey ramp = simulatedSurvey(options);
    ramp.survey.crs.clear();
    // Without a barometer raw heights are those of the GNSS receiver, exact here. Barometric ones would start
    // from the height of the mark, and the tilted range finder sees the slope beside it.
    for (terrawalk::Run& run : ramp.survey.runs) run.log.column(Channel::Pressure).clear();
    PipelineConfig config;
    config.fusion.method = FusionMethod::Raw;
    const Products products = processed(ramp.survey, config);
    const GridGeometry& g = products.dem.geometry;
    std::size_t compared = 0;
    for (std::size_t row = 0; row < g.rows; ++row) {
        for (std::size_t column = 0; column < g.columns; ++column) {
            const float height = products.dem.at(row, column);
            if (std::isnan(height)) continue;
            ++compared;
            const double plane_m = ramp.terrain_height_m(g.centreX(column), g.centreY(row));
            EXPECT_NEAR(height, plane_m, 1e-6 + 1e-7 * std::abs(plane_m));
        }
    }
    EXPECT_GT(compared, 300u);
}

// The same in a projected CRS: each cell is taken back to the local frame by GeographicLib alone, without
// PROJ.
TEST(Process, ARampInUtmLiesWhereAnIndependentProjectionPutsIt) {
    SimulationOptions options = smallField();
    options.terrain = SimulatedTerrain::Ramp;
    options.faults = FaultLevel::None;
    options.noise_scale = 0;
    options.gnss = GnssMode::Rtk;
    SimulatedSurvey ramp = simulatedSurvey(options);
    ASSERT_EQ(ramp.survey.crs, "EPSG:32649");
    for (terrawalk::Run& run : ramp.survey.runs) run.log.column(Channel::Pressure).clear();
    PipelineConfig config;
    config.fusion.method = FusionMethod::Raw;
    const Products products = processed(ramp.survey, config);
    const LocalFrame frame = ramp.survey.frame();
    const GridGeometry& g = products.dem.geometry;
    std::size_t compared = 0;
    for (std::size_t row = 0; row < g.rows; ++row) {
        for (std::size_t column = 0; column < g.columns; ++column) {
            const double height_m = products.dem.at(row, column);
            if (std::isnan(height_m)) continue;
            ++compared;
            GeodeticPosition position;
            GeographicLib::UTMUPS::Reverse(49, true, g.centreX(column), g.centreY(row), position.lat_deg,
                                           position.lon_deg);
            position.h_ell_m = frame.zeroPoint().h_ell_m + height_m;
            const Eigen::Vector3d enu_m = frame.toEnu(position);
            EXPECT_NEAR(height_m, ramp.terrain_height_m(enu_m.x(), enu_m.y()), 1e-4);
        }
    }
    EXPECT_GT(compared, 300u);
}

TEST(Process, CheckMarksNeverTouchTheProducts) {
    SimulationOptions options = smallField();
    options.check_stops = 2;
    SimulatedSurvey s = simulatedSurvey(options);
    const Products before = processed(s.survey, {});
    for (ControlMark& mark : s.survey.marks) {
        if (mark.role == MarkRole::Check) mark.enu_m += Eigen::Vector3d(0.7, -0.4, 5.0);
    }
    const Products after = processed(s.survey, {});
    EXPECT_EQ(before.dem.heights_m.size(), after.dem.heights_m.size());
    EXPECT_EQ(std::memcmp(before.dem.heights_m.data(), after.dem.heights_m.data(),
                          before.dem.heights_m.size() * sizeof(float)),
              0);
    ASSERT_EQ(before.ground_points.size(), after.ground_points.size());
    for (std::size_t i = 0; i < before.ground_points.size(); ++i) {
        ASSERT_EQ(before.ground_points[i].state, after.ground_points[i].state) << i;
        // Bit by bit: points without a range have no sigma, and NaN equals nothing.
        ASSERT_EQ(std::bit_cast<std::uint64_t>(before.ground_points[i].sigma_u_m),
                  std::bit_cast<std::uint64_t>(after.ground_points[i].sigma_u_m))
            << i;
    }
    for (std::size_t run = 0; run < before.trajectories.size(); ++run) {
        for (std::size_t i = 0; i < before.trajectories[run].epochs.size(); ++i) {
            ASSERT_EQ(before.trajectories[run].epochs[i].position_enu_m,
                      after.trajectories[run].epochs[i].position_enu_m);
        }
    }
    EXPECT_NE(before.report.figures.at(0).value, after.report.figures.at(0).value);
}

TEST(Process, OneThreadGivesTheBytesOfMany) {
    const SimulatedSurvey s = simulatedSurvey(smallField());
    const Products many = processed(s.survey, {});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Products single = processed(s.survey, {});
    ASSERT_EQ(many.dem.heights_m.size(), single.dem.heights_m.size());
    EXPECT_EQ(std::memcmp(many.dem.heights_m.data(), single.dem.heights_m.data(),
                          many.dem.heights_m.size() * sizeof(float)),
              0);
}

TEST(Process, FusionBringsTheTrackNearerToTheTruthThanTheSensorsAre) {
    double raw_m2 = 0;
    double fused_m2 = 0;
    for (const std::uint64_t seed : {31, 32, 33}) {
        SimulationOptions options = smallField();
        options.seed = seed;
        const SimulatedSurvey s = simulatedSurvey(options);
        PipelineConfig raw;
        raw.fusion.method = FusionMethod::Raw;
        const auto squaredError = [&](const Products& products) {
            double sum = 0;
            for (std::size_t run = 0; run < s.truth.size(); ++run) {
                for (std::size_t i = 0; i < s.truth[run].epochs.size(); ++i) {
                    sum += (products.trajectories[run].epochs[i].position_enu_m -
                            s.truth[run].epochs[i].position_enu_m)
                               .squaredNorm();
                }
            }
            return sum;
        };
        raw_m2 += squaredError(processed(s.survey, raw));
        fused_m2 += squaredError(processed(s.survey, {}));
    }
    EXPECT_LT(fused_m2, raw_m2);
}

TEST(Process, AStopRequestEndsIt) {
    const SimulatedSurvey s = simulatedSurvey(smallField());
    std::stop_source stop;
    stop.request_stop();
    SilentProgress silent;
    const auto products = process(s.survey, {}, silent, stop.get_token());
    ASSERT_FALSE(products);
    EXPECT_EQ(products.error().kind, ErrorKind::Cancelled);
}

TEST(Process, GridsByTheMethodAskedForAndSaysWhich) {
    const SimulatedSurvey s = simulatedSurvey(smallField());
    PipelineConfig config;
    config.fusion.method = FusionMethod::Raw;
    config.surface.cross_validate = false;
    config.surface.thinning_cell_m = 1.5;  // few points, for speed
    const Products plain = processed(s.survey, config);
    EXPECT_EQ(plain.report.surface.method_used, "linear");
    // One of each kind; the pipeline knows them by their common interface.
    for (const InterpolationMethod method :
         {InterpolationMethod::NaturalNeighbour, InterpolationMethod::CloughTocher,
          InterpolationMethod::Kriging}) {
        const std::string text(name(method));
        ASSERT_TRUE(applySetting(config, fmt::format("surface.method=\"{}\"", text)));
        const Products products = processed(s.survey, config);
        EXPECT_EQ(products.report.surface.method_requested, text);
        EXPECT_EQ(products.report.surface.method_used, text);
        EXPECT_EQ(products.used.surface.method, method);
        ASSERT_EQ(products.dem.heights_m.size(), plain.dem.heights_m.size());
        EXPECT_NE(products.dem.heights_m, plain.dem.heights_m) << text;
        double off_m = 0.0;
        std::size_t cells = 0;
        for (std::size_t i = 0; i < plain.dem.heights_m.size(); ++i) {
            if (std::isnan(plain.dem.heights_m[i]) || std::isnan(products.dem.heights_m[i])) continue;
            off_m += std::abs(plain.dem.heights_m[i] - products.dem.heights_m[i]);
            ++cells;
        }
        ASSERT_GT(cells, 100u);
        EXPECT_LT(off_m / static_cast<double>(cells), 0.5) << text << ": it is the same ground";
        const bool own_variance = method == InterpolationMethod::Kriging;
        ASSERT_TRUE(products.report.surface.uncertainty);
        EXPECT_EQ(products.report.surface.uncertainty->own_variance, own_variance) << text;
        const auto told = testing::HasSubstr("variance of the method: noise times");
        EXPECT_THAT(products.report.surface.notes, testing::Contains(told).Times(own_variance ? 1 : 0))
            << text;
        EXPECT_GT(products.report.surface.uncertainty->at_point_m, 0.0) << text;
        EXPECT_EQ(products.report.surface.variogram.has_value(), own_variance) << text;
    }
    config.surface.method.reset();
    const Products best = processed(s.survey, config);
    ASSERT_TRUE(best.report.surface.comparison);
    EXPECT_EQ(best.report.surface.method_requested, "auto");
    EXPECT_EQ(best.report.surface.method_used, best.report.surface.comparison->ranking.front());
}

TEST(Process, KeepsToTheSurveysBreaklines) {
    SimulatedSurvey s = simulatedSurvey(smallField());
    s.survey.crs.clear();
    PipelineConfig config;
    config.fusion.method = FusionMethod::Raw;
    const Products plain = processed(s.survey, config);
    const GridGeometry& g = plain.dem.geometry;
    const double east_m = g.west_m + 0.5 * static_cast<double>(g.columns) * g.cell_m;
    const double north_m = g.north_m - 0.5 * static_cast<double>(g.rows) * g.cell_m;
    const double wall_m = plain.report.surface.highest_m + 5.0;
    s.survey.breaklines = {
        {{{east_m - 2.0, north_m, wall_m}, {east_m + 2.0, north_m, wall_m}}, BreaklineKind::Hard, "wall"}};
    const Products walled = processed(s.survey, config);
    EXPECT_EQ(walled.report.surface.breaklines, 1u);
    EXPECT_NEAR(walled.report.surface.highest_m, wall_m, 2.5) << "cells beside the line are lower";
    EXPECT_GT(walled.report.surface.highest_m, plain.report.surface.highest_m + 1.0);
    config.surface.method = InterpolationMethod::Kriging;
    SilentProgress silent;
    EXPECT_EQ(process(s.survey, config, silent, {}).error().kind, ErrorKind::Usage);
    config.surface.method = InterpolationMethod::Linear;
    s.survey.breakline_crs = "EPSG:32650";
    EXPECT_EQ(process(s.survey, config, silent, {}).error().kind, ErrorKind::BadData);
}

TEST(Process, CleansTheGroundPointsWhenAsked) {
    const SimulatedSurvey s = simulatedSurvey(smallField());
    PipelineConfig config;
    config.fusion.method = FusionMethod::Raw;
    const auto isolated = [](const Products& products) {
        return std::count_if(
            products.ground_points.begin(), products.ground_points.end(),
            [](const GroundPoint& point) { return point.state == GroundPointState::Isolated; });
    };
    EXPECT_EQ(isolated(processed(s.survey, config)), 0);
    ASSERT_TRUE(applySetting(config, "surface.clean.radius.use=true"));
    EXPECT_GT(processed(s.survey, config).used.surface.cleaning.radius.radius_m, 0.0) << "by the spacing";
    ASSERT_TRUE(applySetting(config, "surface.clean.radius.radius_m=0.2"));
    ASSERT_TRUE(applySetting(config, "surface.clean.radius.least_neighbours=3"));
    const Products products = processed(s.survey, config);
    ASSERT_GT(isolated(products), 0);
    std::size_t reported = 0;
    for (const RunReport& run : products.report.runs) {
        for (const CountedReason& reason : run.ground_points_rejected) {
            if (reason.reason == "isolated") reported += reason.count;
        }
    }
    EXPECT_EQ(reported, static_cast<std::size_t>(isolated(products)));
}

TEST(Process, ProgressStaysInRangeAndEndsAtOne) {
    class Recorder final : public Progress {
      public:
        void report(double fraction, std::string_view) override {
            const std::lock_guard lock(mutex_);
            EXPECT_GE(fraction, 0.0);
            EXPECT_LE(fraction, 1.0 + 1e-12);
            last_ = fraction;
        }
        void message(Severity, std::string_view) override {}
        std::mutex mutex_;
        double last_ = 0.0;
    };
    const SimulatedSurvey s = simulatedSurvey(smallField());
    Recorder recorder;
    ASSERT_TRUE(process(s.survey, {}, recorder, {}));
    EXPECT_NEAR(recorder.last_, 1.0, 1e-9);
}

}  // namespace
}  // namespace terrawalk
