#include "mapping/gridding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "survey/parallel.hpp"

namespace terrawalk {
namespace {

/// Share of a cell within which a coordinate counts as on a cell edge or centre line.
constexpr double kSnap = 1e-6;
constexpr double kGreatestIndex = 9.0e15;  // below 2^53: every index is exact in a double

double snapped(double cells) {
    const double nearest = std::round(cells);
    return std::abs(cells - nearest) < kSnap ? nearest : cells;
}

/// Cells per metre where that is a whole number (0.1 m: 10), else 0. Dividing by it is correctly rounded,
/// while 0.1 itself is not a tenth.
double wholeCellsPerMetre(double cell_m) {
    const double per_metre = std::round(1.0 / cell_m);
    return per_metre >= 1.0 && 1.0 / per_metre == cell_m ? per_metre : 0.0;
}

double indexOf(double coordinate_m, double cell_m) {
    const double per_metre = wholeCellsPerMetre(cell_m);
    return snapped(per_metre > 0.0 ? coordinate_m * per_metre : coordinate_m / cell_m);
}

double coordinateOf(double index, double cell_m) {
    const double per_metre = wholeCellsPerMetre(cell_m);
    return per_metre > 0.0 ? index / per_metre : index * cell_m;
}

/// The series 1, 2, 5, 10, ...: step 0 is 1 m, step -1 half a metre.
double cellSizeStep(int step) {
    static constexpr std::array<double, 3> kMantissas{1.0, 2.0, 5.0};
    const int exponent = step >= 0 ? step / 3 : (step - 2) / 3;
    const double mantissa = kMantissas[static_cast<std::size_t>(step - 3 * exponent)];
    // Negative powers by division: 5 / 100 is the double nearest to 0.05, 5 * 0.01 need not be.
    return exponent < 0 ? mantissa / std::pow(10.0, -exponent) : mantissa * std::pow(10.0, exponent);
}
constexpr int kFinestStep = -6;    // 0.01 m
constexpr int kCoarsestStep = 27;  // 10^9 m, beyond any map frame

struct PlanBox {
    double west = std::numeric_limits<double>::max();
    double east = std::numeric_limits<double>::lowest();
    double south = std::numeric_limits<double>::max();
    double north = std::numeric_limits<double>::lowest();
};

/// The finest cell size of the series with which a grid over the box has no more than so many cells.
double finestCellSizeWithin(const PlanBox& box, std::size_t greatest_cell_count) {
    int step = kFinestStep;
    while (step < kCoarsestStep && ((box.east - box.west) / cellSizeStep(step) + 2.0) *
                                           ((box.north - box.south) / cellSizeStep(step) + 2.0) >
                                       static_cast<double>(greatest_cell_count)) {
        ++step;
    }
    return cellSizeStep(step);
}

PlanBox planBox(const TriangleMesh& mesh) {
    PlanBox box;
    for (const Eigen::Vector3d& vertex : mesh.vertices_m) {
        box.west = std::min(box.west, vertex.x());
        box.east = std::max(box.east, vertex.x());
        box.south = std::min(box.south, vertex.y());
        box.north = std::max(box.north, vertex.y());
    }
    return box;
}

/// A vertex in cells: whole numbers are cell centres, columns to the east, rows to the south.
struct GridVertex {
    double column;
    double row;
    double height_m;
};

std::vector<GridVertex> gridVertices(const TriangleMesh& mesh, const GridGeometry& geometry) {
    std::vector<GridVertex> vertices(mesh.vertices_m.size());
    parallelFor(vertices.size(), [&](std::size_t i) {
        const Eigen::Vector3d& vertex = mesh.vertices_m[i];
        vertices[i] = {snapped((vertex.x() - geometry.west_m) / geometry.cell_m - 0.5),
                       snapped((geometry.north_m - vertex.y()) / geometry.cell_m - 0.5), vertex.z()};
    });
    return vertices;
}

/// The first and the last whole number in [low, high] that is an index below count; first > last when none
/// is.
struct IndexRange {
    std::int64_t first;
    std::int64_t last;
};
IndexRange indicesWithin(double low, double high, std::size_t count) {
    if (!(high >= 0.0 && low <= static_cast<double>(count - 1))) {
        return {0, -1};
    }
    // Clamped into the grid first: conversion truncates, which is floor for what is not negative.
    const double clamped_low = std::max(low, 0.0);
    auto first = static_cast<std::int64_t>(clamped_low);
    first += static_cast<double>(first) < clamped_low ? 1 : 0;
    return {first, static_cast<std::int64_t>(std::min(high, static_cast<double>(count - 1)))};
}

/// The same of rows, in half the memory: no grid has more than kGreatestCellCount of them.
struct RowRange {
    std::int32_t first;
    std::int32_t last;
};

RowRange rowsOf(const std::array<std::uint32_t, 3>& triangle, const std::vector<GridVertex>& vertices,
                std::size_t row_count) {
    const double a = vertices[triangle[0]].row;
    const double b = vertices[triangle[1]].row;
    const double c = vertices[triangle[2]].row;
    const IndexRange rows = indicesWithin(std::min({a, b, c}), std::max({a, b, c}), row_count);
    return {static_cast<std::int32_t>(rows.first), static_cast<std::int32_t>(rows.last)};
}

/// Rows of the grid that one task fills, and the triangles that touch them, in the order of the mesh.
struct RowBands {
    std::size_t rows_per_band = 32;
    std::vector<std::size_t> begins;  ///< band b: triangles[begins[b]] to triangles[begins[b + 1]]
    std::vector<std::uint32_t> triangles;
};

template <class Visit>
void visitBands(const std::vector<RowRange>& rows, std::size_t rows_per_band, Visit visit) {
    for (std::size_t t = 0; t < rows.size(); ++t) {
        if (rows[t].first <= rows[t].last) {
            const std::size_t last = static_cast<std::size_t>(rows[t].last) / rows_per_band;
            for (std::size_t band = static_cast<std::size_t>(rows[t].first) / rows_per_band; band <= last;
                 ++band) {
                visit(band, static_cast<std::uint32_t>(t));
            }
        }
    }
}

RowBands rowBands(const TriangleMesh& mesh, const std::vector<GridVertex>& vertices, std::size_t row_count) {
    std::vector<RowRange> rows(mesh.triangles.size());
    parallelFor(rows.size(),
                [&](std::size_t t) { rows[t] = rowsOf(mesh.triangles[t], vertices, row_count); });
    RowBands bands;
    // Tall triangles in many bands would fill the memory with lists: then higher bands.
    for (;; bands.rows_per_band *= 2) {
        bands.begins.assign((row_count + bands.rows_per_band - 1) / bands.rows_per_band + 1, 0);
        std::size_t entries = 0;
        visitBands(rows, bands.rows_per_band, [&](std::size_t band, std::uint32_t) {
            ++bands.begins[band + 1];
            ++entries;
        });
        if (entries <= 4 * rows.size() || bands.rows_per_band >= row_count) {
            break;
        }
    }
    const std::size_t band_count = bands.begins.size() - 1;
    for (std::size_t band = 0; band < band_count; ++band) {
        bands.begins[band + 1] += bands.begins[band];
    }
    bands.triangles.resize(bands.begins.back());
    std::vector<std::size_t> next(bands.begins.begin(), bands.begins.end() - 1);
    visitBands(rows, bands.rows_per_band,
               [&](std::size_t band, std::uint32_t t) { bands.triangles[next[band]++] = t; });
    return bands;
}

/// An edge from its northern end to its southern one: the same numbers from either side, so that the
/// triangles on an edge meet without crack or overlap.
struct Edge {
    const GridVertex* from;
    const GridVertex* to;
    double columns_per_row;

