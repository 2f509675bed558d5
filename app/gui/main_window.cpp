#include "app/gui/main_window.hpp"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QCloseEvent>
#include <QDesktopServices>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QHeaderView>
#include <QLabel>
#include <QListView>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QRegularExpression>
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTabWidget>
#include <QToolButton>
#include <QTreeView>
#include <QUrl>
#include <QWhatsThis>
#include <algorithm>
#include <utility>

#include "app/gui/accuracy_panel.hpp"
#include "app/gui/export_dialog.hpp"
#include "app/gui/language.hpp"
#include "app/gui/map_panel.hpp"
#include "app/gui/new_survey_dialog.hpp"
#include "app/gui/place_panel.hpp"
#include "app/gui/plot_canvas.hpp"
#include "app/gui/plots_view.hpp"
#include "app/gui/profile_plot.hpp"
#include "app/gui/recent_surveys.hpp"
#include "app/gui/report_view.hpp"
#include "app/gui/runs_dialog.hpp"
#include "app/gui/settings_dialog.hpp"
#include "app/gui/shortcuts_dialog.hpp"
#include "app/gui/show_menu.hpp"
#include "app/gui/start_page.hpp"
#include "app/gui/steps_panel.hpp"
#include "app/gui/terrain_view.hpp"
#include "app/pipeline/version.hpp"

