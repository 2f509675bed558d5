#include "fusion/fuse_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "fusion/aukf_trajectory.hpp"
#include "fusion/raw_trajectory.hpp"
#include "fusion/rts_smoother.hpp"
#include "fusion/run_reference.hpp"
#include "fusion/sensor_ledger.hpp"
#include "fusion/sensor_readings.hpp"

namespace terrawalk {

namespace {

// Mean climb of a walk over `BarometerOptions::longest_silence_s`, where all sensors of height are silent.
constexpr double kClimbSigma_mps = 0.15;

double squared(double x) {
    return x * x;
}

// A sensor that sees what the filter sums up over time can be right against a filter that went astray.
// Velocity and acceleration are forgotten within seconds, so a long rejection of those is the sensor's own
// fault.
bool mayBeReadmitted(Sensor sensor) {
    return sensor == Sensor::GnssPosition || sensor == Sensor::GnssHeight || sensor == Sensor::Barometer;
}

// The worst |innovation| / sigma of a reading's rows.
double worstDeviation(const StateEstimate& state, const Reading& reading) {
    double worst = 0.0;
    for (std::size_t r = 0; r < reading.row_count; ++r) {
        const LinearRow& row = reading.rows[r].row;
        const double sigma = std::sqrt(predictedVariance(state, row) + reading.rows[r].gate_variance);
        worst = std::max(worst, std::abs(innovation(state, row)) / sigma);
    }
    return worst;
}

// For how long the readings of a sensor have told the same thing. Silence tells nothing: a gap ends it.
class Spell {
  public:
    void tell(bool so, double time_s, double longest_gap_s) {
        if (!so) {
            since_s_ = std::numeric_limits<double>::quiet_NaN();
        } else if (!(time_s - last_s_ <= longest_gap_s)) {
            since_s_ = time_s;
        }
        last_s_ = so ? time_s : since_s_;
    }
    /// Up to a reading at `time_s`; not a number when there is no spell.
    double lasted(double time_s, double longest_gap_s) const {
        return time_s - last_s_ <= longest_gap_s ? time_s - since_s_
                                                 : std::numeric_limits<double>::quiet_NaN();
    }

  private:
    double since_s_ = std::numeric_limits<double>::quiet_NaN();
    double last_s_ = std::numeric_limits<double>::quiet_NaN();
};

// Takes one run through the filter, epoch by epoch.
class RunFilter {
  public:
    RunFilter(const ReadingContext& context, const Run& run) : context_(context), run_(run) {
        const RunReference& reference = context.reference;
        const InitialOptions& initial = context.options.initial;
        state_.covariance.setZero();
        state_.mean.segment<3>(offset(StateBlock::Position)) = reference.start_enu_m;
        state_.covariance.diagonal().segment<3>(offset(StateBlock::Position)) =
            reference.start_sigma_m.array().square();
        state_.covariance.diagonal()
            .segment<3>(offset(StateBlock::Velocity))
            .setConstant(squared(initial.velocity_sigma_mps));
        state_.covariance.diagonal()
            .segment<3>(offset(StateBlock::Acceleration))
            .setConstant(squared(initial.acceleration_sigma_mps2));
    }

    const StateEstimate& state() const { return state_; }
    const std::vector<Inflation>& inflations() const { return inflations_; }
    const Vector9d& heightResponse() const { return height_response_; }
    double bridged_s() const { return bridged_s_; }
    std::vector<SensorUse> sensors() const { return ledger_.uses(); }

    /// Nothing, or why the run must be given up.
    std::optional<Error> step(std::size_t epoch) {
        if (epoch > 0) {
            const double dt_s = context_.log.time_s[epoch] - context_.log.time_s[epoch - 1];
            const Transition step = transition(context_.options.process, dt_s);
            state_ = predicted(state_, step);
            height_response_ = (step.F * height_response_).eval();
        }
        readEpoch(context_, epoch, state_, memory_, readings_);
        readmit(epoch);
        applyTies(epoch);
        for (const Reading& reading : readings_) applyReading(epoch, reading);
        if (!context_.reference.has_height) {
            holdHeight();
        } else {
            holdClimb(epoch);
        }
        return divergence(epoch);
    }

  private:
    double time(std::size_t epoch) const { return context_.log.time_s[epoch]; }
    Spell& rejectionOf(Sensor sensor) { return rejections_[static_cast<std::size_t>(sensor)]; }

