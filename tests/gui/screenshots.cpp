// Pictures of the window's views for people to look at: screenshots FOLDER [SURVEY [ONLY]]. Needs a display,
// such as Xvfb's. ONLY is a part of the names of those that are made, e.g. dark_1920x1080 or zh.
#include <QApplication>
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QScrollArea>
#include <QScrollBar>
#include <QSettings>
#include <QStandardPaths>
#include <QTabWidget>
#include <QTest>
#include <QToolButton>
#include <QTreeView>
#include <cstdio>

#include "app/gui/desktop.hpp"
#include "app/gui/language.hpp"
#include "app/gui/new_survey_dialog.hpp"
#include "app/gui/plot_data.hpp"
#include "app/gui/plots_view.hpp"
#include "app/gui/report_view.hpp"
#include "app/gui/settings_dialog.hpp"
#include "app/gui/terrain_view.hpp"
#include "app/gui/theme.hpp"

namespace {

using namespace terrawalk;
using namespace terrawalk::gui;

bool waitFor(const std::function<bool()>& done, int limit_ms) {
    QElapsedTimer timer;
    timer.start();
    while (!done() && timer.elapsed() < limit_ms) QTest::qWait(20);
    return done();
}

class Camera {
  public:
    Camera(MainWindow& window, QDir folder, QString suffix)
        : window_(window), folder_(std::move(folder)), suffix_(std::move(suffix)) {}
    void shoot(const QString& name, QWidget* what = nullptr) {
        waitFor(
            [this] {
                return !window_.map().preparing() && !window_.findChild<ReportView*>()->preparing() &&
                       !window_.findChild<TerrainView*>()->building();
            },
            60000);
        QTest::qWait(150);
        const QString file = folder_.filePath(name + suffix_ + ".png");
        (what != nullptr ? what : &window_)->grab().save(file);
        std::printf("%s\n", qPrintable(file));
    }

