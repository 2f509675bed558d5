#include <gmock/gmock.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/pipeline/memory_need.hpp"
#include "app/pipeline/surface.hpp"
#include "app/pipeline/volume_job.hpp"
#include "io/read_breaklines.hpp"
#include "io/read_dem.hpp"
#include "tests/support/random_numbers.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using test::bytesOf;
using test::RandomNumbers;
using test::TemporaryFolder;
using test::writeBytes;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

void writePlane(const std::filesystem::path& file, const std::string& header, std::size_t count = 400) {
    RandomNumbers random(1);
    std::string text = header + "\n";
    for (std::size_t i = 0; i < count; ++i) {
        const double x = 500'000.0 + random.uniform(0.0, 40.0);
        const double y = 2'500'000.0 + random.uniform(0.0, 30.0);
        text += fmt::format("{:.6f},{:.6f},{:.9f}\n", x, y, 10.0 + 0.1 * (x - 500'000.0));
    }
    writeBytes(file, text);
}

Result<SurfaceOutcome> surfaceOf(const SurfaceRequest& request) {
    SilentProgress progress;
    return makeSurface(request, progress, {});
}

TEST(Surface, WritesTheDemAndTheReportBesideIt) {
    const TemporaryFolder folder;
    writePlane(folder / "plane.csv", "x_ft,y_ft,z_ft");
    SurfaceRequest request;
    request.points = folder / "plane.csv";
    request.output = folder / "dem.tif";
    request.model.method = InterpolationMethod::NaturalNeighbour;
    request.extent = {500'005.0, 2'500'005.0, 500'010.5, 2'500'009.0};
    request.resolution = 1.0;
    const auto outcome = surfaceOf(request);
    ASSERT_TRUE(outcome) << outcome.error().text();
    EXPECT_EQ(outcome->geometry.columns, 6u);
    EXPECT_EQ(outcome->geometry.rows, 4u);
    EXPECT_EQ(outcome->cells_with_height, 24u);
    EXPECT_NEAR(outcome->least_height, 10.55, 1e-5);
    EXPECT_NEAR(outcome->greatest_height, 11.05, 1e-5);
    const auto report = nlohmann::json::parse(bytesOf(folder / "dem.json"));
    EXPECT_EQ(report.at("unit"), "ft");
    EXPECT_EQ(report.at("method"), "natural-neighbour");
    EXPECT_EQ(report.at("cross_validation").at("ranking").size(), 2u);
    EXPECT_TRUE(std::filesystem::exists(folder / "dem.tif"));
    EXPECT_FALSE(std::filesystem::exists(folder / "dem_uncertainty.tif"));
    EXPECT_FALSE(std::filesystem::exists(folder / "dem_points.csv"));
    EXPECT_THAT(bytesOf(folder / "dem.qml"), HasSubstr("hillshade"));
}

TEST(Surface, PutsHeightsAndErrorsInOneFileWhereKrigingHasThem) {
    const TemporaryFolder folder;
    writePlane(folder / "plane.csv", "x_m,y_m,z_m", 150);
    SurfaceRequest request;
    request.points = folder / "plane.csv";
    request.output = folder / "dem.tif";
    request.resolution = 2.0;
    request.multiband = true;
    request.model.cross_validate = false;
    request.model.method = InterpolationMethod::Linear;
    const auto linear = surfaceOf(request);
    ASSERT_TRUE(linear) << linear.error().text();
    EXPECT_THAT(linear->notes, Contains(HasSubstr("no multiband file")));
    EXPECT_FALSE(std::filesystem::exists(folder / "dem_multiband.tif"));
    request.model.method = InterpolationMethod::Kriging;
    const auto kriging = surfaceOf(request);
    ASSERT_TRUE(kriging) << kriging.error().text();
    ASSERT_THAT(kriging->files, Contains(folder / "dem_multiband.tif"));
    EXPECT_THAT(kriging->notes, Contains(HasSubstr("variance of the method: noise times")));
    const auto variogram = nlohmann::json::parse(bytesOf(folder / "dem.json")).at("variogram");
    EXPECT_EQ(variogram.at("model"), kriging->variogram.value().model);
    EXPECT_GT(variogram.at("nugget").get<double>(), 0.0);
    EXPECT_GT(variogram.at("sill").get<double>(), 0.0);
    EXPECT_GT(variogram.at("range").get<double>(), 0.0);
    EXPECT_GT(variogram.at("pairs").get<std::size_t>(), 100u);
    EXPECT_THAT(toText(*kriging), HasSubstr("Variogram"));
    EXPECT_THAT(toText(*kriging), HasSubstr("hang together over"));
    EXPECT_FALSE(linear->variogram);
    // Its first band is the DEM's.
    const auto both = readDem(folder / "dem_multiband.tif", {}), alone = readDem(folder / "dem.tif", {});
    ASSERT_TRUE(both && alone);
    const auto errors = readDem(folder / "dem_uncertainty.tif", {});
    ASSERT_TRUE(errors);
    EXPECT_EQ(errors->heights_sha256, sha256OfHeights(alone->grid));
    EXPECT_TRUE(mayBelongTo(*errors, alone->grid));
    EXPECT_NEAR(errors->correlation_range, kriging->error_range.value(), 6e-4);
    EXPECT_EQ(both->correlation_range, errors->correlation_range);
    ASSERT_EQ(both->grid.geometry, alone->grid.geometry);
    for (std::size_t i = 0; i < alone->grid.heights_m.size(); ++i) {
        if (std::isnan(alone->grid.heights_m[i])) continue;
        EXPECT_EQ(both->grid.heights_m[i], alone->grid.heights_m[i]);
    }
}

TEST(Surface, ChoosesByCrossValidationAndGivesTheSameBytesAgain) {
    const TemporaryFolder folder;
    writePlane(folder / "plane.csv", "x,y,z", 150);
    SurfaceRequest request;
    request.points = folder / "plane.csv";
    request.output = folder / "dem.tif";
    const auto outcome = surfaceOf(request);
    ASSERT_TRUE(outcome) << outcome.error().text();
    EXPECT_EQ(outcome->method, outcome->validation->ranking.front());
    EXPECT_EQ(outcome->validation->methods.size(), kInterpolationMethods.size());
    const auto before = test::readTree(folder.path());
    ASSERT_TRUE(surfaceOf(request));
    EXPECT_EQ(before, test::readTree(folder.path()));
}

TEST(Surface, FollowsBreaklinesOfAVectorFile) {
    const TemporaryFolder folder;
    writePlane(folder / "plane.csv", "x_m,y_m,z_m");
    // A wall five metres above the plane, and a boundary about the middle.
    writeBytes(
        folder / "lines.geojson",
        R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::32649"}},
"features":[{"type":"Feature","properties":{"kind":"hard"},"geometry":{"type":"LineString",
"coordinates":[[500010,2500015.5,16],[500030,2500015.5,18]]}},
{"type":"Feature","properties":{},"geometry":{"type":"Polygon",
"coordinates":[[[500005,2500005],[500035,2500005],[500035,2500025],[500005,2500025],[500005,2500005]]]}}]})");
    SurfaceRequest request;
    request.points = folder / "plane.csv";
    request.output = folder / "dem.tif";
    request.breaklines = folder / "lines.geojson";
    request.resolution = 1.0;
    request.crs = "EPSG:32649";
    const auto outcome = surfaceOf(request);
    ASSERT_TRUE(outcome) << outcome.error().text();
    EXPECT_EQ(outcome->breaklines_used, 2u);
    EXPECT_EQ(outcome->cells_with_height, 30u * 20u);
    EXPECT_NEAR(outcome->greatest_height, 18.0, 0.06);
    request.crs = "EPSG:32650";
    EXPECT_THAT(surfaceOf(request).error().text(), HasSubstr("the breaklines are in"));
    request.model.method = InterpolationMethod::Kriging;
    EXPECT_EQ(surfaceOf(request).error().kind, ErrorKind::Usage);
    request.breaklines = request.points;
    request.model.method.reset();
    EXPECT_THAT(surfaceOf(request).error().text(), HasSubstr("no line"));
}

TEST(Surface, SaysWhatCoordinatesLookLikeWhoseCrsIsNoPlane) {
    const TemporaryFolder folder;
    writePlane(folder / "plane.csv", "x_m,y_m,z_m");
    SurfaceRequest request;
    request.points = folder / "plane.csv";
    request.output = folder / "dem.tif";
    request.breaklines = folder / "lines.geojson";
    request.crs = "EPSG:32649";
    const auto refusalOf = [&](const std::string& coordinates) {
        writeBytes(request.breaklines,
                   R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},)"
                   R"("geometry":{"type":"LineString","coordinates":)" +
                       coordinates + "}}]}");
        const auto outcome = surfaceOf(request);
        return outcome ? std::string() : outcome.error().text();
    };
    EXPECT_THAT(
        refusalOf("[[500010,2500015.5,16],[500030,2500016,18]]"),
        testing::AllOf(HasSubstr("lines.geojson: the breaklines have x 500010 to 500030 and y 2500015.5 to "
                                 "2500016, which are no degrees, but"),
                       HasSubstr("names no CRS counts as WGS 84"), HasSubstr("-a_srs")));
    EXPECT_THAT(refusalOf("[[113.1,23.1,16],[113.2,23.2,18]]"), HasSubstr("which could be degrees"));
    request.points = request.breaklines;
    request.breaklines.clear();
    request.crs.clear();
    writeBytes(request.points,
               R"({"type":"MultiPoint","coordinates":[[500010,2500015,16],[500030,2500016,18]]})");
    EXPECT_THAT(surfaceOf(request).error().text(), HasSubstr("lines.geojson: the points have x 500010"));
    request.points = folder / "one.csv";
    writeBytes(request.points, "x,y,z\n1,2,3\n");
    EXPECT_THAT(
        surfaceOf(request).error().text(),
        testing::AllOf(HasSubstr("one.csv"), HasSubstr("right file"), Not(HasSubstr("walk several"))));
}

