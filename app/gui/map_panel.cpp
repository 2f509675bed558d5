#include "app/gui/map_panel.hpp"

#include <QAction>
#include <QActionGroup>
#include <QComboBox>
#include <QStandardItemModel>
#include <QToolBar>
#include <QVBoxLayout>

#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {
constexpr const char* kIconName = "icon_name";
}

MapPanel::MapPanel(Selection& selection, QWidget* parent) : QWidget(parent), view_(new MapView(selection)) {
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
    themeChanged();
}

void MapPanel::addLayers() {
    layers_ = new QComboBox;
    layers_->setObjectName("layers");
    layers_->setAccessibleName(tr("Layer"));
    layers_->setToolTip(tr("What the ground is coloured by"));
    const std::pair<RasterLayer, QString> names[] = {{RasterLayer::Height, tr("Shaded heights")},
                                                     {RasterLayer::Uncertainty, tr("Uncertainty")},
                                                     {RasterLayer::Density, tr("Point density")},
                                                     {RasterLayer::Source, tr("Source of heights")},
                                                     {RasterLayer::None, tr("No ground")}};
    for (const auto& [layer, name] : names) layers_->addItem(name, static_cast<int>(layer));
    connect(layers_, &QComboBox::currentIndexChanged, this, [this] {
        const auto layer = static_cast<RasterLayer>(layers_->currentData().toInt());
        view_->setLayer(layer);
        Q_EMIT layerChanged(layer);
    });
    bar_->addWidget(layers_);
}

void MapPanel::addColourings() {
    colourings_ = new QComboBox;
    colourings_->setObjectName("colourings");
    colourings_->setAccessibleName(tr("Colour of the tracks"));
    colourings_->setToolTip(tr("What the tracks are coloured by"));
    const std::pair<TrackColouring, QString> names[] = {
        {TrackColouring::Run, tr("Tracks by run")},
        {TrackColouring::Fix, tr("Tracks by fix")},
        {TrackColouring::Speed, tr("Tracks by speed")},
        {TrackColouring::Height, tr("Tracks by height")},
        {TrackColouring::SigmaPlan, tr("Tracks by plan σ")},
        {TrackColouring::SigmaHeight, tr("Tracks by height σ")}};
    for (const auto& [colouring, name] : names) colourings_->addItem(name, static_cast<int>(colouring));
    connect(colourings_, &QComboBox::currentIndexChanged, this, [this] {
        const auto colouring = static_cast<TrackColouring>(colourings_->currentData().toInt());
        view_->setColouring(colouring);
        Q_EMIT colouringChanged(colouring);
    });
    auto* gap = new QWidget;
    gap->setFixedWidth(kGrid_px);
    bar_->addWidget(gap);
    bar_->addWidget(colourings_);
    contours_ = bar_->addAction(tr("Contours"));
    contours_->setProperty(kIconName, "contours");
    contours_->setCheckable(true);
    contours_->setObjectName("contours");
    contours_->setToolTip(tr("Contours of the surface"));
    connect(contours_, &QAction::toggled, view_, &MapView::setContoursVisible);
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
    auto* model = qobject_cast<QStandardItemModel*>(layers_->model());
    for (int row = 0; row < layers_->count(); ++row) {
        const auto layer = static_cast<RasterLayer>(layers_->itemData(row).toInt());
        model->item(row)->setEnabled(layer == RasterLayer::None || (products && hasLayer(*products, layer)));
    }
    contours_->setEnabled(products != nullptr);
    view_->show(std::move(survey), std::move(products));
}

}  // namespace terrawalk::gui
