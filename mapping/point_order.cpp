#include "mapping/point_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace terrawalk {
namespace {

constexpr double kGreatestCoordinate_m = 1e9;  // beyond any map frame on Earth
constexpr int kCurveBits = 24;                 // per axis

/// Four levels of a Hilbert curve at once. Below a quarter the curve runs as it does on the whole, with the
/// axes exchanged (bit 0 of the state) or mirrored (bit 1).
struct CurveStep {
    std::uint8_t index;  ///< along the curve
    std::uint8_t state;  ///< for what lies below
};
constexpr int kLevelsAtOnce = 4;

/// By state, column and row.
constexpr std::array<CurveStep, 1024> kCurveSteps = [] {
    std::array<CurveStep, 1024> steps{};
    for (std::uint32_t at = 0; at < steps.size(); ++at) {
        std::uint32_t state = at >> 8U, index = 0;
        for (std::uint32_t bit = kLevelsAtOnce; bit-- > 0;) {
            const std::uint32_t column = (at >> (4U + bit)) & 1U, row = (at >> bit) & 1U;
            const std::uint32_t mirror = state >> 1U;
            const std::uint32_t right = ((state & 1U) != 0 ? row : column) ^ mirror;
            const std::uint32_t upper = ((state & 1U) != 0 ? column : row) ^ mirror;
            index = (index << 2U) | ((3U * right) ^ upper);
            state ^= (right & (upper ^ 1U)) << 1U;
            state ^= upper ^ 1U;
        }
        steps[at] = {static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(state)};
    }
    return steps;
}();

/// Place along a Hilbert curve over 2^24 x 2^24 cells. Neighbours on the curve are neighbours on the ground.
std::uint64_t hilbertIndex(std::uint32_t column, std::uint32_t row) {
    std::uint64_t index = 0;
    std::uint32_t state = 0;
    for (int bit = kCurveBits - kLevelsAtOnce; bit >= 0; bit -= kLevelsAtOnce) {
        const CurveStep& step =
            kCurveSteps[(state << 8U) | (((column >> bit) & 15U) << 4U) | ((row >> bit) & 15U)];
        index = (index << 8U) | step.index;
        state = step.state;
    }
    return index;
}

struct CurvePlace {
    std::uint64_t curve;
    std::uint32_t point;
};

/// By the curve, then by coordinates. First into buckets by the leading bits, which is most of the work done
/// in one pass.
void sortAlongCurve(std::vector<CurvePlace>& places, const std::vector<Eigen::Vector3d>& points_m) {
    constexpr int kBucketShift = 2 * kCurveBits - 12;
    std::array<std::size_t, (1U << 12) + 1> begins{};
    for (const CurvePlace& place : places) {
        ++begins[(place.curve >> kBucketShift) + 1];
    }
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<CurvePlace> sorted(places.size());
    auto next = begins;
    for (const CurvePlace& place : places) {
        sorted[next[place.curve >> kBucketShift]++] = place;
    }
    const auto before = [&](const CurvePlace& a, const CurvePlace& b) {
        if (a.curve != b.curve) {
            return a.curve < b.curve;
        }
        const Eigen::Vector3d& p = points_m[a.point];
        const Eigen::Vector3d& q = points_m[b.point];
        return std::tuple(p.y(), p.x(), p.z()) < std::tuple(q.y(), q.x(), q.z());
    };
    for (std::size_t bucket = 0; bucket + 1 < begins.size(); ++bucket) {
        std::sort(sorted.data() + begins[bucket], sorted.data() + begins[bucket + 1], before);
    }
    places.swap(sorted);
}

Eigen::Vector3d withoutMinusZero(const Eigen::Vector3d& point_m) {
    return {point_m.x() + 0.0, point_m.y() + 0.0, point_m.z() + 0.0};
}

}  // namespace