TEST(Surface, RefusesContradictingUnitsAndItsOwnInput) {
    const TemporaryFolder folder;
    writePlane(folder / "plane.csv", "x_ft,y_ft,z_ft");
    SurfaceRequest request;
    request.points = folder / "plane.csv";
    request.output = folder / "dem.tif";
    request.unit = "m";
    EXPECT_THAT(surfaceOf(request).error().text(), HasSubstr("are in ft"));
    request.unit.clear();
    request.crs = "EPSG:32649";
    EXPECT_THAT(surfaceOf(request).error().text(), HasSubstr("EPSG:32649) is in m"));
    request.crs = "EPSG:2229";  // in feet of US surveys
    EXPECT_THAT(surfaceOf(request).error().text(),
                testing::AllOf(HasSubstr("_ft is the international foot"), HasSubstr("x_usft")));
    request.crs = "EPSG:4326";
    EXPECT_THAT(surfaceOf(request).error().text(), HasSubstr("project"));
    request.crs.clear();
    request.output = request.points;
    EXPECT_EQ(surfaceOf(request).error().kind, ErrorKind::Usage);
    EXPECT_FALSE(std::filesystem::exists(folder / "dem.tif"));
}

TEST(Surface, NeverReplacesWhatItReads) {
    const TemporaryFolder folder;
    writePlane(folder / "plane_uncertainty.tif.csv", "x_m,y_m,z_m");
    const std::string lines = R"({"type":"FeatureCollection","features":[]})";
    writeBytes(folder / "lines.json", lines);
    SurfaceRequest request;
    request.points = folder / "plane_uncertainty.tif.csv";
    request.breaklines = folder / "lines.json";
    request.output = folder / "lines.tif";
    request.model.method = InterpolationMethod::Linear;
    const auto outcome = surfaceOf(request);
    ASSERT_FALSE(outcome);
    EXPECT_EQ(outcome.error().kind, ErrorKind::Usage);
    EXPECT_THAT(outcome.error().text(), HasSubstr("lines.json"));
    EXPECT_EQ(bytesOf(folder / "lines.json"), lines);
    EXPECT_FALSE(std::filesystem::exists(folder / "lines.tif"));
}

