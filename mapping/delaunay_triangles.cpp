#include "mapping/delaunay_triangles.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <bit>
#include <cmath>
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

struct Place {
    double x, y;
};

PlanPoint exact(const Place& place) {
    return {place.x, place.y};
}

// Plain arithmetic tells nearly all signs, CGAL's exact predicates the others. Bounds of the rounding errors:
// Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric predicates"; what is
// added to them outweighs what underflow takes from coordinates up to 1e9.
constexpr double kHalfStep = 0x1p-53;
constexpr double kTurnBound = (3.0 + 16.0 * kHalfStep) * kHalfStep;
constexpr double kCircleBound = (10.0 + 96.0 * kHalfStep) * kHalfStep;
constexpr double kUnderflow = 1e-290;

/// Whether c lies to the right of the way from a to b.
bool turnsRight(const Place& a, const Place& b, const Place& c) {
    const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
    const double turn = left - right;
    const double bound = kTurnBound * (std::abs(left) + std::abs(right)) + kUnderflow;
    if (turn < -bound) return true;
    if (turn > bound) return false;
    return CGAL::orientation(exact(a), exact(b), exact(c)) == CGAL::RIGHT_TURN;
}

/// On the circle through three corners: inside after a perturbation too small to see, which moves the
/// lexicographically greatest of the four points the most.
bool inPerturbedCircle(const std::array<PlanPoint, 3>& corner, const PlanPoint& place) {
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

/// Whether d lies inside the circle through a, b and c, which turn left.
bool inCircle(const Place& a, const Place& b, const Place& c, const Place& d) {
    const double ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x,
                 cy = c.y - d.y;
    const double bc = bx * cy, cb = cx * by, ca = cx * ay, ac = ax * cy, ab = ax * by, ba = bx * ay;
    const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
    const double inside = aa * (bc - cb) + bb * (ca - ac) + cc * (ab - ba);
    const double size = (std::abs(bc) + std::abs(cb)) * aa + (std::abs(ca) + std::abs(ac)) * bb +
                        (std::abs(ab) + std::abs(ba)) * cc;
    const double bound = kCircleBound * size + kUnderflow;
    if (inside > bound) return true;
    if (inside < -bound) return false;
    const std::array<PlanPoint, 3> corner{exact(a), exact(b), exact(c)};
    const CGAL::Oriented_side side = CGAL::side_of_oriented_circle(corner[0], corner[1], corner[2], exact(d));
    return side == CGAL::ON_ORIENTED_BOUNDARY ? inPerturbedCircle(corner, exact(d))
                                              : side == CGAL::ON_POSITIVE_SIDE;
}

constexpr std::array<Index, 3> kNext{1, 2, 0};
constexpr std::array<Index, 3> kAfterNext{2, 0, 1};

/// Edge `edge` of a face, in one number. The edge lies opposite that vertex.
constexpr Index edgeOf(Index face, Index edge) {
    return (face << 2U) | edge;
}
constexpr Index faceOf(Index link) {
    return link >> 2U;
}
constexpr Index sideOf(Index link) {
    return link & 3U;
}

/// Faces over a sphere: finite ones counter-clockwise, and one with the infinite vertex beyond each edge of
/// the hull. Each edge of a face is linked with the same edge of the face beyond.
class Faces {
  public:
    Faces(const std::vector<Eigen::Vector3d>& points_m, Triangle first) {
        places_.reserve(points_m.size());
        for (const Eigen::Vector3d& point : points_m) places_.push_back({point.x(), point.y()});
        faces_.reserve(2 * points_m.size());
        if (turnsRight(places_[first[0]], places_[first[1]], places_[first[2]])) {
            std::swap(first[1], first[2]);
        }
        faces_.push_back({first, {edgeOf(1, 0), edgeOf(2, 0), edgeOf(3, 0)}});
        for (Index i = 0; i < 3; ++i) {
            // Beyond edge i; its own edges lead to the faces beyond the other two.
            faces_.push_back({{kInfinite, first[kAfterNext[i]], first[kNext[i]]},
                              {edgeOf(0, i), edgeOf(1 + kAfterNext[i], 2), edgeOf(1 + kNext[i], 1)}});
        }
    }

    void insert(Index point) {
        const Place place = places_[point];
        const Index start = locate(place);
        dead_.assign(1, start);
        hole_.clear();
        // The edges round the hole, counter-clockwise: an edge whose far face is in conflict gives way to the
        // two others of that face. The faces in conflict hold no vertex between them, so none comes twice.
        open_.assign({edgeOf(start, 2), edgeOf(start, 1), edgeOf(start, 0)});
        while (!open_.empty()) {
            const Index here = open_.back();
            open_.pop_back();
            const Face& inner = faces_[faceOf(here)];
            const Index link = inner.links[sideOf(here)];
            const Index beyond = faceOf(link), back = sideOf(link);
            if (inConflict(faces_[beyond].vertices, place)) {
                dead_.push_back(beyond);
                open_.push_back(edgeOf(beyond, kAfterNext[back]));
                open_.push_back(edgeOf(beyond, kNext[back]));
            } else {
                hole_.push_back(
                    {inner.vertices[kNext[sideOf(here)]], inner.vertices[kAfterNext[sideOf(here)]], link});
            }
        }
        fillHole(point);
    }

    /// Finite faces, each from its lowest vertex on, in rising order.
    [[nodiscard]] std::vector<Triangle> inRisingOrder() && {
        const auto lowest = [](const Triangle& t) {
            return std::min({t[0], t[1], t[2]});
        };
        std::vector<Index> ends(places_.size(), 0);  // at first the begins, then moved on
        places_ = {};                                // makes room
        std::size_t finite = 0;
        for (const Face& face : faces_) {
            if (isInfinite(face.vertices)) continue;
            ++ends[lowest(face.vertices)];
            ++finite;
        }
        std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), Index{0});
        std::vector<Triangle> ordered(finite);
        for (const Face& face : faces_) {
            if (isInfinite(face.vertices)) continue;
            const auto [a, b, c] = face.vertices;
            const Triangle turned = a < b && a < c ? Triangle{a, b, c}
                                    : b < c        ? Triangle{b, c, a}
                                                   : Triangle{c, a, b};
            // Few triangles share their lowest vertex: each goes to its place among those that came before.
            Index at = ends[turned[0]]++;
            for (; at > 0 && turned < ordered[at - 1]; --at) ordered[at] = ordered[at - 1];
            ordered[at] = turned;
        }
        return ordered;
    }

  private:
    struct Face {
        Triangle vertices;
        std::array<Index, 3> links;
    };
    struct HoleEdge {
        Index from, to;
        Index beyond;
    };

    static bool isInfinite(const Triangle& v) {
        return v[0] == kInfinite || v[1] == kInfinite || v[2] == kInfinite;
    }

    /// A face in conflict with the place: the one that holds it, or one outside that sees it. Walks towards
    /// it; in a Delaunay triangulation that comes to an end.
    [[nodiscard]] Index locate(const Place& place) const {
        Index face = near_, came_by = 3;
        for (;;) {
            const auto& [v, links] = faces_[face];
            Index onward = kInfinite;
            for (Index i = 0; i < 3 && onward == kInfinite; ++i) {
                if (i != came_by && turnsRight(places_[v[kNext[i]]], places_[v[kAfterNext[i]]], place)) {
                    onward = links[i];
                }
            }
            if (onward == kInfinite) return face;
            face = faceOf(onward);
            came_by = sideOf(onward);
            if (isInfinite(faces_[face].vertices)) return face;
        }
    }

    [[nodiscard]] bool inConflict(const Triangle& v, const Place& place) const {
        if (!isInfinite(v)) return inCircle(places_[v[0]], places_[v[1]], places_[v[2]], place);
        const std::size_t i = v[0] == kInfinite ? 0 : v[1] == kInfinite ? 1 : 2;
        const PlanPoint a = exact(places_[v[kNext[i]]]), b = exact(places_[v[kAfterNext[i]]]);
        const PlanPoint c = exact(place);
        const CGAL::Orientation side = CGAL::orientation(a, b, c);
        return side == CGAL::LEFT_TURN ||
               (side == CGAL::COLLINEAR && CGAL::collinear_are_strictly_ordered_along_line(a, c, b));
    }

    /// One face from each edge of the hole to the new vertex, in the place of the dead ones and two more.
    void fillHole(Index point) {
        for (std::size_t more = dead_.size(); more < hole_.size(); ++more) {
            dead_.push_back(static_cast<Index>(faces_.size()));
            faces_.emplace_back();
        }
        Index preceding = dead_[hole_.size() - 1];
        for (std::size_t k = 0; k < hole_.size(); ++k) {
            const HoleEdge& edge = hole_[k];
            const Index face = dead_[k], following = dead_[k + 1 == hole_.size() ? 0 : k + 1];
            faces_[face] = {{edge.from, edge.to, point},
                            {edgeOf(following, 1), edgeOf(preceding, 0), edge.beyond}};
            faces_[faceOf(edge.beyond)].links[sideOf(edge.beyond)] = edgeOf(face, 2);
            if (edge.from != kInfinite && edge.to != kInfinite) near_ = face;
            preceding = face;
        }
    }

    std::vector<Place> places_;
    std::vector<Face> faces_;
    Index near_ = 0;  ///< a finite face, where the next walk begins
    std::vector<Index> dead_;
    std::vector<Index> open_;  ///< edges of dead faces
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
    return std::move(faces).inRisingOrder();
}

}  // namespace terrawalk
