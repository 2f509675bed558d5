#include "app/gui/map_view.hpp"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <cmath>
#include <utility>

#include "app/gui/figures.hpp"
#include "app/gui/map_furniture.hpp"
#include "app/gui/round_numbers.hpp"

namespace terrawalk::gui {

namespace {

// Room for the legend at the right.
// Room for legends at the right, scale bar and notes below.
constexpr QMarginsF kFitMargins_px(24.0, 24.0, 128.0, 64.0);
constexpr double kKeyPan_px = 64.0;
constexpr double kKeyStep_px = 8.0;
constexpr double kKeyZoom = 1.25;
/// Farther than this a press was a drag.
constexpr double kClick_px = 4.0;
constexpr double kReach_px = 12.0;
constexpr double kContours = 25.0;

double length(const QPolygonF& line) {
    double sum = 0.0;
    for (qsizetype i = 1; i < line.size(); ++i)
        sum += std::hypot(line[i].x() - line[i - 1].x(), line[i].y() - line[i - 1].y());
    return sum;
}

double area(const QPolygonF& ring) {
    double twice = 0.0;
    for (qsizetype i = 0; i < ring.size(); ++i) {
        const QPointF a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return std::abs(twice) / 2.0;
}

bool sameView(const MapTransform& a, const MapTransform& b) {
    return a.centre_m == b.centre_m && a.pixels_per_m == b.pixels_per_m && a.size_px == b.size_px;
}

/// Whether contours, edges, points and tracks look the same.
bool sameLines(const MapScene& a, const MapScene& b) {
    ViewChoice shown = a.shown;
    shown.layer = b.shown.layer;
    shown.change = b.shown.change;
    return a.survey == b.survey && a.products == b.products && a.contours == b.contours &&
           a.highlighted == b.highlighted && shown == b.shown;
}

double contourInterval(const Products& products) {
    const double range_m = products.report.surface.highest_m - products.report.surface.lowest_m;
    return range_m > 0.0 ? roundLengthBelow(std::max(range_m / kContours, 0.05)) : metresOf(1.0);
}

}  // namespace

MapView::MapView(ViewState& state, Selection& selection, QWidget* parent)
    : QWidget(parent), state_(state), selection_(selection) {
    scene_.shown = state_.now();
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(320, 240);
    setCursor(Qt::CrossCursor);
    setAccessibleName(tr("Map"));
    connect(&state_, &ViewState::changed, this, &MapView::followState);
    connect(&selection_, &Selection::changed, this, &MapView::followSelection);
}

void MapView::show(std::shared_ptr<const SurveyMap> survey, std::shared_ptr<const Products> products) {
    const QRectF before = scene_.extent_m();
    scene_.survey = std::move(survey);
    scene_.products = std::move(products);
    scene_.place_m.reset();
    const bool elsewhere = !before.intersects(scene_.extent_m());
    if (elsewhere) lines_ = {};
    if (fitted_ || elsewhere) fit();
    colourLayer();
    makeContours();
    update();
}

void MapView::takeLayer(std::shared_ptr<const RasterPicture> raster) {
    scene_.raster = std::move(raster);
    update();
    Q_EMIT layerShown();
}

void MapView::takeContours(std::shared_ptr<const std::vector<Contour>> contours) {
    scene_.contours = std::move(contours);
    update();
}

void MapView::takeLines(LinePicture lines) {
    lines_ = std::move(lines);
    update();
}

bool MapView::preparing() const {
    return layer_beside_.running() || contours_beside_.running() || lines_beside_.running() ||
           (isVisible() && scene_.survey && !linesCurrent());
}

void MapView::colourLayer() {
    scene_.raster.reset();
    update();
    if (!scene_.products) {
        layer_beside_.drop();
        return;
    }
    layer_beside_.start([products = scene_.products, shown = scene_.shown] {
        return std::make_shared<const RasterPicture>(
            rasterPicture(*products, shown.layer, shown.change.get()));
    });
}

void MapView::makeContours() {
    scene_.contours.reset();
    if (!scene_.products || !scene_.shown.contours) {
        contours_beside_.drop();
        return;
    }
    contours_beside_.start([products = scene_.products] {
        SilentProgress silent;
        auto lines = surfaceContours(*products, contourInterval(*products), silent, {});
        return std::make_shared<const std::vector<Contour>>(lines ? std::move(*lines)
                                                                  : std::vector<Contour>());
    });
}

void MapView::followState() {
    const ViewChoice before = std::exchange(scene_.shown, state_.now());
    if (before.layer != scene_.shown.layer || before.change != scene_.shown.change) colourLayer();
    if (before.contours != scene_.shown.contours) makeContours();
    update();
}

void MapView::setTool(MapTool tool) {
    if (tool == tool_) return;
    tool_ = tool;
    stretch_from_.reset();
    area_from_m_.reset();
    drawn_m_.clear();
    scene_.sketch = {};
    update();
    Q_EMIT toolChanged(tool);
}

void MapView::followSelection() {
    scene_.stretches = selection_.stretches();
    scene_.highlighted = scene_.stretches.empty() ? selection_.item() : QString();
    update();
}

void MapView::fit() {
    transform_.size_px = size();
    const QRectF extent = scene_.extent_m();
    if (extent.isEmpty()) return;
    transform_.fit(extent, kFitMargins_px);
    fitted_ = true;
    update();
}

void MapView::centreOn(QPointF map_m) {
    transform_.centre_m = map_m;
    fitted_ = false;
    update();
}

void MapView::zoomBy(double factor) {
    transform_.zoom(factor, rect().center());
    fitted_ = false;
    update();
}

void MapView::moveBy(QPointF by_px) {
    transform_.pan(by_px);
    fitted_ = false;
    update();
}

void MapView::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), palette().color(QPalette::Base));
    if (!scene_.survey) return;
    const MarkNames names = placedNames();
    if (scene_.raster) drawRaster(painter, *scene_.raster, transform_);
    paintLines(painter, names);
    drawStretches(painter, scene_, transform_);
    drawMarks(painter, scene_, transform_, names, palette());
    drawEdits(painter, scene_, transform_, palette());
    drawFurniture(painter, scene_, transform_, palette());
    if (key_cursor_m_) drawCross(painter, transform_.toScreen(*key_cursor_m_));
}

