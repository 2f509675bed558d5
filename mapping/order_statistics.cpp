#include "mapping/order_statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace terrawalk {

double median(std::vector<double> values) {
    assert(!values.empty());
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double quantileOfSorted(const std::vector<double>& sorted, double p) {
    assert(!sorted.empty() && p >= 0.0 && p <= 1.0);
    const double position = p * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

std::optional<QuantilePlaces> quantilePlaces95(std::size_t n, double p) {
    assert(p > 0.0 && p < 1.0);
    constexpr double kEachSide = 0.025;
    const auto count = static_cast<double>(n);
    // Probability that exactly k of n values lie below the quantile.
    const auto chance = [&](std::size_t below) {
        const auto k = static_cast<double>(below);
        return std::exp(std::lgamma(count + 1.0) - std::lgamma(k + 1.0) - std::lgamma(count - k + 1.0) +
                        k * std::log(p) + (count - k) * std::log1p(-p));
    };
    // The value at `low` lies above the quantile where at most `low` values lie below it.
    std::size_t low = 0;
    double at_most = 0.0;
    while (low < n && at_most + chance(low) <= kEachSide) at_most += chance(low++);
    if (low == 0) return std::nullopt;
    // The value at `high` lies below the quantile where more than `high` values do.
    std::size_t high = n;
    double at_least = 0.0;
    while (high > 0 && at_least + chance(high) <= kEachSide) at_least += chance(high--);
    if (high == n) return std::nullopt;
    return QuantilePlaces{low - 1, high};
}

}  // namespace terrawalk
