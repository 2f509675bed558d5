#include "app/pipeline/surface.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/pipeline/config.hpp"
#include "app/pipeline/memory_need.hpp"
#include "app/pipeline/version.hpp"
#include "io/output_folder.hpp"
#include "io/read_breaklines.hpp"
#include "io/read_dem.hpp"
#include "io/read_points.hpp"
#include "io/write_exchange.hpp"
#include "io/write_products.hpp"
#include "mapping/gridding.hpp"
#include "mapping/point_cleaning.hpp"
#include "mapping/thinning.hpp"

namespace terrawalk {
namespace {

namespace fs = std::filesystem;

fs::path beside(const fs::path& output, const std::string& ending) {
    fs::path path = output;
    path.replace_filename(output.stem().string() + ending);
    return path;
}

fs::path uncertaintyFile(const SurfaceRequest& request) {
    return beside(request.output, "_uncertainty.tif");
}

fs::path edgesFile(const SurfaceRequest& request) {
    return beside(request.output, "_terrace_edges.gpkg");
}

fs::path multibandFile(const SurfaceRequest& request) {
    return beside(request.output, "_multiband.tif");
}

fs::path pointsFile(const SurfaceRequest& request) {
    return beside(request.output, "_points.csv");
}

fs::path styleFile(const SurfaceRequest& request) {
    return beside(request.output, ".qml");
}

fs::path reportFile(const SurfaceRequest& request) {
    return beside(request.output, ".json");
}

Result<void> checkRequest(const SurfaceRequest& request) {
    for (const fs::path& input : {request.points, request.breaklines}) {
        for (const fs::path& output :
             {request.output, uncertaintyFile(request), multibandFile(request), edgesFile(request),
              pointsFile(request), styleFile(request), reportFile(request)}) {
            std::error_code error;
            if (!fs::equivalent(input, output, error)) continue;
            return usageError(fmt::format("the output would replace {}", input.string()),
                              "choose another name for it");
        }
    }
    if (auto fits = checkMethod(request.model, !request.breaklines.empty()); !fits) return fits;
    if (!(request.thinning_cell_m >= 0.0) || !std::isfinite(request.thinning_cell_m)) {
        return usageError("the cells to thin by may not be below zero");
    }
    if (const std::string ending = request.output.extension().string();
        ending != ".tif" && ending != ".tiff") {
        return usageError(fmt::format("the DEM is a GeoTIFF, and {} is no name for one",
                                      request.output.filename().string()),
                          "end the name in .tif; gdal_translate makes other formats of it");
    }
    if (!(request.resolution >= 0.0) || !std::isfinite(request.resolution)) {
        return usageError("the resolution may not be below zero");
    }
    return {};
}

/// The file's own CRS outranks none but a contradiction is an error, and so are two units.
Result<CoordinateSystem> coordinateSystemOf(const SurfaceRequest& request, const ScatteredPoints& points,
                                            std::vector<std::string>& notes) {
    std::optional<LengthUnit> unit = points.unit;
    if (!request.unit.empty()) {
        unit = lengthUnit(request.unit);
        if (!unit) return usageError(fmt::format("the unit {} is not known", request.unit), "m, ft or us-ft");
        if (points.unit && *points.unit != *unit) {
            return badData(fmt::format("the points are in {}, not in {}", points.unit->symbol, unit->symbol),
                           request.points, 0, "leave out --unit");
        }
    }
    const std::string& text = !request.crs.empty() ? request.crs : points.crs;
    if (text.empty()) {
        if (!unit) notes.emplace_back("the file names no unit: metres are assumed; --unit names another");
        notes.emplace_back("the points have no CRS, and so has the DEM; --crs names one");
        return localCoordinateSystem(unit.value_or(LengthUnit{"m", 1.0}));
    }
    auto crs = describeCrs(text);
    if (!crs && request.crs.empty()) {
        Eigen::AlignedBox2d extent;
        for (const Eigen::Vector3d& point : points.points) extent.extend(point.head<2>());
        return tl::unexpected(noPlaneCrs(crs.error(), "points", extent, request.points));
    }
    if (!crs) return crs;
    if (unit && *unit != crs->unit) {
        return badData(
            fmt::format("the points are in {}, but {} is in {}", unit->symbol, crs->name, crs->unit.symbol),
            request.points, 0,
            unit->symbol == "ft" && crs->unit.symbol == "US-ft"
                ? "_ft is the international foot: where they are in feet of US surveys, call the columns "
                  "x_usft, "
                  "y_usft and z_usft"
                : "name the CRS of these points, or their unit: _m is the metre, _ft the international foot, "
                  "_usft that of US surveys");
    }
    if (!request.crs.empty() && !points.crs.empty()) {
        const auto own = describeCrs(points.crs);
        if (own && own->wkt2 != crs->wkt2) {
            notes.push_back(fmt::format("--crs replaces the file's own CRS, {}", own->name));
        }
    }
    return crs;
}

Result<std::vector<Breakline>> breaklinesOf(const SurfaceRequest& request, const CoordinateSystem& crs,
                                            Progress& progress, const std::stop_token& stop) {
    auto file = readBreaklines(request.breaklines, progress, stop);
    if (!file) return tl::unexpected(file.error());
    if (auto same = checkBreaklineCrs(file->lines, file->crs, crs.name, request.breaklines); !same) {
        return tl::unexpected(same.error());
    }
    return std::move(file->lines);
}

/// Cleans and thins. What it takes are ground points in metres.
Result<void> cleanInput(const SurfaceRequest& request, double metres_per_unit, SurfaceInput& input,
                        SurfaceOutcome& report, Progress& progress, const std::stop_token& stop) {
    if (!request.cleaning.any() && request.thinning_cell_m == 0.0) return {};
    std::vector<GroundPoint> points(input.points_m.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].epoch = static_cast<std::uint32_t>(i);
        points[i].enu_m = metres_per_unit * input.points_m[i];
    }
    RadiusOutlierOptions& radius = report.cleaning.radius;
    if (radius.use) radius.radius_m = isolationRadius_m(points, radius);
    auto cleaned = cleanGroundPoints(std::move(points), report.cleaning, progress, stop);
    if (!cleaned) return tl::unexpected(cleaned.error());
    points = thinGroundPoints(std::move(*cleaned), request.thinning_cell_m);
    report.points_left_out = leftOutByReason(points);
    report.cleaned = MapPoints{{}, {}, report.crs.unit.symbol};
    for (std::size_t i = 0; i < points.size(); ++i) {
        report.cleaned->points.push_back({input.points_m[i], kMissing, 0.0, 0, points[i].state});
    }
    SurfaceInput kept{{}, {}, std::move(input.breaklines)};
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].state != GroundPointState::Used) continue;
        kept.points_m.push_back(input.points_m[i]);
        if (!input.sigmas_m.empty()) kept.sigmas_m.push_back(input.sigmas_m[i]);
    }
    if (kept.points_m.empty()) {
        std::string taken;
        for (const CountedReason& r : report.points_left_out) {
            taken += fmt::format("{}{}: {}", taken.empty() ? "" : ", ", r.reason, r.count);
        }
        return badData(fmt::format("cleaning left none of {} points ({})", input.points_m.size(), taken),
                       request.points, 0,
                       "leave out that filter: its distances do not fit points so far apart");
    }
    input = std::move(kept);
    return {};
}

