#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/cli_support.hpp"

namespace terrawalk::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

// A real flight without marks and without GNSS height. Its data are not part of the project.
TEST(RealFlight, GivesADemInItsPlaceAndSaysWhatCouldNotBeChecked) {
    const fs::path survey = fs::path(TERRAWALK_SHARED_DATA) / "paddock_flight";
    if (!fs::exists(survey / "survey.json")) GTEST_SKIP() << "no paddock_flight data at " << survey;
    const TemporaryFolder scratch;
    const auto outcome =
        terrawalk({"process", (survey / "survey.json").string(), "-o", (scratch / "out").string()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json report = json::parse(bytesOf(scratch / "out/report.json"));
    EXPECT_THAT(report.at("limitations").dump(), HasSubstr("no marks"));
    EXPECT_THAT(bytesOf(scratch / "out/report.html"), HasSubstr("No accuracy can be stated"));

    GDALAllRegister();
    const auto dem = GDALDatasetUniquePtr(GDALDataset::Open((scratch / "out/dem.tif").c_str()));
    ASSERT_TRUE(dem);
    EXPECT_STREQ(dem->GetSpatialRef()->GetAuthorityCode(nullptr), "32755");
    double corner[6];
    ASSERT_EQ(dem->GetGeoTransform(corner), CE_None);
    // The flight covers some 77 m by 62 m around the zero point, which lies at 303394.7 E, 5807419.1 N.
    const double width_m = corner[1] * dem->GetRasterXSize();
    const double height_m = -corner[5] * dem->GetRasterYSize();
    EXPECT_GT(width_m, 30);
    EXPECT_LT(width_m, 100);
    EXPECT_GT(height_m, 30);
    EXPECT_LT(height_m, 100);
    EXPECT_NEAR(corner[0] + width_m / 2, 303394.7, 60);
    EXPECT_NEAR(corner[3] - height_m / 2, 5807419.1, 60);
    double lowest = 0, highest = 0, mean = 0, sd = 0;
    ASSERT_EQ(dem->GetRasterBand(1)->GetStatistics(FALSE, FALSE, &lowest, &highest, &mean, &sd), CE_None);
    EXPECT_LT(sd, 2.0);  // a paddock, and a barometer that drifts by 1.2 m
}

}  // namespace
}  // namespace terrawalk::test
