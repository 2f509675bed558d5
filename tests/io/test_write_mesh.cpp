#include <gmock/gmock.h>

#include <charconv>
#include <cstring>
#include <limits>
#include <sstream>

#include "io/write_products.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using test::bytesOf;
using test::TemporaryFolder;
using ::testing::Contains;
using ::testing::HasSubstr;

/// A mesh file as read by the few lines below, which share nothing with the writer.
struct ReadMesh {
    std::vector<std::string> comments;
    Eigen::Vector3d origin_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    TriangleMesh mesh;  // origin added
};

void takeComment(ReadMesh& read, const std::string& comment) {
    read.comments.push_back(comment);
    std::istringstream words(comment);
    std::string word;
    words >> word;
    if (word == "origin_m") words >> read.origin_m.x() >> read.origin_m.y() >> read.origin_m.z();
}

ReadMesh readPly(const std::string& bytes) {
    ReadMesh read;
    std::istringstream stream(bytes);
    std::string line;
    std::size_t vertices = 0;
    std::size_t faces = 0;
    std::getline(stream, line);
    EXPECT_EQ(line, "ply");
    std::getline(stream, line);
    EXPECT_EQ(line, "format binary_little_endian 1.0");
    std::vector<std::string> properties;
    while (std::getline(stream, line) && line != "end_header") {
        std::istringstream words(line);
        std::string keyword;
        std::string what;
        words >> keyword;
        if (keyword == "comment") {
            takeComment(read, line.substr(8));
        } else if (keyword == "element") {
            words >> what;
            words >> (what == "vertex" ? vertices : faces);
        } else {
            EXPECT_EQ(keyword, "property");
            properties.push_back(line.substr(9));
        }
    }
    EXPECT_THAT(properties,
                ::testing::ElementsAre("float x", "float y", "float z", "list uchar int vertex_indices"));
    const auto byte = [&] {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(stream.get()));
    };
    const auto word = [&] {
        std::uint32_t value = byte();
        for (unsigned shift = 8; shift < 32; shift += 8) value |= byte() << shift;
        return value;
    };
    for (std::size_t i = 0; i < vertices; ++i) {
        Eigen::Vector3d vertex;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t bits = word();
            float value = 0.0F;
            std::memcpy(&value, &bits, 4);
            vertex[k] = read.origin_m[k] + double{value};
        }
        read.mesh.vertices_m.push_back(vertex);
    }
    for (std::size_t i = 0; i < faces; ++i) {
        EXPECT_EQ(byte(), 3U);
        const std::uint32_t a = word();
        const std::uint32_t b = word();
        read.mesh.triangles.push_back({a, b, word()});
    }
    EXPECT_TRUE(stream.good());
    EXPECT_EQ(stream.get(), std::istringstream::traits_type::eof());
    return read;
}

ReadMesh readObj(const std::string& text) {
    ReadMesh read;
    std::istringstream stream(text);
    std::string line;
    while (std::getline(stream, line)) {
        std::istringstream words(line);
        std::string keyword;
        words >> keyword;
        if (keyword == "#") {
            takeComment(read, line.substr(2));
        } else if (keyword == "v") {
            Eigen::Vector3d offset_m;
            words >> offset_m.x() >> offset_m.y() >> offset_m.z();
            read.mesh.vertices_m.push_back(read.origin_m + offset_m);
        } else {
            EXPECT_EQ(keyword, "f");
            std::array<std::uint32_t, 3> corners{};
            words >> corners[0] >> corners[1] >> corners[2];
            for (auto& corner : corners) --corner;
            read.mesh.triangles.push_back(corners);
        }
        EXPECT_FALSE(words.fail()) << line;
    }
    return read;
}

/// Two kilometres of ground at UTM coordinates.
TriangleMesh strip() {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < 2001; ++i) {
        const double side = i % 2 == 0 ? 0.0 : 1.5;
        mesh.vertices_m.emplace_back(745000.123456 + i, 2565000.654321 + side, 38.0 + 0.001 * i);
        if (i >= 2) mesh.triangles.push_back({i - 2, i % 2 == 0 ? i - 1 : i, i % 2 == 0 ? i : i - 1});
    }
    return mesh;
}

void expectSame(const ReadMesh& read, const TriangleMesh& mesh, double tolerance_m) {
    ASSERT_EQ(read.mesh.vertices_m.size(), mesh.vertices_m.size());
    for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
        EXPECT_LT((read.mesh.vertices_m[i] - mesh.vertices_m[i]).cwiseAbs().maxCoeff(), tolerance_m);
    }
    EXPECT_EQ(read.mesh.triangles, mesh.triangles);
    EXPECT_EQ(read.origin_m, read.origin_m.array().round().matrix());
}

TEST(WritePly, ReadsBackWithinTheStepOfAFloat) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writePly(strip(), "WGS 84 / UTM zone 49N (EPSG:32649)", folder / "surface.ply"));
    const ReadMesh read = readPly(bytesOf(folder / "surface.ply"));
    // 1 km from the middle a float steps by 2^-14 m.
    expectSame(read, strip(), std::ldexp(1.0, -14));
    EXPECT_THAT(read.comments, Contains("crs WGS 84 / UTM zone 49N (EPSG:32649)"));
}

TEST(WriteObj, ReadsBackWithinATenthOfAMillimetre) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeObj(strip(), "WGS 84 / UTM zone 49N (EPSG:32649)", folder / "surface.obj"));
    const ReadMesh read = readObj(bytesOf(folder / "surface.obj"));
    expectSame(read, strip(), 0.5e-4 + 1e-8);
    EXPECT_EQ(read.origin_m, readPly([&] {
                                 EXPECT_TRUE(writePly(strip(), "", folder / "surface.ply"));
                                 return bytesOf(folder / "surface.ply");
                             }())
                                 .origin_m);
}

TEST(WriteMesh, ACrsNameCannotBreakTheHeader) {
    const TemporaryFolder folder;
    const std::string hostile("a\nend_header\r\nelement vertex 9\0b\x7F", 33);
    ASSERT_TRUE(writePly(strip(), hostile, folder / "surface.ply"));
    ASSERT_TRUE(writeObj(strip(), hostile, folder / "surface.obj"));
    EXPECT_EQ(readPly(bytesOf(folder / "surface.ply")).mesh.triangles, strip().triangles);
    const ReadMesh obj = readObj(bytesOf(folder / "surface.obj"));
    EXPECT_EQ(obj.mesh.triangles, strip().triangles);
    EXPECT_THAT(obj.comments, Contains("crs a end_header  element vertex 9 b "));
}

TEST(WriteMesh, RefusesMeshesThatNoReaderCouldUse) {
    const TemporaryFolder folder;
    const auto refusal = [&](const TriangleMesh& mesh) {
        const auto ply = writePly(mesh, "", folder / "m.ply");
        const auto obj = writeObj(mesh, "", folder / "m.obj");
        EXPECT_FALSE(ply);
        EXPECT_FALSE(obj);
        EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
        return ply ? "written" : ply.error().text();
    };
    TriangleMesh mesh = strip();
    mesh.triangles[7][1] = 2001;
    EXPECT_THAT(refusal(mesh), HasSubstr("without a vertex"));
    mesh = strip();
    mesh.vertices_m[3].z() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refusal(mesh), HasSubstr("not finite"));
    mesh.triangles.clear();
    EXPECT_THAT(refusal(mesh), HasSubstr("no triangle"));
    EXPECT_THAT(refusal({}), HasSubstr("no triangle"));
}

}  // namespace
}  // namespace terrawalk
