#include "fusion/optimiser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

#include "fusion/test_functions.hpp"

namespace terrawalk {
namespace {

using testing::HasSubstr;

/// Sum of squares about a point of the box, shared out on two losses. Any optimiser can take it.
Objective twoLosses(std::vector<double> target) {
    Objective objective;
    objective.losses = 2;
    objective.evaluate = [target](std::span<const double> candidates, std::span<double> losses) {
        const std::size_t d = target.size();
        std::fill(losses.begin(), losses.end(), 0.0);
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            const double off = candidates[k] - target[k % d];
            losses[2 * (k / d) + k % 2] += off * off;
        }
    };
    return objective;
}

const SearchBox kBox{{-4.0, -3.0, -5.0, -2.0}, {6.0, 7.0, 5.0, 8.0}};
const std::vector<double> kTarget{1.0, -2.0, 3.0, 0.5};

OptimiserOptions budget(OptimiserKind kind, std::size_t evaluations) {
    return {.kind = kind, .population = 20, .generations = 0, .max_evaluations = evaluations, .seed = 7};
}

Result<OptimiserResult> run(const Objective& objective, const SearchBox& box, const OptimiserOptions& options,
                            const Recording& recording = {}) {
    SilentProgress silent;
    return optimise(objective, box, options, silent, {}, recording);
}

void expectEqual(const OptimiserResult& a, const OptimiserResult& b) {
    EXPECT_EQ(a.best, b.best);
    EXPECT_EQ(a.best_loss, b.best_loss);
    EXPECT_EQ(a.best_losses, b.best_losses);
    EXPECT_EQ(a.evaluations, b.evaluations);
    EXPECT_EQ(a.notes, b.notes);
    ASSERT_EQ(a.convergence.size(), b.convergence.size());
    for (std::size_t i = 0; i < a.convergence.size(); ++i) {
        EXPECT_EQ(a.convergence[i].evaluations, b.convergence[i].evaluations);
        EXPECT_EQ(a.convergence[i].best_loss, b.convergence[i].best_loss);
    }
    ASSERT_EQ(a.front.size(), b.front.size());
    for (std::size_t i = 0; i < a.front.size(); ++i) {
        EXPECT_EQ(a.front[i].candidate, b.front[i].candidate);
        EXPECT_EQ(a.front[i].losses, b.front[i].losses);
    }
}

/// Keeps every loss that is evaluated.
struct Recorder {
    EvaluationRecord record;
    Recording recording(const EvaluationRecord* resume_from = nullptr) {
        return {resume_from, [this](std::size_t island, std::span<const double> losses) {
                    if (record.islands.size() <= island) record.islands.resize(island + 1);
                    record.islands[island].insert(record.islands[island].end(), losses.begin(), losses.end());
                }};
    }
    [[nodiscard]] std::size_t size() const {
        std::size_t sum = 0;
        for (const auto& island : record.islands) sum += island.size();
        return sum;
    }
};

class AnyOptimiser : public testing::TestWithParam<OptimiserKind> {};

TEST_P(AnyOptimiser, FindsTheMinimumOfASphere) {
    const auto result = run(twoLosses(kTarget), kBox, budget(GetParam(), 12'000));
    ASSERT_TRUE(result) << result.error().text();
    // The start is off by metres. Nsga2 seeks the whole front and so comes no closer than about a hundredth;
    // the genetic algorithm mutates by shares of the box.
    const bool coarse = GetParam() == OptimiserKind::Nsga2 || GetParam() == OptimiserKind::Ga;
    for (std::size_t j = 0; j < kTarget.size(); ++j) {
        EXPECT_NEAR(result->best[j], kTarget[j], coarse ? 0.1 : 0.01) << j;
    }
    EXPECT_EQ(result->best_losses.size(), 2U);
    EXPECT_EQ(result->best_loss, result->best_losses[0] + result->best_losses[1]);
    EXPECT_FALSE(result->cancelled);
}

TEST_P(AnyOptimiser, CountsEveryEvaluationAndSpendsExactlyTheLimit) {
    std::atomic<std::size_t> evaluated{0};
    Objective counting = twoLosses(kTarget);
    counting.evaluate = [&, inner = counting.evaluate](std::span<const double> candidates,
                                                       std::span<double> losses) {
        evaluated += losses.size() / 2;
        EXPECT_EQ(candidates.size(), 2 * losses.size());
        inner(candidates, losses);
    };
    // Ends in the start, within a generation, and not on a multiple of the islands.
    for (const std::size_t limit : {13U, 1'003U, 2'047U}) {
        evaluated = 0;
        const auto result = run(counting, kBox, budget(GetParam(), limit));
        ASSERT_TRUE(result) << result.error().text();
        EXPECT_EQ(result->evaluations, limit);
        EXPECT_EQ(evaluated, limit);
        EXPECT_EQ(result->convergence.back().evaluations, limit);
    }
}

TEST_P(AnyOptimiser, ConvergenceFallsToTheBestLoss) {
    const auto result = run(twoLosses(kTarget), kBox, budget(GetParam(), 2'000));
    ASSERT_TRUE(result);
    ASSERT_GE(result->convergence.size(), 2U);
    for (std::size_t i = 1; i < result->convergence.size(); ++i) {
        EXPECT_GE(result->convergence[i].evaluations, result->convergence[i - 1].evaluations);
        EXPECT_LE(result->convergence[i].best_loss, result->convergence[i - 1].best_loss);
    }
    EXPECT_EQ(result->convergence.back().best_loss, result->best_loss);
    std::vector<double> losses(2);
    twoLosses(kTarget).evaluate(result->best, losses);
    EXPECT_EQ(losses, result->best_losses);
}

// The minimum lies outside, beyond a corner: candidates press against the borders and the corner is found.
TEST_P(AnyOptimiser, StaysInTheBoxAndReachesItsCorner) {
    std::atomic<std::size_t> outside{0};
    Objective sloping = twoLosses({9.0, -9.0, 9.0, -9.0});
    sloping.evaluate = [&, inner = sloping.evaluate](std::span<const double> candidates,
                                                     std::span<double> losses) {
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            const std::size_t j = k % kBox.dimensions();
            if (!(candidates[k] >= kBox.lower[j] && candidates[k] <= kBox.upper[j])) ++outside;
        }
        inner(candidates, losses);
    };
    const auto result = run(sloping, kBox, budget(GetParam(), 8'000));
    ASSERT_TRUE(result);
    EXPECT_EQ(outside, 0U);
    const std::vector<double> corner{6.0, -3.0, 5.0, -2.0};
    for (std::size_t j = 0; j < corner.size(); ++j) EXPECT_NEAR(result->best[j], corner[j], 0.15) << j;
}

TEST_P(AnyOptimiser, GivesTheSameOnOneThreadAndOnMany) {
    Objective objective = twoLosses(kTarget);
    std::vector<OptimiserResult> results;
    for (const std::size_t threads : {1U, 2U, 5U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        for (const std::size_t islands : {0U, 3U}) {
            OptimiserOptions options = budget(GetParam(), 1'500);
            options.islands = islands;
            const auto result = run(objective, kBox, options);
            ASSERT_TRUE(result);
            results.push_back(*result);
        }
    }
    for (std::size_t i = 2; i < results.size(); ++i) expectEqual(results[i % 2], results[i]);
}

TEST_P(AnyOptimiser, AnotherSeedIsAnotherSearch) {
    OptimiserOptions options = budget(GetParam(), 500);
    const auto first = run(twoLosses(kTarget), kBox, options);
    options.seed = 8;
    const auto second = run(twoLosses(kTarget), kBox, options);
    ASSERT_TRUE(first && second);
    EXPECT_NE(first->best, second->best);
}

TEST_P(AnyOptimiser, ResumesExactlyFromAnyPlaceOfItsRecord) {
    const OptimiserOptions options = budget(GetParam(), 1'200);
    std::atomic<std::size_t> evaluated{0};
    Objective objective = twoLosses(kTarget);
    objective.evaluate = [&, inner = objective.evaluate](std::span<const double> candidates,
                                                         std::span<double> losses) {
        evaluated += losses.size() / 2;
        inner(candidates, losses);
    };
    Recorder whole;
    const auto uninterrupted = run(objective, kBox, options, whole.recording());
    ASSERT_TRUE(uninterrupted);
    ASSERT_EQ(whole.size(), 2 * 1'200U);

    // Nothing, within the start, within a generation, everything.
    for (const double share : {0.0, 0.011, 0.6, 1.0}) {
        EvaluationRecord cut{searchFingerprint(objective, kBox, options), whole.record.islands};
        std::size_t kept = 0;
        for (auto& island : cut.islands) {
            island.resize(2 * static_cast<std::size_t>(share * static_cast<double>(island.size() / 2)));
            kept += island.size() / 2;
        }
        Recorder rest;
        evaluated = 0;
        const auto resumed = run(objective, kBox, options, rest.recording(&cut));
        ASSERT_TRUE(resumed) << resumed.error().text();
        expectEqual(*uninterrupted, *resumed);
        EXPECT_EQ(evaluated, 1'200 - kept);
        EXPECT_EQ(rest.size(), 2 * (1'200 - kept));
    }
}

TEST_P(AnyOptimiser, StopsOnRequestWithTheBestSoFarAndResumesFromThere) {
    constexpr std::size_t kStopAfter = 300;
    const OptimiserOptions options = budget(GetParam(), 4'000);
    std::stop_source source;
    std::atomic<std::size_t> evaluated{0};
    Objective objective = twoLosses(kTarget);
    const LossFunction inner = objective.evaluate;
    objective.evaluate = [&](std::span<const double> candidates, std::span<double> losses) {
        evaluated += losses.size() / 2;
        if (evaluated > kStopAfter) source.request_stop();
        // What a cancelled objective gives must not matter.
        if (source.stop_requested()) {
            std::fill(losses.begin(), losses.end(), -1.0);
        } else {
            inner(candidates, losses);
        }
    };
    SilentProgress silent;
    Recorder recorder;
    const auto stopped = optimise(objective, kBox, options, silent, source.get_token(), recorder.recording());
    ASSERT_TRUE(stopped) << stopped.error().text();
    EXPECT_TRUE(stopped->cancelled);
    EXPECT_GE(stopped->best_loss, 0.0);
    EXPECT_LE(stopped->evaluations, kStopAfter);
    EXPECT_EQ(recorder.size(), 2 * stopped->evaluations);
    // At most the batch at work of each island: two populations at the start.
    EXPECT_LE(evaluated, kStopAfter + 4 * 2 * 20);

    recorder.record.fingerprint = searchFingerprint(objective, kBox, options);
    const auto resumed = run(twoLosses(kTarget), kBox, options, {&recorder.record, {}});
    const auto uninterrupted = run(twoLosses(kTarget), kBox, options);
    ASSERT_TRUE(resumed && uninterrupted);
    expectEqual(*uninterrupted, *resumed);
}

TEST_P(AnyOptimiser, ALossThatIsNoNumberCountsAsInfinite) {
    Objective half = twoLosses(kTarget);
    half.evaluate = [inner = half.evaluate](std::span<const double> candidates, std::span<double> losses) {
        inner(candidates, losses);
        for (std::size_t i = 0; i < losses.size() / 2; ++i) {
            if (candidates[4 * i] < 2.0) losses[2 * i] = std::numeric_limits<double>::quiet_NaN();
        }
    };
    const auto result = run(half, kBox, budget(GetParam(), 4'000));
    ASSERT_TRUE(result);
    EXPECT_TRUE(std::isfinite(result->best_loss));
    EXPECT_GE(result->best[0], 2.0);
}

INSTANTIATE_TEST_SUITE_P(All, AnyOptimiser,
                         testing::Values(OptimiserKind::Isma, OptimiserKind::IsmaPrinted, OptimiserKind::Sma,
                                         OptimiserKind::Pso, OptimiserKind::Ga, OptimiserKind::Sa,
                                         OptimiserKind::Nsga2, OptimiserKind::Abc, OptimiserKind::Sade,
                                         OptimiserKind::Cmaes),
                         [](const auto& test) {
                             std::string text(name(test.param));
                             std::erase(text, '-');
                             return text;
                         });

TEST(Optimiser, HasAName) {
    for (const auto& [kind, text] : kOptimiserNames) EXPECT_EQ(name(kind), text);
}

TEST(Optimiser, RefusesARecordOfAnotherSearch) {
    const OptimiserOptions options = budget(OptimiserKind::Isma, 200);
    Objective objective = twoLosses(kTarget);
    const std::uint64_t print = searchFingerprint(objective, kBox, options);
    std::vector<std::uint64_t> others;
    for (const OptimiserKind kind : {OptimiserKind::Sma, OptimiserKind::IsmaPrinted}) {
        others.push_back(searchFingerprint(objective, kBox, budget(kind, 200)));
    }
    others.push_back(searchFingerprint(objective, kBox, budget(OptimiserKind::Isma, 201)));
    OptimiserOptions other = options;
    other.seed = 8;
    others.push_back(searchFingerprint(objective, kBox, other));
    other = options;
    other.population = 21;
    others.push_back(searchFingerprint(objective, kBox, other));
    SearchBox narrower = kBox;
    narrower.upper[3] = 7.5;
    others.push_back(searchFingerprint(objective, narrower, options));
    objective.fingerprint = 5;
    others.push_back(searchFingerprint(objective, kBox, options));
    for (const std::uint64_t fingerprint : others) {
        EXPECT_NE(fingerprint, print);
        const EvaluationRecord record{fingerprint, {}};
        const auto refused = run(twoLosses(kTarget), kBox, options, {&record, {}});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().kind, ErrorKind::BadData);
    }
    const EvaluationRecord record{print, {}};
    EXPECT_TRUE(run(twoLosses(kTarget), kBox, options, {&record, {}}));
}

TEST(Optimiser, RefusesWhatItCannotSearch) {
    const auto refusal = [](const Objective& objective, const SearchBox& box,
                            const OptimiserOptions& options) {
        const auto result = run(objective, box, options);
        if (result) return std::string("accepted");
        EXPECT_EQ(result.error().kind, ErrorKind::Usage);
        return result.error().message;
    };
    const Objective one = objectiveOf(unshifted(TestFunction::Sphere, 4));
    const OptimiserOptions good = budget(OptimiserKind::Isma, 100);
    EXPECT_THAT(refusal(one, {{0, 0}, {1, -1}}, good), HasSubstr("bounds 2"));
    EXPECT_THAT(refusal(one, {{0}, {std::numeric_limits<double>::infinity()}}, good), HasSubstr("bounds 1"));
    EXPECT_THAT(refusal(one, {{}, {}}, good), HasSubstr("box"));
    EXPECT_THAT(refusal({}, kBox, good), HasSubstr("objective"));
    EXPECT_THAT(refusal(one, kBox, budget(OptimiserKind::Nsga2, 100)), HasSubstr("two losses"));
    OptimiserOptions bad = good;
    bad.population = 3;
    EXPECT_THAT(refusal(one, kBox, bad), HasSubstr("population"));
    bad = good;
    bad.max_evaluations = 0;
    EXPECT_THAT(refusal(one, kBox, bad), HasSubstr("limit"));
    bad = good;
    bad.islands = 101;
    EXPECT_THAT(refusal(one, kBox, bad), HasSubstr("islands"));
}

TEST(Optimiser, StopBeforeTheFirstEvaluationIsAnError) {
    std::stop_source source;
    source.request_stop();
    SilentProgress silent;
    const auto result =
        optimise(twoLosses(kTarget), kBox, budget(OptimiserKind::Isma, 100), silent, source.get_token());
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
}

TEST(Optimiser, LimitFollowsFromPopulationAndGenerations) {
    OptimiserOptions options{.population = 30, .generations = 100};
    options.kind = OptimiserKind::Sma;
    EXPECT_EQ(evaluationLimit(options), 30U + 3'000U);
    options.kind = OptimiserKind::Isma;  // a start with its opposition
    EXPECT_EQ(evaluationLimit(options), 60U + 3'000U);
    options.kind = OptimiserKind::IsmaPrinted;  // and a trial after each move
    EXPECT_EQ(evaluationLimit(options), 60U + 6'000U);
    options.kind = OptimiserKind::Nsga2;  // 32 individuals
    EXPECT_EQ(evaluationLimit(options), 32U + 3'200U);
    options.max_evaluations = 500;
    EXPECT_EQ(evaluationLimit(options), 500U);
}

TEST(Optimiser, HandsOverWholeGenerations) {
    for (const OptimiserKind kind : {OptimiserKind::Isma, OptimiserKind::IsmaPrinted, OptimiserKind::Sma,
                                     OptimiserKind::Pso, OptimiserKind::Nsga2}) {
        std::vector<std::size_t> batches;
        Objective objective = twoLosses(kTarget);
        objective.evaluate = [&, inner = objective.evaluate](std::span<const double> candidates,
                                                             std::span<double> losses) {
            batches.push_back(losses.size() / 2);
            inner(candidates, losses);
        };
        ASSERT_TRUE(run(objective, kBox, budget(kind, 2'000)));
        EXPECT_GE(*std::min_element(batches.begin(), batches.end() - 1), 10U) << name(kind);
    }
}

TEST(Optimiser, FrontHoldsNoPointThatAnotherBeats) {
    // Two spheres: the front is the line between their centres, on which sqrt(f1) + sqrt(f2) = 1.
    Objective objective;
    objective.losses = 2;
    objective.evaluate = [](std::span<const double> candidates, std::span<double> losses) {
        for (std::size_t i = 0; i < losses.size() / 2; ++i) {
            const double x = candidates[2 * i];
            const double y = candidates[2 * i + 1];
            losses[2 * i] = x * x + y * y;
            losses[2 * i + 1] = (x - 1.0) * (x - 1.0) + y * y;
        }
    };
    const auto result = run(objective, {{-3.0, -3.0}, {3.0, 3.0}}, budget(OptimiserKind::Nsga2, 6'000));
    ASSERT_TRUE(result);
    ASSERT_GE(result->front.size(), 10U);
    double least = std::numeric_limits<double>::infinity();
    double mean_off = 0.0;
    for (std::size_t i = 0; i < result->front.size(); ++i) {
        const std::vector<double>& losses = result->front[i].losses;
        if (i > 0) {
            EXPECT_GT(losses[0], result->front[i - 1].losses[0]);
            EXPECT_LT(losses[1], result->front[i - 1].losses[1]);
        }
        least = std::min(least, losses[0] + losses[1]);
        mean_off +=
            (std::sqrt(losses[0]) + std::sqrt(losses[1]) - 1.0) / static_cast<double>(result->front.size());
    }
    EXPECT_EQ(result->best_loss, least);
    EXPECT_GE(mean_off, 0.0);
    EXPECT_LT(mean_off, 0.02);
}

TEST(ImprovedSlimeMould, BeatsThePlainOneOnShiftedFunctionsByFar) {
    for (const auto& [function, dimensions] :
         {std::pair{TestFunction::Sphere, 10}, std::pair{TestFunction::Ackley, 10},
          std::pair{TestFunction::Rastrigin, 5}, std::pair{TestFunction::Griewank, 12},
          std::pair{TestFunction::Levy13, 2}}) {
        const std::size_t d = static_cast<std::size_t>(dimensions);
        const Objective objective = objectiveOf(shifted(function, d, 99));
        const auto medianOf = [&](OptimiserKind kind) {
            std::vector<double> finals;
            for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
                OptimiserOptions options = budget(kind, 30'000);
                options.population = 50;
                options.seed = seed;
                finals.push_back(run(objective, usualBox(function, d), options)->best_loss);
            }
            std::nth_element(finals.begin(), finals.begin() + 2, finals.end());
            return finals[2];
        };
        const double plain = medianOf(OptimiserKind::Sma);
        EXPECT_LE(medianOf(OptimiserKind::Isma), 0.1 * plain) << name(function);
        // Not a baseline that fails altogether: it comes far below the start.
        std::vector<double> middle(d, 0.0);
        EXPECT_LT(plain, 0.5 * shifted(function, d, 99)(middle)) << name(function);
    }
}

// Losses in another unit, by a power of two so that nothing rounds, lead to the same candidates.
TEST(ImprovedSlimeMould, DoesNotDependOnTheUnitOfTheLoss) {
    const ShiftedFunction function = shifted(TestFunction::Ackley, 6, 3);
    const SearchBox box = usualBox(TestFunction::Ackley, 6);
    const Objective plain = objectiveOf(function);
    const Objective scaled{perCandidate(6, [&](std::span<const double> x) { return 1024.0 * function(x); })};
    const auto a = run(plain, box, budget(OptimiserKind::Isma, 3'000));
    const auto b = run(scaled, box, budget(OptimiserKind::Isma, 3'000));
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->best, b->best);
    EXPECT_EQ(1024.0 * a->best_loss, b->best_loss);
}

// vc X shrinks every individual towards the origin: the reason to compare on shifted functions.
TEST(SlimeMould, IsFlatteredByAMinimumAtTheOrigin) {
    const SearchBox box = usualBox(TestFunction::Sphere, 10);
    const auto centred =
        run(objectiveOf(unshifted(TestFunction::Sphere, 10)), box, budget(OptimiserKind::Sma, 10'000));
    const auto moved =
        run(objectiveOf(shifted(TestFunction::Sphere, 10, 4)), box, budget(OptimiserKind::Sma, 10'000));
    ASSERT_TRUE(centred && moved);
    EXPECT_LT(centred->best_loss, 1e-20);
    EXPECT_GT(moved->best_loss, 1e-6);
}

// Opposition in a box of all positive values: lb + ub - p, not rand (lb + ub) - p, which leaves the box.
TEST(PrintedSlimeMould, StartsWithGoodPointsAndTheirOpposites) {
    std::vector<double> first;
    Objective objective{perCandidate(2, [](std::span<const double> x) { return x[0] + x[1]; })};
    objective.evaluate = [&, inner = objective.evaluate](std::span<const double> candidates,
                                                         std::span<double> losses) {
        if (first.empty()) first.assign(candidates.begin(), candidates.end());
        inner(candidates, losses);
    };
    const SearchBox box{{1.0, 10.0}, {3.0, 50.0}};
    ASSERT_TRUE(run(objective, box, budget(OptimiserKind::IsmaPrinted, 100)));
    ASSERT_EQ(first.size(), 2 * 2 * 20U);
    for (std::size_t i = 0; i < 20; ++i) {
        EXPECT_NEAR(first[2 * i] + first[40 + 2 * i], 4.0, 1e-12);
        EXPECT_NEAR(first[2 * i + 1] + first[40 + 2 * i + 1], 60.0, 1e-12);
    }
}

TEST(PerCandidate, GivesTheSameSideBySide) {
    const ShiftedFunction function = shifted(TestFunction::Griewank, 3, 1);
    std::vector<double> candidates(300);
    std::iota(candidates.begin(), candidates.end(), -150.0);
    std::vector<double> serial(100);
    std::vector<double> parallel(100);
    perCandidate(3, function, std::numeric_limits<std::size_t>::max())(candidates, serial);
    perCandidate(3, function, 7)(candidates, parallel);
    EXPECT_EQ(serial, parallel);
    EXPECT_EQ(serial[41], function(std::span(candidates).subspan(123, 3)));
}

}  // namespace
}  // namespace terrawalk
