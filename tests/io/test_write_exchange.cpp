#include <cpl_minixml.h>
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "io/map_projection.hpp"
#include "io/read_ground_points.hpp"
#include "io/read_mesh.hpp"
#include "io/read_points.hpp"
#include "io/write_exchange.hpp"
#include "io/write_products.hpp"
#include "tests/support/exchange_example.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using test::bytesOf;
using test::originIn;
using test::somePoints;
using test::TemporaryFolder;
using test::terraces;
using test::writeBytes;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kTenthMillimetre = 0.5e-4 + 1e-8;  // half a step of the text, and rounding of doubles

template <class T>
T numberAt(const std::string& bytes, std::size_t offset) {
    T value{};
    EXPECT_LE(offset + sizeof value, bytes.size());
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

ExchangeDescription description() {
    const auto projection =
        MapProjection::create(LocalFrame({23.182753, 113.399795, 38.0}), "EPSG:32649", "local");
    EXPECT_TRUE(projection);
    return {projection->wkt2(), projection->name(), "North <terrace> & \"more\"", "Terrawalk test",
            "2024-05-17"};
}

TEST(WriteStl, HoldsEveryTriangleWithItsNormal) {
    const TemporaryFolder folder;
    const TriangleMesh mesh = terraces();
    ASSERT_TRUE(writeStl(mesh, folder / "s.stl"));
    const std::string bytes = bytesOf(folder / "s.stl");
    EXPECT_THAT(bytes, ::testing::Not(StartsWith("solid")));
    ASSERT_EQ(numberAt<std::uint32_t>(bytes, 80), mesh.triangles.size());
    ASSERT_EQ(bytes.size(), 84 + 50 * mesh.triangles.size());
    const Eigen::Vector3d origin = originIn(bytes.substr(0, 80));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto vector = [&](std::size_t k) {
            Eigen::Vector3d v;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                v[static_cast<int>(axis)] = numberAt<float>(bytes, 84 + 50 * i + 12 * k + 4 * axis);
            }
            return v;
        };
        for (std::size_t k = 0; k < 3; ++k) {
            // Within 64 m of the origin a float steps by at most 2^-18 m.
            EXPECT_LT((vector(k + 1) + origin - mesh.vertices_m[mesh.triangles[i][k]]).norm(), 1e-5);
        }
        EXPECT_NEAR(vector(0).norm(), 1.0, 1e-6);
        EXPECT_GT(vector(0).z(), 0.0);
        EXPECT_NEAR(vector(0).dot(vector(2) - vector(1)), 0.0, 1e-4);
        EXPECT_EQ(numberAt<std::uint16_t>(bytes, 84 + 50 * i + 48), 0);
    }
}

TEST(WriteDxf, GdalReadsEveryFace) {
    const TemporaryFolder folder;
    const TriangleMesh mesh = terraces();
    ASSERT_TRUE(writeDxfFaces(mesh, folder / "s.dxf"));
    GDALAllRegister();
    CPLPushErrorHandler(CPLQuietErrorHandler);  // OGR warns of rings that 3DFACE never closes
    const GDALDatasetUniquePtr dataset(GDALDataset::Open((folder / "s.dxf").c_str(), GDAL_OF_VECTOR));
    ASSERT_NE(dataset, nullptr);
    std::size_t i = 0;
    for (const auto& feature : dataset->GetLayer(0)) {
        ASSERT_LT(i, mesh.triangles.size());
        EXPECT_STREQ(feature->GetFieldAsString("Layer"), "surface");
        const OGRGeometry* const geometry = feature->GetGeometryRef();
        ASSERT_NE(geometry, nullptr);
        ASSERT_EQ(wkbFlatten(geometry->getGeometryType()), wkbPolygon);
        const OGRLinearRing& ring = *geometry->toPolygon()->getExteriorRing();
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d read(ring.getX(k), ring.getY(k), ring.getZ(k));
            const Eigen::Vector3d& vertex = mesh.vertices_m[mesh.triangles[i][static_cast<std::size_t>(k)]];
            EXPECT_LT((read - vertex).cwiseAbs().maxCoeff(), kTenthMillimetre);
        }
        ++i;
    }
    CPLPopErrorHandler();
    EXPECT_EQ(i, mesh.triangles.size());
}

