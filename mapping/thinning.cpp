#include "mapping/thinning.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

namespace terrawalk {
namespace {

/// A used point with the indices of its cell, whole numbers in doubles: no range in which they could
/// overflow.
struct CellEntry {
    double row;
    double column;
    std::size_t point;
};

std::vector<CellEntry> cellEntries(const std::vector<GroundPoint>& points, double cell_m) {
    std::vector<CellEntry> entries;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].state == GroundPointState::Used) {
            entries.push_back(
                {std::floor(points[i].enu_m.y() / cell_m), std::floor(points[i].enu_m.x() / cell_m), i});
        }
    }
    return entries;
}

}  // namespace

std::vector<GroundPoint> thinGroundPoints(std::vector<GroundPoint> points, double cell_m) {
    assert(cell_m >= 0.0);
    if (cell_m == 0.0) {
        return points;
    }
    std::vector<CellEntry> entries = cellEntries(points, cell_m);
    std::sort(entries.begin(), entries.end(), [&](const CellEntry& a, const CellEntry& b) {
        if (a.row != b.row || a.column != b.column) {
            return std::tie(a.row, a.column) < std::tie(b.row, b.column);
        }
        const GroundPoint& p = points[a.point];
        const GroundPoint& q = points[b.point];
        return std::tuple(p.enu_m.z(), p.enu_m.y(), p.enu_m.x(), p.time_s, p.epoch, p.run) <
               std::tuple(q.enu_m.z(), q.enu_m.y(), q.enu_m.x(), q.time_s, q.epoch, q.run);
    });
    for (std::size_t begin = 0; begin < entries.size();) {
        std::size_t end = begin;
        while (end < entries.size() && entries[end].row == entries[begin].row &&
               entries[end].column == entries[begin].column) {
            ++end;
        }
        const std::size_t middle = begin + (end - begin - 1) / 2;
        for (std::size_t entry = begin; entry < end; ++entry) {
            if (entry != middle) {
                points[entries[entry].point].state = GroundPointState::Thinned;
            }
        }
        begin = end;
    }
    return points;
}

}  // namespace terrawalk
