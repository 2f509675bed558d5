#include "io/report_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "io/markup_text.hpp"
#include "io/svg.hpp"

namespace terrawalk {

namespace {

using Pixel = std::pair<double, double>;

constexpr double kWidth_px = 960.0;
constexpr double kGlyph_px = 6.3;      // mean width of a character of the small type
constexpr double kWideGlyph_px = 7.2;  // of capitals and digits in a wide typeface

bool isShown(const Residual& residual, const AccuracyGroup& group) {
    return residual.stage == group.stage && residual.quantity == group.quantity &&
           !residual.used_by_estimator && std::isfinite(residual.difference_enu_m.z());
}

std::string signedMetres(double value_m) {
    return fmt::format("{}{} m", value_m >= 0.0005 ? "+" : "", fixedDecimals(value_m, 3));
}

// ---------------------------------------------------------------------------------------------- symbols

void symbol(Svg& svg, Stage stage, double x, double y, const std::string& tooltip) {
    constexpr double r = 4.0;
    switch (stage) {
        case Stage::BeforeFusion:
            svg.circle(x, y, r, "before", tooltip);
            break;
        case Stage::Fused:
            svg.polygon({{x, y - r - 1}, {x + r + 1, y}, {x, y + r + 1}, {x - r - 1, y}}, "fused", tooltip);
            break;
        case Stage::Surface:
            svg.rectangle(x - r, y - r, 2 * r, 2 * r, "surface", tooltip);
            break;
    }
}

/// A point beyond the frame, drawn at its edge and pointing outwards.
void beyond(Svg& svg, Stage stage, double x, double y, bool upwards, const std::string& tooltip) {
    const double s = upwards ? -1.0 : 1.0;
    const std::string css = stage == Stage::BeforeFusion ? "before"
                            : stage == Stage::Fused      ? "fused"
                                                         : "surface";
    svg.polygon({{x, y + 5 * s}, {x + 5, y - 4 * s}, {x - 5, y - 4 * s}}, css, tooltip);
}

void markSymbol(Svg& svg, MarkRole role, double x, double y, const std::string& tooltip) {
    if (role == MarkRole::Check) {
        svg.circle(x, y, 3.5, "mark", tooltip);
    } else {
        svg.polygon({{x, y - 5}, {x + 5, y + 4}, {x - 5, y + 4}}, "mark", tooltip);
    }
}

// ---------------------------------------------------------------------------------------------- map

struct Box {
    double left, top, right, bottom;
    [[nodiscard]] bool overlaps(const Box& o) const {
        return left < o.right && o.left < right && top < o.bottom && o.top < bottom;
    }
    [[nodiscard]] bool contains(const Box& o) const {
        return left <= o.left && right >= o.right && top <= o.top && bottom >= o.bottom;
    }
};

/// What the map shows and where: one scale for both axes.
struct MapFrame {
    Box frame{};  // pixels
    double west_m = 0.0, north_m = 0.0, px_per_m = 1.0;
    [[nodiscard]] double x(double e_m) const { return frame.left + (e_m - west_m) * px_per_m; }
    [[nodiscard]] double y(double n_m) const { return frame.top + (north_m - n_m) * px_per_m; }
    [[nodiscard]] double east_m() const { return west_m + (frame.right - frame.left) / px_per_m; }
    [[nodiscard]] double south_m() const { return north_m - (frame.bottom - frame.top) / px_per_m; }
};

std::optional<MapFrame> mapFrame(const SurveyReport& report) {
    constexpr double kTop = 56.0, kLeft = 64.0, kRight = 16.0, kHighest = 640.0, kLowest = 240.0,
                     kMargin = 24.0;
    constexpr double kLeastExtent_m = 5.0;
    Eigen::Vector2d low = Eigen::Vector2d::Constant(HUGE_VAL), high = -low;
    const auto include = [&](const Eigen::Vector3d& enu_m) {
        if (!enu_m.head<2>().allFinite()) return;
        low = low.cwiseMin(enu_m.head<2>());
        high = high.cwiseMax(enu_m.head<2>());
    };
    for (const RunReport& run : report.runs) {
        for (const Eigen::Vector3d& position : run.track_enu_m) include(position);
    }
    for (const ControlMark& mark : report.marks) include(mark.enu_m);
    if (!(high.x() >= low.x())) return std::nullopt;

    const Eigen::Vector2d middle = 0.5 * (low + high);
    const Eigen::Vector2d extent = (high - low).cwiseMax(kLeastExtent_m);
    const double width = kWidth_px - kLeft - kRight;
    MapFrame map;
    const double height =
        std::clamp((width - 2 * kMargin) * extent.y() / extent.x() + 2 * kMargin, kLowest, kHighest);
    map.frame = {kLeft, kTop, kLeft + width, kTop + height};
    map.px_per_m = std::min((width - 2 * kMargin) / extent.x(), (height - 2 * kMargin) / extent.y());
    map.west_m = middle.x() - 0.5 * width / map.px_per_m;
    map.north_m = middle.y() + 0.5 * height / map.px_per_m;
    return map;
}

/// The surface below everything else, and its height ramp below the map.
void drawRelief(Svg& svg, const SurveyReport& report, const MapFrame& map) {
    if (!report.relief) return;
    const ReliefPicture& r = *report.relief;
    svg.image(map.x(r.west_m), map.y(r.north_m), r.width_m * map.px_per_m, r.height_m * map.px_per_m, r.png);
    constexpr double kRampWidth_px = 120.0, kRampHeight_px = 8.0;
    const double y = map.frame.bottom + 28;
    const std::string lowest = fmt::format("{} m", fixedDecimals(r.lowest_m, 1));
    const double x = map.frame.left + kGlyph_px * static_cast<double>(characterCount(lowest)) + 16;
    svg.text(map.frame.left, y + 8, lowest, "tick");
    svg.image(x, y, kRampWidth_px, kRampHeight_px, r.ramp_png);
    svg.text(x + kRampWidth_px + 8, y + 8,
             fmt::format("{} m, height of the surface", fixedDecimals(r.highest_m, 1)), "tick");
}

void drawMapGrid(Svg& svg, const MapFrame& map) {
    const Box& f = map.frame;
    // One step for both axes keeps the grid square.
    const double step = niceTicks(map.west_m, map.east_m(), 8).step;
    const auto ticks = [&](double low, double high) {
        return niceTicks(low, high, std::max(1, static_cast<int>(std::ceil((high - low) / step))));
    };
    const Ticks east = ticks(map.west_m, map.east_m()), north = ticks(map.south_m(), map.north_m);
    for (const double e_m : east.values) {
        svg.line(map.x(e_m), f.top, map.x(e_m), f.bottom, "grid");
        svg.text(map.x(e_m), f.bottom + 18, fixedDecimals(e_m, east.decimals), "tick", Anchor::Middle);
    }
    for (const double n_m : north.values) {
        svg.line(f.left, map.y(n_m), f.right, map.y(n_m), "grid");
        svg.text(f.left - 8, map.y(n_m) + 4, fixedDecimals(n_m, north.decimals), "tick", Anchor::End);
    }
    svg.rectangle(f.left, f.top, f.right - f.left, f.bottom - f.top, "frame");
    svg.text(f.right, f.bottom + 36, "east of the zero point [m]", "tick", Anchor::End);
    svg.text(14, f.top, "north of the zero point [m]", "tick", Anchor::End, -90);
}

void drawTracks(Svg& svg, const SurveyReport& report, const MapFrame& map) {
    const std::vector<std::string> classes = trackClasses(report);
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        const RunReport& run = report.runs[i];
        const std::string css = fmt::format("track {}", classes[i]);
        std::vector<Pixel> line;
        for (const Eigen::Vector3d& position : run.track_enu_m) {
            if (!position.head<2>().allFinite()) {
                svg.polyline(line, css, run.id);
                line.clear();
                continue;
            }
            const Pixel at{map.x(position.x()), map.y(position.y())};
            // Steps that nobody can see only make the page heavy.
            if (line.empty() ||
                std::hypot(at.first - line.back().first, at.second - line.back().second) >= 0.7) {
                line.push_back(at);
            }
        }
        svg.polyline(line, css, run.id);
    }
}

/// Mean height error of each mark that the shown group compares.
std::map<std::string, double> heightErrors(const SurveyReport& report, const AccuracyGroup* group) {
    std::map<std::string, std::pair<double, double>> sums;
    for (const Residual& residual : report.residuals) {
        if (group == nullptr || !isShown(residual, *group)) continue;
        auto& [sum, count] = sums[residual.mark];
        sum += residual.difference_enu_m.z();
        count += 1.0;
    }
    std::map<std::string, double> means;
    for (const auto& [mark, sum] : sums) means[mark] = sum.first / sum.second;
    return means;
}

/// Pixels for each metre of height error: nine tenths of the bars stay below 32 pixels, the rest is cut
/// at 48.
struct BarScale {
    static constexpr double kUsual_px = 32.0, kLongest_px = 48.0;
    double px_per_m = 0.0;
    double key_m = 0.0;
    bool cuts = false;
    [[nodiscard]] double length(double error_m) const {
        return std::clamp(error_m * px_per_m, -kLongest_px, kLongest_px);
    }
};

BarScale barScale(const std::map<std::string, double>& errors) {
    std::vector<double> magnitudes;
    for (const auto& [mark, error_m] : errors) magnitudes.push_back(std::abs(error_m));
    std::sort(magnitudes.begin(), magnitudes.end());
    BarScale scale;
    if (magnitudes.empty()) return scale;
    const double usual_m = std::max(magnitudes[magnitudes.size() * 9 / 10], 1e-4);
    scale.px_per_m = BarScale::kUsual_px / usual_m;
    scale.key_m = niceStep(0.5 * usual_m);
    scale.cuts = magnitudes.back() * scale.px_per_m > BarScale::kLongest_px;
    return scale;
}

/// Puts each name at the first free place around its mark; names that find none are left to the tooltips.
class LabelPlacer {
  public:
    explicit LabelPlacer(const Box& frame) : frame_(frame) {}
    void block(const Box& box) { taken_.push_back(box); }
    /// Lower left corner of the text.
    std::optional<Pixel> place(double x, double y, std::string_view words) {
        const double w = kWideGlyph_px * static_cast<double>(characterCount(words)), h = 11.0;
        const std::array<Pixel, 6> corners{Pixel{x + 7, y + 4}, {x - 7 - w, y + 4}, {x + 6, y + 15},
                                           {x - w / 2, y + 17}, {x + 6, y - 7},     {x - 6 - w, y + 15}};
        for (const auto& [left, bottom] : corners) {
            // With the halo of the letters.
            const Box box{left - 1, bottom - h, left + w + 1, bottom + 2};
            const bool free = std::none_of(taken_.begin(), taken_.end(),
                                           [&](const Box& other) { return box.overlaps(other); });
            if (!free || !frame_.contains(box)) continue;
            taken_.push_back(box);
            return Pixel{left, bottom};
        }
        return std::nullopt;
    }

