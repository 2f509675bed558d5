#pragma once

#include <QColor>
#include <QImage>
#include <QPainter>
#include <QRectF>
#include <QString>
#include <optional>
#include <vector>

#include "app/gui/map_transform.hpp"
#include "app/gui/view_state.hpp"
#include "app/pipeline/process.hpp"

namespace terrawalk::gui {

/// What the colours of a layer stand for.
struct RasterLegend {
    std::vector<QColor> ramp;  ///< from low to high; or one for each of `classes`
    double low = 0.0;
    double high = 0.0;
    bool open_above = false;  ///< some values lie above `high` and have its colour
    bool open_below = false;  ///< the same for `low`
    QString unit;
    QStringList classes;
    QStringList notes;  ///< lines below
};

/// A layer as a picture with overviews, each half as wide as the one before: drawing costs by the screen,
/// not by the raster. Immutable.
struct RasterPicture {
    RasterLayer layer = RasterLayer::None;
    GridGeometry geometry;
    std::vector<QImage> levels;
    RasterLegend legend;
};

/// Colours a layer of the products; what they lack gives a picture without levels. Takes a while for large
/// rasters. Pure.
/// @param change  for its layer alone
[[nodiscard]] RasterPicture rasterPicture(const Products& products, RasterLayer layer,
                                          const HeightChange* change = nullptr);
void drawRaster(QPainter& painter, const RasterPicture& picture, const MapTransform& transform);

[[nodiscard]] QRectF extentOf(const GridGeometry& geometry);
/// Whether the products alone have it.
[[nodiscard]] bool hasLayer(const Products& products, RasterLayer layer);

/// What is known of one place of the surface.
struct RasterReading {
    double height_m = 0.0;
    std::optional<double> sigma_m;
};
[[nodiscard]] std::optional<RasterReading> readingAt(const Products& products, QPointF map_m);

}  // namespace terrawalk::gui
