#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_support.hpp"

namespace terrawalk::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

double rmseOf(const json& report, const std::string& hold_out, const std::string& method) {
    for (const json& result : report.at("cross_validation").at("results")) {
        if (result.at("hold_out") != hold_out) continue;
        for (const json& score : result.at("scores")) {
            if (score.at("method") == method) return score.at("rmse");
        }
    }
    ADD_FAILURE() << hold_out << " " << method;
    return 0.0;
}

// Airborne lidar in feet: a plain TIN is to be beaten by a twentieth, on points and on blocks left out.
TEST(SurfaceCommand, BeatsThePlainTinOnRealGround) {
    const fs::path points = fs::path(TERRAWALK_SHARED_DATA) / "lidar_ground/ground_train.csv";
    if (!fs::exists(points)) GTEST_SKIP() << points << " is not there";
    const TemporaryFolder scratch;
    const auto outcome = terrawalk({"surface", points.string(), "-o", (scratch / "dem.tif").string(),
                                    "--method", "kriging", "--crs", "EPSG:2994", "--json", "--seed", "3"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("of memory"));
    const json report = json::parse(outcome.out);
    EXPECT_EQ(report, json::parse(bytesOf(scratch / "dem.json")));
    EXPECT_EQ(report.at("unit"), "ft");
    for (const std::string hold_out : {"random-folds", "spatial-blocks"}) {
        const double linear = rmseOf(report, hold_out, "linear");
        EXPECT_LT(linear, 0.6) << "in feet";
        EXPECT_LT(rmseOf(report, hold_out, "kriging"), 0.95 * linear) << hold_out;
    }
    EXPECT_TRUE(fs::exists(scratch / "dem_uncertainty.tif"));
}

TEST(VolumeCommand, TellsTheVolumeAndItsStandardError) {
    const TemporaryFolder scratch;
    writeBytes(scratch / "p.csv", "x_m,y_m,z_m\n0,0,3\n10,0,3\n10,10,3\n0,10,3\n");
    const std::string dem = (scratch / "dem.tif").string();
    ASSERT_EQ(terrawalk({"surface", (scratch / "p.csv").string(), "-o", dem, "--method", "linear",
                         "--no-validation", "--resolution", "1"})
                  .exit_code,
              0);
    const auto outcome =
        terrawalk({"volume", dem, "--plane", "1", "--sigma", "0.1", "--common-sigma", "0.05", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json volume = json::parse(outcome.out);
    EXPECT_NEAR(volume.at("net").at("volume").get<double>(), 200.0, 1e-9);
    // 100 cells of a square metre: 0.1 sqrt(100) and 0.05 * 100.
    EXPECT_NEAR(volume.at("net").at("standard_error").get<double>(), std::hypot(1.0, 5.0), 1e-6);
    // Half of the cells have no height in the other.
    writeBytes(scratch / "half.csv", "x_m,y_m,z_m\n0,0,1\n10,0,1\n0,10,1\n");
    const std::string half = (scratch / "half.tif").string();
    ASSERT_EQ(terrawalk({"surface", (scratch / "half.csv").string(), "-o", half, "--method", "linear",
                         "--no-validation", "--resolution", "1", "--extent", "0,0,10,10"})
                  .exit_code,
              0);
    const json against = json::parse(terrawalk({"volume", dem, "--against", half, "--json"}).out);
    EXPECT_EQ(against.at("cells").get<int>() + against.at("cells_in_one").get<int>(), 100);
    EXPECT_GE(against.at("cells_in_one").get<int>(), 45);
    EXPECT_THAT(terrawalk({"volume", dem, "--against", half}).out,
                AllOf(HasSubstr("Cut"), HasSubstr("with a height in one DEM only")));
    EXPECT_EQ(terrawalk({"volume", dem}).exit_code, 2);
    EXPECT_EQ(terrawalk({"volume", dem, "--plane", "1", "--against", dem}).exit_code, 2);
    EXPECT_EQ(terrawalk({"volume", (scratch / "none.tif").string(), "--plane", "1"}).exit_code, 3);
}

TEST(SurfaceCommand, SaysWhatIsWrong) {
    const TemporaryFolder scratch;
    const auto run = [&](const std::string& text, std::vector<std::string> more = {}) {
        writeBytes(scratch / "p.csv", text);
        std::vector<std::string> command{"surface", (scratch / "p.csv").string(), "-o",
                                         (scratch / "dem.tif").string()};
        command.insert(command.end(), more.begin(), more.end());
        return terrawalk(command);
    };
    EXPECT_EQ(run("x,y,z\n").exit_code, 3);
    EXPECT_EQ(run("x,y,z\n1,2,3\n").exit_code, 3);
    const auto line = run("x,y,z\n0,0,1\n1,1,1\n2,2,1\n3,3,5\n");
    EXPECT_EQ(line.exit_code, 3);
    EXPECT_THAT(line.err, HasSubstr("one straight line"));
    EXPECT_EQ(run("x,y,z\n0,0,1\n1,0,1\n0,1,1\n", {"--method", "spline"}).exit_code, 2);
    EXPECT_EQ(run("x,y,z\n0,0,1\n1,0,1\n0,1,1\n", {"--extent", "3,0,1,1"}).exit_code, 2);
    const auto few = run("x,y,z\n0,0,1\n1,0,1\n0,1,1\n");
    EXPECT_EQ(few.exit_code, 0) << "nothing to choose by: the plain surface";
    EXPECT_THAT(few.out, HasSubstr("too few for cross-validation"));
    EXPECT_EQ(run("x,y,z\n0,0,1\n1,0,1\n0,1,1\n", {"--resolution", "0"}).exit_code, 2);
    const auto away = run("x,y,z\n0,0,1\n1,0,1\n0,1,1\n", {"--extent", "50,50,60,60"});
    EXPECT_EQ(away.exit_code, 3);
    EXPECT_THAT(away.err, HasSubstr("the extent"));
    const auto degrees = run("lon,lat,z\n110.5,23.1,1\n");
    EXPECT_EQ(degrees.exit_code, 3);
    EXPECT_THAT(degrees.err, HasSubstr("project"));
    EXPECT_EQ(run("x,y,z\n0,0,1\n1,0,1\n0,1,1\n", {"--method", "linear", "--no-validation"}).exit_code, 0);
    const auto picture =
        terrawalk({"surface", (scratch / "p.csv").string(), "-o", (scratch / "dem.png").string()});
    EXPECT_EQ(picture.exit_code, 2);
    EXPECT_THAT(picture.err, HasSubstr(".tif"));
}

TEST(SurfaceCommand, NamesTheFilterThatTookAllPoints) {
    const TemporaryFolder scratch;
    std::string text = "x,y,z\n";
    for (int i = 0; i < 2; ++i) text += fmt::format("{},0,1\n", 20 * i);  // too few to tell their spacing
    writeBytes(scratch / "p.csv", text);
    const auto outcome = terrawalk(
        {"surface", (scratch / "p.csv").string(), "-o", (scratch / "dem.tif").string(), "--clean", "radius"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("isolated: 2"));
}

TEST(SurfaceCommand, PointsCannotCertifyTheirOwnDem) {
    const TemporaryFolder scratch;
    std::string text = "x,y,z\n", other = "x,y,z\n";
    for (int i = 0; i < 60; ++i) {
        text += fmt::format("{},{},{}\n", i % 8, i / 8, 0.1 * (i % 5));
        other += fmt::format("{},{},{}\n", 0.5 + i % 7, 0.5 + i / 9, 0.2);
    }
    writeBytes(scratch / "own.csv", text);
    writeBytes(scratch / "other.csv", other);
    const std::string dem = (scratch / "dem.tif").string();
    ASSERT_EQ(terrawalk({"surface", (scratch / "own.csv").string(), "-o", dem}).exit_code, 0);
    const auto own = terrawalk({"validate", dem, "--check-points", (scratch / "own.csv").string()});
    EXPECT_EQ(own.exit_code, 0);
    EXPECT_THAT(own.out, HasSubstr("made from this very file"));
    EXPECT_THAT(own.out, Not(HasSubstr("Tested")));
    const auto apart = terrawalk({"validate", dem, "--check-points", (scratch / "other.csv").string()});
    EXPECT_EQ(apart.exit_code, 0);
    EXPECT_THAT(apart.out, HasSubstr("Tested"));
}

}  // namespace
}  // namespace terrawalk::test
