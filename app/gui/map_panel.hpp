#pragma once

#include <QWidget>

#include "app/gui/map_view.hpp"

class QActionGroup;
class QComboBox;
class QToolBar;

namespace terrawalk::gui {

/// The map under its own tool bar: layers, colours of the tracks, what is shown, and tools.
class MapPanel : public QWidget {
    Q_OBJECT
  public:
    MapPanel(ViewState& state, Selection& selection, QWidget* parent = nullptr);
    [[nodiscard]] MapView& view() { return *view_; }
    void show(std::shared_ptr<const SurveyMap> survey, std::shared_ptr<const Products> products);
    void themeChanged();
    /// Actions of the tools, for a menu.
    [[nodiscard]] QList<QAction*> toolActions() const;

  private:
    void addLayers();
    void addColourings();
    void followState();
    void addTools();
    void addTool(MapTool tool, const QString& icon_name, const QString& text, const QString& tip,
                 const QKeySequence& key);
    ViewState& state_;
    MapView* view_ = nullptr;
    QToolBar* bar_ = nullptr;
    QComboBox* layers_ = nullptr;
    QComboBox* colourings_ = nullptr;
    QActionGroup* tools_ = nullptr;
};

}  // namespace terrawalk::gui
