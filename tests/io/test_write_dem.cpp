#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <gdal_utils.h>
#include <gmock/gmock.h>
#include <ogr_spatialref.h>
#include <tbb/task_arena.h>

#include <array>
#include <cmath>
#include <memory>

#include "io/map_projection.hpp"
#include "io/write_products.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using test::bytesOf;
using test::TemporaryFolder;
using test::writeBytes;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct DatasetDeleter {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, DatasetDeleter>;

Dataset open(const std::filesystem::path& file) {
    GDALRegister_GTiff();
    GDALRegister_MEM();
    return Dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR));
}

std::vector<float> cellsIn(GDALDataset& dataset) {
    const int columns = dataset.GetRasterXSize();
    const int rows = dataset.GetRasterYSize();
    std::vector<float> cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    EXPECT_EQ(dataset.GetRasterBand(1)->RasterIO(GF_Read, 0, 0, columns, rows, cells.data(), columns, rows,
                                                 GDT_Float32, 0, 0, nullptr),
              CE_None);
    return cells;
}

std::string crsOf(const std::string& crs) {
    const GeodeticPosition zero{23.182753, 113.399795, 38.0};
    auto map = MapProjection::create(LocalFrame(zero), crs, "local");
    EXPECT_TRUE(map);
    return map->wkt2();
}

DemDescription description(const std::string& crs = "EPSG:32649") {
    return {crsOf(crs), "local", "Orchard, elevation", "terrawalk 0.1.0", {{"METHOD", "ukf"}}};
}

/// Falls by one in 64 to the east and one in 32 to the north: every value within a float, no rounding.
double plane(double x_m, double y_m) {
    return 40.0 - (x_m - 745000.0) / 64.0 + (y_m - 2565000.0) / 32.0;
}

ElevationGrid ramp(std::size_t columns, std::size_t rows, double cell_m = 0.5) {
    ElevationGrid grid{{745000.0, 2565000.0 + static_cast<double>(rows) * cell_m, cell_m, columns, rows}, {}};
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            grid.heights_m.push_back(
                static_cast<float>(plane(grid.geometry.centreX(column), grid.geometry.centreY(row))));
        }
    }
    return grid;
}

void write(const ElevationGrid& grid, const std::filesystem::path& file,
           const DemDescription& what = description()) {
    const auto written = writeDem(grid, what, file);
    ASSERT_TRUE(written) << written.error().text();
}

std::vector<std::string> namesIn(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        names.push_back(entry.path().filename().string());
    }
    return names;
}

TEST(WriteDem, ClassesAreBytesWithNothingAtZero) {
    const TemporaryFolder folder;
    ElevationGrid grid = ramp(700, 600);
    for (std::size_t i = 0; i < grid.heights_m.size(); ++i) {
        grid.heights_m[i] = i % 7 == 0 ? kNoHeight : static_cast<float>(1 + i % 3);
    }
    DemDescription what = description();
    what.classes = true;
    write(grid, folder / "source.tif", what);
    const Dataset dataset = open(folder / "source.tif");
    ASSERT_TRUE(dataset);
    GDALRasterBand& band = *dataset->GetRasterBand(1);
    EXPECT_EQ(band.GetRasterDataType(), GDT_Byte);
    EXPECT_EQ(band.GetNoDataValue(), 0.0);
    EXPECT_GT(band.GetOverviewCount(), 0);
    const auto cells = cellsIn(*dataset);
    ASSERT_EQ(cells.size(), grid.heights_m.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        ASSERT_EQ(cells[i], i % 7 == 0 ? 0.0F : grid.heights_m[i]) << i;
    }
    // What is no class is refused, not rounded.
    grid.heights_m[1] = 1.5F;
    EXPECT_FALSE(writeDem(grid, what, folder / "source.tif"));
}

