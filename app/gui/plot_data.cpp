#include "app/gui/plot_data.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "app/gui/figures.hpp"
#include "app/gui/fix_classes.hpp"
#include "app/gui/language.hpp"
#include "app/gui/report_words.hpp"

namespace terrawalk::gui {

namespace {

constexpr double kBand95 = 1.96;
// A step of more than that many usual ones is a gap, as the report counts them.
constexpr double kGapSteps = 2.5;
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostGnssDots = 200'000;

QString text(std::string_view utf8) {
    return QString::fromUtf8(utf8.data(), static_cast<qsizetype>(utf8.size()));
}

double medianOf(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Puts a break into a line wherever its values stay away for longer than they usually do.
void breakAtGaps(PlotSeries& series) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < series.x.size(); ++i) steps.push_back(series.x[i] - series.x[i - 1]);
    const double longest = kGapSteps * medianOf(std::move(steps));
    PlotSeries broken = series;
    broken.x.clear();
    broken.y.clear();
    broken.half_band.clear();
    const bool band = !series.half_band.empty();
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        if (i > 0 && series.x[i] - series.x[i - 1] > longest) {
            broken.x.push_back((series.x[i] + series.x[i - 1]) / 2.0);
            broken.y.push_back(kNoNumber);
            if (band) broken.half_band.push_back(kNoNumber);
        }
        broken.x.push_back(series.x[i]);
        broken.y.push_back(series.y[i]);
        if (band) broken.half_band.push_back(series.half_band[i]);
    }
    series = std::move(broken);
}

/// What a sensor gave, over time. Epochs without a reading are no gap where the sensor is merely slower.
PlotSeries channelSeries(const ArrayLog& log, Channel channel, const QString& name, SeriesInk ink,
                         double factor = 1.0) {
    PlotSeries series{name, SeriesStyle::Line, ink, {}, {}, {}};
    if (!log.has(channel)) return series;
    const std::vector<double>& column = log.column(channel);
    for (std::size_t i = 0; i < column.size(); ++i) {
        if (!present(column[i])) continue;
        series.x.push_back(log.time_s[i]);
        series.y.push_back(column[i] * factor);
    }
    breakAtGaps(series);
    return series;
}

struct ChannelLine {
    Channel channel;
    const char* name;
    double factor = 1.0;
};

/// A panel with those of some channels that the log has.
void addChannels(Plot& plot, const ArrayLog& log, const QString& label, const QString& unit, int decimals,
                 std::initializer_list<ChannelLine> channels) {
    PlotPanel panel{label, unit, decimals, {}, false};
    for (const ChannelLine& line : channels) {
        auto series = channelSeries(log, line.channel, QCoreApplication::translate("PlotData", line.name),
                                    static_cast<SeriesInk>(panel.series.size()), line.factor);
        if (!series.x.empty()) panel.series.push_back(std::move(series));
    }
    if (!panel.series.empty()) plot.panels.push_back(std::move(panel));
}

// Readings of nothing, as far away as the range finder has digits for, would press the others flat.
void keepInSight(Plot& plot) {
    constexpr double kShare = 0.95;
    constexpr double kFarther = 3.0;
    PlotPanel& panel = plot.panels.back();
    std::vector<double> values;
    for (const double y : panel.series.front().y) {
        if (present(y)) values.push_back(y);
    }
    std::sort(values.begin(), values.end());
    const double limit =
        kFarther * values[static_cast<std::size_t>(kShare * static_cast<double>(values.size() - 1))];
    const auto beyond = values.end() - std::upper_bound(values.begin(), values.end(), limit);
    if (beyond == 0 || limit <= 0.0) return;
    panel.highest = limit;
    plot.note = QCoreApplication::translate("PlotData", "%1 readings lie above the picture, up to %2.")
                    .arg(beyond)
                    .arg(lengthText(values.back(), 1));
}

// The worst fix lies lowest; codes that have no name are below it.
void addFixes(Plot& plot, const ArrayLog& log) {
    PlotPanel panel{QCoreApplication::translate("PlotData", "GNSS fix"), {}, 0, {}, false};
    panel.value_names << QCoreApplication::translate("PlotData", "other");
    for (auto c = kFixClasses.rbegin(); c != kFixClasses.rend(); ++c) panel.value_names << c->words();
    auto series =
        channelSeries(log, Channel::Fix, QCoreApplication::translate("PlotData", "Fix"), SeriesInk::First);
    for (double& y : series.y) {
        if (!present(y)) continue;
        const auto place = std::find_if(kFixClasses.begin(), kFixClasses.end(),
                                        [y](const FixClass& c) { return c.code == std::lround(y); });
        y = static_cast<double>(kFixClasses.end() - place);
    }
    if (series.x.empty()) return;
    panel.series.push_back(std::move(series));
    plot.panels.push_back(std::move(panel));
}

constexpr double kDegrees = 180.0 / kPi;

