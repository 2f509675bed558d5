#pragma once

#include <Eigen/Core>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "survey/elevation_grid.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// The way of one laser shot that came back: from the range finder to what it hit. Map frame [m].
struct LaserRay {
    Eigen::Vector3d from_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d hit_m = Eigen::Vector3d::Zero();
};

struct OccupancyOptions {
    double voxel_m = 0.1;
    double greatest_range_m = 12.0;  ///< of a longer shot the first part counts as free, its hit for nothing
    /// Voxel sides lie at multiples of the voxel from here, and the files' coordinates count from here: the
    /// tree holds 32768 voxels to each side.
    Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
};

enum class Space { Unknown, Free, Occupied };

/// What is known of the space above ground. Heights above the ground [m].
struct SpaceAboveGround {
    /// How far up space is known to be free without a break, from the ground layer on, in the best of the
    /// cell's voxel columns but not above its lowest obstacle; 0 under an obstacle that hides the space
    /// right above the ground layer, NaN where nothing is known of that space.
    ElevationGrid free_height;
    /// Bottom of the lowest occupied voxel in any of the cell's voxel columns that stands above the ground
    /// layer of the cell and of its eight neighbours, so that no riser counts as obstacle over its own foot;
    /// NaN where none is known.
    ElevationGrid obstacle_height;
};
struct FreeHeightOptions {
    double ground_layer_m = 0.3;  ///< voxels with their bottom lower than this above ground count as ground
    double greatest_height_m = 5.0;
};

/// All that a map of the space takes; the defaults of every front end.
struct SpaceMapOptions {
    OccupancyOptions occupancy;  ///< whoever makes the map sets the origin
    FreeHeightOptions above;
};

/// Occupancy of the space that laser rays crossed: voxels in an octree, each with the log-odds of being
/// occupied from the rays that ended in it or passed through it, in their order. Source: Hornung et al. 2013,
/// "OctoMap: an efficient probabilistic 3D mapping framework based on octrees", with its default sensor model
/// (hit 0.7, miss 0.4, clamped to 0.12 and 0.97).
class SpaceOccupancy {
  public:
    /// Serial; the same bytes everywhere. Errors: Usage for a voxel or a range that is not above zero, and
    /// for rays that leave the tree; Cancelled.
    [[nodiscard]] static Result<SpaceOccupancy> build(const std::vector<LaserRay>& rays,
                                                      const OccupancyOptions& options, Progress& progress,
                                                      std::stop_token stop);
    SpaceOccupancy(SpaceOccupancy&&) noexcept;
    SpaceOccupancy& operator=(SpaceOccupancy&&) noexcept;
    ~SpaceOccupancy();

    [[nodiscard]] Space at(const Eigen::Vector3d& map_m) const;
    /// Space of that kind, in cubic metres.
    [[nodiscard]] double volume_m3(Space kind) const;

    /// Bytes of a file of OctoMap: .bt holds free or occupied for each voxel, .ot its log-odds.
    [[nodiscard]] Result<std::string> binaryTree() const;
    [[nodiscard]] Result<std::string> fullTree() const;

    /// For each cell of the ground with a height, over its whole area. Runs on all of TBB's threads; the same
    /// bytes with any number of them. Errors: Cancelled.
    [[nodiscard]] Result<SpaceAboveGround> aboveGround(const ElevationGrid& ground,
                                                       const FreeHeightOptions& options, Progress& progress,
                                                       std::stop_token stop) const;

  private:
    struct Impl;
    explicit SpaceOccupancy(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// An upper bound of the memory that build() takes.
[[nodiscard]] double occupancyMemory_bytes(const std::vector<LaserRay>& rays,
                                           const OccupancyOptions& options);

}  // namespace terrawalk
