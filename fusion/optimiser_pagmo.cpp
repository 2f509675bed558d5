#include "fusion/optimiser_pagmo.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/bee_colony.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/algorithms/pso_gen.hpp>
#include <pagmo/algorithms/sade.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/algorithms/simulated_annealing.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/types.hpp>
#include <utility>

#include "fusion/random_numbers.hpp"

namespace terrawalk {

namespace {

using pagmo::vector_double;

/// Ends an algorithm from within: pagmo knows no limit of evaluations and no stop request.
struct SearchIsOver : std::exception {};

/// Infinite losses would make differences that are not numbers.
double finite(double loss) {
    constexpr double kLargest = 1e200;
    return std::clamp(loss, -kLargest, kLargest);
}

/// The evaluator as pagmo's user-defined problem. pagmo copies it freely; the evaluator stays where it is.
struct EvaluatorProblem {
    CandidateEvaluator* evaluator = nullptr;
    const SearchBox* box = nullptr;
    ParetoFront* front = nullptr;  ///< set: pagmo sees all losses, not their sum

    [[nodiscard]] vector_double losses(const vector_double& candidates) const {
        const EvaluatedLosses found = evaluator->evaluate(candidates);
        const std::size_t asked = candidates.size() / box->dimensions();
        if (front != nullptr) addToFront(candidates, found.losses);
        if (found.sums.size() < asked) throw SearchIsOver();
        const std::span<const double> given = front != nullptr ? found.losses : found.sums;
        vector_double values(given.size());
        std::transform(given.begin(), given.end(), values.begin(), finite);
        return values;
    }
    [[nodiscard]] vector_double fitness(const vector_double& candidate) const { return losses(candidate); }
    [[nodiscard]] std::pair<vector_double, vector_double> get_bounds() const {
        return {box->lower, box->upper};
    }
    [[nodiscard]] vector_double::size_type get_nobj() const {
        return front != nullptr ? evaluator->lossesEach() : 1;
    }
    void addToFront(std::span<const double> candidates, std::span<const double> found) const {
        const std::size_t d = box->dimensions();
        const std::size_t m = evaluator->lossesEach();
        for (std::size_t i = 0; i < found.size() / m; ++i) {
            front->add(candidates.subspan(i * d, d), found.subspan(i * m, m));
        }
    }
    template <typename Archive>
    void serialize(Archive&, unsigned) {}
};

/// Hands a whole generation to the evaluator.
struct GenerationEvaluator {
    vector_double operator()(const pagmo::problem& problem, const vector_double& candidates) const {
        return problem.extract<EvaluatorProblem>()->losses(candidates);
    }
    template <typename Archive>
    void serialize(Archive&, unsigned) {}
};

bool handsOverGenerations(OptimiserKind kind) {
    return kind == OptimiserKind::Pso || kind == OptimiserKind::Nsga2;
}

/// Spread of the losses that are numbers; 1 where there is none.
double lossSpread(const pagmo::population& population) {
    std::vector<double> losses;
    for (const vector_double& f : population.get_f()) {
        if (std::abs(f.front()) < 1e200) losses.push_back(f.front());
    }
    if (losses.empty()) return 1.0;
    const auto [least, greatest] = std::minmax_element(losses.begin(), losses.end());
    return *greatest > *least ? *greatest - *least : 1.0;
}

/// Corana's annealing from the spread of the start's losses down to a ten millionth of it, in steps that
/// spend what evaluations are left.
pagmo::algorithm annealing(const pagmo::population& start, const CandidateEvaluator& evaluator,
                           unsigned seed) {
    constexpr unsigned kRounds = 20;  // between changes of the range; pagmo's own choice
    constexpr unsigned kSteps = 100;
    const double spread = lossSpread(start);
    const std::size_t left = evaluator.limit() - evaluator.evaluations();
    const std::size_t each = kRounds * evaluator.dimensions();
    const auto ranges = static_cast<unsigned>(std::clamp<std::size_t>(left / (kSteps * each), 1, 1'000'000));
    const auto steps = static_cast<unsigned>(
        std::clamp<std::size_t>((left + each * ranges - 1) / (each * ranges), 1, kSteps + kSteps));
    return pagmo::algorithm(
        pagmo::simulated_annealing(spread, 1e-7 * spread, steps, ranges, kRounds, 1.0, seed));
}

double narrowest(const SearchBox& box) {
    double width = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < box.dimensions(); ++j) {
        if (box.upper[j] > box.lower[j]) width = std::min(width, box.upper[j] - box.lower[j]);
    }
    return std::isfinite(width) ? width : 1.0;
}

pagmo::algorithm algorithmOf(OptimiserKind kind, const SearchBox& box, const pagmo::population& start,
                             const CandidateEvaluator& evaluator, unsigned seed) {
    // The evaluator ends the search, so generations need no limit and tolerances are as small as they work.
    constexpr unsigned kForever = 2'000'000'000;
    switch (kind) {
        case OptimiserKind::Pso: {
            pagmo::pso_gen swarm(kForever, 0.7298, 2.05, 2.05, 0.5, 5, 2, 4, false, seed);
            swarm.set_bfe(pagmo::bfe(GenerationEvaluator{}));
            return pagmo::algorithm(swarm);
        }
        case OptimiserKind::Nsga2: {
            pagmo::nsga2 pareto(kForever, 0.95, 10.0, 0.01, 50.0, seed);
            pareto.set_bfe(pagmo::bfe(GenerationEvaluator{}));
            return pagmo::algorithm(pareto);
        }
        case OptimiserKind::Ga:
            return pagmo::algorithm(pagmo::sga(kForever, 0.9, 1.0, 0.02, 1.0, 2, "exponential", "polynomial",
                                               "tournament", seed));
        case OptimiserKind::Sa:
            return annealing(start, evaluator, seed);
        case OptimiserKind::Abc:
            return pagmo::algorithm(pagmo::bee_colony(kForever, 20, seed));
        case OptimiserKind::Cmaes:
            return pagmo::algorithm(
                pagmo::cmaes(kForever, -1, -1, -1, -1, 0.5, 0.0, 1e-13 * narrowest(box), false, true, seed));
        case OptimiserKind::Sade:
        default:
            return pagmo::algorithm(pagmo::sade(kForever, 2, 1, 0.0, 0.0, false, seed));
    }
}

/// As good in every loss.
bool covers(std::span<const double> a, std::span<const double> b) {
    return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) { return x <= y; });
}

}  // namespace