Plot sensorPlot(PlotKind kind, const Run& run) {
    Plot plot;
    const ArrayLog& log = run.log;
    switch (kind) {
        case PlotKind::GnssPosition:
            addFixes(plot, log);
            addChannels(plot, log, QCoreApplication::translate("PlotData", "Ellipsoidal height"), "m", 2,
                        {{Channel::EllipsoidalHeight, QT_TRANSLATE_NOOP("PlotData", "Height")}});
            addChannels(plot, log, QCoreApplication::translate("PlotData", "Accuracy"), "m", 2,
                        {{Channel::GnssHorizontalAccuracy, QT_TRANSLATE_NOOP("PlotData", "Plan")},
                         {Channel::GnssVerticalAccuracy, QT_TRANSLATE_NOOP("PlotData", "Height")}});
            break;
        case PlotKind::GnssVelocity:
            addChannels(plot, log, QCoreApplication::translate("PlotData", "GNSS velocity"), "m/s", 2,
                        {{Channel::GnssVelocityEast, QT_TRANSLATE_NOOP("PlotData", "East")},
                         {Channel::GnssVelocityNorth, QT_TRANSLATE_NOOP("PlotData", "North")},
                         {Channel::GnssVelocityUp, QT_TRANSLATE_NOOP("PlotData", "Up")}});
            break;
        case PlotKind::Barometer:
            addChannels(plot, log, QCoreApplication::translate("PlotData", "Pressure"), "hPa", 2,
                        {{Channel::Pressure, QT_TRANSLATE_NOOP("PlotData", "Pressure"), 0.01}});
            addChannels(plot, log, QCoreApplication::translate("PlotData", "Temperature"), "°C", 1,
                        {{Channel::Temperature, QT_TRANSLATE_NOOP("PlotData", "Temperature")}});
            break;
        case PlotKind::OpticalFlow:
            addChannels(plot, log, QCoreApplication::translate("PlotData", "Optical flow"), "m/s", 2,
                        {{Channel::FlowForward, QT_TRANSLATE_NOOP("PlotData", "Forward")},
                         {Channel::FlowLeft, QT_TRANSLATE_NOOP("PlotData", "Left")}});
            addChannels(plot, log, QCoreApplication::translate("PlotData", "Quality"), {}, 0,
                        {{Channel::FlowQuality, QT_TRANSLATE_NOOP("PlotData", "Quality")}});
            break;
        case PlotKind::Attitude:
            addChannels(plot, log, QCoreApplication::translate("PlotData", "Tilt"), "°", 1,
                        {{Channel::Roll, QT_TRANSLATE_NOOP("PlotData", "Roll"), kDegrees},
                         {Channel::Pitch, QT_TRANSLATE_NOOP("PlotData", "Pitch"), kDegrees}});
            addChannels(plot, log, QCoreApplication::translate("PlotData", "Heading"), "°", 0,
                        {{Channel::Heading, QT_TRANSLATE_NOOP("PlotData", "Heading"), kDegrees}});
            break;
        case PlotKind::Acceleration:
            addChannels(plot, log, QCoreApplication::translate("PlotData", "Acceleration"), "m/s²", 2,
                        {{Channel::AccelerationX, QT_TRANSLATE_NOOP("PlotData", "Forward")},
                         {Channel::AccelerationY, QT_TRANSLATE_NOOP("PlotData", "Left")},
                         {Channel::AccelerationZ, QT_TRANSLATE_NOOP("PlotData", "Up")}});
            break;
        case PlotKind::AngularRate:
            addChannels(plot, log, QCoreApplication::translate("PlotData", "Angular rate"), "°/s", 1,
                        {{Channel::AngularRateX, "x", kDegrees},
                         {Channel::AngularRateY, "y", kDegrees},
                         {Channel::AngularRateZ, "z", kDegrees}});
            break;
        default:
            addChannels(plot, log, QCoreApplication::translate("PlotData", "Range to the ground"), "m", 3,
                        {{Channel::Range, QT_TRANSLATE_NOOP("PlotData", "Range")}});
            if (log.has(Channel::Range) && !plot.panels.empty()) keepInSight(plot);
            addChannels(plot, log, QCoreApplication::translate("PlotData", "Strength"), {}, 0,
                        {{Channel::RangeStrength, QT_TRANSLATE_NOOP("PlotData", "Strength")}});
            break;
    }
    if (plot.panels.empty()) {
        plot.reason =
            QCoreApplication::translate("PlotData", "The log of run %1 has no readings of this sensor.")
                .arg(text(run.id));
    }
    return plot;
}

/// The antenna's places as they were logged, one axis.
PlotSeries gnssDots(const Survey& survey, const Run& run, int axis) {
    PlotSeries dots{QCoreApplication::translate("PlotData", "GNSS, as logged"),
                    SeriesStyle::Dots,
                    SeriesInk::Quiet,
                    {},
                    {},
                    {}};
    const LocalFrame frame = survey.frame();
    const std::size_t step = 1 + run.log.size() / kMostGnssDots;
    for (std::size_t i = 0; i < run.log.size(); i += step) {
        const GeodeticPosition position{run.log.value(Channel::Latitude, i),
                                        run.log.value(Channel::Longitude, i),
                                        run.log.value(Channel::EllipsoidalHeight, i)};
        if (!present(position.lat_deg) || !present(position.lon_deg)) continue;
        if (!present(position.h_ell_m)) continue;
        dots.x.push_back(run.log.time_s[i]);
        dots.y.push_back(frame.toEnu(position)[axis]);
    }
    return dots;
}

/// A value of each epoch with its 95 % band.
template <class Value, class Sigma>
PlotSeries stateSeries(const Trajectory& trajectory, const QString& name, SeriesInk ink, Value value,
                       Sigma sigma) {
    PlotSeries series{name, SeriesStyle::Line, ink, {}, {}, {}};
    for (const TrajectoryEpoch& epoch : trajectory.epochs) {
        series.x.push_back(epoch.time_s);
        series.y.push_back(value(epoch));
        series.half_band.push_back(kBand95 * sigma(epoch));
    }
    breakAtGaps(series);
    return series;
}

