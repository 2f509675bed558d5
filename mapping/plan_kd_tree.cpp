#include "mapping/plan_kd_tree.hpp"

#include <algorithm>
#include <nanoflann.hpp>

namespace terrawalk {
namespace {

struct PlanPoints {
    const std::vector<Eigen::Vector3d>& points_m;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points_m.size(); }
    [[nodiscard]] double kdtree_get_pt(std::uint32_t point, std::size_t axis) const {
        return points_m[point][static_cast<Eigen::Index>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;  // let the tree find it
    }
};

using Distance = nanoflann::L2_Simple_Adaptor<double, PlanPoints, double, std::uint32_t>;
using Index = nanoflann::KDTreeSingleIndexAdaptor<Distance, PlanPoints, 2, std::uint32_t>;

}  // namespace

struct PlanKdTree::Tree {
    PlanPoints points;
    Index index;
    explicit Tree(const std::vector<Eigen::Vector3d>& points_m)
        : points{points_m}, index(2, points, nanoflann::KDTreeSingleIndexAdaptorParams(12)) {}
};

PlanKdTree::PlanKdTree(const std::vector<Eigen::Vector3d>& points_m)
    : tree_(std::make_unique<Tree>(points_m)) {}
PlanKdTree::PlanKdTree(PlanKdTree&&) noexcept = default;
PlanKdTree::~PlanKdTree() = default;

void PlanKdTree::nearest(const Eigen::Vector2d& place_m, std::size_t count,
                         std::vector<Neighbour>& found) const {
    const std::size_t wanted = std::min(count, tree_->points.points_m.size());
    thread_local std::vector<std::uint32_t> points;
    thread_local std::vector<double> distances;
    points.resize(wanted);
    distances.resize(wanted);
    tree_->index.knnSearch(place_m.data(), wanted, points.data(), distances.data());
    found.resize(wanted);
    for (std::size_t i = 0; i < wanted; ++i) found[i] = {points[i], distances[i]};
}

}  // namespace terrawalk
