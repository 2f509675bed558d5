#include "mapping/volume.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace terrawalk {
namespace {

constexpr double kBlocksPerRange = 8.0;
constexpr std::size_t kCellsBetweenStops = std::size_t{1} << 20U;

/// Sigmas of the cells of each block summed, for what lies above, below, and with its sign.
struct BlockSums {
    std::size_t columns = 0;
    std::size_t rows = 0;
    double side_m = 0.0;
    std::vector<double> sums;
};

double sphericalCorrelation(double distance_m, double range_m) {
    const double share = distance_m / range_m;
    return share >= 1.0 ? 0.0 : 1.0 - share * (1.5 - 0.5 * share * share);
}

/// Sum over all pairs of blocks; of no meaning once stop is asked for.
double pairSum(const BlockSums& blocks, double range_m, const std::stop_token& stop) {
    const auto reach = static_cast<std::int64_t>(range_m > 0.0 ? std::ceil(range_m / blocks.side_m) : 0.0);
    std::vector<double> correlation;
    for (std::int64_t dr = -reach; dr <= reach; ++dr) {
        for (std::int64_t dc = -reach; dc <= reach; ++dc) {
            const double distance_m =
                blocks.side_m * std::hypot(static_cast<double>(dr), static_cast<double>(dc));
            correlation.push_back(dr == 0 && dc == 0 ? 1.0 : sphericalCorrelation(distance_m, range_m));
        }
    }
    double sum = 0.0;
    const auto rows = static_cast<std::int64_t>(blocks.rows);
    const auto columns = static_cast<std::int64_t>(blocks.columns);
    for (std::int64_t row = 0; row < rows && !stop.stop_requested(); ++row) {
        for (std::int64_t column = 0; column < columns; ++column) {
            const double here = blocks.sums[static_cast<std::size_t>(row * columns + column)];
            if (here == 0.0) continue;
            double seen = 0.0;
            for (std::int64_t r = std::max<std::int64_t>(0, row - reach);
                 r <= std::min(rows - 1, row + reach); ++r) {
                for (std::int64_t c = std::max<std::int64_t>(0, column - reach);
                     c <= std::min(columns - 1, column + reach); ++c) {
                    const std::int64_t at = (r - row + reach) * (2 * reach + 1) + (c - column + reach);
                    seen += correlation[static_cast<std::size_t>(at)] *
                            blocks.sums[static_cast<std::size_t>(r * columns + c)];
                }
            }
            sum += here * seen;
        }
    }
    return sum;
}

/// One standard error of the sum over the cells that count.
template <class Counts>
double sigmaOf(const ElevationGrid& difference, const VolumeErrorModel& errors, std::size_t cells,
               const std::stop_token& stop, Counts counts) {
    if (stop.stop_requested()) return 0.0;
    const GridGeometry& g = difference.geometry;
    const std::size_t per_block = std::max<std::size_t>(
        1, static_cast<std::size_t>(errors.correlation_range_m / kBlocksPerRange / g.cell_m));
    BlockSums blocks{(g.columns + per_block - 1) / per_block,
                     (g.rows + per_block - 1) / per_block,
                     static_cast<double>(per_block) * g.cell_m,
                     {}};
    blocks.sums.assign(blocks.columns * blocks.rows, 0.0);
    for (std::size_t row = 0; row < g.rows && !stop.stop_requested(); ++row) {
        for (std::size_t column = 0; column < g.columns; ++column) {
            const std::size_t cell = row * g.columns + column;
            if (!counts(difference.heights_m[cell])) continue;
            blocks.sums[row / per_block * blocks.columns + column / per_block] +=
                errors.sigmas_m.size() == 1 ? errors.sigmas_m.front() : errors.sigmas_m[cell];
        }
    }
    const double common = errors.common_sigma_m * static_cast<double>(cells);
    return g.cell_m * g.cell_m *
           std::sqrt(pairSum(blocks, errors.correlation_range_m, stop) + common * common);
}

}  // namespace

Result<VolumeResult> volumeOf(const ElevationGrid& difference, const VolumeErrorModel& errors,
                              const std::stop_token& stop) {
    assert(errors.sigmas_m.size() == 1 || errors.sigmas_m.size() == difference.heights_m.size());
    const double cell_area_m2 = difference.geometry.cell_m * difference.geometry.cell_m;
    VolumeResult result;
    std::size_t above = 0, below = 0;
    for (std::size_t cell = 0; cell < difference.heights_m.size(); ++cell) {
        if (cell % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
        const float height = difference.heights_m[cell];
        if (std::isnan(height)) continue;
        ++result.cells;
        above += height > 0.0F ? 1 : 0;
        below += height < 0.0F ? 1 : 0;
        (height > 0.0F ? result.above : result.below).volume_m3 += std::abs(static_cast<double>(height));
    }
    for (VolumePart* const part : {&result.above, &result.below}) part->volume_m3 *= cell_area_m2;
    result.above.area_m2 = cell_area_m2 * static_cast<double>(above);
    result.below.area_m2 = cell_area_m2 * static_cast<double>(below);
    result.area_m2 = cell_area_m2 * static_cast<double>(result.cells);
    result.net_m3 = result.above.volume_m3 - result.below.volume_m3;
    result.above.sigma_m3 = sigmaOf(difference, errors, above, stop, [](float h) { return h > 0.0F; });
    result.below.sigma_m3 = sigmaOf(difference, errors, below, stop, [](float h) { return h < 0.0F; });
    result.net_sigma_m3 =
        sigmaOf(difference, errors, result.cells, stop, [](float h) { return !std::isnan(h); });
    if (stop.stop_requested()) return cancelled();
    return result;
}

}  // namespace terrawalk
