#include "app/pipeline/config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/pipeline/tune_json.hpp"
#include "survey/frames.hpp"

namespace terrawalk {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// A parameter behind a key: how to read it, how to set it, what it may be.
struct Parameter {
    std::string key;
    std::string range;
    std::string meaning;
    std::function<ordered_json(const PipelineConfig&)> get;
    std::function<Result<void>(PipelineConfig&, const json&)> set;
};

std::string wrongValue(const Parameter& parameter, const json& value) {
    const std::string shown = value.is_structured()
                                  ? "a list or an object"
                                  : value.dump(-1, ' ', false, json::error_handler_t::replace);
    return fmt::format("{} = {} is not permitted", parameter.key, shown.substr(0, 80));
}

/// Takes a configuration to one of its members.
template <class Member>
using Field = Member& (*)(PipelineConfig&);

template <class Member>
const Member& read(Field<Member> field, const PipelineConfig& config) {
    return field(const_cast<PipelineConfig&>(config));  // a field only finds the member
}

Parameter number(std::string key, double least, double greatest, std::string meaning, Field<double> field,
                 double unit_factor = 1.0) {
    Parameter p{std::move(key), {}, std::move(meaning), {}, {}};
    p.range = greatest == kUnlimited ? fmt::format(">= {}", least) : fmt::format("{} to {}", least, greatest);
    p.get = [field, unit_factor](const PipelineConfig& config) {
        const double value = read(field, config);
        return ordered_json(unit_factor == 1.0 ? value : std::round(value / unit_factor * 1e9) / 1e9);
    };
    p.set = [field, unit_factor, least, greatest, p](PipelineConfig& config,
                                                     const json& value) -> Result<void> {
        if (!value.is_number()) return usageError(wrongValue(p, value), "give a number");
        const double shown = value.get<double>();
        if (!(shown >= least && shown <= greatest) || !std::isfinite(shown)) {
            return usageError(wrongValue(p, value), "permitted: " + p.range);
        }
        field(config) = shown * unit_factor;
        return {};
    };
    return p;
}

Parameter angle(std::string key, double least_deg, double greatest_deg, std::string meaning,
                Field<double> field) {
    return number(std::move(key), least_deg, greatest_deg, std::move(meaning), field, kPi / 180.0);
}

template <class Member>
Parameter integer(std::string key, std::int64_t least, std::int64_t greatest, std::string meaning,
                  Field<Member> field) {
    Parameter p{std::move(key), fmt::format("{} to {}", least, greatest), std::move(meaning), {}, {}};
    p.get = [field](const PipelineConfig& config) {
        return ordered_json(read(field, config));
    };
    p.set = [field, least, greatest, p](PipelineConfig& config, const json& value) -> Result<void> {
        if (!value.is_number_integer()) return usageError(wrongValue(p, value), "give a whole number");
        const bool too_big =
            value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(greatest);
        if (too_big || value.get<std::int64_t>() < least || value.get<std::int64_t>() > greatest) {
            return usageError(wrongValue(p, value), "permitted: " + p.range);
        }
        field(config) = static_cast<Member>(value.get<std::int64_t>());
        return {};
    };
    return p;
}

Parameter flag(std::string key, std::string meaning, Field<bool> field) {
    Parameter p{std::move(key), "true, false", std::move(meaning), {}, {}};
    p.get = [field](const PipelineConfig& config) {
        return ordered_json(read(field, config));
    };
    p.set = [field, p](PipelineConfig& config, const json& value) -> Result<void> {
        if (!value.is_boolean()) return usageError(wrongValue(p, value), "permitted: true, false");
        field(config) = value.get<bool>();
        return {};
    };
    return p;
}

template <class Enum>
Parameter choice(std::string key, std::vector<std::pair<std::string, Enum>> names, std::string meaning,
                 Field<Enum> field) {
    Parameter p{std::move(key), {}, std::move(meaning), {}, {}};
    for (const auto& [text, value] : names) p.range += (p.range.empty() ? "" : ", ") + text;
    p.get = [field, names](const PipelineConfig& config) {
        const auto found = std::find_if(names.begin(), names.end(),
                                        [&](const auto& n) { return n.second == read(field, config); });
        return ordered_json(found->first);
    };
    p.set = [field, names, p](PipelineConfig& config, const json& value) -> Result<void> {
        const auto found = std::find_if(names.begin(), names.end(),
                                        [&](const auto& n) { return value.is_string() && n.first == value; });
        if (found == names.end()) return usageError(wrongValue(p, value), "permitted: " + p.range);
        field(config) = found->second;
        return {};
    };
    return p;
}

template <class Enum, std::size_t n>
std::vector<std::pair<std::string, Enum>> named(
    const std::array<std::pair<Enum, std::string_view>, n>& names) {
    std::vector<std::pair<std::string, Enum>> list;
    for (const auto& [value, text] : names) list.emplace_back(text, value);
    return list;
}

#define TERRAWALK_FIELD(path)              \
    [](PipelineConfig & config) -> auto& { \
        return config.path;                \
    }

std::vector<Parameter> fusionParameters() {
    return {
        choice<FusionMethod>(
            "fusion.method", named(kFusionMethodNames),
            "raw: sensors as they are; ukf: 9-state unscented Kalman filter with gate and smoother; aukf: "
            "the "
            "method of paper 000 as it is; terrawalk: filter with error states, then one adjustment of all "
            "runs with their crossovers",
            TERRAWALK_FIELD(fusion.method)),
        flag("fusion.smooth", "Rauch-Tung-Striebel pass after the filter", TERRAWALK_FIELD(fusion.smooth)),
        number("fusion.stands.start_s", 0.2, 600, "still seconds at a start mark",
               TERRAWALK_FIELD(fusion.stands.start_s)),
        number("fusion.stands.target_s", 0.2, 600, "still seconds at a target mark",
               TERRAWALK_FIELD(fusion.stands.target_s)),
        flag("fusion.stands.tie_fixed_targets",
             "targets of fixed-point runs hold the estimator; false: they only show its error",
             TERRAWALK_FIELD(fusion.stands.tie_fixed_targets)),
        number("fusion.unscented.alpha", 0.0001, 1, "spread of the sigma points; used by the yaw row only",
               TERRAWALK_FIELD(fusion.unscented.alpha)),
        number("fusion.unscented.beta", 0, 10, "weight of the centre point, 2 for a Gaussian",
               TERRAWALK_FIELD(fusion.unscented.beta)),
        number("fusion.unscented.kappa", 0, 10, "secondary spread of the sigma points",
               TERRAWALK_FIELD(fusion.unscented.kappa)),
        number("fusion.process.noise.position_e_m2ps", 0, 1000, "process noise of the position, east, m2/s",
               TERRAWALK_FIELD(fusion.process.noise.position_e_m2ps)),
        number("fusion.process.noise.position_n_m2ps", 0, 1000, "process noise of the position, north, m2/s",
               TERRAWALK_FIELD(fusion.process.noise.position_n_m2ps)),
        number("fusion.process.noise.position_u_m2ps", 0, 1000, "process noise of the position, up, m2/s",
               TERRAWALK_FIELD(fusion.process.noise.position_u_m2ps)),
        number("fusion.process.noise.velocity_e_m2ps3", 0, 1000, "process noise of the velocity, east, m2/s3",
               TERRAWALK_FIELD(fusion.process.noise.velocity_e_m2ps3)),
        number("fusion.process.noise.velocity_n_m2ps3", 0, 1000,
               "process noise of the velocity, north, m2/s3",
               TERRAWALK_FIELD(fusion.process.noise.velocity_n_m2ps3)),
        number("fusion.process.noise.velocity_u_m2ps3", 0, 1000, "process noise of the velocity, up, m2/s3",
               TERRAWALK_FIELD(fusion.process.noise.velocity_u_m2ps3)),
        number("fusion.process.noise.acceleration_e_m2ps5", 0, 1000,
               "process noise of the acceleration, east, m2/s5",
               TERRAWALK_FIELD(fusion.process.noise.acceleration_e_m2ps5)),
        number("fusion.process.noise.acceleration_n_m2ps5", 0, 1000,
               "process noise of the acceleration, north, m2/s5",
               TERRAWALK_FIELD(fusion.process.noise.acceleration_n_m2ps5)),
        number("fusion.process.noise.acceleration_u_m2ps5", 0, 1000,
               "process noise of the acceleration, up, m2/s5",
               TERRAWALK_FIELD(fusion.process.noise.acceleration_u_m2ps5)),
        number("fusion.process.acceleration_time_constant_s", 0, 1000000.0,
               "in which an acceleration dies away; 0: never",
               TERRAWALK_FIELD(fusion.process.acceleration_time_constant_s)),
        number("fusion.process.longest_step_s", 0.01, 10, "longer gaps are cut into steps of this length",
               TERRAWALK_FIELD(fusion.process.longest_step_s)),
        number("fusion.initial.velocity_sigma_mps", 0.001, 100, "of the velocity at the start",
               TERRAWALK_FIELD(fusion.initial.velocity_sigma_mps)),
        number("fusion.initial.acceleration_sigma_mps2", 0.001, 100, "of the acceleration at the start",
               TERRAWALK_FIELD(fusion.initial.acceleration_sigma_mps2)),
        number("fusion.initial.walking_speed_mps", 0, 100,
               "by which a position ages while nothing measures it",
               TERRAWALK_FIELD(fusion.initial.walking_speed_mps)),
        number("fusion.initial.position_sigma_m", 0.001, 100000.0,
               "around a known start mark, before the ties to it",
               TERRAWALK_FIELD(fusion.initial.position_sigma_m)),
        number("fusion.initial.still_speed_mps", 0, 10, "below this the array counts as standing still",
               TERRAWALK_FIELD(fusion.initial.still_speed_mps)),
        flag("fusion.gnss.use_position", "use GNSS positions", TERRAWALK_FIELD(fusion.gnss.use_position)),
        flag("fusion.gnss.use_velocity", "use GNSS (Doppler) velocities",
             TERRAWALK_FIELD(fusion.gnss.use_velocity)),
        choice<GnssHeightUse>(
            "fusion.gnss.use_height",
            {{"never", GnssHeightUse::Never}, {"rtk", GnssHeightUse::Rtk}, {"always", GnssHeightUse::Always}},
            "when the GNSS height is used; rtk: with an RTK fix, fixed or float, and with any fix while no "
            "barometer tells",
            TERRAWALK_FIELD(fusion.gnss.use_height)),
        number("fusion.gnss.sigma_single_m", 0.0001, 1000, "position, single point, per horizontal axis",
               TERRAWALK_FIELD(fusion.gnss.sigma_single_m)),
        number("fusion.gnss.sigma_differential_m", 0.0001, 1000, "position, DGNSS, per horizontal axis",
               TERRAWALK_FIELD(fusion.gnss.sigma_differential_m)),
        number("fusion.gnss.sigma_float_m", 0.0001, 1000, "position, RTK float, per horizontal axis",
               TERRAWALK_FIELD(fusion.gnss.sigma_float_m)),
        number("fusion.gnss.sigma_fixed_m", 0.0001, 1000, "position, RTK fixed, per horizontal axis",
               TERRAWALK_FIELD(fusion.gnss.sigma_fixed_m)),
        number("fusion.gnss.sigma_single_up_m", 0.0001, 1000, "position, single point, height",
               TERRAWALK_FIELD(fusion.gnss.sigma_single_up_m)),
        number("fusion.gnss.sigma_differential_up_m", 0.0001, 1000, "position, DGNSS, height",
               TERRAWALK_FIELD(fusion.gnss.sigma_differential_up_m)),
        number("fusion.gnss.sigma_float_up_m", 0.0001, 1000, "position, RTK float, height",
               TERRAWALK_FIELD(fusion.gnss.sigma_float_up_m)),
        number("fusion.gnss.sigma_fixed_up_m", 0.0001, 1000, "position, RTK fixed, height",
               TERRAWALK_FIELD(fusion.gnss.sigma_fixed_up_m)),
        number("fusion.gnss.accuracy_floor_share", 0, 100,
               "the receiver's own accuracy counts no less than this share of the sigmas above",
               TERRAWALK_FIELD(fusion.gnss.accuracy_floor_share)),
        number("fusion.gnss.correlation_s", 0, 100000.0,
               "time in which a position error without RTK fix changes",
               TERRAWALK_FIELD(fusion.gnss.correlation_s)),
        number("fusion.gnss.correlation_fixed_s", 0, 100000.0, "the same with an RTK fix",
               TERRAWALK_FIELD(fusion.gnss.correlation_fixed_s)),
        number("fusion.gnss.velocity_sigma_mps", 0.0001, 100, "Doppler velocity, per horizontal axis",
               TERRAWALK_FIELD(fusion.gnss.velocity_sigma_mps)),
        number("fusion.gnss.velocity_sigma_up_mps", 0.0001, 100, "Doppler velocity, up",
               TERRAWALK_FIELD(fusion.gnss.velocity_sigma_up_mps)),
        number("fusion.gnss.velocity_correlation_s", 0, 100000.0, "time in which a velocity error changes",
               TERRAWALK_FIELD(fusion.gnss.velocity_correlation_s)),
        flag("fusion.barometer.use", "use the barometer", TERRAWALK_FIELD(fusion.barometer.use)),
        number("fusion.barometer.scale", 0.1, 10,
               "height per height of the standard atmosphere, from a fit at known marks",
               TERRAWALK_FIELD(fusion.barometer.scale)),
        number("fusion.barometer.sigma_m", 0.0001, 100, "white noise",
               TERRAWALK_FIELD(fusion.barometer.sigma_m)),
        number("fusion.barometer.gust_sigma_m", 0, 100, "error by gusts of wind",
               TERRAWALK_FIELD(fusion.barometer.gust_sigma_m)),
        number("fusion.barometer.gust_correlation_s", 0, 10000.0, "length of a gust",
               TERRAWALK_FIELD(fusion.barometer.gust_correlation_s)),
        number("fusion.barometer.longest_silence_s", 0, 1e5,
               "after this silence GNSS heights of any fix stand in, unless never",
               TERRAWALK_FIELD(fusion.barometer.longest_silence_s)),
        number("fusion.barometer.drift_m_per_sqrt_min", 0, 100,
               "drift since the barometer was zeroed, m per root of a minute",
               TERRAWALK_FIELD(fusion.barometer.drift_m_per_sqrt_min)),
        flag("fusion.flow.use", "use the optical flow", TERRAWALK_FIELD(fusion.flow.use)),
        number("fusion.flow.variance_m2ps2", 1e-09, 100, "variance at rest, m2/s2",
               TERRAWALK_FIELD(fusion.flow.variance_m2ps2)),
        number("fusion.flow.variance_per_v2", 0, 10, "growth of the variance with the square of the speed",
               TERRAWALK_FIELD(fusion.flow.variance_per_v2)),
        number("fusion.flow.scale_sigma", 0, 1, "lasting error of scale, as a share of the speed",
               TERRAWALK_FIELD(fusion.flow.scale_sigma)),
        number("fusion.flow.correlation_s", 0, 1e5,
               "for how long errors of scale and heading keep their direction",
               TERRAWALK_FIELD(fusion.flow.correlation_s)),
        number("fusion.flow.smallest_quality", 0, 255, "flow_quality below this is rejected",
               TERRAWALK_FIELD(fusion.flow.smallest_quality)),
        flag("fusion.flow.screen",
             "reject readings of nothing amid motion, and those far from their neighbours",
             TERRAWALK_FIELD(fusion.flow.screen)),
        flag("fusion.flow.bridge_dropouts", "let the recent mean flow stand in for missing readings",
             TERRAWALK_FIELD(fusion.flow.bridge_dropouts)),
        number("fusion.flow.bridge_after_s", 0, 10000.0, "after this time without a reading",
               TERRAWALK_FIELD(fusion.flow.bridge_after_s)),
        number("fusion.flow.bridge_sigma_mps", 0.001, 100, "of the mean that stands in",
               TERRAWALK_FIELD(fusion.flow.bridge_sigma_mps)),
        number("fusion.flow.bridge_longest_s", 0, 1e5,
               "the mean stands in no longer than this after the last flow reading",
               TERRAWALK_FIELD(fusion.flow.bridge_longest_s)),
        number("fusion.flow.bridge_memory_s", 0.1, 10000.0, "over which the mean is taken",
               TERRAWALK_FIELD(fusion.flow.bridge_memory_s)),
        flag("fusion.accelerometer.use", "use the accelerometer", TERRAWALK_FIELD(fusion.accelerometer.use)),
        number("fusion.accelerometer.sigma_mps2", 0.0001, 100,
               "of the specific force, steps of the walk included",
               TERRAWALK_FIELD(fusion.accelerometer.sigma_mps2)),
        flag("fusion.yaw_row.use", "use the course of the walk against the heading (paper, eq 4)",
             TERRAWALK_FIELD(fusion.yaw_row.use)),
        number("fusion.yaw_row.sigma_deg", 0.1, 180, "of heading less course",
               TERRAWALK_FIELD(fusion.yaw_row.sigma_deg)),
        number("fusion.yaw_row.slowest_mps", 0, 10, "slower than this the course is not used",
               TERRAWALK_FIELD(fusion.yaw_row.slowest_mps)),
        number("fusion.yaw_row.mount_offset_deg", -180, 180,
               "yaw of the array less course, counter-clockwise",
               TERRAWALK_FIELD(fusion.yaw_row.mount_offset_deg)),
        number("fusion.attitude.sigma_tilt_deg", 0.001, 90, "roll and pitch",
               TERRAWALK_FIELD(fusion.attitude.sigma_tilt_deg)),
        number("fusion.attitude.sigma_heading_deg", 0.001, 180, "heading",
               TERRAWALK_FIELD(fusion.attitude.sigma_heading_deg)),
        number("fusion.attitude.heading_lag_s", 0, 10, "by which the compass may come behind in turns",
               TERRAWALK_FIELD(fusion.attitude.heading_lag_s)),
        number("fusion.attitude.sigma_tilt_held_deg", 0.001, 90,
               "roll and pitch while the last known ones stand in",
               TERRAWALK_FIELD(fusion.attitude.sigma_tilt_held_deg)),
        number("fusion.attitude.sigma_heading_held_deg", 0.001, 180,
               "heading while the last known one stands in",
               TERRAWALK_FIELD(fusion.attitude.sigma_heading_held_deg)),
        number("fusion.attitude.longest_hold_s", 0, 10000.0, "for how long a held heading rotates the flow",
               TERRAWALK_FIELD(fusion.attitude.longest_hold_s)),
        number("fusion.attitude.sigma_tilt_unknown_deg", 0.001, 90,
               "roll and pitch where none was ever given",
               TERRAWALK_FIELD(fusion.attitude.sigma_tilt_unknown_deg)),
        number("fusion.ties.sigma_m", 0.0001, 100,
               "how well the array stands over a mark, per horizontal axis",
               TERRAWALK_FIELD(fusion.ties.sigma_m)),
        number("fusion.ties.range_sigma_m", 0.0001, 100, "height of the array above a mark",
               TERRAWALK_FIELD(fusion.ties.range_sigma_m)),
        number("fusion.ties.correlation_s", 0, 10000.0, "of both",
               TERRAWALK_FIELD(fusion.ties.correlation_s)),
        number("fusion.ties.range_tolerance_m", 0.001, 100,
               "a range that far from the median of the stand is left out",
               TERRAWALK_FIELD(fusion.ties.range_tolerance_m)),
        number("fusion.ties.shortest_range_m", 0, 100, "shorter ranges on a mark are not believed",
               TERRAWALK_FIELD(fusion.ties.shortest_range_m)),
        number("fusion.ties.longest_range_m", 0, 1000, "longer ranges on a mark are not believed",
               TERRAWALK_FIELD(fusion.ties.longest_range_m)),
        number("fusion.ties.assumed_height_m", 0, 100,
               "of the array above a mark where no range was measured",
               TERRAWALK_FIELD(fusion.ties.assumed_height_m)),
        number("fusion.ties.assumed_height_sigma_m", 0.001, 100, "of that height",
               TERRAWALK_FIELD(fusion.ties.assumed_height_sigma_m)),
        flag("fusion.robust.use", "down-weight and reject outliers", TERRAWALK_FIELD(fusion.robust.use)),
        number("fusion.robust.huber_sigma", 0.1, 100, "from here on the weight falls",
               TERRAWALK_FIELD(fusion.robust.huber_sigma)),
        number("fusion.robust.gate_sigma", 0.5, 1000, "beyond this a reading is rejected",
               TERRAWALK_FIELD(fusion.robust.gate_sigma)),
        number("fusion.robust.longest_gap_s", 0.1, 1e5, "a silence this long ends a spell of rejections",
               TERRAWALK_FIELD(fusion.robust.longest_gap_s)),
        number("fusion.robust.readmit_after_s", 0.1, 100000.0,
               "a sensor rejected for so long is believed again",
               TERRAWALK_FIELD(fusion.robust.readmit_after_s)),
        number("fusion.divergence.largest_sigma_m", 1, 1000000.0, "a larger sigma ends the run with an error",
               TERRAWALK_FIELD(fusion.divergence.largest_sigma_m)),
        number("fusion.divergence.largest_gnss_distance_m", 1, 1000000.0,
               "a track farther from GNSS ends the run with an error",
               TERRAWALK_FIELD(fusion.divergence.largest_gnss_distance_m)),
        number("fusion.divergence.patience_s", 0, 1000000.0, "after this time",
               TERRAWALK_FIELD(fusion.divergence.patience_s)),
        number("fusion.divergence.rejected_share", 0, 1,
               "a larger share of rejected GNSS positions ends the run with an error",
               TERRAWALK_FIELD(fusion.divergence.rejected_share)),
        integer<int>("fusion.divergence.fewest_rejected", 1, 1000000,
                     "rejected GNSS positions before their share counts",
                     TERRAWALK_FIELD(fusion.divergence.fewest_rejected)),
        number("fusion.divergence.rejected_window_s", 1, 1000000.0, "over which the share is taken",
               TERRAWALK_FIELD(fusion.divergence.rejected_window_s)),
    };
}

std::vector<Parameter> aukfParameters() {
    return {
        choice<FilterKind>("fusion.aukf.filter", named(kFilterNames),
                           "which filter method aukf runs on the model of paper 000",
                           TERRAWALK_FIELD(fusion.aukf.filter)),
        number("fusion.aukf.noise.position_e_m2", 0, 1000,
               "variance that a step adds to the position, east, m2",
               TERRAWALK_FIELD(fusion.aukf.noise.position_e_m2)),
        number("fusion.aukf.noise.position_n_m2", 0, 1000,
               "variance that a step adds to the position, north, m2",
               TERRAWALK_FIELD(fusion.aukf.noise.position_n_m2)),
        number("fusion.aukf.noise.position_u_m2", 0, 1000,
               "variance that a step adds to the position, up, m2",
               TERRAWALK_FIELD(fusion.aukf.noise.position_u_m2)),
        number("fusion.aukf.noise.velocity_e_m2ps2", 0, 1000,
               "variance that a step adds to the velocity, east, m2/s2",
               TERRAWALK_FIELD(fusion.aukf.noise.velocity_e_m2ps2)),
        number("fusion.aukf.noise.velocity_n_m2ps2", 0, 1000,
               "variance that a step adds to the velocity, north, m2/s2",
               TERRAWALK_FIELD(fusion.aukf.noise.velocity_n_m2ps2)),
        number("fusion.aukf.noise.velocity_u_m2ps2", 0, 1000,
               "variance that a step adds to the velocity, up, m2/s2",
               TERRAWALK_FIELD(fusion.aukf.noise.velocity_u_m2ps2)),
        number("fusion.aukf.noise.acceleration_e_m2ps4", 0, 1000,
               "variance that a step adds to the acceleration, east, m2/s4",
               TERRAWALK_FIELD(fusion.aukf.noise.acceleration_e_m2ps4)),
        number("fusion.aukf.noise.acceleration_n_m2ps4", 0, 1000,
               "variance that a step adds to the acceleration, north, m2/s4",
               TERRAWALK_FIELD(fusion.aukf.noise.acceleration_n_m2ps4)),
        number("fusion.aukf.noise.acceleration_u_m2ps4", 0, 1000,
               "variance that a step adds to the acceleration, up, m2/s4",
               TERRAWALK_FIELD(fusion.aukf.noise.acceleration_u_m2ps4)),
        number("fusion.aukf.nominal_interval_s", 0.001, 60,
               "step to which the noise belongs; a step of another length adds its share of it",
               TERRAWALK_FIELD(fusion.aukf.nominal_interval_s)),
        number("fusion.aukf.unscented.alpha", 0.0001, 1, "spread of the sigma points",
               TERRAWALK_FIELD(fusion.aukf.unscented.alpha)),
        number("fusion.aukf.unscented.beta", 0, 10, "weight of the centre point, 2 for a Gaussian",
               TERRAWALK_FIELD(fusion.aukf.unscented.beta)),
        number("fusion.aukf.unscented.kappa", 0, 10, "secondary spread of the sigma points",
               TERRAWALK_FIELD(fusion.aukf.unscented.kappa)),
        flag("fusion.aukf.yaw_row.use", "heading as a measurement of the course",
             TERRAWALK_FIELD(fusion.aukf.yaw_row.use)),
        number("fusion.aukf.yaw_row.sigma_deg", 0.001, 180, "of the heading as a course",
               TERRAWALK_FIELD(fusion.aukf.yaw_row.sigma_deg)),
        number("fusion.aukf.yaw_row.slowest_mps", 0.001, 10, "below this speed the row is left out",
               TERRAWALK_FIELD(fusion.aukf.yaw_row.slowest_mps)),
        number("fusion.aukf.yaw_row.mount_offset_deg", -180, 180,
               "yaw of the array less course of the walk, counter-clockwise",
               TERRAWALK_FIELD(fusion.aukf.yaw_row.mount_offset_deg)),
        number("fusion.aukf.adaptive.forgetting", 0, 1,
               "filter adaptive-ukf: b, the noise remembers 1 / (1 - b) readings",
               TERRAWALK_FIELD(fusion.aukf.adaptive.forgetting)),
        number("fusion.aukf.adaptive.least_factor", 0.0001, 1,
               "filter adaptive-ukf: least noise variance over the sensor's own",
               TERRAWALK_FIELD(fusion.aukf.adaptive.least_factor)),
        number("fusion.aukf.adaptive.greatest_factor", 1, 1e6,
               "filter adaptive-ukf: greatest; a reading that asks for more is left out",
               TERRAWALK_FIELD(fusion.aukf.adaptive.greatest_factor)),
    };
}

std::vector<Parameter> groundParameters() {
    return {
        number("ground.sigma_range_near_m", 0.0001, 10, "of the range finder at short range",
               TERRAWALK_FIELD(ground.sigma_range_near_m)),
        number("ground.sigma_range_far_share", 0, 1, "of the range finder beyond, as a share of the range",
               TERRAWALK_FIELD(ground.sigma_range_far_share)),
        number("ground.range_near_m", 0, 1000, "up to here a range counts as short",
               TERRAWALK_FIELD(ground.range_near_m)),
        number("ground.least_range_m", 0, 1000, "shorter ranges are a hand or a leaf",
               TERRAWALK_FIELD(ground.least_range_m)),
        number("ground.greatest_range_m", 0.1, 10000, "longer ranges are not believed",
               TERRAWALK_FIELD(ground.greatest_range_m)),
        number("ground.least_strength", 0, 65535, "weaker returns are not believed",
               TERRAWALK_FIELD(ground.least_strength)),
        number("ground.greatest_strength", 0, 65535, "stronger returns are not believed",
               TERRAWALK_FIELD(ground.greatest_strength)),
        angle("ground.greatest_tilt_deg", 0.1, 89, "between the ray and the vertical",
              TERRAWALK_FIELD(ground.greatest_tilt_rad)),
        number("ground.greatest_sigma_m", 0.001, 1e6, "points of a less sure position are left out",
               TERRAWALK_FIELD(ground.greatest_sigma_m)),
        number("ground.greatest_sigma_u_m", 0.001, 1e6, "points of a less sure height are left out",
               TERRAWALK_FIELD(ground.greatest_sigma_u_m)),
        number("ground.spike_sigma", 0, 1000,
               "robust sigmas off the neighbours that make a spike; 0: no check",
               TERRAWALK_FIELD(ground.spike_sigma)),
        number("ground.spike_window_m", 0.01, 1000, "path on each side in which neighbours count",
               TERRAWALK_FIELD(ground.spike_window_m)),
        number("ground.spike_window_s", 0.01, 1000, "time on each side in which neighbours count",
               TERRAWALK_FIELD(ground.spike_window_s)),
        number("ground.spike_floor_m", 0.0001, 10, "least robust sigma of the neighbours",
               TERRAWALK_FIELD(ground.spike_floor_m)),
    };
}

std::vector<std::pair<std::string, std::optional<InterpolationMethod>>> methodChoices() {
    std::vector<std::pair<std::string, std::optional<InterpolationMethod>>> choices{{"auto", std::nullopt}};
    for (const auto& [method, text] : kInterpolationMethods) choices.emplace_back(text, method);
    return choices;
}

std::vector<Parameter> cleaningParameters() {
    return {
        flag("surface.clean.statistical.use",
             "leave out points farther from their neighbours than others are",
             TERRAWALK_FIELD(surface.cleaning.statistical.use)),
        integer<int>("surface.clean.statistical.neighbours", 1, 1000, "that the distance is taken to",
                     TERRAWALK_FIELD(surface.cleaning.statistical.neighbours)),
        number("surface.clean.statistical.sigmas", 0, 1000, "above the mean distance that leave a point out",
               TERRAWALK_FIELD(surface.cleaning.statistical.sigmas)),
        flag("surface.clean.radius.use", "leave out points with next to nobody around them",
             TERRAWALK_FIELD(surface.cleaning.radius.use)),
        number("surface.clean.radius.radius_m", 0, 1e4,
               "in which neighbours are counted, in space; 0: from the spacing of the points",
               TERRAWALK_FIELD(surface.cleaning.radius.radius_m)),
        integer<int>("surface.clean.radius.least_neighbours", 1, 1000, "that keep a point",
                     TERRAWALK_FIELD(surface.cleaning.radius.least_neighbours)),
        flag("surface.clean.above_ground.use",
             "leave out what stands on the ground and is narrow: plants, a hand before the range finder",
             TERRAWALK_FIELD(surface.cleaning.above_ground.use)),
        number("surface.clean.above_ground.cell_m", 0.01, 100, "windows are 3, 5, 9, ... of these wide",
               TERRAWALK_FIELD(surface.cleaning.above_ground.cell_m)),
        number("surface.clean.above_ground.greatest_window_m", 0.1, 1000, "what is wider is ground",
               TERRAWALK_FIELD(surface.cleaning.above_ground.greatest_window_m)),
        number("surface.clean.above_ground.slope", 0, 10, "of the ground",
               TERRAWALK_FIELD(surface.cleaning.above_ground.slope)),
        number("surface.clean.above_ground.least_height_m", 0.01, 100, "of what is left out",
               TERRAWALK_FIELD(surface.cleaning.above_ground.least_height_m)),
        number("surface.clean.above_ground.greatest_height_m", 0.01, 1000,
               "whatever stands higher is left out, steep ground or not",
               TERRAWALK_FIELD(surface.cleaning.above_ground.greatest_height_m)),
        number("surface.clean.above_ground.link_m", 0.01, 100, "points that near belong to one thing",
               TERRAWALK_FIELD(surface.cleaning.above_ground.link_m)),
        number("surface.clean.above_ground.terrace_length_m", 0, 1e4,
               "what goes on for so long is a terrace and stays; 0: nothing does",
               TERRAWALK_FIELD(surface.cleaning.above_ground.terrace_length_m)),
    };
}

std::vector<Parameter> surfaceParameters() {
    return {
        number("surface.thinning_cell_m", 0, 1000,
               "one point stands for each cell of this size; 0: all points",
               TERRAWALK_FIELD(surface.thinning_cell_m)),
        flag("surface.fixed_point_runs", "use the ground points of fixed-point runs as well",
             TERRAWALK_FIELD(surface.fixed_point_runs)),
        number("surface.longest_edge_m", 0, 1e6,
               "triangles with a longer edge are left out; 0: from the points",
               TERRAWALK_FIELD(surface.tin.longest_edge_m)),
        choice<std::optional<InterpolationMethod>>(
            "surface.method", methodChoices(),
            "how heights between points are interpolated; auto: the best by cross-validation",
            TERRAWALK_FIELD(surface.method)),
        choice<TerraceEdgeUse>("surface.terrace_edges", named(kTerraceEdgeUses),
                               "whether risers of half a metre and more are found in the points, for methods "
                               "linear and clough-tocher to follow",
                               TERRAWALK_FIELD(surface.terrace_edges)),
        flag("surface.cross_validate", "compare a method that is named with the plain one",
             TERRAWALK_FIELD(surface.cross_validate)),
        number("surface.cell_m", 0, 1e5, "cell size of the DEM; 0: from the density of the points",
               TERRAWALK_FIELD(surface.cell_m)),
        flag("surface.multiband",
             "write dem_multiband.tif as well: heights and standard errors, bands in the order of BAG",
             TERRAWALK_FIELD(surface.multiband)),
        flag("surface.occupancy.use",
             "map the space above the ground that the laser crossed (OctoMap) as well",
             TERRAWALK_FIELD(surface.map_space)),
        number("surface.occupancy.voxel_m", 0.01, 10, "side of a voxel",
               TERRAWALK_FIELD(surface.space.occupancy.voxel_m)),
        number("surface.occupancy.greatest_range_m", 0.1, 1000,
               "of a longer ray the first part counts as free, its hit for nothing",
               TERRAWALK_FIELD(surface.space.occupancy.greatest_range_m)),
        number("surface.occupancy.ground_layer_m", 0, 5, "what lies lower above the DEM counts as ground",
               TERRAWALK_FIELD(surface.space.above.ground_layer_m)),
        number("surface.occupancy.greatest_height_m", 0.1, 100, "how far up to look",
               TERRAWALK_FIELD(surface.space.above.greatest_height_m)),
        number("report.nearest_sample_limit_m", 0.01, 1e4,
               "marks farther from any ground point are not compared with one",
               TERRAWALK_FIELD(report.nearest_sample_limit_m)),
        number("report.vertical_class_m", 0, 10,
               "RMSE_V that the surface is tested for by the ASPRS standards; 0: none",
               TERRAWALK_FIELD(report.vertical_class_m)),
        choice<ReportLanguage>(
            "report.language", {{"en", ReportLanguage::English}, {"zh", ReportLanguage::Chinese}},
            "of report.html and report.pdf: English or Simplified Chinese", TERRAWALK_FIELD(report.language)),
        integer<std::uint64_t>("seed", 0, std::numeric_limits<std::int64_t>::max(),
                               "of the confidence intervals in the report", TERRAWALK_FIELD(seed)),
        number("fusion.lasting.gnss_correlation_s", 1, 100000,
               "time in which the lasting error of GNSS positions changes",
               TERRAWALK_FIELD(fusion.lasting.gnss_correlation_s)),
        number("fusion.lasting.gnss_white_share", 0.001, 1,
               "white noise of GNSS positions as a share of the sigma of the fix",
               TERRAWALK_FIELD(fusion.lasting.gnss_white_share)),
        number("fusion.lasting.gnss_white_share_fixed", 0.001, 1, "the same for RTK fixed",
               TERRAWALK_FIELD(fusion.lasting.gnss_white_share_fixed)),
        number("fusion.lasting.gnss_bias_sigma_m", 0.0001, 1000,
               "bias of GNSS positions without RTK, shared by all runs",
               TERRAWALK_FIELD(fusion.lasting.gnss_bias_sigma_m)),
        number("fusion.lasting.gnss_bias_run_sigma_m", 0.0001, 1000, "by which a run differs from that",
               TERRAWALK_FIELD(fusion.lasting.gnss_bias_run_sigma_m)),
        number("fusion.lasting.heading_sigma_deg", 0.01, 180, "compass error that wanders",
               TERRAWALK_FIELD(fusion.lasting.heading_sigma_deg)),
        number("fusion.lasting.heading_correlation_s", 1, 100000, "time in which it changes",
               TERRAWALK_FIELD(fusion.lasting.heading_correlation_s)),
        number("fusion.lasting.hard_iron_sigma_deg", 0.001, 90,
               "compass error A sin yaw + B cos yaw, shared by all runs",
               TERRAWALK_FIELD(fusion.lasting.hard_iron_sigma_deg)),
        number("fusion.lasting.hard_iron_run_sigma_deg", 0.001, 90, "by which a run differs from that",
               TERRAWALK_FIELD(fusion.lasting.hard_iron_run_sigma_deg)),
        number("fusion.lasting.flow_scale_sigma", 0.0001, 1,
               "error of scale of the optical flow, constant in a run",
               TERRAWALK_FIELD(fusion.lasting.flow_scale_sigma)),
        number("fusion.lasting.flow_scale_wander_sigma", 0, 1,
               "by which it wanders beside, where residuals of the flow show that it does; 0: never",
               TERRAWALK_FIELD(fusion.lasting.flow_scale_wander_sigma)),
        number("fusion.lasting.flow_scale_correlation_s", 1, 100000, "time in which it wanders",
               TERRAWALK_FIELD(fusion.lasting.flow_scale_correlation_s)),
        number("fusion.lasting.flow_axes_sigma", 0.0001, 1,
               "half the difference of the scales of forward and left",
               TERRAWALK_FIELD(fusion.lasting.flow_axes_sigma)),
        number("fusion.lasting.gyro_bias_sigma_dps", 0.0001, 100, "bias of the gyro, constant in a run",
               TERRAWALK_FIELD(fusion.lasting.gyro_bias_sigma_dps)),
        number("fusion.lasting.gyro_scale_sigma", 0.0001, 1, "error of scale of the gyro, constant in a run",
               TERRAWALK_FIELD(fusion.lasting.gyro_scale_sigma)),
        number("fusion.lasting.gyro_walk_deg_per_sqrt_s", 0.0001, 100,
               "by which a turn summed up from the gyro errs",
               TERRAWALK_FIELD(fusion.lasting.gyro_walk_deg_per_sqrt_s)),
        number("fusion.lasting.acceleration_bias_sigma_mps2", 1e-6, 10,
               "bias of each axis of the accelerometer",
               TERRAWALK_FIELD(fusion.lasting.acceleration_bias_sigma_mps2)),
        number("fusion.lasting.acceleration_bias_correlation_s", 1, 1e6,
               "time in which that of the vertical axis wanders",
               TERRAWALK_FIELD(fusion.lasting.acceleration_bias_correlation_s)),
        number("fusion.lasting.tilt_correlation_s", 1, 1e6,
               "time in which the error of the tilt wanders, and with it that of the level axes",
               TERRAWALK_FIELD(fusion.lasting.tilt_correlation_s)),
        number("fusion.drift.climb_sigma_mps", 0.01, 100, "vertical velocity of the array",
               TERRAWALK_FIELD(fusion.drift.climb_sigma_mps)),
        number("fusion.drift.climb_correlation_s", 0.01, 1000, "time in which it changes",
               TERRAWALK_FIELD(fusion.drift.climb_correlation_s)),
        flag("fusion.drift.adapt", "the noise of each sensor follows its innovations",
             TERRAWALK_FIELD(fusion.drift.adapt)),
        number("fusion.drift.adapt_memory_s", 1, 100000, "in which older innovations fade",
               TERRAWALK_FIELD(fusion.drift.adapt_memory_s)),
        number("fusion.drift.least_factor", 0.01, 1, "least factor on the variance of a sensor",
               TERRAWALK_FIELD(fusion.drift.least_factor)),
        number("fusion.drift.greatest_factor", 1, 1000, "greatest factor on the variance of a sensor",
               TERRAWALK_FIELD(fusion.drift.greatest_factor)),
        flag("fusion.joint.preview",
             "a quick look: crossovers bend the filter's tracks in a second stage, without the adjustment",
             TERRAWALK_FIELD(fusion.joint.preview)),
        number("fusion.joint.knot_s", 0.1, 60, "between the knots of the track's correction",
               TERRAWALK_FIELD(fusion.joint.knot_s)),
        number("fusion.joint.heading_knot_s", 1, 600, "between the knots of the compass error",
               TERRAWALK_FIELD(fusion.joint.heading_knot_s)),
        number("fusion.joint.gnss_knot_s", 0.2, 600, "between the knots of the GNSS error",
               TERRAWALK_FIELD(fusion.joint.gnss_knot_s)),
        number("fusion.joint.barometer_knot_s", 1, 600, "between the knots of the barometer's drift",
               TERRAWALK_FIELD(fusion.joint.barometer_knot_s)),
        integer<int>("fusion.joint.rounds", 1, 50, "rounds of the adjustment with crossovers",
                     TERRAWALK_FIELD(fusion.joint.rounds)),
        flag("fusion.joint.use_crossovers", "hold passes over the same ground together",
             TERRAWALK_FIELD(fusion.joint.use_crossovers)),
        flag("fusion.joint.adapt_noise", "scale the noise of each sensor by what its residuals say",
             TERRAWALK_FIELD(fusion.joint.adapt_noise)),
        number("fusion.joint.crossovers.spacing_m", 0.05, 100,
               "along a pass between the places where others are looked for",
               TERRAWALK_FIELD(fusion.joint.crossovers.spacing_m)),
        number("fusion.joint.crossovers.gate_m", 0.05, 100, "farthest apart of two passes in plan",
               TERRAWALK_FIELD(fusion.joint.crossovers.gate_m)),
        number("fusion.joint.crossovers.radius_m", 0.1, 100, "of the ground that is fitted about a crossover",
               TERRAWALK_FIELD(fusion.joint.crossovers.radius_m)),
        number("fusion.joint.crossovers.apart_s", 1, 100000,
               "passes of one run are at least so far apart in time",
               TERRAWALK_FIELD(fusion.joint.crossovers.apart_s)),
        number("fusion.joint.crossovers.bandwidth_m", 0.05, 100,
               "of the weights that fall with the distance from a crossover",
               TERRAWALK_FIELD(fusion.joint.crossovers.bandwidth_m)),
        number("fusion.joint.crossovers.ridge_m2", 0, 1000,
               "holds the slope at a crossover back where the points do not tell it",
               TERRAWALK_FIELD(fusion.joint.crossovers.ridge_m2)),
        integer<std::size_t>("fusion.joint.crossovers.fewest_points", 1, 1000, "of each pass at a crossover",
                             TERRAWALK_FIELD(fusion.joint.crossovers.fewest_points)),
        number("fusion.joint.pair_sigma_m", 0.001, 10, "misfit of two passes over even ground",
               TERRAWALK_FIELD(fusion.joint.pair_sigma_m)),
        number("fusion.joint.pair_even_slope", 0.001, 10, "slope at which ground is half uneven",
               TERRAWALK_FIELD(fusion.joint.pair_even_slope)),
        number("fusion.joint.pair_uneven_m", 0, 10, "added to the misfit over uneven ground",
               TERRAWALK_FIELD(fusion.joint.pair_uneven_m)),
        number("fusion.joint.pair_apart_per_m", 0, 10,
               "added to that, times the squared distance of the passes",
               TERRAWALK_FIELD(fusion.joint.pair_apart_per_m)),
        number("fusion.joint.pair_plan_share", 0, 1, "of the slope that turns errors of the plan into height",
               TERRAWALK_FIELD(fusion.joint.pair_plan_share)),
        number("fusion.joint.pair_weight", 0.01, 1, "neighbouring crossovers share points",
               TERRAWALK_FIELD(fusion.joint.pair_weight)),
        number("fusion.joint.left_out_crossovers", 0, 0.9,
               "share of the ground, in cells of 10 m, whose crossovers only test the result",
               TERRAWALK_FIELD(fusion.joint.left_out_crossovers)),
        number("fusion.joint.walk_mps_per_sqrt_s", 0.01, 100, "random walk of the horizontal velocity",
               TERRAWALK_FIELD(fusion.joint.walk_mps_per_sqrt_s)),
        number("fusion.joint.ground_roughness_m", 0.001, 10, "of the ground below the walk about its level",
               TERRAWALK_FIELD(fusion.joint.ground_roughness_m)),
        number("fusion.joint.ground_climb_m_per_sqrt_m", 0.001, 10, "by which that level wanders",
               TERRAWALK_FIELD(fusion.joint.ground_climb_m_per_sqrt_m)),
        number("fusion.joint.acceleration_noise_mps2", 0, 10,
               "white noise of the accelerometer, which tells how the height bends; 0: it does not",
               TERRAWALK_FIELD(fusion.joint.acceleration_noise_mps2)),
        number("fusion.joint.acceleration_knot_s", 1, 600, "between the knots of the accelerometer's bias",
               TERRAWALK_FIELD(fusion.joint.acceleration_knot_s)),
        number("fusion.joint.blind_climb_m_per_sqrt_s", 0.001, 10,
               "by which the array climbs where no range was measured",
               TERRAWALK_FIELD(fusion.joint.blind_climb_m_per_sqrt_s)),
    };
}

/// A list of values that are texts or objects; `fromJson` gives nothing for one that is not permitted.
template <class Item>
Parameter list(std::string key, std::string range, std::string meaning, Field<std::vector<Item>> field,
               ordered_json (*toJson)(const Item&), std::optional<Item> (*fromJson)(const json&)) {
    Parameter p{std::move(key), std::move(range), std::move(meaning), {}, {}};
    p.get = [field, toJson](const PipelineConfig& config) {
        ordered_json items = ordered_json::array();
        for (const Item& item : read(field, config)) items.push_back(toJson(item));
        return items;
    };
    p.set = [field, fromJson, p](PipelineConfig& config, const json& value) -> Result<void> {
        if (!value.is_array()) return usageError(wrongValue(p, value), "give a list: " + p.range);
        std::vector<Item> items;
        for (const json& one : value) {
            auto item = fromJson(one);
            if (!item) {
                return usageError(fmt::format("item {} of {} is not permitted", items.size() + 1, p.key),
                                  "permitted: " + p.range);
            }
            items.push_back(std::move(*item));
        }
        field(config) = std::move(items);
        return {};
    };
    return p;
}

ordered_json nameJson(const std::string& text) {
    return text;
}

std::optional<std::string> nameOf(const json& value) {
    if (!value.is_string()) return std::nullopt;
    return value.get<std::string>();
}

ordered_json stretchJson(const ExcludedStretch& s) {
    return {{"run", s.run},
            {"from_s", s.from_s},
            {"to_s", s.to_s},
            {"sensor", kEditedSensors[static_cast<std::size_t>(s.sensor)].second}};
}

template <class Enum, std::size_t n>
std::optional<Enum> valueNamed(const std::array<std::pair<Enum, std::string_view>, n>& names,
                               const json& text) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const auto& entry) {
        return text.is_string() && text.get_ref<const std::string&>() == entry.second;
    });
    if (found == names.end()) return std::nullopt;
    return found->first;
}

