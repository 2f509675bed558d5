#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/read_dem.hpp"
#include "tests/cli/cli_support.hpp"

namespace terrawalk::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

TEST(OccupancyCommand, FindsABranchAboveTheGroundOfASurvey) {
    const TemporaryFolder scratch;
    const fs::path out = scratch / "out";
    ASSERT_EQ(terrawalk({"process", quickPlot().string(), "-o", out.string(), "--quiet"}).exit_code, 0);
    const auto clean = terrawalk({"occupancy", out.string(), "--json", "--quiet"});
    ASSERT_EQ(clean.exit_code, 0) << clean.err;
    EXPECT_EQ(clean.err, "");
    const json before = json::parse(clean.out);
    EXPECT_EQ(before, json::parse(bytesOf(scratch / "out-occupancy/occupancy.json")));
    EXPECT_GT(before.at("rays").get<int>(), 1000);
    // The simulated array is carried some 1.1 m above the ground.
    EXPECT_GT(before.at("median_free_height_m").get<double>(), 0.7);
    EXPECT_LT(before.at("median_free_height_m").get<double>(), 2.0);
    // Nothing stands on the simulated ground; a hit on a riser that the track misplaced may look so.
    const int false_obstacles = before.at("cells_with_obstacle");
    EXPECT_LE(false_obstacles, 2);
    const auto free = readDem(scratch / "out-occupancy/free_height.tif", {});
    const auto dem = readDem(out / "dem.tif", {});
    ASSERT_TRUE(free && dem);
    EXPECT_EQ(free->grid.geometry, dem->grid.geometry);
    EXPECT_THAT(bytesOf(scratch / "out-occupancy/occupancy.bt"),
                testing::StartsWith("# Octomap OcTree binary file\n"));

    // A few hits half a metre above the ground, which the pipeline calls spikes.
    std::ifstream table(out / "ground_points.csv");
    std::ostringstream changed;
    int lifted = 0, seen = 0;
    for (std::string line; std::getline(table, line);) {
        // Every seventh, so that they lie apart.
        const bool used = line.starts_with("S01,") && line.ends_with(",1,");
        if (used && seen++ % 7 == 0 && lifted < 20) {
            std::vector<std::string> fields;
            std::istringstream words(line);
            for (std::string field; std::getline(words, field, ',');) fields.push_back(field);
            fields[4] = std::to_string(std::stod(fields[4]) + 0.5);
            line = fields[0] + "," + fields[1] + "," + fields[2] + "," + fields[3] + "," + fields[4] + "," +
                   fields[5] + ",0,spike";
            ++lifted;
        }
        changed << line << "\n";
    }
    table.close();
    ASSERT_EQ(lifted, 20);
    writeBytes(out / "ground_points.csv", changed.str());
    const auto branch = terrawalk({"occupancy", out.string(), "--json"});
    ASSERT_EQ(branch.exit_code, 0) << branch.err;
    EXPECT_GT(json::parse(branch.out).at("cells_with_obstacle").get<int>(), false_obstacles + 5);
    const auto obstacles = readDem(scratch / "out-occupancy/obstacle_height.tif", {});
    ASSERT_TRUE(obstacles);
    // Bottoms of voxels of 0.1 m, over ground that slopes within a cell.
    std::size_t near_half = 0;
    for (const float height : obstacles->grid.heights_m) {
        if (std::isnan(height)) continue;
        EXPECT_GE(height, 0.3F);
        near_half += height > 0.35F && height < 0.65F ? 1 : 0;
    }
    EXPECT_GT(near_half, 3U);
}

TEST(OccupancyCommand, SaysWhatIsWrong) {
    const TemporaryFolder scratch;
    EXPECT_EQ(terrawalk({"occupancy", scratch.path().string()}).exit_code, 3);
    EXPECT_EQ(terrawalk({"occupancy", scratch.path().string(), "--voxel", "0"}).exit_code, 2);
    EXPECT_EQ(
        terrawalk({"occupancy", scratch.path().string(), "--ground-layer", "2", "--greatest-height", "1"})
            .exit_code,
        2);
}

}  // namespace
}  // namespace terrawalk::test
