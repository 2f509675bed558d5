#include "fusion/simulated_sensors.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "fusion/barometer.hpp"
#include "fusion/random_numbers.hpp"
#include "fusion/random_processes.hpp"

namespace terrawalk {
namespace {

/// What a random stream is for. Numbers are part of what a seed means: only ever add at the end.
enum class Stream : std::uint64_t {
    LostRows = 100,
    GnssSlow,
    GnssWhite,
    GnssDoppler,
    GnssJumps,
    GnssJumpSizes,
    GnssDips,
    GnssAccuracy,
    Weather,
    BarometerDrift,
    BarometerGust,
    BarometerWhite,
    Temperature,
    FlowScale,
    FlowWhite,
    FlowDrops,
    FlowQuality,
    Canopy,
    RollDrift,
    PitchDrift,
    TiltWhite,
    HeadingDrift,
    HeadingWhite,
    HardIron,
    AccelerometerBias,
    AccelerometerWhite,
    GyroBias,
    GyroWhite,
    RangeBias,
    RangeWhite,
    Grass,
    GrassHits,
    RangeLost,
    Hands,
    RangeStrength,
    Missing,
};
constexpr std::uint64_t kWholeSurvey = ~std::uint64_t{0};  // run number of what all runs share

RandomNumbers stream(std::uint64_t seed, std::uint64_t run, Stream purpose) {
    return RandomNumbers({seed, run, static_cast<std::uint64_t>(purpose)});
}

/// Everything that the sensors of one run see and share.
struct SensedRun {
    const std::vector<WalkSample>& walked;
    const TerrainModel& terrain;
    const LocalFrame& frame;
    const SimulationOptions& options;
    const SensorErrors errors;
    std::uint64_t run;
    double duration_s;
    std::stop_token stop;

