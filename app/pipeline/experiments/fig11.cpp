// The same as Fig 10 with alpha, beta and kappa tuned as well.

#include "app/pipeline/experiments/experiments.hpp"
#include "app/pipeline/experiments/tuner_trials.hpp"

namespace terrawalk {

Result<ExperimentReport> runFig11(const ExperimentOptions& options, Progress& progress,
                                  std::stop_token stop) {
    const LossComparison comparison{
        .title = "Fig 11: loss by tuner, nine process noises and alpha, beta, kappa",
        .budget = {.dimensions = kAllDimensions,
                   .population = options.quick ? 20U : 50U,
                   .evaluations = options.quick ? 300U : 5000U},
        .paper_isma = "244.25",
        .paper_others = "higher than with nine, but for SMA"};
    auto report = compareTuners(comparison, options.quick ? 3 : 10, options, progress, stop);
    if (!report) return report;
    report->notes.emplace_back(
        "an extended or cubature Kalman filter has no alpha, beta and kappa: these do nothing there");
    return report;
}

}  // namespace terrawalk
