#include "fusion/raw_trajectory.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "fusion/flow_screen.hpp"
#include "fusion/sensor_ledger.hpp"

namespace terrawalk {

namespace {

double squared(double x) {
    return x * x;
}

struct Estimate {
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    Eigen::Vector3d variance = Eigen::Vector3d::Zero();
};

class RawRun {
  public:
    RawRun(const Survey& survey, const Run& run, const FusionOptions& options,
           const std::vector<EpochAttitude>& attitudes, const RunReference& reference)
        : log_(run.log),
          options_(options),
          frame_(survey.frame()),
          attitudes_(attitudes),
          flow_(flowRejections(run.log, attitudes, options.flow)),
          reference_(reference) {
        position_.value = reference.start_enu_m;
        position_.variance = reference.start_sigma_m.array().square();
        if (reference.starts_on_mark) position_.variance = reference.ties.front().variance_m2;
        for (std::size_t i = 0; i < log_.size(); ++i) {
            has_gnss_ = has_gnss_ || (gnssPosition(log_, i, frame_, attitudes_[i], 0.0) &&
                                      gnssQuality(log_, i, options_.gnss).rejection.empty());
        }
        velocity_.variance.setConstant(squared(options.initial.walking_speed_mps));
        horizontal_time_s_ = height_time_s_ = log_.time_s.front();
    }

    bool hasGnss() const { return has_gnss_; }
    std::vector<SensorUse> sensors() const { return ledger_.uses(); }

    TrajectoryEpoch next(std::size_t i) {
        const double dt_s = i == 0 ? 0.0 : log_.time_s[i] - log_.time_s[i - 1];
        const Eigen::Vector3d velocity_before = velocity_.value;
        takeVelocity(i);
        if (!has_gnss_) {
            position_.value.head<2>() += 0.5 * dt_s * (velocity_before + velocity_.value).head<2>();
            // Errors of scale and heading keep their direction for the correlation time of the flow.
            position_.variance.head<2>() +=
                dt_s * std::max(dt_s, 2.0 * options_.flow.correlation_s) * velocity_.variance.head<2>();
        }
        takeHeight(i);
        takePosition(i);
        // What is held ages: the array may have walked away from it.
        const double speed_mps = options_.initial.walking_speed_mps;
        const double horizontal_age_s = has_gnss_ ? log_.time_s[i] - horizontal_time_s_ : 0.0;
        const double height_age_s = log_.time_s[i] - height_time_s_;
        Eigen::Vector3d variance = position_.variance;
        variance.head<2>().array() += squared(speed_mps * horizontal_age_s);
        variance.z() += squared(0.5 * speed_mps * height_age_s);

        TrajectoryEpoch epoch;
        epoch.time_s = log_.time_s[i];
        epoch.position_enu_m = position_.value;
        epoch.velocity_enu_mps = velocity_.value;
        epoch.covariance.diagonal() << variance, velocity_.variance;
        epoch.attitude = attitudes_[i].attitude;
        epoch.sigma_tilt_rad = attitudes_[i].sigma_tilt_rad;
        epoch.sigma_heading_rad = attitudes_[i].sigma_heading_rad;
        return epoch;
    }

  private:
    // Whether there is a reading that may be used; counts what may not.
    bool takes(Sensor sensor, std::optional<std::string_view> rejection) {
        if (!rejection) return false;
        if (!rejection->empty()) ledger_.reject(sensor, *rejection);
        return rejection->empty();
    }

