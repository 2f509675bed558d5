#include <gtest/gtest.h>
#include <pcl/filters/radius_outlier_removal.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_types.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>

#include "mapping/point_cleaning.hpp"
#include "tests/support/random_numbers.hpp"

namespace terrawalk {
namespace {

using test::RandomNumbers;
using Ground = std::function<double(double e_m, double n_m)>;

constexpr double kSigma_m = 0.05;

GroundPoint pointAt(double e_m, double n_m, double u_m) {
    GroundPoint point;
    point.enu_m = {e_m, n_m, u_m};
    return point;
}

/// A walk in lines to the east, 3 m apart, a point every 0.2 m.
std::vector<GroundPoint> walkOver(const Ground& ground, std::uint64_t seed) {
    RandomNumbers random(seed);
    std::vector<GroundPoint> points;
    for (double n = 0.0; n <= 30.0; n += 3.0) {
        for (double e = 0.0; e <= 30.0; e += 0.2) {
            points.push_back(pointAt(e, n, ground(e, n) + kSigma_m * random.normal()));
        }
    }
    return points;
}

double gentleSlope(double e_m, double n_m) {
    return 0.05 * e_m + 0.1 * n_m;
}
/// Treads of 6 m and steps of 1 m in 0.6 m, the walk's lines at their feet, on them and close to their edges.
double terraces(double e_m, double n_m) {
    const double along_m = n_m + 0.5 * std::sin(e_m / 5.0) + 2.0;
    const double tread = std::floor(along_m / 6.0);
    return tread + std::min(1.0, (along_m - 6.0 * tread) / 0.6);
}

Result<std::vector<GroundPoint>> clean(std::vector<GroundPoint> points, const PointCleaningOptions& options) {
    SilentProgress progress;
    return cleanGroundPoints(std::move(points), options, progress, {});
}

std::size_t count(const std::vector<GroundPoint>& points, GroundPointState state) {
    return static_cast<std::size_t>(std::count_if(
        points.begin(), points.end(), [&](const GroundPoint& point) { return point.state == state; }));
}

PointCleaningOptions aboveGround() {
    PointCleaningOptions options;
    options.above_ground.use = true;
    return options;
}

TEST(PointCleaning, TakesPlantedOutliersAndLittleElse) {
    std::vector<GroundPoint> points = walkOver(gentleSlope, 1);
    const std::size_t ground = points.size();
    for (int i = 0; i < 20; ++i) points.push_back(pointAt(1.4 * i, 1.5 + i, 6.0 + 0.3 * i));
    PointCleaningOptions statistical, radius;
    statistical.statistical.use = true;
    radius.radius.use = true;
    for (const auto& [options, state] : {std::pair{statistical, GroundPointState::StatisticalOutlier},
                                         std::pair{radius, GroundPointState::Isolated}}) {
        const auto cleaned = clean(points, options);
        ASSERT_TRUE(cleaned) << cleaned.error().message;
        for (std::size_t i = ground; i < points.size(); ++i) EXPECT_EQ((*cleaned)[i].state, state) << i;
        // Four sigmas of a spread that the outliers widen: next to nothing of the walk itself.
        EXPECT_LE(count(*cleaned, state), 20 + ground / 200);
    }
}

TEST(PointCleaning, IsolationFollowsTheSpacingOfThePoints) {
    PointCleaningOptions options;
    options.radius.use = true;
    for (const double side_m : {6.0, 60.0, 1200.0}) {
        RandomNumbers random(21);
        std::vector<GroundPoint> points;
        for (int i = 0; i < 6000; ++i) {
            points.push_back(pointAt(random.uniform(0.0, side_m), random.uniform(0.0, side_m), 0.0));
        }
        const std::size_t ground = points.size();
        for (int i = 0; i < 6; ++i) points.push_back(pointAt((2.0 + i) * side_m, 0.0, 0.0));
        const double radius_m = isolationRadius_m(points, options.radius);
        EXPECT_NEAR(radius_m, 0.033 * side_m, 0.004 * side_m);
        const auto cleaned = clean(points, options);
        ASSERT_TRUE(cleaned);
        EXPECT_EQ(count(*cleaned, GroundPointState::Isolated), 6U) << side_m;
        for (std::size_t i = ground; i < points.size(); ++i) {
            EXPECT_EQ((*cleaned)[i].state, GroundPointState::Isolated);
        }
    }
    options.radius.radius_m = 0.7;
    EXPECT_EQ(isolationRadius_m({}, options.radius), 0.7);
    options.radius.radius_m = 0.0;
    EXPECT_EQ(isolationRadius_m({}, options.radius), 1.0);
    EXPECT_EQ(isolationRadius_m(std::vector<GroundPoint>(9, pointAt(1, 1, 1)), options.radius), 1.0);
}

TEST(PointCleaning, TakesHandsAndPlantsOffSlopesAndTerraces) {
    for (const Ground& ground : {Ground(gentleSlope), Ground(terraces)}) {
        std::vector<GroundPoint> points = walkOver(ground, 2);
        std::vector<bool> planted(points.size(), false);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double e = points[i].enu_m.x(), n = points[i].enu_m.y();
            const bool hand =
                n == 6.0 && e > 10.0 && e < 12.0;  // two metres of walk with a hand before the laser
            const bool bush = std::hypot(e - 21.0, n - 15.0) < 0.8;  // 0.9 m high
            if (hand) points[i].enu_m.z() += 0.9;
            if (bush) points[i].enu_m.z() += 0.9;
            planted[i] = hand || bush;
        }
        const auto cleaned = clean(points, aboveGround());
        ASSERT_TRUE(cleaned) << cleaned.error().message;
        std::size_t missed = 0, wrong = 0, things = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool taken = (*cleaned)[i].state == GroundPointState::AboveGround;
            things += planted[i];
            missed += planted[i] && !taken;
            wrong += !planted[i] && taken;
        }
        ASSERT_GT(things, 12U);
        EXPECT_LE(missed, things / 10);
        EXPECT_LE(wrong, points.size() / 100);
    }
}