Result<GridGeometry> geometryOf(const SurfaceRequest& request, const GroundTriangles& ground) {
    const double cell = request.resolution > 0.0
                            ? request.resolution
                            : suggestCellSize(ground.area_m2, ground.mesh.vertices_m.size());
    if (!request.extent) return gridCovering(ground.mesh, cell);
    const auto& [west, south, east, north] = *request.extent;
    return gridCovering(GridExtent{west, south, east, north}, cell);
}

/// "west,south,east,north" as --extent takes it.
std::string extentText(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : mesh.vertices_m) box.extend(vertex);
    return fmt::format("{:.2f},{:.2f},{:.2f},{:.2f}", box.min().x(), box.min().y(), box.max().x(),
                       box.max().y());
}

/// Points and surface end with this function: writing needs their memory.
Result<InterpolatedGrid> gridOf(SurfaceInput input, GroundTriangles ground, const GridGeometry& geometry,
                                InterpolationMethod method, const SurfaceModelOptions& options,
                                SurfaceOutcome& report, Progress& progress, const std::stop_token& stop) {
    PartialProgress fitting(progress, 0.0, 0.5), gridding(progress, 0.5, 1.0);
    const auto surface = SurfaceModel::fit(input, std::move(ground), method, options, fitting, stop);
    if (!surface) return tl::unexpected(surface.error());
    if (const auto& scale = surface->varianceScale()) report.notes.push_back(inWords(*scale));
    report.variogram = summaryOf(surface->variogram());
    if (method == InterpolationMethod::Linear) input = {};  // the triangles hold all of it
    auto grid = surface->grid(geometry, gridding, stop);
    if (grid) report.error_range = surface->errorRange(grid->heights);
    return grid;
}