TEST(WriteLandXml, SaysThatItsDateStandsForNone) {
    const TemporaryFolder folder;
    ExchangeDescription unknown = description();
    unknown.date.clear();
    ASSERT_TRUE(writeLandXml(terraces(), unknown, folder / "s.xml"));
    CPLXMLTreeCloser tree(CPLParseXMLFile((folder / "s.xml").c_str()));
    ASSERT_NE(tree.get(), nullptr);
    EXPECT_THAT(CPLGetXMLValue(tree.get(), "=LandXML.Application.desc", ""), testing::HasSubstr("not known"));
}

TEST(WriteLandXml, AnXmlReaderFindsPointsAndFaces) {
    const TemporaryFolder folder;
    const TriangleMesh mesh = terraces();
    ASSERT_TRUE(writeLandXml(mesh, description(), folder / "s.xml"));
    CPLXMLTreeCloser tree(CPLParseXMLFile((folder / "s.xml").c_str()));
    ASSERT_NE(tree.get(), nullptr);
    const CPLXMLNode* const root = CPLGetXMLNode(tree.get(), "=LandXML");
    ASSERT_NE(root, nullptr);
    EXPECT_STREQ(CPLGetXMLValue(root, "xmlns", ""), "http://www.landxml.org/schema/LandXML-1.2");
    EXPECT_STREQ(CPLGetXMLValue(root, "date", ""), "2024-05-17");
    EXPECT_STREQ(CPLGetXMLValue(root, "Application.desc", "none"), "none");
    EXPECT_STREQ(CPLGetXMLValue(root, "Units.Metric.linearUnit", ""), "meter");
    EXPECT_EQ(CPLGetXMLValue(root, "Surfaces.Surface.name", ""), description().title);
    OGRSpatialReference crs;
    EXPECT_EQ(crs.importFromWkt(CPLGetXMLValue(root, "CoordinateSystem.ogcWktCode", "")), OGRERR_NONE);
    const auto childrenOf = [&](const char* path, const char* name, const auto& take) {
        const CPLXMLNode* const parent = CPLGetXMLNode(root, path);
        ASSERT_NE(parent, nullptr) << path;
        std::size_t count = 0;
        for (const CPLXMLNode* child = parent->psChild; child != nullptr; child = child->psNext) {
            if (child->eType != CXT_Element) continue;
            ASSERT_STREQ(child->pszValue, name);
            std::istringstream text(CPLGetXMLValue(child, "", ""));
            take(count++, text, child);
        }
    };
    std::size_t points = 0, faces = 0;
    childrenOf("Surfaces.Surface.Definition.Pnts", "P",
               [&](std::size_t i, std::istringstream& text, const CPLXMLNode* node) {
                   double north = 0, east = 0, up = 0;
                   text >> north >> east >> up;
                   EXPECT_LT((Eigen::Vector3d(east, north, up) - mesh.vertices_m.at(i)).cwiseAbs().maxCoeff(),
                             kTenthMillimetre);
                   EXPECT_EQ(CPLGetXMLValue(node, "id", ""), std::to_string(i + 1));
                   ++points;
               });
    childrenOf("Surfaces.Surface.Definition.Faces", "F",
               [&](std::size_t i, std::istringstream& text, const CPLXMLNode*) {
                   std::array<std::uint32_t, 3> corners{};
                   text >> corners[0] >> corners[1] >> corners[2];
                   for (std::uint32_t& corner : corners) --corner;
                   EXPECT_EQ(corners, mesh.triangles.at(i));
                   ++faces;
               });
    EXPECT_EQ(points, mesh.vertices_m.size());
    EXPECT_EQ(faces, mesh.triangles.size());
}

