#include "io/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "io/markup_text.hpp"
#include "io/svg.hpp"

namespace terrawalk {

namespace {

using Pixel = std::pair<double, double>;

// Plain values: viewers and printers of SVG files know no CSS variables. Colours after Okabe and Ito.
constexpr std::string_view kStyle = R"css(
svg { font: 12px/16px "Liberation Sans", Arial, Helvetica, sans-serif; background: #ffffff; }
.page { fill: #ffffff; }
text { fill: #1c2126; }
.title { font-size: 18px; font-weight: bold; }
.panel { font-size: 14px; font-weight: bold; }
.note, .tick, .axis, .key { fill: #59636e; }
.grid { stroke: #e6eaee; stroke-width: 1; }
.frame { stroke: #59636e; stroke-width: 1; fill: none; }
.line { fill: none; stroke-width: 2; stroke-linejoin: round; }
.dash { fill: none; stroke-width: 2; stroke-linejoin: round; stroke-dasharray: 7 4; }
.reference { stroke: #1c2126; stroke-width: 2; stroke-dasharray: 3 2; }
.box { stroke: #1c2126; stroke-width: 1; fill-opacity: 0.75; }
.whisker { stroke: #1c2126; stroke-width: 1; }
.median { stroke: #1c2126; stroke-width: 2.5; }
.outlier { fill: none; stroke-width: 1.2; }
.point { stroke: none; fill-opacity: 0.85; }
.ribbon { stroke: none; fill-opacity: 0.25; }
.s0 { stroke: #0072b2; } .s1 { stroke: #d55e00; } .s2 { stroke: #009e73; } .s3 { stroke: #cc79a7; }
.s4 { stroke: #b58900; } .s5 { stroke: #56b4e9; } .s6 { stroke: #59636e; } .s7 { stroke: #7b3294; }
.f0 { fill: #0072b2; } .f1 { fill: #d55e00; } .f2 { fill: #009e73; } .f3 { fill: #cc79a7; }
.f4 { fill: #b58900; } .f5 { fill: #56b4e9; } .f6 { fill: #59636e; } .f7 { fill: #7b3294; }
)css";

constexpr double kGlyph_px = 6.4;  // mean width of a character at 12 pixels
constexpr double kMargin_px = 24.0;
constexpr double kLeft_px = 68.0;  // room for the ticks and the label of the y axis
constexpr double kRight_px = 20.0;
constexpr double kTop_px = 34.0;     // the panel's title
constexpr double kBottom_px = 48.0;  // ticks and label of the x axis
constexpr double kHeader_px = 62.0;
constexpr double kKeyRow_px = 20.0;
constexpr int kColours = 8;

double textWidth(std::string_view words) {
    return kGlyph_px * static_cast<double>(characterCount(words));
}

bool shows(const PlotAxis& axis, double value) {
    return std::isfinite(value) && (!axis.logarithmic || value > 0.0);
}

// ---------------------------------------------------------------------------------------------- axes

/// Maps values to pixels along one axis.
struct Scale {
    bool logarithmic = false;
    double low = 0.0;  ///< of the value, or of its decimal logarithm
    double high = 1.0;
    double begin_px = 0.0;
    double end_px = 1.0;
    [[nodiscard]] double at(double value) const {
        const double v = logarithmic ? std::log10(value) : value;
        return begin_px + (v - low) / (high - low) * (end_px - begin_px);
    }
    [[nodiscard]] bool holds(double value) const {
        const double v = logarithmic ? std::log10(value) : value;
        return v >= low - 1e-9 * (high - low) && v <= high + 1e-9 * (high - low);
    }
};

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

/// Range of the axis over the data, with some room, in the axis' own measure.
Range axisRange(const PlotAxis& axis, const Range& data, bool from_zero) {
    const auto measure = [&](double v) {
        return axis.logarithmic ? std::log10(v) : v;
    };
    if (axis.range) return {measure(axis.range->first), measure(axis.range->second)};
    if (!(data.high >= data.low)) return {0.0, 1.0};
    Range range{measure(data.low), measure(data.high)};
    if (from_zero && !axis.logarithmic && range.low > 0.0) range.low = 0.0;
    double room = 0.05 * (range.high - range.low);
    if (room == 0.0) room = axis.logarithmic ? 0.5 : std::max(1e-9, 0.05 * std::abs(range.high));
    const bool stands_on_zero = !axis.logarithmic && range.low == 0.0;
    return {stands_on_zero ? 0.0 : range.low - room, range.high + room};
}

std::string powerOfTen(int exponent) {
    static constexpr std::string_view kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    if (exponent == 0) return "1";
    if (exponent == 1) return "10";
    std::string text = exponent < 0 ? "10⁻" : "10";
    for (const char digit : std::to_string(std::abs(exponent))) {
        text += kDigits[static_cast<std::size_t>(digit - '0')];
    }
    return text;
}

struct Tick {
    double value;
    std::string label;
};

/// 1, 2 and 5 of each power of ten between `low` and `high`.
std::vector<Tick> ticksOfDecades(double low, double high) {
    std::vector<Tick> ticks;
    for (int exponent = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, exponent) <= high;
         ++exponent) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double value = digit * std::pow(10.0, exponent);
            ticks.push_back({value, fmt::format("{:g}", value)});
        }
    }
    return ticks;
}

std::vector<Tick> axisTicks(const Scale& scale, const PlotAxis& axis, int most) {
    std::vector<Tick> ticks;
    // Below a decade and a half there are too few powers of ten to read values from.
    if (scale.logarithmic && scale.high - scale.low >= 1.5) {
        const int step = std::max(1, static_cast<int>(std::ceil((scale.high - scale.low) / most)));
        const int first = static_cast<int>(std::ceil(scale.low / step - 1e-9)) * step;
        for (int exponent = first; exponent <= scale.high + 1e-9; exponent += step) {
            ticks.push_back({std::pow(10.0, exponent), powerOfTen(exponent)});
        }
        return ticks;
    }
    const double low = scale.logarithmic ? std::pow(10.0, scale.low) : scale.low;
    const double high = scale.logarithmic ? std::pow(10.0, scale.high) : scale.high;
    // Over little more than half a decade 1, 2 and 5 are too few, and even steps still lie apart.
    if (scale.logarithmic && scale.high - scale.low >= 0.75) return ticksOfDecades(low, high);
    const Ticks nice = niceTicks(low, high, most);
    const bool large = std::max(std::abs(low), std::abs(high)) >= 1e5;
    for (const double value : nice.values) {
        if (scale.logarithmic && value <= 0.0) continue;
        if (axis.whole_numbers && value != std::round(value)) continue;
        ticks.push_back({value, large || nice.decimals > 4
                                    ? fmt::format("{:g}", value)
                                    : fixedDecimals(value, axis.whole_numbers ? 0 : nice.decimals)});
    }
    return ticks;
}

// ---------------------------------------------------------------------------------------------- samples

struct BoxFigures {
    double low_whisker = 0.0;
    double lower_quartile = 0.0;
    double median = 0.0;
    double upper_quartile = 0.0;
    double high_whisker = 0.0;
    std::vector<double> outliers;
};

/// Linear between order statistics, as R's type 7. `sorted` is not empty.
double quantile(const std::vector<double>& sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// Source: Tukey 1977. `values` is not empty.
BoxFigures boxFigures(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    BoxFigures box{.lower_quartile = quantile(values, 0.25),
                   .median = quantile(values, 0.5),
                   .upper_quartile = quantile(values, 0.75)};
    const double reach = 1.5 * (box.upper_quartile - box.lower_quartile);
    box.low_whisker = box.lower_quartile;
    box.high_whisker = box.upper_quartile;
    for (const double value : values) {
        if (value < box.lower_quartile - reach || value > box.upper_quartile + reach) {
            box.outliers.push_back(value);
        } else {
            box.low_whisker = std::min(box.low_whisker, value);
            box.high_whisker = std::max(box.high_whisker, value);
        }
    }
    return box;
}

// ---------------------------------------------------------------------------------------------- panel

struct PanelFrame {
    Scale x;
    Scale y;
    double left, top, right, bottom;
};

PanelFrame panelFrame(const PlotPanel& panel, double left, double top, double right, double bottom) {
    Range x;
    Range y;
    for (const PlotSeries& series : panel.series) {
        for (const auto& [px, py] : series.points) {
            if (!shows(panel.x, px) || !shows(panel.y, py)) continue;
            x.include(px);
            y.include(py);
        }
        for (const double upper : series.upper) {
            if (shows(panel.y, upper)) y.include(upper);
        }
    }
    bool bars = false;
    for (const PlotSample& sample : panel.samples) {
        bars = bars || sample.values.size() == 1;
        for (const double value : sample.values) {
            if (shows(panel.y, value)) y.include(value);
        }
        if (sample.reference && shows(panel.y, *sample.reference)) y.include(*sample.reference);
    }
    const Range x_range = axisRange(panel.x, x, false);
    const Range y_range = axisRange(panel.y, y, bars);
    PanelFrame frame{{panel.x.logarithmic, x_range.low, x_range.high, left, right},
                     {panel.y.logarithmic, y_range.low, y_range.high, bottom, top},
                     left,
                     top,
                     right,
                     bottom};
    if (!panel.equal_scales) return frame;
    const double px_per_unit = std::min((right - left) / (x_range.high - x_range.low),
                                        (bottom - top) / (y_range.high - y_range.low));
    const double spare_x = (right - left) - px_per_unit * (x_range.high - x_range.low);
    const double spare_y = (bottom - top) - px_per_unit * (y_range.high - y_range.low);
    frame.left = frame.x.begin_px = left + 0.5 * spare_x;
    frame.right = frame.x.end_px = right - 0.5 * spare_x;
    frame.top = frame.y.end_px = top + 0.5 * spare_y;
    frame.bottom = frame.y.begin_px = bottom - 0.5 * spare_y;
    return frame;
}

void drawAxes(Svg& svg, const PlotPanel& panel, const PanelFrame& f) {
    for (const Tick& tick : axisTicks(f.y, panel.y, 6)) {
        if (!f.y.holds(tick.value)) continue;
        svg.line(f.left, f.y.at(tick.value), f.right, f.y.at(tick.value), "grid");
        svg.text(f.left - 6, f.y.at(tick.value) + 4, tick.label, "tick", Anchor::End);
    }
    if (panel.samples.empty()) {
        const int most = std::max(2, static_cast<int>((f.right - f.left) / 64.0));
        for (const Tick& tick : axisTicks(f.x, panel.x, most)) {
            if (!f.x.holds(tick.value)) continue;
            svg.line(f.x.at(tick.value), f.top, f.x.at(tick.value), f.bottom, "grid");
            svg.text(f.x.at(tick.value), f.bottom + 16, tick.label, "tick", Anchor::Middle);
        }
    }
    svg.text(f.left, f.top - 10, panel.title, "panel");
    svg.text((f.left + f.right) / 2, f.bottom + 34, panel.x.label, "axis", Anchor::Middle);
    svg.text(f.left - kLeft_px + 14, (f.top + f.bottom) / 2, panel.y.label, "axis", Anchor::Middle, -90);
}

/// The part of the step between two points that lies within the frame, after Liang and Barsky 1984.
std::optional<std::pair<Pixel, Pixel>> clipped(Pixel from, Pixel to, const PanelFrame& f) {
    double enter = 0.0;
    double leave = 1.0;
    const double dx = to.first - from.first;
    const double dy = to.second - from.second;
    const auto cut = [&](double step, double room) {
        if (step == 0.0) return room >= 0.0;
        const double at = room / step;
        if (step < 0.0) {
            enter = std::max(enter, at);
        } else {
            leave = std::min(leave, at);
        }
        return enter <= leave;
    };
    if (!cut(-dx, from.first - f.left) || !cut(dx, f.right - from.first) || !cut(-dy, from.second - f.top) ||
        !cut(dy, f.bottom - from.second)) {
        return std::nullopt;
    }
    return std::pair{Pixel{from.first + enter * dx, from.second + enter * dy},
                     Pixel{from.first + leave * dx, from.second + leave * dy}};
}

void drawCurve(Svg& svg, const PlotPanel& panel, const PlotSeries& series, const PanelFrame& f, int colour) {
    const std::string css =
        fmt::format("{} s{}", series.look == SeriesLook::Dashed ? "dash" : "line", colour);
    std::vector<Pixel> line;
    Pixel last;
    bool connected = false;
    const auto flush = [&] {
        svg.polyline(line, css, series.name);
        line.clear();
    };
    for (const auto& [x, y] : series.points) {
        if (!shows(panel.x, x) || !shows(panel.y, y)) {
            flush();
            connected = false;
            continue;
        }
        const Pixel at{f.x.at(x), f.y.at(y)};
        if (connected) {
            if (const auto part = clipped(last, at, f)) {
                if (line.empty()) line.push_back(part->first);
                line.push_back(part->second);
                if (part->second != at) flush();
            } else {
                flush();
            }
        }
        last = at;
        connected = true;
    }
    flush();
}

/// A strip between two edges, in pieces where values are missing.
void drawRibbon(Svg& svg, const PlotPanel& panel, const PlotSeries& series, const PanelFrame& f, int colour) {
    std::vector<Pixel> lower, upper;
    const auto flush = [&] {
        if (lower.size() >= 2) {
            lower.insert(lower.end(), upper.rbegin(), upper.rend());
            svg.polygon(lower, fmt::format("ribbon f{}", colour), series.name);
        }
        lower.clear();
        upper.clear();
    };
    for (std::size_t i = 0; i < std::min(series.points.size(), series.upper.size()); ++i) {
        const auto& [x, low] = series.points[i];
        if (!shows(panel.x, x) || !shows(panel.y, low) || !shows(panel.y, series.upper[i])) {
            flush();
            continue;
        }
        lower.emplace_back(f.x.at(x), f.y.at(low));
        upper.emplace_back(f.x.at(x), f.y.at(series.upper[i]));
    }
    flush();
}

void drawSeries(Svg& svg, const PlotPanel& panel, const PanelFrame& f) {
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
        const PlotSeries& series = panel.series[i];
        const int colour = (series.colour >= 0 ? series.colour : static_cast<int>(i)) % kColours;
        if (series.look == SeriesLook::Ribbon) {
            drawRibbon(svg, panel, series, f, colour);
            continue;
        }
        if (series.look != SeriesLook::Points) {
            drawCurve(svg, panel, series, f, colour);
            continue;
        }
        for (const auto& [x, y] : series.points) {
            if (!shows(panel.x, x) || !shows(panel.y, y) || !f.x.holds(x) || !f.y.holds(y)) continue;
            svg.circle(f.x.at(x), f.y.at(y), 2.5, fmt::format("point f{}", colour));
        }
    }
}

void drawBox(Svg& svg, const BoxFigures& box, const Scale& y, double middle, double half, int colour) {
    svg.line(middle, y.at(box.low_whisker), middle, y.at(box.lower_quartile), "whisker");
    svg.line(middle, y.at(box.upper_quartile), middle, y.at(box.high_whisker), "whisker");
    for (const double end : {box.low_whisker, box.high_whisker}) {
        svg.line(middle - half / 2, y.at(end), middle + half / 2, y.at(end), "whisker");
    }
    svg.rectangle(middle - half, y.at(box.upper_quartile), 2 * half,
                  y.at(box.lower_quartile) - y.at(box.upper_quartile), fmt::format("box f{}", colour),
                  fmt::format("median {:.6g}, quartiles {:.6g} and {:.6g}", box.median, box.lower_quartile,
                              box.upper_quartile));
    svg.line(middle - half, y.at(box.median), middle + half, y.at(box.median), "median");
    for (const double value : box.outliers) {
        svg.circle(middle, y.at(value), 3, fmt::format("outlier s{}", colour), fmt::format("{:.6g}", value));
    }
}

void drawSamples(Svg& svg, const PlotPanel& panel, const PanelFrame& f) {
    if (panel.samples.empty()) return;
    const double slot = (f.right - f.left) / static_cast<double>(panel.samples.size());
    const double half = std::min(32.0, 0.3 * slot);
    double middle = f.left + 0.5 * slot;
    for (const PlotSample& sample : panel.samples) {
        std::vector<double> values;
        std::copy_if(sample.values.begin(), sample.values.end(), std::back_inserter(values),
                     [&](double v) { return shows(panel.y, v) && f.y.holds(v); });
        const int colour = sample.colour % kColours;
        if (values.size() == 1 && !f.y.logarithmic) {
            const double ground = f.y.holds(0.0) ? f.y.at(0.0) : f.bottom;
            const double tip = f.y.at(values.front());
            svg.rectangle(middle - half, std::min(ground, tip), 2 * half, std::abs(ground - tip),
                          fmt::format("box f{}", colour), fmt::format("{:.6g}", values.front()));
        } else if (!values.empty()) {
            drawBox(svg, boxFigures(values), f.y, middle, half, colour);
        }
        if (sample.reference && shows(panel.y, *sample.reference) && f.y.holds(*sample.reference)) {
            const double at = f.y.at(*sample.reference);
            svg.line(middle - 1.4 * half, at, middle + 1.4 * half, at, "reference");
        }
        // A name that is wider than its place is written aslant.
        const bool wide = textWidth(sample.name) > slot - 4.0;
        svg.text(middle, f.bottom + 16, sample.name, "tick", wide ? Anchor::End : Anchor::Middle,
                 wide ? -30.0 : 0.0);
        middle += slot;
    }
}

// ---------------------------------------------------------------------------------------------- page

struct KeyEntry {
    std::string name;
    SeriesLook look;
    int colour;
    bool reference;
};

/// The series of all panels, each name once.
std::vector<KeyEntry> keyEntries(const Plot& plot) {
    std::vector<KeyEntry> entries;
    for (const PlotPanel& panel : plot.panels) {
        for (std::size_t i = 0; i < panel.series.size(); ++i) {
            const PlotSeries& s = panel.series[i];
            const bool known = std::any_of(entries.begin(), entries.end(),
                                           [&](const KeyEntry& entry) { return entry.name == s.name; });
            if (s.name.empty() || known) continue;
            entries.push_back(
                {s.name, s.look, (s.colour >= 0 ? s.colour : static_cast<int>(i)) % kColours, false});
        }
    }
    if (!plot.reference.empty()) entries.push_back({plot.reference, SeriesLook::Dashed, 0, true});
    return entries;
}

/// Draws the key from (left, y) on; gives the height that it takes.
double drawKey(Svg* svg, const std::vector<KeyEntry>& entries, double left, double right, double y) {
    constexpr double kSymbol_px = 28.0;
    if (entries.empty()) return 0.0;
    double x = left;
    double height = kKeyRow_px;
    for (const KeyEntry& entry : entries) {
        const double width = kSymbol_px + textWidth(entry.name) + 20.0;
        if (x > left && x + width > right) {
            x = left;
            height += kKeyRow_px;
        }
        const double row = y + height - kKeyRow_px / 2;
        if (svg != nullptr) {
            if (entry.reference) {
                svg->line(x, row, x + 20, row, "reference");
            } else if (entry.look == SeriesLook::Ribbon) {
                svg->rectangle(x, row - 5, 20, 10, fmt::format("ribbon f{}", entry.colour));
            } else if (entry.look == SeriesLook::Points) {
                svg->circle(x + 10, row, 4, fmt::format("point f{}", entry.colour));
            } else {
                svg->line(
                    x, row, x + 20, row,
                    fmt::format("{} s{}", entry.look == SeriesLook::Dashed ? "dash" : "line", entry.colour));
            }
            svg->text(x + kSymbol_px, row + 4, entry.name, "key");
        }
        x += width;
    }
    return height;
}

}  // namespace

std::string plotSvg(const Plot& plot) {
    const auto columns = static_cast<std::size_t>(std::max(1, plot.columns));
    const std::size_t rows = (plot.panels.size() + columns - 1) / columns;
    const double panel_width = columns == 1 ? 800.0 : columns == 2 ? 480.0 : 360.0;
    const double panel_height = columns == 1 ? 440.0 : 360.0;
    const double width = 2 * kMargin_px + panel_width * static_cast<double>(columns);
    const std::vector<KeyEntry> entries = keyEntries(plot);
    const double key_height = drawKey(nullptr, entries, kMargin_px, width - kMargin_px, 0.0);
    const double header = kHeader_px + key_height;
    const double height = header + panel_height * static_cast<double>(rows) + kMargin_px / 2;

    Svg svg(width, height, plot.title);
    svg.rectangle(0, 0, width, height, "page");
    svg.text(kMargin_px, 30, plot.title, "title");
    svg.text(kMargin_px, 50, plot.note, "note");
    drawKey(&svg, entries, kMargin_px, width - kMargin_px, kHeader_px);
    for (std::size_t i = 0; i < plot.panels.size(); ++i) {
        const double left = kMargin_px + panel_width * static_cast<double>(i % columns);
        const double top = header + panel_height * static_cast<double>(i / columns);
        const PanelFrame frame = panelFrame(plot.panels[i], left + kLeft_px, top + kTop_px,
                                            left + panel_width - kRight_px, top + panel_height - kBottom_px);
        drawAxes(svg, plot.panels[i], frame);
        drawSeries(svg, plot.panels[i], frame);
        drawSamples(svg, plot.panels[i], frame);
        svg.rectangle(frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top, "frame");
    }
    return svg.file(kStyle);
}

}  // namespace terrawalk
