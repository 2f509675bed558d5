#include "app/gui/terrain_view.hpp"

#include <QDoubleSpinBox>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QSlider>
#include <QToolBar>
#include <QToolButton>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "app/gui/figures.hpp"
#include "app/gui/map_view.hpp"
#include "app/gui/point_card.hpp"
#include "app/gui/show_menu.hpp"
#include "app/gui/terrain_furniture.hpp"
#include "app/gui/terrain_overlay.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

constexpr double kLeastExaggeration = 0.5, kGreatestExaggeration = 20.0;
// Height range over extent that a surface shall have at least when it is first seen.
constexpr double kReliefAtFirst = 0.18;
constexpr double kFirstLightAzimuth_deg = 315.0, kFirstLightHeight_deg = 45.0;
constexpr double kKeyTurn_px = 24.0, kKeyPan_px = 48.0, kKeyZoom = 1.25;
constexpr double kClickSlack_px = 4.0;
constexpr double kNearMark_px = 12.0;
// Room for the numbers along the floor, and for the legends.
constexpr ViewMargins kFurniture_px{88.0, 40.0, 120.0, 48.0};
constexpr int kRest_ms = 180;
constexpr double kContoursInRange = 16.0;

Eigen::Vector3d lightFrom(double azimuth_deg, double height_deg) {
    const double azimuth = radians(azimuth_deg), height = radians(height_deg);
    return {std::cos(height) * std::sin(azimuth), std::cos(height) * std::cos(azimuth), std::sin(height)};
}

/// As much as shows the shape of a flat field, and no more than a steep one needs: a half at a time.
double firstExaggeration(const TerrainScene& scene) {
    const double range_m = scene.highest_m() - scene.lowest_m();
    const double extent_m = 2.0 * scene.halfSize_m().head<2>().maxCoeff();
    if (!(range_m > 0.0)) return 1.0;
    return std::clamp(std::round(2.0 * kReliefAtFirst * extent_m / range_m) / 2.0, 1.0, 10.0);
}

QAction* sideAction(QToolBar& bar, TerrainView& view, ViewFrom side, const QString& text, const QString& tip,
                    const char* name) {
    QAction* action = bar.addAction(text);
    action->setToolTip(tip);
    action->setWhatsThis(tip);
    action->setObjectName(name);
    QObject::connect(action, &QAction::triggered, &view, [&view, side] { view.viewFrom(side); });
    return action;
}

/// Lets through what lies below it, and the mouse.
class FurnitureWidget final : public QWidget {
  public:
    FurnitureWidget(QWidget* parent, std::function<void(QPainter&)> paint)
        : QWidget(parent), paint_(std::move(paint)) {
        setAttribute(Qt::WA_TransparentForMouseEvents);
    }

  protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        paint_(painter);
    }

  private:
    std::function<void(QPainter&)> paint_;
};

/// Whether two scenes put the same lines and dots on the surface.
bool sameOverlay(const MapScene& a, const MapScene& b) {
    return a.survey == b.survey && a.products == b.products && a.shown == b.shown &&
           a.highlighted == b.highlighted && a.stretches == b.stretches;
}

}  // namespace

TerrainView::TerrainView(ViewState& state, Selection& selection, TerrainRenderer renderer, QWidget* parent)
    : QWidget(parent), state_(state), selection_(selection), renderer_(renderer) {
    map_.shown = state_.now();
    setObjectName("terrainView");
    setAccessibleName(tr("3-D view"));
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(320, 240);
    setMouseTracking(true);
    frame_.to_light = lightFrom(kFirstLightAzimuth_deg, kFirstLightHeight_deg);
    frame_.camera.turn(ViewFrom::Oblique);
    makeToolBar();
    furniture_ = new FurnitureWidget(this, [this](QPainter& painter) { paintFurniture(painter); });
    furniture_->hide();
    card_ = new PointCard(this);
    connect(card_, &PointCard::closed, this, &TerrainView::hidePick);
    connect(card_, &PointCard::stretchAsked, this,
            [this](const TrackStretch& stretch) { selection_.select(stretch); });
    rest_.setSingleShot(true);
    rest_.setInterval(kRest_ms);
    connect(&rest_, &QTimer::timeout, this, [this] { renew(false); });
    connect(&selection_, &Selection::changed, this, [this] {
        map_.highlighted = selection_.item();
        map_.stretches = selection_.stretches();
        renewOverlay();
    });
    connect(&state_, &ViewState::changed, this, &TerrainView::followState);
    themeChanged();
}

TerrainView::~TerrainView() {
    scene_beside_.wait();
    // Its callbacks name this view.
    canvas_.reset();
}

