#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "survey/contour.hpp"
#include "survey/elevation_grid.hpp"
#include "survey/ground_point.hpp"
#include "survey/result.hpp"
#include "survey/triangle_mesh.hpp"

namespace terrawalk {

// Formats for other programs. Every file replaces an earlier one in one step; the same input gives the same
// bytes; coordinates keep a millimetre or better at any map coordinate. Errors: BadData for content that the
// format cannot hold; System; Cancelled.

/// What the files say of themselves.
struct ExchangeDescription {
    std::string crs_wkt2;
    std::string crs_name;
    std::string title;
    std::string software;
    std::string date;  ///< YYYY-MM-DD on which the survey began; empty where it is not known
};

/// Binary STL: float offsets from the whole-metre origin that the 80 bytes of the header state.
[[nodiscard]] Result<void> writeStl(const TriangleMesh& mesh, const std::filesystem::path& file);
/// LandXML 1.2, one surface of type TIN, metric, points as north east height, 0.1 mm. Where the
/// survey has no date it is 1970-01-01, since the schema asks for one and no file of ours holds the time of
/// day.
[[nodiscard]] Result<void> writeLandXml(const TriangleMesh& mesh, const ExchangeDescription& description,
                                        const std::filesystem::path& file);
/// DXF R12 (AC1009), one 3DFACE for each triangle on layer "surface", 0.1 mm.
[[nodiscard]] Result<void> writeDxfFaces(const TriangleMesh& mesh, const std::filesystem::path& file);

/// A ground point in the map frame.
struct MapPoint {
    Eigen::Vector3d map_m = Eigen::Vector3d::Zero();
    double sigma_u_m = 0.0;
    double time_s = 0.0;  ///< since the start of the run's log
    std::uint32_t run = 0;
    GroundPointState state = GroundPointState::Used;
};
struct MapPoints {
    std::vector<MapPoint> points;      ///< finite places
    std::vector<std::string> run_ids;  ///< that MapPoint::run counts; empty: the points come from no walk
    std::string unit = "m";            ///< of places: m, ft or US-ft
};

/// LAS 1.4, point format 6, steps of 0.1 mm, the CRS as WKT. Used points are class 2 (ground), others class 1
/// and withheld; the point source is the run, counted from 1. A log's time is not GPS time: the field is 0,
/// and the extra bytes time_s (double) and sigma_z_m (float) hold what the log knows. The day of creation is
/// that of the survey, 0 where it is not known.
[[nodiscard]] Result<void> writeLas(const MapPoints& points, const ExchangeDescription& description,
                                    const std::filesystem::path& file, std::stop_token stop = {});
/// Binary PLY, float x y z as offsets from the origin that its comment states, float sigma_z, uchar used.
[[nodiscard]] Result<void> writePointsPly(const MapPoints& points, const ExchangeDescription& description,
                                          const std::filesystem::path& file, std::stop_token stop = {});
/// Binary PCD 0.7 with the same fields; the origin stands in a comment, because PCL reads doubles as zeros.
[[nodiscard]] Result<void> writePcd(const MapPoints& points, const ExchangeDescription& description,
                                    const std::filesystem::path& file, std::stop_token stop = {});
/// x_m,y_m,z_m,sigma_z_m,run,time_s,used,reason; 0.1 mm. Without run_ids the points come from no walk: x, y,
/// z, used and reason alone, with the ending of `unit` (_m, _ft or _usft).
[[nodiscard]] Result<void> writePointsCsv(const MapPoints& points, const std::filesystem::path& file,
                                          std::stop_token stop = {});
/// GeoPackage, layer ground_points of 3D points with the columns of the CSV table.
[[nodiscard]] Result<void> writePointsGeoPackage(const MapPoints& points,
                                                 const ExchangeDescription& description,
                                                 const std::filesystem::path& file,
                                                 std::stop_token stop = {});

/// Lines of equal height as 3D lines with elevation and `index` (every fifth). By the extension of the file:
/// .gpkg layer contours, .geojson, .dxf with layers contours, contours_index and contours_label.
/// @param label_height  of the text in DXF, in the unit of the map
[[nodiscard]] Result<void> writeContours(const std::vector<Contour>& contours, double label_height,
                                         const ExchangeDescription& description,
                                         const std::filesystem::path& file, std::stop_token stop = {});

/// A piece of ground and what is known of it.
struct MapRegion {
    std::int32_t label = 0;                              ///< of its cells, > 0
    std::vector<std::pair<std::string, double>> values;  ///< fields; of the same names for all regions
};
/// GeoPackage, layer regions: one multipolygon along the cells' sides for each region, with its label as
/// `rank` and its values. An empty list makes an empty layer.
/// @param labels  for each cell of the geometry the region's label, 0 for none
[[nodiscard]] Result<void> writeRegions(const GridGeometry& geometry, const std::vector<std::int32_t>& labels,
                                        const std::vector<MapRegion>& regions,
                                        const ExchangeDescription& description,
                                        const std::filesystem::path& file, std::stop_token stop = {});

/// ESRI ASCII grid, nodata -9999, and the CRS beside it as .prj. Heights as short as they read back exactly.
[[nodiscard]] Result<void> writeAsciiGrid(const ElevationGrid& grid, const std::string& crs_wkt2,
                                          const std::filesystem::path& file, std::stop_token stop = {});

}  // namespace terrawalk