std::optional<ExcludedStretch> stretchOf(const json& value) {
    if (!value.is_object() || !value.contains("run") || !value["run"].is_string()) return std::nullopt;
    ExcludedStretch stretch{value["run"].get<std::string>()};
    for (const auto& [key, time_s] : {std::pair{"from_s", &stretch.from_s}, {"to_s", &stretch.to_s}}) {
        if (!value.contains(key) || !value[key].is_number()) return std::nullopt;
        *time_s = value[key].template get<double>();
    }
    const auto sensor = valueNamed(kEditedSensors, value.value("sensor", json("all")));
    if (!sensor || !(stretch.from_s <= stretch.to_s)) return std::nullopt;
    stretch.sensor = *sensor;
    return stretch;
}

ordered_json lineJson(const Breakline& line) {
    ordered_json vertices = ordered_json::array();
    for (const Eigen::Vector3d& v : line.vertices_m) {
        ordered_json vertex{v.x(), v.y()};
        if (present(v.z())) vertex.push_back(v.z());
        vertices.push_back(std::move(vertex));
    }
    return {{"kind", kBreaklineKinds[static_cast<std::size_t>(line.kind)].second}, {"vertices_m", vertices}};
}

std::optional<Eigen::Vector3d> vertexOf(const json& value) {
    if (!value.is_array() || value.size() < 2 || value.size() > 3) return std::nullopt;
    Eigen::Vector3d vertex(kMissing, kMissing, kMissing);
    for (std::size_t axis = 0; axis < value.size(); ++axis) {
        if (!value[axis].is_number()) return std::nullopt;
        vertex[static_cast<Eigen::Index>(axis)] = value[axis].get<double>();
    }
    return vertex;
}

