#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogrsf_frmts.h>

#include <cstring>
#include <memory>

#include "io/read_points.hpp"
#include "io/write_products.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using test::TemporaryFolder;
using test::writeBytes;
using testing::HasSubstr;

Result<ScatteredPoints> read(const std::filesystem::path& file, const std::vector<int>& classes = {}) {
    SilentProgress progress;
    return readPoints(file, {classes}, progress, {});
}

Result<ScatteredPoints> readText(const std::string& text, const std::string& name = "points.csv") {
    const TemporaryFolder folder;
    writeBytes(folder / name, text);
    return read(folder / name);
}

TEST(PointTable, TakesColumnsByNameAndTheirUnitFromTheEnding) {
    const auto points =
        readText("id,z_ft,y_ft,x_ft,sigma_z_ft\n1,30.5,2,1,0.1\n# a remark\n\n2,31,4,3,0.2\n");
    ASSERT_TRUE(points) << points.error().text();
    ASSERT_EQ(points->points.size(), 2u);
    EXPECT_EQ(points->points[0], Eigen::Vector3d(1.0, 2.0, 30.5));
    EXPECT_EQ(points->points[1], Eigen::Vector3d(3.0, 4.0, 31.0));
    EXPECT_THAT(points->sigmas, testing::ElementsAre(0.1, 0.2));
    EXPECT_EQ(points->unit, lengthUnit("ft"));
}

TEST(PointTable, TakesTheFirstThreeColumnsWithoutHeaderAndSaysSo) {
    for (const std::string text : {"1 2 3 9\n4\t5  6 9\n", "1;2;3\n4;5;6\n", "1,2,3\r\n4,5,6"}) {
        const auto points = readText(text, "points.xyz");
        ASSERT_TRUE(points) << points.error().text();
        ASSERT_EQ(points->points.size(), 2u);
        EXPECT_EQ(points->points[1], Eigen::Vector3d(4.0, 5.0, 6.0));
        EXPECT_THAT(points->notes.front(), HasSubstr("header"));
    }
}

TEST(PointTable, TakesALineOfAnyFormForTheSamePoint) {
    // Short decimals have a way of their own; blanks, quotation marks, exponents and long numbers another.
    const Eigen::Vector3d point(745610.1234, -2565710.5, 38.0625);
    for (const std::string line : {"7,745610.1234,a,-2565710.5,38.0625,0.25,rest",
                                   " 7 , 745610.1234 , a , -2565710.5 , 38.0625 , 0.25",
                                   "7,\"745610.1234\",a,\"-2565710.5\",38.0625,0.25", "#7,745610.1234",
                                   " #7,745610.1234,a,1,2,3", "7,7.456101234e5,a,-2565710.5,+38.0625,0.25,,,",
                                   ",745610.12340000000000000000,,-2565710.5,38.0625,.25",
                                   "7,745610.1234,a,-2565710.5,38.0625,0.25"}) {
        for (const std::string end : {"\n", "\r\n", "\r", ""}) {
            const auto points =
                readText("id,x,remark,y,z,sigma_z\n7,1,,2,3,4" + std::string("\n") + line + end);
            ASSERT_TRUE(points) << line << points.error().text();
            ASSERT_EQ(points->points.size(), line.find('#') < 2 ? 1U : 2U) << line;
            if (line.find('#') < 2) continue;
            EXPECT_EQ(points->points[1], point) << line;
            EXPECT_EQ(points->sigmas[1], 0.25) << line;
        }
    }
    for (const std::string line : {"7,1,a,2", "7,1,a,2,3", "7,1,a,2,3,", "7,1,a,2,3,-1", "7,1.2.3,a,2,3,1",
                                   "7,1x,a,2,3,1", "7,1,a,2,-,1"}) {
        const auto points = readText("id,x,remark,y,z,sigma_z\n7,1,,2,3,4\n" + line + "\n7,1,,2,3,4\n");
        ASSERT_FALSE(points) << line;
        EXPECT_THAT(points.error().text(), HasSubstr("points.csv:3")) << line;
    }
}

