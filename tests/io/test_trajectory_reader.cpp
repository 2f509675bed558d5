#include <gmock/gmock.h>

#include <cmath>

#include "io/read_trajectory.hpp"
#include "io/survey_format.hpp"
#include "io/write_products.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

constexpr std::string_view kHeader =
    "time_s,e_m,n_m,u_m,ve_mps,vn_mps,vu_mps,sigma_e_m,sigma_n_m,sigma_u_m,roll_deg,pitch_deg,heading_deg,"
    "sigma_tilt_deg,sigma_heading_deg\n";

std::string errorOf(const std::string& bytes) {
    const auto read = parseTrajectoryCsv(bytes, "F01.csv");
    return read ? "accepted" : read.error().text();
}

TEST(TrajectoryReader, ReadsWhatTheWriterWrote) {
    TrajectoryEpoch epoch;
    epoch.time_s = 1.25;
    epoch.position_enu_m = {1.5, -2.25, 1234.5678};
    epoch.velocity_enu_mps = {0.5, 0.25, -0.125};
    epoch.covariance.diagonal() << 0.04, 0.09, 0.0004, 1.0, 1.0, 1.0;
    epoch.attitude = {radians(1.5), radians(-2.0), radians(120.0)};
    epoch.sigma_tilt_rad = radians(0.5);
    epoch.sigma_heading_rad = radians(3.0);
    TrajectoryEpoch later = epoch;
    later.time_s = 1.45;
    const TemporaryFolder folder;
    ASSERT_TRUE(writeTrajectoryCsv({"F01", {epoch, later}}, folder / "F01.csv"));
    const auto read = readTrajectoryCsv(folder / "F01.csv");
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->run_id, "F01");
    ASSERT_EQ(read->epochs.size(), 2U);
    const TrajectoryEpoch& first = read->epochs.front();
    EXPECT_EQ(first.time_s, 1.25);
    EXPECT_EQ(read->epochs.back().time_s, 1.45);
    EXPECT_EQ(first.position_enu_m, epoch.position_enu_m);
    EXPECT_EQ(first.velocity_enu_mps, epoch.velocity_enu_mps);
    EXPECT_NEAR(first.covariance(1, 1), 0.09, 1e-12);
    EXPECT_EQ(first.covariance(0, 1), 0.0);
    EXPECT_NEAR(first.attitude.roll_rad, radians(1.5), 1e-12);
    EXPECT_NEAR(first.attitude.yaw_rad, radians(120.0), 1e-12);
    EXPECT_NEAR(first.sigma_heading_rad, radians(3.0), 1e-12);
}

TEST(TrajectoryReader, KeepsEmptyFieldsMissing) {
    const auto read = parseTrajectoryCsv(std::string(kHeader) + "0,1,2,,,,,,,,,,,,\n", "F01.csv");
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->epochs[0].position_enu_m.x(), 1.0);
    EXPECT_TRUE(std::isnan(read->epochs[0].position_enu_m.z()));
    EXPECT_TRUE(std::isnan(read->epochs[0].attitude.yaw_rad));
}

TEST(TrajectoryReader, RefusesWhatIsNoTrajectory) {
    const std::string header(kHeader);
    const std::string row = "0,1,2,3,0,0,0,1,1,1,0,0,0,1,1\n";
    EXPECT_EQ(errorOf(header + row), "accepted");
    EXPECT_THAT(errorOf(""), HasSubstr("no rows"));
    EXPECT_THAT(errorOf(header), HasSubstr("no rows"));
    EXPECT_THAT(errorOf("time_s,e_m\n0,1\n"), HasSubstr("F01.csv:1: no column n_m"));
    EXPECT_THAT(errorOf(header + row + "1,2\n"), HasSubstr("F01.csv:3: 2 fields"));
    EXPECT_THAT(errorOf(header + row + row), HasSubstr("F01.csv:3: the time does not grow"));
    EXPECT_THAT(errorOf(header + "x" + row), HasSubstr("F01.csv:2: column time_s"));
    EXPECT_THAT(errorOf(header + "0,nan,2,3,0,0,0,1,1,1,0,0,0,1,1\n"), HasSubstr("no finite number"));
    EXPECT_FALSE(readTrajectoryCsv("/nonexistent/F01.csv"));
}

}  // namespace
}  // namespace terrawalk
