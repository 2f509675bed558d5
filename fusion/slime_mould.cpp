#include "fusion/slime_mould.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "fusion/good_points.hpp"
#include "fusion/random_numbers.hpp"

namespace terrawalk {

namespace {

constexpr double kRestart = 0.03;       // u of eq 21
constexpr double kLargestShare = 1e-4;  // 1 - s stays below 1 by this, where artanh is finite

/// Candidates and their losses.
struct Population {
    std::size_t d = 0;
    std::vector<double> x;       // n x d
    std::vector<double> losses;  // n
    [[nodiscard]] std::size_t size() const { return losses.size(); }
    [[nodiscard]] double* at(std::size_t i) { return x.data() + i * d; }
    [[nodiscard]] const double* at(std::size_t i) const { return x.data() + i * d; }
};

double clamped(double value, double lower, double upper) {
    return std::min(std::max(value, lower), upper);
}

/// From 64 random bits three whole numbers below n < 2^21, by the upper part of a product.
struct ThreeIndices {
    std::size_t a, b, c;
};
ThreeIndices threeIndices(std::uint64_t bits, std::size_t n) {
    constexpr std::uint64_t mask = (1U << 21U) - 1U;
    return {((bits & mask) * n) >> 21U, (((bits >> 21U) & mask) * n) >> 21U, ((bits >> 42U) * n) >> 22U};
}

/// Three different ones that are not i; n > 3.
ThreeIndices threeOthers(QuickRandomNumbers& random, std::size_t n, std::size_t i) {
    for (;;) {
        const ThreeIndices k = threeIndices(random.bits(), n);
        if (k.a != i && k.b != i && k.c != i && k.a != k.b && k.a != k.c && k.b != k.c) return k;
    }
}

/// Ranks: the places of the population from the best to the worst; equal ones by place.
void sortByLoss(const Population& population, std::vector<std::size_t>& order) {
    order.resize(population.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const double loss_a = population.losses[a];
        const double loss_b = population.losses[b];
        return loss_a < loss_b || (loss_a == loss_b && a < b);
    });
}

/// W - 1 for r = 1 of an individual: above nothing for the better half, below for the others.
double foodWeight(double loss, double best, double worst, bool better_half) {
    const double spread = best - worst;
    if (!std::isfinite(spread) || spread == 0.0) return 0.0;
    const double scent = std::log10((best - loss) / spread + 1.0);
    return better_half ? scent : -scent;
}

Population randomStart(const SearchBox& box, std::size_t n, QuickRandomNumbers& random,
                       CandidateEvaluator& evaluator) {
    Population start{.d = box.dimensions(), .x = {}, .losses = {}};
    start.x.resize(n * start.d);
    for (std::size_t k = 0; k < start.x.size(); ++k) {
        const std::size_t j = k % start.d;
        start.x[k] = random.uniform(box.lower[j], box.upper[j]);
    }
    const EvaluatedLosses found = evaluator.evaluate(start.x);
    start.losses.assign(found.sums.begin(), found.sums.end());
    return start;
}

/// Good points and their opposites; the better half of both. Fewer where the evaluations end.
Population goodStart(const SearchBox& box, std::size_t n, CandidateEvaluator& evaluator) {
    const std::size_t d = box.dimensions();
    std::vector<double> both = goodPoints(n, d);
    both.resize(2 * n * d);
    for (std::size_t k = 0; k < n * d; ++k) {
        const double lower = box.lower[k % d];
        const double upper = box.upper[k % d];
        both[k] = clamped(lower + both[k] * (upper - lower), lower, upper);
        both[n * d + k] = clamped(lower + upper - both[k], lower, upper);
    }
    const EvaluatedLosses found = evaluator.evaluate(both);
    Population all{.d = d, .x = std::move(both), .losses = {found.sums.begin(), found.sums.end()}};
    std::vector<std::size_t> order;
    sortByLoss(all, order);
    order.resize(std::min(order.size(), n));
    Population start{.d = d, .x = {}, .losses = {}};
    for (const std::size_t i : order) {
        start.x.insert(start.x.end(), all.at(i), all.at(i) + d);
        start.losses.push_back(all.losses[i]);
    }
    return start;
}

double shareSpent(const CandidateEvaluator& evaluator) {
    return static_cast<double>(evaluator.evaluations()) / static_cast<double>(evaluator.limit());
}

/// How far the two moves reach: vb in +-a, vc in +-b.
struct Reach {
    double a, b;
};
Reach reach(double share) {
    const double b = 1.0 - share;
    return {std::atanh(std::min(b, 1.0 - kLargestShare)), b};
}

// ------------------------------------------------------------------------------------ as published

/// Moves everybody by eq 21 and evaluates them. False when the search is over.
bool publishedMove(const SearchBox& box, Population& population, QuickRandomNumbers& random,
                   CandidateEvaluator& evaluator) {
    const std::size_t n = population.size();
    const std::size_t d = population.d;
    std::vector<std::size_t> order;
    sortByLoss(population, order);
    std::vector<double> weights(n);
    for (std::size_t rank = 0; rank < n; ++rank) {
        weights[order[rank]] = foodWeight(population.losses[order[rank]], population.losses[order.front()],
                                          population.losses[order.back()], rank < n / 2);
    }
    const std::vector<double> best = evaluator.best();
    const Reach r = reach(shareSpent(evaluator));
    std::vector<double> moved(population.x.size());
    for (std::size_t i = 0; i < n; ++i) {
        double* const to = moved.data() + i * d;
        if (random.chance(kRestart)) {
            for (std::size_t j = 0; j < d; ++j) to[j] = random.uniform(box.lower[j], box.upper[j]);
            continue;
        }
        const double p = std::tanh(std::abs(population.losses[i] - evaluator.bestLoss()));
        for (std::size_t j = 0; j < d; ++j) {
            if (random.chance(p)) {
                const ThreeIndices k = threeIndices(random.bits(), n);
                const double weight = 1.0 + random.uniform() * weights[i];
                to[j] = best[j] +
                        random.uniform(-r.a, r.a) * (weight * population.at(k.a)[j] - population.at(k.b)[j]);
            } else {
                to[j] = random.uniform(-r.b, r.b) * population.at(i)[j];
            }
            to[j] = clamped(to[j], box.lower[j], box.upper[j]);
        }
    }
    const EvaluatedLosses found = evaluator.evaluate(moved);
    population.x = std::move(moved);
    population.losses.assign(found.sums.begin(), found.sums.end());
    return !evaluator.isOver();
}

/// Eq 25 with fitness = -loss.
std::vector<double> crossoverRates(const std::vector<double>& losses) {
    constexpr double kLower = 0.1;
    constexpr double kUpper = 0.6;
    const auto [best, worst] = std::minmax_element(losses.begin(), losses.end());
    const double mean =
        std::accumulate(losses.begin(), losses.end(), 0.0) / static_cast<double>(losses.size());
    std::vector<double> rates(losses.size(), kLower);
    for (std::size_t i = 0; i < losses.size(); ++i) {
        if (losses[i] < mean && std::isfinite(mean)) {
            rates[i] += (kUpper - kLower) * (*worst - losses[i]) / (*worst - *best);
        }
    }
    return rates;
}

/// Eqs 23-26: a trial vector for everybody, kept where it is better. False when the search is over.
bool printedTrials(const SearchBox& box, Population& population, QuickRandomNumbers& random,
                   CandidateEvaluator& evaluator) {
    constexpr double kScale = 0.5;
    const std::size_t n = population.size();
    const std::size_t d = population.d;
    const std::vector<double> rates = crossoverRates(population.losses);
    std::vector<double> trials(population.x);
    for (std::size_t i = 0; i < n; ++i) {
        const ThreeIndices k = threeOthers(random, n, i);
        const std::size_t forced = random.index(d);
        for (std::size_t j = 0; j < d; ++j) {
            if (!random.chance(rates[i]) && j != forced) continue;
            const double mutated =
                population.at(k.a)[j] + kScale * (population.at(k.b)[j] - population.at(k.c)[j]);
            trials[i * d + j] = clamped(mutated, box.lower[j], box.upper[j]);
        }
    }
    const EvaluatedLosses found = evaluator.evaluate(trials);
    for (std::size_t i = 0; i < found.sums.size(); ++i) {
        if (!(found.sums[i] < population.losses[i])) continue;
        std::copy_n(trials.data() + i * d, d, population.at(i));
        population.losses[i] = found.sums[i];
    }
    return !evaluator.isOver();
}

// ------------------------------------------------------------------------------------ the form to use

/// What an individual crosses over with; it passes on what brought a gain.
struct Control {
    double scale = 0.5;        // F
    double rate = 0.9;         // CR
    bool exponential = false;  // a run of neighbouring dimensions instead of each by itself
};

/// The improved algorithm between two generations.
class ImprovedSlimeMould {
  public:
    ImprovedSlimeMould(const SearchBox& box, std::size_t population, std::uint64_t seed,
                       CandidateEvaluator& evaluator)
        : box_(box),
          random_({seed, kStream}),
          evaluator_(evaluator),
          largest_(population),
          population_(goodStart(box, population, evaluator)),
          controls_(population_.size()) {
        for (Control& control : controls_) control.exponential = random_.chance(0.5);
    }

