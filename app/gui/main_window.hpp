#pragma once

#include <QMainWindow>
#include <QTimer>
#include <deque>
#include <functional>

#include "app/gui/figures.hpp"
#include "app/gui/map_view.hpp"
#include "app/gui/message_model.hpp"
#include "app/gui/steps.hpp"
#include "app/gui/survey_session.hpp"
#include "app/gui/survey_tree_model.hpp"
#include "app/gui/theme.hpp"

class QDockWidget;
class QLabel;
class QListView;
class QMenu;
class QStackedWidget;
class QTabWidget;
class QTreeView;

namespace terrawalk::gui {

class AccuracyPanel;
class MapPanel;
class PlacePanel;
class PlotCanvas;
class PlotsView;
class TerrainView;
class ReportView;
class SettingsDialog;
class StartPage;
class StepsPanel;

/// The window: survey tree at the left, views in the middle, steps at the right, messages below.
class MainWindow : public QMainWindow {
    Q_OBJECT
  public:
    /// Both must outlive the window.
    MainWindow(SurveySession& session, MessageModel& messages, QWidget* parent = nullptr);
    ~MainWindow() override;

    [[nodiscard]] SurveySession& session() { return session_; }
    [[nodiscard]] MapView& map();
    /// Whether views still wait for their turn to show a result.
    [[nodiscard]] bool filling() const { return !views_to_fill_.empty(); }
    void open(const QString& path, bool then_process = false);
    /// Asks what survey the files make; see NewSurveyDialog.
    void newSurvey(const QStringList& files = {});
    void setTheme(Theme theme);
    /// Remembers where the window and its docks stand.
    void keepLayout();

    /// How a person is asked for a file or folder; a test answers in its place. Empty: cancelled.
    struct Questions {
        std::function<QString(const QString& title, const QString& folder)> survey;
        std::function<QString(const QString& title, const QString& folder)> settings_file;
        std::function<QString(const QString& title, const QString& folder)> settings_target;
        std::function<QString(const QString& title, const QString& folder)> dem;
        std::function<QString(const QString& title, const QString& folder)> searches;
    };
    Questions questions;

  Q_SIGNALS:
    void languageAsked(const QString& language);
    void figureStyleAsked(terrawalk::gui::FigureStyle style);

  protected:
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

  private:
    void buildDocks();
    void explain();
    void explainActions();
    void buildViews();
    void buildActions();
    void buildFileMenu();
    void buildEditMenu();
    void buildViewMenu();
    void buildFiguresMenu(QMenu& menu);
    void buildCompareMenu(QMenu& menu);
    void fillCompareMenu(QMenu& menu);
    void saveSettingsAs();
    void buildHelpMenu();
    QAction* addAction(QMenu& menu, const QString& name, const QString& icon_name, const QString& text,
                       const QKeySequence& key, const std::function<void()>& run);
    QDockWidget* addDock(Qt::DockWidgetArea area, const QString& name, const QString& title, QWidget* widget);
    void connectSession();
    /// Opens, reads or compares what files are taken for, one at a time but for logs and marks.
    void takeDropped(const QStringList& paths);
    void askForSurvey();
    void askForExport();
    void copyCommand();
    void showPage(QWidget* page);
    void showSurvey();
    void showProducts();
    /// Each in a turn of its own: together they would leave the window deaf for a tenth of a second.
    void fillInTurns(std::deque<std::function<void()>> views);
    void fillNext();
    void followSelection();
    void showTitle();
    void showTree();
    void enableActions();
    void askPlace(QPointF map_m);
    void takeLine(MapTool tool, const QPolygonF& vertices_m);
    /// By value: the selection, which it may come from, ends here.
    void excludeStretches(std::vector<TrackStretch> stretches, EditedSensor sensor);
    void excludeSelected();
    void leaveOut(int kind, const QString& id, bool out);
    void treeMenu(const QPoint& at);
    /// The view and layer of a result in the tree.
    void showResult(const QString& id);
    void showProfile(const QPolygonF& line_m);
    void showRuns();
    void showShortcuts();
    void showSettings(StepKind step);
    void showAbout();
    void themeIcons();
    void say(MessageKind kind, const QString& text);

    SurveySession& session_;
    MessageModel& message_model_;
    SurveyTreeModel tree_model_;
    QStackedWidget* pages_ = nullptr;
    StartPage* start_ = nullptr;
    QTabWidget* views_ = nullptr;
    MapPanel* map_ = nullptr;
    TerrainView* terrain_ = nullptr;
    PlotsView* plots_ = nullptr;
    PlotCanvas* profile_ = nullptr;
    QDockWidget* profile_dock_ = nullptr;
    QDockWidget* message_dock_ = nullptr;
    int messages_height_px_ = 0;  ///< before a profile was shown beside them
    AccuracyPanel* accuracy_ = nullptr;
    ReportView* report_ = nullptr;
    PlacePanel* place_ = nullptr;
    StepsPanel* steps_ = nullptr;
    SettingsDialog* settings_ = nullptr;  ///< made when it is first asked for
    QTreeView* tree_ = nullptr;
    QListView* messages_ = nullptr;
    QLabel* readout_ = nullptr;
    QLabel* crs_ = nullptr;
    QLabel* state_ = nullptr;
    QList<QDockWidget*> docks_;
    QByteArray layout_;  ///< of the docks, while the start page hides them
    std::map<QString, QAction*> actions_;
    std::deque<std::function<void()>> views_to_fill_;
    QTimer fill_timer_;
};

}  // namespace terrawalk::gui
