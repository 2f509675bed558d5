#pragma once

#include <QFrame>
#include <QLabel>
#include <QPushButton>
#include <optional>
#include <vector>

#include "app/gui/selection.hpp"
#include "app/pipeline/process.hpp"
#include "survey/survey.hpp"

namespace terrawalk::gui {

/// What is known of one place of the surface, line by line: what, and how much.
struct PlaceFacts {
    QString title;
    std::vector<std::pair<QString, QString>> lines;
    std::optional<TrackStretch> around;  ///< some seconds of the run about the nearest sample
};
[[nodiscard]] PlaceFacts placeFacts(const Survey& survey, const Products& products,
                                    const std::vector<Eigen::Vector3d>& points_map_m,
                                    const Eigen::Vector3d& map_m);

/// A small card that tells it.
class PointCard : public QFrame {
    Q_OBJECT
  public:
    explicit PointCard(QWidget* parent = nullptr);
    void show(const PlaceFacts& facts);

  Q_SIGNALS:
    void stretchAsked(const terrawalk::gui::TrackStretch& stretch);
    void closed();

  private:
    QLabel* title_;
    QLabel* text_;
    QPushButton* select_;
    std::optional<TrackStretch> around_;
};

}  // namespace terrawalk::gui
