#include "mapping/constrained_tin.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "mapping/delaunay_tin.hpp"
#include "mapping/edge_limit.hpp"
#include "mapping/interpolators.hpp"
#include "mapping/plan_kd_tree.hpp"
#include "mapping/point_order.hpp"
#include "mapping/triangle_walk.hpp"

namespace terrawalk {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PlanPoint = Kernel::Point_2;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                               CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Triangle = std::array<std::uint32_t, 3>;

constexpr std::size_t kInsertionsBetweenChecks = 16384;
constexpr double kGreatestHeightGap_m = 0.001;  // lines that meet must agree in height

PlanPoint plan(const Eigen::Vector3d& point_m) {
    return {point_m.x(), point_m.y()};
}

bool isRing(BreaklineKind kind) {
    return kind == BreaklineKind::Boundary || kind == BreaklineKind::Hole;
}

bool folds(BreaklineKind kind) {
    return kind != BreaklineKind::Soft;
}

auto placeOf(const Eigen::Vector3d& p) {
    return std::tuple(p.y(), p.x(), p.z());
}

/// Lines in an order and a direction that do not depend on how they were given; rings closed.
Result<std::vector<Breakline>> orderedLines(std::vector<Breakline> lines) {
    for (Breakline& line : lines) {
        std::vector<Eigen::Vector3d>& v = line.vertices_m;
        const auto samePlace = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
            return a.x() == b.x() && a.y() == b.y();
        };
        if (isRing(line.kind) && !v.empty() && !samePlace(v.front(), v.back())) v.push_back(v.front());
        v.erase(std::unique(v.begin(), v.end(), samePlace), v.end());
        if (v.size() < (isRing(line.kind) ? 4U : 2U)) {
            return badData(fmt::format("{} has too few vertices at different places", line.name));
        }
        for (const Eigen::Vector3d& vertex : v) {
            if (!(vertex.head<2>().cwiseAbs().maxCoeff() <= 1e9) || std::isinf(vertex.z())) {
                return badData(fmt::format("{} has a vertex that is no place on Earth", line.name));
            }
        }
        if (isRing(line.kind)) {  // from its first place on, so that any start gives the same
            v.pop_back();
            std::rotate(
                v.begin(),
                std::min_element(v.begin(), v.end(),
                                 [](const auto& a, const auto& b) { return placeOf(a) < placeOf(b); }),
                v.end());
            v.push_back(v.front());
            if (placeOf(v[v.size() - 2]) < placeOf(v[1])) std::reverse(v.begin(), v.end());
        } else if (placeOf(v.back()) < placeOf(v.front())) {
            std::reverse(v.begin(), v.end());
        }
    }
    std::sort(lines.begin(), lines.end(), [](const Breakline& a, const Breakline& b) {
        if (a.kind != b.kind) return a.kind < b.kind;
        return std::lexicographical_compare(
            a.vertices_m.begin(), a.vertices_m.end(), b.vertices_m.begin(), b.vertices_m.end(),
            [](const auto& p, const auto& q) { return placeOf(p) < placeOf(q); });
    });
    return lines;
}

/// Square buckets of the nearness in plan, to find what lies within it.
class NearFinder {
  public:
    explicit NearFinder(double near_m) : near_m_(near_m) {}

    [[nodiscard]] std::optional<std::uint32_t> find(const std::vector<Eigen::Vector3d>& points_m,
                                                    const Eigen::Vector3d& at_m) const {
        const auto [column, row] = bucketOf(at_m);
        std::optional<std::uint32_t> nearest;
        double least = near_m_ * near_m_;
        for (std::int64_t c = column - 1; c <= column + 1; ++c) {
            for (std::int64_t r = row - 1; r <= row + 1; ++r) {
                const auto bucket = buckets_.find(key(c, r));
                if (bucket == buckets_.end()) continue;
                for (const std::uint32_t point : bucket->second) {
                    const double d = (points_m[point] - at_m).head<2>().squaredNorm();
                    if (d < least || (d == least && !nearest)) {
                        least = d;
                        nearest = point;
                    }
                }
            }
        }
        return nearest;
    }

