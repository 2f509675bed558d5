#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/cli_support.hpp"

namespace terrawalk::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

TEST(ExportCommand, WritesEveryFormatOfAProcessedSurvey) {
    const TemporaryFolder scratch;
    const std::string out = (scratch / "out").string();
    ASSERT_EQ(terrawalk({"process", quickPlot().string(), "-o", out, "--quiet"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(scratch / "out/dem.qml"));
    EXPECT_TRUE(fs::exists(scratch / "out/dem.qlr"));
    const std::vector<std::string> all{"export", out,       "--points", "las,ply,pcd,csv,gpkg",
                                       "--mesh", "stl,dxf", "--mesh",   "landxml",
                                       "--dem",  "asc",     "--json"};
    const auto outcome = terrawalk(all);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json told = json::parse(outcome.out);
    EXPECT_EQ(told.at("files").size(), 9U);
    for (const json& file : told.at("files"))
        EXPECT_GT(fs::file_size(file.get<std::string>()), 1000U) << file;
    EXPECT_GT(told.at("points").get<int>(), 100);
    EXPECT_EQ(told.at("points_not_used"), 0);
    // The points lie on the map of the DEM: gridded again they give its heights.
    const auto again =
        terrawalk({"surface", (scratch / "out-export/ground_points.las").string(), "-o",
                   (scratch / "again.tif").string(), "--method", "linear", "--no-validation", "--json"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_THAT(json::parse(again.out).at("crs").get<std::string>(), HasSubstr("UTM zone 49N"));

    const auto files = readTree(scratch / "out-export");
    ASSERT_EQ(terrawalk(all).exit_code, 0);
    EXPECT_EQ(readTree(scratch / "out-export"), files) << "the same bytes again";

    const auto unused = terrawalk(
        {"export", out, "--points", "csv", "--all-points", "--json", "-o", (scratch / "more").string()});
    ASSERT_EQ(unused.exit_code, 0);
    EXPECT_GT(json::parse(unused.out).at("points_not_used").get<int>(), 0);
    EXPECT_THAT(bytesOf(scratch / "more/ground_points.csv"), HasSubstr(",0,thinned\n"));
}

TEST(ExportCommand, SaysWhatIsWrong) {
    const TemporaryFolder scratch;
    EXPECT_EQ(terrawalk({"export", scratch.path().string()}).exit_code, 2);
    EXPECT_EQ(terrawalk({"export", scratch.path().string(), "--points", "e57"}).exit_code, 2);
    const auto empty = terrawalk({"export", scratch.path().string(), "--points", "las"});
    EXPECT_EQ(empty.exit_code, 3);
    EXPECT_THAT(empty.err, HasSubstr("process the survey first"));
    writeBytes(scratch / "old/manifest.json", R"({"format": "terrawalk-output 1", "products": []})");
    const auto old = terrawalk({"export", (scratch / "old").string(), "--points", "las"});
    EXPECT_EQ(old.exit_code, 3);
    EXPECT_THAT(old.err, HasSubstr("frame"));
}

}  // namespace
}  // namespace terrawalk::test