    [[nodiscard]] bool goesOn(std::size_t epoch) const { return epoch % 4096 != 0 || !stop.stop_requested(); }
    [[nodiscard]] RandomNumbers random(Stream purpose) const { return stream(options.seed, run, purpose); }
    [[nodiscard]] RandomNumbers surveyRandom(Stream purpose) const {
        return stream(options.seed, kWholeSurvey, purpose);
    }
    [[nodiscard]] GaussMarkov gaussMarkov(double correlation_s, Stream purpose) const {
        return {correlation_s, options.sample_interval_s, random(purpose)};
    }
    [[nodiscard]] Bursts bursts(double per_min, Bursts::Length length, Stream purpose) const {
        return {per_min, length, options.sample_interval_s, random(purpose)};
    }
    /// A patchy property of the site that stays where it is, -1..1.
    [[nodiscard]] double patch(const Eigen::Vector3d& enu_m, double size_m, Stream purpose) const {
        return valueNoise(enu_m.x() / size_m, enu_m.y() / size_m,
                          scramble({options.seed, static_cast<std::uint64_t>(purpose)}));
    }
};

int plannedFix(GnssMode mode, double time_s, double duration_s) {
    constexpr double kFloatAfterOutage_s = 15.0;
    switch (mode) {
        case GnssMode::Single:
            return fix_code::kSingle;
        case GnssMode::Float:
            return fix_code::kRtkFloat;
        case GnssMode::Rtk:
            return fix_code::kRtkFixed;
        case GnssMode::Outage:
            if (time_s < 0.4 * duration_s) return fix_code::kRtkFixed;
            if (time_s < 0.6 * duration_s) return fix_code::kNone;
            return time_s < 0.6 * duration_s + kFloatAfterOutage_s ? fix_code::kRtkFloat
                                                                   : fix_code::kRtkFixed;
    }
    return fix_code::kNone;
}

int poorerFix(int fix) {
    if (fix == fix_code::kRtkFixed) return fix_code::kRtkFloat;
    return fix == fix_code::kRtkFloat ? fix_code::kSingle : fix_code::kNone;
}

void addColumns(ArrayLog& log, std::initializer_list<Channel> channels) {
    for (const Channel c : channels) log.column(c).assign(log.size(), kMissing);
}

void senseGnss(const SensedRun& in, ArrayLog& log) {
    addColumns(log, {Channel::Latitude, Channel::Longitude, Channel::EllipsoidalHeight, Channel::Fix,
                     Channel::GnssHorizontalAccuracy, Channel::GnssVerticalAccuracy});
    RandomNumbers slow_random = in.random(Stream::GnssSlow);
    const double step_s = in.options.sample_interval_s;
    const double keep = std::exp(-step_s / kGnssCorrelation_s);
    Eigen::Vector3d slow = normals(slow_random);
    RandomNumbers white_random = in.random(Stream::GnssWhite);
    RandomNumbers jump_random = in.random(Stream::GnssJumpSizes);
    Bursts jumps = in.bursts(in.errors.gnss_jumps_per_min, {2.0, 12.0}, Stream::GnssJumps);
    Bursts dips = in.bursts(in.errors.gnss_dips_per_min, {1.0, 8.0}, Stream::GnssDips);
    GaussMarkov accuracy = in.gaussMarkov(60.0, Stream::GnssAccuracy);
    Eigen::Vector3d jump = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < in.walked.size() && in.goesOn(i); ++i) {
        const WalkSample& truth = in.walked[i];
        const Eigen::Vector3d white = normals(white_random);
        const Bursts::State jumping = jumps.next();
        if (jumping.begins) jump = normals(jump_random);
        const double reported = std::clamp(1.0 + 0.25 * accuracy.next(), 0.5, 2.0);
        int fix = plannedFix(in.options.gnss, truth.time_s, in.duration_s);
        if (dips.next().active) fix = poorerFix(fix);

        log.column(Channel::Fix)[i] = fix;
        if (fix != fix_code::kNone) {
            const GnssErrors sizes = gnssErrors(fix);
            const Eigen::Vector3d slow_m(sizes.slow_h_m, sizes.slow_h_m, sizes.slow_v_m);
            const Eigen::Vector3d white_m(sizes.white_h_m, sizes.white_h_m, sizes.white_v_m);
            Eigen::Vector3d error_m = slow_m.cwiseProduct(slow) + white_m.cwiseProduct(white);
            if (jumping.active) error_m += sizes.jump_m * jump;
            const Eigen::Vector3d antenna_m =
                truth.position_m + truth.enu_from_body * in.options.gnss_lever_arm_m;
            const GeodeticPosition read = in.frame.toGeodetic(antenna_m + in.options.noise_scale * error_m);
            log.column(Channel::Latitude)[i] = read.lat_deg;
            log.column(Channel::Longitude)[i] = read.lon_deg;
            log.column(Channel::EllipsoidalHeight)[i] = read.h_ell_m;
            log.column(Channel::GnssHorizontalAccuracy)[i] =
                reported * std::hypot(sizes.slow_h_m, sizes.white_h_m);
            log.column(Channel::GnssVerticalAccuracy)[i] =
                reported * std::hypot(sizes.slow_v_m, sizes.white_v_m);
        }
        slow = keep * slow + std::sqrt(1.0 - keep * keep) * normals(slow_random);
    }
}

// After senseGnss: a receiver without a fix has no velocity either.
void senseDoppler(const SensedRun& in, ArrayLog& log) {
    addColumns(log, {Channel::GnssVelocityEast, Channel::GnssVelocityNorth, Channel::GnssVelocityUp});
    RandomNumbers random = in.random(Stream::GnssDoppler);
    for (std::size_t i = 0; i < in.walked.size() && in.goesOn(i); ++i) {
        const Eigen::Vector3d white = normals(random);
        const int fix = static_cast<int>(log.value(Channel::Fix, i));
        if (fix == fix_code::kNone) continue;
        const GnssErrors sizes = gnssErrors(fix);
        const Eigen::Vector3d sigma(sizes.doppler_h_mps, sizes.doppler_h_mps, sizes.doppler_v_mps);
        const WalkSample& truth = in.walked[i];
        const Eigen::Vector3d antenna_mps =
            truth.velocity_mps +
            truth.enu_from_body * truth.angular_rate_body_radps.cross(in.options.gnss_lever_arm_m);
        const Eigen::Vector3d read = antenna_mps + in.options.noise_scale * sigma.cwiseProduct(white);
        log.column(Channel::GnssVelocityEast)[i] = read.x();
        log.column(Channel::GnssVelocityNorth)[i] = read.y();
        log.column(Channel::GnssVelocityUp)[i] = read.z();
    }
}

void senseBarometer(const SensedRun& in, ArrayLog& log) {
    addColumns(log, {Channel::Pressure, Channel::Temperature});
    const double minutes = in.options.sample_interval_s / 60.0;
    const double weather_pa = in.errors.weather_pa * in.surveyRandom(Stream::Weather).normal();
    RandomNumbers drift_random = in.random(Stream::BarometerDrift);
    RandomNumbers white_random = in.random(Stream::BarometerWhite);
    GaussMarkov gust = in.gaussMarkov(5.0, Stream::BarometerGust);
    GaussMarkov warmth = in.gaussMarkov(600.0, Stream::Temperature);
    double drift_m = 0.0;
    for (std::size_t i = 0; i < in.walked.size() && in.goesOn(i); ++i) {
        const double error_m = drift_m + in.errors.barometer_gust_m * gust.next() +
                               in.errors.barometer_white_m * white_random.normal();
        const double height_m = in.frame.zeroPoint().h_ell_m + in.walked[i].position_m.z();
        log.column(Channel::Pressure)[i] =
            isaPressure(height_m + in.options.noise_scale * error_m) + in.options.noise_scale * weather_pa;
        log.column(Channel::Temperature)[i] = 31.0 + in.options.noise_scale * warmth.next();
        drift_m += in.errors.barometer_drift_m_per_sqrt_min * std::sqrt(minutes) * drift_random.normal();
    }
}

void senseFlow(const SensedRun& in, ArrayLog& log) {
    addColumns(log, {Channel::FlowForward, Channel::FlowLeft, Channel::FlowQuality});
    constexpr double kFailsInShade = 0.85;
    const double scale =
        1.0 + in.options.noise_scale * in.errors.flow_scale * in.random(Stream::FlowScale).normal();
    RandomNumbers white_random = in.random(Stream::FlowWhite);
    RandomNumbers quality_random = in.random(Stream::FlowQuality);
    Bursts drops = in.bursts(in.errors.flow_drops_per_min, {0.4, 3.0}, Stream::FlowDrops);
    for (std::size_t i = 0; i < in.walked.size() && in.goesOn(i); ++i) {
        const WalkSample& truth = in.walked[i];
        const double white_forward = white_random.normal();
        const double white_left = white_random.normal();
        const double texture = quality_random.uniform();
        const bool fails_in_shade = quality_random.chance(kFailsInShade);
        const bool shaded = in.patch(truth.position_m, 4.0, Stream::Canopy) > in.errors.shade_level;
        const bool dropped = drops.next().active;
        if (dropped || (shaded && fails_in_shade)) {
            // As such modules do: a speed of nothing, and the quality says that it means nothing.
            log.column(Channel::FlowForward)[i] = 0.0;
            log.column(Channel::FlowLeft)[i] = 0.0;
            log.column(Channel::FlowQuality)[i] = 0.0;
            continue;
        }
        const double cos_yaw = std::cos(truth.attitude.yaw_rad);
        const double sin_yaw = std::sin(truth.attitude.yaw_rad);
        const double forward_mps = cos_yaw * truth.velocity_mps.x() + sin_yaw * truth.velocity_mps.y();
        const double left_mps = -sin_yaw * truth.velocity_mps.x() + cos_yaw * truth.velocity_mps.y();
        const double noise_mps =
            in.options.noise_scale *
            (in.errors.flow_white_mps + in.errors.flow_white_per_speed * std::hypot(forward_mps, left_mps));
        log.column(Channel::FlowForward)[i] = scale * forward_mps + noise_mps * white_forward;
        log.column(Channel::FlowLeft)[i] = scale * left_mps + noise_mps * white_left;
        log.column(Channel::FlowQuality)[i] = std::floor((shaded ? 30.0 : 170.0) + 80.0 * texture);
    }
}

void senseAttitude(const SensedRun& in, ArrayLog& log) {
    addColumns(log, {Channel::Roll, Channel::Pitch, Channel::Heading});
    constexpr double kStill_radps = radians(5.0);
    RandomNumbers iron_random = in.surveyRandom(Stream::HardIron);
    const double iron_sin_rad = in.errors.hard_iron_rad * iron_random.normal();
    const double iron_cos_rad = in.errors.hard_iron_rad * iron_random.normal();
    RandomNumbers tilt_random = in.random(Stream::TiltWhite);
    RandomNumbers heading_random = in.random(Stream::HeadingWhite);
    GaussMarkov heading_drift = in.gaussMarkov(400.0, Stream::HeadingDrift);
    GaussMarkov roll_drift = in.gaussMarkov(300.0, Stream::RollDrift);
    GaussMarkov pitch_drift = in.gaussMarkov(300.0, Stream::PitchDrift);
    for (std::size_t i = 0; i < in.walked.size() && in.goesOn(i); ++i) {
        const WalkSample& truth = in.walked[i];
        const double tilt_white_rad = truth.angular_rate_body_radps.norm() < kStill_radps
                                          ? in.errors.tilt_still_rad
                                          : in.errors.tilt_moving_rad;
        const double roll_error_rad =
            in.errors.tilt_drift_rad * roll_drift.next() + tilt_white_rad * tilt_random.normal();
        const double pitch_error_rad =
            in.errors.tilt_drift_rad * pitch_drift.next() + tilt_white_rad * tilt_random.normal();
        const double heading_rad = yawFromHeading(truth.attitude.yaw_rad);  // its own inverse
        const double heading_error_rad = in.errors.heading_drift_rad * heading_drift.next() +
                                         in.errors.heading_white_rad * heading_random.normal() +
                                         iron_sin_rad * std::sin(heading_rad) +
                                         iron_cos_rad * std::cos(heading_rad);
        const double read_rad = wrapAngle(heading_rad + in.options.noise_scale * heading_error_rad);
        log.column(Channel::Roll)[i] = truth.attitude.roll_rad + in.options.noise_scale * roll_error_rad;
        log.column(Channel::Pitch)[i] = truth.attitude.pitch_rad + in.options.noise_scale * pitch_error_rad;
        log.column(Channel::Heading)[i] = read_rad < 0.0 ? read_rad + 2.0 * kPi : read_rad;
    }
}

void senseInertial(const SensedRun& in, ArrayLog& log) {
    addColumns(log, {Channel::AccelerationX, Channel::AccelerationY, Channel::AccelerationZ,
                     Channel::AngularRateX, Channel::AngularRateY, Channel::AngularRateZ});
    RandomNumbers force_bias_random = in.random(Stream::AccelerometerBias);
    RandomNumbers rate_bias_random = in.random(Stream::GyroBias);
    RandomNumbers force_random = in.random(Stream::AccelerometerWhite);
    RandomNumbers rate_random = in.random(Stream::GyroWhite);
    const Eigen::Vector3d force_bias_mps2 = in.errors.accelerometer_bias_mps2 * normals(force_bias_random);
    const Eigen::Vector3d rate_bias_radps = in.errors.gyro_bias_radps * normals(rate_bias_random);
    const Eigen::Vector3d gravity_mps2(0.0, 0.0, -kStandardGravity_mps2);
    for (std::size_t i = 0; i < in.walked.size() && in.goesOn(i); ++i) {
        const WalkSample& truth = in.walked[i];
        const Eigen::Vector3d force_error_mps2 =
            force_bias_mps2 + in.errors.accelerometer_white_mps2 * normals(force_random);
        const Eigen::Vector3d rate_error_radps =
            rate_bias_radps + in.errors.gyro_white_radps * normals(rate_random);
        const Eigen::Vector3d force_mps2 =
            truth.enu_from_body.transpose() * (truth.acceleration_mps2 - gravity_mps2) +
            in.options.noise_scale * force_error_mps2;
        const Eigen::Vector3d rate_radps =
            truth.angular_rate_body_radps + in.options.noise_scale * rate_error_radps;
        log.column(Channel::AccelerationX)[i] = force_mps2.x();
        log.column(Channel::AccelerationY)[i] = force_mps2.y();
        log.column(Channel::AccelerationZ)[i] = force_mps2.z();
        log.column(Channel::AngularRateX)[i] = rate_radps.x();
        log.column(Channel::AngularRateY)[i] = rate_radps.y();
        log.column(Channel::AngularRateZ)[i] = rate_radps.z();
    }
}

void senseRange(const SensedRun& in, ArrayLog& log) {
    addColumns(log, {Channel::Range, Channel::RangeStrength});
    constexpr double kBladeInTheWay = 0.7;  // of the shots into grass
    constexpr double kGrassShortest_m = 0.05;
    constexpr double kResolution_m = 0.01;  // paper 000, Table 2
    const double scale = in.options.noise_scale;
    const double bias_m = in.errors.range_bias_m * in.surveyRandom(Stream::RangeBias).normal();
    RandomNumbers white_random = in.random(Stream::RangeWhite);
    RandomNumbers grass_random = in.random(Stream::GrassHits);
    RandomNumbers lost_random = in.random(Stream::RangeLost);
    RandomNumbers strength_random = in.random(Stream::RangeStrength);
    Bursts hands = in.bursts(in.errors.hands_per_min, {0.4, 2.0}, Stream::Hands);
    for (std::size_t i = 0; i < in.walked.size() && in.goesOn(i); ++i) {
        const WalkSample& truth = in.walked[i];
        const Eigen::Vector3d origin_m =
            truth.position_m + truth.enu_from_body * in.options.range_lever_arm_m;
        const Eigen::Vector3d down = -truth.enu_from_body.col(2);
        const double true_m = distanceToGround_m(in.terrain, origin_m, down, kRangeGreatest_m);

        const bool blade = grass_random.chance(kBladeInTheWay);
        const double blade_share = grass_random.uniform();
        const double white = white_random.normal();
        const double reflects = strength_random.uniform(0.7, 1.3);
        const bool lost = lost_random.chance(in.errors.range_lost_chance);
        const bool hand = hands.next().active;

        double& range_m = log.column(Channel::Range)[i];
        double& strength = log.column(Channel::RangeStrength)[i];
        if (hand) {
            range_m = kResolution_m * std::round(10.0 + 15.0 * blade_share);
            strength = std::floor(2200.0 * reflects);
            continue;
        }
        if (lost || !(true_m < kRangeGreatest_m)) {
            range_m = kNoReturnRange_m;
            strength = std::floor(10.0 * reflects);
            continue;
        }
        const bool grassy =
            in.patch(origin_m + true_m * down, 2.0, Stream::Grass) > in.errors.grass_level && blade;
        const double grass_m =
            grassy ? kGrassShortest_m + (in.errors.grass_tallest_m - kGrassShortest_m) * blade_share : 0.0;
        const double read_m = true_m + scale * (bias_m - grass_m + rangeSigma_m(true_m) * white);
        range_m = scale > 0.0 ? kResolution_m * std::round(read_m / kResolution_m) : read_m;
        strength = std::floor(reflects * 900.0 / std::max(true_m * true_m, 0.5));
    }
}

// Each sensor as a whole: a frame that did not arrive has none of its values.
void dropFrames(const SensedRun& in, ArrayLog& log) {
    static const std::vector<std::vector<Channel>> kSensors{
        {Channel::Latitude, Channel::Longitude, Channel::EllipsoidalHeight, Channel::Fix,
         Channel::GnssHorizontalAccuracy, Channel::GnssVerticalAccuracy, Channel::GnssVelocityEast,
         Channel::GnssVelocityNorth, Channel::GnssVelocityUp},
        {Channel::Pressure, Channel::Temperature},
        {Channel::FlowForward, Channel::FlowLeft, Channel::FlowQuality},
        {Channel::Roll, Channel::Pitch, Channel::Heading},
        {Channel::AccelerationX, Channel::AccelerationY, Channel::AccelerationZ, Channel::AngularRateX,
         Channel::AngularRateY, Channel::AngularRateZ},
        {Channel::Range, Channel::RangeStrength}};
    RandomNumbers random = in.random(Stream::Missing);
    for (std::size_t i = 0; i < log.size() && in.goesOn(i); ++i) {
        for (const std::vector<Channel>& channels : kSensors) {
            if (!random.chance(in.errors.missing_chance)) continue;
            for (const Channel c : channels) {
                if (log.has(c)) log.column(c)[i] = kMissing;
            }
        }
    }
}

}  // namespace

