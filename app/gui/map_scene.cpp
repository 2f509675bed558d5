#include "app/gui/map_scene.hpp"

#include <QCoreApplication>
#include <QPainterPath>
#include <algorithm>
#include <array>
#include <cmath>

#include "app/gui/figures.hpp"
#include "app/gui/fix_classes.hpp"
#include "app/gui/round_numbers.hpp"
#include "app/gui/theme.hpp"
#include "app/pipeline/relief.hpp"

namespace terrawalk::gui {

namespace {

constexpr std::size_t kMostDots = 20'000;
constexpr double kPlaceArm_px = 14.0;

QString text(const std::string& utf8) {
    return QString::fromStdString(utf8);
}

std::vector<double> valuesOf(const MapTrack& track, TrackColouring colouring) {
    switch (colouring) {
        case TrackColouring::Speed:
            return track.speed_mps;
        case TrackColouring::SigmaPlan:
            return track.sigma_plan_m;
        case TrackColouring::SigmaHeight:
            return track.sigma_height_m;
        case TrackColouring::Residual:
            return track.residual_over_sigma;
        case TrackColouring::Height: {
            std::vector<double> heights_m;
            for (const Eigen::Vector3d& p : track.map_m) heights_m.push_back(p.z());
            return heights_m;
        }
        case TrackColouring::Run:
        case TrackColouring::Fix:
            break;
    }
    return {};
}

constexpr QRgb kUnknownFix = qRgb(120, 120, 120);
constexpr QRgb kNoValue = qRgb(160, 160, 160);

QRgb fixColour(int code) {
    const auto found = std::find_if(kFixClasses.begin(), kFixClasses.end(),
                                    [&](const FixClass& c) { return c.code == code; });
    return found == kFixClasses.end() ? kUnknownFix : found->colour;
}

double quantile(std::vector<double> values, double share) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
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

/// A long line that crosses itself is outlined as a whole before it is filled, which takes tenths of a
/// second; pieces of it take hundredths. `pen` has flat caps where it lets the ground through.
void drawInPieces(QPainter& painter, const QPolygonF& line, const QPen& pen) {
    constexpr qsizetype kPiece = 8;
    painter.setPen(pen);
    for (qsizetype from = 0; from + 1 < line.size(); from += kPiece - 1) {
        painter.drawPolyline(line.constData() + from, int(std::min(kPiece, line.size() - from)));
    }
}

/// Pieces of one track, each in the colour of its end.
void drawColoured(QPainter& painter, const MapTrack& track, const MapTransform& transform, double width_px,
                  const TrackInk& colourAt) {
    QPointF last;
    for (std::size_t i = 0; i < track.map_m.size(); ++i) {
        const QPointF at = transform.toScreen({track.map_m[i].x(), track.map_m[i].y()});
        if (i > 0 && (at - last).manhattanLength() < 0.7) continue;
        if (i > 0) {
            painter.setPen(QPen(QColor(colourAt(i)), width_px, Qt::SolidLine, Qt::RoundCap));
            painter.drawLine(last, at);
        }
        last = at;
    }
}

void drawPart(QPainter& painter, const MapTrack& track, double from_s, double to_s, const QPen& pen,
              const MapTransform& transform) {
    QPolygonF line;
    for (std::size_t i = 0; i < track.map_m.size(); ++i) {
        if (track.time_s[i] < from_s || track.time_s[i] > to_s) continue;
        line << transform.toScreen({track.map_m[i].x(), track.map_m[i].y()});
    }
    drawInPieces(painter, line, pen);
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

// Glyphs drawn about it are kept by the painter, an outline would be made anew for each label.
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

std::optional<ValueRange> trackRange(const MapScene& scene) {
    if (!scene.survey) return std::nullopt;
    std::vector<double> all;
    for (const MapTrack& track : scene.survey->tracks) {
        if (scene.shown.hidden_runs.contains(text(track.run_id))) continue;
        const auto own = valuesOf(track, scene.shown.colouring);
        std::copy_if(own.begin(), own.end(), std::back_inserter(all),
                     [](double v) { return std::isfinite(v); });
    }
    if (all.empty()) return std::nullopt;
    // Alike on every survey: what lies within 2 sigma is as expected.
    if (scene.shown.colouring == TrackColouring::Residual) return ValueRange{0.0, 4.0};
    // The few largest values must not take the colours from all others.
    const double high = quantile(all, 0.98);
    const double low = scene.shown.colouring == TrackColouring::Height ? quantile(std::move(all), 0.02) : 0.0;
    return ValueRange{low, std::max(high, low + 1e-6)};
}

TrackInk trackInk(const MapScene& scene, std::size_t index) {
    const MapTrack& track = scene.survey->tracks[index];
    if (scene.shown.colouring == TrackColouring::Fix && track.fix.size() == track.map_m.size()) {
        return [&track](std::size_t i) {
            return fixColour(track.fix[i]);
        };
    }
    const auto range = trackRange(scene);
    auto own = valuesOf(track, scene.shown.colouring);
    if (!range || own.size() != track.map_m.size()) {
        return [colour = runColour(index).rgb()](std::size_t) {
            return colour;
        };
    }
    return [range = *range, own = std::move(own), ramp = sequentialRamp()](std::size_t i) {
        if (!std::isfinite(own[i])) return kNoValue;
        const Colour c = rampColour(ramp, (own[i] - range.low) / (range.high - range.low));
        return qRgb(c[0], c[1], c[2]);
    };
}

std::vector<std::pair<QString, QColor>> fixClasses(const MapScene& scene) {
    std::vector<std::pair<QString, QColor>> classes;
    if (!scene.survey || scene.shown.colouring != TrackColouring::Fix) return classes;
    const auto occurs = [&](int code) {
        return std::any_of(scene.survey->tracks.begin(), scene.survey->tracks.end(),
                           [&](const MapTrack& track) {
                               return std::find(track.fix.begin(), track.fix.end(), code) != track.fix.end();
                           });
    };
    for (const FixClass& c : kFixClasses) {
        if (occurs(c.code)) classes.emplace_back(c.words(), QColor(c.colour));
    }
    if (occurs(-1))
        classes.emplace_back(QCoreApplication::translate("MapScene", "not told"), QColor(kUnknownFix));
    return classes;
}

std::optional<TrackHit> nearestOnTracks(const MapScene& scene, const MapTransform& transform,
                                        QPointF screen_px, const QString& only_run) {
    if (!scene.survey || !scene.shown.tracks) return std::nullopt;
    std::optional<TrackHit> best;
    for (std::size_t t = 0; t < scene.survey->tracks.size(); ++t) {
        const MapTrack& track = scene.survey->tracks[t];
        const QString id = text(track.run_id);
        if (scene.shown.hidden_runs.contains(id) || (!only_run.isEmpty() && id != only_run)) continue;
        for (std::size_t i = 0; i < track.map_m.size(); ++i) {
            const QPointF off = transform.toScreen({track.map_m[i].x(), track.map_m[i].y()}) - screen_px;
            const double distance_px = std::hypot(off.x(), off.y());
            if (!best || distance_px < best->distance_px) best = TrackHit{t, i, distance_px};
        }
    }
    return best;
}

std::vector<TrackStretch> stretchesWithin(const MapScene& scene, const MapTransform& transform,
                                          const QRectF& screen_px) {
    std::vector<TrackStretch> found;
    if (!scene.survey || !scene.shown.tracks) return found;
    for (const MapTrack& track : scene.survey->tracks) {
        const QString id = text(track.run_id);
        if (scene.shown.hidden_runs.contains(id)) continue;
        bool inside = false;
        for (std::size_t i = 0; i < track.map_m.size(); ++i) {
            const bool before = std::exchange(
                inside, screen_px.contains(transform.toScreen({track.map_m[i].x(), track.map_m[i].y()})));
            if (!inside) continue;
            if (!before) found.push_back({id, track.time_s[i], track.time_s[i]});
            found.back().to_s = track.time_s[i];
        }
    }
    // A single epoch is no stretch.
    std::erase_if(found, [](const TrackStretch& s) { return s.from_s == s.to_s; });
    return found;
}

QString markAt(const MapScene& scene, const MapTransform& transform, QPointF screen_px) {
    if (!scene.survey || !scene.shown.marks) return {};
    constexpr double kReach_px = 8.0;
    for (const PlacedMark& placed : scene.survey->marks) {
        const QString name = text(placed.mark.name);
        if (scene.shown.hidden_marks.contains(name)) continue;
        const QPointF off = transform.toScreen({placed.map_m.x(), placed.map_m.y()}) - screen_px;
        if (std::hypot(off.x(), off.y()) <= kReach_px) return name;
    }
    return {};
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

QRgb pointColour(GroundPointState state) {
    switch (state) {
        case GroundPointState::Used:
            return qRgb(32, 36, 40);
        case GroundPointState::Thinned:
        case GroundPointState::RunLeftOut:
            return qRgb(128, 134, 140);
        default:
            return qRgb(213, 94, 0);
    }
}

std::vector<std::pair<QString, QColor>> pointClasses(const MapScene& scene) {
    std::vector<std::pair<QString, QColor>> classes;
    if (!scene.shown.points || !scene.products) return classes;
    const std::array<std::pair<GroundPointState, const char*>, 3> kinds{
        {{GroundPointState::Used, QT_TRANSLATE_NOOP("MapScene", "used")},
         {GroundPointState::Thinned, QT_TRANSLATE_NOOP("MapScene", "thinned, left out")},
         {GroundPointState::NoRange, QT_TRANSLATE_NOOP("MapScene", "refused")}}};
    for (const auto& [state, name] : kinds) {
        const QRgb colour = pointColour(state);
        const auto& points = scene.products->ground_points;
        if (std::any_of(points.begin(), points.end(), [&](const GroundPoint& p) {
                return pointColour(p.state) == colour && p.enu_m.allFinite();
            }))
            classes.emplace_back(QCoreApplication::translate("MapScene", name), QColor(colour));
    }
    return classes;
}

void drawPoints(QPainter& painter, const MapScene& scene, const MapTransform& transform) {
    if (!scene.survey || !scene.products || !scene.shown.points) return;
    const auto& places = scene.survey->ground_points_m;
    const auto& points = scene.products->ground_points;
    if (places.size() != points.size()) return;
    painter.setRenderHint(QPainter::Antialiasing, false);
    const QRectF seen = QRectF(QPointF(0, 0), transform.size_px).adjusted(-2, -2, 2, 2);
    // Of very many some suffice to see where they lie.
    const std::size_t step = 1 + places.size() / kMostDots;
    for (std::size_t i = 0; i < places.size(); i += step) {
        if (!places[i].allFinite()) continue;
        const QPointF at = transform.toScreen({places[i].x(), places[i].y()});
        const bool hidden =
            points[i].run < scene.survey->tracks.size() &&
            scene.shown.hidden_runs.contains(text(scene.survey->tracks[points[i].run].run_id));
        if (hidden || !seen.contains(at)) continue;
        painter.fillRect(QRectF(at.x() - 1.0, at.y() - 1.0, 2.5, 2.5), QColor(pointColour(points[i].state)));
    }
}

void drawTracks(QPainter& painter, const MapScene& scene, const MapTransform& transform) {
    if (!scene.survey) return;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    for (std::size_t t = 0; scene.shown.tracks && t < scene.survey->tracks.size(); ++t) {
        const MapTrack& track = scene.survey->tracks[t];
        const QString id = text(track.run_id);
        if (scene.shown.hidden_runs.contains(id)) continue;
        const double width_px = scene.highlighted == id ? 4.0 : 1.8;
        const QPolygonF line = onScreen(track, transform);
        drawInPieces(
            painter, line,
            QPen(QColor(255, 255, 255, 150), width_px + 1.6, Qt::SolidLine, Qt::FlatCap, Qt::BevelJoin));
        if (scene.shown.colouring == TrackColouring::Run) {
            drawInPieces(painter, line,
                         QPen(runColour(t), width_px, Qt::SolidLine, Qt::SquareCap, Qt::BevelJoin));
        } else {
            drawColoured(painter, track, transform, width_px + 0.7, trackInk(scene, t));
        }
    }
}

void drawStretches(QPainter& painter, const MapScene& scene, const MapTransform& transform) {
    if (!scene.survey) return;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    for (const MapTrack& track : scene.survey->tracks) {
        const QString id = text(track.run_id);
        if (scene.shown.hidden_runs.contains(id)) continue;
        for (const ExcludedStretch& out : scene.shown.edits->stretches) {
            if (out.run != track.run_id) continue;
            drawPart(painter, track, out.from_s, out.to_s, QPen(Qt::white, 5.0, Qt::SolidLine, Qt::FlatCap),
                     transform);
            drawPart(painter, track, out.from_s, out.to_s, QPen(kExcludedInk, 2.0, Qt::DotLine, Qt::FlatCap),
                     transform);
        }
        for (const TrackStretch& selected : scene.stretches) {
            if (selected.run != id) continue;
            // Opaque: the line is drawn in pieces, which would show where they overlap.
            for (const auto& [colour, width_px] :
                 {std::pair(QColor(Qt::white), 7.0), {accentColour(), 4.5}}) {
                drawPart(painter, track, selected.from_s, selected.to_s,
                         QPen(colour, width_px, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin), transform);
            }
        }
    }
}

void drawMarkSymbol(QPainter& painter, QPointF at, const ControlMark& mark, bool highlighted,
                    const QColor& colour) {
    const double r = highlighted ? 7.0 : 5.0;
    painter.setPen(QPen(Qt::white, 1.5));
    painter.setBrush(colour);
    if (mark.name == kZeroMark) {
        painter.drawRect(QRectF(at.x() - r, at.y() - r, 2 * r, 2 * r));
    } else if (mark.role == MarkRole::Control) {
        painter.drawPolygon(
            QPolygonF({at + QPointF(0, -1.2 * r), at + QPointF(r, 0.8 * r), at + QPointF(-r, 0.8 * r)}));
    } else {
        painter.drawEllipse(at, 0.8 * r, 0.8 * r);
    }
}

std::vector<MarkName> markNames(const MapScene& scene, const MapTransform& transform) {
    std::vector<MarkName> names;
    if (!scene.survey || !scene.shown.marks) return names;
    for (const PlacedMark& placed : scene.survey->marks) {
        const QString name = text(placed.mark.name);
        if (scene.shown.hidden_marks.contains(name)) continue;
        const QPointF at = transform.toScreen({placed.map_m.x(), placed.map_m.y()});
        names.push_back({at, name, scene.highlighted == name});
    }
    return names;
}

void drawMarks(QPainter& painter, const MapScene& scene, const MapTransform& transform,
               const MarkNames& names, const QPalette& palette) {
    if (!scene.survey || !scene.shown.marks) return;
    painter.setRenderHint(QPainter::Antialiasing);
    const double scale = vectorScale(scene, transform);
    for (const PlacedMark& placed : scene.survey->marks) {
        const QString name = text(placed.mark.name);
        if (scene.shown.hidden_marks.contains(name)) continue;
        const QPointF at = transform.toScreen({placed.map_m.x(), placed.map_m.y()});
        if (placed.array_map_m) {
            const Eigen::Vector2d off_px =
                (*placed.array_map_m - placed.map_m.head<2>()) * (scale * transform.pixels_per_m);
            drawVector(painter, at, at + QPointF(off_px.x(), -off_px.y()));
        }
        drawMarkSymbol(painter, at, placed.mark, scene.highlighted == name, kMarkInk);
    }
    drawMarkNames(painter, names, palette);
}

void drawTerraceEdges(QPainter& painter, const MapScene& scene, const MapTransform& transform) {
    if (!scene.products || !scene.shown.edges) return;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    for (const auto& edge : scene.products->terrace_edges) {
        for (const auto* vertices : {&edge.toe_m, &edge.top_m}) {
            QPolygonF line;
            for (const Eigen::Vector3d& p : *vertices) line << transform.toScreen({p.x(), p.y()});
            const bool top = vertices == &edge.top_m;
            painter.setPen(QPen(kEdgeInk, top ? 1.8 : 1.0, top ? Qt::SolidLine : Qt::DashLine));
            painter.drawPolyline(line);
        }
    }
}

namespace {

QList<QRectF> boxesOf(const MarkNames& names) {
    QList<QRectF> boxes;
    for (const MarkName& mark : names.marks) boxes << symbolBox(mark);
    for (const PlacedName& place : names.places) boxes << place.box;
    return boxes;
}

/// The box of a label on a line, as near to the middle of it as one is seen and free.
std::optional<QRectF> freePlace(const QPolygonF& line, const QRectF& seen, const QList<QRectF>& taken) {
    const qsizetype middle = line.size() / 2;
    const qsizetype step = std::max<qsizetype>(1, line.size() / 64);
    for (qsizetype off = 0; off <= middle; off += step) {
        for (const qsizetype i : {middle + off, middle - off}) {
            if (i < 0 || i >= line.size()) continue;
            const QRectF box(line[i] - QPointF(24, 12), QSizeF(48, 24));
            const bool free =
                std::none_of(taken.begin(), taken.end(), [&](const QRectF& o) { return o.intersects(box); });
            if (free && seen.contains(box)) return box;
        }
    }
    return std::nullopt;
}

}  // namespace

void drawContours(QPainter& painter, const MapScene& scene, const MapTransform& transform,
                  const MarkNames& names, const QPalette& palette) {
    if (!scene.contours || !scene.shown.contours) return;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    const QRectF seen = QRectF(QPointF(0, 0), transform.size_px).adjusted(-8, -8, 8, 8);
    // Marks and their names are drawn over this.
    QList<QRectF> taken = boxesOf(names);
    for (const Contour& contour : *scene.contours) {
        QPolygonF line;
        for (const Eigen::Vector2d& v : contour.vertices) {
            const QPointF at = transform.toScreen({v.x(), v.y()});
            if (!line.isEmpty() && (at - line.last()).manhattanLength() < 0.7) continue;
            line << at;
        }
        if (line.size() < 2 || !line.boundingRect().intersects(seen)) continue;
        painter.setPen(QPen(QColor(60, 45, 30, contour.is_index ? 220 : 130), contour.is_index ? 1.4 : 0.8));
        painter.drawPolyline(line);
        if (!contour.is_index || line.size() < 12) continue;
        const double level = inUnit(contour.level);
        const QString label = number(level, std::abs(level - std::round(level)) < 1e-6 ? 0 : 1);
        const auto box = freePlace(line, seen, taken);
        if (!box) continue;
        taken << *box;
        const double half_px = painter.fontMetrics().horizontalAdvance(label) / 2.0;
        drawLabel(painter, box->center() + QPointF(-half_px, 4), label, palette);
    }
}

namespace {

QPolygonF onScreen(const QPolygonF& vertices_m, const MapTransform& transform, bool closed) {
    QPolygonF line;
    for (const QPointF& v : vertices_m) line << transform.toScreen(v);
    if (closed && line.size() > 2) line << line.first();
    return line;
}

void drawLine(QPainter& painter, const QPolygonF& line, const QColor& colour, Qt::PenStyle style) {
    painter.setPen(QPen(Qt::white, 4.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(line);
    painter.setPen(QPen(colour, 2.2, style, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(line);
}

}  // namespace

QColor lineColour(BreaklineKind kind) {
    switch (kind) {
        case BreaklineKind::Hard:
            return {170, 30, 90};
        case BreaklineKind::Soft:
            return {130, 90, 190};
        case BreaklineKind::Boundary:
            return {0, 90, 160};
        case BreaklineKind::Hole:
            return {150, 90, 0};
    }
    return {};
}

void drawCross(QPainter& painter, QPointF at) {
    painter.setRenderHint(QPainter::Antialiasing);
    for (const auto& [colour, width] : {std::pair{QColor(Qt::white), 4.0}, {accentColour(), 2.0}}) {
        painter.setPen(QPen(colour, width));
        for (const QPointF& arm : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
            painter.drawLine(at + arm * 4.0, at + arm * 18.0);
    }
}

QRectF placeBox(QPointF at) {
    return {at.x() - kPlaceArm_px, at.y() - kPlaceArm_px, 2.0 * kPlaceArm_px, 2.0 * kPlaceArm_px};
}

void drawEdits(QPainter& painter, const MapScene& scene, const MapTransform& transform,
               const QPalette& palette) {
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    for (const Breakline& line : scene.shown.edits->lines) {
        QPolygonF vertices_m;
        for (const Eigen::Vector3d& v : line.vertices_m) vertices_m << QPointF(v.x(), v.y());
        const bool ring = line.kind == BreaklineKind::Boundary || line.kind == BreaklineKind::Hole;
        drawLine(painter, onScreen(vertices_m, transform, ring), lineColour(line.kind),
                 line.kind == BreaklineKind::Soft ? Qt::DashLine : Qt::SolidLine);
    }
    if (!scene.sketch.vertices_m.isEmpty() && scene.sketch.label.isEmpty() && scene.sketch.closed) {
        const QPolygonF area = onScreen(scene.sketch.vertices_m, transform, true);
        QColor fill = accentColour();
        fill.setAlpha(40);
        painter.setPen(QPen(accentColour(), 1.5));
        painter.setBrush(fill);
        painter.drawPolygon(area);
        painter.setBrush(Qt::NoBrush);
    } else if (!scene.sketch.vertices_m.isEmpty()) {
        const QPolygonF line = onScreen(scene.sketch.vertices_m, transform, scene.sketch.closed);
        drawLine(painter, line, accentColour(), Qt::SolidLine);
        painter.setPen(QPen(Qt::white, 1.5));
        painter.setBrush(accentColour());
        for (const QPointF& at : line) painter.drawEllipse(at, 4.0, 4.0);
        const QPointF end = transform.toScreen(scene.sketch.vertices_m.last());
        drawLabel(painter, end + QPointF(12, -8), scene.sketch.label, palette);
    }
    if (scene.place_m) {
        const QPointF at = transform.toScreen(*scene.place_m);
        for (const auto& [colour, width] : {std::pair{QColor(Qt::white), 4.0}, {accentColour(), 2.0}}) {
            painter.setPen(QPen(colour, width));
            painter.setBrush(Qt::NoBrush);
            painter.drawEllipse(at, 9.0, 9.0);
            for (const QPointF& arm : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
                painter.drawLine(at + arm * 5.0, at + arm * kPlaceArm_px);
        }
    }
}

}  // namespace terrawalk::gui
