#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

#include "app/pipeline/process.hpp"
#include "mapping/dem_difference.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// Heights of a survey less earlier ones of the same ground, on the cells of its DEM.
struct HeightChange {
    std::string earlier;       ///< what it was compared with, in words or as a file's name
    DemDifference difference;  ///< significance by the sigmas of both, as if their errors were independent
    bool has_sigma = false;    ///< of the survey itself; without, every change counts as significant
    bool earlier_has_sigma = false;
    double median_m = 0.0;
    double rms_m = 0.0;
};

// Earlier heights are taken between their cell centres, bilinear, where the cells are others. Errors: BadData
// where no cell has a height in both; Cancelled. Pure but for the files that they read.

/// @param name  of the earlier results
[[nodiscard]] Result<HeightChange> changeSince(const Products& later, const Products& earlier,
                                               std::string name, const std::stop_token& stop);
/// Against a DEM, and the sigmas beside it where there is a raster of its name and "_uncertainty" that does
/// not say that it belongs to other heights. Errors also: BadData for a raster in another CRS, and as
/// readDem().
[[nodiscard]] Result<HeightChange> changeSince(const Products& later, const std::filesystem::path& earlier,
                                               const std::stop_token& stop);

}  // namespace terrawalk