std::optional<Breakline> lineOf(const json& value) {
    if (!value.is_object() || !value.contains("vertices_m") || !value["vertices_m"].is_array()) {
        return std::nullopt;
    }
    const auto kind = valueNamed(kBreaklineKinds, value.value("kind", json("hard")));
    if (!kind) return std::nullopt;
    Breakline line{{}, *kind, {}};
    for (const json& one : value["vertices_m"]) {
        const auto vertex = vertexOf(one);
        if (!vertex) return std::nullopt;
        line.vertices_m.push_back(*vertex);
    }
    return line;
}

std::vector<Parameter> editParameters() {
    return {
        list<ExcludedStretch>("edits.stretches",
                              "[{\"run\": \"S01\", \"from_s\": 1, \"to_s\": 2, \"sensor\": \"all\"}, ...] "
                              "with sensor all, gnss, barometer, flow, attitude or range",
                              "readings that are left out", TERRAWALK_FIELD(edits.stretches), stretchJson,
                              stretchOf),
        list<std::string>("edits.runs", "[\"S01\", ...]", "runs that are left out",
                          TERRAWALK_FIELD(edits.runs), nameJson, nameOf),
        list<std::string>("edits.marks", "[\"P01\", ...]",
                          "marks that are left out: neither control nor check", TERRAWALK_FIELD(edits.marks),
                          nameJson, nameOf),
        list<Breakline>(
            "edits.lines",
            "[{\"kind\": \"hard\", \"vertices_m\": [[x, y], ...]}, ...] in the map frame, a third "
            "number is a height; kind hard, soft, boundary or hole",
            "lines that the surface keeps to, beside those of the survey's file",
            TERRAWALK_FIELD(edits.lines), lineJson, lineOf),
    };
}