TEST(ReadMeshPly, ReadsWhatWasWrittenAndRefusesDamage) {
    const TemporaryFolder folder;
    const TriangleMesh mesh = terraces();
    ASSERT_TRUE(writePly(mesh, "EPSG:32649", folder / "s.ply"));
    SilentProgress silent;
    const auto read = readMeshPly(folder / "s.ply", silent, {});
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->triangles, mesh.triangles);
    for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
        EXPECT_LT((read->vertices_m[i] - mesh.vertices_m[i]).norm(), 1e-5);
    }
    std::string bytes = bytesOf(folder / "s.ply");
    writeBytes(folder / "cut.ply", bytes.substr(0, bytes.size() - 3));
    EXPECT_FALSE(readMeshPly(folder / "cut.ply", silent, {}));
    bytes[bytes.size() - 13] = 4;
    writeBytes(folder / "quad.ply", bytes);
    const auto quad = readMeshPly(folder / "quad.ply", silent, {});
    ASSERT_FALSE(quad);
    EXPECT_THAT(quad.error().text(), HasSubstr("no triangle"));
    bytes[bytes.size() - 13] = 3;
    bytes[bytes.size() - 1] = 0x7F;
    writeBytes(folder / "beyond.ply", bytes);
    EXPECT_THAT(readMeshPly(folder / "beyond.ply", silent, {}).error().text(), HasSubstr("names no vertex"));
    writeBytes(
        folder / "points.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "end_header\n1 2 3\n");
    EXPECT_FALSE(readMeshPly(folder / "points.ply", silent, {}));
}

TEST(WriteLas, HasNoDayWhereTheSurveyHasNone) {
    const TemporaryFolder folder;
    for (const std::string date : {"", "2023-02-29"}) {
        ExchangeDescription undated = description();
        undated.date = date;
        ASSERT_TRUE(writeLas(somePoints(), undated, folder / "p.las"));
        EXPECT_EQ(numberAt<std::uint32_t>(bytesOf(folder / "p.las"), 90), 0U) << date;
    }
}

// ASPRS LAS 1.4 R15: the offsets below are those of its tables, not those of the writer.
TEST(WriteLas, FollowsTheSpecificationByteByByte) {
    const TemporaryFolder folder;
    const MapPoints points = somePoints();
    ASSERT_TRUE(writeLas(points, description(), folder / "p.las"));
    const std::string las = bytesOf(folder / "p.las");
    EXPECT_EQ(las.substr(0, 4), "LASF");
    EXPECT_EQ(las[24], 1);
    EXPECT_EQ(las[25], 4);
    EXPECT_EQ(numberAt<std::uint16_t>(las, 6) & 16, 16) << "CRS is WKT";
    EXPECT_EQ(numberAt<std::uint16_t>(las, 90), 138) << "day of a leap year";
    EXPECT_EQ(numberAt<std::uint16_t>(las, 92), 2024);
    EXPECT_EQ(numberAt<std::uint16_t>(las, 94), 375);
    const auto data = numberAt<std::uint32_t>(las, 96);
    EXPECT_EQ(las[104], 6);
    const auto record = numberAt<std::uint16_t>(las, 105);
    EXPECT_EQ(record, 42);
    EXPECT_EQ(numberAt<std::uint32_t>(las, 107), 0U) << "legacy count";
    EXPECT_EQ(numberAt<std::uint64_t>(las, 247), points.points.size());
    EXPECT_EQ(numberAt<std::uint64_t>(las, 255), points.points.size());
    ASSERT_EQ(las.size(), data + record * points.points.size());

    // Variable length records.
    std::size_t at = 375;
    std::string wkt, extra;
    for (std::uint32_t i = 0; i < numberAt<std::uint32_t>(las, 100); ++i) {
        const std::string user = las.substr(at + 2, 16).c_str();
        const auto id = numberAt<std::uint16_t>(las, at + 18);
        const auto length = numberAt<std::uint16_t>(las, at + 20);
        if (user == "LASF_Projection" && id == 2112) wkt = las.substr(at + 54, length);
        if (user == "LASF_Spec" && id == 4) extra = las.substr(at + 54, length);
        at += 54U + length;
    }
    EXPECT_EQ(at, data);
    EXPECT_EQ(wkt.back(), '\0');
    OGRSpatialReference crs;
    ASSERT_EQ(crs.importFromWkt(wkt.c_str()), OGRERR_NONE);
    EXPECT_STREQ(crs.GetAuthorityCode(nullptr), "32649");
    ASSERT_EQ(extra.size(), 2U * 192);
    EXPECT_EQ(extra[2], 10);
    EXPECT_STREQ(extra.c_str() + 4, "time_s");
    EXPECT_EQ(extra[192 + 2], 9);
    EXPECT_STREQ(extra.c_str() + 192 + 4, "sigma_z_m");

    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = -low;
    for (std::size_t i = 0; i < points.points.size(); ++i) {
        const std::size_t p = data + record * i;
        const MapPoint& point = points.points[i];
        const bool used = point.state == GroundPointState::Used;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double value =
                numberAt<std::int32_t>(las, p + 4 * axis) * numberAt<double>(las, 131 + 8 * axis) +
                numberAt<double>(las, 155 + 8 * axis);
            EXPECT_NEAR(value, point.map_m[static_cast<int>(axis)], kTenthMillimetre);
        }
        EXPECT_EQ(las[p + 14], 0x11);
        EXPECT_EQ(las[p + 15], used ? 0 : 4);
        EXPECT_EQ(las[p + 16], used ? 2 : 1);
        EXPECT_EQ(numberAt<std::uint16_t>(las, p + 20), point.run + 1);
        EXPECT_EQ(numberAt<double>(las, p + 30), point.time_s);
        EXPECT_EQ(numberAt<float>(las, p + 38), static_cast<float>(point.sigma_u_m));
        low = low.cwiseMin(point.map_m);
        high = high.cwiseMax(point.map_m);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(numberAt<double>(las, 179 + 16 * axis), high[static_cast<int>(axis)]);
        EXPECT_EQ(numberAt<double>(las, 187 + 16 * axis), low[static_cast<int>(axis)]);
    }
}