    // `from_height_reference`: the row's value moves with what heights are measured from.
    void update(const LinearRow& row, bool from_height_reference = false) {
        const double moved = from_height_reference ? row.direction.z() : 0.0;
        height_response_ +=
            gain(state_, row) * (moved - row.direction.dot(height_response_.segment<3>(offset(row.block))));
        state_ = updated(state_, row);
    }

    void applyTies(std::size_t epoch) {
        const std::vector<MarkTie>& ties = context_.reference.ties;
        for (; next_tie_ < ties.size() && ties[next_tie_].epoch == epoch; ++next_tie_) {
            const MarkTie& tie = ties[next_tie_];
            for (int axis = 0; axis < (tie.has_height ? 3 : 2); ++axis) {
                update({StateBlock::Position, Eigen::Vector3d::Unit(axis), tie.array_enu_m[axis],
                        tie.variance_m2[axis]});
            }
            if (tie.has_height) memory_.lastUsed(Sensor::MarkTie) = time(epoch);
            ledger_.use(Sensor::MarkTie, false);
        }
    }

    // Lets a sensor in again that was steadily rejected for so long that the filter must be wrong: the
    // filter's own variance grows by the square of what it is off.
    void readmit(std::size_t epoch) {
        const RobustOptions& robust = context_.options.robust;
        if (!robust.use) return;
        for (const Reading& reading : readings_) {
            if (!mayBeReadmitted(reading.sensor) || reading.row_count == 0) continue;
            const double rejected_s = rejectionOf(reading.sensor).lasted(time(epoch), robust.longest_gap_s);
            if (!(rejected_s >= robust.readmit_after_s)) continue;
            if (worstDeviation(state_, reading) <= robust.gate_sigma) continue;
            Inflation inflation{epoch, reading.rows[0].row.block, Eigen::Vector3d::Zero()};
            for (std::size_t r = 0; r < reading.row_count; ++r) {
                const LinearRow& row = reading.rows[r].row;
                inflation.variance +=
                    squared(innovation(state_, row)) * row.direction.array().square().matrix();
            }
            const int at = offset(inflation.block);
            state_.covariance.block<3, 3>(at, at).diagonal() += inflation.variance;
            inflations_.push_back(inflation);
        }
    }

    void applyReading(std::size_t epoch, const Reading& reading) {
        if (!reading.rejection.empty()) {
            ledger_.reject(reading.sensor, reading.rejection);
            return;
        }
        const RobustOptions& robust = context_.options.robust;
        const double deviation = robust.use ? worstDeviation(state_, reading) : 0.0;
        const bool outside = deviation > robust.gate_sigma;
        if (reading.sensor == Sensor::GnssPosition) watchGnss(epoch, reading, outside);
        rejectionOf(reading.sensor).tell(outside, time(epoch), robust.longest_gap_s);
        if (outside) {
            ledger_.reject(reading.sensor, "beyond gate");
            return;
        }
        bool down_weighted = false;
        for (std::size_t r = 0; r < reading.row_count; ++r) {
            LinearRow row = reading.rows[r].row;
            if (robust.use) {
                const double sigma =
                    std::sqrt(predictedVariance(state_, row) + reading.rows[r].gate_variance);
                const double excess = std::abs(innovation(state_, row)) / (sigma * robust.huber_sigma);
                if (excess > 1.0) {
                    row.variance *= excess;
                    down_weighted = true;
                }
            }
            update(row, reading.sensor == Sensor::Barometer);
        }
        ledger_.use(reading.sensor, down_weighted);
        remember(epoch, reading);
    }

    void remember(std::size_t epoch, const Reading& reading) {
        if (reading.sensor == Sensor::MeanFlow) bridged_s_ += time(epoch) - memory_.lastFlow();
        const double since_s = time(epoch) - memory_.lastUsed(reading.sensor);
        memory_.lastUsed(reading.sensor) = time(epoch);
        if (reading.sensor != Sensor::OpticalFlow) return;
        const Eigen::Vector2d flow_mps(context_.log.value(Channel::FlowForward, epoch),
                                       context_.log.value(Channel::FlowLeft, epoch));
        const double weight = -std::expm1(-since_s / context_.options.flow.bridge_memory_s);
        memory_.mean_flow_mps += weight * (flow_mps - memory_.mean_flow_mps);
    }

    // Where nothing measures height it stays near that of the start, by an assumption that errs lastingly.
    void holdHeight() {
        update({StateBlock::Position, Eigen::Vector3d::UnitZ(), context_.reference.start_enu_m.z(),
                context_.reference.height_reference_variance_m2},
               true);
        ledger_.use(Sensor::HeightAssumption, false);
    }

