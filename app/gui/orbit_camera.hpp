#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace terrawalk::gui {

enum class ViewFrom { Oblique, Above, South, East, North, West };

/// A straight line of sight, in the frame of the scene.
struct SightLine {
    Eigen::Vector3d from_m;
    Eigen::Vector3d direction;  ///< length one
};

/// Pixels to keep clear on each side of a picture.
struct ViewMargins {
    double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
};

/// A camera that looks at a target from around it. Frame of the scene: metres, x east, y north, z up. Pixels
/// count from the upper left, y down. A value; all functions are pure but for those that move it.
class OrbitCamera {
  public:
    Eigen::Vector3d target_m = Eigen::Vector3d::Zero();
    double distance_m = 100.0;
    double azimuth_rad = 0.0;    ///< of the place from which it looks, clockwise from north
    double elevation_rad = 0.6;  ///< of that place above the target's horizon
    Eigen::Vector2d viewport_px{640.0, 480.0};
    double radius_m = 100.0;  ///< of all that there is to see, about the origin: sets how far it sees

    [[nodiscard]] Eigen::Vector3d forward() const;
    [[nodiscard]] Eigen::Vector3d right() const;
    [[nodiscard]] Eigen::Vector3d up() const;
    [[nodiscard]] Eigen::Vector3d eye_m() const { return target_m - distance_m * forward(); }
    /// To clip coordinates as OpenGL has them.
    [[nodiscard]] Eigen::Matrix4d viewProjection() const;
    /// Pixels and depth in [-1, 1]; nothing for what lies behind the camera.
    [[nodiscard]] std::optional<Eigen::Vector3d> project(const Eigen::Vector3d& scene_m) const;
    [[nodiscard]] SightLine through(const Eigen::Vector2d& px) const;
    /// Pixels that a metre has at a distance from the eye.
    [[nodiscard]] double pixelsPerMetre(double distance_m) const;

    void orbit(const Eigen::Vector2d& by_px);
    /// The target's plane follows the cursor.
    void pan(const Eigen::Vector2d& by_px);
    /// A factor above one comes nearer; `fixed_m` stays where it is on the screen.
    void zoom(double factor, const Eigen::Vector3d& fixed_m);
    /// Turns to a side; distance and target stay.
    void turn(ViewFrom side);
    /// Moves so that all points are in view within the margins, whatever way it looks. Does nothing without
    /// points.
    void fit(std::span<const Eigen::Vector3d> points_m, const ViewMargins& margins_px);

  private:
    [[nodiscard]] std::optional<Eigen::Vector3d> project(const Eigen::Matrix4d& view_projection,
                                                         const Eigen::Vector3d& scene_m) const;
};

}  // namespace terrawalk::gui
