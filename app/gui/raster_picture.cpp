#include "app/gui/raster_picture.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <span>

#include "app/pipeline/relief.hpp"

namespace terrawalk::gui {

namespace {

constexpr int kSmallestOverview_px = 256;

std::vector<QColor> colours(const std::vector<Colour>& ramp) {
    std::vector<QColor> list;
    for (const Colour& c : ramp) list.emplace_back(c[0], c[1], c[2]);
    return list;
}

/// Each pixel the mean of four. QImage's own way waits for Qt's pool of threads, and so does its painter.
QImage halved(const QImage& full) {
    QImage half((full.width() + 1) / 2, (full.height() + 1) / 2, QImage::Format_ARGB32_Premultiplied);
    for (int row = 0; row < half.height(); ++row) {
        const auto* const upper = reinterpret_cast<const QRgb*>(full.constScanLine(2 * row));
        const auto* const lower =
            reinterpret_cast<const QRgb*>(full.constScanLine(std::min(2 * row + 1, full.height() - 1)));
        auto* const line = reinterpret_cast<QRgb*>(half.scanLine(row));
        for (int column = 0; column < half.width(); ++column) {
            const int left = 2 * column, right = std::min(left + 1, full.width() - 1);
            // Two channels at once, each with room for the sum of four.
            constexpr QRgb kOdd = 0x00FF00FFU;
            QRgb low = 0, high = 0;
            for (const QRgb pixel : {upper[left], upper[right], lower[left], lower[right]}) {
                low += pixel & kOdd;
                high += (pixel >> 8U) & kOdd;
            }
            line[column] = ((low + 0x00020002U) >> 2U & kOdd) | ((high + 0x00020002U) >> 2U & kOdd) << 8U;
        }
    }
    return half;
}

std::vector<QImage> withOverviews(QImage full) {
    std::vector<QImage> levels;
    levels.push_back(std::move(full));
    while (std::max(levels.back().width(), levels.back().height()) > kSmallestOverview_px) {
        levels.push_back(halved(levels.back()));
    }
    return levels;
}

QImage emptyImage(const GridGeometry& g) {
    QImage image(static_cast<int>(g.columns), static_cast<int>(g.rows), QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::transparent);
    return image;
}

RasterPicture heights(const Products& products) {
    const std::vector<Colour> ramp = reliefRamp();
    const ReliefImage relief = shadedRelief(products.dem, ramp);
    const QImage image(relief.rgba.data(), static_cast<int>(relief.columns), static_cast<int>(relief.rows),
                       4 * static_cast<qsizetype>(relief.columns), QImage::Format_RGBA8888);
    return {RasterLayer::Height,
            products.dem.geometry,
            withOverviews(image.convertToFormat(QImage::Format_ARGB32_Premultiplied)),
            {colours(ramp), relief.lowest_m, relief.highest_m, false, false, "m", {}, {}}};
}

/// The few largest values, at the edge of the survey, must not take the colours from all others.
double upperEnd(std::span<const float> values) {
    std::vector<float> known;
    std::copy_if(values.begin(), values.end(), std::back_inserter(known),
                 [](float v) { return std::isfinite(v) && v > 0.0F; });
    if (known.empty()) return 1.0;
    const auto at = known.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(known.size() - 1));
    std::nth_element(known.begin(), at, known.end());
    return *at;
}

RasterPicture values(const Products& products, RasterLayer layer, std::span<const float> numbers,
                     const QString& unit) {
    const std::vector<Colour> ramp = sequentialRamp();
    const GridGeometry& g = products.dem.geometry;
    const double high = upperEnd(numbers);
    bool above = false;
    QImage image = emptyImage(g);
    for (std::size_t row = 0; row < g.rows; ++row) {
        auto* line = reinterpret_cast<QRgb*>(image.scanLine(static_cast<int>(row)));
        for (std::size_t column = 0; column < g.columns; ++column) {
            const std::size_t cell = row * g.columns + column;
            if (!std::isfinite(numbers[cell]) || std::isnan(products.dem.heights_m[cell])) continue;
            above = above || static_cast<double>(numbers[cell]) > high;
            const Colour c = rampColour(ramp, static_cast<double>(numbers[cell]) / high);
            line[column] = qRgb(c[0], c[1], c[2]);
        }
    }
    return {layer, g, withOverviews(image), {colours(ramp), 0.0, high, above, false, unit, {}, {}}};
}

RasterPicture sources(const Products& products) {
    // Okabe and Ito: told apart by readers who do not see all colours.
    const std::vector<QColor> classes{QColor(0, 158, 115), QColor(86, 180, 233), QColor(230, 159, 0)};
    const GridGeometry& g = products.dem.geometry;
    QImage image = emptyImage(g);
    for (std::size_t row = 0; row < g.rows; ++row) {
        auto* line = reinterpret_cast<QRgb*>(image.scanLine(static_cast<int>(row)));
        for (std::size_t column = 0; column < g.columns; ++column) {
            const std::uint8_t source = products.uncertainty->sources[row * g.columns + column];
            if (source >= 1 && source <= classes.size()) line[column] = classes[source - 1U].rgb();
        }
    }
    return {RasterLayer::Source,
            g,
            withOverviews(image),
            {classes,
             0.0,
             0.0,
             false,
             false,
             {},
             {QCoreApplication::translate("RasterPicture", "measured"),
              QCoreApplication::translate("RasterPicture", "interpolated"),
              QCoreApplication::translate("RasterPicture", "extrapolated")},
             {}}};
}

/// As near to white as says that it is no more than error.
QRgb faint(const Colour& c) {
    const auto mixed = [](std::uint8_t part) {
        return 255 - (255 - part) * 3 / 10;
    };
    return qRgb(mixed(c[0]), mixed(c[1]), mixed(c[2]));
}

/// White is no change, and both ends are as far from it.
RasterPicture changes(const Products& products, const HeightChange& change) {
    const std::vector<Colour> ramp = divergingRamp();
    const GridGeometry& g = products.dem.geometry;
    const auto& metres = change.difference.change.heights_m;
    std::vector<float> sizes;
    for (const float m : metres) sizes.push_back(std::abs(m));
    const double end = upperEnd(sizes);
    RasterLegend legend{colours(ramp), -end, end, false, false, "m", {}, {}};
    QImage image = emptyImage(g);
    for (std::size_t row = 0; row < g.rows; ++row) {
        auto* line = reinterpret_cast<QRgb*>(image.scanLine(static_cast<int>(row)));
        for (std::size_t column = 0; column < g.columns; ++column) {
            const std::size_t cell = row * g.columns + column;
            const auto m = static_cast<double>(metres[cell]);
            if (std::isnan(m)) continue;
            legend.open_above = legend.open_above || m > end;
            legend.open_below = legend.open_below || m < -end;
            const Colour c = rampColour(ramp, 0.5 + 0.5 * m / end);
            const bool sure = !change.has_sigma || change.difference.significance.heights_m[cell] != 0.0F;
            line[column] = sure ? qRgb(c[0], c[1], c[2]) : faint(c);
        }
    }
    legend.notes << QCoreApplication::translate("RasterPicture", "less %1")
                        .arg(QString::fromStdString(change.earlier));
    if (change.has_sigma) legend.notes << QCoreApplication::translate("RasterPicture", "pale: within 1.96 σ");
    if (change.has_sigma && !change.earlier_has_sigma)
        legend.notes << QCoreApplication::translate("RasterPicture", "σ of the survey alone");
    return {RasterLayer::Change, g, withOverviews(image), legend};
}

}  // namespace

