#include "fusion/fuse_survey.hpp"

#include <tbb/parallel_for.h>

#include <atomic>
#include <cstddef>

#include "fusion/fuse_run.hpp"
#include "fusion/joint_adjustment.hpp"
#include "fusion/run_reference.hpp"

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

Result<FusedSurvey> adjusted(const Survey& survey, FusedSurvey fused, const FusionOptions& options,
                             Progress& progress, std::stop_token stop) {
    std::vector<RunStart> starts;
    for (std::size_t i = 0; i < survey.runs.size(); ++i) {
        RunStart start;
        start.run = &survey.runs[i];
        RunNotes again;
        start.attitudes = epochAttitudes(start.run->log, options.attitude, again);
        const auto reference = runReference(survey, *start.run, options, start.attitudes, again);
        if (!reference) return tl::unexpected(reference.error());
        start.reference = *reference;
        start.trajectory = std::move(fused.runs[i].trajectory);
        starts.push_back(std::move(start));
    }
    auto solution = adjustJointly(survey, starts, options, progress, stop);
    for (std::size_t i = 0; i < survey.runs.size(); ++i) {
        FusedRun& run = fused.runs[i];
        run.trajectory = solution ? std::move(solution->trajectories[i]) : std::move(starts[i].trajectory);
        if (!solution) {
            run.notes.limitations.push_back(
                "the adjustment of all runs has no solution: the tracks are those of the filter, crossovers "
                "are not used");
        }
    }
    if (solution) {
        fused.adjustment = std::move(solution->summary);
    } else if (solution.error().kind == ErrorKind::Cancelled) {
        return tl::unexpected(solution.error());
    }
    return fused;
}

}  // namespace

Result<FusedSurvey> fuseSurvey(const Survey& survey, const FusionOptions& options, Progress& progress,
                               std::stop_token stop) {
    const std::size_t n = survey.runs.size();
    std::vector<Result<FusedRun>> fused(n, cancelled());
    SideBySide parts(survey, progress);
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
        if (stop.stop_requested()) return;
        fused[i] = fuseRun(survey, survey.runs[i], options, parts.of(i), stop);
    });
    if (stop.stop_requested()) return cancelled();
    FusedSurvey result;
    result.runs.reserve(n);
    for (Result<FusedRun>& run : fused) {
        if (!run) return tl::unexpected(run.error());
        result.runs.push_back(std::move(*run));
    }
    if (options.method == FusionMethod::Terrawalk) {
        return adjusted(survey, std::move(result), options, progress, stop);
    }
    return result;
}

}  // namespace terrawalk
