#pragma once

#include <QObject>
#include <QString>
#include <optional>

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
    [[nodiscard]] const std::optional<TrackStretch>& stretch() const { return stretch_; }
    /// A run or a mark by its name; empty for none.
    [[nodiscard]] const QString& item() const { return item_; }

    /// Selects the run as well. Ends may come in any order.
    void select(TrackStretch stretch) {
        if (stretch.to_s < stretch.from_s) std::swap(stretch.from_s, stretch.to_s);
        if (stretch_ == stretch) return;
        item_ = stretch.run;
        stretch_ = std::move(stretch);
        Q_EMIT changed();
    }
    void selectItem(const QString& name) {
        if (item_ == name && !stretch_) return;
        item_ = name;
        stretch_.reset();
        Q_EMIT changed();
    }
    void clear() { selectItem({}); }

  Q_SIGNALS:
    void changed();

  private:
    std::optional<TrackStretch> stretch_;
    QString item_;
};

}  // namespace terrawalk::gui
