#include "app/pipeline/tune.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "fusion/random_numbers.hpp"

namespace terrawalk {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<std::size_t> allParts(const TunableProblem& problem) {
    std::vector<std::size_t> parts(problem.parts.size());
    std::iota(parts.begin(), parts.end(), std::size_t{0});
    return parts;
}

std::vector<double> lossOver(const TunableProblem& problem, std::span<const std::size_t> parts,
                             std::span<const double> candidate, const std::stop_token& stop) {
    std::vector<double> loss(problem.components.size());
    problem.losses(candidate, parts, loss, stop);
    return loss;
}

std::vector<std::vector<double>> lossOfEachPart(const TunableProblem& problem,
                                                std::span<const double> candidate,
                                                const std::stop_token& stop) {
    std::vector<std::vector<double>> losses;
    for (std::size_t i = 0; i < problem.parts.size(); ++i) {
        losses.push_back(lossOver(problem, std::span(&i, 1), candidate, stop));
    }
    return losses;
}

SearchBox boxOf(const TunableProblem& problem) {
    SearchBox box;
    for (const TunableParameter& parameter : problem.parameters) {
        box.lower.push_back(parameter.lower);
        box.upper.push_back(parameter.upper);
    }
    return box;
}

std::string lossText(const TunableProblem& problem, double loss, std::size_t parts) {
    std::string text = fmt::format("{:.4g}", loss);
    if (!problem.loss_unit.empty()) text += " " + problem.loss_unit;
    if (problem.squared_metres) text += fmt::format(" (RMSE {:.3f} m)", rootMean(loss, parts));
    return text;
}

/// Adds the least loss so far to what a search reports.
class BestLossProgress final : public Progress {
  public:
    BestLossProgress(Progress& parent, const TunableProblem& problem, std::size_t parts, std::string step)
        : parent_(parent), problem_(problem), parts_(parts), step_(std::move(step)) {}
    void report(double fraction, std::string_view) override {
        const double best = best_.load(std::memory_order_relaxed);
        parent_.report(fraction, std::isfinite(best)
                                     ? step_ + ", best loss " + lossText(problem_, best, parts_)
                                     : step_);
    }
    void message(Severity severity, std::string_view text) override { parent_.message(severity, text); }
    void offer(std::span<const double> losses) {
        const std::size_t m = problem_.components.size();
        for (std::size_t i = 0; i + m <= losses.size(); i += m) {
            const double loss = totalLoss(losses.subspan(i, m));
            double best = best_.load(std::memory_order_relaxed);
            while (loss < best && !best_.compare_exchange_weak(best, loss, std::memory_order_relaxed)) {
            }
        }
    }