  private:
    Box frame_;
    std::vector<Box> taken_;
};

std::size_t drawMarks(Svg& svg, const SurveyReport& report, const MapFrame& map,
                      const std::map<std::string, double>& errors, const BarScale& scale) {
    LabelPlacer placer(map.frame);
    for (const ControlMark& mark : report.marks) {
        if (!mark.enu_m.head<2>().allFinite()) continue;
        const double x = map.x(mark.enu_m.x()), y = map.y(mark.enu_m.y());
        std::string tooltip = fmt::format("{} ({})", mark.name, name(mark.role));
        placer.block({x - 5, y - 5, x + 5, y + 5});
        if (const auto error = errors.find(mark.name); error != errors.end()) {
            const double top = y - std::max(scale.length(error->second), 0.0);
            const double height = std::abs(scale.length(error->second));
            tooltip += ": " + signedMetres(error->second);
            svg.rectangle(x - 2.5, top, 5, height, error->second > 0.0 ? "high" : "low", tooltip);
            placer.block({x - 5, top - 1, x + 5, top + height + 1});
        }
        markSymbol(svg, mark.role, x, y, tooltip);
    }
    std::size_t unnamed = 0;
    for (const ControlMark& mark : report.marks) {
        if (!mark.enu_m.head<2>().allFinite()) continue;
        const std::string words = shortened(mark.name, 16);
        if (const auto at = placer.place(map.x(mark.enu_m.x()), map.y(mark.enu_m.y()), words)) {
            svg.name(at->first, at->second, words, "label");
        } else {
            ++unnamed;
        }
    }
    return unnamed;
}

void drawMapKey(Svg& svg, const SurveyReport& report, const MapFrame& map, const BarScale& scale,
                std::size_t unnamed) {
    constexpr double y = 28.0;
    double x = map.frame.left;
    const auto entry = [&](const std::string& words, double symbol_px) {
        svg.text(x + symbol_px, y + 4, words, "key");
        x += symbol_px + kGlyph_px * static_cast<double>(characterCount(words)) + 20;
    };
    for (const MarkRole role : {MarkRole::Check, MarkRole::Control}) {
        if (std::none_of(report.marks.begin(), report.marks.end(),
                         [&](const auto& m) { return m.role == role; })) {
            continue;
        }
        markSymbol(svg, role, x + 5, y, {});
        entry(fmt::format("{} mark", name(role)), 16);
    }
    if (scale.px_per_m > 0.0) {
        const double bar_px = scale.key_m * scale.px_per_m;
        svg.rectangle(x, y + 6 - bar_px, 5, bar_px, "high");
        svg.rectangle(x + 8, y + 6 - bar_px, 5, bar_px, "low");
        entry(fmt::format("{:g} m too high, too low{}", scale.key_m, scale.cuts ? " (longest cut)" : ""), 20);
    }
    if (unnamed > 0)
        entry(fmt::format("{} left out for room", unnamed == 1 ? "1 name" : fmt::format("{} names", unnamed)),
              0);

    const double north_x = map.frame.right - 10;
    svg.polygon({{north_x, y - 22}, {north_x + 6, y + 8}, {north_x, y + 3}, {north_x - 6, y + 8}}, "ink");
    svg.text(north_x - 12, y - 10, "N", "key", Anchor::End);
    const double length_m = niceStep(60.0 / map.px_per_m);
    const double bar_right = north_x - 36, bar_left = bar_right - length_m * map.px_per_m;
    svg.rectangle(bar_left, y + 2, bar_right - bar_left, 4, "ink");
    svg.text((bar_left + bar_right) / 2, y - 4, fmt::format("{:g} m", length_m), "key", Anchor::Middle);
}

// ---------------------------------------------------------------------------------------------- plots by
// mark

/// What one column of a plot by mark shows: a name below and values by stage.
struct Column {
    std::string label;
    MarkRole role = MarkRole::Check;
    std::map<Stage, double> values;
};

/// Half the height of a plot [m]. Errors before fusion may dwarf the rest; then they are cut rather than it
/// flattened.
double plotRange_m(double greatest_m, double greatest_after_fusion_m) {
    const bool dwarfed = greatest_after_fusion_m > 0.0 && greatest_m > 10.0 * greatest_after_fusion_m;
    return 1.08 * std::max(1e-3, dwarfed ? 4.0 * greatest_after_fusion_m : greatest_m);
}

double plotRange_m(const std::vector<Column>& columns) {
    double all = 0.0, after = 0.0;
    for (const Column& column : columns) {
        for (const auto& [stage, value] : column.values) {
            all = std::max(all, std::abs(value));
            if (stage != Stage::BeforeFusion) after = std::max(after, std::abs(value));
        }
    }
    return plotRange_m(all, after);
}

/// Names the symbols that a plot shows, from left to right.
void drawStageKey(Svg& svg, const std::set<Stage>& stages, double x, double y) {
    for (const Stage stage : stages) {
        symbol(svg, stage, x + 6, y - 4, {});
        svg.text(x + 18, y, name(stage), "key");
        x += 42 + kGlyph_px * static_cast<double>(name(stage).size());
    }
}

/// Where things stand in a plot by mark. One column for each comparison, heights around zero.
struct MarkPlot {
    static constexpr double kLeft = 64.0, kRight = 16.0, kTop = 48.0, kHeight = 240.0, kWidestColumn = 56.0;
    static constexpr std::size_t kLabelCharacters = 14;
    double column_px, width, right, bottom = kTop + kHeight;
    double range_m;

