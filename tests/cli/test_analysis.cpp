#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/coordinate_system.hpp"
#include "io/read_dem.hpp"
#include "io/write_products.hpp"
#include "tests/cli/cli_support.hpp"

namespace terrawalk::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

/// Writes a raster in UTM coordinates, 40 x 30 cells of a metre, x and y counted from its south-west corner.
std::string made(const fs::path& file, const std::function<double(double, double)>& value,
                 const std::vector<std::pair<std::string, std::string>>& metadata = {}) {
    const auto crs = describeCrs("EPSG:32649");
    EXPECT_TRUE(crs);
    ElevationGrid grid{{745600.0, 2565730.0, 1.0, 40, 30}, {}};
    for (std::size_t row = 0; row < 30; ++row) {
        for (std::size_t column = 0; column < 40; ++column) {
            grid.heights_m.push_back(static_cast<float>(
                value(static_cast<double>(column) + 0.5, 29.5 - static_cast<double>(row))));
        }
    }
    const auto written = writeDem(grid,
                                  {.crs_wkt2 = crs->wkt2,
                                   .vertical_datum = "local",
                                   .title = "made",
                                   .software = {},
                                   .metadata = metadata},
                                  file);
    EXPECT_TRUE(written) << written.error().text();
    return file.string();
}

std::string hill(const fs::path& file) {
    return made(file, [](double x, double y) { return 38.0 + 0.1 * x + 0.05 * y; });
}

ElevationGrid read(const fs::path& file) {
    const auto dem = readDem(file, {});
    EXPECT_TRUE(dem) << file;
    return dem ? dem->grid : ElevationGrid{};
}

std::vector<std::vector<double>> tableOf(const fs::path& file) {
    std::ifstream lines(file);
    std::vector<std::vector<double>> rows;
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        rows.emplace_back();
        std::istringstream fields(line);
        for (std::string field; std::getline(fields, field, ',');) {
            rows.back().push_back(field.empty() ? std::nan("") : std::stod(field));
        }
    }
    return rows;
}

TEST(ContourCommand, SmoothsWithinTheStandardErrorsThatLieBesideTheDem) {
    const TemporaryFolder scratch;
    const std::string dem = made(scratch / "dem.tif", [](double x, double y) {
        return 38.26 + (x > 20 ? 0.3 : 0.0) + 0.04 * std::sin(0.9 * x) * std::sin(0.9 * y);
    });
    const auto contours = [&](std::vector<std::string> more) {
        std::vector<std::string> command{"contour",    dem,    "-o",    (scratch / "c.gpkg").string(),
                                         "--interval", "0.25", "--json"};
        command.insert(command.end(), more.begin(), more.end());
        const auto outcome = terrawalk(command);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return json::parse(outcome.out);
    };
    const double noisy = contours({}).at("length");
    EXPECT_EQ(contours({}).at("uncertainty"), "");
    const std::string sigma = made(scratch / "dem_uncertainty.tif", [](double, double) { return 0.05; });
    const json calm = contours({});
    EXPECT_EQ(calm.at("uncertainty"), sigma);
    EXPECT_LT(calm.at("length").get<double>(), 0.5 * noisy);
    EXPECT_EQ(contours({"--smoothing", "0"}).at("uncertainty"), "");
    // A DEM made anew beside the standard errors of an earlier one.
    const auto hash = sha256OfHeights(read(dem));
    const auto flat = [](double, double) {
        return 0.05;
    };
    made(sigma, flat, {{kHeightsSha256, hash}});
    EXPECT_EQ(contours({}).at("length"), calm.at("length"));
    EXPECT_EQ(contours({}).at("note"), "");
    made(sigma, flat, {{kHeightsSha256, std::string(64, '0')}});
    const json passed_over = contours({});
    EXPECT_EQ(passed_over.at("length").get<double>(), noisy);
    EXPECT_EQ(passed_over.at("uncertainty"), "");
    EXPECT_THAT(passed_over.at("note").get<std::string>(),
                HasSubstr("dem_uncertainty.tif say that they are of other heights, and are not used"));
    const json named = contours({"--uncertainty", sigma});
    EXPECT_EQ(named.at("length"), calm.at("length"));
    EXPECT_THAT(named.at("note").get<std::string>(), HasSubstr("of other heights"));
    const std::vector<std::string> volume{"volume", dem, "--plane", "38", "--uncertainty", sigma};
    EXPECT_THAT(terrawalk(volume).out, HasSubstr("Note: the standard errors of dem_uncertainty.tif say"));
    made(sigma, flat, {{kHeightsSha256, hash}});
    EXPECT_THAT(terrawalk(volume).out, testing::Not(HasSubstr("of other heights")));
    // What lies beside the DEM by chance is passed over, what is named is not.
    writeBytes(scratch / "dem_uncertainty.tif", "no raster");
    EXPECT_EQ(contours({}).at("length").get<double>(), noisy);
    EXPECT_EQ(
        terrawalk({"contour", dem, "-o", (scratch / "c.gpkg").string(), "--uncertainty", sigma}).exit_code,
        3);
    EXPECT_THAT(terrawalk({"contour", hill(scratch / "h.tif"), "-o", (scratch / "c.gpkg").string(),
                           "--interval", "4", "--base", "40"})
                    .out,
                HasSubstr("1 line at 1 level from 40 to 40 m"));
}

