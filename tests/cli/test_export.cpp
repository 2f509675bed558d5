#include <fmt/format.h>
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

TEST(ExportCommand, WritesTheDayOfTheSurvey) {
    const TemporaryFolder scratch;
    fs::copy(quickPlot(), scratch / "field", fs::copy_options::recursive);
    for (const auto& [log, start] : {std::pair{"F02", "2024-05-17T08:30:00Z"}, {"S01", "2024-05-18"}}) {
        const fs::path file = scratch / "field/logs" / fmt::format("{}.csv", log);
        const std::string text = bytesOf(file);
        const std::size_t second = text.find('\n') + 1;
        writeBytes(file,
                   fmt::format("{}# start_utc: {}\n{}", text.substr(0, second), start, text.substr(second)));
    }
    const std::string out = (scratch / "out").string();
    ASSERT_EQ(terrawalk({"process", (scratch / "field").string(), "-o", out, "--quiet"}).exit_code, 0);
    EXPECT_EQ(json::parse(bytesOf(scratch / "out/manifest.json")).at("survey_date"), "2024-05-17");
    ASSERT_EQ(terrawalk({"export", out, "--points", "las", "--mesh", "landxml"}).exit_code, 0);
    EXPECT_THAT(bytesOf(scratch / "out-export/surface.xml"), HasSubstr("date=\"2024-05-17\""));
    // Day 138 of the year 2024, little-endian, from byte 90 on.
    EXPECT_EQ(bytesOf(scratch / "out-export/ground_points.las").substr(90, 4),
              std::string("\x8a\0\xe8\x07", 4));
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