    void run() {
        while (!evaluator_.isOver()) {
            shrink();
            makeTrials();
            select();
        }
    }

  private:
    static constexpr std::uint64_t kStream = 1;
    static constexpr std::size_t kSmallest = 10;
    static constexpr double kRenewal = 0.1;
    static constexpr double kSlimeMouldShare = 0.1;

    /// Lets the worst leave; afterwards the population stands in the order of its losses.
    void shrink() {
        const double share = shareSpent(evaluator_);
        const double smallest = static_cast<double>(std::min(kSmallest, largest_));
        const auto n = static_cast<std::size_t>(
            std::lround(static_cast<double>(largest_) - (static_cast<double>(largest_) - smallest) * share));
        sortByLoss(population_, order_);
        order_.resize(std::min(n, order_.size()));
        kept_.x.resize(order_.size() * population_.d);
        kept_.losses.resize(order_.size());
        kept_controls_.resize(order_.size());
        for (std::size_t rank = 0; rank < order_.size(); ++rank) {
            const std::size_t i = order_[rank];
            std::copy_n(population_.at(i), population_.d, kept_.at(rank));
            kept_.losses[rank] = population_.losses[i];
            kept_controls_[rank] = controls_[i];
        }
        std::swap(population_, kept_);
        std::swap(controls_, kept_controls_);
    }

