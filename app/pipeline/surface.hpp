#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "app/pipeline/surface_model.hpp"
#include "io/coordinate_system.hpp"
#include "io/write_exchange.hpp"
#include "io/write_products.hpp"
#include "mapping/cross_validation.hpp"
#include "mapping/point_cleaning.hpp"
#include "survey/elevation_grid.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// A DEM from points of any origin. Lengths are in the unit of the points.
struct SurfaceRequest {
    std::filesystem::path points;
    std::filesystem::path output;                 ///< GeoTIFF
    PointCleaningOptions cleaning;                ///< in metres, whatever the points are in
    double thinning_cell_m = 0.0;                 ///< the same; one point stands for each cell; 0: all points
    SurfaceModelOptions model;                    ///< its unit is that of the points
    double resolution = 0.0;                      ///< 0: from the point spacing
    std::optional<std::array<double, 4>> extent;  ///< xmin, ymin, xmax, ymax; nothing: all points
    std::filesystem::path breaklines;             ///< vector file; empty: none
    std::string crs;                              ///< where the file has none; empty: none
    std::string unit;                             ///< "m", "ft", "us-ft"; empty: by CRS or file, else metre
    std::vector<int> las_classes;
    bool multiband = false;  ///< heights and their standard errors in one file as well
    RasterStorage storage;   ///< of all rasters that are written
};

/// What was made, and how.
struct SurfaceOutcome {
    SurfaceRequest request;
    CoordinateSystem crs;
    std::size_t points_in_file = 0;
    std::size_t points_used = 0;
    PointCleaningOptions cleaning;               ///< as used: with the radius that was found
    std::vector<CountedReason> points_left_out;  ///< by cleaning and thinning
    std::optional<MapPoints> cleaned;            ///< every point, where there was cleaning or thinning
    std::size_t breaklines_used = 0;
    TerraceEdgeSummary terrace_edges;
    InterpolationMethod method = InterpolationMethod::Linear;
    GridGeometry geometry;
    double longest_edge = 0.0;
    std::size_t cells_with_height = 0;
    double least_height = 0.0;
    double greatest_height = 0.0;
    double memory_need_bytes = 0.0;
    std::optional<CrossValidation> validation;
    std::optional<VariogramSummary> variogram;  ///< of kriging
    std::optional<double> error_range;          ///< the same: its errors hang together over this distance
    std::vector<std::string> notes;
    std::vector<std::filesystem::path> files;
    std::string points_sha256;
};

/// Reads the points, judges the methods, grids, and writes OUTPUT, with kriging OUTPUT's stem +
/// "_uncertainty.tif" (standard error), and if asked for both in "_multiband.tif"; OUTPUT's stem + ".qml",
/// how QGIS shows it; with cleaning or thinning "_points.csv", every point with the reason that left it out;
/// and OUTPUT's stem + ".json", the report. Cells outside the triangles within the longest edge stay empty,
/// whatever the method. Without a method the first of the ranking is taken. Memory is told before the grid is
/// made. Errors: as the steps; System when the memory does not suffice; Cancelled. Terrace edges that were
/// found are written to OUTPUT's stem + "_terrace_edges.gpkg". Each file appears whole or not at all, the
/// report last.
[[nodiscard]] Result<SurfaceOutcome> makeSurface(const SurfaceRequest& request, Progress& progress,
                                                 std::stop_token stop);

[[nodiscard]] std::string toText(const SurfaceOutcome& report);
[[nodiscard]] std::string toJson(const SurfaceOutcome& report);

}  // namespace terrawalk
