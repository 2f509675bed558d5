#include "app/pipeline/outage_measure.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "fusion/fuse_survey.hpp"
#include "survey/gnss_channels.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {

namespace {

/// A stretch of time, from after its start to its end.
struct Stretch {
    double start_s = 0.0;
    double end_s = 0.0;
};

/// Where the array was, up to a constant, at some times of a run.
class DisplacementReference {
  public:
    static DisplacementReference fromTruth(const Trajectory& truth) {
        DisplacementReference reference;
        for (const TrajectoryEpoch& epoch : truth.epochs) {
            reference.times_s_.push_back(epoch.time_s);
            reference.en_m_.emplace_back(epoch.position_enu_m.head<2>());
        }
        return reference;
    }

    static DisplacementReference fromDoppler(const ArrayLog& log) {
        DisplacementReference reference;
        Eigen::Vector2d at_m = Eigen::Vector2d::Zero();
        Eigen::Vector2d before_mps = Eigen::Vector2d::Zero();
        for (std::size_t i = 0; i < log.size(); ++i) {
            const Eigen::Vector2d velocity_mps(log.value(Channel::GnssVelocityEast, i),
                                               log.value(Channel::GnssVelocityNorth, i));
            if (!velocity_mps.allFinite()) continue;
            if (!reference.times_s_.empty()) {
                at_m += 0.5 * (log.time_s[i] - reference.times_s_.back()) * (before_mps + velocity_mps);
            }
            reference.times_s_.push_back(log.time_s[i]);
            reference.en_m_.push_back(at_m);
            before_mps = velocity_mps;
        }
        return reference;
    }

    /// Nothing where the stretch reaches beyond the reference or holds a gap.
    [[nodiscard]] std::optional<Eigen::Vector2d> over(const Stretch& stretch, double longest_gap_s) const {
        const auto end = std::lower_bound(times_s_.begin(), times_s_.end(), stretch.end_s);
        const auto start = std::upper_bound(times_s_.begin(), times_s_.end(), stretch.start_s);
        if (end == times_s_.end() || start == times_s_.begin()) return std::nullopt;
        for (auto time = start; time <= end; ++time) {
            if (*time - *(time - 1) > longest_gap_s) return std::nullopt;
        }
        return at(stretch.end_s) - at(stretch.start_s);
    }

  private:
    [[nodiscard]] Eigen::Vector2d at(double time_s) const {
        const auto after = std::max<std::ptrdiff_t>(
            1, std::lower_bound(times_s_.begin(), times_s_.end(), time_s) - times_s_.begin());
        const auto j = static_cast<std::size_t>(after);
        const double share = (time_s - times_s_[j - 1]) / (times_s_[j] - times_s_[j - 1]);
        return (1.0 - share) * en_m_[j - 1] + share * en_m_[j];
    }

    std::vector<double> times_s_;
    std::vector<Eigen::Vector2d> en_m_;
};

/// The rows of a log within a stretch, its ends included.
ArrayLog cutLog(const ArrayLog& log, const Stretch& stretch) {
    const auto first =
        std::lower_bound(log.time_s.begin(), log.time_s.end(), stretch.start_s) - log.time_s.begin();
    const auto last =
        std::upper_bound(log.time_s.begin(), log.time_s.end(), stretch.end_s) - log.time_s.begin();
    const auto cut = [&](const std::vector<double>& values) {
        return values.empty() ? values : std::vector<double>(values.begin() + first, values.begin() + last);
    };
    ArrayLog piece;
    piece.file = log.file;
    piece.device = log.device;
    piece.sample_interval_s = log.sample_interval_s;
    piece.range_lever_arm_m = log.range_lever_arm_m;
    piece.gnss_lever_arm_m = log.gnss_lever_arm_m;
    piece.time_s = cut(log.time_s);
    for (std::size_t c = 0; c < kChannelCount; ++c) piece.channels[c] = cut(log.channels[c]);
    return piece;
}

void maskGnss(ArrayLog& log, const Stretch& outage) {
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (log.time_s[i] <= outage.start_s || log.time_s[i] > outage.end_s) continue;
        for (const Channel channel : kGnssChannels) {
            if (log.has(channel)) log.column(channel)[i] = kMissing;
        }
    }
}

