#include "mapping/terrace_edges.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "mapping/delaunay_tin.hpp"
#include "mapping/edge_strips.hpp"
#include "mapping/order_statistics.hpp"
#include "mapping/plan_cells.hpp"
#include "mapping/plan_kd_tree.hpp"
#include "mapping/point_order.hpp"
#include "mapping/riser_line.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kLeastPoints = 30;
constexpr double kPointsInWindow = 60.0;
constexpr double kMorePoints_pm2 = 4000.0;  // per variance of the heights: noise takes more points
constexpr double kGapsAlong = 5.0;          // to either side: lines of a walk on both sides of each place
constexpr double kGapsAcross = 2.0;
constexpr double kLeastReach_m = 1.2;
constexpr double kLeastAlong_m = 2.5;
constexpr double kGreatestAlong_m = 20.0;
constexpr double kLeastEvidence = 15.0;  // of a whole edge, by the information criterion

/// Spread of the heights about the plane through their nearest neighbours; robust, so that risers count
/// little.
double noiseOf(const std::vector<Vector3d>& points_m) {
    constexpr std::size_t kSamples = 2000, kNeighbours = 7;
    constexpr double kWithPlane = 1.5;  // root of 1 + 3 / 6 and what the ground itself adds, or so
    const PlanKdTree tree(points_m);
    std::vector<Neighbour> near;
    std::vector<double> offs;
    const std::size_t stride = std::max<std::size_t>(1, points_m.size() / kSamples);
    for (std::size_t i = 0; i < points_m.size(); i += stride) {
        tree.nearest(points_m[i].head<2>(), kNeighbours, near);
        Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
        Vector3d right = Vector3d::Zero();
        for (const Neighbour& neighbour : near) {
            if (neighbour.point == i) continue;
            const Vector3d d = points_m[neighbour.point] - points_m[i];
            const Vector3d row(1.0, d.x(), d.y());
            normal += row * row.transpose();
            right += d.z() * row;
        }
        offs.push_back(std::abs(normal.ldlt().solve(right)[0]));
    }
    return 1.4826 * median(std::move(offs)) / kWithPlane;
}

StepScale scaleOf(const DelaunayTin& tin, const std::vector<Vector3d>& points_m,
                  const TerraceEdgeOptions& options) {
    constexpr double kGapsInLongestEdge = 2.5;  // as longestEdgeLimit() has it
    constexpr double kGreatestNoise_m = 0.4, kLeastNoise_m = 0.03;
    const double gap_m = tin.longestEdge_m() / kGapsInLongestEdge;
    const double per_m2 = static_cast<double>(points_m.size()) / tin.area_m2();
    const double sigma_m = std::min(noiseOf(points_m), kGreatestNoise_m);
    const double wanted = kPointsInWindow + kMorePoints_pm2 * sigma_m * sigma_m;
    StepScale scale;
    scale.noise_m = std::max(sigma_m, kLeastNoise_m);
    // Half as long again along the riser as across it.
    scale.reach_m = std::clamp(std::max(kGapsAcross * gap_m, std::sqrt(wanted / (6.0 * per_m2))),
                               std::min(kLeastReach_m, options.greatest_reach_m), options.greatest_reach_m);
    scale.along_m = std::clamp(std::max(kGapsAlong * gap_m, wanted / (4.0 * scale.reach_m * per_m2)),
                               kLeastAlong_m, kGreatestAlong_m);
    return scale;
}

Result<void> check(const TerraceEdgeOptions& options) {
    for (const double value : {options.least_step_m, options.greatest_width_m, options.least_slope,
                               options.least_length_m, options.greatest_reach_m, options.metres_per_unit}) {
        if (!(value > 0.0) || !std::isfinite(value)) {
            return usageError("the least and greatest of a terrace edge must be above zero");
        }
    }
    return {};
}

Vector2d lowestCorner(const std::vector<Vector3d>& points_m) {
    Vector2d corner_m = points_m.front().head<2>();
    for (const Vector3d& point : points_m) corner_m = corner_m.cwiseMin(point.head<2>());
    return corner_m;
}

/// Clear places everywhere, the clearest first.
std::vector<RiserPlace> startsOf(const RiserSearch& search, const std::stop_token& stop) {
    const std::vector<Vector2d> places_m = search.cells.centres();
    std::vector<std::optional<RiserPlace>> seeds(places_m.size());
    parallelFor(places_m.size(), [&](std::size_t i) {
        if (!stop.stop_requested()) seeds[i] = clearStepAt(search, places_m[i]);
    });
    std::vector<RiserPlace> starts;
    for (const auto& seed : seeds) {
        if (seed) starts.push_back(*seed);
    }
    std::stable_sort(starts.begin(), starts.end(),
                     [](const RiserPlace& a, const RiserPlace& b) { return a.gain > b.gain; });
    return starts;
}

