#include "fusion/joint_adjustment.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "fusion/barometer.hpp"
#include "fusion/position_bends.hpp"
#include "fusion/random_numbers.hpp"
#include "fusion/sparse_least_squares.hpp"

namespace terrawalk {

namespace {

double squared(double x) {
    return x * x;
}

// Rows by the cause of their noise.
enum Group : std::size_t {
    kPrior,
    kTieH,
    kTieV,
    kGnssH,  // of three kinds of fix each
    kGnssV = kGnssH + 3,
    kGnssWalkH = kGnssV + 3,
    kGnssWalkV = kGnssWalkH + 3,
    kDoppler = kGnssWalkV + 3,
    kBarometer,
    kBarometerDrift,
    kGust,
    kFlow,
    kBridge,
    kCompass,
    kGyro,
    kHeading,
    kWalk,
    kClimb,
    kRoughness,
    kBlindClimb,
    kAccelerationH,
    kAccelerationV,
    kAccelerationBias,
    kPair,
    kMarkPass,
    kGroupCount,
};

std::vector<RowGroup> rowGroups(bool robust) {
    std::vector<RowGroup> groups(kGroupCount);
    const auto set = [&](std::size_t g, std::string name, Loss loss, double tuning, bool adapt,
                         double least = 0.2, double greatest = 5.0) {
        groups[g] = {
            std::move(name), robust ? loss : Loss::Square, tuning, false, adapt, least, greatest, 20.0, 1.0};
    };
    set(kPrior, "prior", Loss::Square, 3.0, false);
    set(kTieH, "mark ties, plan", Loss::Square, 3.0, false);
    set(kTieV, "mark ties, height", Loss::Huber, 3.0, false);
    static const std::array<std::string, 3> kFixes{"single", "RTK float", "RTK fixed"};
    // A fixed position does not drift by more than its sigma; what seems to is the sway of the walk.
    constexpr std::size_t kRtkFixed = 2;
    for (std::size_t f = 0; f < 3; ++f) {
        set(kGnssH + f, "GNSS noise, plan, " + kFixes[f], Loss::Cauchy, 3.0, true, 0.5);
        set(kGnssV + f, "GNSS noise, height, " + kFixes[f], Loss::Cauchy, 3.0, true);
        set(kGnssWalkH + f, "GNSS drift, plan, " + kFixes[f], Loss::Cauchy, 2.0, true, 0.3,
            f == kRtkFixed ? 1.0 : 3.0);
        set(kGnssWalkV + f, "GNSS drift, height, " + kFixes[f], Loss::Cauchy, 2.0, true, 0.3, 3.0);
    }
    set(kDoppler, "GNSS velocity", Loss::Cauchy, 3.0, true);
    set(kBarometer, "barometer noise", Loss::Huber, 2.0, true);
    set(kBarometerDrift, "barometer drift", Loss::Square, 3.0, true, 0.1, 6.0);
    set(kGust, "barometer gusts", Loss::Square, 3.0, true, 0.1, 6.0);
    set(kFlow, "optical flow", Loss::Huber, 3.0, true, 0.3, 6.0);
    set(kBridge, "optical flow bridged", Loss::Square, 2.0, false);
    set(kCompass, "compass drift", Loss::Huber, 3.0, true, 0.2, 6.0);
    set(kGyro, "gyro", Loss::Huber, 3.0, true, 0.2, 20.0);
    set(kHeading, "compass noise", Loss::Cauchy, 3.0, true, 0.2, 10.0);
    set(kWalk, "walk", Loss::Square, 2.0, false);
    set(kClimb, "ground climb", Loss::Cauchy, 2.0, true, 0.5, 4.0);
    groups[kClimb].by_median = true;
    set(kRoughness, "ground roughness", Loss::Huber, 2.0, true, 0.2, 6.0);
    set(kBlindClimb, "climb", Loss::Huber, 2.0, false);
    set(kAccelerationH, "accelerometer, plan", Loss::Huber, 3.0, true, 0.2, 50.0);
    set(kAccelerationV, "accelerometer, height", Loss::Huber, 3.0, true, 0.2, 50.0);
    set(kAccelerationBias, "accelerometer bias", Loss::Square, 3.0, false);
    set(kPair, "crossovers", Loss::Cauchy, 3.0, true, 0.5, 5.0);
    set(kMarkPass, "passes over marks", Loss::Cauchy, 3.0, true, 0.5, 5.0);
    return groups;
}

// Coefficients of one row under work.
class RowBuilder {
  public:
    void clear() { size_ = 0; }
    void add(std::size_t unknown, double value) { items_[size_++] = {unknown, value}; }
    std::span<const Coefficient> all() const { return {items_.data(), size_}; }

  private:
    std::array<Coefficient, 32> items_;
    std::size_t size_ = 0;
};

// A quantity that is linear between knots in time; its values are unknowns, one behind the other `stride`
// apart.
class Chain {
  public:
    Chain() = default;
    // Knots every `step_s` where there is something to tell; a gap of two steps is jumped over.
    void cover(double time_s, double step_s) {
        if (times_.empty()) {
            times_.push_back(time_s);
        }
        while (time_s > times_.back()) {
            times_.push_back(time_s > times_.back() + 2.0 * step_s ? time_s : times_.back() + step_s);
        }
    }
    void place(std::size_t first_unknown, std::size_t stride) {
        first_ = first_unknown;
        stride_ = stride;
        values_.assign(times_.size() * stride, 0.0);
    }
    std::size_t knots() const { return times_.size(); }
    double time(std::size_t k) const { return times_[k]; }
    std::size_t unknown(std::size_t k, std::size_t part = 0) const { return first_ + k * stride_ + part; }
    std::size_t unknowns() const { return values_.size(); }
    double knotValue(std::size_t k, std::size_t part = 0) const { return values_[k * stride_ + part]; }

    void setKnotValue(std::size_t k, double value) { values_[k * stride_] = value; }

    struct Place {
        std::size_t knot = 0;
        double fraction = 0.0;  // towards the next knot
    };
    Place locate(double time_s) const {
        if (times_.size() == 1) return {0, 0.0};
        const auto next = std::upper_bound(times_.begin(), times_.end(), time_s);
        const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
            next - times_.begin() - 1, 0, static_cast<std::ptrdiff_t>(times_.size()) - 2));
        return {k, std::clamp((time_s - times_[k]) / (times_[k + 1] - times_[k]), 0.0, 1.0)};
    }
    double value(const Place& at, std::size_t part = 0) const {
        const double here = knotValue(at.knot, part);
        return at.fraction == 0.0 ? here : here + at.fraction * (knotValue(at.knot + 1, part) - here);
    }
    void addTo(RowBuilder& row, const Place& at, double factor, std::size_t part = 0) const {
        row.add(unknown(at.knot, part), factor * (1.0 - at.fraction));
        if (at.fraction > 0.0) row.add(unknown(at.knot + 1, part), factor * at.fraction);
    }
    void take(const Eigen::VectorXd& solution) {
        for (std::size_t i = 0; i < values_.size(); ++i) {
            values_[i] += solution[static_cast<Eigen::Index>(first_ + i)];
        }
    }

  private:
    std::vector<double> times_;
    std::vector<double> values_;
    std::size_t first_ = 0;
    std::size_t stride_ = 1;
};

// GNSS positions of one kind of fix, one after the other.
struct GnssSegment {
    std::size_t fix_class = 0;
    double sigma_m = 0.0;  // of the lasting error
    double sigma_up_m = 0.0;
    Chain error;  // e, n, u
};

struct GnssEpoch {
    std::size_t epoch = 0;
    std::size_t fix_class = 0;
    std::size_t segment = 0;
    Eigen::Vector3d enu_m;
    double white_m = 0.0;
    double white_up_m = 0.0;
};

// A number that a run has once.
struct Scalar {
    std::size_t unknown = 0;
    double value = 0.0;
};

class RunModel {
  public:
    const RunStart* start = nullptr;
    const ArrayLog* log = nullptr;
    std::vector<Eigen::Vector3d> track_m;  // as corrected so far
    std::vector<double> yaw_rad;           // as measured, unwrapped nowhere
    Chain correction;                      // e, n, u of the track
    Chain level;  // of the ground along the track, as far as it is even; knots as in `correction`
    Chain psi;    // compass error that wanders
    Chain turn;   // error of the turn summed up from the gyro
    std::vector<double> base_yaw_rad;     // what `turn` corrects: summed gyro, continuous
    std::vector<double> base_doubt_rad2;  // variance of the turn before this epoch where the gyro was silent
    Chain drift, gust;                    // barometer
    Chain force_bias;                     // accelerometer, body axes
    std::optional<LevelAcceleration> acceleration;
    std::vector<GnssSegment> segments;
    std::vector<GnssEpoch> gnss;
    Scalar iron_sin, iron_cos, scale, axes, gyro_bias;
    bool has_flow = false, has_heading = false, has_gyro = false, has_barometer = false;
    // Optical flow of each epoch, forward and left; where there was none, the mean of those around it.
    std::vector<Eigen::Vector2d> flow_mps;
    std::vector<double> bridge_sigma_mps;  // zero where the flow was measured
    std::vector<bool> level_known;         // whether a range was measured about the knot
    std::vector<double>
        plan_variance_m2;                // of each knot, per axis, as of the last solution without crossovers
    std::vector<double> above_ground_m;  // height of the array above the ground below it, spikes left out
    std::vector<Chain::Place> at;        // of each epoch in `correction`
    std::vector<Chain::Place> psi_at;
    std::vector<Chain::Place> turn_at;

