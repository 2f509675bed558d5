#include "mapping/delaunay_tin.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <new>
#include <numeric>
#include <tuple>
#include <utility>

#include "mapping/delaunay_triangles.hpp"
#include "mapping/edge_limit.hpp"
#include "mapping/point_order.hpp"
#include "mapping/triangle_locator.hpp"

namespace terrawalk {

struct DelaunayTin::Surface {
    GroundMesh ground;
    LocatorOnDemand locator;
};

namespace {

// Exact predicates work on the coordinates as they stand and need no origin nearby.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PlanPoint = Kernel::Point_2;
using Triangle = std::array<std::uint32_t, 3>;

PlanPoint plan(const Eigen::Vector3d& point_m) {
    return {point_m.x(), point_m.y()};
}

/// A point off the line through the first and the last; nothing when there is none.
std::optional<std::size_t> findOffLine(const std::vector<Eigen::Vector3d>& points_m) {
    for (std::size_t i = 1; i + 1 < points_m.size(); ++i) {
        if (CGAL::orientation(plan(points_m.front()), plan(points_m[i]), plan(points_m.back())) !=
            CGAL::COLLINEAR) {
            return i;
        }
    }
    return std::nullopt;
}

TriangleExtent extentOf(const TriangleMesh& mesh, const Triangle& triangle) {
    const Eigen::Vector2d a = mesh.vertices_m[triangle[0]].head<2>();
    const Eigen::Vector2d b = mesh.vertices_m[triangle[1]].head<2>();
    const Eigen::Vector2d c = mesh.vertices_m[triangle[2]].head<2>();
    const Eigen::Vector2d ab = b - a;
    const Eigen::Vector2d ac = c - a;
    return {std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()})),
            0.5 * (ab.x() * ac.y() - ab.y() * ac.x())};
}

double limitFromPoints(const TriangleMesh& mesh) {
    std::vector<TriangleExtent> extents(mesh.triangles.size());
    std::transform(mesh.triangles.begin(), mesh.triangles.end(), extents.begin(),
                   [&](const Triangle& triangle) { return extentOf(mesh, triangle); });
    return longestEdgeLimit(extents, mesh.vertices_m.size());
}

/// Leaves out the triangles above the limit and then the vertices that none uses; orders stay.
TriangleMesh withinLimit(TriangleMesh mesh, double longest_edge_m) {
    std::vector<bool> used(mesh.vertices_m.size(), false);
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (extentOf(mesh, mesh.triangles[t]).longest_edge_m <= longest_edge_m) {
            mesh.triangles[kept++] = mesh.triangles[t];
            for (const std::uint32_t vertex : mesh.triangles[t]) {
                used[vertex] = true;
            }
        }
    }
    mesh.triangles.resize(kept);
    std::vector<std::uint32_t> new_index(mesh.vertices_m.size(), 0);
    std::uint32_t used_count = 0;
    for (std::size_t vertex = 0; vertex < mesh.vertices_m.size(); ++vertex) {
        if (used[vertex]) {
            mesh.vertices_m[used_count] = mesh.vertices_m[vertex];
            new_index[vertex] = used_count++;
        }
    }
    mesh.vertices_m.resize(used_count);
    for (Triangle& triangle : mesh.triangles) {
        for (std::uint32_t& vertex : triangle) {
            vertex = new_index[vertex];
        }
    }
    return mesh;
}