    explicit MarkPlot(const std::vector<Column>& columns)
        : column_px(
              std::min(kWidestColumn, (kWidth_px - kLeft - kRight) / static_cast<double>(columns.size()))),
          width(std::max(kLeft + kRight + column_px * static_cast<double>(columns.size()), 480.0)),
          right(width - kRight),
          range_m(plotRange_m(columns)) {}
    [[nodiscard]] double x(std::size_t column) const {
        return kLeft + column_px * (static_cast<double>(column) + 0.5);
    }
    /// Stages stand side by side where there is room, so that equal values stay visible.
    [[nodiscard]] double offset(Stage stage) const {
        const double step = column_px < 9.0 ? 0.0 : std::min(0.25 * column_px, 9.0);
        return step * (static_cast<double>(stage) - 1.0);
    }
    [[nodiscard]] double y(double value_m) const { return kTop + kHeight * 0.5 * (1.0 - value_m / range_m); }
};

void drawMarkAxes(Svg& svg, const MarkPlot& plot, const std::vector<Column>& columns) {
    const Ticks ticks = niceTicks(-plot.range_m, plot.range_m, 8);
    for (const double value : ticks.values) {
        svg.line(plot.kLeft, plot.y(value), plot.right, plot.y(value), value == 0.0 ? "zero" : "grid");
        svg.text(plot.kLeft - 8, plot.y(value) + 4, fixedDecimals(value, ticks.decimals), "tick",
                 Anchor::End);
    }
    svg.text(14, plot.kTop, "product \u2212 mark [m]", "tick", Anchor::End, -90);
    const auto label_every = static_cast<std::size_t>(std::ceil(13.0 / plot.column_px));
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (i % label_every == 0) {
            svg.name(plot.x(i) + 4, plot.bottom + 8, shortened(columns[i].label, plot.kLabelCharacters),
                     "tick", Anchor::End, -90);
        }
        if (i > 0 && columns[i - 1].role != columns[i].role) {
            const double x = plot.x(i) - plot.column_px / 2;
            const bool room = plot.right - x > 100.0;
            svg.line(x, plot.kTop - 12, x, plot.bottom, "divide");
            svg.text(room ? x + 6 : x - 6, plot.kTop - 4, room ? "control marks" : "control marks \u2192",
                     "key", room ? Anchor::Start : Anchor::End);
        }
    }
}