    // While all that measures height is silent, a walk climbs little.
    void holdClimb(std::size_t epoch) {
        const double longest_s = context_.options.barometer.longest_silence_s;
        const double measured_s =
            std::max({context_.log.time_s.front(), memory_.lastUsed(Sensor::Barometer),
                      memory_.lastUsed(Sensor::GnssHeight), memory_.lastUsed(Sensor::MarkTie)});
        if (time(epoch) - measured_s <= longest_s) return;
        const double factor = whiteNoiseFactor(longest_s, time(epoch) - time(epoch - 1));
        update({StateBlock::Velocity, Eigen::Vector3d::UnitZ(), 0.0, factor * squared(kClimbSigma_mps)});
        ledger_.use(Sensor::HeightAssumption, false);
    }

    void watchGnss(std::size_t epoch, const Reading& reading, bool outside) {
        const DivergenceOptions& limits = context_.options.divergence;
        const Eigen::Vector2d apart(innovation(state_, reading.rows[0].row),
                                    innovation(state_, reading.rows[1].row));
        const double longest_gap_s = context_.options.robust.longest_gap_s;
        far_.tell(apart.norm() > limits.largest_gnss_distance_m, time(epoch), longest_gap_s);
        far_for_s_ = far_.lasted(time(epoch), longest_gap_s);
        // A position that ends a silence speaks for itself, not for the time that nothing was heard.
        const double interval_s =
            std::isnan(gnss_seen_s_) ? 0.0 : std::min(time(epoch) - gnss_seen_s_, longest_gap_s);
        gnss_seen_s_ = time(epoch);
        if (outside) ++rejected_positions_;
        const double weight = -std::expm1(-interval_s / limits.rejected_window_s);
        rejected_share_ += weight * ((outside ? 1.0 : 0.0) - rejected_share_);
    }

    std::optional<Error> divergence(std::size_t epoch) const {
        const DivergenceOptions& limits = context_.options.divergence;
        if (!state_.finite()) return diverged(epoch, "the state is no longer finite");
        const double sigma_m = std::sqrt(state_.blockCovariance(StateBlock::Position).diagonal().maxCoeff());
        if (!(sigma_m <= limits.largest_sigma_m)) {
            return diverged(epoch, fmt::format("the position is known to no better than {:.0f} m", sigma_m));
        }
        if (far_for_s_ >= limits.patience_s) {
            return diverged(epoch, fmt::format("the track is more than {:.0f} m from GNSS for {:.0f} s",
                                               limits.largest_gnss_distance_m, limits.patience_s));
        }
        if (rejected_positions_ >= limits.fewest_rejected && rejected_share_ > limits.rejected_share) {
            return diverged(
                epoch, fmt::format("{:.0f} % of the GNSS positions of the last {:.0f} s are beyond the gate",
                                   100.0 * rejected_share_, limits.rejected_window_s));
        }
        return std::nullopt;
    }

    Error diverged(std::size_t epoch, const std::string& why) const {
        return {ErrorKind::BadData,
                fmt::format("run {}: the filter diverged at {:.2f} s: {}", run_.id, time(epoch), why),
                run_.log.file, 0,
                "look at the sensors of this run with 'inspect', or leave out the one that contradicts the "
                "others"};
    }

