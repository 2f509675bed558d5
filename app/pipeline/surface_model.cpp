#include "app/pipeline/surface_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/coordinate_system.hpp"
#include "mapping/delaunay_tin.hpp"
#include "mapping/gridding.hpp"
#include "mapping/order_statistics.hpp"

namespace terrawalk {
namespace {

/// Denser points show a riser by themselves, and looking for it would take long.
constexpr std::size_t kMostPointsForEdges = 200'000;

bool hasBoundary(const std::vector<Breakline>& lines) {
    return std::any_of(lines.begin(), lines.end(),
                       [](const Breakline& line) { return line.kind == BreaklineKind::Boundary; });
}

bool seeksEdges(const SurfaceInput& input, const SurfaceModelOptions& options,
                std::vector<std::string>& notes) {
    if (options.terrace_edges == TerraceEdgeUse::Off) return false;
    if (options.method && !followsBreaklines(*options.method)) {
        notes.push_back(fmt::format("terrace edges are not looked for: method {} cannot follow them",
                                    name(*options.method)));
        return false;
    }
    if (input.points_m.size() > kMostPointsForEdges) {
        notes.push_back(
            fmt::format("terrace edges are not looked for among more than {} points", kMostPointsForEdges));
        return false;
    }
    return true;
}

Result<GroundTriangles> alongLines(const std::vector<Eigen::Vector3d>& points_m,
                                   const std::vector<Breakline>& lines, double longest_edge_m,
                                   Progress& progress, const std::stop_token& stop) {
    ConstrainedTinOptions options;
    options.longest_edge_m = longest_edge_m;
    auto tin = buildConstrainedTin(points_m, lines, options, progress, stop);
    if (!tin) return tl::unexpected(tin.error());
    const auto shared = std::make_shared<const ConstrainedTin>(std::move(*tin));
    GroundTriangles ground{shared->groundMesh(), shared->longest_edge_m, shared->area_m2, shared, {}, {}};
    if (shared->merged > 0) {
        ground.notes.push_back(fmt::format("{} points lay within {:g} of another or of a breakline",
                                           shared->merged, options.near_m));
    }
    return ground;
}

}  // namespace

Result<void> checkMethod(const SurfaceModelOptions& options, bool breaklines_given) {
    if (!breaklines_given || !options.method || followsBreaklines(*options.method)) return {};
    return usageError(fmt::format("method {} cannot follow breaklines", name(*options.method)),
                      "use linear or clough-tocher");
}

Error noPlaneCrs(const Error& of_crs, std::string_view what, const Eigen::AlignedBox2d& extent,
                 const std::filesystem::path& file) {
    const bool degrees =
        Eigen::AlignedBox2d(Eigen::Vector2d(-360, -90), Eigen::Vector2d(360, 90)).contains(extent);
    const bool json = file.extension() == ".geojson" || file.extension() == ".json";
    Error error = of_crs;
    error.file = file;
    error.message = fmt::format("the {} have x {:.9g} to {:.9g} and y {:.9g} to {:.9g}, which {}, but {}",
                                what, extent.min().x(), extent.max().x(), extent.min().y(), extent.max().y(),
                                degrees ? "could be degrees" : "are no degrees", of_crs.message);
    error.cure =
        json ? "GeoJSON that names no CRS counts as WGS 84: where its coordinates are those of a plane, "
               "name their CRS, e.g. with `ogr2ogr -a_srs EPSG:32649 new.gpkg old.geojson`; project "
               "degrees with `-t_srs`"
             : "project them first, e.g. with `ogr2ogr -t_srs`; where only the CRS is named wrong, "
               "`-a_srs` names another";
    return error;
}

Result<void> checkBreaklineCrs(const std::vector<Breakline>& lines, const std::string& lines_crs,
                               const std::string& points_crs, const std::filesystem::path& file) {
    if (lines_crs.empty()) return {};
    const auto own = describeCrs(lines_crs);
    if (!own) {
        Eigen::AlignedBox2d extent;
        for (const Breakline& line : lines) {
            for (const Eigen::Vector3d& vertex : line.vertices_m) extent.extend(vertex.head<2>());
        }
        return tl::unexpected(noPlaneCrs(own.error(), "breaklines", extent, file));
    }
    if (own->name == points_crs) return {};
    return badData(fmt::format("the breaklines are in {}, the points in {}", own->name, points_crs), file, 0,
                   "bring both to one CRS");
}

Result<GroundTriangles> triangulateGround(const SurfaceInput& input, const SurfaceModelOptions& options,
                                          Progress& progress, std::stop_token stop) {
    std::vector<std::string> notes;
    std::vector<Breakline> lines = input.breaklines;
    double longest_edge_m = options.longest_edge_m;
    std::vector<TerraceEdge> edges;
    PartialProgress looking(progress, 0.0, 0.7), triangulating(progress, 0.7, 1.0);
    if (seeksEdges(input, options, notes)) {
        TerraceEdgeOptions wanted;
        wanted.metres_per_unit = options.metres_per_unit;
        auto found = findTerraceEdges(input.points_m, input.breaklines, wanted, looking, stop);
        if (!found) return tl::unexpected(found.error());
        edges = std::move(found->edges);
        // The vertices of the edges are no survey: how far apart points may be, the points alone tell.
        const bool limit_from_points = longest_edge_m == 0.0 && !hasBoundary(input.breaklines);
        if (!edges.empty() && limit_from_points) longest_edge_m = found->longest_edge_m;
        const std::vector<Breakline> soft = softBreaklines(edges);
        lines.insert(lines.end(), soft.begin(), soft.end());
    }
    if (lines.empty()) {
        auto tin = triangulatePoints(input.points_m, {longest_edge_m}, triangulating, stop);
        if (!tin) return tl::unexpected(tin.error());
        return GroundTriangles{std::move(tin->mesh), tin->longest_edge_m, tin->area_m2, nullptr, {}, notes};
    }
    auto ground = alongLines(input.points_m, lines, longest_edge_m, triangulating, stop);
    if (!ground) return ground;
    ground->terrace_edges = std::move(edges);
    ground->notes.insert(ground->notes.begin(), notes.begin(), notes.end());
    return ground;
}

Result<MethodChoice> chooseMethod(const SurfaceInput& input, const GroundTriangles& ground,
                                  const SurfaceModelOptions& options, Progress& progress,
                                  std::stop_token stop) {
    MethodChoice choice{options.method.value_or(InterpolationMethod::Linear), std::nullopt, {}};
    if (options.method && !options.cross_validate) return choice;
    CrossValidationOptions judged;
    judged.seed = options.seed;
    if (options.method) {
        // A method that was named is judged beside the plain one.
        judged.methods = {InterpolationMethod::Linear};
        if (*options.method != InterpolationMethod::Linear) judged.methods.push_back(*options.method);
    } else if (!input.breaklines.empty()) {
        judged.methods = {InterpolationMethod::Linear, InterpolationMethod::CloughTocher};
    } else {
        judged.breaklines = softBreaklines(ground.terrace_edges);
    }
    auto validation =
        crossValidate(input.points_m, input.sigmas_m, options.interpolation, judged, progress, stop);
    // Nothing to choose by: what was named, or the plain surface.
    if (!validation && validation.error().kind == ErrorKind::BadData) {
        choice.note = "no cross-validation: " + validation.error().message;
        return choice;
    }
    if (!validation) return tl::unexpected(validation.error());
    if (!options.method) choice.method = validation->ranking.front();
    choice.validation = std::move(*validation);
    return choice;
}

std::string inWords(const VarianceScale& scale) {
    return fmt::format(
        "variance of the method: noise times {:.2f}, structure times {:.2f}, learnt from {} points left out",
        scale.noise, scale.structure, scale.left_out.n);
}

Result<GroundTriangles> groundFor(InterpolationMethod method, GroundTriangles ground,
                                  const SurfaceInput& input, const SurfaceModelOptions& options,
                                  Progress& progress, std::stop_token stop) {
    if (ground.terrace_edges.empty() || followsBreaklines(method)) return ground;
    SurfaceModelOptions without = options;
    without.terrace_edges = TerraceEdgeUse::Off;
    auto plain = triangulateGround(input, without, progress, std::move(stop));
    if (!plain) return plain;
    plain->notes.push_back(
        fmt::format("terrace edges found but not kept to: {}; method {}, which cannot follow them, "
                    "foretells points left out better than those that do",
                    ground.terrace_edges.size(), name(method)));
    return plain;
}

SurfaceModel::SurfaceModel(GroundTriangles ground, InterpolationMethod method,
                           std::unique_ptr<const HeightInterpolator> heights)
    : ground_(std::move(ground)),
      method_(method),
      heights_(std::move(heights)),
      locator_(std::make_unique<const LocatorOnDemand>()) {
    if (heights_) variance_scale_ = heights_->varianceScale();
}

Result<SurfaceModel> SurfaceModel::fit(const SurfaceInput& input, GroundTriangles ground,
                                       InterpolationMethod method, const SurfaceModelOptions& options,
                                       Progress& progress, std::stop_token stop) {
    if (method == InterpolationMethod::Linear) return SurfaceModel(std::move(ground), method, nullptr);
    InterpolationOptions interpolation = options.interpolation;
    interpolation.learn_variance = true;
    auto heights = ground.constrained ? fitInterpolator(method, ground.constrained, stop)
                                      : fitInterpolator(method, input.points_m, input.sigmas_m, interpolation,
                                                        progress, stop);
    if (!heights) return tl::unexpected(heights.error());
    return SurfaceModel(std::move(ground), method, std::move(*heights));
}

std::optional<double> SurfaceModel::heightAt(double x_m, double y_m) const {
    const std::optional<double> linear_m = locator_->of(ground_.mesh).heightAt(ground_.mesh, x_m, y_m);
    if (!linear_m || !heights_) return linear_m;
    const std::array<Eigen::Vector2d, 1> place{Eigen::Vector2d(x_m, y_m)};
    std::array<HeightEstimate, 1> estimate;
    heights_->estimate(place, estimate);
    if (!std::isfinite(estimate[0].height_m)) return std::nullopt;
    return estimate[0].height_m;
}

std::optional<FittedVariogram> SurfaceModel::variogram() const {
    return heights_ ? heights_->variogram() : std::nullopt;
}

std::optional<double> SurfaceModel::errorRange(const ElevationGrid& heights) const {
    return heights_ ? heights_->errorRange(heights) : std::nullopt;
}

Result<InterpolatedGrid> SurfaceModel::grid(const GridGeometry& geometry, Progress& progress,
                                            std::stop_token stop) const {
    PartialProgress masking(progress, 0.0, heights_ ? 0.2 : 1.0);
    auto within = rasterize(ground_.mesh, geometry, masking, stop);
    if (!within) return tl::unexpected(within.error());
    if (!heights_) return InterpolatedGrid{std::move(*within), {}};
    PartialProgress gridding(progress, 0.2, 1.0);
    return interpolateGrid(*heights_, geometry, within->heights_m, gridding, stop);
}

std::optional<VariogramSummary> summaryOf(const std::optional<FittedVariogram>& fitted) {
    if (!fitted) return std::nullopt;
    const Variogram& v = fitted->variogram;
    VariogramSummary summary{
        std::string(name(v.model)), v.nugget_m2, v.sill_m2, v.range_m, {}, fitted->pairs};
    if (v.model == VariogramModel::Power) summary.exponent = v.exponent;
    return summary;
}

TerraceEdgeSummary summaryOf(const std::vector<TerraceEdge>& edges) {
    TerraceEdgeSummary summary;
    summary.count = edges.size();
    if (edges.empty()) return summary;
    std::vector<double> steps_m, sigmas_m;
    for (const TerraceEdge& edge : edges) {
        summary.length_m += edge.length_m;
        steps_m.push_back(edge.step_m);
        sigmas_m.push_back(edge.location_sigma_m);
    }
    summary.median_step_m = median(std::move(steps_m));
    summary.median_location_sigma_m = median(std::move(sigmas_m));
    return summary;
}

std::optional<InterpolationComparison> comparisonOf(const std::optional<CrossValidation>& validation) {
    if (!validation) return std::nullopt;
    InterpolationComparison comparison;
    comparison.seed = validation->seed;
    for (const HoldOutResult& result : validation->results) {
        comparison.hold_outs.emplace_back(name(result.hold_out));
    }
    for (const InterpolationMethod method : validation->ranking) {
        comparison.ranking.emplace_back(name(method));
        const auto m = std::find(validation->methods.begin(), validation->methods.end(), method) -
                       validation->methods.begin();
        for (const HoldOutResult& result : validation->results) {
            const HoldOutScore& score = result.scores[static_cast<std::size_t>(m)];
            comparison.scores.push_back({std::string(name(method)), std::string(name(result.hold_out)),
                                         result.compared, score.rmse_m, score.mean_absolute_m,
                                         score.error95_m});
        }
    }
    return comparison;
}

}  // namespace terrawalk
