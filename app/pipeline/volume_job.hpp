#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

#include "mapping/volume.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// The volume between a DEM and a level plane or another DEM. Lengths in the unit of the DEM.
struct VolumeRequest {
    std::filesystem::path dem;
    std::optional<double> plane;                ///< its height; or
    std::filesystem::path against;              ///< the other DEM, on the same cells
    std::filesystem::path uncertainty;          ///< raster of one sigma for the DEM; empty: `sigma`
    std::filesystem::path against_uncertainty;  ///< and for the other
    double sigma = 0.0;                         ///< of a cell's height where no raster tells it
    /// Of height errors from cell to cell; nothing: what the rasters of sigmas tell, and 0 where none does.
    std::optional<double> correlation_range;
    double common_sigma = 0.0;  ///< of an error that all cells share
};

struct VolumeOutcome {
    VolumeRequest request;
    std::string unit;
    VolumeResult volume;
    double correlation_range = 0.0;  ///< that was used
    std::size_t cells_in_one = 0;    ///< with a height in one DEM and none in the other: left out
    std::vector<std::filesystem::path> of_other_heights;  ///< rasters of sigmas that say so of themselves
};

/// Errors: BadData for rasters that cannot be read, that have other cells or another CRS than the DEM, that
/// have no sigma where the DEM has a height, and for a DEM that shares no cell with the other; Usage for
/// neither or both of plane and other DEM and for sigmas below zero; Cancelled.
[[nodiscard]] Result<VolumeOutcome> measureVolume(const VolumeRequest& request, Progress& progress,
                                                  std::stop_token stop);

[[nodiscard]] std::string toText(const VolumeOutcome& outcome);
[[nodiscard]] std::string toJson(const VolumeOutcome& outcome);

}  // namespace terrawalk
