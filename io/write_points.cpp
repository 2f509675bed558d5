#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

#include "io/gdal_support.hpp"
#include "io/markup_text.hpp"
#include "io/mesh_layout.hpp"
#include "io/replacing_file.hpp"
#include "io/write_exchange.hpp"

namespace terrawalk {

namespace {

constexpr std::size_t kPointsBetweenStops = 16384;

Result<void> checkPoints(const MapPoints& points, const std::filesystem::path& file, bool walked = true) {
    if (points.points.empty()) return badData("there is no ground point to write", file);
    for (const MapPoint& point : points.points) {
        if (!point.map_m.allFinite()) return badData("a ground point has no place", file);
        if (walked && point.run >= points.run_ids.size()) {
            return badData(fmt::format("a ground point names run {} of {}", point.run, points.run_ids.size()),
                           file);
        }
    }
    return {};
}

Eigen::Vector3d originOfPoints(const MapPoints& points) {
    std::vector<Eigen::Vector3d> places_m;
    places_m.reserve(points.points.size());
    for (const MapPoint& point : points.points) places_m.push_back(point.map_m);
    return originOf(places_m);
}

/// A header, then what `writePoint` makes of each point.
template <class WritePoint>
Result<void> writeEach(const MapPoints& points, const std::string& header, const std::filesystem::path& file,
                       const std::stop_token& stop, WritePoint writePoint) {
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    auto written = out->write(header);
    std::string record;
    for (std::size_t i = 0; written && i < points.points.size(); ++i) {
        if (i % kPointsBetweenStops == 0 && stop.stop_requested()) return cancelled();
        record.clear();
        writePoint(points.points[i], record);
        written = out->write(record);
    }
    if (!written) return written;
    return out->commit();
}

template <class T>
void append(std::string& record, T value) {
    std::array<char, sizeof(T)> bytes{};
    put(bytes.data(), value);
    record.append(bytes.data(), bytes.size());
}

bool isUsed(const MapPoint& point) {
    return point.state == GroundPointState::Used;
}

/// The record that PLY and PCD share: 17 bytes.
void appendFloatRecord(std::string& record, const MapPoint& point, const Eigen::Vector3d& origin_m) {
    for (int axis = 0; axis < 3; ++axis)
        append(record, static_cast<float>(point.map_m[axis] - origin_m[axis]));
    append(record, static_cast<float>(point.sigma_u_m));
    append(record, static_cast<std::uint8_t>(isUsed(point) ? 1 : 0));
}

// ---- LAS: ASPRS LAS Specification 1.4 - R15 (2019) ----

constexpr double kLasStep_m = 1e-4;
constexpr std::size_t kLasHeaderBytes = 375;
constexpr std::size_t kVlrHeaderBytes = 54;
constexpr std::size_t kExtraBytesDescriptor = 192;
constexpr std::uint16_t kLasRecordBytes = 30 + 12;  // format 6, then time_s and sigma_z_m
constexpr std::uint16_t kWktBit = 1U << 4U;

void appendText(std::string& to, std::string_view text, std::size_t bytes) {
    std::string field(text.substr(0, bytes));
    field.resize(bytes, '\0');
    to += field;
}

std::string vlrHeader(std::string_view user, std::uint16_t id, std::size_t bytes, std::string_view about) {
    std::string header;
    append(header, std::uint16_t{0});
    appendText(header, user, 16);
    append(header, id);
    append(header, static_cast<std::uint16_t>(bytes));
    appendText(header, about, 32);
    return header;
}

/// Tables 24 and 25.
std::string extraBytesDescriptor(std::uint8_t type, std::string_view name, std::string_view about) {
    std::string d;
    append(d, std::uint16_t{0});
    append(d, type);
    append(d, std::uint8_t{0});
    appendText(d, name, 32);
    d.resize(kExtraBytesDescriptor - 32, '\0');
    appendText(d, about, 32);
    return d;
}

std::string lasWkt(const std::string& wkt2) {
    OGRSpatialReference crs;
    if (wkt2.empty() || crs.importFromWkt(wkt2.c_str()) != OGRERR_NONE) return {};
    char* text = nullptr;
    const std::array<const char*, 2> options{"FORMAT=WKT1_GDAL", nullptr};
    const bool ok = crs.exportToWkt(&text, options.data()) == OGRERR_NONE && text != nullptr;
    std::string wkt = ok ? text : "";
    CPLFree(text);
    return wkt;
}

struct LasDay {
    std::uint16_t of_year = 0;  ///< 1: the first of January
    std::uint16_t year = 0;
};

/// Zeros where the date is not known or is none.
LasDay lasDay(std::string_view date) {
    int year = 0;
    unsigned month = 0, day = 0;
    if (std::sscanf(std::string(date).c_str(), "%4d-%2u-%2u", &year, &month, &day) != 3) return {};
    const std::chrono::year_month_day when{std::chrono::year(year), std::chrono::month(month),
                                           std::chrono::day(day)};
    if (!when.ok() || year <= 0) return {};
    const auto before = std::chrono::sys_days(when.year() / 1 / 1) - std::chrono::days(1);
    return {static_cast<std::uint16_t>((std::chrono::sys_days(when) - before).count()),
            static_cast<std::uint16_t>(year)};
}

Result<std::string> lasHeader(const MapPoints& points, const ExchangeDescription& description,
                              const Eigen::Vector3d& origin_m, const std::filesystem::path& file) {
    const GdalErrors errors;
    const std::string wkt = lasWkt(description.crs_wkt2);
    if (wkt.empty() || wkt.size() >= std::numeric_limits<std::uint16_t>::max()) {
        return badData("LAS cannot hold the CRS: " + errors.text(), file);
    }
    std::string vlrs = vlrHeader("LASF_Projection", 2112, wkt.size() + 1, "OGC coordinate system WKT");
    vlrs += wkt;
    vlrs.push_back('\0');
    vlrs += vlrHeader("LASF_Spec", 4, 2 * kExtraBytesDescriptor, "Extra bytes");
    vlrs += extraBytesDescriptor(10, "time_s", "seconds since the log began");
    vlrs += extraBytesDescriptor(9, "sigma_z_m", "one sigma of the height");

    Eigen::Vector3d low = points.points.front().map_m;
    Eigen::Vector3d high = low;
    for (const MapPoint& point : points.points) {
        low = low.cwiseMin(point.map_m);
        high = high.cwiseMax(point.map_m);
    }
    std::string h = "LASF";
    append(h, std::uint16_t{0});  // file source
    append(h, kWktBit);
    h.append(16, '\0');  // GUID
    append(h, std::uint8_t{1});
    append(h, std::uint8_t{4});
    appendText(h, "EXTRACTION", 32);
    appendText(h, description.software, 32);
    const LasDay created = lasDay(description.date);
    append(h, created.of_year);
    append(h, created.year);
    append(h, static_cast<std::uint16_t>(kLasHeaderBytes));
    append(h, static_cast<std::uint32_t>(kLasHeaderBytes + vlrs.size()));
    append(h, std::uint32_t{2});  // variable length records
    append(h, std::uint8_t{6});
    append(h, kLasRecordBytes);
    h.append(4 + 20, '\0');  // legacy counts, zero for format 6
    for (int axis = 0; axis < 3; ++axis) append(h, kLasStep_m);
    for (int axis = 0; axis < 3; ++axis) append(h, origin_m[axis]);
    for (int axis = 0; axis < 3; ++axis) {
        append(h, high[axis]);
        append(h, low[axis]);
    }
    h.append(8 + 8 + 4, '\0');  // waveforms, extended records
    append(h, std::uint64_t{points.points.size()});
    append(h, std::uint64_t{points.points.size()});  // all are first and only returns
    h.append(14 * 8, '\0');
    return h + vlrs;
}

void appendLasRecord(std::string& record, const MapPoint& point, const Eigen::Vector3d& origin_m) {
    for (int axis = 0; axis < 3; ++axis) {
        append(record,
               static_cast<std::int32_t>(std::lround((point.map_m[axis] - origin_m[axis]) / kLasStep_m)));
    }
    append(record, std::uint16_t{0});                                        // intensity
    append(record, std::uint8_t{0x11});                                      // return 1 of 1
    append(record, static_cast<std::uint8_t>(isUsed(point) ? 0x00 : 0x04));  // withheld
    append(record, static_cast<std::uint8_t>(isUsed(point) ? 2 : 1));        // ground, unclassified
    append(record, static_cast<std::uint8_t>(point.state));                  // user data
    append(record, std::int16_t{0});                                         // scan angle
    append(record, static_cast<std::uint16_t>(point.run + 1));
    append(record, 0.0);  // GPS time
    append(record, point.time_s);
    append(record, static_cast<float>(point.sigma_u_m));
}

}  // namespace

Result<void> writeLas(const MapPoints& points, const ExchangeDescription& description,
                      const std::filesystem::path& file, std::stop_token stop) {
    if (auto checked = checkPoints(points, file); !checked) return checked;
    const Eigen::Vector3d origin_m = originOfPoints(points);
    for (const MapPoint& point : points.points) {
        if (((point.map_m - origin_m) / kLasStep_m).cwiseAbs().maxCoeff() >=
            std::numeric_limits<std::int32_t>::max()) {
            return badData("the points reach farther than LAS can hold in steps of 0.1 mm", file);
        }
    }
    if (points.run_ids.size() >= std::numeric_limits<std::uint16_t>::max()) {
        return badData("more runs than LAS can number", file);
    }
    const auto header = lasHeader(points, description, origin_m, file);
    if (!header) return tl::unexpected(header.error());
    return writeEach(points, *header, file, stop, [&](const MapPoint& point, std::string& record) {
        appendLasRecord(record, point, origin_m);
    });
}

Result<void> writePointsPly(const MapPoints& points, const ExchangeDescription& description,
                            const std::filesystem::path& file, std::stop_token stop) {
    if (auto checked = checkPoints(points, file); !checked) return checked;
    const Eigen::Vector3d origin_m = originOfPoints(points);
    const std::string header = fmt::format(
        "ply\nformat binary_little_endian 1.0\n"
        "comment Terrawalk ground points; map coordinates in metres are origin_m + x y z\n"
        "comment crs {}\ncomment origin_m {}\nelement vertex {}\nproperty float x\nproperty float y\n"
        "property float z\nproperty float sigma_z\nproperty uchar used\nend_header\n",
        oneLine(description.crs_name), originText(origin_m), points.points.size());
    return writeEach(points, header, file, stop, [&](const MapPoint& point, std::string& record) {
        appendFloatRecord(record, point, origin_m);
    });
}

Result<void> writePcd(const MapPoints& points, const ExchangeDescription& description,
                      const std::filesystem::path& file, std::stop_token stop) {
    if (auto checked = checkPoints(points, file); !checked) return checked;
    const Eigen::Vector3d origin_m = originOfPoints(points);
    const std::string header = fmt::format(
        "# .PCD v0.7 - Terrawalk ground points; map coordinates in metres are origin_m + x y z\n"
        "# crs {}\n# origin_m {}\n"
        "VERSION 0.7\nFIELDS x y z sigma_z used\nSIZE 4 4 4 4 1\nTYPE F F F F U\nCOUNT 1 1 1 1 1\n"
        "WIDTH {}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
        oneLine(description.crs_name), originText(origin_m), points.points.size(), points.points.size());
    return writeEach(points, header, file, stop, [&](const MapPoint& point, std::string& record) {
        appendFloatRecord(record, point, origin_m);
    });
}

Result<void> writePointsCsv(const MapPoints& points, const std::filesystem::path& file,
                            std::stop_token stop) {
    if (auto checked = checkPoints(points, file, !points.run_ids.empty()); !checked) return checked;
    const auto place = [](const MapPoint& point) {
        return fmt::format(FMT_COMPILE("{:.4f},{:.4f},{:.4f},"), point.map_m.x(), point.map_m.y(),
                           point.map_m.z());
    };
    const auto use = [](const MapPoint& point) {
        return fmt::format("{},{}\n", isUsed(point) ? 1 : 0, isUsed(point) ? "" : name(point.state));
    };
    if (points.run_ids.empty()) {
        const std::string unit = points.unit == "US-ft" ? "usft" : points.unit;
        return writeEach(
            points, fmt::format("x_{0},y_{0},z_{0},used,reason\n", unit), file, stop,
            [&](const MapPoint& point, std::string& record) { record += place(point) + use(point); });
    }
    std::vector<std::string> runs;
    for (const std::string& id : points.run_ids) runs.push_back(csvField(id));
    return writeEach(points, "x_m,y_m,z_m,sigma_z_m,run,time_s,used,reason\n", file, stop,
                     [&](const MapPoint& point, std::string& record) {
                         record += place(point);
                         if (std::isfinite(point.sigma_u_m)) record += fmt::format("{:.4f}", point.sigma_u_m);
                         record += fmt::format(",{},{:.3f},", runs[point.run], point.time_s) + use(point);
                     });
}

}  // namespace terrawalk
