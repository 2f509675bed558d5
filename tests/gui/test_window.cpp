#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QDockWidget>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMenu>
#include <QMenuBar>
#include <QMimeData>
#include <QPrinter>
#include <QProcess>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSettings>
#include <QSignalSpy>
#include <QSpinBox>
#include <QStandardPaths>
#include <QTabWidget>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <QToolBar>
#include <QToolButton>
#include <QTreeView>
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <functional>
#include <tuple>

#include "app/gui/desktop.hpp"
#include "app/gui/export_dialog.hpp"
#include "app/gui/language.hpp"
#include "app/gui/map_panel.hpp"
#include "app/gui/new_survey_dialog.hpp"
#include "app/gui/place_panel.hpp"
#include "app/gui/plot_canvas.hpp"
#include "app/gui/plots_view.hpp"
#include "app/gui/profile_plot.hpp"
#include "app/gui/report_view.hpp"
#include "app/gui/report_words.hpp"
#include "app/gui/runs_dialog.hpp"
#include "app/gui/sample_surveys.hpp"
#include "app/gui/setting_editor.hpp"
#include "app/gui/setting_words.hpp"
#include "app/gui/settings_dialog.hpp"
#include "app/gui/start_page.hpp"
#include "app/gui/steps_panel.hpp"
#include "app/gui/survey_tree_model.hpp"
#include "app/gui/terrain_view.hpp"
#include "app/gui/theme.hpp"
#include "tests/support/slack.hpp"

namespace terrawalk::gui {

namespace fs = std::filesystem;

namespace {

using test::kSlack;
constexpr int kLong_ms = 300000 * kSlack;

QString text(const fs::path& path) {
    return QString::fromStdString(path.string());
}

/// Settings and autosaves of this test: the one on another platform may run beside it.
QString testName() {
    return "terrawalk-test-" + QGuiApplication::platformName();
}

QByteArray bytesOf(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace

/// The whole story on the real window, with the small sample.
class WindowTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void initTestCase();
    void init();
    void cleanup();
    void windowAndSampleOpenQuickly();
    void startPageOffersTheSampleAndOneClickMakesItsDem();
    void clickTellsTheHeightThere();
    void stretchIsExcludedByDraggingAlongATrackAndUndoBringsItBack();
    void areaSelectsAllPassesThroughIt();
    void mapObeysTheKeysAlone();
    void tracksAreColouredByTheirResiduals();
    void unitsAndNumbersAreChosen();
    void breaklineIsDrawnByClicksAndHoldsTheSurface();
    void profileShowsHeightsAlongALine();
    void reportIsShownSavedAndPrinted();
    void settingsAreCheckedAndUndone();
    void sizeOfCellsIsAutoUntilOneIsEntered();
    void allSettingsAreSearchedMarkedAndSetBack();
    void fieldsOfTheStepsStandInOneColumn();
    void cancelStopsSoonAndKeepsWhatWasThere();
    void windowAnswersWhileItWorks();
    void unsavedChangesComeBackAfterTheProcessWasKilled();
    void changesOfTheLastMomentComeBack();
    void arrowKeysChooseInTheTree();
    void resultsInTheTreeShowThemselves();
    void savedSettingsReplayedByTheCommandLineGiveTheSameBytes();
    void aChineseReportReplayedByTheCommandLineIsTheSameBytes();
    void narrowPlacePanelCutsNothing();
    void exportDialogRefusesWhatCannotBe();
    void themeAndLanguageSwitch();
    void badFilesAreErrorsInTheMessagesAndLoseNothing();
    void droppedFolderIsOpened();
    void oddFilesThatAreDroppedAreToldOrTaken();
    void earlierRunsCanBeGoneBackTo();
    void earlierRunsOutliveTheProgram();
    void keptSurfacesOfEarlierRunsAreComparedAfterARestart();
    void runsOfReadOnlySurveysAndBrokenListsAreNoHarm();
    void figuresStandBesideThoseOfTheRunBefore();
    void keysAloneSuffice();
    void droppedLogsAndMarksBecomeASurvey();
    void newSurveyDialogRefusesWhatCannotBe();
    void settingsTravelThroughAnyFile();
    void badSettingsAndSearchesAreMessages();
    void tuningRefusesWhatItCannotDoAndIsPlotted();
    void dialogsCloseAndReopen();
    void changeSinceAnEarlierRunIsALayerOfBothViews();
    void bothViewsFollowOneState();
    void everyPartExplainsItself();
    void everyActionOfTheMenusHasAStatusTip();
    void toolBarsAndMenusShowWhatTheyHold();
    void tabReachesEveryControl();
    void chineseKnowsSettingsStepsAndSentences();
    void orchardNeverSilencesTheWindow();

  private:
    void tabThrough(QWidget& top);
    NewSurveyDialog* newSurveyDialog() const;
    QString looseFiles();
    /// The longest turn of the event loop until something is done.
    struct Silence {
        double wall_ms = 0.0;
        double own_ms = 0.0;  ///< in which this thread worked
    };
    [[nodiscard]] static Silence longestSilence(const std::function<bool()>& done);
    void openSample();
    void processed();
    /// What the window exports and what its command writes.
    void commandGivesTheSameBytes();
    [[nodiscard]] QPoint onScreen(const Eigen::Vector3d& map_m) const {
        return window_->map().transform().toScreen({map_m.x(), map_m.y()}).toPoint();
    }
    [[nodiscard]] SurveySession& session() const { return desktop_->session(); }
    [[nodiscard]] QAction& action(const char* name) const { return *window_->findChild<QAction*>(name); }
    [[nodiscard]] QString messages() const;
    [[nodiscard]] bool idle() const { return !session().busy() && !window_->filling(); }

    std::unique_ptr<QTemporaryDir> scratch_;
    QString sample_;  ///< a copy that may be written beside
    std::unique_ptr<Desktop> desktop_;
    MainWindow* window_ = nullptr;  ///< the desktop's
};

void WindowTest::initTestCase() {
    QStandardPaths::setTestModeEnabled(true);
    QApplication::setOrganizationName("Terrawalk");
    QApplication::setApplicationName(testName());
    QVERIFY(!sampleSurveys().empty());
}

void WindowTest::init() {
    QSettings().clear();
    QDir(QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation)).removeRecursively();
    applyTheme(Theme::Light);
    scratch_ = std::make_unique<QTemporaryDir>();
    sample_ = scratch_->filePath("plot");
    fs::copy(TERRAWALK_SOURCE_DIR "/sample_surveys/quick_plot", sample_.toStdString(),
             fs::copy_options::recursive);
    applyLanguage("en");
    applyFigureStyle({});
    desktop_ = std::make_unique<Desktop>();
    window_ = &desktop_->window();
    window_->resize(1280, 800);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_));
    // Nobody else makes it the active one where no window manager runs, and keys go to the active one.
    QApplication::setActiveWindow(window_);
}

void WindowTest::cleanup() {
    desktop_.reset();
    scratch_.reset();
}

QString WindowTest::messages() const {
    const auto* model = window_->findChild<QListView*>("messages")->model();
    QString all;
    for (int row = 0; row < model->rowCount(); ++row) all += model->index(row, 0).data().toString() + "\n";
    return all;
}

void WindowTest::openSample() {
    window_->open(sample_);
    QTRY_VERIFY_WITH_TIMEOUT(session().survey() && idle(), kLong_ms);
}

void WindowTest::processed() {
    if (!session().survey()) openSample();
    action("process").trigger();
    QTRY_VERIFY_WITH_TIMEOUT(session().products() && idle(), kLong_ms);
    QTRY_VERIFY_WITH_TIMEOUT(!window_->map().preparing(), kLong_ms);
}

// A second for the window and two for the sample on a quiet machine; tests share theirs.
void WindowTest::windowAndSampleOpenQuickly() {
    QElapsedTimer timer;
    timer.start();
    Desktop another;
    another.window().show();
    QVERIFY(QTest::qWaitForWindowExposed(&another.window()));
    const qint64 window_ms = timer.restart();
    another.window().open(TERRAWALK_SOURCE_DIR "/sample_surveys/mango_orchard");
    QTRY_VERIFY_WITH_TIMEOUT(another.session().survey() && !another.session().busy(), kLong_ms);
    const qint64 open_ms = timer.elapsed();
    qInfo("window %lld ms, sample %lld ms", window_ms, open_ms);
    QVERIFY(window_ms < 10000 * kSlack);
    QVERIFY(open_ms < 20000 * kSlack);
}

