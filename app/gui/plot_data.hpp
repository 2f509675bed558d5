#pragma once

#include <QString>
#include <QStringList>
#include <cstddef>
#include <optional>
#include <vector>

#include "app/pipeline/process.hpp"
#include "app/pipeline/tune_trace.hpp"
#include "survey/survey.hpp"

namespace terrawalk::gui {

enum class PlotKind {
    // Sensors of one run, as they were logged.
    GnssPosition,
    GnssVelocity,
    Barometer,
    OpticalFlow,
    Attitude,
    Acceleration,
    AngularRate,
    Range,
    // The fused run.
    Position,
    Speed,
    Sigma,
    GroundHeights,
    Innovations,
    Consistency,
    // The whole survey.
    NormalisedErrors,
    ErrorHistogram,
    QuantileQuantile,
    CrossValidation,
    Tuning,
    Convergence,
    Optimisers,
};

enum class SeriesStyle {
    Line,   ///< over x that never falls; a y that is not a number breaks it
    Dots,   ///< in any order
    Bars,   ///< about x, one unit of `bar_width` wide
    Guide,  ///< a thin line to compare with
    Boxes,  ///< quartiles, whiskers and outliers of the values that share an x
};
/// Of the series' colours; each is told apart from the others by readers who do not see all colours.
enum class SeriesInk { First, Second, Third, Fourth, Fifth, Sixth, Quiet };

struct PlotSeries {
    QString name;
    SeriesStyle style = SeriesStyle::Line;
    SeriesInk ink = SeriesInk::First;
    std::vector<double> x, y;
    std::vector<double> half_band;  ///< empty, or half the width of a band about each y
    bool sets_scale = true;         ///< whether y makes room for it
    QStringList names;              ///< of dots: one for each, e.g. a mark; or none
};

/// One pair of axes. Panels of a plot stand one below the other over the same x.
struct PlotPanel {
    QString label;
    QString unit;  ///< of y; empty for a pure number
    int decimals = 2;
    std::vector<PlotSeries> series;
    bool from_zero = false;                        ///< y starts at zero
    std::optional<double> highest = std::nullopt;  ///< y ends here, whatever lies above
    QStringList value_names = {};                  ///< of y = 0, 1, 2 ..., where y is no number
};

struct Plot {
    QString title;
    QString x_label;
    QString x_unit;
    bool over_time = false;  ///< x is the time of a run's log [s]
    double bar_width = 1.0;
    QStringList categories;  ///< names of x = 0, 1, 2 ..., where x is no number
    bool of_marks = false;   ///< dots and categories are named after marks
    std::vector<PlotPanel> panels;
    QString note;    ///< figures that belong to it
    QString reason;  ///< where there are no panels: why, and what to do
};

[[nodiscard]] const std::vector<PlotKind>& allPlots();
[[nodiscard]] QString plotName(PlotKind kind);
/// Heading under which it stands in a list.
[[nodiscard]] QString plotGroup(PlotKind kind);
/// Whether it shows one run, over time.
[[nodiscard]] bool plotsOneRun(PlotKind kind);
/// Which readings a person most likely wants to exclude on seeing it, as EditedSensor is named.
[[nodiscard]] QString likelySensor(PlotKind kind);

/// Pure.
/// @param run       number of the run in the survey, for plots of one run
/// @param products  null before processing
/// @param tuning    of the searches that are known; null: none
[[nodiscard]] Plot plotOf(PlotKind kind, std::size_t run, const Survey& survey, const Products* products,
                          const TuningData* tuning = nullptr);
/// Lengths and speeds of a plot in metres, in what a person chose instead.
[[nodiscard]] Plot inChosenUnit(Plot plot);
/// Whether it shows searches for parameters, which may come from other files.
[[nodiscard]] bool plotsSearches(PlotKind kind);

}  // namespace terrawalk::gui
