#include "fusion/run_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fusion/flow_screen.hpp"
#include "fusion/squared.hpp"
#include "survey/upper_median.hpp"

namespace terrawalk {

namespace {

constexpr double kScaleKnot_s = 20.0;
constexpr double kLongest_s = 0.3;  // half of the longest time that an epoch stands for

class Preparer {
  public:
    Preparer(const LocalFrame& frame, const FusionOptions& options) : frame_(frame), options_(options) {}

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
        const FlowRejections flow = flowRejections(log, start.attitudes, options_.flow);
        for (std::size_t i = 0; i < log.size(); ++i) {
            run.correction.cover(log.time_s[i], options_.joint.knot_s);
            if (start.attitudes[i].heading_known) {
                run.psi.cover(log.time_s[i], options_.joint.heading_knot_s);
                run.has_heading = true;
            }
            if (options_.flow.use && flow[i] == "") run.has_flow = true;
            if (run.has_barometer && barometerRejection(log, i) == "") {
                run.drift.cover(log.time_s[i], options_.joint.barometer_knot_s);
                run.gust.cover(log.time_s[i], options_.joint.knot_s);
            }
        }
        markBarometer(run);
        if (run.has_heading) prepareTurn(run);
        if (run.has_flow && run.has_heading) {
            for (const double t : log.time_s) run.scale_wander.cover(t, kScaleKnot_s);
        }
        prepareAcceleration(run);
        run.above_ground_m = withoutSpikes(run);
        prepareFlow(run, flow);
        return run;
    }