void scale(std::vector<Vector3d>& places_m, double factor) {
    for (Vector3d& place : places_m) place *= factor;
}

/// @param points  in curve order, no two at one place
Result<TerraceEdges> findInMetres(std::vector<Vector3d> points, const std::vector<Breakline>& lines,
                                  const TerraceEdgeOptions& options, Progress& progress,
                                  const std::stop_token& stop) {
    TerraceEdges result;
    PartialProgress triangulating(progress, 0.0, 0.2);
    const auto tin = DelaunayTin::build(points, {}, triangulating, stop);
    if (!tin) return tl::unexpected(tin.error());
    const StepScale scale = scaleOf(*tin, points, options);
    result.longest_edge_m = tin->longestEdge_m();

    const Vector2d origin_m = lowestCorner(points);
    for (Vector3d& point : points) point.head<2>() -= origin_m;
    const PlanCells cells(points, 0.6 * scale.reach_m);
    const RiserSearch search{cells, scale, std::clamp(0.25 * scale.along_m, 0.5, 1.5), options};
    progress.report(0.2, "looking for terrace edges");
    const std::vector<RiserPlace> starts = startsOf(search, stop);

    RiserPlaces covered(scale.reach_m), refused(scale.reach_m);
    EdgeStrips strips(*tin, origin_m, options, scale.along_m);
    for (const Breakline& line : lines) strips.keepClearOf(line);
    const OnGround on_ground = [&](const Vector2d& at_m) {
        return strips.onGround(at_m);
    };
    for (std::size_t i = 0; i < starts.size(); ++i) {
        if (stop.stop_requested()) return cancelled();
        progress.report(0.6 + 0.4 * static_cast<double>(i) / static_cast<double>(starts.size()),
                        "following terrace edges");
        const Vector2d& at_m = starts[i].frame.origin_m;
        if (covered.nearest(at_m, 0.7 * scale.reach_m) || refused.nearest(at_m, 0.4 * scale.reach_m)) {
            continue;
        }
        const std::vector<RiserPlace> line = riserThrough(search, starts[i], covered, stop);
        if (line.size() < 2) continue;
        const bool accepted = evidenceOf(line, search) >= kLeastEvidence;
        for (const RiserPlace& place : line) (accepted ? covered : refused).add(place);
        if (accepted) strips.add(prolonged(search, line, on_ground));
    }
    if (stop.stop_requested()) return cancelled();
    result.edges = strips.edges();
    return result;
}

}  // namespace

Result<TerraceEdges> findTerraceEdges(const std::vector<Vector3d>& points_m,
                                      const std::vector<Breakline>& lines, const TerraceEdgeOptions& options,
                                      Progress& progress, std::stop_token stop) {
    if (auto checked = check(options); !checked) return tl::unexpected(checked.error());
    if (auto checked = checkCoordinates(points_m); !checked) return tl::unexpected(checked.error());
    if (points_m.size() < kLeastPoints) return TerraceEdges{};
    std::vector<Vector3d> points = placedHeights(points_m, {}).points_m;
    if (options.metres_per_unit == 1.0)
        return findInMetres(std::move(points), lines, options, progress, stop);
    scale(points, options.metres_per_unit);
    std::vector<Breakline> scaled_lines = lines;
    for (Breakline& line : scaled_lines) scale(line.vertices_m, options.metres_per_unit);
    auto found = findInMetres(std::move(points), scaled_lines, options, progress, stop);
    if (!found) return found;
    const double units_per_metre = 1.0 / options.metres_per_unit;
    found->longest_edge_m *= units_per_metre;
    for (TerraceEdge& edge : found->edges) {
        scale(edge.toe_m, units_per_metre);
        scale(edge.top_m, units_per_metre);
        edge.length_m *= units_per_metre;
        edge.step_m *= units_per_metre;
        edge.location_sigma_m *= units_per_metre;
    }
    return found;
}

std::string_view name(TerraceEdgeUse use) {
    for (const auto& [known, text] : kTerraceEdgeUses) {
        if (known == use) return text;
    }
    return {};
}

std::vector<Breakline> softBreaklines(const std::vector<TerraceEdge>& edges) {
    std::vector<Breakline> lines;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        lines.push_back({edges[i].toe_m, BreaklineKind::Soft, fmt::format("edge {} toe", i + 1)});
        lines.push_back({edges[i].top_m, BreaklineKind::Soft, fmt::format("edge {} top", i + 1)});
    }
    return lines;
}

}  // namespace terrawalk