void TerrainView::makeToolBar() {
    tools_ = new QToolBar(this);
    tools_->setObjectName("terrainTools");
    tools_->setAccessibleName(tr("3-D view tools"));
    sideAction(*tools_, *this, ViewFrom::Oblique, tr("Oblique"), tr("From the south-west, half above"),
               "viewOblique");
    sideAction(*tools_, *this, ViewFrom::Above, tr("Above"), tr("From above, north up"), "viewAbove");
    sideAction(*tools_, *this, ViewFrom::North, tr("N"), tr("From the north"), "viewNorth");
    sideAction(*tools_, *this, ViewFrom::East, tr("E"), tr("From the east"), "viewEast");
    sideAction(*tools_, *this, ViewFrom::South, tr("S"), tr("From the south"), "viewSouth");
    sideAction(*tools_, *this, ViewFrom::West, tr("W"), tr("From the west"), "viewWest");
    tools_->addSeparator();
    exaggeration_ = new QDoubleSpinBox;
    exaggeration_->setObjectName("exaggeration");
    exaggeration_->setAccessibleName(tr("Exaggeration of heights"));
    exaggeration_->setToolTip(tr("Heights are drawn this many times as high as they are."));
    exaggeration_->setPrefix(tr("Heights × "));
    exaggeration_->setRange(kLeastExaggeration, kGreatestExaggeration);
    exaggeration_->setSingleStep(0.5);
    exaggeration_->setDecimals(1);
    exaggeration_->setValue(frame_.exaggeration);
    connect(exaggeration_, &QDoubleSpinBox::valueChanged, this, &TerrainView::setExaggeration);
    tools_->addWidget(exaggeration_);
    auto* label = new QLabel(tr("Light"));
    label->setObjectName("quiet");
    label->setContentsMargins(kGrid_px, 0, kGrid_px / 2, 0);
    tools_->addWidget(label);
    auto* light = new QSlider(Qt::Horizontal);
    light->setObjectName("light");
    light->setAccessibleName(tr("Direction of the light"));
    light->setToolTip(tr("From where the light comes: north, east, south, west, north"));
    light->setRange(0, 360);
    light->setSingleStep(15);
    light->setPageStep(45);
    light->setFixedWidth(9 * kGrid_px);
    light->setValue(static_cast<int>(kFirstLightAzimuth_deg));
    connect(light, &QSlider::valueChanged, this, [this](int deg) { setLight(deg, kFirstLightHeight_deg); });
    tools_->addWidget(light);
    auto* shown = new QToolButton;
    shown->setObjectName("shown");
    shown->setText(tr("Show"));
    shown->setToolTip(tr("What is drawn on the surface, here and on the map"));
    shown->setPopupMode(QToolButton::InstantPopup);
    shown->setMenu(new ShowMenu(state_, shown));
    tools_->addWidget(shown);
    QAction* reset = tools_->addAction(icon("fit"), tr("Reset"));
    reset->setObjectName("resetView");
    reset->setToolTip(tr("The first view again (Home)"));
    reset->setWhatsThis(reset->toolTip());
    for (QWidget* widget :
         {static_cast<QWidget*>(exaggeration_), static_cast<QWidget*>(light), static_cast<QWidget*>(shown)}) {
        widget->setWhatsThis(widget->toolTip());
    }
    connect(reset, &QAction::triggered, this, &TerrainView::resetView);
}

void TerrainView::show(std::shared_ptr<const Survey> survey, std::shared_ptr<const SurveyMap> map,
                       std::shared_ptr<const Products> products) {
    survey_ = std::move(survey);
    map_.survey = std::move(map);
    map_.products = std::move(products);
    map_.raster.reset();
    hidePick();
    build();
}

void TerrainView::build() {
    const bool some = map_.products && survey_ &&
                      std::any_of(map_.products->dem.heights_m.begin(), map_.products->dem.heights_m.end(),
                                  [](float h) { return !std::isnan(h); });
    building_ = some;
    if (!some) {
        scene_beside_.drop();
        frame_.scene.reset();
        frame_.overlay.reset();
        points_map_m_.reset();
        if (canvas_) canvas_->widget()->hide();
        furniture_->hide();
        update();
        return;
    }
    // The points of this surface, whatever is shown next.
    const std::shared_ptr<const std::vector<Eigen::Vector3d>> points(map_.survey,
                                                                     &map_.survey->ground_points_m);
    scene_beside_.start([products = map_.products, shown = map_.shown, points, map = map_,
                         palette = palette()] {
        Built built;
        built.picture =
            std::make_shared<const RasterPicture>(rasterPicture(*products, shown.layer, shown.change.get()));
        built.scene = std::make_shared<const TerrainScene>(products, *built.picture);
        built.points_map_m = points;
        built.overlay =
            std::make_shared<const SceneOverlay>(sceneOverlay(*built.scene, map, *points, palette));
        built.overlay_of = map;
        built.palette = palette;
        return built;
    });
    update();
}

