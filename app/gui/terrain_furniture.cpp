#include "app/gui/terrain_furniture.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "app/gui/figures.hpp"
#include "app/gui/map_furniture.hpp"
#include "app/gui/round_numbers.hpp"
#include "app/gui/terrain_overlay.hpp"

namespace terrawalk::gui {

namespace {

constexpr double kMargin_px = 16.0;
constexpr double kCompass_px = 56.0;
constexpr double kPinHeight_px = 22.0;

std::optional<QPointF> onScreen(const TerrainFrame& frame, const Eigen::Vector3d& map_m) {
    const auto seen = frame.camera.project(frame.scene->toScene(map_m, frame.exaggeration));
    if (!seen) return std::nullopt;
    return QPointF(seen->x(), seen->y());
}

/// Numbers along one edge of the floor, outside of it, as many as have room. Returns where they stand.
std::vector<QRectF> drawEdgeNumbers(QPainter& painter, const TerrainFrame& frame, const QPalette& palette,
                                    bool eastings, const FloorGrid& grid) {
    const Eigen::Vector3d eye = frame.scene->toMap(frame.camera.eye_m(), frame.exaggeration);
    const double floor_m = frame.scene->origin_map_m().z();
    const double middle_x = (grid.west_m + grid.east_m) / 2.0, middle_y = (grid.south_m + grid.north_m) / 2.0;
    const double edge = eastings ? (eye.y() < middle_y ? grid.south_m : grid.north_m)
                                 : (eye.x() < middle_x ? grid.west_m : grid.east_m);
    const double from = eastings ? grid.west_m : grid.south_m, to = eastings ? grid.east_m : grid.north_m;
    const auto place = [&](double at, double beyond) {
        const double out = edge + (edge > (eastings ? middle_y : middle_x) ? beyond : -beyond);
        return onScreen(frame,
                        eastings ? Eigen::Vector3d(at, out, floor_m) : Eigen::Vector3d(out, at, floor_m));
    };
    const QFontMetricsF metrics(painter.font());
    std::vector<QRectF> taken;
    for (const double at : wholeSteps(from, to, grid.step_m)) {
        const auto foot = place(at, 0.0), beyond = place(at, grid.step_m * 0.2);
        if (!foot || !beyond) continue;
        QPointF away = *beyond - *foot;
        const double length = std::hypot(away.x(), away.y());
        if (length < 0.5) continue;
        away /= length;
        const QString text = (eastings ? "E " : "N ") + QString::number(at, 'f', grid.step_m < 1.0 ? 1 : 0);
        const double wide = metrics.horizontalAdvance(text), high = metrics.ascent();
        const QPointF middle = *foot + QPointF(away.x() * (8.0 + wide / 2.0), away.y() * (8.0 + high / 2.0));
        const QRectF box(middle.x() - wide / 2.0 - 6.0, middle.y() - high / 2.0 - 2.0, wide + 12.0,
                         high + 4.0);
        const bool free = std::none_of(taken.begin(), taken.end(),
                                       [&](const QRectF& other) { return other.intersects(box); });
        if (!free) continue;
        taken.push_back(box);
        drawLabel(painter, QPointF(middle.x() - wide / 2.0, middle.y() + high / 2.0 - 1.0), text, palette);
    }
    return taken;
}

/// At the corner of the floor that stands farthest to the left, where nothing can hide it.
void drawHeights(QPainter& painter, const TerrainFrame& frame, const QPalette& palette,
                 const FloorGrid& grid) {
    const double floor_m = frame.scene->origin_map_m().z(), top_m = frame.scene->highest_m();
    std::optional<Eigen::Vector3d> corner;
    double leftmost_px = HUGE_VAL;
    for (const double x : {grid.west_m, grid.east_m}) {
        for (const double y : {grid.south_m, grid.north_m}) {
            const auto seen = onScreen(frame, {x, y, floor_m});
            if (!seen || seen->x() >= leftmost_px) continue;
            leftmost_px = seen->x();
            corner = Eigen::Vector3d(x, y, floor_m);
        }
    }
    if (!corner) return;
    const auto at = [&](double height_m) {
        return onScreen(frame, {corner->x(), corner->y(), height_m});
    };
    const auto foot = at(floor_m), head = at(top_m);
    if (!foot || !head || std::hypot(head->x() - foot->x(), head->y() - foot->y()) < 30.0) return;
    painter.setPen(QPen(palette.color(QPalette::Text), 1.0));
    painter.drawLine(*foot, *head);
    const QFontMetricsF metrics(painter.font());
    const double length_px = std::hypot(head->x() - foot->x(), head->y() - foot->y());
    const double tick_m =
        std::max(roundLengthBelow((top_m - floor_m) / std::max(1.0, length_px / 28.0) * 1.5), 0.01);
    for (const double h : wholeSteps(floor_m, top_m, tick_m)) {
        const auto tick = at(h);
        if (!tick) continue;
        painter.setPen(QPen(palette.color(QPalette::Text), 1.0));
        painter.drawLine(*tick, *tick - QPointF(5, 0));
        const QString text = lengthText(h, inUnit(tick_m) < 1.0 - 1e-9 ? 1 : 0);
        drawLabel(painter, *tick - QPointF(9.0 + metrics.horizontalAdvance(text), -metrics.ascent() * 0.4),
                  text, palette);
    }
}

bool hidden(const TerrainFrame& frame, const Eigen::Vector3d& scene_m) {
    const Eigen::Vector3d eye = frame.camera.eye_m(), way = scene_m - eye;
    const double slack_m = std::max(0.01 * frame.camera.radius_m, 0.5);
    const auto hit = frame.scene->firstHit({eye, way.normalized()}, frame.exaggeration, slack_m / 4.0);
    return hit && (*hit - eye).norm() < way.norm() - slack_m;
}

void drawCompass(QPainter& painter, const TerrainFrame& frame, QPointF middle, const QPalette& palette) {
    const double r = kCompass_px / 2.0;
    drawPanel(painter, QRectF(middle.x() - r, middle.y() - r, 2 * r, 2 * r), palette);
    // The plane of the ground as it is seen: east and north as directions on the screen.
    const Eigen::Vector3d right = frame.camera.right(), up = frame.camera.up();
    const QPointF east(right.x(), -up.x()), north(right.y(), -up.y());
    const double arm = r * 0.56;
    const auto at = [&](double e, double n) {
        return middle + (east * e + north * n) * arm;
    };
    painter.setPen(QPen(palette.color(QPalette::Text), 1.0));
    painter.setBrush(palette.color(QPalette::Text));
    painter.drawPolygon(QPolygonF({at(0, 1), at(-0.32, -0.7), at(0, -0.4)}));
    painter.setBrush(palette.color(QPalette::Base));
    painter.drawPolygon(QPolygonF({at(0, 1), at(0.32, -0.7), at(0, -0.4)}));
    const QPointF tip =
        middle + north * (r * 0.56) + north / std::max(std::hypot(north.x(), north.y()), 1e-9) * 8.0;
    QFont bold = painter.font();
    bold.setBold(true);
    painter.save();
    painter.setFont(bold);
    painter.drawText(QRectF(tip.x() - 10, tip.y() - 10, 20, 20), Qt::AlignCenter, "N");
    painter.restore();
}

QPointF compassMiddle(const TerrainFrame& frame) {
    return {frame.camera.viewport_px.x() - kMargin_px - kCompass_px / 2.0, kMargin_px + kCompass_px / 2.0};
}

QPointF legendCorner(const TerrainFrame& frame) {
    return {frame.camera.viewport_px.x() - kMargin_px, kMargin_px + kCompass_px + 8.0};
}

QString noteText(const TerrainFrame& frame) {
    QString note = exaggerationText(frame.exaggeration);
    note = note.isEmpty() ? QCoreApplication::translate("TerrainFurniture", "Heights as they are")
                          : QCoreApplication::translate("TerrainFurniture", "Heights %1").arg(note);
    if (frame.contour_interval_m > 0.0) {
        note += QCoreApplication::translate("TerrainFurniture", ", contours every %1")
                    .arg(shortLength(frame.contour_interval_m));
    }
    return note;
}

QRectF noteBox(const QFontMetricsF& metrics, const TerrainFrame& frame) {
    const double height = metrics.height() + 8.0;
    return {kMargin_px, frame.camera.viewport_px.y() - kMargin_px - height,
            metrics.horizontalAdvance(noteText(frame)) + 16.0, height};
}

void drawNote(QPainter& painter, const TerrainFrame& frame, const QPalette& palette) {
    const QRectF box = noteBox(QFontMetricsF(painter.font()), frame);
    drawPanel(painter, box, palette);
    painter.setPen(palette.color(QPalette::Text));
    painter.drawText(box, Qt::AlignCenter, noteText(frame));
}

}  // namespace

double pinHeight(const TerrainFrame& frame) {
    return kPinHeight_px * std::cos(frame.camera.elevation_rad);
}

QString exaggerationText(double exaggeration) {
    if (std::abs(exaggeration - 1.0) < 1e-9) return {};
    return QString::fromUtf8("× ") + QString::number(exaggeration, 'g', 3);
}

std::vector<QRectF> drawAxes(QPainter& painter, const TerrainFrame& frame, const QPalette& palette) {
    painter.setRenderHint(QPainter::Antialiasing);
    const FloorGrid grid = floorGrid(*frame.scene);
    std::vector<QRectF> boxes = drawEdgeNumbers(painter, frame, palette, true, grid);
    for (const QRectF& box : drawEdgeNumbers(painter, frame, palette, false, grid)) boxes.push_back(box);
    drawHeights(painter, frame, palette, grid);
    return boxes;
}

void drawPins(QPainter& painter, const TerrainFrame& frame, const MapScene& map, std::vector<QRectF> reserved,
              const QPalette& palette) {
    if (!map.survey) return;
    painter.setRenderHint(QPainter::Antialiasing);
    std::vector<MarkName> names;
    for (const PlacedMark& placed : map.survey->marks) {
        const QString name = QString::fromStdString(placed.mark.name);
        if (map.shown.hidden_marks.contains(name)) continue;
        const auto foot = onScreen(frame, placed.map_m);
        if (!foot) continue;
        const bool highlighted = map.highlighted == name;
        const Eigen::Vector3d at_m = frame.scene->toScene(placed.map_m, frame.exaggeration);
        painter.setOpacity(!frame.moving && !highlighted && hidden(frame, at_m) ? 0.3 : 1.0);
        const QPointF head = *foot - QPointF(0, pinHeight(frame));
        painter.setPen(QPen(QColor(255, 255, 255, 180), 3.0));
        painter.drawLine(*foot, head);
        painter.setPen(QPen(QColor(20, 24, 28), 1.4));
        painter.drawLine(*foot, head);
        drawMarkSymbol(painter, head, placed.mark, highlighted, highlighted ? selectedColour() : kMarkInk);
        names.push_back({head, name, highlighted, pinHeight(frame), painter.opacity()});
    }
    painter.setOpacity(1.0);
    const QFontMetricsF metrics(painter.font());
    for (const QRectF& box : terrainFurnitureBoxes(metrics, frame, map)) reserved.push_back(box);
    const Eigen::Vector2d size_px = frame.camera.viewport_px;
    // Lines that jump about while the ground turns would only distract.
    const NameRoom room{{0.0, 0.0, size_px.x(), size_px.y()}, std::move(reserved), !frame.moving};
    drawMarkNames(painter, placeMarkNames(metrics, std::move(names), room), palette);
}

void drawPick(QPainter& painter, const TerrainFrame& frame, const Eigen::Vector3d& map_m) {
    const auto at = onScreen(frame, map_m);
    if (!at) return;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    for (const auto& [colour, width] :
         {std::pair{QColor(Qt::white), 4.0}, std::pair{QColor(20, 24, 28), 2.0}}) {
        painter.setPen(QPen(colour, width));
        painter.drawEllipse(*at, 7.0, 7.0);
    }
    painter.setBrush(selectedColour());
    painter.setPen(Qt::NoPen);
    painter.drawEllipse(*at, 2.5, 2.5);
}

void drawTerrainFurniture(QPainter& painter, const TerrainFrame& frame, const MapScene& map,
                          const QPalette& palette) {
    painter.setRenderHint(QPainter::Antialiasing);
    drawCompass(painter, frame, compassMiddle(frame), palette);
    drawLegends(painter, map, legendCorner(frame), palette);
    drawNote(painter, frame, palette);
}

std::vector<QRectF> terrainFurnitureBoxes(const QFontMetricsF& metrics, const TerrainFrame& frame,
                                          const MapScene& map) {
    std::vector<QRectF> boxes = legendBoxes(metrics, map, legendCorner(frame));
    const QPointF middle = compassMiddle(frame);
    boxes.emplace_back(middle.x() - kCompass_px / 2.0, middle.y() - kCompass_px / 2.0, kCompass_px,
                       kCompass_px);
    boxes.push_back(noteBox(metrics, frame));
    return boxes;
}

}  // namespace terrawalk::gui
