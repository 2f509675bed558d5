#include "mapping/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace terrawalk {

std::optional<double> bilinearAt(const ElevationGrid& grid, const Eigen::Vector2d& at) {
    const GridGeometry& g = grid.geometry;
    const double right = (at.x() - g.centreX(0)) / g.cell_m;
    const double down = (g.centreY(0) - at.y()) / g.cell_m;
    if (!(right >= 0.0) || !(down >= 0.0) || right > static_cast<double>(g.columns - 1) ||
        down > static_cast<double>(g.rows - 1)) {
        return std::nullopt;
    }
    const auto column = std::min(static_cast<std::size_t>(right), g.columns < 2 ? 0 : g.columns - 2);
    const auto row = std::min(static_cast<std::size_t>(down), g.rows < 2 ? 0 : g.rows - 2);
    const double u = right - static_cast<double>(column);
    const double v = down - static_cast<double>(row);
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const double weight = (i % 2 == 0 ? 1.0 - u : u) * (i / 2 == 0 ? 1.0 - v : v);
        if (weight == 0.0) continue;
        const double value = grid.at(row + i / 2, column + i % 2);
        if (std::isnan(value)) return std::nullopt;
        sum += weight * value;
    }
    return sum;
}

std::vector<ProfilePoint> profileAlong(const ElevationGrid& heights, const ElevationGrid* sigmas,
                                       const std::vector<Eigen::Vector2d>& line, double step) {
    std::vector<ProfilePoint> profile;
    const auto add = [&](double distance, const Eigen::Vector2d& at) {
        profile.push_back({distance, at, bilinearAt(heights, at),
                           sigmas == nullptr ? std::nullopt : bilinearAt(*sigmas, at)});
    };
    double before = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Eigen::Vector2d way = line[i + 1] - line[i];
        const auto pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(way.norm() / step)));
        for (std::size_t k = 0; k < pieces; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(pieces);
            add(before + share * way.norm(), line[i] + share * way);
        }
        before += way.norm();
    }
    if (!line.empty()) add(before, line.back());
    return profile;
}

LineOffset offsetFrom(const std::vector<Eigen::Vector2d>& line, const Eigen::Vector2d& point) {
    LineOffset nearest;
    double least = std::numeric_limits<double>::infinity();
    double before = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Eigen::Vector2d way = line[i + 1] - line[i];
        const Eigen::Vector2d to_point = point - line[i];
        const double length = way.norm();
        const double share =
            length == 0.0 ? 0.0 : std::clamp(way.dot(to_point) / way.squaredNorm(), 0.0, 1.0);
        const double away = (to_point - share * way).norm();
        if (away < least) {
            least = away;
            const double side = way.x() * to_point.y() - way.y() * to_point.x();
            nearest = {before + share * length, side < 0.0 ? -away : away};
        }
        before += length;
    }
    return nearest;
}

}  // namespace terrawalk
