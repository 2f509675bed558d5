#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

enum class OptimiserKind {
    Isma,  ///< improved slime mould: greedy, scale-free, self-adaptive differential evolution; the default
    IsmaPrinted,  ///< improved slime mould as paper 000 prints it
    Sma,          ///< slime mould algorithm (Li et al. 2020)
    Pso,          ///< particle swarm (pagmo, generational)
    Ga,           ///< genetic algorithm (pagmo)
    Sa,           ///< simulated annealing (pagmo, Corana's)
    Nsga2,        ///< Pareto search over several losses (pagmo); its answer is the front's least sum
    Abc,          ///< artificial bee colony (pagmo)
    Sade,         ///< self-adaptive differential evolution (pagmo, jDE)
    Cmaes,        ///< covariance matrix adaptation evolution strategy (pagmo)
};

inline constexpr std::array<std::pair<OptimiserKind, std::string_view>, 10> kOptimiserNames{{
    {OptimiserKind::Isma, "isma"},
    {OptimiserKind::IsmaPrinted, "isma-printed"},
    {OptimiserKind::Sma, "sma"},
    {OptimiserKind::Pso, "pso"},
    {OptimiserKind::Ga, "ga"},
    {OptimiserKind::Sa, "sa"},
    {OptimiserKind::Nsga2, "nsga2"},
    {OptimiserKind::Abc, "abc"},
    {OptimiserKind::Sade, "sade"},
    {OptimiserKind::Cmaes, "cmaes"},
}};
[[nodiscard]] std::string_view name(OptimiserKind kind);

/// The box that is searched, of d dimensions. Every candidate lies in it, borders included.
struct SearchBox {
    std::vector<double> lower;
    std::vector<double> upper;  ///< not below `lower`
    [[nodiscard]] std::size_t dimensions() const { return lower.size(); }
};

/// Losses of n candidates at once. `candidates` is n x d, row after row; `losses` is n x m and is filled.
/// A pure function of the candidates, as it may be called from several threads at once. A loss that is not a
/// number counts as infinite.
using LossFunction = std::function<void(std::span<const double> candidates, std::span<double> losses)>;

/// What is to be made small.
struct Objective {
    LossFunction evaluate;
    /// m. An optimiser of one loss makes their sum small; Nsga2 needs two or more.
    std::size_t losses = 1;
    /// Decided by everything that the losses depend on beside the candidate (data, settings), so that a
    /// record of other losses is refused. 0 where nothing is recorded.
    std::uint64_t fingerprint = 0;
};

/// One loss of each candidate by itself. Batches above `grain` candidates are worked on in parallel, `grain`
/// at a time; SIZE_MAX: never, for functions that cost less than a thread's errand.
[[nodiscard]] LossFunction perCandidate(std::size_t dimensions,
                                        std::function<double(std::span<const double>)> loss,
                                        std::size_t grain = 1);

struct OptimiserOptions {
    OptimiserKind kind = OptimiserKind::Isma;
    std::size_t population = 50;  ///< Nsga2 rounds it up to a multiple of four
    /// Rounds in which each member of the population is tried once (twice with IsmaPrinted: a slime mould
    /// move and a trial vector). Isma shrinks its population on the way and spends the same number of
    /// evaluations in more rounds. 0: no limit but `max_evaluations`.
    std::size_t generations = 1000;
    std::size_t max_evaluations = 0;  ///< 0: no limit but `generations`
    std::uint64_t seed = 1;
    /// Independent searches side by side, which share the evaluations out evenly; the best of all is the
    /// answer. 0: one for kinds that hand over whole generations (Isma, IsmaPrinted, Sma, Pso, Nsga2), four
    /// for the others, which pagmo drives one candidate at a time. Never the number of cores, so that the
    /// answer is the same on every machine. Who compares kinds sets 1: four short searches are no long one.
    std::size_t islands = 0;
};

struct ConvergencePoint {
    std::size_t evaluations = 0;  ///< of all islands
    double best_loss = 0.0;       ///< sum of the losses, best so far
};

struct FrontPoint {
    std::vector<double> candidate;
    std::vector<double> losses;
};

struct OptimiserResult {
    std::vector<double> best;         ///< d values
    double best_loss = 0.0;           ///< sum of `best_losses`
    std::vector<double> best_losses;  ///< m values
    std::vector<FrontPoint> front;  ///< Nsga2 alone: candidates that none beats in every loss, by first loss
    std::size_t evaluations = 0;    ///< all of them: start, opposition, trials
    std::vector<ConvergencePoint> convergence;  ///< one point at each gain, and the end
    bool cancelled = false;                     ///< stopped on request: the best so far
    std::vector<std::string> notes;             ///< what was done otherwise than a reader would expect
};

/// Losses in the order in which they were asked for, which is all that a search needs to be resumed: the
/// random numbers follow from the seed, so the same losses lead to the same candidates.
struct EvaluationRecord {
    std::uint64_t fingerprint = 0;             ///< `searchFingerprint` of the search that was recorded
    std::vector<std::vector<double>> islands;  ///< for each island, m losses for each evaluation
};

struct Recording {
    const EvaluationRecord* resume_from = nullptr;  ///< replayed before anything is evaluated anew
    /// Called with each batch of losses that was evaluated (never with replayed ones), one call at a time,
    /// from any thread.
    std::function<void(std::size_t island, std::span<const double> losses)> on_losses;
};

/// Decided by all that makes two searches the same: kind, seed, budget, islands, box, objective.
[[nodiscard]] std::uint64_t searchFingerprint(const Objective& objective, const SearchBox& box,
                                              const OptimiserOptions& options);

/// Independent searches that the options lead to.
[[nodiscard]] std::size_t islandCount(const OptimiserOptions& options);

/// Evaluations that the options allow, of all islands.
[[nodiscard]] std::size_t evaluationLimit(const OptimiserOptions& options);

/// Searches the box for the candidate of least loss. The same objective, box and options give the same result
/// on any number of threads, whether the search ran through or was resumed from its record.
///
/// Every evaluation counts towards the limit, which is kept exactly. A pagmo algorithm that ends before its
/// evaluations are spent (a collapsed population) starts again elsewhere; the notes say how often.
///
/// When a stop is requested the best so far comes back, marked `cancelled`; losses of the batch at work are
/// dropped, so an objective may return early with any value. `Cancelled` is the error when nothing was
/// evaluated yet.
///
/// Errors: Usage for an empty or reversed box, no limit, a population below what the kind needs, one loss
/// with Nsga2; BadData for a record of another search.
/// Source: Li et al. 2020 (slime mould), paper 000 (improvement), Brest et al. 2006
/// (self-adaptive differential evolution); pagmo 2 (Biscani and Izzo 2020).
[[nodiscard]] Result<OptimiserResult> optimise(const Objective& objective, const SearchBox& box,
                                               const OptimiserOptions& options, Progress& progress,
                                               std::stop_token stop, const Recording& recording = {});

}  // namespace terrawalk
