#include "mapping/edge_strips.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mapping/order_statistics.hpp"

namespace terrawalk {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// One pair of opposite vertices.
struct Rung {
    Vector3d toe_m;
    Vector3d top_m;
    const RiserPlace* place;
};

Rung rungOf(const RiserPlace& place) {
    const auto [toe, top] = faceOf(place);
    return {{toe.x(), toe.y(), place.height_m - 0.5 * place.step_m},
            {top.x(), top.y(), place.height_m + 0.5 * place.step_m},
            &place};
}

double cross(const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

bool meet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
    const auto side = [](const Vector2d& from, const Vector2d& to, const Vector2d& at) {
        return cross(to - from, at - from);
    };
    return side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0;
}

using Outline = std::array<std::pair<Vector2d, Vector2d>, 4>;

/// The quadrilateral between two rungs, a little larger, so that lines keep a distance.
Outline outlineOf(const Rung& a, const Rung& b) {
    static constexpr double kWider = 0.1;
    const auto wider = [](const Vector3d& from, const Vector3d& to) -> Vector2d {
        return (to + kWider * (to - from)).head<2>();
    };
    const Vector2d a_toe = wider(a.top_m, a.toe_m), a_top = wider(a.toe_m, a.top_m);
    const Vector2d b_toe = wider(b.top_m, b.toe_m), b_top = wider(b.toe_m, b.top_m);
    return {{{a_toe, b_toe}, {a_top, b_top}, {a_toe, a_top}, {b_toe, b_top}}};
}

bool advances(const Rung& a, const Rung& b) {
    const Vector2d ahead = a.place->frame.ahead();
    return (b.toe_m - a.toe_m).head<2>().dot(ahead) > 0.0 && (b.top_m - a.top_m).head<2>().dot(ahead) > 0.0;
}

TerraceEdge edgeOf(const std::vector<Rung>& rungs, const Vector2d& origin_m) {
    TerraceEdge edge;
    std::vector<double> steps_m, sigmas_m;
    const Vector3d moved(origin_m.x(), origin_m.y(), 0.0);
    for (const Rung& rung : rungs) {
        edge.toe_m.emplace_back(rung.toe_m + moved);
        edge.top_m.emplace_back(rung.top_m + moved);
        steps_m.push_back(rung.place->step_m);
        sigmas_m.push_back(rung.place->location_sigma_m);
    }
    for (std::size_t i = 1; i < rungs.size(); ++i) {
        const Vector3d way = edge.toe_m[i] + edge.top_m[i] - edge.toe_m[i - 1] - edge.top_m[i - 1];
        edge.length_m += 0.5 * way.head<2>().norm();
    }
    edge.step_m = median(steps_m);
    edge.location_sigma_m = median(sigmas_m);
    return edge;
}

}  // namespace

template <class See>
bool EdgeStrips::visitCells(const Segment& segment, See see) const {
    const Vector2d low = segment.first.cwiseMin(segment.second) / cell_m_;
    const Vector2d high = segment.first.cwiseMax(segment.second) / cell_m_;
    for (double r = std::floor(low.y()); r <= std::floor(high.y()); r += 1.0) {
        for (double c = std::floor(low.x()); c <= std::floor(high.x()); c += 1.0) {
            if (see(std::pair{r, c})) return true;
        }
    }
    return false;
}

bool EdgeStrips::isFree(const Segment& segment) const {
    return !visitCells(segment, [&](const std::pair<double, double>& cell) {
        const auto found = occupied_.find(cell);
        return found != occupied_.end() &&
               std::any_of(found->second.begin(), found->second.end(), [&](const Segment& other) {
                   return meet(segment.first, segment.second, other.first, other.second);
               });
    });
}

void EdgeStrips::occupy(const Segment& segment) {
    visitCells(segment, [&](const std::pair<double, double>& cell) {
        occupied_[cell].push_back(segment);
        return false;
    });
}

void EdgeStrips::keepClearOf(const Breakline& line) {
    std::vector<Vector2d> places_m;
    for (const Vector3d& vertex : line.vertices_m) places_m.emplace_back(vertex.head<2>() - origin_m_);
    const bool ring = line.kind == BreaklineKind::Boundary || line.kind == BreaklineKind::Hole;
    if (ring && !places_m.empty()) places_m.push_back(places_m.front());
    for (std::size_t i = 1; i < places_m.size(); ++i) {
        // In pieces no longer than a cell, so that each lies in few of them.
        const Vector2d way = places_m[i] - places_m[i - 1];
        const double parts = std::max(1.0, std::ceil(way.norm() / cell_m_));
        for (double k = 0.0; k < parts; k += 1.0) {
            occupy({places_m[i - 1] + k / parts * way, places_m[i - 1] + (k + 1.0) / parts * way});
        }
    }
}

bool EdgeStrips::onGround(const Vector2d& at_m) const {
    return tin_.heightAt(at_m.x() + origin_m_.x(), at_m.y() + origin_m_.y()).has_value();
}

void EdgeStrips::add(const std::vector<RiserPlace>& line) {
    std::vector<std::vector<Rung>> pieces(1);
    // A line may not meet itself either, but it touches the two outlines right before.
    constexpr std::size_t kTouching = 2;
    std::vector<Outline> outlines;
    const auto occupyFrom = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            for (const Segment& side : outlines[i]) occupy(side);
        }
    };
    std::size_t occupied = 0;
    for (const RiserPlace& place : line) {
        const Rung rung = rungOf(place);
        std::vector<Rung>& piece = pieces.back();
        if (!place.holds || !onGround(rung.toe_m.head<2>()) || !onGround(rung.top_m.head<2>())) {
            if (!piece.empty()) pieces.emplace_back();
            continue;
        }
        if (piece.empty()) {
            piece.push_back(rung);
            continue;
        }
        if (!advances(piece.back(), rung)) continue;
        const Outline outline = outlineOf(piece.back(), rung);
        if (!std::all_of(outline.begin(), outline.end(), [&](const Segment& side) { return isFree(side); })) {
            pieces.emplace_back();
            continue;
        }
        outlines.push_back(outline);
        piece.push_back(rung);
        if (outlines.size() > kTouching) {
            occupyFrom(occupied, outlines.size() - kTouching);
            occupied = outlines.size() - kTouching;
        }
    }
    occupyFrom(occupied, outlines.size());
    for (const std::vector<Rung>& piece : pieces) {
        if (piece.size() < 2) continue;
        TerraceEdge edge = edgeOf(piece, origin_m_);
        if (edge.length_m < options_.least_length_m || edge.step_m < options_.least_step_m) continue;
        edges_.push_back(std::move(edge));
    }
}

}  // namespace terrawalk
