#include <gtest/gtest.h>

#include <cmath>

#include "fusion/random_numbers.hpp"
#include "fusion/test_functions.hpp"

namespace terrawalk {
namespace {

class AnyFunction : public testing::TestWithParam<TestFunction> {
  protected:
    std::size_t dimensions() const { return GetParam() == TestFunction::Levy13 ? 2 : 6; }
};

TEST_P(AnyFunction, IsZeroAtItsMinimiserAndPositiveElsewhere) {
    const std::vector<double> minimum(dimensions(), minimiser(GetParam()));
    EXPECT_NEAR(evaluate(GetParam(), minimum), 0.0, 1e-14);
    const SearchBox box = usualBox(GetParam(), dimensions());
    RandomNumbers random({1});
    for (int draw = 0; draw < 1000; ++draw) {
        std::vector<double> x(dimensions());
        for (std::size_t j = 0; j < x.size(); ++j) x[j] = random.uniform(box.lower[j], box.upper[j]);
        EXPECT_GT(evaluate(GetParam(), x), 0.0);
    }
}

TEST_P(AnyFunction, ShiftMovesTheMinimumWithinTheBox) {
    const SearchBox box = usualBox(GetParam(), dimensions());
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const ShiftedFunction function = shifted(GetParam(), dimensions(), seed);
        std::vector<double> minimum = function.shift;
        for (std::size_t j = 0; j < minimum.size(); ++j) {
            minimum[j] += minimiser(GetParam());
            EXPECT_LE(std::abs(minimum[j]), 0.8 * box.upper[j] * (1.0 + 1e-12));
        }
        // x - shift rounds: half an ulp of the box, times the steepest curvature of the six (800 x 30^2 / 2).
        EXPECT_NEAR(function(minimum), 0.0, 1e-12);
        EXPECT_NE(function.shift, shifted(GetParam(), dimensions(), seed + 1).shift);
    }
}

INSTANTIATE_TEST_SUITE_P(All, AnyFunction,
                         testing::Values(TestFunction::Sphere, TestFunction::Ackley, TestFunction::Rastrigin,
                                         TestFunction::Rosenbrock, TestFunction::Griewank,
                                         TestFunction::Levy13),
                         [](const auto& test) { return std::string(name(test.param)); });

TEST(TestFunctions, HaveTheirPublishedValues) {
    const std::vector<double> ones{1.0, 1.0};
    EXPECT_DOUBLE_EQ(evaluate(TestFunction::Sphere, ones), 2.0);
    EXPECT_NEAR(evaluate(TestFunction::Rastrigin, ones), 2.0, 1e-12);
    EXPECT_NEAR(evaluate(TestFunction::Ackley, ones), 20.0 - 20.0 * std::exp(-0.2), 1e-12);
    EXPECT_DOUBLE_EQ(evaluate(TestFunction::Rosenbrock, std::vector{-1.0, 2.0}), 104.0);
    EXPECT_NEAR(evaluate(TestFunction::Griewank, ones),
                2.0 / 4000.0 - std::cos(1.0) * std::cos(1.0 / std::sqrt(2.0)) + 1.0, 1e-15);
    EXPECT_NEAR(evaluate(TestFunction::Levy13, std::vector{0.0, 0.0}), 2.0, 1e-12);
}

}  // namespace
}  // namespace terrawalk
