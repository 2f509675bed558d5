#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fusion/good_points.hpp"
#include "fusion/random_numbers.hpp"

namespace terrawalk {
namespace {

double fraction(double value) {
    return value - std::floor(value);
}

// Two dimensions: e = 7, the smallest prime with (e - 3)/2 >= 2. Three: e = 11, as 9 is no prime.
TEST(GoodPoints, AreMultiplesOfTheGoodPointOfTheSmallestPrime) {
    for (const auto& [dimensions, e] : {std::pair{2, 7}, std::pair{3, 11}, std::pair{9, 23}}) {
        const std::size_t d = static_cast<std::size_t>(dimensions);
        const std::vector<double> points = goodPoints(40, d);
        ASSERT_EQ(points.size(), 40 * d);
        for (std::size_t k = 0; k < 40; ++k) {
            for (std::size_t j = 0; j < d; ++j) {
                const double r = 2.0 * std::cos(2.0 * std::numbers::pi * static_cast<double>(j + 1) / e);
                EXPECT_NEAR(points[k * d + j], fraction(r * static_cast<double>(k + 1)), 1e-12);
            }
        }
    }
}

// In the dimensions in which they are used: the picture of Fig 8, nine and twelve parameters. With so few
// points it does not hold in each dimension; five is an exception.
TEST(GoodPoints, AreMoreEvenThanRandomPoints) {
    for (const std::size_t dimensions : {2U, 9U, 12U}) {
        constexpr std::size_t kPoints = 100;
        constexpr int kDraws = 50;
        const double good = centredDiscrepancy(goodPoints(kPoints, dimensions), dimensions);
        int more_even = 0;
        RandomNumbers random({5, dimensions});
        for (int draw = 0; draw < kDraws; ++draw) {
            std::vector<double> points(kPoints * dimensions);
            for (double& value : points) value = random.uniform();
            more_even += good < centredDiscrepancy(points, dimensions) ? 1 : 0;
        }
        EXPECT_GE(more_even, kDraws * 9 / 10) << dimensions;
    }
}

// One point in the middle of the unit interval: 13/12 - 2 + 1.
TEST(CentredDiscrepancy, HasItsValueForOnePoint) {
    EXPECT_NEAR(centredDiscrepancy({0.5}, 1), std::sqrt(1.0 / 12.0), 1e-15);
}

TEST(CentredDiscrepancy, IsGreatWhereAllPointsLieInACorner) {
    const std::vector<double> corner(50 * 2, 0.01);
    EXPECT_GT(centredDiscrepancy(corner, 2), 5.0 * centredDiscrepancy(goodPoints(50, 2), 2));
}

}  // namespace
}  // namespace terrawalk
