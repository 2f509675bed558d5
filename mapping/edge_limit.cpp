#include "mapping/edge_limit.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace terrawalk {
namespace {

constexpr double kShareAlongTrack = 0.02;
constexpr double kTimesMedianEdge = 2.5;
constexpr double kTimesPointSpacing = 4.0;

/// Positive doubles rise with their bit patterns: exponent and eight bits of mantissa give bins of 0.2 to 0.4
/// %.
constexpr int kDroppedBits = 44;

std::uint64_t binOf(double length_m) {
    return std::bit_cast<std::uint64_t>(length_m) >> kDroppedBits;
}

double upperEndOf(std::uint64_t bin) {
    return std::bit_cast<double>((bin + 1) << kDroppedBits);
}

struct Bin {
    double area_m2 = 0.0;
    double faced_track_m = 0.0;
};

/// Triangles by their longest edge.
struct EdgeHistogram {
    std::uint64_t first_bin = 0;
    std::vector<Bin> bins;
    double area_m2 = 0.0;
};

EdgeHistogram edgeHistogram(const std::vector<TriangleExtent>& triangles) {
    double shortest = std::numeric_limits<double>::max();
    double longest = 0.0;
    for (const TriangleExtent& triangle : triangles) {
        if (triangle.area_m2 > 0.0) {
            shortest = std::min(shortest, triangle.longest_edge_m);
            longest = std::max(longest, triangle.longest_edge_m);
        }
    }
    EdgeHistogram histogram;
    if (longest == 0.0) {
        return histogram;
    }
    histogram.first_bin = binOf(shortest);
    histogram.bins.resize(binOf(longest) - histogram.first_bin + 1);
    for (const TriangleExtent& triangle : triangles) {
        if (triangle.area_m2 > 0.0) {
            Bin& bin = histogram.bins[binOf(triangle.longest_edge_m) - histogram.first_bin];
            bin.area_m2 += triangle.area_m2;
            bin.faced_track_m += 2.0 * triangle.area_m2 / triangle.longest_edge_m;
            histogram.area_m2 += triangle.area_m2;
        }
    }
    return histogram;
}

double medianEdge(const EdgeHistogram& histogram) {
    std::size_t first = 0;
    for (double area = histogram.bins[0].area_m2; area < kShareAlongTrack * histogram.area_m2;) {
        area += histogram.bins[++first].area_m2;
    }
    double faced = 0.0;
    for (std::size_t bin = first; bin < histogram.bins.size(); ++bin) {
        faced += histogram.bins[bin].faced_track_m;
    }
    std::size_t median = first;
    for (double below = histogram.bins[first].faced_track_m; below < 0.5 * faced;) {
        below += histogram.bins[++median].faced_track_m;
    }
    return upperEndOf(histogram.first_bin + median);
}

double areaUpTo(const EdgeHistogram& histogram, double length_m) {
    double area = 0.0;
    for (std::size_t bin = 0; bin < histogram.bins.size(); ++bin) {
        if (upperEndOf(histogram.first_bin + bin) <= length_m) {
            area += histogram.bins[bin].area_m2;
        }
    }
    return area;
}

}  // namespace

double longestEdgeLimit(const std::vector<TriangleExtent>& triangles, std::size_t points) {
    const EdgeHistogram histogram = edgeHistogram(triangles);
    if (histogram.bins.empty() || points == 0) {
        return 0.0;
    }
    const double limit = kTimesMedianEdge * medianEdge(histogram);
    const double spacing = std::sqrt(areaUpTo(histogram, limit) / static_cast<double>(points));
    return std::max(limit, kTimesPointSpacing * spacing);
}

}  // namespace terrawalk
