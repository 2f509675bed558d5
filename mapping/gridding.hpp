#pragma once

#include <cstddef>
#include <stop_token>

#include "survey/elevation_grid.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/triangle_mesh.hpp"

namespace terrawalk {

/// Cells that one grid may have: 4 GB of heights.
inline constexpr std::size_t kGreatestCellCount = 1'000'000'000;

/// Cell size that the points can carry: the largest of 1, 2, 5 times a power of ten (..., 0.05, 0.1, 0.2,
/// 0.5, 1, 2, ...) [m] that is not above half the mean point spacing sqrt(area / points), two cells to a
/// spacing. Not below 0.01 m. Pure.
/// @param area_m2  that the surface covers, > 0
/// @param points   that carry it, > 0
[[nodiscard]] double suggestCellSize(double area_m2, std::size_t points);

/// The smallest grid over the mesh whose edges are integer multiples of the cell size. A vertex within a
/// millionth of a cell of such an edge counts as on it. The grid is half-open: a mesh that ends on a cell
/// edge gets no further column or row. Edges are computed from whole-number indices and do not drift. Pure.
/// Errors: Usage for a cell size that is not above zero; BadData for an empty mesh, and for more than
/// `greatest_cell_count` cells, with the cell size that would do as cure.
[[nodiscard]] Result<GridGeometry> gridCovering(const TriangleMesh& mesh, double cell_m,
                                                std::size_t greatest_cell_count = kGreatestCellCount);

/// A rectangle in plan.
struct GridExtent {
    double west_m = 0.0;
    double south_m = 0.0;
    double east_m = 0.0;
    double north_m = 0.0;
};
/// The same for a rectangle. Errors: also Usage for one without area.
[[nodiscard]] Result<GridGeometry> gridCovering(const GridExtent& extent, double cell_m,
                                                std::size_t greatest_cell_count = kGreatestCellCount);

/// Heights of the mesh at the cell centres by linear interpolation; NaN where no triangle is. A centre on an
/// edge or a vertex belongs to the surface, also at its border; a vertex within a millionth of a cell of a
/// centre's row or column counts as on it, so that points given on cell centres fill their own cells whatever
/// rounding their coordinates went through. Where triangles touch, the last of the mesh writes; they agree
/// but for rounding. Runs on all of TBB's threads; the same bytes with any number of them. Errors: System
/// when there is not enough memory; Cancelled.
/// @param mesh  triangles that do not overlap in plan, of any winding; finite coordinates
[[nodiscard]] Result<ElevationGrid> rasterize(const TriangleMesh& mesh, const GridGeometry& geometry,
                                              Progress& progress, std::stop_token stop);

}  // namespace terrawalk
