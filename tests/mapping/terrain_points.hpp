#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "tests/support/random_numbers.hpp"

namespace terrawalk::test {

/// Where tests work with large coordinates: UTM zone 49 N, southern China.
inline const Eigen::Vector3d kUtmOrigin_m(745'000.0, 2'565'000.0, 38.0);

using Points = std::vector<Eigen::Vector3d>;

inline void shuffle(Points& points, RandomNumbers& random) {
    for (std::size_t i = points.size(); i > 1; --i) {
        std::swap(points[i - 1], points[random.below(i)]);
    }
}

inline Points randomPoints(std::size_t count, double side_m, std::uint64_t seed,
                           const Eigen::Vector3d& origin_m = Eigen::Vector3d::Zero()) {
    RandomNumbers random(seed);
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = random.uniform(0.0, side_m);
        const double y = random.uniform(0.0, side_m);
        points.push_back(origin_m + Eigen::Vector3d(x, y, random.uniform(0.0, 5.0)));
    }
    return points;
}

/// columns x rows points one spacing apart, the first at the origin, with heights that no plane holds.
inline Points regularGrid(std::size_t columns, std::size_t rows, double spacing_m,
                          const Eigen::Vector3d& origin_m = Eigen::Vector3d::Zero()) {
    RandomNumbers random(columns * 1000 + rows);
    Points points;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            points.push_back(origin_m + Eigen::Vector3d(static_cast<double>(column) * spacing_m,
                                                        static_cast<double>(row) * spacing_m,
                                                        random.uniform(0.0, 2.0)));
        }
    }
    return points;
}

struct WalkStyle {
    double line_spacing_m = 3.0;
    double step_m = 0.2;
    double wobble_m = 0.1;  ///< of each point, east and north, to either side
};

/// A walk up and down a rectangle in lines to the north, with the links between the lines.
inline void walkRectangle(Points& points, double west_m, double south_m, double width_m, double length_m,
                          const WalkStyle& style, RandomNumbers& random) {
    const auto step = [&](double x, double y) {
        points.emplace_back(x + random.uniform(-style.wobble_m, style.wobble_m),
                            y + random.uniform(-style.wobble_m, style.wobble_m), 0.1 * x);
    };
    bool northward = true;
    for (double x = 0.0; x <= width_m + 1e-9; x += style.line_spacing_m, northward = !northward) {
        for (double y = 0.0; y <= length_m; y += style.step_m) {
            step(west_m + x, south_m + (northward ? y : length_m - y));
        }
        for (double link = style.step_m; link < style.line_spacing_m && x + link < width_m;
             link += style.step_m) {
            step(west_m + x + link, south_m + (northward ? length_m : 0.0));
        }
    }
}

}  // namespace terrawalk::test
