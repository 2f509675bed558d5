#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "survey/breakline.hpp"
#include "survey/elevation_grid.hpp"
#include "survey/ground_point.hpp"
#include "survey/result.hpp"
#include "survey/survey_report.hpp"
#include "survey/trajectory.hpp"
#include "survey/triangle_mesh.hpp"

namespace terrawalk {

/// Metadata item of a DEM: hash of the file of points that it was made from.
inline constexpr const char* kPointsSha256 = "POINTS_SHA256";
/// Of a raster of standard errors: range of the spherical correlogram of the errors, in the unit of the band.
inline constexpr const char* kCorrelationRange = "CORRELATION_RANGE";
/// Of a raster of standard errors: sha256OfHeights() of the DEM that they belong to.
inline constexpr const char* kHeightsSha256 = "HEIGHTS_SHA256";

/// How the cells of a raster are packed. Every program reads DEFLATE and bare cells; ZSTD, faster than
/// DEFLATE and larger by a tenth, needs a libtiff of 2018 or later that was built with it.
enum class RasterCompression : std::uint8_t { Deflate, Zstd, None };
inline constexpr std::array<std::pair<RasterCompression, std::string_view>, 3> kRasterCompressions{
    {{RasterCompression::Deflate, "deflate"},
     {RasterCompression::Zstd, "zstd"},
     {RasterCompression::None, "none"}}};
[[nodiscard]] constexpr std::string_view name(RasterCompression compression) {
    for (const auto& [value, text] : kRasterCompressions) {
        if (value == compression) return text;
    }
    return {};
}

/// How a raster lies in its file. The cells are the same, whatever is chosen.
struct RasterStorage {
    RasterCompression compression = RasterCompression::Deflate;
    bool overviews = true;  ///< smaller rasters in the file, which let programs draw it fast when zoomed out
};

/// What a DEM file says of itself beside the heights.
struct DemDescription {
    std::string crs_wkt2;                                       ///< as MapProjection::wkt2() gives it
    std::string vertical_datum;                                 ///< metadata VERTICAL_DATUM
    std::string title;                                          ///< TIFFTAG_IMAGEDESCRIPTION
    std::string software;                                       ///< TIFFTAG_SOFTWARE
    std::vector<std::pair<std::string, std::string>> metadata;  ///< further items, e.g. METHOD
    std::string quantity = "Elevation";                         ///< what the band holds
    std::string unit = "m";                                     ///< of the band: m, ft or US-ft
    /// Values name classes, 1 to 255: a file of bytes with 0 for none, and overviews show the most frequent.
    bool classes = false;
    RasterStorage storage = {};
};

/// Writes a Cloud-Optimized GeoTIFF: Float32, nodata -9999, statistics, averaged overviews unless left out,
/// everything inside the file; side files of an earlier raster of that name are removed. The same grid gives
/// the same bytes. The file is read again before it takes its place. A grid that is moved in is not copied.
/// Errors: BadData for a grid without any
/// height or with one that the file cannot hold, and for a CRS that GDAL does not know; System; Cancelled.
[[nodiscard]] Result<void> writeDem(ElevationGrid grid, const DemDescription& description,
                                    const std::filesystem::path& file, std::stop_token stop = {});
/// The same with a second band, the standard error of each height in the unit of the heights: elevation and
/// uncertainty in the order of the Bathymetry Attributed Grid (BAG).
/// @param sigmas  in the order of the cells; NaN where there is no height
[[nodiscard]] Result<void> writeDemWithUncertainty(ElevationGrid grid, std::vector<float> sigmas,
                                                   const DemDescription& description,
                                                   const std::filesystem::path& file,
                                                   std::stop_token stop = {});

/// Writes a GeoPackage with one layer of lines with heights; fields "name" and "kind", as readBreaklines()
/// takes them. The same lines give the same bytes. The file is read again before it takes its place. Errors:
/// System; Cancelled.
[[nodiscard]] Result<void> writeBreaklines(const std::vector<Breakline>& lines, const std::string& layer_name,
                                           const std::string& crs_wkt2, const std::filesystem::path& file,
                                           std::stop_token stop = {});

/// How QGIS shows a raster that it opens: as shaded relief, light from the north-west. Goes beside the raster
/// as NAME.qml, which QGIS reads by itself. Errors: System.
[[nodiscard]] Result<void> writeHillshadeStyle(const std::filesystem::path& file);
/// The same relief over heights in colours, which is two layers and so more than a style can say: a layer
/// definition (.qlr) to drag into QGIS, beside the raster. Errors: BadData for an empty ramp or range;
/// System.
/// @param dem_name  file name of the raster
/// @param ramp      colours from the lowest to the highest, at least two
[[nodiscard]] Result<void> writeShadedLayers(const std::string& dem_name, const std::string& crs_wkt2,
                                             double lowest, double highest,
                                             const std::vector<std::array<std::uint8_t, 3>>& ramp,
                                             const std::filesystem::path& file);

/// Binary little-endian PLY, float offsets from the origin that its comment states (integer metres). A float
/// steps by at most 0.5 mm within 8 km of the origin. Errors: BadData for a mesh without triangles; System.
[[nodiscard]] Result<void> writePly(const TriangleMesh& mesh, const std::string& crs_name,
                                    const std::filesystem::path& file);
/// OBJ text, offsets from the origin that its comment states, 0.1 mm. Errors as for writePly.
[[nodiscard]] Result<void> writeObj(const TriangleMesh& mesh, const std::string& crs_name,
                                    const std::filesystem::path& file);

/// One row for each epoch; heading clockwise from north, 0 <= heading < 360.
[[nodiscard]] Result<void> writeTrajectoryCsv(const Trajectory& trajectory,
                                              const std::filesystem::path& file);
/// One row for each point, used or not; a point without a range has no coordinates.
/// @param run_ids  names of the runs that the points count
[[nodiscard]] Result<void> writeGroundPointsCsv(const std::vector<GroundPoint>& points,
                                                const std::vector<std::string>& run_ids,
                                                const std::filesystem::path& file);
[[nodiscard]] Result<void> writeResidualsCsv(const std::vector<Residual>& residuals,
                                             const std::filesystem::path& file);
[[nodiscard]] Result<void> writeReportJson(const SurveyReport& report, const std::filesystem::path& file);
/// One self-contained page, plots as SVG, readable without a network, in light and dark, and on paper.
[[nodiscard]] Result<void> writeReportHtml(const SurveyReport& report, const std::filesystem::path& file);
/// The same page on paper (PDF), for who signs it.
[[nodiscard]] Result<void> writeReportPdf(const SurveyReport& report, const std::filesystem::path& file);

}  // namespace terrawalk