TEST(ContourCommand, DrawsTheLevelsOfAHill) {
    const TemporaryFolder scratch;
    const std::string dem = hill(scratch / "dem.tif");
    const auto outcome = terrawalk({"contour", dem, "-o", (scratch / "c.gpkg").string(), "--interval", "0.5",
                                    "--smoothing", "0", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    GDALAllRegister();
    const GDALDatasetUniquePtr file(GDALDataset::Open((scratch / "c.gpkg").c_str(), GDAL_OF_VECTOR));
    ASSERT_NE(file, nullptr);
    std::size_t lines = 0;
    for (const auto& feature : file->GetLayer(0)) {
        const OGRLineString& line = *feature->GetGeometryRef()->toLineString();
        const double level = feature->GetFieldAsDouble("elevation");
        EXPECT_EQ(feature->GetFieldAsInteger("index"), std::fmod(level, 2.5) == 0.0 ? 1 : 0);
        for (int i = 0; i < line.getNumPoints(); ++i) {
            // Floats near 40 step by 3.8e-6.
            EXPECT_NEAR(38.0 + 0.1 * (line.getX(i) - 745600.0) + 0.05 * (line.getY(i) - 2565700.0), level,
                        1e-5);
        }
        ++lines;
    }
    EXPECT_EQ(json::parse(outcome.out).at("lines"), lines);
    EXPECT_EQ(lines, 10U) << "38.5 to 43";
    EXPECT_EQ(terrawalk({"contour", dem, "-o", (scratch / "c.shp").string()}).exit_code, 2);
    EXPECT_EQ(terrawalk({"contour", dem, "-o", (scratch / "c.dxf").string(), "--interval", "0"}).exit_code,
              2);
    EXPECT_EQ(terrawalk({"contour", dem, "-o", (scratch / "c.dxf").string(), "--interval", "100"}).exit_code,
              3);
    EXPECT_FALSE(fs::exists(scratch / "c.dxf"));
}

TEST(DeriveCommand, MakesEveryRaster) {
    const TemporaryFolder scratch;
    const std::string dem = hill(scratch / "dem.tif");
    const auto outcome =
        terrawalk({"derive", dem, "-o", (scratch / "made").string(), "--slope", "--aspect", "--hillshade",
                   "--curvature", "--roughness", "--flow-accumulation", "--flow-accumulation-dinf",
                   "--wet-spots", "--slope-unit", "percent", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(json::parse(outcome.out).at("files").size(), 10U);
    EXPECT_NEAR(read(scratch / "made/dem_slope.tif").at(10, 10), 100.0 * std::hypot(0.1, 0.05), 1e-3);
    EXPECT_NEAR(read(scratch / "made/dem_aspect.tif").at(10, 10), 180.0 + std::atan2(2.0, 1.0) * 180.0 / M_PI,
                1e-2);
    EXPECT_NEAR(read(scratch / "made/dem_roughness.tif").at(10, 10), 0.3, 1e-5);
    EXPECT_EQ(read(scratch / "made/dem_wet_spots.tif").at(10, 10), 0.0F);
    EXPECT_GT(read(scratch / "made/dem_flow_accumulation.tif").at(29, 0), 10.0F);
    EXPECT_GT(read(scratch / "made/dem_flow_accumulation_dinf.tif").at(29, 0), 10.0F);
    const GDALDatasetUniquePtr slope(GDALDataset::Open((scratch / "made/dem_slope.tif").c_str()));
    ASSERT_NE(slope, nullptr);
    EXPECT_STREQ(slope->GetRasterBand(1)->GetUnitType(), "percent");
    EXPECT_STREQ(slope->GetMetadataItem("METHOD"), "Horn 1981");
    EXPECT_EQ(terrawalk({"derive", dem}).exit_code, 2);
}

TEST(ProfileCommand, TellsHeightsRibbonAndMarks) {
    const TemporaryFolder scratch;
    const std::string dem = hill(scratch / "dem.tif");
    const std::string sigma = made(scratch / "sigma.tif", [](double, double) { return 0.05; });
    writeBytes(scratch / "marks.csv",
               "x_m,y_m,z_m,sigma_z_m\n745610,2565710.5,39.6,0.01\n745610,2565720,40,0.01\n");
    const auto outcome = terrawalk(
        {"profile", dem, "--from", "745605,2565710", "--to", "745625,2565710", "--uncertainty", sigma,
         "--check-points", (scratch / "marks.csv").string(), "-o", (scratch / "p.csv").string(), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json told = json::parse(outcome.out);
    EXPECT_DOUBLE_EQ(told.at("length").get<double>(), 20.0);
    EXPECT_NEAR(told.at("rise").get<double>(), 2.0, 1e-5);
    ASSERT_EQ(told.at("marks").size(), 1U);
    EXPECT_NEAR(told.at("marks")[0].at("offset").get<double>(), 0.5, 1e-9);
    const auto rows = tableOf(scratch / "p.csv");
    ASSERT_EQ(rows.size(), 41U);
    for (const auto& row : rows) {
        EXPECT_NEAR(row.at(3), 39.0 + 0.1 * row.at(0), 1e-4);
        EXPECT_NEAR(row.at(4), 0.05, 1e-9);
    }
    const std::string svg = bytesOf(scratch / "p.svg");
    EXPECT_THAT(svg, HasSubstr("<polygon"));
    EXPECT_THAT(svg, HasSubstr("Marks"));

    writeBytes(scratch / "line.geojson",
               R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32649"}},
                   "features": [{"type": "Feature", "properties": {}, "geometry":
                   {"type": "LineString", "coordinates": [[745605, 2565705], [745605, 2565715], [745610, 2565715]]}}]})");
    const auto along = terrawalk({"profile", dem, "--line", (scratch / "line.geojson").string(), "-o",
                                  (scratch / "q.csv").string(), "--json"});
    ASSERT_EQ(along.exit_code, 0) << along.err;
    EXPECT_NEAR(json::parse(along.out).at("rise").get<double>(), 1.0, 1e-5);
    EXPECT_EQ(terrawalk({"profile", dem}).exit_code, 2);
    EXPECT_EQ(terrawalk({"profile", dem, "--from", "745605,2565710", "--to", "745625,2565710", "--step", "0"})
                  .exit_code,
              2);
    EXPECT_EQ(terrawalk({"profile", dem, "--from", "1,2", "--to", "3,4", "-o", (scratch / "n.csv").string()})
                  .exit_code,
              3);
}

// What `process` writes into dem_uncertainty.tif is used unless another range is named.
TEST(VolumeCommand, TakesTheRangeOfErrorsFromTheUncertainty) {
    const TemporaryFolder scratch;
    const std::string dem = hill(scratch / "dem.tif");
    const auto flat = [](double, double) {
        return 0.1;
    };
    const std::string told = made(scratch / "told.tif", flat, {{kCorrelationRange, "10.000"}});
    const std::string not_told = made(scratch / "not_told.tif", flat);
    const auto netOf = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"volume", dem, "--plane", "38", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const auto outcome = terrawalk(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const json volume = json::parse(outcome.out);
        return std::pair{volume.at("net").at("standard_error").get<double>(),
                         volume.at("correlation_range").get<double>()};
    };
    const auto by_file = netOf({"--uncertainty", told});
    EXPECT_EQ(by_file.second, 10.0);
    EXPECT_EQ(by_file, netOf({"--uncertainty", not_told, "--correlation-range", "10"}));
    const auto alone = netOf({"--uncertainty", told, "--correlation-range", "0"});
    EXPECT_EQ(alone, netOf({"--uncertainty", not_told}));
    EXPECT_NEAR(alone.first, 0.1 * std::sqrt(1200.0), 1e-4);
    EXPECT_GT(by_file.first, 5.0 * alone.first);
    EXPECT_THAT(terrawalk({"volume", dem, "--plane", "38", "--uncertainty", told}).out,
                HasSubstr("hang together over 10 m, as the uncertainty says"));
    EXPECT_THAT(terrawalk({"volume", dem, "--plane", "38", "--uncertainty", not_told}).out,
                HasSubstr("each cell counts as independent"));
    const auto changed = terrawalk({"diff", dem, dem, "--earlier-uncertainty", told, "--later-uncertainty",
                                    not_told, "-o", (scratch / "d.tif").string(), "--json"});
    ASSERT_EQ(changed.exit_code, 0) << changed.err;
    EXPECT_EQ(json::parse(changed.out).at("correlation_range"), 10.0);
}

TEST(DiffCommand, TellsChangeFromError) {
    const TemporaryFolder scratch;
    const std::string before = hill(scratch / "before.tif");
    // A fill of 10 x 10 m by 0.5 m, and 0.05 m everywhere else, which is within the error.
    const std::string after = made(scratch / "after.tif", [](double x, double y) {
        return 38.0 + 0.1 * x + 0.05 * y + (x > 10 && x < 20 && y > 10 && y < 20 ? 0.5 : 0.05);
    });
    const auto outcome =
        terrawalk({"diff", before, after, "--sigma", "0.05", "-o", (scratch / "d.tif").string(), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json told = json::parse(outcome.out);
    EXPECT_EQ(told.at("cells_raised"), 100);
    EXPECT_EQ(told.at("cells_lowered"), 0);
    const json& net = told.at("volumes")[5];
    EXPECT_EQ(net.at("cells"), "significant");
    EXPECT_NEAR(net.at("volume").get<double>(), 50.0, 1e-3);
    EXPECT_NEAR(net.at("standard_error").get<double>(), 0.05 * std::sqrt(2.0) * 10.0, 1e-4);
    EXPECT_NEAR(told.at("volumes")[2].at("volume").get<double>(), 50.0 + 1100 * 0.05, 5e-3);
    const ElevationGrid mask = read(scratch / "d_significance.tif");
    EXPECT_EQ(mask.at(14, 14), 1.0F);
    EXPECT_EQ(mask.at(2, 2), 0.0F);
    EXPECT_NEAR(read(scratch / "d.tif").at(14, 14), 0.5, 1e-5);
    EXPECT_THAT(bytesOf(scratch / "d_volumes.csv"), HasSubstr("significant,net,50.000"));
    const std::string sigma = made(scratch / "sigma.tif", [](double, double) { return 0.01; });
    const auto sure = terrawalk({"diff", before, after, "--earlier-uncertainty", sigma, "--later-uncertainty",
                                 sigma, "-o", (scratch / "d.tif").string(), "--json"});
    ASSERT_EQ(sure.exit_code, 0) << sure.err;
    EXPECT_EQ(json::parse(sure.out).at("cells_raised"), 1200);
    EXPECT_EQ(terrawalk({"diff", before, after, "-o", (scratch / "d.tif").string()}).exit_code, 2)
        << "no sigma";
}

TEST(ValidateCommand, ShowsTheSameNumbersInTextJsonAndTable) {
    const TemporaryFolder scratch;
    const std::string dem = hill(scratch / "dem.tif");
    std::string points = "x_m,y_m,z_m,sigma_z_m\n";
    double squares = 0.0;
    for (int i = 0; i < 35; ++i) {
        const double x = 3.0 + i, y = 4.0 + (i * 7) % 20, error = 0.02 * ((i % 5) - 2) + 0.01;
        squares += error * error;
        std::ostringstream line;
        line.precision(12);
        line << 745600 + x << "," << 2565700 + y << "," << 38.0 + 0.1 * x + 0.05 * y - error << ",0.005\n";
        points += line.str();
    }
    points += "745000,2565000,10,0.005\n";
    writeBytes(scratch / "points.csv", points);
    const std::vector<std::string> command{"validate",
                                           dem,
                                           "--check-points",
                                           (scratch / "points.csv").string(),
                                           "-o",
                                           (scratch / "v.csv").string()};
    const auto text = terrawalk(command);
    ASSERT_EQ(text.exit_code, 0) << text.err;
    const json told = json::parse(bytesOf(scratch / "v.json"));
    const json& height = told.at("accuracy")[0].at("height");
    const double rmse = std::sqrt(squares / 35.0);
    EXPECT_EQ(height.at("n"), 35);
    EXPECT_NEAR(height.at("rmse_m").get<double>(), rmse, 1e-5);
    EXPECT_NEAR(height.at("mean_m").get<double>(), 0.01, 1e-5);
    EXPECT_EQ(told.at("marks_without_height"), json::array({"point 36"}));
    // From the table alone.
    std::ifstream table(scratch / "v.csv");
    std::string line;
    std::getline(table, line);
    double from_table = 0.0;
    int n = 0;
    while (std::getline(table, line)) {
        std::istringstream fields(line);
        std::string field;
        for (int i = 0; i < 11; ++i) std::getline(fields, field, ',');
        from_table += std::stod(field) * std::stod(field);
        ++n;
    }
    EXPECT_EQ(n, 35);
    EXPECT_NEAR(std::sqrt(from_table / n), height.at("rmse_m").get<double>(), 1e-6);
    char shown[32];
    std::snprintf(shown, sizeof shown, "%.4f", height.at("rmse_m").get<double>());
    EXPECT_THAT(text.out, HasSubstr(shown));
    EXPECT_THAT(text.out, HasSubstr("ASPRS"));
    for (const json& statement : told.at("statements"))
        EXPECT_THAT(text.out, HasSubstr(statement.get<std::string>()));

    const auto with_sigma =
        terrawalk({"validate", dem, "--check-points", (scratch / "points.csv").string(), "--uncertainty",
                   made(scratch / "s.tif", [](double, double) { return 0.02; }), "--json"});
    ASSERT_EQ(with_sigma.exit_code, 0) << with_sigma.err;
    // Errors of -0.03 to 0.05 against 1.96 hypot(0.02, 0.005): one in five is outside.
    EXPECT_EQ(json::parse(with_sigma.out).at("accuracy")[0].at("within_95").at("within"), 28);
    EXPECT_EQ(terrawalk({"validate", dem}).exit_code, 2);

    // RMSE 3.0 cm with the points' own 0.5 cm.
    const auto tested = [&](const std::string& asked) {
        return terrawalk({"validate", dem, "--check-points", (scratch / "points.csv").string(),
                          "--vertical-class", asked, "-o", (scratch / "t.csv").string()});
    };
    EXPECT_THAT(tested("5cm").out, HasSubstr("This data set was tested to meet ASPRS"));
    EXPECT_EQ(json::parse(bytesOf(scratch / "t.json")).at("vertical_class").at("met"), true);
    EXPECT_THAT(tested("0.025m").out, HasSubstr("does not meet the 2.5 cm RMSE_V"));
    EXPECT_EQ(json::parse(bytesOf(scratch / "t.json")).at("vertical_class").at("met"), false);
    for (const char* wrong : {"5", "0cm", "5 ft", "-5cm"}) EXPECT_EQ(tested(wrong).exit_code, 2) << wrong;
}

TEST(ValidateCommand, TakesMarksOfASurveyToItsMap) {
    const TemporaryFolder scratch;
    ASSERT_EQ(
        terrawalk({"process", quickPlot().string(), "-o", (scratch / "out").string(), "--quiet"}).exit_code,
        0);
    const std::string marks = (quickPlot() / "control.csv").string();
    const auto outcome =
        terrawalk({"validate", (scratch / "out/dem.tif").string(), "--marks", marks, "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json told = json::parse(outcome.out);
    ASSERT_EQ(told.at("accuracy")[0].at("role"), "check");
    // The report measures the triangles, this the cells of 0.2 m: close, and on the same ground.
    const json report = json::parse(bytesOf(scratch / "out/report.json"));
    double rmse = 0.0;
    for (const json& group : report.at("accuracy")) {
        if (group.at("quantity") == "surface height" && group.at("role") == "check")
            rmse = group.at("up").at("rmse_m");
    }
    EXPECT_NEAR(told.at("accuracy")[0].at("height").at("rmse_m").get<double>(), rmse, 0.05);
    fs::copy(scratch / "out/dem.tif", scratch / "alone.tif");
    const auto alone = terrawalk({"validate", (scratch / "alone.tif").string(), "--marks", marks});
    EXPECT_EQ(alone.exit_code, 3);
    EXPECT_THAT(alone.err, HasSubstr("--survey"));
    EXPECT_EQ(terrawalk({"validate", (scratch / "alone.tif").string(), "--marks", marks, "--survey",
                         (scratch / "out").string()})
                  .exit_code,
              0);
}

TEST(WalkAgainCommand, DrawsTheGroundThatIsKnownWorst) {
    const TemporaryFolder scratch;
    const std::string sigma = made(scratch / "sigma.tif", [](double x, double y) {
        if (x > 5 && x < 15 && y > 5 && y < 12) return 0.4;
        return x > 30 && y > 20 ? 0.2 : 0.05;
    });
    const auto outcome =
        terrawalk({"walk-again", sigma, "-o", (scratch / "w.gpkg").string(), "--least-area", "10", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NEAR(json::parse(outcome.out).at("target_sigma").get<double>(), 0.1, 1e-6);
    GDALAllRegister();
    const GDALDatasetUniquePtr file(GDALDataset::Open((scratch / "w.gpkg").c_str(), GDAL_OF_VECTOR));
    ASSERT_NE(file, nullptr);
    std::vector<double> areas;
    for (const auto& feature : file->GetLayer(0)) {
        EXPECT_EQ(feature->GetFieldAsInteger("rank"), static_cast<int>(areas.size()) + 1);
        areas.push_back(feature->GetGeometryRef()->toMultiPolygon()->get_Area());
        EXPECT_NEAR(areas.back(), feature->GetFieldAsDouble("area"), 1e-6);
    }
    EXPECT_EQ(areas, (std::vector<double>{70.0, 100.0}));

    // Small pieces count in a small field: here 12 of 1200 m2, and no more than 25 m2 in a large one.
    const std::string spots = made(scratch / "spots.tif", [](double x, double y) {
        if (x < 6 && y < 2) return 0.4;
        return x > 30 && x < 33 && y > 20 && y < 23 ? 0.4 : 0.05;
    });
    const auto small = terrawalk({"walk-again", spots, "-o", (scratch / "s.gpkg").string(), "--json"});
    ASSERT_EQ(small.exit_code, 0) << small.err;
    EXPECT_NEAR(json::parse(small.out).at("least_area").get<double>(), 12.0, 1e-6);
    ASSERT_EQ(json::parse(small.out).at("regions").size(), 1U);
    EXPECT_NEAR(json::parse(small.out).at("regions")[0].at("area").get<double>(), 12.0, 1e-6);
    EXPECT_THAT(
        terrawalk({"walk-again", spots, "-o", (scratch / "s.gpkg").string(), "--least-area", "13"}).out,
        HasSubstr("No piece of 13 m2 or more is known worse; --least-area takes smaller ones"));
    EXPECT_EQ(terrawalk({"walk-again", hill(scratch / "dem.tif"), "--target", "-1"}).exit_code, 2);
}

}  // namespace
}  // namespace terrawalk::test
