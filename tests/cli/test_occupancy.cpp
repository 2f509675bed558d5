#include <fmt/format.h>
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

TEST(OccupancyCommand, GivesWhatProcessGivesWhenAsked) {
    const TemporaryFolder scratch;
    const fs::path out = scratch / "out";
    ASSERT_EQ(terrawalk({"process", quickPlot().string(), "-o", out.string(), "--quiet", "--set",
                         "surface.occupancy.use=true", "--set", "surface.occupancy.voxel_m=0.2"})
                  .exit_code,
              0);
    const json report = json::parse(bytesOf(out / "report.json")).at("occupancy");
    const auto products = json::parse(bytesOf(out / "manifest.json")).at("products");
    for (const char* file : {"occupancy.bt", "occupancy.ot", "free_height.tif"}) {
        EXPECT_TRUE(fs::exists(out / file)) << file;
        EXPECT_THAT(products, testing::Contains(file));
    }
    const bool obstacles = report.at("cells_with_obstacle").get<int>() > 0;
    EXPECT_EQ(fs::exists(out / "obstacle_height.tif"), obstacles);
    const std::string html = bytesOf(out / "report.html");
    EXPECT_THAT(html, HasSubstr("Space above the ground"));
    EXPECT_THAT(html, HasSubstr(fmt::format("in {} of {} cells", report.at("cells_known_free").get<int>(),
                                            report.at("ground_cells").get<int>())));
    EXPECT_THAT(bytesOf(out / "figures.txt"), HasSubstr("free_height.tif"));

    // The command reads places and heights that were rounded when they were written: a ray may fall into the
    // next voxel.
    const auto after = terrawalk({"occupancy", out.string(), "--voxel", "0.2", "--json", "--quiet"});
    ASSERT_EQ(after.exit_code, 0) << after.err;
    const json told = json::parse(after.out);
    for (const auto& [key, value] : report.items()) {
        ASSERT_TRUE(told.contains(key)) << key;
        if (value.is_number_float()) {
            EXPECT_NEAR(told.at(key).get<double>(), value.get<double>(), 0.01 * std::abs(value.get<double>()))
                << key;
        } else if (key != "cells_known_free" && key != "cells_with_obstacle") {
            EXPECT_EQ(told.at(key), value) << key;
        }
    }

    EXPECT_EQ(
        terrawalk({"process", quickPlot().string(), "-o", (scratch / "bad").string(), "--quiet", "--set",
                   "surface.occupancy.use=true", "--set", "surface.occupancy.greatest_height_m=0.2"})
            .exit_code,
        2);
    const fs::path plain = scratch / "plain";
    ASSERT_EQ(terrawalk({"process", quickPlot().string(), "-o", plain.string(), "--quiet"}).exit_code, 0);
    EXPECT_TRUE(json::parse(bytesOf(plain / "report.json")).at("occupancy").is_null());
    EXPECT_FALSE(fs::exists(plain / "occupancy.bt"));
    EXPECT_EQ(bytesOf(plain / "dem.tif"), bytesOf(out / "dem.tif"));
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