    double time(std::size_t i) const { return log->time_s[i]; }
    std::size_t size() const { return log->size(); }
};

class JointAdjuster {
  public:
    JointAdjuster(const Survey& survey, std::span<const RunStart> starts, const FusionOptions& options,
                  Progress& progress, std::stop_token stop)
        : survey_(survey),
          frame_(survey.frame()),
          options_(options),
          progress_(progress),
          stop_(std::move(stop)) {
        for (const RunStart& start : starts) runs_.push_back(prepare(start));
        iron_sin_.unknown = take();
        iron_cos_.unknown = take();
        for (RunModel& run : runs_) number(run);
    }

    Result<JointSolution> adjust() {
        JointSolution result;
        result.summary.unknowns = unknowns_;
        std::vector<RowGroup> groups = rowGroups(true);
        std::optional<SparseLeastSquares> before;
        const int least = options_.joint.rounds;
        int rounds = 0;  // since the track settled
        for (int round = 0;; ++round) {
            if (stop_.stop_requested()) return cancelled();
            progress_.report(std::min(1.0, (settled_ ? 2.0 + rounds : std::min(round, 1)) / (2.0 + least)),
                             "adjusting all runs");
            const bool robust = round > 0;
            const bool with_pairs = options_.joint.use_crossovers && settled_;
            if (options_.joint.use_crossovers && (round == 0 || with_pairs)) findPairs();
            if (round == 0) {
                result.summary.misfit_before_m = misfit(pairs_);
                result.summary.left_out.before_m = misfit(left_out_);
            }
            SparseLeastSquares system(unknowns_, robust ? groups : rowGroups(false), stop_);
            addRows(system, with_pairs);
            if (stop_.stop_requested()) return cancelled();
            wantCovariances(system);
            // With other crossovers another order of elimination is good.
            if (before && !with_pairs) system.continueFrom(*before);
            const auto solution = system.solve();
            if (stop_.stop_requested()) return cancelled();
            if (!solution) {
                return badData("the adjustment of all runs has no solution", survey_.project_file, 0,
                               "use --method ukf, or leave out the run that has no position");
            }
            const double step_m = takeSolution(*solution);
            // Crossovers are not to be trusted more for what they themselves said of the plan.
            if (!with_pairs) takePlanVariances(system);
            if (settled_) ++rounds;
            const bool last = rounds >= 2 * least || (rounds >= least && step_m < kFinalStep_m);
            if (!settled_ && robust && (step_m < kSettledStep_m || round >= kMostToSettle)) {
                settled_ = true;
                if (options_.joint.use_crossovers) result.summary.crossover_test = testHeights(system);
                height_inflation_ = heightInflation(result.summary.crossover_test);
            }
            // Residuals of a track that is still on its way say nothing of the noise.
            if (settled_) {
                const std::vector<GroupStatistics> statistics = system.statistics(*solution);
                if (last) {
                    result.summary.rounds = rounds;
                    result.summary.last_step_m = step_m;
                    result.summary.settled = step_m < kFinalStep_m;
                    for (std::size_t g = 0; g < groups.size(); ++g) {
                        if (statistics[g].rows == 0) continue;
                        result.summary.noise.push_back({groups[g].name, statistics[g].rows,
                                                        statistics[g].redundancy, groups[g].scale,
                                                        statistics[g].down_weighted});
                    }
                    for (const RunModel& run : runs_) result.trajectories.push_back(trajectory(run, system));
                    break;
                }
                if (options_.joint.adapt_noise) system.adaptScales(statistics);
                groups = system.groups();
            }
            before.emplace(std::move(system));
        }
        result.summary.height_inflation = height_inflation_;
        if (options_.joint.use_crossovers) {
            findPairs();
            result.summary.misfit_after_m = misfit(pairs_);
            result.summary.left_out.after_m = misfit(left_out_);
            result.summary.left_out.n = left_out_.size();
            result.crossovers = pairs_;
            result.summary.crossovers = pairs_.size();
        }
        return result;
    }

  private:
    // Greatest of the runs' RMS corrections in plan, from where noise factors and crossovers are looked at,
    // and where more rounds gain nothing.
    static constexpr double kSettledStep_m = 0.3;
    static constexpr double kFinalStep_m = 0.1;
    static constexpr int kMostToSettle = 8;

    std::size_t take(std::size_t n = 1) {
        const std::size_t first = unknowns_;
        unknowns_ += n;
        return first;
    }

    // ---- what a run offers

    RunModel prepare(const RunStart& start) const {
        RunModel run;
        run.start = &start;
        run.log = &start.run->log;
        const ArrayLog& log = *run.log;
        for (const TrajectoryEpoch& epoch : start.trajectory.epochs) {
            run.track_m.push_back(epoch.position_enu_m);
        }
        for (const EpochAttitude& a : start.attitudes) run.yaw_rad.push_back(a.attitude.yaw_rad);
        prepareGnss(run);
        run.has_barometer = options_.barometer.use && start.reference.barometer_zero_m.has_value();
        for (std::size_t i = 0; i < log.size(); ++i) {
            run.correction.cover(log.time_s[i], options_.joint.knot_s);
            if (start.attitudes[i].heading_known) {
                run.psi.cover(log.time_s[i], options_.joint.heading_knot_s);
                run.has_heading = true;
            }
            const auto rejection = flowRejection(log, i, start.attitudes[i], options_.flow);
            if (options_.flow.use && rejection && rejection->empty()) run.has_flow = true;
            if (run.has_barometer && barometerRejection(log, i) == "") {
                run.drift.cover(log.time_s[i], options_.joint.barometer_knot_s);
                run.gust.cover(log.time_s[i], options_.joint.knot_s);
            }
        }
        if (run.has_heading) prepareTurn(run);
        prepareAcceleration(run);
        run.above_ground_m = withoutSpikes(run);
        prepareFlow(run);
        return run;
    }

    void prepareAcceleration(RunModel& run) const {
        const JointOptions& o = options_.joint;
        const bool fine = o.knot_s < kStrideAverage_s;  // the average would reach beyond the next knot
        if (!options_.accelerometer.use || o.acceleration_noise_mps2 <= 0.0 || fine) return;
        run.acceleration = levelAcceleration(*run.log, run.start->attitudes);
        if (!run.acceleration) return;
        for (const double t : run.log->time_s) run.force_bias.cover(t, o.acceleration_knot_s);
    }