TEST(PointCleaning, LeavesTerracesWhereTheFilterAloneWouldNot) {
    const std::vector<GroundPoint> points = walkOver(terraces, 3);
    const auto kept = clean(points, aboveGround());
    ASSERT_TRUE(kept);
    EXPECT_LE(count(*kept, GroundPointState::AboveGround), points.size() / 200);

    // A long bund, 1.5 m high: a terrace wall, no plant.
    std::vector<GroundPoint> bund = walkOver(gentleSlope, 4);
    for (GroundPoint& point : bund) point.enu_m.z() += point.enu_m.y() == 15.0 ? 1.5 : 0.0;
    EXPECT_EQ(count(*clean(bund, aboveGround()), GroundPointState::AboveGround), 0U);
    PointCleaningOptions bare = aboveGround();
    bare.above_ground.greatest_window_m = 8.0;
    bare.above_ground.terrace_length_m = 0.0;
    EXPECT_GT(count(*clean(bund, bare), GroundPointState::AboveGround), 100U) << "as published";
}

// Scattered points, where the upper edge of a wall is broken into things of a few points.
TEST(PointCleaning, LeavesTheUpperEdgeOfAWallAndTakesWhatGrowsBesideIt) {
    const auto wall = [](double e_m, double n_m) {
        return 0.05 * e_m + (n_m > 30.0 ? 1.2 : 0.0);
    };
    std::size_t wrong = 0, missed = 0, plants = 0;
    for (const std::uint64_t seed : {11U, 12U, 13U}) {
        RandomNumbers random(seed);
        std::vector<GroundPoint> points;
        for (int i = 0; i < 6000; ++i) {
            const double e = random.uniform(0.0, 60.0), n = random.uniform(0.0, 60.0);
            points.push_back(pointAt(e, n, wall(e, n) + 0.02 * random.normal()));
        }
        const std::size_t ground = points.size();
        for (int i = 0; i < 8; ++i) {
            const double e = 5.0 + 7.0 * i, n = i % 2 == 0 ? 28.5 : 32.0;
            for (int hit = 0; hit < 20; ++hit) {
                const double e_m = e + 0.3 * random.normal(), n_m = n + 0.3 * random.normal();
                points.push_back(pointAt(e_m, n_m, wall(e_m, n_m) + random.uniform(0.5, 2.5)));
            }
        }
        const auto cleaned = clean(points, aboveGround());
        ASSERT_TRUE(cleaned) << cleaned.error().message;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool taken = (*cleaned)[i].state == GroundPointState::AboveGround;
            plants += i >= ground;
            wrong += i < ground && taken;
            missed += i >= ground && !taken;
        }
    }
    EXPECT_LE(wrong, 20U);
    EXPECT_LE(missed, plants / 50);
}

TEST(PointCleaning, DoesNotDependOnOrderOrThreadsAndCanBeTakenBack) {
    std::vector<GroundPoint> points = walkOver(terraces, 5);
    for (std::size_t i = 0; i < points.size(); i += 97) points[i].enu_m.z() += 1.5;
    points[3].state = GroundPointState::Spike;
    PointCleaningOptions options = aboveGround();
    options.statistical.use = options.radius.use = true;
    const auto expected = clean(points, options);
    ASSERT_TRUE(expected);
    ASSERT_GT(count(*expected, GroundPointState::AboveGround) +
                  count(*expected, GroundPointState::StatisticalOutlier),
              5U);
    EXPECT_EQ((*expected)[3].state, GroundPointState::Spike);

    std::vector<GroundPoint> reversed(points.rbegin(), points.rend());
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    auto again = clean(reversed, options);
    ASSERT_TRUE(again);
    std::reverse(again->begin(), again->end());
    const std::vector<GroundPoint> undone = withoutCleaning(*expected);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ((*again)[i].state, (*expected)[i].state) << i;
        EXPECT_EQ(undone[i].state, points[i].state);
        EXPECT_EQ((*expected)[i].enu_m, points[i].enu_m);
    }
}

