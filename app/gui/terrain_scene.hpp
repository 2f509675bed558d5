#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "app/gui/orbit_camera.hpp"
#include "app/gui/raster_picture.hpp"

namespace terrawalk::gui {

/// Where something stands, what way its surface faces, and its colour. Metres from the scene's origin;
/// heights without exaggeration.
struct TerrainVertex {
    std::array<float, 3> at_m{};
    std::array<float, 2> facing{};  ///< surface: slope east and north; wall: unit normal in plan
    std::array<std::uint8_t, 3> colour{};
    std::uint8_t wall = 0;  ///< 255 on the sides of the block of ground, 0 on its surface
};

/// A part of the surface at one level of detail. Triangles are counter-clockwise seen from above or outside.
struct TerrainBlock {
    std::vector<TerrainVertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Names a block: every 2^level-th row and column of it is drawn.
struct BlockLevel {
    std::uint32_t block = 0;
    std::uint32_t level = 0;
    auto operator<=>(const BlockLevel&) const = default;
};

/// The surface of a DEM in blocks of 64 x 64 cells, each of which can be had at seven levels of detail. It is
/// drawn as a block of ground: walls go down from its edges to a floor, and skirts hide the cracks between
/// blocks of different levels. Immutable; safe from any thread.
class TerrainScene {
  public:
    static constexpr std::uint32_t kBlockCells = 64;
    static constexpr std::uint32_t kLevels = 7;

    /// @param products  with a DEM of at least one known height
    /// @param picture   of a layer of these products; without levels the ground is grey
    TerrainScene(std::shared_ptr<const Products> products, const RasterPicture& picture);

    /// Map place of the scene's origin: the middle of what is known, on the floor.
    [[nodiscard]] const Eigen::Vector3d& origin_map_m() const { return origin_map_m_; }
    /// Half the size of what is known, and its height above the floor.
    [[nodiscard]] const Eigen::Vector3d& halfSize_m() const { return half_size_m_; }
    [[nodiscard]] double lowest_m() const { return lowest_m_; }    ///< map height
    [[nodiscard]] double highest_m() const { return highest_m_; }  ///< map height
    /// Corners of what is known, for a camera to fit.
    [[nodiscard]] std::vector<Eigen::Vector3d> corners(double exaggeration) const;
    [[nodiscard]] const Products& products() const { return *products_; }

    [[nodiscard]] Eigen::Vector3d toScene(const Eigen::Vector3d& map_m, double exaggeration) const;
    [[nodiscard]] Eigen::Vector3d toMap(const Eigen::Vector3d& scene_m, double exaggeration) const;
    /// Map height of the surface, between the centres of cells; nothing where a corner is not known.
    [[nodiscard]] std::optional<double> heightAt(double x_map_m, double y_map_m) const;
    /// Where a line of sight first meets the surface, in the frame of the scene.
    /// @param step_m  of the search along the line, no less than half a cell: what is narrower may be missed
    [[nodiscard]] std::optional<Eigen::Vector3d> firstHit(const SightLine& sight, double exaggeration,
                                                          double step_m = 0.0) const;

    [[nodiscard]] std::size_t blockCount() const { return blocks_.size(); }
    [[nodiscard]] TerrainBlock build(BlockLevel which) const;
    /// About how many triangles build() gives.
    [[nodiscard]] std::size_t trianglesOf(BlockLevel which) const;
    /// Blocks in view, each as fine as its size on the screen asks for, but no more than `budget` triangles
    /// in all where coarser levels allow it.
    [[nodiscard]] std::vector<BlockLevel> select(const OrbitCamera& camera, double exaggeration,
                                                 std::size_t budget) const;

  private:
    struct Extent {
        std::size_t first_row = 0, first_column = 0, known = 0;
        Eigen::Vector3d middle_m, half_m;  ///< heights above the floor, not exaggerated
    };
    class Sampler;
    [[nodiscard]] std::array<std::uint8_t, 3> colourOf(std::size_t row, std::size_t column) const;
    void measure();

    std::shared_ptr<const Products> products_;
    RasterLegend height_legend_;  ///< with a ramp where heights give the colour
    QImage colours_;
    Eigen::Vector3d origin_map_m_ = Eigen::Vector3d::Zero();
    Eigen::Vector3d half_size_m_ = Eigen::Vector3d::Zero();
    double lowest_m_ = 0.0, highest_m_ = 0.0;
    std::vector<Extent> blocks_;
};

}  // namespace terrawalk::gui
