#include "mapping/vertex_gradients.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "survey/parallel.hpp"

namespace terrawalk {
namespace {

constexpr std::size_t kVerticesPerTask = 1024;
constexpr std::size_t kMostNeighbours = 64;  // a hub of very many triangles gains nothing from more
constexpr std::size_t kLeastForQuadratic = 8;

/// A run of triangles round a vertex that no breakline parts.
struct Sector {
    std::uint32_t vertex;
    std::vector<std::uint32_t> triangles;
};

class SectorWalk {
  public:
    SectorWalk(const TriangleWalk& walk, const std::vector<std::uint8_t>& breaks)
        : walk_(walk), breaks_(breaks) {}

    /// The neighbour across a side that is neither border nor breakline.
    [[nodiscard]] std::uint32_t across(std::uint32_t triangle, std::size_t corner) const {
        const bool parted = !breaks_.empty() && ((breaks_[triangle] >> corner) & 1U) != 0;
        return parted ? kNoTriangle : walk_.across(triangle, corner);
    }

    [[nodiscard]] std::size_t cornerAt(std::uint32_t triangle, std::uint32_t vertex) const {
        const std::array<std::uint32_t, 3>& corners = walk_.mesh().triangles[triangle];
        return corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2;
    }

    /// The sector that a triangle belongs to, from its clockwise end on.
    [[nodiscard]] Sector sectorFrom(std::uint32_t triangle, std::uint32_t vertex) const {
        const std::uint32_t given = triangle;
        for (;;) {
            const std::uint32_t before = across(triangle, (cornerAt(triangle, vertex) + 2) % 3);
            if (before == kNoTriangle || before == given) break;
            triangle = before;
        }
        Sector sector{vertex, {triangle}};
        for (;;) {
            const std::uint32_t after = across(triangle, (cornerAt(triangle, vertex) + 1) % 3);
            if (after == kNoTriangle || after == sector.triangles.front()) break;
            triangle = after;
            sector.triangles.push_back(triangle);
        }
        return sector;
    }

    /// Vertices of the sector's triangles and of those behind their outer sides, without its own.
    [[nodiscard]] std::vector<std::uint32_t> neighbours(const Sector& sector) const {
        std::vector<std::uint32_t> found;
        for (const std::uint32_t triangle : sector.triangles) {
            for (const std::uint32_t corner : walk_.mesh().triangles[triangle]) found.push_back(corner);
            // Two rings: what lies across the outer side, and round each of the two triangles there.
            const std::uint32_t outer = across(triangle, cornerAt(triangle, sector.vertex));
            if (outer == kNoTriangle) continue;
            for (const std::uint32_t corner : walk_.mesh().triangles[outer]) found.push_back(corner);
            const std::size_t back = walk_.cornerFacing(outer, triangle);
            for (const std::size_t side : {(back + 1) % 3, (back + 2) % 3}) {
                const std::uint32_t farther = across(outer, side);
                if (farther == kNoTriangle) continue;
                for (const std::uint32_t corner : walk_.mesh().triangles[farther]) found.push_back(corner);
            }
            if (found.size() > 8 * kMostNeighbours) break;
        }
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        found.erase(std::remove(found.begin(), found.end(), sector.vertex), found.end());
        if (found.size() > kMostNeighbours) found.resize(kMostNeighbours);
        return found;
    }

  private:
    const TriangleWalk& walk_;
    const std::vector<std::uint8_t>& breaks_;
};

/// Weighted least squares with `n` terms; the gradient is its first two. Not finite when it is not
/// determined.
template <int n>
Eigen::Vector2d fittedGradient(const std::vector<Eigen::Vector3d>& offsets_m) {
    using Normal = Eigen::Matrix<double, n, n>;
    using Terms = Eigen::Matrix<double, n, 1>;
    double scale = 0.0;  // so that all terms are about one
    for (const Eigen::Vector3d& d : offsets_m) scale = std::max(scale, d.head<2>().norm());
    Normal normal = Normal::Zero();
    Terms right = Terms::Zero();
    for (const Eigen::Vector3d& d : offsets_m) {
        const double x = d.x() / scale;
        const double y = d.y() / scale;
        const double weight = 1.0 / (x * x + y * y);
        Terms row;
        if constexpr (n == 2) {
            row << x, y;
        } else {
            row << x, y, x * x, x * y, y * y;
        }
        normal += weight * row * row.transpose();
        right += weight * d.z() * row;
    }
    const Eigen::LDLT<Normal> factor(normal);
    const auto pivots = factor.vectorD();
    if (!(pivots.minCoeff() > 1e-6 * pivots.maxCoeff())) {
        return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
    }
    const Terms solution = factor.solve(right);
    return solution.template head<2>() / scale;
}

Eigen::Vector2d gradientOf(const TriangleMesh& mesh, std::uint32_t vertex,
                           const std::vector<std::uint32_t>& neighbours) {
    std::vector<Eigen::Vector3d> offsets_m;
    for (const std::uint32_t other : neighbours) {
        offsets_m.push_back(mesh.vertices_m[other] - mesh.vertices_m[vertex]);
    }
    if (offsets_m.size() >= kLeastForQuadratic) {
        const Eigen::Vector2d gradient = fittedGradient<5>(offsets_m);
        if (gradient.allFinite()) return gradient;
    }
    const Eigen::Vector2d gradient = fittedGradient<2>(offsets_m);
    return gradient.allFinite() ? gradient : Eigen::Vector2d::Zero();
}

/// Where each sector is found again.
struct SectorStart {
    std::uint32_t triangle;
    std::uint32_t vertex;
};

std::vector<SectorStart> sectorsOf(const SectorWalk& sectors, const TriangleWalk& walk,
                                   std::vector<std::array<std::uint32_t, 3>>& of_corner) {
    std::vector<SectorStart> found;
    const TriangleMesh& mesh = walk.mesh();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            if (of_corner[t][corner] != kNoTriangle) continue;
            const Sector sector = sectors.sectorFrom(t, mesh.triangles[t][corner]);
            for (const std::uint32_t member : sector.triangles) {
                of_corner[member][sectors.cornerAt(member, sector.vertex)] =
                    static_cast<std::uint32_t>(found.size());
            }
            found.push_back({t, sector.vertex});
        }
    }
    return found;
}

}  // namespace

VertexGradients vertexGradients(const TriangleWalk& walk, const std::vector<std::uint8_t>& breaks,
                                const std::stop_token& stop) {
    VertexGradients result;
    result.of_corner.assign(walk.mesh().triangles.size(), {kNoTriangle, kNoTriangle, kNoTriangle});
    const SectorWalk sectors(walk, breaks);
    const std::vector<SectorStart> found = sectorsOf(sectors, walk, result.of_corner);
    result.gradients.resize(found.size());
    parallelRanges(found.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
        if (stop.stop_requested()) return;
        for (std::size_t i = begin; i < end; ++i) {
            const Sector sector = sectors.sectorFrom(found[i].triangle, found[i].vertex);
            result.gradients[i] = gradientOf(walk.mesh(), sector.vertex, sectors.neighbours(sector));
        }
    });
    return result;
}

}  // namespace terrawalk
