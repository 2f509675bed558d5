#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace terrawalk {

/// The middle value, or the mean of the two middle ones. Needs at least one value, none of them NaN.
[[nodiscard]] double median(std::vector<double> values);

/// The p-quantile of sorted values, linear between neighbours. Needs at least one value; p in 0..1.
[[nodiscard]] double quantileOfSorted(const std::vector<double>& sorted, double p);

/// Places, from 0, of two of n values in rising order that hold the p-quantile of what they were drawn from
/// between them with at least 95 % probability, whatever its distribution: each end is passed in at most
/// 2.5 % of cases, by the binomial distribution of how many values lie below the quantile. Nothing where n is
/// too small for that, below 72 for p = 0.95. Source: Conover, Practical Nonparametric Statistics, 3rd ed.,
/// section 3.2.
struct QuantilePlaces {
    std::size_t low = 0;
    std::size_t high = 0;
};
/// @param p  above 0, below 1
[[nodiscard]] std::optional<QuantilePlaces> quantilePlaces95(std::size_t n, double p);

}  // namespace terrawalk