// An option that is added without a parameter could be neither set nor reported.
static_assert(sizeof(FusionOptions) == 1272, "add the new option to fusionParameters()");
static_assert(sizeof(AukfOptions) == 168, "add the new option to aukfParameters()");
static_assert(sizeof(GroundPointOptions) == 112, "add the new option to groundParameters()");
static_assert(sizeof(PointCleaningOptions) == 104, "add the new option to cleaningParameters()");
static_assert(sizeof(SurfaceOptions) == 224, "add the new option to surfaceParameters()");
static_assert(sizeof(ReportOptions) == 24, "add the new option to the report's parameters");

const std::vector<Parameter>& parameters() {
    static const std::vector<Parameter> kParameters = [] {
        std::vector<Parameter> all = fusionParameters();
        for (const auto& part : {aukfParameters(), groundParameters(), cleaningParameters(),
                                 surfaceParameters(), editParameters()})
            all.insert(all.end(), part.begin(), part.end());
        return all;
    }();
    return kParameters;
}

#undef TERRAWALK_FIELD

std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, substituted});
        }
    }
    return row.back();
}

Result<const Parameter*> findParameter(std::string_view key) {
    const auto& all = parameters();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.key == key; });
    if (found != all.end()) return &*found;
    const auto nearest =
        std::min_element(all.begin(), all.end(), [&](const Parameter& a, const Parameter& b) {
            return editDistance(a.key, key) < editDistance(b.key, key);
        });
    return usageError(fmt::format("unknown parameter '{}'", key.substr(0, 80)),
                      fmt::format("did you mean {}? `terrawalk config describe` lists all", nearest->key));
}