TEST(WriteDem, RampComesBackCellByCellInItsPlace) {
    const TemporaryFolder folder;
    const ElevationGrid grid = ramp(700, 600);
    write(grid, folder / "dem.tif");
    const Dataset dataset = open(folder / "dem.tif");
    ASSERT_TRUE(dataset);
    std::array<double, 6> transform{};
    ASSERT_EQ(dataset->GetGeoTransform(transform.data()), CE_None);
    EXPECT_THAT(transform, ElementsAre(745000.0, 0.5, 0.0, 2565300.0, 0.0, -0.5));
    const auto cells = cellsIn(*dataset);
    ASSERT_EQ(cells.size(), grid.heights_m.size());
    for (int row = 0; row < 600; ++row) {
        for (int column = 0; column < 700; ++column) {
            // The place by GDAL's own convention: the geotransform is the outer corner.
            const double x_m = transform[0] + (column + 0.5) * transform[1];
            const double y_m = transform[3] + (row + 0.5) * transform[5];
            ASSERT_NEAR(cells[static_cast<std::size_t>(row * 700 + column)], plane(x_m, y_m), 1e-6);
        }
    }
}

TEST(WriteDem, RampSurvivesBilinearResamplingToCellsHalfACellAway) {
    const TemporaryFolder folder;
    write(ramp(64, 48), folder / "dem.tif");
    const Dataset dataset = open(folder / "dem.tif");
    CPLStringList arguments;
    for (const char* argument : {"-of", "MEM", "-r", "bilinear", "-tr", "0.5", "0.5", "-te", "745005.25",
                                 "2565005.25", "745025.25", "2565015.25", "-et", "0"}) {
        arguments.AddString(argument);
    }
    const std::unique_ptr<GDALWarpAppOptions, decltype(&GDALWarpAppOptionsFree)> options(
        GDALWarpAppOptionsNew(arguments.List(), nullptr), &GDALWarpAppOptionsFree);
    GDALDatasetH source = dataset.get();
    const Dataset shifted(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &source, options.get(), nullptr)));
    ASSERT_TRUE(shifted);
    ASSERT_EQ(shifted->GetRasterXSize(), 40);
    ASSERT_EQ(shifted->GetRasterYSize(), 20);
    const auto cells = cellsIn(*shifted);
    for (int row = 0; row < 20; ++row) {
        for (int column = 0; column < 40; ++column) {
            const double expected = plane(745005.5 + 0.5 * column, 2565015.0 - 0.5 * row);
            ASSERT_NEAR(cells[static_cast<std::size_t>(row * 40 + column)], expected, 1e-6);
        }
    }
}

TEST(WriteDem, IsACloudOptimizedGeoTiffThatSaysWhatItHolds) {
    const TemporaryFolder folder;
    ElevationGrid grid = ramp(1100, 1030);
    grid.heights_m[5] = kNoHeight;
    write(grid, folder / "dem.tif");
    const Dataset dataset = open(folder / "dem.tif");
    ASSERT_TRUE(dataset);
    EXPECT_STREQ(dataset->GetMetadataItem("LAYOUT", "IMAGE_STRUCTURE"), "COG");
    EXPECT_STREQ(dataset->GetMetadataItem("COMPRESSION", "IMAGE_STRUCTURE"), "DEFLATE");
    EXPECT_STREQ(dataset->GetMetadataItem("PREDICTOR", "IMAGE_STRUCTURE"), "3");
    EXPECT_STREQ(dataset->GetMetadataItem("AREA_OR_POINT"), "Area");
    EXPECT_STREQ(dataset->GetMetadataItem("VERTICAL_DATUM"), "local");
    EXPECT_STREQ(dataset->GetMetadataItem("METHOD"), "ukf");
    EXPECT_STREQ(dataset->GetMetadataItem("TIFFTAG_SOFTWARE"), "terrawalk 0.1.0");
    EXPECT_STREQ(dataset->GetMetadataItem("TIFFTAG_IMAGEDESCRIPTION"), "Orchard, elevation");
    EXPECT_EQ(dataset->GetMetadataItem("TIFFTAG_DATETIME"), nullptr);
    EXPECT_STREQ(dataset->GetSpatialRef()->GetAuthorityCode(nullptr), "32649");

    GDALRasterBand* const band = dataset->GetRasterBand(1);
    EXPECT_STREQ(band->GetDescription(), "Elevation (m)");
    EXPECT_STREQ(band->GetUnitType(), "m");
    EXPECT_EQ(band->GetRasterDataType(), GDT_Float32);
    int has_no_data = FALSE;
    EXPECT_EQ(band->GetNoDataValue(&has_no_data), -9999.0);
    EXPECT_EQ(has_no_data, TRUE);
    EXPECT_EQ(cellsIn(*dataset)[5], -9999.0F);
    int block_columns = 0;
    int block_rows = 0;
    band->GetBlockSize(&block_columns, &block_rows);
    EXPECT_EQ(block_columns, 256);
    EXPECT_EQ(block_rows, 256);
    ASSERT_EQ(band->GetOverviewCount(), 3);
    EXPECT_EQ(band->GetOverview(0)->GetXSize(), 550);
    EXPECT_EQ(band->GetOverview(1)->GetXSize(), 275);
    EXPECT_THAT(namesIn(folder.path()), ElementsAre("dem.tif"));
}