TEST(WriteLas, RefusesWhatItCannotHold) {
    const TemporaryFolder folder;
    MapPoints far = somePoints();
    far.points[3].map_m.x() += 1e6;
    const auto refused = writeLas(far, description(), folder / "p.las");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().text(), HasSubstr("farther than LAS can hold"));
    EXPECT_FALSE(writeLas({}, description(), folder / "p.las"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WritePoints, PlyIsReadBackAtItsPlace) {
    const TemporaryFolder folder;
    const MapPoints points = somePoints();
    ASSERT_TRUE(writePointsPly(points, description(), folder / "p.ply"));
    SilentProgress silent;
    const auto read = readPoints(folder / "p.ply", {}, silent, {});
    ASSERT_TRUE(read);
    // What is marked as not used is no ground.
    EXPECT_EQ(read->in_file, points.points.size());
    std::size_t next = 0;
    for (const MapPoint& point : points.points) {
        if (point.state != GroundPointState::Used) continue;
        ASSERT_LT(next, read->points.size());
        EXPECT_LT((read->points[next++] - point.map_m).norm(), 3e-5);
    }
    EXPECT_EQ(next, read->points.size());
    EXPECT_LT(next, points.points.size());
}

// The PCD 0.7 header says where each number lies; it is read here by that alone.
TEST(WritePoints, PcdFollowsItsOwnHeader) {
    const TemporaryFolder folder;
    const MapPoints points = somePoints();
    ASSERT_TRUE(writePcd(points, description(), folder / "p.pcd"));
    const std::string bytes = bytesOf(folder / "p.pcd");
    std::istringstream header(bytes);
    std::map<std::string, std::vector<std::string>> entries;
    for (std::string line; std::getline(header, line) && !entries.contains("DATA");) {
        std::istringstream words(line);
        std::string key, word;
        words >> key;
        while (key != "#" && words >> word) entries[key].push_back(word);
        if (key == "DATA") break;
    }
    EXPECT_EQ(entries["DATA"], std::vector<std::string>{"binary"});
    EXPECT_EQ(entries["POINTS"].at(0), std::to_string(points.points.size()));
    std::size_t record = 0;
    for (const std::string& size : entries["SIZE"]) record += std::stoul(size);
    const auto data = static_cast<std::size_t>(header.tellg());
    ASSERT_EQ(bytes.size(), data + record * points.points.size());
    const Eigen::Vector3d origin = originIn(bytes.substr(0, data));
    for (std::size_t i = 0; i < points.points.size(); ++i) {
        Eigen::Vector3d place = origin;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            place[static_cast<int>(axis)] += numberAt<float>(bytes, data + record * i + 4 * axis);
        }
        EXPECT_LT((place - points.points[i].map_m).norm(), 3e-5);
        EXPECT_EQ(bytes[data + record * i + 16], i % 5 == 0 ? 0 : 1);
    }
}

