#pragma once

#include <QWidget>
#include <vector>

#include "app/pipeline/run_history.hpp"

class QGridLayout;

namespace terrawalk::gui {

/// Figures of a run beside those of the run before: before, now, change, and whether that is better, said by
/// a sign and not by colour alone.
class FigureTable : public QWidget {
    Q_OBJECT
  public:
    explicit FigureTable(QWidget* parent = nullptr);
    /// @param before  the time of the run before, as timeOfRun()
    void show(const std::vector<FigureChange>& changes, const QString& before);

  private:
    void addRow(const FigureChange& change, int row);
    void addCell(const QString& text, int row, int column, const char* name = nullptr);
    QGridLayout* grid_ = nullptr;
};

}  // namespace terrawalk::gui
