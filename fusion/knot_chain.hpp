#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "fusion/sparse_least_squares.hpp"

namespace terrawalk {

/// Coefficients of one row under work.
class RowTerms {
  public:
    void clear() { size_ = 0; }
    void add(std::size_t unknown, double value) { items_[size_++] = {unknown, value}; }
    std::span<const Coefficient> all() const { return {items_.data(), size_}; }

  private:
    std::array<Coefficient, 32> items_;
    std::size_t size_ = 0;
};

/// A quantity that is linear between knots in time; its values are unknowns, one behind the other `stride`
/// apart.
class KnotChain {
  public:
    KnotChain() = default;
    // Knots every `step_s` where there is something to tell; a gap of two steps is jumped over.
    void cover(double time_s, double step_s) {
        if (times_.empty()) {
            times_.push_back(time_s);
        }
        while (time_s > times_.back()) {
            times_.push_back(time_s > times_.back() + 2.0 * step_s ? time_s : times_.back() + step_s);
        }
    }
    void place(std::size_t first_unknown, std::size_t stride) {
        first_ = first_unknown;
        stride_ = stride;
        values_.assign(times_.size() * stride, 0.0);
    }
    std::size_t knots() const { return times_.size(); }
    double time(std::size_t k) const { return times_[k]; }
    std::size_t unknown(std::size_t k, std::size_t part = 0) const { return first_ + k * stride_ + part; }
    std::size_t unknowns() const { return values_.size(); }
    double knotValue(std::size_t k, std::size_t part = 0) const { return values_[k * stride_ + part]; }

    void setKnotValue(std::size_t k, double value) { values_[k * stride_] = value; }

    struct Place {
        std::size_t knot = 0;
        double fraction = 0.0;  // towards the next knot
    };
    Place locate(double time_s) const {
        if (times_.size() == 1) return {0, 0.0};
        const auto next = std::upper_bound(times_.begin(), times_.end(), time_s);
        const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
            next - times_.begin() - 1, 0, static_cast<std::ptrdiff_t>(times_.size()) - 2));
        return {k, std::clamp((time_s - times_[k]) / (times_[k + 1] - times_[k]), 0.0, 1.0)};
    }
    double value(const Place& at, std::size_t part = 0) const {
        const double here = knotValue(at.knot, part);
        return at.fraction == 0.0 ? here : here + at.fraction * (knotValue(at.knot + 1, part) - here);
    }
    void addTo(RowTerms& row, const Place& at, double factor, std::size_t part = 0) const {
        row.add(unknown(at.knot, part), factor * (1.0 - at.fraction));
        if (at.fraction > 0.0) row.add(unknown(at.knot + 1, part), factor * at.fraction);
    }
    void take(const Eigen::VectorXd& solution) {
        for (std::size_t i = 0; i < values_.size(); ++i) {
            values_[i] += solution[static_cast<Eigen::Index>(first_ + i)];
        }
    }

  private:
    std::vector<double> times_;
    std::vector<double> values_;
    std::size_t first_ = 0;
    std::size_t stride_ = 1;
};

}  // namespace terrawalk