double speedSigma(const TrajectoryEpoch& epoch) {
    const Eigen::Vector2d v = epoch.velocity_enu_mps.head<2>();
    const Eigen::Matrix2d c = epoch.covariance.block<2, 2>(3, 3);
    // Standing still has no direction: the mean of both.
    if (v.norm() < 1e-3) return std::sqrt(c.trace() / 2.0);
    return std::sqrt(std::max(0.0, v.dot(c * v))) / v.norm();
}

Plot positionPlot(const Survey& survey, std::size_t run, const Trajectory& trajectory) {
    Plot plot;
    const std::array<QString, 3> axes{QCoreApplication::translate("PlotData", "East"),
                                      QCoreApplication::translate("PlotData", "North"),
                                      QCoreApplication::translate("PlotData", "Height")};
    for (int axis = 0; axis < 3; ++axis) {
        PlotPanel panel{axes[static_cast<std::size_t>(axis)], "m", 2, {}, false};
        auto dots = gnssDots(survey, survey.runs[run], axis);
        if (!dots.x.empty()) panel.series.push_back(std::move(dots));
        panel.series.push_back(stateSeries(
            trajectory, QCoreApplication::translate("PlotData", "Fused, 95 % band"), SeriesInk::First,
            [axis](const TrajectoryEpoch& e) { return e.position_enu_m[axis]; },
            [axis](const TrajectoryEpoch& e) { return std::sqrt(e.covariance(axis, axis)); }));
        plot.panels.push_back(std::move(panel));
    }
    return plot;
}

Plot speedPlot(const Trajectory& trajectory) {
    Plot plot;
    PlotPanel speed{QCoreApplication::translate("PlotData", "Speed over ground"), "m/s", 2, {}, false};
    speed.series.push_back(stateSeries(
        trajectory, QCoreApplication::translate("PlotData", "Fused, 95 % band"), SeriesInk::First,
        [](const TrajectoryEpoch& e) { return e.velocity_enu_mps.head<2>().norm(); }, speedSigma));
    PlotPanel climb{QCoreApplication::translate("PlotData", "Climb"), "m/s", 2, {}, false};
    climb.series.push_back(stateSeries(
        trajectory, QCoreApplication::translate("PlotData", "Fused, 95 % band"), SeriesInk::First,
        [](const TrajectoryEpoch& e) { return e.velocity_enu_mps.z(); },
        [](const TrajectoryEpoch& e) { return std::sqrt(e.covariance(5, 5)); }));
    plot.panels = {std::move(speed), std::move(climb)};
    return plot;
}

Plot sigmaPlot(const Trajectory& trajectory) {
    const auto line = [&](const QString& name, SeriesInk ink, auto value) {
        auto series = stateSeries(trajectory, name, ink, value, [](const TrajectoryEpoch&) { return 0.0; });
        series.half_band.clear();
        return series;
    };
    PlotPanel position{QCoreApplication::translate("PlotData", "Position, 1 σ"), "m", 3, {}, true};
    position.series = {line(QCoreApplication::translate("PlotData", "Plan"), SeriesInk::First,
                            [](const TrajectoryEpoch& e) {
                                return std::sqrt(std::max(e.covariance(0, 0), e.covariance(1, 1)));
                            }),
                       line(QCoreApplication::translate("PlotData", "Height"), SeriesInk::Second,
                            [](const TrajectoryEpoch& e) { return std::sqrt(e.covariance(2, 2)); })};
    PlotPanel attitude{QCoreApplication::translate("PlotData", "Attitude, 1 σ"), "°", 2, {}, true};
    attitude.series = {line(QCoreApplication::translate("PlotData", "Tilt"), SeriesInk::First,
                            [](const TrajectoryEpoch& e) { return degrees(e.sigma_tilt_rad); }),
                       line(QCoreApplication::translate("PlotData", "Heading"), SeriesInk::Second,
                            [](const TrajectoryEpoch& e) { return degrees(e.sigma_heading_rad); })};
    Plot plot;
    plot.panels = {std::move(position), std::move(attitude)};
    return plot;
}

PlotSeries guide(double from, double to, double y, const QString& name = {}) {
    return {name, SeriesStyle::Guide, SeriesInk::Quiet, {from, to}, {y, y}, {}};
}

Plot noFilter() {
    Plot plot;
    plot.reason = QCoreApplication::translate(
        "PlotData",
        "The method that was used has no filter that foretells readings. Choose another one and "
        "process again.");
    return plot;
}

/// What the filter was surprised by, sensor by sensor.
Plot innovationPlot(const std::vector<SensorInnovations>& sensors) {
    Plot plot;
    for (const SensorInnovations& sensor : sensors) {
        if (sensor.readings.empty()) continue;
        PlotSeries used{
            QCoreApplication::translate("PlotData", "used"), SeriesStyle::Dots, SeriesInk::First, {}, {}, {}};
        PlotSeries gated{QCoreApplication::translate("PlotData", "beyond the gate"),
                         SeriesStyle::Dots,
                         SeriesInk::Second,
                         {},
                         {},
                         {}};
        for (const Innovation& reading : sensor.readings) {
            PlotSeries& series = reading.used ? used : gated;
            series.x.push_back(reading.time_s);
            series.y.push_back(static_cast<double>(reading.over_sigma));
        }
        const double from = sensor.readings.front().time_s, to = sensor.readings.back().time_s;
        PlotPanel panel{reportWords(sensor.consistency.sensor), "σ", 1, {}, false};
        gated.sets_scale = used.x.empty();
        panel.series.push_back(std::move(used));
        if (!gated.x.empty()) panel.series.push_back(std::move(gated));
        panel.series.push_back(guide(from, to, kBand95, QString::fromUtf8("± 1.96")));
        panel.series.push_back(guide(from, to, -kBand95));
        plot.panels.push_back(std::move(panel));
    }
    if (plot.panels.empty()) return noFilter();
    plot.note = QCoreApplication::translate(
        "PlotData",
        "Reading less what the filter foretold, over the sigma of that: 95 % between the lines is "
        "right.");
    return plot;
}

