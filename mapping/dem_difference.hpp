#pragma once

#include <vector>

#include "mapping/volume.hpp"
#include "survey/elevation_grid.hpp"

namespace terrawalk {

/// How the ground changed from one survey to another, cell by cell.
struct DemDifference {
    ElevationGrid change;  ///< later less earlier; NaN where either is unknown
    /// +1 raised and -1 lowered beyond 1.96 sigma of the change (95 %), 0 not so; NaN where there is no
    /// change.
    ElevationGrid significance;
    VolumeResult all;          ///< every cell with a change
    VolumeResult significant;  ///< the cells of +1 and -1 alone, a threshold that leaves out slow change
    std::size_t raised = 0;    ///< cells
    std::size_t lowered = 0;
};

/// Pure. Source of the threshold: Wheaton et al. 2010, "Accounting for uncertainty in DEMs from repeat
/// topographic surveys", with errors that both surveys share (common_sigma_m) counted in each cell.
/// Error: Cancelled.
/// @param later, earlier  on the same cells
/// @param errors          of the change: both surveys' variances together
[[nodiscard]] Result<DemDifference> demDifference(const ElevationGrid& later, const ElevationGrid& earlier,
                                                  const VolumeErrorModel& errors,
                                                  const std::stop_token& stop = {});

}  // namespace terrawalk
