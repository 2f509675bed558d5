#pragma once

#include <QFontMetricsF>
#include <QPainter>
#include <QPalette>
#include <QPointF>
#include <QRectF>
#include <QString>
#include <cstddef>
#include <limits>
#include <vector>

namespace terrawalk::gui {

/// A mark's symbol on the screen, whose name is to stand beside it.
struct MarkName {
    QPointF at;
    QString name;
    bool highlighted = false;  ///< shown even where it lies on something
    double pin_px = 0.0;       ///< below the symbol
    double opacity = 1.0;
};
[[nodiscard]] QRectF symbolBox(const MarkName& mark);

/// Where names may stand.
struct NameRoom {
    QRectF seen;                   ///< marks beyond it have no name
    std::vector<QRectF> reserved;  ///< for what is drawn over the names, or lies there already
    bool far_too = true;           ///< farther away, at the end of a line, where there is no room beside
};

struct PlacedName {
    std::size_t mark = 0;
    QPointF start;  ///< of the base line
    QRectF box;
    bool led = false;  ///< a line goes from the symbol to the name
};

/// Names of marks on one frame, found once for all that draw around them.
struct MarkNames {
    std::vector<MarkName> marks;
    std::vector<PlacedName> places;
};

/// Names right, left, above or below their symbols, none on another, on a symbol, on a pin or on what is
/// reserved. Those that find no such place stand farther away at the end of a line, one that crosses no name
/// and no other line where there is any, then where they lie on others by a quarter of themselves at most;
/// else they are left out.
[[nodiscard]] MarkNames placeMarkNames(const QFontMetricsF& metrics, std::vector<MarkName> marks,
                                       const NameRoom& room);
void drawMarkNames(QPainter& painter, const MarkNames& names, const QPalette& palette);

/// Text with an edge that sets it off from any ground.
void drawLabel(QPainter& painter, QPointF at, const QString& label, const QPalette& palette);

}  // namespace terrawalk::gui