std::string plotByMark(const std::vector<Column>& columns, std::string_view label) {
    if (columns.empty()) return {};
    const MarkPlot plot(columns);
    std::size_t longest = 0;
    for (const Column& column : columns) {
        longest = std::max(longest, characterCount(shortened(column.label, plot.kLabelCharacters)));
    }
    Svg svg(plot.width, plot.bottom + 16 + kGlyph_px * static_cast<double>(longest), label);
    drawMarkAxes(svg, plot, columns);
    std::set<Stage> stages;
    std::size_t cut = 0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        for (const auto& [stage, value] : columns[i].values) {
            stages.insert(stage);
            const std::string tooltip =
                fmt::format("{}, {}: {}", columns[i].label, name(stage), signedMetres(value));
            const double x = plot.x(i) + plot.offset(stage);
            if (std::abs(value) <= plot.range_m) {
                symbol(svg, stage, x, plot.y(value), tooltip);
            } else {
                ++cut;
                beyond(svg, stage, x, value > 0.0 ? plot.kTop + 6 : plot.bottom - 6, value > 0.0, tooltip);
            }
        }
    }
    drawStageKey(svg, stages, plot.kLeft, 24);
    if (cut > 0) svg.text(plot.right, 24, fmt::format("{} beyond the frame \u25B3", cut), "key", Anchor::End);
    return svg.str();
}