Plot consistencyPlot(const std::vector<SensorInnovations>& sensors) {
    Plot plot;
    PlotSeries bars{QCoreApplication::translate("PlotData", "Mean NIS over its degrees of freedom"),
                    SeriesStyle::Bars,
                    SeriesInk::First,
                    {},
                    {},
                    {}};
    for (const SensorInnovations& sensor : sensors) {
        const SensorConsistency& sums = sensor.consistency;
        if (sums.n == 0 || !(sums.dof > 0.0)) continue;
        bars.x.push_back(static_cast<double>(plot.categories.size()));
        bars.y.push_back(sums.mean_nis / sums.dof);
        plot.categories << QString("%1 (%2)").arg(reportWords(sums.sensor)).arg(sums.n);
    }
    if (bars.x.empty()) return noFilter();
    plot.bar_width = 0.5;
    plot.x_label = QCoreApplication::translate("PlotData", "Sensor (readings used)");
    const double last = static_cast<double>(plot.categories.size()) - 0.5;
    plot.panels.push_back({QCoreApplication::translate("PlotData", "Mean NIS over degrees of freedom"),
                           {},
                           2,
                           {std::move(bars)},
                           true});
    plot.panels.back().series.push_back(
        guide(-0.5, last, 1.0, QCoreApplication::translate("PlotData", "right")));
    plot.note = QCoreApplication::translate(
        "PlotData",
        "Normalised innovations squared. Above 1 the filter is too sure of this sensor, below 1 not "
        "sure enough; gates and weights make it smaller.");
    return plot;
}

Plot groundPlot(std::size_t run, const Products& products) {
    Plot plot;
    std::array<PlotSeries, kGroundPointStateCount> by_state;
    for (const GroundPoint& point : products.ground_points) {
        if (point.run != run || !point.enu_m.allFinite()) continue;
        PlotSeries& series = by_state[static_cast<std::size_t>(point.state)];
        series.x.push_back(point.time_s);
        series.y.push_back(point.enu_m.z());
    }
    PlotPanel panel{QCoreApplication::translate("PlotData", "Height of the ground"), "m", 2, {}, false};
    const bool some_used = !by_state[static_cast<std::size_t>(GroundPointState::Used)].x.empty();
    int refused = 0;
    // The used ones last, on top.
    for (std::size_t i = kGroundPointStateCount; i-- > 0;) {
        PlotSeries& series = by_state[i];
        if (series.x.empty()) continue;
        const auto state = static_cast<GroundPointState>(i);
        const bool stands_back = state == GroundPointState::Thinned || state == GroundPointState::RunLeftOut;
        series.style = SeriesStyle::Dots;
        series.name = QString("%1 (%2)").arg(reportWords(name(state))).arg(series.x.size());
        series.ink = state == GroundPointState::Used ? SeriesInk::First
                     : stands_back                   ? SeriesInk::Quiet
                                                     : static_cast<SeriesInk>(1 + refused++ % 5);
        // What was refused can lie anywhere.
        series.sets_scale = state == GroundPointState::Used || !some_used;
        panel.series.push_back(std::move(series));
    }
    plot.note = QCoreApplication::translate(
        "PlotData", "The heights fit the points that are used; those that were refused may lie beyond.");
    if (panel.series.empty()) {
        plot.reason = QCoreApplication::translate(
            "PlotData", "This run has no ground points: its range finder gave nothing.");
    } else {
        plot.panels.push_back(std::move(panel));
    }
    return plot;
}

