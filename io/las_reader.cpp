// ASPRS LAS Specification 1.4 - R15 (2019), tables 1 to 19; older versions have shorter headers.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "io/point_readers.hpp"
#include "io/text_input.hpp"

namespace terrawalk {
namespace {

static_assert(std::endian::native == std::endian::little, "LAS fields are read as they lie in the file");

constexpr std::size_t kPointsAtOnce = 8192;
constexpr std::array<std::size_t, 11> kLeastRecordBytes{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
constexpr int kGround = 2;
constexpr int kLowNoise = 7;
constexpr int kHighNoise = 18;

template <class T>
T valueAt(const char* bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes + offset, sizeof(T));
    return value;
}

struct LasHeader {
    int minor = 0;
    std::size_t header_bytes = 0;
    std::size_t points_offset = 0;
    std::uint32_t record_count = 0;  ///< of variable length
    int format = 0;
    std::size_t record_bytes = 0;
    std::uint64_t points = 0;
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

class LasReader {
  public:
    LasReader(const std::filesystem::path& file, ReadableFile input)
        : file_(file), input_(std::move(input)) {}

    Result<ScatteredPoints> read(const std::vector<int>& classes, Progress& progress,
                                 const std::stop_token& stop) {
        if (auto done = readHeader(); !done) return tl::unexpected(done.error());
        if (auto done = readRecords(); !done) return tl::unexpected(done.error());
        if (auto done = readPoints(progress, stop); !done) return tl::unexpected(done.error());
        choose(classes);
        return std::move(points_);
    }

  private:
    tl::unexpected<Error> bad(std::string message, std::string cure = {}) const {
        return badData(std::move(message), file_, 0, std::move(cure));
    }

    Result<void> readExactly(char* buffer, std::size_t bytes, const char* what) {
        const auto got = input_.read(buffer, bytes);
        if (!got) return tl::unexpected(got.error());
        if (*got != bytes)
            return bad(fmt::format("the file ends within its {}", what), "copy the file again");
        at_ += bytes;
        return {};
    }

    Result<void> readHeader() {
        std::array<char, 375> bytes{};
        constexpr std::size_t kShortest = 227;
        if (auto done = readExactly(bytes.data(), kShortest, "header"); !done) return done;
        if (std::memcmp(bytes.data(), "LASF", 4) != 0) return bad("this is no LAS file");
        const int major = valueAt<std::uint8_t>(bytes.data(), 24);
        header_.minor = valueAt<std::uint8_t>(bytes.data(), 25);
        if (major != 1 || header_.minor > 4) {
            return bad(fmt::format("LAS {}.{} is not known", major, header_.minor), "write it as LAS 1.4");
        }
        header_.header_bytes = valueAt<std::uint16_t>(bytes.data(), 94);
        header_.points_offset = valueAt<std::uint32_t>(bytes.data(), 96);
        header_.record_count = valueAt<std::uint32_t>(bytes.data(), 100);
        const int format = valueAt<std::uint8_t>(bytes.data(), 104);
        header_.record_bytes = valueAt<std::uint16_t>(bytes.data(), 105);
        header_.points = valueAt<std::uint32_t>(bytes.data(), 107);
        if ((format & 0xC0) != 0) {
            return bad("the points are compressed (LAZ)",
                       "decompress the file, e.g. with laszip or pdal translate");
        }
        header_.format = format;
        if (header_.header_bytes < kShortest) return bad("the header is too short to be one");
        if (header_.minor == 4 && header_.header_bytes >= bytes.size()) {
            if (auto done = readExactly(bytes.data() + kShortest, bytes.size() - kShortest, "header");
                !done) {
                return done;
            }
            header_.points = valueAt<std::uint64_t>(bytes.data(), 247);
        }
        for (int axis = 0; axis < 3; ++axis) {
            header_.scale[axis] = valueAt<double>(bytes.data(), 131 + 8 * static_cast<std::size_t>(axis));
            header_.offset[axis] = valueAt<double>(bytes.data(), 155 + 8 * static_cast<std::size_t>(axis));
        }
        return checkHeader();
    }

    Result<void> checkHeader() const {
        if (static_cast<std::size_t>(header_.format) >= kLeastRecordBytes.size()) {
            return bad(fmt::format("point format {} is not known", header_.format));
        }
        if (header_.record_bytes < kLeastRecordBytes[static_cast<std::size_t>(header_.format)]) {
            return bad(fmt::format("records of {} bytes are too short for point format {}",
                                   header_.record_bytes, header_.format));
        }
        if (!header_.scale.allFinite() || !header_.offset.allFinite() || header_.scale.minCoeff() <= 0.0) {
            return bad("the scale or the offset of the coordinates is none");
        }
        if (header_.points_offset < header_.header_bytes || header_.points_offset > input_.size()) {
            return bad("the points begin outside the file");
        }
        // Said before memory is asked for: a damaged count could be anything.
        if (header_.points > (input_.size() - header_.points_offset) / header_.record_bytes) {
            return bad(
                fmt::format("the header tells of {} points, but the file ends after {}", header_.points,
                            (input_.size() - header_.points_offset) / header_.record_bytes),
                "copy the file again");
        }
        return {};
    }