std::string shortText(const ordered_json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

Result<void> applyTuning(PipelineConfig& config, const json& section) {
    try {
        config.tuning = tuningOf(section);
    } catch (const json::exception&) {
        return usageError("the section \"tuning\" is not as `terrawalk tune` writes it",
                          "leave it as it was, or out");
    }
    return {};
}

// {"fusion": {"gnss": {"x": 1}}} sets "fusion.gnss.x".
Result<void> applyObject(PipelineConfig& config, const json& object, const std::string& prefix) {
    for (const auto& [key, value] : object.items()) {
        const std::string path = prefix.empty() ? key : prefix + "." + key;
        if (path == "tuning") {
            if (auto done = applyTuning(config, value); !done) return done;
            continue;
        }
        // No key is longer than an assignment on a command line: what nests deeper is no configuration of
        // ours.
        if (value.is_object() && path.size() < 100) {
            if (auto done = applyObject(config, value, path); !done) return done;
            continue;
        }
        if (path == "format") {
            if (value != "terrawalk-config 1") return usageError("format must be \"terrawalk-config 1\"");
            continue;
        }
        const auto parameter = findParameter(path);
        if (!parameter) return tl::unexpected(parameter.error());
        if (auto done = (*parameter)->set(config, value); !done) return done;
    }
    return {};
}

}  // namespace