/// Errors over their predicted sigma, axis by axis, mark by mark.
Plot normalisedErrors(const SurveyReport& report) {
    Plot plot;
    plot.of_marks = true;
    plot.x_label = QCoreApplication::translate("PlotData", "Mark");
    std::vector<QString> marks;
    const auto place = [&](const std::string& mark) {
        const QString wanted = text(mark);
        auto found = std::find(marks.begin(), marks.end(), wanted);
        if (found == marks.end()) found = marks.insert(marks.end(), wanted);
        return static_cast<double>(found - marks.begin());
    };
    struct Kind {
        Stage stage;
        Quantity quantity;
        bool used;
        QString name;
    };
    const std::array<Kind, 4> kinds{
        Kind{Stage::Fused, Quantity::ArrayPosition, true,
             QCoreApplication::translate("PlotData", "Track, tied")},
        Kind{Stage::Fused, Quantity::ArrayPosition, false, QCoreApplication::translate("PlotData", "Track")},
        Kind{Stage::Surface, Quantity::SurfaceHeight, true,
             QCoreApplication::translate("PlotData", "Surface, tied")},
        Kind{Stage::Surface, Quantity::SurfaceHeight, false,
             QCoreApplication::translate("PlotData", "Surface")}};
    const std::array<QString, 3> axes{QCoreApplication::translate("PlotData", "East"),
                                      QCoreApplication::translate("PlotData", "North"),
                                      QCoreApplication::translate("PlotData", "Height")};
    std::size_t n = 0, within = 0;
    for (int axis = 0; axis < 3; ++axis) {
        PlotPanel panel{QCoreApplication::translate("PlotData", "%1, error over σ")
                            .arg(axes[static_cast<std::size_t>(axis)]),
                        {},
                        2,
                        {},
                        false};
        for (std::size_t k = 0; k < kinds.size(); ++k) {
            PlotSeries series{kinds[k].name, SeriesStyle::Dots, static_cast<SeriesInk>(3 - k), {}, {}, {}};
            for (const Residual& r : report.residuals) {
                if (r.stage != kinds[k].stage || r.quantity != kinds[k].quantity) continue;
                if (r.used_by_estimator != kinds[k].used) continue;
                const double ratio = r.difference_enu_m[axis] / r.sigma_enu_m[axis];
                if (!std::isfinite(ratio)) continue;
                series.x.push_back(place(r.mark));
                series.y.push_back(ratio);
                series.names << text(r.mark);
                if (r.used_by_estimator) continue;
                ++n;
                within += std::abs(ratio) <= kBand95 ? 1U : 0U;
            }
            if (!series.x.empty()) panel.series.push_back(std::move(series));
        }
        if (!panel.series.empty()) plot.panels.push_back(std::move(panel));
    }
    for (const QString& mark : marks) plot.categories << mark;
    const double last = static_cast<double>(marks.size()) - 0.5;
    for (PlotPanel& panel : plot.panels) {
        panel.series.push_back(guide(-0.5, last, kBand95, QString::fromUtf8("± 1.96")));
        panel.series.push_back(guide(-0.5, last, -kBand95));
        panel.series.push_back(guide(-0.5, last, 0.0));
    }
    if (n > 0) {
        plot.note = QCoreApplication::translate(
                        "PlotData",
                        "%1 of %2 errors lie within 1.96 σ (%3 %); 95 % is right. Marks that the estimator "
                        "used do not count.")
                        .arg(within)
                        .arg(n)
                        .arg(100.0 * static_cast<double>(within) / static_cast<double>(n), 0, 'f', 0);
    }
    if (plot.panels.empty()) {
        plot.reason = QCoreApplication::translate(
            "PlotData", "No errors at marks. Add marks to the survey's control.csv and process again.");
    }
    return plot;
}

/// Errors in order of size, and the marks where they are.
struct HeightErrors {
    QString of_what;
    std::vector<double> m;
    QStringList marks;
};

/// Of the surface at marks that it had no part in; else those of the tracks.
HeightErrors heightErrors(const SurveyReport& report) {
    for (const Stage stage : {Stage::Surface, Stage::Fused}) {
        std::vector<std::pair<double, std::string>> errors;
        for (const Residual& r : report.residuals) {
            const auto wanted = stage == Stage::Surface ? Quantity::SurfaceHeight : Quantity::ArrayPosition;
            if (r.stage != stage || r.quantity != wanted || r.used_by_estimator) continue;
            if (std::isfinite(r.difference_enu_m.z())) errors.emplace_back(r.difference_enu_m.z(), r.mark);
        }
        if (errors.size() < 3) continue;
        std::sort(errors.begin(), errors.end());
        HeightErrors found{stage == Stage::Surface
                               ? QCoreApplication::translate("PlotData", "Height error of the surface")
                               : QCoreApplication::translate("PlotData", "Height error of the tracks"),
                           {},
                           {}};
        for (const auto& [error_m, mark] : errors) {
            found.m.push_back(error_m);
            found.marks << text(mark);
        }
        return found;
    }
    return {};
}

struct Moments {
    double mean = 0.0, sd = 0.0;
};

Moments momentsOf(const std::vector<double>& values) {
    Moments m;
    const auto n = static_cast<double>(values.size());
    m.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    for (const double v : values) m.sd += (v - m.mean) * (v - m.mean);
    m.sd = std::sqrt(m.sd / (n - 1.0));
    return m;
}

Plot fewErrors() {
    Plot plot;
    plot.reason = QCoreApplication::translate(
        "PlotData",
        "Too few marks to show how errors spread: three at least, that the estimator did "
        "not use.");
    return plot;
}

Plot errorHistogram(const SurveyReport& report) {
    const auto [what, errors, marks] = heightErrors(report);
    if (errors.empty()) return fewErrors();
    const auto n = static_cast<double>(errors.size());
    const Moments m = momentsOf(errors);
    // Freedman and Diaconis (1981); where half of the errors are alike, by the standard deviation.
    const double iqr = errors[errors.size() * 3 / 4] - errors[errors.size() / 4];
    double width = 2.0 * (iqr > 0.0 ? iqr : m.sd) / std::cbrt(n);
    if (!(width > 0.0)) width = 0.01;
    const double first = std::floor(errors.front() / width);
    const auto bins = static_cast<std::size_t>(std::floor(errors.back() / width) - first) + 1;
    PlotSeries bars{
        QCoreApplication::translate("PlotData", "Marks"), SeriesStyle::Bars, SeriesInk::First, {}, {}, {}};
    for (std::size_t i = 0; i < bins; ++i) {
        bars.x.push_back((first + static_cast<double>(i) + 0.5) * width);
        bars.y.push_back(0.0);
    }
    for (const double e : errors) {
        bars.y[std::min(bins - 1, static_cast<std::size_t>(std::floor(e / width) - first))] += 1.0;
    }
    PlotSeries bell{QCoreApplication::translate("PlotData", "Normal, of the same mean and SD"),
                    SeriesStyle::Line,
                    SeriesInk::Second,
                    {},
                    {},
                    {}};
    for (int i = -80; i <= 80 && m.sd > 0.0; ++i) {
        const double z = i / 20.0;
        bell.x.push_back(m.mean + z * m.sd);
        bell.y.push_back(n * width / (m.sd * std::sqrt(2.0 * kPi)) * std::exp(-z * z / 2.0));
    }
    Plot plot;
    plot.x_label = what;
    plot.x_unit = "m";
    plot.bar_width = width;
    plot.panels.push_back(
        {QCoreApplication::translate("PlotData", "Marks"), {}, 0, {std::move(bars), std::move(bell)}, true});
    double square = 0.0;
    for (const double e : errors) square += e * e / n;
    plot.note = QCoreApplication::translate("PlotData", "n %1, mean %2, SD %3, RMSE %4")
                    .arg(errors.size())
                    .arg(lengthText(m.mean, 3), lengthText(m.sd, 3), lengthText(std::sqrt(square), 3));
    return plot;
}