TEST(WritePoints, GdalReadsGeoPackageAndCsv) {
    const TemporaryFolder folder;
    const MapPoints points = somePoints();
    ASSERT_TRUE(writePointsGeoPackage(points, description(), folder / "p.gpkg"));
    ASSERT_TRUE(writePointsCsv(points, folder / "p.csv"));
    GDALAllRegister();
    const GDALDatasetUniquePtr package(GDALDataset::Open((folder / "p.gpkg").c_str(), GDAL_OF_VECTOR));
    ASSERT_NE(package, nullptr);
    OGRLayer* const layer = package->GetLayerByName("ground_points");
    ASSERT_NE(layer, nullptr);
    EXPECT_STREQ(layer->GetSpatialRef()->GetAuthorityCode(nullptr), "32649");
    std::size_t i = 0;
    for (const auto& feature : *layer) {
        const MapPoint& point = points.points.at(i++);
        const OGRPoint& place = *feature->GetGeometryRef()->toPoint();
        EXPECT_EQ(Eigen::Vector3d(place.getX(), place.getY(), place.getZ()), point.map_m);
        EXPECT_EQ(feature->GetFieldAsString("run"), points.run_ids[point.run]);
        EXPECT_STREQ(feature->GetFieldAsString("reason"),
                     point.state == GroundPointState::Used ? "" : "spike");
    }
    EXPECT_EQ(i, points.points.size());
    const GDALDatasetUniquePtr table(GDALDataset::Open((folder / "p.csv").c_str(), GDAL_OF_VECTOR));
    ASSERT_NE(table, nullptr);
    i = 0;
    for (const auto& feature : table->GetLayer(0)) {
        const MapPoint& point = points.points.at(i++);
        EXPECT_NEAR(feature->GetFieldAsDouble("y_m"), point.map_m.y(), kTenthMillimetre);
        EXPECT_EQ(feature->GetFieldAsString("run"), points.run_ids[point.run]);
    }
    EXPECT_EQ(i, points.points.size());
}

TEST(WritePoints, TheSamePointsGiveTheSameBytes) {
    const TemporaryFolder folder;
    for (const std::string name : {"a", "b"}) {
        ASSERT_TRUE(writePointsGeoPackage(somePoints(), description(), folder / (name + ".gpkg")));
        ASSERT_TRUE(writeLas(somePoints(), description(), folder / (name + ".las")));
    }
    EXPECT_EQ(bytesOf(folder / "a.gpkg"), bytesOf(folder / "b.gpkg"));
    EXPECT_EQ(bytesOf(folder / "a.las"), bytesOf(folder / "b.las"));
}

