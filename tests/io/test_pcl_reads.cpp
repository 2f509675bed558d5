// Point Cloud Library, and VTK below it, read what the writers of points and meshes made.

#include <gtest/gtest.h>
#include <pcl/PolygonMesh.h>
#include <pcl/io/obj_io.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include "io/write_exchange.hpp"
#include "io/write_products.hpp"
#include "tests/support/exchange_example.hpp"
#include "tests/support/temporary_folder.hpp"

namespace pcl::io {
// Reads by VTK. Its header would bring all of VTK's along.
int loadPolygonFileSTL(const std::string& file_name, pcl::PolygonMesh& mesh);
}  // namespace pcl::io

namespace terrawalk {
namespace {

using test::bytesOf;
using test::originIn;
using test::somePoints;
using test::TemporaryFolder;
using test::terraces;

// Within 256 m of the origin a float steps by 2^-15 m.
constexpr double kFloatStep_m = 3.1e-5;
const ExchangeDescription kDescription{"", "EPSG:32649", "test", "Terrawalk test"};

/// The origin stands in the text before the data.
Eigen::Vector3d originOfFile(const std::filesystem::path& file) {
    return originIn(bytesOf(file).substr(0, 600));
}

void expectPoints(const pcl::PCLPointCloud2& cloud, const Eigen::Vector3d& origin_m) {
    const MapPoints points = somePoints();
    pcl::PointCloud<pcl::PointXYZ> places;
    pcl::fromPCLPointCloud2(cloud, places);
    ASSERT_EQ(places.size(), points.points.size());
    const int sigma = pcl::getFieldIndex(cloud, "sigma_z"), used = pcl::getFieldIndex(cloud, "used");
    ASSERT_GE(sigma, 0);
    ASSERT_GE(used, 0);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const MapPoint& point = points.points[i];
        const Eigen::Vector3d read_m = origin_m + places[i].getVector3fMap().cast<double>();
        EXPECT_LT((read_m - point.map_m).cwiseAbs().maxCoeff(), kFloatStep_m) << i;
        const auto at = static_cast<pcl::index_t>(i);
        EXPECT_EQ(cloud.at<float>(at, cloud.fields[static_cast<std::size_t>(sigma)].offset),
                  static_cast<float>(point.sigma_u_m));
        EXPECT_EQ(cloud.at<std::uint8_t>(at, cloud.fields[static_cast<std::size_t>(used)].offset),
                  point.state == GroundPointState::Used ? 1 : 0);
    }
}

TEST(PointCloudLibrary, ReadsPcdPoints) {
    const TemporaryFolder folder;
    const auto file = folder / "p.pcd";
    ASSERT_TRUE(writePcd(somePoints(), kDescription, file));
    pcl::PCLPointCloud2 cloud;
    ASSERT_EQ(pcl::io::loadPCDFile(file.string(), cloud), 0);
    expectPoints(cloud, originOfFile(file));
}

TEST(PointCloudLibrary, ReadsPlyPoints) {
    const TemporaryFolder folder;
    const auto file = folder / "p.ply";
    ASSERT_TRUE(writePointsPly(somePoints(), kDescription, file));
    pcl::PCLPointCloud2 cloud;
    ASSERT_EQ(pcl::io::loadPLYFile(file.string(), cloud), 0);
    expectPoints(cloud, originOfFile(file));
}

/// @param places_m  how far the file's numbers may be off
void expectMesh(const pcl::PolygonMesh& read, const Eigen::Vector3d& origin_m, double places_m) {
    const TriangleMesh mesh = terraces();
    pcl::PointCloud<pcl::PointXYZ> places;
    pcl::fromPCLPointCloud2(read.cloud, places);
    ASSERT_EQ(read.polygons.size(), mesh.triangles.size());
    for (std::size_t t = 0; t < read.polygons.size(); ++t) {
        ASSERT_EQ(read.polygons[t].vertices.size(), 3U);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto vertex = static_cast<std::size_t>(read.polygons[t].vertices[k]);
            ASSERT_LT(vertex, places.size());
            const Eigen::Vector3d at_m = origin_m + places[vertex].getVector3fMap().cast<double>();
            EXPECT_LT((at_m - mesh.vertices_m[mesh.triangles[t][k]]).cwiseAbs().maxCoeff(), places_m)
                << "corner " << k << " of triangle " << t;
        }
    }
}

TEST(PointCloudLibrary, ReadsPlyMesh) {
    const TemporaryFolder folder;
    const auto file = folder / "s.ply";
    ASSERT_TRUE(writePly(terraces(), "EPSG:32649", file));
    pcl::PolygonMesh read;
    ASSERT_EQ(pcl::io::loadPLYFile(file.string(), read), 0);
    expectMesh(read, originOfFile(file), kFloatStep_m);
}

TEST(PointCloudLibrary, ReadsObjMesh) {
    const TemporaryFolder folder;
    const auto file = folder / "s.obj";
    ASSERT_TRUE(writeObj(terraces(), "EPSG:32649", file));
    pcl::PolygonMesh read;
    ASSERT_EQ(pcl::io::loadOBJFile(file.string(), read), 0);
    // Half a tenth of a millimetre of the text, and the float that PCL makes of it.
    expectMesh(read, originOfFile(file), 0.5e-4 + kFloatStep_m);
}

TEST(PointCloudLibrary, ReadsStlMeshByVtk) {
    const TemporaryFolder folder;
    const auto file = folder / "s.stl";
    ASSERT_TRUE(writeStl(terraces(), file));
    pcl::PolygonMesh read;
    ASSERT_GT(pcl::io::loadPolygonFileSTL(file.string(), read), 0);
    expectMesh(read, originIn(bytesOf(file).substr(0, 80)), kFloatStep_m);
}

}  // namespace
}  // namespace terrawalk
