#pragma once

#include <stop_token>
#include <vector>

#include "survey/elevation_grid.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// To whom a cell hands its water.
enum class FlowRouting {
    /// The neighbour of steepest descent, one of eight (O'Callaghan and Mark 1984). Of equally steep ones the
    /// first counts, clockwise from the east. Valleys stay one cell wide.
    D8,
    /// The two neighbours that the steepest of eight triangular facets falls between, in parts by the angle
    /// (Tarboton 1997). Slopes show no stripes along the eight directions.
    DInfinity,
};

/// Where water gathers, on the cells of a DEM; none where the DEM has no height.
struct Drainage {
    /// Area that drains through the cell, its own included, unit squared; one for each routing asked for.
    std::vector<ElevationGrid> accumulations;
    ElevationGrid wet_depth;  ///< how deep water stands before it spills, in the DEM's unit; 0 where it flows
};

/// What drainageOf() takes at its peak with one routing, the heights not counted, and with each one more.
inline constexpr double kDrainageBytesPerCell = 40.0;
inline constexpr double kAccumulationBytesPerCell = 4.0;

/// Depressions are filled by the improved priority flood with a gradient of one step of a double (Barnes,
/// Lehman and Mulla 2014, algorithm 3), so that water leaves every flat; then each cell hands its water on.
/// Water leaves at the edge of the heights, beside cells without one too. Serial; the same bytes everywhere.
/// Errors: Cancelled.
[[nodiscard]] Result<Drainage> drainageOf(const ElevationGrid& heights,
                                          const std::vector<FlowRouting>& routings, Progress& progress,
                                          std::stop_token stop);

}  // namespace terrawalk
