// Natural neighbour coordinates without inserting the place: the cavity of triangles whose circumcircle holds
// it, after Bowyer (1981) and Watson (1981), and the polygons that it would take from each Voronoi cell.
// Sibson, R.: A brief description of natural neighbour interpolation. In: Interpreting Multivariate Data,
// 1981; with his C1 form.

#include <cmath>
#include <limits>
#include <utility>

#include "mapping/interpolators.hpp"
#include "mapping/triangle_walk.hpp"
#include "mapping/vertex_gradients.hpp"

namespace terrawalk {
namespace {

/// Sibson's coordinates answer with the place itself; by how much of the distance to the farthest neighbour
/// they may miss it before rounding is taken to have spoilt them.
constexpr double kGreatestMiss = 1e-7;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Centre of the circle through three places.
Eigen::Vector2d circumcentre(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    const Eigen::Vector2d ab = b - a;
    const Eigen::Vector2d ac = c - a;
    const double twice = 2.0 * cross(ab, ac);
    const double bb = ab.squaredNorm();
    const double cc = ac.squaredNorm();
    return a + Eigen::Vector2d(ac.y() * bb - ab.y() * cc, ab.x() * cc - ac.x() * bb) / twice;
}

struct Share {
    std::uint32_t vertex;
    double weight;
};

/// An edge of the cavity seen from its inner triangle, which has it across `corner`.
struct CavityEdge {
    std::uint32_t triangle;
    std::size_t corner;
};

class NaturalNeighbour final : public HeightInterpolator {
  public:
    NaturalNeighbour(std::shared_ptr<const TriangleMesh> mesh, bool smooth, const std::stop_token& stop)
        : mesh_(std::move(mesh)), walk_(*mesh_) {
        if (!smooth) return;
        // Without breaklines each vertex has one slope; by vertex it is found without the corner.
        const VertexGradients found = vertexGradients(walk_, {}, stop);
        gradients_.resize(mesh_->vertices_m.size());
        for (std::size_t t = 0; t < mesh_->triangles.size(); ++t) {
            for (std::size_t corner = 0; corner < 3; ++corner) {
                gradients_[mesh_->triangles[t][corner]] = found.gradients[found.of_corner[t][corner]];
            }
        }
    }

    void estimate(std::span<const Eigen::Vector2d> places_m,
                  std::span<HeightEstimate> estimates) const override {
        if (places_m.empty()) return;
        Scratch scratch;
        std::uint32_t near = walk_.startNear(places_m.front());
        for (std::size_t i = 0; i < places_m.size(); ++i) {
            estimates[i].height_m = heightAt(places_m[i], near, scratch);
        }
    }

  private:
    struct Scratch {
        std::vector<CavityEdge> open;
        std::vector<CavityEdge> border;
        std::vector<Share> shares;
    };

    [[nodiscard]] Eigen::Vector2d offset(std::uint32_t vertex, const Eigen::Vector2d& place_m) const {
        return mesh_->vertices_m[vertex].head<2>() - place_m;
    }

    [[nodiscard]] bool circleHolds(std::uint32_t triangle, const Eigen::Vector2d& place_m) const {
        const auto& [i, j, k] = mesh_->triangles[triangle];
        const Eigen::Vector2d a = offset(i, place_m);
        const Eigen::Vector2d b = offset(j, place_m);
        const Eigen::Vector2d c = offset(k, place_m);
        return a.squaredNorm() * cross(b, c) + b.squaredNorm() * cross(c, a) + c.squaredNorm() * cross(a, b) >
               0.0;
    }

    double heightAt(const Eigen::Vector2d& place_m, std::uint32_t& near, Scratch& scratch) const {
        const std::uint32_t triangle = walk_.locate(place_m, near);
        if (triangle == kNoTriangle) return std::numeric_limits<double>::quiet_NaN();
        for (const std::uint32_t vertex : mesh_->triangles[triangle]) {
            if (offset(vertex, place_m).isZero(0.0)) return mesh_->vertices_m[vertex].z();
        }
        if (!findCavity(triangle, place_m, scratch) || !findShares(place_m, scratch)) {
            takeLinearShares(triangle, place_m, scratch);
        }
        return gradients_.empty() ? mean(scratch.shares) : smoothMean(place_m, scratch.shares);
    }

    /// The border of the cavity, counter-clockwise. The cavity holds no vertex, so its triangles form a tree
    /// and each is met once; when rounding makes a ring of them, this gives up.
    bool findCavity(std::uint32_t triangle, const Eigen::Vector2d& place_m, Scratch& scratch) const {
        scratch.border.clear();
        scratch.open = {{triangle, 2}, {triangle, 1}, {triangle, 0}};
        std::size_t members = 1;
        while (!scratch.open.empty()) {
            const CavityEdge edge = scratch.open.back();
            scratch.open.pop_back();
            const std::uint32_t beyond = walk_.across(edge.triangle, edge.corner);
            if (beyond == kNoTriangle || !circleHolds(beyond, place_m)) {
                scratch.border.push_back(edge);
                continue;
            }
            if (++members > mesh_->triangles.size()) return false;
            const std::size_t entry = walk_.cornerFacing(beyond, edge.triangle);
            scratch.open.push_back({beyond, (entry + 2) % 3});
            scratch.open.push_back({beyond, (entry + 1) % 3});
        }
        return true;
    }

