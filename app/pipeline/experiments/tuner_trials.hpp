#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "app/pipeline/experiment.hpp"
#include "fusion/fixed_point_loss.hpp"
#include "fusion/fusion_options.hpp"
#include "fusion/optimiser.hpp"
#include "fusion/simulation.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

// Searches over the parameters of paper 000's filter, as figures 10 to 15 repeat them on simulated
// fixed-point runs.

/// Who tunes what.
struct Tuner {
    OptimiserKind kind = OptimiserKind::Isma;
    FilterKind filter = FilterKind::Ukf;
    std::string name;
};

/// The six of the paper, our default form of its own, and the paper's filter replaced by others (section 4).
[[nodiscard]] std::vector<Tuner> paperTuners();

/// The runs that the tuners see, and as many walked over another ground on another day, which they do not.
struct TuningGround {
    FixedPointLoss training;
    FixedPointLoss elsewhere;
};

/// The paper's 16 fixed-point runs of 259 epochs and no area walk.
[[nodiscard]] Result<SimulatedSurvey> simulatedFixedPointRuns(std::uint64_t seed,
                                                              const std::stop_token& stop);

[[nodiscard]] Result<TuningGround> tuningGround(std::uint64_t seed, FilterKind filter,
                                                const std::stop_token& stop);

struct SearchBudget {
    std::size_t dimensions = kNoiseDimensions;
    std::size_t population = 50;
    std::size_t evaluations = 5000;  ///< every one counts, those of the start too
};

/// One search. The islands of kinds that have some would share the budget out, so there is one.
[[nodiscard]] Result<OptimiserResult> searchOnce(const FixedPointLoss& loss, OptimiserKind kind,
                                                 const SearchBudget& budget, std::uint64_t seed,
                                                 Progress& progress, const std::stop_token& stop);

struct SampleSummary {
    double mean = 0.0;
    double median = 0.0;
    double least = 0.0;
    double greatest = 0.0;
};
/// @param values  one or more
[[nodiscard]] SampleSummary summaryOf(std::vector<double> values);

/// Figures 10 and 11, which differ in what is tuned.
struct LossComparison {
    std::string title;
    SearchBudget budget;
    std::string paper_isma;  ///< the paper's figure for its own tuner
    std::string paper_others;
};
[[nodiscard]] Result<ExperimentReport> compareTuners(const LossComparison& comparison, std::size_t repeats,
                                                     const ExperimentOptions& options, Progress& progress,
                                                     const std::stop_token& stop);

}  // namespace terrawalk
