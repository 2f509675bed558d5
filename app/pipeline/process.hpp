#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "app/pipeline/config.hpp"
#include "app/pipeline/space_map.hpp"
#include "io/output_folder.hpp"
#include "mapping/surface_uncertainty.hpp"
#include "mapping/terrace_edges.hpp"
#include "survey/elevation_grid.hpp"
#include "survey/ground_point.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"
#include "survey/survey_report.hpp"
#include "survey/trajectory.hpp"
#include "survey/triangle_mesh.hpp"

namespace terrawalk {

/// Everything that one run of the pipeline makes, in memory.
struct Products {
    std::vector<Trajectory> trajectories;  ///< one for each run of the survey, in its order
    std::vector<std::vector<SensorInnovations>> innovations;  ///< of each run, from methods that filter
    std::vector<GroundPoint> ground_points;                   ///< of all runs, run by run; local ENU
    TriangleMesh surface;                                     ///< map frame
    ElevationGrid dem;                                        ///< map frame
    std::optional<SurfaceUncertainty> uncertainty;            ///< of the DEM, cell by cell
    std::vector<TerraceEdge> terrace_edges;                   ///< found in the points; map frame
    std::shared_ptr<const SpaceMap> space;                    ///< where it was asked for
    std::string crs_wkt2;
    SurveyReport report;
    PipelineConfig used;  ///< the configuration with every choice that the pipeline made filled in
};

/// The whole job, from a survey to its products; both programs call this and nothing else. Works on as many
/// threads as TBB allows; the result does not depend on their number. Errors: BadData, Cancelled.
[[nodiscard]] Result<Products> process(const Survey& survey, const PipelineConfig& config, Progress& progress,
                                       std::stop_token stop);

/// How the run was started, for the manifest.
struct Provenance {
    std::vector<std::string> command;  ///< arguments that decide the result, program name first
    std::optional<ReportLanguage> language = std::nullopt;  ///< where another is wanted than was configured
};

/// Writes dem.tif with its styles for QGIS, dem_uncertainty.tif, dem_density.tif, dem_source.tif,
/// surface.ply, surface.obj, terrace_edges.gpkg where any were found, the files of spaceWriters() where the
/// space was mapped, trajectory/*.csv, ground_points.csv,
/// residuals.csv, report.json, report.html, figures.txt and manifest.json. The caller commits the folder.
[[nodiscard]] Result<void> writeProducts(const Survey& survey, const Products& products,
                                         const Provenance& provenance, OutputFolder& folder,
                                         Progress& progress, std::stop_token stop);

/// Writes report.pdf alone, the same bytes as writeProducts(). Errors: as there.
[[nodiscard]] Result<void> writeReport(const Survey& survey, const Products& products,
                                       ReportLanguage language, const std::filesystem::path& file);

/// Writes heights and, as "STEM_uncertainty", their standard errors where there are any: dem.tif and
/// dem_uncertainty.tif under another name. Errors: as writeProducts().
[[nodiscard]] Result<void> writeSurface(const Survey& survey, const Products& products,
                                        const std::filesystem::path& file, std::stop_token stop);

/// The few lines that a person reads first: the files that matter and how good the surface is.
[[nodiscard]] std::string summaryText(const Products& products);

}  // namespace terrawalk