void sortByRole(std::vector<Column>& columns) {
    std::stable_sort(columns.begin(), columns.end(), [](const Column& a, const Column& b) {
        return a.role == MarkRole::Check && b.role == MarkRole::Control;
    });
}

// ---------------------------------------------------------------------------------------------- histogram

struct Histogram {
    double first_m = 0.0, width_m = 1.0;
    std::vector<std::size_t> counts;
};

/// Bins of a round width after Freedman and Diaconis, from 5 to 40 of them.
Histogram histogram(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    const double quartiles = values[3 * n / 4] - values[n / 4];
    const double extent = std::max(values.back() - values.front(), 1e-3);
    const double wanted = 2.0 * quartiles / std::cbrt(static_cast<double>(n));
    Histogram h;
    h.width_m = niceStep(std::clamp(wanted, extent / 38.0, extent / 5.0) * 0.75);
    const double first = std::floor(values.front() / h.width_m);
    h.first_m = first * h.width_m;
    for (const double value : values) {
        const auto bin = static_cast<std::size_t>(std::max(0.0, std::floor(value / h.width_m) - first));
        if (bin >= h.counts.size()) h.counts.resize(bin + 1);
        ++h.counts[bin];
    }
    return h;
}

double normalDensity(double x, double mean, double sd) {
    const double z = (x - mean) / sd;
    return std::exp(-0.5 * z * z) / (sd * std::sqrt(2.0 * kPi));
}

}  // namespace