TEST(Surface, SaysWhenAnOlderUncertaintyLiesBesideIt) {
    const TemporaryFolder folder;
    writePlane(folder / "plane.csv", "x_m,y_m,z_m");
    SurfaceRequest request;
    request.points = folder / "plane.csv";
    request.output = folder / "dem.tif";
    request.resolution = 2.0;
    request.model.cross_validate = false;
    request.model.method = InterpolationMethod::Linear;
    const auto alone = surfaceOf(request);
    ASSERT_TRUE(alone);
    EXPECT_THAT(alone->notes, Not(Contains(HasSubstr("dem_uncertainty.tif"))));
    request.model.method = InterpolationMethod::Kriging;
    ASSERT_TRUE(surfaceOf(request));
    ASSERT_TRUE(std::filesystem::exists(folder / "dem_uncertainty.tif"));
    request.model.method = InterpolationMethod::Linear;
    const auto again = surfaceOf(request);
    ASSERT_TRUE(again);
    EXPECT_THAT(again->notes, Contains(HasSubstr("dem_uncertainty.tif")));
}

/// Treads of 20 ft that climb to the north by steps of 3 ft.
void writeTerraces(const std::filesystem::path& file) {
    RandomNumbers random(2);
    std::string text = "x_ft,y_ft,z_ft\n";
    for (int i = 0; i < 1200; ++i) {
        const double x = random.uniform(0.0, 100.0), y = random.uniform(0.0, 100.0);
        const double into = (y - 10.0) / 20.0 - std::floor((y - 10.0) / 20.0);
        const double z = 3.0 * (std::floor((y - 10.0) / 20.0) + std::min(1.0, into * 20.0 / 2.0));
        text += fmt::format("{:.6f},{:.6f},{:.6f}\n", x, y, z + 0.1 * random.normal());
    }
    writeBytes(file, text);
}

