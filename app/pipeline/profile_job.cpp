#include "app/pipeline/profile_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/pipeline/raster_input.hpp"
#include "io/output_folder.hpp"
#include "io/plot.hpp"
#include "io/read_breaklines.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

constexpr double kNormal95 = 1.959963984540054;
constexpr double kMostPoints = 1e7;

Result<std::vector<Eigen::Vector2d>> lineOf(const ProfileRequest& request, const DemFile& dem,
                                            Progress& progress, const std::stop_token& stop) {
    if (request.line.empty() == request.path.empty()) {
        return usageError("a profile follows one line", "give --line, or --from and --to");
    }
    if (request.line.empty()) return request.path;
    const auto file = readBreaklines(request.line, progress, stop);
    if (!file) return tl::unexpected(file.error());
    if (file->lines.size() != 1) {
        return badData(fmt::format("there are {} lines in the file", file->lines.size()), request.line, 0,
                       "keep the one that the profile is to follow");
    }
    if (!file->crs.empty()) {
        const auto crs = describeCrs(file->crs);
        if (!crs) return tl::unexpected(crs.error());
        if (crs->name != dem.crs.name) {
            return badData(fmt::format("the line is in {}, the DEM in {}", crs->name, dem.crs.name),
                           request.line, 0, "bring it to the CRS of the DEM");
        }
    }
    std::vector<Eigen::Vector2d> line;
    for (const Eigen::Vector3d& vertex : file->lines.front().vertices_m) line.emplace_back(vertex.head<2>());
    return line;
}

Result<std::vector<ProfileMark>> marksAlong(const ProfileRequest& request, const DemFile& dem,
                                            const std::vector<Eigen::Vector2d>& line, Progress& progress,
                                            const std::stop_token& stop) {
    std::vector<ProfileMark> along;
    if (request.marks.empty()) return along;
    const auto marks = marksOnMap(request.marks, request.dem, dem.crs, progress, stop);
    if (!marks) return tl::unexpected(marks.error());
    const double farthest =
        request.mark_distance > 0.0 ? request.mark_distance : 2.0 * dem.grid.geometry.cell_m;
    for (const MapMark& mark : *marks) {
        const LineOffset place = offsetFrom(line, mark.map.head<2>());
        if (std::abs(place.offset) > farthest) continue;
        along.push_back({mark.mark.name, place, mark.map.z(), mark.mark.sigma_v_m});
    }
    std::stable_sort(along.begin(), along.end(), [](const ProfileMark& a, const ProfileMark& b) {
        return a.place.distance < b.place.distance;
    });
    return along;
}

std::string tableOf(const std::vector<ProfilePoint>& profile, const std::string& unit) {
    std::string csv = fmt::format("distance_{0},x_{0},y_{0},height_{0},sigma_{0}\n", unit);
    const auto field = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.4f}", *value) : std::string();
    };
    for (const ProfilePoint& p : profile) {
        csv += fmt::format("{:.4f},{:.4f},{:.4f},{},{}\n", p.distance, p.at.x(), p.at.y(), field(p.height),
                           field(p.sigma));
    }
    return csv;
}

Plot plotOf(const std::vector<ProfilePoint>& profile, const ProfileOutcome& o) {
    const double gap = std::numeric_limits<double>::quiet_NaN();
    PlotSeries heights{"Height", {}, SeriesLook::Line, 0, {}};
    PlotSeries ribbon{"95 % (1.96 sigma)", {}, SeriesLook::Ribbon, 0, {}};
    for (const ProfilePoint& p : profile) {
        heights.points.emplace_back(p.distance, p.height.value_or(gap));
        if (o.request.uncertainty.empty()) continue;
        const double half = p.height && p.sigma ? kNormal95 * *p.sigma : gap;
        ribbon.points.emplace_back(p.distance, p.height.value_or(gap) - half);
        ribbon.upper.push_back(p.height.value_or(gap) + half);
    }
    PlotPanel panel;
    panel.x.label = fmt::format("Distance ({})", o.unit);
    panel.y.label = fmt::format("Height ({})", o.unit);
    if (!ribbon.points.empty()) panel.series.push_back(std::move(ribbon));
    panel.series.push_back(std::move(heights));
    if (!o.marks.empty()) {
        PlotSeries marks{"Marks", {}, SeriesLook::Points, 1, {}};
        for (const ProfileMark& mark : o.marks) marks.points.emplace_back(mark.place.distance, mark.height);
        panel.series.push_back(std::move(marks));
    }
    return {fmt::format("Profile of {}", o.request.dem.filename().string()),
            fmt::format("{:.2f} {} long", o.length, o.unit),
            {std::move(panel)},
            1,
            {}};
}

}  // namespace