    void add(const Eigen::Vector3d& at_m, std::uint32_t point) {
        const auto [column, row] = bucketOf(at_m);
        buckets_[key(column, row)].push_back(point);
    }

  private:
    [[nodiscard]] std::pair<std::int64_t, std::int64_t> bucketOf(const Eigen::Vector3d& at_m) const {
        const double side = near_m_ > 0.0 ? near_m_ : 1e-6;
        return {static_cast<std::int64_t>(std::floor(at_m.x() / side)),
                static_cast<std::int64_t>(std::floor(at_m.y() / side))};
    }
    // Two far buckets may share a key: distances decide.
    static std::uint64_t key(std::int64_t column, std::int64_t row) {
        return static_cast<std::uint64_t>(column) * 0x9E3779B97F4A7C15ULL ^
               static_cast<std::uint64_t>(row) * 0xD6E8FEB86659FD93ULL;
    }

    double near_m_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> buckets_;
};

struct Segment {
    std::uint32_t from;
    std::uint32_t to;
    std::size_t line;
};

/// All places, those of lines first, and the segments between them.
struct Input {
    std::vector<Eigen::Vector3d> places_m;
    std::vector<Segment> segments;
    std::size_t merged = 0;
};

/// Heights that a line does not have, from the points: of the TIN, or of the nearest point outside it.
Result<void> drape(std::vector<Breakline>& lines, const std::vector<Eigen::Vector3d>& points_m,
                   Progress& progress, const std::stop_token& stop) {
    const bool needed = std::any_of(lines.begin(), lines.end(), [](const Breakline& line) {
        return std::any_of(line.vertices_m.begin(), line.vertices_m.end(),
                           [](const Eigen::Vector3d& v) { return std::isnan(v.z()); });
    });
    if (!needed) return {};
    const auto tin = DelaunayTin::build(points_m, {1e10}, progress, stop);
    if (!tin) return tl::unexpected(tin.error());
    const PlanKdTree tree(tin->mesh().vertices_m);
    std::vector<Neighbour> nearest;
    for (Breakline& line : lines) {
        for (Eigen::Vector3d& v : line.vertices_m) {
            if (!std::isnan(v.z())) continue;
            if (const auto height = tin->heightAt(v.x(), v.y())) {
                v.z() = *height;
                continue;
            }
            tree.nearest(v.head<2>(), 1, nearest);
            v.z() = tin->mesh().vertices_m[nearest.front().point].z();
        }
    }
    return {};
}

Result<Input> inputOf(const std::vector<Eigen::Vector3d>& points_m, const std::vector<Breakline>& lines,
                      double near_m) {
    Input input;
    NearFinder finder(near_m);
    std::vector<std::size_t> line_of;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::optional<std::uint32_t> before;
        for (const Eigen::Vector3d& vertex : lines[i].vertices_m) {
            auto at = finder.find(input.places_m, vertex);
            if (at && std::abs(input.places_m[*at].z() - vertex.z()) > kGreatestHeightGap_m) {
                return badData(fmt::format("{} and {} meet at {:.3f}, {:.3f} at heights of {:.3f} and {:.3f}",
                                           lines[line_of[*at]].name, lines[i].name, vertex.x(), vertex.y(),
                                           input.places_m[*at].z(), vertex.z()),
                               {}, 0, "give the common vertex one height, or leave a gap between the lines");
            }
            if (!at) {
                at = static_cast<std::uint32_t>(input.places_m.size());
                input.places_m.push_back(vertex);
                line_of.push_back(i);
                finder.add(vertex, *at);
            }
            if (before && *before != *at) input.segments.push_back({*before, *at, i});
            before = at;
        }
    }
    const std::size_t line_places = input.places_m.size();
    std::vector<double> sums(line_places, 0.0);
    std::vector<std::size_t> counts(line_places, 0);
    for (const Eigen::Vector3d& point : placedHeights(points_m, {}).points_m) {
        const auto at = finder.find(input.places_m, point);
        if (!at) {
            finder.add(point, static_cast<std::uint32_t>(input.places_m.size()));
            input.places_m.push_back(point);
            sums.push_back(0.0);
            counts.push_back(1);
        } else {
            ++input.merged;
            sums[*at] += point.z() - input.places_m[*at].z();
            ++counts[*at];
        }
    }
    for (std::size_t i = line_places; i < input.places_m.size(); ++i) {
        input.places_m[i].z() += sums[i] / static_cast<double>(counts[i]);
    }
    return input;
}