/// The cloud that cleaning makes of points whose least coordinates are zero and that are floats.
pcl::PointCloud<pcl::PointXYZ>::Ptr cloudOf(const std::vector<GroundPoint>& points) {
    auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
    for (const GroundPoint& point : points) {
        const Eigen::Vector3f p = point.enu_m.cast<float>();
        cloud->push_back({p.x(), p.y(), p.z()});
    }
    return cloud;
}

TEST(PointCleaning, TakesTheOutliersThatPclsOwnFiltersTake) {
    RandomNumbers random(7);
    std::vector<GroundPoint> points{pointAt(0.0, 0.0, 0.0)};
    for (int i = 0; i < 6000; ++i) {
        // Clusters of all densities, and some points alone.
        const double side_m = i % 3 == 0 ? 60.0 : i % 3 == 1 ? 20.0 : 5.0;
        const auto coordinate = [&](double least, double most) {
            return double{static_cast<float>(random.uniform(least, most))};
        };
        points.push_back(
            pointAt(coordinate(0.0, side_m), coordinate(0.0, side_m), coordinate(0.0, 0.1 * side_m)));
    }
    const auto cloud = cloudOf(points);
    const auto compare = [&](pcl::FilterIndices<pcl::PointXYZ>& filter, const PointCleaningOptions& options,
                             GroundPointState state) {
        filter.setInputCloud(cloud);
        pcl::Indices kept;
        filter.filter(kept);
        std::vector<bool> expected(points.size(), true);
        for (const pcl::index_t i : kept) expected[static_cast<std::size_t>(i)] = false;
        const auto cleaned = clean(points, options);
        ASSERT_TRUE(cleaned);
        ASSERT_GT(count(*cleaned, state), 20U);
        ASSERT_LT(count(*cleaned, state), points.size() / 2);
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_EQ((*cleaned)[i].state == state, expected[i]) << i;
        }
    };
    PointCleaningOptions statistical;
    statistical.statistical = {true, 8, 2.0};
    pcl::StatisticalOutlierRemoval<pcl::PointXYZ> by_distance;
    by_distance.setMeanK(8);
    by_distance.setStddevMulThresh(2.0);
    compare(by_distance, statistical, GroundPointState::StatisticalOutlier);
    PointCleaningOptions radius;
    radius.radius = {true, 1.5, 3};
    pcl::RadiusOutlierRemoval<pcl::PointXYZ> by_radius;
    by_radius.setRadiusSearch(1.5);
    by_radius.setMinNeighborsInRadius(3);
    compare(by_radius, radius, GroundPointState::Isolated);
}

/// Asks to stop as soon as a step has begun to report.
class StopsAtOnce : public Progress {
  public:
    void report(double, std::string_view) override {
        ++reports;
        stop.request_stop();
    }
    void message(Severity, std::string_view) override {}
    std::stop_source stop;
    std::atomic<int> reports = 0;
};

TEST(PointCleaning, OutlierFiltersStopInTheMiddle) {
    const std::vector<GroundPoint> points = [] {
        RandomNumbers random(8);
        std::vector<GroundPoint> many;
        for (int i = 0; i < 100'000; ++i) {
            many.push_back(pointAt(random.uniform(0.0, 200.0), random.uniform(0.0, 200.0), 0.0));
        }
        return many;
    }();
    PointCleaningOptions statistical, radius;
    statistical.statistical.use = true;
    radius.radius.use = true;
    for (const PointCleaningOptions& options : {statistical, radius}) {
        StopsAtOnce progress;
        const auto cleaned = cleanGroundPoints(points, options, progress, progress.stop.get_token());
        ASSERT_FALSE(cleaned);
        EXPECT_EQ(cleaned.error().kind, ErrorKind::Cancelled);
        EXPECT_LT(progress.reports, 50) << "of about a hundred blocks";
    }
}

TEST(PointCleaning, CopesWithNothingAndSaysWhatIsWrong) {
    PointCleaningOptions options = aboveGround();
    options.statistical.use = options.radius.use = true;
    EXPECT_TRUE(clean({}, options)->empty());
    EXPECT_EQ(clean({pointAt(0, 0, 0)}, options)->size(), 1U);
    options.above_ground.cell_m = 0.0;
    EXPECT_EQ(clean({}, options).error().kind, ErrorKind::Usage);
    options = aboveGround();
    std::stop_source stop;
    stop.request_stop();
    SilentProgress progress;
    EXPECT_EQ(cleanGroundPoints(walkOver(terraces, 6), options, progress, stop.get_token()).error().kind,
              ErrorKind::Cancelled);
}

}  // namespace
}  // namespace terrawalk
