#include "app/gui/terrain_view.hpp"

#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <QApplication>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <set>

#include "app/gui/point_card.hpp"
#include "app/gui/software_rasteriser.hpp"
#include "app/gui/terrain_overlay.hpp"
#include "app/gui/theme.hpp"
#include "tests/gui/processed_sample.hpp"

using namespace terrawalk;
using namespace terrawalk::gui;

namespace {

constexpr double kCell_m = 0.5;

/// A plane that rises to the east and more to the north.
double planeAt(double x_m, double y_m) {
    return 5.0 + 0.1 * x_m + 0.2 * y_m;
}

std::shared_ptr<Products> plane(std::size_t cells) {
    auto products = std::make_shared<Products>();
    GridGeometry& g = products->dem.geometry;
    g = {100.0, 200.0 + kCell_m * static_cast<double>(cells), kCell_m, cells, cells};
    for (std::size_t row = 0; row < cells; ++row) {
        for (std::size_t column = 0; column < cells; ++column) {
            products->dem.heights_m.push_back(static_cast<float>(planeAt(g.centreX(column), g.centreY(row))));
        }
    }
    return products;
}

struct Counted {
    std::size_t surface = 0, walls = 0, facing_down = 0;
};

Counted count(const TerrainBlock& block) {
    Counted counted;
    for (const auto& [a, b, c] : block.triangles) {
        const auto at = [&](std::uint32_t i) {
            const auto& p = block.vertices[i].at_m;
            return Eigen::Vector3f(p[0], p[1], p[2]);
        };
        const Eigen::Vector3f normal = (at(b) - at(a)).cross(at(c) - at(a));
        if (block.vertices[a].wall != 0) {
            ++counted.walls;
            const auto& facing = block.vertices[a].facing;
            // Outward as its vertices say, or the wall is dark on the wrong side.
            if (normal.x() * facing[0] + normal.y() * facing[1] <= 0.0F) ++counted.facing_down;
        } else if (std::abs(normal.z()) > 1e-9F) {
            ++counted.surface;
            if (normal.z() < 0.0F) ++counted.facing_down;
        }
    }
    return counted;
}

std::size_t triangles(const TerrainScene& scene, const std::vector<BlockLevel>& chosen) {
    std::size_t sum = 0;
    for (const BlockLevel which : chosen) sum += scene.build(which).triangles.size();
    return sum;
}

OrbitCamera cameraOver(const TerrainScene& scene, ViewFrom side) {
    OrbitCamera camera;
    camera.viewport_px = {800.0, 600.0};
    camera.radius_m = scene.halfSize_m().norm();
    camera.turn(side);
    camera.fit(scene.corners(1.0), {});
    return camera;
}

TerrainFrame frameOver(std::shared_ptr<const TerrainScene> scene, ViewFrom side) {
    TerrainFrame frame;
    frame.camera = cameraOver(*scene, side);
    frame.scene = std::move(scene);
    frame.sky_above = frame.sky_below = QColor(1, 2, 3);
    frame.wall = QColor(90, 80, 70);
    return frame;
}

QImage pictureOf(const TerrainFrame& frame) {
    BlockStore store;
    const auto blocks = store.ready(*frame.scene, frame.scene->select(frame.camera, 1.0, 1'000'000),
                                    std::chrono::milliseconds(10'000));
    return rasterise(frame, blocks, {800, 600}, 1);
}

constexpr ViewFrom kSides[] = {ViewFrom::Oblique, ViewFrom::Above, ViewFrom::South,
                               ViewFrom::East,    ViewFrom::North, ViewFrom::West};

}  // namespace

class TestTerrainView : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void initTestCase();
    void sightLineMeetsItsPixel();
    void zoomKeepsTheFixedPoint();
    void fitKeepsAllWithinTheMargins();
    void fromAboveNorthIsUp();
    void heightsBetweenCellsLieOnThePlane();
    void sightLineHitsThePlane();
    void blockHasAllTrianglesAndWallsAround();
    void holeHasWalls();
    void neighboursHaveNoWallBetween();
    void coarserLevelsKeepTheEdge();
    void selectionKeepsToTheBudget();
    void nothingIsChosenOutOfView();
    void budgetFollowsTheFrames();
    void flatGroundHasOneTint();
    void whatIsNearHidesWhatIsFar();
    void pictureIsTheSameOnAnyNumberOfThreads();
    void contoursLieAtTheirHeights();
    void emptyViewSaysWhatToDo();
    void surfaceGoesWithItsProducts();
    void clickTellsOfThePlace();
    void cardSelectsTheStretch();
    void clickOnPinSelectsTheMark();
    void namesOfMarksLieOnNothing();
    void namesWithoutRoomStandAtTheEndOfALine();
    void dragTurnsAndShiftDragMoves();
    void keysTurnZoomAndReset();
    void layersChangeThePicture();
    void hiddenRunIsNotDrawn();
    void stretchIsDrawnOnItsRun();
    void editsAndEdgesLieOnTheSurface();
    void changeOfHeightIsALayer();
    void exaggerationIsStated();
    void newResultsKeepTheView();
    void openGlDrawsTheSamePicture();
    void pictures();

  private:
    struct Shown {
        std::unique_ptr<ViewState> state = std::make_unique<ViewState>();
        std::unique_ptr<Selection> selection = std::make_unique<Selection>();
        std::unique_ptr<TerrainView> view;
    };
    [[nodiscard]] Shown shownView(TerrainRenderer renderer = TerrainRenderer::Automatic) const;
    /// Where a mark stands on the screen, in the picture.
    [[nodiscard]] static QPointF onPicture(const TerrainView& view, const Eigen::Vector3d& map_m);
    test::ProcessedSample sample_;
};

void TestTerrainView::initTestCase() {
    applyTheme(Theme::Light);
    sample_ = test::processedSample("quick_plot");
}

TestTerrainView::Shown TestTerrainView::shownView(TerrainRenderer renderer) const {
    Shown shown;
    shown.view = std::make_unique<TerrainView>(*shown.state, *shown.selection, renderer);
    shown.view->resize(900, 640);
    QSignalSpy ready(shown.view.get(), &TerrainView::surfaceShown);
    shown.view->show(sample_.survey, sample_.map, sample_.products);
    shown.view->show();
    if (!QTest::qWaitForWindowExposed(shown.view.get()) || (ready.isEmpty() && !ready.wait(20'000))) {
        qFatal("no surface");
    }
    return shown;
}

QPointF TestTerrainView::onPicture(const TerrainView& view, const Eigen::Vector3d& map_m) {
    const TerrainFrame& frame = view.frame();
    const auto seen = frame.camera.project(frame.scene->toScene(map_m, frame.exaggeration));
    return seen ? QPointF(seen->x(), seen->y()) : QPointF(-1, -1);
}

void TestTerrainView::sightLineMeetsItsPixel() {
    OrbitCamera camera;
    for (const ViewFrom side : kSides) {
        camera.turn(side);
        for (const Eigen::Vector2d& px :
             {Eigen::Vector2d(0, 0), Eigen::Vector2d(320, 240), Eigen::Vector2d(600, 31)}) {
            const SightLine sight = camera.through(px);
            const auto seen = camera.project(sight.from_m + 87.0 * sight.direction);
            QVERIFY(seen);
            QVERIFY((seen->head<2>() - px).norm() < 1e-6);
        }
    }
}

void TestTerrainView::zoomKeepsTheFixedPoint() {
    OrbitCamera camera;
    camera.turn(ViewFrom::Oblique);
    const Eigen::Vector3d fixed_m(12.0, -7.0, 3.0);
    const Eigen::Vector3d before = *camera.project(fixed_m);
    const double distance_m = (camera.eye_m() - fixed_m).norm();
    camera.zoom(1.7, fixed_m);
    QVERIFY((camera.project(fixed_m)->head<2>() - before.head<2>()).norm() < 1e-6);
    QVERIFY(std::abs((camera.eye_m() - fixed_m).norm() - distance_m / 1.7) < 1e-9);
}

void TestTerrainView::fitKeepsAllWithinTheMargins() {
    const std::vector<Eigen::Vector3d> points{{-40, -10, 0}, {40, -10, 2}, {40, 15, 9}, {-40, 15, 0}};
    const ViewMargins margins{80, 20, 140, 60};
    for (const ViewFrom side : kSides) {
        OrbitCamera camera;
        camera.viewport_px = {900, 700};
        camera.radius_m = 50;
        camera.turn(side);
        camera.fit(points, margins);
        double widest = 0.0;
        for (const Eigen::Vector3d& p : points) {
            const auto seen = camera.project(p);
            QVERIFY(seen);
            QVERIFY2(seen->x() > 78 && seen->x() < 762 && seen->y() > 18 && seen->y() < 642,
                     qPrintable(QString("%1, %2").arg(seen->x()).arg(seen->y())));
            widest = std::max({widest, std::abs(seen->x() - 420) / 340, std::abs(seen->y() - 330) / 310});
        }
        // And it does not stand farther off than it must.
        QVERIFY2(widest > 0.85, qPrintable(QString::number(widest)));
    }
}

void TestTerrainView::fromAboveNorthIsUp() {
    OrbitCamera camera;
    camera.turn(ViewFrom::Above);
    const auto middle = *camera.project({0, 0, 0}), north = *camera.project({0, 10, 0}),
               east = *camera.project({10, 0, 0});
    QVERIFY(north.y() < middle.y() - 10 && std::abs(north.x() - middle.x()) < 1e-6);
    QVERIFY(east.x() > middle.x() + 10 && std::abs(east.y() - middle.y()) < 1e-6);
}

void TestTerrainView::heightsBetweenCellsLieOnThePlane() {
    const TerrainScene scene(plane(40), {});
    // Heights are floats of some tens of metres.
    for (const auto& [x, y] : {std::pair{105.3, 207.9}, std::pair{110.0, 210.0}, std::pair{119.6, 201.1}}) {
        const auto height = scene.heightAt(x, y);
        QVERIFY(height);
        QVERIFY(std::abs(*height - planeAt(x, y)) < 1e-5);
    }
    QVERIFY(!scene.heightAt(99.0, 210.0));
}

void TestTerrainView::sightLineHitsThePlane() {
    const TerrainScene scene(plane(150), {});
    for (const double exaggeration : {1.0, 4.0}) {
        OrbitCamera camera = cameraOver(scene, ViewFrom::Oblique);
        const Eigen::Vector3d place(135.2, 233.7, planeAt(135.2, 233.7));
        const Eigen::Vector3d at = scene.toScene(place, exaggeration);
        const auto seen = camera.project(at);
        const auto hit = scene.firstHit(camera.through(seen->head<2>()), exaggeration);
        QVERIFY(hit);
        QVERIFY2((*hit - at).norm() < 1e-3, qPrintable(QString::number((*hit - at).norm())));
    }
    QVERIFY(!scene.firstHit({{0, 0, 1000}, Eigen::Vector3d::UnitZ()}, 1.0));
}

void TestTerrainView::blockHasAllTrianglesAndWallsAround() {
    const TerrainScene scene(plane(20), {});
    QCOMPARE(scene.blockCount(), std::size_t{1});
    const Counted counted = count(scene.build({0, 0}));
    QCOMPARE(counted.surface, std::size_t{2 * 19 * 19});
    QCOMPARE(counted.walls, std::size_t{2 * 4 * 19});
    QCOMPARE(counted.facing_down, std::size_t{0});
}

void TestTerrainView::holeHasWalls() {
    auto products = plane(20);
    products->dem.heights_m[10 * 20 + 10] = kNoHeight;
    const TerrainScene scene(products, {});
    const Counted counted = count(scene.build({0, 0}));
    // Each of the four squares at the hole keeps one triangle, and has one wall.
    QCOMPARE(counted.surface, std::size_t{2 * 19 * 19 - 4});
    QCOMPARE(counted.walls, std::size_t{2 * (4 * 19 + 4)});
    QCOMPARE(counted.facing_down, std::size_t{0});
}

void TestTerrainView::neighboursHaveNoWallBetween() {
    const TerrainScene scene(plane(TerrainScene::kBlockCells + 11), {});
    QCOMPARE(scene.blockCount(), std::size_t{4});
    std::size_t surface = 0, walls = 0;
    for (std::uint32_t i = 0; i < 4; ++i) {
        const Counted counted = count(scene.build({i, 0}));
        surface += counted.surface;
        walls += counted.walls;
    }
    const std::size_t edge = TerrainScene::kBlockCells + 10;
    QCOMPARE(surface, 2 * edge * edge);
    QCOMPARE(walls, 2 * 4 * edge);
}

void TestTerrainView::coarserLevelsKeepTheEdge() {
    auto products = plane(100);
    // A survey that is no rectangle: known within a circle.
    for (std::size_t row = 0; row < 100; ++row) {
        for (std::size_t column = 0; column < 100; ++column) {
            const double far =
                std::hypot(static_cast<double>(row) - 50.0, static_cast<double>(column) - 50.0);
            if (far > 45.0) products->dem.heights_m[row * 100 + column] = kNoHeight;
        }
    }
    const TerrainScene scene(products, {});
    for (std::uint32_t level = 0; level < 4; ++level) {
        double farthest_m = 0.0;
        for (std::uint32_t block = 0; block < scene.blockCount(); ++block) {
            for (const TerrainVertex& v : scene.build({block, level}).vertices) {
                farthest_m = std::max(
                    farthest_m, std::hypot(static_cast<double>(v.at_m[0]), static_cast<double>(v.at_m[1])));
            }
        }
        // A step of the level, no more.
        const double step_m = kCell_m * std::pow(2.0, level);
        QVERIFY2(farthest_m < 45.0 * kCell_m + kCell_m && farthest_m > 45.0 * kCell_m - 1.5 * step_m,
                 qPrintable(QString::number(farthest_m)));
    }
}

void TestTerrainView::selectionKeepsToTheBudget() {
    const TerrainScene scene(plane(700), {});
    const OrbitCamera camera = cameraOver(scene, ViewFrom::Oblique);
    std::size_t before = 0;
    for (const std::size_t budget : {std::size_t{20'000}, std::size_t{100'000}, std::size_t{400'000}}) {
        const std::size_t drawn = triangles(scene, scene.select(camera, 1.0, budget));
        QVERIFY2(static_cast<double>(drawn) < 1.15 * static_cast<double>(budget),
                 qPrintable(QString::number(drawn)));
        QVERIFY(drawn > before);
        before = drawn;
    }
    // What is near is finer than what is far.
    OrbitCamera low = camera;
    low.elevation_rad = 0.15;
    low.distance_m *= 0.3;
    std::uint32_t least = 99, greatest = 0;
    for (const BlockLevel which : scene.select(low, 1.0, 60'000)) {
        least = std::min(least, which.level);
        greatest = std::max(greatest, which.level);
    }
    QVERIFY(least < greatest);
}

void TestTerrainView::nothingIsChosenOutOfView() {
    const TerrainScene scene(plane(200), {});
    OrbitCamera camera = cameraOver(scene, ViewFrom::South);
    QVERIFY(!scene.select(camera, 1.0, 1'000'000).empty());
    camera.target_m.x() += 50.0 * camera.radius_m;
    QVERIFY(scene.select(camera, 1.0, 1'000'000).empty());
}

void TestTerrainView::budgetFollowsTheFrames() {
    FrameBudget budget(40.0);
    for (int i = 0; i < 30; ++i)
        budget.took(budget.triangles(), static_cast<double>(budget.triangles()) / 10'000.0);
    // A machine that draws 10 000 triangles in a millisecond draws 400 000 in 40.
    QVERIFY(std::abs(static_cast<double>(budget.triangles()) - 400'000.0) < 4'000.0);
}

void TestTerrainView::flatGroundHasOneTint() {
    auto products = plane(60);
    std::fill(products->dem.heights_m.begin(), products->dem.heights_m.end(), 3.0F);
    TerrainFrame frame =
        frameOver(std::make_shared<const TerrainScene>(products, RasterPicture{}), ViewFrom::Above);
    frame.to_light = Eigen::Vector3d::UnitZ();
    const QImage picture = pictureOf(frame);
    const QColor own(176, 178, 172);
    const double bright = shade(1.0, false);
    const QColor lit(std::min(255, static_cast<int>(own.red() * bright)),
                     std::min(255, static_cast<int>(own.green() * bright)),
                     std::min(255, static_cast<int>(own.blue() * bright)));
    std::size_t ground = 0;
    for (int y = 100; y < 500; y += 7) {
        for (int x = 250; x < 550; x += 7) {
            const QColor seen = picture.pixelColor(x, y);
            QVERIFY2(std::abs(seen.red() - lit.red()) <= 1 && std::abs(seen.blue() - lit.blue()) <= 1,
                     qPrintable(seen.name() + " " + lit.name()));
            ++ground;
        }
    }
    QVERIFY(ground > 1000);
    QCOMPARE(picture.pixelColor(2, 2), frame.sky_above);
}

void TestTerrainView::whatIsNearHidesWhatIsFar() {
    auto products = plane(120);
    // Level ground with a high wall across the middle: from the south its northern half cannot be seen.
    for (std::size_t row = 0; row < 120; ++row) {
        for (std::size_t column = 0; column < 120; ++column) {
            products->dem.heights_m[row * 120 + column] = row > 58 && row < 62 ? 40.0F : 0.0F;
        }
    }
    RasterPicture picture;
    picture.layer = RasterLayer::Source;
    picture.geometry = products->dem.geometry;
    QImage colours(120, 120, QImage::Format_ARGB32_Premultiplied);
    colours.fill(QColor(0, 0, 200));
    for (int row = 0; row < 57; ++row) {
        for (int column = 0; column < 120; ++column) colours.setPixelColor(column, row, QColor(200, 0, 0));
    }
    picture.levels = {colours};
    const auto red = [&](ViewFrom side) {
        const QImage seen =
            pictureOf(frameOver(std::make_shared<const TerrainScene>(products, picture), side));
        std::size_t n = 0;
        for (int y = 0; y < seen.height(); ++y) {
            for (int x = 0; x < seen.width(); ++x) {
                const QColor c = seen.pixelColor(x, y);
                if (c.red() > 60 && c.blue() < 40 && c.green() < 20) ++n;
            }
        }
        return n;
    };
    QCOMPARE(red(ViewFrom::South), std::size_t{0});
    QVERIFY(red(ViewFrom::North) > 1000);
}

void TestTerrainView::pictureIsTheSameOnAnyNumberOfThreads() {
    const auto products = sample_.products;
    auto scene =
        std::make_shared<const TerrainScene>(products, rasterPicture(*products, RasterLayer::Height));
    TerrainFrame frame = frameOver(scene, ViewFrom::Oblique);
    frame.contour_interval_m = 0.5;
    frame.overlay = std::make_shared<const SceneOverlay>(
        sceneOverlay(*scene, MapScene{sample_.map, products}, {}, QPalette()));
    const QImage several = pictureOf(frame);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    QCOMPARE(pictureOf(frame), several);
}

void TestTerrainView::contoursLieAtTheirHeights() {
    auto products = plane(160);
    auto scene = std::make_shared<const TerrainScene>(products, RasterPicture{});
    TerrainFrame frame = frameOver(scene, ViewFrom::Above);
    frame.camera.distance_m *= 0.7;
    const QImage plain = pictureOf(frame);
    frame.contour_interval_m = 2.0;
    const QImage lined = pictureOf(frame);
    std::size_t lines = 0;
    for (int y = 150; y < 450; ++y) {
        const auto hit = scene->firstHit(frame.camera.through({400.5, y + 0.5}), 1.0);
        QVERIFY(hit);
        const double level = scene->toMap(*hit, 1.0).z() / 2.0;
        const double away = std::abs(level - std::round(level));
        const bool dark = plain.pixelColor(400, y).red() - lined.pixelColor(400, y).red() > 25;
        if (dark) ++lines;
        // A line is about a pixel wide; the plane rises a hundredth of a contour in that.
        if (dark) QVERIFY2(away < 0.03, qPrintable(QString::number(away)));
    }
    QVERIFY2(lines >= 3, qPrintable(QString::number(lines)));
}

void TestTerrainView::emptyViewSaysWhatToDo() {
    ViewState state;
    Selection selection;
    TerrainView view(state, selection);
    view.resize(500, 400);
    view.show();
    const QImage nothing = view.grab().toImage();
    view.show(sample_.survey, sample_.map, nullptr);
    QVERIFY(!view.building());
    QVERIFY(view.canvas() == nullptr);
    // Other words than without a survey.
    QVERIFY(view.grab().toImage() != nothing);
    QTest::mouseClick(&view, Qt::LeftButton, {}, {250, 200});
    QVERIFY(!view.picked_map_m());
}

void TestTerrainView::surfaceGoesWithItsProducts() {
    const Shown shown = shownView();
    TerrainView& view = *shown.view;
    view.show(sample_.survey, sample_.map, nullptr);
    QTest::qWait(50);
    QVERIFY(!view.frame().scene);
    QVERIFY(!view.canvas()->widget()->isVisible());
    QSignalSpy ready(&view, &TerrainView::surfaceShown);
    view.show(sample_.survey, sample_.map, sample_.products);
    QVERIFY(ready.wait(10'000));
    QVERIFY(view.canvas()->widget()->isVisible());
}

void TestTerrainView::clickTellsOfThePlace() {
    const Shown shown = shownView();
    TerrainView& view = *shown.view;
    const PlacedMark& mark = sample_.map->marks.front();
    Eigen::Vector3d place = mark.map_m + Eigen::Vector3d(2.0, 3.0, 0.0);
    const auto height = view.frame().scene->heightAt(place.x(), place.y());
    QVERIFY(height);
    place.z() = *height;
    view.viewFrom(ViewFrom::Above);
    for (const double exaggeration : {1.0, 3.0}) {
        view.setExaggeration(exaggeration);
        QSignalSpy picked(&view, &TerrainView::picked);
        const QPoint at = (onPicture(view, place) + QPointF(view.canvas()->widget()->pos())).toPoint();
        QTest::mouseClick(&view, Qt::LeftButton, {}, at);
        QCOMPARE(picked.size(), 1);
        const QPointF told = picked.front().front().toPointF();
        // Within a pixel of the screen.
        const double pixel_m = 1.0 / view.camera().pixelsPerMetre(view.camera().distance_m);
        QVERIFY(std::hypot(told.x() - place.x(), told.y() - place.y()) < 1.5 * pixel_m);
        const auto* card = view.findChild<PointCard*>();
        QVERIFY(card->isVisible());
        const auto known = readingAt(*sample_.products, told);
        QVERIFY(known);
        QVERIFY(std::abs(view.picked_map_m()->z() - known->height_m) < 0.5);
    }
    QTest::keyClick(&view, Qt::Key_Escape);
    QVERIFY(!view.picked_map_m());
}

void TestTerrainView::cardSelectsTheStretch() {
    const Shown shown = shownView();
    TerrainView& view = *shown.view;
    view.pickAt(onPicture(view, sample_.map->marks.front().map_m));
    QVERIFY(view.picked_map_m());
    QTest::mouseClick(view.findChild<QPushButton*>("selectStretch"), Qt::LeftButton);
    QCOMPARE(shown.selection->stretches().size(), 1U);
    const TrackStretch& stretch = shown.selection->stretches().front();
    // The nearest used point, sought here in the plain way.
    double least_m = HUGE_VAL, time_s = -1.0;
    std::size_t run = 0;
    for (const GroundPoint& point : sample_.products->ground_points) {
        if (point.state != GroundPointState::Used) continue;
        const auto& track = sample_.products->trajectories[point.run];
        static_cast<void>(track);
        const double far_m = (point.enu_m.head<2>() - Eigen::Vector2d::Zero()).norm();
        if (far_m < least_m) {
            least_m = far_m;
            time_s = point.time_s;
            run = point.run;
        }
    }
    // The first mark is the zero point, the origin of the local frame: the hit lies within a pixel of it, so
    // the point may be another one that is as near.
    const double pixel_m = 1.0 / view.camera().pixelsPerMetre(view.camera().distance_m);
    if (stretch.run == QString::fromStdString(sample_.survey->runs[run].id)) {
        QVERIFY(stretch.to_s > stretch.from_s && stretch.to_s - stretch.from_s <= 10.0 + 1e-9);
    }
    double best_m = HUGE_VAL;
    for (const GroundPoint& point : sample_.products->ground_points) {
        const bool within = QString::fromStdString(sample_.survey->runs[point.run].id) == stretch.run &&
                            point.time_s >= stretch.from_s && point.time_s <= stretch.to_s;
        if (within && point.state == GroundPointState::Used) {
            best_m = std::min(best_m, point.enu_m.head<2>().norm());
        }
    }
    QVERIFY2(best_m < least_m + 4.0 * pixel_m,
             qPrintable(QString("%1 %2 %3").arg(best_m).arg(least_m).arg(time_s)));
}

void TestTerrainView::clickOnPinSelectsTheMark() {
    const Shown shown = shownView();
    TerrainView& view = *shown.view;
    view.viewFrom(ViewFrom::Above);
    const PlacedMark& mark = sample_.map->marks.back();
    view.pickAt(onPicture(view, mark.map_m));
    QCOMPARE(shown.selection->item(), QString::fromStdString(mark.mark.name));
}

void TestTerrainView::namesOfMarksLieOnNothing() {
    std::vector<MarkName> marks;
    for (const QPointF at : {QPointF(100, 100), {130, 100}, {112, 112}, {95, 125}, {300, 90}}) {
        marks.push_back({at, QString("FP%1").arg(marks.size()), false, 30.0});
    }
    const QFontMetricsF metrics{QFont()};
    const QRectF legend(250, 70, 40, 60), seen(0, 0, 400, 300);
    // The last one has the legend at its right, and one lies beyond the view.
    marks.push_back({{236, 100}, "FP6", false, 30.0});
    marks.push_back({{-40, 100}, "FP7", false, 30.0});
    const MarkNames names = placeMarkNames(metrics, marks, {seen, {legend}});
    std::set<std::size_t> named;
    for (const PlacedName& place : names.places) {
        named.insert(place.mark);
        QVERIFY(seen.contains(place.box));
        QVERIFY(!place.box.intersects(legend));
        for (const PlacedName& other : names.places)
            QVERIFY(&place == &other || !place.box.intersects(other.box));
        for (const MarkName& mark : marks) {
            QVERIFY(!place.box.intersects({mark.at - QPointF(8, 8), QSizeF(16, 16)}));
            QVERIFY(!place.box.intersects({mark.at.x() - 2, mark.at.y(), 4, mark.pin_px}));
        }
        // Who stands alone has the name at the right.
        if (place.mark == 4) QVERIFY(place.start.x() > 300 && !place.led);
    }
    QCOMPARE(named, (std::set<std::size_t>{0, 1, 2, 3, 4, 5}));
}

void TestTerrainView::namesWithoutRoomStandAtTheEndOfALine() {
    const QFontMetricsF metrics{QFont()};
    const QRectF seen(0, 0, 400, 300);
    const auto among = [&](std::size_t count, bool far_too) {
        std::vector<MarkName> heap(count, MarkName{{200, 150}, "FP"});
        return placeMarkNames(metrics, heap, {seen, {}, far_too}).places;
    };
    const auto led = [](const std::vector<PlacedName>& places) {
        return std::count_if(places.begin(), places.end(), [](const PlacedName& p) { return p.led; });
    };
    QCOMPARE(among(12, true).size(), 12U);
    QVERIFY(led(among(12, true)) >= 8);
    QVERIFY(among(12, false).size() < 12);
    QCOMPARE(led(among(12, false)), 0);
    // Hundreds on one place: as many as can be read, and the highlighted one.
    std::vector<MarkName> heap(500, MarkName{{200, 150}, "FP"});
    heap.back().highlighted = true;
    const MarkNames names = placeMarkNames(metrics, heap, {seen, {}});
    QVERIFY(names.places.size() < 60);
    QCOMPARE(names.places.back().mark, heap.size() - 1);
}

void TestTerrainView::dragTurnsAndShiftDragMoves() {
    const Shown shown = shownView();
    TerrainView& view = *shown.view;
    const auto drag = [&](Qt::MouseButton button, Qt::KeyboardModifiers keys) {
        const QPoint from(400, 300), to(460, 330);
        QTest::mousePress(&view, button, keys, from);
        QMouseEvent move(QEvent::MouseMove, to, view.mapToGlobal(to), Qt::NoButton, button, keys);
        QApplication::sendEvent(&view, &move);
        QTest::mouseRelease(&view, button, keys, to);
    };
    QSignalSpy picked(&view, &TerrainView::picked);
    OrbitCamera before = view.camera();
    drag(Qt::LeftButton, {});
    QVERIFY(std::abs(view.camera().azimuth_rad - before.azimuth_rad) > 0.1);
    QVERIFY(view.camera().target_m.isApprox(before.target_m));
    for (const auto& [button, keys] : {std::pair{Qt::RightButton, Qt::KeyboardModifiers{}},
                                       std::pair{Qt::LeftButton, Qt::KeyboardModifiers(Qt::ShiftModifier)}}) {
        before = view.camera();
        drag(button, keys);
        QCOMPARE(view.camera().azimuth_rad, before.azimuth_rad);
        QVERIFY((view.camera().target_m - before.target_m).norm() > 0.01);
    }
    // A drag is no click.
    QCOMPARE(picked.size(), 0);
}

void TestTerrainView::keysTurnZoomAndReset() {
    const Shown shown = shownView();
    TerrainView& view = *shown.view;
    const OrbitCamera first = view.camera();
    QTest::keyClick(&view, Qt::Key_Left);
    QVERIFY(view.camera().azimuth_rad != first.azimuth_rad);
    QTest::keyClick(&view, Qt::Key_Plus);
    QVERIFY(view.camera().distance_m < first.distance_m);
    QTest::keyClick(&view, Qt::Key_Up, Qt::ShiftModifier);
    QVERIFY(!view.camera().target_m.isApprox(first.target_m));
    QTest::keyClick(&view, Qt::Key_Home);
    QVERIFY(std::abs(view.camera().azimuth_rad - first.azimuth_rad) < 1e-9);
    QVERIFY(std::abs(view.camera().distance_m - first.distance_m) < 1e-6 * first.distance_m);
}

void TestTerrainView::layersChangeThePicture() {
    const Shown shown = shownView(TerrainRenderer::Software);
    TerrainView& view = *shown.view;
    shown.state->setShown(&ViewChoice::tracks, false);
    std::vector<QImage> seen;
    for (const RasterLayer layer : {RasterLayer::Height, RasterLayer::Uncertainty, RasterLayer::Density,
                                    RasterLayer::Source, RasterLayer::None}) {
        QSignalSpy ready(&view, &TerrainView::surfaceShown);
        shown.state->setLayer(layer);
        if (view.building()) QVERIFY(ready.wait(10'000));
        const QImage picture = view.canvas()->picture();
        for (const QImage& other : seen) QVERIFY(picture != other);
        seen.push_back(picture);
    }
}

void TestTerrainView::hiddenRunIsNotDrawn() {
    const Shown shown = shownView();
    TerrainView& view = *shown.view;
    const auto vertices = [&] {
        std::size_t n = 0;
        for (const SceneLine& line : view.frame().overlay->lines) n += line.on_ground ? line.at_m.size() : 0;
        return n;
    };
    const std::size_t all = vertices();
    shown.state->setRunVisible(QString::fromStdString(sample_.survey->runs.back().id), false);
    const std::size_t fewer = vertices();
    QVERIFY(fewer > 0 && fewer < all);
    shown.state->setShown(&ViewChoice::tracks, false);
    shown.state->setShown(&ViewChoice::edges, false);
    QCOMPARE(vertices(), std::size_t{0});
    shown.state->setShown(&ViewChoice::points, true);
    QVERIFY(!view.frame().overlay->dots.empty());
}

void TestTerrainView::stretchIsDrawnOnItsRun() {
    const Shown shown = shownView();
    TerrainView& view = *shown.view;
    shown.state->setShown(&ViewChoice::tracks, false);
    shown.state->setShown(&ViewChoice::edges, false);
    const MapTrack& track = sample_.map->tracks.back();
    const double from_s = track.time_s[track.time_s.size() / 3], to_s = track.time_s[track.time_s.size() / 2];
    shown.selection->select({QString::fromStdString(track.run_id), from_s, to_s});
    std::size_t drawn = 0;
    for (const SceneLine& line : view.frame().overlay->lines) {
        if (!line.on_ground) continue;
        for (const Eigen::Vector3f& at : line.at_m) {
            double least_m = HUGE_VAL;
            const Eigen::Vector3d place = view.frame().scene->toMap(at.cast<double>(), 1.0);
            for (std::size_t i = 0; i < track.time_s.size(); ++i) {
                if (track.time_s[i] < from_s || track.time_s[i] > to_s) continue;
                least_m = std::min(least_m, (track.map_m[i] - place).head<2>().norm());
            }
            QVERIFY(least_m < 1e-3);
            ++drawn;
        }
    }
    QVERIFY(drawn > 10);
    shown.selection->clear();
    for (const SceneLine& line : view.frame().overlay->lines) QVERIFY(!line.on_ground);
}

void TestTerrainView::editsAndEdgesLieOnTheSurface() {
    const Shown shown = shownView();
    TerrainView& view = *shown.view;
    shown.state->setShown(&ViewChoice::tracks, false);
    shown.state->setShown(&ViewChoice::edges, false);
    const auto linesOf = [&](QRgb colour) {
        std::size_t n = 0;
        for (const SceneLine& line : view.frame().overlay->lines) {
            if (!line.on_ground || line.colours.front() != colour) continue;
            ++n;
            for (const Eigen::Vector3f& at : line.at_m) {
                const Eigen::Vector3d place = view.frame().scene->toMap(at.cast<double>(), 1.0);
                const auto height = view.frame().scene->heightAt(place.x(), place.y());
                if (!height || std::abs(*height - place.z()) > 1e-3) return std::size_t{0};
            }
        }
        return n;
    };
    const MapTrack& track = sample_.map->tracks.back();
    const Eigen::Vector3d middle = view.frame().scene->origin_map_m();
    SurveyEdits edits;
    edits.stretches.push_back(
        {track.run_id, track.time_s[track.time_s.size() / 3], track.time_s[track.time_s.size() / 2], {}});
    edits.lines.push_back(
        {{middle - Eigen::Vector3d(3, 2, 0), middle + Eigen::Vector3d(3, 2, 0)}, BreaklineKind::Hard, {}});
    shown.state->setEdits(edits);
    QVERIFY(linesOf(kExcludedInk.rgb()) > 0);
    QVERIFY(linesOf(lineColour(BreaklineKind::Hard).rgb()) > 0);
    shown.state->setEdits({});
    QCOMPARE(linesOf(kExcludedInk.rgb()), std::size_t{0});
    QCOMPARE(linesOf(lineColour(BreaklineKind::Hard).rgb()), std::size_t{0});
    shown.state->setShown(&ViewChoice::edges, true);
    QCOMPARE(linesOf(kEdgeInk.rgb()) > 0, !sample_.products->terrace_edges.empty());
}

void TestTerrainView::changeOfHeightIsALayer() {
    auto earlier = *sample_.products;
    for (float& h : earlier.dem.heights_m) h -= 5.0F;
    const auto change = changeSince(*sample_.products, earlier, "before", {});
    QVERIFY(change.has_value());
    const RasterPicture picture = rasterPicture(*sample_.products, RasterLayer::Change, &*change);
    QVERIFY(!picture.levels.empty());
    QVERIFY(std::abs(picture.legend.high - 5.0) < 1e-3);
    QCOMPARE(picture.legend.low, -picture.legend.high);
    QVERIFY(picture.legend.notes.front().contains("before"));
    // All rose as far as the ramp reaches.
    const QColor risen = picture.legend.ramp.back();
    for (std::size_t i = 0; i < sample_.products->dem.geometry.size(); ++i) {
        const auto columns = sample_.products->dem.geometry.columns;
        const QColor c =
            picture.levels.front().pixelColor(static_cast<int>(i % columns), static_cast<int>(i / columns));
        QCOMPARE(c.alpha() > 0, !std::isnan(sample_.products->dem.heights_m[i]));
        if (c.alpha() > 0)
            QVERIFY(std::abs(c.red() - risen.red()) <= 1 && std::abs(c.blue() - risen.blue()) <= 1);
    }
    // Of other results it shows nothing.
    auto other = *sample_.products;
    other.dem.geometry.west_m += other.dem.geometry.cell_m;
    QVERIFY(rasterPicture(other, RasterLayer::Change, &*change).levels.empty());
    const Shown shown = shownView(TerrainRenderer::Software);
    const QImage heights = shown.view->canvas()->picture();
    QSignalSpy ready(shown.view.get(), &TerrainView::surfaceShown);
    shown.state->setChange(std::make_shared<const HeightChange>(*change));
    QCOMPARE(shown.state->now().layer, RasterLayer::Change);
    QVERIFY(ready.wait(10'000));
    QVERIFY(shown.view->canvas()->picture() != heights);
    shown.state->setChange(nullptr);
    QCOMPARE(shown.state->now().layer, RasterLayer::Height);
}

void TestTerrainView::exaggerationIsStated() {
    const Shown shown = shownView();
    TerrainView& view = *shown.view;
    view.setExaggeration(1.0);
    QApplication::processEvents();
    const QImage before = view.grab({0, view.height() - 60, 300, 60}).toImage();
    view.setExaggeration(5.0);
    QCOMPARE(view.frame().exaggeration, 5.0);
    QVERIFY(view.grab({0, view.height() - 60, 300, 60}).toImage() != before);
    view.setExaggeration(1000.0);
    QCOMPARE(view.frame().exaggeration, 20.0);
}

void TestTerrainView::newResultsKeepTheView() {
    const Shown shown = shownView();
    TerrainView& view = *shown.view;
    view.zoomBy(2.0);
    const OrbitCamera before = view.camera();
    auto again = std::make_shared<Products>(*sample_.products);
    for (float& h : again->dem.heights_m) h += 0.5F;
    QSignalSpy ready(&view, &TerrainView::surfaceShown);
    view.show(sample_.survey, sample_.map, again);
    QVERIFY(ready.wait(10'000));
    QCOMPARE(view.camera().distance_m, before.distance_m);
    QVERIFY((view.camera().target_m - before.target_m).head<2>().norm() < 1e-6);
}

/// Two ways of drawing that share no code but the blocks.
void TestTerrainView::openGlDrawsTheSamePicture() {
    if (openGl() == OpenGlKind::None) QSKIP("no OpenGL here");
    std::vector<QImage> pictures;
    for (const TerrainRenderer renderer : {TerrainRenderer::OpenGl, TerrainRenderer::Software}) {
        const Shown shown = shownView(renderer);
        QSignalSpy drawn(shown.view.get(), &TerrainView::drawn);
        shown.view->viewFrom(ViewFrom::Oblique);
        QTRY_VERIFY_WITH_TIMEOUT(!drawn.isEmpty() && drawn.back()[2].toBool(), 20'000);
        pictures.push_back(shown.view->canvas()->picture().convertToFormat(QImage::Format_RGB32));
    }
    QCOMPARE(pictures[0].size(), pictures[1].size());
    // Along edges of lines and contours they smooth in different ways; over the whole they agree.
    double sum = 0.0;
    std::size_t far = 0;
    for (int y = 0; y < pictures[0].height(); ++y) {
        for (int x = 0; x < pictures[0].width(); ++x) {
            const QColor a = pictures[0].pixelColor(x, y), b = pictures[1].pixelColor(x, y);
            const int off =
                std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) + std::abs(a.blue() - b.blue());
            sum += off / 3.0;
            if (off > 90) ++far;
        }
    }
    const double n = static_cast<double>(pictures[0].width()) * pictures[0].height();
    QVERIFY2(sum / n < 4.0, qPrintable(QString::number(sum / n)));
    QVERIFY2(static_cast<double>(far) / n < 0.05, qPrintable(QString::number(static_cast<double>(far) / n)));
}

/// Pictures of all looks, for a person to look at: only where TERRAWALK_PICTURES names a folder.
void TestTerrainView::pictures() {
    const QString folder = qEnvironmentVariable("TERRAWALK_PICTURES");
    if (folder.isEmpty()) QSKIP("TERRAWALK_PICTURES is not set");
    const auto sample = test::processedSample("mango_orchard");
    for (const Theme theme : {Theme::Light, Theme::Dark}) {
        applyTheme(theme);
        ViewState state;
        Selection selection;
        const bool opengl = openGl() != OpenGlKind::None;
        TerrainView view(state, selection, opengl ? TerrainRenderer::OpenGl : TerrainRenderer::Software);
        view.resize(1280, 800);
        view.show(sample.survey, sample.map, sample.products);
        QSignalSpy shown(&view, &TerrainView::surfaceShown);
        view.show();
        QVERIFY(QTest::qWaitForWindowExposed(&view));
        QVERIFY(!view.building() || shown.wait(20'000));
        const QString stem =
            folder + "/terrain_" + view.canvas()->about() + (theme == Theme::Dark ? "_dark" : "_light");
        const auto save = [&](const QString& name) {
            QTRY_VERIFY_WITH_TIMEOUT(!view.building(), 10'000);
            QTest::qWait(800);
            QVERIFY(view.grab().save(stem + "_" + name + ".png"));
        };
        save("oblique");
        view.pickAt({700, 420});
        const auto& log = sample.survey->runs.back().log;
        selection.select({QString::fromStdString(sample.survey->runs.back().id), log.time_s[log.size() / 3],
                          log.time_s[log.size() / 2]});
        save("picked");
        view.viewFrom(ViewFrom::Above);
        state.setLayer(RasterLayer::Uncertainty);
        state.setColouring(TrackColouring::SigmaHeight);
        save("above");
        view.viewFrom(ViewFrom::South);
        state.setLayer(RasterLayer::Source);
        state.setShown(&ViewChoice::points, true);
        save("south");
        state.setLayer(RasterLayer::Height);
        view.resetView();
        for (int i = 0; i < 6; ++i) view.zoomBy(1.25);
        save("near");
    }
    applyTheme(Theme::Light);
}

int main(int argc, char** argv) {
    QApplication app(argc, argv);
    TestTerrainView test;
    return QTest::qExec(&test, argc, argv);
}

#include "test_terrain_view.moc"
