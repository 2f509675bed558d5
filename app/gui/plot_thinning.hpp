#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace terrawalk::gui {

struct PlotPoints {
    std::vector<double> x, y;
};

/// What a line looks like on so many columns of pixels between two x: of each column the first, the least,
/// the greatest and the last value, in their order. Gaps (y not a number) stay gaps, however short. One point
/// beyond each end is kept, so that the line runs off the picture. Costs one pass over what is in view.
/// @param x  never falls
[[nodiscard]] PlotPoints thinnedLine(std::span<const double> x, std::span<const double> y, double from,
                                     double to, std::size_t columns);

struct PlotWindow {
    double left = 0.0, right = 1.0, bottom = 0.0, top = 1.0;
    std::size_t columns = 1, rows = 1;
};
/// At most one dot for each pixel of the window; those outside are left out.
[[nodiscard]] PlotPoints thinnedDots(std::span<const double> x, std::span<const double> y,
                                     const PlotWindow& window);

/// A sample as a box: quartiles as medians of the halves' ends (linear between values), whiskers to the
/// farthest values within 1.5 box lengths, the others one by one. Source: Tukey 1977.
struct BoxOfValues {
    double low_whisker = 0.0, lower_quartile = 0.0, median = 0.0, upper_quartile = 0.0, high_whisker = 0.0;
    std::vector<double> outliers;
};
/// @param values  one or more, finite
[[nodiscard]] BoxOfValues boxOf(std::vector<double> values);

}  // namespace terrawalk::gui
