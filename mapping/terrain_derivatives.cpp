#include "mapping/terrain_derivatives.hpp"

#include <algorithm>
#include <cmath>

#include "mapping/grid_rows.hpp"
#include "survey/frames.hpp"

namespace terrawalk {

namespace {

/// Heights of a cell and its neighbours, row by row from the north-west: z[4] is the cell itself.
using Window = std::array<double, 9>;

struct Gradient {
    double east = 0.0;
    double north = 0.0;
    [[nodiscard]] double squared() const { return east * east + north * north; }
};

Gradient hornGradient(const Window& z, double cell) {
    return {((z[2] + 2 * z[5] + z[8]) - (z[0] + 2 * z[3] + z[6])) / (8.0 * cell),
            ((z[0] + 2 * z[1] + z[2]) - (z[6] + 2 * z[7] + z[8])) / (8.0 * cell)};
}

double hillshade(const Window& z, double cell, const ReliefOptions& sun) {
    Gradient g = hornGradient(z, cell);
    g.east *= sun.exaggeration;
    g.north *= sun.exaggeration;
    const double toward_sun_e = std::sin(sun.sun_azimuth_rad) * std::cos(sun.sun_altitude_rad);
    const double toward_sun_n = std::cos(sun.sun_azimuth_rad) * std::cos(sun.sun_altitude_rad);
    const double cosine = (std::sin(sun.sun_altitude_rad) - g.east * toward_sun_e - g.north * toward_sun_n) /
                          std::sqrt(1.0 + g.squared());
    return std::round(1.0 + 254.0 * std::max(0.0, cosine));
}

double slopeOf(const Window& z, double cell, SlopeUnit unit) {
    const double rise = std::sqrt(hornGradient(z, cell).squared());
    return unit == SlopeUnit::Percent ? 100.0 * rise : degrees(std::atan(rise));
}

double aspectOf(const Window& z, double cell) {
    const Gradient g = hornGradient(z, cell);
    if (g.squared() == 0.0) return kNoHeight;
    const double clockwise_deg = degrees(std::atan2(-g.east, -g.north));
    return clockwise_deg < 0.0 ? clockwise_deg + 360.0 : clockwise_deg;
}

/// Second derivatives of the surface of Zevenbergen and Thorne: their 2D, 2E and F, and their gradient.
struct Quadratic {
    double ee = 0.0, nn = 0.0, en = 0.0;
    Gradient gradient;
};
Quadratic quadraticOf(const Window& z, double cell) {
    return {(z[3] + z[5] - 2 * z[4]) / (cell * cell),
            (z[1] + z[7] - 2 * z[4]) / (cell * cell),
            (z[2] + z[6] - z[0] - z[8]) / (4 * cell * cell),
            {(z[5] - z[3]) / (2 * cell), (z[1] - z[7]) / (2 * cell)}};
}

double curvatureOf(const Window& z, double cell, Derivative which) {
    const Quadratic q = quadraticOf(z, cell);
    if (which == Derivative::Curvature) return -(q.ee + q.nn);
    const double squared = q.gradient.squared();
    if (squared == 0.0) return kNoHeight;
    const double e = q.gradient.east, n = q.gradient.north;
    const double second = which == Derivative::ProfileCurvature
                              ? q.ee * e * e + q.nn * n * n + 2.0 * q.en * e * n
                              : q.ee * n * n + q.nn * e * e - 2.0 * q.en * e * n;
    return -second / squared;
}

double roughnessOf(const Window& z) {
    const auto [least, greatest] = std::minmax_element(z.begin(), z.end());
    return *greatest - *least;
}

double valueOf(const Window& z, double cell, Derivative derivative, const DerivativeOptions& options) {
    switch (derivative) {
        case Derivative::Hillshade:
            return hillshade(z, cell, options.sun);
        case Derivative::Slope:
            return slopeOf(z, cell, options.slope_unit);
        case Derivative::Aspect:
            return aspectOf(z, cell);
        case Derivative::Curvature:
        case Derivative::ProfileCurvature:
        case Derivative::PlanCurvature:
            return curvatureOf(z, cell, derivative);
        case Derivative::Roughness:
            return roughnessOf(z);
    }
    return kNoHeight;
}

}  // namespace

Result<ElevationGrid> derivativeOf(const ElevationGrid& heights, Derivative derivative,
                                   const DerivativeOptions& options, Progress& progress,
                                   std::stop_token stop) {
    const GridGeometry& g = heights.geometry;
    const std::string_view step = kDerivatives[static_cast<std::size_t>(derivative)].second;
    return gridOf(g, step, progress, stop, [&](std::size_t row, std::size_t column) -> double {
        if (row == 0 || column == 0 || row + 1 == g.rows || column + 1 == g.columns) return kNoHeight;
        Window z{};
        for (std::size_t i = 0; i < 9; ++i) z[i] = heights.at(row - 1 + i / 3, column - 1 + i % 3);
        if (std::any_of(z.begin(), z.end(), [](double height) { return std::isnan(height); }))
            return kNoHeight;
        return valueOf(z, g.cell_m, derivative, options);
    });
}

}  // namespace terrawalk