void summarize(const ElevationGrid& grid, SurfaceOutcome& report) {
    report.least_height = std::numeric_limits<double>::infinity();
    report.greatest_height = -report.least_height;
    for (const float height : grid.heights_m) {
        if (std::isnan(height)) continue;
        ++report.cells_with_height;
        report.least_height = std::min(report.least_height, static_cast<double>(height));
        report.greatest_height = std::max(report.greatest_height, static_cast<double>(height));
    }
}

ElevationGrid standardErrors(const InterpolatedGrid& grid) {
    ElevationGrid errors{grid.heights.geometry, grid.variances_m2};
    for (float& value : errors.heights_m) value = std::sqrt(value);
    return errors;
}

/// A file of an earlier run would be taken for this one's.
void noteLeftOver(const fs::path& file, const std::string& reason, std::vector<std::string>& notes) {
    if (std::error_code error; fs::exists(file, error)) {
        notes.push_back(fmt::format("{} does not belong to this DEM: {}", file.filename().string(), reason));
    }
}

Result<void> writeFiles(InterpolatedGrid grid, const std::vector<TerraceEdge>& edges, SurfaceOutcome& report,
                        const std::stop_token& stop) {
    const SurfaceRequest& request = report.request;
    DemDescription description{.crs_wkt2 = report.crs.wkt2,
                               .vertical_datum = report.crs.vertical_datum,
                               .title = fmt::format("{}, elevation", request.points.stem().string()),
                               .software = programVersion(),
                               .metadata = {{"METHOD", std::string(name(report.method))},
                                            {"POINTS", std::to_string(report.points_used)},
                                            {kPointsSha256, report.points_sha256}},
                               .unit = report.crs.unit.symbol,
                               .storage = request.storage};
    report.files = {request.output};
    std::optional<ElevationGrid> errors;
    DemDescription of_errors = description;
    if (!grid.variances_m2.empty()) {
        errors = standardErrors(grid);
        of_errors.metadata.emplace_back(kHeightsSha256, sha256OfHeights(grid.heights));
        if (report.error_range) {
            of_errors.metadata.emplace_back(kCorrelationRange, fmt::format("{:.3f}", *report.error_range));
        }
    }
    if (request.multiband && errors) {
        report.files.push_back(multibandFile(request));
        if (auto done = writeDemWithUncertainty(grid.heights, errors->heights_m, of_errors,
                                                report.files.back(), stop);
            !done) {
            return done;
        }
    } else {
        const std::string why = request.multiband
                                    ? fmt::format("method {} gives no uncertainty", name(report.method))
                                    : "it was not asked for";
        if (request.multiband) report.notes.push_back("no multiband file: " + why + "; kriging does");
        noteLeftOver(multibandFile(request), why, report.notes);
    }
    if (auto done = writeDem(std::move(grid.heights), description, request.output, stop); !done) return done;
    if (auto done = writeHillshadeStyle(styleFile(request)); !done) return done;
    report.files.push_back(styleFile(request));
    if (!errors) {
        noteLeftOver(uncertaintyFile(request),
                     fmt::format("method {} gives no uncertainty", name(report.method)), report.notes);
    } else {
        of_errors.quantity = "Standard error of kriging";
        of_errors.title = fmt::format("{}, standard error", request.points.stem().string());
        report.files.push_back(uncertaintyFile(request));
        if (auto done = writeDem(std::move(*errors), of_errors, report.files.back(), stop); !done)
            return done;
    }
    if (report.cleaned) {
        report.files.push_back(pointsFile(request));
        if (auto done = writePointsCsv(*report.cleaned, report.files.back(), stop); !done) return done;
    } else {
        noteLeftOver(pointsFile(request), "no point was left out", report.notes);
    }
    if (edges.empty()) {
        noteLeftOver(edgesFile(request), "it keeps to no terrace edges", report.notes);
    } else {
        report.files.push_back(edgesFile(request));
        if (auto done = writeBreaklines(softBreaklines(edges), "terrace_edges", report.crs.wkt2,
                                        report.files.back(), stop);
            !done)
            return done;
    }
    report.files.push_back(reportFile(request));
    return writeTextFile(toJson(report), report.files.back());
}

