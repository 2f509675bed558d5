#include <gmock/gmock.h>

#include "io/write_products.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using test::bytesOf;
using test::TemporaryFolder;

TrajectoryEpoch epochWithYaw(double yaw_deg) {
    TrajectoryEpoch epoch;
    epoch.attitude.yaw_rad = radians(yaw_deg);
    return epoch;
}

TEST(WriteTrajectoryCsv, GivesGoldenLines) {
    TrajectoryEpoch epoch;
    epoch.time_s = 1.25;
    epoch.position_enu_m = {1.5, -2.25, 1234.56789};
    epoch.velocity_enu_mps = {0.5, 0.25, -0.125};
    epoch.covariance.diagonal() << 0.04, 0.09, 0.0004, 1.0, 1.0, 1.0;
    epoch.attitude = {radians(1.5), radians(-2.0), radians(0.0)};
    epoch.sigma_tilt_rad = radians(0.5);
    epoch.sigma_heading_rad = radians(3.0);
    const TemporaryFolder folder;
    ASSERT_TRUE(writeTrajectoryCsv({"F01", {epoch}}, folder / "F01.csv"));
    EXPECT_EQ(
        bytesOf(folder / "F01.csv"),
        "time_s,e_m,n_m,u_m,ve_mps,vn_mps,vu_mps,sigma_e_m,sigma_n_m,sigma_u_m,roll_deg,pitch_deg,heading_"
        "deg,"
        "sigma_tilt_deg,sigma_heading_deg\n"
        "1.250,1.5000,-2.2500,1234.5679,0.5000,0.2500,-0.1250,0.2000,0.3000,0.0200,1.5000,-2.0000,90.0000,"
        "0.5000,3.0000\n");
}

TEST(WriteTrajectoryCsv, HeadingRunsClockwiseFromNorthAndStaysBelow360) {
    const TemporaryFolder folder;
    // east, north, west, south, a hair west of north that rounds to 360
    ASSERT_TRUE(writeTrajectoryCsv(
        {"",
         {epochWithYaw(0), epochWithYaw(90), epochWithYaw(180), epochWithYaw(-90), epochWithYaw(90.00001)}},
        folder / "t.csv"));
    std::istringstream stream(bytesOf(folder / "t.csv"));
    std::string line;
    std::getline(stream, line);
    std::vector<std::string> headings;
    while (std::getline(stream, line)) {
        std::istringstream fields(line);
        std::string field;
        for (int i = 0; i < 13; ++i) std::getline(fields, field, ',');
        headings.push_back(field);
    }
    EXPECT_THAT(headings, ::testing::ElementsAre("90.0000", "0.0000", "270.0000", "180.0000", "0.0000"));
}

TEST(WriteGroundPointsCsv, GivesGoldenLines) {
    GroundPoint used;
    used.run = 1;
    used.time_s = 0.05;
    used.enu_m = {10.0, 20.0, -1.25};
    used.sigma_u_m = 0.0625;
    GroundPoint no_range;
    no_range.enu_m.setConstant(kMissing);
    no_range.sigma_u_m = kMissing;
    no_range.state = GroundPointState::NoRange;
    GroundPoint spike = used;
    spike.state = GroundPointState::Spike;
    const TemporaryFolder folder;
    ASSERT_TRUE(writeGroundPointsCsv({used, no_range, spike}, {"F \"1\", second", "S01"}, folder / "g.csv"));
    EXPECT_EQ(bytesOf(folder / "g.csv"),
              "run,time_s,e_m,n_m,u_m,sigma_u_m,used,reason\n"
              "S01,0.050,10.0000,20.0000,-1.2500,0.0625,1,\n"
              "\"F \"\"1\"\", second\",0.000,,,,,0,no range\n"
              "S01,0.050,10.0000,20.0000,-1.2500,0.0625,0,spike\n");
}

TEST(WriteGroundPointsCsv, RefusesAPointOfNoRun) {
    const TemporaryFolder folder;
    EXPECT_FALSE(writeGroundPointsCsv({GroundPoint{}}, {}, folder / "g.csv"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace terrawalk
