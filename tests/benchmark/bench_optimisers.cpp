// The optimisers on fourteen shifted functions, every evaluation counted, and what they cost beside the
// function. Medians over the seeds.
//
//     bench_optimisers [--evaluations N] [--seeds N] [--shift-seed N] [--kinds isma,sma,...]
//
// cmaes is left out unless asked for: in a hundred dimensions its matrices take minutes.
// A shift seed that was not used while the rules were chosen tells what they are worth.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <vector>

#include "fusion/optimiser.hpp"
#include "fusion/test_functions.hpp"
#include "survey/parallel.hpp"

namespace {

using namespace terrawalk;

struct Case {
    TestFunction function;
    std::size_t dimensions;
};

const std::vector<Case> kCases{
    {TestFunction::Levy13, 2},      {TestFunction::Griewank, 12},    {TestFunction::Sphere, 5},
    {TestFunction::Ackley, 5},      {TestFunction::Rastrigin, 5},    {TestFunction::Rosenbrock, 5},
    {TestFunction::Sphere, 50},     {TestFunction::Ackley, 50},      {TestFunction::Rastrigin, 50},
    {TestFunction::Rosenbrock, 50}, {TestFunction::Sphere, 100},     {TestFunction::Ackley, 100},
    {TestFunction::Rastrigin, 100}, {TestFunction::Rosenbrock, 100},
};

/// Below this two results are equal: rounding of functions that add up hundreds of terms.
constexpr double kFloor = 1e-12;

struct Arguments {
    std::size_t evaluations = 100'000;
    std::size_t seeds = 10;
    std::uint64_t shift_seed = 20'260'101;
    std::vector<OptimiserKind> kinds{OptimiserKind::Isma, OptimiserKind::IsmaPrinted, OptimiserKind::Sma,
                                     OptimiserKind::Pso,  OptimiserKind::Ga,          OptimiserKind::Sa,
                                     OptimiserKind::Abc,  OptimiserKind::Sade};
};

std::vector<OptimiserKind> kindsOf(std::string_view list) {
    std::vector<OptimiserKind> kinds;
    while (!list.empty()) {
        const std::string_view word = list.substr(0, list.find(','));
        list.remove_prefix(std::min(list.size(), word.size() + 1));
        const auto* const known = std::find_if(kOptimiserNames.begin(), kOptimiserNames.end(),
                                               [&](const auto& entry) { return entry.second == word; });
        if (known == kOptimiserNames.end() || known->first == OptimiserKind::Nsga2) {
            fmt::print(stderr, "no optimiser of one loss is called {}\n", word);
            std::exit(2);
        }
        kinds.push_back(known->first);
    }
    return kinds;
}

Arguments argumentsOf(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string_view option = argv[i];
        const std::string_view value = argv[i + 1];
        if (option == "--kinds") {
            arguments.kinds = kindsOf(value);
            continue;
        }
        std::uint64_t number = 0;
        const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
        const bool whole = error == std::errc() && end == value.data() + value.size() && number > 0;
        if (whole && option == "--evaluations") {
            arguments.evaluations = number;
        } else if (whole && option == "--seeds") {
            arguments.seeds = number;
        } else if (whole && option == "--shift-seed") {
            arguments.shift_seed = number;
        } else {
            fmt::print(stderr, "cannot read {} {}\n", option, value);
            std::exit(2);
        }
    }
    return arguments;
}

OptimiserOptions optionsOf(OptimiserKind kind, std::size_t evaluations, std::uint64_t seed) {
    // One island: four short searches are no long one.
    return {.kind = kind, .generations = 0, .max_evaluations = evaluations, .seed = seed, .islands = 1};
}

