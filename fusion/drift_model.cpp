#include "fusion/drift_model.hpp"

#include <algorithm>
#include <cmath>

#include "fusion/gnss_jumps.hpp"
#include "fusion/unscented_transform.hpp"

namespace terrawalk {

namespace {

using FlowVector = Eigen::Matrix<double, 6, 1>;
using FlowMatrix = Eigen::Matrix<double, 6, 6>;

double squared(double x) {
    return x * x;
}

double predictedFlow(const FlowVector& x, const Eigen::Vector2d& direction, double sin_yaw, double cos_yaw) {
    const double error = x[kCompassError] + x[kIronSin] * sin_yaw + x[kIronCos] * cos_yaw;
    const double c = std::cos(error);
    const double s = std::sin(error);
    return x[kFlowScale] * (direction.x() * (c * x[kVelocityEast] - s * x[kVelocityNorth]) +
                            direction.y() * (s * x[kVelocityEast] + c * x[kVelocityNorth]));
}

int velocityState(int axis) {
    return axis == 2 ? kVelocityUp : kVelocityEast + axis;
}

// Velocity by random walk of density q, and position.
void addWalk(DriftTransition& step, int velocity, int position, double q, double dt_s) {
    step.F(position, velocity) = dt_s;
    step.Q(velocity, velocity) = q * dt_s;
    step.Q(velocity, position) = step.Q(position, velocity) = 0.5 * q * dt_s * dt_s;
    step.Q(position, position) = q * dt_s * dt_s * dt_s / 3.0;
}

// Velocity as a Gauss-Markov process, and position. Source: Singer 1970, one order lower.
void addGaussMarkovWalk(DriftTransition& step, int velocity, int position, double sigma_mps, double tau_s,
                        double dt_s) {
    const double x = dt_s / tau_s;
    const double gone = -std::expm1(-x);
    const double variance = squared(sigma_mps);
    step.F(velocity, velocity) = 1.0 - gone;
    step.F(position, velocity) = tau_s * gone;
    step.Q(velocity, velocity) = variance * -std::expm1(-2.0 * x);
    step.Q(velocity, position) = step.Q(position, velocity) = variance * tau_s * gone * gone;
    // 2 x - 2 gone - gone^2 cancels for small x; the series does not.
    const double way = x < 1e-3 ? x * x * x * (2.0 / 3.0 - 0.5 * x) : 2.0 * (x - gone) - gone * gone;
    step.Q(position, position) = variance * tau_s * tau_s * way;
}

void addGaussMarkov(DriftTransition& step, int state, double sigma, double tau_s, double dt_s) {
    step.F(state, state) = std::exp(-dt_s / tau_s);
    step.Q(state, state) = squared(sigma) * -std::expm1(-2.0 * dt_s / tau_s);
}

long fixCode(const ArrayLog& log, std::size_t epoch) {
    const double fix = log.value(Channel::Fix, epoch);
    return present(fix) ? std::lround(fix) : fix_code::kSingle;
}

}  // namespace

double innovation(const DriftEstimate& state, const DriftRow& row) {
    return row.value - row.direction.dot(state.mean);
}

double innovationVariance(const DriftEstimate& state, const DriftRow& row) {
    return row.direction.dot(state.covariance * row.direction) + row.variance;
}

DriftEstimate updated(const DriftEstimate& state, const DriftRow& row) {
    const DriftVector PH = state.covariance * row.direction;
    const DriftVector K = PH / (row.direction.dot(PH) + row.variance);
    const DriftMatrix A = state.covariance - K * PH.transpose();
    const DriftVector AH = A * row.direction;
    const DriftMatrix P = A - AH * K.transpose() + row.variance * K * K.transpose();
    return {state.mean + K * innovation(state, row), 0.5 * (P + P.transpose())};
}

DriftRow linearisedFlow(const DriftEstimate& state, const Eigen::Vector2d& direction, double yaw_rad,
                        double value_mps, double variance, const UnscentedOptions& options) {
    const FlowVector mean = state.mean.head<6>();
    const FlowMatrix P = state.covariance.topLeftCorner<6, 6>();
    const double sin_yaw = std::sin(yaw_rad);
    const double cos_yaw = std::cos(yaw_rad);
    const double centre = predictedFlow(mean, direction, sin_yaw, cos_yaw);
    const auto linear =
        statisticallyLinearised<6>(P, sigmaPointSpread(options, 6), options, [&](const FlowVector& step) {
            return predictedFlow(mean + step, direction, sin_yaw, cos_yaw) - centre;
        });
    DriftRow row;
    row.direction.head<6>() = linear.gradient;
    row.value = value_mps - centre - linear.shift + linear.gradient.dot(mean);
    row.variance = variance + linear.omega;
    return row;
}

DriftTransition driftTransition(const FusionOptions& options, double dt_s, const GnssErrorStep& gnss) {
    const LastingErrorOptions& lasting = options.lasting;
    const BarometerOptions& barometer = options.barometer;
    DriftTransition step{DriftMatrix::Identity(), DriftMatrix::Zero()};
    const double walk = squared(options.joint.walk_mps_per_sqrt_s);
    addWalk(step, kVelocityEast, kEast, walk, dt_s);
    addWalk(step, kVelocityNorth, kNorth, walk, dt_s);
    addGaussMarkovWalk(step, kVelocityUp, kUp, options.drift.climb_sigma_mps,
                       options.drift.climb_correlation_s, dt_s);
    step.Q(kBarometerDrift, kBarometerDrift) = squared(barometer.drift_m_per_sqrt_min) * dt_s / 60.0;
    addGaussMarkov(step, kGust, barometer.gust_sigma_m, barometer.gust_correlation_s, dt_s);
    addGaussMarkov(step, kCompassError, radians(lasting.heading_sigma_deg), lasting.heading_correlation_s,
                   dt_s);
    for (int axis = 0; axis < 3; ++axis) {
        const int state = kGnssErrorEast + axis;
        const double sigma_m = axis == 2 ? gnss.sigma_up_m : gnss.sigma_m;
        addGaussMarkov(step, state, sigma_m, lasting.gnss_correlation_s, dt_s);
        if (gnss.renewed) {
            step.F(state, state) = 0.0;
            step.Q(state, state) = squared(sigma_m);
        }
    }
    return step;
}

DriftModel::DriftModel(const ReadingContext& context) : context_(context), gnss_jump_m_(gnssJumps(context)) {
    const FusionOptions& options = context.options;
    const RunReference& reference = context.reference;
    const LastingErrorOptions& lasting = options.lasting;
    state_.mean.segment<3>(kEast) = reference.start_enu_m;
    state_.mean[kFlowScale] = 1.0;
    auto variance = state_.covariance.diagonal();
    variance.segment<3>(kEast) = reference.start_sigma_m.array().square();
    for (int axis = 0; axis < 3; ++axis) {
        variance[velocityState(axis)] = squared(options.initial.velocity_sigma_mps);
    }
    variance[kFlowScale] = squared(lasting.flow_scale_sigma);
    variance[kCompassError] = squared(radians(lasting.heading_sigma_deg));
    variance[kIronSin] = variance[kIronCos] =
        squared(radians(std::hypot(lasting.hard_iron_sigma_deg, lasting.hard_iron_run_sigma_deg)));
    // Where something else tells the height, it tells the zero of the barometer too, and better than once.
    const double walked_s = std::abs(reference.barometer_zero_time_s - context.log.time_s.front());
    variance[kBarometerDrift] = reference.barometer_zero_m && heightIsTold()
                                    ? squared(options.initial.position_sigma_m)
                                    : reference.height_reference_variance_m2 +
                                          squared(options.barometer.drift_m_per_sqrt_min) * walked_s / 60.0;
    variance[kGust] = squared(options.barometer.gust_sigma_m);
    for (NoiseFactor& factor : factors_) factor.time_s = context.log.time_s.front();
    const GnssErrorStep gnss = gnssStep(0);
    variance.segment<3>(kGnssErrorEast) << squared(gnss.sigma_m), squared(gnss.sigma_m),
        squared(gnss.sigma_up_m);
    gnss_steps_.push_back(gnss);
}

// Whether anything but the zero of the barometer tells the height of the run.
bool DriftModel::heightIsTold() const {
    const auto& ties = context_.reference.ties;
    if (std::any_of(ties.begin(), ties.end(), [](const MarkTie& tie) { return tie.has_height; })) return true;
    const GnssHeightUse use = context_.reference.gnss_height;
    if (use == GnssHeightUse::Never) return false;
    const ArrayLog& log = context_.log;
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (!present(log.value(Channel::EllipsoidalHeight, i)) || !present(log.value(Channel::Latitude, i))) {
            continue;
        }
        const GnssQuality quality = gnssQuality(log, i, context_.options.gnss);
        if (quality.rejection.empty() && (quality.rtk || use == GnssHeightUse::Always)) return true;
    }
    return false;
}

