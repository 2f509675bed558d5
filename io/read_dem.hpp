#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

#include "io/coordinate_system.hpp"
#include "survey/elevation_grid.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// The first band of a north-up raster, in the raster's own unit.
struct DemFile {
    ElevationGrid grid;
    CoordinateSystem crs;  ///< a local one in metres where the file has none
    /// Of the file of points that it was made from, where Terrawalk made it and wrote so; empty: not told.
    std::string points_sha256;
    /// Of standard errors that Terrawalk made: over which distance the errors hang together; 0: not told.
    double correlation_range = 0.0;
    /// The same: sha256OfHeights() of the DEM that they belong to; empty: not told.
    std::string heights_sha256;
};

/// Hash of all cells of a DEM, row by row, as 64 hexadecimal digits: the same for the grid and for any file
/// that holds it.
[[nodiscard]] std::string sha256OfHeights(const ElevationGrid& heights);
/// Whether standard errors may be those of a DEM: false where they say that they are of other heights.
[[nodiscard]] bool mayBelongTo(const DemFile& errors, const ElevationGrid& heights);

/// Reads any raster that GDAL reads. Errors: BadData for a file without raster, without place, turned, with
/// cells that are not square, or in a CRS that describeCrs() refuses; System when there is not enough memory;
/// Cancelled.
[[nodiscard]] Result<DemFile> readDem(const std::filesystem::path& file, std::stop_token stop);

}  // namespace terrawalk