namespace terrawalk::gui {

namespace {

constexpr int kLayoutVersion = 1;
constexpr const char* kIconName = "icon_name";

QString text(const std::string& utf8) {
    return QString::fromStdString(utf8);
}

std::string nameOf(const QString& utf16) {
    return utf16.toStdString();
}

enum class Dropped { Survey, Settings, Dem, Unknown };

Dropped kindOfDropped(const QString& path) {
    const QFileInfo info(path);
    const QString suffix = info.suffix().toLower();
    if (info.isDir()) return Dropped::Survey;
    if (QStringList{"tif", "tiff", "asc"}.contains(suffix)) return Dropped::Dem;
    if (suffix != "json") return Dropped::Unknown;
    constexpr qint64 kBeginning_bytes = 4096;
    QFile file(path);
    static const QRegularExpression settings("\"format\"\\s*:\\s*\"terrawalk-config");
    const bool read = file.open(QIODevice::ReadOnly);
    return read && settings.match(QString::fromUtf8(file.read(kBeginning_bytes))).hasMatch()
               ? Dropped::Settings
               : Dropped::Survey;
}

BreaklineKind kindOf(MapTool tool) {
    switch (tool) {
        case MapTool::SoftLine:
            return BreaklineKind::Soft;
        case MapTool::Boundary:
            return BreaklineKind::Boundary;
        case MapTool::Hole:
            return BreaklineKind::Hole;
        default:
            return BreaklineKind::Hard;
    }
}

}  // namespace

MainWindow::MainWindow(SurveySession& session, MessageModel& messages, QWidget* parent)
    : QMainWindow(parent), session_(session), message_model_(messages) {
    setObjectName("main_window");
    setWindowIcon(icon("terrawalk"));
    setAcceptDrops(true);
    setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
    setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    questions.survey = [this](const QString& title, const QString& folder) {
        return QFileDialog::getOpenFileName(this, title, folder, tr("Surveys (*.json);;All files (*)"));
    };
    questions.settings_file = [this](const QString& title, const QString& folder) {
        return QFileDialog::getOpenFileName(this, title, folder, tr("Settings (*.json);;All files (*)"));
    };
    questions.settings_target = [this](const QString& title, const QString& folder) {
        return QFileDialog::getSaveFileName(this, title, folder, tr("Settings (*.json);;All files (*)"));
    };
    questions.searches = [this](const QString& title, const QString& folder) {
        return QFileDialog::getOpenFileName(this, title, folder,
                                            tr("Tunings and experiments (*.json *.csv);;All files (*)"));
    };
    questions.dem = [this](const QString& title, const QString& folder) {
        return QFileDialog::getOpenFileName(this, title, folder, tr("Rasters (*.tif *.asc);;All files (*)"));
    };
    buildViews();
    buildDocks();
    buildActions();
    connectSession();
    resize(1280, 800);
    const QSettings settings;
    restoreGeometry(settings.value("window/geometry").toByteArray());
    restoreState(settings.value("window/layout").toByteArray(), kLayoutVersion);
    showSurvey();
    showProducts();
    plots_->setTuning(session_.tuning());
}

MainWindow::~MainWindow() = default;

MapView& MainWindow::map() {
    return map_->view();
}

void MainWindow::buildViews() {
    map_ = new MapPanel(session_.viewState(), session_.selection());
    terrain_ = new TerrainView(session_.viewState(), session_.selection());
    terrain_->setObjectName("terrain");
    plots_ = new PlotsView(session_.selection());
    plots_->setObjectName("plots");
    accuracy_ = new AccuracyPanel(session_.selection());
    report_ = new ReportView;
    report_->setObjectName("report");
    connect(report_, &ReportView::failed, this,
            [this](const QString& problem) { say(MessageKind::Error, problem); });
    connect(report_, &ReportView::saved, this,
            [this](const QString& path) { say(MessageKind::Done, tr("Saved to %1.").arg(path)); });
    views_ = new QTabWidget;
    views_->setObjectName("views");
    views_->setDocumentMode(true);
    views_->addTab(map_, tr("Map"));
    views_->addTab(terrain_, tr("3-D"));
    views_->addTab(plots_, tr("Plots"));
    views_->addTab(accuracy_, tr("Accuracy"));
    views_->addTab(report_, tr("Report"));
    start_ = new StartPage;
    pages_ = new QStackedWidget;
    pages_->addWidget(start_);
    pages_->addWidget(views_);
    setCentralWidget(pages_);
    connect(start_, &StartPage::openAsked, this, &MainWindow::askForSurvey);
    connect(start_, &StartPage::newAsked, this, [this] { newSurvey(); });
    connect(start_, &StartPage::surveyAsked, this, [this](const QString& path) { open(path); });
    connect(start_, &StartPage::sampleAsked, this, [this](const QString& path) { open(path, true); });
    MapView& view = map_->view();
    connect(&view, &MapView::hovered, this, [this](const QString& words) { readout_->setText(words); });
    connect(&view, &MapView::placeAsked, this, &MainWindow::askPlace);
    connect(&view, &MapView::lineDrawn, this, &MainWindow::takeLine);
    connect(terrain_, &TerrainView::hovered, this,
            [this](const QString& words) { readout_->setText(words); });
    connect(terrain_, &TerrainView::picked, this, &MainWindow::askPlace);
    connect(plots_, &PlotsView::searchesAsked, this, [this] {
        const QString file = questions.searches(tr("Tuning or experiment"), lastFolder());
        if (file.isEmpty()) return;
        rememberFolder(file);
        session_.openSearches(file.toStdString());
    });
    connect(plots_, &PlotsView::excludeAsked, this,
            [this](const std::vector<TrackStretch>& stretches, const QString& sensor) {
                for (const auto& [value, name] : kEditedSensors) {
                    if (sensor.toStdString() == name) excludeStretches(stretches, value);
                }
            });
    connect(plots_, &PlotsView::excludeMarkAsked, this,
            [this](const QString& mark) { leaveOut(SurveyTreeModel::MarkItem, mark, true); });
}

QDockWidget* MainWindow::addDock(Qt::DockWidgetArea area, const QString& name, const QString& title,
                                 QWidget* widget) {
    auto* dock = new QDockWidget(title, this);
    dock->setObjectName(name);
    dock->setWidget(widget);
    addDockWidget(area, dock);
    docks_ << dock;
    return dock;
}

void MainWindow::buildDocks() {
    tree_ = new QTreeView;
    tree_->setObjectName("survey_tree");
    tree_->setModel(&tree_model_);
    tree_->setHeaderHidden(true);
    tree_->setContextMenuPolicy(Qt::CustomContextMenu);
    tree_->setIndentation(16);
    tree_->setMinimumWidth(264);
    tree_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    tree_->setFrameShape(QFrame::NoFrame);
    tree_->setAccessibleName(tr("Survey"));
    connect(tree_, &QTreeView::customContextMenuRequested, this, &MainWindow::treeMenu);
    const auto choose = [this](const QModelIndex& index) {
        const QModelIndex first = index.siblingAtColumn(0);
        const int kind = first.data(SurveyTreeModel::KindRole).toInt();
        if (kind != SurveyTreeModel::RunItem && kind != SurveyTreeModel::MarkItem) return;
        session_.selection().selectItem(first.data(SurveyTreeModel::IdRole).toString());
    };
    connect(tree_, &QTreeView::clicked, this, choose);
    // A click, or the enter key: passing over a result by arrow keys must not turn the views over.
    const auto show = [this](const QModelIndex& index) {
        const QModelIndex first = index.siblingAtColumn(0);
        if (first.data(SurveyTreeModel::KindRole).toInt() == SurveyTreeModel::ResultItem)
            showResult(first.data(SurveyTreeModel::IdRole).toString());
    };
    connect(tree_, &QTreeView::clicked, this, show);
    connect(tree_, &QTreeView::activated, this, show);
    // The tree follows what is selected elsewhere, a stretch of a run perhaps: that is no choice of the run.
    connect(tree_->selectionModel(), &QItemSelectionModel::currentChanged, this,
            [this, choose](const QModelIndex& index) {
                const QVariant id = index.siblingAtColumn(0).data(SurveyTreeModel::IdRole);
                if (id.toString() != session_.selection().item()) choose(index);
            });
    connect(&tree_model_, &SurveyTreeModel::visibilityChanged, this,
            [this](int kind, const QString& id, bool visible) {
                ViewState& state = session_.viewState();
                if (kind == SurveyTreeModel::RunItem) state.setRunVisible(id, visible);
                if (kind == SurveyTreeModel::MarkItem) state.setMarkVisible(id, visible);
                if (kind == SurveyTreeModel::EdgesItem) state.setShown(&ViewChoice::edges, visible);
            });
    steps_ = new StepsPanel(session_);
    steps_->setMinimumWidth(296);
    connect(steps_, &StepsPanel::openAsked, this, &MainWindow::askForSurvey);
    connect(steps_, &StepsPanel::exportAsked, this, &MainWindow::askForExport);
    connect(steps_, &StepsPanel::commandAsked, this, &MainWindow::copyCommand);
    connect(steps_, &StepsPanel::accuracyAsked, this, [this] { views_->setCurrentWidget(accuracy_); });
    connect(steps_, &StepsPanel::runsAsked, this, &MainWindow::showRuns);
    connect(steps_, &StepsPanel::settingsAsked, this, &MainWindow::showSettings);
    place_ = new PlacePanel;
    messages_ = new QListView;
    messages_->setObjectName("messages");
    messages_->setModel(&message_model_);
    messages_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    messages_->setIconSize({16, 16});
    messages_->setUniformItemSizes(true);
    messages_->setTextElideMode(Qt::ElideRight);
    messages_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    messages_->setFrameShape(QFrame::NoFrame);
    messages_->setAccessibleName(tr("Messages"));
    auto* tree_dock = addDock(Qt::LeftDockWidgetArea, "dock_survey", tr("Survey"), tree_);
    auto* place_dock = addDock(Qt::LeftDockWidgetArea, "dock_place", tr("Place"), place_);
    auto* steps_dock = addDock(Qt::RightDockWidgetArea, "dock_steps", tr("Steps"), steps_);
    profile_ = new PlotCanvas;
    profile_->setObjectName("profile_plot");
    profile_->setMinimumHeight(160);
    profile_dock_ = addDock(Qt::BottomDockWidgetArea, "dock_profile", tr("Profile"), profile_);
    message_dock_ = addDock(Qt::BottomDockWidgetArea, "dock_messages", tr("Messages"), messages_);
    // Both want the whole width.
    tabifyDockWidget(message_dock_, profile_dock_);
    profile_dock_->hide();
    // A profile needs more height than messages, which get back what they had.
    connect(profile_dock_->toggleViewAction(), &QAction::toggled, message_dock_, [this](bool shown) {
        if (!shown && messages_height_px_ > 0)
            resizeDocks({message_dock_}, {messages_height_px_}, Qt::Vertical);
    });
    resizeDocks({tree_dock, steps_dock}, {288, 328}, Qt::Horizontal);
    resizeDocks({tree_dock, place_dock}, {340, 340}, Qt::Vertical);
    resizeDocks({message_dock_}, {120}, Qt::Vertical);
    readout_ = new QLabel;
    readout_->setObjectName("readout");
    state_ = new QLabel;
    state_->setObjectName("quiet");
    state_->setContentsMargins(0, 0, kGrid_px, 0);
    crs_ = new QLabel;
    crs_->setObjectName("crs");
    statusBar()->addPermanentWidget(readout_);
    statusBar()->addPermanentWidget(crs_);
    statusBar()->addPermanentWidget(state_);
    statusBar()->setSizeGripEnabled(false);
}

QAction* MainWindow::addAction(QMenu& menu, const QString& name, const QString& icon_name,
                               const QString& words, const QKeySequence& key,
                               const std::function<void()>& run) {
    QAction* action = menu.addAction(words);
    action->setObjectName(name);
    action->setProperty(kIconName, icon_name);
    action->setShortcut(key);
    connect(action, &QAction::triggered, this, run);
    actions_[name] = action;
    return action;
}

void MainWindow::explain() {
    const std::pair<QWidget*, QString> parts[] = {
        {start_, tr("Where to begin: a survey that is there, a new one from loose files, or a sample.")},
        {&map_->view(), tr("The map. Drag moves it, the wheel zooms about the cursor, a click tells what is "
                           "there. The tools "
                           "above measure, select and draw; Escape leaves them.")},
        {terrain_,
         tr("The surface in three dimensions. Drag turns it, a right drag moves it, the wheel comes "
            "nearer; a click tells what is known of a place.")},
        {plots_, tr("Plots of the sensors, the fused runs, errors at marks and searches for parameters. Drag "
                    "along the time axis selects a stretch in all views.")},
        {accuracy_, tr("How far the results lie from the marks: figures, groups of errors, what they say and "
                       "what they cannot say.")},
        {report_, tr("The report as it will be printed; save it as PDF or print it here.")},
        {tree_,
         tr("Runs, marks, edits and results. The box shows or hides a thing in all views; a click on a "
            "result shows it; the right button leaves a run or a mark out, or takes an edit back.")},
        {place_,
         tr("What is known of the place that was clicked: its height, where the error comes from, the "
            "nearest hits, and what another pass would give.")},
        {steps_,
         tr("The way from logs to a DEM, from above to below. Each step shows its important settings; "
            "the others unfold.")},
        {profile_,
         tr("Heights along the line that was drawn on the map, with their 95 % band and marks beside "
            "it.")},
        {messages_, tr("What the program did and what went wrong, with the cure. Newest below.")}};
    for (const auto& [widget, words] : parts) widget->setWhatsThis(words);
    for (QDockWidget* dock : docks_) {
        dock->setWhatsThis(dock->widget()->whatsThis());
        dock->toggleViewAction()->setWhatsThis(dock->whatsThis());
    }
}

void MainWindow::explainActions() {
    const std::pair<const char*, QString> tips[] = {
        {"open", tr("Opens a survey.json, or the folder that holds one")},
        {"new", tr("Makes a survey from array logs and a table of marks")},
        {"start_page", tr("Samples and the surveys of the last days")},
        {"save",
         tr("Writes the settings and edits beside the survey, for this program and the command line")},
        {"save_settings_as", tr("Writes the settings and edits into any file, for other surveys")},
        {"load_settings", tr("Takes the settings of a file over; undo brings yours back")},
        {"process", tr("Fuses, cleans, makes the surface and checks it")},
        {"cancel", tr("Stops what is running; what was there before stays")},
        {"runs", tr("Figures and settings of the last runs, and the way back to one")},
        {"tune", tr("Searches noise parameters that make errors at control marks small")},
        {"export", tr("Writes DEM, mesh, tracks and report into a folder")},
        {"command", tr("Puts the command line that makes the same files on the clipboard")},
        {"quit", tr("Closes the window; changes that are not saved come back next time")},
        {"undo", tr("Takes the last change of settings or edits back")},
        {"redo", tr("Makes the change again that was taken back")},
        {"exclude", tr("Leaves the selected stretch, run or mark out; the logs stay as they are")},
        {"settings", tr("Every setting with its meaning, in groups and with a search")},
        {"theme", tr("Light colours on dark, or dark ones on light")},
        {"language", tr("The window in Chinese or in English")},
        {"shortcuts", tr("All keys in one table")},
        {"whats_this", tr("Click a part of the window then, and it explains itself")},
        {"about", tr("Version and licence")}};
    const auto explain = [](QAction& action, const QString& tip) {
        action.setStatusTip(tip);
        action.setWhatsThis(tip);
    };
    for (const auto& [name, tip] : tips) explain(*actions_.at(name), tip);
    for (int tab = 0; tab < views_->count(); ++tab)
        explain(*actions_.at(QString("view_%1").arg(tab)), tr("Shows the view %1").arg(views_->tabText(tab)));
    for (QDockWidget* dock : docks_)
        dock->toggleViewAction()->setStatusTip(tr("Shows or hides the panel %1").arg(dock->windowTitle()));
}

void MainWindow::buildActions() {
    buildFileMenu();
    buildEditMenu();
    buildViewMenu();
    buildHelpMenu();
    explain();
    explainActions();
    themeIcons();
}

void MainWindow::buildFileMenu() {
    QMenu& menu = *menuBar()->addMenu(tr("&Survey"));
    addAction(menu, "open", "open", tr("&Open…"), QKeySequence::Open, [this] { askForSurvey(); });
    addAction(menu, "new", "new", tr("&New from files…"), QKeySequence::New, [this] { newSurvey(); });
    QMenu* recent = menu.addMenu(tr("Open &recent"));
    recent->setObjectName("recent");
    connect(recent, &QMenu::aboutToShow, this, [this, recent] {
        recent->clear();
        for (const QString& path : recentSurveys()) {
            connect(recent->addAction(path), &QAction::triggered, this, [this, path] { open(path); });
        }
        if (recent->isEmpty()) recent->addAction(tr("None yet"))->setEnabled(false);
    });
    addAction(menu, "start_page", "map", tr("&Start page"), {}, [this] {
        start_->refresh();
        showPage(start_);
    });
    menu.addSeparator();
    addAction(menu, "save", "save", tr("&Save settings"), QKeySequence::Save, [this] { session_.save(); });
    addAction(menu, "save_settings_as", "save", tr("Save settings &as…"), QKeySequence::SaveAs,
              [this] { saveSettingsAs(); });
    addAction(menu, "load_settings", "settings", tr("&Load settings…"), {}, [this] {
        const QString file = questions.settings_file(tr("Load settings"), lastFolder());
        if (file.isEmpty()) return;
        rememberFolder(file);
        session_.loadSettings(file.toStdString());
    });
    menu.addSeparator();
    addAction(menu, "process", "process", tr("&Process"), QKeySequence(Qt::Key_F5),
              [this] { session_.process(); });
    addAction(menu, "cancel", "stop", tr("&Cancel"), QKeySequence(Qt::CTRL | Qt::Key_Period),
              [this] { session_.cancel(); });
    addAction(menu, "runs", "history", tr("Earlier &runs…"), QKeySequence("Ctrl+H"), [this] { showRuns(); });
    addAction(menu, "tune", "tune", tr("&Tune on the marks"), {}, [this] { steps_->tune(); });
    menu.addSeparator();
    addAction(menu, "export", "export", tr("&Export…"), QKeySequence("Ctrl+E"), [this] { askForExport(); });
    addAction(menu, "command", "copy", tr("Copy as co&mmand"), QKeySequence("Ctrl+Shift+C"),
              [this] { copyCommand(); });
    menu.addSeparator();
    addAction(menu, "quit", "", tr("&Quit"), QKeySequence::Quit, [this] { close(); });
}

void MainWindow::buildEditMenu() {
    QMenu& menu = *menuBar()->addMenu(tr("&Edit"));
    QUndoStack& stack = session_.undoStack();
    for (const bool undo : {true, false}) {
        const QString name = undo ? tr("&Undo") : tr("&Redo");
        QAction* action = undo ? stack.createUndoAction(this, name) : stack.createRedoAction(this, name);
        action->setProperty(kPlainMeaning, name);  // its text also tells what would be undone
        action->setObjectName(undo ? "undo" : "redo");
        action->setProperty(kIconName, undo ? "undo" : "redo");
        action->setShortcut(undo ? QKeySequence::Undo : QKeySequence::Redo);
        menu.addAction(action);
        actions_[action->objectName()] = action;
    }
    menu.addSeparator();
    addAction(menu, "exclude", "exclude", tr("E&xclude what is selected"), QKeySequence(Qt::Key_Delete),
              [this] { excludeSelected(); });
    QMenu* only = menu.addMenu(tr("Exclude &only"));
    const std::pair<EditedSensor, QString> sensors[] = {{EditedSensor::Range, tr("range (no ground points)")},
                                                        {EditedSensor::Gnss, tr("GNSS")},
                                                        {EditedSensor::Barometer, tr("barometer")},
                                                        {EditedSensor::Flow, tr("optical flow")},
                                                        {EditedSensor::Attitude, tr("attitude")}};
    for (const auto& [sensor, words] : sensors) {
        QAction* action = only->addAction(words);
        action->setStatusTip(tr("Leaves these readings of the selected stretch out, and keeps the others"));
        connect(action, &QAction::triggered, this,
                [this, one = sensor] { excludeStretches(session_.selection().stretches(), one); });
    }
    connect(only, &QMenu::aboutToShow, this, [this, only] {
        for (QAction* action : only->actions()) action->setEnabled(!session_.selection().stretches().empty());
    });
    menu.addSeparator();
    addAction(menu, "settings", "settings", tr("All se&ttings…"), QKeySequence("Ctrl+,"),
              [this] { showSettings(StepKind::Fuse); });
    menu.addSeparator();
    menu.addActions(map_->toolActions());
}

void MainWindow::buildViewMenu() {
    QMenu& menu = *menuBar()->addMenu(tr("&View"));
    for (int tab = 0; tab < views_->count(); ++tab) {
        addAction(menu, QString("view_%1").arg(tab), "", views_->tabText(tab),
                  QKeySequence(QString("Ctrl+%1").arg(tab + 1)),
                  [this, tab] { views_->setCurrentIndex(tab); });
    }
    menu.addSeparator();
    menu.addMenu(new ShowMenu(session_.viewState(), &menu));
    buildCompareMenu(*menu.addMenu(tr("Co&mpare with")));
    menu.addSeparator();
    for (QDockWidget* dock : docks_) menu.addAction(dock->toggleViewAction());
    menu.addSeparator();
    addAction(menu, "theme", "theme", tr("&Dark or light"), QKeySequence("Ctrl+Shift+D"),
              [this] { setTheme(currentTheme() == Theme::Light ? Theme::Dark : Theme::Light); });
    addAction(menu, "language", "language", tr("中文 / English"), {}, [this] {
        const bool chinese = preferredLanguage().startsWith("zh");
        Q_EMIT languageAsked(chinese ? "en" : "zh_CN");
    });
    buildFiguresMenu(*menu.addMenu(tr("&Units and numbers")));
}

void MainWindow::buildFiguresMenu(QMenu& menu) {
    menu.menuAction()->setStatusTip(
        tr("How lengths and numbers are written in the window; files and reports stay in metres"));
    const FigureStyle now = figureStyle();
    const auto add = [&](QActionGroup* group, const char* name, const QString& words, FigureStyle style) {
        QAction* action = group->addAction(menu.addAction(words));
        action->setObjectName(name);
        action->setCheckable(true);
        action->setChecked(style == now);
        action->setStatusTip(menu.menuAction()->statusTip());
        connect(action, &QAction::triggered, this, [this, style] { Q_EMIT figureStyleAsked(style); });
    };
    auto* units = new QActionGroup(this);
    add(units, "unit_m", tr("Metres"), {LengthUnit::Metre, now.numbers});
    add(units, "unit_ft", tr("Feet (0.3048 m)"), {LengthUnit::Foot, now.numbers});
    add(units, "unit_us_ft", tr("US survey feet"), {LengthUnit::UsSurveyFoot, now.numbers});
    menu.addSeparator();
    auto* numbers = new QActionGroup(this);
    add(numbers, "numbers_plain", QString("1234.56"), {now.unit, NumberStyle::Plain});
    add(numbers, "numbers_grouped", QString::fromUtf8("1\u2009234.56"), {now.unit, NumberStyle::Grouped});
    add(numbers, "numbers_comma", QString::fromUtf8("1\u2009234,56"), {now.unit, NumberStyle::Comma});
}

void MainWindow::buildCompareMenu(QMenu& menu) {
    menu.setObjectName("compare");
    menu.menuAction()->setStatusTip(tr("Shows how the heights changed, as a layer of map and 3-D view"));
    connect(&menu, &QMenu::aboutToShow, this, [this, &menu] { fillCompareMenu(menu); });
    fillCompareMenu(menu);
}

void MainWindow::fillCompareMenu(QMenu& menu) {
    menu.clear();
    const bool ready = session_.products() && !session_.busy();
    const auto& runs = session_.history();
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (i == session_.shownRun()) continue;
        QAction* action = menu.addAction(tr("The run of %1").arg(timeOfRun(runs[i].when)));
        action->setEnabled(ready);
        action->setStatusTip(tr("Shows how the heights changed since that run"));
        connect(action, &QAction::triggered, this, [this, i] { session_.compareWith(i); });
    }
    if (menu.isEmpty()) menu.addAction(tr("No other run yet"))->setEnabled(false);
    menu.addSeparator();
    QAction* dem = menu.addAction(tr("Another DEM…"));
    dem->setObjectName("compare_dem");
    dem->setStatusTip(tr("Shows how the heights differ from those of a file"));
    dem->setEnabled(ready);
    connect(dem, &QAction::triggered, this, [this] {
        const QString file = questions.dem(tr("Earlier heights of the same ground"), lastFolder());
        if (file.isEmpty()) return;
        rememberFolder(file);
        session_.compareWith(std::filesystem::path(file.toStdString()));
    });
    QAction* nothing = menu.addAction(tr("Nothing"));
    nothing->setStatusTip(tr("Takes the layer of changes away"));
    nothing->setEnabled(session_.viewState().now().change != nullptr);
    connect(nothing, &QAction::triggered, this, [this] { session_.compareWithNothing(); });
}