// As `process` writes ground_points.csv: what is no ground has 0 there, and perhaps no place.
TEST(PointTable, LeavesOutWhatIsMarkedAsNotUsed) {
    const auto points = readText(
        "run,e_m,n_m,u_m,used,reason\nS01,1,2,3,1,\nS01,,,,0,no range\nS01,4,5,-60,0,range too long\n"
        "S01,7,8,9,1,\n");
    ASSERT_TRUE(points) << points.error().text();
    ASSERT_EQ(points->points.size(), 2U);
    EXPECT_EQ(points->points[1], Eigen::Vector3d(7, 8, 9));
    EXPECT_EQ(points->in_file, 4U);
    ASSERT_EQ(points->notes.size(), 1U);
    EXPECT_THAT(points->notes[0], HasSubstr("2 of 4 points are marked as not used"));
    // A place that is missing is still an error where the point counts.
    EXPECT_FALSE(readText("e_m,n_m,u_m,used\n1,2,,1\n"));
}

TEST(PointTable, TakesTablesAsOthersWriteThem) {
    const Eigen::Vector3d point(500000.5, 2500000.25, 12.5);
    for (const std::string& table :
         {std::string("x [m];y [m];z [m]\r\n500000.5;2500000.25;12.5\r\n"),
          std::string("北坐标,东坐标,高程\n2500000.25,500000.5,12.5\n"),
          std::string("id\tE (m)\tN (m)\tHeight (m)\n7\t500000.5\t2500000.25\t12.5\n"),
          std::string("x,y,z\n500000.5,2500000.25,12.5,\n"),
          std::string("点号,X,Y,H\n7,2500000.25,500000.5,12.5\n"),
          std::string("点号\tX坐标(m)\tY坐标(m)\t高程（米）\n7\t2500000.25\t500000.5\t12.5\n"),
          std::string("点号,X/m,Y/m,标高/m\n7,2500000.25,500000.5,12.5\n"),
          std::string("x;y;z\n500000,5;2500000,25;12,5\n"), std::string("500000,5\t2500000,25\t12,5\n")}) {
        const auto points = readText(table);
        ASSERT_TRUE(points) << table << points.error().text();
        ASSERT_EQ(points->points.size(), 1U);
        EXPECT_EQ(points->points[0], point) << table;
    }
    // Never a wrong height in silence.
    for (const std::string& table :
         {std::string("x,y,z\n500000,5,2500000,25,12,5\n"), std::string("500000,5 2500000,25 12,5\n"),
          std::string("x,y,z\n500,000.5,2,500,000.25,12.5\n"),
          std::string("x,y,z,code\n500000,5,2500000,25,12,5,edge\n"),
          std::string("x,y,z,code\n1,2,3,edge\n500000,5,2500000,25,12,5,edge\n")}) {
        const auto points = readText(table);
        ASSERT_FALSE(points) << table;
        EXPECT_THAT(points.error().text(), HasSubstr("a dot as decimal sign")) << table;
    }
    EXPECT_THAT(readText("1,2500000.25,500000.5,12.5,edge\n").error().text(), HasSubstr("number of a point"));
    EXPECT_THAT(readText("500000,5,2500000,25,12,5\n").error().text(), HasSubstr("comma as decimal sign"));
    EXPECT_TRUE(readText("1 2 3 255 255 255\n")) << "colours after whole numbers";
}

TEST(PointTable, TakesTheCommaForTheDecimalSignWhereNothingElseFits) {
    // 12,500 alone could be twelve thousand; one number among them that could not decides for all.
    const auto points = readText("x;y;z\n100;2,500;12,500\n101;3,500;0,125\n");
    ASSERT_TRUE(points) << points.error().text();
    EXPECT_EQ(points->points[0], Eigen::Vector3d(100.0, 2.5, 12.5));
    EXPECT_EQ(points->points[1], Eigen::Vector3d(101.0, 3.5, 0.125));
    EXPECT_THAT(points->notes, testing::ElementsAre(HasSubstr("comma as decimal sign")));

    const auto refusal = [](const std::string& table) {
        return readText(table).error().text();
    };
    EXPECT_THAT(refusal("x;y;z\n1;2;3\n1,234;5,678;12,500\n"), HasSubstr(":3: the commas in all numbers"));
    EXPECT_THAT(refusal("x;y;z\n1,234;5,678;12.5\n"),
                HasSubstr(":2: some numbers have a comma and some a dot"));
    EXPECT_THAT(refusal("x;y;z\n1.5;2;3\n4;5;6,25\n"), HasSubstr(":3: some numbers have a comma"));
    EXPECT_THAT(refusal("x;y;z\n4;5;6,25\n1.5;2;3\n"), HasSubstr(":3: some numbers have a comma"));
    for (const std::string field : {"1.234,5", "1,234.5", "1 234,5", "1'234.5", "1,234,567"}) {
        EXPECT_THAT(refusal("x;y;z\n1;2;" + field + "\n"),
                    testing::AllOf(HasSubstr(":2: \"" + field + "\" in column 3 is no number"),
                                   HasSubstr("nothing between thousands")));
    }
}