RasterPicture rasterPicture(const Products& products, RasterLayer layer, const HeightChange* change) {
    if (layer == RasterLayer::Change) {
        const bool fits = change != nullptr && change->difference.change.geometry == products.dem.geometry;
        return fits ? changes(products, *change) : RasterPicture{};
    }
    if (!hasLayer(products, layer)) return {};
    switch (layer) {
        case RasterLayer::Height:
            return heights(products);
        case RasterLayer::Uncertainty:
            return values(products, layer, products.uncertainty->sigmas_m, "m");
        case RasterLayer::Density:
            return values(products, layer, products.uncertainty->density_per_m2,
                          QCoreApplication::translate("RasterPicture", "points/m²"));
        case RasterLayer::Source:
            return sources(products);
        case RasterLayer::Change:
        case RasterLayer::None:
            break;
    }
    return {};
}

void drawRaster(QPainter& painter, const RasterPicture& picture, const MapTransform& transform) {
    if (picture.levels.empty()) return;
    const QRectF extent_m = extentOf(picture.geometry);
    // As coarse as one pixel of the picture still covers no more than one of the screen.
    const double screen_px_per_cell = transform.pixels_per_m * picture.geometry.cell_m;
    std::size_t level = 0;
    while (level + 1 < picture.levels.size() &&
           screen_px_per_cell * static_cast<double>(std::size_t{2} << level) <= 1.0) {
        ++level;
    }
    const QImage& image = picture.levels[level];
    const QRectF whole(transform.toScreen({extent_m.left(), extent_m.bottom()}),
                       transform.toScreen({extent_m.right(), extent_m.top()}));
    const QRectF seen = whole.intersected(QRectF(QPointF(0, 0), transform.size_px));
    if (seen.isEmpty()) return;
    const double across = image.width() / whole.width(), down = image.height() / whole.height();
    // Whole pixels of the picture and one more, so that its pixels stay in place while the map is moved.
    const QRect source = QRectF((seen.left() - whole.left()) * across, (seen.top() - whole.top()) * down,
                                seen.width() * across, seen.height() * down)
                             .toAlignedRect()
                             .adjusted(-1, -1, 1, 1)
                             .intersected(image.rect());
    const QRectF target(whole.left() + source.left() / across, whole.top() + source.top() / down,
                        source.width() / across, source.height() / down);
    painter.setRenderHint(QPainter::SmoothPixmapTransform, screen_px_per_cell < 8.0);
    painter.drawImage(target, image, source);
}

QRectF extentOf(const GridGeometry& g) {
    const double high_m = g.cell_m * static_cast<double>(g.rows);
    return {g.west_m, g.north_m - high_m, g.cell_m * static_cast<double>(g.columns), high_m};
}

bool hasLayer(const Products& products, RasterLayer layer) {
    if (layer == RasterLayer::None || layer == RasterLayer::Change) return false;
    return layer == RasterLayer::Height ? products.dem.geometry.size() > 0 : products.uncertainty.has_value();
}

std::optional<RasterReading> readingAt(const Products& products, QPointF map_m) {
    const auto cell = products.dem.geometry.cellAt(map_m.x(), map_m.y());
    if (!cell || std::isnan(products.dem.heights_m[*cell])) return std::nullopt;
    RasterReading reading{products.dem.heights_m[*cell], std::nullopt};
    if (products.uncertainty && std::isfinite(products.uncertainty->sigmas_m[*cell])) {
        reading.sigma_m = products.uncertainty->sigmas_m[*cell];
    }
    return reading;
}

}  // namespace terrawalk::gui
