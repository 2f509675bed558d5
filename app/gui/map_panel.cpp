#include "app/gui/map_panel.hpp"

#include <QAction>
#include <QActionGroup>
#include <QComboBox>
#include <QStandardItemModel>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>

#include "app/gui/show_menu.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {
constexpr const char* kIconName = "icon_name";
}

MapPanel::MapPanel(ViewState& state, Selection& selection, QWidget* parent)
    : QWidget(parent), state_(state), view_(new MapView(state, selection)) {
    view_->setObjectName("map");
    bar_ = new QToolBar(tr("Map"));
    bar_->setObjectName("map_bar");
    bar_->setIconSize({18, 18});
    addLayers();
    addColourings();
    addTools();
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(bar_);
    layout->addWidget(view_, 1);
    connect(view_, &MapView::toolChanged, this, [this](MapTool tool) {
        for (QAction* action : tools_->actions()) {
            if (action->data().toInt() == static_cast<int>(tool)) action->setChecked(true);
        }
    });
    connect(&state_, &ViewState::changed, this, &MapPanel::followState);
    connect(&state_, &ViewState::availableChanged, this, &MapPanel::followState);
    followState();
    themeChanged();
}

void MapPanel::followState() {
    layers_->setCurrentIndex(layers_->findData(static_cast<int>(state_.now().layer)));
    colourings_->setCurrentIndex(colourings_->findData(static_cast<int>(state_.now().colouring)));
    auto* model = qobject_cast<QStandardItemModel*>(layers_->model());
    for (int row = 0; row < layers_->count(); ++row) {
        model->item(row)->setEnabled(
            state_.available(static_cast<RasterLayer>(layers_->itemData(row).toInt())));
    }
}

void MapPanel::addLayers() {
    layers_ = new QComboBox;
    layers_->setObjectName("layers");
    layers_->setAccessibleName(tr("Layer"));
    layers_->setToolTip(tr("What the ground is coloured by"));
    layers_->setWhatsThis(tr(
        "What the ground is coloured by, here and in the 3-D view: shaded heights; their standard error; how "
        "many points a square metre has; whether a height was measured, interpolated or extrapolated; and, "
        "once View > Compare with has something to compare, how the heights changed."));
    for (const auto& [layer, name] : layerNames()) layers_->addItem(name, static_cast<int>(layer));
    connect(layers_, &QComboBox::currentIndexChanged, this,
            [this] { state_.setLayer(static_cast<RasterLayer>(layers_->currentData().toInt())); });
    bar_->addWidget(layers_);
}

void MapPanel::addColourings() {
    colourings_ = new QComboBox;
    colourings_->setObjectName("colourings");
    colourings_->setAccessibleName(tr("Colour of the tracks"));
    colourings_->setToolTip(tr("What the tracks are coloured by"));
    colourings_->setWhatsThis(
        tr("What the tracks are coloured by: one colour for each run, the GNSS fix, speed, height, standard "
           "errors of the fused track, or by how many of them the worst reading was off."));
    for (const auto& [colouring, name] : colouringNames())
        colourings_->addItem(name, static_cast<int>(colouring));
    connect(colourings_, &QComboBox::currentIndexChanged, this,
            [this] { state_.setColouring(static_cast<TrackColouring>(colourings_->currentData().toInt())); });
    auto* gap = new QWidget;
    gap->setFixedWidth(kGrid_px);
    bar_->addWidget(gap);
    bar_->addWidget(colourings_);
    auto* shown = new QToolButton;
    shown->setObjectName("shown");
    shown->setText(tr("Show"));
    shown->setToolTip(tr("What is drawn on the ground, here and in the 3-D view"));
    shown->setWhatsThis(shown->toolTip());
    shown->setPopupMode(QToolButton::InstantPopup);
    shown->setMenu(new ShowMenu(state_, shown));
    bar_->addWidget(shown);
    bar_->addSeparator();
}

void MapPanel::addTool(MapTool tool, const QString& icon_name, const QString& text, const QString& tip,
                       const QKeySequence& key) {
    QAction* action = bar_->addAction(text);
    action->setObjectName("tool_" + icon_name);
    action->setProperty(kIconName, icon_name);
    action->setCheckable(true);
    action->setChecked(tool == MapTool::Pan);
    action->setData(static_cast<int>(tool));
    action->setShortcut(key);
    action->setToolTip(
        QString("<b>%1</b> (%2)<br>%3").arg(text, key.toString(QKeySequence::NativeText), tip));
    action->setStatusTip(tip);
    action->setWhatsThis(tip);
    tools_->addAction(action);
    connect(action, &QAction::triggered, this, [this, tool] {
        view_->setTool(tool);
        view_->setFocus();
    });
}

void MapPanel::addTools() {
    tools_ = new QActionGroup(this);
    addTool(MapTool::Pan, "pan", tr("Move and ask"), tr("Drag moves the map; a click tells what is there."),
            QKeySequence("V"));
    addTool(MapTool::SelectStretch, "select_stretch", tr("Select a stretch"),
            tr("Drag along a track, then exclude what was selected."), QKeySequence("S"));
    addTool(MapTool::SelectArea, "select_area", tr("Select an area"),
            tr("Drag a rectangle: all passes through it are selected, with Shift beside earlier ones."),
            QKeySequence("A"));
    addTool(MapTool::Measure, "measure", tr("Measure"),
            tr("Click points; length and area stand beside them. A double click ends it."),
            QKeySequence("M"));
    addTool(MapTool::Profile, "profile", tr("Profile"),
            tr("Click a line; a double click shows the heights along it."), QKeySequence("P"));
    addTool(MapTool::HardLine, "hard_line", tr("Draw a breakline"),
            tr("Click along an edge where the surface folds; a double click ends it."), QKeySequence("B"));
    addTool(MapTool::SoftLine, "soft_line", tr("Draw a soft breakline"),
            tr("Triangles keep to it, and the surface stays smooth across it."), QKeySequence("Shift+B"));
    addTool(MapTool::Boundary, "boundary", tr("Draw the boundary"), tr("Nothing outside it is ground."),
            QKeySequence("O"));
    addTool(MapTool::Hole, "hole", tr("Draw a hole"), tr("Nothing inside it is ground, e.g. a pond."),
            QKeySequence("H"));
    bar_->addSeparator();
    const auto add = [this](const QString& name, const QString& text, auto run) {
        QAction* action = bar_->addAction(text);
        action->setProperty(kIconName, name);
        action->setObjectName(name);
        action->setWhatsThis(text);
        connect(action, &QAction::triggered, view_, run);
    };
    add("fit", tr("Show all (Home)"), [this] { view_->fit(); });
}

QList<QAction*> MapPanel::toolActions() const {
    return tools_->actions();
}

void MapPanel::themeChanged() {
    for (QAction* action : bar_->actions()) {
        const QString name = action->property(kIconName).toString();
        if (!name.isEmpty()) action->setIcon(toolIcon(name));
    }
}

void MapPanel::show(std::shared_ptr<const SurveyMap> survey, std::shared_ptr<const Products> products) {
    view_->show(std::move(survey), std::move(products));
}

}  // namespace terrawalk::gui
