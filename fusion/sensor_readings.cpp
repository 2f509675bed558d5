#include "fusion/sensor_readings.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fusion/barometer.hpp"
#include "survey/upper_median.hpp"

namespace terrawalk {

namespace {

double squared(double x) {
    return x * x;
}

// What stands in for one angle of the attitude while its channel is silent.
struct HeldAngle {
    double value_rad = 0.0;
    double measured_s = -std::numeric_limits<double>::infinity();
    std::size_t held_epochs = 0;

    bool everMeasured() const { return std::isfinite(measured_s); }
    void take(double value, double time_s) {
        if (present(value)) {
            value_rad = value;
            measured_s = time_s;
        } else {
            ++held_epochs;
        }
    }
};

void noteHeld(std::string_view what, std::string_view instead, const HeldAngle& angle, std::size_t epochs,
              RunNotes& notes) {
    if (angle.held_epochs == 0) return;
    if (angle.everMeasured()) {
        notes.details.push_back(fmt::format("{} missing in {} of {} epochs; the last value is held", what,
                                            angle.held_epochs, epochs));
    } else {
        notes.limitations.push_back(fmt::format("no {}; {}", what, instead));
    }
}

void readHeading(const ReadingContext& context, std::size_t i, const StateEstimate& prediction,
                 std::vector<Reading>& readings) {
    const YawRowOptions& options = context.options.yaw_row;
    const EpochAttitude& attitude = context.attitudes[i];
    if (!options.use || !present(context.log.value(Channel::Heading, i))) return;
    Reading reading(Sensor::Heading);
    if (prediction.mean.head<2>().norm() < options.slowest_mps) {
        reading.rejection = "too slow";
    } else {
        const YawRow row{attitude.attitude.yaw_rad - radians(options.mount_offset_deg),
                         squared(radians(options.sigma_deg))};
        const LinearRow linear = linearised(prediction, row, context.options.unscented);
        reading.rows[reading.row_count++] = {linear, linear.variance};
    }
    readings.push_back(reading);
}

void readGnssPosition(const ReadingContext& context, std::size_t i, const StateEstimate& prediction,
                      const SensorMemory& memory, std::vector<Reading>& readings) {
    const GnssOptions& options = context.options.gnss;
    const double up_m = prediction.block(StateBlock::Position).z();
    const auto position = gnssPosition(context.log, i, context.frame, context.attitudes[i], up_m);
    if (!position) return;
    const GnssQuality quality = gnssQuality(context.log, i, options);
    const double time_s = context.log.time_s[i];

    if (options.use_position) {
        Reading reading(Sensor::GnssPosition, quality.rejection);
        const double variance = squared(quality.sigma_m) + position->arm_variance_m2;
        const double factor =
            whiteNoiseFactor(quality.correlation_s, time_s - memory.lastUsed(Sensor::GnssPosition));
        if (quality.rejection.empty()) {
            for (int axis = 0; axis < 2; ++axis) {
                reading.add(StateBlock::Position, Eigen::Vector3d::Unit(axis), position->enu_m[axis],
                            factor * variance, variance);
            }
        }
        readings.push_back(reading);
    }
    if (present(position->enu_m.z()) && context.reference.gnss_height != GnssHeightUse::Never) {
        Reading reading(Sensor::GnssHeight, quality.rejection);
        const double variance = squared(quality.sigma_up_m) + position->arm_variance_up_m2;
        const double factor =
            whiteNoiseFactor(quality.correlation_s, time_s - memory.lastUsed(Sensor::GnssHeight));
        if (quality.rejection.empty()) {
            const double silent_since_s =
                std::max(memory.lastUsed(Sensor::Barometer), context.log.time_s.front());
            if (context.reference.gnss_height == GnssHeightUse::Rtk && !quality.rtk &&
                time_s - silent_since_s <= context.options.barometer.longest_silence_s) {
                reading.rejection = "no RTK fix";
            } else {
                reading.add(StateBlock::Position, Eigen::Vector3d::UnitZ(), position->enu_m.z(),
                            factor * variance, variance);
            }
        }
        readings.push_back(reading);
    }
}

void readGnssVelocity(const ReadingContext& context, std::size_t i, const SensorMemory& memory,
                      std::vector<Reading>& readings) {
    const ArrayLog& log = context.log;
    const GnssOptions& options = context.options.gnss;
    const Eigen::Vector3d velocity(log.value(Channel::GnssVelocityEast, i),
                                   log.value(Channel::GnssVelocityNorth, i),
                                   log.value(Channel::GnssVelocityUp, i));
    const auto rejection = dopplerRejection(log, i);
    if (!options.use_velocity || !rejection) return;
    Reading reading(Sensor::GnssVelocity, *rejection);
    if (!rejection->empty()) {
        readings.push_back(reading);
        return;
    }
    // The antenna also moves about the array as this turns.
    Eigen::Vector3d lever_velocity = Eigen::Vector3d::Zero();
    const Eigen::Vector3d rate(log.value(Channel::AngularRateX, i), log.value(Channel::AngularRateY, i),
                               log.value(Channel::AngularRateZ, i));
    if (!log.gnss_lever_arm_m.isZero() && rate.allFinite() && context.attitudes[i].heading_known) {
        const Eigen::Vector3d body = rate.cross(log.gnss_lever_arm_m);
        lever_velocity = rotationEnuFromBody(context.attitudes[i].attitude) * body;
    }
    const double factor = whiteNoiseFactor(options.velocity_correlation_s,
                                           log.time_s[i] - memory.lastUsed(Sensor::GnssVelocity));
    for (int axis = 0; axis < 3; ++axis) {
        if (!present(velocity[axis])) continue;
        const double variance =
            squared(axis == 2 ? options.velocity_sigma_up_mps : options.velocity_sigma_mps);
        reading.add(StateBlock::Velocity, Eigen::Vector3d::Unit(axis), velocity[axis] - lever_velocity[axis],
                    factor * variance, variance);
    }
    readings.push_back(reading);
}

void readBarometer(const ReadingContext& context, std::size_t i, const StateEstimate& prediction,
                   const SensorMemory& memory, std::vector<Reading>& readings) {
    const BarometerOptions& options = context.options.barometer;
    const auto rejection = barometerRejection(context.log, i);
    if (!options.use || !rejection || !context.reference.barometer_zero_m) return;
    Reading reading(Sensor::Barometer, *rejection);
    if (rejection->empty()) {
        const double up_m = context.reference.barometricUp(
            context.log.value(Channel::Pressure, i), options.scale, prediction.block(StateBlock::Position));
        const double time_s = context.log.time_s[i];
        const auto [white, lasting] =
            barometerVariance(options, time_s - context.reference.barometer_zero_time_s);
        const double factor =
            whiteNoiseFactor(options.gust_correlation_s, time_s - memory.lastUsed(Sensor::Barometer));
        reading.add(StateBlock::Position, Eigen::Vector3d::UnitZ(), up_m, white + factor * lasting,
                    white + lasting);
    }
    readings.push_back(reading);
}

// Along and across the measured direction, where errors of scale and of heading fall apart.
void addFlowRows(const Eigen::Vector2d& flow_mps, const EpochAttitude& attitude, const FlowOptions& options,
                 double factor, Reading& reading) {
    const double speed = flow_mps.norm();
    const double noise = flowVariance(options, speed);
    const double lasting_along = squared(options.scale_sigma * speed);
    const double lasting_across = squared(attitude.sigma_heading_rad * speed);
    const double course_rad =
        attitude.attitude.yaw_rad + (speed > 0.0 ? std::atan2(flow_mps.y(), flow_mps.x()) : 0.0);
    const Eigen::Vector3d along(std::cos(course_rad), std::sin(course_rad), 0.0);
    const Eigen::Vector3d across(-along.y(), along.x(), 0.0);
    reading.add(StateBlock::Velocity, along, speed, noise + factor * lasting_along, noise + lasting_along);
    reading.add(StateBlock::Velocity, across, 0.0, noise + factor * lasting_across, noise + lasting_across);
}

void readFlow(const ReadingContext& context, std::size_t i, const SensorMemory& memory,
              std::vector<Reading>& readings) {
    const ArrayLog& log = context.log;
    const FlowOptions& options = context.options.flow;
    if (!options.use) return;
    const EpochAttitude& attitude = context.attitudes[i];
    const double time_s = log.time_s[i];
    const double since_s = time_s - memory.lastUsed(Sensor::OpticalFlow);
    if (const auto rejection = context.flow_rejections[i]) {
        Reading reading(Sensor::OpticalFlow, *rejection);
        if (rejection->empty()) {
            const Eigen::Vector2d flow_mps(log.value(Channel::FlowForward, i),
                                           log.value(Channel::FlowLeft, i));
            addFlowRows(flow_mps, attitude, options, whiteNoiseFactor(options.correlation_s, since_s),
                        reading);
        }
        readings.push_back(reading);
        if (rejection->empty()) return;
    }
    const bool bridge = options.bridge_dropouts && attitude.heading_known &&
                        since_s > options.bridge_after_s && since_s <= options.bridge_longest_s &&
                        time_s - memory.lastUsed(Sensor::GnssVelocity) > options.bridge_after_s;
    if (!bridge) return;
    Reading reading(Sensor::MeanFlow);
    const double yaw = attitude.attitude.yaw_rad;
    const double variance = squared(options.bridge_sigma_mps);
    const double believed = variance * whiteNoiseFactor(options.bridge_memory_s, time_s - memory.lastFlow());
    reading.add(StateBlock::Velocity, {std::cos(yaw), std::sin(yaw), 0.0}, memory.mean_flow_mps.x(), believed,
                variance);
    reading.add(StateBlock::Velocity, {-std::sin(yaw), std::cos(yaw), 0.0}, memory.mean_flow_mps.y(),
                believed, variance);
    readings.push_back(reading);
}

void readAccelerometer(const ReadingContext& context, std::size_t i, std::vector<Reading>& readings) {
    const ArrayLog& log = context.log;
    const Eigen::Vector3d specific_force(log.value(Channel::AccelerationX, i),
                                         log.value(Channel::AccelerationY, i),
                                         log.value(Channel::AccelerationZ, i));
    if (!context.options.accelerometer.use || specific_force.array().isNaN().all()) return;
    const EpochAttitude& attitude = context.attitudes[i];
    Reading reading(Sensor::Accelerometer);
    if (!specific_force.allFinite()) {
        reading.rejection = "one component missing";
    } else if (!attitude.tilt_known) {
        reading.rejection = "no attitude";
    } else {
        const Eigen::Vector3d acceleration = rotationEnuFromBody(attitude.attitude) * specific_force -
                                             kStandardGravity_mps2 * Eigen::Vector3d::UnitZ();
        const double noise = squared(context.options.accelerometer.sigma_mps2);
        const double leaned = noise + squared(kStandardGravity_mps2 * attitude.sigma_tilt_rad);
        if (attitude.heading_known) {
            reading.add(StateBlock::Acceleration, Eigen::Vector3d::UnitX(), acceleration.x(), leaned, leaned);
            reading.add(StateBlock::Acceleration, Eigen::Vector3d::UnitY(), acceleration.y(), leaned, leaned);
        }
        reading.add(StateBlock::Acceleration, Eigen::Vector3d::UnitZ(), acceleration.z(), noise, noise);
    }
    readings.push_back(reading);
}

}  // namespace

std::string_view name(Sensor sensor) {
    static constexpr std::array<std::string_view, kSensorCount> kNames{
        "heading row", "mark tie",     "GNSS position",     "GNSS height",   "GNSS velocity",
        "barometer",   "optical flow", "mean optical flow", "accelerometer", "height assumption"};
    return kNames[static_cast<std::size_t>(sensor)];
}

std::vector<EpochAttitude> epochAttitudes(const ArrayLog& log, const AttitudeOptions& options,
                                          RunNotes& notes) {
    std::vector<EpochAttitude> attitudes(log.size());
    HeldAngle roll, pitch, heading;
    for (std::size_t i = 0; i < log.size(); ++i) {
        const double time_s = log.time_s[i];
        roll.take(log.value(Channel::Roll, i), time_s);
        pitch.take(log.value(Channel::Pitch, i), time_s);
        heading.take(log.value(Channel::Heading, i), time_s);
        const double tilt_s = std::min(roll.measured_s, pitch.measured_s);

        EpochAttitude& epoch = attitudes[i];
        epoch.attitude.roll_rad = roll.value_rad;
        epoch.attitude.pitch_rad = pitch.value_rad;
        epoch.attitude.yaw_rad = heading.everMeasured() ? yawFromHeading(heading.value_rad) : 0.0;
        epoch.tilt_known = time_s - tilt_s <= options.longest_hold_s;
        epoch.heading_known = time_s - heading.measured_s <= options.longest_hold_s;
        epoch.sigma_tilt_rad = radians(tilt_s == time_s        ? options.sigma_tilt_deg
                                       : std::isfinite(tilt_s) ? options.sigma_tilt_held_deg
                                                               : options.sigma_tilt_unknown_deg);
        epoch.sigma_heading_rad = heading.measured_s == time_s ? radians(options.sigma_heading_deg)
                                  : heading.everMeasured()     ? radians(options.sigma_heading_held_deg)
                                                               : kPi / std::sqrt(3.0);
    }
    noteHeld("roll", "the array is taken to be level", roll, log.size(), notes);
    noteHeld("pitch", "the array is taken to be level", pitch, log.size(), notes);
    noteHeld("heading", "optical flow and horizontal acceleration cannot be used", heading, log.size(),
             notes);
    return attitudes;
}

GnssFixClass gnssFixClass(const ArrayLog& log, std::size_t epoch) {
    const double fix = log.value(Channel::Fix, epoch);
    if (!present(fix)) return kSingleClass;
    if (std::lround(fix) == fix_code::kRtkFixed) return kFixedClass;
    return std::lround(fix) == fix_code::kRtkFloat ? kFloatClass : kSingleClass;
}

double gnssWhiteShare(const ArrayLog& log, std::size_t epoch, const LastingErrorOptions& lasting) {
    return gnssFixClass(log, epoch) == kFixedClass ? lasting.gnss_white_share_fixed
                                                   : lasting.gnss_white_share;
}

GnssQuality gnssQuality(const ArrayLog& log, std::size_t epoch, const GnssOptions& options) {
    GnssQuality quality;
    quality.correlation_s = options.correlation_s;
    const double fix = log.value(Channel::Fix, epoch);
    // A log without the column says nothing against its positions; the least of the fixes is assumed.
    const long code = present(fix) ? std::lround(fix) : fix_code::kSingle;
    switch (code) {
        case fix_code::kNone:
            quality.rejection = "no fix";
            return quality;
        case fix_code::kSingle:
            quality.sigma_m = options.sigma_single_m;
            quality.sigma_up_m = options.sigma_single_up_m;
            break;
        case fix_code::kDifferential:
            quality.sigma_m = options.sigma_differential_m;
            quality.sigma_up_m = options.sigma_differential_up_m;
            break;
        case fix_code::kRtkFixed:
            quality.sigma_m = options.sigma_fixed_m;
            quality.sigma_up_m = options.sigma_fixed_up_m;
            quality.correlation_s = options.correlation_fixed_s;
            quality.rtk = true;
            break;
        case fix_code::kRtkFloat:
            quality.sigma_m = options.sigma_float_m;
            quality.sigma_up_m = options.sigma_float_up_m;
            quality.rtk = true;
            break;
        default:
            quality.rejection = "fix code that names no satellite fix";
            return quality;
    }
    const double accuracy_m = log.value(Channel::GnssHorizontalAccuracy, epoch);
    const double accuracy_up_m = log.value(Channel::GnssVerticalAccuracy, epoch);
    if (accuracy_m > 0.0)
        quality.sigma_m = std::max(accuracy_m, options.accuracy_floor_share * quality.sigma_m);
    if (accuracy_up_m > 0.0) {
        quality.sigma_up_m = std::max(accuracy_up_m, options.accuracy_floor_share * quality.sigma_up_m);
    }
    return quality;
}

std::optional<GnssPosition> gnssPosition(const ArrayLog& log, std::size_t epoch, const LocalFrame& frame,
                                         const EpochAttitude& attitude, double assumed_up_m) {
    const double lat_deg = log.value(Channel::Latitude, epoch);
    const double lon_deg = log.value(Channel::Longitude, epoch);
    if (!present(lat_deg) || !present(lon_deg)) return std::nullopt;
    const double h_ell_m = log.value(Channel::EllipsoidalHeight, epoch);
    const double height_m = present(h_ell_m) ? h_ell_m : frame.zeroPoint().h_ell_m + assumed_up_m;
    GnssPosition position{.enu_m = frame.toEnu({lat_deg, lon_deg, height_m})};
    if (!log.gnss_lever_arm_m.isZero()) {
        Eigen::Vector3d arm = rotationEnuFromBody(attitude.attitude) * log.gnss_lever_arm_m;
        const double tilt_variance = squared(attitude.sigma_tilt_rad);
        const double horizontal_m2 = arm.head<2>().squaredNorm();
        position.arm_variance_m2 =
            tilt_variance * squared(arm.z()) +
            (attitude.heading_known ? squared(attitude.sigma_heading_rad) : 1.0) * horizontal_m2;
        position.arm_variance_up_m2 = tilt_variance * horizontal_m2;
        if (!attitude.heading_known) arm.head<2>().setZero();
        position.enu_m -= arm;
    }
    if (!present(h_ell_m)) position.enu_m.z() = kMissing;
    return position;
}

std::optional<std::string_view> dopplerRejection(const ArrayLog& log, std::size_t epoch) {
    if (!present(log.value(Channel::GnssVelocityEast, epoch)) &&
        !present(log.value(Channel::GnssVelocityNorth, epoch)) &&
        !present(log.value(Channel::GnssVelocityUp, epoch))) {
        return std::nullopt;
    }
    const double fix = log.value(Channel::Fix, epoch);
    return present(fix) && std::lround(fix) == fix_code::kNone ? "no fix" : "";
}

std::optional<std::string_view> barometerRejection(const ArrayLog& log, std::size_t epoch) {
    const double pressure_pa = log.value(Channel::Pressure, epoch);
    if (!present(pressure_pa)) return std::nullopt;
    return std::isfinite(isaHeight(pressure_pa)) ? "" : "pressure not positive";
}

double levelDrop(const Eigen::Vector3d& enu_m) {
    constexpr double kEarthRadius_m = 6371.0e3;
    return enu_m.head<2>().squaredNorm() / (2.0 * kEarthRadius_m);
}

BarometerVariance barometerVariance(const BarometerOptions& options, double since_zero_s) {
    return {squared(options.sigma_m), squared(options.gust_sigma_m) + squared(options.drift_m_per_sqrt_min) *
                                                                          std::abs(since_zero_s) / 60.0};
}

double usualStep_s(const ArrayLog& log) {
    if (log.size() < 2) return 1.0;
    std::vector<double> steps_s;
    for (std::size_t i = 1; i < log.size(); ++i) steps_s.push_back(log.time_s[i] - log.time_s[i - 1]);
    return upperMedian(steps_s);
}

double flowVariance(const FlowOptions& options, double speed_mps) {
    return options.variance_m2ps2 + options.variance_per_v2 * squared(speed_mps);
}

double RunReference::barometricUp(double pressure_pa, double scale, const Eigen::Vector3d& near_enu_m) const {
    return scale * isaHeight(pressure_pa) - *barometer_zero_m - levelDrop(near_enu_m);
}

double heightAboveGround(const ArrayLog& log, std::size_t epoch, const Attitude& attitude,
                         const TieOptions& options) {
    const double range_m = log.value(Channel::Range, epoch);
    if (!(range_m >= options.shortest_range_m && range_m <= options.longest_range_m)) return kMissing;
    const Eigen::Vector3d hit_body = log.range_lever_arm_m - range_m * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d hit_enu = rotationEnuFromBody(attitude) * hit_body;
    return -hit_enu.z();
}

double heightThroughGrass(std::vector<double>& heights_m) {
    constexpr double kReach_m = 0.08;  // white noise of the finder, some 3 cm, lies within
    if (heights_m.empty()) return kMissing;
    const auto top = heights_m.begin() + static_cast<std::ptrdiff_t>((heights_m.size() * 9) / 10);
    std::nth_element(heights_m.begin(), top, heights_m.end());
    const double least_m = *top - kReach_m;
    double sum = 0.0;
    double n = 0.0;
    for (const double h : heights_m) {
        if (h < least_m || h > *top + kReach_m) continue;
        sum += h;
        n += 1.0;
    }
    return sum / n;
}

double whiteNoiseFactor(double correlation_s, double interval_s) {
    return std::max(1.0, 2.0 * correlation_s / interval_s);
}

void readEpoch(const ReadingContext& context, std::size_t epoch, const StateEstimate& prediction,
               const SensorMemory& memory, std::vector<Reading>& readings) {
    readings.clear();
    readHeading(context, epoch, prediction, readings);
    readGnssPosition(context, epoch, prediction, memory, readings);
    readGnssVelocity(context, epoch, memory, readings);
    readBarometer(context, epoch, prediction, memory, readings);
    readFlow(context, epoch, memory, readings);
    readAccelerometer(context, epoch, readings);
}

}  // namespace terrawalk