MarkNames MapView::placedNames() const {
    const QFontMetricsF metrics(font());
    std::vector<QRectF> reserved = furnitureBoxes(metrics, scene_, transform_);
    if (scene_.place_m) reserved.push_back(placeBox(transform_.toScreen(*scene_.place_m)));
    return placeMarkNames(metrics, markNames(scene_, transform_), {rect(), std::move(reserved)});
}

bool MapView::linesCurrent() const {
    return !lines_.image.isNull() && sameLines(lines_.scene, scene_) &&
           sameView(lines_.transform, transform_) && lines_.palette == palette() &&
           lines_.image.devicePixelRatio() == devicePixelRatioF();
}

void MapView::paintLines(QPainter& painter, const MarkNames& names) {
    if (!lines_.image.isNull()) {
        // Until the new one has come, the last picture goes along with the map.
        const MapTransform& then = lines_.transform;
        const QPointF from = transform_.toScreen(then.toMap({0, 0}));
        const QPointF to = transform_.toScreen(then.toMap({then.size_px.width(), then.size_px.height()}));
        painter.drawImage(QRectF(from, to), lines_.image);
    }
    if (!linesCurrent()) drawLinesBeside(names);
}

void MapView::drawLinesBeside(const MarkNames& names) {
    // One at a time; when it has come, the next paint sees whether another is needed.
    if (lines_beside_.running()) return;
    lines_beside_.start([scene = scene_, transform = transform_, names, palette = palette(), font = font(),
                         ratio = devicePixelRatioF()] {
        QImage image((transform.size_px * ratio).toSize(), QImage::Format_ARGB32_Premultiplied);
        image.setDevicePixelRatio(ratio);
        image.fill(Qt::transparent);
        QPainter painter(&image);
        painter.setFont(font);
        drawContours(painter, scene, transform, names, palette);
        drawTerraceEdges(painter, scene, transform);
        drawPoints(painter, scene, transform);
        drawTracks(painter, scene, transform);
        painter.end();
        return LinePicture{scene, transform, palette, image};
    });
}

void MapView::resizeEvent(QResizeEvent*) {
    transform_.size_px = size();
    if (fitted_) fit();
}

void MapView::wheelEvent(QWheelEvent* event) {
    transform_.zoom(std::pow(1.2, event->angleDelta().y() / 120.0), event->position());
    fitted_ = false;
    update();
    event->accept();
}

