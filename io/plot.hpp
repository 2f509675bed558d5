#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace terrawalk {

/// A value axis. Its range covers the data unless it is given.
struct PlotAxis {
    std::string label;  ///< with the unit
    bool logarithmic = false;
    bool whole_numbers = false;  ///< labels at whole numbers only
    std::optional<std::pair<double, double>> range;
};

enum class SeriesLook { Line, Dashed, Points, Ribbon };

/// A named curve or cloud of points.
struct PlotSeries {
    std::string name;  ///< empty: not in the key
    std::vector<std::pair<double, double>> points;
    SeriesLook look = SeriesLook::Line;
    int colour = -1;                 ///< 0..7; -1: by the place among the panel's series
    std::vector<double> upper = {};  ///< of a ribbon: its upper edge at each point, which is on the lower one
};

/// A named sample, drawn as a box (quartiles, median, whiskers to the last value within 1.5 quartile
/// distances, values beyond as circles); a sample of one is drawn as a bar from zero, or as a median on a
/// logarithmic axis, which has no zero.
struct PlotSample {
    std::string name;
    std::vector<double> values;
    std::optional<double> reference;  ///< a published value, drawn as a dash across
    int colour = 0;                   ///< 0..7
};

/// One set of axes. Either series over an x axis or samples side by side.
struct PlotPanel {
    std::string title;
    PlotAxis x;
    PlotAxis y;
    std::vector<PlotSeries> series;
    std::vector<PlotSample> samples;
    bool equal_scales = false;  ///< a metre is as long in x as in y
};

struct Plot {
    std::string title;
    std::string note;  ///< one line below the title: what was simulated, the seed
    std::vector<PlotPanel> panels;
    int columns = 1;        ///< panels side by side
    std::string reference;  ///< what the dashes of the samples are, for the key; empty: none
};

/// A stand-alone SVG file. Values that are not finite, or not positive on a logarithmic axis, are left out.
/// Pure.
[[nodiscard]] std::string plotSvg(const Plot& plot);

}  // namespace terrawalk
