// Turk, G.: The PLY Polygon File Format, 1994.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "io/point_readers.hpp"
#include "io/read_mesh.hpp"
#include "io/text_input.hpp"

namespace terrawalk {
namespace {

constexpr std::size_t kMostBytes = std::size_t{4} << 30U;
constexpr std::size_t kPointsBetweenReports = 65536;

enum class Format { Text, LittleEndian, BigEndian };
enum class Type { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };

std::optional<Type> typeOf(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, Type>, 16> kTypes{{{"char", Type::Int8},
                                                                        {"int8", Type::Int8},
                                                                        {"uchar", Type::UInt8},
                                                                        {"uint8", Type::UInt8},
                                                                        {"short", Type::Int16},
                                                                        {"int16", Type::Int16},
                                                                        {"ushort", Type::UInt16},
                                                                        {"uint16", Type::UInt16},
                                                                        {"int", Type::Int32},
                                                                        {"int32", Type::Int32},
                                                                        {"uint", Type::UInt32},
                                                                        {"uint32", Type::UInt32},
                                                                        {"float", Type::Float},
                                                                        {"float32", Type::Float},
                                                                        {"double", Type::Double},
                                                                        {"float64", Type::Double}}};
    for (const auto& [known, type] : kTypes) {
        if (known == name) return type;
    }
    return std::nullopt;
}

std::size_t bytesOf(Type type) {
    switch (type) {
        case Type::Int8:
        case Type::UInt8:
            return 1;
        case Type::Int16:
        case Type::UInt16:
            return 2;
        case Type::Int32:
        case Type::UInt32:
        case Type::Float:
            return 4;
        case Type::Double:
            return 8;
    }
    return 0;
}

template <class T>
double as(const char* bytes, bool swap) {
    std::array<char, sizeof(T)> own{};
    std::memcpy(own.data(), bytes, sizeof(T));
    if (swap) std::reverse(own.begin(), own.end());
    return static_cast<double>(std::bit_cast<T>(own));
}

double numberAt(const char* bytes, Type type, bool swap) {
    switch (type) {
        case Type::Int8:
            return as<std::int8_t>(bytes, swap);
        case Type::UInt8:
            return as<std::uint8_t>(bytes, swap);
        case Type::Int16:
            return as<std::int16_t>(bytes, swap);
        case Type::UInt16:
            return as<std::uint16_t>(bytes, swap);
        case Type::Int32:
            return as<std::int32_t>(bytes, swap);
        case Type::UInt32:
            return as<std::uint32_t>(bytes, swap);
        case Type::Float:
            return as<float>(bytes, swap);
        case Type::Double:
            return as<double>(bytes, swap);
    }
    return 0.0;
}

struct Property {
    Type type;
    std::string name;
};

class PlyReader {
  public:
    PlyReader(const std::filesystem::path& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

    Result<ScatteredPoints> read(Progress& progress, const std::stop_token& stop) {
        if (auto done = readHeader(); !done) return tl::unexpected(done.error());
        points_.in_file = count_;
        points_.points.reserve(std::min(count_, bytes_.size() / std::max<std::size_t>(record_bytes_, 1)));
        const std::string step = fmt::format("reading {}", file_.filename().string());
        for (std::size_t i = 0; i < count_; ++i) {
            if (i % kPointsBetweenReports == 0) {
                if (stop.stop_requested()) return cancelled();
                progress.report(static_cast<double>(i) / static_cast<double>(count_), step);
            }
            auto taken = format_ == Format::Text ? takeText(i) : takeBinary(i);
            if (!taken) return tl::unexpected(taken.error());
        }
        if (!origin_.isZero(0.0)) {
            for (Eigen::Vector3d& point : points_.points) point += origin_;
        }
        leaveOutUnused(points_, left_out_);
        return std::move(points_);
    }

    /// To be called after read().
    Result<std::vector<std::array<std::uint32_t, 3>>> readTriangles() {
        if (!faces_follow_ || !index_type_ || format_ == Format::Text) {
            return bad("there are no binary faces right after the vertices");
        }
        std::vector<std::array<std::uint32_t, 3>> triangles;
        triangles.reserve(std::min(face_count_, bytes_.size()));
        for (std::size_t i = 0; i < face_count_; ++i) {
            if (nextNumber(*length_type_) != 3.0) return bad(fmt::format("face {} is no triangle", i + 1));
            std::array<std::uint32_t, 3> corners{};
            for (std::uint32_t& corner : corners) {
                const double index = nextNumber(*index_type_).value_or(-1.0);
                if (!(index >= 0.0) || !(index < static_cast<double>(count_))) {
                    return bad(fmt::format("face {} names no vertex", i + 1));
                }
                corner = static_cast<std::uint32_t>(index);
            }
            triangles.push_back(corners);
        }
        return triangles;
    }

  private:
    tl::unexpected<Error> bad(std::string message) const { return badData(std::move(message), file_, line_); }

    /// The next binary number; nothing at the end of the file.
    std::optional<double> nextNumber(Type type) {
        if (bytes_.size() - at_ < bytesOf(type)) return std::nullopt;
        const double value = numberAt(bytes_.data() + at_, type, swapped());
        at_ += bytesOf(type);
        return value;
    }
    [[nodiscard]] bool swapped() const {
        return (format_ == Format::BigEndian) == (std::endian::native == std::endian::little);
    }

    std::optional<std::string_view> nextLine() {
        if (at_ >= bytes_.size()) return std::nullopt;
        ++line_;
        const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
        std::string_view line = bytes_.substr(at_, end - at_);
        at_ = std::min(end + 1, bytes_.size());
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line;
    }

    static std::vector<std::string_view> words(std::string_view line) {
        std::vector<std::string_view> found;
        for (std::size_t at = 0; at < line.size();) {
            const std::size_t begin = line.find_first_not_of(" \t", at);
            if (begin == std::string_view::npos) break;
            at = std::min(line.find_first_of(" \t", begin), line.size());
            found.push_back(line.substr(begin, at - begin));
        }
        return found;
    }

    Result<void> readHeader() {
        if (nextLine() != "ply") return bad("this is no PLY file");
        bool in_vertices = false;
        bool other_before = false;
        bool in_faces = false;
        bool between = false;
        for (;;) {
            const auto line = nextLine();
            if (!line) return bad("the header does not end");
            const auto word = words(*line);
            if (word.empty()) continue;
            if (word[0] == "end_header") break;
            if (word[0] == "comment") takeComment(word);
            if (word[0] == "format" && word.size() >= 2) {
                if (word[1] == "ascii") {
                    format_ = Format::Text;
                } else if (word[1] == "binary_little_endian") {
                    format_ = Format::LittleEndian;
                } else if (word[1] == "binary_big_endian") {
                    format_ = Format::BigEndian;
                } else {
                    return bad("this form of PLY is not known");
                }
            } else if (word[0] == "element" && word.size() >= 3) {
                in_vertices = word[1] == "vertex";
                const auto count = parseNumber(word[2]);
                if (!count || *count < 0.0 || *count > 1e12) return bad("an element without a count");
                if (in_vertices) count_ = static_cast<std::size_t>(*count);
                if (!in_vertices && properties_.empty() && *count > 0.0) other_before = true;
                in_faces = word[1] == "face" && !faces_follow_;
                if (in_faces) {
                    faces_follow_ = count_ > 0 && !between;
                    face_count_ = static_cast<std::size_t>(*count);
                }
                between = between || (!in_vertices && !in_faces);
            } else if (word[0] == "property" && in_faces) {
                if (word.size() != 5 || word[1] != "list" || index_type_) return bad("faces of unknown form");
                length_type_ = typeOf(word[2]);
                index_type_ = typeOf(word[3]);
                if (!length_type_ || !index_type_) return bad("faces of unknown form");
            } else if (word[0] == "property" && in_vertices) {
                const auto type = word.size() == 3 ? typeOf(word[1]) : std::nullopt;
                if (!type) return bad("vertices with lists or types that are not known");
                properties_.push_back({*type, std::string(word[2])});
            }
        }
        if (other_before) return bad("the vertices do not come first");
        std::size_t offset = 0;
        for (std::size_t i = 0; i < properties_.size(); ++i) {
            const std::string& property = properties_[i].name;
            if (property.size() == 1 && property[0] >= 'x' && property[0] <= 'z') {
                axes_[static_cast<std::size_t>(property[0] - 'x')] = {i, offset, properties_[i].type, true};
            }
            if (property == "used") used_ = {i, offset, properties_[i].type, true};
            offset += bytesOf(properties_[i].type);
        }
        record_bytes_ = offset;
        if (!axes_[0].found || !axes_[1].found || !axes_[2].found)
            return bad("the vertices have no x, y and z");
        return {};
    }

    /// Our own meshes hold offsets in metres: "comment origin_m x y z".
    void takeComment(const std::vector<std::string_view>& word) {
        if (word.size() != 5 || word[1] != "origin_m") return;
        points_.unit = lengthUnit("m");
        for (std::size_t axis = 0; axis < 3; ++axis) {
            origin_[static_cast<Eigen::Index>(axis)] = parseNumber(word[axis + 2]).value_or(0.0);
        }
    }

    Result<void> take(std::size_t i, const Eigen::Vector3d& point) {
        if (!point.allFinite()) return bad(fmt::format("vertex {} has no place", i + 1));
        points_.points.push_back(point);
        return {};
    }

    Result<void> takeText(std::size_t i) {
        const auto line = nextLine();
        if (!line) return bad(fmt::format("the file ends after {} of {} vertices", i, count_));
        const auto word = words(*line);
        if (used_.found && used_.index < word.size() && word[used_.index] == "0") {
            ++left_out_;
            return {};
        }
        Eigen::Vector3d point;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t column = axes_[axis].index;
            const auto number = column < word.size() ? parseNumber(word[column]) : std::nullopt;
            if (!number) return bad(fmt::format("vertex {} has no place", i + 1));
            point[static_cast<Eigen::Index>(axis)] = *number;
        }
        return take(i, point);
    }