void TerrainView::take(Built built) {
    if (!built.scene) return;
    building_ = false;
    // Another place needs another view; the same place, processed again, keeps it.
    const bool same_place =
        frame_.scene && (frame_.scene->origin_map_m() - built.scene->origin_map_m()).head<2>().norm() <
                            built.scene->halfSize_m().head<2>().norm();
    if (frame_.scene && same_place && !fitted_) {
        const Eigen::Vector3d target_map = frame_.scene->toMap(frame_.camera.target_m, frame_.exaggeration);
        frame_.camera.target_m = built.scene->toScene(target_map, frame_.exaggeration);
    }
    frame_.scene = std::move(built.scene);
    map_.raster = std::move(built.picture);
    points_map_m_ = std::move(built.points_map_m);
    if (!same_place) {
        frame_.exaggeration = firstExaggeration(*frame_.scene);
        const QSignalBlocker silent(exaggeration_);
        exaggeration_->setValue(frame_.exaggeration);
    }
    const Eigen::Vector3d half = frame_.scene->halfSize_m();
    frame_.camera.radius_m = std::max(1.0, std::hypot(half.x(), half.y(), half.z() * frame_.exaggeration));
    chooseContours();
    ensureCanvas();
    if (!same_place || fitted_) fit();
    // Thousands of places laid on the surface take longer than the window may be deaf.
    if (sameOverlay(built.overlay_of, map_) && built.palette == palette()) {
        frame_.overlay = std::move(built.overlay);
        renew(frame_.moving);
    } else {
        renewOverlay();
    }
    Q_EMIT surfaceShown();
}

void TerrainView::ensureCanvas() {
    if (!frame_.scene) return;
    // No sooner than it is seen: a context for OpenGL takes a while.
    if (!canvas_ && isVisible()) {
        const bool opengl = renderer_ == TerrainRenderer::Automatic ? openGl() == OpenGlKind::Hardware
                            : renderer_ == TerrainRenderer::OpenGl  ? openGl() != OpenGlKind::None
                                                                    : false;
        canvas_ = opengl ? makeOpenGlCanvas(this) : makeSoftwareCanvas(this);
        canvas_->drawn = [this](std::size_t triangles, double ms, bool complete) {
            Q_EMIT drawn(triangles, ms, complete);
        };
        canvas_->widget()->setAccessibleName(tr("Picture of the surface"));
        layOut();
        canvas_->setFrame(frame_);
    }
    if (!canvas_) return;
    canvas_->widget()->show();
    furniture_->show();
    furniture_->raise();
    card_->raise();
}

QRect TerrainView::pictureRect() const {
    return rect().adjusted(0, tools_->sizeHint().height(), 0, 0);
}

void TerrainView::layOut() {
    const int high = tools_->sizeHint().height();
    tools_->setGeometry(0, 0, width(), high);
    const QRect picture = pictureRect();
    frame_.camera.viewport_px = {std::max(picture.width(), 1), std::max(picture.height(), 1)};
    if (canvas_) canvas_->widget()->setGeometry(picture);
    furniture_->setGeometry(picture);
    card_->move(picture.left() + 2 * kGrid_px, picture.top() + 2 * kGrid_px);
}

void TerrainView::fit() {
    if (!frame_.scene) return;
    auto corners = frame_.scene->corners(frame_.exaggeration);
    const FloorGrid floor = floorGrid(*frame_.scene);
    for (const double x : {floor.west_m, floor.east_m}) {
        for (const double y : {floor.south_m, floor.north_m}) {
            corners.push_back(
                frame_.scene->toScene({x, y, frame_.scene->origin_map_m().z()}, frame_.exaggeration));
        }
    }
    frame_.camera.fit(corners, kFurniture_px);
    fitted_ = true;
}

void TerrainView::renew(bool moving) {
    frame_.moving = moving;
    if (moving) rest_.start();
    if (canvas_) canvas_->setFrame(frame_);
    furniture_->update();
}

void TerrainView::renewOverlay() {
    if (!frame_.scene) return;
    frame_.overlay = std::make_shared<const SceneOverlay>(sceneOverlay(
        *frame_.scene, map_, points_map_m_ ? *points_map_m_ : std::vector<Eigen::Vector3d>(), palette()));
    renew(frame_.moving);
}