    [[nodiscard]] Eigen::Vector2d newCentre(const CavityEdge& edge, const Eigen::Vector2d& place_m) const {
        const std::array<std::uint32_t, 3>& corners = mesh_->triangles[edge.triangle];
        return circumcentre(Eigen::Vector2d::Zero(), offset(corners[(edge.corner + 1) % 3], place_m),
                            offset(corners[(edge.corner + 2) % 3], place_m));
    }

    [[nodiscard]] Eigen::Vector2d oldCentre(std::uint32_t triangle, const Eigen::Vector2d& place_m) const {
        const auto& [i, j, k] = mesh_->triangles[triangle];
        return circumcentre(offset(i, place_m), offset(j, place_m), offset(k, place_m));
    }

    /// Each vertex on the border loses a polygon: from the new centre before it to the one after it, then
    /// back over the old centres between them. All seen from the place, so that large coordinates lose
    /// nothing. False when rounding spoilt the shares.
    bool findShares(const Eigen::Vector2d& place_m, Scratch& scratch) const {
        scratch.shares.clear();
        double sum = 0.0;
        double farthest = 0.0;
        Eigen::Vector2d moment = Eigen::Vector2d::Zero();
        Eigen::Vector2d before = newCentre(scratch.border.back(), place_m);
        for (std::size_t k = 0; k < scratch.border.size(); ++k) {
            const CavityEdge& arriving =
                scratch.border[(k + scratch.border.size() - 1) % scratch.border.size()];
            const CavityEdge& leaving = scratch.border[k];
            const Eigen::Vector2d after = newCentre(leaving, place_m);
            const std::uint32_t vertex = mesh_->triangles[leaving.triangle][(leaving.corner + 1) % 3];
            const double area = takenArea(arriving, leaving, before, after, place_m);
            before = after;
            scratch.shares.push_back({vertex, area});
            const Eigen::Vector2d to = offset(vertex, place_m);
            sum += area;
            moment += area * to;
            farthest = std::max(farthest, to.norm());
        }
        bool sound = sum > 0.0 && moment.norm() <= kGreatestMiss * farthest * sum;
        for (Share& share : scratch.shares) {
            sound = sound && share.weight >= -kGreatestMiss * sum;
            share.weight /= sum;
        }
        return sound;
    }

    /// Twice the polygon's area. Turns round the vertex from one border edge to the next.
    [[nodiscard]] double takenArea(const CavityEdge& arriving, const CavityEdge& leaving,
                                   const Eigen::Vector2d& before, const Eigen::Vector2d& after,
                                   const Eigen::Vector2d& place_m) const {
        std::uint32_t triangle = arriving.triangle;
        std::size_t corner = arriving.corner;
        Eigen::Vector2d last = oldCentre(triangle, place_m);
        double twice = cross(before, after) + cross(last, before);
        for (;;) {
            const std::size_t side = (corner + 1) % 3;
            if (triangle == leaving.triangle && side == leaving.corner) break;
            const std::uint32_t next = walk_.across(triangle, side);
            corner = walk_.cornerFacing(next, triangle);
            triangle = next;
            const Eigen::Vector2d centre = oldCentre(triangle, place_m);
            twice += cross(centre, last);
            last = centre;
        }
        return twice + cross(after, last);
    }

    void takeLinearShares(std::uint32_t triangle, const Eigen::Vector2d& place_m, Scratch& scratch) const {
        const Eigen::Vector3d weights = walk_.barycentric(triangle, place_m);
        scratch.shares.clear();
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = mesh_->triangles[triangle][corner];
            scratch.shares.push_back({vertex, weights[static_cast<Eigen::Index>(corner)]});
        }
    }

    /// Counted from one of the heights, so that equal heights stay what they are.
    [[nodiscard]] double mean(const std::vector<Share>& shares) const {
        const double base = mesh_->vertices_m[shares.front().vertex].z();
        double above = 0.0;
        for (const Share& share : shares) {
            above += share.weight * (mesh_->vertices_m[share.vertex].z() - base);
        }
        return base + above;
    }

    /// Sibson (1981), as in the manual of CGAL's 2D interpolation: a mean of the plain one and of the planes
    /// through the neighbours.
    [[nodiscard]] double smoothMean(const Eigen::Vector2d& place_m, const std::vector<Share>& shares) const {
        const double base = mesh_->vertices_m[shares.front().vertex].z();
        double plain = 0.0, planes = 0.0, nearness = 0.0, distance = 0.0, squared = 0.0;
        for (const Share& share : shares) {
            const Eigen::Vector2d from = -offset(share.vertex, place_m);
            const double r = from.norm();
            const double above = mesh_->vertices_m[share.vertex].z() - base;
            plain += share.weight * above;
            planes += share.weight / r * (above + gradients_[share.vertex].dot(from));
            nearness += share.weight / r;
            distance += share.weight * r;
            squared += share.weight * r * r;
        }
        const double alpha = distance / nearness;
        return base + (alpha * plain + squared * planes / nearness) / (alpha + squared);
    }

    std::shared_ptr<const TriangleMesh> mesh_;
    TriangleWalk walk_;
    std::vector<Eigen::Vector2d> gradients_;  ///< empty: the plain form
};

}  // namespace

InterpolatorPointer makeNaturalNeighbour(std::shared_ptr<const TriangleMesh> mesh, bool smooth,
                                         const std::stop_token& stop) {
    return std::make_unique<NaturalNeighbour>(std::move(mesh), smooth, stop);
}

}  // namespace terrawalk