GnssErrors gnssErrors(int fix) {
    switch (fix) {
        case fix_code::kRtkFixed:
            return {0.014, 0.023, 0.006, 0.010, 0.03, 0.05, 0.25};
        case fix_code::kRtkFloat:
            return {0.29, 0.44, 0.06, 0.10, 0.05, 0.08, 1.0};
        default:
            return {1.24, 1.87, 0.28, 0.35, 0.08, 0.12, 4.0};
    }
}

SensorErrors sensorErrors(FaultLevel level) {
    SensorErrors e;
    if (level == FaultLevel::None) return e;
    const bool severe = level == FaultLevel::Severe;
    e.barometer_drift_m_per_sqrt_min = severe ? 0.20 : 0.07;
    e.barometer_gust_m = severe ? 0.30 : 0.10;
    e.weather_pa = 300.0;
    e.flow_scale = severe ? 0.10 : 0.05;
    e.shade_level = severe ? 0.15 : 0.45;
    e.flow_drops_per_min = severe ? 4.0 : 1.0;
    e.tilt_drift_rad = radians(severe ? 0.6 : 0.3);
    e.heading_drift_rad = radians(severe ? 5.0 : 3.0);
    e.hard_iron_rad = radians(severe ? 4.0 : 2.0);
    e.accelerometer_bias_mps2 = severe ? 0.10 : 0.05;
    e.gyro_bias_radps = radians(severe ? 0.6 : 0.3);
    e.range_bias_m = 0.01;
    e.grass_level = severe ? 0.0 : 0.3;
    e.grass_tallest_m = severe ? 0.35 : 0.20;
    e.range_lost_chance = severe ? 0.02 : 0.003;
    e.hands_per_min = severe ? 0.5 : 0.1;
    e.gnss_jumps_per_min = severe ? 0.7 : 0.2;
    e.gnss_dips_per_min = severe ? 0.5 : 0.1;
    e.missing_chance = severe ? 0.025 : 0.005;
    e.lost_row_chance = severe ? 0.01 : 0.001;
    return e;
}