bool cross(const std::vector<Eigen::Vector3d>& places_m, const Segment& a, const Segment& b) {
    if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) return false;
    const auto side = [&](std::uint32_t from, std::uint32_t to, std::uint32_t at) {
        return static_cast<int>(
            CGAL::orientation(plan(places_m[from]), plan(places_m[to]), plan(places_m[at])));
    };
    return side(a.from, a.to, b.from) * side(a.from, a.to, b.to) < 0 &&
           side(b.from, b.to, a.from) * side(b.from, b.to, a.to) < 0;
}

Eigen::Vector2d crossing(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                         const Eigen::Vector3d& d) {
    const Eigen::Vector2d ab = (b - a).head<2>();
    const Eigen::Vector2d cd = (d - c).head<2>();
    const Eigen::Vector2d ac = (c - a).head<2>();
    const double along = (ac.x() * cd.y() - ac.y() * cd.x()) / (ab.x() * cd.y() - ab.y() * cd.x());
    return a.head<2>() + along * ab;
}

/// Sweeps over the segments from west to east.
Result<void> checkCrossings(const Input& input, const std::vector<Breakline>& lines,
                            const std::stop_token& stop) {
    struct Span {
        double west, east, south, north;
        std::size_t segment;
    };
    std::vector<Span> spans;
    for (std::size_t i = 0; i < input.segments.size(); ++i) {
        const Eigen::Vector3d& a = input.places_m[input.segments[i].from];
        const Eigen::Vector3d& b = input.places_m[input.segments[i].to];
        spans.push_back({std::min(a.x(), b.x()), std::max(a.x(), b.x()), std::min(a.y(), b.y()),
                         std::max(a.y(), b.y()), i});
    }
    std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) {
        return std::tie(a.west, a.segment) < std::tie(b.west, b.segment);
    });
    std::vector<Span> open;
    for (const Span& span : spans) {
        if (stop.stop_requested()) return cancelled();
        std::erase_if(open, [&](const Span& other) { return other.east < span.west; });
        for (const Span& other : open) {
            if (other.north < span.south || other.south > span.north) continue;
            const Segment& a = input.segments[std::min(other.segment, span.segment)];
            const Segment& b = input.segments[std::max(other.segment, span.segment)];
            if (!cross(input.places_m, a, b)) continue;
            const Eigen::Vector2d at = crossing(input.places_m[a.from], input.places_m[a.to],
                                                input.places_m[b.from], input.places_m[b.to]);
            const std::string who =
                a.line == b.line ? fmt::format("{} crosses itself", lines[a.line].name)
                                 : fmt::format("{} and {} cross", lines[a.line].name, lines[b.line].name);
            return badData(fmt::format("{} at {:.3f}, {:.3f}", who, at.x(), at.y()), {}, 0,
                           "give both a vertex there, of one height, or end one of them before");
        }
        open.push_back(span);
    }
    return {};
}

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