  private:
    void markBarometer(RunModel& run) const {
        run.barometer_known.assign(run.correction.knots(), false);
        if (!run.has_barometer) return;
        for (std::size_t i = 0; i < run.size(); ++i) {
            if (barometerRejection(*run.log, i) != "") continue;
            const KnotChain::Place at = run.correction.locate(run.time(i));
            run.barometer_known[at.knot] = true;
            if (at.fraction > 0.0) run.barometer_known[at.knot + 1] = true;
        }
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
        std::size_t first_known = n;
        bool stuck = true;
        for (std::size_t i = 0; i < n; ++i) {
            const Attitude& a = run.start->attitudes[i].attitude;
            rate[i] = (std::sin(a.roll_rad) * log.value(Channel::AngularRateY, i) +
                       std::cos(a.roll_rad) * log.value(Channel::AngularRateZ, i)) /
                      std::cos(a.pitch_rad);
            if (!present(rate[i])) continue;
            if (known++ == 0) first_known = i;
            stuck =
                stuck && log.value(Channel::AngularRateZ, i) == log.value(Channel::AngularRateZ, first_known);
        }
        if (2 * known < n || stuck) return;
        run.has_gyro = true;
        run.base_yaw_rad.assign(n, 0.0);
        run.base_doubt_rad2.assign(n, 0.0);
        run.gyro_turn_rad.assign(n, 0.0);
        run.base_yaw_rad[0] = run.yaw_rad[0];
        constexpr double kUnknownRate_radps = radians(20.0);  // change of rate from one record to the next
        const double longest_s = 1.5 * usualStep_s(log);
        constexpr double kFastTurn_radps = radians(50.0);
        constexpr double kMissedTurn_rad = radians(20.0);
        const double compass_step = 2.0 * squared(compassNoise_rad(options_.attitude));
        for (std::size_t i = 1; i < n; ++i) {
            const double dt = log.time_s[i] - log.time_s[i - 1];
            const bool summed = present(rate[i]) && present(rate[i - 1]) && dt <= longest_s;
            const bool compass =
                present(log.value(Channel::Heading, i)) && present(log.value(Channel::Heading, i - 1));
            // A stride turns the hand by degrees between two records: over a gap the compass tells more.
            const double by_gyro = 0.5 * dt * (rate[i] + rate[i - 1]);
            const double by_compass = wrapAngle(run.yaw_rad[i] - run.yaw_rad[i - 1]);
            // Who turns on the spot can do so between two records, and the rates tell of a part.
            const bool missed = compass &&
                                std::max(std::abs(rate[i]), std::abs(rate[i - 1])) > kFastTurn_radps &&
                                std::abs(wrapAngle(by_compass - by_gyro)) > kMissedTurn_rad;
            double turned = 0.0;
            if (summed && !missed) {
                turned = by_gyro;
                run.gyro_turn_rad[i] = by_gyro;
            } else if (compass) {
                turned = by_compass;
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
    void prepareFlow(RunModel& run, const FlowRejections& rejections) const {
        const ArrayLog& log = *run.log;
        const std::size_t n = run.size();
        run.flow_mps.assign(n, Eigen::Vector2d::Constant(kMissing));
        run.bridge_sigma_mps.assign(n, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            if (options_.flow.use && rejections[i] == "") {
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
            run.has_single = run.has_single || gnss.fix_class == kSingleClass;
            run.segments[*current].error.cover(run.time(gnss.epoch), options_.joint.gnss_knot_s);
        }
    }

    // What the white noise leaves of the sigma of a fix.
    double lastingSigma(GnssFixClass fix_class, bool up) const {
        const double white = fix_class == kFixedClass ? options_.lasting.gnss_white_share_fixed
                                                      : options_.lasting.gnss_white_share;
        return tableSigma(fix_class, up) * std::sqrt(std::max(0.1, 1.0 - squared(white)));
    }

    double tableSigma(GnssFixClass fix_class, bool up) const {
        const GnssOptions& g = options_.gnss;
        if (fix_class == kFixedClass) return up ? g.sigma_fixed_up_m : g.sigma_fixed_m;
        if (fix_class == kFloatClass) return up ? g.sigma_float_up_m : g.sigma_float_m;
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
            if (std::abs(above[i] - upperMedian(around)) <= kTolerance_m) kept[i] = above[i];
        }
        return kept;
    }

    const LocalFrame& frame_;
    const FusionOptions& options_;
};

}  // namespace

RunModel makeRunModel(const RunStart& start, const LocalFrame& frame, const FusionOptions& options) {
    return Preparer(frame, options).prepare(start);
}

namespace {

// Of heading and flow.
std::array<SingleUnknown*, 6> constants(RunModel& run) {
    return {&run.iron.sin, &run.iron.cos, &run.scale, &run.axes, &run.gyro_bias, &run.gyro_scale};
}

}  // namespace

void numberTrack(RunModel& run, std::size_t& next) {
    run.correction.place(next, 3);
    next += run.correction.unknowns();
    for (std::size_t i = 0; i < run.size(); ++i) run.at.push_back(run.correction.locate(run.time(i)));
}

void numberUnknowns(RunModel& run, std::size_t& next) {
    const auto take = [&](std::size_t n) {
        const std::size_t first = next;
        next += n;
        return first;
    };
    numberTrack(run, next);
    run.level = run.correction;
    run.level.place(next, 1);
    take(run.level.knots());
    run.level_known.assign(run.level.knots(), false);
    for (GnssSegment& segment : run.segments) {
        segment.error.place(next, 3);
        take(3 * segment.error.knots());
    }
    if (run.has_single) {
        for (SingleUnknown& bias : run.gnss_bias) bias.unknown = take(1);
    }
    if (run.has_barometer) {
        run.drift.place(next, 1);
        take(run.drift.knots());
        run.gust.place(next, 1);
        take(run.gust.knots());
    }
    if (run.acceleration) {
        run.force_bias.place(next, 3);
        take(3 * run.force_bias.knots());
    }
    if (run.has_heading) {
        run.psi.place(next, 1);
        take(run.psi.knots());
        for (std::size_t i = 0; i < run.size(); ++i) run.psi_at.push_back(run.psi.locate(run.time(i)));
        if (run.has_gyro) {
            run.turn.place(next, 1);
            take(run.turn.knots());
            for (std::size_t i = 0; i < run.size(); ++i) run.turn_at.push_back(run.turn.locate(run.time(i)));
        }
        run.scale_wander.place(next, 1);
        take(run.scale_wander.knots());
        for (SingleUnknown* s : constants(run)) {
            s->unknown = take(1);
        }
    }
}

double moveTrack(RunModel& run, const Eigen::VectorXd& solution) {
    double squares = 0.0;
    for (std::size_t k = 0; k < run.correction.knots(); ++k) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            squares += squared(solution[static_cast<Eigen::Index>(run.correction.unknown(k, axis))]);
        }
    }
    const double step_m = std::sqrt(squares / static_cast<double>(run.correction.knots()));
    for (std::size_t i = 0; i < run.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const KnotChain::Place& at = run.at[i];
            const auto a = static_cast<Eigen::Index>(axis);
            const double here = solution[static_cast<Eigen::Index>(run.correction.unknown(at.knot, axis))];
            const double next =
                at.fraction > 0.0
                    ? solution[static_cast<Eigen::Index>(run.correction.unknown(at.knot + 1, axis))]
                    : here;
            run.track_m[i][a] += here + at.fraction * (next - here);
        }
    }
    return step_m;
}

