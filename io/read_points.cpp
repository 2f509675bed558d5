#include "io/read_points.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "io/point_readers.hpp"

namespace terrawalk {

std::optional<NamedColumn> namedColumn(std::string_view name) {
    std::string text(name);
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::optional<LengthUnit> unit;
    constexpr std::array<std::pair<std::string_view, std::string_view>, 13> kEndings{
        {{"_m", "m"},
         {"[m]", "m"},
         {"(m)", "m"},
         {"/m", "m"},
         {"\uff08m\uff09", "m"},  // brackets as wide as a Chinese character; the metre in Chinese
         {"(\u7c73)", "m"},
         {"\uff08\u7c73\uff09", "m"},
         {"_usft", "us-ft"},
         {"[us-ft]", "us-ft"},
         {"(us-ft)", "us-ft"},
         {"_ft", "ft"},
         {"[ft]", "ft"},
         {"(ft)", "ft"}}};
    for (const auto& [ending, symbol] : kEndings) {
        if (text.size() > ending.size() && text.ends_with(ending)) {
            unit = lengthUnit(symbol);
            text.resize(text.size() - ending.size());
            while (text.ends_with(' ')) text.pop_back();
            break;
        }
    }
    constexpr std::array<std::pair<std::string_view, PointColumn>, 29> kNames{
        {{"x", PointColumn::X},
         {"e", PointColumn::X},
         {"east", PointColumn::X},
         {"easting", PointColumn::X},
         {"y", PointColumn::Y},
         {"n", PointColumn::Y},
         {"north", PointColumn::Y},
         {"northing", PointColumn::Y},
         {"z", PointColumn::Z},
         {"h", PointColumn::Z},
         {"u", PointColumn::Z},
         {"height", PointColumn::Z},
         {"elevation", PointColumn::Z},
         {"sigma_z", PointColumn::Sigma},
         {"sigma_v", PointColumn::Sigma},
         {"\u4e1c\u5750\u6807", PointColumn::X},  // east coordinate, north coordinate, height
         {"\u5317\u5750\u6807", PointColumn::Y},
         {"x\u5750\u6807", PointColumn::X},  // x coordinate, y coordinate, also the other way about
         {"y\u5750\u6807", PointColumn::Y},
         {"\u5750\u6807x", PointColumn::X},
         {"\u5750\u6807y", PointColumn::Y},
         {"\u6a2a\u5750\u6807", PointColumn::X},  // across and along the meridian
         {"\u7eb5\u5750\u6807", PointColumn::Y},
         {"\u9ad8\u7a0b", PointColumn::Z},
         {"\u6807\u9ad8", PointColumn::Z},
         {"\u6d77\u62d4", PointColumn::Z},
         {"\u5927\u5730\u9ad8", PointColumn::Z},
         {"\u6b63\u5e38\u9ad8", PointColumn::Z},
         {"used", PointColumn::Used}}};
    for (const auto& [known, column] : kNames) {
        if (text == known) return NamedColumn{column, unit};
    }
    return std::nullopt;
}

void leaveOutUnused(ScatteredPoints& points, std::size_t left_out) {
    points.in_file = points.points.size() + left_out;
    if (left_out == 0) return;
    points.notes.push_back(
        fmt::format("{} of {} points are marked as not used and left out", left_out, points.in_file));
}

Result<ScatteredPoints> readPoints(const std::filesystem::path& file, const PointReadOptions& options,
                                   Progress& progress, std::stop_token stop) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return badData("no such file", file);
    Result<ScatteredPoints> points = [&] {
        if (extension == ".csv" || extension == ".txt" || extension == ".xyz") {
            return readPointTable(file, progress, stop);
        }
        if (extension == ".las" || extension == ".laz") {
            return readLas(file, options.las_classes, progress, stop);
        }
        if (extension == ".ply") return readPly(file, progress, stop);
        return readVectorPoints(file, progress, stop);
    }();
    if (stop.stop_requested()) return cancelled();
    if (points && points->points.empty()) return badData("there is no point in the file", file);
    return points;
}

}  // namespace terrawalk
