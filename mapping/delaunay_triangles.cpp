#include "mapping/delaunay_triangles.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

namespace terrawalk {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PlanPoint = Kernel::Point_2;
using Index = std::uint32_t;
using Triangle = std::array<Index, 3>;

/// The vertex of all faces outside the hull.
constexpr Index kInfinite = std::numeric_limits<Index>::max();
constexpr std::size_t kInsertionsBetweenReports = 16384;

/// Biased randomized insertion order (Amenta, Choi and Rote 2003): sparse levels first, each along the curve.
/// It bounds the cost for points in any arrangement. The level of a point is the number of trailing zero bit
/// pairs of its scrambled index: a quarter of the points moves up each time.
std::vector<Index> insertionOrder(std::size_t count) {
    constexpr std::size_t kLevels = 12;
    const auto level = [](std::size_t index) {
        std::uint64_t bits = (index + 1) * 0x9E3779B97F4A7C15ULL;
        bits = (bits ^ (bits >> 32)) * 0xD6E8FEB86659FD93ULL;
        return std::min<std::size_t>(static_cast<std::size_t>(std::countr_zero(bits >> 16)) / 2, kLevels - 1);
    };
    std::array<std::size_t, kLevels + 1> begins{};
    for (std::size_t i = 0; i < count; ++i) {
        ++begins[kLevels - level(i)];
    }
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<Index> order(count);
    for (std::size_t i = 0; i < count; ++i) {
        order[begins[kLevels - 1 - level(i)]++] = static_cast<Index>(i);
    }
    return order;
}

constexpr std::size_t next(std::size_t i) {
    return i == 2 ? 0 : i + 1;
}
constexpr std::size_t afterNext(std::size_t i) {
    return i == 0 ? 2 : i - 1;
}

/// Faces over a sphere: finite ones counter-clockwise, and one with the infinite vertex beyond each edge of
/// the hull. Edge i of a face lies opposite its vertex i, and neighbour i beyond it.
class Faces {
  public:
    Faces(const std::vector<Eigen::Vector3d>& points_m, Triangle first) : points_m_(points_m) {
        faces_.reserve(2 * points_m.size());
        if (CGAL::orientation(at(first[0]), at(first[1]), at(first[2])) == CGAL::RIGHT_TURN) {
            std::swap(first[1], first[2]);
        }
        faces_.push_back({first, {1, 2, 3}});
        for (std::size_t i = 0; i < 3; ++i) {
            // Beyond edge i; its own edges lead to the faces beyond the other two.
            faces_.push_back({{kInfinite, first[afterNext(i)], first[next(i)]},
                              {0, static_cast<Index>(1 + afterNext(i)), static_cast<Index>(1 + next(i))}});
        }
    }

    void insert(Index point) {
        const PlanPoint place = at(point);
        const Index start = locate(place);
        dead_.assign(1, start);
        hole_.clear();
        // The edges round the hole, counter-clockwise: an edge whose far face is in conflict gives way to the
        // two others of that face. The faces in conflict hold no vertex between them, so none comes twice.
        open_.assign({{start, 2}, {start, 1}, {start, 0}});
        while (!open_.empty()) {
            const auto [face, edge] = open_.back();
            open_.pop_back();
            const Index beyond = faces_[face].neighbours[edge];
            const std::size_t back = edgeTo(beyond, face);
            if (inConflict(beyond, place)) {
                dead_.push_back(beyond);
                open_.push_back({beyond, afterNext(back)});
                open_.push_back({beyond, next(back)});
            } else {
                const Triangle& v = faces_[face].vertices;
                hole_.push_back({v[next(edge)], v[afterNext(edge)], beyond, back});
            }
        }
        fillHole(point);
    }

    [[nodiscard]] std::vector<Triangle> finite() const {
        std::vector<Triangle> triangles;
        triangles.reserve(faces_.size());
        for (const Face& face : faces_) {
            if (!isInfinite(face.vertices)) triangles.push_back(face.vertices);
        }
        return triangles;
    }

  private:
    struct Face {
        Triangle vertices;
        std::array<Index, 3> neighbours;
    };
    struct FaceEdge {
        Index face;
        std::size_t edge;
    };
    struct HoleEdge {
        Index from, to;
        Index beyond;
        std::size_t back;  ///< edge of `beyond` that leads here
    };

    [[nodiscard]] PlanPoint at(Index vertex) const { return {points_m_[vertex].x(), points_m_[vertex].y()}; }

    static bool isInfinite(const Triangle& v) {
        return v[0] == kInfinite || v[1] == kInfinite || v[2] == kInfinite;
    }

    [[nodiscard]] std::size_t edgeTo(Index face, Index neighbour) const {
        const auto& n = faces_[face].neighbours;
        return n[0] == neighbour ? 0 : n[1] == neighbour ? 1 : 2;
    }

