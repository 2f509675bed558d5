#include "app/gui/plot_thinning.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace terrawalk::gui {

namespace {

/// The points of one column that a line needs.
class Column {
  public:
    explicit Column(std::span<const double> y) : y_(y) {}
    void add(std::size_t i) {
        if (empty_) {
            first_ = least_ = greatest_ = i;
            empty_ = false;
        }
        if (y_[i] < y_[least_]) least_ = i;
        if (y_[i] > y_[greatest_]) greatest_ = i;
        last_ = i;
    }
    void flush(std::span<const double> x, PlotPoints& points) {
        if (empty_) return;
        std::array<std::size_t, 4> order{first_, std::min(least_, greatest_), std::max(least_, greatest_),
                                         last_};
        for (std::size_t k = 0; k < order.size(); ++k) {
            if (k > 0 && order[k] == order[k - 1]) continue;
            points.x.push_back(x[order[k]]);
            points.y.push_back(y_[order[k]]);
        }
        empty_ = true;
    }

  private:
    std::span<const double> y_;
    std::size_t first_ = 0, least_ = 0, greatest_ = 0, last_ = 0;
    bool empty_ = true;
};

}  // namespace

PlotPoints thinnedLine(std::span<const double> x, std::span<const double> y, double from, double to,
                       std::size_t columns) {
    PlotPoints points;
    if (x.empty() || !(from < to) || columns == 0) return points;
    const auto at = [&](auto found) {
        return static_cast<std::size_t>(found - x.begin());
    };
    std::size_t begin = at(std::lower_bound(x.begin(), x.end(), from));
    std::size_t end = at(std::upper_bound(x.begin(), x.end(), to));
    if (begin > 0) --begin;
    if (end < x.size()) ++end;
    const double per_column = (to - from) / static_cast<double>(columns);
    double current = -HUGE_VAL;
    Column column(y);
    for (std::size_t i = begin; i < end; ++i) {
        if (std::isnan(y[i])) {
            column.flush(x, points);
            if (!points.y.empty() && !std::isnan(points.y.back())) {
                points.x.push_back(x[i]);
                points.y.push_back(y[i]);
            }
            continue;
        }
        const double own = std::floor((x[i] - from) / per_column);
        if (own != current) column.flush(x, points);
        current = own;
        column.add(i);
    }
    column.flush(x, points);
    return points;
}

PlotPoints thinnedDots(std::span<const double> x, std::span<const double> y, const PlotWindow& window) {
    PlotPoints points;
    std::vector<bool> taken(window.columns * window.rows, false);
    const double wide = window.right - window.left, high = window.top - window.bottom;
    if (!(wide > 0.0) || !(high > 0.0)) return points;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double across = (x[i] - window.left) / wide, up = (y[i] - window.bottom) / high;
        if (!(across >= 0.0 && across <= 1.0 && up >= 0.0 && up <= 1.0)) continue;
        const auto column = std::min(static_cast<std::size_t>(across * static_cast<double>(window.columns)),
                                     window.columns - 1);
        const auto row =
            std::min(static_cast<std::size_t>(up * static_cast<double>(window.rows)), window.rows - 1);
        if (taken[row * window.columns + column]) continue;
        taken[row * window.columns + column] = true;
        points.x.push_back(x[i]);
        points.y.push_back(y[i]);
    }
    return points;
}

BoxOfValues boxOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        const double place = share * static_cast<double>(values.size() - 1);
        const auto below = static_cast<std::size_t>(place);
        const double above = values[std::min(below + 1, values.size() - 1)];
        return values[below] + (place - static_cast<double>(below)) * (above - values[below]);
    };
    BoxOfValues box;
    box.lower_quartile = at(0.25);
    box.median = at(0.5);
    box.upper_quartile = at(0.75);
    const double reach = 1.5 * (box.upper_quartile - box.lower_quartile);
    box.low_whisker = box.lower_quartile;
    box.high_whisker = box.upper_quartile;
    for (const double v : values) {
        if (v < box.lower_quartile - reach || v > box.upper_quartile + reach) {
            box.outliers.push_back(v);
            continue;
        }
        box.low_whisker = std::min(box.low_whisker, v);
        box.high_whisker = std::max(box.high_whisker, v);
    }
    return box;
}

}  // namespace terrawalk::gui