TEST(WriteContours, GdalReadsLevelsInAllThreeFormats) {
    const TemporaryFolder folder;
    std::vector<Contour> contours(2);
    contours[0] = {12.5, false, false, {{745000.1, 2565000.2}, {745010.3, 2565004.4}, {745020.5, 2565001.6}}};
    contours[1] = {
        15.0, true, true, {{745001, 2565001}, {745002, 2565001}, {745002, 2565002}, {745001, 2565001}}};
    GDALAllRegister();
    for (const std::string extension : {"gpkg", "geojson", "dxf"}) {
        const auto file = folder / ("c." + extension);
        const auto written = writeContours(contours, 0.5, description(), file);
        ASSERT_TRUE(written) << written.error().text();
        const GDALDatasetUniquePtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR));
        ASSERT_NE(dataset, nullptr) << extension;
        std::size_t i = 0, labels = 0;
        for (const auto& feature : dataset->GetLayer(0)) {
            const OGRGeometry& geometry = *feature->GetGeometryRef();
            if (wkbFlatten(geometry.getGeometryType()) == wkbPoint) {
                EXPECT_THAT(feature->GetStyleString(), HasSubstr("15"));
                ++labels;
                continue;
            }
            const Contour& contour = contours.at(i++);
            const OGRLineString& line = *geometry.toLineString();
            ASSERT_EQ(static_cast<std::size_t>(line.getNumPoints()), contour.vertices.size()) << extension;
            for (int k = 0; k < line.getNumPoints(); ++k) {
                EXPECT_NEAR(line.getX(k), contour.vertices[static_cast<std::size_t>(k)].x(), 1e-4);
                EXPECT_NEAR(line.getY(k), contour.vertices[static_cast<std::size_t>(k)].y(), 1e-4);
                EXPECT_EQ(line.getZ(k), contour.level) << extension;
            }
            if (extension != "dxf") {
                EXPECT_EQ(feature->GetFieldAsDouble("elevation"), contour.level);
                EXPECT_EQ(feature->GetFieldAsInteger("index"), contour.is_index ? 1 : 0);
            } else {
                EXPECT_STREQ(feature->GetFieldAsString("Layer"),
                             contour.is_index ? "contours_index" : "contours");
            }
        }
        EXPECT_EQ(i, contours.size()) << extension;
        EXPECT_EQ(labels, extension == "dxf" ? 1U : 0U);
    }
    EXPECT_FALSE(writeContours(contours, 0.5, description(), folder / "c.kml"));
    EXPECT_FALSE(writeContours({}, 0.5, description(), folder / "c.gpkg"));
}

TEST(WriteAsciiGrid, GdalReadsTheSameHeightsAtTheSamePlace) {
    const TemporaryFolder folder;
    ElevationGrid grid{{745645.2, 2565788.8, 0.2, 7, 5}, {}};
    for (std::size_t i = 0; i < grid.geometry.size(); ++i) {
        grid.heights_m.push_back(i % 6 == 0 ? kNoHeight : 38.0F + 0.123456F * static_cast<float>(i));
    }
    ASSERT_TRUE(writeAsciiGrid(grid, description().crs_wkt2, folder / "d.asc"));
    GDALAllRegister();
    const GDALDatasetUniquePtr dataset(GDALDataset::Open((folder / "d.asc").c_str()));
    ASSERT_NE(dataset, nullptr);
    ASSERT_NE(dataset->GetSpatialRef(), nullptr);
    std::array<double, 6> transform{};
    ASSERT_EQ(dataset->GetGeoTransform(transform.data()), CE_None);
    EXPECT_DOUBLE_EQ(transform[0], 745645.2);
    EXPECT_DOUBLE_EQ(transform[1], 0.2);
    EXPECT_NEAR(transform[3], 2565788.8, 1e-8);
    std::vector<float> heights(grid.geometry.size());
    ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, 7, 5, heights.data(), 7, 5, GDT_Float32, 0,
                                                  0, nullptr),
              CE_None);
    EXPECT_EQ(dataset->GetRasterBand(1)->GetNoDataValue(), -9999.0);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        EXPECT_EQ(heights[i], i % 6 == 0 ? -9999.0F : grid.heights_m[i]);
    }
}

