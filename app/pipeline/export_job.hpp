#pragma once

#include <array>
#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

enum class PointFormat { Las, Ply, Pcd, Csv, GeoPackage };
inline constexpr std::array<std::pair<PointFormat, std::string_view>, 5> kPointFormats{
    {{PointFormat::Las, "las"},
     {PointFormat::Ply, "ply"},
     {PointFormat::Pcd, "pcd"},
     {PointFormat::Csv, "csv"},
     {PointFormat::GeoPackage, "gpkg"}}};
enum class MeshFormat { Stl, LandXml, Dxf };
inline constexpr std::array<std::pair<MeshFormat, std::string_view>, 3> kMeshFormats{
    {{MeshFormat::Stl, "stl"}, {MeshFormat::LandXml, "landxml"}, {MeshFormat::Dxf, "dxf"}}};
enum class GridFormat { EsriAscii };
inline constexpr std::array<std::pair<GridFormat, std::string_view>, 1> kGridFormats{
    {{GridFormat::EsriAscii, "asc"}}};

/// Which results of a processed survey another program is to get, and in which formats.
struct ExportRequest {
    std::filesystem::path input;   ///< folder that `process` wrote
    std::filesystem::path output;  ///< folder; empty: INPUT-export
    std::vector<PointFormat> points;
    std::vector<MeshFormat> meshes;
    std::vector<GridFormat> grids;
    bool all_points = false;  ///< also those that were not used, with their reasons
};

struct ExportOutcome {
    ExportRequest request;
    std::size_t points = 0;           ///< written
    std::size_t points_unused = 0;    ///< of them
    std::size_t points_no_place = 0;  ///< without a range, so without a place; never written
    std::size_t triangles = 0;
    std::string crs;
    std::vector<std::filesystem::path> files;
};

/// Writes ground_points.*, surface.* and dem.* in the map frame of the survey. Each file replaces an earlier
/// one in one step. Errors: Usage when nothing was asked for; BadData; System; Cancelled.
[[nodiscard]] Result<ExportOutcome> exportResults(const ExportRequest& request, Progress& progress,
                                                  std::stop_token stop);

[[nodiscard]] std::string toText(const ExportOutcome& outcome);
[[nodiscard]] std::string toJson(const ExportOutcome& outcome);

}  // namespace terrawalk
