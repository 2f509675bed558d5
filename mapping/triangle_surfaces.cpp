// Surfaces over the triangles themselves: planes, and the split cubics of Clough and Tocher (1965) in the
// Bernstein form of Farin, G.: Triangular Bernstein-Bezier patches. CAGD 3 (1986).

#include <array>
#include <cmath>
#include <utility>

#include "mapping/interpolators.hpp"
#include "mapping/triangle_walk.hpp"
#include "mapping/vertex_gradients.hpp"

namespace terrawalk {
namespace {

class OverTriangles : public HeightInterpolator {
  public:
    explicit OverTriangles(std::shared_ptr<const TriangleMesh> mesh)
        : mesh_(std::move(mesh)), walk_(*mesh_) {}

    void estimate(std::span<const Eigen::Vector2d> places_m,
                  std::span<HeightEstimate> estimates) const override {
        if (places_m.empty()) return;
        std::uint32_t near = walk_.startNear(places_m.front());
        for (std::size_t i = 0; i < places_m.size(); ++i) {
            const std::uint32_t triangle = walk_.locate(places_m[i], near);
            if (triangle != kNoTriangle) {
                estimates[i].height_m = heightIn(triangle, walk_.barycentric(triangle, places_m[i]));
            }
        }
    }

  protected:
    [[nodiscard]] virtual double heightIn(std::uint32_t triangle, const Eigen::Vector3d& shares) const = 0;
    [[nodiscard]] const Eigen::Vector3d& corner(std::uint32_t triangle, std::size_t k) const {
        return mesh_->vertices_m[mesh_->triangles[triangle][k]];
    }
    [[nodiscard]] const TriangleWalk& walk() const { return walk_; }

  private:
    std::shared_ptr<const TriangleMesh> mesh_;
    TriangleWalk walk_;
};

class Linear final : public OverTriangles {
  public:
    using OverTriangles::OverTriangles;

  private:
    [[nodiscard]] double heightIn(std::uint32_t triangle, const Eigen::Vector3d& shares) const override {
        const double base = corner(triangle, 0).z();
        return base + shares[1] * (corner(triangle, 1).z() - base) +
               shares[2] * (corner(triangle, 2).z() - base);
    }
};

class CloughTocher final : public OverTriangles {
  public:
    CloughTocher(std::shared_ptr<const TriangleMesh> mesh, std::vector<std::uint8_t> breaks,
                 const std::stop_token& stop)
        : OverTriangles(std::move(mesh)),
          breaks_(std::move(breaks)),
          slopes_(vertexGradients(walk(), breaks_, stop)) {}

  private:
    [[nodiscard]] bool bordersBreak(std::uint32_t triangle, std::size_t side) const {
        return !breaks_.empty() && ((breaks_[triangle] >> side) & 1U) != 0;
    }

    /// Rise along `way` by the slope at a corner.
    [[nodiscard]] double rise(std::uint32_t triangle, std::size_t at, const Eigen::Vector2d& way) const {
        return slopes_.gradients[slopes_.of_corner[triangle][at]].dot(way);
    }

    /// The slope across a side varies linearly, in the direction from the triangle's centre to that of its
    /// neighbour: any direction that both triangles take gives a smooth joint, and this one does not change
    /// under affine maps. The share of the side's second end in where that line meets the side.
    [[nodiscard]] double crossing(std::uint32_t triangle, std::size_t side) const {
        const std::uint32_t other = walk().across(triangle, side);
        if (other == kNoTriangle || bordersBreak(triangle, side)) return -0.5;
        const Eigen::Vector3d centre = (corner(other, 0) + corner(other, 1) + corner(other, 2)) / 3.0;
        const Eigen::Vector3d c = walk().barycentric(triangle, centre.head<2>());
        const auto first = static_cast<Eigen::Index>((side + 1) % 3);
        const auto second = static_cast<Eigen::Index>((side + 2) % 3);
        const double along = 2.0 - 3.0 * c[first] - 3.0 * c[second];
        return std::abs(along) > 1e-12 ? (2.0 * c[second] + c[first] - 1.0) / along : -0.5;
    }