    void makeTrials() {
        const std::size_t n = population_.size();
        reach_ = reach(shareSpent(evaluator_));
        trials_.resize(n * population_.d);
        trial_controls_ = controls_;
        for (std::size_t i = 0; i < n; ++i) {
            Control& control = trial_controls_[i];
            if (random_.chance(kRenewal)) control.scale = 0.1 + 0.9 * random_.uniform();
            if (random_.chance(kRenewal)) control.rate = random_.uniform();
            if (random_.chance(kRenewal)) control.exponential = random_.chance(0.5);
            chooseCrossed(control);
            double* const trial = trials_.data() + i * population_.d;
            if (!random_.chance(kSlimeMouldShare)) {
                differentialTrial(i, trial);
            } else if (random_.chance(kRestart)) {
                restartTrial(i, trial);
            } else {
                slimeMouldTrial(i, trial);
            }
        }
    }

    /// Which dimensions come from the donor; one at least.
    void chooseCrossed(const Control& control) {
        const std::size_t d = population_.d;
        crossed_.assign(d + 1, 0);
        std::size_t j = random_.index(d);
        crossed_[j] = 1;
        if (control.exponential) {
            for (std::size_t length = 1; length < d && random_.chance(control.rate); ++length) {
                j = j + 1 == d ? 0 : j + 1;
                crossed_[j] = 1;
            }
            return;
        }
        const auto threshold = static_cast<std::uint64_t>(control.rate * 0x1.0p32);
        for (std::size_t k = 0; k < d; k += 2) {
            const std::uint64_t bits = random_.bits();
            crossed_[k] |= static_cast<std::uint8_t>((bits & 0xffffffffU) < threshold);
            crossed_[k + 1] |= static_cast<std::uint8_t>((bits >> 32U) < threshold);
        }
    }

