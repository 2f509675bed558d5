#include "app/pipeline/inspect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "mapping/order_statistics.hpp"
#include "survey/result.hpp"

namespace terrawalk {

namespace {

struct SensorColumns {
    std::string_view name;
    std::vector<Channel> columns;
};

const std::vector<SensorColumns>& sensorTable() {
    static const std::vector<SensorColumns> kTable{
        {"GNSS position", {Channel::Latitude, Channel::Longitude, Channel::EllipsoidalHeight}},
        {"GNSS velocity", {Channel::GnssVelocityEast, Channel::GnssVelocityNorth, Channel::GnssVelocityUp}},
        {"GNSS accuracy", {Channel::GnssHorizontalAccuracy, Channel::GnssVerticalAccuracy}},
        {"barometer", {Channel::Pressure, Channel::Temperature}},
        {"optical flow", {Channel::FlowForward, Channel::FlowLeft, Channel::FlowQuality}},
        {"attitude", {Channel::Heading, Channel::Roll, Channel::Pitch}},
        {"accelerometer", {Channel::AccelerationX, Channel::AccelerationY, Channel::AccelerationZ}},
        {"gyroscope", {Channel::AngularRateX, Channel::AngularRateY, Channel::AngularRateZ}},
        {"range finder", {Channel::Range, Channel::RangeStrength}},
    };
    return kTable;
}

std::optional<SensorSummary> inspectSensor(const ArrayLog& log, const SensorColumns& sensor) {
    SensorSummary summary;
    summary.sensor = sensor.name;
    std::optional<Channel> first;
    for (const Channel column : sensor.columns) {
        if (!log.has(column)) continue;
        if (!first) first = column;
        summary.columns.emplace_back(kChannels[static_cast<std::size_t>(column)].column);
    }
    if (!first) return std::nullopt;
    const double file_unit = 1.0 / kChannels[static_cast<std::size_t>(*first)].unit_factor;
    std::vector<double> steps_s;
    double last_s = kMissing;
    for (std::size_t i = 0; i < log.size(); ++i) {
        const double value = log.value(*first, i);
        if (!present(value)) continue;
        const double shown = value * file_unit;
        summary.least = summary.epochs == 0 ? shown : std::min(summary.least, shown);
        summary.greatest = summary.epochs == 0 ? shown : std::max(summary.greatest, shown);
        ++summary.epochs;
        if (present(last_s)) steps_s.push_back(log.time_s[i] - last_s);
        last_s = log.time_s[i];
    }
    if (summary.epochs == 0) return std::nullopt;
    if (!steps_s.empty()) {
        summary.longest_gap_s = *std::max_element(steps_s.begin(), steps_s.end());
        const double step_s = median(std::move(steps_s));
        summary.rate_hz = step_s > 1e-9 ? 1.0 / step_s : 0.0;
    }
    return summary;
}

std::string fixName(int code) {
    switch (code) {
        case fix_code::kNone:
            return "none";
        case fix_code::kSingle:
            return "single";
        case fix_code::kDifferential:
            return "DGNSS";
        case fix_code::kRtkFixed:
            return "RTK fixed";
        case fix_code::kRtkFloat:
            return "RTK float";
        default:
            return fmt::format("code {}", code);
    }
}

// A list of line numbers that stays short whatever the log.
std::string lines(const std::vector<std::size_t>& numbers) {
    constexpr std::size_t kShown = 5;
    const std::vector<std::size_t> head(
        numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, numbers.size())));
    return fmt::format("{}{}", fmt::join(head, ", "), numbers.size() > kShown ? ", ..." : "");
}

}  // namespace

std::vector<CountedReason> fixShares(const ArrayLog& log) {
    std::map<int, std::size_t> counts;
    std::size_t without_code = 0;
    for (std::size_t i = 0; i < log.size(); ++i) {
        const double fix = log.value(Channel::Fix, i);
        if (present(fix)) {
            ++counts[static_cast<int>(fix)];
        } else if (present(log.value(Channel::Latitude, i))) {
            ++without_code;
        }
    }
    std::vector<CountedReason> shares;
    for (const auto& [code, count] : counts) shares.push_back({fixName(code), count});
    if (without_code > 0) shares.push_back({"no code", without_code});
    return shares;
}

LogSummary inspectLog(const ArrayLog& log, std::string run_id) {
    LogSummary summary;
    summary.run_id = std::move(run_id);
    summary.file = log.file.filename().string();
    summary.device = log.device;
    summary.start_utc = log.start_utc;
    summary.epochs = log.size();
    summary.read_report = log.read_report;
    if (log.size() > 1) {
        std::vector<double> steps_s(log.size() - 1);
        for (std::size_t i = 0; i + 1 < log.size(); ++i) steps_s[i] = log.time_s[i + 1] - log.time_s[i];
        summary.duration_s = log.time_s.back() - log.time_s.front();
        summary.interval_s = median(steps_s);
        summary.longest_gap_s = *std::max_element(steps_s.begin(), steps_s.end());
        summary.gaps =
            static_cast<std::size_t>(std::count_if(steps_s.begin(), steps_s.end(), [&](double step_s) {
                return step_s > 2.5 * summary.interval_s;
            }));
    }
    for (const SensorColumns& sensor : sensorTable()) {
        if (auto found = inspectSensor(log, sensor)) {
            summary.sensors.push_back(std::move(*found));
        } else {
            summary.missing.emplace_back(sensor.name);
        }
    }
    summary.fixes = fixShares(log);
    for (const AuxiliaryColumn& column : log.auxiliary) summary.auxiliary.push_back(column.name);
    return summary;
}

