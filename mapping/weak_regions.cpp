#include "mapping/weak_regions.hpp"

#include <algorithm>
#include <cmath>

namespace terrawalk {

namespace {

/// Marks the piece that holds the cell, and sums it up.
WeakRegion takePiece(const ElevationGrid& sigmas, double target, std::size_t first, std::int32_t label,
                     std::vector<std::int32_t>& labels) {
    const GridGeometry& g = sigmas.geometry;
    WeakRegion region;
    region.label = label;
    std::vector<std::size_t> open{first};
    labels[first] = label;
    const auto visit = [&](std::size_t cell) {
        if (labels[cell] != 0 || !(double{sigmas.heights_m[cell]} > target)) return;
        labels[cell] = label;
        open.push_back(cell);
    };
    double sum = 0.0, excess = 0.0;
    while (!open.empty()) {
        const std::size_t cell = open.back();
        open.pop_back();
        const double sigma = sigmas.heights_m[cell];
        ++region.cells;
        sum += sigma;
        excess += sigma * sigma - target * target;
        region.greatest_sigma = std::max(region.greatest_sigma, sigma);
        const std::size_t column = cell % g.columns;
        if (column > 0) visit(cell - 1);
        if (column + 1 < g.columns) visit(cell + 1);
        if (cell >= g.columns) visit(cell - g.columns);
        if (cell + g.columns < g.size()) visit(cell + g.columns);
    }
    const double cell_area = g.cell_m * g.cell_m;
    region.area = cell_area * static_cast<double>(region.cells);
    region.mean_sigma = sum / static_cast<double>(region.cells);
    region.gain = excess * cell_area;
    return region;
}

}  // namespace

WeakRegions weakRegions(const ElevationGrid& sigmas, const WeakRegionOptions& options) {
    WeakRegions found;
    found.labels.assign(sigmas.heights_m.size(), 0);
    std::int32_t label = 0;
    for (std::size_t cell = 0; cell < sigmas.heights_m.size(); ++cell) {
        if (found.labels[cell] != 0 || !(double{sigmas.heights_m[cell]} > options.target_sigma)) continue;
        found.regions.push_back(takePiece(sigmas, options.target_sigma, cell, ++label, found.labels));
    }
    std::vector<std::int32_t> ranks(static_cast<std::size_t>(label) + 1, 0);
    std::erase_if(found.regions, [&](const WeakRegion& r) { return r.area < options.least_area; });
    std::stable_sort(found.regions.begin(), found.regions.end(),
                     [](const WeakRegion& a, const WeakRegion& b) { return a.gain > b.gain; });
    for (std::size_t i = 0; i < found.regions.size(); ++i) {
        ranks[static_cast<std::size_t>(found.regions[i].label)] = static_cast<std::int32_t>(i) + 1;
        found.regions[i].label = static_cast<std::int32_t>(i) + 1;
    }
    for (std::int32_t& cell_label : found.labels) cell_label = ranks[static_cast<std::size_t>(cell_label)];
    return found;
}

}  // namespace terrawalk
