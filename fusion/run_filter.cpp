#include "fusion/run_filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

}  // namespace

void Spell::tell(bool so, double time_s, double longest_gap_s) {
    if (!so) {
        since_s_ = std::numeric_limits<double>::quiet_NaN();
    } else if (!(time_s - last_s_ <= longest_gap_s)) {
        since_s_ = time_s;
    }
    last_s_ = so ? time_s : since_s_;
}

double Spell::lasted(double time_s, double longest_gap_s) const {
    return time_s - last_s_ <= longest_gap_s ? time_s - since_s_ : std::numeric_limits<double>::quiet_NaN();
}

std::optional<Error> RunFilter::step(std::size_t epoch) {
    if (epoch > 0) model_.predict(epoch);
    gated_.fill(false);
    readEpoch(context_, epoch, model_.prediction(), memory_, readings_);
    readmit(epoch);
    applyTies(epoch);
    for (const Reading& reading : readings_) applyReading(epoch, reading);
    if (!context_.reference.has_height) {
        model_.holdHeight();
        ledger_.use(Sensor::HeightAssumption, false);
    } else {
        holdClimb(epoch);
    }
    return divergence(epoch);
}

void RunFilter::note(std::vector<std::string>& notes) const {
    for (const SensorUse& use : ledger_.uses()) {
        if (2 * use.used < use.offered) {
            notes.push_back(
                fmt::format("{}: only {} of {} readings were used", use.sensor, use.used, use.offered));
        }
    }
    if (bridged_s_ > 0.0) {
        notes.push_back(
            fmt::format("optical flow bridged by its recent mean for {:.1f} s in all", bridged_s_));
    }
    if (readmissions_ > 0) {
        notes.push_back(
            fmt::format("a sensor that had been rejected for long was let in again {} times; the track may "
                        "be off before that",
                        readmissions_));
    }
}

// Innovation over sigma of the worst of a reading's rows, with its sign.
double RunFilter::worstDeviation(std::size_t epoch, const Reading& reading) const {
    double worst = 0.0;
    for (std::size_t r = 0; r < reading.row_count; ++r) {
        const RowTest row = model_.test(epoch, reading, r);
        const double own = row.innovation / row.sigma;
        if (std::abs(own) > std::abs(worst)) worst = own;
    }
    return worst;
}

void RunFilter::applyTies(std::size_t epoch) {
    const std::vector<MarkTie>& ties = context_.reference.ties;
    for (; next_tie_ < ties.size() && ties[next_tie_].epoch == epoch; ++next_tie_) {
        const MarkTie& tie = ties[next_tie_];
        for (int axis = 0; axis < (tie.has_height ? 3 : 2); ++axis) {
            model_.assume({StateBlock::Position, Eigen::Vector3d::Unit(axis), tie.array_enu_m[axis],
                           tie.variance_m2[axis]});
        }
        if (tie.has_height) memory_.lastUsed(Sensor::MarkTie) = time(epoch);
        ledger_.use(Sensor::MarkTie, false);
    }
}

// Lets a sensor in again that was steadily rejected for so long that the filter must be wrong.
void RunFilter::readmit(std::size_t epoch) {
    const RobustOptions& robust = context_.options.robust;
    if (!robust.use) return;
    for (const Reading& reading : readings_) {
        if (!mayBeReadmitted(reading.sensor) || reading.row_count == 0) continue;
        const double rejected_s = rejectionOf(reading.sensor).lasted(time(epoch), robust.longest_gap_s);
        if (!(rejected_s >= robust.readmit_after_s)) continue;
        if (std::abs(worstDeviation(epoch, reading)) <= robust.gate_sigma) continue;
        model_.readmit(epoch, reading);
        ++readmissions_;
    }
}

void RunFilter::applyReading(std::size_t epoch, const Reading& reading) {
    if (!reading.rejection.empty()) {
        ledger_.reject(reading.sensor, reading.rejection);
        return;
    }
    const RobustOptions& robust = context_.options.robust;
    const double deviation = worstDeviation(epoch, reading);
    const bool outside = robust.use && std::abs(deviation) > robust.gate_sigma;
    record_.add(reading.sensor, time(epoch), deviation, !outside);
    if (reading.sensor == Sensor::GnssPosition) watchGnss(epoch, reading, outside);
    rejectionOf(reading.sensor).tell(outside, time(epoch), robust.longest_gap_s);
    gated_[static_cast<std::size_t>(reading.sensor)] = outside;
    if (outside) {
        ledger_.reject(reading.sensor, "beyond gate");
        return;
    }
    bool down_weighted = model_.doubts(epoch, reading);
    double nis = 0.0;
    for (std::size_t r = 0; r < reading.row_count; ++r) {
        double excess = 1.0;
        const RowTest row = model_.test(epoch, reading, r);
        // Row after row, each against what the ones before it left: together they are nu' S^-1 nu.
        nis += row.innovation * row.innovation / (row.sigma * row.sigma);
        if (robust.use) {
            excess = std::max(1.0, std::abs(row.innovation) / (row.sigma * robust.huber_sigma));
        }
        down_weighted = down_weighted || excess > 1.0;
        model_.update(epoch, reading, r, excess);
    }
    ledger_.use(reading.sensor, down_weighted);
    record_.addNis(reading.sensor, nis, reading.row_count);
    remember(epoch, reading);
}