double rangeSigma_m(double range_m) {
    return 0.5 * (range_m < 6.0 ? 0.06 : 0.01 * range_m);
}

std::vector<std::uint64_t> keptTicks(std::size_t rows, double lost_row_chance, std::uint64_t seed,
                                     std::uint64_t run) {
    RandomNumbers random = stream(seed, run, Stream::LostRows);
    std::vector<std::uint64_t> ticks;
    ticks.reserve(rows);
    for (std::uint64_t tick = 0; ticks.size() < rows; ++tick) {
        if (!random.chance(lost_row_chance) || tick == 0) ticks.push_back(tick);
    }
    return ticks;
}

ArrayLog senseWalk(const std::vector<WalkSample>& walked, const TerrainModel& terrain,
                   const LocalFrame& frame, const SimulationOptions& options, std::uint64_t run,
                   double duration_s, std::stop_token stop) {
    const SensedRun in{walked, terrain,    frame,          options, sensorErrors(options.faults),
                       run,    duration_s, std::move(stop)};
    ArrayLog log;
    log.sample_interval_s = options.sample_interval_s;
    log.range_lever_arm_m = options.range_lever_arm_m;
    log.gnss_lever_arm_m = options.gnss_lever_arm_m;
    for (const WalkSample& sample : walked) log.time_s.push_back(sample.time_s);
    senseGnss(in, log);
    if (options.doppler_velocity) senseDoppler(in, log);
    senseBarometer(in, log);
    senseFlow(in, log);
    senseAttitude(in, log);
    senseInertial(in, log);
    senseRange(in, log);
    dropFrames(in, log);
    return log;
}

ArrayLog keepRows(const ArrayLog& log, const std::vector<std::uint64_t>& rows) {
    ArrayLog kept = log;
    const auto keep = [&](std::vector<double>& column) {
        if (column.empty()) return;
        for (std::size_t i = 0; i < rows.size(); ++i) column[i] = column[rows[i]];
        column.resize(rows.size());
    };
    keep(kept.time_s);
    for (std::vector<double>& column : kept.channels) keep(column);
    return kept;
}

}  // namespace terrawalk