    Edge(const GridVertex& northern, const GridVertex& southern) : from(&northern), to(&southern) {
        const double rows = southern.row - northern.row;
        columns_per_row = rows > 0.0 ? (southern.column - northern.column) / rows : 0.0;
    }
    /// The column where the edge crosses a row that it reaches; exact at both ends.
    [[nodiscard]] double columnAt(double row) const {
        return row == to->row ? to->column : from->column + (row - from->row) * columns_per_row;
    }
};

struct RowSpan {
    std::size_t first;
    std::size_t end;
};

void fillTriangle(const std::array<std::uint32_t, 3>& triangle, const std::vector<GridVertex>& vertices,
                  RowSpan band, ElevationGrid& grid) {
    std::array<const GridVertex*, 3> corner{&vertices[triangle[0]], &vertices[triangle[1]],
                                            &vertices[triangle[2]]};
    // From north to south, without branches: the order is as good as random.
    const auto sort = [](const GridVertex*& a, const GridVertex*& b) {
        const GridVertex* northern = b->row < a->row ? b : a;
        const GridVertex* southern = b->row < a->row ? a : b;
        a = northern;
        b = southern;
    };
    sort(corner[0], corner[1]);
    sort(corner[1], corner[2]);
    sort(corner[0], corner[1]);
    const auto first = static_cast<double>(band.first);
    const auto last = static_cast<double>(band.end - 1);
    const IndexRange rows =
        indicesWithin(std::max(corner[0]->row, first), std::min(corner[2]->row, last), grid.geometry.rows);
    const double row_extent = corner[2]->row - corner[0]->row;
    if (rows.first > rows.last || row_extent == 0.0) {
        return;  // flat along one row: its neighbours hold the centres on its edges
    }

    const Edge whole(*corner[0], *corner[2]);
    const Edge upper(*corner[0], *corner[1]);
    const Edge lower(*corner[1], *corner[2]);
    const double whole_metres_per_row = (corner[2]->height_m - corner[0]->height_m) / row_extent;
    // Heights run from the edge that spans all rows, with the slope along a row, taken where the triangle is
    // widest. No centre is farther from that edge than the width there, so that even a sliver gives nothing
    // but heights between its corners. A width of nothing holds no centre but one on the edge itself.
    const auto whole_height = [&](double row) {
        return corner[0]->height_m + (row - corner[0]->row) * whole_metres_per_row;
    };
    const double width = corner[1]->column - whole.columnAt(corner[1]->row);
    const double metres_per_column =
        std::abs(width) > kSnap ? (corner[1]->height_m - whole_height(corner[1]->row)) / width : 0.0;

    for (std::int64_t row = rows.first; row <= rows.last; ++row) {
        const auto at = static_cast<double>(row);
        const double edge = whole.columnAt(at);
        const double other = (at <= corner[1]->row ? upper : lower).columnAt(at);
        const double height_m = whole_height(at);
        float* row_m = grid.heights_m.data() + static_cast<std::size_t>(row) * grid.geometry.columns;
        const IndexRange columns =
            indicesWithin(std::min(edge, other), std::max(edge, other), grid.geometry.columns);
        for (std::int64_t column = columns.first; column <= columns.last; ++column) {
            row_m[column] =
                static_cast<float>(height_m + (static_cast<double>(column) - edge) * metres_per_column);
        }
    }
}

constexpr double kLeastCell_m = 0.001;

Result<GridGeometry> gridOver(const PlanBox& box, double cell_m, std::size_t greatest_cell_count) {
    if (!(cell_m >= kLeastCell_m) || !std::isfinite(cell_m)) {
        return usageError(fmt::format("a cell of {} m is none", cell_m),
                          "ask for a resolution of a millimetre or more");
    }
    const double west = std::floor(indexOf(box.west, cell_m));
    const double east = std::max(std::ceil(indexOf(box.east, cell_m)), west + 1.0);
    const double south = std::floor(indexOf(box.south, cell_m));
    const double north = std::max(std::ceil(indexOf(box.north, cell_m)), south + 1.0);
    const double columns = east - west;
    const double rows = north - south;
    const double greatest_index =
        std::max({std::abs(west), std::abs(east), std::abs(south), std::abs(north)});
    if (!(columns * rows <= static_cast<double>(greatest_cell_count)) ||
        !(greatest_index <= kGreatestIndex)) {
        return badData(
            fmt::format("cells of {} m make a grid of {:.0f} x {:.0f}, above the limit of {} cells", cell_m,
                        columns, rows, greatest_cell_count),
            {}, 0,
            fmt::format("ask for a resolution of {} m or coarser, or look for stray points far from the "
                        "others",
                        finestCellSizeWithin(box, greatest_cell_count)));
    }
    GridGeometry geometry;
    geometry.cell_m = cell_m;
    geometry.west_m = coordinateOf(west, cell_m);
    geometry.north_m = coordinateOf(north, cell_m);
    geometry.columns = static_cast<std::size_t>(columns);
    geometry.rows = static_cast<std::size_t>(rows);
    return geometry;
}

}  // namespace

double suggestCellSize(double area_m2, std::size_t points) {
    assert(area_m2 > 0.0 && points > 0);
    const double spacing = std::sqrt(area_m2 / static_cast<double>(points));
    int step = kFinestStep;
    while (step < kCoarsestStep && cellSizeStep(step + 1) <= 0.5 * spacing) {
        ++step;
    }
    return cellSizeStep(step);
}

Result<GridGeometry> gridCovering(const TriangleMesh& mesh, double cell_m, std::size_t greatest_cell_count) {
    if (mesh.vertices_m.empty()) {
        return badData("there is no surface to make a grid of");
    }
    return gridOver(planBox(mesh), cell_m, greatest_cell_count);
}

Result<GridGeometry> gridCovering(const GridExtent& extent, double cell_m, std::size_t greatest_cell_count) {
    if (!(extent.east_m > extent.west_m) || !(extent.north_m > extent.south_m)) {
        return usageError("the extent has no area",
                          "give xmin,ymin,xmax,ymax with xmin < xmax and ymin < ymax");
    }
    return gridOver({extent.west_m, extent.east_m, extent.south_m, extent.north_m}, cell_m,
                    greatest_cell_count);
}

Result<ElevationGrid> rasterize(const TriangleMesh& mesh, const GridGeometry& geometry, Progress& progress,
                                std::stop_token stop) {
    constexpr std::size_t kTrianglesBetweenChecks = 16384;
    try {
        ElevationGrid grid{geometry, std::vector<float>(geometry.size(), kNoHeight)};
        if (geometry.size() == 0 || mesh.triangles.empty()) {
            return grid;
        }
        const std::vector<GridVertex> vertices = gridVertices(mesh, geometry);
        const RowBands bands = rowBands(mesh, vertices, geometry.rows);
        const std::size_t band_count = bands.begins.size() - 1;
        std::atomic<std::size_t> bands_done = 0;
        parallelFor(band_count, [&](std::size_t band) {
            const RowSpan span{band * bands.rows_per_band,
                               std::min((band + 1) * bands.rows_per_band, geometry.rows)};
            for (std::size_t entry = bands.begins[band]; entry < bands.begins[band + 1]; ++entry) {
                if ((entry - bands.begins[band]) % kTrianglesBetweenChecks == 0 && stop.stop_requested()) {
                    return;
                }
                fillTriangle(mesh.triangles[bands.triangles[entry]], vertices, span, grid);
            }
            progress.report(static_cast<double>(++bands_done) / static_cast<double>(band_count), "gridding");
        });
        if (stop.stop_requested()) {
            return cancelled();
        }
        return grid;
    } catch (const std::bad_alloc&) {  // TBB passes it on from its threads
        return systemError(
            fmt::format("not enough memory for a grid of {} x {} cells", geometry.columns, geometry.rows), {},
            "ask for a coarser resolution");
    }
}

}  // namespace terrawalk
