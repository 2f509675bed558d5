#include "mapping/order_statistics.hpp"

#include <algorithm>
#include <cassert>
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

}  // namespace terrawalk