TEST(WriteDem, OverviewsAreAveragesThatLeaveOutNodata) {
    const TemporaryFolder folder;
    ElevationGrid grid = ramp(1024, 1024);
    grid.heights_m[0] = kNoHeight;
    write(grid, folder / "dem.tif");
    const Dataset dataset = open(folder / "dem.tif");
    float corner = 0.0F;
    float inside = 0.0F;
    GDALRasterBand* const half = dataset->GetRasterBand(1)->GetOverview(0);
    ASSERT_EQ(half->RasterIO(GF_Read, 0, 0, 1, 1, &corner, 1, 1, GDT_Float32, 0, 0, nullptr), CE_None);
    ASSERT_EQ(half->RasterIO(GF_Read, 100, 50, 1, 1, &inside, 1, 1, GDT_Float32, 0, 0, nullptr), CE_None);
    EXPECT_NEAR(corner, (grid.at(0, 1) + grid.at(1, 0) + grid.at(1, 1)) / 3.0F, 1e-5);
    EXPECT_NEAR(inside, (grid.at(100, 200) + grid.at(101, 201)) / 2.0F, 1e-5);
}

// Sizes that are odd at every level: a cell of an overview then covers a little less than two.
TEST(WriteDem, OverviewsOfOddSizesAreThoseOfGdal) {
    const TemporaryFolder folder;
    ElevationGrid grid = ramp(1023, 1101);
    for (std::size_t i = 0; i < grid.heights_m.size(); i += 11) grid.heights_m[i] = kNoHeight;
    write(grid, folder / "dem.tif");
    const Dataset dataset = open(folder / "dem.tif");
    const auto gdal = [&] {
        Dataset copy(GetGDALDriverManager()->GetDriverByName("MEM")->CreateCopy("", dataset.get(), FALSE,
                                                                                nullptr, nullptr, nullptr));
        std::array<int, 3> factors{2, 4, 8};
        EXPECT_EQ(copy->BuildOverviews("AVERAGE", 3, factors.data(), 0, nullptr, nullptr, nullptr), CE_None);
        return copy;
    }();
    for (int level = 0; level < 3; ++level) {
        GDALRasterBand* const ours = dataset->GetRasterBand(1)->GetOverview(level);
        GDALRasterBand* const theirs = gdal->GetRasterBand(1)->GetOverview(level);
        ASSERT_EQ(ours->GetXSize(), theirs->GetXSize());
        ASSERT_EQ(ours->GetYSize(), theirs->GetYSize());
        const auto cells = [](GDALRasterBand* band) {
            std::vector<float> all(static_cast<std::size_t>(band->GetXSize()) *
                                   static_cast<std::size_t>(band->GetYSize()));
            EXPECT_EQ(band->RasterIO(GF_Read, 0, 0, band->GetXSize(), band->GetYSize(), all.data(),
                                     band->GetXSize(), band->GetYSize(), GDT_Float32, 0, 0, nullptr),
                      CE_None);
            return all;
        };
        const auto a = cells(ours), b = cells(theirs);
        // GDAL may take a coarse level from the finest, where cells without a height weigh otherwise: the
        // ramp rises by 0.016 a cell.
        for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 0.005 * (1 << level)) << level;
    }
}

