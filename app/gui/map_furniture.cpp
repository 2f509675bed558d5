#include "app/gui/map_furniture.hpp"

#include <QCoreApplication>
#include <QLinearGradient>
#include <QPainterPath>
#include <cmath>
#include <vector>

#include "app/gui/figures.hpp"
#include "app/gui/round_numbers.hpp"
#include "app/pipeline/relief.hpp"

namespace terrawalk::gui {

namespace {

constexpr double kMargin_px = 16.0;
constexpr double kPadding_px = 8.0;
constexpr double kRampHeight_px = 96.0;
constexpr double kRampWidth_px = 16.0;

QRectF scaleBarBox(const QFontMetricsF& metrics, const MapTransform& transform) {
    const double length_m = roundLengthBelow(140.0 / transform.pixels_per_m);
    const double height = metrics.height() + 8 + 2 * kPadding_px - 2;
    const double width = length_m * transform.pixels_per_m +
                         metrics.horizontalAdvance(shortLength(length_m)) / 2 + 12 + 2 * kPadding_px;
    return {kMargin_px, transform.size_px.height() - kMargin_px - height, width, height};
}

void drawScaleBar(QPainter& painter, const MapTransform& transform, const QPalette& palette) {
    const double length_m = roundLengthBelow(140.0 / transform.pixels_per_m);
    const double length_px = length_m * transform.pixels_per_m;
    const QFontMetricsF metrics(painter.font());
    const QString label = shortLength(length_m);
    const QRectF box = scaleBarBox(metrics, transform);
    drawPanel(painter, box, palette);
    const double left = box.left() + kPadding_px + 4, top = box.bottom() - kPadding_px - 6;
    painter.setPen(QPen(palette.color(QPalette::Text), 1.0));
    for (int part = 0; part < 2; ++part) {
        painter.setBrush(part == 0 ? palette.color(QPalette::Text) : palette.color(QPalette::Base));
        painter.drawRect(QRectF(left + part * length_px / 2, top, length_px / 2, 5));
    }
    const double base = top - 4;
    painter.drawText(QPointF(left - 2, base), "0");
    painter.drawText(QPointF(left + length_px - metrics.horizontalAdvance(label) / 2, base), label);
}

QRectF northArrowBox(const MapTransform& transform) {
    return {transform.size_px.width() - kMargin_px - 40, kMargin_px, 40, 56};
}

QPointF legendCorner(const MapTransform& transform) {
    return {transform.size_px.width() - kMargin_px, northArrowBox(transform).bottom() + 8};
}

void drawNorthArrow(QPainter& painter, const MapTransform& transform, const QPalette& palette) {
    const QRectF box = northArrowBox(transform);
    drawPanel(painter, box, palette);
    const QPointF tip(box.center().x(), box.top() + 7), foot(box.center().x(), tip.y() + 18);
    painter.setPen(QPen(palette.color(QPalette::Text), 1.0));
    painter.setBrush(palette.color(QPalette::Text));
    painter.drawPolygon(QPolygonF({tip, foot + QPointF(-7, 6), foot}));
    painter.setBrush(palette.color(QPalette::Base));
    painter.drawPolygon(QPolygonF({tip, foot + QPointF(7, 6), foot}));
    painter.drawText(QRectF(box.left(), box.bottom() - 24, box.width(), 20), Qt::AlignCenter, "N");
}

struct LegendPart {
    QString title;
    RasterLegend legend;
};

QString value(double given, double range) {
    return number(given, range < 1.0 ? 2 : range < 100.0 ? 1 : 0);
}

/// Rasters and tracks are in metres; their legends are in what a person chose.
RasterLegend inChosenUnit(RasterLegend legend) {
    if (legend.unit != "m" && legend.unit != "m/s") return legend;
    legend.unit = legend.unit == "m" ? lengthUnit() : speedUnit();
    legend.low = inUnit(legend.low);
    legend.high = inUnit(legend.high);
    return legend;
}

QString titleOf(RasterLayer layer) {
    switch (layer) {
        case RasterLayer::Height:
            return QCoreApplication::translate("MapFurniture", "Height");
        case RasterLayer::Uncertainty:
            return QCoreApplication::translate("MapFurniture", "Height, 1 σ");
        case RasterLayer::Density:
            return QCoreApplication::translate("MapFurniture", "Density");
        case RasterLayer::Source:
            return QCoreApplication::translate("MapFurniture", "Source");
        case RasterLayer::Change:
            return QCoreApplication::translate("MapFurniture", "Change of height");
        case RasterLayer::None:
            break;
    }
    return {};
}

QString titleOf(TrackColouring colouring) {
    switch (colouring) {
        case TrackColouring::Speed:
            return QCoreApplication::translate("MapFurniture", "Track, speed");
        case TrackColouring::Height:
            return QCoreApplication::translate("MapFurniture", "Track, height");
        case TrackColouring::SigmaPlan:
            return QCoreApplication::translate("MapFurniture", "Track, plan 1 σ");
        case TrackColouring::SigmaHeight:
            return QCoreApplication::translate("MapFurniture", "Track, height 1 σ");
        case TrackColouring::Residual:
            return QCoreApplication::translate("MapFurniture", "Track, residual");
        case TrackColouring::Run:
        case TrackColouring::Fix:
            break;
    }
    return {};
}

LegendPart classesPart(const QString& title, const std::vector<std::pair<QString, QColor>>& classes) {
    LegendPart part{title, {}};
    for (const auto& [name, colour] : classes) {
        part.legend.classes << name;
        part.legend.ramp.push_back(colour);
    }
    return part;
}

QString unitOf(TrackColouring colouring) {
    return colouring == TrackColouring::Speed ? "m/s" : colouring == TrackColouring::Residual ? "σ" : "m";
}

std::vector<LegendPart> legendParts(const MapScene& scene) {
    std::vector<LegendPart> parts;
    if (scene.raster && !scene.raster->levels.empty()) {
        parts.push_back({titleOf(scene.raster->layer), inChosenUnit(scene.raster->legend)});
    }
    if (const auto classes = pointClasses(scene); !classes.empty()) {
        parts.push_back(classesPart(QCoreApplication::translate("MapFurniture", "Ground points"), classes));
    }
    if (!scene.shown.tracks) return parts;
    if (const auto classes = fixClasses(scene); !classes.empty()) {
        parts.push_back(classesPart(QCoreApplication::translate("MapFurniture", "GNSS fix"), classes));
    }
    if (const auto range = trackRange(scene)) {
        std::vector<QColor> ramp;
        for (const Colour& c : sequentialRamp()) ramp.emplace_back(c[0], c[1], c[2]);
        RasterLegend legend;
        legend.ramp = std::move(ramp);
        legend.low = range->low;
        legend.high = range->high;
        legend.open_above = scene.shown.colouring != TrackColouring::Height;
        legend.unit = unitOf(scene.shown.colouring);
        parts.push_back({titleOf(scene.shown.colouring), inChosenUnit(std::move(legend))});
    }
    return parts;
}

double heightOf(const LegendPart& part, double line_px) {
    const double body = part.legend.classes.isEmpty()
                            ? kRampHeight_px + line_px * 0.6
                            : (line_px + 4) * static_cast<double>(part.legend.classes.size());
    return line_px + 8 + body +
           (part.legend.notes.isEmpty() ? 0.0
                                        : line_px * (0.3 + static_cast<double>(part.legend.notes.size()))) +
           2 * kPadding_px;
}

double widthOf(const LegendPart& part, const QFontMetricsF& metrics) {
    double width = metrics.horizontalAdvance(part.title + " (" + part.legend.unit + ")");
    for (const QString& note : part.legend.notes) width = std::max(width, metrics.horizontalAdvance(note));
    for (const QString& c : part.legend.classes) {
        width = std::max(width, metrics.horizontalAdvance(c) + kRampWidth_px + 8);
    }
    return std::max(width + 2 * kPadding_px, 96.0);
}

void drawLegend(QPainter& painter, const LegendPart& part, const QRectF& box, const QPalette& palette) {
    drawPanel(painter, box, palette);
    const QFontMetricsF metrics(painter.font());
    const double left = box.left() + kPadding_px;
    double y = box.top() + kPadding_px + metrics.ascent();
    painter.setPen(palette.color(QPalette::Text));
    const QString unit = part.legend.unit.isEmpty() ? QString() : " (" + part.legend.unit + ")";
    painter.drawText(QPointF(left, y), part.title + unit);
    y += 8;
    if (!part.legend.classes.isEmpty()) {
        for (qsizetype i = 0; i < part.legend.classes.size(); ++i) {
            const QRectF patch(left, y + 2, kRampWidth_px, metrics.height() - 2);
            painter.fillRect(patch, part.legend.ramp[static_cast<std::size_t>(i)]);
            painter.drawText(QPointF(left + kRampWidth_px + 8, y + metrics.ascent()), part.legend.classes[i]);
            y += metrics.height() + 4;
        }
        return;
    }
    const QRectF bar(left, y + metrics.height() * 0.3, kRampWidth_px, kRampHeight_px);
    QLinearGradient gradient(bar.bottomLeft(), bar.topLeft());
    const auto& ramp = part.legend.ramp;
    for (std::size_t i = 0; i < ramp.size(); ++i) {
        gradient.setColorAt(static_cast<double>(i) / static_cast<double>(ramp.size() - 1), ramp[i]);
    }
    painter.fillRect(bar, gradient);
    const double range = part.legend.high - part.legend.low;
    for (int tick = 0; tick <= 4; ++tick) {
        const double share = tick / 4.0, at = bar.bottom() - share * bar.height();
        painter.setPen(palette.color(QPalette::Text));
        painter.drawLine(QPointF(bar.right(), at), QPointF(bar.right() + 4, at));
        const QString sign = tick == 4 && part.legend.open_above   ? "≥ "
                             : tick == 0 && part.legend.open_below ? "≤ "
                                                                   : "";
        painter.drawText(QPointF(bar.right() + 8, at + metrics.ascent() * 0.4),
                         sign + value(part.legend.low + share * range, range));
    }
    y = bar.bottom() + metrics.height() * 0.6;
    for (const QString& note : part.legend.notes) {
        y += metrics.height();
        painter.drawText(QPointF(left, y), note);
    }
}

/// How much longer errors are drawn than they are; nothing where none is.
QString vectorNote(const MapScene& scene, const MapTransform& transform) {
    const double scale = vectorScale(scene, transform);
    if (scale <= 0.0 || !scene.shown.marks) return {};
    return QCoreApplication::translate("MapFurniture", "errors at marks %1 times as long")
        .arg(QString::number(scale, 'g', 3));
}

QRectF vectorNoteBox(const QFontMetricsF& metrics, const QString& note, const MapTransform& transform) {
    const double width = metrics.horizontalAdvance(note) + 24 + 3 * kPadding_px;
    const double height = metrics.height() + kPadding_px;
    return {transform.size_px.width() - kMargin_px - width, transform.size_px.height() - kMargin_px - height,
            width, height};
}

void drawVectorNote(QPainter& painter, const QString& note, const MapTransform& transform,
                    const QPalette& palette) {
    if (note.isEmpty()) return;
    const QRectF box = vectorNoteBox(QFontMetricsF(painter.font()), note, transform);
    drawPanel(painter, box, palette);
    const double y = box.center().y();
    painter.setPen(QPen(QColor(200, 30, 60), 2.0));
    painter.drawLine(QPointF(box.left() + kPadding_px, y), QPointF(box.left() + kPadding_px + 24, y));
    painter.setPen(palette.color(QPalette::Text));
    painter.drawText(box.adjusted(24 + 2 * kPadding_px, 0, 0, 0), Qt::AlignVCenter | Qt::AlignLeft, note);
}

std::vector<QRectF> boxesOf(const std::vector<LegendPart>& parts, const QFontMetricsF& metrics,
                            QPointF upper_right) {
    std::vector<QRectF> boxes;
    double top = upper_right.y();
    for (const LegendPart& part : parts) {
        const double width = widthOf(part, metrics), height = heightOf(part, metrics.height());
        boxes.emplace_back(upper_right.x() - width, top, width, height);
        top += height + 8;
    }
    return boxes;
}

}  // namespace

void drawPanel(QPainter& painter, const QRectF& box, const QPalette& palette) {
    QColor ground = palette.color(QPalette::Base), edge = palette.color(QPalette::Mid);
    ground.setAlpha(225);
    edge.setAlpha(120);
    painter.setPen(QPen(edge, 1.0));
    painter.setBrush(ground);
    painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), 4, 4);
}