void TerrainView::chooseContours() {
    frame_.contour_interval_m = 0.0;
    if (!map_.shown.contours || !frame_.scene) return;
    const double range_m = frame_.scene->highest_m() - frame_.scene->lowest_m();
    if (range_m > 0.0) frame_.contour_interval_m = roundLengthBelow(1.5 * range_m / kContoursInRange);
}

void TerrainView::followState() {
    const ViewChoice before = std::exchange(map_.shown, state_.now());
    if (before.layer != map_.shown.layer || before.change != map_.shown.change) build();
    if (before.contours != map_.shown.contours) chooseContours();
    renewOverlay();
}

void TerrainView::setExaggeration(double factor) {
    factor = std::clamp(factor, kLeastExaggeration, kGreatestExaggeration);
    if (factor == frame_.exaggeration) return;
    const double before = std::exchange(frame_.exaggeration, factor);
    exaggeration_->setValue(factor);
    if (!frame_.scene) return;
    frame_.camera.target_m.z() *= factor / before;
    const Eigen::Vector3d half = frame_.scene->halfSize_m();
    frame_.camera.radius_m = std::max(1.0, std::hypot(half.x(), half.y(), half.z() * factor));
    if (fitted_) fit();
    renew(true);
}

void TerrainView::setLight(double azimuth_deg, double height_deg) {
    frame_.to_light = lightFrom(azimuth_deg, std::clamp(height_deg, 5.0, 90.0));
    renew(true);
}

void TerrainView::viewFrom(ViewFrom side) {
    frame_.camera.turn(side);
    fit();
    renew(false);
}

void TerrainView::resetView() {
    viewFrom(ViewFrom::Oblique);
}

void TerrainView::zoomBy(double factor) {
    frame_.camera.zoom(factor, frame_.camera.target_m);
    fitted_ = false;
    renew(true);
}

void TerrainView::themeChanged() {
    const bool dark = currentTheme() == Theme::Dark;
    frame_.sky_above = dark ? QColor("#1b2426") : QColor("#c9d9e2");
    frame_.sky_below = dark ? QColor("#2e3836") : QColor("#f4f5f1");
    frame_.wall = dark ? QColor("#6d655a") : QColor("#a89c88");
    for (QAction* action : tools_->actions()) {
        if (action->objectName() == "resetView") action->setIcon(icon("fit"));
    }
    if (frame_.scene) {
        renewOverlay();
        if (picked_map_m_ && survey_) {
            card_->show(placeFacts(*survey_, *map_.products, *points_map_m_, *picked_map_m_));
        }
    }
    update();
}

QPointF TerrainView::inPicture(QPointF px) const {
    return px - QPointF(pictureRect().topLeft());
}

std::optional<Eigen::Vector3d> TerrainView::sceneAt(QPointF px) const {
    if (!frame_.scene) return std::nullopt;
    return frame_.scene->firstHit(frame_.camera.through({px.x(), px.y()}), frame_.exaggeration);
}

void TerrainView::pickAt(QPointF px) {
    if (!frame_.scene) return;
    for (const PlacedMark& placed : map_.survey->marks) {
        const auto foot = frame_.camera.project(frame_.scene->toScene(placed.map_m, frame_.exaggeration));
        if (!map_.shown.marks || !foot) continue;
        // The head of its pin stands above it.
        if (std::hypot(foot->x() - px.x(), foot->y() - pinHeight(frame_) - px.y()) > kNearMark_px) continue;
        const QString name = QString::fromStdString(placed.mark.name);
        if (!map_.shown.hidden_marks.contains(name)) {
            selection_.selectItem(name);
            break;
        }
    }
    const auto hit = sceneAt(px);
    if (!hit) return hidePick();
    Eigen::Vector3d at = frame_.scene->toMap(*hit, frame_.exaggeration);
    at.z() = frame_.scene->heightAt(at.x(), at.y()).value_or(at.z());
    picked_map_m_ = at;
    card_->show(placeFacts(*survey_, *map_.products, *points_map_m_, at));
    renew(false);
    Q_EMIT picked({at.x(), at.y()});
}

void TerrainView::hidePick() {
    card_->hide();
    if (!picked_map_m_) return;
    picked_map_m_.reset();
    renew(false);
}

