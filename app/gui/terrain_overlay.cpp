#include "app/gui/terrain_overlay.hpp"

#include <algorithm>
#include <cmath>

#include "app/gui/round_numbers.hpp"
#include "app/gui/theme.hpp"
#include "app/pipeline/relief.hpp"

namespace terrawalk::gui {

namespace {

// Steps that nobody sees cost time to draw: of the scene's radius.
constexpr double kSmallestStep = 1.0 / 2500.0;
constexpr std::size_t kMostDots = 200'000;
constexpr double kFloorLines = 5.0;
constexpr double kFloorBeyond = 0.08;  ///< of the survey's half size

Eigen::Vector3f inScene(const TerrainScene& scene, const Eigen::Vector3d& map_m) {
    return scene.toScene(map_m, 1.0).cast<float>();
}

/// The part of a track between two times, laid on the surface; where there is none the line breaks.
template <class Ink>
void layTrack(const TerrainScene& scene, const MapTrack& track, double from_s, double to_s, const Ink& ink,
              SceneLine style, std::vector<SceneLine>& lines) {
    const double step_m = scene.halfSize_m().head<2>().norm() * kSmallestStep;
    SceneLine line = style;
    Eigen::Vector2d last = Eigen::Vector2d::Constant(HUGE_VAL);
    const auto finish = [&] {
        if (line.at_m.size() > 1) lines.push_back(std::move(line));
        line = style;
        last.setConstant(HUGE_VAL);
    };
    for (std::size_t i = 0; i < track.map_m.size(); ++i) {
        if (track.time_s[i] < from_s || track.time_s[i] > to_s) continue;
        const Eigen::Vector2d at = track.map_m[i].head<2>();
        if ((at - last).norm() < step_m) continue;
        const auto height_m = scene.heightAt(at.x(), at.y());
        if (!height_m) {
            finish();
            continue;
        }
        line.at_m.push_back(inScene(scene, {at.x(), at.y(), *height_m}));
        line.colours.push_back(ink(i));
        last = at;
    }
    finish();
}

void addTracks(const TerrainScene& scene, const MapScene& map, std::vector<SceneLine>& lines) {
    for (std::size_t i = 0; i < map.survey->tracks.size(); ++i) {
        const MapTrack& track = map.survey->tracks[i];
        const QString id = QString::fromStdString(track.run_id);
        if (map.shown.hidden_runs.contains(id)) continue;
        const TrackInk ink = trackInk(map, i);
        SceneLine style;
        style.width_px = map.highlighted == id ? 3.5F : 1.8F;
        style.edge = qRgba(255, 255, 255, 255);
        if (map.shown.tracks) {
            layTrack(scene, track, -HUGE_VAL, HUGE_VAL, ink, style, lines);
        }
        for (const ExcludedStretch& out : map.shown.edits->stretches) {
            if (out.run != track.run_id) continue;
            SceneLine left_out;
            left_out.width_px = 3.0F;
            left_out.edge = qRgba(255, 255, 255, 255);
            layTrack(
                scene, track, out.from_s, out.to_s, [](std::size_t) { return kExcludedInk.rgb(); }, left_out,
                lines);
        }
        for (const TrackStretch& selected : map.stretches) {
            if (selected.run != id) continue;
            const QRgb bright = selectedColour().rgb();
            style.width_px = 5.0F;
            style.edge = qRgba(30, 30, 30, 255);
            layTrack(
                scene, track, selected.from_s, selected.to_s, [&](std::size_t) { return bright; }, style,
                lines);
        }
    }
}

/// A polyline of the map, laid on the surface; where there is none it breaks.
void layLine(const TerrainScene& scene, const std::vector<Eigen::Vector3d>& vertices_m, bool closed,
             const SceneLine& style, QRgb colour, std::vector<SceneLine>& lines) {
    const double step_m = scene.products().dem.geometry.cell_m;
    SceneLine line = style;
    const auto add = [&](const Eigen::Vector2d& at) {
        const auto height_m = scene.heightAt(at.x(), at.y());
        if (height_m) {
            line.at_m.push_back(inScene(scene, {at.x(), at.y(), *height_m}));
            line.colours.push_back(colour);
            return;
        }
        if (line.at_m.size() > 1) lines.push_back(std::move(line));
        line = style;
    };
    const std::size_t n = vertices_m.size(), ends = closed && n > 2 ? n : n - 1;
    for (std::size_t i = 0; n > 1 && i < ends; ++i) {
        const Eigen::Vector2d from = vertices_m[i].head<2>(), to = vertices_m[(i + 1) % n].head<2>();
        const auto steps = std::clamp(std::ceil((to - from).norm() / step_m), 1.0, 2000.0);
        for (double k = i == 0 ? 0.0 : 1.0; k <= steps; ++k) add(from + (to - from) * (k / steps));
    }
    if (line.at_m.size() > 1) lines.push_back(std::move(line));
}

void addEdges(const TerrainScene& scene, std::vector<SceneLine>& lines) {
    for (const TerraceEdge& edge : scene.products().terrace_edges) {
        for (const auto* vertices : {&edge.toe_m, &edge.top_m}) {
            SceneLine style;
            style.width_px = vertices == &edge.top_m ? 1.8F : 1.0F;
            layLine(scene, *vertices, false, style, kEdgeInk.rgb(), lines);
        }
    }
}

void addDrawnLines(const TerrainScene& scene, const SurveyEdits& edits, std::vector<SceneLine>& lines) {
    for (const Breakline& drawn : edits.lines) {
        const bool ring = drawn.kind == BreaklineKind::Boundary || drawn.kind == BreaklineKind::Hole;
        SceneLine style;
        style.width_px = 2.4F;
        style.edge = qRgba(255, 255, 255, 255);
        layLine(scene, drawn.vertices_m, ring, style, lineColour(drawn.kind).rgb(), lines);
    }
}

void addFloor(const TerrainScene& scene, const QPalette& palette, std::vector<SceneLine>& lines) {
    const FloorGrid grid = floorGrid(scene);
    const QRgb ink = palette.color(QPalette::Mid).rgb();
    const double floor_m = scene.origin_map_m().z();
    const auto add = [&](double x0, double y0, double x1, double y1) {
        SceneLine line;
        line.on_ground = false;
        // In parts, so that one that passes behind the eye is not lost as a whole.
        constexpr int kParts = 24;
        for (int i = 0; i <= kParts; ++i) {
            const double share = static_cast<double>(i) / kParts;
            line.at_m.push_back(inScene(scene, {x0 + share * (x1 - x0), y0 + share * (y1 - y0), floor_m}));
            line.colours.push_back(ink);
        }
        lines.push_back(std::move(line));
    };
    for (const double x : wholeSteps(grid.west_m, grid.east_m, grid.step_m)) {
        add(x, grid.south_m, x, grid.north_m);
    }
    for (const double y : wholeSteps(grid.south_m, grid.north_m, grid.step_m)) {
        add(grid.west_m, y, grid.east_m, y);
    }
    add(grid.west_m, grid.south_m, grid.east_m, grid.south_m);
    add(grid.west_m, grid.north_m, grid.east_m, grid.north_m);
    add(grid.west_m, grid.south_m, grid.west_m, grid.north_m);
    add(grid.east_m, grid.south_m, grid.east_m, grid.north_m);
}

}  // namespace

QColor selectedColour() {
    return {255, 214, 10};
}

std::vector<double> wholeSteps(double from, double to, double step) {
    std::vector<double> list;
    for (double at = std::ceil(from / step) * step; at <= to; at += step) list.push_back(at);
    return list;
}

FloorGrid floorGrid(const TerrainScene& scene) {
    const Eigen::Vector2d half = scene.halfSize_m().head<2>(), middle = scene.origin_map_m().head<2>();
    FloorGrid grid;
    grid.step_m = roundBelow(2.0 * std::max(half.maxCoeff(), 0.5) / kFloorLines * 1.3);
    const double beyond_m = kFloorBeyond * half.maxCoeff();
    grid.west_m = middle.x() - half.x() - beyond_m;
    grid.east_m = middle.x() + half.x() + beyond_m;
    grid.south_m = middle.y() - half.y() - beyond_m;
    grid.north_m = middle.y() + half.y() + beyond_m;
    return grid;
}

SceneOverlay sceneOverlay(const TerrainScene& scene, const MapScene& map,
                          const std::vector<Eigen::Vector3d>& points_map_m, const QPalette& palette) {
    SceneOverlay overlay;
    addFloor(scene, palette, overlay.lines);
    if (map.shown.edges) addEdges(scene, overlay.lines);
    if (map.survey) addTracks(scene, map, overlay.lines);
    addDrawnLines(scene, *map.shown.edits, overlay.lines);
    if (!map.shown.points) return overlay;
    const auto& points = scene.products().ground_points;
    const std::size_t step = 1 + points_map_m.size() / kMostDots;
    for (std::size_t i = 0; i < points_map_m.size(); i += step) {
        if (!points_map_m[i].allFinite()) continue;
        if (map.survey && points[i].run < map.survey->tracks.size() &&
            map.shown.hidden_runs.contains(
                QString::fromStdString(map.survey->tracks[points[i].run].run_id))) {
            continue;
        }
        overlay.dots.push_back({inScene(scene, points_map_m[i]), pointColour(points[i].state)});
    }
    return overlay;
}

}  // namespace terrawalk::gui