    // Sums the gyro up to a heading; over its gaps the compass tells the turn.
    void prepareTurn(RunModel& run) const {
        const ArrayLog& log = *run.log;
        const std::size_t n = run.size();
        std::vector<double> rate(n, kMissing);
        std::size_t known = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const Attitude& a = run.start->attitudes[i].attitude;
            rate[i] = (std::sin(a.roll_rad) * log.value(Channel::AngularRateY, i) +
                       std::cos(a.roll_rad) * log.value(Channel::AngularRateZ, i)) /
                      std::cos(a.pitch_rad);
            if (present(rate[i])) ++known;
        }
        if (2 * known < n) return;
        run.has_gyro = true;
        run.base_yaw_rad.assign(n, 0.0);
        run.base_doubt_rad2.assign(n, 0.0);
        run.base_yaw_rad[0] = run.yaw_rad[0];
        constexpr double kUnknownRate_radps = radians(20.0);  // change of rate from one record to the next
        const double longest_s = 1.5 * usualStep_s(log);
        const double compass_step = 2.0 * squared(compassNoise_rad());
        for (std::size_t i = 1; i < n; ++i) {
            const double dt = log.time_s[i] - log.time_s[i - 1];
            const bool summed = present(rate[i]) && present(rate[i - 1]) && dt <= longest_s;
            const bool compass =
                present(log.value(Channel::Heading, i)) && present(log.value(Channel::Heading, i - 1));
            // A stride turns the hand by degrees between two records: over a gap the compass tells more.
            double turned = 0.0;
            if (summed) {
                turned = 0.5 * dt * (rate[i] + rate[i - 1]);
            } else if (compass) {
                turned = wrapAngle(run.yaw_rad[i] - run.yaw_rad[i - 1]);
                run.base_doubt_rad2[i] = compass_step;
            } else {
                const double known_rate = present(rate[i]) ? rate[i] : rate[i - 1];
                turned = present(known_rate) ? dt * known_rate : 0.0;
                run.base_doubt_rad2[i] = squared(dt * kUnknownRate_radps);
            }
            run.base_yaw_rad[i] = run.base_yaw_rad[i - 1] + turned;
        }
        run.has_gyro = followCompass(run);
        if (!run.has_gyro) return;
        for (std::size_t i = 0; i < n; ++i) run.turn.cover(log.time_s[i], options_.joint.heading_knot_s);
    }

    // White noise of the compass, a sixth of what it may be off at any time (paper 000, table 1: 0.5
    // degrees).
    double compassNoise_rad() const { return radians(options_.attitude.sigma_heading_deg) / 6.0; }

    // Takes the gyro's mean bias and the start of its sum from the compass, so that the adjustment begins
    // near the truth. False when the two do not go together.
    static bool followCompass(RunModel& run) {
        constexpr double kFarthest_rad = radians(25.0);
        const std::size_t n = run.size();
        double unwrapped = run.yaw_rad[0];
        std::vector<double> apart(n);
        double mean_t = 0.0;
        double mean_d = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            if (i > 0) unwrapped += wrapAngle(run.yaw_rad[i] - run.yaw_rad[i - 1]);
            apart[i] = run.base_yaw_rad[i] - unwrapped;
            mean_t += run.time(i) / static_cast<double>(n);
            mean_d += apart[i] / static_cast<double>(n);
        }
        double tt = 0.0;
        double td = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            tt += squared(run.time(i) - mean_t);
            td += (run.time(i) - mean_t) * (apart[i] - mean_d);
        }
        const double bias = tt > 0.0 ? td / tt : 0.0;
        double squares = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            const double removed = mean_d + bias * (run.time(i) - mean_t);
            run.base_yaw_rad[i] -= removed;
            squares += squared(apart[i] - removed);
        }
        return std::sqrt(squares / static_cast<double>(n)) < kFarthest_rad;
    }

    // Where the flow is silent, a walk goes on as it did before and will after: the mean of the flow on
    // either side of the gap, linear between, less sure the farther away they are.
    void prepareFlow(RunModel& run) const {
        const ArrayLog& log = *run.log;
        const std::size_t n = run.size();
        run.flow_mps.assign(n, Eigen::Vector2d::Constant(kMissing));
        run.bridge_sigma_mps.assign(n, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            if (options_.flow.use && flowRejection(log, i, run.start->attitudes[i], options_.flow) == "") {
                run.flow_mps[i] = {log.value(Channel::FlowForward, i), log.value(Channel::FlowLeft, i)};
            }
        }
        if (!options_.flow.bridge_dropouts) return;
        std::vector<bool> measured(n);
        for (std::size_t i = 0; i < n; ++i) measured[i] = run.flow_mps[i].allFinite();
        for (std::size_t i = 0; i < n;) {
            if (measured[i]) {
                ++i;
                continue;
            }
            std::size_t end = i;
            while (end < n && !measured[end]) ++end;
            bridge(run, measured, i, end);
            i = end;
        }
    }

    // Epochs [from, to) have no flow.
    void bridge(RunModel& run, const std::vector<bool>& measured, std::size_t from, std::size_t to) const {
        constexpr double kMean_s = 3.0;
        const auto meanBefore = [&](std::size_t i, bool backwards) -> std::optional<Eigen::Vector2d> {
            Eigen::Vector2d sum = Eigen::Vector2d::Zero();
            double count = 0.0;
            const double edge_s = run.time(i);
            for (std::size_t j = i; j < run.size() && std::abs(run.time(j) - edge_s) <= kMean_s;
                 j += backwards ? static_cast<std::size_t>(-1) : 1) {
                if (!measured[j]) continue;
                sum += run.flow_mps[j];
                count += 1.0;
            }
            if (count == 0.0) return std::nullopt;
            return sum / count;
        };
        const auto before = from > 0 ? meanBefore(from - 1, true) : std::nullopt;
        const auto after = to < run.size() ? meanBefore(to, false) : std::nullopt;
        if (!before && !after) return;
        const double begin_s = run.time(from > 0 ? from - 1 : from);
        const double end_s = run.time(to < run.size() ? to : to - 1);
        const double length_s = std::max(end_s - begin_s, 1e-3);
        const FlowOptions& o = options_.flow;
        for (std::size_t i = from; i < to; ++i) {
            if (!run.start->attitudes[i].heading_known) continue;
            const double share = (run.time(i) - begin_s) / length_s;
            const Eigen::Vector2d left = before.value_or(after.value_or(Eigen::Vector2d::Zero()));
            const Eigen::Vector2d right = after.value_or(left);
            run.flow_mps[i] = left + share * (right - left);
            const double away_s = std::min(before ? run.time(i) - begin_s : end_s - run.time(i),
                                           after ? end_s - run.time(i) : run.time(i) - begin_s);
            // Errors of a gap go together: seconds of it do not average out.
            const double together = std::max(1.0, std::min(length_s, o.bridge_memory_s));
            run.bridge_sigma_mps[i] =
                o.bridge_sigma_mps *
                std::sqrt(together * (0.04 - std::expm1(-2.0 * away_s / o.bridge_memory_s)));
        }
    }

    void prepareGnss(RunModel& run) const {
        const RunStart& start = *run.start;
        const ArrayLog& log = *run.log;
        if (!options_.gnss.use_position) return;
        for (std::size_t i = 0; i < log.size(); ++i) {
            const auto position = gnssPosition(log, i, frame_, start.attitudes[i], run.track_m[i].z());
            if (!position) continue;
            const GnssQuality quality = gnssQuality(log, i, options_.gnss);
            if (!quality.rejection.empty()) continue;
            if (!start.gnss_gated.empty() && start.gnss_gated[i]) continue;
            GnssEpoch epoch;
            epoch.epoch = i;
            epoch.fix_class = gnssFixClass(log, i);
            epoch.enu_m = position->enu_m;
            if (start.reference.gnss_height == GnssHeightUse::Never) epoch.enu_m.z() = kMissing;
            const double share = gnssWhiteShare(log, i, options_.lasting);
            epoch.white_m = std::sqrt(squared(share * quality.sigma_m) + position->arm_variance_m2);
            epoch.white_up_m = std::sqrt(squared(share * quality.sigma_up_m) + position->arm_variance_up_m2);
            run.gnss.push_back(epoch);
        }
        partGnss(run);
    }

    // The lasting error starts anew where the kind of fix changes. A stretch that stands off has one of its
    // own, as large as the jump; the one around it goes on after it.
    void partGnss(RunModel& run) const {
        const auto jump = [&](const GnssEpoch& gnss) {
            return run.start->gnss_jump_m.empty() ? 0.0 : run.start->gnss_jump_m[gnss.epoch];
        };
        std::optional<std::size_t> sound, doubted;
        for (std::size_t i = 0; i < run.gnss.size(); ++i) {
            GnssEpoch& gnss = run.gnss[i];
            const bool other_fix = i > 0 && run.gnss[i - 1].fix_class != gnss.fix_class;
            if (other_fix) sound.reset();
            if (other_fix || (i > 0 && jump(gnss) != jump(run.gnss[i - 1]))) doubted.reset();
            std::optional<std::size_t>& current = jump(gnss) > 0.0 ? doubted : sound;
            if (!current) {
                current = run.segments.size();
                run.segments.push_back({gnss.fix_class,
                                        std::max(lastingSigma(gnss.fix_class, false), jump(gnss)),
                                        std::max(lastingSigma(gnss.fix_class, true), jump(gnss)),
                                        {}});
            }
            gnss.segment = *current;
            run.segments[*current].error.cover(run.time(gnss.epoch), options_.joint.gnss_knot_s);
        }
    }

    // What the white noise leaves of the sigma of a fix.
    double lastingSigma(std::size_t fix_class, bool up) const {
        const double white =
            fix_class == 2 ? options_.lasting.gnss_white_share_fixed : options_.lasting.gnss_white_share;
        return tableSigma(fix_class, up) * std::sqrt(std::max(0.1, 1.0 - squared(white)));
    }

    double tableSigma(std::size_t fix_class, bool up) const {
        const GnssOptions& g = options_.gnss;
        if (fix_class == 2) return up ? g.sigma_fixed_up_m : g.sigma_fixed_m;
        if (fix_class == 1) return up ? g.sigma_float_up_m : g.sigma_float_m;
        return up ? g.sigma_single_up_m : g.sigma_single_m;
    }

    // A hand or a leaf in front of the finder stands off from the median of the readings around it.
    std::vector<double> withoutSpikes(const RunModel& run) const {
        constexpr std::size_t kSide = 3;
        constexpr double kTolerance_m = 0.25;
        const ArrayLog& log = *run.log;
        const std::size_t n = log.size();
        std::vector<double> above(n);
        for (std::size_t i = 0; i < n; ++i) {
            above[i] = heightAboveGround(log, i, run.start->attitudes[i].attitude, options_.ties);
        }
        std::vector<double> kept(n, kMissing);
        std::vector<double> around;
        for (std::size_t i = 0; i < n; ++i) {
            if (!present(above[i])) continue;
            around.clear();
            const std::size_t from = i < kSide ? 0 : i - kSide;
            for (std::size_t j = from; j < std::min(n, i + kSide + 1); ++j) {
                if (present(above[j])) around.push_back(above[j]);
            }
            std::nth_element(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2),
                             around.end());
            if (std::abs(above[i] - around[around.size() / 2]) <= kTolerance_m) kept[i] = above[i];
        }
        return kept;
    }

    void number(RunModel& run) {
        run.correction.place(unknowns_, 3);
        take(3 * run.correction.knots());
        for (std::size_t i = 0; i < run.size(); ++i) run.at.push_back(run.correction.locate(run.time(i)));
        run.level = run.correction;
        run.level.place(unknowns_, 1);
        take(run.level.knots());
        run.level_known.assign(run.level.knots(), false);
        for (GnssSegment& segment : run.segments) {
            segment.error.place(unknowns_, 3);
            take(3 * segment.error.knots());
        }
        if (run.has_barometer) {
            run.drift.place(unknowns_, 1);
            take(run.drift.knots());
            run.gust.place(unknowns_, 1);
            take(run.gust.knots());
        }
        if (run.acceleration) {
            run.force_bias.place(unknowns_, 3);
            take(3 * run.force_bias.knots());
        }
        if (run.has_heading) {
            run.psi.place(unknowns_, 1);
            take(run.psi.knots());
            for (std::size_t i = 0; i < run.size(); ++i) run.psi_at.push_back(run.psi.locate(run.time(i)));
            if (run.has_gyro) {
                run.turn.place(unknowns_, 1);
                take(run.turn.knots());
                for (std::size_t i = 0; i < run.size(); ++i)
                    run.turn_at.push_back(run.turn.locate(run.time(i)));
            }
            for (Scalar* s : {&run.iron_sin, &run.iron_cos, &run.scale, &run.axes, &run.gyro_bias}) {
                s->unknown = take();
            }
        }
    }

    // ---- rows

    void addRows(SparseLeastSquares& system, bool with_pairs) {
        const double iron = radians(options_.lasting.hard_iron_sigma_deg);
        system.addRow(kPrior, {{iron_sin_.unknown, 1.0}}, -iron_sin_.value, iron);
        system.addRow(kPrior, {{iron_cos_.unknown, 1.0}}, -iron_cos_.value, iron);
        for (RunModel& run : runs_) {
            addStart(run, system);
            addTies(run, system);
            addGnss(run, system);
            addDoppler(run, system);
            addBarometer(run, system);
            addFlow(run, system);
            addHeading(run, system);
            addWalk(run, system);
            addClimb(run, system);
            addAcceleration(run, system);
        }
        if (with_pairs) addPairs(system);
    }

    void position(const RunModel& run, std::size_t epoch, std::size_t axis, double factor) {
        run.correction.addTo(row_, run.at[epoch], factor, axis);
    }

    // Weak where ties or GNSS tell more: it only keeps the system regular.
    void addStart(const RunModel& run, SparseLeastSquares& system) {
        const RunReference& reference = run.start->reference;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis);
            const double sigma = std::max(reference.start_sigma_m[a], 0.01);
            system.addRow(kPrior, {{run.correction.unknown(0, axis), 1.0}},
                          reference.start_enu_m[a] - run.track_m[0][a], sigma);
        }
    }

    void addTies(const RunModel& run, SparseLeastSquares& system) {
        for (const MarkTie& tie : run.start->reference.ties) {
            for (std::size_t axis = 0; axis < (tie.has_height ? 3U : 2U); ++axis) {
                const auto a = static_cast<Eigen::Index>(axis);
                row_.clear();
                position(run, tie.epoch, axis, 1.0);
                system.addRow(axis == 2 ? kTieV : kTieH, row_.all(),
                              tie.array_enu_m[a] - run.track_m[tie.epoch][a], std::sqrt(tie.variance_m2[a]));
            }
        }
    }

    void addGnss(const RunModel& run, SparseLeastSquares& system) {
        for (const GnssEpoch& gnss : run.gnss) {
            const GnssSegment& segment = run.segments[gnss.segment];
            const Chain::Place place = segment.error.locate(run.time(gnss.epoch));
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto a = static_cast<Eigen::Index>(axis);
                if (!present(gnss.enu_m[a])) continue;
                row_.clear();
                position(run, gnss.epoch, axis, 1.0);
                segment.error.addTo(row_, place, 1.0, axis);
                system.addRow((axis == 2 ? kGnssV : kGnssH) + segment.fix_class, row_.all(),
                              gnss.enu_m[a] - run.track_m[gnss.epoch][a] - segment.error.value(place, axis),
                              axis == 2 ? gnss.white_up_m : gnss.white_m);
            }
        }
        for (const GnssSegment& segment : run.segments) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                addGaussMarkov(segment.error, axis, axis == 2 ? segment.sigma_up_m : segment.sigma_m,
                               options_.lasting.gnss_correlation_s,
                               (axis == 2 ? kGnssWalkV : kGnssWalkH) + segment.fix_class, system);
            }
        }
    }

    // A stationary first-order Gauss-Markov process; the first knot carries its variance.
    void addGaussMarkov(const Chain& chain, std::size_t part, double sigma, double correlation_s,
                        std::size_t group, SparseLeastSquares& system) {
        system.addRow(kPrior, {{chain.unknown(0, part), 1.0}}, -chain.knotValue(0, part), sigma);
        for (std::size_t k = 1; k < chain.knots(); ++k) {
            const double keep = std::exp(-(chain.time(k) - chain.time(k - 1)) / correlation_s);
            system.addRow(group, {{chain.unknown(k, part), 1.0}, {chain.unknown(k - 1, part), -keep}},
                          keep * chain.knotValue(k - 1, part) - chain.knotValue(k, part),
                          sigma * std::sqrt(1.0 - keep * keep));
        }
    }

    // Track between two times, linear between epochs.
    Eigen::Vector3d trackAt(const RunModel& run, double time_s) const {
        const std::vector<double>& times = run.log->time_s;
        if (time_s <= times.front()) return run.track_m.front();
        if (time_s >= times.back()) return run.track_m.back();
        const auto next =
            static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time_s) - times.begin());
        const double f = (time_s - times[next - 1]) / (times[next] - times[next - 1]);
        return run.track_m[next - 1] + f * (run.track_m[next] - run.track_m[next - 1]);
    }

    // Calls f(epoch, from_s, to_s) for the share that each epoch has in each knot interval: an epoch stands
    // for the time to halfway to its neighbours, but no longer than a usual step.
    template <class Usable, class Take, class Done>
    void overIntervals(const RunModel& run, Usable usable, Take take_part, Done done) const {
        const std::vector<double>& times = run.log->time_s;
        std::size_t i = 0;
        for (std::size_t k = 0; k + 1 < run.correction.knots(); ++k) {
            const double from_s = run.correction.time(k);
            const double to_s = run.correction.time(k + 1);
            while (i > 0 && cellEnd(times, i - 1) > from_s) --i;
            for (; i < times.size() && cellBegin(times, i) < to_s; ++i) {
                const double begin_s = std::max(cellBegin(times, i), from_s);
                const double end_s = std::min(cellEnd(times, i), to_s);
                if (end_s > begin_s && usable(i)) take_part(i, begin_s, end_s);
            }
            done(k, to_s - from_s);
        }
    }
    static constexpr double kLongestCell_s = 0.3;  // half of it, on either side
    static double cellBegin(const std::vector<double>& times, std::size_t i) {
        if (i == 0) return times[0];
        return times[i] - std::min(0.5 * (times[i] - times[i - 1]), kLongestCell_s);
    }
    static double cellEnd(const std::vector<double>& times, std::size_t i) {
        if (i + 1 == times.size()) return times[i];
        return times[i] + std::min(0.5 * (times[i + 1] - times[i]), kLongestCell_s);
    }

    void addDoppler(const RunModel& run, SparseLeastSquares& system) {
        if (!options_.gnss.use_velocity || !run.log->has(Channel::GnssVelocityEast)) return;
        static constexpr std::array<Channel, 3> kAxes{Channel::GnssVelocityEast, Channel::GnssVelocityNorth,
                                                      Channel::GnssVelocityUp};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis);
            const double sigma =
                axis == 2 ? options_.gnss.velocity_sigma_up_mps : options_.gnss.velocity_sigma_mps;
            double residual = 0.0;
            double covered_s = 0.0;
            double variance = 0.0;
            overIntervals(
                run,
                [&](std::size_t i) {
                    return present(run.log->value(kAxes[axis], i)) && dopplerRejection(*run.log, i) == "";
                },
                [&](std::size_t i, double from_s, double to_s) {
                    const double dt = to_s - from_s;
                    residual +=
                        dt * run.log->value(kAxes[axis], i) - (trackAt(run, to_s) - trackAt(run, from_s))[a];
                    covered_s += dt;
                    // Errors that last for `velocity_correlation_s`.
                    variance +=
                        squared(dt * sigma) *
                        std::max(1.0, 2.0 * options_.gnss.velocity_correlation_s / std::max(dt, 0.02) / 5.0);
                },
                [&](std::size_t k, double dt) {
                    if (covered_s > 0.0) {
                        const double share = covered_s / dt;
                        system.addRow(kDoppler,
                                      {{run.correction.unknown(k + 1, axis), share},
                                       {run.correction.unknown(k, axis), -share}},
                                      residual, std::max(std::sqrt(variance), 0.01));
                    }
                    residual = covered_s = variance = 0.0;
                });
        }
    }

    void addBarometer(const RunModel& run, SparseLeastSquares& system) {
        if (!run.has_barometer) return;
        const BarometerOptions& o = options_.barometer;
        for (std::size_t i = 0; i < run.size(); ++i) {
            if (barometerRejection(*run.log, i) != "") continue;
            const double up_m = run.start->reference.barometricUp(run.log->value(Channel::Pressure, i),
                                                                  o.scale, run.track_m[i]);
            const Chain::Place drift = run.drift.locate(run.time(i));
            const Chain::Place gust = run.gust.locate(run.time(i));
            row_.clear();
            position(run, i, 2, 1.0);
            run.drift.addTo(row_, drift, 1.0);
            run.gust.addTo(row_, gust, 1.0);
            system.addRow(kBarometer, row_.all(),
                          up_m - run.track_m[i].z() - run.drift.value(drift) - run.gust.value(gust),
                          o.sigma_m);
        }
        addGaussMarkov(run.gust, 0, o.gust_sigma_m, o.gust_correlation_s, kGust, system);
        const double zero_sigma_m =
            heightIsTold(run) ? kLooseZero_m : std::sqrt(run.start->reference.height_reference_variance_m2);
        system.addRow(kPrior, {{run.drift.unknown(0), 1.0}}, -run.drift.knotValue(0),
                      std::max(zero_sigma_m, 0.01));
        for (std::size_t k = 1; k < run.drift.knots(); ++k) {
            const double dt = run.drift.time(k) - run.drift.time(k - 1);
            system.addRow(kBarometerDrift, {{run.drift.unknown(k), 1.0}, {run.drift.unknown(k - 1), -1.0}},
                          run.drift.knotValue(k - 1) - run.drift.knotValue(k),
                          o.drift_m_per_sqrt_min * std::sqrt(dt / 60.0));
        }
    }

    static constexpr double kLooseZero_m = 10.0;

    // Whether anything but the zero of the barometer tells the height of a run.
    static bool heightIsTold(const RunModel& run) {
        for (const MarkTie& tie : run.start->reference.ties) {
            if (tie.has_height) return true;
        }
        return std::any_of(run.gnss.begin(), run.gnss.end(),
                           [](const GnssEpoch& g) { return present(g.enu_m.z()); });
    }

    double trueYaw(const RunModel& run, std::size_t i) const {
        if (!run.has_heading) return run.yaw_rad[i];
        if (run.has_gyro) return run.base_yaw_rad[i] - run.turn.value(run.turn_at[i]);
        const double yaw = run.yaw_rad[i];
        return yaw - run.psi.value(run.psi_at[i]) - (iron_sin_.value + run.iron_sin.value) * std::sin(yaw) -
               (iron_cos_.value + run.iron_cos.value) * std::cos(yaw);
    }

    void addFlow(const RunModel& run, SparseLeastSquares& system) {
        if (!run.has_heading) return;
        const LastingErrorOptions& lasting = options_.lasting;
        const double iron = radians(lasting.hard_iron_run_sigma_deg);
        system.addRow(kPrior, {{run.iron_sin.unknown, 1.0}}, -run.iron_sin.value, iron);
        system.addRow(kPrior, {{run.iron_cos.unknown, 1.0}}, -run.iron_cos.value, iron);
        system.addRow(kPrior, {{run.scale.unknown, 1.0}}, -run.scale.value, lasting.flow_scale_sigma);
        system.addRow(kPrior, {{run.axes.unknown, 1.0}}, -run.axes.value, lasting.flow_axes_sigma);
        if (!run.has_flow) return;
        const FlowOptions& o = options_.flow;
        Eigen::Vector2d residual = Eigen::Vector2d::Zero();
        Eigen::Vector2d by_sin = residual, by_cos = residual, by_scale = residual, by_axes = residual;
        std::array<Eigen::Vector2d, 3> by_knot{residual, residual, residual};
        const Chain& turning = run.has_gyro ? run.turn : run.psi;
        std::size_t first_knot = 0;
        double covered_s = 0.0;
        double bridged_s = 0.0;
        double bridged_m = 0.0;
        double variance = 0.0;
        const double forward_scale = 1.0 + run.scale.value + run.axes.value;
        const double left_scale = 1.0 + run.scale.value - run.axes.value;
        overIntervals(
            run, [&](std::size_t i) { return run.flow_mps[i].allFinite(); },
            [&](std::size_t i, double from_s, double to_s) {
                const double dt = to_s - from_s;
                const double yaw = trueYaw(run, i);
                const double c = std::cos(yaw);
                const double s = std::sin(yaw);
                const double f = run.flow_mps[i].x() / forward_scale;
                const double l = run.flow_mps[i].y() / left_scale;
                const Eigen::Vector2d v(c * f - s * l, s * f + c * l);
                // What errors do is reckoned from the way of the track, once that is near: the noise of a
                // reading in its own coefficients would make the flow's scale come out too large.
                const Eigen::Vector2d tracked = (trackAt(run, to_s) - trackAt(run, from_s)).head<2>();
                residual += dt * v - tracked;
                const Eigen::Vector2d way = settled_ ? tracked : dt * v;
                const Eigen::Vector2d turned(way.y(), -way.x());  // d way / d psi
                const Chain::Place place = run.has_gyro ? run.turn_at[i] : run.psi_at[i];
                if (covered_s == 0.0) first_knot = place.knot;
                const std::size_t k = std::min<std::size_t>(place.knot - first_knot, 1);
                by_knot[k] += (1.0 - place.fraction) * turned;
                by_knot[k + 1] += place.fraction * turned;
                by_sin += std::sin(run.yaw_rad[i]) * turned;
                by_cos += std::cos(run.yaw_rad[i]) * turned;
                const Eigen::Vector2d ahead(c, s);
                const Eigen::Vector2d forward = ahead.dot(way) * ahead;
                const Eigen::Vector2d left = way - forward;
                by_scale -= forward / forward_scale + left / left_scale;
                by_axes -= forward / forward_scale - left / left_scale;
                covered_s += dt;
                if (run.bridge_sigma_mps[i] > 0.0) {
                    bridged_s += dt;
                    bridged_m += dt * run.bridge_sigma_mps[i];
                    return;
                }
                variance += squared(dt) * flowVariance(o, std::hypot(f, l));
            },
            [&](std::size_t k, double interval_s) {
                if (covered_s > 0.0) {
                    const double share = covered_s / interval_s;
                    const bool bridged = bridged_s > 0.2 * covered_s;
                    variance += squared(bridged_m);
                    for (std::size_t axis = 0; axis < 2; ++axis) {
                        const auto a = static_cast<Eigen::Index>(axis);
                        row_.clear();
                        row_.add(run.correction.unknown(k + 1, axis), share);
                        row_.add(run.correction.unknown(k, axis), -share);
                        for (std::size_t j = 0; j < 3; ++j) {
                            if (by_knot[j][a] != 0.0)
                                row_.add(turning.unknown(first_knot + j), -by_knot[j][a]);
                        }
                        if (!run.has_gyro) {
                            row_.add(run.iron_sin.unknown, -by_sin[a]);
                            row_.add(run.iron_cos.unknown, -by_cos[a]);
                            row_.add(iron_sin_.unknown, -by_sin[a]);
                            row_.add(iron_cos_.unknown, -by_cos[a]);
                        }
                        row_.add(run.scale.unknown, -by_scale[a]);
                        row_.add(run.axes.unknown, -by_axes[a]);
                        system.addRow(bridged ? kBridge : kFlow, row_.all(), residual[a],
                                      std::max(std::sqrt(variance), 0.005));
                    }
                }
                residual.setZero();
                by_sin = by_cos = by_scale = by_axes = residual;
                by_knot = {residual, residual, residual};
                covered_s = bridged_s = bridged_m = variance = 0.0;
            });
    }

    // The compass error wanders; what the gyro saw of the turns tells how.
    void addHeading(const RunModel& run, SparseLeastSquares& system) {
        if (!run.has_heading) return;
        const LastingErrorOptions& lasting = options_.lasting;
        addGaussMarkov(run.psi, 0, radians(lasting.heading_sigma_deg), lasting.heading_correlation_s,
                       kCompass, system);
        system.addRow(kPrior, {{run.gyro_bias.unknown, 1.0}}, -run.gyro_bias.value,
                      radians(lasting.gyro_bias_sigma_dps));
        if (run.has_gyro) addGyro(run, system);
    }

    void addGyro(const RunModel& run, SparseLeastSquares& system) {
        const double walk = radians(options_.lasting.gyro_walk_deg_per_sqrt_s);
        std::vector<double> doubt_rad2(run.turn.knots(), 0.0);
        for (std::size_t i = 0; i < run.size(); ++i) {
            doubt_rad2[std::min(run.turn_at[i].knot + 1, run.turn.knots() - 1)] += run.base_doubt_rad2[i];
        }
        system.addRow(kPrior, {{run.turn.unknown(0), 1.0}}, -run.turn.knotValue(0), 1.0);
        for (std::size_t k = 1; k < run.turn.knots(); ++k) {
            const double dt = run.turn.time(k) - run.turn.time(k - 1);
            system.addRow(
                kGyro,
                {{run.turn.unknown(k), 1.0}, {run.turn.unknown(k - 1), -1.0}, {run.gyro_bias.unknown, -dt}},
                run.turn.knotValue(k - 1) - run.turn.knotValue(k) + run.gyro_bias.value * dt,
                std::sqrt(squared(walk) * dt + doubt_rad2[k]));
        }
        addCompass(run, system);
    }

    // Compass against summed gyro, one row for the mean over each knot interval.
    void addCompass(const RunModel& run, SparseLeastSquares& system) {
        constexpr double kSteady_rad = radians(0.15);  // of the mean: what does not average out
        const double white = compassNoise_rad();
        std::array<double, 2> turn{}, psi{};
        double n = 0.0, sine = 0.0, cosine = 0.0, residual = 0.0;
        std::size_t psi_first = 0;
        for (std::size_t i = 0; i <= run.size(); ++i) {
            const std::size_t interval = i == run.size() ? run.turn.knots() : run.turn_at[i].knot;
            if (n > 0.0 && interval != turn_interval_) {
                row_.clear();
                for (std::size_t j = 0; j < 2; ++j) {
                    if (turn[j] != 0.0) row_.add(run.turn.unknown(turn_interval_ + j), -turn[j] / n);
                    if (psi[j] != 0.0) row_.add(run.psi.unknown(psi_first + j), psi[j] / n);
                }
                row_.add(run.iron_sin.unknown, sine / n);
                row_.add(iron_sin_.unknown, sine / n);
                row_.add(run.iron_cos.unknown, cosine / n);
                row_.add(iron_cos_.unknown, cosine / n);
                system.addRow(kHeading, row_.all(), residual / n,
                              std::hypot(white / std::sqrt(n), kSteady_rad));
                turn = psi = {};
                n = sine = cosine = residual = 0.0;
            }
            if (i == run.size()) break;
            turn_interval_ = interval;
            if (!present(run.log->value(Channel::Heading, i))) continue;
            if (n == 0.0) psi_first = run.psi_at[i].knot;
            const double yaw = run.yaw_rad[i];
            turn[0] += 1.0 - run.turn_at[i].fraction;
            turn[1] += run.turn_at[i].fraction;
            psi[0] += 1.0 - run.psi_at[i].fraction;
            psi[1] += run.psi_at[i].fraction;
            sine += std::sin(yaw);
            cosine += std::cos(yaw);
            residual += wrapAngle(yaw - trueYaw(run, i) - run.psi.value(run.psi_at[i]) -
                                  (iron_sin_.value + run.iron_sin.value) * std::sin(yaw) -
                                  (iron_cos_.value + run.iron_cos.value) * std::cos(yaw));
            n += 1.0;
        }
    }

    // Nobody turns on the spot of a second: the horizontal velocity is a random walk.
    void addWalk(const RunModel& run, SparseLeastSquares& system) {
        for (std::size_t k = 1; k + 1 < run.correction.knots(); ++k) {
            const double dt0 = run.correction.time(k) - run.correction.time(k - 1);
            const double dt1 = run.correction.time(k + 1) - run.correction.time(k);
            const Eigen::Vector3d before = trackAt(run, run.correction.time(k - 1));
            const Eigen::Vector3d here = trackAt(run, run.correction.time(k));
            const Eigen::Vector3d after = trackAt(run, run.correction.time(k + 1));
            const Eigen::Vector3d change = (after - here) / dt1 - (here - before) / dt0;
            const double sigma = options_.joint.walk_mps_per_sqrt_s * std::sqrt((dt0 + dt1) / 3.0);
            for (std::size_t axis = 0; axis < 2; ++axis) {
                system.addRow(kWalk,
                              {{run.correction.unknown(k + 1, axis), 1.0 / dt1},
                               {run.correction.unknown(k, axis), -1.0 / dt1 - 1.0 / dt0},
                               {run.correction.unknown(k - 1, axis), 1.0 / dt0}},
                              -change[static_cast<Eigen::Index>(axis)], sigma);
            }
        }
    }

    // Height above ground about a knot.
    double aboveGround(const RunModel& run, double time_s) {
        constexpr double kReach_s = 0.81;
        const std::vector<double>& times = run.log->time_s;
        scratch_.clear();
        for (auto it = std::lower_bound(times.begin(), times.end(), time_s - kReach_s);
             it != times.end() && *it <= time_s + kReach_s; ++it) {
            const double above = run.above_ground_m[static_cast<std::size_t>(it - times.begin())];
            if (present(above)) scratch_.push_back(above);
        }
        return heightThroughGrass(scratch_);
    }

    // The ground below the walk lies about a level that wanders little, but for steps such as a terrace edge:
    // a level with noise. Where no range was measured the array itself climbs little.
    void addClimb(RunModel& run, SparseLeastSquares& system) {
        const JointOptions& o = options_.joint;
        for (std::size_t k = 0; k < run.level.knots(); ++k) {
            const double above = aboveGround(run, run.level.time(k));
            const double up = trackAt(run, run.level.time(k)).z();
            if (present(above) && !run.level_known[k]) run.level.setKnotValue(k, up - above);
            run.level_known[k] = present(above);
            if (run.level_known[k]) {
                system.addRow(kRoughness, {{run.correction.unknown(k, 2), 1.0}, {run.level.unknown(k), -1.0}},
                              run.level.knotValue(k) + above - up, o.ground_roughness_m);
            } else {
                system.addRow(kPrior, {{run.level.unknown(k), 1.0}}, 0.0, 1e3);
            }
            if (k == 0) continue;
            const double dt = run.level.time(k) - run.level.time(k - 1);
            const Eigen::Vector3d step =
                trackAt(run, run.level.time(k)) - trackAt(run, run.level.time(k - 1));
            if (run.level_known[k] && run.level_known[k - 1]) {
                const double sigma =
                    std::sqrt(squared(o.ground_climb_m_per_sqrt_m) * step.head<2>().norm() + squared(0.005));
                system.addRow(kClimb, {{run.level.unknown(k), 1.0}, {run.level.unknown(k - 1), -1.0}},
                              run.level.knotValue(k - 1) - run.level.knotValue(k), sigma);
            } else {
                system.addRow(kBlindClimb,
                              {{run.correction.unknown(k, 2), 1.0}, {run.correction.unknown(k - 1, 2), -1.0}},
                              -step.z(), o.blind_climb_m_per_sqrt_s * std::sqrt(dt));
            }
        }
    }

    // Yaw at the even steps of the accelerations, linear between epochs.
    std::vector<double> yawOfSteps(const RunModel& run) const {
        const LevelAcceleration& series = *run.acceleration;
        std::vector<double> yaw(series.size());
        std::size_t i = 0;
        for (std::size_t j = 0; j < series.size(); ++j) {
            while (i + 2 < run.size() && run.time(i + 1) <= series.time(j)) ++i;
            const double f =
                std::clamp((series.time(j) - run.time(i)) / (run.time(i + 1) - run.time(i)), 0.0, 1.0);
            const double here = trueYaw(run, i);
            yaw[j] = here + f * wrapAngle(trueYaw(run, i + 1) - here);
        }
        return yaw;
    }

    // Bends of the track averaged over a stride; what is linear between knots bends at them alone, and the
    // average takes the share `b` of each bend to either side.
    void addAcceleration(const RunModel& run, SparseLeastSquares& system) {
        if (!run.acceleration) return;
        const JointOptions& o = options_.joint;
        std::vector<double> knots(run.correction.knots());
        std::vector<Eigen::Vector3d> track_m(knots.size());
        for (std::size_t k = 0; k < knots.size(); ++k) {
            knots[k] = run.correction.time(k);
            track_m[k] = strideAverage(run.log->time_s, run.track_m, knots[k]);
        }
        const double b = kStrideAverage_s / (6.0 * o.knot_s);
        const std::array<double, 5> kernel{b, 1.0 - 4.0 * b, -2.0 + 6.0 * b, 1.0 - 4.0 * b, b};
        for (const PositionBend& bend : positionBends(*run.acceleration, yawOfSteps(run), knots, o.knot_s)) {
            const std::size_t k = bend.knot;
            const Eigen::Vector3d bent_m = track_m[k - 1] - 2.0 * track_m[k] + track_m[k + 1];
            if (!bent_m.allFinite() || bend.filled_sigma_m > kBlindBend_m) continue;
            const Chain::Place at = run.force_bias.locate(knots[k]);
            Eigen::Vector3d bias_mps2;
            for (std::size_t part = 0; part < 3; ++part) {
                bias_mps2[static_cast<Eigen::Index>(part)] = run.force_bias.value(at, part);
            }
            const Eigen::Vector3d residual_m = bend.bend_m - bend.by_bias_s2 * bias_mps2 - bent_m;
            const double noise_m2 =
                squared(o.acceleration_noise_mps2 * bend.sigma_per_noise_s2) + squared(bend.filled_sigma_m);
            const double turned_m2 = bend.bend_m.head<2>().squaredNorm() * squared(kYawDoubt_rad);
            for (std::size_t axis = run.has_heading ? 0 : 2; axis < 3; ++axis) {
                const auto a = static_cast<Eigen::Index>(axis);
                row_.clear();
                for (std::size_t j = 0; j < kernel.size(); ++j) {
                    // Beyond the ends the correction goes on as it is.
                    const std::size_t knot = std::clamp<std::size_t>(k + j, 2, knots.size() + 1) - 2;
                    row_.add(run.correction.unknown(knot, axis), kernel[j]);
                }
                for (std::size_t part = 0; part < 3; ++part) {
                    run.force_bias.addTo(row_, at, bend.by_bias_s2(a, static_cast<Eigen::Index>(part)), part);
                }
                if (axis < 2) turnedBy(run, knots[k], axis == 0 ? bend.bend_m.y() : -bend.bend_m.x());
                system.addRow(axis == 2 ? kAccelerationV : kAccelerationH, row_.all(), residual_m[a],
                              std::sqrt(noise_m2 + (axis == 2 ? 0.0 : turned_m2)));
            }
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // A tilt that is off lets gravity into the level axes, and the error of the tilt wanders.
            addGaussMarkov(run.force_bias, axis, options_.lasting.acceleration_bias_sigma_mps2,
                           axis == 2 ? options_.lasting.acceleration_bias_correlation_s
                                     : options_.lasting.tilt_correlation_s,
                           kAccelerationBias, system);
        }
    }

    // Adds to the row what errors of the heading at a time do to a reading: `change` for each radian.
    void turnedBy(const RunModel& run, double time_s, double change) {
        if (run.has_gyro) {
            run.turn.addTo(row_, run.turn.locate(time_s), -change);
            return;
        }
        run.psi.addTo(row_, run.psi.locate(time_s), -change);
        const auto& times = run.log->time_s;
        const auto next = std::lower_bound(times.begin(), times.end() - 1, time_s);
        const double yaw = run.yaw_rad[static_cast<std::size_t>(next - times.begin())];
        row_.add(run.iron_sin.unknown, -change * std::sin(yaw));
        row_.add(run.iron_cos.unknown, -change * std::cos(yaw));
        row_.add(iron_sin_.unknown, -change * std::sin(yaw));
        row_.add(iron_cos_.unknown, -change * std::cos(yaw));
    }
    static constexpr double kBlindBend_m = 0.5;            // of a sigma that tells nothing
    static constexpr double kYawDoubt_rad = radians(0.5);  // by which the yaw errs within a bend

    // ---- crossovers

    std::vector<GroundSample> groundSamples() const {
        std::vector<GroundSample> samples;
        for (std::size_t r = 0; r < runs_.size(); ++r) {
            const RunModel& run = runs_[r];
            for (std::size_t i = 0; i < run.size(); ++i) {
                if (!present(run.above_ground_m[i])) continue;
                Attitude attitude = run.start->attitudes[i].attitude;
                attitude.yaw_rad = trueYaw(run, i);
                const Eigen::Vector3d ray =
                    run.log->range_lever_arm_m - run.log->value(Channel::Range, i) * Eigen::Vector3d::UnitZ();
                samples.push_back({static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(i), run.time(i),
                                   run.track_m[i] + rotationEnuFromBody(attitude) * ray});
            }
        }
        return samples;
    }

    void findPairs() {
        const std::vector<GroundSample> samples = groundSamples();
        pairs_ = findCrossovers(samples, options_.joint.crossovers);
        const auto kept = std::stable_partition(pairs_.begin(), pairs_.end(),
                                                [&](const Crossover& c) { return !isLeftOut(c); });
        left_out_.assign(kept, pairs_.end());
        pairs_.erase(kept, pairs_.end());
        mark_passes_.clear();
        for (const ControlMark& mark : survey_.marks) {
            if (mark.role != MarkRole::Control || onlyShowsErrors(mark)) continue;
            for (const MarkPass& pass : findMarkPasses(samples, mark.enu_m, options_.joint.crossovers)) {
                mark_passes_.push_back(pass);
            }
        }
    }

    // The target of a fixed-point run that the options keep from the estimator.
    bool onlyShowsErrors(const ControlMark& mark) const {
        if (options_.stands.tie_fixed_targets) return false;
        return std::any_of(survey_.runs.begin(), survey_.runs.end(), [&](const Run& run) {
            return run.kind == RunKind::FixedPoint && run.target == mark.name;
        });
    }

    // Whole cells of the ground, as neighbouring pairs share their points.
    bool isLeftOut(const Crossover& pair) const {
        constexpr double kCell_m = 10.0;
        const auto cell = [](double metres) {
            return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(metres / kCell_m)));
        };
        const double draw = unitInterval(scramble({cell(pair.place_m.x()), cell(pair.place_m.y())}));
        return draw < options_.joint.left_out_crossovers;
    }

    static double misfit(const std::vector<Crossover>& pairs) {
        double sum = 0.0;
        for (const Crossover& pair : pairs) sum += squared(pair.misfit_m);
        return pairs.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(pairs.size()));
    }

    // Planes fit where the ground is even; where it is not, they fit the worse the farther apart the passes
    // are, or may be.
    double pairSigma(const Eigen::Vector2d& slope, double roughness_m, double apart_m2) const {
        const JointOptions& o = options_.joint;
        const double uneven = slope.norm() / (slope.norm() + o.pair_even_slope);
        const double sigma =
            o.pair_sigma_m + uneven * (o.pair_uneven_m + o.pair_apart_per_m * std::min(apart_m2, 4.0));
        return std::sqrt((squared(sigma) + squared(0.5 * roughness_m) + slope.squaredNorm() * apart_m2) /
                         o.pair_weight);
    }

    double planVariance(std::size_t run, std::size_t epoch) const {
        const RunModel& r = runs_[run];
        return r.plan_variance_m2.empty() ? 1.0 : r.plan_variance_m2[r.at[epoch].knot];
    }

    void ground(const RunModel& run, std::size_t epoch, const Eigen::Vector2d& slope, double sign) {
        position(run, epoch, 2, sign);
        // Half of what a slope tells of the plan: the ground is a plane only near by.
        const double share = options_.joint.pair_plan_share;
        position(run, epoch, 0, -sign * share * slope.x());
        position(run, epoch, 1, -sign * share * slope.y());
    }

    // Of m passes over the same ground only so many differences are independent as there are passes, while
    // pairs grow with their square: where more than kPairsOfAKnot meet, they share their weight.
    static constexpr double kPairsOfAKnot = 3.0;

    std::vector<double> pairCrowding() const {
        std::vector<std::vector<double>> pairs_of_knot;
        for (const RunModel& run : runs_) pairs_of_knot.emplace_back(run.correction.knots(), 0.0);
        const auto count = [&](std::uint32_t run, std::uint32_t epoch) -> double& {
            return pairs_of_knot[run][runs_[run].at[epoch].knot];
        };
        for (const Crossover& pair : pairs_) {
            count(pair.run_a, pair.epoch_a) += 1.0;
            count(pair.run_b, pair.epoch_b) += 1.0;
        }
        std::vector<double> crowding;
        for (const Crossover& pair : pairs_) {
            const double pairs = 0.5 * (count(pair.run_a, pair.epoch_a) + count(pair.run_b, pair.epoch_b));
            crowding.push_back(std::max(1.0, pairs / kPairsOfAKnot));
        }
        return crowding;
    }

    void addPairs(SparseLeastSquares& system) {
        const std::vector<double> crowding = pairCrowding();
        for (std::size_t p = 0; p < pairs_.size(); ++p) {
            const Crossover& pair = pairs_[p];
            row_.clear();
            ground(runs_[pair.run_a], pair.epoch_a, pair.slope, 1.0);
            ground(runs_[pair.run_b], pair.epoch_b, pair.slope, -1.0);
            system.addRow(kPair, row_.all(), -pair.misfit_m,
                          pairSigma(pair.slope, pair.roughness_m,
                                    squared(pair.apart_m) + planVariance(pair.run_a, pair.epoch_a) +
                                        planVariance(pair.run_b, pair.epoch_b)) *
                              std::sqrt(crowding[p]));
        }
        for (const MarkPass& pass : mark_passes_) {
            row_.clear();
            ground(runs_[pass.run], pass.epoch, pass.slope, 1.0);
            // A single pass does not tell the slope across its way.
            const double aside = squared(0.2 * pass.apart_m);
            system.addRow(kMarkPass, row_.all(), -pass.misfit_m,
                          std::hypot(pairSigma(pass.slope, pass.roughness_m,
                                               squared(pass.apart_m) + planVariance(pass.run, pass.epoch)),
                                     std::sqrt(aside)));
        }
    }

    // ---- the answer

    // Returns how far the track moved.
    double takeSolution(const Eigen::VectorXd& solution) {
        const auto add = [&](Scalar& s) {
            s.value += solution[static_cast<Eigen::Index>(s.unknown)];
        };
        add(iron_sin_);
        add(iron_cos_);
        double step_m = 0.0;
        for (RunModel& run : runs_) {
            double squares = 0.0;
            for (std::size_t k = 0; k < run.correction.knots(); ++k) {
                for (std::size_t axis = 0; axis < 2; ++axis) {
                    squares += squared(solution[static_cast<Eigen::Index>(run.correction.unknown(k, axis))]);
                }
            }
            step_m = std::max(step_m, std::sqrt(squares / static_cast<double>(run.correction.knots())));
            for (std::size_t i = 0; i < run.size(); ++i) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const Chain::Place& at = run.at[i];
                    const auto a = static_cast<Eigen::Index>(axis);
                    const double here =
                        solution[static_cast<Eigen::Index>(run.correction.unknown(at.knot, axis))];
                    const double next =
                        at.fraction > 0.0
                            ? solution[static_cast<Eigen::Index>(run.correction.unknown(at.knot + 1, axis))]
                            : here;
                    run.track_m[i][a] += here + at.fraction * (next - here);
                }
            }
            run.level.take(solution);
            for (GnssSegment& segment : run.segments) segment.error.take(solution);
            if (run.has_barometer) {
                run.drift.take(solution);
                run.gust.take(solution);
            }
            if (run.acceleration) run.force_bias.take(solution);
            if (run.has_heading) {
                run.psi.take(solution);
                if (run.has_gyro) run.turn.take(solution);
                for (Scalar* s : {&run.iron_sin, &run.iron_cos, &run.scale, &run.axes, &run.gyro_bias})
                    add(*s);
            }
        }
        return step_m;
    }

    void takePlanVariances(SparseLeastSquares& system) {
        for (RunModel& run : runs_) {
            run.plan_variance_m2.resize(run.correction.knots());
            for (std::size_t k = 0; k < run.correction.knots(); ++k) {
                const std::size_t e = run.correction.unknown(k, 0);
                const std::size_t n = run.correction.unknown(k, 1);
                run.plan_variance_m2[k] = 0.5 * (system.covariance(e, e) + system.covariance(n, n));
            }
        }
    }

    // Before the crossovers are used they test the track: misfits over what its covariance predicts. Passes
    // close in time share their errors, so they do not count.
    SigmaCoverage testHeights(SparseLeastSquares& system) {
        constexpr double kApart_s = 120.0;
        constexpr double kOutlier = 5.0;
        findPairs();
        SigmaCoverage test;
        const auto heightVariance = [&](std::uint32_t run, std::uint32_t epoch) {
            const std::size_t u = runs_[run].correction.unknown(runs_[run].at[epoch].knot, 2);
            return system.covariance(u, u);
        };
        for (const Crossover& pair : pairs_) {
            const double apart_s =
                std::abs(runs_[pair.run_a].time(pair.epoch_a) - runs_[pair.run_b].time(pair.epoch_b));
            if (pair.run_a == pair.run_b && apart_s < kApart_s) continue;
            const double plan =
                planVariance(pair.run_a, pair.epoch_a) + planVariance(pair.run_b, pair.epoch_b);
            const double own =
                squared(pairSigma(pair.slope, pair.roughness_m, squared(pair.apart_m) + plan)) *
                options_.joint.pair_weight;
            const double sigma = std::sqrt(heightVariance(pair.run_a, pair.epoch_a) +
                                           heightVariance(pair.run_b, pair.epoch_b) + own);
            test.add(std::clamp(pair.misfit_m, -kOutlier * sigma, kOutlier * sigma), sigma);
        }
        return test;
    }

    static double heightInflation(const SigmaCoverage& test) {
        constexpr std::size_t kFewest = 30;
        // Crossovers bind a track more than they test it: what they leave is judged with a margin.
        constexpr double kMargin = 2.2;
        return test.n < kFewest ? 1.0 : std::clamp(kMargin * test.mean_square, 0.65, 4.0);
    }

    void wantCovariances(SparseLeastSquares& system) const {
        for (const RunModel& run : runs_) {
            for (std::size_t k = 0; k < run.correction.knots(); ++k) {
                const std::size_t next = std::min(k + 1, run.correction.knots() - 1);
                for (std::size_t a = 0; a < 3; ++a) {
                    for (std::size_t b = 0; b < 3; ++b) {
                        system.wantCovariance(run.correction.unknown(k, a), run.correction.unknown(k, b));
                        system.wantCovariance(run.correction.unknown(k, a), run.correction.unknown(next, b));
                    }
                }
            }
        }
    }

    // Slopes of the ground tell where a track lies, and pairs side by side err alike in it: of what the
    // crossovers take off the variance of the plan, only a part is believed.
    static double planInflation(const RunModel& run, std::size_t knot, double with_crossovers_m2) {
        constexpr double kBelieved = 0.4;
        const double without = std::max(run.plan_variance_m2[knot], with_crossovers_m2);
        return kBelieved + (1.0 - kBelieved) * without / with_crossovers_m2;
    }

    Trajectory trajectory(const RunModel& run, SparseLeastSquares& system) const {
        Trajectory result;
        result.run_id = run.start->run->id;
        result.epochs = run.start->trajectory.epochs;
        for (std::size_t i = 0; i < run.size(); ++i) {
            TrajectoryEpoch& epoch = result.epochs[i];
            epoch.position_enu_m = run.track_m[i];
            const std::size_t before = i == 0 ? 0 : i - 1;
            const std::size_t after = std::min(i + 1, run.size() - 1);
            if (after > before) {
                epoch.velocity_enu_mps =
                    (run.track_m[after] - run.track_m[before]) / (run.time(after) - run.time(before));
            }
            const Chain::Place& at = run.at[i];
            const std::size_t next = std::min(at.knot + 1, run.correction.knots() - 1);
            const double g = 1.0 - at.fraction;
            const double f = at.fraction;
            const double dt = next > at.knot ? run.correction.time(next) - run.correction.time(at.knot) : 1.0;
            Eigen::Matrix3d here, there, cross;
            for (std::size_t a = 0; a < 3; ++a) {
                for (std::size_t b = 0; b < 3; ++b) {
                    const auto ia = static_cast<Eigen::Index>(a);
                    const auto ib = static_cast<Eigen::Index>(b);
                    here(ia, ib) = system.covariance(run.correction.unknown(at.knot, a),
                                                     run.correction.unknown(at.knot, b));
                    there(ia, ib) =
                        system.covariance(run.correction.unknown(next, a), run.correction.unknown(next, b));
                    cross(ia, ib) = system.covariance(run.correction.unknown(at.knot, a),
                                                      run.correction.unknown(next, b));
                }
            }
            Eigen::Matrix3d p = g * g * here + f * f * there + g * f * (cross + cross.transpose());
            // Variances are scaled, correlations stay.
            const double plan = std::sqrt(planInflation(run, at.knot, 0.5 * (here(0, 0) + here(1, 1))));
            const Eigen::Vector3d inflate(plan, plan, std::sqrt(height_inflation_));
            p = inflate.asDiagonal() * p * inflate.asDiagonal();
            epoch.covariance.setZero();
            epoch.covariance.topLeftCorner<3, 3>() = p;
            epoch.covariance.bottomRightCorner<3, 3>() =
                (here + there - cross - cross.transpose()) / squared(dt);
            if (run.has_heading) {
                epoch.attitude.yaw_rad = wrapAngle(trueYaw(run, i));
                const std::size_t unknown = run.has_gyro ? run.turn.unknown(run.turn_at[i].knot)
                                                         : run.psi.unknown(run.psi_at[i].knot);
                epoch.sigma_heading_rad =
                    std::sqrt(system.covariance(unknown, unknown) + squared(radians(0.5)));
            }
        }
        return result;
    }

    const Survey& survey_;
    LocalFrame frame_;
    const FusionOptions& options_;
    Progress& progress_;
    std::stop_token stop_;
    std::vector<RunModel> runs_;
    Scalar iron_sin_, iron_cos_;
    std::size_t unknowns_ = 0;
    double height_inflation_ = 1.0;
    std::vector<Crossover> pairs_;
    std::vector<Crossover> left_out_;  // only tests
    std::vector<MarkPass> mark_passes_;
    RowBuilder row_;
    std::vector<double> scratch_;
    std::size_t turn_interval_ = 0;
    bool settled_ = false;  // the track is near its place
};

}  // namespace

Result<JointSolution> adjustJointly(const Survey& survey, std::span<const RunStart> starts,
                                    const FusionOptions& options, Progress& progress, std::stop_token stop) {
    return JointAdjuster(survey, starts, options, progress, std::move(stop)).adjust();
}

}  // namespace terrawalk
