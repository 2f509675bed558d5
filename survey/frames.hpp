#pragma once

#include <Eigen/Core>

namespace terrawalk {

/// WGS 84 geodetic position. Latitude and longitude stay in degrees, the unit in which files and
/// GeographicLib hold them; every other angle inside the program is in radians.
struct GeodeticPosition {
    double lat_deg = 0.0;
    double lon_deg = 0.0;
    double h_ell_m = 0.0;  ///< height above the WGS 84 ellipsoid
};

/// Local Cartesian frame: e east, n north, u up [m], tangent to the ellipsoid at the zero point.
/// Round trips agree within a nanometre for surveys of some kilometres. Pure; safe from any thread.
/// Source: Karney, GeographicLib::LocalCartesian.
class LocalFrame {
  public:
    explicit LocalFrame(const GeodeticPosition& zero_point) : zero_point_(zero_point) {}
    [[nodiscard]] const GeodeticPosition& zeroPoint() const { return zero_point_; }
    [[nodiscard]] Eigen::Vector3d toEnu(const GeodeticPosition& position) const;
    [[nodiscard]] GeodeticPosition toGeodetic(const Eigen::Vector3d& enu_m) const;

  private:
    GeodeticPosition zero_point_;
};

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kStandardGravity_mps2 = 9.80665;

[[nodiscard]] constexpr double radians(double degrees) {
    return degrees * (kPi / 180.0);
}
[[nodiscard]] constexpr double degrees(double radians) {
    return radians * (180.0 / kPi);
}

/// Wraps an angle to (-pi, pi].
[[nodiscard]] double wrapAngle(double angle_rad);

/// Heading (clockwise from north) to yaw (counter-clockwise from east), wrapped to (-pi, pi]; its own inverse
/// up to wrapping.
[[nodiscard]] double yawFromHeading(double heading_rad);

/// Attitude of the body frame (FLU: x forward, y left, z up) in ENU.
struct Attitude {
    double roll_rad = 0.0;   ///< positive: right side down
    double pitch_rad = 0.0;  ///< positive: nose up
    double yaw_rad = 0.0;    ///< counter-clockwise from east
};

/// Rotation that takes body coordinates to ENU: Rz(yaw) Ry(-pitch) Rx(roll).
[[nodiscard]] Eigen::Matrix3d rotationEnuFromBody(const Attitude& attitude);

}  // namespace terrawalk