/// Quantile of the standard normal distribution, by bisection of its distribution function.
double normalQuantile(double p) {
    double low = -8.0, high = 8.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2.0;
        (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
    }
    return (low + high) / 2.0;
}

Plot quantiles(const SurveyReport& report) {
    const auto [what, errors, marks] = heightErrors(report);
    if (errors.empty()) return fewErrors();
    PlotSeries dots{
        QCoreApplication::translate("PlotData", "Marks"), SeriesStyle::Dots, SeriesInk::First, {}, {}, {}};
    for (std::size_t i = 0; i < errors.size(); ++i) {
        dots.x.push_back(normalQuantile((static_cast<double>(i) + 0.5) / static_cast<double>(errors.size())));
        dots.y.push_back(errors[i]);
    }
    dots.names = marks;
    // Robust, so that blunders stand off from the line and do not pull it: median and NMAD.
    const double middle = medianOf(errors);
    std::vector<double> off;
    for (const double e : errors) off.push_back(std::abs(e - middle));
    const double nmad = 1.4826 * medianOf(std::move(off));
    const double end = std::max(2.0, dots.x.back() * 1.1);
    PlotSeries line{QCoreApplication::translate("PlotData", "Normal, of the same median and NMAD"),
                    SeriesStyle::Guide,
                    SeriesInk::Second,
                    {-end, end},
                    {middle - end * nmad, middle + end * nmad},
                    {}};
    Plot plot;
    plot.of_marks = true;
    plot.x_label = QCoreApplication::translate("PlotData", "Quantile of the normal distribution (σ)");
    plot.panels.push_back({what, "m", 2, {std::move(dots), std::move(line)}, false});
    plot.note = QCoreApplication::translate(
                    "PlotData", "n %1, median %2, NMAD %3. Ends that leave the line are heavier than normal.")
                    .arg(errors.size())
                    .arg(lengthText(middle, 3), lengthText(nmad, 3));
    return plot;
}

Plot crossValidation(const SurveyReport& report) {
    Plot plot;
    if (!report.surface.comparison) {
        plot.reason = QCoreApplication::translate(
            "PlotData",
            "Ways of interpolating were not compared. Set the surface's method to auto and "
            "process again.");
        return plot;
    }
    const InterpolationComparison& comparison = *report.surface.comparison;
    plot.x_label = QCoreApplication::translate("PlotData", "Method, best first");
    PlotPanel panel{
        QCoreApplication::translate("PlotData", "Error of points left out, RMSE"), "m", 3, {}, true};
    for (const std::string& method : comparison.ranking) plot.categories << text(method);
    const double share = 0.8 / static_cast<double>(std::max<std::size_t>(1, comparison.hold_outs.size()));
    plot.bar_width = share;
    for (std::size_t h = 0; h < comparison.hold_outs.size(); ++h) {
        PlotSeries bars{reportWords(comparison.hold_outs[h]),
                        SeriesStyle::Bars,
                        static_cast<SeriesInk>(h % 6),
                        {},
                        {},
                        {}};
        for (std::size_t i = 0; i < comparison.ranking.size(); ++i) {
            for (const InterpolationScore& score : comparison.scores) {
                if (score.method != comparison.ranking[i] || score.hold_out != comparison.hold_outs[h])
                    continue;
                bars.x.push_back(static_cast<double>(i) - 0.4 + (static_cast<double>(h) + 0.5) * share);
                bars.y.push_back(score.rmse_m);
            }
        }
        panel.series.push_back(std::move(bars));
    }
    plot.panels.push_back(std::move(panel));
    plot.note = QCoreApplication::translate("PlotData", "Points foretold from the others. Used: %1. Seed %2.")
                    .arg(text(report.surface.method_used))
                    .arg(comparison.seed);
    return plot;
}

Plot tuningPlot(const SurveyReport& report) {
    Plot plot;
    if (!report.tuning) {
        plot.reason = QCoreApplication::translate(
            "PlotData", "Nothing was tuned. Tune the survey on its own marks to compare here.");
        return plot;
    }
    const TuningRecord& tuning = *report.tuning;
    plot.categories << QCoreApplication::translate("PlotData", "on its marks");
    plot.x_label = QCoreApplication::translate("PlotData", "Loss");
    plot.bar_width = 0.35;
    PlotSeries before{QCoreApplication::translate("PlotData", "Before"),
                      SeriesStyle::Bars,
                      SeriesInk::Quiet,
                      {-0.2},
                      {tuning.loss_before},
                      {}};
    PlotSeries after{QCoreApplication::translate("PlotData", "After"),
                     SeriesStyle::Bars,
                     SeriesInk::First,
                     {0.2},
                     {tuning.loss_after},
                     {}};
    if (tuning.left_out_before && tuning.left_out_after) {
        plot.categories << QCoreApplication::translate("PlotData", "on marks left out");
        before.x.push_back(0.8);
        before.y.push_back(*tuning.left_out_before);
        after.x.push_back(1.2);
        after.y.push_back(*tuning.left_out_after);
    }
    plot.panels.push_back({text(tuning.loss), {}, 3, {std::move(before), std::move(after)}, true});
    plot.note = joinSentences(
        {reportWords(tuning.decision), QCoreApplication::translate("PlotData", "%1, %2 evaluations, seed %3.")
                                           .arg(text(tuning.optimiser))
                                           .arg(tuning.evaluations)
                                           .arg(tuning.seed)});
    return plot;
}