TEST(Surface, KeepsToTerraceEdgesThatItFinds) {
    const TemporaryFolder folder;
    writeTerraces(folder / "terraces.csv");
    SurfaceRequest request;
    request.points = folder / "terraces.csv";
    request.output = folder / "dem.tif";
    request.model.method = InterpolationMethod::Linear;
    request.resolution = 1.0;
    const auto found = surfaceOf(request);
    ASSERT_TRUE(found) << found.error().text();
    EXPECT_GT(found->terrace_edges.length_m, 250.0);
    EXPECT_NEAR(found->terrace_edges.median_step_m, 3.0, 0.3);
    ASSERT_THAT(found->files, Contains(folder / "dem_terrace_edges.gpkg"));
    SilentProgress silent;
    const auto lines = readBreaklines(folder / "dem_terrace_edges.gpkg", silent, {});
    ASSERT_TRUE(lines) << lines.error().text();
    ASSERT_EQ(lines->lines.size(), 2 * found->terrace_edges.count);
    EXPECT_EQ(lines->lines.front().kind, BreaklineKind::Soft);
    EXPECT_TRUE(std::isfinite(lines->lines.front().vertices_m.front().z()));
    const auto report = nlohmann::json::parse(bytesOf(folder / "dem.json"));
    EXPECT_EQ(report.at("terrace_edges").at("requested"), "auto");
    EXPECT_EQ(report.at("terrace_edges").at("count"), found->terrace_edges.count);
    const std::string dem = bytesOf(folder / "dem.tif"), edges = bytesOf(folder / "dem_terrace_edges.gpkg");
    ASSERT_TRUE(surfaceOf(request));
    EXPECT_EQ(bytesOf(folder / "dem.tif"), dem);
    EXPECT_EQ(bytesOf(folder / "dem_terrace_edges.gpkg"), edges);

    // The lines can be given back by hand.
    request.breaklines = folder / "dem_terrace_edges.gpkg";
    request.output = folder / "again.tif";
    request.model.terrace_edges = TerraceEdgeUse::Off;
    const auto again = surfaceOf(request);
    ASSERT_TRUE(again) << again.error().text();
    EXPECT_EQ(again->terrace_edges.count, 0u);

    request.breaklines.clear();
    request.output = folder / "dem.tif";
    const auto off = surfaceOf(request);
    ASSERT_TRUE(off);
    EXPECT_NE(bytesOf(folder / "dem.tif"), dem);
    EXPECT_THAT(off->notes, Contains(HasSubstr("dem_terrace_edges.gpkg")));
    request.model.terrace_edges = TerraceEdgeUse::Auto;
    request.model.method = InterpolationMethod::Nearest;
    EXPECT_THAT(surfaceOf(request)->notes, Contains(HasSubstr("nearest cannot follow")));
}