const AccuracyGroup* shownHeights(const SurveyReport& report) {
    if (report.headline && *report.headline < report.accuracy.size())
        return &report.accuracy[*report.headline];
    const auto last = std::find_if(report.accuracy.rbegin(), report.accuracy.rend(),
                                   [](const AccuracyGroup& group) { return group.up.has_value(); });
    return last == report.accuracy.rend() ? nullptr : &*last;
}

std::vector<std::string> trackClasses(const SurveyReport& report) {
    constexpr std::size_t kColours = 6, kDashes = 3;
    std::vector<std::string> classes(report.runs.size());
    std::size_t next = 0;
    for (const RunKind kind : {RunKind::Area, RunKind::FixedPoint}) {
        for (std::size_t i = 0; i < report.runs.size(); ++i) {
            if (report.runs[i].kind != kind) continue;
            classes[i] = fmt::format("c{} d{}", next % kColours, next / kColours % kDashes);
            ++next;
        }
    }
    return classes;
}

std::string surveyMap(const SurveyReport& report) {
    const std::optional<MapFrame> map = mapFrame(report);
    if (!map) return {};
    Svg svg(kWidth_px, map->frame.bottom + 44, "Map of tracks and marks");
    drawRelief(svg, report, *map);
    drawMapGrid(svg, *map);
    drawTracks(svg, report, *map);
    const auto errors = heightErrors(report, shownHeights(report));
    const BarScale scale = barScale(errors);
    const std::size_t unnamed = drawMarks(svg, report, *map, errors, scale);
    drawMapKey(svg, report, *map, scale, unnamed);
    return svg.str();
}

Quantity plottedHeights(const SurveyReport& report) {
    const bool has_surface =
        std::any_of(report.residuals.begin(), report.residuals.end(),
                    [](const Residual& r) { return r.quantity == Quantity::SurfaceHeight; });
    return has_surface ? Quantity::SurfaceHeight : Quantity::NearestSample;
}