    /// A face in conflict with the place: the one that holds it, or one outside that sees it. Walks towards
    /// it; in a Delaunay triangulation that comes to an end.
    [[nodiscard]] Index locate(const PlanPoint& place) const {
        Index face = near_, before = kInfinite;
        for (;;) {
            const auto& [v, neighbours] = faces_[face];
            Index onward = kInfinite;
            for (std::size_t i = 0; i < 3 && onward == kInfinite; ++i) {
                if (neighbours[i] != before &&
                    CGAL::orientation(at(v[next(i)]), at(v[afterNext(i)]), place) == CGAL::RIGHT_TURN) {
                    onward = neighbours[i];
                }
            }
            if (onward == kInfinite) return face;
            if (isInfinite(faces_[onward].vertices)) return onward;
            before = std::exchange(face, onward);
        }
    }

    [[nodiscard]] bool inConflict(Index face, const PlanPoint& place) const {
        const Triangle& v = faces_[face].vertices;
        for (std::size_t i = 0; i < 3; ++i) {
            if (v[i] != kInfinite) continue;
            const PlanPoint a = at(v[next(i)]), b = at(v[afterNext(i)]);
            const CGAL::Orientation side = CGAL::orientation(a, b, place);
            return side == CGAL::LEFT_TURN ||
                   (side == CGAL::COLLINEAR && CGAL::collinear_are_strictly_ordered_along_line(a, place, b));
        }
        return inCircle({at(v[0]), at(v[1]), at(v[2])}, place);
    }

    /// Inside the circle through three corners, or on it and inside after a perturbation too small to see,
    /// which moves the lexicographically greatest of the four points the most.
    static bool inCircle(const std::array<PlanPoint, 3>& corner, const PlanPoint& place) {
        const CGAL::Oriented_side side =
            CGAL::side_of_oriented_circle(corner[0], corner[1], corner[2], place);
        if (side != CGAL::ON_ORIENTED_BOUNDARY) return side == CGAL::ON_POSITIVE_SIDE;
        std::array<const PlanPoint*, 4> points{&corner[0], &corner[1], &corner[2], &place};
        std::sort(points.begin(), points.end(), [](const PlanPoint* p, const PlanPoint* q) {
            return CGAL::lexicographically_xy_smaller(*p, *q);
        });
        for (std::size_t i = 3; i > 0; --i) {
            if (points[i] == &place) return false;
            const CGAL::Orientation turn =
                points[i] == &corner[2]   ? CGAL::orientation(corner[0], corner[1], place)
                : points[i] == &corner[1] ? CGAL::orientation(corner[0], place, corner[2])
                                          : CGAL::orientation(place, corner[1], corner[2]);
            if (turn != CGAL::COLLINEAR) return turn == CGAL::LEFT_TURN;
        }
        return false;
    }

    /// One face from each edge of the hole to the new vertex, in the place of the dead ones and two more.
    void fillHole(Index point) {
        for (std::size_t more = dead_.size(); more < hole_.size(); ++more) {
            dead_.push_back(static_cast<Index>(faces_.size()));
            faces_.emplace_back();
        }
        for (std::size_t k = 0; k < hole_.size(); ++k) {
            const HoleEdge& edge = hole_[k];
            const Index following = dead_[k + 1 == hole_.size() ? 0 : k + 1];
            const Index preceding = dead_[k == 0 ? hole_.size() - 1 : k - 1];
            faces_[dead_[k]] = {{edge.from, edge.to, point}, {following, preceding, edge.beyond}};
            faces_[edge.beyond].neighbours[edge.back] = dead_[k];
            if (edge.from != kInfinite && edge.to != kInfinite) near_ = dead_[k];
        }
    }

    const std::vector<Eigen::Vector3d>& points_m_;
    std::vector<Face> faces_;
    Index near_ = 0;  ///< a finite face, where the next walk begins
    std::vector<Index> dead_;
    std::vector<FaceEdge> open_;
    std::vector<HoleEdge> hole_;
};

}  // namespace

Result<std::vector<Triangle>> delaunayTriangles(const std::vector<Eigen::Vector3d>& points_m,
                                                std::size_t off_line, Progress& progress,
                                                std::stop_token stop) {
    const Triangle first{0, static_cast<Index>(off_line), static_cast<Index>(points_m.size() - 1)};
    Faces faces(points_m, first);
    std::size_t done = 0;
    for (const Index point : insertionOrder(points_m.size())) {
        if (++done % kInsertionsBetweenReports == 0) {
            if (stop.stop_requested()) return cancelled();
            progress.report(static_cast<double>(done) / static_cast<double>(points_m.size()),
                            "triangulating");
        }
        if (std::find(first.begin(), first.end(), point) == first.end()) faces.insert(point);
    }
    return faces.finite();
}

}  // namespace terrawalk
