#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "survey/triangle_mesh.hpp"

namespace terrawalk {

/// Finds the triangle below a place in plan: square buckets over the mesh, each with the triangles whose
/// bounding box touches it. Built once, then constant; safe from any thread. The mesh is passed to each query
/// and must be the one that the locator was built for.
class TriangleLocator {
  public:
    explicit TriangleLocator(const TriangleMesh& mesh);

    /// Height by linear interpolation in the first triangle that holds the place, edges and vertices
    /// included; exactly the vertex's height at a vertex. Nothing outside the triangles or for a place that
    /// is not finite.
    [[nodiscard]] std::optional<double> heightAt(const TriangleMesh& mesh, double x_m, double y_m) const;

  private:
    [[nodiscard]] std::size_t columnOf(double x_m) const;
    [[nodiscard]] std::size_t rowOf(double y_m) const;
    /// Calls visit(bucket, triangle index) for every pair, triangles in rising order.
    template <class Visit>
    void visitBuckets(const TriangleMesh& mesh, Visit visit) const;
    [[nodiscard]] std::size_t entryCount(const TriangleMesh& mesh) const;
    void setBucketSize(double bucket_m);

    double west_m_ = 0.0, east_m_ = 0.0, south_m_ = 0.0, north_m_ = 0.0;
    double bucket_m_ = 1.0;
    std::size_t columns_ = 0, rows_ = 0;
    std::vector<std::size_t> begins_;  ///< bucket b holds entries_[begins_[b]] to entries_[begins_[b + 1]]
    std::vector<std::uint32_t> entries_;
};

/// Makes the locator at the first question: only who asks for heights pays for it. Safe from any thread.
class LocatorOnDemand {
  public:
    /// @param mesh  the same at each call
    [[nodiscard]] const TriangleLocator& of(const TriangleMesh& mesh) const {
        std::call_once(made_, [&] { locator_.emplace(mesh); });
        return *locator_;
    }

  private:
    mutable std::once_flag made_;
    mutable std::optional<TriangleLocator> locator_;
};

}  // namespace terrawalk
