#include "app/gui/show_menu.hpp"

#include <QActionGroup>

namespace terrawalk::gui {

ShowMenu::ShowMenu(ViewState& state, QWidget* parent) : QMenu(parent), state_(state) {
    setTitle(tr("Show"));
    addLayers();
    addColourings();
    addSeparator();
    addFlag(tr("Tracks"), "showTracks", &ViewChoice::tracks);
    addFlag(tr("Ground points"), "showPoints", &ViewChoice::points);
    addFlag(tr("Marks"), "showMarks", &ViewChoice::marks);
    addFlag(tr("Contours"), "showContours", &ViewChoice::contours);
    addFlag(tr("Terrace edges"), "showEdges", &ViewChoice::edges);
}

void ShowMenu::addLayers() {
    QMenu* menu = addMenu(tr("Ground"));
    auto* group = new QActionGroup(this);
    for (const auto& [layer, name] : layerNames()) {
        QAction* action = group->addAction(menu->addAction(name));
        action->setCheckable(true);
        action->setStatusTip(tr("Colours the ground by this, on the map and in 3-D"));
        const auto follow = [this, action, own = layer] {
            action->setChecked(state_.now().layer == own);
            action->setEnabled(state_.available(own));
        };
        follow();
        connect(&state_, &ViewState::changed, action, follow);
        connect(&state_, &ViewState::availableChanged, action, follow);
        connect(action, &QAction::triggered, this, [this, own = layer] { state_.setLayer(own); });
    }
}

void ShowMenu::addColourings() {
    QMenu* menu = addMenu(tr("Colour of the tracks"));
    auto* group = new QActionGroup(this);
    for (const auto& [colouring, name] : colouringNames()) {
        QAction* action = group->addAction(menu->addAction(name));
        action->setCheckable(true);
        action->setStatusTip(tr("Colours the tracks by this, on the map and in 3-D"));
        const auto follow = [this, action, own = colouring] {
            action->setChecked(state_.now().colouring == own);
        };
        follow();
        connect(&state_, &ViewState::changed, action, follow);
        connect(action, &QAction::triggered, this, [this, own = colouring] { state_.setColouring(own); });
    }
}

void ShowMenu::addFlag(const QString& text, const char* name, bool ViewChoice::*flag) {
    QAction* action = addAction(text);
    action->setObjectName(name);
    action->setCheckable(true);
    action->setStatusTip(tr("Draws this on the ground or not, on the map and in 3-D"));
    const auto follow = [this, action, flag] {
        action->setChecked(state_.now().*flag);
    };
    follow();
    connect(&state_, &ViewState::changed, action, follow);
    connect(action, &QAction::toggled, this, [this, flag](bool on) { state_.setShown(flag, on); });
}

}  // namespace terrawalk::gui
