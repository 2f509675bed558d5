#pragma once

#include <atomic>
#include <stop_token>
#include <string_view>

#include "survey/elevation_grid.hpp"
#include "survey/parallel.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// A grid of the same cells, each made by `cellValue(row, column)` on its own. Runs on all of TBB's threads;
/// the same bytes with any number of them. Errors: Cancelled.
template <class CellValue>
Result<ElevationGrid> gridOf(const GridGeometry& geometry, std::string_view step, Progress& progress,
                             const std::stop_token& stop, CellValue cellValue) {
    constexpr std::size_t kRowsAtOnce = 16;
    ElevationGrid grid{geometry, std::vector<float>(geometry.size(), kNoHeight)};
    std::atomic<std::size_t> rows_done{0};
    parallelRanges(geometry.rows, kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
        if (stop.stop_requested()) return;
        for (std::size_t row = begin; row < end; ++row) {
            for (std::size_t column = 0; column < geometry.columns; ++column) {
                grid.heights_m[row * geometry.columns + column] = static_cast<float>(cellValue(row, column));
            }
        }
        rows_done += end - begin;
        progress.report(static_cast<double>(rows_done) / static_cast<double>(geometry.rows), step);
    });
    if (stop.stop_requested()) return cancelled();
    return grid;
}

}  // namespace terrawalk
