#include <QApplication>
#include <QDir>
#include <QSignalSpy>
#include <QTest>

#include "app/gui/terrain_view.hpp"
#include "app/gui/theme.hpp"
#include "tests/gui/processed_sample.hpp"

using namespace terrawalk;
using namespace terrawalk::gui;

class TestTerrainView : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void pictures();
};

/// Pictures of all looks, for a person to look at: only where TERRAWALK_PICTURES names a folder.
void TestTerrainView::pictures() {
    const QString folder = qEnvironmentVariable("TERRAWALK_PICTURES");
    if (folder.isEmpty()) QSKIP("TERRAWALK_PICTURES is not set");
    const auto sample =
        test::processedSample(qEnvironmentVariable("TERRAWALK_PICTURED", "mango_orchard").toStdString());
    for (const Theme theme : {Theme::Light, Theme::Dark}) {
        applyTheme(theme);
        Selection selection;
        TerrainView view(selection);
        view.resize(1280, 800);
        view.show(sample.survey, sample.map, sample.products);
        view.show();
        QSignalSpy shown(&view, &TerrainView::surfaceShown);
        QVERIFY(QTest::qWaitForWindowExposed(&view));
        QVERIFY(!view.building() || shown.wait(20'000));
        const QString stem =
            folder + "/terrain_" + view.canvas()->about() + (theme == Theme::Dark ? "_dark" : "_light");
        const auto save = [&](const QString& name) {
            QTest::qWait(1500);
            QVERIFY(view.grab().save(stem + "_" + name + ".png"));
        };
        save("oblique");
        view.pickAt({700, 420});
        const auto& log = sample.survey->runs.back().log;
        selection.select({QString::fromStdString(sample.survey->runs.back().id), log.time_s[log.size() / 3],
                          log.time_s[log.size() / 2]});
        save("picked");
        view.viewFrom(ViewFrom::Above);
        view.setLayer(RasterLayer::Uncertainty);
        view.setColouring(TrackColouring::SigmaHeight);
        save("above");
        view.viewFrom(ViewFrom::South);
        view.setLayer(RasterLayer::Source);
        view.setPointsShown(true);
        save("south");
        view.setLayer(RasterLayer::Height);
        view.resetView();
        for (int i = 0; i < 6; ++i) view.zoomBy(1.25);
        save("near");
    }
}

int main(int argc, char** argv) {
    Q_INIT_RESOURCE(gui);
    QApplication app(argc, argv);
    TestTerrainView test;
    return QTest::qExec(&test, argc, argv);
}

#include "test_terrain_view.moc"
