#include "app/gui/profile_plot.hpp"

#include <QCoreApplication>
#include <cmath>
#include <limits>

#include "app/gui/figures.hpp"

namespace terrawalk::gui {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kBand = 1.96;

QString words(const char* text) {
    return QCoreApplication::translate("ProfilePlot", text);
}

}  // namespace

Plot profilePlot(const Products& products, const SurveyMap& map, const QPolygonF& line_m) {
    std::vector<Eigen::Vector2d> line;
    for (const QPointF& v : line_m) line.emplace_back(v.x(), v.y());
    const SurfaceProfile profile = surfaceProfile(products, map, line);
    Plot plot;
    plot.title = words(QT_TRANSLATE_NOOP("ProfilePlot", "Profile"));
    plot.x_label = words(QT_TRANSLATE_NOOP("ProfilePlot", "Along the line"));
    plot.x_unit = "m";
    PlotSeries surface{words(QT_TRANSLATE_NOOP("ProfilePlot", "Surface, 95 % band")),
                       SeriesStyle::Line,
                       SeriesInk::First,
                       {},
                       {},
                       {},
                       true};
    std::size_t known = 0;
    for (const ProfilePoint& point : profile.points) {
        surface.x.push_back(point.distance);
        surface.y.push_back(point.height.value_or(kNone));
        surface.half_band.push_back(point.height && point.sigma ? kBand * *point.sigma : kNone);
        if (point.height) ++known;
    }
    if (known < 2) {
        plot.reason = words(QT_TRANSLATE_NOOP("ProfilePlot", "There is no surface along this line."));
        return plot;
    }
    PlotSeries marks{words(QT_TRANSLATE_NOOP("ProfilePlot", "Marks beside it")),
                     SeriesStyle::Dots,
                     SeriesInk::Second,
                     {},
                     {},
                     {},
                     true};
    for (const SurfaceProfile::Mark& mark : profile.marks) {
        marks.x.push_back(mark.distance_m);
        marks.y.push_back(mark.height_m);
    }
    PlotPanel panel;
    panel.label = words(QT_TRANSLATE_NOOP("ProfilePlot", "Height"));
    panel.unit = "m";
    panel.series.push_back(std::move(surface));
    if (!marks.x.empty()) panel.series.push_back(std::move(marks));
    plot.panels.push_back(std::move(panel));
    return inChosenUnit(std::move(plot));
}

}  // namespace terrawalk::gui