void MainWindow::saveSettingsAs() {
    const QString file = questions.settings_target(tr("Save settings as"), lastFolder());
    if (file.isEmpty()) return;
    rememberFolder(file);
    session_.saveSettingsAs(file.toStdString());
}

void MainWindow::buildHelpMenu() {
    QMenu& menu = *menuBar()->addMenu(tr("&Help"));
    addAction(menu, "shortcuts", "help", tr("&Keys"), QKeySequence("F1"), [this] { showShortcuts(); });
    addAction(menu, "whats_this", "help", tr("&What is this?"), QKeySequence::WhatsThis,
              [] { QWhatsThis::enterWhatsThisMode(); });
    addAction(menu, "about", "info", tr("&About Terrawalk"), {}, [this] { showAbout(); });
}

void MainWindow::connectSession() {
    fill_timer_.setSingleShot(true);
    connect(&fill_timer_, &QTimer::timeout, this, &MainWindow::fillNext);
    connect(&session_, &SurveySession::surveyChanged, this, &MainWindow::showSurvey);
    connect(&session_, &SurveySession::productsChanged, this, &MainWindow::showProducts);
    connect(&session_, &SurveySession::tuningChanged, this, [this] { plots_->setTuning(session_.tuning()); });
    connect(&session_, &SurveySession::told, this, &MainWindow::say);
    connect(&session_, &SurveySession::savedChanged, this, &MainWindow::showTitle);
    connect(&session_, &SurveySession::settingsChanged, this, [this] {
        session_.viewState().setEdits(session_.edits());
        showTree();
        enableActions();
    });
    connect(&session_.job(), &BackgroundJob::runningChanged, this, &MainWindow::enableActions);
    connect(&session_.selection(), &Selection::changed, this, [this] {
        followSelection();
        enableActions();
    });
    connect(&session_.undoStack(), &QUndoStack::cleanChanged, this, &MainWindow::enableActions);
    connect(&session_, &SurveySession::exported, this, [this](const QString&) { enableActions(); });
    enableActions();
    showTitle();
}

