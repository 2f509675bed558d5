// How long a person waits for the window: its start, a survey, a cancel; and how long it is deaf meanwhile.
#include <QApplication>
#include <QComboBox>
#include <QDir>
#include <QElapsedTimer>
#include <QSettings>
#include <QStandardPaths>
#include <QTabWidget>
#include <QTest>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <vector>

#include "app/gui/desktop.hpp"
#include "app/gui/language.hpp"
#include "app/gui/terrain_view.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {
namespace {

constexpr int kRepeats = 5;

struct Waited {
    double whole_ms = 0.0;
    double longest_turn_ms = 0.0;  ///< of the event loop, by the clock
};

Waited waitFor(const std::function<bool()>& done) {
    Waited waited;
    QElapsedTimer whole, turn;
    whole.start();
    while (!done()) {
        turn.start();
        QCoreApplication::processEvents(QEventLoop::AllEvents, 5);
        waited.longest_turn_ms = std::max(waited.longest_turn_ms, double(turn.nsecsElapsed()) * 1e-6);
    }
    waited.whole_ms = double(whole.nsecsElapsed()) * 1e-6;
    return waited;
}

double timed(const std::function<void()>& work) {
    QElapsedTimer timer;
    timer.start();
    work();
    return double(timer.nsecsElapsed()) * 1e-6;
}

class Table {
  public:
    void add(const QString& what, double ms) {
        const auto found =
            std::find_if(rows_.begin(), rows_.end(), [&](const Row& r) { return r.what == what; });
        (found == rows_.end() ? rows_.emplace_back(Row{what, {}}) : *found).ms.push_back(ms);
    }
    void print() {
        std::printf("%-44s %9s %9s %9s  ms\n", "", "min", "median", "max");
        for (Row& row : rows_) {
            std::sort(row.ms.begin(), row.ms.end());
            std::printf("%-44s %9.1f %9.1f %9.1f\n", qPrintable(row.what), row.ms.front(),
                        row.ms[row.ms.size() / 2], row.ms.back());
        }
    }

  private:
    struct Row {
        QString what;
        std::vector<double> ms;
    };
    std::vector<Row> rows_;
};

bool settled(MainWindow& window) {
    return !window.session().busy() && !window.filling() && !window.map().preparing() &&
           !window.findChild<TerrainView*>()->building();
}

void measure(Table& table, const QString& survey) {
    // Nothing of the time before.
    QSettings().clear();
    QDir(QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation)).removeRecursively();
    std::unique_ptr<Desktop> desktop;
    table.add("window: made and shown", timed([&] {
                  desktop = std::make_unique<Desktop>();
                  desktop->window().resize(1280, 800);
                  desktop->window().show();
                  QCoreApplication::processEvents();
              }));
    MainWindow& window = desktop->window();
    SurveySession& session = window.session();
    window.open(survey);
    const Waited opened = waitFor([&] { return session.survey() && settled(window); });
    table.add("open the orchard", opened.whole_ms);
    table.add("  longest turn of opening", opened.longest_turn_ms);
    for (const int after_ms : {300, 1500, 2500}) {
        session.process();
        QElapsedTimer run;
        run.start();
        (void)waitFor([&] { return run.elapsed() > after_ms; });
        session.cancel();
        table.add("cancel of processing", waitFor([&] { return !session.busy(); }).whole_ms);
    }
    session.process();
    const Waited processed = waitFor([&] { return session.products() && settled(window); });
    table.add("process the orchard", processed.whole_ms);
    table.add("  longest turn of processing", processed.longest_turn_ms);
    auto* views = window.findChild<QTabWidget*>("views");
    for (int tab = 1; tab < views->count(); ++tab) {
        views->setCurrentIndex(tab);
        QElapsedTimer shown;
        shown.start();
        table.add("turn to view " + views->tabText(tab) + ", longest turn",
                  waitFor([&] { return shown.elapsed() > 400 && settled(window); }).longest_turn_ms);
    }
    views->setCurrentIndex(0);
    // Ten million cells.
    session.changeSetting("surface.cell_m", "0.017");
    session.process();
    const Waited fine = waitFor([&] { return !session.outdated() && settled(window); });
    const std::size_t cells = session.products()->dem.geometry.size();
    const QString of = QString(" of %1 million cells").arg(double(cells) * 1e-6, 0, 'f', 1);
    table.add("process" + of, fine.whole_ms);
    table.add("  longest turn" + of, fine.longest_turn_ms);
    MapView& map = window.map();
    for (int i = 0; i < 6; ++i) {
        table.add("zoom the map" + of, timed([&] {
                      map.zoomBy(i < 3 ? 1.5 : 1.0 / 1.5);
                      map.repaint();
                  }));
        (void)waitFor([&] { return settled(window); });
        table.add("move the map" + of, timed([&] {
                      map.centreOn(map.transform().centre_m + QPointF(0.5, 0.3));
                      map.repaint();
                  }));
        (void)waitFor([&] { return settled(window); });
    }
    window.findChild<QComboBox*>("layers")->setCurrentIndex(1);
    const Waited layer = waitFor([&] { return settled(window); });
    table.add("another layer" + of, layer.whole_ms);
    table.add("  longest turn of another layer", layer.longest_turn_ms);
}

}  // namespace
}  // namespace terrawalk::gui

int main(int argc, char** argv) {
    using namespace terrawalk::gui;
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
    QStandardPaths::setTestModeEnabled(true);
    QApplication app(argc, argv);
    QApplication::setOrganizationName("Terrawalk");
    QApplication::setApplicationName("terrawalk-bench");
    QSettings().clear();
    applyLanguage("en");
    applyTheme(Theme::Light);
    const QString survey =
        argc > 1 ? argv[1] : QString(TERRAWALK_SOURCE_DIR "/sample_surveys/mango_orchard/survey.json");
    Table table;
    for (int i = 0; i < kRepeats; ++i) measure(table, survey);
    table.print();
    return 0;
}