std::vector<ParameterInfo> describeParameters() {
    const PipelineConfig defaults;
    std::vector<ParameterInfo> described;
    for (const Parameter& p : parameters()) {
        described.push_back({p.key, shortText(p.get(defaults)), p.range, p.meaning});
    }
    return described;
}

Result<void> applySetting(PipelineConfig& config, std::string_view assignment) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string_view::npos) {
        return usageError(fmt::format("'{}' is no setting", assignment.substr(0, 80)), "write key=value");
    }
    const auto parameter = findParameter(assignment.substr(0, equals));
    if (!parameter) return tl::unexpected(parameter.error());
    const std::string text(assignment.substr(equals + 1));
    // What is no JSON number or boolean is a word, such as the name of a method.
    json value = json::parse(text, nullptr, false);
    if (value.is_discarded()) value = text;
    return (*parameter)->set(config, value);
}

std::string settingText(const PipelineConfig& config, std::string_view key) {
    const auto parameter = findParameter(key);
    return parameter ? shortText((*parameter)->get(config)) : std::string();
}

Result<void> applyConfigFile(PipelineConfig& config, const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::error_code error;
    if (!stream || !std::filesystem::is_regular_file(file, error)) {
        return badData("cannot be read", file, 0, "check the path");
    }
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    const std::string text = bytes.str();
    json document;
    try {
        document = json::parse(text);
    } catch (const json::parse_error& problem) {
        const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(problem.byte, text.size()));
        return badData("is not valid JSON", file,
                       1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n')));
    } catch (const json::exception&) {
        return badData("holds a number that is too large", file);
    }
    if (!document.is_object()) return badData("must hold one JSON object", file, 1);
    if (auto done = applyObject(config, document, ""); !done) {
        Error problem = done.error();
        problem.kind = ErrorKind::BadData;
        problem.file = file;
        return tl::unexpected(problem);
    }
    return {};
}

std::string toJson(const PipelineConfig& config) {
    ordered_json document{{"format", "terrawalk-config 1"}};
    for (const Parameter& p : parameters()) {
        std::string pointer = "/" + p.key;
        std::replace(pointer.begin(), pointer.end(), '.', '/');
        document[ordered_json::json_pointer(pointer)] = p.get(config);
    }
    if (config.tuning) document["tuning"] = tuningJson(*config.tuning);
    return document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::vector<UsedSetting> settingsReport(const PipelineConfig& requested, const PipelineConfig& used) {
    const PipelineConfig defaults;
    std::vector<UsedSetting> settings;
    for (const Parameter& p : parameters()) {
        const std::string asked = shortText(p.get(requested));
        settings.push_back(
            {p.key, asked == shortText(p.get(defaults)) ? "default" : asked, shortText(p.get(used))});
    }
    return settings;
}

}  // namespace terrawalk