Result<Triangulation> triangulate(const Input& input, Progress& progress, const std::stop_token& stop) {
    // In curve order each place lies near the one before. Sparse levels first: cost bounded for any
    // arrangement.
    const std::vector<std::uint32_t> order = curveOrder(input.places_m);
    Triangulation triangulation;
    std::vector<Triangulation::Vertex_handle> handles(input.places_m.size());
    Triangulation::Face_handle near;
    std::size_t done = 0;
    std::size_t stride = 1;
    while (stride * 4 < order.size()) stride *= 4;
    for (std::size_t level = stride;; level /= 4) {
        for (std::size_t i = 0; i < order.size(); i += level) {
            if (level != stride && i % (level * 4) == 0) continue;  // in already
            if (++done % kInsertionsBetweenChecks == 0) {
                if (stop.stop_requested()) return cancelled();
                progress.report(0.8 * static_cast<double>(done) / static_cast<double>(order.size()),
                                "triangulating");
            }
            const auto vertex = triangulation.insert(plan(input.places_m[order[i]]), near);
            vertex->info() = order[i];
            handles[order[i]] = vertex;
            near = vertex->face();
        }
        if (level == 1) break;
    }
    for (const Segment& segment : input.segments) {
        if (stop.stop_requested()) return cancelled();
        triangulation.insert_constraint(handles[segment.from], handles[segment.to]);
    }
    return triangulation;
}

/// Which lines run along an edge of triangles: a bit for each kind. A segment may have been cut by places
/// that lie on it.
std::map<std::uint64_t, std::uint8_t> kindsOfEdges(const Triangulation& triangulation, const Input& input,
                                                   const std::vector<Breakline>& lines) {
    std::vector<Triangulation::Vertex_handle> handles(input.places_m.size());
    for (const auto vertex : triangulation.finite_vertex_handles()) handles[vertex->info()] = vertex;
    std::map<std::uint64_t, std::uint8_t> kinds;
    for (const Segment& segment : input.segments) {
        const auto bit = static_cast<std::uint8_t>(1U << static_cast<unsigned>(lines[segment.line].kind));
        auto at = handles[segment.from];
        const auto end = handles[segment.to];
        while (at != end) {
            Triangulation::Vertex_handle next;
            Triangulation::Face_handle face;
            int index = 0;
            if (!triangulation.includes_edge(at, end, next, face, index)) break;
            kinds[edgeKey(at->info(), next->info())] |= bit;
            at = next;
        }
    }
    return kinds;
}

/// New numbers in curve order, as DelaunayTin has them.
TriangleMesh meshOf(const Triangulation& triangulation, const Input& input,
                    std::vector<std::uint32_t>& new_index) {
    const std::vector<std::uint32_t> order = curveOrder(input.places_m);
    TriangleMesh mesh;
    new_index.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        new_index[order[i]] = static_cast<std::uint32_t>(i);
        const Eigen::Vector3d& p = input.places_m[order[i]];
        mesh.vertices_m.emplace_back(p.x() + 0.0, p.y() + 0.0, p.z() + 0.0);
    }
    for (const auto face : triangulation.finite_face_handles()) {
        Triangle triangle{new_index[face->vertex(0)->info()], new_index[face->vertex(1)->info()],
                          new_index[face->vertex(2)->info()]};
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
        mesh.triangles.push_back(triangle);
    }
    std::sort(mesh.triangles.begin(), mesh.triangles.end());
    return mesh;
}

/// Kinds by triangle and side.
using SideKinds = std::vector<std::array<std::uint8_t, 3>>;

SideKinds sideKinds(const TriangleMesh& mesh, const std::map<std::uint64_t, std::uint8_t>& kinds,
                    const std::vector<std::uint32_t>& new_index) {
    std::unordered_map<std::uint64_t, std::uint8_t> renumbered;
    for (const auto& [key, bits] : kinds) {
        renumbered[edgeKey(new_index[key >> 32], new_index[key & 0xFFFF'FFFFU])] = bits;
    }
    SideKinds sides(mesh.triangles.size(), {0, 0, 0});
    for (std::size_t t = 0; t < mesh.triangles.size() && !renumbered.empty(); ++t) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto found = renumbered.find(
                edgeKey(mesh.triangles[t][(corner + 1) % 3], mesh.triangles[t][(corner + 2) % 3]));
            if (found != renumbered.end()) sides[t][corner] = found->second;
        }
    }
    return sides;
}

/// Triangles that can be reached from outside the hull without crossing a line of the kind.
std::vector<std::uint8_t> reachedFromOutside(const TriangleWalk& walk, const SideKinds& sides,
                                             BreaklineKind kind) {
    const auto closed = [&](std::uint32_t t, std::size_t corner) {
        return ((sides[t][corner] >> static_cast<unsigned>(kind)) & 1U) != 0;
    };
    std::vector<std::uint8_t> reached(sides.size(), 0);
    std::vector<std::uint32_t> open;
    const auto enter = [&](std::uint32_t t) {
        if (reached[t] != 0) return;
        reached[t] = 1;
        open.push_back(t);
    };
    for (std::uint32_t t = 0; t < sides.size(); ++t) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            if (walk.across(t, corner) == kNoTriangle && !closed(t, corner)) enter(t);
        }
    }
    while (!open.empty()) {
        const std::uint32_t t = open.back();
        open.pop_back();
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t other = walk.across(t, corner);
            if (other != kNoTriangle && !closed(t, corner)) enter(other);
        }
    }
    return reached;
}