std::string heightErrorPlot(const SurveyReport& report) {
    const Quantity quantity = plottedHeights(report);
    std::vector<Column> columns;
    for (const ControlMark& mark : report.marks) {
        Column column{mark.name, mark.role, {}};
        for (const Residual& r : report.residuals) {
            if (r.mark != mark.name || r.quantity != quantity || r.used_by_estimator) continue;
            if (std::isfinite(r.difference_enu_m.z())) column.values[r.stage] = r.difference_enu_m.z();
        }
        if (!column.values.empty()) columns.push_back(std::move(column));
    }
    sortByRole(columns);
    return plotByMark(columns, "Height error at each mark");
}

std::string standErrorPlot(const SurveyReport& report) {
    std::vector<Column> columns;
    for (const Residual& r : report.residuals) {
        if (r.quantity != Quantity::ArrayPosition || r.used_by_estimator) continue;
        if (!std::isfinite(r.difference_enu_m.z())) continue;
        const std::string label = r.run + " " + r.mark;
        auto column = std::find_if(columns.begin(), columns.end(), [&](const Column& c) {
            return c.label == label && !c.values.contains(r.stage);
        });
        if (column == columns.end()) column = columns.insert(columns.end(), Column{label, r.role, {}});
        column->values[r.stage] = r.difference_enu_m.z();
    }
    sortByRole(columns);
    return plotByMark(columns, "Height error below the array at each stand on a mark");
}

std::string planErrorPlot(const SurveyReport& report) {
    struct PlanError {
        Stage stage;
        Eigen::Vector2d d;
        std::string words;
    };
    std::vector<PlanError> errors;
    double all = 0.0, after = 0.0;
    for (const Residual& r : report.residuals) {
        if (r.quantity != Quantity::ArrayPosition || r.used_by_estimator) continue;
        const Eigen::Vector2d d = r.difference_enu_m.head<2>();
        if (!d.allFinite()) continue;
        errors.push_back({r.stage, d,
                          fmt::format("{} {}, {}: {} east, {} north", r.run, r.mark, name(r.stage),
                                      signedMetres(d.x()), signedMetres(d.y()))});
        all = std::max(all, d.norm());
        if (r.stage != Stage::BeforeFusion) after = std::max(after, d.norm());
    }
    if (errors.empty()) return {};
    constexpr double kSize = 448.0, kTop = 40.0, kRadius = 160.0;
    constexpr double centre_x = kSize / 2, centre_y = kTop + kRadius + 12;
    const double range = plotRange_m(all, after);
    const double px_per_m = kRadius / range;
    Svg svg(kSize, centre_y + kRadius + 32, "Error in plan at each stand on a mark");
    const Ticks rings = niceTicks(0.0, range, 4);
    for (const double radius : rings.values) {
        if (radius == 0.0) continue;
        svg.circle(centre_x, centre_y, radius * px_per_m, "ring");
        svg.text(centre_x + 4, centre_y - radius * px_per_m - 3, fixedDecimals(radius, rings.decimals) + " m",
                 "tick");
    }
    svg.line(centre_x - kRadius, centre_y, centre_x + kRadius, centre_y, "zero");
    svg.line(centre_x, centre_y - kRadius, centre_x, centre_y + kRadius, "zero");
    svg.text(centre_x + kRadius + 6, centre_y + 4, "E", "key");
    svg.text(centre_x - 10, centre_y - kRadius - 4, "N", "key");
    std::set<Stage> stages;
    std::size_t cut = 0;
    for (const PlanError& error : errors) {
        stages.insert(error.stage);
        Eigen::Vector2d d = error.d * px_per_m;
        if (d.norm() > kRadius) {
            ++cut;
            d *= (kRadius + 4) / d.norm();
        }
        symbol(svg, error.stage, centre_x + d.x(), centre_y - d.y(), error.words);
    }
    drawStageKey(svg, stages, 8, 20);
    if (cut > 0) {
        svg.text(kSize / 2, centre_y + kRadius + 26,
                 fmt::format("{} beyond the last ring, drawn at the rim", cut), "key", Anchor::Middle);
    }
    return svg.str();
}

