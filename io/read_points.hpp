#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "io/coordinate_system.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// Ground heights from a file of any origin: x east, y north, z up, as they stand in the file.
struct ScatteredPoints {
    std::vector<Eigen::Vector3d> points;
    std::vector<double> sigmas;      ///< of the heights; empty where the file has none
    std::string crs;                 ///< as describeCrs() takes it; empty where the file has none
    std::optional<LengthUnit> unit;  ///< where the file tells one apart from its CRS
    std::size_t in_file = 0;         ///< points in the file
    std::vector<std::string> notes;  ///< what was left out or assumed, plain sentences
};

struct PointReadOptions {
    /// Classes of a LAS file that count; empty: ground (2) where the file has any, else all but noise.
    std::vector<int> las_classes;
};

/// Reads points by the file's extension:
/// .csv .txt .xyz  a table with comma, semicolon, tab or blanks; a header names x or e or easting, y or n or
///                 northing, z or h or u or height or elevation (or the Chinese names), and maybe sigma_z or
///                 sigma_v, each with an ending _m, [m], (m) that tells the unit, and so with ft and usft;
///                 without a header the first three columns. In a Chinese header X is north and Y east. The
///                 decimal sign is the dot, or the comma where it parts no columns and cannot part thousands
/// .las            LAS 1.0 to 1.4, formats 0 to 10, not compressed; withheld points are left out
/// .ply            text or binary, vertices with x, y, z
/// others          points of a vector file that GDAL reads (GeoPackage, Shapefile, GeoJSON, ...), heights
/// from
///                 the geometry or a field z, h, height or elevation
/// A table, PLY or vector file with a column `used`, such as Terrawalk writes, has 0 there for points that
/// are not ground: they are left out. Errors: BadData with file, line and cure; System; Cancelled.
[[nodiscard]] Result<ScatteredPoints> readPoints(const std::filesystem::path& file,
                                                 const PointReadOptions& options, Progress& progress,
                                                 std::stop_token stop);

}  // namespace terrawalk
