#include "fusion/random_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace terrawalk {
namespace {

constexpr int kDraws = 200'000;

TEST(RandomNumbers, AreDecidedByTheirKeyAlone) {
    RandomNumbers one({7, 1, 2});
    RandomNumbers again({7, 1, 2});
    RandomNumbers swapped({7, 2, 1});
    int equal_to_swapped = 0;
    for (int i = 0; i < 100; ++i) {
        const double value = one.normal();
        EXPECT_EQ(value, again.normal());
        equal_to_swapped += value == swapped.normal() ? 1 : 0;
    }
    EXPECT_EQ(equal_to_swapped, 0);
}

// A seed must mean the same survey in the next version, too. SplitMix64's first output from state 0 is
// published.
TEST(RandomNumbers, KeepWhatASeedMeans) {
    EXPECT_EQ(scramble(std::uint64_t{0}), 0xe220a8397b1dcdafULL);
    RandomNumbers random({1, 2, 3});
    EXPECT_EQ(random.uniform(), 0x1.33b22422c10b3p-1);
}

// The first outputs of SplitMix64 from state 1234567, as its authors' reference prints them.
TEST(RandomNumbers, QuickOnesAreSplitMix64) {
    SplitMix64 engine(1234567);
    EXPECT_EQ(engine(), 6457827717110365317ULL);
    EXPECT_EQ(engine(), 3203168211198807973ULL);
    EXPECT_EQ(engine(), 9817491932198370423ULL);
}

TEST(RandomNumbers, IndexTakesEachValueEvenly) {
    constexpr std::size_t kValues = 7;
    std::vector<int> counts(kValues, 0);
    QuickRandomNumbers random({44});
    for (int i = 0; i < kDraws; ++i) ++counts.at(random.index(kValues));
    const double expected = static_cast<double>(kDraws) / kValues;
    double chi_square = 0.0;
    for (const int count : counts) chi_square += (count - expected) * (count - expected) / expected;
    // Mean 6, variance 12.
    EXPECT_LT(chi_square, 6.0 + 4.0 * std::sqrt(12.0));
}

TEST(RandomNumbers, UniformFillsItsBinsEvenly) {
    constexpr int kBins = 100;
    std::vector<int> counts(kBins, 0);
    RandomNumbers random({42});
    for (int i = 0; i < kDraws; ++i) {
        const double value = random.uniform();
        ASSERT_GE(value, 0.0);
        ASSERT_LT(value, 1.0);
        ++counts[static_cast<std::size_t>(value * kBins)];
    }
    const double expected = static_cast<double>(kDraws) / kBins;
    double chi_square = 0.0;
    for (const int count : counts) chi_square += (count - expected) * (count - expected) / expected;
    // Mean 99, variance 198.
    EXPECT_NEAR(chi_square, 99.0, 4.0 * std::sqrt(198.0));
}

TEST(RandomNumbers, NormalHasTheMomentsOfANormalDistribution) {
    RandomNumbers random({43});
    double sum = 0.0;
    double sum2 = 0.0;
    double sum3 = 0.0;
    double sum4 = 0.0;
    double sum_lagged = 0.0;
    double last = 0.0;
    for (int i = 0; i < kDraws; ++i) {
        const double x = random.normal();
        sum += x;
        sum2 += x * x;
        sum3 += x * x * x;
        sum4 += x * x * x * x;
        sum_lagged += x * last;
        last = x;
    }
    // Four standard errors of each moment: variances 1, 2, 15, 96 and 1 over n.
    const double n = kDraws;
    EXPECT_NEAR(sum / n, 0.0, 4.0 * std::sqrt(1.0 / n));
    EXPECT_NEAR(sum2 / n, 1.0, 4.0 * std::sqrt(2.0 / n));
    EXPECT_NEAR(sum3 / n, 0.0, 4.0 * std::sqrt(15.0 / n));
    EXPECT_NEAR(sum4 / n, 3.0, 4.0 * std::sqrt(96.0 / n));
    EXPECT_NEAR(sum_lagged / n, 0.0, 4.0 * std::sqrt(1.0 / n));
}

}  // namespace
}  // namespace terrawalk