TEST(Surface, LetsAllMethodsCompeteWhereTerraceEdgesAreFound) {
    const TemporaryFolder folder;
    SurfaceRequest request;
    request.points = folder / "points.csv";
    request.output = folder / "dem.tif";
    request.resolution = 1.0;
    // Steep risers between level treads: the edges are worth more than anything else.
    writeTerraces(request.points);
    const auto terraces = surfaceOf(request);
    ASSERT_TRUE(terraces) << terraces.error().text();
    ASSERT_TRUE(terraces->validation);
    EXPECT_EQ(terraces->validation->ranking.size(), kInterpolationMethods.size());
    EXPECT_TRUE(followsBreaklines(terraces->method)) << name(terraces->method);
    EXPECT_GT(terraces->terrace_edges.count, 0u);
    EXPECT_THAT(terraces->notes, Not(Contains(HasSubstr("not kept to"))));

    // One riser among waves with noise: who smooths wins, edges or not.
    RandomNumbers random(4);
    std::string text = "x_m,y_m,z_m\n";
    for (int i = 0; i < 2500; ++i) {
        const double x = random.uniform(0.0, 60.0), y = random.uniform(0.0, 60.0);
        const double z = 0.5 * std::sin(x / 3.0) * std::cos(y / 3.0) + std::clamp(y - 30.0, 0.0, 1.0) +
                         0.1 * random.normal();
        text += fmt::format("{:.6f},{:.6f},{:.6f}\n", x, y, z);
    }
    writeBytes(request.points, text);
    const auto waves = surfaceOf(request);
    ASSERT_TRUE(waves) << waves.error().text();
    EXPECT_FALSE(followsBreaklines(waves->method)) << name(waves->method);
    EXPECT_EQ(waves->method, waves->validation->ranking.front());
    EXPECT_EQ(waves->terrace_edges.count, 0u);
    EXPECT_THAT(waves->notes, Contains(HasSubstr("terrace edges found but not kept to: ")));
    EXPECT_THAT(waves->files, Not(Contains(folder / "dem_terrace_edges.gpkg")));
    EXPECT_THAT(waves->notes, Contains(HasSubstr("dem_terrace_edges.gpkg does not belong to this DEM")));
}

