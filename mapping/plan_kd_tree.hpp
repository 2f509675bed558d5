#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

namespace terrawalk {

struct Neighbour {
    std::uint32_t point;
    double squared_distance_m2;
};

/// The nearest points in plan (k-d tree, nanoflann). Keeps a reference to the points. Immutable; safe from
/// any thread.
class PlanKdTree {
  public:
    explicit PlanKdTree(const std::vector<Eigen::Vector3d>& points_m);
    PlanKdTree(PlanKdTree&&) noexcept;
    ~PlanKdTree();

    /// The `count` nearest, nearest first, or all where there are fewer. Which of several at the same
    /// distance comes first depends on the points alone.
    void nearest(const Eigen::Vector2d& place_m, std::size_t count, std::vector<Neighbour>& found) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace terrawalk