TriangleExtent extentOf(const TriangleMesh& mesh, const Triangle& triangle) {
    const Eigen::Vector2d a = mesh.vertices_m[triangle[0]].head<2>();
    const Eigen::Vector2d ab = mesh.vertices_m[triangle[1]].head<2>() - a;
    const Eigen::Vector2d ac = mesh.vertices_m[triangle[2]].head<2>() - a;
    return {std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()})),
            0.5 * (ab.x() * ac.y() - ab.y() * ac.x())};
}

void markGround(const SideKinds& sides, const std::vector<Breakline>& lines, double longest_edge_m,
                ConstrainedTin& tin) {
    const TriangleWalk walk(tin.mesh);
    const auto hasKind = [&](BreaklineKind kind) {
        return std::any_of(lines.begin(), lines.end(), [&](const Breakline& l) { return l.kind == kind; });
    };
    const std::size_t count = tin.mesh.triangles.size();
    tin.ground.assign(count, 1);
    if (hasKind(BreaklineKind::Boundary)) {
        const auto outside = reachedFromOutside(walk, sides, BreaklineKind::Boundary);
        for (std::size_t t = 0; t < count; ++t) tin.ground[t] = outside[t] == 0 ? 1 : 0;
    }
    if (hasKind(BreaklineKind::Hole)) {
        const auto outside = reachedFromOutside(walk, sides, BreaklineKind::Hole);
        for (std::size_t t = 0; t < count; ++t) {
            if (outside[t] == 0) tin.ground[t] = 0;
        }
    }
    std::vector<TriangleExtent> extents;
    for (const Triangle& triangle : tin.mesh.triangles) extents.push_back(extentOf(tin.mesh, triangle));
    tin.longest_edge_m = longest_edge_m > 0.0 ? longest_edge_m
                         : hasKind(BreaklineKind::Boundary)
                             ? std::numeric_limits<double>::infinity()
                             : longestEdgeLimit(extents, tin.mesh.vertices_m.size());
    for (std::size_t t = 0; t < count; ++t) {
        if (extents[t].longest_edge_m > tin.longest_edge_m) tin.ground[t] = 0;
        if (tin.ground[t] != 0) tin.area_m2 += extents[t].area_m2;
    }
}