nlohmann::ordered_json reasonsJson(const std::vector<CountedReason>& reasons) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const CountedReason& r : reasons) list.push_back({{"reason", r.reason}, {"count", r.count}});
    return list;
}

/// In the unit of the points, or its square.
nlohmann::ordered_json variogramJson(const VariogramSummary& v) {
    nlohmann::ordered_json document{
        {"model", v.model}, {"nugget", v.nugget_m2}, {"sill", v.sill_m2}, {"range", v.range_m}};
    if (v.exponent) document["exponent"] = *v.exponent;
    document["pairs"] = v.pairs;
    return document;
}

/// The filters as settings of a survey have them, in metres.
nlohmann::ordered_json cleaningJson(const PointCleaningOptions& cleaning) {
    PipelineConfig config;
    config.surface.cleaning = cleaning;
    return nlohmann::ordered_json::parse(toJson(config)).at("surface").at("clean");
}

nlohmann::ordered_json validationJson(const CrossValidation& validation) {
    nlohmann::ordered_json results = nlohmann::ordered_json::array();
    for (const HoldOutResult& result : validation.results) {
        nlohmann::ordered_json scores = nlohmann::ordered_json::array();
        for (std::size_t m = 0; m < result.scores.size(); ++m) {
            const HoldOutScore& score = result.scores[m];
            scores.push_back({{"method", name(validation.methods[m])},
                              {"rmse", score.rmse_m},
                              {"mean", score.mean_m},
                              {"mean_absolute", score.mean_absolute_m},
                              {"error95", score.error95_m}});
        }
        results.push_back({{"hold_out", name(result.hold_out)},
                           {"rounds", result.rounds},
                           {"points_compared", result.compared},
                           {"points_outside", result.outside},
                           {"scores", std::move(scores)}});
    }
    nlohmann::ordered_json ranking = nlohmann::ordered_json::array();
    for (const InterpolationMethod method : validation.ranking) ranking.push_back(name(method));
    return {{"points", validation.points}, {"folds", validation.folds}, {"block", validation.block_m},
            {"seed", validation.seed},     {"results", results},        {"ranking", ranking}};
}

std::string validationText(const CrossValidation& validation, const std::string& unit) {
    std::string text = fmt::format("Cross-validation, errors in {} (seed {}, blocks of {:.3g}):\n{:<20}",
                                   unit, validation.seed, validation.block_m, "");
    for (const HoldOutResult& result : validation.results)
        text += fmt::format("{:>28}", name(result.hold_out));
    text += fmt::format("\n{:<20}", "method");
    for (std::size_t i = 0; i < validation.results.size(); ++i) {
        text += fmt::format("{:>10}{:>9}{:>9}", "RMSE", "MAE", "95 %");
    }
    for (const InterpolationMethod method : validation.ranking) {
        text += fmt::format("\n{:<20}", name(method));
        const auto m =
            static_cast<std::size_t>(std::find(validation.methods.begin(), validation.methods.end(), method) -
                                     validation.methods.begin());
        for (const HoldOutResult& result : validation.results) {
            const HoldOutScore& score = result.scores[m];
            text += fmt::format("{:>10.4f}{:>9.4f}{:>9.4f}", score.rmse_m, score.mean_absolute_m,
                                score.error95_m);
        }
    }
    text += fmt::format("\n{:<20}", "points compared");
    for (const HoldOutResult& result : validation.results) text += fmt::format("{:>28}", result.compared);
    return text + "\n";
}

}  // namespace