void WindowTest::startPageOffersTheSampleAndOneClickMakesItsDem() {
    auto* sample = window_->findChild<QPushButton*>("sample_quick_plot");
    QVERIFY(sample != nullptr);
    QVERIFY(sample->isVisible());
    QTest::mouseClick(sample, Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(session().products() && idle(), kLong_ms);
    QTRY_VERIFY_WITH_TIMEOUT(window_->map().scene().raster != nullptr, kLong_ms);
    QVERIFY(window_->map().isVisible());
    QCOMPARE(window_->map().scene().raster->layer, RasterLayer::Height);
    QVERIFY(messages().contains("Processed."));
    QVERIFY(window_->findChild<QLabel*>("figure")->text().endsWith(" m"));
}

void WindowTest::clickTellsTheHeightThere() {
    processed();
    const auto& dem = session().products()->dem;
    std::size_t cell = dem.geometry.size() / 2;
    while (std::isnan(dem.heights_m[cell])) ++cell;
    const Eigen::Vector3d at(dem.geometry.centreX(cell % dem.geometry.columns),
                             dem.geometry.centreY(cell / dem.geometry.columns), 0);
    // The pointer of the screen itself may come by in between.
    const auto readout = [&] {
        QTest::mouseMove(&window_->map(), onScreen(at));
        return window_->findChild<QLabel*>("readout")->text();
    };
    QTRY_VERIFY(readout().contains("height"));
    QTest::mouseClick(&window_->map(), Qt::LeftButton, {}, onScreen(at));
    auto* advice = window_->findChild<QLabel*>("advice");
    QVERIFY(advice != nullptr);
    QVERIFY(advice->text().contains("Most of it is"));
    bool found = false;
    const QPointF asked = *window_->map().scene().place_m;
    const auto own = dem.geometry.cellAt(asked.x(), asked.y());
    QVERIFY(own.has_value());
    const QString height = QString::number(static_cast<double>(dem.heights_m[*own]), 'f', 2) + " m";
    for (const QLabel* label : window_->findChildren<QLabel*>("figure"))
        found = found || label->text().startsWith(height);
    QVERIFY2(found, qPrintable(height));
}

void WindowTest::stretchIsExcludedByDraggingAlongATrackAndUndoBringsItBack() {
    processed();
    const std::size_t used_before = session().products()->report.runs.back().ground_points_used;
    MapView& map = window_->map();
    action("tool_select_stretch").trigger();
    QCOMPARE(map.tool(), MapTool::SelectStretch);
    const MapTrack& track = session().map()->tracks.back();
    const std::size_t n = track.map_m.size();
    QTest::mousePress(&map, Qt::LeftButton, {}, onScreen(track.map_m[n / 3]));
    QTest::mouseMove(&map, onScreen(track.map_m[n / 3 + 50]));
    QTest::mouseMove(&map, onScreen(track.map_m[n / 3 + 120]));
    QTest::mouseRelease(&map, Qt::LeftButton, {}, onScreen(track.map_m[n / 3 + 120]));
    QVERIFY(!session().selection().stretches().empty());
    QCOMPARE(session().selection().stretches().front().run.toStdString(), track.run_id);
    action("exclude").trigger();
    QCOMPARE(session().edits().stretches.size(), std::size_t{1});
    QVERIFY(session().outdated());
    QVERIFY(window_->isWindowModified());
    processed();
    QVERIFY(!session().outdated());
    QVERIFY(session().products()->report.runs.back().ground_points_used < used_before);
    action("undo").trigger();
    QVERIFY(session().edits().stretches.empty());
    QVERIFY(!window_->isWindowModified());
    action("redo").trigger();
    QCOMPARE(session().edits().stretches.size(), std::size_t{1});
}

void WindowTest::areaSelectsAllPassesThroughIt() {
    processed();
    MapView& map = window_->map();
    action("tool_select_area").trigger();
    const QPointF centre = map.scene().extent_m().center();
    const QRectF area_m(centre - QPointF(3, 3), centre + QPointF(3, 3));
    const auto drag = [&](const QRectF& m, Qt::KeyboardModifiers keys) {
        const auto px = [&](QPointF at) {
            return map.transform().toScreen(at).toPoint();
        };
        QTest::mousePress(&map, Qt::LeftButton, keys, px(m.topLeft()));
        QTest::mouseMove(&map, px(m.center()));
        QTest::mouseMove(&map, px(m.bottomRight()));
        QTest::mouseRelease(&map, Qt::LeftButton, keys, px(m.bottomRight()));
    };
    drag(area_m, {});
    const auto first = session().selection().stretches();
    QVERIFY(first.size() > 1);
    // Epochs within are selected, others are not, to a pixel; a single one is no stretch.
    const double pixel_m = 1.5 / map.transform().pixels_per_m;
    const QRectF surely = area_m.adjusted(pixel_m, pixel_m, -pixel_m, -pixel_m),
                 perhaps = area_m.adjusted(-pixel_m, -pixel_m, pixel_m, pixel_m);
    std::size_t within = 0;
    for (const MapTrack& track : session().map()->tracks) {
        const auto at = [&](std::size_t i) {
            return QPointF(track.map_m[i].x(), track.map_m[i].y());
        };
        for (std::size_t i = 1; i < track.map_m.size(); ++i) {
            const bool selected = std::any_of(first.begin(), first.end(), [&](const TrackStretch& s) {
                return s.run.toStdString() == track.run_id && s.from_s <= track.time_s[i] &&
                       track.time_s[i] <= s.to_s;
            });
            if (selected) QVERIFY(perhaps.contains(at(i)));
            if (surely.contains(at(i)) && surely.contains(at(i - 1))) QVERIFY(selected);
            within += selected ? 1U : 0U;
        }
    }
    QVERIFY(within > 20);
    drag(area_m.translated(7, 0), Qt::ShiftModifier);
    const auto both = session().selection().stretches();
    QVERIFY(both.size() > first.size());
    QVERIFY(std::equal(first.begin(), first.end(), both.begin()));
    QTest::qWait(50);
    QVERIFY(map.scene().sketch.vertices_m.isEmpty());
    action("exclude").trigger();
    QCOMPARE(session().edits().stretches.size(), both.size());
    QVERIFY(session().selection().empty());
    action("undo").trigger();  // all of them are one step
    QVERIFY(session().edits().stretches.empty());
}

void WindowTest::mapObeysTheKeysAlone() {
    processed();
    MapView& map = window_->map();
    map.setFocus();
    const auto press = [&](Qt::Key key, int times = 1, Qt::KeyboardModifiers keys = {}) {
        for (int i = 0; i < times; ++i) QTest::keyClick(&map, key, keys);
    };
    const QPointF middle_m = map.transform().centre_m;
    action("tool_hard_line").trigger();
    press(Qt::Key_Space);  // the cross
    press(Qt::Key_Space);
    press(Qt::Key_Right, 10);
    press(Qt::Key_Down, 3, Qt::ShiftModifier);
    press(Qt::Key_Space);
    press(Qt::Key_Return);
    QCOMPARE(session().edits().lines.size(), std::size_t{1});
    const auto line = session().edits().lines[0].vertices_m;
    QCOMPARE(line.size(), std::size_t{2});
    QVERIFY(std::abs(line[0].x() - middle_m.x()) < 1e-6);
    QVERIFY(std::abs((line[1].x() - line[0].x()) * map.transform().pixels_per_m - 80.0) < 1e-6);
    QVERIFY(std::abs((line[0].y() - line[1].y()) * map.transform().pixels_per_m - 3.0) < 1e-6);
    QCOMPARE(map.transform().centre_m, middle_m);

    action("tool_select_area").trigger();
    press(Qt::Key_Space);
    press(Qt::Key_Left, 20);
    press(Qt::Key_Up, 20);
    QVERIFY(!session().selection().stretches().empty());
    press(Qt::Key_Space);
    const auto selected = session().selection().stretches();
    press(Qt::Key_Left, 4);  // the area is done: moving on changes nothing
    QCOMPARE(session().selection().stretches(), selected);
    press(Qt::Key_Delete);
    QCOMPARE(session().edits().stretches.size(), selected.size());

    action("tool_pan").trigger();
    QSignalSpy asked(&map, &MapView::placeAsked);
    press(Qt::Key_Space);
    QCOMPARE(asked.size(), 1);
    press(Qt::Key_Escape);
    press(Qt::Key_Right);  // without the cross the map moves
    QVERIFY(map.transform().centre_m.x() > middle_m.x());
}

void WindowTest::tracksAreColouredByTheirResiduals() {
    processed();
    session().viewState().setColouring(TrackColouring::Residual);
    const MapScene& scene = window_->map().scene();
    const auto range = trackRange(scene);
    QVERIFY(range && range->low == 0.0 && range->high == 4.0);
    const auto& innovations = session().products()->innovations;
    for (std::size_t run = 0; run < scene.survey->tracks.size(); ++run) {
        const MapTrack& track = scene.survey->tracks[run];
        QCOMPARE(track.residual_over_sigma.size(), track.map_m.size());
        double worst = 0.0, drawn = 0.0;
        for (const SensorInnovations& sensor : innovations[run]) {
            for (const Innovation& reading : sensor.readings)
                worst = std::max(worst, static_cast<double>(std::abs(reading.over_sigma)));
        }
        for (const double r : track.residual_over_sigma) drawn = std::max(drawn, std::isnan(r) ? 0.0 : r);
        QCOMPARE(drawn, worst);
        const TrackInk ink = trackInk(scene, run);
        std::set<QRgb> colours;
        for (std::size_t i = 0; i < track.map_m.size(); ++i) colours.insert(ink(i));
        QVERIFY(colours.size() > 5);
    }
}

void WindowTest::unitsAndNumbersAreChosen() {
    // 1 m is 3937/1200 US survey feet, exactly; 0.3048 m an international one.
    applyFigureStyle({LengthUnit::UsSurveyFoot, NumberStyle::Plain});
    QCOMPARE(lengthText(1200.0), QString("3937.00 US ft"));
    QCOMPARE(areaText(1200.0 * 1200.0), QString("15499969.0 US ft²"));
    applyFigureStyle({LengthUnit::Foot, NumberStyle::Comma});
    QCOMPARE(lengthText(-0.3048 * 1234567.25), QString::fromUtf8("−1\u2009234\u2009567,25 ft"));
    QCOMPARE(signedLength(-0.0001, 2), QString("+0,00 ft"));
    QCOMPARE(number(999.0, 0), QString("999"));
    QCOMPARE(number(-1000.0, 0), QString::fromUtf8("−1\u2009000"));
    applyFigureStyle({});

    processed();
    const auto height_m = session().products()->report.surface.highest_m;
    const auto profiled = [&] {
        const QRectF extent = window_->map().scene().extent_m();
        return profilePlot(*session().products(), *session().map(),
                           QPolygonF({extent.center() - QPointF(4, 0), extent.center() + QPointF(4, 0)}));
    };
    const Plot metric = profiled();
    const Plot sigma_m = plotOf(PlotKind::Sigma, 0, *session().survey(), session().products().get());
    action("unit_ft").trigger();
    QTRY_VERIFY(&desktop_->window() != window_);
    window_ = &desktop_->window();
    QTRY_VERIFY_WITH_TIMEOUT(idle() && !window_->map().preparing(), kLong_ms);
    QVERIFY(action("unit_ft").isChecked() && !action("unit_m").isChecked());
    QVERIFY(session().products());  // nothing was lost
    QCOMPARE(preferredFigureStyle().unit, LengthUnit::Foot);
    const Plot imperial = profiled();
    QCOMPARE(imperial.x_unit, QString("ft"));
    QCOMPARE(imperial.panels[0].unit, QString("ft"));
    for (std::size_t i = 0; i < metric.panels[0].series[0].x.size(); ++i) {
        QVERIFY(std::abs(imperial.panels[0].series[0].x[i] * 0.3048 - metric.panels[0].series[0].x[i]) <
                1e-9);
    }
    const Plot sigma_ft = plotOf(PlotKind::Sigma, 0, *session().survey(), session().products().get());
    QVERIFY(std::abs(sigma_ft.panels[0].series[0].y[9] * 0.3048 - sigma_m.panels[0].series[0].y[9]) < 1e-12);
    const QString read = readout(window_->map().scene(), window_->map().scene().extent_m().center());
    QVERIFY2(read.contains(" ft") && read.contains(" m "), qPrintable(read));  // coordinates stay in metres
    QCOMPARE(session().products()->report.surface.highest_m, height_m);        // and so does the survey
    action("unit_m").trigger();
    QTRY_VERIFY(&desktop_->window() != window_);
    window_ = &desktop_->window();
    QVERIFY(readout(window_->map().scene(), window_->map().scene().extent_m().center()).count(" ft") == 0);
}

void WindowTest::breaklineIsDrawnByClicksAndHoldsTheSurface() {
    processed();
    MapView& map = window_->map();
    const QRectF extent = map.scene().extent_m();
    action("tool_hard_line").trigger();
    const QPointF a = extent.center() - QPointF(3, 1), b = extent.center() + QPointF(3, 1);
    QTest::mouseClick(&map, Qt::LeftButton, {}, map.transform().toScreen(a).toPoint());
    QTest::mouseMove(&map, map.transform().toScreen(extent.center()).toPoint());
    QVERIFY(map.scene().sketch.label.endsWith(" m"));
    QTest::mouseClick(&map, Qt::LeftButton, {}, map.transform().toScreen(b).toPoint());
    QTest::keyClick(&map, Qt::Key_Return);
    QCOMPARE(session().edits().lines.size(), std::size_t{1});
    QCOMPARE(session().edits().lines[0].vertices_m.size(), std::size_t{2});
    QVERIFY(std::abs(session().edits().lines[0].vertices_m[0].x() - a.x()) <
            2.0 / map.transform().pixels_per_m);
    processed();
    QCOMPARE(session().products()->report.surface.breaklines, std::size_t{1});
    // A line that is begun and left leaves nothing.
    QTest::mouseClick(&map, Qt::LeftButton, {}, map.transform().toScreen(a).toPoint());
    QTest::keyClick(&map, Qt::Key_Escape);
    QCOMPARE(session().edits().lines.size(), std::size_t{1});
    QTest::keyClick(&map, Qt::Key_Escape);
    QCOMPARE(map.tool(), MapTool::Pan);
}

void WindowTest::profileShowsHeightsAlongALine() {
    processed();
    const auto* messages = window_->findChild<QDockWidget*>("dock_messages");
    const int messages_px = messages->height();
    MapView& map = window_->map();
    const QPointF centre = map.scene().extent_m().center();
    action("tool_profile").trigger();
    QTest::mouseClick(&map, Qt::LeftButton, {}, map.transform().toScreen(centre - QPointF(4, 0)).toPoint());
    QTest::mouseClick(&map, Qt::LeftButton, {}, map.transform().toScreen(centre + QPointF(4, 0)).toPoint());
    QTest::keyClick(&map, Qt::Key_Return);
    auto* profile = window_->findChild<PlotCanvas*>("profile_plot");
    QVERIFY(profile->isVisible());
    const Plot& plot = profile->plot();
    QCOMPARE(plot.panels.size(), std::size_t{1});
    const PlotSeries& line = plot.panels[0].series[0];
    QVERIFY(std::abs(line.x.back() - 8.0) < 2.5 / map.transform().pixels_per_m);
    const auto& report = session().products()->report.surface;
    for (const double height : line.y)
        QVERIFY(std::isnan(height) || (height >= report.lowest_m && height <= report.highest_m));
    window_->findChild<QDockWidget*>("dock_profile")->close();
    QTRY_COMPARE(messages->height(), messages_px);
}

void WindowTest::reportIsShownSavedAndPrinted() {
    processed();
    auto* report = window_->findChild<ReportView*>("report");
    window_->findChild<QTabWidget*>("views")->setCurrentWidget(report);
    QTRY_VERIFY_WITH_TIMEOUT(report->pages() > 0, kLong_ms);
    // The pages have the width of the view, whatever that is.
    const auto* area = report->findChild<QScrollArea*>();
    const QSize before = window_->size();
    QScrollBar& place = *area->verticalScrollBar();
    place.setValue(place.maximum() / 2);
    for (const int wider_px : {0, 160, 0}) {
        window_->resize(before.width() + wider_px, before.height());
        const auto spare_px = [&] {
            const QPixmap page = area->findChild<QLabel*>()->pixmap();
            return area->viewport()->width() - page.deviceIndependentSize().toSize().width();
        };
        QTRY_VERIFY_WITH_TIMEOUT(spare_px() >= 0 && spare_px() <= 40, kLong_ms);
        QTRY_VERIFY(!area->horizontalScrollBar()->isVisible());
        // Nor does what is being read move away.
        QVERIFY(std::abs(static_cast<double>(place.value()) / place.maximum() - 0.5) < 0.02);
    }
    QVERIFY(report->saveTo(scratch_->filePath("report.pdf")));
    QVERIFY(bytesOf(scratch_->filePath("report.pdf")).startsWith("%PDF"));
    QVERIFY(!report->saveTo("/no/such/place/report.pdf"));
    QVERIFY(messages().contains("/no/such/place"));
    QPrinter printer;
    printer.setOutputFormat(QPrinter::PdfFormat);
    printer.setOutputFileName(scratch_->filePath("printed.pdf"));
    report->print(printer);
    QVERIFY(bytesOf(scratch_->filePath("printed.pdf")).size() > 20000);
    // The file that the export writes is the one that is shown.
    session().exportTo(scratch_->filePath("out").toStdString());
    QTRY_VERIFY_WITH_TIMEOUT(idle(), kLong_ms);
    QCOMPARE(bytesOf(scratch_->filePath("out/report.pdf")), bytesOf(scratch_->filePath("report.pdf")));
}

void WindowTest::settingsAreCheckedAndUndone() {
    openSample();
    QVERIFY(session().changeSetting("surface.cell_m", "0.5"));
    QCOMPARE(session().settings().config().surface.cell_m, 0.5);
    QVERIFY(!session().changeSetting("surface.cell_m", "wide"));
    QCOMPARE(session().settings().config().surface.cell_m, 0.5);
    QVERIFY(messages().contains("surface.cell_m"));
    action("undo").trigger();
    QCOMPARE(session().settings().config().surface.cell_m, 0.0);
}

void WindowTest::sizeOfCellsIsAutoUntilOneIsEntered() {
    openSample();
    QLineEdit* field = nullptr;
    for (QLineEdit* candidate : window_->findChildren<QLineEdit*>()) {
        if (candidate->accessibleName() == settingLabel("surface.cell_m")) field = candidate;
    }
    QVERIFY(field);
    QCOMPARE(field->text(), QString());
    QCOMPARE(field->placeholderText(), QString("auto"));
    const auto enter = [&](const QString& value) {
        field->selectAll();
        QTest::keyClick(field, Qt::Key_Delete);
        QTest::keyClicks(field, value);
        QTest::keyClick(field, Qt::Key_Return);
    };
    enter("0.5");
    QCOMPARE(session().settings().config().surface.cell_m, 0.5);
    enter("");
    QCOMPARE(session().settings().config().surface.cell_m, 0.0);
    QCOMPARE(field->text(), QString());
}

void WindowTest::allSettingsAreSearchedMarkedAndSetBack() {
    openSample();
    QElapsedTimer timer;
    timer.start();
    action("settings").trigger();
    auto* dialog = window_->findChild<SettingsDialog*>();
    QVERIFY(dialog != nullptr);
    QVERIFY(!dialog->isVisible());  // made in turns of the event loop, not in one
    QTRY_VERIFY(dialog->isVisible());
    qInfo("all settings shown in %lld ms", timer.restart());
    QVERIFY(session().changeSetting("fusion.smooth", "false"));
    qInfo("one changed in %lld ms", timer.restart());
    action("undo").trigger();
    const auto shown = [&] {
        QStringList keys;
        for (const SettingEditor* editor : dialog->findChildren<SettingEditor*>())
            if (editor->isVisibleTo(dialog)) keys << editor->key();
        return keys;
    };
    // Every setting but edits stands there once.
    QStringList all = shown();
    for (const ParameterInfo& info : knownParameters()) {
        const QString key = QString::fromStdString(info.key);
        QCOMPARE(all.count(key), key.startsWith("edits.") ? 0 : 1);
    }
    auto* search = dialog->findChild<QLineEdit*>("setting_search");
    QTest::keyClicks(search, "gust");
    QCOMPARE(shown(), (QStringList{"fusion.barometer.gust_sigma_m", "fusion.barometer.gust_correlation_s"}));
    search->setText("STILL target");  // by meaning, in any order
    QCOMPARE(shown(), QStringList{"fusion.stands.target_s"});
    search->setText("surface.cell");  // by key
    QCOMPARE(shown(), QStringList{"surface.cell_m"});
    search->setText(QString::fromUtf8("阵风 长度"));  // in the other language
    QCOMPARE(shown(), QStringList{"fusion.barometer.gust_correlation_s"});
    search->setText("no such thing");
    QVERIFY(shown().isEmpty());
    search->clear();
    // What differs from its default is marked, in the dialog and in the step, and can be set back.
    auto* only = dialog->findChild<QCheckBox*>("only_changed");
    QVERIFY(session().changeSetting("surface.method", "kriging"));
    QVERIFY(session().changeSetting("fusion.robust.use", "false"));
    QVERIFY2(only->text().contains("(2)"), qPrintable(only->text()));
    only->setChecked(true);
    QCOMPARE(shown(), (QStringList{"fusion.robust.use", "surface.method"}));
    const auto marked = [&] {
        const auto names = window_->findChildren<QLabel*>("settingName");
        return std::count_if(names.begin(), names.end(),
                             [](const QLabel* name) { return name->property("changed").toBool(); });
    };
    QCOMPARE(marked(), 3);  // the method stands in both
    for (const SettingEditor* editor : dialog->findChildren<SettingEditor*>()) {
        auto* reset = editor->findChild<QToolButton*>("reset");
        QCOMPARE(reset->isVisibleTo(dialog), only->isChecked() && shown().contains(editor->key()));
        if (editor->key() == "surface.method") QTest::mouseClick(reset, Qt::LeftButton);
    }
    QCOMPARE(session().settings().text("surface.method"), std::string("linear"));
    QTest::mouseClick(dialog->findChild<QPushButton*>("reset_all"), Qt::LeftButton);
    QCOMPARE(session().settings().text("fusion.robust.use"), std::string("true"));
    QCOMPARE(marked(), 0);
    action("undo").trigger();
    QCOMPARE(session().settings().text("fusion.robust.use"), std::string("false"));
    // The wheel passes over what has not the focus.
    auto* passed = dialog->findChild<QComboBox*>();
    search->setFocus();
    const auto turn = [](QWidget& widget) {
        QWheelEvent wheel(QPointF(5, 5), widget.mapToGlobal(QPointF(5, 5)), {}, {0, -120}, Qt::NoButton, {},
                          Qt::NoScrollPhase, false);
        QApplication::sendEvent(&widget, &wheel);
    };
    turn(*passed);
    QCOMPARE(session().settings().text("fusion.method"), std::string("terrawalk"));
    auto* repeats = window_->findChild<QSpinBox*>("repeats");
    const int repeated = repeats->value();
    QWheelEvent up(QPointF(5, 5), repeats->mapToGlobal(QPointF(5, 5)), {}, {0, 120}, Qt::NoButton, {},
                   Qt::NoScrollPhase, false);
    QApplication::sendEvent(repeats, &up);
    QCOMPARE(repeats->value(), repeated);
    // A choice has a name to read and stores its word.
    auto* method = dialog->findChild<QComboBox*>();
    QCOMPARE(method->currentText(), QString("Terrawalk, all runs"));
    method->setCurrentIndex(method->findData("ukf"));
    QCOMPARE(session().settings().text("fusion.method"), std::string("ukf"));
    for (const ParameterInfo& info : knownParameters()) {
        const QString range = QString::fromStdString(info.range);
        if (!range.contains(", ") || range.startsWith("[") || range.startsWith("true")) continue;
        for (const QString& word : range.split(", ")) QVERIFY2(choiceWords(word) != word, qPrintable(word));
    }
}

void WindowTest::fieldsOfTheStepsStandInOneColumn() {
    for (const char* language : {"en", "zh_CN"}) {
        applyLanguage(language);
        desktop_ = std::make_unique<Desktop>();
        window_ = &desktop_->window();
        window_->resize(1280, 800);
        window_->show();
        openSample();
        auto* steps = window_->findChild<StepsPanel*>();
        QSet<int> left_px, right_px;
        for (const SettingEditor* editor : steps->findChildren<SettingEditor*>()) {
            const QPoint at = editor->mapTo(steps, QPoint());
            left_px << at.x();
            right_px << at.x() + editor->width();
            for (const QLabel* name : steps->findChildren<QLabel*>("settingName"))
                QVERIFY(name->sizeHint().width() <= name->width());
        }
        QCOMPARE(left_px.size(), 1);
        QCOMPARE(right_px.size(), 1);
    }
}

void WindowTest::cancelStopsSoonAndKeepsWhatWasThere() {
    window_->open(TERRAWALK_SOURCE_DIR "/sample_surveys/mango_orchard");
    QTRY_VERIFY_WITH_TIMEOUT(session().survey() && idle(), kLong_ms);
    action("process").trigger();
    QTRY_VERIFY_WITH_TIMEOUT(window_->findChild<QProgressBar*>("progress")->value() > 20, kLong_ms);
    QElapsedTimer timer;
    timer.start();
    window_->findChild<QPushButton*>("cancel")->click();
    QTRY_VERIFY_WITH_TIMEOUT(idle(), kLong_ms);
    // The aim is a second; tests share their machine.
    QVERIFY2(timer.elapsed() < 3000 * kSlack, qPrintable(QString::number(timer.elapsed())));
    QVERIFY(!session().products());
    QVERIFY(session().survey() != nullptr);
    QVERIFY(messages().contains("Cancelled"));
}

void WindowTest::windowAnswersWhileItWorks() {
    openSample();
    QTest::qWait(300);  // its first picture is no part of the work
    action("process").trigger();
    // Each turn of the event loop gives the window's longest silence.
    qint64 longest_ms = 0;
    QElapsedTimer timer;
    while (!idle()) {
        timer.start();
        QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
        longest_ms = std::max(longest_ms, timer.elapsed());
    }
    qInfo("longest silence %lld ms", longest_ms);
    QVERIFY2(longest_ms < 2000 * kSlack, qPrintable(QString("blocked for %1 ms").arg(longest_ms)));
}

void WindowTest::unsavedChangesComeBackAfterTheProcessWasKilled() {
    // Another process does the work of a person, and is killed in the middle of it.
    QProcess other;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("TERRAWALK_TEST_EDIT_AND_WAIT", sample_);
    other.setProcessEnvironment(environment);
    other.start(QCoreApplication::applicationFilePath(), {});
    QByteArray said;
    connect(&other, &QProcess::readyReadStandardOutput, this, [&] { said += other.readAllStandardOutput(); });
    QTRY_VERIFY_WITH_TIMEOUT(said.contains("edited"), kLong_ms);
    QCOMPARE(other.state(), QProcess::Running);
    other.kill();
    QVERIFY(other.waitForFinished());
    openSample();
    QCOMPARE(session().settings().config().surface.cell_m, 0.75);
    QVERIFY(window_->isWindowModified());
    QVERIFY(messages().contains("Unsaved changes"));
    action("undo").trigger();
    QCOMPARE(session().settings().config().surface.cell_m, 0.0);
}

void WindowTest::changesOfTheLastMomentComeBack() {
    openSample();
    QVERIFY(session().changeSetting("surface.cell_m", "0.75"));
    window_->close();
    desktop_.reset();
    desktop_ = std::make_unique<Desktop>();
    window_ = &desktop_->window();
    window_->show();
    openSample();
    QCOMPARE(session().settings().config().surface.cell_m, 0.75);
    QVERIFY(window_->isWindowModified());
}

void WindowTest::arrowKeysChooseInTheTree() {
    openSample();
    auto* tree = window_->findChild<QTreeView*>("survey_tree");
    tree->setFocus();
    const QString run = QString::fromStdString(session().survey()->runs.back().id);
    session().selection().select({run, 10.0, 20.0});
    QCOMPARE(tree->currentIndex().siblingAtColumn(0).data(SurveyTreeModel::IdRole).toString(), run);
    QVERIFY(!session().selection().stretches().empty());  // the tree follows, and chooses nothing
    session().selection().clear();
    tree->setCurrentIndex({});
    QString first;
    for (int press = 0; press < 8; ++press) {
        QTest::keyClick(tree, Qt::Key_Down);
        const QString item = session().selection().item();
        if (first.isEmpty()) first = item;
        if (!item.isEmpty() && item != first) return;
    }
    QFAIL("two items of the tree were to be chosen in turn");
}

void WindowTest::resultsInTheTreeShowThemselves() {
    processed();
    auto* tree = window_->findChild<QTreeView*>("survey_tree");
    auto* views = window_->findChild<QTabWidget*>("views");
    const auto row = [&](const char* id) {
        const auto found = tree->model()->match(tree->model()->index(0, 0), SurveyTreeModel::IdRole, id, 1,
                                                Qt::MatchExactly | Qt::MatchRecursive);
        return found.isEmpty() ? QModelIndex() : found.front();
    };
    const auto click = [&](const QModelIndex& index) {
        tree->scrollTo(index);
        QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, tree->visualRect(index).center());
    };
    const std::tuple<const char*, int, RasterLayer> results[] = {{"uncertainty", 0, RasterLayer::Uncertainty},
                                                                 {"mesh", 1, RasterLayer::Uncertainty},
                                                                 {"density", 0, RasterLayer::Density},
                                                                 {"accuracy", 3, RasterLayer::Density},
                                                                 {"source", 0, RasterLayer::Source},
                                                                 {"report", 4, RasterLayer::Source},
                                                                 {"dem", 0, RasterLayer::Height}};
    for (const auto& [id, view, layer] : results) {
        QVERIFY2(row(id).isValid(), id);
        click(row(id));
        QCOMPARE(views->currentIndex(), view);
        QCOMPARE(session().viewState().now().layer, layer);
    }
    // By keys: arrows only pass over, enter shows.
    tree->setFocus();
    tree->setCurrentIndex(row("mesh"));
    QCOMPARE(views->currentIndex(), 0);
    QTest::keyClick(tree, Qt::Key_Return);
    QCOMPARE(views->currentIndex(), 1);
}