TEST(WriteDem, PacksTheSameCellsInOtherWays) {
    const TemporaryFolder folder;
    ElevationGrid grid = ramp(700, 600);
    grid.heights_m[5] = kNoHeight;
    DemDescription what = description();
    std::vector<float> expected;
    std::uintmax_t bare_bytes = 0;
    for (const auto& [compression, text] : kRasterCompressions) {
        for (const bool overviews : {true, false}) {
            what.storage = {compression, overviews};
            write(grid, folder / "dem.tif", what);
            const Dataset dataset = open(folder / "dem.tif");
            ASSERT_TRUE(dataset);
            const char* const packed = dataset->GetMetadataItem("COMPRESSION", "IMAGE_STRUCTURE");
            EXPECT_EQ(packed == nullptr ? "none" : CPLString(packed).tolower(), text);
            EXPECT_STREQ(dataset->GetMetadataItem("LAYOUT", "IMAGE_STRUCTURE"), "COG");
            EXPECT_EQ(dataset->GetRasterBand(1)->GetOverviewCount(), overviews ? 2 : 0);
            const std::vector<float> cells = cellsIn(*dataset);
            if (expected.empty()) expected = cells;
            EXPECT_EQ(cells, expected) << text;
            const auto bytes = std::filesystem::file_size(folder / "dem.tif");
            if (compression == RasterCompression::None && !overviews) bare_bytes = bytes;
        }
    }
    // 3 x 3 tiles of 256, and little else.
    EXPECT_GE(bare_bytes, 9u * 256u * 256u * 4u);
    EXPECT_LT(bare_bytes, 9u * 256u * 256u * 4u + 8192u);
}

TEST(WriteDem, StatisticsInTheFileAreThoseOfAllCellsWithHeights) {
    const TemporaryFolder folder;
    ElevationGrid grid = ramp(300, 200);
    for (std::size_t i = 0; i < grid.heights_m.size(); i += 7) grid.heights_m[i] = kNoHeight;
    write(grid, folder / "dem.tif");
    double n = 0.0;
    double sum = 0.0;
    double lowest = 1e9;
    double highest = -1e9;
    for (const float height : grid.heights_m) {
        if (std::isnan(height)) continue;
        n += 1.0;
        sum += double{height};
        lowest = std::min(lowest, double{height});
        highest = std::max(highest, double{height});
    }
    double squares = 0.0;
    for (const float height : grid.heights_m) {
        if (!std::isnan(height)) squares += std::pow(double{height} - sum / n, 2);
    }
    const Dataset dataset = open(folder / "dem.tif");
    const auto stored = [&](const char* item) {
        return CPLAtof(dataset->GetRasterBand(1)->GetMetadataItem(item));
    };
    EXPECT_NEAR(stored("STATISTICS_MINIMUM"), lowest, 1e-10);
    EXPECT_NEAR(stored("STATISTICS_MAXIMUM"), highest, 1e-10);
    EXPECT_NEAR(stored("STATISTICS_MEAN"), sum / n, 1e-10);
    EXPECT_NEAR(stored("STATISTICS_STDDEV"), std::sqrt(squares / n), 1e-10);
    EXPECT_EQ(dataset->GetRasterBand(1)->GetMetadataItem("STATISTICS_APPROXIMATE"), nullptr);
}

