#include "mapping/triangle_walk.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace terrawalk {
namespace {

/// Share of an edge's length by which a place may lie outside the border and still count as on it.
constexpr double kOnBorder = 1e-9;

/// One side of one triangle, kept with the lower of its two vertices.
struct Side {
    std::uint32_t higher;
    std::uint32_t triangle;
    std::uint32_t corner;  ///< that it faces
};

/// Twice the area of (a, b, place), positive when the place lies left of the edge.
double leftOf(const Eigen::Vector3d& a_m, const Eigen::Vector3d& b_m, const Eigen::Vector2d& place_m) {
    return (a_m.x() - place_m.x()) * (b_m.y() - place_m.y()) -
           (a_m.y() - place_m.y()) * (b_m.x() - place_m.x());
}

}  // namespace

TriangleWalk::TriangleWalk(const TriangleMesh& mesh)
    : mesh_(&mesh),
      across_(mesh.triangles.size(), {kNoTriangle, kNoTriangle, kNoTriangle}),
      triangle_at_(mesh.vertices_m.size(), kNoTriangle) {
    std::vector<std::size_t> begins(mesh.vertices_m.size() + 1, 0);
    const auto visitSides = [&](auto visit) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            for (std::uint32_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t a = mesh.triangles[t][(corner + 1) % 3];
                const std::uint32_t b = mesh.triangles[t][(corner + 2) % 3];
                visit(std::min(a, b), Side{std::max(a, b), t, corner});
            }
        }
    };
    visitSides([&](std::uint32_t lower, const Side&) { ++begins[lower + 1]; });
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<Side> sides(begins.back());
    std::vector<std::size_t> next(begins.begin(), begins.end() - 1);
    visitSides([&](std::uint32_t lower, const Side& side) { sides[next[lower]++] = side; });
    for (std::size_t vertex = 0; vertex + 1 < begins.size(); ++vertex) {
        const auto first = sides.begin() + static_cast<std::ptrdiff_t>(begins[vertex]);
        const auto last = sides.begin() + static_cast<std::ptrdiff_t>(begins[vertex + 1]);
        std::sort(first, last, [](const Side& p, const Side& q) {
            return p.higher != q.higher ? p.higher < q.higher : p.triangle < q.triangle;
        });
        for (auto side = first; side != last; ++side) {
            if (side + 1 == last || side->higher != (side + 1)->higher) continue;
            across_[side->triangle][side->corner] = (side + 1)->triangle;
            across_[(side + 1)->triangle][(side + 1)->corner] = side->triangle;
        }
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t vertex : mesh.triangles[t]) {
            if (triangle_at_[vertex] == kNoTriangle) triangle_at_[vertex] = t;
        }
    }
}

std::uint32_t TriangleWalk::startNear(const Eigen::Vector2d& place_m) const {
    assert(!mesh_->triangles.empty());
    // A cube root of the vertices to choose from leaves a walk of about as many steps.
    const std::size_t count = mesh_->vertices_m.size();
    const auto tries = static_cast<std::size_t>(std::cbrt(static_cast<double>(count))) + 1;
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t vertex = 0; vertex < count; vertex += std::max<std::size_t>(count / tries, 1)) {
        const double distance = (mesh_->vertices_m[vertex].head<2>() - place_m).squaredNorm();
        if (distance < least && triangle_at_[vertex] != kNoTriangle) {
            least = distance;
            best = vertex;
        }
    }
    return triangle_at_[best];
}

std::uint32_t TriangleWalk::locate(const Eigen::Vector2d& place_m, std::uint32_t& start) const {
    // Rounding could send a walk in circles, and a constrained triangulation can too: then look at all.
    const std::size_t most_steps = 1000 + mesh_->triangles.size() / 4;
    std::uint32_t triangle = start;
    for (std::size_t step = 0; step < most_steps; ++step) {
        start = triangle;
        const std::array<std::uint32_t, 3>& corners = mesh_->triangles[triangle];
        std::uint32_t next = triangle;
        bool outside = false;
        // Not always the same side first: another way out of a circle.
        for (std::size_t k = 0; k < 3 && next == triangle; ++k) {
            const std::size_t corner = (k + step) % 3;
            const Eigen::Vector3d& a_m = mesh_->vertices_m[corners[(corner + 1) % 3]];
            const Eigen::Vector3d& b_m = mesh_->vertices_m[corners[(corner + 2) % 3]];
            const double left = leftOf(a_m, b_m, place_m);
            if (left >= 0.0) continue;
            if (across(triangle, corner) != kNoTriangle) {
                next = across(triangle, corner);
            } else {
                outside = outside || left < -kOnBorder * (b_m - a_m).head<2>().squaredNorm();
            }
        }
        if (next == triangle) return outside ? kNoTriangle : triangle;
        triangle = next;
    }
    for (std::uint32_t t = 0; t < mesh_->triangles.size(); ++t) {
        if (barycentric(t, place_m).minCoeff() >= -kOnBorder) return start = t;
    }
    return kNoTriangle;
}

Eigen::Vector3d TriangleWalk::barycentric(std::uint32_t triangle, const Eigen::Vector2d& place_m) const {
    const std::array<std::uint32_t, 3>& corners = mesh_->triangles[triangle];
    const Eigen::Vector3d& a_m = mesh_->vertices_m[corners[0]];
    const Eigen::Vector3d& b_m = mesh_->vertices_m[corners[1]];
    const Eigen::Vector3d& c_m = mesh_->vertices_m[corners[2]];
    const Eigen::Vector3d areas(leftOf(b_m, c_m, place_m), leftOf(c_m, a_m, place_m),
                                leftOf(a_m, b_m, place_m));
    return areas / areas.sum();
}

}  // namespace terrawalk
