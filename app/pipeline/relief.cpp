#include "app/pipeline/relief.hpp"

#include <algorithm>
#include <cmath>

#include "io/encode_picture.hpp"
#include "mapping/shaded_relief.hpp"
#include "resources/resources.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {

namespace {

constexpr double kLongerSide_px = 800.0;

/// Three numbers a line after the header; the file is ours and well formed.
std::vector<Colour> parseRamp(std::string_view csv) {
    std::vector<Colour> ramp;
    std::size_t component = 0;
    bool in_number = false;
    for (const char c : csv) {
        const bool digit = c >= '0' && c <= '9';
        if (digit && !in_number && component % 3 == 0) ramp.push_back({});
        if (digit) {
            std::uint8_t& value = ramp.back()[component % 3];
            value = static_cast<std::uint8_t>(value * 10 + (c - '0'));
        } else if (in_number) {
            ++component;
        }
        in_number = digit;
    }
    return ramp;
}

GridGeometry pictureFrame(const std::vector<GroundPoint>& points) {
    Eigen::Vector2d least = Eigen::Vector2d::Constant(HUGE_VAL);
    Eigen::Vector2d greatest = -least;
    for (const GroundPoint& point : points) {
        if (point.state != GroundPointState::Used) continue;
        least = least.cwiseMin(point.enu_m.head<2>());
        greatest = greatest.cwiseMax(point.enu_m.head<2>());
    }
    const Eigen::Vector2d extent = greatest - least;
    const double pixel_m = std::max(extent.maxCoeff(), 1e-3) / kLongerSide_px;
    return {least.x(), greatest.y(), pixel_m, static_cast<std::size_t>(std::ceil(extent.x() / pixel_m)) + 1,
            static_cast<std::size_t>(std::ceil(extent.y() / pixel_m)) + 1};
}

/// From local to map coordinates as a linear map about the middle: over a walk it is off by less than a
/// pixel.
struct LinearProjection {
    Eigen::Vector2d middle_enu_m;
    Eigen::Vector2d middle_map_m;
    Eigen::Matrix2d slope;
    [[nodiscard]] Eigen::Vector2d operator()(double e_m, double n_m) const {
        return middle_map_m + slope * (Eigen::Vector2d(e_m, n_m) - middle_enu_m);
    }
};

Result<LinearProjection> linearised(const MapProjection& projection, const GridGeometry& frame) {
    LinearProjection linear;
    const double half_m = 0.5 * frame.cell_m * static_cast<double>(std::max(frame.columns, frame.rows));
    linear.middle_enu_m = {frame.centreX(frame.columns / 2), frame.centreY(frame.rows / 2)};
    const auto at = [&](double e_m, double n_m) {
        return projection.toMap(
            Eigen::Vector3d(linear.middle_enu_m.x() + e_m, linear.middle_enu_m.y() + n_m, 0.0));
    };
    const auto middle = at(0, 0), east = at(half_m, 0), north = at(0, half_m);
    for (const auto* position : {&middle, &east, &north}) {
        if (!*position) return tl::unexpected(position->error());
    }
    linear.middle_map_m = middle->head<2>();
    linear.slope.col(0) = (east->head<2>() - middle->head<2>()) / half_m;
    linear.slope.col(1) = (north->head<2>() - middle->head<2>()) / half_m;
    return linear;
}

}  // namespace

std::vector<Colour> reliefRamp() {
    return parseRamp(resources::relief_ramp);
}

std::vector<Colour> divergingRamp() {
    return parseRamp(resources::diverging_ramp);
}

std::vector<Colour> sequentialRamp() {
    return parseRamp(resources::sequential_ramp);
}

Result<ReliefPicture> reliefPicture(const SurfaceModel& surface, const MapProjection& projection,
                                    const std::vector<GroundPoint>& ground_points) {
    ElevationGrid grid{pictureFrame(ground_points), {}};
    const GridGeometry& g = grid.geometry;
    const auto to_map = linearised(projection, g);
    if (!to_map) return tl::unexpected(to_map.error());
    grid.heights_m.assign(g.size(), kNoHeight);
    parallelFor(g.rows, [&](std::size_t row) {
        for (std::size_t column = 0; column < g.columns; ++column) {
            const Eigen::Vector2d at = (*to_map)(g.centreX(column), g.centreY(row));
            const auto height_m = surface.heightAt(at.x(), at.y());
            if (height_m) grid.heights_m[row * g.columns + column] = static_cast<float>(*height_m);
        }
    });
    const std::vector<Colour> ramp = reliefRamp();
    const ReliefImage image = shadedRelief(grid, ramp);
    auto png = encodePng(image);
    if (!png) return tl::unexpected(png.error());
    auto ramp_png = encodePng(rampImage(ramp));
    if (!ramp_png) return tl::unexpected(ramp_png.error());
    return ReliefPicture{g.west_m,
                         g.north_m,
                         g.cell_m * static_cast<double>(g.columns),
                         g.cell_m * static_cast<double>(g.rows),
                         image.lowest_m,
                         image.highest_m,
                         std::move(*png),
                         std::move(*ramp_png)};
}

}  // namespace terrawalk