    void takeVelocity(std::size_t i) {
        const EpochAttitude& attitude = attitudes_[i];
        if (takes(Sensor::OpticalFlow, flow_[i])) {
            const Eigen::Vector2d flow(log_.value(Channel::FlowForward, i), log_.value(Channel::FlowLeft, i));
            velocity_.value.head<2>() = Eigen::Rotation2Dd(attitude.attitude.yaw_rad) * flow;
            velocity_.variance.head<2>().setConstant(
                options_.flow.variance_m2ps2 +
                (options_.flow.variance_per_v2 + squared(attitude.sigma_heading_rad)) * flow.squaredNorm());
            ledger_.use(Sensor::OpticalFlow, false);
            return;
        }
        const Eigen::Vector2d doppler(log_.value(Channel::GnssVelocityEast, i),
                                      log_.value(Channel::GnssVelocityNorth, i));
        if (!takes(Sensor::GnssVelocity, dopplerRejection(log_, i))) return;
        if (!doppler.allFinite()) {
            ledger_.reject(Sensor::GnssVelocity, "one component missing");
            return;
        }
        velocity_.value.head<2>() = doppler;
        velocity_.variance.head<2>().setConstant(squared(options_.gnss.velocity_sigma_mps));
        ledger_.use(Sensor::GnssVelocity, false);
    }

    void takeHeight(std::size_t i) {
        if (!reference_.barometer_zero_m) return;
        if (!takes(Sensor::Barometer, barometerRejection(log_, i))) return;
        const auto [white, lasting] =
            barometerVariance(options_.barometer, log_.time_s[i] - reference_.barometer_zero_time_s);
        position_.value.z() = reference_.barometricUp(log_.value(Channel::Pressure, i),
                                                      options_.barometer.scale, position_.value);
        position_.variance.z() = white + lasting + reference_.height_reference_variance_m2;
        height_time_s_ = log_.time_s[i];
        ledger_.use(Sensor::Barometer, false);
    }

    void takePosition(std::size_t i) {
        const auto position = gnssPosition(log_, i, frame_, attitudes_[i], position_.value.z());
        if (!position) return;
        const GnssQuality quality = gnssQuality(log_, i, options_.gnss);
        if (!quality.rejection.empty()) {
            ledger_.reject(Sensor::GnssPosition, quality.rejection);
            return;
        }
        position_.value.head<2>() = position->enu_m.head<2>();
        position_.variance.head<2>().setConstant(squared(quality.sigma_m) + position->arm_variance_m2);
        horizontal_time_s_ = log_.time_s[i];
        ledger_.use(Sensor::GnssPosition, false);
        if (reference_.barometer_zero_m || !present(position->enu_m.z())) return;
        position_.value.z() = position->enu_m.z();
        position_.variance.z() = squared(quality.sigma_up_m) + position->arm_variance_up_m2;
        height_time_s_ = log_.time_s[i];
        ledger_.use(Sensor::GnssHeight, false);
    }

    const ArrayLog& log_;
    const FusionOptions& options_;
    const LocalFrame frame_;
    const std::vector<EpochAttitude>& attitudes_;
    const FlowRejections flow_;
    const RunReference& reference_;
    SensorLedger ledger_;
    Estimate position_;  // as it was when it was measured
    Estimate velocity_;
    double horizontal_time_s_ = 0.0;  // when that was
    double height_time_s_ = 0.0;
    bool has_gnss_ = false;
};

}  // namespace

Result<FusedRun> rawTrajectory(const Survey& survey, const Run& run, const FusionOptions& options,
                               const std::vector<EpochAttitude>& attitudes, const RunReference& reference,
                               Progress& progress, std::stop_token stop) {
    RawRun raw(survey, run, options, attitudes, reference);
    FusedRun fused;
    fused.trajectory.run_id = run.id;
    fused.trajectory.epochs.reserve(run.log.size());
    for (std::size_t i = 0; i < run.log.size(); ++i) {
        if (i % 512 == 0) {
            if (stop.stop_requested()) return cancelled();
            progress.report(static_cast<double>(i) / static_cast<double>(run.log.size()),
                            "reading " + run.id);
        }
        fused.trajectory.epochs.push_back(raw.next(i));
    }
    fused.sensors = raw.sensors();
    if (!raw.hasGnss()) {
        fused.notes.limitations.push_back(
            "no GNSS: raw positions are the start and the velocity summed up from there");
    }
    return fused;
}

}  // namespace terrawalk