  private:
    MainWindow& window_;
    QDir folder_;
    QString suffix_;
};

QString suffixOf(Theme theme, QSize size, const QString& language) {
    return QString("_%1_%2x%3_%4")
        .arg(theme == Theme::Dark ? "dark" : "light")
        .arg(size.width())
        .arg(size.height())
        .arg(language);
}

void shootAll(const QDir& folder, const QString& survey, Theme theme, QSize size, const QString& suffix) {
    QSettings().clear();
    QDir(QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation)).removeRecursively();
    QSettings().setValue("theme", theme == Theme::Dark ? "dark" : "light");
    applyTheme(theme);
    Desktop desktop;
    MainWindow& window = desktop.window();
    window.resize(size);
    window.show();
    QTest::qWait(100);
    Camera camera(window, folder, suffix);
    camera.shoot("start");
    SurveySession& session = window.session();
    window.open(survey);
    waitFor([&] { return session.survey() && !session.busy(); }, 60000);
    camera.shoot("opened");
    session.process();
    waitFor([&] { return session.products() && !session.busy(); }, 300000);
    auto* views = window.findChild<QTabWidget*>("views");
    const QRectF extent = window.map().scene().extent_m();
    QTest::mouseClick(&window.map(), Qt::LeftButton, {},
                      window.map().transform().toScreen(extent.center() + QPointF(7.3, 5.1)).toPoint());
    camera.shoot("map");
    const auto choose = [&](const char* combo, int row) {
        window.findChild<QComboBox*>(combo)->setCurrentIndex(row);
    };
    choose("layers", 1);
    choose("colourings", 5);
    camera.shoot("uncertainty");
    choose("layers", 0);
    Q_EMIT window.map().lineDrawn(
        MapTool::Profile, QPolygonF({extent.center() - QPointF(5, 25), extent.center() + QPointF(5, 25)}));
    camera.shoot("profile");
    window.findChild<QDockWidget*>("dock_profile")->hide();
    // What the surface would be without the adjustment of all runs.
    session.changeSetting("fusion.method", "ukf");
    session.process();
    waitFor([&] { return session.history().size() == 2 && !session.busy(); }, 300000);
    session.goBackTo(0);
    session.compareWith(1);
    waitFor([&] { return !session.busy() && session.viewState().now().change; }, 60000);
    camera.shoot("change");
    session.compareWithNothing();
    choose("colourings", 1);
    const MapTrack& track = session.map()->tracks.back();
    const std::size_t n = track.time_s.size();
    session.selection().select(
        {QString::fromStdString(track.run_id), track.time_s[n / 3], track.time_s[n / 2]});
    SurveyEdits edits = session.edits();
    const QPointF c = extent.center();
    edits.lines.push_back(
        {{{c.x() - 20, c.y() - 8, kMissing}, {c.x(), c.y() + 2, kMissing}, {c.x() + 15, c.y(), kMissing}},
         BreaklineKind::Hard,
         {}});
    edits.stretches.push_back({track.run_id, track.time_s[n / 8], track.time_s[n / 6], EditedSensor::All});
    session.changeEdits(edits, "draw");
    camera.shoot("edits");
    for (int tab = 1; tab < views->count(); ++tab) {
        views->setCurrentIndex(tab);
        QTest::qWait(tab == 1 || tab == 4 ? 2500 : 300);
        camera.shoot(QString("view%1").arg(tab));
    }
    if (size.width() == 1280) {
        views->setCurrentIndex(2);
        auto* plots = window.findChild<PlotsView*>();
        for (std::size_t i = 0; i < allPlots().size(); ++i) {
            plots->setPlot(allPlots()[i]);
            camera.shoot(QString("plot%1").arg(i, 2, 10, QChar('0')));
        }
    }
    views->setCurrentIndex(0);
    window.newSurvey({survey + "/logs", survey + "/control.csv"});
    if (auto* dialog = window.findChild<NewSurveyDialog*>()) {
        waitFor([&] { return !dialog->reading(); }, 60000);
        camera.shoot("dialog_new", dialog);
        dialog->close();
        QTest::qWait(50);
    }
    for (QAction* top : window.menuBar()->actions()) {
        QMenu* menu = top->menu();
        if (!menu->actions().contains(window.findChild<QAction*>("undo"))) continue;
        menu->popup(window.mapToGlobal(QPoint(40, 20)));
        QTest::qWait(100);
        camera.shoot("menu_edit", menu);
        menu->close();
    }
    for (const char* name : {"export", "shortcuts", "about"}) {
        window.findChild<QAction*>(name)->trigger();
        QTest::qWait(150);
        if (QWidget* dialog = QApplication::activeModalWidget()) {
            camera.shoot(QString("dialog_%1").arg(name), dialog);
            dialog->close();
            QTest::qWait(50);
        }
    }
    if (auto* tree = window.findChild<QTreeView*>("survey_tree")) {
        tree->scrollToBottom();
        camera.shoot("tree_results");
    }
    session.changeSetting("fusion.gnss.sigma_fixed_m", "0.05");
    session.changeSetting("surface.method", "kriging");
    camera.shoot("steps_changed");
    for (QToolButton* fold : window.findChildren<QToolButton*>("further"))
        if (fold->isCheckable()) fold->click();
    camera.shoot("steps_search");
    auto* steps = window.findChild<QScrollArea*>("steps_scroll");
    steps->verticalScrollBar()->setValue(steps->verticalScrollBar()->maximum());
    camera.shoot("steps_check");
    session.goBackTo(1);
    QTest::qWait(50);
    steps->verticalScrollBar()->setValue(steps->verticalScrollBar()->maximum());
    camera.shoot("steps_figures");
    window.findChild<QAction*>("runs")->trigger();
    if (QWidget* dialog = QApplication::activeModalWidget()) {
        camera.shoot("dialog_runs", dialog);
        dialog->close();
    }
    window.findChild<QAction*>("settings")->trigger();
    auto* settings = window.findChild<SettingsDialog*>();
    while (!settings->isVisible()) QTest::qWait(10);
    camera.shoot("dialog_settings", settings);
    settings->openAt(StepKind::Surface);
    camera.shoot("dialog_settings_surface", settings);
    settings->findChild<QLineEdit*>("setting_search")->setText("sigma gnss");
    camera.shoot("dialog_settings_search", settings);
    settings->close();
    // What a person did not save must not come back in the next picture.
    session.undoStack().setIndex(0);
    QTest::qWait(1000);
}

}  // namespace

int main(int argc, char** argv) {
    QStandardPaths::setTestModeEnabled(true);
    QApplication app(argc, argv);
    QApplication::setOrganizationName("Terrawalk");
    QApplication::setApplicationName("terrawalk-screenshots");
    if (argc < 2) {
        std::fprintf(stderr, "usage: screenshots FOLDER [SURVEY [ONLY]]\n");
        return 2;
    }
    const QDir folder(argv[1]);
    folder.mkpath(".");
    const QString survey = argc > 2 ? argv[2] : TERRAWALK_SOURCE_DIR "/sample_surveys/mango_orchard";
    const QString only = argc > 3 ? argv[3] : "";
    for (const QString& language : {QString("en"), QString("zh")}) {
        applyLanguage(language);
        for (const Theme theme : {Theme::Light, Theme::Dark}) {
            for (const QSize& size : {QSize(1280, 800), QSize(1920, 1080)}) {
                const QString suffix = suffixOf(theme, size, language);
                if (suffix.contains(only)) shootAll(folder, survey, theme, size, suffix);
            }
        }
    }
    return 0;
}
