#pragma once

#include <QMarginsF>
#include <QPointF>
#include <QRectF>
#include <QSizeF>
#include <algorithm>

namespace terrawalk::gui {

/// Where the map lies on the screen: map metres, y north; pixels, y down.
struct MapTransform {
    QPointF centre_m;
    double pixels_per_m = 1.0;
    QSizeF size_px;

    [[nodiscard]] QPointF toScreen(QPointF map_m) const {
        return {size_px.width() / 2 + (map_m.x() - centre_m.x()) * pixels_per_m,
                size_px.height() / 2 - (map_m.y() - centre_m.y()) * pixels_per_m};
    }
    [[nodiscard]] QPointF toMap(QPointF screen_px) const {
        return {centre_m.x() + (screen_px.x() - size_px.width() / 2) / pixels_per_m,
                centre_m.y() - (screen_px.y() - size_px.height() / 2) / pixels_per_m};
    }
    /// The place under `screen_px` stays there.
    void zoom(double factor, QPointF screen_px) {
        const QPointF fixed_m = toMap(screen_px);
        pixels_per_m = std::clamp(pixels_per_m * factor, 1e-4, 1e4);
        centre_m += fixed_m - toMap(screen_px);
    }
    void pan(QPointF by_px) { centre_m += QPointF(-by_px.x(), by_px.y()) / pixels_per_m; }
    /// @param extent_m  map metres; its top() is the least y
    void fit(QRectF extent_m, QMarginsF margins_px) {
        const double wide = std::max(extent_m.width(), 1.0), high = std::max(extent_m.height(), 1.0);
        pixels_per_m =
            std::max(1e-4, std::min((size_px.width() - margins_px.left() - margins_px.right()) / wide,
                                    (size_px.height() - margins_px.top() - margins_px.bottom()) / high));
        centre_m = extent_m.center() +
                   QPointF(margins_px.right() - margins_px.left(), margins_px.top() - margins_px.bottom()) /
                       (2.0 * pixels_per_m);
    }
};

}  // namespace terrawalk::gui