std::string heightHistogram(const SurveyReport& report) {
    constexpr std::size_t kLeastValues = 5;
    constexpr double kWidth = 448.0, kLeft = 40.0, kRight = 16.0, kTop = 40.0, kPlot = 320.0;
    const AccuracyGroup* group = shownHeights(report);
    if (group == nullptr || group->up->n < kLeastValues) return {};
    std::vector<double> values;
    for (const Residual& r : report.residuals) {
        if (isShown(r, *group) && r.role == group->role) values.push_back(r.difference_enu_m.z());
    }
    if (values.size() < kLeastValues) return {};
    const ErrorStatistics& up = *group->up;
    const double n = static_cast<double>(values.size());
    const Histogram h = histogram(std::move(values));

    const double last_m = h.first_m + h.width_m * static_cast<double>(h.counts.size());
    const double low_m = std::min(h.first_m, 0.0) - h.width_m, high_m = std::max(last_m, 0.0) + h.width_m;
    const bool curve = up.sd_m && *up.sd_m > 0.0;
    const auto expected = [&](double x_m) {
        return n * h.width_m * normalDensity(x_m, up.mean_m, *up.sd_m);
    };
    double tallest = static_cast<double>(*std::max_element(h.counts.begin(), h.counts.end()));
    if (curve) tallest = std::max(tallest, expected(up.mean_m));
    tallest *= 1.08;
    const auto x_of = [&](double x_m) {
        return kLeft + (kWidth - kLeft - kRight) * (x_m - low_m) / (high_m - low_m);
    };
    const double bottom = kTop + kPlot;
    const auto y_of = [&](double count) {
        return bottom - kPlot * count / tallest;
    };

    Svg svg(kWidth, bottom + 44, "Histogram of height errors");
    const Ticks counts = niceTicks(0.0, tallest, 6);
    for (const double count : counts.values) {
        if (counts.step < 1.0 && count != std::floor(count)) continue;
        svg.line(kLeft, y_of(count), kWidth - kRight, y_of(count), "grid");
        svg.text(kLeft - 8, y_of(count) + 4, fixedDecimals(count, 0), "tick", Anchor::End);
    }
    for (std::size_t i = 0; i < h.counts.size(); ++i) {
        if (h.counts[i] == 0) continue;
        const double from_m = h.first_m + h.width_m * static_cast<double>(i);
        const auto count = static_cast<double>(h.counts[i]);
        svg.rectangle(x_of(from_m) + 0.5, y_of(count), x_of(from_m + h.width_m) - x_of(from_m) - 1,
                      bottom - y_of(count), "bar",
                      fmt::format("{} to {} m: {}", fixedDecimals(from_m, 3),
                                  fixedDecimals(from_m + h.width_m, 3), h.counts[i]));
    }
    if (curve) {
        std::vector<Pixel> line;
        for (int i = 0; i <= 120; ++i) {
            const double x_m = low_m + (high_m - low_m) * i / 120.0;
            line.emplace_back(x_of(x_m), y_of(expected(x_m)));
        }
        svg.polyline(line, "curve");
    }
    svg.line(x_of(0.0), kTop, x_of(0.0), bottom, "zero");
    svg.line(kLeft, bottom, kWidth - kRight, bottom, "frame");
    const Ticks metres = niceTicks(low_m, high_m, 7);
    for (const double value : metres.values) {
        svg.line(x_of(value), bottom, x_of(value), bottom + 4, "frame");
        svg.text(x_of(value), bottom + 18, fixedDecimals(value, metres.decimals), "tick", Anchor::Middle);
    }
    svg.text(kWidth - kRight, bottom + 36, "product \u2212 mark [m]", "tick", Anchor::End);
    svg.text(kLeft, 20,
             fmt::format("{} heights at {} marks{}", groupedDigits(up.n), name(group->role),
                         curve ? "; normal curve of the same mean and SD" : ""),
             "key");
    return svg.str();
}

}  // namespace terrawalk