GnssErrorStep DriftModel::gnssStep(std::size_t epoch) {
    const ArrayLog& log = context_.log;
    const FusionOptions& options = context_.options;
    GnssErrorStep step = gnss_steps_.empty() ? GnssErrorStep{false, options.gnss.sigma_single_m,
                                                             options.gnss.sigma_single_up_m}
                                             : gnss_steps_.back();
    step.renewed = false;
    const GnssQuality quality = gnssQuality(log, epoch, options.gnss);
    if (!present(log.value(Channel::Latitude, epoch)) || !quality.rejection.empty()) return step;
    const long code = fixCode(log, epoch);
    step.renewed = code != fix_code_;
    fix_code_ = code;
    const double share = std::sqrt(std::max(0.0, 1.0 - squared(gnssWhiteShare(log, epoch, options.lasting))));
    step.sigma_m = share * quality.sigma_m;
    step.sigma_up_m = share * quality.sigma_up_m;
    return step;
}

void DriftModel::predict(std::size_t epoch) {
    gnss_steps_.push_back(gnssStep(epoch));
    const DriftTransition step = driftTransition(
        context_.options, context_.log.time_s[epoch] - context_.log.time_s[epoch - 1], gnss_steps_.back());
    const DriftMatrix P = step.F * state_.covariance * step.F.transpose() + step.Q;
    state_ = {step.F * state_.mean, 0.5 * (P + P.transpose())};
}