Result<ProfileOutcome> makeProfile(const ProfileRequest& request, Progress& progress, std::stop_token stop) {
    if (!(request.step >= 0.0) || !(request.mark_distance >= 0.0)) {
        return usageError("steps and distances may not be below zero");
    }
    if (request.output.extension() == ".svg") {
        return usageError("the output is the table; its drawing goes beside it as .svg", "name a .csv file");
    }
    progress.report(0.0, "reading");
    const auto dem = readDem(request.dem, stop);
    if (!dem) return tl::unexpected(dem.error());
    PartialProgress reading(progress, 0.4, 0.5);
    const auto line = lineOf(request, *dem, reading, stop);
    if (!line) return tl::unexpected(line.error());
    std::optional<ElevationGrid> sigmas;
    if (!request.uncertainty.empty()) {
        auto read = readAlike(request.uncertainty, *dem, stop);
        if (!read) return tl::unexpected(read.error());
        sigmas = std::move(*read);
    }
    ProfileOutcome outcome{request, dem->crs.unit.symbol};
    for (std::size_t i = 0; i + 1 < line->size(); ++i) outcome.length += ((*line)[i + 1] - (*line)[i]).norm();
    const double step = request.step > 0.0 ? request.step : 0.5 * dem->grid.geometry.cell_m;
    if (!(outcome.length > 0.0) || outcome.length / step > kMostPoints) {
        return usageError("the line has no length, or too many steps",
                          "name two places apart, or a longer step");
    }
    const auto profile = profileAlong(dem->grid, sigmas ? &*sigmas : nullptr, *line, step);
    std::vector<double> heights;
    for (const ProfilePoint& p : profile) {
        if (p.height) heights.push_back(*p.height);
    }
    if (heights.empty()) {
        const GridGeometry& g = dem->grid.geometry;
        return badData("the line meets no height of the DEM", request.dem, 0,
                       fmt::format("the DEM reaches from x {:.2f} to {:.2f} and y {:.2f} to {:.2f}", g.west_m,
                                   g.west_m + g.cell_m * static_cast<double>(g.columns),
                                   g.north_m - g.cell_m * static_cast<double>(g.rows), g.north_m));
    }
    outcome.points = profile.size();
    outcome.without_height = profile.size() - heights.size();
    outcome.lowest = *std::min_element(heights.begin(), heights.end());
    outcome.highest = *std::max_element(heights.begin(), heights.end());
    outcome.rise = heights.back() - heights.front();
    auto marks = marksAlong(request, *dem, *line, reading, stop);
    if (!marks) return tl::unexpected(marks.error());
    outcome.marks = std::move(*marks);
    fs::path drawing = request.output;
    drawing.replace_extension(".svg");
    outcome.files = {request.output, drawing};
    if (auto done = writeTextFile(tableOf(profile, outcome.unit), request.output); !done) {
        return tl::unexpected(done.error());
    }
    if (auto done = writeTextFile(plotSvg(plotOf(profile, outcome)), drawing); !done) {
        return tl::unexpected(done.error());
    }
    progress.report(1.0, "done");
    return outcome;
}

std::string toText(const ProfileOutcome& o) {
    std::string text = fmt::format(
        "Profile     {:.3f} {}, {} points, {} of them without a height\nHeights     {:.3f} to {:.3f} {}, "
        "from "
        "first to last {:+.3f}\n",
        o.length, o.unit, o.points, o.without_height, o.lowest, o.highest, o.unit, o.rise);
    for (const ProfileMark& mark : o.marks) {
        text += fmt::format("Mark        {} at {:.3f}, {:+.3f} off the line, height {:.3f}\n",
                            printable(mark.name), mark.place.distance, mark.place.offset, mark.height);
    }
    for (const fs::path& file : o.files) text += "Written to " + printable(file.string()) + "\n";
    return text;
}

std::string toJson(const ProfileOutcome& o) {
    nlohmann::ordered_json document{{"format", "terrawalk-profile 1"},
                                    {"dem", o.request.dem.string()},
                                    {"unit", o.unit},
                                    {"length", o.length},
                                    {"points", o.points},
                                    {"points_without_height", o.without_height},
                                    {"lowest", o.lowest},
                                    {"highest", o.highest},
                                    {"rise", o.rise},
                                    {"marks", nlohmann::ordered_json::array()},
                                    {"files", nlohmann::ordered_json::array()}};
    for (const ProfileMark& mark : o.marks) {
        document["marks"].push_back({{"name", mark.name},
                                     {"distance", mark.place.distance},
                                     {"offset", mark.place.offset},
                                     {"height", mark.height},
                                     {"sigma", mark.sigma}});
    }
    for (const fs::path& file : o.files) document["files"].push_back(file.string());
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