void ParetoFront::add(std::span<const double> candidate, std::span<const double> losses) {
    if (!std::all_of(losses.begin(), losses.end(), [](double loss) { return std::isfinite(loss); })) return;
    const auto beaten = [&](const FrontPoint& point) {
        return covers(point.losses, losses);
    };
    if (std::any_of(points_.begin(), points_.end(), beaten)) return;
    std::erase_if(points_, [&](const FrontPoint& point) { return covers(losses, point.losses); });
    points_.push_back({{candidate.begin(), candidate.end()}, {losses.begin(), losses.end()}});
}

PagmoOutcome pagmoSearch(OptimiserKind kind, const SearchBox& box, std::size_t population, std::uint64_t seed,
                         CandidateEvaluator& evaluator) {
    PagmoOutcome outcome;
    try {
        const pagmo::problem problem(
            EvaluatorProblem{&evaluator, &box, kind == OptimiserKind::Nsga2 ? &outcome.front : nullptr});
        for (std::uint64_t start = 0; !evaluator.isOver(); ++start) {
            const auto start_seed = static_cast<unsigned>(scramble({seed, start, 0}));
            const auto search_seed = static_cast<unsigned>(scramble({seed, start, 1}));
            outcome.restarts = start;
            const pagmo::population individuals =
                handsOverGenerations(kind)
                    ? pagmo::population(problem, pagmo::bfe(GenerationEvaluator{}), population, start_seed)
                    : pagmo::population(problem, population, start_seed);
            (void)algorithmOf(kind, box, individuals, evaluator, search_seed).evolve(individuals);
        }
    } catch (const SearchIsOver&) {
        // As every search ends that has spent its evaluations.
    } catch (const std::exception& refusal) {
        outcome.error = refusal.what();
    }
    return outcome;
}

}  // namespace terrawalk