TEST(Surface, CleansAndThinsPointsInTheirOwnUnit) {
    const TemporaryFolder folder;
    writePlane(folder / "plane.csv", "x_ft,y_ft,z_ft");
    std::string text = bytesOf(folder / "plane.csv");
    text += "500020,2500015,90\n";
    writeBytes(folder / "plane.csv", text);
    SurfaceRequest request;
    request.points = folder / "plane.csv";
    request.output = folder / "dem.tif";
    request.model.method = InterpolationMethod::Linear;
    const auto raw = surfaceOf(request);
    ASSERT_TRUE(raw);
    EXPECT_GT(raw->greatest_height, 30.0);
    request.cleaning.radius.use = true;
    request.cleaning.radius.radius_m = 3.0;
    const auto cleaned = surfaceOf(request);
    ASSERT_TRUE(cleaned) << cleaned.error().text();
    EXPECT_EQ(cleaned->points_used, 400u);
    ASSERT_EQ(cleaned->points_left_out.size(), 1u);
    EXPECT_EQ(cleaned->points_left_out.front().reason, "isolated");
    EXPECT_LT(cleaned->greatest_height, 15.0);
    const auto radiusUsed = [&] {
        const auto report = nlohmann::json::parse(bytesOf(folder / "dem.json"));
        return report.at("cleaning").at("radius").at("radius_m").get<double>();
    };
    EXPECT_EQ(radiusUsed(), 3.0);
    request.cleaning.radius.radius_m = 0.0;
    const auto by_spacing = surfaceOf(request);
    ASSERT_TRUE(by_spacing);
    EXPECT_EQ(by_spacing->points_used, 400u);
    EXPECT_EQ(radiusUsed(), by_spacing->cleaning.radius.radius_m);
    EXPECT_GT(radiusUsed(), 0.5);  // 400 points in 12 m by 9 m
    EXPECT_LT(radiusUsed(), 2.0);
    request.cleaning.radius.radius_m = 3.0;
    ASSERT_THAT(cleaned->files, Contains(folder / "dem_points.csv"));
    const std::string points = bytesOf(folder / "dem_points.csv");
    EXPECT_TRUE(points.starts_with("x_ft,y_ft,z_ft,used,reason\n"));
    EXPECT_THAT(points, HasSubstr("500020.0000,2500015.0000,90.0000,0,isolated\n"));
    EXPECT_EQ(std::count(points.begin(), points.end(), '\n'), 402) << "a header and every point";
    request.thinning_cell_m = 10.0 * 0.3048;
    const auto thinned = surfaceOf(request);
    ASSERT_TRUE(thinned);
    EXPECT_EQ(thinned->points_used, 12u) << "40 x 30 ft in cells of 10 ft";
    request.thinning_cell_m = -1.0;
    EXPECT_EQ(surfaceOf(request).error().kind, ErrorKind::Usage);
}

Result<VolumeOutcome> volumeOfFile(const VolumeRequest& request) {
    SilentProgress progress;
    return measureVolume(request, progress, {});
}

// A plane that rises by 0.1 to the east over 20 x 10 cells: 20 * 10 * (11.5 - 11) above the level of 11.
TEST(Volume, BetweenAPlaneAndADemOfSurface) {
    const TemporaryFolder folder;
    writePlane(folder / "plane.csv", "x_m,y_m,z_m");
    SurfaceRequest surface;
    surface.points = folder / "plane.csv";
    surface.output = folder / "dem.tif";
    surface.model.method = InterpolationMethod::Linear;
    surface.model.cross_validate = false;
    surface.extent = {500'005.0, 2'500'010.0, 500'025.0, 2'500'020.0};
    surface.resolution = 1.0;
    ASSERT_TRUE(surfaceOf(surface));
    VolumeRequest request;
    request.dem = folder / "dem.tif";
    request.plane = 11.0;
    request.sigma = 0.1;
    const auto outcome = volumeOfFile(request);
    ASSERT_TRUE(outcome) << outcome.error().text();
    EXPECT_NEAR(outcome->volume.net_m3, 100.0, 1e-3);
    EXPECT_NEAR(outcome->volume.net_sigma_m3, 0.1 * std::sqrt(200.0), 1e-6);
    EXPECT_NEAR(outcome->volume.above.volume_m3 - outcome->volume.below.volume_m3, 100.0, 1e-3);

    request.plane.reset();
    request.against = request.dem;
    const auto same = volumeOfFile(request);
    ASSERT_TRUE(same) << same.error().text();
    EXPECT_EQ(same->volume.net_m3, 0.0);
    EXPECT_NEAR(same->volume.net_sigma_m3, 0.1 * std::sqrt(2.0 * 200.0), 1e-5);

    surface.output = folder / "other.tif";
    surface.resolution = 2.0;
    ASSERT_TRUE(surfaceOf(surface));
    request.against = folder / "other.tif";
    EXPECT_THAT(volumeOfFile(request).error().text(), HasSubstr("cells are not those"));
    request.plane = 1.0;
    EXPECT_EQ(volumeOfFile(request).error().kind, ErrorKind::Usage);
    request.against.clear();
    request.sigma = -1.0;
    EXPECT_EQ(volumeOfFile(request).error().kind, ErrorKind::Usage);
    request.sigma = 0.0;
    request.dem = surface.points;
    EXPECT_EQ(volumeOfFile(request).error().kind, ErrorKind::BadData);
}

