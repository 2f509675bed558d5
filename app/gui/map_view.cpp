#include "app/gui/map_view.hpp"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <QtConcurrent>
#include <cmath>
#include <utility>

#include "app/gui/map_furniture.hpp"

namespace terrawalk::gui {

namespace {
constexpr double kFitMargin_px = 32.0;
constexpr double kKeyPan_px = 64.0;
constexpr double kKeyZoom = 1.25;
}  // namespace

MapView::MapView(QWidget* parent) : QWidget(parent) {
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(320, 240);
    setCursor(Qt::CrossCursor);
    setAccessibleName(tr("Map"));
    connect(&watcher_, &QFutureWatcherBase::finished, this, [this] {
        scene_.raster = watcher_.result();
        update();
        Q_EMIT layerShown();
    });
}

MapView::~MapView() {
    watcher_.waitForFinished();
}

void MapView::show(std::shared_ptr<const SurveyMap> survey, std::shared_ptr<const Products> products) {
    const QRectF before = scene_.extent_m();
    scene_.survey = std::move(survey);
    scene_.products = std::move(products);
    scene_.raster.reset();
    if (!fitted_ || !before.intersects(scene_.extent_m())) fit();
    if (fitted_) fit();
    colourLayer();
    update();
}

void MapView::colourLayer() {
    scene_.raster.reset();
    update();
    if (!scene_.products) {
        watcher_.setFuture({});
        return;
    }
    watcher_.setFuture(QtConcurrent::run([products = scene_.products, layer = layer_] {
        return std::make_shared<const RasterPicture>(rasterPicture(*products, layer));
    }));
}

void MapView::setLayer(RasterLayer layer) {
    if (layer == layer_) return;
    layer_ = layer;
    colourLayer();
}

void MapView::setColouring(TrackColouring colouring) {
    scene_.colouring = colouring;
    update();
}

void MapView::toggle(QSet<QString>& hidden, const QString& name, bool visible) {
    if (visible) {
        hidden.remove(name);
    } else {
        hidden.insert(name);
    }
    update();
}

void MapView::setRunVisible(const QString& run, bool visible) {
    toggle(scene_.hidden_runs, run, visible);
}

void MapView::setMarkVisible(const QString& mark, bool visible) {
    toggle(scene_.hidden_marks, mark, visible);
}

void MapView::setEdgesVisible(bool visible) {
    scene_.show_edges = visible;
    update();
}

void MapView::highlight(const QString& run_or_mark) {
    scene_.highlighted = run_or_mark;
    update();
}

void MapView::fit() {
    transform_.size_px = size();
    const QRectF extent = scene_.extent_m();
    if (extent.isEmpty()) return;
    transform_.fit(extent, kFitMargin_px);
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

void MapView::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), palette().color(QPalette::Base));
    if (!scene_.survey) return;
    if (scene_.raster) drawRaster(painter, *scene_.raster, transform_);
    drawTerraceEdges(painter, scene_, transform_);
    drawTracks(painter, scene_, transform_);
    drawMarks(painter, scene_, transform_, palette());
    drawFurniture(painter, scene_, transform_, palette());
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
    if (event->button() != Qt::LeftButton && event->button() != Qt::MiddleButton) return;
    dragged_from_ = event->position();
    setCursor(Qt::ClosedHandCursor);
}

void MapView::mouseMoveEvent(QMouseEvent* event) {
    if (dragged_from_) {
        transform_.pan(event->position() - *dragged_from_);
        dragged_from_ = event->position();
        fitted_ = false;
        update();
    }
    Q_EMIT hovered(readout(scene_, transform_.toMap(event->position())));
}

void MapView::mouseReleaseEvent(QMouseEvent*) {
    dragged_from_.reset();
    setCursor(Qt::CrossCursor);
}

void MapView::mouseDoubleClickEvent(QMouseEvent* event) {
    transform_.zoom(2.0, event->position());
    fitted_ = false;
    update();
}

void MapView::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
        case Qt::Key_Left:
            transform_.pan({kKeyPan_px, 0});
            break;
        case Qt::Key_Right:
            transform_.pan({-kKeyPan_px, 0});
            break;
        case Qt::Key_Up:
            transform_.pan({0, kKeyPan_px});
            break;
        case Qt::Key_Down:
            transform_.pan({0, -kKeyPan_px});
            break;
        case Qt::Key_Plus:
            return zoomBy(kKeyZoom);
        case Qt::Key_Minus:
            return zoomBy(1.0 / kKeyZoom);
        case Qt::Key_Home:
            return fit();
        default:
            return QWidget::keyPressEvent(event);
    }
    fitted_ = false;
    update();
}

void MapView::leaveEvent(QEvent*) {
    Q_EMIT hovered({});
}

QString readout(const MapScene& scene, QPointF map_m) {
    if (!scene.survey) return {};
    QString line = MapView::tr("E %1 m   N %2 m")
                       .arg(QString::number(map_m.x(), 'f', 2), QString::number(map_m.y(), 'f', 2));
    const auto reading = scene.products ? readingAt(*scene.products, map_m) : std::nullopt;
    if (!reading) return line;
    line += MapView::tr("   height %1 m").arg(QString::number(reading->height_m, 'f', 2));
    if (reading->sigma_m) line += QString(" ± %1 m").arg(QString::number(*reading->sigma_m, 'f', 2));
    return line;
}

}  // namespace terrawalk::gui
