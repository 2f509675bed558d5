#include "fusion/positioning_model.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "fusion/flow_screen.hpp"

namespace terrawalk {

namespace {

double squared(double x) {
    return x * x;
}

// The start mark with the height of the array above it, from all ranges of the stand.
StateEstimate startOf(const Run& run, const FusionOptions& options, const RunReference& reference) {
    Eigen::Vector3d position = reference.start_enu_m;
    Eigen::Vector3d variance = reference.start_sigma_m.array().square();
    if (reference.starts_on_mark) {
        variance = reference.ties.front().variance_m2;
        const double until_s = run.log.time_s.front() + options.stands.start_s;
        double sum_m = 0.0;
        double n = 0.0;
        for (const MarkTie& tie : reference.ties) {
            if (!tie.has_height || run.log.time_s[tie.epoch] > until_s) continue;
            sum_m += tie.array_enu_m.z();
            n += 1.0;
        }
        if (n > 0.0) position.z() = sum_m / n;
    }
    StateEstimate start;
    start.covariance.setZero();
    start.mean.segment<3>(offset(StateBlock::Position)) = position;
    start.covariance.diagonal().segment<3>(offset(StateBlock::Position)) = variance;
    start.covariance.diagonal()
        .segment<3>(offset(StateBlock::Velocity))
        .setConstant(squared(options.initial.velocity_sigma_mps));
    start.covariance.diagonal()
        .segment<3>(offset(StateBlock::Acceleration))
        .setConstant(squared(options.initial.acceleration_sigma_mps2));
    return start;
}

class LogMeasurer {
  public:
    LogMeasurer(const Survey& survey, const Run& run, const FusionOptions& options,
                const std::vector<EpochAttitude>& attitudes, const RunReference& reference,
                SensorLedger& ledger)
        : log_(run.log),
          options_(options),
          frame_(survey.frame()),
          attitudes_(attitudes),
          flow_(flowRejections(run.log, attitudes, options.flow)),
          reference_(reference),
          ledger_(ledger),
          near_enu_m_(reference.start_enu_m) {}

    MeasurementEpoch measure(std::size_t i) {
        MeasurementEpoch epoch;
        epoch.z.fill(0.0);
        epoch.variance.fill(1.0);
        epoch.dt_s = i == 0 ? 0.0 : log_.time_s[i] - log_.time_s[i - 1];
        measureHeight(i, epoch);
        measurePosition(i, epoch);
        measureFlow(i, epoch);
        measureYaw(i, epoch);
        measureAcceleration(i, epoch);
        return epoch;
    }

  private:
    bool takes(Sensor sensor, std::optional<std::string_view> rejection) {
        if (!rejection) return false;
        if (!rejection->empty()) ledger_.reject(sensor, *rejection);
        return rejection->empty();
    }

    void measureHeight(std::size_t i, MeasurementEpoch& epoch) {
        if (!reference_.has_height) {
            epoch.set(MeasurementRow::BarometerUp, reference_.start_enu_m.z(),
                      reference_.height_reference_variance_m2);
            return;
        }
        if (!reference_.barometer_zero_m || !options_.barometer.use) return;
        if (!takes(Sensor::Barometer, barometerRejection(log_, i))) return;
        const auto [white, gust] = barometerVariance(options_.barometer, 0.0);
        near_enu_m_.z() =
            reference_.barometricUp(log_.value(Channel::Pressure, i), options_.barometer.scale, near_enu_m_);
        epoch.set(MeasurementRow::BarometerUp, near_enu_m_.z(), white + gust);
    }

    void measurePosition(std::size_t i, MeasurementEpoch& epoch) {
        const auto position = gnssPosition(log_, i, frame_, attitudes_[i], near_enu_m_.z());
        if (!position) return;
        const GnssQuality quality = gnssQuality(log_, i, options_.gnss);
        if (!quality.rejection.empty()) {
            if (options_.gnss.use_position) ledger_.reject(Sensor::GnssPosition, quality.rejection);
            return;
        }
        near_enu_m_.head<2>() = position->enu_m.head<2>();
        if (options_.gnss.use_position) {
            const double variance = squared(quality.sigma_m) + position->arm_variance_m2;
            epoch.set(MeasurementRow::GnssEast, position->enu_m.x(), variance);
            epoch.set(MeasurementRow::GnssNorth, position->enu_m.y(), variance);
        }
        const bool stands_in = reference_.has_height && !reference_.barometer_zero_m &&
                               (reference_.gnss_height == GnssHeightUse::Always || quality.rtk);
        if (stands_in && present(position->enu_m.z())) {
            near_enu_m_.z() = position->enu_m.z();
            epoch.set(MeasurementRow::BarometerUp, position->enu_m.z(),
                      squared(quality.sigma_up_m) + position->arm_variance_up_m2);
        }
    }

