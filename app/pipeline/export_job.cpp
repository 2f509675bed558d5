#include "app/pipeline/export_job.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/pipeline/survey_output.hpp"
#include "app/pipeline/version.hpp"
#include "io/read_dem.hpp"
#include "io/read_ground_points.hpp"
#include "io/read_mesh.hpp"
#include "io/write_exchange.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

fs::path outputOf(const ExportRequest& request) {
    if (!request.output.empty()) return request.output;
    fs::path input = request.input;
    if (!input.has_filename()) input = input.parent_path();
    return input += "-export";
}

template <class Enum, std::size_t n>
std::string_view nameIn(const std::array<std::pair<Enum, std::string_view>, n>& names, Enum value) {
    for (const auto& [known, text] : names) {
        if (known == value) return text;
    }
    return {};
}

Result<MapPoints> mapPoints(const ExportRequest& request, const SurveyOutput& survey, ExportOutcome& outcome,
                            Progress& progress, const std::stop_token& stop) {
    auto table = readGroundPointsCsv(request.input / "ground_points.csv", progress, stop);
    if (!table) return tl::unexpected(table.error());
    MapPoints mapped;
    mapped.run_ids = std::move(table->run_ids);
    for (const GroundPoint& point : table->points) {
        const bool used = point.state == GroundPointState::Used;
        if (!point.enu_m.allFinite()) {
            ++outcome.points_no_place;
            continue;
        }
        if (!used && !request.all_points) continue;
        const auto map_m = survey.projection.toMap(point.enu_m);
        if (!map_m) return tl::unexpected(map_m.error());
        mapped.points.push_back({*map_m, point.sigma_u_m, point.time_s, point.run, point.state});
        outcome.points_unused += used ? 0 : 1;
        if (mapped.points.size() % 4096 == 0 && stop.stop_requested()) return cancelled();
    }
    outcome.points = mapped.points.size();
    return mapped;
}

Result<void> writePoints(PointFormat format, const MapPoints& points, const ExchangeDescription& description,
                         const fs::path& file, const std::stop_token& stop) {
    switch (format) {
        case PointFormat::Las:
            return writeLas(points, description, file, stop);
        case PointFormat::Ply:
            return writePointsPly(points, description, file, stop);
        case PointFormat::Pcd:
            return writePcd(points, description, file, stop);
        case PointFormat::Csv:
            return writePointsCsv(points, file, stop);
        case PointFormat::GeoPackage:
            return writePointsGeoPackage(points, description, file, stop);
    }
    return usageError("no such format");
}

Result<void> writeMesh(MeshFormat format, const TriangleMesh& mesh, const ExchangeDescription& description,
                       const fs::path& file) {
    switch (format) {
        case MeshFormat::Stl:
            return writeStl(mesh, file);
        case MeshFormat::LandXml:
            return writeLandXml(mesh, description, file);
        case MeshFormat::Dxf:
            return writeDxfFaces(mesh, file);
    }
    return usageError("no such format");
}

}  // namespace

Result<ExportOutcome> exportResults(const ExportRequest& request, Progress& progress, std::stop_token stop) {
    if (request.points.empty() && request.meshes.empty() && request.grids.empty()) {
        return usageError("nothing to export", "name formats with --points, --mesh or --dem");
    }
    const auto survey = openSurveyOutput(request.input);
    if (!survey) return tl::unexpected(survey.error());
    ExportOutcome outcome{request};
    outcome.crs = survey->projection.name();
    const fs::path folder = outputOf(request);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return systemError("cannot make the folder: " + error.message(), folder);
    const ExchangeDescription description{survey->projection.wkt2(), survey->projection.name(),
                                          survey->survey, programVersion(), survey->date};
    const auto fileFor = [&](std::string_view name, std::string_view extension) {
        outcome.files.push_back(folder / fmt::format("{}.{}", name, extension));
        progress.report(0.3, "writing " + outcome.files.back().filename().string());
        return outcome.files.back();
    };
    if (!request.points.empty()) {
        PartialProgress reading(progress, 0.0, 0.3);
        const auto points = mapPoints(request, *survey, outcome, reading, stop);
        if (!points) return tl::unexpected(points.error());
        for (const PointFormat format : request.points) {
            const fs::path file = fileFor("ground_points", nameIn(kPointFormats, format));
            if (auto done = writePoints(format, *points, description, file, stop); !done) {
                return tl::unexpected(done.error());
            }
        }
    }
    if (!request.meshes.empty()) {
        PartialProgress reading(progress, 0.3, 0.4);
        const auto mesh = readMeshPly(request.input / "surface.ply", reading, stop);
        if (!mesh) return tl::unexpected(mesh.error());
        outcome.triangles = mesh->triangles.size();
        for (const MeshFormat format : request.meshes) {
            if (stop.stop_requested()) return cancelled();
            const bool xml = format == MeshFormat::LandXml;
            const fs::path file = fileFor("surface", xml ? "xml" : nameIn(kMeshFormats, format));
            if (auto done = writeMesh(format, *mesh, description, file); !done) {
                return tl::unexpected(done.error());
            }
        }
    }
    if (!request.grids.empty()) {
        const auto dem = readDem(request.input / "dem.tif", stop);
        if (!dem) return tl::unexpected(dem.error());
        const fs::path file = fileFor("dem", "asc");
        if (auto done = writeAsciiGrid(dem->grid, description.crs_wkt2, file, stop); !done) {
            return tl::unexpected(done.error());
        }
    }
    progress.report(1.0, "done");
    return outcome;
}

std::string toText(const ExportOutcome& outcome) {
    std::string text = fmt::format("CRS         {}\n", outcome.crs);
    if (!outcome.request.points.empty()) {
        text += fmt::format("Points      {}", outcome.points);
        if (outcome.request.all_points) text += fmt::format(", {} of them not used", outcome.points_unused);
        text += fmt::format("; {} without a range have no place\n", outcome.points_no_place);
    }
    if (!outcome.request.meshes.empty()) text += fmt::format("Triangles   {}\n", outcome.triangles);
    for (const fs::path& file : outcome.files) text += "Written to " + printable(file.string()) + "\n";
    return text;
}

std::string toJson(const ExportOutcome& outcome) {
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const fs::path& file : outcome.files) files.push_back(file.string());
    const nlohmann::ordered_json document{{"format", "terrawalk-export 1"},
                                          {"input", outcome.request.input.string()},
                                          {"crs", outcome.crs},
                                          {"points", outcome.points},
                                          {"points_not_used", outcome.points_unused},
                                          {"points_without_place", outcome.points_no_place},
                                          {"triangles", outcome.triangles},
                                          {"files", files}};
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