void WindowTest::savedSettingsReplayedByTheCommandLineGiveTheSameBytes() {
    openSample();
    QVERIFY(session().changeSetting("surface.cell_m", "0.5"));
    SurveyEdits edits = session().edits();
    const Run& run = session().survey()->runs.back();
    edits.stretches.push_back({run.id, 20.0, 30.0, EditedSensor::Range});
    session().changeEdits(edits, "exclude");
    action("save").trigger();
    QVERIFY(!window_->isWindowModified());
    processed();
    QVERIFY(session().commandArguments().contains("--config"));
    commandGivesTheSameBytes();
}

// The report speaks the window's language, and the command says so.
void WindowTest::aChineseReportReplayedByTheCommandLineIsTheSameBytes() {
    processed();
    applyLanguage("zh_CN");
    commandGivesTheSameBytes();
    QVERIFY(session().commandArguments().contains("report.language=zh"));
    QVERIFY(bytesOf(scratch_->filePath("window/report.html")).contains("<html lang=\"zh-CN\">"));
    // What is saved by a Chinese window says it too; an English one takes it back.
    QVERIFY(session().changeSetting("surface.cell_m", "0.5"));
    action("save").trigger();
    processed();
    QVERIFY(!session().commandArguments().contains("report.language=zh"));
    applyLanguage("en");
    QVERIFY(session().commandArguments().contains("report.language=en"));
    commandGivesTheSameBytes();
    QVERIFY(bytesOf(scratch_->filePath("window/report.html")).contains("<html lang=\"en\">"));
}

