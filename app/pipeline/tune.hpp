#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "app/pipeline/tune_problem.hpp"
#include "fusion/optimiser.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

struct TuneOptions {
    OptimiserKind optimiser = OptimiserKind::Isma;
    std::size_t population = 0;    ///< 0: what is usual for the problem, aukf 100
    std::size_t iterations = 0;    ///< 0: the same, aukf 1000
    std::size_t restarts = 1;      ///< independent searches, each of the whole budget; the best is taken
    bool hyperparameters = false;  ///< alpha, beta and kappa as well
    std::uint64_t seed = 1;
};

enum class Bound { None, Lower, Upper };

/// What became of one parameter. Values, not their logarithms.
struct TunedParameter {
    std::string name;
    std::vector<UsedSetting> settings;  ///< key, value before, value after
    double before = 0.0;
    double after = 0.0;
    double lower = 0.0;
    double upper = 0.0;
    Bound on_bound = Bound::None;
    /// Range around the tuned value in which the loss stays within `kFlatShare` of the least, all others
    /// held.
    double flat_from = 0.0;
    double flat_to = 0.0;
    bool identified = true;  ///< that range is narrower than a decade, or half the box
    /// Least and greatest value that the searches with one part left out came to.
    std::optional<double> left_out_least;
    std::optional<double> left_out_greatest;
};
inline constexpr double kFlatShare = 0.01;

/// Loss of one part, m components.
struct PartOutcome {
    TunablePart part;
    std::vector<double> before;
    std::vector<double> after;
    std::vector<double> left_out;  ///< tuned without it; empty where that was not possible
};

/// What tuning is worth on data that it has not seen: each part, or group of parts, in turn is left out, the
/// others are tuned on with a smaller budget, and what was left out is the test.
struct HeldOutComparison {
    std::size_t groups = 0;
    std::size_t evaluations_each = 0;
    std::size_t population = 0;
    double before = 0.0;               ///< sum over the parts, with the values as they were
    double after = 0.0;                ///< sum over the parts, each with the values tuned without it
    double gain_standard_error = 0.0;  ///< of before - after, from its spread over the parts
};

struct TuneOutcome {
    TuneOptions options;  ///< as used
    std::string method;
    std::string loss_meaning;
    std::string loss_unit;
    std::vector<std::string> components;
    bool squared_metres = false;
    std::vector<TunedParameter> parameters;
    std::vector<PartOutcome> parts;
    std::vector<ControlMark> marks;  ///< on which the values were tuned
    std::vector<double> before;      ///< loss, m components
    std::vector<double> after;
    bool improved = false;  ///< the search found better values than those it started from; else these stay
    std::optional<HeldOutComparison> held_out;  ///< nothing with a single part
    bool holds_out_better = false;  ///< by more than one standard error: the values are worth adopting
    std::string decision;           ///< the same in a sentence
    std::vector<std::string> warnings;
    std::vector<ConvergencePoint> convergence;
    std::vector<std::string> search_notes;
    std::size_t search_evaluations = 0;
    std::size_t held_out_evaluations = 0;
    std::size_t profile_evaluations = 0;
    PipelineConfig tuned;  ///< the configuration with the values after

    [[nodiscard]] std::size_t evaluations() const {
        return search_evaluations + held_out_evaluations + profile_evaluations;
    }
};

/// Sum of the components, and for losses in squared metres the root of the mean over n parts.
[[nodiscard]] double totalLoss(std::span<const double> components);
[[nodiscard]] double rootMean(double loss, std::size_t parts);

/// The options with what is usual for the problem filled in.
[[nodiscard]] TuneOptions usedOptions(const TunableProblem& problem, TuneOptions options);

/// Losses of the searches of one tuning, in their order: the search over all parts, then those with a group
/// left out. Enough to resume it.
using TuneRecord = std::vector<EvaluationRecord>;

struct TuneRecording {
    const TuneRecord* resume_from = nullptr;
    /// Before the first losses of a search.
    std::function<void(std::size_t search, std::uint64_t fingerprint)> on_search;
    /// As Recording::on_losses.
    std::function<void(std::size_t search, std::size_t island, std::span<const double> losses)> on_losses;
};

/// Tunes the parameters of a problem, tests them on parts left out, and looks at what the data can tell of
/// each. The same problem and options give the same outcome on any number of threads, run through or resumed.
/// Values that the search started from stay where it finds none better.
///
/// The tuned values count as better on held-out data when the summed loss of the parts left out falls by more
/// than its standard error. Source of the rule: Breiman et al. 1984, section 3.4.3 (one standard error).
/// Errors: Usage as optimise(); BadData for a record of another tuning; Cancelled, after all losses were
/// handed to the recording.
[[nodiscard]] Result<TuneOutcome> tune(const TunableProblem& problem, const PipelineConfig& config,
                                       const TuneOptions& options, Progress& progress, std::stop_token stop,
                                       const TuneRecording& recording = {});

}  // namespace terrawalk