Result<SurfaceOutcome> makeSurface(const SurfaceRequest& request, Progress& progress, std::stop_token stop) {
    if (auto checked = checkRequest(request); !checked) return tl::unexpected(checked.error());
    PartialProgress reading(progress, 0.0, 0.2);
    auto points = readPoints(request.points, {request.las_classes}, reading, stop);
    if (!points) return tl::unexpected(points.error());
    SurfaceOutcome report;
    report.request = request;
    report.cleaning = request.cleaning;
    report.notes = points->notes;
    report.points_in_file = points->in_file;
    auto crs = coordinateSystemOf(request, *points, report.notes);
    if (!crs) return tl::unexpected(crs.error());
    report.crs = std::move(*crs);
    auto hash = sha256OfFile(request.points);
    if (!hash) return tl::unexpected(hash.error());
    report.points_sha256 = std::move(*hash);

    SurfaceModelOptions model = request.model;
    model.metres_per_unit = report.crs.unit.metres;
    SurfaceInput input{std::move(points->points), std::move(points->sigmas), {}};
    if (!request.breaklines.empty()) {
        auto lines = breaklinesOf(request, report.crs, progress, stop);
        if (!lines) return tl::unexpected(lines.error());
        input.breaklines = std::move(*lines);
        report.breaklines_used = input.breaklines.size();
    }
    PartialProgress cleaning(progress, 0.2, 0.25);
    if (auto done = cleanInput(request, model.metres_per_unit, input, report, cleaning, stop); !done) {
        return tl::unexpected(done.error());
    }
    PartialProgress triangulating(progress, 0.25, 0.35);
    auto ground = triangulateGround(input, model, triangulating, stop);
    if (!ground) {
        Error error = ground.error();
        if (error.kind == ErrorKind::BadData && error.file.empty() && request.breaklines.empty()) {
            error.file = request.points;
            if (input.points_m.size() < 3) error.cure = "see whether this is the right file";
        }
        return tl::unexpected(std::move(error));
    }
    report.points_used = input.points_m.size();
    auto geometry = geometryOf(request, *ground);
    if (!geometry) return tl::unexpected(geometry.error());

    // Before the long work: whether kriging, with its variances, will be chosen is not known yet.
    const bool variances = !model.method || *model.method == InterpolationMethod::Kriging;
    const bool linear = model.method == InterpolationMethod::Linear && !model.cross_validate;
    const MemoryNeed need{input.points_m.size(), geometry->size(), variances, linear, request.multiband};
    report.memory_need_bytes = need.bytes();
    progress.message(
        Severity::Info,
        fmt::format("{} points, {} x {} cells of {} {}: about {} of memory", need.points, geometry->columns,
                    geometry->rows, geometry->cell_m, report.crs.unit.symbol, memoryText(need.bytes())));
    if (const auto available = availableMemory_bytes()) {
        if (auto fits = checkMemory(need, *available, geometry->cell_m); !fits)
            return tl::unexpected(fits.error());
    }

    PartialProgress judging(progress, 0.35, 0.7);
    auto choice = chooseMethod(input, *ground, model, judging, stop);
    if (!choice) return tl::unexpected(choice.error());
    SilentProgress silent;
    ground = groundFor(choice->method, std::move(*ground), input, model, silent, stop);
    if (!ground) return tl::unexpected(ground.error());
    geometry = geometryOf(request, *ground);
    if (!geometry) return tl::unexpected(geometry.error());
    report.geometry = *geometry;
    report.longest_edge = ground->longest_edge_m;
    report.terrace_edges = summaryOf(ground->terrace_edges);
    report.notes.insert(report.notes.end(), ground->notes.begin(), ground->notes.end());
    report.method = choice->method;
    report.validation = std::move(choice->validation);
    if (!choice->note.empty()) report.notes.push_back(choice->note);
    if (report.validation && ground->constrained && (model.method || !input.breaklines.empty())) {
        report.notes.emplace_back("the cross-validation is of the points without the breaklines");
    }
    const std::vector<TerraceEdge> edges = std::move(ground->terrace_edges);
    const std::string covered = extentText(ground->mesh);
    PartialProgress fitting(progress, 0.7, 0.9);
    auto grid =
        gridOf(std::move(input), std::move(*ground), *geometry, report.method, model, report, fitting, stop);
    if (!grid) return tl::unexpected(grid.error());
    summarize(grid->heights, report);
    if (report.cells_with_height == 0 && request.extent) {
        return badData("no cell of the extent lies on the surface", request.points, 0,
                       fmt::format("give an extent that overlaps {}", covered));
    }
    progress.report(0.9, "writing");
    if (auto done = writeFiles(std::move(*grid), edges, report, stop); !done)
        return tl::unexpected(done.error());
    progress.report(1.0, "done");
    return report;
}