void MainWindow::enableActions() {
    const bool busy = session_.busy(), open = session_.survey() != nullptr,
               made = session_.products() != nullptr;
    const std::pair<const char*, bool> states[] = {{"open", !busy},
                                                   {"new", !busy},
                                                   {"save", open},
                                                   {"save_settings_as", open},
                                                   {"load_settings", open && !busy},
                                                   {"process", open && !busy},
                                                   {"tune", open && !busy},
                                                   {"runs", !session_.runs().empty()},
                                                   {"cancel", busy},
                                                   {"export", made && !busy},
                                                   {"command", open},
                                                   {"settings", open},
                                                   {"exclude", !session_.selection().empty()}};
    for (const auto& [name, enabled] : states) actions_.at(name)->setEnabled(enabled);
    state_->setText(!open                 ? QString()
                    : busy                ? tr("working")
                    : !made               ? tr("not processed")
                    : session_.outdated() ? tr("settings changed: process again")
                                          : tr("up to date"));
}

void MainWindow::open(const QString& path, bool then_process) {
    if (session_.busy()) {
        say(MessageKind::Warning, tr("Cancel what is running first."));
        return;
    }
    session_.open(path.toStdString(), then_process);
}

void MainWindow::askForSurvey() {
    const QString file = questions.survey(tr("Open a survey"), lastFolder());
    if (file.isEmpty()) return;
    rememberFolder(file);
    open(file);
}

