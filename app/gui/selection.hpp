#pragma once

#include <QObject>
#include <QString>
#include <utility>
#include <vector>

namespace terrawalk::gui {

/// A part of a run, by the times of its log [s].
struct TrackStretch {
    QString run;
    double from_s = 0.0;
    double to_s = 0.0;
    bool operator==(const TrackStretch&) const = default;
};

/// What is selected, one for the whole window: every view shows it and may change it.
class Selection : public QObject {
    Q_OBJECT
  public:
    using QObject::QObject;
    /// As they were chosen: one, or those that lie in an area.
    [[nodiscard]] const std::vector<TrackStretch>& stretches() const { return stretches_; }
    [[nodiscard]] bool empty() const { return item_.isEmpty() && stretches_.empty(); }
    /// A run or a mark by its name; empty for none.
    [[nodiscard]] const QString& item() const { return item_; }

    /// Selects the run as well, where all are of one. Ends may come in any order.
    void select(std::vector<TrackStretch> stretches) {
        if (stretches.empty()) return clear();
        for (TrackStretch& stretch : stretches) {
            if (stretch.to_s < stretch.from_s) std::swap(stretch.from_s, stretch.to_s);
        }
        if (stretches_ == stretches) return;
        item_ = stretches.front().run;
        for (const TrackStretch& stretch : stretches) {
            if (stretch.run != item_) item_.clear();
        }
        stretches_ = std::move(stretches);
        Q_EMIT changed();
    }
    void select(TrackStretch stretch) { select(std::vector{std::move(stretch)}); }
    void selectItem(const QString& name) {
        if (item_ == name && stretches_.empty()) return;
        item_ = name;
        stretches_.clear();
        Q_EMIT changed();
    }
    void clear() { selectItem({}); }

  Q_SIGNALS:
    void changed();

  private:
    std::vector<TrackStretch> stretches_;
    QString item_;
};

}  // namespace terrawalk::gui