  private:
    Progress& parent_;
    const TunableProblem& problem_;
    std::size_t parts_;
    std::string step_;
    std::atomic<double> best_{kInfinity};
};

/// One search over some of the parts.
struct Search {
    std::size_t number = 0;  ///< in the record
    std::vector<std::size_t> parts;
    OptimiserOptions options;
    std::string step;
};

OptimiserOptions wholeBudget(const TuneOptions& options) {
    OptimiserOptions search{.kind = options.optimiser,
                            .population = options.population,
                            .generations = options.iterations,
                            .seed = options.seed,
                            .islands = 1};
    if (options.restarts > 1) {
        // Islands share a budget out; restarts have one each.
        search.max_evaluations = options.restarts * evaluationLimit(search);
        search.generations = 0;
        search.islands = options.restarts;
    }
    return search;
}

/// The searches with a group left out cost together about as much as the search over all.
OptimiserOptions budgetForLeftOut(const TuneOptions& options, std::size_t groups, std::size_t group) {
    constexpr std::size_t kPopulation = 30;
    constexpr std::size_t kFewestRounds = 5;
    OptimiserOptions search = wholeBudget(options);
    const std::size_t whole = evaluationLimit(search);
    search.population = std::min(options.population, kPopulation);
    search.generations = 0;
    search.max_evaluations = std::min(whole, std::max(whole / groups, kFewestRounds * search.population));
    search.islands = 1;
    search.seed = scramble({options.seed, group + 1});
    return search;
}

std::size_t groupCount(const TunableProblem& problem) {
    const std::size_t parts = problem.parts.size();
    return problem.left_out_groups == 0 ? parts : std::min(parts, problem.left_out_groups);
}

std::vector<Search> plannedSearches(const TunableProblem& problem, const TuneOptions& options) {
    const std::vector<std::size_t> all = allParts(problem);
    std::vector<Search> searches{{0, all, wholeBudget(options), "tuning"}};
    const std::size_t groups = groupCount(problem);
    if (groups < 2) return searches;
    for (std::size_t group = 0; group < groups; ++group) {
        std::vector<std::size_t> others;
        std::vector<std::string> left_out;
        for (const std::size_t part : all) {
            if (part % groups == group) {
                left_out.push_back(problem.parts[part].name);
            } else {
                others.push_back(part);
            }
        }
        searches.push_back({group + 1, std::move(others), budgetForLeftOut(options, groups, group),
                            fmt::format("tuning without {}", fmt::join(left_out, ", "))});
    }
    return searches;
}

/// The best of a search, or the values that it started from where it found none better.
struct SearchOutcome {
    std::vector<double> best;
    bool improved = false;
    OptimiserResult found;
};

Result<SearchOutcome> run(const TunableProblem& problem, const Search& search, Progress& progress,
                          const std::stop_token& stop, const TuneRecording& recording) {
    BestLossProgress best_progress(progress, problem, search.parts.size(), search.step);
    const Objective objective{.evaluate =
                                  [&](std::span<const double> candidates, std::span<double> losses) {
                                      problem.losses(candidates, search.parts, losses, stop);
                                      if (!stop.stop_requested()) best_progress.offer(losses);
                                  },
                              .losses = problem.components.size(),
                              .fingerprint = scramble({problem.fingerprint, search.number})};
    const SearchBox box = boxOf(problem);
    Recording of_search;
    if (recording.resume_from != nullptr && search.number < recording.resume_from->size()) {
        of_search.resume_from = &(*recording.resume_from)[search.number];
        for (const auto& losses : of_search.resume_from->islands) best_progress.offer(losses);
    }
    if (recording.on_search) {
        recording.on_search(search.number, searchFingerprint(objective, box, search.options));
    }
    if (recording.on_losses) {
        of_search.on_losses = [&](std::size_t island, std::span<const double> losses) {
            recording.on_losses(search.number, island, losses);
        };
    }
    auto found = optimise(objective, box, search.options, best_progress, stop, of_search);
    if (!found) return tl::unexpected(found.error());
    if (found->cancelled) return cancelled();
    const std::vector<double> start = problem.start();
    const bool improved = found->best_loss < totalLoss(lossOver(problem, search.parts, start, stop));
    if (stop.stop_requested()) return cancelled();
    return SearchOutcome{improved ? found->best : start, improved, std::move(*found)};
}

/// Every place at which the effect of a parameter is looked at, row after row, and the loss there.
struct Profile {
    std::vector<double> places;
    std::vector<double> losses;
};

Profile profileOf(const TunableProblem& problem, std::size_t parameter, std::span<const double> best,
                  const std::stop_token& stop) {
    const TunableParameter& p = problem.parameters[parameter];
    Profile profile;
    std::vector<double> candidates;
    for (std::size_t k = 0; k < problem.profile_points; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(problem.profile_points - 1);
        profile.places.push_back(p.lower + share * (p.upper - p.lower));
        candidates.insert(candidates.end(), best.begin(), best.end());
        candidates[candidates.size() - best.size() + parameter] = profile.places.back();
    }
    const std::size_t m = problem.components.size();
    std::vector<double> losses(problem.profile_points * m);
    problem.losses(candidates, allParts(problem), losses, stop);
    for (std::size_t k = 0; k < problem.profile_points; ++k) {
        profile.losses.push_back(totalLoss(std::span(losses).subspan(k * m, m)));
    }
    return profile;
}

/// From `x` outwards to the last places in a row at which the loss is as good as the least.
std::pair<double, double> flatRange(const Profile& profile, double x, double least) {
    const double limit = least + kFlatShare * std::abs(least);
    double from = x;
    double to = x;
    for (std::size_t k = 0; k < profile.places.size(); ++k) {
        if (profile.places[k] <= x) continue;
        if (!(profile.losses[k] <= limit)) break;
        to = profile.places[k];
    }
    for (std::size_t k = profile.places.size(); k-- > 0;) {
        if (profile.places[k] >= x) continue;
        if (!(profile.losses[k] <= limit)) break;
        from = profile.places[k];
    }
    return {from, to};
}

Bound boundAt(const TunableParameter& parameter, double x) {
    const double close = 1e-3 * (parameter.upper - parameter.lower);
    if (x <= parameter.lower + close) return Bound::Lower;
    if (x >= parameter.upper - close) return Bound::Upper;
    return Bound::None;
}

std::string shortNumber(double value) {
    return fmt::format("{:.3g}", value);
}

TunedParameter tunedParameter(const TunableParameter& parameter, double after, const Profile& profile,
                              double least) {
    TunedParameter tuned{.name = parameter.name,
                         .before = parameter.value(parameter.start),
                         .after = parameter.value(after),
                         .lower = parameter.value(parameter.lower),
                         .upper = parameter.value(parameter.upper),
                         .on_bound = boundAt(parameter, after)};
    for (const TunedSetting& setting : parameter.settings) {
        tuned.settings.push_back({setting.key, fmt::format("{}", setting.base * tuned.before),
                                  fmt::format("{}", setting.base * tuned.after)});
    }
    const auto [from, to] = flatRange(profile, after, least);
    tuned.flat_from = parameter.value(from);
    tuned.flat_to = parameter.value(to);
    const double whole = std::min(parameter.notableRange(), parameter.upper - parameter.lower);
    // The range may end anywhere up to the next place that was looked at.
    tuned.identified = to - from < whole - 1e-9;
    return tuned;
}

void addSpread(std::vector<TunedParameter>& tuned, const TunableProblem& problem,
               const std::vector<SearchOutcome>& left_out) {
    for (std::size_t i = 0; i < tuned.size(); ++i) {
        for (const SearchOutcome& outcome : left_out) {
            const double value = problem.parameters[i].value(outcome.best[i]);
            tuned[i].left_out_least = std::min(value, tuned[i].left_out_least.value_or(value));
            tuned[i].left_out_greatest = std::max(value, tuned[i].left_out_greatest.value_or(value));
        }
    }
}

HeldOutComparison compareHeldOut(const std::vector<PartOutcome>& parts, std::size_t groups,
                                 const OptimiserOptions& budget) {
    HeldOutComparison held{
        .groups = groups, .evaluations_each = evaluationLimit(budget), .population = budget.population};
    std::vector<double> gains;
    for (const PartOutcome& part : parts) {
        const double before = totalLoss(part.before);
        const double after = totalLoss(part.left_out);
        held.before += before;
        held.after += after;
        gains.push_back(before - after);
    }
    const auto n = static_cast<double>(gains.size());
    const double mean = (held.before - held.after) / n;
    double squares = 0.0;
    for (const double gain : gains) squares += (gain - mean) * (gain - mean);
    held.gain_standard_error = std::sqrt(n / (n - 1.0) * squares);
    return held;
}

bool holdsOutBetter(const HeldOutComparison& held) {
    if (!std::isfinite(held.before)) return std::isfinite(held.after);
    return held.before - held.after > held.gain_standard_error;
}

std::string decisionText(const TunableProblem& problem, const TuneOutcome& outcome) {
    if (!outcome.improved) {
        return "The search found nothing better than the values that it started from; these stay.";
    }
    if (!outcome.held_out) {
        return "There is one part only, so nothing can be left out to test the tuned values on: the default "
               "is not replaced by them.";
    }
    const HeldOutComparison& held = *outcome.held_out;
    const std::size_t n = problem.parts.size();
    const std::string figures = fmt::format(
        "on parts left out of the tuning the loss goes from {} to {}, a gain of {:.3g} with a standard error "
        "of {:.3g}",
        lossText(problem, held.before, n), lossText(problem, held.after, n), held.before - held.after,
        held.gain_standard_error);
    return outcome.holds_out_better
               ? "The tuned values hold out better than those before: " + figures + "."
               : "The tuned values do not hold out better than those before: " + figures +
                     ". `process --tune` does not adopt them.";
}

std::vector<std::string> warningsOf(const std::vector<TunedParameter>& parameters) {
    std::vector<std::string> warnings;
    for (const TunedParameter& p : parameters) {
        if (p.on_bound != Bound::None) {
            warnings.push_back(
                fmt::format("{} ended on its {} bound {}: the data ask for more than the box "
                            "allows, or say nothing of it",
                            p.name, p.on_bound == Bound::Lower ? "lower" : "upper",
                            shortNumber(p.on_bound == Bound::Lower ? p.lower : p.upper)));
        }
        if (!p.identified) {
            warnings.push_back(
                fmt::format("the data cannot tell {} apart from {} to {}: the loss changes by less than {:g} "
                            "% in between",
                            p.name, shortNumber(p.flat_from), shortNumber(p.flat_to), 100.0 * kFlatShare));
        }
    }
    return warnings;
}

}  // namespace