std::vector<QRectF> legendBoxes(const QFontMetricsF& metrics, const MapScene& scene, QPointF upper_right) {
    return boxesOf(legendParts(scene), metrics, upper_right);
}

void drawLegends(QPainter& painter, const MapScene& scene, QPointF upper_right, const QPalette& palette) {
    const std::vector<LegendPart> parts = legendParts(scene);
    const std::vector<QRectF> boxes = boxesOf(parts, QFontMetricsF(painter.font()), upper_right);
    for (std::size_t i = 0; i < parts.size(); ++i) drawLegend(painter, parts[i], boxes[i], palette);
}

std::vector<QRectF> furnitureBoxes(const QFontMetricsF& metrics, const MapScene& scene,
                                   const MapTransform& transform) {
    std::vector<QRectF> boxes = legendBoxes(metrics, scene, legendCorner(transform));
    boxes.push_back(scaleBarBox(metrics, transform));
    boxes.push_back(northArrowBox(transform));
    if (const QString note = vectorNote(scene, transform); !note.isEmpty())
        boxes.push_back(vectorNoteBox(metrics, note, transform));
    return boxes;
}

void drawFurniture(QPainter& painter, const MapScene& scene, const MapTransform& transform,
                   const QPalette& palette) {
    painter.setRenderHint(QPainter::Antialiasing);
    drawScaleBar(painter, transform, palette);
    drawNorthArrow(painter, transform, palette);
    drawLegends(painter, scene, legendCorner(transform), palette);
    drawVectorNote(painter, vectorNote(scene, transform), transform, palette);
}

}  // namespace terrawalk::gui
