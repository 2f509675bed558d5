#include "mapping/space_occupancy.hpp"

#include <fmt/format.h>

#define OCTOMAP_NODEBUGOUT  // it would print
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Of the cell and its eight neighbours.
double highestAround(const ElevationGrid& ground, std::size_t row, std::size_t column) {
    const GridGeometry& g = ground.geometry;
    double highest_m = -std::numeric_limits<double>::infinity();
    for (std::size_t r = row == 0 ? 0 : row - 1; r <= std::min(row + 1, g.rows - 1); ++r) {
        for (std::size_t c = column == 0 ? 0 : column - 1; c <= std::min(column + 1, g.columns - 1); ++c) {
            const double height_m = ground.at(r, c);
            if (height_m > highest_m) highest_m = height_m;
        }
    }
    return highest_m;
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

    /// Middles of the voxel columns that stand on a cell; that of its centre where none has its middle there.
    [[nodiscard]] std::vector<Eigen::Vector2d> voxelColumns(const GridGeometry& g, std::size_t row,
                                                            std::size_t column) const {
        const double voxel_m = options.voxel_m;
        const auto middlesIn = [&](double low_m, double origin_m) {
            std::vector<double> middles;
            const auto first = std::ceil((low_m - origin_m) / voxel_m - 0.5);
            for (double k = first; origin_m + (k + 0.5) * voxel_m < low_m + g.cell_m; k += 1.0) {
                middles.push_back(origin_m + (k + 0.5) * voxel_m);
            }
            if (middles.empty()) middles.push_back(low_m + 0.5 * g.cell_m);
            return middles;
        };
        const double half_m = 0.5 * g.cell_m;
        std::vector<Eigen::Vector2d> columns;
        for (const double x : middlesIn(g.centreX(column) - half_m, options.origin_m.x())) {
            for (const double y : middlesIn(g.centreY(row) - half_m, options.origin_m.y()))
                columns.emplace_back(x, y);
        }
        return columns;
    }

    /// Shows `take` the voxels above the ground layer with the height of their bottoms above ground, upwards,
    /// until it has seen enough.
    template <class Take>
    void climb(const Eigen::Vector2d& at_m, double ground_m, const FreeHeightOptions& above,
               Take take) const {
        if (std::isnan(ground_m)) return;
        const double origin_m = options.origin_m.z();
        const auto first =
            static_cast<long>(std::ceil((ground_m + above.ground_layer_m - origin_m) / options.voxel_m));
        for (long k = first;; ++k) {
            const double bottom_m = origin_m + static_cast<double>(k) * options.voxel_m;
            if (bottom_m - ground_m >= above.greatest_height_m) return;
            const Space space = at({at_m.x(), at_m.y(), bottom_m + 0.5 * options.voxel_m});
            if (!take(bottom_m - ground_m, space)) return;
        }
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
    // The header as in OctoMap's own writeBinary(), which prints to standard error.
    std::ostringstream bytes(std::ios::binary);
    bytes << fmt::format("# Octomap OcTree binary file\n#\nid {}\nsize {}\nres {}\ndata\n",
                         impl_->tree.getTreeType(), impl_->tree.size(), impl_->tree.getResolution());
    if (!impl_->tree.writeBinaryData(bytes)) return systemError("the octree cannot be written");
    return bytes.str();
}

Result<std::string> SpaceOccupancy::fullTree() const {
    std::ostringstream bytes(std::ios::binary);
    if (!impl_->tree.write(bytes) || !bytes) return systemError("the octree cannot be written");
    return bytes.str();
}

Result<SpaceAboveGround> SpaceOccupancy::aboveGround(const ElevationGrid& ground,
                                                     const FreeHeightOptions& options, Progress& progress,
                                                     std::stop_token stop) const {
    const GridGeometry& g = ground.geometry;
    PartialProgress first_half(progress, 0.0, 0.5);
    auto obstacles = gridOf(g, "obstacles", first_half, stop, [&](std::size_t row, std::size_t column) {
        const double ground_m = ground.at(row, column);
        const double around_m = highestAround(ground, row, column);
        double lowest_m = std::numeric_limits<double>::infinity();
        for (const Eigen::Vector2d& at : impl_->voxelColumns(g, row, column)) {
            impl_->climb(at, ground_m, options, [&](double above_m, Space space) {
                const bool is_obstacle =
                    space == Space::Occupied && ground_m + above_m >= around_m + options.ground_layer_m;
                if (is_obstacle) lowest_m = std::min(lowest_m, above_m);
                return !is_obstacle;
            });
        }
        return std::isinf(lowest_m) ? double{kNoHeight} : lowest_m;
    });
    if (!obstacles) return tl::unexpected(obstacles.error());
    PartialProgress second_half(progress, 0.5, 1.0);
    auto free_height = gridOf(g, "free height", second_half, stop, [&](std::size_t row, std::size_t column) {
        const double ground_m = ground.at(row, column);
        if (std::isnan(ground_m)) return double{kNoHeight};
        double free_m = 0.0;
        bool seen = false;
        for (const Eigen::Vector2d& at : impl_->voxelColumns(g, row, column)) {
            impl_->climb(at, ground_m, options, [&](double above_m, Space space) {
                seen = seen || space != Space::Unknown;
                if (space == Space::Free) free_m = std::max(free_m, above_m + impl_->options.voxel_m);
                return space == Space::Free;
            });
        }
        const double obstacle_m = obstacles->at(row, column);
        if (!seen && std::isnan(obstacle_m)) return double{kNoHeight};  // no ray went here
        return std::isnan(obstacle_m) ? free_m : std::min(free_m, obstacle_m);
    });
    if (!free_height) return tl::unexpected(free_height.error());
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