void MapView::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::RightButton && draws()) return finishLine();
    if (event->button() != Qt::LeftButton && event->button() != Qt::MiddleButton) return;
    pressed_at_ = event->position();
    key_cursor_m_.reset();
    if (selects() && event->button() == Qt::LeftButton) {
        kept_ = event->modifiers() & Qt::ShiftModifier ? selection_.stretches() : std::vector<TrackStretch>();
        startSelection(event->position());
        if (selecting()) return;
    }
    dragged_from_ = event->position();
}

void MapView::mouseMoveEvent(QMouseEvent* event) {
    const QPointF at = event->position();
    if (selecting() && pressed_at_) {
        extendSelection(at);
    } else if (dragged_from_) {
        if (cursor().shape() != Qt::ClosedHandCursor) setCursor(Qt::ClosedHandCursor);
        moveBy(at - *dragged_from_);
        dragged_from_ = at;
    } else if (draws() && !drawn_m_.isEmpty()) {
        showSketch(at);
    }
    Q_EMIT hovered(readout(scene_, transform_.toMap(at)));
}

void MapView::mouseReleaseEvent(QMouseEvent* event) {
    setCursor(Qt::CrossCursor);
    const bool clicked = pressed_at_ && (event->position() - *pressed_at_).manhattanLength() < kClick_px;
    pressed_at_.reset();
    dragged_from_.reset();
    if (clicked && event->button() == Qt::LeftButton) click(event->position());
    stretch_from_.reset();
    if (area_from_m_) scene_.sketch = {};
    area_from_m_.reset();
    update();
}

void MapView::click(QPointF screen_px) {
    if (draws()) {
        drawn_m_ << transform_.toMap(screen_px);
        return showSketch({});
    }
    if (!scene_.survey) return;
    if (const QString mark = markAt(scene_, transform_, screen_px); !mark.isEmpty()) {
        selection_.selectItem(mark);
    } else if (const auto hit = nearestOnTracks(scene_, transform_, screen_px);
               hit && hit->distance_px <= kReach_px / 2) {
        selection_.selectItem(QString::fromStdString(scene_.survey->tracks[hit->track].run_id));
    } else {
        selection_.clear();
    }
    scene_.place_m = transform_.toMap(screen_px);
    update();
    Q_EMIT placeAsked(*scene_.place_m);
}

void MapView::startSelection(QPointF screen_px) {
    if (tool_ == MapTool::SelectArea) {
        area_from_m_ = transform_.toMap(screen_px);
        return;
    }
    stretch_from_ = nearestOnTracks(scene_, transform_, screen_px);
    if (stretch_from_ && stretch_from_->distance_px > kReach_px) stretch_from_.reset();
}

void MapView::extendSelection(QPointF screen_px) {
    if (stretch_from_) extendStretch(screen_px);
    if (area_from_m_) extendArea(screen_px);
}

void MapView::extendArea(QPointF screen_px) {
    const QPointF a = *area_from_m_, b = transform_.toMap(screen_px);
    scene_.sketch = {QPolygonF({a, {b.x(), a.y()}, b, {a.x(), b.y()}}), true, {}};
    std::vector<TrackStretch> all = kept_;
    for (TrackStretch& found :
         stretchesWithin(scene_, transform_, QRectF(transform_.toScreen(a), screen_px).normalized())) {
        if (std::find(all.begin(), all.end(), found) == all.end()) all.push_back(std::move(found));
    }
    selection_.select(std::move(all));
    update();
}

void MapView::extendStretch(QPointF screen_px) {
    const MapTrack& track = scene_.survey->tracks[stretch_from_->track];
    const QString run = QString::fromStdString(track.run_id);
    const auto hit = nearestOnTracks(scene_, transform_, screen_px, run);
    if (!hit || hit->index == stretch_from_->index) return;
    selection_.select({run, track.time_s[stretch_from_->index], track.time_s[hit->index]});
}

void MapView::showSketch(std::optional<QPointF> cursor_px) {
    scene_.sketch.vertices_m = drawn_m_;
    if (cursor_px) scene_.sketch.vertices_m << transform_.toMap(*cursor_px);
    scene_.sketch.closed = drawsRing(tool_);
    scene_.sketch.label =
        measureText(scene_.sketch.vertices_m, tool_ == MapTool::Measure || drawsRing(tool_));
    update();
}

