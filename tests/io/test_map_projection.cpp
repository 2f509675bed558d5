#include <gmock/gmock.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/TransverseMercatorExact.hpp>
#include <array>
#include <cmath>
#include <limits>

#include "io/map_projection.hpp"

namespace terrawalk {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr GeodeticPosition kOrchard{23.182753, 113.399795, 38.0};
constexpr GeodeticPosition kBerlin{52.52, 13.405, 80.0};

MapProjection projection(const GeodeticPosition& zero, const std::string& crs,
                         const std::string& datum = "local") {
    auto made = MapProjection::create(LocalFrame(zero), crs, datum);
    if (!made) throw std::runtime_error(made.error().text());
    return std::move(*made);
}

std::string refusalOf(const std::string& crs, const std::string& datum = "local",
                      const GeodeticPosition& zero = kOrchard) {
    const auto made = MapProjection::create(LocalFrame(zero), crs, datum);
    if (made) return "accepted";
    EXPECT_EQ(made.error().kind, ErrorKind::BadData);
    EXPECT_FALSE(made.error().cure.empty());
    return made.error().text();
}

/// Points within two kilometres of the zero point, from a seedless lattice.
std::vector<Eigen::Vector3d> lattice() {
    std::vector<Eigen::Vector3d> points;
    for (int i = -4; i <= 4; ++i) {
        for (int k = -4; k <= 4; ++k) points.emplace_back(500.0 * i + 3.25, 500.0 * k - 1.5, 10.0 * (i - k));
    }
    return points;
}

/// ENU to UTM 49N without LocalFrame and PROJ: rotation written out, exact transverse Mercator of Karney
/// (2011).
Eigen::Vector2d independentUtm49(const GeodeticPosition& zero, const Eigen::Vector3d& enu_m) {
    const auto& earth = GeographicLib::Geocentric::WGS84();
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    earth.Forward(zero.lat_deg, zero.lon_deg, zero.h_ell_m, x, y, z);
    const double lat = radians(zero.lat_deg);
    const double lon = radians(zero.lon_deg);
    const Eigen::Vector3d east{-std::sin(lon), std::cos(lon), 0.0};
    const Eigen::Vector3d north{-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon),
                                std::cos(lat)};
    const Eigen::Vector3d up{std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
    const Eigen::Vector3d ecef =
        Eigen::Vector3d{x, y, z} + enu_m.x() * east + enu_m.y() * north + enu_m.z() * up;
    double point_lat = 0.0;
    double point_lon = 0.0;
    double point_h = 0.0;
    earth.Reverse(ecef.x(), ecef.y(), ecef.z(), point_lat, point_lon, point_h);
    double easting = 0.0;
    double northing = 0.0;
    GeographicLib::TransverseMercatorExact::UTM().Forward(111.0, point_lat, point_lon, easting, northing);
    return {easting + 500000.0, northing};
}

TEST(MapProjection, AgreesWithExactTransverseMercatorToATenthOfAMillimetre) {
    const MapProjection map = projection(kOrchard, "EPSG:32649");
    const auto points = lattice();
    const auto mapped = map.toMap(points);
    ASSERT_TRUE(mapped) << mapped.error().text();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector2d expected = independentUtm49(kOrchard, points[i]);
        EXPECT_LT(((*mapped)[i].head<2>() - expected).norm(), 1e-4) << points[i].transpose();
        EXPECT_EQ((*mapped)[i].z(), points[i].z());
    }
    EXPECT_EQ(map.name(), "WGS 84 / UTM zone 49N (EPSG:32649)");
    EXPECT_THAT(map.warnings(), IsEmpty());
}

TEST(MapProjection, KeepsGridConvergenceAndScale) {
    // 2.4 degrees east of the central meridian north is turned by about 2.4 sin(23.2) = 0.94 degrees.
    const MapProjection map = projection(kOrchard, "EPSG:32649");
    const auto mapped = map.toMap(std::vector<Eigen::Vector3d>{{0, 0, 0}, {0, 1000, 0}});
    ASSERT_TRUE(mapped);
    const Eigen::Vector3d north = (*mapped)[1] - (*mapped)[0];
    EXPECT_NEAR(degrees(std::atan2(-north.x(), north.y())), 2.399795 * std::sin(radians(23.182753)), 0.01);
    EXPECT_NEAR(north.head<2>().norm(), 1000.0 * 0.9996 * (1.0 + 0.5 * std::pow(245.6 / 6370.0, 2)), 0.02);
}

TEST(MapProjection, GivesEastBeforeNorthWhateverTheCrsSays) {
    // EPSG:31468 has the axes north, east. Berlin lies in zone 4 (12 degrees east).
    const MapProjection map = projection(kBerlin, "EPSG:31468");
    const auto mapped = map.toMap(Eigen::Vector3d::Zero());
    ASSERT_TRUE(mapped);
    EXPECT_NEAR(mapped->x(), 4.595e6, 2e3);
    EXPECT_NEAR(mapped->y(), 5.821e6, 2e3);
}

TEST(MapProjection, SinglePointAndBatchAgreeExactly) {
    const MapProjection map = projection(kBerlin, "EPSG:25833", "ellipsoid");
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 10000; ++i) points.emplace_back(0.37 * i, -0.21 * i, 0.001 * i);
    const auto mapped = map.toMap(points);
    ASSERT_TRUE(mapped);
    for (std::size_t i = 0; i < points.size(); i += 501) EXPECT_EQ(*map.toMap(points[i]), (*mapped)[i]);
    EXPECT_EQ(mapped->back(), *map.toMap(points.back()));
}