TEST(PointTable, TakesXForNorthUnderAChineseHeaderAndSaysSo) {
    const auto points = readText("点号,X,Y,H,备注\n1,30.5,20.25,3,a\n");
    ASSERT_TRUE(points) << points.error().text();
    EXPECT_EQ(points->points[0], Eigen::Vector3d(20.25, 30.5, 3.0));
    EXPECT_THAT(points->notes, testing::ElementsAre(HasSubstr("X is taken for north")));
    EXPECT_EQ(readText("id,X,Y,H\n1,30.5,20.25,3\n")->points[0], Eigen::Vector3d(30.5, 20.25, 3.0));
    EXPECT_EQ(readText("点号,E,N,高程\n1,30.5,20.25,3\n")->points[0], Eigen::Vector3d(30.5, 20.25, 3.0));
    // A table with the axes of mathematics, and one of another encoding.
    EXPECT_THAT(readText("点号,X,Y,H\n1,500000.5,2500000.25,3\n").error().text(), HasSubstr("X is east"));
    EXPECT_THAT(readText("\xB5\xE3\xBA\xC5,X,Y,H\n1,30.5,20.25,3\n").error().text(), HasSubstr("UTF-8"));
}

TEST(PointTable, NamesTheLineOfWhatIsWrong) {
    EXPECT_THAT(readText("x,y,z\n1,2,3\n1,2\n").error().text(), HasSubstr("points.csv:3"));
    EXPECT_THAT(readText("x,y,z\n1,2,three\n").error().text(),
                HasSubstr(":2: \"three\" in column 3 is no number"));
    EXPECT_THAT(readText("a,b,z\n1,2,3\n").error().text(), HasSubstr("no x, y and z"));
    EXPECT_THAT(readText("lat,lon,z\n1,2,3\n").error().text(), HasSubstr("degrees; project them"));
    EXPECT_THAT(readText("x_m,y_ft,z_m\n1,2,3\n").error().text(), HasSubstr("different units"));
    EXPECT_THAT(readText("x,e,y,z\n1,2,3,4\n").error().text(), HasSubstr("both"));
    EXPECT_THAT(readText("x,y,z\n").error().text(), HasSubstr("no point"));
    EXPECT_FALSE(readText(""));
    EXPECT_THAT(read("/nowhere/points.csv").error().text(), HasSubstr("no such file"));
}

struct LasPoint {
    std::int32_t x, y, z;
    std::uint8_t classification;
    bool withheld = false;
};

