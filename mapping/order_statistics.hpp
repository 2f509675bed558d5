#pragma once

#include <vector>

namespace terrawalk {

/// The middle value, or the mean of the two middle ones. Needs at least one value, none of them NaN.
[[nodiscard]] double median(std::vector<double> values);

/// The p-quantile of sorted values, linear between neighbours. Needs at least one value; p in 0..1.
[[nodiscard]] double quantileOfSorted(const std::vector<double>& sorted, double p);

}  // namespace terrawalk