TEST(MapProjection, EllipsoidHeightsFallAwayFromThePlaneWithTheSquareOfTheDistance) {
    const MapProjection map = projection(kOrchard, "EPSG:32649", "ellipsoid");
    const auto mapped = map.toMap(std::vector<Eigen::Vector3d>{{0, 0, 0}, {1000, 0, 2}});
    ASSERT_TRUE(mapped);
    EXPECT_NEAR((*mapped)[0].z(), 38.0, 1e-6);
    EXPECT_NEAR((*mapped)[1].z(), 40.0 + 1000.0 * 1000.0 / (2.0 * 6.381e6), 1e-4);
    EXPECT_THAT(map.heightReference(), HasSubstr("WGS 84 ellipsoid"));
}

TEST(MapProjection, WithoutCrsIsTheLocalFrame) {
    const MapProjection local = projection(kOrchard, "");
    const MapProjection ellipsoid = projection(kOrchard, "", "ellipsoid");
    const Eigen::Vector3d point{12.345678901, -9876.5, 3.25};
    EXPECT_EQ(*local.toMap(point), point);
    EXPECT_EQ(ellipsoid.toMap(point)->head<2>(), point.head<2>());
    EXPECT_NEAR(ellipsoid.toMap(point)->z(), LocalFrame(kOrchard).toGeodetic(point).h_ell_m, 1e-9);
    EXPECT_EQ(local.name(), "Terrawalk local frame, zero point lat 23.182753000 lon 113.399795000 h 38.000");
    EXPECT_THAT(local.wkt2(), HasSubstr(local.name()));
    EXPECT_THAT(local.heightReference(), HasSubstr("zero point"));
}

TEST(MapProjection, RefusesWhatCannotBeAMapInMetres) {
    EXPECT_THAT(refusalOf("EPSG:99999"), HasSubstr("is not known"));
    EXPECT_THAT(refusalOf("nonsense\n"), HasSubstr("is not known"));
    EXPECT_THAT(refusalOf("EPSG:4326"), HasSubstr("geographic"));
    EXPECT_THAT(refusalOf("EPSG:4979"), HasSubstr("geographic"));
    EXPECT_THAT(refusalOf("EPSG:4978"), HasSubstr("geocentric"));
    EXPECT_THAT(refusalOf("EPSG:2263"), HasSubstr("US survey foot"));
    EXPECT_THAT(refusalOf("EPSG:5703"), HasSubstr("vertical"));
    EXPECT_THAT(refusalOf("EPSG:32649+5773"), HasSubstr("\"vertical_datum\": \"ellipsoid\""));
    EXPECT_THAT(refusalOf("EPSG:2053"), HasSubstr("west and south"));
    EXPECT_THAT(refusalOf("EPSG:3031"), HasSubstr("north and north"));
    EXPECT_THAT(refusalOf("+proj=utm +zone=49 +datum=WGS84"), HasSubstr("does not describe"));
    EXPECT_THAT(refusalOf("EPSG:32649", "EGM2008"), HasSubstr("\"local\""));
    EXPECT_THAT(refusalOf("EPSG:32649", ""), HasSubstr("\"ellipsoid\""));
}

TEST(MapProjection, RefusesADatumThatItWouldHaveToIgnore) {
    // Between WGS 84 and Beijing 1954 PROJ has nothing here but to take the one for the other: a hundred
    // metres.
    EXPECT_THAT(refusalOf("EPSG:21481", "local", {40.0, 123.0, 0.0}), HasSubstr("no transformation"));
}

TEST(MapProjection, TellsOfADatumShiftOfLimitedAccuracy) {
    EXPECT_THAT(projection(kBerlin, "EPSG:25833").warnings(), Contains(HasSubstr("good to about 1 m")));
    EXPECT_THAT(projection({30.0, 114.0, 20.0}, "EPSG:4547").warnings(), Contains(HasSubstr("taken as one")));
}

TEST(MapProjection, TellsOfASurveyOutsideTheMap) {
    EXPECT_THAT(projection(kBerlin, "EPSG:32649").warnings(), Contains(HasSubstr("outside the area")));
    EXPECT_THAT(projection(kBerlin, "EPSG:3857").warnings(), Contains(HasSubstr("1 m on the ground is 1.6")));
}

TEST(MapProjection, RefusesAPointThatIsNotFinite) {
    const MapProjection map = projection(kOrchard, "EPSG:32649");
    EXPECT_FALSE(map.toMap(Eigen::Vector3d{0.0, std::numeric_limits<double>::quiet_NaN(), 0.0}));
    EXPECT_FALSE(projection(kOrchard, "").toMap(Eigen::Vector3d{0.0, 0.0, kPi / 0.0}));
}

TEST(MapProjection, WorksAfterAMove) {
    MapProjection one = projection(kOrchard, "EPSG:32649");
    const Eigen::Vector3d before = *one.toMap(Eigen::Vector3d::Zero());
    MapProjection other = std::move(one);
    other = projection(kOrchard, "EPSG:32649");
    EXPECT_EQ(*other.toMap(Eigen::Vector3d::Zero()), before);
}

}  // namespace
}  // namespace terrawalk