template <class T>
void put(std::string& bytes, std::size_t offset, T value) {
    std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

/// A LAS file by the tables of the specification: scale 0.01, offset (1000, 2000, 0).
std::string lasFile(int minor, int format, const std::vector<LasPoint>& points, const std::string& wkt = {}) {
    const std::size_t header_bytes = minor == 4 ? 375 : 227;
    const std::size_t record_bytes = format == 6 ? 30 : format == 3 ? 34 : 20;
    std::string bytes(header_bytes, '\0');
    std::memcpy(bytes.data(), "LASF", 4);
    bytes[24] = 1;
    bytes[25] = static_cast<char>(minor);
    put(bytes, 94, static_cast<std::uint16_t>(header_bytes));
    put(bytes, 104, static_cast<std::uint8_t>(format));
    put(bytes, 105, static_cast<std::uint16_t>(record_bytes));
    if (minor == 4) put(bytes, 247, static_cast<std::uint64_t>(points.size()));
    if (minor < 4) put(bytes, 107, static_cast<std::uint32_t>(points.size()));
    for (std::size_t axis = 0; axis < 3; ++axis) put(bytes, 131 + 8 * axis, 0.01);
    put(bytes, 155, 1000.0);
    put(bytes, 163, 2000.0);
    if (!wkt.empty()) {
        std::string record(54, '\0');
        std::memcpy(record.data() + 2, "LASF_Projection", 15);
        put(record, 18, std::uint16_t{2112});
        put(record, 20, static_cast<std::uint16_t>(wkt.size() + 1));
        bytes += record + wkt + '\0';
        put(bytes, 100, std::uint32_t{1});
    }
    put(bytes, 96, static_cast<std::uint32_t>(bytes.size()));
    for (const LasPoint& point : points) {
        std::string record(record_bytes, '\0');
        put(record, 0, point.x);
        put(record, 4, point.y);
        put(record, 8, point.z);
        if (format >= 6) {
            record[15] = point.withheld ? 0x04 : 0;
            record[16] = static_cast<char>(point.classification);
        } else {
            record[15] = static_cast<char>(point.classification | (point.withheld ? 0x80 : 0));
        }
        bytes += record;
    }
    return bytes;
}

TEST(Las, ReadsGroundPointsOfEachVersionAndFormat) {
    const std::vector<LasPoint> points{
        {100, 200, 300, 2}, {0, 0, 9900, 5}, {400, 500, -600, 2}, {1, 1, 1, 2, true}, {2, 2, 2, 7}};
    for (const auto& [minor, format] : {std::pair{2, 0}, std::pair{3, 3}, std::pair{4, 6}}) {
        const TemporaryFolder folder;
        writeBytes(folder / "p.las", lasFile(minor, format, points, "LOCAL_CS[\"x\"]"));
        const auto ground = read(folder / "p.las");
        ASSERT_TRUE(ground) << ground.error().text();
        ASSERT_EQ(ground->points.size(), 2u) << minor;
        EXPECT_NEAR((ground->points[0] - Eigen::Vector3d(1001.0, 2002.0, 3.0)).norm(), 0.0, 1e-9);
        EXPECT_NEAR((ground->points[1] - Eigen::Vector3d(1004.0, 2005.0, -6.0)).norm(), 0.0, 1e-9);
        EXPECT_EQ(ground->in_file, 5u);
        EXPECT_EQ(ground->crs, "LOCAL_CS[\"x\"]");
        EXPECT_EQ(ground->notes.size(), 2u);
        EXPECT_EQ(read(folder / "p.las", {5})->points.size(), 1u);
        EXPECT_EQ(read(folder / "p.las", {2, 5, 7})->points.size(), 4u);
    }
}

TEST(Las, TakesAllButNoiseWhereNothingIsGround) {
    const TemporaryFolder folder;
    writeBytes(folder / "p.las", lasFile(2, 0, {{1, 1, 1, 1}, {2, 2, 2, 7}, {3, 3, 3, 0}}));
    EXPECT_EQ(read(folder / "p.las")->points.size(), 2u);
}

// Every shorter file and every flipped header byte: an error or points, never a crash or a huge allocation.
TEST(Las, SurvivesDamage) {
    const TemporaryFolder folder;
    const std::string whole = lasFile(4, 6, {{1, 1, 1, 2}, {2, 2, 2, 2}}, "LOCAL_CS[\"x\"]");
    for (std::size_t length = 0; length < whole.size(); length += 3) {
        writeBytes(folder / "p.las", whole.substr(0, length));
        EXPECT_FALSE(read(folder / "p.las")) << length;
    }
    for (std::size_t at = 0; at < 375; ++at) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0xFF);
        writeBytes(folder / "p.las", damaged);
        const auto points = read(folder / "p.las");
        if (points) {
            EXPECT_LE(points->points.size(), 2u) << at;
        }
    }
    std::string compressed = whole;
    compressed[104] = static_cast<char>(6 | 0x80);
    writeBytes(folder / "p.laz", compressed);
    EXPECT_THAT(read(folder / "p.laz").error().text(), HasSubstr("decompress"));
}

TEST(Ply, ReadsTextAndBothByteOrders) {
    const std::string header =
        "element vertex 2\nproperty double x\nproperty uchar red\nproperty double y\n"
        "property float z\nelement face 0\nproperty list uchar int vertex_indices\n"
        "end_header\n";
    std::string little = "ply\nformat binary_little_endian 1.0\n" + header;
    std::string big = "ply\nformat binary_big_endian 1.0\n" + header;
    for (const auto& [x, y, z] : {std::tuple{745000.125, 2565000.25, 38.5F}, std::tuple{1.0, 2.0, 3.0F}}) {
        const auto append = [](std::string& bytes, auto value, bool swap) {
            std::string raw(sizeof(value), '\0');
            std::memcpy(raw.data(), &value, sizeof(value));
            bytes += swap ? std::string(raw.rbegin(), raw.rend()) : raw;
        };
        for (const bool swap : {false, true}) {
            std::string& bytes = swap ? big : little;
            append(bytes, x, swap);
            bytes += '\x7F';
            append(bytes, y, swap);
            append(bytes, z, swap);
        }
    }
    const std::string text =
        "ply\nformat ascii 1.0\n" + header + "745000.125 127 2565000.25 38.5\n1 127 2 3\n";
    for (const std::string& bytes : {text, little, big}) {
        const auto points = readText(bytes, "p.ply");
        ASSERT_TRUE(points) << points.error().text();
        ASSERT_EQ(points->points.size(), 2u);
        EXPECT_EQ(points->points[0], Eigen::Vector3d(745000.125, 2565000.25, 38.5));
        EXPECT_EQ(points->points[1], Eigen::Vector3d(1.0, 2.0, 3.0));
        for (std::size_t length = 0; length + 2 < bytes.size(); length += 5) {
            EXPECT_FALSE(readText(bytes.substr(0, length), "p.ply")) << length;
        }
    }
}