Result<ConstrainedTin> build(const std::vector<Eigen::Vector3d>& points_m, std::vector<Breakline> lines,
                             const ConstrainedTinOptions& options, Progress& progress,
                             const std::stop_token& stop) {
    if (auto done = drape(lines, points_m, progress, stop); !done) return tl::unexpected(done.error());
    const auto input = inputOf(points_m, lines, options.near_m);
    if (!input) return tl::unexpected(input.error());
    if (auto done = checkCrossings(*input, lines, stop); !done) return tl::unexpected(done.error());
    const auto triangulation = triangulate(*input, progress, stop);
    if (!triangulation) return tl::unexpected(triangulation.error());
    if (triangulation->number_of_faces() == 0) {
        return badData(fmt::format("{} places in plan, all on one line or too few, make no surface",
                                   input->places_m.size()));
    }
    ConstrainedTin tin;
    tin.merged = input->merged;
    std::vector<std::uint32_t> new_index;
    tin.mesh = meshOf(*triangulation, *input, new_index);
    const SideKinds sides = sideKinds(tin.mesh, kindsOfEdges(*triangulation, *input, lines), new_index);
    tin.breaks.assign(tin.mesh.triangles.size(), 0);
    for (std::size_t t = 0; t < sides.size(); ++t) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            for (const auto& [kind, text] : kBreaklineKinds) {
                const bool here = ((sides[t][corner] >> static_cast<unsigned>(kind)) & 1U) != 0;
                if (here && folds(kind)) tin.breaks[t] |= static_cast<std::uint8_t>(1U << corner);
            }
        }
    }
    markGround(sides, lines, options.longest_edge_m, tin);
    if (tin.area_m2 <= 0.0) {
        return badData(
            "no triangle is left within the boundary, outside the holes and below the longest edge", {}, 0,
            "check the rings, or allow a longer edge");
    }
    progress.report(1.0, "triangulating");
    return tin;
}

}  // namespace

TriangleMesh ConstrainedTin::groundMesh() const {
    TriangleMesh part;
    std::vector<std::uint32_t> new_index(mesh.vertices_m.size(), kNoTriangle);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (ground[t] == 0) continue;
        for (const std::uint32_t vertex : mesh.triangles[t]) new_index[vertex] = 0;
    }
    for (std::size_t v = 0; v < new_index.size(); ++v) {
        if (new_index[v] == kNoTriangle) continue;
        new_index[v] = static_cast<std::uint32_t>(part.vertices_m.size());
        part.vertices_m.push_back(mesh.vertices_m[v]);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (ground[t] == 0) continue;
        const Triangle& triangle = mesh.triangles[t];
        part.triangles.push_back({new_index[triangle[0]], new_index[triangle[1]], new_index[triangle[2]]});
    }
    return part;
}

Result<ConstrainedTin> buildConstrainedTin(const std::vector<Eigen::Vector3d>& points_m,
                                           const std::vector<Breakline>& breaklines,
                                           const ConstrainedTinOptions& options, Progress& progress,
                                           std::stop_token stop) {
    if (!(options.longest_edge_m >= 0.0)) return usageError("the longest edge may not be below zero");
    if (!(options.near_m >= 0.0) || !std::isfinite(options.near_m)) {
        return usageError("the distance of points that become one may not be below zero");
    }
    if (auto checked = checkCoordinates(points_m); !checked) return tl::unexpected(checked.error());
    auto lines = orderedLines(breaklines);
    if (!lines) return tl::unexpected(lines.error());
    try {
        if (points_m.empty() && lines->empty()) return badData("there is no point to make a surface of");
        return build(points_m, std::move(*lines), options, progress, stop);
    } catch (const std::bad_alloc&) {
        return systemError(fmt::format("not enough memory to triangulate {} points", points_m.size()), {},
                           "thin the points");
    } catch (const CGAL::Failure_exception& failure) {
        return systemError(fmt::format("the triangulation failed: {}", failure.what()));
    }
}

bool followsBreaklines(InterpolationMethod method) {
    return method == InterpolationMethod::Linear || method == InterpolationMethod::CloughTocher;
}

Result<InterpolatorPointer> fitInterpolator(InterpolationMethod method,
                                            std::shared_ptr<const ConstrainedTin> tin, std::stop_token stop) {
    std::shared_ptr<const TriangleMesh> mesh(tin, &tin->mesh);
    if (method == InterpolationMethod::Linear) return makeLinear(std::move(mesh));
    if (method == InterpolationMethod::CloughTocher) {
        auto surface = makeCloughTocher(std::move(mesh), tin->breaks, stop);
        if (stop.stop_requested()) return cancelled();
        return surface;
    }
    return usageError(fmt::format("method {} cannot follow breaklines", name(method)),
                      "use linear or clough-tocher");
}

}  // namespace terrawalk
