#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace terrawalk {

/// Where the cells of a north-up grid lie. Map frame, metres. Row 0 is the northernmost, column 0 the
/// westernmost. `west_m` and `north_m` are the outer corner of cell (0, 0); both are integer multiples of the
/// cell size.
struct GridGeometry {
    double west_m = 0.0;
    double north_m = 0.0;
    double cell_m = 1.0;
    std::size_t columns = 0;
    std::size_t rows = 0;

    [[nodiscard]] double centreX(std::size_t column) const {
        return west_m + (static_cast<double>(column) + 0.5) * cell_m;
    }
    [[nodiscard]] double centreY(std::size_t row) const {
        return north_m - (static_cast<double>(row) + 0.5) * cell_m;
    }
    /// Index of the cell that holds a place; west and north edges belong to it.
    [[nodiscard]] std::optional<std::size_t> cellAt(double x_m, double y_m) const {
        const double column = std::floor((x_m - west_m) / cell_m);
        const double row = std::floor((north_m - y_m) / cell_m);
        if (!(column >= 0.0 && row >= 0.0 && column < static_cast<double>(columns) &&
              row < static_cast<double>(rows))) {
            return std::nullopt;
        }
        return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
    }
    [[nodiscard]] std::size_t size() const { return columns * rows; }
    bool operator==(const GridGeometry&) const = default;
};

/// Heights at cell centres, row by row from the north; NaN where nothing is known.
struct ElevationGrid {
    GridGeometry geometry;
    std::vector<float> heights_m;

    [[nodiscard]] float at(std::size_t row, std::size_t column) const {
        return heights_m[row * geometry.columns + column];
    }
};

inline constexpr float kNoHeight = std::numeric_limits<float>::quiet_NaN();

}  // namespace terrawalk