void RunFilter::remember(std::size_t epoch, const Reading& reading) {
    if (reading.sensor == Sensor::MeanFlow) bridged_s_ += time(epoch) - memory_.lastFlow();
    const double since_s = time(epoch) - memory_.lastUsed(reading.sensor);
    memory_.lastUsed(reading.sensor) = time(epoch);
    if (reading.sensor != Sensor::OpticalFlow) return;
    const Eigen::Vector2d flow_mps(context_.log.value(Channel::FlowForward, epoch),
                                   context_.log.value(Channel::FlowLeft, epoch));
    const double weight = -std::expm1(-since_s / context_.options.flow.bridge_memory_s);
    memory_.mean_flow_mps += weight * (flow_mps - memory_.mean_flow_mps);
}

// While all that measures height is silent, a walk climbs little.
void RunFilter::holdClimb(std::size_t epoch) {
    const double longest_s = context_.options.barometer.longest_silence_s;
    const double measured_s =
        std::max({context_.log.time_s.front(), memory_.lastUsed(Sensor::Barometer),
                  memory_.lastUsed(Sensor::GnssHeight), memory_.lastUsed(Sensor::MarkTie)});
    if (time(epoch) - measured_s <= longest_s) return;
    const double factor = whiteNoiseFactor(longest_s, time(epoch) - time(epoch - 1));
    model_.assume({StateBlock::Velocity, Eigen::Vector3d::UnitZ(), 0.0, factor * squared(kClimbSigma_mps)});
    ledger_.use(Sensor::HeightAssumption, false);
}

void RunFilter::watchGnss(std::size_t epoch, const Reading& reading, bool outside) {
    const DivergenceOptions& limits = context_.options.divergence;
    const Eigen::Vector2d position_m(reading.rows[0].row.value, reading.rows[1].row.value);
    const Eigen::Vector2d apart_m = position_m - model_.prediction().block(StateBlock::Position).head<2>();
    const double longest_gap_s = context_.options.robust.longest_gap_s;
    far_.tell(apart_m.norm() > limits.largest_gnss_distance_m, time(epoch), longest_gap_s);
    far_for_s_ = far_.lasted(time(epoch), longest_gap_s);
    // A position that ends a silence speaks for itself, not for the time that nothing was heard.
    const double interval_s =
        std::isnan(gnss_seen_s_) ? 0.0 : std::min(time(epoch) - gnss_seen_s_, longest_gap_s);
    gnss_seen_s_ = time(epoch);
    if (outside) ++rejected_positions_;
    const double weight = -std::expm1(-interval_s / limits.rejected_window_s);
    rejected_share_ += weight * ((outside ? 1.0 : 0.0) - rejected_share_);
}

std::optional<Error> RunFilter::divergence(std::size_t epoch) const {
    const DivergenceOptions& limits = context_.options.divergence;
    if (!model_.finite()) return diverged(epoch, "the state is no longer finite");
    const double sigma_m = std::sqrt(model_.positionCovariance().diagonal().maxCoeff());
    if (!(sigma_m <= limits.largest_sigma_m)) {
        return diverged(epoch, fmt::format("the position is known to no better than {:.0f} m", sigma_m));
    }
    if (far_for_s_ >= limits.patience_s) {
        return diverged(epoch, fmt::format("the track is more than {:.0f} m from GNSS for {:.0f} s",
                                           limits.largest_gnss_distance_m, limits.patience_s));
    }
    if (rejected_positions_ >= limits.fewest_rejected && rejected_share_ > limits.rejected_share) {
        return diverged(epoch,
                        fmt::format("{:.0f} % of the GNSS positions of the last {:.0f} s are beyond the gate",
                                    100.0 * rejected_share_, limits.rejected_window_s));
    }
    return std::nullopt;
}

Error RunFilter::diverged(std::size_t epoch, const std::string& why) const {
    return {ErrorKind::BadData,
            fmt::format("run {}: the filter diverged at {:.2f} s: {}", run_.id, time(epoch), why),
            run_.log.file, 0,
            "look at the sensors of this run with 'inspect', or leave out the one that contradicts the "
            "others"};
}

}  // namespace terrawalk