    /// Control values by the powers of the corners 0, 1, 2 and of the middle, where the three parts meet.
    [[nodiscard]] double heightIn(std::uint32_t triangle, const Eigen::Vector3d& shares) const override {
        const Eigen::Vector2d e01 = (corner(triangle, 1) - corner(triangle, 0)).head<2>();
        const Eigen::Vector2d e12 = (corner(triangle, 2) - corner(triangle, 1)).head<2>();
        const Eigen::Vector2d e20 = (corner(triangle, 0) - corner(triangle, 2)).head<2>();
        const double base = corner(triangle, 0).z();  // equal heights stay what they are

        const double c3000 = 0.0;
        const double c2100 = c3000 + rise(triangle, 0, e01) / 3.0;
        const double c2010 = c3000 - rise(triangle, 0, e20) / 3.0;
        const double c0300 = corner(triangle, 1).z() - base;
        const double c1200 = c0300 - rise(triangle, 1, e01) / 3.0;
        const double c0210 = c0300 + rise(triangle, 1, e12) / 3.0;
        const double c0030 = corner(triangle, 2).z() - base;
        const double c1020 = c0030 + rise(triangle, 2, e20) / 3.0;
        const double c0120 = c0030 - rise(triangle, 2, e12) / 3.0;

        const double c2001 = (c2100 + c2010 + c3000) / 3.0;
        const double c0201 = (c1200 + c0300 + c0210) / 3.0;
        const double c0021 = (c1020 + c0120 + c0030) / 3.0;

        const double g0 = crossing(triangle, 0);
        const double g1 = crossing(triangle, 1);
        const double g2 = crossing(triangle, 2);
        const double c0111 = (g0 * (-c0300 + 3.0 * c0210 - 3.0 * c0120 + c0030) - c0300 + 2.0 * c0210 -
                              c0120 + c0021 + c0201) /
                             2.0;
        const double c1011 = (g1 * (-c0030 + 3.0 * c1020 - 3.0 * c2010 + c3000) - c0030 + 2.0 * c1020 -
                              c2010 + c2001 + c0021) /
                             2.0;
        const double c1101 = (g2 * (-c3000 + 3.0 * c2100 - 3.0 * c1200 + c0300) - c3000 + 2.0 * c2100 -
                              c1200 + c2001 + c0201) /
                             2.0;
        const double c1002 = (c1101 + c1011 + c2001) / 3.0;
        const double c0102 = (c1101 + c0111 + c0201) / 3.0;
        const double c0012 = (c1011 + c0111 + c0021) / 3.0;
        const double c0003 = (c1002 + c0102 + c0012) / 3.0;

        // The part that holds the place is the one without the corner of the least share.
        const double least = shares.minCoeff();
        const double a = shares[0] - least;
        const double b = shares[1] - least;
        const double c = shares[2] - least;
        const double m = 3.0 * least;
        return base + a * a * a * c3000 + b * b * b * c0300 + c * c * c * c0030 + m * m * m * c0003 +
               3.0 * (a * a * (b * c2100 + c * c2010 + m * c2001) +
                      b * b * (a * c1200 + c * c0210 + m * c0201) +
                      c * c * (a * c1020 + b * c0120 + m * c0021) +
                      m * m * (a * c1002 + b * c0102 + c * c0012)) +
               6.0 * m * (a * b * c1101 + a * c * c1011 + b * c * c0111);
    }

    std::vector<std::uint8_t> breaks_;
    VertexGradients slopes_;
};

}  // namespace

InterpolatorPointer makeLinear(std::shared_ptr<const TriangleMesh> mesh) {
    return std::make_unique<Linear>(std::move(mesh));
}

InterpolatorPointer makeCloughTocher(std::shared_ptr<const TriangleMesh> mesh,
                                     std::vector<std::uint8_t> breaks, const std::stop_token& stop) {
    return std::make_unique<CloughTocher>(std::move(mesh), std::move(breaks), stop);
}

}  // namespace terrawalk