    /// Skips what lies between the headers and the points, but for the CRS.
    Result<void> readRecords() {
        if (auto done = skipTo(header_.header_bytes); !done) return done;
        constexpr std::size_t kRecordHeader = 54;
        for (std::uint32_t i = 0; i < header_.record_count && at_ + kRecordHeader <= header_.points_offset;
             ++i) {
            std::array<char, kRecordHeader> head{};
            if (auto done = readExactly(head.data(), head.size(), "variable length records"); !done)
                return done;
            const std::size_t bytes = valueAt<std::uint16_t>(head.data(), 20);
            if (at_ + bytes > header_.points_offset)
                return bad("a variable length record reaches into the points");
            std::string content(bytes, '\0');
            if (auto done = readExactly(content.data(), bytes, "variable length records"); !done) return done;
            const std::string user(head.data() + 2, ::strnlen(head.data() + 2, 16));
            if (user == "LASF_Projection") takeProjection(valueAt<std::uint16_t>(head.data(), 18), content);
        }
        return skipTo(header_.points_offset);
    }

    Result<void> skipTo(std::size_t offset) {
        std::array<char, 4096> ignored{};
        while (at_ < offset) {
            const std::size_t bytes = std::min(ignored.size(), offset - at_);
            if (auto done = readExactly(ignored.data(), bytes, "variable length records"); !done) return done;
        }
        return {};
    }

    /// WKT outranks the keys of GeoTIFF, of which only codes and units are read.
    void takeProjection(std::uint16_t record, const std::string& content) {
        constexpr std::uint16_t kWkt = 2112;
        constexpr std::uint16_t kGeoKeys = 34735;
        if (record == kWkt) {
            points_.crs = content.substr(0, content.find('\0'));
            return;
        }
        if (record != kGeoKeys) return;
        for (std::size_t at = 8; at + 8 <= content.size(); at += 8) {
            const auto key = valueAt<std::uint16_t>(content.data(), at);
            const auto place = valueAt<std::uint16_t>(content.data(), at + 2);
            const auto value = valueAt<std::uint16_t>(content.data(), at + 6);
            constexpr std::uint16_t kUserDefined = 32767;
            if (place != 0 || value == kUserDefined) continue;
            if (key == 3072 && points_.crs.empty()) points_.crs = fmt::format("EPSG:{}", value);
            if (key == 3076)
                points_.unit = value == 9002   ? lengthUnit("ft")
                               : value == 9003 ? lengthUnit("us-ft")
                               : value == 9001 ? lengthUnit("m")
                                               : std::nullopt;
        }
    }

    Result<void> readPoints(Progress& progress, const std::stop_token& stop) {
        const std::string step = fmt::format("reading {}", file_.filename().string());
        points_.in_file = header_.points;
        points_.points.reserve(header_.points);
        classes_.reserve(header_.points);
        std::vector<char> bytes(kPointsAtOnce * header_.record_bytes);
        for (std::uint64_t done = 0; done < header_.points;) {
            if (stop.stop_requested()) return cancelled();
            const std::size_t count =
                static_cast<std::size_t>(std::min<std::uint64_t>(kPointsAtOnce, header_.points - done));
            if (auto read = readExactly(bytes.data(), count * header_.record_bytes, "points"); !read)
                return read;
            for (std::size_t i = 0; i < count; ++i) takePoint(bytes.data() + i * header_.record_bytes);
            done += count;
            progress.report(static_cast<double>(done) / static_cast<double>(header_.points), step);
        }
        return {};
    }

    void takePoint(const char* record) {
        const bool extended = header_.format >= 6;
        const auto flags = valueAt<std::uint8_t>(record, 15);
        const bool withheld = extended ? (flags & 0x04) != 0 : (flags & 0x80) != 0;
        if (withheld) {
            ++withheld_;
            return;
        }
        Eigen::Vector3d point;
        for (int axis = 0; axis < 3; ++axis) {
            point[axis] =
                valueAt<std::int32_t>(record, 4 * static_cast<std::size_t>(axis)) * header_.scale[axis] +
                header_.offset[axis];
        }
        points_.points.push_back(point);
        classes_.push_back(extended ? valueAt<std::uint8_t>(record, 16)
                                    : static_cast<std::uint8_t>(flags & 0x1F));
    }

    void choose(const std::vector<int>& asked) {
        const bool has_ground = std::find(classes_.begin(), classes_.end(), kGround) != classes_.end();
        const auto wanted = [&](int c) {
            if (!asked.empty()) return std::find(asked.begin(), asked.end(), c) != asked.end();
            return has_ground ? c == kGround : c != kLowNoise && c != kHighNoise;
        };
        std::size_t kept = 0;
        for (std::size_t i = 0; i < classes_.size(); ++i) {
            if (wanted(classes_[i])) points_.points[kept++] = points_.points[i];
        }
        if (withheld_ > 0) points_.notes.push_back(fmt::format("{} points are withheld", withheld_));
        if (kept < classes_.size()) {
            points_.notes.push_back(fmt::format("{} of {} points are used: {}", kept, header_.points,
                                                !asked.empty() ? "the classes asked for"
                                                : has_ground   ? "those of class 2, ground"
                                                               : "those that are not noise"));
        }
        points_.points.resize(kept);
    }

    std::filesystem::path file_;
    ReadableFile input_;
    std::size_t at_ = 0;
    LasHeader header_;
    ScatteredPoints points_;
    std::vector<std::uint8_t> classes_;
    std::size_t withheld_ = 0;
};

}  // namespace

Result<ScatteredPoints> readLas(const std::filesystem::path& file, const std::vector<int>& classes,
                                Progress& progress, const std::stop_token& stop) {
    auto input = ReadableFile::open(file);
    if (!input) return tl::unexpected(input.error());
    return LasReader(file, std::move(*input)).read(classes, progress, stop);
}

}  // namespace terrawalk