double totalLoss(std::span<const double> components) {
    const double sum = std::accumulate(components.begin(), components.end(), 0.0);
    return std::isnan(sum) ? kInfinity : sum;
}

double rootMean(double loss, std::size_t parts) {
    return std::sqrt(loss / static_cast<double>(parts));
}

TuneOptions usedOptions(const TunableProblem& problem, TuneOptions options) {
    if (options.population == 0) options.population = problem.usual_population;
    if (options.iterations == 0) options.iterations = problem.usual_iterations;
    return options;
}

Result<TuneOutcome> tune(const TunableProblem& problem, const PipelineConfig& config,
                         const TuneOptions& asked, Progress& progress, std::stop_token stop,
                         const TuneRecording& recording) {
    const TuneOptions options = usedOptions(problem, asked);
    const std::vector<Search> searches = plannedSearches(problem, options);
    const std::size_t profiles = problem.parameters.size() * problem.profile_points;
    std::size_t planned = profiles;
    for (const Search& search : searches) planned += evaluationLimit(search.options);
    std::size_t done = 0;
    std::vector<SearchOutcome> outcomes;
    for (const Search& search : searches) {
        const auto share = [&](std::size_t evaluations) {
            return static_cast<double>(evaluations) / static_cast<double>(planned);
        };
        const std::size_t end = done + evaluationLimit(search.options);
        PartialProgress partial(progress, share(done), share(end));
        auto outcome = run(problem, search, partial, stop, recording);
        if (!outcome) return tl::unexpected(outcome.error());
        outcomes.push_back(std::move(*outcome));
        done = end;
    }
    const SearchOutcome whole = std::move(outcomes.front());
    outcomes.erase(outcomes.begin());

    TuneOutcome outcome{.options = options,
                        .method = problem.method,
                        .loss_meaning = problem.loss_meaning,
                        .loss_unit = problem.loss_unit,
                        .components = problem.components,
                        .squared_metres = problem.squared_metres,
                        .marks = problem.marks,
                        .before = lossOver(problem, allParts(problem), problem.start(), stop),
                        .after = lossOver(problem, allParts(problem), whole.best, stop),
                        .improved = whole.improved,
                        .convergence = whole.found.convergence,
                        .search_notes = whole.found.notes,
                        .search_evaluations = whole.found.evaluations};
    const auto before = lossOfEachPart(problem, problem.start(), stop);
    const auto after = lossOfEachPart(problem, whole.best, stop);
    for (std::size_t i = 0; i < problem.parts.size(); ++i) {
        PartOutcome part{problem.parts[i], before[i], after[i], {}};
        if (!outcomes.empty()) {
            part.left_out = lossOver(problem, std::span(&i, 1), outcomes[i % outcomes.size()].best, stop);
        }
        outcome.parts.push_back(std::move(part));
    }
    for (const SearchOutcome& left_out : outcomes) {
        outcome.held_out_evaluations += left_out.found.evaluations;
    }
    for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
        progress.report(
            1.0 - static_cast<double>(profiles - outcome.profile_evaluations) / static_cast<double>(planned),
            "looking at the effect of " + problem.parameters[i].name);
        const Profile profile = profileOf(problem, i, whole.best, stop);
        if (stop.stop_requested()) return cancelled();
        outcome.profile_evaluations += profile.places.size();
        outcome.parameters.push_back(
            tunedParameter(problem.parameters[i], whole.best[i], profile, totalLoss(outcome.after)));
    }
    addSpread(outcome.parameters, problem, outcomes);
    if (!outcomes.empty()) {
        outcome.held_out = compareHeldOut(outcome.parts, outcomes.size(), searches.back().options);
        outcome.holds_out_better = outcome.improved && holdsOutBetter(*outcome.held_out);
    }
    if (stop.stop_requested()) return cancelled();
    outcome.decision = decisionText(problem, outcome);
    outcome.warnings = warningsOf(outcome.parameters);
    auto tuned = withCandidate(problem, config, whole.best);
    if (!tuned) return tl::unexpected(tuned.error());
    outcome.tuned = std::move(*tuned);
    progress.report(1.0, "tuned");
    return outcome;
}

}  // namespace terrawalk