Plot convergencePlot(const TuningData* tuning) {
    Plot plot;
    if (tuning == nullptr || tuning->traces.empty()) {
        plot.reason = QCoreApplication::translate(
            "PlotData",
            "No search is known. Tune the survey on its marks, or open a file that terrawalk tune wrote.");
        return plot;
    }
    const std::string& loss = tuning->traces.back().loss;
    plot.x_label = QCoreApplication::translate("PlotData", "Evaluations of the loss");
    PlotPanel panel{text(loss), {}, 3, {}, true};
    for (const TuneTrace& trace : tuning->traces) {
        if (trace.loss != loss) continue;
        const auto ink = static_cast<SeriesInk>(panel.series.size() % 6);
        PlotSeries line{
            QCoreApplication::translate("PlotData", "%1, seed %2").arg(text(trace.optimiser)).arg(trace.seed),
            SeriesStyle::Line,
            ink,
            {},
            {},
            {},
            true};
        // The best stays the best until a better one is found: a stair.
        for (const ConvergencePoint& point : trace.convergence) {
            if (!line.y.empty()) {
                line.x.push_back(static_cast<double>(point.evaluations));
                line.y.push_back(line.y.back());
            }
            line.x.push_back(static_cast<double>(point.evaluations));
            line.y.push_back(point.best_loss);
        }
        panel.series.push_back(std::move(line));
    }
    plot.note =
        QCoreApplication::translate("PlotData", "The least loss found so far; it counts every evaluation.");
    plot.panels.push_back(std::move(panel));
    return plot;
}

Plot optimisersPlot(const TuningData* tuning) {
    Plot plot;
    const OptimiserTable table = tuning == nullptr                  ? OptimiserTable()
                                 : tuning->table.optimisers.empty() ? endLosses(tuning->traces)
                                                                    : tuning->table;
    if (table.optimisers.empty()) {
        plot.reason = QCoreApplication::translate(
            "PlotData",
            "Nothing to compare yet. Tune with several optimisers or seeds, or open the CSV of an experiment "
            "such as terrawalk experiment fig10.");
        return plot;
    }
    plot.x_label = QCoreApplication::translate("PlotData", "Optimiser");
    PlotSeries boxes;
    boxes.style = SeriesStyle::Boxes;
    std::size_t most = 0;
    for (std::size_t i = 0; i < table.optimisers.size(); ++i) {
        plot.categories << text(table.optimisers[i].optimiser);
        for (const double loss : table.optimisers[i].losses) {
            boxes.x.push_back(static_cast<double>(i));
            boxes.y.push_back(loss);
        }
        most = std::max(most, table.optimisers[i].losses.size());
    }
    plot.panels.push_back({text(table.quantity), {}, 3, {std::move(boxes)}, false});
    plot.note = QCoreApplication::translate(
                    "PlotData",
                    "Up to %1 searches each. Box: quartiles and median; whiskers: 1.5 box lengths at most.")
                    .arg(most);
    return plot;
}

Plot notProcessed() {
    Plot plot;
    plot.reason = QCoreApplication::translate("PlotData", "Process the survey to see this.");
    return plot;
}

Plot unnamedPlot(PlotKind kind, std::size_t run, const Survey& survey, const Products* products,
                 const TuningData* tuning) {
    if (kind == PlotKind::Convergence) return convergencePlot(tuning);
    if (kind == PlotKind::Optimisers) return optimisersPlot(tuning);
    if (plotsOneRun(kind) && run >= survey.runs.size()) return {};
    if (kind <= PlotKind::Range) return sensorPlot(kind, survey.runs[run]);
    if (products == nullptr) return notProcessed();
    switch (kind) {
        case PlotKind::Position:
            return positionPlot(survey, run, products->trajectories[run]);
        case PlotKind::Speed:
            return speedPlot(products->trajectories[run]);
        case PlotKind::Sigma:
            return sigmaPlot(products->trajectories[run]);
        case PlotKind::GroundHeights:
            return groundPlot(run, *products);
        case PlotKind::Innovations:
        case PlotKind::Consistency: {
            if (run >= products->innovations.size()) return noFilter();
            const auto& sensors = products->innovations[run];
            return kind == PlotKind::Innovations ? innovationPlot(sensors) : consistencyPlot(sensors);
        }
        case PlotKind::NormalisedErrors:
            return normalisedErrors(products->report);
        case PlotKind::ErrorHistogram:
            return errorHistogram(products->report);
        case PlotKind::QuantileQuantile:
            return quantiles(products->report);
        case PlotKind::CrossValidation:
            return crossValidation(products->report);
        default:
            return tuningPlot(products->report);
    }
}

}  // namespace

