#include "survey/frames.hpp"

#include <Eigen/Geometry>
#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

namespace terrawalk {

Eigen::Vector3d LocalFrame::toEnu(const GeodeticPosition& position) const {
    const GeographicLib::LocalCartesian local(zero_point_.lat_deg, zero_point_.lon_deg, zero_point_.h_ell_m);
    Eigen::Vector3d enu;
    local.Forward(position.lat_deg, position.lon_deg, position.h_ell_m, enu.x(), enu.y(), enu.z());
    return enu;
}

GeodeticPosition LocalFrame::toGeodetic(const Eigen::Vector3d& enu_m) const {
    const GeographicLib::LocalCartesian local(zero_point_.lat_deg, zero_point_.lon_deg, zero_point_.h_ell_m);
    GeodeticPosition position;
    local.Reverse(enu_m.x(), enu_m.y(), enu_m.z(), position.lat_deg, position.lon_deg, position.h_ell_m);
    return position;
}

double wrapAngle(double angle_rad) {
    const double wrapped = std::remainder(angle_rad, 2.0 * kPi);
    return wrapped <= -kPi ? kPi : wrapped;
}

double yawFromHeading(double heading_rad) {
    return wrapAngle(0.5 * kPi - heading_rad);
}

Eigen::Matrix3d rotationEnuFromBody(const Attitude& attitude) {
    // Body y points left, so a positive rotation about it lowers the nose: hence the minus.
    return (Eigen::AngleAxisd(attitude.yaw_rad, Eigen::Vector3d::UnitZ()) *
            Eigen::AngleAxisd(-attitude.pitch_rad, Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(attitude.roll_rad, Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
}

}  // namespace terrawalk