    const ReadingContext& context_;
    const Run& run_;
    StateEstimate state_;
    SensorMemory memory_;
    SensorLedger ledger_;
    std::vector<Reading> readings_;
    std::vector<Inflation> inflations_;
    std::array<Spell, kSensorCount> rejections_{};
    Vector9d height_response_ = Vector9d::Zero();
    std::size_t next_tie_ = 0;
    Spell far_;
    double far_for_s_ = std::numeric_limits<double>::quiet_NaN();
    double gnss_seen_s_ = std::numeric_limits<double>::quiet_NaN();
    double rejected_share_ = 0.0;
    int rejected_positions_ = 0;
    double bridged_s_ = 0.0;
};

TrajectoryEpoch trajectoryEpoch(const PackedEstimate& estimate, double height_reference_variance_m2,
                                double time_s, const EpochAttitude& attitude) {
    StateEstimate state = unpacked(estimate);
    const Vector9d lasting = std::sqrt(height_reference_variance_m2) * estimate.height_response;
    state.covariance += lasting * lasting.transpose();
    constexpr int p = offset(StateBlock::Position);
    constexpr int v = offset(StateBlock::Velocity);
    TrajectoryEpoch epoch;
    epoch.time_s = time_s;
    epoch.position_enu_m = state.block(StateBlock::Position);
    epoch.velocity_enu_mps = state.block(StateBlock::Velocity);
    epoch.covariance.topLeftCorner<3, 3>() = state.covariance.block<3, 3>(p, p);
    epoch.covariance.topRightCorner<3, 3>() = state.covariance.block<3, 3>(p, v);
    epoch.covariance.bottomLeftCorner<3, 3>() = state.covariance.block<3, 3>(v, p);
    epoch.covariance.bottomRightCorner<3, 3>() = state.covariance.block<3, 3>(v, v);
    epoch.attitude = attitude.attitude;
    epoch.sigma_tilt_rad = attitude.sigma_tilt_rad;
    epoch.sigma_heading_rad = attitude.sigma_heading_rad;
    return epoch;
}

void noteSensors(const RunFilter& filter, std::vector<std::string>& notes) {
    for (const SensorUse& use : filter.sensors()) {
        if (2 * use.used < use.offered) {
            notes.push_back(
                fmt::format("{}: only {} of {} readings were used", use.sensor, use.used, use.offered));
        }
    }
    if (filter.bridged_s() > 0.0) {
        notes.push_back(
            fmt::format("optical flow bridged by its recent mean for {:.1f} s in all", filter.bridged_s()));
    }
    if (!filter.inflations().empty()) {
        notes.push_back(
            fmt::format("a sensor that had been rejected for long was let in again {} times; the track may "
                        "be off before that",
                        filter.inflations().size()));
    }
}

Result<FusedRun> filteredRun(const Survey& survey, const Run& run, const FusionOptions& options,
                             const std::vector<EpochAttitude>& attitudes, const RunReference& reference,
                             Progress& progress, std::stop_token stop) {
    const LocalFrame frame = survey.frame();
    const ReadingContext context{run.log, options, frame, attitudes, reference};
    RunFilter filter(context, run);
    const std::size_t n = run.log.size();
    std::vector<PackedEstimate> estimates;
    estimates.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (i % 512 == 0) {
            if (stop.stop_requested()) return cancelled();
            progress.report(0.7 * static_cast<double>(i) / static_cast<double>(n), "fusing " + run.id);
        }
        if (auto error = filter.step(i)) return tl::unexpected<Error>(std::move(*error));
        estimates.push_back(packed(filter.state()));
        estimates.back().height_response = filter.heightResponse();
    }
    if (options.smooth) {
        progress.report(0.7, "smoothing " + run.id);
        estimates =
            smoothed(std::move(estimates), run.log.time_s, options.process, filter.inflations(), stop);
        if (stop.stop_requested()) return cancelled();
    }
    FusedRun fused;
    fused.trajectory.run_id = run.id;
    fused.trajectory.epochs.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (!unpacked(estimates[i]).finite()) {
            return badData(fmt::format("run {}: the smoother failed at {:.2f} s", run.id, run.log.time_s[i]),
                           run.log.file);
        }
        fused.trajectory.epochs.push_back(trajectoryEpoch(
            estimates[i], reference.height_reference_variance_m2, run.log.time_s[i], attitudes[i]));
    }
    fused.sensors = filter.sensors();
    noteSensors(filter, fused.notes.details);
    return fused;
}

}  // namespace

Result<FusedRun> fuseRun(const Survey& survey, const Run& run, const FusionOptions& options,
                         Progress& progress, std::stop_token stop) {
    if (run.log.size() == 0)
        return badData(fmt::format("run {}: the log has no epochs", run.id), run.log.file);
    RunNotes notes;
    const std::vector<EpochAttitude> attitudes = epochAttitudes(run.log, options.attitude, notes);
    const auto reference = runReference(survey, run, options, attitudes, notes);
    if (!reference) return tl::unexpected<Error>(reference.error());
    const auto fuse = options.method == FusionMethod::Raw    ? rawTrajectory
                      : options.method == FusionMethod::Aukf ? aukfTrajectory
                                                             : filteredRun;
    auto fused = fuse(survey, run, options, attitudes, *reference, progress, stop);
    if (!fused) return fused;
    notes.details.insert(notes.details.end(), fused->notes.details.begin(), fused->notes.details.end());
    notes.limitations.insert(notes.limitations.end(), fused->notes.limitations.begin(),
                             fused->notes.limitations.end());
    fused->notes = std::move(notes);
    progress.report(1.0, "fused " + run.id);
    return fused;
}

}  // namespace terrawalk
