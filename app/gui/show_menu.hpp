#pragma once

#include <QMenu>

#include "app/gui/view_state.hpp"

namespace terrawalk::gui {

/// What is shown and in which colours, for the map and the 3-D view alike: a switch here shows in both.
class ShowMenu : public QMenu {
    Q_OBJECT
  public:
    explicit ShowMenu(ViewState& state, QWidget* parent = nullptr);

  private:
    void addLayers();
    void addColourings();
    void addFlag(const QString& text, const char* name, bool ViewChoice::*flag);
    ViewState& state_;
};

}  // namespace terrawalk::gui
