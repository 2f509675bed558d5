#include "fusion/optimiser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "fusion/candidate_evaluator.hpp"
#include "fusion/optimiser_pagmo.hpp"
#include "fusion/random_numbers.hpp"
#include "fusion/slime_mould.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {

namespace {

constexpr std::size_t kLeastPopulation = 8;
constexpr std::size_t kLargestPopulation = 1'000'000;
constexpr std::size_t kIslandsOfSequentialKinds = 4;
constexpr std::size_t kMostIslands = 1024;

std::size_t population(const OptimiserOptions& options) {
    if (options.kind != OptimiserKind::Nsga2) return options.population;
    return (options.population + 3) / 4 * 4;
}

bool isOurs(OptimiserKind kind) {
    return kind == OptimiserKind::Isma || kind == OptimiserKind::IsmaPrinted || kind == OptimiserKind::Sma;
}

/// Evaluations before the first generation.
std::size_t startEvaluations(const OptimiserOptions& options) {
    const bool opposition = options.kind == OptimiserKind::Isma || options.kind == OptimiserKind::IsmaPrinted;
    return population(options) * (opposition ? 2 : 1);
}

Result<void> checked(const Objective& objective, const SearchBox& box, const OptimiserOptions& options) {
    const std::size_t d = box.dimensions();
    if (!objective.evaluate || objective.losses == 0) return usageError("the objective has no losses");
    if (d == 0 || box.upper.size() != d)
        return usageError("the search box has no dimensions or unequal ones");
    for (std::size_t j = 0; j < d; ++j) {
        if (!std::isfinite(box.lower[j]) || !std::isfinite(box.upper[j]) || box.lower[j] > box.upper[j]) {
            return usageError(
                fmt::format("bounds {} of the search box are {} and {}", j + 1, box.lower[j], box.upper[j]),
                "give finite bounds, the lower one first");
        }
    }
    if (options.population < kLeastPopulation || options.population > kLargestPopulation) {
        return usageError(fmt::format("a population of {} individuals", options.population),
                          fmt::format("take {} to {}", kLeastPopulation, kLargestPopulation));
    }
    if (options.generations == 0 && options.max_evaluations == 0) {
        return usageError("the search has no limit", "give generations or evaluations");
    }
    if (options.islands > kMostIslands || islandCount(options) > evaluationLimit(options)) {
        return usageError(
            fmt::format("{} islands for {} evaluations", islandCount(options), evaluationLimit(options)),
            fmt::format("take at most {} islands", kMostIslands));
    }
    if (options.kind == OptimiserKind::Nsga2 && objective.losses < 2) {
        return usageError("nsga2 needs two losses or more, this objective has one", "take another optimiser");
    }
    return {};
}

Result<void> checkedRecord(const Recording& recording, std::uint64_t fingerprint, std::size_t islands) {
    if (recording.resume_from == nullptr) return {};
    if (recording.resume_from->fingerprint != fingerprint) {
        return badData("the record is of another search: optimiser, seed, budget, box or data differ", {}, 0,
                       "start without it");
    }
    if (recording.resume_from->islands.size() > islands) {
        return badData(fmt::format("the record has {} islands, the search {}",
                                   recording.resume_from->islands.size(), islands));
    }
    return {};
}

/// One island: its evaluator and what pagmo said of it.
struct Island {
    std::optional<CandidateEvaluator> evaluator;
    PagmoOutcome pagmo;
};

void search(const SearchBox& box, const OptimiserOptions& options, std::uint64_t seed, Island& island) {
    CandidateEvaluator& evaluator = *island.evaluator;
    switch (options.kind) {
        case OptimiserKind::Isma:
            return improvedSlimeMould(box, population(options), seed, evaluator);
        case OptimiserKind::IsmaPrinted:
            return printedSlimeMould(box, population(options), seed, evaluator);
        case OptimiserKind::Sma:
            return slimeMould(box, population(options), seed, evaluator);
        default:
            island.pagmo = pagmoSearch(options.kind, box, population(options), seed, evaluator);
    }
}

/// Islands run at the same pace, so a point of one stands at as many evaluations of each.
std::vector<ConvergencePoint> merged(const std::vector<Island>& islands, std::size_t evaluations,
                                     double best_loss) {
    std::vector<ConvergencePoint> all;
    for (const Island& island : islands) {
        for (const ConvergencePoint& point : island.evaluator->convergence()) {
            all.push_back({std::min(point.evaluations * islands.size(), evaluations), point.best_loss});
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const ConvergencePoint& a, const ConvergencePoint& b) {
        return a.evaluations < b.evaluations;
    });
    std::vector<ConvergencePoint> gains;
    for (const ConvergencePoint& point : all) {
        if (gains.empty() || point.best_loss < gains.back().best_loss) gains.push_back(point);
    }
    if (gains.empty() || gains.back().evaluations < evaluations) gains.push_back({evaluations, best_loss});
    return gains;
}

std::vector<std::string> notesOn(const OptimiserOptions& options, const std::vector<Island>& islands) {
    std::vector<std::string> notes;
    if (islands.size() > 1) {
        notes.push_back(fmt::format(
            "{} independent islands share the evaluations; the best of all is the answer", islands.size()));
    }
    if (population(options) != options.population) {
        notes.push_back(fmt::format("population {} instead of {}: {} needs a multiple of four",
                                    population(options), options.population, name(options.kind)));
    }
    std::size_t restarts = 0;
    for (const Island& island : islands) restarts += island.pagmo.restarts;
    if (restarts > 0) {
        notes.push_back(fmt::format("{} ended before its evaluations were spent and started again {} times",
                                    name(options.kind), restarts));
    }
    if (options.kind == OptimiserKind::Sa) {
        notes.emplace_back("annealed from the spread of the start's losses down to a ten millionth of it");
    }
    return notes;
}

Result<OptimiserResult> outcome(const OptimiserOptions& options, const std::vector<Island>& islands) {
    OptimiserResult result;
    const CandidateEvaluator* best = nullptr;
    for (const Island& island : islands) {
        const CandidateEvaluator& evaluator = *island.evaluator;
        if (!island.pagmo.error.empty()) {
            return systemError(fmt::format("pagmo refuses the search: {}", island.pagmo.error));
        }
        result.evaluations += evaluator.evaluations();
        result.cancelled = result.cancelled || evaluator.wasStopped();
        if (evaluator.best().empty()) continue;
        if (best == nullptr || evaluator.bestLoss() < best->bestLoss()) best = &evaluator;
    }
    if (best == nullptr) return cancelled();
    result.best = best->best();
    result.best_loss = best->bestLoss();
    result.best_losses = best->bestLosses();
    result.convergence = merged(islands, result.evaluations, result.best_loss);
    result.notes = notesOn(options, islands);
    ParetoFront front;
    for (const Island& island : islands) {
        for (const FrontPoint& point : island.pagmo.front.points()) front.add(point.candidate, point.losses);
    }
    result.front = front.points();
    std::stable_sort(result.front.begin(), result.front.end(), [](const FrontPoint& a, const FrontPoint& b) {
        return a.losses.front() < b.losses.front();
    });
    return result;
}

}  // namespace

