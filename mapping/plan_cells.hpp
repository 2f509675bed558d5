#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <vector>

namespace terrawalk {

/// Points by square cells in plan, row by row, to find those near a place. Keeps a reference to the points.
/// Immutable; safe from any thread. The order of what is found depends on the points alone.
class PlanCells {
  public:
    PlanCells(const std::vector<Eigen::Vector3d>& points_m, double cell_m)
        : points_m_(points_m), cell_m_(cell_m) {
        entries_.reserve(points_m.size());
        for (std::uint32_t i = 0; i < points_m.size(); ++i) {
            entries_.push_back({index(points_m[i].y()), index(points_m[i].x()), i});
        }
        std::sort(entries_.begin(), entries_.end());
    }

    template <class Take>
    void within(const Eigen::Vector2d& at_m, double radius_m, Take take) const {
        for (double row = index(at_m.y() - radius_m); row <= index(at_m.y() + radius_m); row += 1.0) {
            const Entry first{row, index(at_m.x() - radius_m), 0};
            const double last = index(at_m.x() + radius_m);
            for (auto e = std::lower_bound(entries_.begin(), entries_.end(), first);
                 e != entries_.end() && e->row == row && e->column <= last; ++e) {
                if ((points_m_[e->point].head<2>() - at_m).squaredNorm() <= radius_m * radius_m) {
                    take(points_m_[e->point]);
                }
            }
        }
    }

    /// The mean place of the points of each cell, in the order of the cells.
    [[nodiscard]] std::vector<Eigen::Vector2d> centres() const {
        std::vector<Eigen::Vector2d> centres;
        for (std::size_t begin = 0; begin < entries_.size();) {
            std::size_t end = begin;
            Eigen::Vector2d sum = Eigen::Vector2d::Zero();
            for (; end < entries_.size() && entries_[end].row == entries_[begin].row &&
                   entries_[end].column == entries_[begin].column;
                 ++end) {
                sum += points_m_[entries_[end].point].head<2>();
            }
            centres.push_back(sum / static_cast<double>(end - begin));
            begin = end;
        }
        return centres;
    }

  private:
    struct Entry {
        double row;
        double column;
        std::uint32_t point;
        auto operator<=>(const Entry&) const = default;
    };
    [[nodiscard]] double index(double at_m) const { return std::floor(at_m / cell_m_); }

    const std::vector<Eigen::Vector3d>& points_m_;
    double cell_m_;
    std::vector<Entry> entries_;
};

}  // namespace terrawalk