void WindowTest::commandGivesTheSameBytes() {
    QSignalSpy exported(&session(), &SurveySession::exported);
    session().exportTo(scratch_->filePath("window").toStdString());
    QTRY_VERIFY_WITH_TIMEOUT(exported.count() == 1, kLong_ms);
    const QStringList arguments = session().commandArguments();
    QProcess command;
    command.start(TERRAWALK_PROGRAM, arguments.mid(1) + QStringList{"-o", scratch_->filePath("command")});
    QVERIFY(command.waitForFinished(kLong_ms));
    QCOMPARE(command.exitCode(), 0);
    std::size_t compared = 0;
    for (const auto& entry : fs::recursive_directory_iterator(scratch_->filePath("window").toStdString())) {
        if (!entry.is_regular_file()) continue;
        const fs::path relative = fs::relative(entry.path(), scratch_->filePath("window").toStdString());
        const QByteArray own = bytesOf(text(entry.path()));
        QVERIFY2(own == bytesOf(scratch_->filePath("command") + "/" + text(relative)), relative.c_str());
        ++compared;
    }
    QVERIFY(compared > 10);
}

void WindowTest::narrowPlacePanelCutsNothing() {
    PlaceReport place;
    place.height_m = 112.345;
    place.sigma_m = 0.123;
    place.parts = SigmaParts{0.1, 0.02, 0.03, 0.04};
    place.sigma_after_pass_m = 0.09;
    for (const char* run : {"S01", "2024-05-17_north_terrace", "walkwithoutanybreakinitsname"}) {
        place.nearest.push_back({run, 12345.6, 12.34, 1234.56, 12.34, GroundPointState::StatisticalOutlier});
    }
    for (const char* language : {"en", "zh_CN"}) {
        applyLanguage(language);
        PlacePanel panel;
        panel.resize(panel.minimumWidth(), 700);
        panel.show(place);
        static_cast<QWidget&>(panel).show();
        QVERIFY(QTest::qWaitForWindowExposed(&panel));
        const int right = panel.findChild<QScrollArea*>()->viewport()->width();
        for (const QLabel* label : panel.findChildren<QLabel*>()) {
            const QString& words = label->text();
            const QRect needed = label->fontMetrics().boundingRect(
                QRect(0, 0, label->width(), 10'000), label->wordWrap() ? Qt::TextWordWrap : 0, words);
            QVERIFY2(needed.width() <= label->width() && needed.height() <= label->height(),
                     qPrintable(words));
            QVERIFY2(label->mapTo(&panel, label->rect().topRight()).x() < right, qPrintable(words));
        }
    }
    applyLanguage("en");
}

void WindowTest::exportDialogRefusesWhatCannotBe() {
    processed();
    action("export").trigger();
    auto* dialog = qobject_cast<ExportDialog*>(QApplication::activeModalWidget());
    QVERIFY(dialog != nullptr);
    auto* go = dialog->findChild<QPushButton*>("primary");
    for (const QString& bad : {QString(), sample_ + "/survey.json", QString("/no/such/place/out")}) {
        dialog->setFolder(bad);
        QVERIFY2(!go->isEnabled(), qPrintable(bad));
        QVERIFY(!dialog->findChild<QLabel*>("problem")->text().isEmpty());
    }
    // What was chosen last may be gone; another place is offered then.
    QSettings().setValue("export/parent", "/no/such/stick");
    QVERIFY(ExportDialog(session()).findChild<QPushButton*>("primary")->isEnabled());
    QSettings().remove("export/parent");
    dialog->setFolder(scratch_->filePath("result"));
    QVERIFY(go->isEnabled());
    QVERIFY(dialog->findChild<QLabel*>("command")->text().contains("terrawalk process"));
    QTest::mouseClick(dialog->findChild<QWidget*>("format_las_points"), Qt::LeftButton, {}, QPoint(8, 8));
    const auto* command = dialog->findChild<QLabel*>("command");
    QVERIFY(command->text().contains("--points las"));
    QVERIFY(!command->text().contains("--all-points"));
    auto* all_points = dialog->findChild<QCheckBox*>("all_points");
    QVERIFY(all_points->isEnabled());
    all_points->setChecked(true);
    QVERIFY(command->text().endsWith("--points las --all-points"));
    const QString export_line = command->text().section('\n', 1);
    QTest::mouseClick(go, Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(fs::exists(scratch_->filePath("result/dem.tif").toStdString()) && idle(),
                             kLong_ms);
    QVERIFY(fs::exists(scratch_->filePath("result-export/ground_points.las").toStdString()));
    // The command that was shown makes the same file.
    const QByteArray all = bytesOf(scratch_->filePath("result-export/ground_points.las"));
    QProcess export_command;
    export_command.start(TERRAWALK_PROGRAM, QProcess::splitCommand(export_line).mid(1) +
                                                QStringList{"-o", scratch_->filePath("again"), "-q"});
    QVERIFY(export_command.waitForFinished(kLong_ms));
    QCOMPARE(export_command.exitCode(), 0);
    QVERIFY(!all.isEmpty());
    QVERIFY(bytesOf(scratch_->filePath("again/ground_points.las")) == all);
    // The survey's own folder must not be replaced.
    session().exportTo(sample_.toStdString());
    QTRY_VERIFY_WITH_TIMEOUT(idle(), kLong_ms);
    QVERIFY(fs::exists((sample_ + "/survey.json").toStdString()));
    QVERIFY(messages().contains("choose another folder"));
}

void WindowTest::themeAndLanguageSwitch() {
    processed();
    const QColor light = window_->palette().color(QPalette::Window);
    action("theme").trigger();
    QCOMPARE(currentTheme(), Theme::Dark);
    QVERIFY(window_->palette().color(QPalette::Window).lightness() < light.lightness());
    QCOMPARE(QSettings().value("theme").toString(), QString("dark"));
    action("theme").trigger();
    QCOMPARE(currentTheme(), Theme::Light);
    const auto products = session().products();
    const QString english = window_->findChild<QTabWidget*>("views")->tabText(0);
    action("language").trigger();
    QTRY_VERIFY(&desktop_->window() != window_);
    window_ = &desktop_->window();
    QVERIFY(window_->isVisible());
    QCOMPARE(window_->findChild<QTabWidget*>("views")->tabText(0), QString::fromUtf8("地图"));
    QVERIFY(window_->findChild<QTabWidget*>("views")->tabText(0) != english);
    // Nothing of the work is lost.
    QCOMPARE(session().products(), products);
    QVERIFY(window_->map().isVisible());
    QCOMPARE(window_->map().scene().products, products);
    QVERIFY(messages().contains("Processed."));
}

void WindowTest::badFilesAreErrorsInTheMessagesAndLoseNothing() {
    openSample();
    const auto before = session().survey();
    const QString broken = scratch_->filePath("broken.json");
    QFile file(broken);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("{\"format\": ");
    file.close();
    for (const QString& bad : {broken, QString("/no/such/file.json"), scratch_->path()}) {
        window_->open(bad);
        QTRY_VERIFY_WITH_TIMEOUT(idle(), kLong_ms);
        QCOMPARE(session().survey(), before);
        QVERIFY2(messages().contains(QFileInfo(bad).fileName()), qPrintable(bad));
    }
    session().loadSettings(broken.toStdString());
    QVERIFY(messages().contains("not valid JSON"));
    QVERIFY(!window_->isWindowModified());
}

void WindowTest::droppedFolderIsOpened() {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(sample_)});
    QDragEnterEvent enter(QPoint(100, 100), Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(window_, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent drop(QPointF(100, 100), Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(window_, &drop);
    QTRY_VERIFY_WITH_TIMEOUT(session().survey() && idle(), kLong_ms);
}

void WindowTest::oddFilesThatAreDroppedAreToldOrTaken() {
    const auto drop = [&](const QStringList& paths) {
        QMimeData data;
        QList<QUrl> urls;
        for (const QString& path : paths) urls << QUrl::fromLocalFile(path);
        data.setUrls(urls);
        QDragEnterEvent over(QPoint(100, 100), Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window_, &over);
        QDropEvent event(QPointF(100, 100), Qt::CopyAction, &data, Qt::LeftButton, {});
        const qsizetype before = messages().size();
        QApplication::sendEvent(window_, &event);
        QTest::qWait(20);
        [&] {
            QTRY_VERIFY_WITH_TIMEOUT(idle(), kLong_ms);
        }();
        return messages().mid(before);
    };
    QMimeData web;
    web.setUrls({QUrl("https://example.org/survey.json")});
    QDragEnterEvent enter(QPoint(100, 100), Qt::CopyAction, &web, Qt::LeftButton, {});
    QApplication::sendEvent(window_, &enter);
    QVERIFY(!enter.isAccepted());

    const QString settings = scratch_->filePath("settings.json"), picture = scratch_->filePath("photo.jpg");
    QVERIFY(QFile::copy(TERRAWALK_SOURCE_DIR "/resources/pictures/map.png", picture));
    QFile file(settings);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("{\"format\": \"terrawalk-config 1\", \"surface\": {\"cell_m\": 1.5}}");
    file.close();
    QVERIFY(drop({settings}).contains("Open a survey first"));
    QVERIFY(drop({picture}).contains("cannot be opened"));
    QVERIFY(!session().survey());
    // The survey among other things.
    const QString words = drop({picture, settings, sample_});
    QVERIFY2(words.contains("One at a time") && words.contains("Opened"), qPrintable(words));
    QVERIFY(session().survey() != nullptr);
    QVERIFY(drop({settings}).contains("Settings read"));
    QCOMPARE(session().settings().config().surface.cell_m, 1.5);
    action("undo").trigger();
    QCOMPARE(session().settings().config().surface.cell_m, 0.0);
    const QString dem = scratch_->filePath("out/dem.tif");
    QVERIFY(drop({dem}).contains("Process a survey first"));
    processed();
    session().exportTo(scratch_->filePath("out").toStdString());
    QTRY_VERIFY_WITH_TIMEOUT(idle(), kLong_ms);
    drop({dem});
    QTRY_VERIFY(session().viewState().now().change);
    // Nothing is opened behind the back of what runs.
    action("process").trigger();
    QVERIFY(drop({sample_}).contains("Cancel what is running first"));
}

void WindowTest::earlierRunsCanBeGoneBackTo() {
    processed();
    const auto first = session().products();
    QVERIFY(session().changeSetting("surface.cell_m", "1"));
    processed();
    QVERIFY(session().products() != first);
    QCOMPARE(session().history().size(), std::size_t{2});
    session().goBackTo(0);
    QCOMPARE(session().products(), first);
    QCOMPARE(session().settings().config().surface.cell_m, 0.0);
    QVERIFY(!session().outdated());
    action("undo").trigger();
    QCOMPARE(session().settings().config().surface.cell_m, 1.0);
    QVERIFY(session().outdated());
}

void WindowTest::earlierRunsOutliveTheProgram() {
    processed();
    QVERIFY(session().changeSetting("surface.cell_m", "1"));
    QVERIFY(session().changeSetting("surface.method", "nearest"));
    processed();
    QVERIFY(fs::exists((sample_ + "/survey.runs.json").toStdString()));
    const RunFigures figures = session().runs().front().figures;
    window_->close();
    desktop_ = std::make_unique<Desktop>();
    window_ = &desktop_->window();
    window_->show();
    QApplication::setActiveWindow(window_);
    openSample();
    QVERIFY(!session().products());
    QCOMPARE(session().runs().size(), std::size_t{2});
    QCOMPARE(session().runs().front().figures, figures);
    // What was not saved came back as well; here the runs are what matters.
    QCOMPARE(session().settings().config().surface.cell_m, 1.0);
    QTest::mouseClick(window_->findChild<QPushButton*>("step_history"), Qt::LeftButton);
    QWidget* dialog = QApplication::activeModalWidget();
    QVERIFY(dialog != nullptr);
    auto* runs = dialog->findChild<QTableWidget*>("runs_table");
    QCOMPARE(runs->rowCount(), 2);
    QVERIFY(runs->item(0, runs->columnCount() - 1)->text().contains("Nearest point"));
    QCOMPARE(runs->item(1, 1)->text(), QString::number(figures.at("height_rmse_m"), 'f', 3));
    runs->selectRow(1);
    auto* differences = dialog->findChild<QTableWidget*>("differences_table");
    QCOMPARE(differences->rowCount(), 2);
    QCOMPARE(differences->item(1, 1)->text(), QString("auto"));
    QCOMPARE(differences->item(1, 2)->text(), QString("1.0 m"));
    QVERIFY(!dialog->findChild<QPushButton*>("compare_run")->isEnabled());  // its surface is gone
    QTest::mouseClick(dialog->findChild<QPushButton*>("primary"), Qt::LeftButton);
    QCOMPARE(session().settings().config().surface.cell_m, 0.0);
    QCOMPARE(session().settings().text("surface.method"), std::string("linear"));
    QVERIFY(messages().contains("process again"));
    action("undo").trigger();
    QCOMPARE(session().settings().config().surface.cell_m, 1.0);
    // The first run of today has that of yesterday to be compared with, and joins the list.
    processed();
    QCOMPARE(session().runs().size(), std::size_t{3});
    QVERIFY(session().history().front().before.has_value());
    // One whose results are still there shows them.
    QVERIFY(session().changeSetting("surface.cell_m", "2"));
    const auto first = session().products();
    processed();
    session().goBackToRun(2);
    QCOMPARE(session().products(), first);
}

void WindowTest::keptSurfacesOfEarlierRunsAreComparedAfterARestart() {
    processed();
    const auto runsDialog = [this] {
        action("runs").trigger();
        return QApplication::activeModalWidget();
    };
    QWidget* dialog = runsDialog();
    auto* keep = dialog->findChild<QCheckBox*>("keep_surfaces");
    QVERIFY(!keep->isChecked());
    keep->click();
    QTRY_VERIFY_WITH_TIMEOUT(idle(), kLong_ms);
    // The run that is shown is kept at once, the next by itself.
    QVERIFY(session().keptSurfaces().has(session().runs().front().when));
    dialog->close();
    QVERIFY(session().changeSetting("surface.cell_m", "1"));
    processed();
    const QDateTime first = session().runs().front().when, second = session().runs().back().when;
    QVERIFY(session().keptSurfaces().has(second));
    QVERIFY(session().keptSurfaces().bytes(first) <=
            KeptSurfaces::mostBytes(*session().history()[0].products));
    // The two results in memory say what the file must say.
    session().compareWithRun(0);
    QTRY_VERIFY_WITH_TIMEOUT(idle() && session().viewState().now().change, kLong_ms);
    const double median_m = session().viewState().now().change->median_m;
    const double rms_m = session().viewState().now().change->rms_m;

    window_->close();
    desktop_ = std::make_unique<Desktop>();
    window_ = &desktop_->window();
    window_->show();
    QApplication::setActiveWindow(window_);
    openSample();
    QVERIFY(!session().canCompareWith(0));  // nothing is shown yet
    dialog = runsDialog();
    dialog->findChild<QTableWidget*>("runs_table")->selectRow(0);
    QVERIFY(dialog->findChild<QLabel*>("results_of_run")->text().contains("kept on disk"));
    QTest::mouseClick(dialog->findChild<QPushButton*>("process_run_again"), Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(session().products() && idle(), kLong_ms);
    QCOMPARE(session().settings().config().surface.cell_m, 1.0);
    QVERIFY(session().canCompareWith(0));
    session().compareWithRun(0);
    QTRY_VERIFY_WITH_TIMEOUT(idle() && session().viewState().now().change, kLong_ms);
    QVERIFY(std::abs(session().viewState().now().change->median_m - median_m) < 1e-6);
    QVERIFY(std::abs(session().viewState().now().change->rms_m - rms_m) < 1e-6);
    QVERIFY(session().viewState().now().change->earlier_has_sigma);
    // Unticked, no more are kept, and those on disk stay until a person wants them removed.
    dialog = runsDialog();
    dialog->findChild<QCheckBox*>("keep_surfaces")->click();
    QVERIFY(!session().keptSurfaces().wanted());
    QVERIFY(session().canCompareWith(0));
    dialog->close();
    QVERIFY(session().changeSetting("surface.cell_m", "2"));
    processed();
    QVERIFY(!session().keptSurfaces().has(session().runs().back().when));
    QVERIFY(session().keptSurfaces().has(first));
    dialog = runsDialog();
    QString asked;
    bool yes = false;
    qobject_cast<RunsDialog*>(dialog)->sure = [&](const QString& question) {
        asked = question;
        return yes;
    };
    auto* remove = dialog->findChild<QPushButton*>("remove_kept");
    QVERIFY(remove->isVisible());
    remove->click();
    QVERIFY2(asked.contains("cannot be undone"), qPrintable(asked));
    QVERIFY(session().keptSurfaces().has(first));
    yes = true;
    remove->click();
    QVERIFY(!session().keptSurfaces().has(first));
    QVERIFY(!session().canCompareWith(0));
    QVERIFY(!remove->isVisible());
    QVERIFY(!fs::exists(session().keptSurfaces().file(first).parent_path()));  // the disk is as it was
    dialog->findChild<QCheckBox*>("keep_surfaces")->click();
    QTRY_VERIFY_WITH_TIMEOUT(idle(), kLong_ms);
    QVERIFY(session().keptSurfaces().has(session().runs().back().when));
}

void WindowTest::runsOfReadOnlySurveysAndBrokenListsAreNoHarm() {
    window_->open(TERRAWALK_SOURCE_DIR "/sample_surveys/quick_plot", true);
    QTRY_VERIFY_WITH_TIMEOUT(session().products() && idle(), kLong_ms);
    QVERIFY(!fs::exists(TERRAWALK_SOURCE_DIR "/sample_surveys/quick_plot/survey.runs.json"));
    QVERIFY(fs::exists(session().runsFile()));
    QVERIFY(text(session().runsFile())
                .startsWith(QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation)));
    QFile broken(sample_ + "/survey.runs.json");
    QVERIFY(broken.open(QIODevice::WriteOnly));
    broken.write("{\"format\"");
    broken.close();
    openSample();
    QTRY_COMPARE(text(session().path()), sample_);
    QVERIFY(messages().contains("survey.runs.json"));
    QVERIFY(session().runs().empty());
    QVERIFY(!action("runs").isEnabled());
    // What another version wrote is left out, and said.
    QVERIFY(broken.open(QIODevice::WriteOnly | QIODevice::Truncate));
    broken.write(R"({"format": "terrawalk-runs 1", "runs": [{"finished": "2026-05-01T08:00:00.000Z",
        "program": "Terrawalk 9", "figures": {}, "settings": {"surface.not_yet": "1"}}]})");
    broken.close();
    openSample();
    QTRY_VERIFY(idle() && messages().contains("1 earlier run cannot be read"));
}

void WindowTest::figuresStandBesideThoseOfTheRunBefore() {
    processed();
    auto* table = window_->findChild<QWidget*>("figure_table");
    QVERIFY(!table->isVisibleTo(window_));
    const double before_m = session().runs().back().figures.at("height_rmse_m");
    QVERIFY(session().changeSetting("surface.method", "nearest"));
    processed();
    const double now_m = session().runs().back().figures.at("height_rmse_m");
    QVERIFY(now_m > before_m);
    QVERIFY(table->isVisibleTo(window_));
    auto* grid = qobject_cast<QGridLayout*>(table->layout());
    const auto cell = [&](int row, int column) {
        return qobject_cast<QLabel*>(grid->itemAtPosition(row, column)->widget());
    };
    QCOMPARE(cell(1, 0)->text(), QString("Height RMSE (m)"));
    QCOMPARE(cell(1, 1)->text(), QString::number(before_m, 'f', 3));
    QCOMPARE(cell(1, 2)->text(), QString::number(now_m, 'f', 3));
    QVERIFY(cell(1, 3)->text().startsWith('+'));
    QCOMPARE(cell(1, 4)->text(), QString(QChar(0x2717)));
    QCOMPARE(cell(1, 4)->toolTip(), QString("worse"));
    // Nothing is cut off, and numbers end in one line.
    for (int row = 1; row < 4; ++row) {
        for (int column = 0; column < 4; ++column)
            QVERIFY(cell(row, column)->width() >= cell(row, column)->sizeHint().width());
        QCOMPARE(cell(row, 1)->geometry().right(), cell(1, 1)->geometry().right());
    }
    QVERIFY(table->width() <= table->parentWidget()->width());
}

void WindowTest::keysAloneSuffice() {
    openSample();
    QTest::keyClick(window_, Qt::Key_F5);
    QTRY_VERIFY_WITH_TIMEOUT(session().products() && idle(), kLong_ms);
    QTest::keyClick(window_, Qt::Key_2, Qt::ControlModifier);
    QCOMPARE(window_->findChild<QTabWidget*>("views")->currentIndex(), 1);
    QTest::keyClick(window_, Qt::Key_1, Qt::ControlModifier);
    MapView& map = window_->map();
    map.setFocus();
    const double scale = map.transform().pixels_per_m;
    QTest::keyClick(&map, Qt::Key_Plus);
    QVERIFY(map.transform().pixels_per_m > scale);
    QTest::keyClick(&map, Qt::Key_Home);
    QCOMPARE(map.transform().pixels_per_m, scale);
    QTest::keyClick(window_, Qt::Key_F1);
    QVERIFY(QApplication::activeModalWidget() != nullptr);
    QStringList listed;
    for (const QLabel* label : QApplication::activeModalWidget()->findChildren<QLabel*>())
        listed << label->text();
    for (const char* what : {"Move the map", "Turn the view", "Zoom the time axis", "All settings"})
        QVERIFY2(listed.contains(what), what);
    QTest::keyClick(QApplication::activeModalWidget(), Qt::Key_Escape);
    QTRY_VERIFY(QApplication::activeModalWidget() == nullptr);
    // Every button and field can be reached and has a name for a screen reader.
    for (const QAbstractButton* button : window_->findChildren<QPushButton*>())
        QVERIFY(!button->text().isEmpty());
}

/// Logs and marks of the sample as a stick holds them: in one folder, without a survey.json.
QString WindowTest::looseFiles() {
    const QString folder = scratch_->filePath("walk");
    QDir().mkpath(folder);
    for (const QFileInfo& log : QDir(sample_ + "/logs").entryInfoList({"*.csv"}))
        QFile::copy(log.filePath(), folder + "/" + log.fileName());
    QFile::copy(sample_ + "/control.csv", folder + "/marks.csv");
    return folder;
}

NewSurveyDialog* WindowTest::newSurveyDialog() const {
    return qobject_cast<NewSurveyDialog*>(QApplication::activeModalWidget());
}

void WindowTest::droppedLogsAndMarksBecomeASurvey() {
    const QDir folder(looseFiles());
    QMimeData data;
    QList<QUrl> urls;
    for (const QFileInfo& file : folder.entryInfoList(QDir::Files))
        urls << QUrl::fromLocalFile(file.filePath());
    data.setUrls(urls);
    QDragEnterEvent enter(QPoint(100, 100), Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(window_, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent drop(QPointF(100, 100), Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(window_, &drop);
    NewSurveyDialog* dialog = newSurveyDialog();
    QVERIFY(dialog != nullptr);
    auto* create = dialog->findChild<QPushButton*>("primary");
    QVERIFY(!create->isEnabled());
    QTRY_VERIFY_WITH_TIMEOUT(create->isEnabled(), kLong_ms);
    auto* table = dialog->findChild<QTableWidget*>("runs");
    QCOMPARE(table->rowCount(), 4);
    const auto choice = [&](int row, NewSurveyDialog::Column column) {
        return qobject_cast<QComboBox*>(table->cellWidget(row, column));
    };
    QCOMPARE(choice(0, NewSurveyDialog::TargetColumn)->currentText(), QString("P01"));
    QCOMPARE(choice(3, NewSurveyDialog::KindColumn)->currentIndex(), 0);
    QVERIFY(!table->item(3, NewSurveyDialog::ReasonColumn)->text().isEmpty());
    choice(1, NewSurveyDialog::TargetColumn)->setCurrentText("C01");
    dialog->findChild<QLineEdit*>("survey_name")->setText("Dropped");
    // More files do not undo what was corrected.
    dialog->addFiles({folder.filePath("F01.csv")});
    QTRY_VERIFY_WITH_TIMEOUT(!dialog->reading() && create->isEnabled(), kLong_ms);
    QCOMPARE(table->rowCount(), 4);
    QCOMPARE(choice(1, NewSurveyDialog::TargetColumn)->currentText(), QString("C01"));
    QTest::mouseClick(create, Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(session().survey() && idle(), kLong_ms);
    QCOMPARE(session().survey()->name, std::string("Dropped"));
    QCOMPARE(session().survey()->runs.size(), std::size_t{4});
    QCOMPARE(session().survey()->runs[1].target.value_or(""), std::string("C01"));
    QVERIFY(fs::exists(folder.filePath("survey.json").toStdString()));
}

void WindowTest::newSurveyDialogRefusesWhatCannotBe() {
    const QDir folder(looseFiles());
    const QString bad = folder.filePath("S02.csv");
    QFile file(bad);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("time_s,lat_deg\n0,95\n");
    file.close();
    action("new").trigger();
    NewSurveyDialog* dialog = newSurveyDialog();
    QVERIFY(dialog != nullptr);
    auto* create = dialog->findChild<QPushButton*>("primary");
    const auto* problem = dialog->findChild<QLabel*>("problem");
    QVERIFY(!create->isEnabled());
    QVERIFY(problem->text().contains("at least one log"));
    dialog->addFiles({folder.path()});
    QTRY_VERIFY_WITH_TIMEOUT(!dialog->reading(), kLong_ms);
    auto* table = dialog->findChild<QTableWidget*>("runs");
    QCOMPARE(table->rowCount(), 5);
    QVERIFY(table->item(4, NewSurveyDialog::LogColumn)->text().contains("S02.csv:2:"));
    QVERIFY(!create->isEnabled());
    QVERIFY(problem->text().contains("cannot be used"));
    table->selectRow(4);
    QTest::mouseClick(dialog->findChild<QPushButton*>("remove_files"), Qt::LeftButton);
    QCOMPARE(table->rowCount(), 4);
    QVERIFY2(create->isEnabled(), qPrintable(problem->text()));

    const std::tuple<const char*, QString, QString> fields[] = {
        {"survey_name", " ", "name"},
        {"latitude", "abc", "latitude"},
        {"latitude", "91", "latitude"},
        {"longitude", "", "longitude"},
        {"height", "1e9", "height"},
        {"survey_file", "/no/such/place/survey.json", "does not exist"},
        {"survey_file", folder.path(), "Name a file"}};
    for (const auto& [name, wrong, words] : fields) {
        auto* field = dialog->findChild<QLineEdit*>(name);
        const QString right = field->text();
        field->setText(wrong);
        QVERIFY2(!create->isEnabled(), name);
        QVERIFY2(problem->text().contains(words), qPrintable(problem->text()));
        field->setText(right);
        QVERIFY2(create->isEnabled(), qPrintable(problem->text()));
    }
    auto* target = qobject_cast<QComboBox*>(table->cellWidget(0, NewSurveyDialog::TargetColumn));
    target->setCurrentIndex(0);
    QVERIFY(!create->isEnabled());
    QVERIFY(problem->text().contains("no target mark"));
    target->setCurrentText("P01");
    table->item(0, NewSurveyDialog::RunColumn)->setText("F02");
    QVERIFY(problem->text().contains("two runs"));
    table->item(0, NewSurveyDialog::RunColumn)->setText("F01");
    QVERIFY(create->isEnabled());
    // A frame that is none is found when it is written; the dialog stays.
    dialog->findChild<QComboBox*>("frame")->setEditText("EPSG:4326");
    QTest::mouseClick(create, Qt::LeftButton);
    QVERIFY(dialog->isVisible());
    QVERIFY(problem->text().contains("4326"));
    QVERIFY(!fs::exists(folder.filePath("survey.json").toStdString()));
    dialog->findChild<QComboBox*>("frame")->setEditText("");
    // Never over another survey unasked.
    QVERIFY(QFile::copy(sample_ + "/survey.json", folder.filePath("survey.json")));
    dialog->findChild<QLineEdit*>("survey_name")->setText("Again");
    auto* replace = dialog->findChild<QCheckBox*>("replace");
    QVERIFY(replace->isVisible());
    QVERIFY(!create->isEnabled());
    replace->setChecked(true);
    QTest::mouseClick(create, Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(session().survey() && idle(), kLong_ms);
    QCOMPARE(session().survey()->name, std::string("Again"));
    QCOMPARE(session().survey()->crs, std::string());
}

void WindowTest::settingsTravelThroughAnyFile() {
    openSample();
    QVERIFY(session().changeSetting("surface.cell_m", "0.5"));
    const QString file = scratch_->filePath("my settings.json");
    window_->questions.settings_target = [&](const QString&, const QString&) {
        return file;
    };
    action("save_settings_as").trigger();
    QVERIFY(fs::exists(file.toStdString()));
    QVERIFY(window_->isWindowModified());
    QProcess command;
    command.start(TERRAWALK_PROGRAM,
                  {"process", sample_, "--config", file, "-o", scratch_->filePath("out"), "-q"});
    QVERIFY(command.waitForFinished(kLong_ms));
    QCOMPARE(command.exitCode(), 0);
    QVERIFY(session().changeSetting("surface.cell_m", "2"));
    window_->questions.settings_file = [&](const QString&, const QString&) {
        return file;
    };
    action("load_settings").trigger();
    QCOMPARE(session().settings().config().surface.cell_m, 0.5);
    action("undo").trigger();
    QCOMPARE(session().settings().config().surface.cell_m, 2.0);
}

void WindowTest::badSettingsAndSearchesAreMessages() {
    openSample();
    const QString answer = scratch_->filePath("answer.json");
    const auto put = [&](const QByteArray& bytes) {
        QFile out(answer);
        QVERIFY(out.open(QIODevice::WriteOnly));
        out.write(bytes);
    };
    QString asked = answer;
    window_->questions.settings_file = window_->questions.searches = [&](const QString&, const QString&) {
        return asked;
    };
    const std::pair<QByteArray, QString> settings[] = {
        {"", "not valid JSON"},
        {"{\"format\": \"terrawalk-config 1\", \"surface\": {\"cell\": 1}}", "cell"},
        {"{\"format\": \"terrawalk-config 1\", \"surface\": {\"cell_m\": -1}}", "cell_m"},
        {"{\"format\": \"other 1\"}", "answer.json"}};
    for (const auto& [bytes, words] : settings) {
        put(bytes);
        const qsizetype before = messages().size();
        action("load_settings").trigger();
        QVERIFY2(messages().mid(before).contains(words), qPrintable(messages().mid(before)));
        QVERIFY(!window_->isWindowModified());
    }
    asked = scratch_->filePath("none.json");
    action("load_settings").trigger();
    QVERIFY(messages().contains("none.json"));
    // Whoever cancels the question changes nothing.
    asked.clear();
    const QString all = messages();
    action("load_settings").trigger();
    QCOMPARE(messages(), all);
    window_->questions.settings_target = [](const QString&, const QString&) {
        return QString("/no/such/place/settings.json");
    };
    action("save_settings_as").trigger();
    QVERIFY(messages().contains("/no/such/place/settings.json"));

    window_->findChild<PlotsView*>()->setPlot(PlotKind::Convergence);
    window_->findChild<QTabWidget*>("views")->setCurrentIndex(2);
    auto* open = window_->findChild<QPushButton*>("openSearches");
    QVERIFY(open->isVisible());
    asked = answer;
    put("{}");
    QTest::mouseClick(open, Qt::LeftButton);
    QVERIFY(messages().contains("no search for parameters"));
    QVERIFY(session().tuning()->traces.empty());
    asked = scratch_->filePath("fig10.csv");
    QFile table(asked);
    QVERIFY(table.open(QIODevice::WriteOnly));
    table.write("tuner,repeat,loss [m2]\nISMA,1,2\nISMA,2,3\nPSO,1,4\n");
    table.close();
    QTest::mouseClick(open, Qt::LeftButton);
    window_->findChild<PlotsView*>()->setPlot(PlotKind::Optimisers);
    const Plot& plot = window_->findChild<PlotsView*>()->canvas().plot();
    QCOMPARE(plot.categories, (QStringList{"ISMA", "PSO"}));
    QCOMPARE(plot.panels[0].series[0].style, SeriesStyle::Boxes);
    QCOMPARE(plot.panels[0].series[0].y.size(), std::size_t{3});
}

void WindowTest::tuningRefusesWhatItCannotDoAndIsPlotted() {
    openSample();
    QVERIFY(session().changeSetting("fusion.method", "raw"));
    action("tune").trigger();
    QTRY_VERIFY_WITH_TIMEOUT(idle(), kLong_ms);
    QVERIFY2(messages().contains("raw"), qPrintable(messages()));
    QVERIFY(!session().settings().tuned());
    QVERIFY(session().changeSetting("fusion.method", "ukf"));
    auto* optimiser = window_->findChild<QComboBox*>("optimiser");
    optimiser->setCurrentIndex(optimiser->findText("Particle swarm"));
    // The effort is folded away, and what is usual until it is chosen.
    auto* population = window_->findChild<QSpinBox*>("population");
    QVERIFY(!population->isVisible());
    QCOMPARE(population->text(), QString("auto"));
    for (QToolButton* fold : window_->findChildren<QToolButton*>("further"))
        if (fold->isCheckable()) fold->click();
    QVERIFY(population->isVisible());
    population->setValue(9);
    window_->findChild<QSpinBox*>("iterations")->setValue(2);
    window_->findChild<QSpinBox*>("restarts")->setValue(2);
    window_->findChild<QSpinBox*>("repeats")->setValue(2);
    QTest::mouseClick(window_->findChild<QPushButton*>("step_tune"), Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(idle() && session().tuning()->traces.size() == 2, kLong_ms);
    QVERIFY(session().settings().tuned());
    QCOMPARE(session().settings().config().tuning->population, std::size_t{9});
    QCOMPARE(session().settings().config().tuning->iterations, std::size_t{2});
    auto* plots = window_->findChild<PlotsView*>();
    plots->setPlot(PlotKind::Convergence);
    const Plot& plot = plots->canvas().plot();
    QCOMPARE(plot.panels.size(), std::size_t{1});
    QCOMPARE(plot.panels[0].series.size(), std::size_t{2});
    for (const PlotSeries& line : plot.panels[0].series) {
        QVERIFY(line.name.startsWith("pso"));
        QVERIFY(std::is_sorted(line.x.begin(), line.x.end()));
        QVERIFY(std::is_sorted(line.y.rbegin(), line.y.rend()));
    }
    // Saved settings keep how they came about.
    action("save").trigger();
    window_->open(sample_);
    QTRY_VERIFY_WITH_TIMEOUT(idle() && session().tuning()->traces.size() == 1, kLong_ms);
}

void WindowTest::dialogsCloseAndReopen() {
    processed();
    for (const char* name : {"shortcuts", "about", "export", "runs", "new"}) {
        for (int time = 0; time < 2; ++time) {
            action(name).trigger();
            QWidget* dialog = QApplication::activeModalWidget();
            QVERIFY2(dialog != nullptr, name);
            QVERIFY(!dialog->windowTitle().isEmpty());
            // No window manager does it here.
            QApplication::setActiveWindow(dialog);
            tabThrough(*dialog);
            QTest::keyClick(dialog, Qt::Key_Escape);
            QTRY_VERIFY(QApplication::activeModalWidget() == nullptr);
        }
    }
    // A language that there is none of is English.
    applyLanguage("xx");
    QCOMPARE(MainWindow::tr("&Open…"), QString("&Open…"));
}

void WindowTest::changeSinceAnEarlierRunIsALayerOfBothViews() {
    processed();
    QVERIFY(!session().viewState().available(RasterLayer::Change));
    QVERIFY(session().changeSetting("surface.method", "natural-neighbour"));
    processed();
    auto* menu = window_->findChild<QMenu*>("compare");
    Q_EMIT menu->aboutToShow();
    QVERIFY(menu->actions().front()->isEnabled());
    menu->actions().front()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(idle() && session().viewState().now().change, kLong_ms);
    QTRY_VERIFY_WITH_TIMEOUT(window_->map().scene().raster != nullptr, kLong_ms);
    QCOMPARE(window_->map().scene().raster->layer, RasterLayer::Change);
    QCOMPARE(window_->findChild<QComboBox*>("layers")->currentText(), QString("Change of height"));
    auto* terrain = window_->findChild<TerrainView*>();
    QTRY_VERIFY_WITH_TIMEOUT(!terrain->building(), kLong_ms);
    QVERIFY(messages().contains("median"));
    // A file that is no DEM changes nothing.
    const auto change = session().viewState().now().change;
    window_->questions.dem = [&](const QString&, const QString&) {
        return sample_ + "/survey.json";
    };
    window_->findChild<QAction*>("compare_dem")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(idle() && messages().contains("no raster"), kLong_ms);
    QCOMPARE(session().viewState().now().change, change);
    session().exportTo(scratch_->filePath("out").toStdString());
    QTRY_VERIFY_WITH_TIMEOUT(idle(), kLong_ms);
    window_->questions.dem = [&](const QString&, const QString&) {
        return scratch_->filePath("out/dem.tif");
    };
    window_->findChild<QAction*>("compare_dem")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(idle() && session().viewState().now().change != change, kLong_ms);
    QVERIFY(session().viewState().now().change->rms_m < 1e-3);
    // Other results, other heights: what was compared goes.
    session().goBackTo(0);
    QVERIFY(!session().viewState().now().change);
    QCOMPARE(session().viewState().now().layer, RasterLayer::Height);
}

void WindowTest::bothViewsFollowOneState() {
    processed();
    auto* terrain = window_->findChild<TerrainView*>();
    auto* panel = window_->findChild<MapPanel*>();
    QVERIFY(panel != nullptr);
    window_->findChild<QTabWidget*>("views")->setCurrentIndex(1);
    QTRY_VERIFY_WITH_TIMEOUT(!terrain->building() && terrain->frame().overlay, kLong_ms);
    const std::size_t lines = terrain->frame().overlay->lines.size();
    panel->findChild<QAction*>("showTracks")->trigger();
    QVERIFY(!window_->map().scene().shown.tracks);
    QVERIFY(terrain->frame().overlay->lines.size() < lines);
    QVERIFY(!terrain->findChild<QAction*>("showTracks")->isChecked());
    terrain->findChild<QAction*>("showTracks")->trigger();
    QVERIFY(window_->map().scene().shown.tracks);
    QCOMPARE(terrain->frame().overlay->lines.size(), lines);
    QVERIFY(terrain->frame().contour_interval_m > 0.0);
    panel->findChild<QAction*>("showContours")->trigger();
    QCOMPARE(terrain->frame().contour_interval_m, 0.0);
    window_->findChild<QComboBox*>("layers")->setCurrentIndex(1);
    QCOMPARE(session().viewState().now().layer, RasterLayer::Uncertainty);
    QTRY_VERIFY_WITH_TIMEOUT(!terrain->building(), kLong_ms);
    // And it outlives a change of the language.
    action("language").trigger();
    QTRY_VERIFY(&desktop_->window() != window_);
    window_ = &desktop_->window();
    QCOMPARE(window_->findChild<QComboBox*>("layers")->currentIndex(), 1);
    QVERIFY(!window_->map().scene().shown.contours);
}

void WindowTest::everyPartExplainsItself() {
    processed();
    const auto told = [](const QWidget& widget) {
        for (const QWidget* w = &widget; w != nullptr && !w->isWindow(); w = w->parentWidget()) {
            if (!w->whatsThis().isEmpty()) return true;
        }
        return false;
    };
    auto* views = window_->findChild<QTabWidget*>("views");
    for (int tab = 0; tab < views->count(); ++tab) {
        views->setCurrentIndex(tab);
        for (QWidget* widget : views->currentWidget()->findChildren<QWidget*>()) {
            const bool control = widget->focusPolicy() != Qt::NoFocus && widget->isVisible();
            QVERIFY2(!control || told(*widget),
                     qPrintable(views->tabText(tab) + ": " + widget->objectName()));
        }
    }
    for (const QDockWidget* dock : window_->findChildren<QDockWidget*>())
        QVERIFY2(!dock->whatsThis().isEmpty(), qPrintable(dock->objectName()));
    for (const QAction* one : window_->findChild<MapPanel*>()->toolActions())
        QVERIFY2(!one->whatsThis().isEmpty(), qPrintable(one->text()));
}

void WindowTest::everyActionOfTheMenusHasAStatusTip() {
    processed();
    std::function<void(const QList<QAction*>&)> visit = [&](const QList<QAction*>& actions) {
        for (const QAction* one : actions) {
            if (one->isSeparator()) continue;
            if (one->menu() != nullptr) {
                if (one->menu()->objectName() != "recent") visit(one->menu()->actions());
                continue;
            }
            QVERIFY2(!one->statusTip().isEmpty() || !one->isEnabled(), qPrintable(one->text()));
            QVERIFY2(one->statusTip() != QString(one->text()).remove('&').remove("…"),
                     qPrintable(one->text()));
        }
    };
    visit(window_->menuBar()->actions());
}

void WindowTest::toolBarsAndMenusShowWhatTheyHold() {
    processed();
    for (const bool dark : {false, true}) {
        if (dark) action("theme").trigger();
        // The button for what a narrow tool bar has no room for is as wide as the others.
        auto* bar = window_->findChild<QToolBar*>("map_bar");
        auto* more = bar->findChild<QToolButton*>("qt_toolbar_ext_button");
        QTRY_VERIFY(more->isVisible());
        QVERIFY(more->width() >= 24);
        // The icon of the tool that is in use stands out from the menu.
        QMenu* edit = nullptr;
        for (QAction* top : window_->menuBar()->actions())
            if (top->menu()->actions().contains(&action("undo"))) edit = top->menu();
        QVERIFY(edit != nullptr);
        edit->popup(window_->mapToGlobal(QPoint(40, 20)));
        QVERIFY(QTest::qWaitForWindowExposed(edit));
        const QRect place = edit->actionGeometry(&action("tool_pan"));
        const QImage picture = edit->grab(QRect(place.topLeft(), QSize(32, place.height()))).toImage();
        const QImage other = edit->grab(QRect(edit->actionGeometry(&action("tool_measure")).topLeft(),
                                              QSize(32, place.height())))
                                 .toImage();
        const auto contrast = [](const QImage& image) {
            int darkest = 255, lightest = 0;
            for (int y = 4; y < image.height() - 4; ++y) {
                for (int x = 4; x < image.width() - 4; ++x) {
                    const int grey = qGray(image.pixel(x, y));
                    darkest = std::min(darkest, grey);
                    lightest = std::max(lightest, grey);
                }
            }
            return lightest - darkest;
        };
        edit->close();
        QVERIFY2(contrast(picture) > 90, qPrintable(QString::number(contrast(picture))));
        QVERIFY2(contrast(other) > 90, qPrintable(QString::number(contrast(other))));
    }
}

/// From where the focus is, the tab key comes to each control that can be seen, and back.
void WindowTest::tabThrough(QWidget& top) {
    QSet<QWidget*> met;
    for (int i = 0; i < 600; ++i) {
        QWidget* now = QApplication::focusWidget();
        QVERIFY(now != nullptr);
        if (met.contains(now)) break;
        met << now;
        QTest::keyClick(now, Qt::Key_Tab);
    }
    for (QWidget* widget : top.findChildren<QWidget*>()) {
        if (!(widget->focusPolicy() & Qt::TabFocus) || !widget->isVisible() || !widget->isEnabled()) continue;
        if (widget->focusProxy() != nullptr || widget->isWindow() || widget->window() != top.window())
            continue;
        const bool radio = qobject_cast<QAbstractButton*>(widget) != nullptr &&
                           qobject_cast<QAbstractButton*>(widget)->group() != nullptr;
        QString name = widget->objectName();
        for (QWidget* w = widget->parentWidget(); w != nullptr; w = w->parentWidget())
            name.prepend(QString(w->objectName().isEmpty() ? w->metaObject()->className() : w->objectName()) +
                         "/");
        QVERIFY2(met.contains(widget) || radio, qPrintable(name + " " + widget->metaObject()->className()));
    }
}

void WindowTest::tabReachesEveryControl() {
    window_->findChild<QPushButton*>("start_new")->setFocus();
    tabThrough(*window_);
    processed();
    auto* views = window_->findChild<QTabWidget*>("views");
    for (int tab = 0; tab < views->count(); ++tab) {
        views->setCurrentIndex(tab);
        window_->findChild<QTreeView*>("survey_tree")->setFocus();
        tabThrough(*window_);
    }
}

void WindowTest::chineseKnowsSettingsStepsAndSentences() {
    processed();
    applyLanguage("zh_CN");
    const auto isChinese = [](const QString& words) {
        return std::any_of(words.begin(), words.end(), [](QChar c) { return c.unicode() >= 0x4E00; });
    };
    for (const ParameterInfo& info : knownParameters()) {
        const QString label = settingLabel(QString::fromStdString(info.key));
        QVERIFY2(isChinese(label), qPrintable(label));
        const QString meaning = settingMeaning(QString::fromStdString(info.key));
        QVERIFY2(isChinese(meaning), qPrintable(meaning));
    }
    QCOMPARE(joinSentences({"甲。", QString(), "乙。"}), QString("甲。乙。"));
    QVERIFY2(settingHelp("fusion.joint.rounds").contains(" 至 "),
             qPrintable(settingHelp("fusion.joint.rounds")));
    const SurveyReport& report = session().products()->report;
    std::vector<std::string> sentences;
    for (const auto* lines : {&report.statements, &report.limitations, &report.warnings})
        sentences.insert(sentences.end(), lines->begin(), lines->end());
    for (const KeyFigure& figure : report.figures) {
        sentences.push_back(figure.label);
        sentences.push_back(figure.detail);
    }
    for (const char* step :
         {"reading F01.csv", "fusing S01", "smoothing S01", "adjusting all runs", "gridding",
          "making the surface", "looking for terrace edges", "writing dem.tif"}) {
        sentences.emplace_back(step);
    }
    for (const std::string& sentence : sentences)
        QVERIFY2(isChinese(reportWords(sentence)), sentence.c_str());
    QCOMPARE(reportWords("fusing S01"), QString::fromUtf8("融合 S01"));
    // Numbers and names come through, and what nobody knows stays.
    QVERIFY(
        reportWords("C08 is off by +0.442 m, more than 3 times the RMSE of the others: a possible blunder. "
                    "It is counted.")
            .contains("+0.442 m"));
    QCOMPARE(reportWords("no sentence of ours"), QString("no sentence of ours"));
    applyLanguage("en");
    QCOMPARE(reportWords("fusing S01"), QString("fusing S01"));
}

WindowTest::Silence WindowTest::longestSilence(const std::function<bool()>& done) {
    const auto own_ms = [] {
        timespec now{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
    };
    Silence longest;
    QElapsedTimer timer;
    while (!done()) {
        timer.start();
        const double before_ms = own_ms();
        QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
        longest.wall_ms = std::max(longest.wall_ms, static_cast<double>(timer.nsecsElapsed()) * 1e-6);
        longest.own_ms = std::max(longest.own_ms, own_ms() - before_ms);
    }
    return longest;
}

// The aim is 50 ms of work of the window's own thread in one turn; the limit leaves room for a busy machine.
void WindowTest::orchardNeverSilencesTheWindow() {
    auto* terrain = window_->findChild<TerrainView*>();
    bool complete = false;
    connect(terrain, &TerrainView::drawn, this, [&](qulonglong, double, bool all) { complete = all; });
    const auto measured = [&](const char* what, const std::function<bool()>& done) {
        const Silence silence = longestSilence(done);
        qInfo("%s: longest turn %.0f ms by the clock, %.0f ms of work", what, silence.wall_ms,
              silence.own_ms);
        return silence.own_ms;
    };
    std::vector<double> turns_ms;
    window_->open(TERRAWALK_SOURCE_DIR "/sample_surveys/mango_orchard");
    turns_ms.push_back(measured("opening", [this] { return session().survey() && idle(); }));
    action("process").trigger();
    turns_ms.push_back(measured("processing", [this] { return session().products() && idle(); }));
    turns_ms.push_back(measured("map", [this] { return !window_->map().preparing(); }));
    window_->findChild<QTabWidget*>("views")->setCurrentIndex(1);
    turns_ms.push_back(measured("3-D, first picture", [&] { return complete && !terrain->building(); }));
    complete = false;
    terrain->viewFrom(ViewFrom::South);
    turns_ms.push_back(measured("3-D, last picture at rest", [&] { return complete; }));
    for (const int tab : {2, 3, 4, 0}) {
        window_->findChild<QTabWidget*>("views")->setCurrentIndex(tab);
        QElapsedTimer shown;
        shown.start();
        const QByteArray name = QString("tab %1").arg(tab).toUtf8();
        turns_ms.push_back(measured(name.constData(), [&] { return shown.elapsed() > 500; }));
    }
    for (const double ms : turns_ms) QVERIFY2(ms < 100.0 * kSlack, qPrintable(QString::number(ms)));
}

}  // namespace terrawalk::gui

namespace {

/// The part of the test that is killed: edits a survey and waits for its end.
int editAndWait(const QString& survey) {
    using namespace terrawalk::gui;
    Desktop desktop;
    desktop.window().open(survey);
    while (!desktop.session().survey()) QTest::qWait(10);
    desktop.session().changeSetting("surface.cell_m", "0.75");
    QTest::qWait(1500);  // longer than the autosave takes
    std::printf("edited\n");
    std::fflush(stdout);
    QTest::qWait(60000);
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    QStandardPaths::setTestModeEnabled(true);
    QApplication app(argc, argv);
    QApplication::setOrganizationName("Terrawalk");
    QApplication::setApplicationName(terrawalk::gui::testName());
    const QString survey = qEnvironmentVariable("TERRAWALK_TEST_EDIT_AND_WAIT");
    if (!survey.isEmpty()) return editAndWait(survey);
    terrawalk::gui::WindowTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "test_window.moc"