std::string toText(const SurfaceOutcome& report) {
    const std::string& unit = report.crs.unit.symbol;
    std::string text = fmt::format(
        "Points      {} of {} in {}\nCRS         {}\nMethod      {}{}\nGrid        {} x {} cells of {} {}, "
        "{} with a "
        "height\nHeights     {:.3f} to {:.3f} {}\n",
        report.points_used, report.points_in_file, report.request.points.string(), report.crs.name,
        name(report.method), report.request.model.method ? "" : ", the best by cross-validation",
        report.geometry.columns, report.geometry.rows, report.geometry.cell_m, unit, report.cells_with_height,
        report.least_height, report.greatest_height, unit);
    for (const CountedReason& reason : report.points_left_out) {
        text += fmt::format("Left out    {} points: {}\n", reason.count, reason.reason);
    }
    if (const RadiusOutlierOptions& radius = report.cleaning.radius; radius.use) {
        text += fmt::format("Isolated    fewer than {} others within {:.3g} m\n", radius.least_neighbours,
                            radius.radius_m);
    }
    if (report.terrace_edges.count > 0) {
        text += fmt::format("Edges       {} terrace edges, {:.0f} {} long in all, median step {:.2f} {}\n",
                            report.terrace_edges.count, report.terrace_edges.length_m, unit,
                            report.terrace_edges.median_step_m, unit);
    }
    if (report.variogram) text += fmt::format("Variogram   {}\n", inWords(*report.variogram, unit));
    if (report.error_range) {
        text +=
            fmt::format("Errors      of heights hang together over {:.3g} {}\n", *report.error_range, unit);
    }
    if (report.validation) text += validationText(*report.validation, unit);
    for (const std::string& note : report.notes) text += "Note: " + note + "\n";
    for (const fs::path& file : report.files) text += "Written to " + file.string() + "\n";
    return text;
}

std::string toJson(const SurfaceOutcome& report) {
    const GridGeometry& g = report.geometry;
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const fs::path& file : report.files) files.push_back(file.filename().string());
    nlohmann::ordered_json document{
        {"format", "terrawalk-surface 1"},
        {"program", programVersion()},
        {"points_file", report.request.points.filename().string()},
        {"points_sha256", report.points_sha256},
        {"points_in_file", report.points_in_file},
        {"points_used", report.points_used},
        {"points_left_out", reasonsJson(report.points_left_out)},
        {"cleaning", cleaningJson(report.cleaning)},
        {"breaklines", report.breaklines_used},
        {"terrace_edges",
         {{"requested", name(report.request.model.terrace_edges)},
          {"count", report.terrace_edges.count},
          {"length", report.terrace_edges.length_m},
          {"median_step", report.terrace_edges.median_step_m},
          {"median_location_sigma", report.terrace_edges.median_location_sigma_m}}},
        {"crs", report.crs.name},
        {"vertical_datum", report.crs.vertical_datum},
        {"unit", report.crs.unit.symbol},
        {"method_requested",
         report.request.model.method ? std::string(name(*report.request.model.method)) : "auto"},
        {"method", name(report.method)},
        {"grid",
         {{"west", g.west_m},
          {"north", g.north_m},
          {"cell", g.cell_m},
          {"columns", g.columns},
          {"rows", g.rows},
          {"cells_with_height", report.cells_with_height}}},
        {"longest_edge", std::isfinite(report.longest_edge) ? nlohmann::ordered_json(report.longest_edge)
                                                            : nlohmann::ordered_json(nullptr)},
        {"least_height", report.least_height},
        {"greatest_height", report.greatest_height},
        {"compression", name(report.request.storage.compression)},
        {"overviews", report.request.storage.overviews},
        {"seed", report.request.model.seed},
        {"notes", report.notes},
        {"files", files}};
    if (report.variogram) document["variogram"] = variogramJson(*report.variogram);
    if (report.error_range) document["error_correlation_range"] = *report.error_range;
    if (report.validation) document["cross_validation"] = validationJson(*report.validation);
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
