#pragma once

#include <QColor>
#include <QWidget>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/gui/plot_data.hpp"

namespace terrawalk::gui {

/// Draws one plot. Over time a left drag selects a stretch; the wheel zooms about the cursor, a right drag
/// moves, a double click shows all again; arrow keys, plus, minus and Home do the same. Shift with left and
/// right moves the end of the stretch, Ctrl with them its start.
class PlotCanvas : public QWidget {
    Q_OBJECT
  public:
    explicit PlotCanvas(QWidget* parent = nullptr);
    ~PlotCanvas() override;

    void show(Plot plot);
    using QWidget::show;
    /// Shades parts of the time axis.
    void setStretches(std::vector<std::pair<double, double>> stretches_s);
    /// Marks what is named, a category or dots.
    void setNamed(const QString& name);
    void themeChanged();
    /// Shows all of x again.
    void resetZoom();
    /// @param factor  above one shows less
    void zoom(double factor, double about_x);
    /// What is seen of x.
    [[nodiscard]] std::pair<double, double> visibleX() const;
    /// Pixel of a value in one of the panels.
    [[nodiscard]] QPointF pixelOf(std::size_t panel, double x, double y) const;
    /// How many points are drawn now, of all panels.
    [[nodiscard]] std::size_t pointsDrawn() const;
    /// What is known at a place of a panel: x and the values next to it, with units.
    [[nodiscard]] QString readoutAt(std::size_t panel, double x) const;
    [[nodiscard]] const Plot& plot() const;

  Q_SIGNALS:
    void stretchDragged(double from_s, double to_s);
    /// A click on a dot that has a name, or on the column of a category.
    void nameClicked(const QString& name);
    /// Under the cursor; empty where there is nothing.
    void readout(const QString& text);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Colours of series on the theme's ground.
[[nodiscard]] QColor seriesColour(SeriesInk ink);

}  // namespace terrawalk::gui
