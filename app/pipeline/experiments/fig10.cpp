// Loss that each tuner reaches with the nine process noises of paper 000's filter.

#include "app/pipeline/experiments/experiments.hpp"
#include "app/pipeline/experiments/tuner_trials.hpp"

namespace terrawalk {

Result<ExperimentReport> runFig10(const ExperimentOptions& options, Progress& progress,
                                  std::stop_token stop) {
    const LossComparison comparison{.title = "Fig 10: loss by tuner, nine process noises",
                                    .budget = {.dimensions = kNoiseDimensions,
                                               .population = options.quick ? 20U : 50U,
                                               .evaluations = options.quick ? 300U : 5000U},
                                    .paper_isma = "245.24",
                                    .paper_others = "higher than ISMA's"};
    return compareTuners(comparison, options.quick ? 3 : 10, options, progress, stop);
}

}  // namespace terrawalk
