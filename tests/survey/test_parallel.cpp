#include "survey/parallel.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

namespace terrawalk {
namespace {

TEST(Parallel, EveryIndexOnce) {
    for (const std::size_t count : {0UL, 1UL, 7UL, 10'000UL}) {
        std::vector<int> each(count, 0), ranged(count, 0);
        parallelFor(count, [&](std::size_t i) { ++each[i]; });
        parallelRanges(count, 64, [&](std::size_t begin, std::size_t end) {
            EXPECT_LE(end - begin, 64U);
            for (std::size_t i = begin; i < end; ++i) ++ranged[i];
        });
        EXPECT_EQ(each, std::vector<int>(count, 1));
        EXPECT_EQ(ranged, std::vector<int>(count, 1));
    }
}

TEST(Parallel, GrainOfNothingIsOne) {
    parallelRanges(9, 0, [](std::size_t begin, std::size_t end) { EXPECT_EQ(end - begin, 1U); });
}

TEST(Parallel, LoopsStandInLoops) {
    constexpr std::size_t kSide = 30;
    std::vector<std::size_t> products(kSide * kSide);
    parallelFor(kSide, [&](std::size_t i) {
        isolated([&] { parallelFor(kSide, [&](std::size_t k) { products[i * kSide + k] = i * k; }); });
    });
    for (std::size_t i = 0; i < products.size(); ++i) EXPECT_EQ(products[i], i / kSide * (i % kSide));
}

TEST(Parallel, ExceptionOfABodyComesOut) {
    EXPECT_THROW(parallelFor(1000,
                             [](std::size_t i) {
                                 if (i == 500) throw std::runtime_error("enough");
                             }),
                 std::runtime_error);
}

}  // namespace
}  // namespace terrawalk