/// A survey of one piece of one run, without what the run says of times outside it.
Survey pieceOf(const Survey& survey, const Run& run, const Stretch& stretch, const Stretch& outage) {
    Survey piece;
    piece.project_file = survey.project_file;
    piece.name = survey.name;
    piece.zero_point = survey.zero_point;
    piece.marks = survey.marks;
    Run cut{.id = run.id,
            .kind = run.kind,
            .start = {},
            .target = {},
            .stops = {},
            .log = cutLog(run.log, stretch)};
    if (cut.log.time_s.front() == run.log.time_s.front()) cut.start = run.start;
    if (cut.log.time_s.back() == run.log.time_s.back()) cut.target = run.target;
    for (const Stop& stop : run.stops) {
        if (stop.from_s >= stretch.start_s && stop.to_s <= stretch.end_s) cut.stops.push_back(stop);
    }
    maskGnss(cut.log, outage);
    piece.runs.push_back(std::move(cut));
    return piece;
}

/// Position at a time between epochs.
Eigen::Vector2d positionAt(const Trajectory& trajectory, double time_s) {
    const auto& epochs = trajectory.epochs;
    const auto found = std::lower_bound(epochs.begin(), epochs.end(), time_s,
                                        [](const TrajectoryEpoch& e, double t) { return e.time_s < t; });
    if (found == epochs.end()) return epochs.back().position_enu_m.head<2>();
    if (found == epochs.begin()) return epochs.front().position_enu_m.head<2>();
    const double share = (time_s - (found - 1)->time_s) / (found->time_s - (found - 1)->time_s);
    return ((1.0 - share) * (found - 1)->position_enu_m + share * found->position_enu_m).head<2>();
}

Result<double> fusedError(const Survey& piece, const FusionOptions& fusion, const Stretch& outage,
                          const Eigen::Vector2d& reference_m, const std::stop_token& stop) {
    SilentProgress silent;
    const auto fused = fuseSurvey(piece, fusion, silent, stop);
    if (!fused && fused.error().kind == ErrorKind::Cancelled) return tl::unexpected(fused.error());
    if (!fused) return std::numeric_limits<double>::infinity();
    const Trajectory& track = fused->runs.front().trajectory;
    return (positionAt(track, outage.end_s) - positionAt(track, outage.start_s) - reference_m).norm();
}

/// The last Doppler velocity at the start of the outage, for as long as it lasts; standing where there is
/// none.
Eigen::Vector2d constantVelocity(const ArrayLog& log, const Stretch& outage) {
    Eigen::Vector2d velocity_mps = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < log.size() && log.time_s[i] <= outage.start_s; ++i) {
        const Eigen::Vector2d measured(log.value(Channel::GnssVelocityEast, i),
                                       log.value(Channel::GnssVelocityNorth, i));
        if (measured.allFinite()) velocity_mps = measured;
    }
    return velocity_mps * (outage.end_s - outage.start_s);
}

/// Flow turned by the heading, both held where they are missing.
Eigen::Vector2d integratedFlow(const ArrayLog& log, const Stretch& outage) {
    Eigen::Vector2d displacement_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d velocity_mps = Eigen::Vector2d::Zero();
    double before_s = outage.start_s;
    for (std::size_t i = 0; i < log.size() && log.time_s[i] <= outage.end_s; ++i) {
        const Eigen::Vector2d flow_mps(log.value(Channel::FlowForward, i), log.value(Channel::FlowLeft, i));
        const double yaw_rad = yawFromHeading(log.value(Channel::Heading, i));
        if (log.time_s[i] > outage.start_s) {
            displacement_m += (log.time_s[i] - before_s) * velocity_mps;
            before_s = log.time_s[i];
        }
        if (flow_mps.allFinite() && present(yaw_rad)) {
            velocity_mps = {flow_mps.x() * std::cos(yaw_rad) - flow_mps.y() * std::sin(yaw_rad),
                            flow_mps.x() * std::sin(yaw_rad) + flow_mps.y() * std::cos(yaw_rad)};
        }
    }
    return displacement_m + (outage.end_s - before_s) * velocity_mps;
}