Result<TriangleMesh> delaunayMesh(const std::vector<Eigen::Vector3d>& points_m, Progress& progress,
                                  std::stop_token stop) {
    static constexpr auto kCure =
        "walk several lines beside one another, and look at why ground points were rejected";
    if (auto checked = checkCoordinates(points_m); !checked) {
        return tl::unexpected(checked.error());
    }
    if (points_m.size() > 0x7FFF'FFFFU) {
        return badData(fmt::format("{} ground points are more than a surface can hold", points_m.size()), {},
                       0, "thin the points");
    }
    TriangleMesh mesh;
    if (!points_m.empty()) {
        mesh.vertices_m = inCurveOrder(points_m);
        mergeSamePlaces(mesh.vertices_m);
    }
    if (mesh.vertices_m.size() < 3) {
        return badData(
            fmt::format("a surface needs at least three ground points at different places, there are {}",
                        mesh.vertices_m.size()),
            {}, 0, kCure);
    }
    if (stop.stop_requested()) {
        return cancelled();
    }
    const std::optional<std::size_t> off_line = findOffLine(mesh.vertices_m);
    if (!off_line) {
        return badData(fmt::format("all {} ground points lie on one straight line", mesh.vertices_m.size()),
                       {}, 0, kCure);
    }
    auto triangles = delaunayTriangles(mesh.vertices_m, *off_line, progress, stop);
    if (!triangles) {
        return tl::unexpected(triangles.error());
    }
    mesh.triangles = std::move(*triangles);
    return mesh;
}

}  // namespace

Result<GroundMesh> triangulatePoints(const std::vector<Eigen::Vector3d>& points_m, const TinOptions& options,
                                     Progress& progress, std::stop_token stop) {
    if (!(options.longest_edge_m >= 0.0)) {
        return usageError("the longest edge of the surface's triangles may not be below zero",
                          "give metres, or 0 to take it from the points");
    }
    try {
        Result<TriangleMesh> mesh = delaunayMesh(points_m, progress, stop);
        if (!mesh) {
            return tl::unexpected(mesh.error());
        }
        GroundMesh ground;
        ground.longest_edge_m =
            options.longest_edge_m > 0.0 ? options.longest_edge_m : limitFromPoints(*mesh);
        std::size_t within = 0;
        for (const Triangle& triangle : mesh->triangles) {
            const TriangleExtent extent = extentOf(*mesh, triangle);
            if (!(extent.longest_edge_m <= ground.longest_edge_m)) continue;
            ++within;
            ground.area_m2 += extent.area_m2;
        }
        if (within == 0) {
            return badData(fmt::format("no triangle between the ground points has all edges within {} m",
                                       ground.longest_edge_m),
                           {}, 0, "allow a longer edge, or 0 to take the limit from the points");
        }
        ground.mesh = within == mesh->triangles.size() ? std::move(*mesh)
                                                       : withinLimit(std::move(*mesh), ground.longest_edge_m);
        progress.report(1.0, "triangulating");
        return ground;
    } catch (const std::bad_alloc&) {
        return systemError(fmt::format("not enough memory to triangulate {} points", points_m.size()), {},
                           "thin the points");
    } catch (const CGAL::Failure_exception& failure) {
        return systemError(fmt::format("the triangulation failed: {}", failure.what()));
    }
}

DelaunayTin::DelaunayTin(std::shared_ptr<const Surface> surface) : surface_(std::move(surface)) {}

Result<DelaunayTin> DelaunayTin::build(const std::vector<Eigen::Vector3d>& points_m,
                                       const TinOptions& options, Progress& progress, std::stop_token stop) {
    auto ground = triangulatePoints(points_m, options, progress, std::move(stop));
    if (!ground) return tl::unexpected(ground.error());
    auto surface = std::make_shared<Surface>();
    surface->ground = std::move(*ground);
    return DelaunayTin(std::move(surface));
}

const TriangleMesh& DelaunayTin::mesh() const {
    return surface_->ground.mesh;
}
double DelaunayTin::longestEdge_m() const {
    return surface_->ground.longest_edge_m;
}
double DelaunayTin::area_m2() const {
    return surface_->ground.area_m2;
}

std::optional<double> DelaunayTin::heightAt(double x_m, double y_m) const {
    return surface_->locator.of(mesh()).heightAt(mesh(), x_m, y_m);
}

}  // namespace terrawalk
