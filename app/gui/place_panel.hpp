#pragma once

#include <QFrame>

#include "app/pipeline/place_report.hpp"

class QGridLayout;
class QLabel;
class QScrollArea;
class QVBoxLayout;

namespace terrawalk::gui {

/// What is known of the place that was clicked: its height, where its sigma comes from, the nearest hits, and
/// what another pass would give.
class PlacePanel : public QFrame {
    Q_OBJECT
  public:
    explicit PlacePanel(QWidget* parent = nullptr);
    void show(const PlaceReport& place);
    void clear();

  protected:
    void resizeEvent(QResizeEvent* event) override;

  private:
    void rebuild();
    void fitHeight();
    QScrollArea* scroll_ = nullptr;
    QVBoxLayout* column_ = nullptr;
    QWidget* content_ = nullptr;
};

}  // namespace terrawalk::gui
