#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "survey/elevation_grid.hpp"
#include "survey/ground_point.hpp"
#include "survey/result.hpp"
#include "survey/survey_report.hpp"
#include "survey/trajectory.hpp"
#include "survey/triangle_mesh.hpp"

namespace terrawalk {

/// What a DEM file says of itself beside the heights.
struct DemDescription {
    std::string crs_wkt2;
    std::string vertical_datum;  ///< metadata VERTICAL_DATUM
    std::string title;           ///< TIFFTAG_IMAGEDESCRIPTION
    std::string software;        ///< TIFFTAG_SOFTWARE
    std::vector<std::pair<std::string, std::string>> metadata;  ///< further items, e.g. METHOD
};

/// Writes a Cloud-Optimized GeoTIFF: Float32, nodata -9999, unit m, statistics, averaged overviews, everything
/// inside the file. The same grid gives the same bytes.
[[nodiscard]] Result<void> writeDem(const ElevationGrid& grid, const DemDescription& description,
                                    const std::filesystem::path& file);

/// Binary little-endian PLY, float offsets from the origin that its comment states (integer metres).
[[nodiscard]] Result<void> writePly(const TriangleMesh& mesh, const std::string& crs_name,
                                    const std::filesystem::path& file);
/// OBJ text, offsets from the origin that its comment states, 0.1 mm.
[[nodiscard]] Result<void> writeObj(const TriangleMesh& mesh, const std::string& crs_name,
                                    const std::filesystem::path& file);

[[nodiscard]] Result<void> writeTrajectoryCsv(const Trajectory& trajectory, const std::filesystem::path& file);
[[nodiscard]] Result<void> writeGroundPointsCsv(const std::vector<GroundPoint>& points,
                                                const std::vector<std::string>& run_ids,
                                                const std::filesystem::path& file);
[[nodiscard]] Result<void> writeResidualsCsv(const std::vector<Residual>& residuals,
                                             const std::filesystem::path& file);
[[nodiscard]] Result<void> writeReportJson(const SurveyReport& report, const std::filesystem::path& file);
/// One self-contained page, plots as SVG, readable without a network, in light and dark, and on paper.
[[nodiscard]] Result<void> writeReportHtml(const SurveyReport& report, const std::filesystem::path& file);

}  // namespace terrawalk
