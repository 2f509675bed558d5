#include "mapping/space_occupancy.hpp"

#include <fmt/format.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mapping/grid_rows.hpp"

namespace terrawalk {

namespace {

constexpr std::size_t kRaysBetweenStops = 1024;
constexpr double kVoxelsToEachSide = 32768.0;
constexpr double kBytesPerVoxel = 60.0;  // a leaf, its share of inner nodes and of pointer blocks

octomap::point3d pointOf(const Eigen::Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Result<void> checkRays(const std::vector<LaserRay>& rays, const OccupancyOptions& options) {
    if (!(options.voxel_m > 0.0) || !(options.greatest_range_m > 0.0)) {
        return usageError("voxels and ranges must be above zero");
    }
    const double reach_m = options.voxel_m * (kVoxelsToEachSide - 2.0);
    for (const LaserRay& ray : rays) {
        for (const Eigen::Vector3d& end : {ray.from_m, ray.hit_m}) {
            if (!((end - options.origin_m).cwiseAbs().maxCoeff() < reach_m)) {
                return usageError(
                    fmt::format("rays reach farther than {:.0f} m from the origin of the tree", reach_m),
                    "choose larger voxels");
            }
        }
    }
    return {};
}

}  // namespace

struct SpaceOccupancy::Impl {
    explicit Impl(const OccupancyOptions& o) : options(o), tree(o.voxel_m) {}

    [[nodiscard]] Space at(const Eigen::Vector3d& map_m) const {
        const Eigen::Vector3d p = map_m - options.origin_m;
        octomap::OcTreeKey key;
        if (!tree.coordToKeyChecked(p.x(), p.y(), p.z(), key)) return Space::Unknown;
        const octomap::OcTreeNode* const node = tree.search(key);
        if (node == nullptr) return Space::Unknown;
        return tree.isNodeOccupied(node) ? Space::Occupied : Space::Free;
    }

    OccupancyOptions options;
    octomap::OcTree tree;
};

SpaceOccupancy::SpaceOccupancy(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SpaceOccupancy::SpaceOccupancy(SpaceOccupancy&&) noexcept = default;
SpaceOccupancy& SpaceOccupancy::operator=(SpaceOccupancy&&) noexcept = default;
SpaceOccupancy::~SpaceOccupancy() = default;

Result<SpaceOccupancy> SpaceOccupancy::build(const std::vector<LaserRay>& rays,
                                             const OccupancyOptions& options, Progress& progress,
                                             std::stop_token stop) {
    if (auto checked = checkRays(rays, options); !checked) return tl::unexpected(checked.error());
    auto impl = std::make_unique<Impl>(options);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (i % kRaysBetweenStops == 0) {
            if (stop.stop_requested()) return cancelled();
            progress.report(static_cast<double>(i) / static_cast<double>(rays.size()),
                            "following laser rays");
        }
        impl->tree.insertRay(pointOf(rays[i].from_m - options.origin_m),
                             pointOf(rays[i].hit_m - options.origin_m), options.greatest_range_m, true);
    }
    impl->tree.updateInnerOccupancy();
    impl->tree.prune();
    return SpaceOccupancy(std::move(impl));
}

Space SpaceOccupancy::at(const Eigen::Vector3d& map_m) const {
    return impl_->at(map_m);
}

double SpaceOccupancy::volume_m3(Space kind) const {
    double volume_m3 = 0.0;
    for (auto leaf = impl_->tree.begin_leafs(); leaf != impl_->tree.end_leafs(); ++leaf) {
        const Space own = impl_->tree.isNodeOccupied(*leaf) ? Space::Occupied : Space::Free;
        if (own == kind) volume_m3 += std::pow(leaf.getSize(), 3);
    }
    return volume_m3;
}

Result<std::string> SpaceOccupancy::binaryTree() const {
    std::ostringstream bytes(std::ios::binary);
    if (!impl_->tree.writeBinaryConst(bytes) || !bytes) return systemError("the octree cannot be written");
    return bytes.str();
}

Result<std::string> SpaceOccupancy::fullTree() const {
    std::ostringstream bytes(std::ios::binary);
    if (!impl_->tree.write(bytes) || !bytes) return systemError("the octree cannot be written");
    return bytes.str();
}

Result<SpaceAboveGround> SpaceOccupancy::aboveGround(const ElevationGrid& ground,
                                                     const AboveGroundOptions& options, Progress& progress,
                                                     std::stop_token stop) const {
    const GridGeometry& g = ground.geometry;
    const double voxel_m = impl_->options.voxel_m;
    const double origin_z_m = impl_->options.origin_m.z();
    /// Bottoms of the voxels above the ground layer, upwards, until `take` has seen enough.
    const auto climb = [&](std::size_t row, std::size_t column, double ground_m, auto take) {
        const auto first =
            static_cast<long>(std::ceil((ground_m + options.ground_layer_m - origin_z_m) / voxel_m));
        for (long k = first;; ++k) {
            const double bottom_m = origin_z_m + static_cast<double>(k) * voxel_m;
            const double above_m = bottom_m - ground_m;
            if (above_m >= options.greatest_height_m) return;
            const Space space = impl_->at({g.centreX(column), g.centreY(row), bottom_m + 0.5 * voxel_m});
            if (!take(above_m, space)) return;
        }
    };
    PartialProgress first_half(progress, 0.0, 0.5);
    auto free_height = gridOf(g, "free height", first_half, stop, [&](std::size_t row, std::size_t column) {
        const double ground_m = ground.at(row, column);
        if (std::isnan(ground_m)) return double{kNoHeight};
        double free_m = 0.0;
        climb(row, column, ground_m, [&](double above_m, Space space) {
            if (space == Space::Free) free_m = above_m + voxel_m;
            return space == Space::Free;
        });
        return free_m;
    });
    if (!free_height) return tl::unexpected(free_height.error());
    PartialProgress second_half(progress, 0.5, 1.0);
    auto obstacles = gridOf(g, "obstacles", second_half, stop, [&](std::size_t row, std::size_t column) {
        const double ground_m = ground.at(row, column);
        double lowest_m = kNoHeight;
        if (std::isnan(ground_m)) return lowest_m;
        climb(row, column, ground_m, [&](double above_m, Space space) {
            if (space == Space::Occupied) lowest_m = above_m;
            return space != Space::Occupied;
        });
        return lowest_m;
    });
    if (!obstacles) return tl::unexpected(obstacles.error());
    return SpaceAboveGround{std::move(*free_height), std::move(*obstacles)};
}

double occupancyMemory_bytes(const std::vector<LaserRay>& rays, const OccupancyOptions& options) {
    double voxels = 0.0;
    for (const LaserRay& ray : rays) {
        const double length_m = std::min((ray.hit_m - ray.from_m).norm(), options.greatest_range_m);
        // A line of that length crosses at most so many voxels in each direction, and one more.
        voxels += 1.0 + std::sqrt(3.0) * length_m / options.voxel_m;
    }
    return kBytesPerVoxel * voxels;
}

}  // namespace terrawalk
