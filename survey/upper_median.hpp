#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace terrawalk {

/// The middle value, of an even number the upper of the two. Needs at least one value, none of them NaN;
/// reorders them.
[[nodiscard]] inline double upperMedian(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace terrawalk