    void differentialTrial(std::size_t i, double* trial) {
        const ThreeIndices k = threeOthers(random_, population_.size(), i);
        const double* const x = population_.at(i);
        const double* const a = population_.at(k.a);
        const double* const b = population_.at(k.b);
        const double* const c = population_.at(k.c);
        const double scale = trial_controls_[i].scale;
        for (std::size_t j = 0; j < population_.d; ++j) {
            const double donor = clamped(a[j] + scale * (b[j] - c[j]), box_.lower[j], box_.upper[j]);
            trial[j] = crossed_[j] != 0 ? donor : x[j];
        }
    }

    void restartTrial(std::size_t i, double* trial) {
        const double* const x = population_.at(i);
        for (std::size_t j = 0; j < population_.d; ++j) {
            trial[j] = crossed_[j] != 0 ? random_.uniform(box_.lower[j], box_.upper[j]) : x[j];
        }
    }

    void slimeMouldTrial(std::size_t i, double* trial) {
        const std::size_t n = population_.size();
        const double* const x = population_.at(i);
        const double* const best = population_.at(0);
        const double best_loss = population_.losses.front();
        const double worst_loss = population_.losses.back();
        const double spread = worst_loss - best_loss;
        const double distance = population_.losses[i] - best_loss;
        const double scent = foodWeight(population_.losses[i], best_loss, worst_loss, i < n / 2);
        // A population of equal losses, or one that is infinite and so tells no distance.
        const double p = spread > 0.0 && std::isfinite(spread) ? std::tanh(distance / spread) : 0.0;
        for (std::size_t j = 0; j < population_.d; ++j) {
            if (crossed_[j] == 0) {
                trial[j] = x[j];
                continue;
            }
            const ThreeIndices k = threeIndices(random_.bits(), n);
            const double a = population_.at(k.a)[j];
            const double b = population_.at(k.b)[j];
            const std::uint64_t bits = random_.bits();
            const double along = static_cast<double>(bits >> 32U) * 0x1.0p-31 - 1.0;
            if (random_.chance(p)) {
                const double weight = 1.0 + static_cast<double>(bits & 0xffffffffU) * 0x1.0p-32 * scent;
                trial[j] = best[j] + along * reach_.a * (weight * (a - best[j]) - (b - best[j]));
            } else {
                trial[j] = x[j] + along * reach_.b * (a - b);
            }
            trial[j] = clamped(trial[j], box_.lower[j], box_.upper[j]);
        }
    }

    void select() {
        const EvaluatedLosses found = evaluator_.evaluate(trials_);
        for (std::size_t i = 0; i < found.sums.size(); ++i) {
            if (found.sums[i] > population_.losses[i]) continue;
            if (found.sums[i] < population_.losses[i]) controls_[i] = trial_controls_[i];
            std::copy_n(trials_.data() + i * population_.d, population_.d, population_.at(i));
            population_.losses[i] = found.sums[i];
        }
    }

    const SearchBox& box_;
    QuickRandomNumbers random_;
    CandidateEvaluator& evaluator_;
    std::size_t largest_;
    Population population_;  // in the order of losses while trials are made
    Population kept_{.d = population_.d, .x = {}, .losses = {}};
    std::vector<Control> controls_;
    std::vector<Control> kept_controls_;
    std::vector<Control> trial_controls_;
    std::vector<double> trials_;  // n x d
    std::vector<std::size_t> order_;
    std::vector<std::uint8_t> crossed_;
    Reach reach_{};
};

}  // namespace

void slimeMould(const SearchBox& box, std::size_t population, std::uint64_t seed,
                CandidateEvaluator& evaluator) {
    QuickRandomNumbers random({seed, 3});
    Population slime = randomStart(box, population, random, evaluator);
    while (!evaluator.isOver() && publishedMove(box, slime, random, evaluator)) {
    }
}

void printedSlimeMould(const SearchBox& box, std::size_t population, std::uint64_t seed,
                       CandidateEvaluator& evaluator) {
    QuickRandomNumbers random({seed, 2});
    Population slime = goodStart(box, population, evaluator);
    while (!evaluator.isOver() && publishedMove(box, slime, random, evaluator) &&
           printedTrials(box, slime, random, evaluator)) {
    }
}

void improvedSlimeMould(const SearchBox& box, std::size_t population, std::uint64_t seed,
                        CandidateEvaluator& evaluator) {
    ImprovedSlimeMould(box, population, seed, evaluator).run();
}

}  // namespace terrawalk