DriftTransition DriftModel::transitionInto(std::size_t epoch) const {
    DriftTransition step = driftTransition(
        context_.options, context_.log.time_s[epoch] - context_.log.time_s[epoch - 1], gnss_steps_[epoch]);
    for (const Doubt& doubt : doubts_) {
        if (doubt.epoch == epoch) step.Q.diagonal() += doubt.variance;
    }
    return step;
}

StateEstimate DriftModel::prediction() const {
    StateEstimate out;
    out.mean.setZero();
    out.mean.segment<3>(offset(StateBlock::Position)) = state_.mean.segment<3>(kEast);
    for (int axis = 0; axis < 3; ++axis) {
        out.mean[offset(StateBlock::Velocity) + axis] = state_.mean[velocityState(axis)];
    }
    return out;
}

Eigen::Matrix3d DriftModel::positionCovariance() const {
    return state_.covariance.block<3, 3>(kEast, kEast);
}

bool DriftModel::finite() const {
    return state_.mean.allFinite() && state_.covariance.allFinite();
}

// What the errors that have states of their own leave to the noise of a row.
DriftRow DriftModel::row(std::size_t epoch, const Reading& reading, std::size_t r) const {
    const FusionOptions& options = context_.options;
    const LinearRow& given = reading.rows[r].row;
    const double factor = noiseFactor(reading.sensor);
    DriftRow row;
    row.value = given.value;
    switch (reading.sensor) {
        case Sensor::GnssPosition:
        case Sensor::GnssHeight: {
            const GnssQuality quality = gnssQuality(context_.log, epoch, options.gnss);
            const double total =
                squared(reading.sensor == Sensor::GnssHeight ? quality.sigma_up_m : quality.sigma_m);
            const double arm = reading.rows[r].gate_variance - total;
            row.direction.segment<3>(kEast) = given.direction;
            row.direction.segment<3>(kGnssErrorEast) = given.direction;
            row.variance =
                factor * squared(gnssWhiteShare(context_.log, epoch, options.lasting)) * total + arm;
            return row;
        }
        case Sensor::Barometer:
            row.direction[kUp] = row.direction[kBarometerDrift] = row.direction[kGust] = 1.0;
            row.variance = factor * squared(options.barometer.sigma_m);
            return row;
        case Sensor::OpticalFlow:
        case Sensor::MeanFlow: {
            const EpochAttitude& attitude = context_.attitudes[epoch];
            double variance = given.variance;
            if (reading.sensor == Sensor::OpticalFlow) {
                const double speed = reading.rows[0].row.value;
                // A held heading errs by more than the states of the compass; across the walk.
                const double held = squared(attitude.sigma_heading_rad) -
                                    squared(radians(options.attitude.sigma_heading_deg));
                variance = factor * flowVariance(options.flow, speed) +
                           (r == 1 ? std::max(0.0, held) * squared(speed) : 0.0);
            }
            return linearisedFlow(state_, given.direction.head<2>(), attitude.attitude.yaw_rad, given.value,
                                  variance, options.unscented);
        }
        default:
            for (int axis = 0; axis < 3; ++axis) row.direction[velocityState(axis)] = given.direction[axis];
            row.variance = factor * given.variance;
            return row;
    }
}

