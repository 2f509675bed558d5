#include "fusion/fuse_survey.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "fusion/crossover_correction.hpp"
#include "fusion/fuse_run.hpp"
#include "fusion/joint_adjustment.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {

namespace {

/// Progress of runs that are worked on side by side, each weighing as much as its log is long.
class SideBySide {
  public:
    SideBySide(const Survey& survey, Progress& progress) : progress_(progress), parts_(survey.runs.size()) {
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            parts_[i].whole = this;
            parts_[i].weight = static_cast<double>(survey.runs[i].log.size());
            weight_ += parts_[i].weight;
        }
    }
    Progress& of(std::size_t run) { return parts_[run]; }

  private:
    struct Part final : Progress {
        void report(double fraction, std::string_view step) override {
            done = fraction * weight;
            whole->report(step);
        }
        void message(Severity severity, std::string_view text) override {
            whole->progress_.message(severity, text);
        }
        SideBySide* whole = nullptr;
        double weight = 0.0;
        std::atomic<double> done{0.0};
    };
    void report(std::string_view step) {
        double done = 0.0;
        for (const Part& part : parts_) done += part.done;
        progress_.report(weight_ > 0.0 ? done / weight_ : 1.0, step);
    }
    Progress& progress_;
    std::vector<Part> parts_;
    double weight_ = 0.0;
};

void limit(FusedSurvey& fused, const std::string& sentence) {
    for (FusedRun& run : fused.runs) run.notes.limitations.push_back(sentence);
}

// The quick second stage; the sigmas stay those of the filter.
void correctTracks(const Survey& survey, std::vector<RunStart>& starts, const FusionOptions& options,
                   const std::stop_token& stop, const std::string& why, FusedSurvey& fused) {
    std::optional<CrossoverCorrection> correction;
    if (options.joint.use_crossovers) correction = correctByCrossovers(survey, starts, options, stop);
    for (std::size_t r = 0; r < starts.size(); ++r) {
        Trajectory& track = fused.runs[r].trajectory = std::move(starts[r].trajectory);
        if (!correction) continue;
        for (std::size_t i = 0; i < track.epochs.size(); ++i) {
            track.epochs[i].position_enu_m = correction->tracks_m[r][i];
        }
    }
    limit(fused, correction ? fmt::format("{}: the tracks are those of the filter, bent so that {} pairs of "
                                          "passes over the same ground agree ({:.3f} m RMS apart before, "
                                          "{:.3f} m after); sigmas are the filter's",
                                          why, correction->crossovers, correction->misfit_before_m,
                                          correction->misfit_after_m)
                            : why + ": the tracks are those of the filter, crossovers are not used");
}

Result<FusedSurvey> adjusted(const Survey& survey, std::vector<RunFusion> runs, const FusionOptions& options,
                             Progress& progress, std::stop_token stop) {
    FusedSurvey fused;
    std::vector<RunStart> starts;
    for (std::size_t i = 0; i < survey.runs.size(); ++i) {
        RunFusion& run = runs[i];
        starts.push_back({&survey.runs[i], std::move(run.attitudes), std::move(run.reference),
                          std::move(run.fused.trajectory), std::move(run.gnss_gated),
                          std::move(run.gnss_jump_m)});
        fused.runs.push_back(std::move(run.fused));
    }
    if (options.joint.preview) {
        correctTracks(survey, starts, options, stop, "a preview without the adjustment of all runs", fused);
        if (stop.stop_requested()) return cancelled();
        return fused;
    }
    auto solution = adjustJointly(survey, starts, options, progress, stop);
    if (stop.stop_requested()) return cancelled();
    if (!solution) {
        correctTracks(survey, starts, options, stop, "the adjustment of all runs has no solution", fused);
        if (stop.stop_requested()) return cancelled();
        return fused;
    }
    for (std::size_t i = 0; i < survey.runs.size(); ++i) {
        fused.runs[i].trajectory = std::move(solution->trajectories[i]);
    }
    const AdjustmentSummary& summary = solution->summary;
    if (summary.flow_scale_wanders) {
        limit(fused, "the scale of the optical flow wanders: the adjustment follows it");
    }
    if (!summary.settled) {
        limit(fused, fmt::format("the adjustment of all runs has not settled: the last of {} rounds moved a "
                                 "track by {:.2f} m",
                                 summary.rounds, summary.last_step_m));
    }
    fused.adjustment = std::move(solution->summary);
    return fused;
}

}  // namespace

Result<FusedSurvey> fuseSurvey(const Survey& survey, const FusionOptions& options, Progress& progress,
                               std::stop_token stop) {
    const std::size_t n = survey.runs.size();
    std::vector<Result<RunFusion>> fusions(n, cancelled());
    SideBySide parts(survey, progress);
    parallelFor(n, [&](std::size_t i) {
        if (stop.stop_requested()) return;
        fusions[i] = fuseRunInFull(survey, survey.runs[i], options, parts.of(i), stop);
    });
    if (stop.stop_requested()) return cancelled();
    std::vector<RunFusion> runs;
    runs.reserve(n);
    for (Result<RunFusion>& run : fusions) {
        if (!run) return tl::unexpected(run.error());
        runs.push_back(std::move(*run));
    }
    if (options.method == FusionMethod::Terrawalk) {
        return adjusted(survey, std::move(runs), options, progress, stop);
    }
    FusedSurvey result;
    result.runs.reserve(n);
    for (RunFusion& run : runs) result.runs.push_back(std::move(run.fused));
    return result;
}

}  // namespace terrawalk