TEST(WriteDem, TheSameGridGivesTheSameBytesWithAnyNumberOfThreads) {
    const TemporaryFolder folder;
    const ElevationGrid grid = ramp(1500, 1300);
    const DemDescription what = description();
    tbb::task_arena one(1);
    one.execute([&] { write(grid, folder / "one.tif", what); });
    tbb::task_arena two(2);
    two.execute([&] { write(grid, folder / "two.tif", what); });
    write(grid, folder / "again.tif", what);
    EXPECT_TRUE(bytesOf(folder / "one.tif") == bytesOf(folder / "two.tif"));
    EXPECT_TRUE(bytesOf(folder / "one.tif") == bytesOf(folder / "again.tif"));
}

TEST(WriteDem, TinyGridsWork) {
    const TemporaryFolder folder;
    for (const auto& [columns, rows] : {std::pair{1, 1}, {3, 2}, {1, 700}, {513, 1}}) {
        const ElevationGrid grid = ramp(static_cast<std::size_t>(columns), static_cast<std::size_t>(rows));
        write(grid, folder / "dem.tif");
        EXPECT_EQ(cellsIn(*open(folder / "dem.tif")), grid.heights_m);
    }
}

TEST(WriteDem, HoldsTheLocalFrameAsEngineeringCrs) {
    const TemporaryFolder folder;
    write(ramp(3, 2), folder / "dem.tif", description(""));
    const Dataset dataset = open(folder / "dem.tif");
    const OGRSpatialReference* const crs = dataset->GetSpatialRef();
    ASSERT_NE(crs, nullptr);
    EXPECT_TRUE(crs->IsLocal());
    EXPECT_STREQ(crs->GetName(),
                 "Terrawalk local frame, zero point lat 23.182753000 lon 113.399795000 h 38.000");
    EXPECT_EQ(crs->GetLinearUnits(), 1.0);
}

TEST(WriteDem, HoldsNationalGrids) {
    const TemporaryFolder folder;
    const std::vector<std::pair<std::string, GeodeticPosition>> grids{
        {"EPSG:25833", {52.5, 13.4, 0.0}},
        {"EPSG:31468", {52.5, 12.4, 0.0}},
        {"EPSG:27700", {52.0, -1.0, 0.0}},
        {"EPSG:5514", {50.0, 15.0, 0.0}},
        {"EPSG:2326", {22.3, 114.1, 0.0}},
        {"EPSG:4547", {30.0, 114.0, 0.0}},
        {"EPSG:2154", {47.0, 3.0, 0.0}},
        {"EPSG:2056", {47.0, 8.0, 0.0}},
        {"EPSG:28992", {52.0, 5.0, 0.0}},
        {"EPSG:3857", {23.0, 113.0, 0.0}},
        {"EPSG:32755", {-35.0, 147.0, 0}},
        {"EPSG:2193", {-41.0, 173.0, 0.0}},
        {"+proj=tmerc +lat_0=23 +lon_0=113.4 +x_0=1000 +y_0=2000 +datum=WGS84 +type=crs",
         {23.0, 113.4, 0.0}}};
    for (const auto& [crs, zero] : grids) {
        const auto map = MapProjection::create(LocalFrame(zero), crs, "local");
        ASSERT_TRUE(map) << map.error().text();
        const auto written = writeDem(ramp(3, 2), {map->wkt2(), "local", "t", "s", {}}, folder / "dem.tif");
        EXPECT_TRUE(written) << crs << ": " << written.error().text();
    }
}

TEST(WriteDem, RemovesSideFilesThatWouldOutrankIt) {
    const TemporaryFolder folder;
    for (const char* side : {"dem.tif.aux.xml", "dem.tif.ovr", "dem.tif.msk", "dem.tfw"}) {
        writeBytes(folder / side, "stale");
    }
    write(ramp(3, 2), folder / "dem.tif");
    EXPECT_THAT(namesIn(folder.path()), ElementsAre("dem.tif"));
}

