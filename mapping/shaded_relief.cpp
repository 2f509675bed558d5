#include "mapping/shaded_relief.hpp"

#include <algorithm>
#include <cmath>

namespace terrawalk {

namespace {

constexpr double kAmbient = 0.45;  // what a slope turned away from the sun keeps of its colour

struct HeightRange {
    double lowest_m = 0.0;
    double highest_m = 0.0;
};

HeightRange heightRange(const std::vector<float>& heights_m) {
    HeightRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const float height : heights_m) {
        if (std::isnan(height)) continue;
        range.lowest_m = std::min(range.lowest_m, static_cast<double>(height));
        range.highest_m = std::max(range.highest_m, static_cast<double>(height));
    }
    return range.lowest_m > range.highest_m ? HeightRange{} : range;
}

/// Cosine of the angle between the surface and the sun, 0 where the slope lies in its own shadow.
double sunlight(const ElevationGrid& grid, std::size_t row, std::size_t column,
                const ReliefOptions& options) {
    const double centre = grid.at(row, column);
    const auto z = [&](std::ptrdiff_t down, std::ptrdiff_t right) {
        const auto r = static_cast<std::ptrdiff_t>(row) + down;
        const auto c = static_cast<std::ptrdiff_t>(column) + right;
        if (r < 0 || c < 0 || r >= static_cast<std::ptrdiff_t>(grid.geometry.rows) ||
            c >= static_cast<std::ptrdiff_t>(grid.geometry.columns)) {
            return centre;
        }
        const float height = grid.at(static_cast<std::size_t>(r), static_cast<std::size_t>(c));
        return std::isnan(height) ? centre : static_cast<double>(height);
    };
    const double scale = options.exaggeration / (8.0 * grid.geometry.cell_m);
    const double east = ((z(-1, 1) + 2 * z(0, 1) + z(1, 1)) - (z(-1, -1) + 2 * z(0, -1) + z(1, -1))) * scale;
    const double north = ((z(-1, -1) + 2 * z(-1, 0) + z(-1, 1)) - (z(1, -1) + 2 * z(1, 0) + z(1, 1))) * scale;
    const double toward_sun_e = std::sin(options.sun_azimuth_rad) * std::cos(options.sun_altitude_rad);
    const double toward_sun_n = std::cos(options.sun_azimuth_rad) * std::cos(options.sun_altitude_rad);
    const double dot = -east * toward_sun_e - north * toward_sun_n + std::sin(options.sun_altitude_rad);
    return std::max(0.0, dot / std::sqrt(1.0 + east * east + north * north));
}

}  // namespace

Colour rampColour(const std::vector<Colour>& ramp, double share) {
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(ramp.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(at), ramp.size() - 1);
    const auto high = std::min(low + 1, ramp.size() - 1);
    const double weight = at - static_cast<double>(low);
    Colour colour{};
    for (std::size_t i = 0; i < 3; ++i) {
        colour[i] =
            static_cast<std::uint8_t>(std::lround((1.0 - weight) * ramp[low][i] + weight * ramp[high][i]));
    }
    return colour;
}

ReliefImage shadedRelief(const ElevationGrid& heights, const std::vector<Colour>& ramp,
                         const ReliefOptions& options) {
    const GridGeometry& g = heights.geometry;
    const HeightRange range = heightRange(heights.heights_m);
    const double extent_m = std::max(range.highest_m - range.lowest_m, 1e-9);
    ReliefImage image{g.west_m, g.north_m, g.cell_m, g.columns, g.rows, range.lowest_m, range.highest_m, {}};
    image.rgba.assign(4 * g.size(), 0);
    for (std::size_t row = 0; row < g.rows; ++row) {
        for (std::size_t column = 0; column < g.columns; ++column) {
            const double height = heights.at(row, column);
            if (std::isnan(height)) continue;
            const Colour colour = rampColour(ramp, (height - range.lowest_m) / extent_m);
            // Level ground keeps its full colour.
            const double level = std::sin(options.sun_altitude_rad);
            const double light =
                std::min(1.15, kAmbient + (1.0 - kAmbient) * sunlight(heights, row, column, options) / level);
            std::uint8_t* pixel = &image.rgba[4 * (row * g.columns + column)];
            for (std::size_t i = 0; i < 3; ++i) {
                pixel[i] = static_cast<std::uint8_t>(std::lround(std::min(255.0, colour[i] * light)));
            }
            pixel[3] = 255;
        }
    }
    return image;
}

ReliefImage rampImage(const std::vector<Colour>& ramp) {
    constexpr std::size_t kColumns = 64;
    ReliefImage image;
    image.columns = kColumns;
    image.rows = 1;
    for (std::size_t column = 0; column < kColumns; ++column) {
        const Colour colour = rampColour(ramp, static_cast<double>(column) / (kColumns - 1));
        image.rgba.insert(image.rgba.end(), {colour[0], colour[1], colour[2], 255});
    }
    return image;
}

}  // namespace terrawalk
