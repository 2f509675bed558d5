#pragma once

#include <stop_token>

#include "survey/elevation_grid.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// Where water gathers, on the cells of a DEM; none where the DEM has no height.
struct Drainage {
    ElevationGrid accumulation;  ///< area that drains through the cell, its own included, unit squared
    ElevationGrid wet_depth;  ///< how deep water stands before it spills, in the DEM's unit; 0 where it flows
};

/// What drainageOf() takes at its peak, the heights not counted.
inline constexpr double kDrainageBytesPerCell = 40.0;

/// Depressions are filled by the improved priority flood with a gradient of one step of a double (Barnes,
/// Lehman and Mulla 2014, algorithm 3), so that water leaves every flat; then each cell hands its water to
/// the neighbour of steepest descent, D8 (O'Callaghan and Mark 1984). Water leaves at the edge of the
/// heights, beside cells without one too. Of equally steep neighbours the first counts, clockwise from the
/// east. Serial; the same bytes everywhere. Errors: Cancelled.
[[nodiscard]] Result<Drainage> drainageOf(const ElevationGrid& heights, Progress& progress,
                                          std::stop_token stop);

}  // namespace terrawalk