Result<void> checkCoordinates(const std::vector<Eigen::Vector3d>& points_m) {
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        if (!(points_m[i].cwiseAbs().maxCoeff() <= kGreatestCoordinate_m) || !points_m[i].allFinite()) {
            return badData(fmt::format("ground point {} of {} is no place on Earth: {}, {}, {}", i + 1,
                                       points_m.size(), points_m[i].x(), points_m[i].y(), points_m[i].z()));
        }
    }
    return {};
}

std::vector<std::uint32_t> curveOrder(const std::vector<Eigen::Vector3d>& points_m) {
    Eigen::Vector3d low = points_m.front();
    Eigen::Vector3d high = points_m.front();
    for (const Eigen::Vector3d& point : points_m) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }
    const double extent = std::max(high.x() - low.x(), high.y() - low.y());
    const double cells_per_metre = extent > 0.0 ? (std::ldexp(1.0, kCurveBits) - 1.0) / extent : 0.0;

    std::vector<CurvePlace> places(points_m.size());
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        places[i] = {hilbertIndex(static_cast<std::uint32_t>((points_m[i].x() - low.x()) * cells_per_metre),
                                  static_cast<std::uint32_t>((points_m[i].y() - low.y()) * cells_per_metre)),
                     static_cast<std::uint32_t>(i)};
    }
    sortAlongCurve(places, points_m);
    std::vector<std::uint32_t> order(places.size());
    std::transform(places.begin(), places.end(), order.begin(),
                   [](const CurvePlace& place) { return place.point; });
    return order;
}

std::vector<Eigen::Vector3d> inCurveOrder(const std::vector<Eigen::Vector3d>& points_m) {
    const std::vector<std::uint32_t> order = curveOrder(points_m);
    std::vector<Eigen::Vector3d> ordered(points_m.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        ordered[i] = withoutMinusZero(points_m[order[i]]);
    }
    return ordered;
}

void mergeSamePlaces(std::vector<Eigen::Vector3d>& points_m) {
    std::size_t kept = 0;
    for (std::size_t begin = 0; begin < points_m.size();) {
        const Eigen::Vector3d first = points_m[begin];
        double above_first = 0.0;
        std::size_t end = begin;
        while (end < points_m.size() && points_m[end].x() == first.x() && points_m[end].y() == first.y()) {
            above_first += points_m[end].z() - first.z();
            ++end;
        }
        const double mean = first.z() + above_first / static_cast<double>(end - begin);
        points_m[kept++] = {first.x(), first.y(), mean};
        begin = end;
    }
    points_m.resize(kept);
}

PlacedHeights placedHeights(const std::vector<Eigen::Vector3d>& points_m,
                            const std::vector<double>& sigmas_m) {
    PlacedHeights placed;
    if (points_m.empty()) return placed;
    if (sigmas_m.empty()) {
        placed.points_m = inCurveOrder(points_m);
        mergeSamePlaces(placed.points_m);
        return placed;
    }
    const std::vector<std::uint32_t> order = curveOrder(points_m);
    const auto samePlace = [&](std::uint32_t a, std::uint32_t b) {
        return points_m[a].x() == points_m[b].x() && points_m[a].y() == points_m[b].y();
    };
    for (std::size_t begin = 0; begin < order.size();) {
        std::vector<Eigen::Vector3d> here_m;
        std::vector<double> variances_m2;
        std::size_t end = begin;
        for (; end < order.size() && samePlace(order[begin], order[end]); ++end) {
            here_m.push_back(withoutMinusZero(points_m[order[end]]));
            variances_m2.push_back(sigmas_m[order[end]] * sigmas_m[order[end]]);
        }
        mergeSamePlaces(here_m);
        // Sorted, so that the rounding of the sum does not depend on the order either.
        std::sort(variances_m2.begin(), variances_m2.end());
        placed.points_m.push_back(here_m.front());
        placed.sigmas_m.push_back(std::sqrt(std::accumulate(variances_m2.begin(), variances_m2.end(), 0.0)) /
                                  static_cast<double>(variances_m2.size()));
        begin = end;
    }
    return placed;
}

}  // namespace terrawalk