TEST(Ply, ReadsOurOwnMeshBackAtItsPlace) {
    const TemporaryFolder folder;
    const TriangleMesh mesh{
        {{745000.25, 2565000.5, 38.0}, {745010.0, 2565000.0, 39.0}, {745000.0, 2565010.0, 40.0}},
        {{0, 1, 2}}};
    ASSERT_TRUE(writePly(mesh, "none", folder / "s.ply"));
    const auto points = read(folder / "s.ply");
    ASSERT_TRUE(points) << points.error().text();
    ASSERT_EQ(points->points.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT((points->points[i] - mesh.vertices_m[i]).norm(), 1e-3);
    }
    EXPECT_EQ(points->unit, lengthUnit("m"));
}

void writeGeoPackage(const std::filesystem::path& file, bool three_d) {
    GDALAllRegister();
    std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> dataset(
        GetGDALDriverManager()->GetDriverByName("GPKG")->Create(file.c_str(), 0, 0, 0, GDT_Unknown, nullptr),
        [](GDALDataset* d) { GDALClose(d); });
    OGRSpatialReference crs;
    crs.importFromEPSG(2994);
    OGRLayer* const layer = dataset->CreateLayer("ground", &crs, three_d ? wkbPoint25D : wkbPoint, nullptr);
    OGRFieldDefn field("elevation", OFTReal);
    ASSERT_EQ(layer->CreateField(&field), OGRERR_NONE);
    for (int i = 0; i < 3; ++i) {
        const OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(layer->GetLayerDefn()));
        feature->SetField("elevation", 100.0 + i);
        OGRPoint point(1.0 * i, 2.0 * i, 5.0 * i);
        if (!three_d) point.flattenTo2D();
        ASSERT_EQ(feature->SetGeometry(&point), OGRERR_NONE);
        ASSERT_EQ(layer->CreateFeature(feature.get()), OGRERR_NONE);
    }
}

TEST(GeoPackage, TakesHeightsFromTheGeometryElseFromAField) {
    const TemporaryFolder folder;
    writeGeoPackage(folder / "flat.gpkg", false);
    writeGeoPackage(folder / "high.gpkg", true);
    const auto flat = read(folder / "flat.gpkg");
    const auto high = read(folder / "high.gpkg");
    ASSERT_TRUE(flat) << flat.error().text();
    ASSERT_TRUE(high) << high.error().text();
    EXPECT_EQ(flat->points.at(2), Eigen::Vector3d(2.0, 4.0, 102.0));
    EXPECT_EQ(high->points.at(2), Eigen::Vector3d(2.0, 4.0, 10.0));
    const auto crs = describeCrs(high->crs);
    ASSERT_TRUE(crs) << crs.error().text();
    EXPECT_EQ(crs->unit, lengthUnit("ft"));
}

TEST(CoordinateSystem, KnowsUnitsAndRefusesWhatIsNoPlane) {
    EXPECT_EQ(describeCrs("EPSG:32649")->unit, lengthUnit("m"));
    EXPECT_EQ(describeCrs("EPSG:2994")->unit, lengthUnit("ft"));
    EXPECT_EQ(describeCrs("EPSG:2229")->unit, lengthUnit("us-ft"));
    EXPECT_EQ(describeCrs("EPSG:32649+5773")->vertical_datum, "EGM96 height");
    EXPECT_THAT(describeCrs("EPSG:4326").error().text(), HasSubstr("project the points"));
    EXPECT_THAT(describeCrs("EPSG:2994+5773").error().text(), HasSubstr("heights are in m"));
    EXPECT_FALSE(describeCrs("EPSG:99999999"));
    EXPECT_FALSE(describeCrs(""));
}

}  // namespace
}  // namespace terrawalk
