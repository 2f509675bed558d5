#include "app/gui/map_scene.hpp"

#include <QPainterPath>
#include <algorithm>
#include <array>
#include <cmath>

#include "app/gui/round_numbers.hpp"
#include "app/pipeline/relief.hpp"

namespace terrawalk::gui {

namespace {

constexpr double kHalo_px = 2.5;

QString text(const std::string& utf8) {
    return QString::fromStdString(utf8);
}

const std::vector<double>& sigmas(const MapTrack& track, TrackColouring colouring) {
    return colouring == TrackColouring::SigmaPlan ? track.sigma_plan_m : track.sigma_height_m;
}

QPolygonF onScreen(const MapTrack& track, const MapTransform& transform) {
    QPolygonF line;
    for (const Eigen::Vector3d& p : track.map_m) {
        const QPointF at = transform.toScreen({p.x(), p.y()});
        // Steps that nobody sees cost time to draw.
        if (!line.isEmpty() && (at - line.last()).manhattanLength() < 0.7) continue;
        line << at;
    }
    return line;
}

void drawBySigma(QPainter& painter, const MapTrack& track, const std::vector<double>& sigmas_m,
                 double greatest_m, const MapTransform& transform, double width_px) {
    const std::vector<Colour> ramp = sequentialRamp();
    QPointF last;
    for (std::size_t i = 0; i < track.map_m.size(); ++i) {
        const QPointF at = transform.toScreen({track.map_m[i].x(), track.map_m[i].y()});
        if (i > 0 && (at - last).manhattanLength() < 0.7) continue;
        if (i > 0) {
            const Colour c = rampColour(ramp, sigmas_m[i] / greatest_m);
            painter.setPen(QPen(QColor(c[0], c[1], c[2]), width_px, Qt::SolidLine, Qt::RoundCap));
            painter.drawLine(last, at);
        }
        last = at;
    }
}

/// Text with an edge that sets it off from any ground.
void drawLabel(QPainter& painter, QPointF at, const QString& label, const QPalette& palette) {
    QPainterPath path;
    path.addText(at, painter.font(), label);
    QColor halo = palette.color(QPalette::Base);
    halo.setAlpha(220);
    painter.strokePath(path, QPen(halo, kHalo_px, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.fillPath(path, palette.color(QPalette::Text));
}

void drawSymbol(QPainter& painter, QPointF at, const ControlMark& mark, bool highlighted) {
    const double r = highlighted ? 7.0 : 5.0;
    painter.setPen(QPen(Qt::white, 1.5));
    painter.setBrush(QColor(20, 24, 28));
    if (mark.name == kZeroMark) {
        painter.drawRect(QRectF(at.x() - r, at.y() - r, 2 * r, 2 * r));
    } else if (mark.role == MarkRole::Control) {
        painter.drawPolygon(
            QPolygonF({at + QPointF(0, -1.2 * r), at + QPointF(r, 0.8 * r), at + QPointF(-r, 0.8 * r)}));
    } else {
        painter.drawEllipse(at, 0.8 * r, 0.8 * r);
    }
}

void drawVector(QPainter& painter, QPointF from, QPointF to) {
    const QPointF along = to - from;
    const double length = std::hypot(along.x(), along.y());
    if (length < 2.0) return;
    const QPointF unit = along / length, side(-unit.y(), unit.x());
    const QColor red(200, 30, 60);
    painter.setPen(QPen(Qt::white, 4.5, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(from, to);
    painter.setPen(QPen(red, 2.0, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(from, to);
    if (length < 8.0) return;
    painter.setBrush(red);
    painter.setPen(Qt::NoPen);
    painter.drawPolygon(QPolygonF({to + unit * 3, to - unit * 5 + side * 4, to - unit * 5 - side * 4}));
}

}  // namespace

QRectF MapScene::extent_m() const {
    QRectF extent;
    const auto add = [&](double x, double y) {
        const QRectF point(x - 0.5, y - 0.5, 1.0, 1.0);
        extent = extent.isNull() ? point : extent.united(point);
    };
    if (survey) {
        for (const MapTrack& track : survey->tracks) {
            for (const Eigen::Vector3d& p : track.map_m) add(p.x(), p.y());
        }
        for (const PlacedMark& mark : survey->marks) add(mark.map_m.x(), mark.map_m.y());
    }
    if (products && products->dem.geometry.size() > 0) {
        const QRectF dem = extentOf(products->dem.geometry);
        extent = extent.isNull() ? dem : extent.united(dem);
    }
    return extent;
}

QColor runColour(std::size_t index) {
    static const std::array<QColor, 7> colours{QColor(0, 90, 160), QColor(213, 94, 0), QColor(150, 60, 130),
                                               QColor(0, 128, 96), QColor(90, 50, 20), QColor(190, 40, 60),
                                               QColor(60, 60, 60)};
    return colours[index % colours.size()];
}

double greatestSigma(const MapScene& scene) {
    std::vector<double> all;
    if (!scene.survey || scene.colouring == TrackColouring::Run) return 0.0;
    for (const MapTrack& track : scene.survey->tracks) {
        const auto& own = sigmas(track, scene.colouring);
        all.insert(all.end(), own.begin(), own.end());
    }
    if (all.empty()) return 0.0;
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(all.size() - 1));
    std::nth_element(all.begin(), at, all.end());
    return *at;
}

double vectorScale(const MapScene& scene, const MapTransform& transform) {
    double longest_m = 0.0;
    if (scene.survey) {
        for (const PlacedMark& mark : scene.survey->marks) {
            if (mark.array_map_m) {
                longest_m = std::max(longest_m, (*mark.array_map_m - mark.map_m.head<2>()).norm());
            }
        }
    }
    if (longest_m <= 0.0) return 0.0;
    constexpr double kLongest_px = 60.0;
    return std::max(1.0, roundBelow(kLongest_px / (longest_m * transform.pixels_per_m)));
}

void drawTracks(QPainter& painter, const MapScene& scene, const MapTransform& transform) {
    if (!scene.survey) return;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    const double greatest_m = greatestSigma(scene);
    for (std::size_t i = 0; i < scene.survey->tracks.size(); ++i) {
        const MapTrack& track = scene.survey->tracks[i];
        const QString id = text(track.run_id);
        if (scene.hidden_runs.contains(id)) continue;
        const double width_px = scene.highlighted == id ? 4.0 : 1.8;
        const auto& own = sigmas(track, scene.colouring);
        const QPolygonF line = onScreen(track, transform);
        painter.setPen(
            QPen(QColor(255, 255, 255, 150), width_px + 1.6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        painter.drawPolyline(line);
        if (greatest_m > 0.0 && own.size() == track.map_m.size()) {
            drawBySigma(painter, track, own, greatest_m, transform, width_px + 0.7);
            continue;
        }
        painter.setPen(QPen(runColour(i), width_px, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        painter.drawPolyline(line);
    }
}

void drawMarks(QPainter& painter, const MapScene& scene, const MapTransform& transform,
               const QPalette& palette) {
    if (!scene.survey) return;
    painter.setRenderHint(QPainter::Antialiasing);
    const double scale = vectorScale(scene, transform);
    for (const PlacedMark& placed : scene.survey->marks) {
        const QString name = text(placed.mark.name);
        if (scene.hidden_marks.contains(name)) continue;
        const QPointF at = transform.toScreen({placed.map_m.x(), placed.map_m.y()});
        if (placed.array_map_m) {
            const Eigen::Vector2d off_px =
                (*placed.array_map_m - placed.map_m.head<2>()) * (scale * transform.pixels_per_m);
            drawVector(painter, at, at + QPointF(off_px.x(), -off_px.y()));
        }
        drawSymbol(painter, at, placed.mark, scene.highlighted == name);
    }
    // Names last, and only where they do not lie on one another.
    QList<QRectF> taken;
    for (const PlacedMark& placed : scene.survey->marks) {
        const QString name = text(placed.mark.name);
        if (scene.hidden_marks.contains(name)) continue;
        const QPointF at = transform.toScreen({placed.map_m.x(), placed.map_m.y()}) + QPointF(8, -6);
        const QRectF box(
            at - QPointF(0, painter.fontMetrics().ascent()),
            QSizeF(painter.fontMetrics().horizontalAdvance(name), painter.fontMetrics().height()));
        const bool free = std::none_of(taken.begin(), taken.end(),
                                       [&](const QRectF& other) { return other.intersects(box); });
        if (!free && scene.highlighted != name) continue;
        taken << box;
        drawLabel(painter, at, name, palette);
    }
}

void drawTerraceEdges(QPainter& painter, const MapScene& scene, const MapTransform& transform) {
    if (!scene.products || !scene.show_edges) return;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    for (const auto& edge : scene.products->terrace_edges) {
        for (const auto* vertices : {&edge.toe_m, &edge.top_m}) {
            QPolygonF line;
            for (const Eigen::Vector3d& p : *vertices) line << transform.toScreen({p.x(), p.y()});
            const bool top = vertices == &edge.top_m;
            painter.setPen(QPen(QColor(70, 35, 20), top ? 1.8 : 1.0, top ? Qt::SolidLine : Qt::DashLine));
            painter.drawPolyline(line);
        }
    }
}

}  // namespace terrawalk::gui
