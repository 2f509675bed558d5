#include "app/pipeline/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/pipeline/memory_need.hpp"
#include "app/pipeline/version.hpp"
#include "io/output_folder.hpp"
#include "io/read_breaklines.hpp"
#include "io/read_points.hpp"
#include "io/write_products.hpp"
#include "mapping/constrained_tin.hpp"
#include "mapping/delaunay_tin.hpp"
#include "mapping/gridding.hpp"

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

fs::path reportFile(const SurfaceRequest& request) {
    return beside(request.output, ".json");
}

Result<void> checkRequest(const SurfaceRequest& request) {
    for (const fs::path& input : {request.points, request.breaklines}) {
        for (const fs::path& output : {request.output, uncertaintyFile(request), reportFile(request)}) {
            std::error_code error;
            if (!fs::equivalent(input, output, error)) continue;
            return usageError(fmt::format("the output would replace {}", input.string()),
                              "choose another name for it");
        }
    }
    const bool follows = !request.method || *request.method == InterpolationMethod::Linear ||
                         *request.method == InterpolationMethod::CloughTocher;
    if (!request.breaklines.empty() && !follows) {
        return usageError(fmt::format("method {} cannot follow breaklines", name(*request.method)),
                          "use linear or clough-tocher");
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
    if (!crs) return crs;
    if (unit && *unit != crs->unit) {
        return badData(
            fmt::format("the points are in {}, but {} is in {}", unit->symbol, crs->name, crs->unit.symbol),
            request.points, 0, "name the CRS of these points");
    }
    if (!request.crs.empty() && !points.crs.empty()) {
        const auto own = describeCrs(points.crs);
        if (own && own->wkt2 != crs->wkt2) {
            notes.push_back(fmt::format("--crs replaces the file's own CRS, {}", own->name));
        }
    }
    return crs;
}

Result<CrossValidation> judge(const SurfaceRequest& request, const ScatteredPoints& points,
                              Progress& progress, const std::stop_token& stop) {
    CrossValidationOptions options;
    options.seed = request.seed;
    // A method that was named is judged beside the plain one.
    if (!request.breaklines.empty() && !request.method) {
        options.methods = {InterpolationMethod::Linear, InterpolationMethod::CloughTocher};
    } else if (request.method) {
        options.methods = {InterpolationMethod::Linear};
        if (*request.method != InterpolationMethod::Linear) options.methods.push_back(*request.method);
    }
    return crossValidate(points.points, points.sigmas, request.interpolation, options, progress, stop);
}

/// The triangles that count as ground, and with breaklines what the methods need of them.
struct Ground {
    TriangleMesh mesh;
    double longest_edge = 0.0;
    double area = 0.0;
    std::shared_ptr<const ConstrainedTin> constrained;  ///< null without breaklines
};

Result<std::vector<Breakline>> breaklinesOf(const SurfaceRequest& request, const CoordinateSystem& crs,
                                            Progress& progress, const std::stop_token& stop) {
    auto file = readBreaklines(request.breaklines, progress, stop);
    if (!file) return tl::unexpected(file.error());
    if (!file->crs.empty()) {
        const auto own = describeCrs(file->crs);
        if (!own) return tl::unexpected(own.error());
        if (own->name != crs.name) {
            return badData(fmt::format("the breaklines are in {}, the points in {}", own->name, crs.name),
                           request.breaklines, 0, "bring both to one CRS; --crs names that of the points");
        }
    }
    return std::move(file->lines);
}

Result<Ground> groundOf(const SurfaceRequest& request, const ScatteredPoints& points, SurfaceOutcome& report,
                        Progress& progress, const std::stop_token& stop) {
    if (request.breaklines.empty()) {
        const auto tin = DelaunayTin::build(points.points, {request.longest_edge}, progress, stop);
        if (!tin) return tl::unexpected(tin.error());
        return Ground{tin->mesh(), tin->longestEdge_m(), tin->area_m2(), nullptr};
    }
    const auto lines = breaklinesOf(request, report.crs, progress, stop);
    if (!lines) return tl::unexpected(lines.error());
    report.breaklines_used = lines->size();
    ConstrainedTinOptions options;
    options.longest_edge_m = request.longest_edge;
    auto tin = buildConstrainedTin(points.points, *lines, options, progress, stop);
    if (!tin) return tl::unexpected(tin.error());
    if (tin->merged > 0) {
        report.notes.push_back(fmt::format("{} points lay within {} {} of another or of a breakline",
                                           tin->merged, options.near_m, report.crs.unit.symbol));
    }
    const auto shared = std::make_shared<const ConstrainedTin>(std::move(*tin));
    return Ground{shared->groundMesh(), shared->longest_edge_m, shared->area_m2, shared};
}

Result<GridGeometry> geometryOf(const SurfaceRequest& request, const Ground& ground) {
    const double cell = request.resolution > 0.0
                            ? request.resolution
                            : suggestCellSize(ground.area, ground.mesh.vertices_m.size());
    if (!request.extent) return gridCovering(ground.mesh, cell);
    const auto& [west, south, east, north] = *request.extent;
    return gridCovering(GridExtent{west, south, east, north}, cell);
}

Result<InterpolatedGrid> gridBy(const SurfaceRequest& request, const ScatteredPoints& points,
                                InterpolationMethod method, const Ground& ground,
                                const GridGeometry& geometry, Progress& progress,
                                const std::stop_token& stop) {
    PartialProgress masking(progress, 0.0, 0.1);
    auto within = rasterize(ground.mesh, geometry, masking, stop);
    if (!within) return tl::unexpected(within.error());
    if (method == InterpolationMethod::Linear) return InterpolatedGrid{std::move(*within), {}};
    PartialProgress fitting(progress, 0.1, 0.4);
    const auto surface = ground.constrained ? fitInterpolator(method, ground.constrained)
                                            : fitInterpolator(method, points.points, points.sigmas,
                                                              request.interpolation, fitting, stop);
    if (!surface) return tl::unexpected(surface.error());
    PartialProgress gridding(progress, 0.4, 1.0);
    return interpolateGrid(**surface, geometry, within->heights_m, gridding, stop);
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

Result<void> writeFiles(const InterpolatedGrid& grid, SurfaceOutcome& report, const std::stop_token& stop) {
    const SurfaceRequest& request = report.request;
    DemDescription description{.crs_wkt2 = report.crs.wkt2,
                               .vertical_datum = report.crs.vertical_datum,
                               .title = fmt::format("{}, elevation", request.points.stem().string()),
                               .software = programVersion(),
                               .metadata = {{"METHOD", std::string(name(report.method))},
                                            {"POINTS", std::to_string(report.points_used)}},
                               .unit = report.crs.unit.symbol};
    report.files = {request.output};
    if (!grid.variances_m2.empty()) {
        report.files.push_back(uncertaintyFile(request));
    } else if (std::error_code error; fs::exists(uncertaintyFile(request), error)) {
        report.notes.push_back(fmt::format("{} does not belong to this DEM: method {} gives no uncertainty",
                                           uncertaintyFile(request).filename().string(),
                                           name(report.method)));
    }
    report.files.push_back(reportFile(request));
    if (auto done = writeDem(grid.heights, description, request.output, stop); !done) return done;
    if (!grid.variances_m2.empty()) {
        description.quantity = "Standard error of kriging";
        description.title = fmt::format("{}, standard error", request.points.stem().string());
        if (auto done = writeDem(standardErrors(grid), description, report.files[1], stop); !done)
            return done;
    }
    return writeTextFile(toJson(report), report.files.back());
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
    const auto points = readPoints(request.points, {request.las_classes}, reading, stop);
    if (!points) return tl::unexpected(points.error());
    SurfaceOutcome report;
    report.request = request;
    report.notes = points->notes;
    report.points_in_file = points->in_file;
    auto crs = coordinateSystemOf(request, *points, report.notes);
    if (!crs) return tl::unexpected(crs.error());
    report.crs = std::move(*crs);
    auto hash = sha256OfFile(request.points);
    if (!hash) return tl::unexpected(hash.error());
    report.points_sha256 = std::move(*hash);

    PartialProgress triangulating(progress, 0.2, 0.3);
    const auto ground = groundOf(request, *points, report, triangulating, stop);
    if (!ground) return tl::unexpected(ground.error());
    report.longest_edge = ground->longest_edge;
    report.points_used = points->points.size();
    const auto geometry = geometryOf(request, *ground);
    if (!geometry) return tl::unexpected(geometry.error());
    report.geometry = *geometry;

    // Before the long work: whether kriging, with its variances, will be chosen is not known yet.
    const bool variances = !request.method || *request.method == InterpolationMethod::Kriging;
    const MemoryNeed need{points->points.size(), geometry->size(), variances};
    report.memory_need_bytes = need.bytes();
    progress.message(
        Severity::Info,
        fmt::format("{} points, {} x {} cells of {} {}: about {} of memory", need.points, geometry->columns,
                    geometry->rows, geometry->cell_m, report.crs.unit.symbol, memoryText(need.bytes())));
    if (const auto available = availableMemory_bytes()) {
        if (auto fits = checkMemory(need, *available, geometry->cell_m); !fits)
            return tl::unexpected(fits.error());
    }

    report.method = request.method.value_or(InterpolationMethod::Linear);
    if (request.cross_validate || !request.method) {
        PartialProgress judging(progress, 0.3, 0.7);
        auto validation = judge(request, *points, judging, stop);
        if (!validation) return tl::unexpected(validation.error());
        if (!request.method) report.method = validation->ranking.front();
        report.validation = std::move(*validation);
        if (!request.breaklines.empty()) {
            report.notes.emplace_back("the cross-validation is of the points without the breaklines");
        }
    }
    PartialProgress gridding(progress, 0.7, 0.9);
    const auto grid = gridBy(request, *points, report.method, *ground, *geometry, gridding, stop);
    if (!grid) return tl::unexpected(grid.error());
    summarize(grid->heights, report);
    progress.report(0.9, "writing");
    if (auto done = writeFiles(*grid, report, stop); !done) return tl::unexpected(done.error());
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
        name(report.method), report.request.method ? "" : ", the best by cross-validation",
        report.geometry.columns, report.geometry.rows, report.geometry.cell_m, unit, report.cells_with_height,
        report.least_height, report.greatest_height, unit);
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
        {"breaklines", report.breaklines_used},
        {"crs", report.crs.name},
        {"vertical_datum", report.crs.vertical_datum},
        {"unit", report.crs.unit.symbol},
        {"method_requested", report.request.method ? std::string(name(*report.request.method)) : "auto"},
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
        {"seed", report.request.seed},
        {"notes", report.notes},
        {"files", files}};
    if (report.validation) document["cross_validation"] = validationJson(*report.validation);
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