    void measureFlow(std::size_t i, MeasurementEpoch& epoch) {
        const FlowOptions& flow = options_.flow;
        const EpochAttitude& attitude = attitudes_[i];
        if (!flow.use || !takes(Sensor::OpticalFlow, flow_[i])) return;
        const Eigen::Vector2d body_mps(log_.value(Channel::FlowForward, i), log_.value(Channel::FlowLeft, i));
        const Eigen::Vector2d velocity_mps = Eigen::Rotation2Dd(attitude.attitude.yaw_rad) * body_mps;
        const double variance =
            flow.variance_m2ps2 +
            (flow.variance_per_v2 + squared(attitude.sigma_heading_rad)) * body_mps.squaredNorm();
        epoch.set(MeasurementRow::FlowEast, velocity_mps.x(), variance);
        epoch.set(MeasurementRow::FlowNorth, velocity_mps.y(), variance);
    }

    void measureYaw(std::size_t i, MeasurementEpoch& epoch) const {
        const YawRowOptions& yaw = options_.aukf.yaw_row;
        if (!yaw.use || !present(log_.value(Channel::Heading, i))) return;
        epoch.set(MeasurementRow::Yaw,
                  wrapAngle(attitudes_[i].attitude.yaw_rad - radians(yaw.mount_offset_deg)),
                  squared(radians(yaw.sigma_deg)));
    }

    void measureAcceleration(std::size_t i, MeasurementEpoch& epoch) {
        const Eigen::Vector3d specific_force(log_.value(Channel::AccelerationX, i),
                                             log_.value(Channel::AccelerationY, i),
                                             log_.value(Channel::AccelerationZ, i));
        if (!options_.accelerometer.use || specific_force.array().isNaN().all()) return;
        const EpochAttitude& attitude = attitudes_[i];
        if (!specific_force.allFinite()) {
            ledger_.reject(Sensor::Accelerometer, "one component missing");
            return;
        }
        if (!attitude.tilt_known) {
            ledger_.reject(Sensor::Accelerometer, "no attitude");
            return;
        }
        const Eigen::Vector3d acceleration = rotationEnuFromBody(attitude.attitude) * specific_force -
                                             kStandardGravity_mps2 * Eigen::Vector3d::UnitZ();
        const double noise = squared(options_.accelerometer.sigma_mps2);
        const double leaned = noise + squared(kStandardGravity_mps2 * attitude.sigma_tilt_rad);
        if (attitude.heading_known) {
            epoch.set(MeasurementRow::AccelerationEast, acceleration.x(), leaned);
            epoch.set(MeasurementRow::AccelerationNorth, acceleration.y(), leaned);
        }
        epoch.set(MeasurementRow::AccelerationUp, acceleration.z(), noise);
    }

    const ArrayLog& log_;
    const FusionOptions& options_;
    const LocalFrame frame_;
    const std::vector<EpochAttitude>& attitudes_;
    const FlowRejections flow_;
    const RunReference& reference_;
    SensorLedger& ledger_;
    Eigen::Vector3d near_enu_m_;  // the latest measured position, for what depends on it weakly
};

}  // namespace

MeasuredRun measuredRun(const Survey& survey, const Run& run, const FusionOptions& options,
                        const std::vector<EpochAttitude>& attitudes, const RunReference& reference,
                        SensorLedger& ledger) {
    LogMeasurer measurer(survey, run, options, attitudes, reference, ledger);
    MeasuredRun measured{.run_id = run.id, .start = startOf(run, options, reference)};
    Sensor& height = measured.sensors[static_cast<std::size_t>(MeasurementRow::BarometerUp)];
    if (!reference.has_height) {
        height = Sensor::HeightAssumption;
    } else if (!reference.barometer_zero_m) {
        height = Sensor::GnssHeight;
    }
    measured.epochs.reserve(run.log.size());
    for (std::size_t i = 0; i < run.log.size(); ++i) measured.epochs.push_back(measurer.measure(i));
    return measured;
}

Matrix9d constantAccelerationMatrix(double dt_s) {
    Matrix9d F = Matrix9d::Identity();
    for (int axis = 0; axis < 3; ++axis) {
        const int v = offset(StateBlock::Velocity) + axis;
        const int p = offset(StateBlock::Position) + axis;
        const int a = offset(StateBlock::Acceleration) + axis;
        F(p, v) = dt_s;
        F(p, a) = 0.5 * dt_s * dt_s;
        F(v, a) = dt_s;
    }
    return F;
}

Vector9d stepNoiseDiagonal(const AukfOptions& options, double dt_s) {
    const StepNoiseOptions& noise = options.noise;
    Vector9d q;
    q << noise.velocity_e_m2ps2, noise.velocity_n_m2ps2, noise.velocity_u_m2ps2,  //
        noise.position_e_m2, noise.position_n_m2, noise.position_u_m2,            //
        noise.acceleration_e_m2ps4, noise.acceleration_n_m2ps4, noise.acceleration_u_m2ps4;
    return dt_s / options.nominal_interval_s * q;
}

}  // namespace terrawalk