TEST(MemoryNeed, IsRefusedWithAResolutionThatFits) {
    const MemoryNeed need{1'000'000, 400'000'000, true};
    EXPECT_TRUE(checkMemory(need, 20e9, 0.5));
    const double available = 4e9;
    const auto refused = checkMemory(need, available, 0.5);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::System);
    const std::string cure = refused.error().cure;
    ASSERT_THAT(cure, HasSubstr("resolution of "));
    const double proposed = std::stod(cure.substr(cure.find("of ") + 3));
    MemoryNeed coarser = need;
    const auto cells_at = [&](double cell) {
        return static_cast<std::size_t>(static_cast<double>(need.cells) * 0.25 / (cell * cell));
    };
    coarser.cells = cells_at(proposed);
    EXPECT_TRUE(checkMemory(coarser, available, proposed));
    coarser.cells = cells_at(0.8 * proposed);
    EXPECT_FALSE(checkMemory(coarser, available, proposed));
    EXPECT_THAT(checkMemory({10'000'000, 10, false}, 1e9, 1.0).error().cure, HasSubstr("thin"));
    ASSERT_TRUE(availableMemory_bytes());
    EXPECT_GT(*availableMemory_bytes(), 1e6);
}

TEST(Surface, SaysHowItsRastersArePacked) {
    const TemporaryFolder folder;
    writePlane(folder / "plane.csv", "x_m,y_m,z_m");
    SurfaceRequest request;
    request.points = folder / "plane.csv";
    request.output = folder / "dem.tif";
    request.resolution = 0.05;
    request.model.method = InterpolationMethod::Linear;
    request.model.cross_validate = false;
    ASSERT_TRUE(surfaceOf(request));
    const auto packed = readDem(folder / "dem.tif", {});
    const auto bytes = std::filesystem::file_size(folder / "dem.tif");
    request.storage = {RasterCompression::None, false};
    ASSERT_TRUE(surfaceOf(request));
    const auto bare = readDem(folder / "dem.tif", {});
    ASSERT_TRUE(packed && bare);
    EXPECT_EQ(sha256OfHeights(packed->grid), sha256OfHeights(bare->grid));
    EXPECT_GT(std::filesystem::file_size(folder / "dem.tif"), 2 * bytes);
    const auto report = nlohmann::json::parse(bytesOf(folder / "dem.json"));
    EXPECT_EQ(report.at("compression"), "none");
    EXPECT_EQ(report.at("overviews"), false);
}

