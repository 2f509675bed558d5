#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fusion/barometer.hpp"
#include "survey/survey.hpp"
#include "tests/fusion/normal_numbers.hpp"

namespace terrawalk {

/// Errors of the sensors of a made run, 1 sigma of white noise each.
struct MadeErrors {
    double gnss_m = 1.0;
    double barometer_m = 0.06;
    double flow_mps = 0.05;
    double acceleration_mps2 = 0.3;
    double range_m = 0.02;
    double doppler_mps = 0.1;
};

struct MadeOptions {
    std::uint64_t seed = 1;
    std::size_t epochs = 300;
    double interval_s = 0.2;
    double speed_mps = 1.0;  ///< 0: stands on the start mark all the time
    double still_s = 3.0;    ///< at both ends
    int fix = fix_code::kSingle;
    bool ellipsoidal_height = true;
    bool doppler = false;
    Eigen::Vector3d gnss_lever_arm_m = Eigen::Vector3d::Zero();
    MadeErrors errors{};
};

/// A survey of one area run, ZERO to T01, north-east over a slope of 5 %, with all sensors, and its truth.
struct MadeRun {
    Survey survey;
    std::vector<Eigen::Vector3d> position_enu_m;
    std::vector<Eigen::Vector3d> velocity_enu_mps;

    [[nodiscard]] Run& run() { return survey.runs.front(); }
    [[nodiscard]] const Run& run() const { return survey.runs.front(); }
    [[nodiscard]] ArrayLog& log() { return run().log; }
    void erase(Channel channel) { log().column(channel).clear(); }
};

inline MadeRun makeRun(const MadeOptions& options = {}) {
    constexpr double kArrayHeight_m = 1.2;
    constexpr double kSlope = 0.05;
    NormalNumbers normal(options.seed);
    MadeRun made;
    Survey& survey = made.survey;
    survey.name = "made";
    survey.zero_point = {23.182753, 113.399795, 38.0};
    Run run;
    run.id = "S01";
    run.kind = RunKind::Area;
    run.start = std::string(kZeroMark);
    ArrayLog& log = run.log;
    log.file = "S01.csv";
    log.gnss_lever_arm_m = options.gnss_lever_arm_m;
    for (std::vector<double>& column : log.channels) column.assign(options.epochs, kMissing);
    const LocalFrame frame = survey.frame();
    const double yaw = radians(30.0);
    const double last_s = static_cast<double>(options.epochs - 1) * options.interval_s;
    const auto put = [&](Channel channel, std::size_t i, double value) {
        log.column(channel)[i] = value;
    };

    double way_m = 0.0;
    double speed_before = 0.0;
    for (std::size_t i = 0; i < options.epochs; ++i) {
        const double time_s = static_cast<double>(i) * options.interval_s;
        // A second to set off, a second to stop.
        const double speed = options.speed_mps * std::clamp(time_s - options.still_s, 0.0, 1.0) *
                             std::clamp(last_s - options.still_s - time_s, 0.0, 1.0);
        const double gained = i == 0 ? 0.0 : (speed - speed_before) / options.interval_s;
        way_m += 0.5 * (speed_before + speed) * (i == 0 ? 0.0 : options.interval_s);
        speed_before = speed;
        const Eigen::Vector3d direction(std::cos(yaw), std::sin(yaw), kSlope);
        const Eigen::Vector3d position = way_m * direction + kArrayHeight_m * Eigen::Vector3d::UnitZ();
        const Eigen::Vector3d velocity = speed * direction;
        const Attitude attitude{radians(2.0 * std::sin(time_s)), radians(3.0 * std::cos(0.7 * time_s)), yaw};
        const Eigen::Matrix3d R = rotationEnuFromBody(attitude);
        made.position_enu_m.push_back(position);
        made.velocity_enu_mps.push_back(velocity);
        log.time_s.push_back(time_s);

        const Eigen::Vector3d noise(normal(), normal(), 1.5 * normal());
        const GeodeticPosition fix =
            frame.toGeodetic(position + R * options.gnss_lever_arm_m + options.errors.gnss_m * noise);
        put(Channel::Latitude, i, fix.lat_deg);
        put(Channel::Longitude, i, fix.lon_deg);
        if (options.ellipsoidal_height) put(Channel::EllipsoidalHeight, i, fix.h_ell_m);
        put(Channel::Fix, i, options.fix);
        if (options.doppler) {
            put(Channel::GnssVelocityEast, i, velocity.x() + options.errors.doppler_mps * normal());
            put(Channel::GnssVelocityNorth, i, velocity.y() + options.errors.doppler_mps * normal());
            put(Channel::GnssVelocityUp, i, velocity.z() + options.errors.doppler_mps * normal());
        }
        put(Channel::Pressure, i, isaPressure(position.z() + 71.0 + options.errors.barometer_m * normal()));
        put(Channel::FlowForward, i, speed + options.errors.flow_mps * normal());
        put(Channel::FlowLeft, i, options.errors.flow_mps * normal());
        put(Channel::FlowQuality, i, 200.0);
        put(Channel::Roll, i, attitude.roll_rad);
        put(Channel::Pitch, i, attitude.pitch_rad);
        put(Channel::Heading, i, yawFromHeading(yaw));
        const Eigen::Vector3d force =
            R.transpose() * (gained * direction + Eigen::Vector3d(0.0, 0.0, kStandardGravity_mps2));
        put(Channel::AccelerationX, i, force.x() + options.errors.acceleration_mps2 * normal());
        put(Channel::AccelerationY, i, force.y() + options.errors.acceleration_mps2 * normal());
        put(Channel::AccelerationZ, i, force.z() + options.errors.acceleration_mps2 * normal());
        put(Channel::Range, i, kArrayHeight_m / R(2, 2) + options.errors.range_m * normal());
    }
    if (!options.doppler) {
        for (const Channel c :
             {Channel::GnssVelocityEast, Channel::GnssVelocityNorth, Channel::GnssVelocityUp}) {
            log.column(c).clear();
        }
    }
    if (!options.ellipsoidal_height) log.column(Channel::EllipsoidalHeight).clear();
    ControlMark target{"T01", made.position_enu_m.back() - kArrayHeight_m * Eigen::Vector3d::UnitZ(), 0.005,
                       0.005, MarkRole::Control};
    survey.marks.push_back(target);
    survey.runs.push_back(std::move(run));
    return made;
}

}  // namespace terrawalk