    Result<void> takeBinary(std::size_t i) {
        if (bytes_.size() - at_ < record_bytes_) {
            return bad(fmt::format("the file ends after {} of {} vertices", i, count_));
        }
        Eigen::Vector3d point;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            point[static_cast<Eigen::Index>(axis)] =
                numberAt(bytes_.data() + at_ + axes_[axis].offset, axes_[axis].type, swapped());
        }
        const char* const used = bytes_.data() + at_ + used_.offset;
        at_ += record_bytes_;
        if (used_.found && numberAt(used, used_.type, swapped()) == 0.0) {
            ++left_out_;
            return {};
        }
        return take(i, point);
    }

    struct Axis {
        std::size_t index = 0;
        std::size_t offset = 0;
        Type type = Type::Float;
        bool found = false;
    };

    std::filesystem::path file_;
    std::string_view bytes_;
    std::size_t at_ = 0;
    std::size_t line_ = 0;
    Format format_ = Format::Text;
    std::size_t count_ = 0;
    std::vector<Property> properties_;
    std::array<Axis, 3> axes_{};
    Axis used_;
    std::size_t left_out_ = 0;
    std::size_t record_bytes_ = 0;
    std::size_t face_count_ = 0;
    bool faces_follow_ = false;  ///< the vertices, with nothing between
    std::optional<Type> length_type_;
    std::optional<Type> index_type_;
    Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
    ScatteredPoints points_;
};

}  // namespace

Result<ScatteredPoints> readPly(const std::filesystem::path& file, Progress& progress,
                                const std::stop_token& stop) {
    const auto bytes = readWholeFile(file, kMostBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    return PlyReader(file, *bytes).read(progress, stop);
}

Result<TriangleMesh> readMeshPly(const std::filesystem::path& file, Progress& progress,
                                 std::stop_token stop) {
    const auto bytes = readWholeFile(file, kMostBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    PlyReader reader(file, *bytes);
    auto vertices = reader.read(progress, stop);
    if (!vertices) return tl::unexpected(vertices.error());
    auto triangles = reader.readTriangles();
    if (!triangles) return tl::unexpected(triangles.error());
    return TriangleMesh{std::move(vertices->points), std::move(*triangles)};
}

}  // namespace terrawalk