struct PlannedOutage {
    Outage outage;
    Stretch stretch;
    Eigen::Vector2d reference_m;
};

std::vector<PlannedOutage> planOutages(const Survey& survey, const OutageOptions& options,
                                       const std::vector<Trajectory>* truth) {
    std::vector<PlannedOutage> planned;
    for (const double length_s : options.lengths_s) {
        for (std::size_t run = 0; run < survey.runs.size(); ++run) {
            const ArrayLog& log = survey.runs[run].log;
            const auto reference = truth != nullptr ? DisplacementReference::fromTruth((*truth)[run])
                                                    : DisplacementReference::fromDoppler(log);
            const double first_s = log.time_s.front() + options.least_history_s;
            for (int k = 0; first_s + k * options.every_s + length_s <= log.time_s.back(); ++k) {
                const double start_s = first_s + k * options.every_s;
                const Stretch stretch{start_s, start_s + length_s};
                const auto moved_m = reference.over(stretch, options.longest_gap_s);
                if (moved_m) planned.push_back({{run, start_s, length_s, {}}, stretch, *moved_m});
            }
        }
    }
    return planned;
}

Result<Outage> measured(const Survey& survey, const FusionOptions& fusion, const OutageOptions& options,
                        const PlannedOutage& planned, const std::stop_token& stop) {
    const Run& run = survey.runs[planned.outage.run];
    const Stretch& outage = planned.stretch;
    const double from_s = outage.start_s - options.history_s;
    const auto forward = fusedError(pieceOf(survey, run, {from_s, outage.end_s}, outage), fusion, outage,
                                    planned.reference_m, stop);
    if (!forward) return tl::unexpected(forward.error());
    const Stretch with_following{from_s, outage.end_s + options.following_s};
    const auto smoothed =
        fusedError(pieceOf(survey, run, with_following, outage), fusion, outage, planned.reference_m, stop);
    if (!smoothed) return tl::unexpected(smoothed.error());
    Outage result = planned.outage;
    result.error_m = {*forward, *smoothed, (constantVelocity(run.log, outage) - planned.reference_m).norm(),
                      (integratedFlow(run.log, outage) - planned.reference_m).norm()};
    return result;
}

}  // namespace

Result<std::vector<Outage>> measureOutages(const Survey& survey, const FusionOptions& fusion,
                                           const OutageOptions& options, const std::vector<Trajectory>* truth,
                                           Progress& progress, std::stop_token stop) {
    const std::vector<PlannedOutage> planned = planOutages(survey, options, truth);
    if (planned.empty()) {
        return badData("no stretch of the survey has a Doppler velocity to compare with", survey.project_file,
                       0, "give a survey whose logs have gnss_ve_mps and gnss_vn_mps");
    }
    std::vector<Result<Outage>> results(planned.size(), cancelled());
    std::atomic<std::size_t> done = 0;
    parallelFor(planned.size(), [&](std::size_t i) {
        if (stop.stop_requested()) return;
        results[i] = measured(survey, fusion, options, planned[i], stop);
        progress.report(static_cast<double>(++done) / static_cast<double>(planned.size()), "masking GNSS");
    });
    std::vector<Outage> outages;
    for (const Result<Outage>& result : results) {
        if (!result) return tl::unexpected(result.error());
        outages.push_back(*result);
    }
    return outages;
}

std::vector<double> outageErrors(const std::vector<Outage>& outages, double length_s, OutageMethod method) {
    std::vector<double> errors_m;
    for (const Outage& outage : outages) {
        if (outage.length_s == length_s) errors_m.push_back(outage.error(method));
    }
    std::sort(errors_m.begin(), errors_m.end());
    return errors_m;
}

}  // namespace terrawalk
