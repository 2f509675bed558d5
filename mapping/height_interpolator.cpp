#include "mapping/height_interpolator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>

#include "mapping/delaunay_tin.hpp"
#include "mapping/interpolators.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {
namespace {

constexpr double kWholeHull_m = 1e10;  // no edge between places on Earth is longer
constexpr std::size_t kCellsPerTask = 512;

Result<void> check(const InterpolationOptions& options) {
    if (options.idw_neighbours == 0 || options.kriging_neighbours == 0) {
        return usageError("a height needs at least one neighbour");
    }
    if (!(options.idw_power > 0.0) || !std::isfinite(options.idw_power)) {
        return usageError("the power of the inverse distance must be above zero");
    }
    if (!(options.b_spline_spacing >= 0.05) || !std::isfinite(options.b_spline_spacing)) {
        return usageError("the spacing of the B-spline's finest lattice must be at least 0.05");
    }
    return {};
}

Result<void> checkSigmas(const std::vector<Eigen::Vector3d>& points_m, const std::vector<double>& sigmas_m) {
    if (!sigmas_m.empty() && sigmas_m.size() != points_m.size()) {
        return usageError(
            fmt::format("{} sigmas were given for {} points", sigmas_m.size(), points_m.size()));
    }
    for (const double sigma_m : sigmas_m) {
        if (!(sigma_m >= 0.0) || !std::isfinite(sigma_m)) {
            return badData(fmt::format("a height's sigma of {} is none", sigma_m));
        }
    }
    return {};
}

Result<InterpolatorPointer> overTriangles(InterpolationMethod method,
                                          const std::vector<Eigen::Vector3d>& points_m, Progress& progress,
                                          const std::stop_token& stop) {
    auto tin = DelaunayTin::build(points_m, {kWholeHull_m}, progress, stop);
    if (!tin) return tl::unexpected(tin.error());
    // The mesh lives as long as the TIN that it is part of.
    const auto owner = std::make_shared<const DelaunayTin>(std::move(*tin));
    std::shared_ptr<const TriangleMesh> mesh(owner, &owner->mesh());
    if (method == InterpolationMethod::Linear) return makeLinear(std::move(mesh));
    if (method == InterpolationMethod::CloughTocher) return makeCloughTocher(std::move(mesh), {}, stop);
    return makeNaturalNeighbour(std::move(mesh), method == InterpolationMethod::SibsonC1, stop);
}

Result<InterpolatorPointer> fit(InterpolationMethod method, const std::vector<Eigen::Vector3d>& points_m,
                                const std::vector<double>& sigmas_m, const InterpolationOptions& options,
                                Progress& progress, const std::stop_token& stop) {
    switch (method) {
        case InterpolationMethod::Linear:
        case InterpolationMethod::NaturalNeighbour:
        case InterpolationMethod::SibsonC1:
        case InterpolationMethod::CloughTocher:
            return overTriangles(method, points_m, progress, stop);
        case InterpolationMethod::InverseDistance:
            return makeInverseDistance(placedHeights(points_m, {}).points_m, options.idw_neighbours,
                                       options.idw_power);
        case InterpolationMethod::Nearest:
            return makeNearest(placedHeights(points_m, {}).points_m);
        case InterpolationMethod::Kriging:
            return makeKriging(placedHeights(points_m, sigmas_m), options.kriging_neighbours,
                               options.learn_variance, progress, stop);
        case InterpolationMethod::BSpline:
            return makeBSpline(placedHeights(points_m, {}).points_m, options.b_spline_spacing, progress,
                               stop);
    }
    return usageError("no such method of interpolation");
}

}  // namespace

std::string_view name(InterpolationMethod method) {
    for (const auto& [candidate, text] : kInterpolationMethods) {
        if (candidate == method) return text;
    }
    return "unknown";
}

Result<InterpolatorPointer> fitInterpolator(InterpolationMethod method,
                                            const std::vector<Eigen::Vector3d>& points_m,
                                            const std::vector<double>& sigmas_m,
                                            const InterpolationOptions& options, Progress& progress,
                                            std::stop_token stop) {
    if (auto checked = check(options); !checked) return tl::unexpected(checked.error());
    if (auto checked = checkCoordinates(points_m); !checked) return tl::unexpected(checked.error());
    if (auto checked = checkSigmas(points_m, sigmas_m); !checked) return tl::unexpected(checked.error());
    if (points_m.empty()) return badData("there is no point to interpolate between");
    try {
        auto fitted = fit(method, points_m, sigmas_m, options, progress, stop);
        if (stop.stop_requested()) return cancelled();
        return fitted;
    } catch (const std::bad_alloc&) {
        return systemError(fmt::format("not enough memory to interpolate between {} points", points_m.size()),
                           {}, "thin the points");
    }
}

Result<InterpolatedGrid> interpolateGrid(const HeightInterpolator& surface, const GridGeometry& geometry,
                                         const std::vector<float>& wanted, Progress& progress,
                                         std::stop_token stop) {
    if (!wanted.empty() && wanted.size() != geometry.size()) {
        return usageError("the wanted cells are those of another grid");
    }
    try {
        InterpolatedGrid grid{{geometry, std::vector<float>(geometry.size(), kNoHeight)}, {}};
        if (surface.hasVariance()) grid.variances_m2.assign(geometry.size(), kNoHeight);
        const std::size_t tasks_per_row = (geometry.columns + kCellsPerTask - 1) / kCellsPerTask;
        const std::size_t task_count = tasks_per_row * geometry.rows;
        std::atomic<std::size_t> done = 0;
        // One part of one row each: where a walk over the triangles begins does not depend on the threads.
        parallelFor(task_count, [&](std::size_t task) {
            if (stop.stop_requested()) return;
            const std::size_t row = task / tasks_per_row;
            const std::size_t first = task % tasks_per_row * kCellsPerTask;
            const std::size_t end = std::min(first + kCellsPerTask, geometry.columns);
            std::vector<Eigen::Vector2d> places_m;
            std::vector<std::size_t> cells;
            for (std::size_t column = first; column < end; ++column) {
                const std::size_t cell = row * geometry.columns + column;
                if (!wanted.empty() && std::isnan(wanted[cell])) continue;
                places_m.emplace_back(geometry.centreX(column), geometry.centreY(row));
                cells.push_back(cell);
            }
            std::vector<HeightEstimate> estimates(places_m.size());
            surface.estimate(places_m, estimates);
            for (std::size_t i = 0; i < cells.size(); ++i) {
                grid.heights.heights_m[cells[i]] = static_cast<float>(estimates[i].height_m);
                if (!grid.variances_m2.empty()) {
                    grid.variances_m2[cells[i]] = static_cast<float>(estimates[i].variance_m2);
                }
            }
            progress.report(static_cast<double>(++done) / static_cast<double>(task_count), "gridding");
        });
        if (stop.stop_requested()) return cancelled();
        return grid;
    } catch (const std::bad_alloc&) {
        return systemError(
            fmt::format("not enough memory for a grid of {} x {} cells", geometry.columns, geometry.rows), {},
            "ask for a coarser resolution");
    }
}

}  // namespace terrawalk