RowTest DriftModel::test(std::size_t epoch, const Reading& reading, std::size_t r) const {
    const DriftRow tested = row(epoch, reading, r);
    return {innovation(state_, tested), std::sqrt(innovationVariance(state_, tested))};
}

// By which the GNSS stands off there [m].
double DriftModel::jumpOf(std::size_t epoch, const Reading& reading) const {
    const bool of_gnss = reading.sensor == Sensor::GnssPosition || reading.sensor == Sensor::GnssHeight;
    return of_gnss ? gnss_jump_m_[epoch] : 0.0;
}

bool DriftModel::doubts(std::size_t epoch, const Reading& reading) const {
    return jumpOf(epoch, reading) > 0.0;
}

void DriftModel::update(std::size_t epoch, const Reading& reading, std::size_t r, double excess) {
    DriftRow taken = row(epoch, reading, r);
    const bool telling = reading.sensor != Sensor::MeanFlow && !doubts(epoch, reading);
    if (context_.options.drift.adapt && telling) adapt(epoch, reading, taken);
    taken.variance = taken.variance * excess + squared(jumpOf(epoch, reading));
    state_ = updated(state_, taken);
}

// A step towards the factor that makes the bounded normalised innovation 1 on average. It counts by the
// share of the noise in the innovation, so a filter that is unsure of itself learns nothing of its sensors.
void DriftModel::adapt(std::size_t epoch, const Reading& reading, const DriftRow& row) {
    constexpr double kGreatestSquare = 9.0;
    constexpr double kLongestInterval_s = 1.0;  // a reading after a silence counts as one
    const DriftFilterOptions& options = context_.options.drift;
    NoiseFactor& factor = factors_[static_cast<std::size_t>(reading.sensor)];
    const double time_s = context_.log.time_s[epoch];
    if (time_s > factor.time_s) {
        factor.interval_s = std::min(time_s - factor.time_s, kLongestInterval_s);
        factor.time_s = time_s;
    }
    const double share_s = factor.interval_s / static_cast<double>(reading.row_count);
    const double variance = innovationVariance(state_, row);
    const double square = std::min(squared(innovation(state_, row)) / variance, kGreatestSquare);
    const double weight = -std::expm1(-share_s / options.adapt_memory_s);
    factor.value = std::clamp(factor.value * (1.0 + weight * row.variance / variance * (square - 1.0)),
                              options.least_factor, options.greatest_factor);
}

void DriftModel::assume(const LinearRow& given) {
    DriftRow row;
    for (int axis = 0; axis < 3; ++axis) {
        row.direction[given.block == StateBlock::Velocity ? velocityState(axis) : kEast + axis] =
            given.direction[axis];
    }
    row.value = given.value;
    row.variance = given.variance;
    state_ = updated(state_, row);
}

// By an assumption that errs lastingly: the drift of a barometer stands for its error.
void DriftModel::holdHeight() {
    DriftRow row;
    row.direction[kUp] = row.direction[kBarometerDrift] = 1.0;
    row.value = context_.reference.start_enu_m.z();
    row.variance = context_.reference.height_reference_variance_m2;
    state_ = updated(state_, row);
}

// GNSS is believed against the track, a barometer against what was held to be its drift.
void DriftModel::readmit(std::size_t epoch, const Reading& reading) {
    Doubt doubt{epoch, DriftVector::Zero()};
    for (std::size_t r = 0; r < reading.row_count; ++r) {
        const double square = squared(innovation(state_, row(epoch, reading, r)));
        if (reading.sensor == Sensor::Barometer) {
            doubt.variance[kBarometerDrift] += square;
        } else {
            doubt.variance.segment<3>(kEast) +=
                square * reading.rows[r].row.direction.array().square().matrix();
        }
    }
    state_.covariance.diagonal() += doubt.variance;
    doubts_.push_back(doubt);
}

}  // namespace terrawalk
