#include "fusion/raw_trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "fusion/barometer.hpp"
#include "fusion/sensor_ledger.hpp"

namespace terrawalk {

namespace {

double squared(double x) {
    return x * x;
}

// The latest value of one quantity, and what it is worth at a later time.
struct Held {
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
          reference_(reference) {
        position_.value = reference.start_enu_m;
        position_.variance = reference.start_sigma_m.array().square();
        if (reference.starts_on_mark) position_.variance = reference.ties.front().variance_m2;
        for (std::size_t i = 0; i < log_.size(); ++i) {
            has_gnss_ = has_gnss_ || (gnssPosition(log_, i, frame_, attitudes_[i].attitude, 0.0) &&
                                      gnssQuality(log_, i, options_.gnss).rejection.empty());
        }
        velocity_.variance.setConstant(squared(options.initial.walking_speed_mps));
    }

    bool hasGnss() const { return has_gnss_; }
    std::vector<SensorUse> sensors() const { return ledger_.uses(); }

    TrajectoryEpoch next(std::size_t i) {
        const double dt_s = i == 0 ? 0.0 : log_.time_s[i] - log_.time_s[i - 1];
        const Eigen::Vector3d velocity_before = velocity_.value;
        takeVelocity(i);
        if (has_gnss_) {
            position_.variance.head<2>().array() += squared(options_.initial.walking_speed_mps * dt_s);
        } else {
            position_.value.head<2>() += 0.5 * dt_s * (velocity_before + velocity_.value).head<2>();
            // Errors of scale and heading keep their direction for the correlation time of the flow.
            position_.variance.head<2>() +=
                dt_s * std::max(dt_s, 2.0 * options_.flow.correlation_s) * velocity_.variance.head<2>();
        }
        const bool measured_height = takeHeight(i);
        if (!measured_height)
            position_.variance.z() += squared(0.5 * options_.initial.walking_speed_mps * dt_s);
        takePosition(i);

        TrajectoryEpoch epoch;
        epoch.time_s = log_.time_s[i];
        epoch.position_enu_m = position_.value;
        epoch.velocity_enu_mps = velocity_.value;
        epoch.covariance.diagonal() << position_.variance, velocity_.variance;
        epoch.attitude = attitudes_[i].attitude;
        epoch.sigma_tilt_rad = attitudes_[i].sigma_tilt_rad;
        epoch.sigma_heading_rad = attitudes_[i].sigma_heading_rad;
        return epoch;
    }

  private:
    void takeVelocity(std::size_t i) {
        const Eigen::Vector2d flow(log_.value(Channel::FlowForward, i), log_.value(Channel::FlowLeft, i));
        const EpochAttitude& attitude = attitudes_[i];
        if (present(flow.x()) || present(flow.y())) {
            const double quality = log_.value(Channel::FlowQuality, i);
            if (present(quality) && quality < options_.flow.smallest_quality) {
                ledger_.reject(Sensor::OpticalFlow, "no texture");
            } else if (!flow.allFinite()) {
                ledger_.reject(Sensor::OpticalFlow, "one component missing");
            } else if (!attitude.heading_known) {
                ledger_.reject(Sensor::OpticalFlow, "no attitude");
            } else {
                const double c = std::cos(attitude.attitude.yaw_rad);
                const double s = std::sin(attitude.attitude.yaw_rad);
                velocity_.value.head<2>() << c * flow.x() - s * flow.y(), s * flow.x() + c * flow.y();
                velocity_.variance.head<2>().setConstant(
                    options_.flow.variance_m2ps2 +
                    (options_.flow.variance_per_v2 + squared(attitude.sigma_heading_rad)) *
                        flow.squaredNorm());
                ledger_.use(Sensor::OpticalFlow, false);
                return;
            }
        }
        const Eigen::Vector2d doppler(log_.value(Channel::GnssVelocityEast, i),
                                      log_.value(Channel::GnssVelocityNorth, i));
        if (!doppler.allFinite()) return;
        velocity_.value.head<2>() = doppler;
        velocity_.variance.head<2>().setConstant(squared(options_.gnss.velocity_sigma_mps));
        ledger_.use(Sensor::GnssVelocity, false);
    }

    bool takeHeight(std::size_t i) {
        const double pressure_pa = log_.value(Channel::Pressure, i);
        if (!present(pressure_pa) || !reference_.barometer_zero_m) return false;
        const BarometerOptions& barometer = options_.barometer;
        const double height_m = barometer.scale * isaHeight(pressure_pa) - *reference_.barometer_zero_m;
        if (!std::isfinite(height_m)) {
            ledger_.reject(Sensor::Barometer, "pressure not positive");
            return false;
        }
        position_.value.z() = height_m;
        position_.variance.z() = squared(barometer.sigma_m) + squared(barometer.gust_sigma_m) +
                                 squared(barometer.drift_m_per_sqrt_min) *
                                     std::abs(log_.time_s[i] - reference_.barometer_zero_time_s) / 60.0;
        ledger_.use(Sensor::Barometer, false);
        return true;
    }

    void takePosition(std::size_t i) {
        const auto position = gnssPosition(log_, i, frame_, attitudes_[i].attitude, position_.value.z());
        if (!position) return;
        const GnssQuality quality = gnssQuality(log_, i, options_.gnss);
        if (!quality.rejection.empty()) {
            ledger_.reject(Sensor::GnssPosition, quality.rejection);
            return;
        }
        position_.value.head<2>() = position->head<2>();
        position_.variance.head<2>().setConstant(squared(quality.sigma_m));
        ledger_.use(Sensor::GnssPosition, false);
        if (reference_.barometer_zero_m || !present(position->z())) return;
        position_.value.z() = position->z();
        position_.variance.z() = squared(quality.sigma_up_m);
        ledger_.use(Sensor::GnssHeight, false);
    }

    const ArrayLog& log_;
    const FusionOptions& options_;
    const LocalFrame frame_;
    const std::vector<EpochAttitude>& attitudes_;
    const RunReference& reference_;
    SensorLedger ledger_;
    Held position_;
    Held velocity_;
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