std::string_view name(OptimiserKind kind) {
    return kOptimiserNames[static_cast<std::size_t>(kind)].second;
}

LossFunction perCandidate(std::size_t dimensions, std::function<double(std::span<const double>)> loss,
                          std::size_t grain) {
    return [dimensions, loss = std::move(loss), grain](std::span<const double> candidates,
                                                       std::span<double> losses) {
        const auto work = [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                losses[i] = loss(candidates.subspan(i * dimensions, dimensions));
            }
        };
        if (losses.size() <= grain) return work(0, losses.size());
        parallelRanges(losses.size(), grain, work);
    };
}

std::size_t islandCount(const OptimiserOptions& options) {
    if (options.islands > 0) return options.islands;
    const bool hands_over_generations =
        isOurs(options.kind) || options.kind == OptimiserKind::Pso || options.kind == OptimiserKind::Nsga2;
    return hands_over_generations ? 1 : kIslandsOfSequentialKinds;
}

std::size_t evaluationLimit(const OptimiserOptions& options) {
    const std::size_t trials = options.kind == OptimiserKind::IsmaPrinted ? 2 : 1;
    const std::size_t by_generations =
        startEvaluations(options) + options.generations * population(options) * trials;
    if (options.generations == 0) return options.max_evaluations;
    if (options.max_evaluations == 0) return by_generations;
    return std::min(by_generations, options.max_evaluations);
}

std::uint64_t searchFingerprint(const Objective& objective, const SearchBox& box,
                                const OptimiserOptions& options) {
    constexpr std::uint64_t kVersion = 1;  // to be raised when a kind comes to ask for other candidates
    std::uint64_t print = scramble({kVersion, objective.fingerprint, objective.losses, box.dimensions(),
                                    static_cast<std::uint64_t>(options.kind), options.seed,
                                    population(options), evaluationLimit(options), islandCount(options)});
    for (const std::vector<double>* bounds : {&box.lower, &box.upper}) {
        for (const double bound : *bounds) print = scramble({print, std::bit_cast<std::uint64_t>(bound)});
    }
    return print;
}

Result<OptimiserResult> optimise(const Objective& objective, const SearchBox& box,
                                 const OptimiserOptions& options, Progress& progress, std::stop_token stop,
                                 const Recording& recording) {
    if (auto good = checked(objective, box, options); !good) return tl::unexpected(good.error());
    std::vector<Island> islands(islandCount(options));
    if (auto good = checkedRecord(recording, searchFingerprint(objective, box, options), islands.size());
        !good) {
        return tl::unexpected(good.error());
    }
    const std::size_t limit = evaluationLimit(options);
    SearchMonitor monitor(limit, recording, progress, stop);
    for (std::size_t i = 0; i < islands.size(); ++i) {
        const std::size_t share = limit / islands.size() + (i < limit % islands.size() ? 1 : 0);
        std::span<const double> recorded;
        if (recording.resume_from != nullptr && i < recording.resume_from->islands.size()) {
            recorded = recording.resume_from->islands[i];
        }
        islands[i].evaluator.emplace(objective, box.dimensions(), share, i, recorded, monitor);
    }
    parallelFor(islands.size(), [&](std::size_t i) {
        search(box, options, scramble({options.seed, i}), islands[i]);
    });
    return outcome(options, islands);
}

}  // namespace terrawalk