TEST(QgisStyles, AreSoundXmlWithTheRamp) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeHillshadeStyle(folder / "dem.qml"));
    ASSERT_TRUE(writeShadedLayers("a&b.tif", description().crs_wkt2, 10.0, 20.0,
                                  {{1, 2, 3}, {50, 60, 70}, {255, 0, 16}}, folder / "dem.qlr"));
    CPLXMLTreeCloser style(CPLParseXMLFile((folder / "dem.qml").c_str()));
    ASSERT_NE(style.get(), nullptr);
    EXPECT_STREQ(CPLGetXMLValue(style.get(), "=qgis.pipe.rasterrenderer.type", ""), "hillshade");
    CPLXMLTreeCloser layers(CPLParseXMLFile((folder / "dem.qlr").c_str()));
    ASSERT_NE(layers.get(), nullptr);
    const CPLXMLNode* const relief = CPLGetXMLNode(layers.get(), "=qlr.maplayers.maplayer");
    ASSERT_NE(relief, nullptr);
    EXPECT_STREQ(CPLGetXMLValue(relief, "datasource", ""), "./a&b.tif");
    const CPLXMLNode* const heights = relief->psNext;
    ASSERT_NE(heights, nullptr);
    const CPLXMLNode* const shader =
        CPLGetXMLNode(const_cast<CPLXMLNode*>(heights), "pipe.rasterrenderer.rastershader.colorrampshader");
    ASSERT_NE(shader, nullptr);
    std::vector<std::string> items;
    for (const CPLXMLNode* item = shader->psChild; item != nullptr; item = item->psNext) {
        if (item->eType == CXT_Element)
            items.push_back(std::string(CPLGetXMLValue(item, "value", "")) +
                            CPLGetXMLValue(item, "color", ""));
    }
    EXPECT_EQ(items, (std::vector<std::string>{"10#010203", "15#323c46", "20#ff0010"}));
    EXPECT_FALSE(writeShadedLayers("d.tif", "", 2.0, 1.0, {{1, 2, 3}, {4, 5, 6}}, folder / "no.qlr"));
}

TEST(ReadGroundPoints, ReadsWhatWasWritten) {
    const TemporaryFolder folder;
    std::vector<GroundPoint> points(3);
    points[0].enu_m = {1.25, -2.5, 0.0625};
    points[0].sigma_u_m = 0.031;
    points[1].run = 1;
    points[1].time_s = 0.4;
    points[1].enu_m.setConstant(std::nan(""));
    points[1].state = GroundPointState::NoRange;
    points[2].run = 1;
    points[2].time_s = 0.6;
    points[2].state = GroundPointState::Thinned;
    ASSERT_TRUE(writeGroundPointsCsv(points, {"F,01", "S01"}, folder / "g.csv"));
    SilentProgress silent;
    const auto read = readGroundPointsCsv(folder / "g.csv", silent, {});
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->run_ids, (std::vector<std::string>{"F,01", "S01"}));
    ASSERT_EQ(read->points.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(read->points[i].run, points[i].run);
        EXPECT_EQ(read->points[i].time_s, points[i].time_s);
        EXPECT_EQ(read->points[i].state, points[i].state);
        EXPECT_EQ(read->points[i].enu_m.allFinite(), points[i].enu_m.allFinite());
    }
    EXPECT_EQ(read->points[0].enu_m, points[0].enu_m);
    const auto refusal = [&](const std::string& text) {
        writeBytes(folder / "bad.csv", text);
        const auto bad = readGroundPointsCsv(folder / "bad.csv", silent, {});
        return bad ? std::string("read") : bad.error().text();
    };
    const std::string header = "run,time_s,e_m,n_m,u_m,sigma_u_m,used,reason\n";
    EXPECT_THAT(refusal("run,time_s\nF,1\n"), HasSubstr("no column"));
    EXPECT_THAT(refusal(header), HasSubstr("no rows"));
    EXPECT_THAT(refusal(header + "F,1,1,1,x,1,1,\n"), HasSubstr("u_m"));
    EXPECT_THAT(refusal(header + "F,1,1,1,1,1,0,tired\n"), HasSubstr("tired"));
    EXPECT_THAT(refusal(header + "F,1,,,,1,1,\n"), HasSubstr("no place"));
    EXPECT_THAT(refusal(header + "F,1,1,1\n"), HasSubstr("4 fields"));
}

}  // namespace
}  // namespace terrawalk
