#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "survey/frames.hpp"

namespace terrawalk {
namespace {

const GeodeticPosition kZero{23.182753, 113.399795, 38.0};

TEST(LocalFrame, ZeroPointIsTheOrigin) {
    EXPECT_LT(LocalFrame(kZero).toEnu(kZero).norm(), 1e-9);
}

TEST(LocalFrame, RoundTripIsExactToAMicrometre) {
    const LocalFrame frame(kZero);
    for (const Eigen::Vector3d& enu : {Eigen::Vector3d{50, -20, 3}, {1500, 2500, -40}, {-9000, 10, 120}}) {
        EXPECT_LT((frame.toEnu(frame.toGeodetic(enu)) - enu).norm(), 1e-6);
    }
}

TEST(LocalFrame, AxesPointEastNorthUp) {
    const LocalFrame frame(kZero);
    const auto east = frame.toEnu({kZero.lat_deg, kZero.lon_deg + 1e-5, kZero.h_ell_m});
    const auto north = frame.toEnu({kZero.lat_deg + 1e-5, kZero.lon_deg, kZero.h_ell_m});
    // A degree of latitude there is about 110.8 km, one of longitude cos(lat) 111.3 km.
    EXPECT_NEAR(east.x(), 1.0233, 1e-3);
    EXPECT_NEAR(east.y(), 0.0, 1e-6);
    EXPECT_NEAR(north.y(), 1.1076, 1e-3);
    EXPECT_NEAR(north.x(), 0.0, 1e-6);
}

TEST(LocalFrame, CurvatureLowersADistantPointOfTheSameHeight) {
    const LocalFrame frame(kZero);
    const auto enu = frame.toEnu({kZero.lat_deg + 0.01, kZero.lon_deg, kZero.h_ell_m});
    const double meridian_radius_m = 6345300.0;  // at 23 degrees, to 0.1 %
    EXPECT_NEAR(enu.z(), -enu.y() * enu.y() / (2 * meridian_radius_m), 2e-4);
}

TEST(Angles, WrapKeepsTheHalfOpenInterval) {
    EXPECT_DOUBLE_EQ(wrapAngle(kPi), kPi);
    EXPECT_DOUBLE_EQ(wrapAngle(-kPi), kPi);
    EXPECT_NEAR(wrapAngle(3 * kPi + 0.25), -kPi + 0.25, 1e-12);
}

TEST(Angles, HeadingNorthIsYawNinetyDegrees) {
    EXPECT_NEAR(yawFromHeading(0.0), kPi / 2, 1e-15);
    EXPECT_NEAR(yawFromHeading(kPi / 2), 0.0, 1e-15);
    EXPECT_NEAR(yawFromHeading(yawFromHeading(2.0)), 2.0, 1e-12);
}

TEST(Attitude, SignsAreThoseOfTheFormat) {
    const auto up = Eigen::Vector3d::UnitZ();
    // Pitch up lifts the nose, roll lowers the right side (body -y), heading 90 degrees points the nose east.
    EXPECT_GT(rotationEnuFromBody({0, 0.1, 0}).col(0).dot(up), 0.0);
    EXPECT_LT((rotationEnuFromBody({0.1, 0, 0}) * -Eigen::Vector3d::UnitY()).dot(up), 0.0);
    EXPECT_NEAR(rotationEnuFromBody({0, 0, yawFromHeading(kPi / 2)})(0, 0), 1.0, 1e-12);
    EXPECT_NEAR(rotationEnuFromBody({0.3, -0.2, 1.7}).determinant(), 1.0, 1e-12);
}

}  // namespace
}  // namespace terrawalk
