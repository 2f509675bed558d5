#include "app/gui/orbit_camera.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "survey/frames.hpp"

namespace terrawalk::gui {

namespace {

// Half the angle of view from top to bottom: narrow, so that distances deceive little.
const double kHalfView = std::tan(radians(15.0));
// What is left for the points where margins leave little.
constexpr double kLeastRoom_px = 80.0;
constexpr double kOrbitPerPixel_rad = 0.006;
// Below the ground there is nothing to see.
const double kLowest_rad = radians(2.0);
const double kHighest_rad = radians(90.0);

}  // namespace

Eigen::Vector3d OrbitCamera::forward() const {
    return {-std::cos(elevation_rad) * std::sin(azimuth_rad),
            -std::cos(elevation_rad) * std::cos(azimuth_rad), -std::sin(elevation_rad)};
}

Eigen::Vector3d OrbitCamera::up() const {
    return {-std::sin(elevation_rad) * std::sin(azimuth_rad),
            -std::sin(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad)};
}

Eigen::Vector3d OrbitCamera::right() const {
    return forward().cross(up());
}

Eigen::Matrix4d OrbitCamera::viewProjection() const {
    const Eigen::Vector3d eye = eye_m();
    Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
    view.block<1, 3>(0, 0) = right();
    view.block<1, 3>(1, 0) = up();
    view.block<1, 3>(2, 0) = -forward();
    view.topRightCorner<3, 1>() = -view.topLeftCorner<3, 3>() * eye;
    // As near as something can be, so that the depth buffer tells apart what lies far.
    const double far_m = eye.norm() + 3.0 * radius_m;
    const double near_m = std::max(eye.norm() - 3.0 * radius_m, distance_m / 60.0);
    Eigen::Matrix4d lens = Eigen::Matrix4d::Zero();
    lens(0, 0) = viewport_px.y() / (viewport_px.x() * kHalfView);
    lens(1, 1) = 1.0 / kHalfView;
    lens(2, 2) = -(far_m + near_m) / (far_m - near_m);
    lens(2, 3) = -2.0 * far_m * near_m / (far_m - near_m);
    lens(3, 2) = -1.0;
    return lens * view;
}

std::optional<Eigen::Vector3d> OrbitCamera::project(const Eigen::Vector3d& scene_m) const {
    return project(viewProjection(), scene_m);
}

std::optional<Eigen::Vector3d> OrbitCamera::project(const Eigen::Matrix4d& view_projection,
                                                    const Eigen::Vector3d& scene_m) const {
    const Eigen::Vector4d clip = view_projection * scene_m.homogeneous();
    if (clip.w() <= 0.0) return std::nullopt;
    const Eigen::Vector3d ndc = clip.head<3>() / clip.w();
    return Eigen::Vector3d((ndc.x() + 1.0) / 2.0 * viewport_px.x(), (1.0 - ndc.y()) / 2.0 * viewport_px.y(),
                           ndc.z());
}

SightLine OrbitCamera::through(const Eigen::Vector2d& px) const {
    const double per_px = 2.0 * kHalfView / viewport_px.y();
    const Eigen::Vector2d off = (px - viewport_px / 2.0) * per_px;
    return {eye_m(), (forward() + off.x() * right() - off.y() * up()).normalized()};
}

double OrbitCamera::pixelsPerMetre(double at_m) const {
    return viewport_px.y() / (2.0 * kHalfView * at_m);
}

void OrbitCamera::orbit(const Eigen::Vector2d& by_px) {
    azimuth_rad = wrapAngle(azimuth_rad + by_px.x() * kOrbitPerPixel_rad);
    elevation_rad = std::clamp(elevation_rad + by_px.y() * kOrbitPerPixel_rad, kLowest_rad, kHighest_rad);
}

void OrbitCamera::pan(const Eigen::Vector2d& by_px) {
    const double metre_px = pixelsPerMetre(distance_m);
    target_m += (-by_px.x() * right() + by_px.y() * up()) / metre_px;
}

void OrbitCamera::zoom(double factor, const Eigen::Vector3d& fixed_m) {
    const double kept = std::clamp(1.0 / factor, 1e-3 * radius_m / distance_m, 20.0 * radius_m / distance_m);
    // All of the scene shrinks towards the fixed point as seen from the eye, which therefore stays.
    target_m = fixed_m + kept * (target_m - fixed_m);
    distance_m *= kept;
}

void OrbitCamera::turn(ViewFrom side) {
    switch (side) {
        case ViewFrom::Oblique:
            azimuth_rad = radians(205.0);
            elevation_rad = radians(32.0);
            return;
        case ViewFrom::Above:
            azimuth_rad = radians(180.0);
            elevation_rad = kHighest_rad;
            return;
        case ViewFrom::South:
            azimuth_rad = radians(180.0);
            break;
        case ViewFrom::East:
            azimuth_rad = radians(90.0);
            break;
        case ViewFrom::North:
            azimuth_rad = 0.0;
            break;
        case ViewFrom::West:
            azimuth_rad = radians(-90.0);
            break;
    }
    elevation_rad = radians(12.0);
}

void OrbitCamera::fit(std::span<const Eigen::Vector3d> points_m, const ViewMargins& margins_px) {
    if (points_m.empty()) return;
    const Eigen::Vector2d room_px = (viewport_px - Eigen::Vector2d(margins_px.left + margins_px.right,
                                                                   margins_px.top + margins_px.bottom))
                                        .cwiseMax(kLeastRoom_px);
    const Eigen::Vector2d middle_px =
        viewport_px / 2.0 +
        Eigen::Vector2d(margins_px.left - margins_px.right, margins_px.top - margins_px.bottom) / 2.0;
    const Eigen::Vector2d half_view = kHalfView * room_px / viewport_px.y();
    target_m = Eigen::Vector3d::Zero();
    // What is near looks larger, so the middle of what is seen moves as the distance does: rounds settle it.
    const Eigen::Vector3d across = right(), upwards = up(), ahead = forward();
    for (int round = 0; round < 8; ++round) {
        const Eigen::Matrix4d lens = viewProjection();
        Eigen::Vector2d least = Eigen::Vector2d::Constant(HUGE_VAL), greatest = -least;
        for (const Eigen::Vector3d& p : points_m) {
            const auto seen = project(lens, p);
            if (!seen) continue;
            least = least.cwiseMin(seen->head<2>());
            greatest = greatest.cwiseMax(seen->head<2>());
        }
        if (least.x() <= greatest.x()) pan(middle_px - (least + greatest) / 2.0);
        double needed_m = 0.0;
        const Eigen::Vector3d middle_m = target_m + ((middle_px - viewport_px / 2.0).x() * across -
                                                     (middle_px - viewport_px / 2.0).y() * upwards) /
                                                        pixelsPerMetre(distance_m);
        for (const Eigen::Vector3d& p : points_m) {
            const Eigen::Vector3d off = p - middle_m;
            const double beyond = off.dot(ahead);
            needed_m = std::max({needed_m, std::abs(off.dot(across)) / half_view.x() - beyond,
                                 std::abs(off.dot(upwards)) / half_view.y() - beyond});
        }
        distance_m = std::max(needed_m, 1e-3 * radius_m);
    }
}

}  // namespace terrawalk::gui
