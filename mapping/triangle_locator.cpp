#include "mapping/triangle_locator.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace terrawalk {
namespace {

struct Box {
    double west, east, south, north;
};

Box planBox(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
    const Eigen::Vector3d& a = mesh.vertices_m[triangle[0]];
    const Eigen::Vector3d& b = mesh.vertices_m[triangle[1]];
    const Eigen::Vector3d& c = mesh.vertices_m[triangle[2]];
    return {std::min({a.x(), b.x(), c.x()}), std::max({a.x(), b.x(), c.x()}), std::min({a.y(), b.y(), c.y()}),
            std::max({a.y(), b.y(), c.y()})};
}

/// Twice the area of (from, to, place), positive when the place lies left of the edge. Always computed from
/// the lower index to the higher, so that the two triangles on an edge see opposite values to the last bit
/// and no place falls between them.
double leftOfEdge(const TriangleMesh& mesh, std::uint32_t from, std::uint32_t to, double x_m, double y_m) {
    const Eigen::Vector3d& low = mesh.vertices_m[std::min(from, to)];
    const Eigen::Vector3d& high = mesh.vertices_m[std::max(from, to)];
    const double left = (low.x() - x_m) * (high.y() - y_m) - (low.y() - y_m) * (high.x() - x_m);
    return from < to ? left : -left;
}

std::optional<double> heightInTriangle(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle,
                                       double x_m, double y_m) {
    const auto [a, b, c] = triangle;
    const std::array<double, 3> weights{leftOfEdge(mesh, b, c, x_m, y_m), leftOfEdge(mesh, c, a, x_m, y_m),
                                        leftOfEdge(mesh, a, b, x_m, y_m)};
    const double sum = weights[0] + weights[1] + weights[2];
    if (!(weights[0] >= 0.0 && weights[1] >= 0.0 && weights[2] >= 0.0 && sum > 0.0)) {
        return std::nullopt;
    }
    // Differences from the vertex with the greatest weight: exact at each vertex.
    const auto base =
        static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
    const std::size_t second = (base + 1) % 3;
    const std::size_t third = (base + 2) % 3;
    const double z = mesh.vertices_m[triangle[base]].z();
    return z + (weights[second] * (mesh.vertices_m[triangle[second]].z() - z) +
                weights[third] * (mesh.vertices_m[triangle[third]].z() - z)) /
                   sum;
}

}  // namespace

TriangleLocator::TriangleLocator(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) {
        return;
    }
    Box all = planBox(mesh, mesh.triangles.front());
    for (const auto& triangle : mesh.triangles) {
        const Box box = planBox(mesh, triangle);
        all = {std::min(all.west, box.west), std::max(all.east, box.east), std::min(all.south, box.south),
               std::max(all.north, box.north)};
    }
    west_m_ = all.west;
    east_m_ = all.east;
    south_m_ = all.south;
    north_m_ = all.north;

    // About one bucket for each triangle. Long triangles across many buckets would make the lists grow
    // without bound: then larger buckets.
    const auto triangle_count = static_cast<double>(mesh.triangles.size());
    const double width = east_m_ - west_m_;
    const double height = north_m_ - south_m_;
    setBucketSize(
        std::max(std::sqrt(width * height / triangle_count), std::max(width, height) / triangle_count));
    while (columns_ * rows_ > 1 && entryCount(mesh) > 8 * mesh.triangles.size()) {
        setBucketSize(2.0 * bucket_m_);
    }

    begins_.assign(columns_ * rows_ + 1, 0);
    visitBuckets(mesh, [&](std::size_t bucket, std::uint32_t) { ++begins_[bucket + 1]; });
    for (std::size_t bucket = 0; bucket < columns_ * rows_; ++bucket) {
        begins_[bucket + 1] += begins_[bucket];
    }
    entries_.resize(begins_.back());
    std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
    visitBuckets(mesh,
                 [&](std::size_t bucket, std::uint32_t triangle) { entries_[next[bucket]++] = triangle; });
}

void TriangleLocator::setBucketSize(double bucket_m) {
    bucket_m_ = bucket_m > 0.0 ? bucket_m : 1.0;
    columns_ = static_cast<std::size_t>((east_m_ - west_m_) / bucket_m_) + 1;
    rows_ = static_cast<std::size_t>((north_m_ - south_m_) / bucket_m_) + 1;
}

std::size_t TriangleLocator::columnOf(double x_m) const {
    return std::min(static_cast<std::size_t>((x_m - west_m_) / bucket_m_), columns_ - 1);
}

std::size_t TriangleLocator::rowOf(double y_m) const {
    return std::min(static_cast<std::size_t>((y_m - south_m_) / bucket_m_), rows_ - 1);
}

template <class Visit>
void TriangleLocator::visitBuckets(const TriangleMesh& mesh, Visit visit) const {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Box box = planBox(mesh, mesh.triangles[t]);
        for (std::size_t row = rowOf(box.south); row <= rowOf(box.north); ++row) {
            for (std::size_t column = columnOf(box.west); column <= columnOf(box.east); ++column) {
                visit(row * columns_ + column, static_cast<std::uint32_t>(t));
            }
        }
    }
}

std::size_t TriangleLocator::entryCount(const TriangleMesh& mesh) const {
    std::size_t count = 0;
    for (const auto& triangle : mesh.triangles) {
        const Box box = planBox(mesh, triangle);
        count += (rowOf(box.north) - rowOf(box.south) + 1) * (columnOf(box.east) - columnOf(box.west) + 1);
    }
    return count;
}

std::optional<double> TriangleLocator::heightAt(const TriangleMesh& mesh, double x_m, double y_m) const {
    if (columns_ == 0 || !(x_m >= west_m_ && x_m <= east_m_ && y_m >= south_m_ && y_m <= north_m_)) {
        return std::nullopt;
    }
    const std::size_t bucket = rowOf(y_m) * columns_ + columnOf(x_m);
    for (std::size_t entry = begins_[bucket]; entry < begins_[bucket + 1]; ++entry) {
        if (const auto height = heightInTriangle(mesh, mesh.triangles[entries_[entry]], x_m, y_m)) {
            return height;
        }
    }
    return std::nullopt;
}

}  // namespace terrawalk