void MapView::finishLine() {
    const QPolygonF line = std::exchange(drawn_m_, {});
    const qsizetype fewest = drawsRing(tool_) ? 3 : 2;
    if (tool_ == MapTool::Measure) {
        // What was measured stays in view until the next click.
        scene_.sketch.vertices_m = line;
        scene_.sketch.label = measureText(line, true);
    } else {
        scene_.sketch = {};
    }
    update();
    if (line.size() >= fewest) Q_EMIT lineDrawn(tool_, line);
}

void MapView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (draws()) return finishLine();
    if (event->button() != Qt::LeftButton) return;
    transform_.zoom(2.0, event->position());
    fitted_ = false;
    update();
}

void MapView::pressKeyCursor() {
    if (!scene_.survey) return;
    if (!key_cursor_m_) {
        key_cursor_m_ = transform_.centre_m;
    } else if (const QPointF at = transform_.toScreen(*key_cursor_m_); !selects()) {
        click(at);
    } else if (selecting()) {
        extendSelection(at);
        stretch_from_.reset();
        area_from_m_.reset();
        scene_.sketch = {};
    } else {
        kept_.clear();
        startSelection(at);
    }
    update();
}

void MapView::moveKeyCursor(QPointF by_px) {
    const QPointF at = transform_.toScreen(*key_cursor_m_) + by_px;
    key_cursor_m_ = transform_.toMap(at);
    if (!rect().contains(at.toPoint())) moveBy(-by_px);
    if (selecting()) extendSelection(at);
    if (draws() && !drawn_m_.isEmpty()) showSketch(at);
    update();
    Q_EMIT hovered(readout(scene_, *key_cursor_m_));
}

void MapView::keyPressEvent(QKeyEvent* event) {
    const double step_px = event->modifiers() & Qt::ShiftModifier ? 1.0 : kKeyStep_px;
    const auto arrow = [&](double x, double y) {
        return key_cursor_m_ ? moveKeyCursor(QPointF(x, y) * step_px) : moveBy(QPointF(-x, -y) * kKeyPan_px);
    };
    switch (event->key()) {
        case Qt::Key_Left:
            return arrow(-1, 0);
        case Qt::Key_Right:
            return arrow(1, 0);
        case Qt::Key_Up:
            return arrow(0, -1);
        case Qt::Key_Down:
            return arrow(0, 1);
        case Qt::Key_Space:
            return pressKeyCursor();
        case Qt::Key_Plus:
        case Qt::Key_Equal:
            return zoomBy(kKeyZoom);
        case Qt::Key_Minus:
            return zoomBy(1.0 / kKeyZoom);
        case Qt::Key_Home:
            return fit();
        case Qt::Key_Return:
        case Qt::Key_Enter:
            if (draws()) return finishLine();
            break;
        case Qt::Key_Backspace:
            if (!drawn_m_.isEmpty()) {
                drawn_m_.removeLast();
                return showSketch({});
            }
            break;
        case Qt::Key_Escape:
            if (key_cursor_m_) {
                key_cursor_m_.reset();
            } else if (drawn_m_.isEmpty()) {
                setTool(MapTool::Pan);
                selection_.clear();
            }
            stretch_from_.reset();
            area_from_m_.reset();
            drawn_m_.clear();
            scene_.sketch = {};
            return update();
        default:
            break;
    }
    QWidget::keyPressEvent(event);
}

void MapView::leaveEvent(QEvent*) {
    Q_EMIT hovered({});
}

QString readout(const MapScene& scene, QPointF map_m) {
    if (!scene.survey) return {};
    QString line = MapView::tr("E %1 m   N %2 m").arg(number(map_m.x(), 2), number(map_m.y(), 2));
    const auto reading = scene.products ? readingAt(*scene.products, map_m) : std::nullopt;
    if (!reading) return line;
    line += MapView::tr("   height %1").arg(lengthText(reading->height_m));
    if (reading->sigma_m) line += QString(" ± %1").arg(lengthText(*reading->sigma_m));
    return line;
}

QString measureText(const QPolygonF& vertices_m, bool closed) {
    if (vertices_m.size() < 2) return {};
    QString words = lengthText(length(vertices_m));
    if (closed && vertices_m.size() > 2) words += MapView::tr(", area %1").arg(areaText(area(vertices_m)));
    return words;
}

bool drawsRing(MapTool tool) {
    return tool == MapTool::Boundary || tool == MapTool::Hole;
}

}  // namespace terrawalk::gui
