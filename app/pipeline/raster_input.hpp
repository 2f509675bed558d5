#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "io/read_dem.hpp"
#include "io/write_products.hpp"
#include "survey/elevation_grid.hpp"
#include "survey/result.hpp"

namespace terrawalk {

// What the commands that work on rasters share.

/// A raster on the DEM's own cells. Errors: as readDem(); BadData for other cells or another CRS.
[[nodiscard]] Result<ElevationGrid> readAlike(const std::filesystem::path& file, const DemFile& dem,
                                              const std::stop_token& stop);
/// The same of a raster of standard errors, with what it says of itself.
[[nodiscard]] Result<DemFile> readErrorsAlike(const std::filesystem::path& file, const DemFile& dem,
                                              const std::stop_token& stop);

/// One sigma of a surface's heights: a raster, or a single value where there is none.
struct SigmaSource {
    std::filesystem::path raster;
    double value = 0.0;
    const ElevationGrid* heights = nullptr;  ///< that they are given for; null: not looked at
};
struct CombinedSigmas {
    /// Root of the summed variances, for each cell; one for all cells where no raster tells them.
    std::vector<float> sigmas;
    double correlation_range = 0.0;  ///< the largest that a raster tells; 0 where none does
    /// Rasters whose standard errors say that they are of other heights than those they were given for.
    std::vector<std::filesystem::path> of_other_heights;
};
/// Of surfaces on the DEM's cells. Errors: BadData for a cell with a difference that has no sigma; Cancelled.
[[nodiscard]] Result<CombinedSigmas> combinedSigmas(const std::vector<SigmaSource>& sources,
                                                    const DemFile& dem, const ElevationGrid& difference,
                                                    const std::stop_token& stop);

/// A line for each of them, for the outcome of a command.
[[nodiscard]] std::string notesOn(const std::vector<std::filesystem::path>& of_other_heights);

/// Description of a raster that was made from a DEM.
[[nodiscard]] DemDescription describeDerived(const DemFile& dem, const std::string& title,
                                             const std::string& quantity, const std::string& unit,
                                             const std::string& method);

/// Error System when `work` would need more than nine tenths of the memory that can be had.
[[nodiscard]] Result<void> checkMemoryFor(std::string_view work, double need_bytes, std::string_view cure);
/// The same for work on the cells of a raster.
[[nodiscard]] Result<void> checkCellMemory(std::size_t cells, double bytes_per_cell, std::string_view work);

}  // namespace terrawalk
