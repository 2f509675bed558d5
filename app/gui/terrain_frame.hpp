#pragma once

#include <QColor>
#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "app/gui/orbit_camera.hpp"
#include "app/gui/terrain_scene.hpp"

namespace terrawalk::gui {

/// A line in the scene, as wide on the screen wherever it runs. Places as in TerrainVertex.
struct SceneLine {
    std::vector<Eigen::Vector3f> at_m;
    std::vector<QRgb> colours;  ///< one for each place
    float width_px = 1.0F;
    QRgb edge = 0;          ///< along both sides, beyond the width; transparent for none
    bool on_ground = true;  ///< drawn a little nearer than it is, so that the ground does not swallow it
};

struct SceneDot {
    Eigen::Vector3f at_m;
    QRgb colour = 0;
};

/// What stands on the ground. Immutable once drawn.
struct SceneOverlay {
    std::vector<SceneLine> lines;
    std::vector<SceneDot> dots;
};

/// All that a picture of the terrain depends on. A value.
struct TerrainFrame {
    std::shared_ptr<const TerrainScene> scene;
    std::shared_ptr<const SceneOverlay> overlay;
    OrbitCamera camera;
    double exaggeration = 1.0;
    Eigen::Vector3d to_light = Eigen::Vector3d::UnitZ();  ///< length one
    double contour_interval_m = 0.0;                      ///< 0: no contours
    QColor sky_above, sky_below, wall;
    float dot_px = 4.0F;
    bool moving = false;  ///< speed counts for more than detail
};

/// How wide the edge of a line is on each side.
inline constexpr float kLineEdge_px = 0.8F;
/// By how much lines and dots come nearer to the eye, as a share of their distance.
inline constexpr double kOverlayLift = 0.004;

/// How light the ground looks, 0..1 and above, by the cosine of its normal with the light.
[[nodiscard]] constexpr double shade(double cosine, bool wall) {
    const double lit = cosine > 0.0 ? cosine : 0.0;
    return wall ? 0.78 + 0.22 * lit : 0.48 + 0.66 * lit;
}

/// How many triangles may be drawn so that a frame keeps its time, learnt from the frames before.
class FrameBudget {
  public:
    explicit FrameBudget(double aim_ms) : aim_ms_(aim_ms) {}
    [[nodiscard]] std::size_t triangles() const { return triangles_; }
    void took(std::size_t triangles, double ms);

  private:
    double aim_ms_;
    std::size_t triangles_ = 150'000;
};

/// The blocks of one scene that were built so far.
class BlockStore {
  public:
    using Clock = std::chrono::steady_clock;
    struct Ready {
        BlockLevel which;
        const TerrainBlock* block;
    };
    /// A block for each that was chosen; where it is not built yet and no time is left to do so, the nearest
    /// level that there is, or else the coarsest. Forgets blocks that nobody chose when there are many.
    [[nodiscard]] std::vector<Ready> ready(const TerrainScene& scene, const std::vector<BlockLevel>& chosen,
                                           std::chrono::milliseconds time);
    /// Whether the last call gave all that was chosen.
    [[nodiscard]] bool complete() const { return complete_; }
    [[nodiscard]] bool holds(BlockLevel which) const { return built_.contains(which); }
    void clear() { built_.clear(); }

  private:
    const TerrainBlock& make(const TerrainScene& scene, BlockLevel which);
    std::map<BlockLevel, std::unique_ptr<TerrainBlock>> built_;
    bool complete_ = true;
};

}  // namespace terrawalk::gui