void TerrainView::paintFurniture(QPainter& painter) {
    if (!frame_.scene) return;
    const std::vector<QRectF> labels = drawAxes(painter, frame_, palette());
    if (map_.shown.marks) drawPins(painter, frame_, map_, labels, palette());
    if (picked_map_m_) drawPick(painter, frame_, *picked_map_m_);
    drawTerrainFurniture(painter, frame_, map_, palette());
}

void TerrainView::paintEvent(QPaintEvent*) {
    if (frame_.scene && canvas_) return;
    QPainter painter(this);
    QLinearGradient sky(0, 0, 0, height());
    sky.setColorAt(0, frame_.sky_above);
    sky.setColorAt(1, frame_.sky_below);
    painter.fillRect(pictureRect(), sky);
    const QString words = building()               ? tr("The surface is being made ready…")
                          : map_.survey == nullptr ? tr("Open a survey to see it here.")
                                                   : tr("No surface yet. Process the survey to see it here.");
    painter.setPen(quietColour());
    painter.drawText(pictureRect(), Qt::AlignCenter, words);
}

void TerrainView::resizeEvent(QResizeEvent*) {
    layOut();
    if (fitted_) fit();
    renew(frame_.moving);
}

void TerrainView::showEvent(QShowEvent*) {
    layOut();
    if (fitted_) fit();
    ensureCanvas();
}

void TerrainView::wheelEvent(QWheelEvent* event) {
    event->accept();
    if (!frame_.scene) return;
    const auto under = sceneAt(inPicture(event->position()));
    frame_.camera.zoom(std::pow(1.2, event->angleDelta().y() / 120.0),
                       under.value_or(frame_.camera.target_m));
    fitted_ = false;
    renew(true);
}

void TerrainView::mousePressEvent(QMouseEvent* event) {
    held_ = event->button();
    pressed_at_ = last_at_ = event->position();
    dragging_ = false;
}

void TerrainView::mouseMoveEvent(QMouseEvent* event) {
    const QPointF at = event->position();
    if (held_ == Qt::NoButton) {
        const auto hit = sceneAt(inPicture(at));
        if (!hit) return Q_EMIT hovered({});
        const Eigen::Vector3d map_m = frame_.scene->toMap(*hit, frame_.exaggeration);
        return Q_EMIT hovered(readout(map_, {map_m.x(), map_m.y()}));
    }
    if (!dragging_ && (at - pressed_at_).manhattanLength() < kClickSlack_px) return;
    dragging_ = true;
    const Eigen::Vector2d by(at.x() - last_at_.x(), at.y() - last_at_.y());
    last_at_ = at;
    const bool pan = held_ != Qt::LeftButton || event->modifiers().testFlag(Qt::ShiftModifier);
    setCursor(pan ? Qt::SizeAllCursor : Qt::ClosedHandCursor);
    if (pan) {
        frame_.camera.pan(by);
    } else {
        frame_.camera.orbit(by);
    }
    fitted_ = false;
    renew(true);
}

void TerrainView::mouseReleaseEvent(QMouseEvent* event) {
    unsetCursor();
    if (event->button() == Qt::LeftButton && held_ == Qt::LeftButton && !dragging_) {
        pickAt(inPicture(event->position()));
    }
    held_ = Qt::NoButton;
}

void TerrainView::mouseDoubleClickEvent(QMouseEvent* event) {
    const auto hit = sceneAt(inPicture(event->position()));
    if (!hit) return;
    frame_.camera.target_m = *hit;
    fitted_ = false;
    renew(false);
}

void TerrainView::keyPressEvent(QKeyEvent* event) {
    const bool pan = event->modifiers().testFlag(Qt::ShiftModifier);
    const auto move = [&](double x, double y) {
        if (pan) {
            frame_.camera.pan(Eigen::Vector2d(-x, -y) * kKeyPan_px);
        } else {
            frame_.camera.orbit(Eigen::Vector2d(x, y) * kKeyTurn_px);
        }
        fitted_ = false;
        renew(true);
    };
    switch (event->key()) {
        case Qt::Key_Left:
            return move(-1, 0);
        case Qt::Key_Right:
            return move(1, 0);
        case Qt::Key_Up:
            return move(0, -1);
        case Qt::Key_Down:
            return move(0, 1);
        case Qt::Key_Plus:
        case Qt::Key_Equal:
            return zoomBy(kKeyZoom);
        case Qt::Key_Minus:
            return zoomBy(1.0 / kKeyZoom);
        case Qt::Key_Home:
            return resetView();
        case Qt::Key_Escape:
            return hidePick();
        default:
            return QWidget::keyPressEvent(event);
    }
}

void TerrainView::leaveEvent(QEvent*) {
    Q_EMIT hovered({});
}

}  // namespace terrawalk::gui