std::string toText(const LogSummary& s) {
    std::string out;
    const auto line = [&](fmt::string_view format, const auto&... args) {
        out += fmt::vformat(format, fmt::make_format_args(args...));
        out += '\n';
    };
    line("{}{}", s.run_id.empty() ? "" : s.run_id + "  ", printable(s.file));
    if (!s.device.empty()) line("  device    {}", printable(s.device));
    if (!s.start_utc.empty()) line("  start     {}", s.start_utc);
    line("  epochs    {}, {:.1f} s, every {:.3f} s", s.epochs, s.duration_s, s.interval_s);
    line("  gaps      {} (longest {:.1f} s)", s.gaps, s.longest_gap_s);
    if (s.read_report.repeated_lines.size() + s.read_report.late_lines.size() > 0) {
        line("  rows      {} read, {} repeated and dropped{}, {} late and put in order{}",
             s.read_report.rows_read, s.read_report.repeated_lines.size(),
             s.read_report.repeated_lines.empty() ? ""
                                                  : " (lines " + lines(s.read_report.repeated_lines) + ")",
             s.read_report.late_lines.size(),
             s.read_report.late_lines.empty() ? "" : " (lines " + lines(s.read_report.late_lines) + ")");
    }
    if (s.read_report.cut_off_line > 0) line("  cut off   line {}, dropped", s.read_report.cut_off_line);
    for (const SensorSummary& sensor : s.sensors) {
        line("  {:<14}{:>8} epochs ({:>5.1f} %) {:>6.2f} Hz, longest gap {:>6.1f} s, {} {:.9g} to {:.9g}",
             sensor.sensor, sensor.epochs,
             100.0 * static_cast<double>(sensor.epochs) /
                 static_cast<double>(std::max<std::size_t>(s.epochs, 1)),
             sensor.rate_hz, sensor.longest_gap_s, sensor.columns.front(), sensor.least, sensor.greatest);
    }
    std::size_t fixes = 0;
    for (const CountedReason& fix : s.fixes) fixes += fix.count;
    for (const CountedReason& fix : s.fixes) {
        line("  fix       {:<10}{:>8} epochs ({:>5.1f} %)", fix.reason, fix.count,
             100.0 * static_cast<double>(fix.count) / static_cast<double>(fixes));
    }
    if (!s.missing.empty()) line("  missing   {}", fmt::join(s.missing, ", "));
    for (const std::string& note : s.read_report.notes) line("  note      {}", printable(note));
    return out;
}

std::string toJson(const std::vector<LogSummary>& summaries) {
    using nlohmann::ordered_json;
    ordered_json logs = ordered_json::array();
    for (const LogSummary& s : summaries) {
        ordered_json log{{"run", s.run_id},
                         {"file", s.file},
                         {"device", s.device},
                         {"start_utc", s.start_utc},
                         {"epochs", s.epochs},
                         {"duration_s", s.duration_s},
                         {"interval_s", s.interval_s},
                         {"gaps", s.gaps},
                         {"longest_gap_s", s.longest_gap_s},
                         {"rows_read", s.read_report.rows_read},
                         {"repeated_lines", s.read_report.repeated_lines},
                         {"late_lines", s.read_report.late_lines},
                         {"cut_off_line", s.read_report.cut_off_line},
                         {"sensors", ordered_json::array()},
                         {"fixes", ordered_json::object()},
                         {"missing", s.missing},
                         {"auxiliary_columns", s.auxiliary},
                         {"notes", s.read_report.notes}};
        for (const SensorSummary& sensor : s.sensors) {
            log["sensors"].push_back({{"sensor", sensor.sensor},
                                      {"columns", sensor.columns},
                                      {"epochs", sensor.epochs},
                                      {"rate_hz", sensor.rate_hz},
                                      {"longest_gap_s", sensor.longest_gap_s},
                                      {"least", sensor.least},
                                      {"greatest", sensor.greatest}});
        }
        for (const CountedReason& fix : s.fixes) log["fixes"][fix.reason] = fix.count;
        logs.push_back(std::move(log));
    }
    return ordered_json{{"format", "terrawalk-inspection 1"}, {"logs", std::move(logs)}}.dump(
               2, ' ', false, ordered_json::error_handler_t::replace) +
           "\n";
}

}  // namespace terrawalk