double takeSolution(RunModel& run, const Eigen::VectorXd& solution) {
    const double step_m = moveTrack(run, solution);
    run.level.take(solution);
    for (GnssSegment& segment : run.segments) segment.error.take(solution);
    if (run.has_single) {
        for (SingleUnknown& bias : run.gnss_bias) {
            bias.value += solution[static_cast<Eigen::Index>(bias.unknown)];
        }
    }
    if (run.has_barometer) {
        run.drift.take(solution);
        run.gust.take(solution);
    }
    if (run.acceleration) run.force_bias.take(solution);
    if (run.has_heading) {
        run.psi.take(solution);
        run.scale_wander.take(solution);
        if (run.has_gyro) run.turn.take(solution);
        for (SingleUnknown* s : constants(run)) {
            s->value += solution[static_cast<Eigen::Index>(s->unknown)];
        }
    }
    return step_m;
}

Eigen::Vector3d trackAt(const RunModel& run, double time_s) {
    const std::vector<double>& times = run.log->time_s;
    if (time_s <= times.front()) return run.track_m.front();
    if (time_s >= times.back()) return run.track_m.back();
    const auto next =
        static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time_s) - times.begin());
    const double f = (time_s - times[next - 1]) / (times[next] - times[next - 1]);
    return run.track_m[next - 1] + f * (run.track_m[next] - run.track_m[next - 1]);
}

double trueYaw(const RunModel& run, const HardIron& array_iron, std::size_t i) {
    if (!run.has_heading) return run.yaw_rad[i];
    if (run.has_gyro) return run.base_yaw_rad[i] - run.turn.value(run.turn_at[i]);
    const double yaw = run.yaw_rad[i];
    return yaw - run.psi.value(run.psi_at[i]) - (array_iron.sin.value + run.iron.sin.value) * std::sin(yaw) -
           (array_iron.cos.value + run.iron.cos.value) * std::cos(yaw);
}

double epochBegin(const std::vector<double>& times_s, std::size_t epoch) {
    if (epoch == 0) return times_s[0];
    return times_s[epoch] - std::min(0.5 * (times_s[epoch] - times_s[epoch - 1]), kLongest_s);
}

double epochEnd(const std::vector<double>& times_s, std::size_t epoch) {
    if (epoch + 1 == times_s.size()) return times_s[epoch];
    return times_s[epoch] + std::min(0.5 * (times_s[epoch + 1] - times_s[epoch]), kLongest_s);
}

double compassNoise_rad(const AttitudeOptions& options) {
    return radians(options.sigma_heading_deg) / 6.0;
}

}  // namespace terrawalk