TEST(WriteDem, RemovesWhatAKilledRunLeftOfIt) {
    const TemporaryFolder folder;
    // No process has this number: it is above what Linux gives.
    const std::string left = ".dem.tif.partial-999999999-0", young = ".dem.tif.partial-999999999-1";
    const std::string own = fmt::format(".dem.tif.partial-{}-7", ::getpid()),
                      other = ".b.tif.partial-999999999-0";
    for (const std::string& name : {left, young, own, other}) {
        writeBytes(folder / name, "part");
        if (name == young) continue;
        std::filesystem::last_write_time(
            folder / name, std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
    }
    write(ramp(3, 2), folder / "dem.tif");
    EXPECT_THAT(namesIn(folder.path()), testing::UnorderedElementsAre("dem.tif", young, own, other));
}

TEST(WriteDem, RefusesGridsThatTheFileCannotHold) {
    const TemporaryFolder folder;
    const auto refusal = [&](const ElevationGrid& grid, const DemDescription& what = description()) {
        const auto written = writeDem(grid, what, folder / "dem.tif");
        EXPECT_TRUE(namesIn(folder.path()).empty());
        return written ? "written" : written.error().text();
    };
    ElevationGrid empty = ramp(3, 2);
    empty.heights_m.assign(6, kNoHeight);
    EXPECT_THAT(refusal(empty), HasSubstr("no cell of the DEM has a height"));
    EXPECT_THAT(refusal({}), HasSubstr("no cells"));
    ElevationGrid infinite = ramp(3, 2);
    infinite.heights_m[1] = std::numeric_limits<float>::infinity();
    EXPECT_THAT(refusal(infinite), HasSubstr("cannot hold the height inf"));
    ElevationGrid no_data = ramp(3, 2);
    no_data.heights_m[1] = -9999.0F;
    EXPECT_THAT(refusal(no_data), HasSubstr("-9999"));
    ElevationGrid short_of_cells = ramp(3, 2);
    short_of_cells.heights_m.pop_back();
    EXPECT_THAT(refusal(short_of_cells), HasSubstr("5 heights for 3 x 2"));
    DemDescription nowhere = description();
    nowhere.crs_wkt2.clear();
    EXPECT_THAT(refusal(ramp(3, 2), nowhere), HasSubstr("CRS"));
}

TEST(WriteDem, StopsWhenAskedAndLeavesNothing) {
    const TemporaryFolder folder;
    std::stop_source stop;
    stop.request_stop();
    const auto written = writeDem(ramp(600, 600), description(), folder / "dem.tif", stop.get_token());
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().kind, ErrorKind::Cancelled);
    EXPECT_TRUE(namesIn(folder.path()).empty());
}

TEST(WriteDem, AFullDiskIsAnErrorAndThePreviousDemStays) {
    const TemporaryFolder folder;
    write(ramp(3, 2), folder / "dem.tif");
    const std::string before = bytesOf(folder / "dem.tif");
    ElevationGrid rough = ramp(900, 900);
    for (std::size_t i = 0; i < rough.heights_m.size(); ++i) {
        rough.heights_m[i] += static_cast<float>((i * 2654435761U) % 100003U) * 1e-4F;
    }
    const DemDescription what = description();
    const auto written = [&] {
        const test::FileSizeLimit full_disk(200000);
        return writeDem(rough, what, folder / "dem.tif");
    }();
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().kind, ErrorKind::System);
    EXPECT_THAT(written.error().text(), HasSubstr("cannot write the DEM"));
    EXPECT_TRUE(bytesOf(folder / "dem.tif") == before);
    EXPECT_THAT(namesIn(folder.path()), ElementsAre("dem.tif"));
}

TEST(WriteDem, AMissingFolderIsASystemError) {
    const auto written = writeDem(ramp(3, 2), description(), "/nonexistent/folder/dem.tif");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().kind, ErrorKind::System);
}

}  // namespace
}  // namespace terrawalk
