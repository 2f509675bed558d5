#include <fmt/compile.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>

#include "io/markup_text.hpp"
#include "io/mesh_layout.hpp"
#include "io/replacing_file.hpp"
#include "io/write_exchange.hpp"

namespace terrawalk {

namespace {

char* putFloats(char* to, const Eigen::Vector3d& v) {
    for (const double value : v) to = put(to, static_cast<float>(value));
    return to;
}

}  // namespace

Result<void> writeStl(const TriangleMesh& mesh, const std::filesystem::path& file) {
    if (auto checked = checkMesh(mesh, file); !checked) return checked;
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    const Eigen::Vector3d origin_m = originOf(mesh.vertices_m);
    // Readers take a file that begins with "solid" for text.
    std::string header = "Terrawalk surface, metres; origin_m " + originText(origin_m);
    header.resize(80, ' ');
    std::array<char, 4> count{};
    put(count.data(), static_cast<std::uint32_t>(mesh.triangles.size()));
    auto done = out->write(header + std::string(count.data(), count.size()));
    for (std::size_t i = 0; done && i < mesh.triangles.size(); ++i) {
        std::array<Eigen::Vector3d, 3> corners_m;
        for (std::size_t k = 0; k < 3; ++k) corners_m[k] = mesh.vertices_m[mesh.triangles[i][k]] - origin_m;
        const Eigen::Vector3d normal =
            (corners_m[1] - corners_m[0]).cross(corners_m[2] - corners_m[0]).stableNormalized();
        std::array<char, 50> record{};  // the last two bytes, an attribute count, stay zero
        char* at = putFloats(record.data(), normal);
        for (const Eigen::Vector3d& corner : corners_m) at = putFloats(at, corner);
        done = out->write({record.data(), record.size()});
    }
    if (!done) return done;
    return out->commit();
}

Result<void> writeDxfFaces(const TriangleMesh& mesh, const std::filesystem::path& file) {
    if (auto checked = checkMesh(mesh, file); !checked) return checked;
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    auto done = out->write(
        "999\nTerrawalk surface, metres\n0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n0\nENDSEC\n"
        "0\nSECTION\n2\nENTITIES\n");
    std::string face;
    for (std::size_t i = 0; done && i < mesh.triangles.size(); ++i) {
        face = "0\n3DFACE\n8\nsurface\n";
        // A face has four corners; that of a triangle repeats the third.
        for (std::size_t k = 0; k < 4; ++k) {
            const Eigen::Vector3d& v = mesh.vertices_m[mesh.triangles[i][std::min<std::size_t>(k, 2)]];
            fmt::format_to(std::back_inserter(face), FMT_COMPILE("{}\n{:.4f}\n{}\n{:.4f}\n{}\n{:.4f}\n"),
                           10 + k, v.x(), 20 + k, v.y(), 30 + k, v.z());
        }
        done = out->write(face);
    }
    if (done) done = out->write("0\nENDSEC\n0\nEOF\n");
    if (!done) return done;
    return out->commit();
}

Result<void> writeLandXml(const TriangleMesh& mesh, const ExchangeDescription& description,
                          const std::filesystem::path& file) {
    if (auto checked = checkMesh(mesh, file); !checked) return checked;
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    auto done = out->write(fmt::format(
        R"(<?xml version="1.0" encoding="UTF-8"?>
<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2" version="1.2" date="{}" time="00:00:00" readOnly="false">
<Units><Metric areaUnit="squareMeter" linearUnit="meter" volumeUnit="cubicMeter" temperatureUnit="celsius" pressureUnit="HPA"/></Units>
<CoordinateSystem name="{}" ogcWktCode="{}"/>
<Application name="{}"{}/>
<Surfaces>
<Surface name="{}">
<Definition surfType="TIN">
<Pnts>
)",
        description.date.empty() ? "1970-01-01" : escapedMarkup(description.date),
        escapedMarkup(description.crs_name), escapedMarkup(oneLine(description.crs_wkt2)),
        escapedMarkup(description.software),
        description.date.empty() ? " desc=\"The day of the survey is not known: the date stands for none\""
                                 : "",
        escapedMarkup(description.title)));
    std::string line;
    for (std::size_t i = 0; done && i < mesh.vertices_m.size(); ++i) {
        const Eigen::Vector3d& v = mesh.vertices_m[i];
        line.clear();
        fmt::format_to(std::back_inserter(line), FMT_COMPILE("<P id=\"{}\">{:.4f} {:.4f} {:.4f}</P>\n"),
                       i + 1, v.y(), v.x(), v.z());
        done = out->write(line);
    }
    if (done) done = out->write("</Pnts>\n<Faces>\n");
    for (std::size_t i = 0; done && i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        line.clear();
        fmt::format_to(std::back_inserter(line), FMT_COMPILE("<F>{} {} {}</F>\n"), std::uint64_t{a} + 1,
                       std::uint64_t{b} + 1, std::uint64_t{c} + 1);
        done = out->write(line);
    }
    if (done) done = out->write("</Faces>\n</Definition>\n</Surface>\n</Surfaces>\n</LandXML>\n");
    if (!done) return done;
    return out->commit();
}

}  // namespace terrawalk