double finalLoss(const Case& of, const Arguments& arguments, OptimiserKind kind, std::uint64_t seed) {
    const ShiftedFunction function = shifted(of.function, of.dimensions, arguments.shift_seed);
    SilentProgress silent;
    const auto result = optimise(objectiveOf(function), usualBox(of.function, of.dimensions),
                                 optionsOf(kind, arguments.evaluations, seed), silent, {});
    if (!result || result->evaluations != arguments.evaluations) {
        fmt::print(stderr, "{} failed\n", name(kind));
        std::exit(1);
    }
    return result->best_loss;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

/// Medians by case and kind.
std::vector<std::vector<double>> medians(const Arguments& arguments) {
    const std::size_t kinds = arguments.kinds.size();
    const std::size_t seeds = arguments.seeds;
    std::vector<double> finals(kCases.size() * kinds * seeds);
    parallelFor(finals.size(), [&](std::size_t k) {
        finals[k] = finalLoss(kCases[k / (kinds * seeds)], arguments, arguments.kinds[k / seeds % kinds],
                              1 + k % seeds);
    });
    std::vector<std::vector<double>> table(kCases.size());
    for (std::size_t k = 0; k < finals.size(); k += seeds) {
        const auto begin = finals.begin() + static_cast<std::ptrdiff_t>(k);
        table[k / (kinds * seeds)].push_back(median({begin, begin + static_cast<std::ptrdiff_t>(seeds)}));
    }
    return table;
}

/// Column of a kind; -1 where it did not run.
int columnOf(const Arguments& arguments, OptimiserKind kind) {
    const auto at = std::find(arguments.kinds.begin(), arguments.kinds.end(), kind);
    return at == arguments.kinds.end() ? -1 : static_cast<int>(at - arguments.kinds.begin());
}

void printMedians(const Arguments& arguments, const std::vector<std::vector<double>>& table) {
    fmt::print("{:<16}", "function");
    for (const OptimiserKind kind : arguments.kinds) fmt::print("{:>13}", name(kind));
    fmt::print("  best\n");
    for (std::size_t c = 0; c < kCases.size(); ++c) {
        fmt::print("{:<12}{:>4}", name(kCases[c].function), kCases[c].dimensions);
        for (const double value : table[c]) fmt::print("{:>13.2e}", value);
        const double least = *std::min_element(table[c].begin(), table[c].end());
        std::string winners;
        for (std::size_t k = 0; k < arguments.kinds.size(); ++k) {
            if (table[c][k] <= std::max(least, kFloor))
                winners += fmt::format(" {}", name(arguments.kinds[k]));
        }
        fmt::print(" {}\n", winners);
    }
}

void printComparisons(const Arguments& arguments, const std::vector<std::vector<double>>& table) {
    const int isma = columnOf(arguments, OptimiserKind::Isma);
    if (isma < 0) return;
    for (std::size_t k = 0; k < arguments.kinds.size(); ++k) {
        if (static_cast<int>(k) == isma) continue;
        int tenth = 0;
        int of_easier = 0;
        int no_worse = 0;
        for (std::size_t c = 0; c < kCases.size(); ++c) {
            const double ours = table[c][static_cast<std::size_t>(isma)];
            const double theirs = table[c][k];
            const bool hard = kCases[c].function == TestFunction::Rosenbrock && kCases[c].dimensions >= 50;
            const bool at_most_a_tenth = ours <= std::max(0.1 * theirs, kFloor);
            tenth += at_most_a_tenth ? 1 : 0;
            of_easier += at_most_a_tenth && !hard ? 1 : 0;
            no_worse += ours <= std::max(theirs, kFloor) ? 1 : 0;
        }
        fmt::print(
            "isma against {:<13} at most a tenth on {:>2} of 14 ({:>2} of the 12 that are not Rosenbrock 50, "
            "100); no worse on {:>2} of 14\n",
            name(arguments.kinds[k]), tenth, of_easier, no_worse);
    }
}

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Seconds for each evaluation beside those in the function itself.
double overhead_s(const Case& of, OptimiserKind kind, const Arguments& arguments) {
    const ShiftedFunction function = shifted(of.function, of.dimensions, arguments.shift_seed);
    Objective objective = objectiveOf(function);
    double in_function_s = 0.0;
    const LossFunction inner = objective.evaluate;
    const auto single = [&](std::span<const double> candidates, std::span<double> losses) {
        const Clock::time_point begin = Clock::now();
        inner(candidates, losses);
        in_function_s += secondsSince(begin);
    };
    objective.evaluate = single;
    SilentProgress silent;
    const Clock::time_point begin = Clock::now();
    (void)optimise(objective, usualBox(of.function, of.dimensions), optionsOf(kind, arguments.evaluations, 1),
                   silent, {});
    return (secondsSince(begin) - in_function_s) / static_cast<double>(arguments.evaluations);
}

void printOverheads(const Arguments& arguments) {
    constexpr int kRepeats = 5;
    const bool has_pso = columnOf(arguments, OptimiserKind::Pso) >= 0;
    fmt::print("\nnanoseconds for each evaluation beside the function, best of {} (share of pso's)\n",
               kRepeats);
    for (const Case& of : {Case{TestFunction::Levy13, 2}, Case{TestFunction::Griewank, 12},
                           Case{TestFunction::Sphere, 50}, Case{TestFunction::Sphere, 100}}) {
        std::vector<double> best(arguments.kinds.size(), std::numeric_limits<double>::infinity());
        // Side by side, so that a busy machine slows all alike.
        for (int repeat = 0; repeat < kRepeats; ++repeat) {
            for (std::size_t k = 0; k < best.size(); ++k) {
                if (arguments.kinds[k] == OptimiserKind::Cmaes) continue;  // matrices, another class
                best[k] = std::min(best[k], 1e9 * overhead_s(of, arguments.kinds[k], arguments));
            }
        }
        fmt::print("{:<12}{:>4}", name(of.function), of.dimensions);
        for (std::size_t k = 0; k < best.size(); ++k) {
            if (!std::isfinite(best[k])) continue;
            fmt::print("  {} {:.0f}", name(arguments.kinds[k]), best[k]);
            if (has_pso) {
                fmt::print(" ({:.2f})",
                           best[k] / best[static_cast<std::size_t>(columnOf(arguments, OptimiserKind::Pso))]);
            }
        }
        fmt::print("\n");
    }
}

}  // namespace

int main(int argc, char** argv) {
    const Arguments arguments = argumentsOf(argc, argv);
    fmt::print("{} evaluations, {} seeds, shift seed {}; medians of the final value\n", arguments.evaluations,
               arguments.seeds, arguments.shift_seed);
    const auto table = medians(arguments);
    printMedians(arguments, table);
    fmt::print("\nvalues below {:g} count as equal\n", kFloor);
    printComparisons(arguments, table);
    printOverheads(arguments);
}
