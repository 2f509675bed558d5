#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "mapping/thinning.hpp"
#include "tests/support/random_numbers.hpp"

namespace terrawalk {
namespace {

using test::RandomNumbers;

GroundPoint pointAt(double e, double n, double u, std::uint32_t run = 0, std::uint32_t epoch = 0) {
    GroundPoint point;
    point.enu_m = {e, n, u};
    point.run = run;
    point.epoch = epoch;
    point.time_s = 0.1 * epoch;
    return point;
}

std::vector<GroundPoint> randomWalks(std::uint64_t seed) {
    RandomNumbers random(seed);
    std::vector<GroundPoint> points;
    for (std::uint32_t run = 0; run < 3; ++run) {
        for (std::uint32_t epoch = 0; epoch < 2000; ++epoch) {
            // Heights in steps, so that many are equal.
            const double u = 0.1 * static_cast<double>(random.below(10));
            points.push_back(
                pointAt(random.uniform(-10.0, 10.0), random.uniform(-10.0, 10.0), u, run, epoch));
            if (random.below(10) == 0) {
                points.back().state = GroundPointState::Spike;
            }
        }
    }
    return points;
}

std::vector<std::tuple<double, double, double>> usedPlaces(const std::vector<GroundPoint>& points) {
    std::vector<std::tuple<double, double, double>> places;
    for (const GroundPoint& point : points) {
        if (point.state == GroundPointState::Used) {
            places.emplace_back(point.enu_m.x(), point.enu_m.y(), point.enu_m.z());
        }
    }
    std::sort(places.begin(), places.end());
    return places;
}

TEST(Thinning, LeavesThePointOfMedianHeightInEachCell) {
    const std::vector<GroundPoint> points = randomWalks(1);
    const std::vector<GroundPoint> thinned = thinGroundPoints(points, 0.5);
    ASSERT_EQ(thinned.size(), points.size());
    std::map<std::pair<double, double>, std::vector<double>> all;
    std::map<std::pair<double, double>, std::vector<double>> left;
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(thinned[i].enu_m, points[i].enu_m) << "as measured";
        const std::pair cell(std::floor(2.0 * points[i].enu_m.x()), std::floor(2.0 * points[i].enu_m.y()));
        if (points[i].state == GroundPointState::Used) {
            all[cell].push_back(points[i].enu_m.z());
        } else {
            EXPECT_EQ(thinned[i].state, points[i].state) << "rejected points keep their reason";
        }
        if (thinned[i].state == GroundPointState::Used) {
            left[cell].push_back(points[i].enu_m.z());
        }
    }
    ASSERT_EQ(all.size(), left.size());
    EXPECT_LT(left.size(), points.size() / 3);
    for (auto& [cell, heights] : all) {
        std::sort(heights.begin(), heights.end());
        ASSERT_EQ(left[cell].size(), 1U);
        EXPECT_EQ(left[cell][0], heights[(heights.size() - 1) / 2]);
    }
}

TEST(Thinning, DoesNotDependOnTheOrderOfPointsAndRuns) {
    std::vector<GroundPoint> points = randomWalks(2);
    const auto expected = usedPlaces(thinGroundPoints(points, 0.5));
    RandomNumbers random(3);
    for (int round = 0; round < 5; ++round) {
        for (std::size_t i = points.size(); i > 1; --i) {
            std::swap(points[i - 1], points[random.below(i)]);
        }
        for (GroundPoint& point : points) {
            point.run = (point.run + 1) % 3;
        }
        EXPECT_EQ(usedPlaces(thinGroundPoints(points, 0.5)), expected);
    }
}

TEST(Thinning, CellsAreHalfOpenOnBothSidesOfZero) {
    const auto thinned =
        thinGroundPoints({pointAt(-0.1, 0.1, 1.0), pointAt(0.0, 0.1, 2.0), pointAt(0.4999, 0.1, 3.0),
                          pointAt(0.5, 0.1, 4.0), pointAt(0.1, -0.1, 5.0)},
                         0.5);
    EXPECT_EQ(thinned[0].state, GroundPointState::Used);
    EXPECT_EQ(thinned[1].state, GroundPointState::Used);
    EXPECT_EQ(thinned[2].state, GroundPointState::Thinned);
    EXPECT_EQ(thinned[3].state, GroundPointState::Used);
    EXPECT_EQ(thinned[4].state, GroundPointState::Used);
}

TEST(Thinning, ZeroThinsNothing) {
    const std::vector<GroundPoint> points = randomWalks(4);
    EXPECT_EQ(usedPlaces(thinGroundPoints(points, 0.0)), usedPlaces(points));
    EXPECT_TRUE(thinGroundPoints({}, 0.5).empty());
}

}  // namespace
}  // namespace terrawalk