void MainWindow::newSurvey(const QStringList& files) {
    auto* dialog = new NewSurveyDialog(this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &NewSurveyDialog::created, this, [this](const QString& survey) { open(survey); });
    dialog->open();
    dialog->addFiles(files);
}

void MainWindow::askForExport() {
    if (!session_.products()) return;
    auto* dialog = new ExportDialog(session_, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void MainWindow::copyCommand() {
    QGuiApplication::clipboard()->setText(session_.commandLine("out"));
    say(MessageKind::Info, tr("Copied: %1").arg(session_.commandLine("out")));
    if (session_.settings().tuned() && session_.modified()) {
        say(MessageKind::Warning, tr("Tuned values travel in a file: save the settings, then copy again."));
    }
}

void MainWindow::showPage(QWidget* page) {
    pages_->setCurrentWidget(page);
    if (page == start_ && layout_.isEmpty()) {
        layout_ = saveState(kLayoutVersion);
        for (QDockWidget* dock : docks_) dock->hide();
    } else if (page != start_ && !layout_.isEmpty()) {
        restoreState(std::exchange(layout_, {}), kLayoutVersion);
    }
}

void MainWindow::showSurvey() {
    const auto survey = session_.survey();
    showPage(survey ? static_cast<QWidget*>(views_) : start_);
    if (survey) {
        rememberSurvey(text(session_.path().string()));
        views_->setCurrentWidget(map_);
        session_.viewState().setEdits(session_.edits());
    }
    place_->clear();
    showTitle();
}

void MainWindow::showProducts() {
    const auto products = session_.products();
    QList<RasterLayer> layers{RasterLayer::None};
    for (const auto& [layer, name] : layerNames()) {
        if (products && hasLayer(*products, layer)) layers << layer;
    }
    session_.viewState().setAvailable(layers);
    map_->show(session_.map(), session_.products());
    crs_->setText(session_.map() ? text(session_.map()->crs) : QString());
    crs_->setToolTip(session_.map() ? text(session_.map()->height_reference) : QString());
    fillInTurns({[this] { terrain_->show(session_.shownSurvey(), session_.map(), session_.products()); },
                 [this] { plots_->show(session_.shownSurvey(), session_.map(), session_.products()); },
                 [this] { accuracy_->show(session_.products()); },
                 [this] {
                     report_->show(session_.shownSurvey(), session_.products());
                 }});
    place_->clear();
    showTree();
    enableActions();
}

void MainWindow::fillInTurns(std::deque<std::function<void()>> views) {
    views_to_fill_ = std::move(views);
    fill_timer_.start();
}

void MainWindow::fillNext() {
    if (views_to_fill_.empty()) return;
    const auto fill = std::move(views_to_fill_.front());
    views_to_fill_.pop_front();
    fill();
    if (!views_to_fill_.empty()) fill_timer_.start();
}

void MainWindow::showTree() {
    const auto survey = session_.survey();
    if (!survey) return;
    tree_model_.show(*survey, *session_.map(), session_.products().get(), session_.edits(),
                     session_.viewState().now());
    tree_->expandAll();
    tree_->header()->setStretchLastSection(false);
    tree_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    tree_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
}

void MainWindow::followSelection() {
    const QString item = session_.selection().item();
    if (item.isEmpty()) return tree_->clearSelection();
    const auto found = tree_model_.match(tree_model_.index(0, 0), SurveyTreeModel::IdRole, item, 1,
                                         Qt::MatchExactly | Qt::MatchRecursive);
    if (found.isEmpty()) return;
    tree_->setCurrentIndex(found.front());
    tree_->scrollTo(found.front());
}

void MainWindow::showTitle() {
    const auto survey = session_.survey();
    setWindowTitle(survey ? tr("%1[*] – Terrawalk").arg(text(survey->name)) : tr("Terrawalk"));
    setWindowModified(session_.modified());
    enableActions();
}

void MainWindow::askPlace(QPointF map_m) {
    const auto products = session_.products();
    if (!products) return;
    const auto& run = session_.history()[session_.shownRun()];
    place_->show(placeReport(*run.survey, *products, *run.map, {map_m.x(), map_m.y()}));
}

void MainWindow::takeLine(MapTool tool, const QPolygonF& vertices_m) {
    if (tool == MapTool::Measure) {
        say(MessageKind::Info, measureText(vertices_m, true));
        return;
    }
    if (tool == MapTool::Profile) {
        showProfile(vertices_m);
        return;
    }
    Breakline line{{}, kindOf(tool), {}};
    for (const QPointF& v : vertices_m) line.vertices_m.emplace_back(v.x(), v.y(), kMissing);
    SurveyEdits edits = session_.edits();
    edits.lines.push_back(std::move(line));
    session_.changeEdits(edits, tr("draw a line"));
    say(MessageKind::Info, tr("Line drawn: process again, and the surface keeps to it."));
}

void MainWindow::excludeStretches(std::vector<TrackStretch> stretches, EditedSensor sensor) {
    if (stretches.empty()) return;
    SurveyEdits edits = session_.edits();
    for (const TrackStretch& s : stretches)
        edits.stretches.push_back({nameOf(s.run), s.from_s, s.to_s, sensor});
    session_.changeEdits(edits, tr("exclude %n stretches", nullptr, static_cast<int>(stretches.size())));
    session_.selection().clear();
    if (stretches.size() > 1) {
        double sum_s = 0.0;
        for (const TrackStretch& s : stretches) sum_s += s.to_s - s.from_s;
        return say(MessageKind::Info,
                   tr("%1 stretches, %2 s in all, are left out: process again to see what it changes.")
                       .arg(stretches.size())
                       .arg(sum_s, 0, 'f', 1));
    }
    const TrackStretch& stretch = stretches.front();
    say(MessageKind::Info, tr("%1 is left out from %2 to %3 s: process again to see what it changes.")
                               .arg(stretch.run, number(stretch.from_s, 1), number(stretch.to_s, 1)));
}

void MainWindow::leaveOut(int kind, const QString& id, bool out) {
    SurveyEdits edits = session_.edits();
    auto& names = kind == SurveyTreeModel::RunItem ? edits.runs : edits.marks;
    std::erase(names, nameOf(id));
    if (out) names.push_back(nameOf(id));
    session_.changeEdits(edits, out ? tr("leave out %1").arg(id) : tr("take %1 back in").arg(id));
}

void MainWindow::excludeSelected() {
    const Selection& selection = session_.selection();
    if (!selection.stretches().empty()) return excludeStretches(selection.stretches(), EditedSensor::All);
    const auto survey = session_.survey();
    if (!survey || selection.item().isEmpty()) return;
    const bool run = std::any_of(survey->runs.begin(), survey->runs.end(),
                                 [&](const Run& r) { return text(r.id) == selection.item(); });
    leaveOut(run ? SurveyTreeModel::RunItem : SurveyTreeModel::MarkItem, selection.item(), true);
}

void MainWindow::showResult(const QString& id) {
    const std::pair<const char*, QWidget*> views[] = {
        {"mesh", terrain_}, {"accuracy", accuracy_}, {"report", report_}};
    for (const auto& [name, view] : views) {
        if (id == name) return views_->setCurrentWidget(view);
    }
    const std::pair<const char*, RasterLayer> layers[] = {{"dem", RasterLayer::Height},
                                                          {"uncertainty", RasterLayer::Uncertainty},
                                                          {"density", RasterLayer::Density},
                                                          {"source", RasterLayer::Source}};
    for (const auto& [name, layer] : layers) {
        if (id != name || !session_.viewState().available(layer)) continue;
        session_.viewState().setLayer(layer);
        views_->setCurrentWidget(map_);
    }
}

void MainWindow::treeMenu(const QPoint& at) {
    const QModelIndex index = tree_->indexAt(at).siblingAtColumn(0);
    if (!index.isValid()) return;
    const int kind = index.data(SurveyTreeModel::KindRole).toInt();
    const QString id = index.data(SurveyTreeModel::IdRole).toString();
    QMenu menu;
    const SurveyEdits edits = session_.edits();
    if (kind == SurveyTreeModel::RunItem || kind == SurveyTreeModel::MarkItem) {
        const auto& names = kind == SurveyTreeModel::RunItem ? edits.runs : edits.marks;
        const bool out = std::find(names.begin(), names.end(), nameOf(id)) != names.end();
        connect(menu.addAction(out ? tr("Take back in") : tr("Leave out")), &QAction::triggered, this,
                [this, kind, id, out] { leaveOut(kind, id, !out); });
    } else if (kind == SurveyTreeModel::StretchItem || kind == SurveyTreeModel::LineItem) {
        connect(menu.addAction(tr("Take back")), &QAction::triggered, this, [this, kind, row = id.toUInt()] {
            SurveyEdits changed = session_.edits();
            if (kind == SurveyTreeModel::StretchItem && row < changed.stretches.size()) {
                changed.stretches.erase(changed.stretches.begin() + static_cast<std::ptrdiff_t>(row));
            } else if (kind == SurveyTreeModel::LineItem && row < changed.lines.size()) {
                changed.lines.erase(changed.lines.begin() + static_cast<std::ptrdiff_t>(row));
            }
            session_.changeEdits(changed, tr("take back an edit"));
        });
    }
    if (!menu.isEmpty()) menu.exec(tree_->viewport()->mapToGlobal(at));
}

void MainWindow::showProfile(const QPolygonF& line_m) {
    const auto products = session_.products();
    if (!products) {
        say(MessageKind::Info, tr("Process the survey first: a profile needs a surface."));
        return;
    }
    profile_->show(profilePlot(*products, *session_.map(), line_m));
    if (!profile_dock_->isVisible()) messages_height_px_ = message_dock_->height();
    profile_dock_->show();
    profile_dock_->raise();
}

void MainWindow::showSettings(StepKind step) {
    if (settings_ == nullptr) settings_ = new SettingsDialog(session_, this);
    settings_->openAt(step);
}

void MainWindow::showRuns() {
    auto* dialog = new RunsDialog(session_, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void MainWindow::showShortcuts() {
    auto* dialog = new ShortcutsDialog(actions_, map_->toolActions(), this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void MainWindow::showAbout() {
    auto* box = new QMessageBox(this);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setObjectName("about_box");
    box->setWindowTitle(tr("About Terrawalk"));
    box->setIconPixmap(icon("terrawalk").pixmap(64, 64));
    box->setText(
        tr("<h3>Terrawalk %1</h3><p>From a walk with the sensor array to a terrain model that you can sign "
           "for."
           "</p><p>Free software, see LICENSE. Built with Eigen, CGAL, PCL, GDAL, PROJ, OctoMap and Qt.</p>")
            .arg(text(versionNumber())));
    box->open();
}

void MainWindow::say(MessageKind kind, const QString& words) {
    message_model_.add(kind, words);
    messages_->scrollToBottom();
    if (kind == MessageKind::Error) {
        for (QDockWidget* dock : docks_) {
            if (dock->objectName() == "dock_messages") dock->show();
        }
    }
    statusBar()->showMessage(words, 8000);
}

void MainWindow::setTheme(Theme theme) {
    applyTheme(theme);
    QSettings().setValue("theme", theme == Theme::Dark ? "dark" : "light");
    themeIcons();
    map_->themeChanged();
    terrain_->themeChanged();
    plots_->themeChanged();
    profile_->themeChanged();
    report_->themeChanged();
    message_model_.themeChanged();
    steps_->themeChanged();
    if (settings_ != nullptr) settings_->themeChanged();
    accuracy_->show(session_.products());
    showTree();
}

void MainWindow::themeIcons() {
    for (const auto& [name, action] : actions_) {
        const QString icon_name = action->property(kIconName).toString();
        if (!icon_name.isEmpty()) action->setIcon(icon(icon_name));
    }
    // Qt's own buttons for what a tool bar has no room for.
    for (auto* more : findChildren<QToolButton*>("qt_toolbar_ext_button")) more->setIcon(icon("more"));
    const std::pair<int, const char*> tabs[] = {{views_->indexOf(map_), "map"},
                                                {views_->indexOf(terrain_), "terrain_3d"},
                                                {views_->indexOf(plots_), "plots"},
                                                {views_->indexOf(accuracy_), "accuracy"},
                                                {views_->indexOf(report_), "report"}};
    for (const auto& [tab, name] : tabs) views_->setTabIcon(tab, icon(name));
}

void MainWindow::keepLayout() {
    QSettings settings;
    settings.setValue("window/geometry", saveGeometry());
    settings.setValue("window/layout", layout_.isEmpty() ? saveState(kLayoutVersion) : layout_);
}

void MainWindow::closeEvent(QCloseEvent* event) {
    keepLayout();
    session_.keepChanges();
    session_.cancel();
    event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    const QList<QUrl> urls = event->mimeData()->urls();
    if (std::any_of(urls.begin(), urls.end(), [](const QUrl& url) { return url.isLocalFile(); }))
        event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    QStringList paths;
    for (const QUrl& url : event->mimeData()->urls()) {
        if (url.isLocalFile()) paths << url.toLocalFile();
    }
    if (!paths.isEmpty()) takeDropped(paths);
}

void MainWindow::takeDropped(const QStringList& paths) {
    if (session_.busy()) return say(MessageKind::Warning, tr("Cancel what is running first."));
    if (areLooseFiles(paths)) return newSurvey(paths);
    const auto survey = std::find_if(paths.begin(), paths.end(), [](const QString& path) {
        return kindOfDropped(path) == Dropped::Survey;
    });
    const QString& path = survey == paths.end() ? paths.front() : *survey;
    if (paths.size() > 1)
        say(MessageKind::Info, tr("One at a time: of what was dropped, %1 is taken.").arg(path));
    switch (kindOfDropped(path)) {
        case Dropped::Survey:
            return open(path);
        case Dropped::Settings:
            if (!session_.survey())
                return say(MessageKind::Warning, tr("Open a survey first: these are settings for one."));
            return session_.loadSettings(path.toStdString());
        case Dropped::Dem:
            if (!session_.products())
                return say(MessageKind::Warning,
                           tr("Process a survey first: its heights are compared with those of this DEM."));
            return session_.compareWith(std::filesystem::path(path.toStdString()));
        case Dropped::Unknown:
            return say(MessageKind::Error,
                       tr("%1: this cannot be opened; drop a survey.json or its folder, logs "
                          "and marks (.csv), settings (.json) or a DEM (.tif)")
                           .arg(path));
    }
}

}  // namespace terrawalk::gui