// Volumes of kriged surfaces over ground drawn by lot: a sum of waves of many directions and lengths, with
// noise in the heights. Each survey measures the volume above a plane over a square inside the points.
TEST(Surface, ErrorBarsOfVolumesOfKrigingHoldTheTruth) {
    constexpr int kSurveys = 40, kWaves = 40;
    constexpr double kSide_m = 60.0, kNoise_m = 0.05;
    double squares = 0.0, squares_independent = 0.0;
    int held = 0;
    for (int survey = 0; survey < kSurveys; ++survey) {
        const TemporaryFolder folder;
        RandomNumbers random(7100 + static_cast<std::uint64_t>(survey));
        struct Wave {
            double east, north, phase, height_m;
        };
        std::vector<Wave> waves;
        for (int w = 0; w < kWaves; ++w) {
            const double length_m = std::exp(random.uniform(std::log(4.0), std::log(60.0)));
            const double angle = random.uniform(0.0, 6.2831853), number = 6.2831853 / length_m;
            waves.push_back({number * std::cos(angle), number * std::sin(angle),
                             random.uniform(0.0, 6.2831853), 0.02 * length_m / std::sqrt(20.0)});
        }
        const auto ground = [&](double x, double y) {
            double z = 0.0;
            for (const Wave& w : waves) z += w.height_m * std::sin(w.east * x + w.north * y + w.phase);
            return z;
        };
        std::string text = "x_m,y_m,z_m\n";
        for (int i = 0; i < 900; ++i) {
            const double x = random.uniform(0.0, kSide_m), y = random.uniform(0.0, kSide_m);
            text += fmt::format("{:.6f},{:.6f},{:.6f}\n", x, y, ground(x, y) + kNoise_m * random.normal());
        }
        writeBytes(folder / "points.csv", text);
        SurfaceRequest request;
        request.points = folder / "points.csv";
        request.output = folder / "dem.tif";
        request.resolution = 1.0;
        request.extent = {5.0, 5.0, 55.0, 55.0};
        request.model.method = InterpolationMethod::Kriging;
        request.model.cross_validate = false;
        const auto outcome = surfaceOf(request);
        ASSERT_TRUE(outcome) << outcome.error().text();
        ASSERT_GT(outcome->error_range.value(), 0.0);
        VolumeRequest asked;
        asked.dem = folder / "dem.tif";
        asked.uncertainty = folder / "dem_uncertainty.tif";
        asked.plane = 0.0;
        SilentProgress silent;
        const auto volume = measureVolume(asked, silent, {});
        asked.correlation_range = 0.0;
        const auto independent = measureVolume(asked, silent, {});
        ASSERT_TRUE(volume && independent) << volume.error().text();
        const auto dem = readDem(folder / "dem.tif", {});
        ASSERT_TRUE(dem);
        double truth = 0.0;
        for (std::size_t cell = 0; cell < dem->grid.heights_m.size(); ++cell) {
            const GridGeometry& g = dem->grid.geometry;
            if (std::isnan(dem->grid.heights_m[cell])) continue;
            truth += ground(g.centreX(cell % g.columns), g.centreY(cell / g.columns));
        }
        const double error = volume->volume.net_m3 - truth;
        squares += std::pow(error / volume->volume.net_sigma_m3, 2);
        squares_independent += std::pow(error / independent->volume.net_sigma_m3, 2);
        held += std::abs(error) <= 1.96 * volume->volume.net_sigma_m3 ? 1 : 0;
    }
    RecordProperty("held", held);
    RecordProperty("mean_square", fmt::format("{:.3f}", squares / kSurveys));
    RecordProperty("mean_square_independent", fmt::format("{:.3f}", squares_independent / kSurveys));
    // 95 % of 40 is 38; 34 or fewer come once in a hundred. The mean square of 40 normal errors lies within
    // 0.5 and 1.7 ninety-eight times in a hundred.
    EXPECT_GE(held, 35);
    EXPECT_GT(squares / kSurveys, 0.5);
    EXPECT_LT(squares / kSurveys, 1.7);
    // Cells taken for independent would not have held it.
    EXPECT_GT(squares_independent / kSurveys, 2.5);
}

}  // namespace
}  // namespace terrawalk