const std::vector<PlotKind>& allPlots() {
    static const std::vector<PlotKind> all{PlotKind::GnssPosition,
                                           PlotKind::GnssVelocity,
                                           PlotKind::Barometer,
                                           PlotKind::OpticalFlow,
                                           PlotKind::Attitude,
                                           PlotKind::Acceleration,
                                           PlotKind::AngularRate,
                                           PlotKind::Range,
                                           PlotKind::Position,
                                           PlotKind::Speed,
                                           PlotKind::Sigma,
                                           PlotKind::GroundHeights,
                                           PlotKind::Innovations,
                                           PlotKind::Consistency,
                                           PlotKind::NormalisedErrors,
                                           PlotKind::ErrorHistogram,
                                           PlotKind::QuantileQuantile,
                                           PlotKind::CrossValidation,
                                           PlotKind::Tuning,
                                           PlotKind::Convergence,
                                           PlotKind::Optimisers};
    return all;
}

QString plotName(PlotKind kind) {
    switch (kind) {
        case PlotKind::GnssPosition:
            return QCoreApplication::translate("PlotData", "GNSS position");
        case PlotKind::GnssVelocity:
            return QCoreApplication::translate("PlotData", "GNSS velocity");
        case PlotKind::Barometer:
            return QCoreApplication::translate("PlotData", "Barometer");
        case PlotKind::OpticalFlow:
            return QCoreApplication::translate("PlotData", "Optical flow");
        case PlotKind::Attitude:
            return QCoreApplication::translate("PlotData", "Attitude");
        case PlotKind::Acceleration:
            return QCoreApplication::translate("PlotData", "Acceleration");
        case PlotKind::AngularRate:
            return QCoreApplication::translate("PlotData", "Angular rate");
        case PlotKind::Range:
            return QCoreApplication::translate("PlotData", "Range finder");
        case PlotKind::Position:
            return QCoreApplication::translate("PlotData", "Position");
        case PlotKind::Speed:
            return QCoreApplication::translate("PlotData", "Speed");
        case PlotKind::Sigma:
            return QCoreApplication::translate("PlotData", "Sigmas");
        case PlotKind::GroundHeights:
            return QCoreApplication::translate("PlotData", "Ground points");
        case PlotKind::Innovations:
            return QCoreApplication::translate("PlotData", "Innovations");
        case PlotKind::Consistency:
            return QCoreApplication::translate("PlotData", "Consistency (NIS)");
        case PlotKind::NormalisedErrors:
            return QCoreApplication::translate("PlotData", "Errors over sigma");
        case PlotKind::ErrorHistogram:
            return QCoreApplication::translate("PlotData", "Histogram of errors");
        case PlotKind::QuantileQuantile:
            return QCoreApplication::translate("PlotData", "Q-Q of errors");
        case PlotKind::CrossValidation:
            return QCoreApplication::translate("PlotData", "Cross-validation");
        case PlotKind::Tuning:
            return QCoreApplication::translate("PlotData", "Tuning");
        case PlotKind::Convergence:
            return QCoreApplication::translate("PlotData", "Convergence");
        case PlotKind::Optimisers:
            return QCoreApplication::translate("PlotData", "Optimisers compared");
    }
    return {};
}

QString plotGroup(PlotKind kind) {
    if (kind <= PlotKind::Range) return QCoreApplication::translate("PlotData", "Sensors");
    if (kind <= PlotKind::Consistency) return QCoreApplication::translate("PlotData", "Fused run");
    if (kind <= PlotKind::QuantileQuantile) return QCoreApplication::translate("PlotData", "Errors at marks");
    return QCoreApplication::translate("PlotData", "Choices");
}

bool plotsOneRun(PlotKind kind) {
    return kind <= PlotKind::Consistency;
}

QString likelySensor(PlotKind kind) {
    switch (kind) {
        case PlotKind::GnssPosition:
        case PlotKind::GnssVelocity:
            return "gnss";
        case PlotKind::Barometer:
            return "barometer";
        case PlotKind::OpticalFlow:
            return "flow";
        case PlotKind::Attitude:
            return "attitude";
        case PlotKind::Range:
        case PlotKind::GroundHeights:
            return "range";
        default:
            return "all";
    }
}

bool plotsSearches(PlotKind kind) {
    return kind == PlotKind::Convergence || kind == PlotKind::Optimisers;
}

Plot plotOf(PlotKind kind, std::size_t run, const Survey& survey, const Products* products,
            const TuningData* tuning) {
    Plot plot = unnamedPlot(kind, run, survey, products, tuning);
    plot.title = plotName(kind);
    if (plotsOneRun(kind) && run < survey.runs.size()) {
        plot.title =
            QCoreApplication::translate("PlotData", "%1, run %2").arg(plot.title, text(survey.runs[run].id));
    }
    if (plotsOneRun(kind) && plot.categories.isEmpty()) {
        plot.over_time = true;
        plot.x_label = QCoreApplication::translate("PlotData", "Time of the log");
        plot.x_unit = "s";
    }
    return inChosenUnit(std::move(plot));
}

Plot inChosenUnit(Plot plot) {
    if (figureStyle().unit == LengthUnit::Metre) return plot;
    const auto convert = [](std::vector<double>& values) {
        std::transform(values.begin(), values.end(), values.begin(), inUnit);
    };
    const bool along = plot.x_unit == "m";
    if (along) {
        plot.x_unit = lengthUnit();
        plot.bar_width = inUnit(plot.bar_width);
    }
    for (PlotPanel& panel : plot.panels) {
        const bool length = panel.unit == "m", speed = panel.unit == "m/s";
        if (length || speed) {
            panel.unit = length ? lengthUnit() : speedUnit();
            if (panel.highest) panel.highest = inUnit(*panel.highest);
        }
        for (PlotSeries& series : panel.series) {
            if (along) convert(series.x);
            if (!length && !speed) continue;
            convert(series.y);
            convert(series.half_band);
        }
    }
    return plot;
}

}  // namespace terrawalk::gui
