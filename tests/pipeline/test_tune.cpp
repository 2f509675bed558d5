#include "app/pipeline/tune.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/pipeline/process.hpp"
#include "app/pipeline/tune_checkpoint.hpp"
#include "app/pipeline/tune_file.hpp"
#include "app/pipeline/tune_jobs.hpp"
#include "fusion/fixed_point_loss.hpp"
#include "fusion/simulation.hpp"
#include "io/write_survey.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using nlohmann::json;
using test::bytesOf;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

/// Parameters x0, x1, ... of the box [-4, 4], behind keys of the paper's filter, and a loss of one's own.
TunableProblem madeProblem(std::size_t dimensions, std::size_t parts,
                           std::function<double(std::span<const double>, std::size_t part)> loss) {
    const std::vector<std::string> keys{"fusion.aukf.noise.position_e_m2", "fusion.aukf.noise.position_n_m2",
                                        "fusion.aukf.noise.position_u_m2",
                                        "fusion.aukf.noise.velocity_e_m2ps2",
                                        "fusion.aukf.noise.velocity_n_m2ps2"};
    TunableProblem problem{
        .method = "made", .components = {"a", "b"}, .profile_points = 81, .fingerprint = 1};
    for (std::size_t i = 0; i < dimensions; ++i) {
        problem.parameters.push_back({.name = "x" + std::to_string(i),
                                      .settings = {{keys.at(i), 2.0}},
                                      .lower = -4.0,
                                      .upper = 2.0,
                                      .start = 0.0});
    }
    for (std::size_t i = 0; i < parts; ++i) problem.parts.push_back({"part " + std::to_string(i), ""});
    problem.losses = [dimensions, loss](std::span<const double> candidates,
                                        std::span<const std::size_t> chosen, std::span<double> losses,
                                        const std::stop_token&) {
        for (std::size_t c = 0; c < candidates.size() / dimensions; ++c) {
            double sum = 0.0;
            for (const std::size_t part : chosen) {
                sum += loss(candidates.subspan(c * dimensions, dimensions), part);
            }
            losses[2 * c] = 0.25 * sum;
            losses[2 * c + 1] = 0.75 * sum;
        }
    };
    return problem;
}

TuneOptions small(OptimiserKind kind = OptimiserKind::Isma) {
    return {.optimiser = kind, .population = 10, .iterations = 60, .seed = 5};
}

TuneOutcome tuned(const TunableProblem& problem, const TuneOptions& options,
                  const TuneRecording& recording = {}) {
    SilentProgress silent;
    auto outcome = tune(problem, {}, options, silent, {}, recording);
    if (!outcome) throw std::runtime_error(outcome.error().text());
    return std::move(*outcome);
}

double squared(double x) {
    return x * x;
}

// The sum over the parts has its minimum at x0 = -1.5 and beyond the box in x1; x2 does nothing.
TunableProblem plainProblem() {
    return madeProblem(3, 4, [](std::span<const double> x, std::size_t part) {
        return 1.0 + squared(x[0] + 1.5) + 0.1 * static_cast<double>(part) + squared(x[1] - 3.0);
    });
}

TEST(Tune, FindsTheLeastLossAndWarnsOfBoundsAndOfWhatTheDataCannotTell) {
    const TuneOutcome outcome = tuned(plainProblem(), small());
    // The least is at (-1.5, 2): 4 parts of 1 + 1, and 0.6 of their own.
    EXPECT_NEAR(totalLoss(outcome.after), 8.6, 1e-3);
    EXPECT_DOUBLE_EQ(totalLoss(outcome.before), 4 * (1.0 + 2.25 + 9.0) + 0.6);
    ASSERT_EQ(outcome.parameters.size(), 3U);
    EXPECT_NEAR(outcome.parameters[0].after, std::pow(10.0, -1.5), 0.003);
    EXPECT_EQ(outcome.parameters[0].on_bound, Bound::None);
    EXPECT_TRUE(outcome.parameters[0].identified);
    EXPECT_EQ(outcome.parameters[1].on_bound, Bound::Upper);
    EXPECT_TRUE(outcome.parameters[1].identified);
    EXPECT_FALSE(outcome.parameters[2].identified);
    EXPECT_DOUBLE_EQ(outcome.parameters[2].flat_from, 1e-4);
    EXPECT_DOUBLE_EQ(outcome.parameters[2].flat_to, 1e2);
    std::size_t of_x2 = 0;
    for (const std::string& warning : outcome.warnings) {
        EXPECT_THAT(warning, testing::Not(HasSubstr("x0")));
        of_x2 += warning.starts_with("the data cannot tell x2 apart from 0.0001 to 100") ? 1 : 0;
    }
    EXPECT_EQ(of_x2, 1U);
    EXPECT_THAT(outcome.warnings, testing::Contains(HasSubstr("x1 ended on its upper bound 100")));
}

// 4 (x0 + 1.5)^2 stays within 1 % of 8.6 as far as 0.147 from the minimum: one place of the profile's 0.075.
TEST(Tune, TheFlatRangeIsWhereTheLossStaysWithinItsShare) {
    const TuneOutcome outcome = tuned(plainProblem(), small());
    EXPECT_NEAR(std::log10(outcome.parameters[0].flat_from), -1.5 - 0.147, 0.075);
    EXPECT_NEAR(std::log10(outcome.parameters[0].flat_to), -1.5 + 0.147, 0.075);
}

TEST(Tune, ThePartsAddUpToTheLosses) {
    const TuneOutcome outcome = tuned(plainProblem(), small());
    double before = 0.0;
    double after = 0.0;
    double left_out = 0.0;
    for (const PartOutcome& part : outcome.parts) {
        before += totalLoss(part.before);
        after += totalLoss(part.after);
        left_out += totalLoss(part.left_out);
    }
    EXPECT_NEAR(before, totalLoss(outcome.before), 1e-9);
    EXPECT_NEAR(after, totalLoss(outcome.after), 1e-9);
    ASSERT_TRUE(outcome.held_out);
    EXPECT_NEAR(left_out, outcome.held_out->after, 1e-9);
    EXPECT_NEAR(before, outcome.held_out->before, 1e-9);
}

TEST(Tune, SettingsGetTheirBaseTimesTheValue) {
    const TuneOutcome outcome = tuned(plainProblem(), small());
    EXPECT_EQ(outcome.tuned.fusion.aukf.noise.position_e_m2, 2.0 * outcome.parameters[0].after);
    EXPECT_EQ(outcome.tuned.fusion.aukf.noise.velocity_e_m2ps2, AukfOptions{}.noise.velocity_e_m2ps2);
}

// All parts agree on where the minimum is, so the one that was left out gains as well.
TEST(Tune, WhatThePartsAgreeOnHoldsOutBetter) {
    const TuneOutcome outcome = tuned(plainProblem(), small());
    EXPECT_TRUE(outcome.holds_out_better) << outcome.decision;
    EXPECT_LT(outcome.held_out->after, outcome.held_out->before);
    EXPECT_THAT(outcome.decision, HasSubstr("hold out better"));
}

// Part i is the better the larger x_i and the worse the larger every other one: what is tuned on the others
// harms the one left out. In closed form x_j = 1 / (1 + 2 (n - 2)) without part i.
TEST(Tune, WhatEachPartWantsForItselfIsNotAdopted) {
    constexpr std::size_t kParts = 5;
    const TunableProblem problem =
        madeProblem(kParts, kParts, [](std::span<const double> x, std::size_t part) {
            double loss = 0.0;
            for (std::size_t j = 0; j < x.size(); ++j) {
                loss += j == part ? squared(1.0 - x[j]) : 2.0 * squared(x[j]);
            }
            return loss;
        });
    TuneOptions options = small();
    options.iterations = 300;
    const TuneOutcome outcome = tuned(problem, options);
    EXPECT_TRUE(outcome.improved);
    EXPECT_LT(totalLoss(outcome.after), totalLoss(outcome.before));
    EXPECT_FALSE(outcome.holds_out_better) << outcome.decision;
    const double x = 1.0 / (1.0 + 2.0 * (kParts - 2));
    EXPECT_NEAR(outcome.held_out->after, kParts * (1.0 + 2.0 * (kParts - 1) * x * x), 0.05);
    EXPECT_NEAR(outcome.held_out->before, 1.0 * kParts, 1e-12);
    EXPECT_THAT(outcome.decision, HasSubstr("do not hold out better"));
    EXPECT_THAT(outcome.decision, HasSubstr("does not adopt"));
}

// A gain that differs from part to part by more than itself is no gain that one can count on.
TEST(Tune, AGainWithinItsStandardErrorIsNotAdopted) {
    const TunableProblem problem = madeProblem(1, 4, [](std::span<const double> x, std::size_t part) {
        // Three parts gain by 1 at the common minimum, the last loses 2.9 there.
        return part == 3 ? 1.0 + 0.3 * squared(x[0]) : 5.0 + squared(x[0] + 3.1);
    });
    const TuneOutcome outcome = tuned(problem, small());
    ASSERT_TRUE(outcome.held_out);
    const double gain = outcome.held_out->before - outcome.held_out->after;
    EXPECT_GT(gain, 0.0);
    EXPECT_EQ(outcome.holds_out_better, gain > outcome.held_out->gain_standard_error);
}

TEST(Tune, ASinglePartCannotBeLeftOut) {
    const TuneOutcome outcome =
        tuned(madeProblem(1, 1, [](std::span<const double> x, std::size_t) { return squared(x[0] - 1.0); }),
              small());
    EXPECT_TRUE(outcome.improved);
    EXPECT_FALSE(outcome.held_out);
    EXPECT_FALSE(outcome.holds_out_better);
    EXPECT_THAT(outcome.decision, HasSubstr("nothing can be left out"));
}

TEST(Tune, WhereNothingBetterIsFoundTheValuesStay) {
    const TuneOutcome outcome = tuned(
        madeProblem(2, 3, [](std::span<const double> x, std::size_t) { return x[0] == 0.0 ? 0.0 : 1.0; }),
        small());
    EXPECT_FALSE(outcome.improved);
    EXPECT_FALSE(outcome.holds_out_better);
    EXPECT_EQ(outcome.after, outcome.before);
    EXPECT_EQ(outcome.parameters[0].after, outcome.parameters[0].before);
    EXPECT_THAT(outcome.decision, HasSubstr("nothing better"));
}

TEST(Tune, RestartsHaveAWholeBudgetEach) {
    TuneOptions options = small();
    const std::size_t one = tuned(plainProblem(), options).search_evaluations;
    EXPECT_EQ(one, 2 * 10U + 10U * 60U);
    options.restarts = 3;
    EXPECT_EQ(tuned(plainProblem(), options).search_evaluations, 3 * one);
}

TEST(Tune, IsTheSameOnAnyNumberOfThreads) {
    std::vector<std::string> texts;
    for (const std::size_t threads : {1U, 2U, 5U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        TuneOptions options = small();
        options.restarts = 2;
        texts.push_back(tuneFileText(tuned(plainProblem(), options), "made"));
    }
    EXPECT_EQ(texts[0], texts[1]);
    EXPECT_EQ(texts[0], texts[2]);
}

class Resume : public testing::TestWithParam<OptimiserKind> {};

// Stopped at several moments, in the search and in those with a part left out.
TEST_P(Resume, EndsWithTheSameBitsAndEvaluatesNothingTwice) {
    const TunableProblem whole = plainProblem();
    std::atomic<std::size_t> evaluated = 0;
    TunableProblem counting = whole;
    counting.losses = [&](std::span<const double> candidates, std::span<const std::size_t> parts,
                          std::span<double> losses, const std::stop_token& stop) {
        whole.losses(candidates, parts, losses, stop);
        evaluated += candidates.size() / 3;
    };
    const std::string uninterrupted = tuneFileText(tuned(counting, small(GetParam())), "made");
    const std::size_t total = evaluated;
    for (const std::size_t stop_at : {40U, 300U, 700U}) {
        TuneRecord record;
        std::stop_source stop;
        std::size_t recorded = 0;
        const TuneRecording recording{
            .on_search =
                [&](std::size_t search, std::uint64_t fingerprint) {
                    record.resize(search + 1);
                    record[search].fingerprint = fingerprint;
                },
            .on_losses =
                [&](std::size_t search, std::size_t island, std::span<const double> losses) {
                    auto& islands = record[search].islands;
                    islands.resize(std::max(islands.size(), island + 1));
                    islands[island].insert(islands[island].end(), losses.begin(), losses.end());
                    recorded += losses.size() / 2;
                    if (recorded >= stop_at) stop.request_stop();
                }};
        SilentProgress silent;
        const auto cut = tune(counting, {}, small(GetParam()), silent, stop.get_token(), recording);
        ASSERT_FALSE(cut);
        EXPECT_EQ(cut.error().kind, ErrorKind::Cancelled);
        evaluated = 0;
        const TuneOutcome resumed = tuned(counting, small(GetParam()), {.resume_from = &record});
        EXPECT_EQ(tuneFileText(resumed, "made"), uninterrupted) << "stopped at " << stop_at;
        // Starts and ends of searches cost a few evaluations beside those of the search.
        EXPECT_LE(evaluated, total - recorded);
    }
}
INSTANTIATE_TEST_SUITE_P(Optimisers, Resume,
                         testing::Values(OptimiserKind::Isma, OptimiserKind::IsmaPrinted, OptimiserKind::Pso,
                                         OptimiserKind::Nsga2, OptimiserKind::Cmaes),
                         [](const auto& named) {
                             std::string text(name(named.param));
                             std::erase(text, '-');
                             return text;
                         });

TEST(TuneCheckpoint, ReadsBackEveryBit) {
    const TemporaryFolder scratch;
    const TuneIdentity identity{"Terrawalk 1", 5, 0xffffffffffffffffULL, "isma"};
    auto checkpoint = TuneCheckpoint::begin(scratch / "c", identity);
    ASSERT_TRUE(checkpoint);
    EXPECT_TRUE(checkpoint->isEmpty());
    const std::vector<double> losses{0.1, 1.0 / 3.0, 1e-300, HUGE_VAL, 12345.678901234567};
    checkpoint->onSearch(0, 0x8000000000000001ULL);
    checkpoint->onLosses(0, 1, losses);
    EXPECT_FALSE(checkpoint->isEmpty());
    ASSERT_TRUE(checkpoint->write());
    const auto read = TuneCheckpoint::resume(scratch / "c", identity);
    ASSERT_TRUE(read) << read.error().text();
    ASSERT_EQ(read->read().size(), 1U);
    EXPECT_EQ(read->read()[0].fingerprint, 0x8000000000000001ULL);
    ASSERT_EQ(read->read()[0].islands.size(), 2U);
    EXPECT_EQ(read->read()[0].islands[1], losses);
}

TEST(TuneCheckpoint, RefusesWhatIsNotItsOwnAndSaysTheCure) {
    const TemporaryFolder scratch;
    const TuneIdentity own{"Terrawalk 1", 5, 6, "isma"};
    auto checkpoint = TuneCheckpoint::begin(scratch / "c", own);
    ASSERT_TRUE(checkpoint);
    checkpoint->onSearch(0, 1);
    ASSERT_TRUE(checkpoint->write());
    const auto refusal = [&](const TuneIdentity& identity) {
        const auto resumed = TuneCheckpoint::resume(scratch / "c", identity);
        return resumed ? std::string("accepted") : resumed.error().text();
    };
    EXPECT_EQ(refusal(own), "accepted");
    EXPECT_THAT(refusal({"Terrawalk 2", 5, 6, "isma"}), HasSubstr("another program, Terrawalk 1"));
    EXPECT_THAT(refusal({"Terrawalk 1", 7, 6, "isma"}), HasSubstr("another survey"));
    EXPECT_THAT(refusal({"Terrawalk 1", 5, 7, "isma"}), HasSubstr("another configuration"));
    EXPECT_THAT(refusal({"Terrawalk 1", 5, 6, "sma"}), HasSubstr("another search: isma; asked for: sma"));
    EXPECT_THAT(refusal({"Terrawalk 1", 5, 6, "sma"}), HasSubstr("without --resume"));
    // A forgotten --resume must not throw the work away.
    const auto anew = TuneCheckpoint::begin(scratch / "c", own);
    ASSERT_FALSE(anew);
    EXPECT_THAT(anew.error().text(), HasSubstr("--resume"));
    const std::string whole = bytesOf(scratch / "c");
    for (const std::string& damaged :
         {whole.substr(0, whole.size() / 2), std::string("{}"), std::string("[1]"),
          std::string(R"({"format": "terrawalk-tune-checkpoint 1"})"), std::string(50'000, '[')}) {
        test::writeBytes(scratch / "c", damaged);
        EXPECT_THAT(refusal(own), HasSubstr("damaged"));
    }
    test::writeBytes(scratch / "c", R"({"format": "other"})");
    EXPECT_THAT(refusal(own), HasSubstr("no checkpoint"));
    EXPECT_FALSE(TuneCheckpoint::resume(scratch / "missing", own));
}

SimulatedSurvey simulated(std::size_t fixed_point_runs = 3, std::size_t area_epochs = 900) {
    SilentProgress silent;
    auto made = simulateSurvey({.seed = 11,
                                .area_east_m = 12,
                                .area_north_m = 12,
                                .line_spacing_m = 2,
                                .fixed_point_runs = fixed_point_runs,
                                .fixed_point_epochs = 100,
                                .area_epochs = area_epochs,
                                .control_stops = 0,
                                .check_points = 8},
                               silent, {});
    if (!made) throw std::runtime_error(made.error().text());
    return std::move(*made);
}

PipelineConfig aukf() {
    PipelineConfig config;
    config.fusion.method = FusionMethod::Aukf;
    return config;
}

TEST(TunableProblem, OfThePapersFilterIsItsFixedPointLoss) {
    const SimulatedSurvey survey = simulated();
    const auto problem = tunableProblem(survey.survey, aukf(), true, {});
    ASSERT_TRUE(problem) << problem.error().text();
    const auto loss = FixedPointLoss::prepare(survey.survey, aukf().fusion);
    ASSERT_TRUE(loss);
    ASSERT_EQ(problem->parameters.size(), kAllDimensions);
    ASSERT_EQ(problem->parts.size(), 3U);
    std::vector<double> candidate(kAllDimensions, -1.0);
    candidate[9] = 0.5;
    candidate[10] = 2.0;
    candidate[11] = 1.0;
    std::vector<double> losses(2);
    const std::vector<std::size_t> chosen{0, 2};
    problem->losses(candidate, chosen, losses, {});
    const auto each = loss->runLosses(candidate);
    EXPECT_DOUBLE_EQ(losses[0], each[0].horizontal_m2 + each[2].horizontal_m2);
    EXPECT_DOUBLE_EQ(losses[1], each[0].vertical_m2 + each[2].vertical_m2);
    // The candidate put into a configuration is the filter that the loss ran.
    const auto config = withCandidate(*problem, aukf(), candidate);
    ASSERT_TRUE(config);
    const auto configured = FixedPointLoss::prepare(survey.survey, config->fusion);
    EXPECT_NEAR(configured->loss(candidateOf(config->fusion.aukf, kAllDimensions)).total_m2(),
                loss->loss(candidate).total_m2(), 1e-9);
}

TEST(TunableProblem, SaysWhyThereIsNone) {
    PipelineConfig raw;
    raw.fusion.method = FusionMethod::Raw;
    const auto other = tunableProblem(simulated().survey, raw, false, {});
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().kind, ErrorKind::Usage);
    PipelineConfig ukf;
    ukf.fusion.method = FusionMethod::Ukf;
    EXPECT_FALSE(tunableProblem(simulated().survey, ukf, true, {}));
    const auto without = tunableProblem(simulated(0).survey, aukf(), false, {});
    ASSERT_FALSE(without);
    EXPECT_EQ(without.error().kind, ErrorKind::BadData);
    EXPECT_THAT(without.error().cure, HasSubstr("fixed"));
    // Check marks are for testing alone.
    SimulatedSurvey checks = simulated();
    for (ControlMark& mark : checks.survey.marks) mark.role = MarkRole::Check;
    EXPECT_FALSE(tunableProblem(checks.survey, aukf(), false, {}));
}

TEST(TunableProblem, TheFingerprintFollowsDataAndConfiguration) {
    const Survey survey = simulated().survey;
    const auto print = [&](const Survey& of, const PipelineConfig& config) {
        return tunableProblem(of, config, false, {})->fingerprint;
    };
    const std::uint64_t own = print(survey, aukf());
    EXPECT_EQ(print(survey, aukf()), own);
    Survey other = survey;
    other.runs[0].log.column(Channel::Pressure)[7] += 1e-9;
    EXPECT_NE(print(other, aukf()), own);
    other = survey;
    other.marks[0].enu_m.z() += 1e-6;
    EXPECT_NE(print(other, aukf()), own);
    PipelineConfig config = aukf();
    config.fusion.barometer.sigma_m *= 1.01;
    EXPECT_NE(print(survey, config), own);
}

class TuneSurvey : public testing::Test {
  protected:
    TuneSurvey() {
        std::filesystem::create_directories(scratch_ / "survey");
        const auto written = writeSurvey(simulated().survey, scratch_ / "survey");
        if (!written) throw std::runtime_error(written.error().text());
    }
    Result<TunedSurvey> run(const std::string& output, const TuneOptions& options, bool resume = false,
                            std::stop_token stop = {}) {
        SilentProgress silent;
        return tuneSurvey(scratch_ / "survey", config_, options, {scratch_ / output, {}, resume}, silent,
                          std::move(stop));
    }
    TemporaryFolder scratch_;
    PipelineConfig config_ = aukf();
};

TEST_F(TuneSurvey, WritesAFileThatIsAConfigurationAsItIs) {
    config_.fusion.barometer.sigma_m = 0.07;
    const auto tuned = run("params.json", small());
    ASSERT_TRUE(tuned) << tuned.error().text();
    PipelineConfig loaded;
    const auto done = applyConfigFile(loaded, scratch_ / "params.json");
    ASSERT_TRUE(done) << done.error().text();
    ASSERT_TRUE(loaded.tuning);
    EXPECT_EQ(loaded.tuning->seed, 5U);
    EXPECT_EQ(loaded.tuning->optimiser, "isma");
    EXPECT_EQ(loaded.tuning->evaluations, tuned->outcome.evaluations());
    ASSERT_EQ(loaded.tuning->marks.size(), 3U);
    EXPECT_EQ(loaded.tuning->marks[0].name, "P01");
    // Printed and read again, the record stays.
    test::writeBytes(scratch_ / "again.json", toJson(loaded));
    PipelineConfig again;
    ASSERT_TRUE(applyConfigFile(again, scratch_ / "again.json"));
    EXPECT_EQ(toJson(again), toJson(loaded));
    // What was tuned, and what differed from the default before, stands in the file; nothing else.
    loaded.tuning.reset();
    EXPECT_EQ(toJson(loaded), toJson(tuned->outcome.tuned));
    const json file = json::parse(bytesOf(scratch_ / "params.json"));
    EXPECT_EQ(file.at("fusion").at("method"), "aukf");
    EXPECT_EQ(file.at("fusion").size(), 3U);
    EXPECT_EQ(file.at("fusion").at("barometer").size(), 1U);
    EXPECT_EQ(file.at("tuning").at("parameters").size(), 9U);
    EXPECT_EQ(file.at("tuning").at("parts").size(), 3U);
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "params.json.checkpoint"));
}

TEST_F(TuneSurvey, CancelledItLeavesACheckpointAndEndsWithTheSameBytes) {
    TuneOptions options = small();
    options.iterations = 300;
    ASSERT_TRUE(run("whole.json", options));
    std::stop_source stop;
    /// Asks to stop a third of the way.
    class Stopping final : public Progress {
      public:
        explicit Stopping(std::stop_source& stop) : stop_(stop) {}
        void report(double fraction, std::string_view) override {
            if (fraction > 0.33) stop_.request_stop();
        }
        void message(Severity, std::string_view) override {}

      private:
        std::stop_source& stop_;
    } progress(stop);
    const TuneFiles files{scratch_ / "cut.json", scratch_ / "kept", false};
    const auto cut = tuneSurvey(scratch_ / "survey", config_, options, files, progress, stop.get_token());
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().kind, ErrorKind::Cancelled);
    EXPECT_THAT(cut.error().text(), HasSubstr("--resume"));
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "cut.json"));
    ASSERT_TRUE(std::filesystem::exists(scratch_ / "kept"));
    SilentProgress silent;
    TuneFiles again = files;
    // Another seed is another tuning.
    again.resume = true;
    TuneOptions other = options;
    other.seed = 6;
    const auto refused = tuneSurvey(scratch_ / "survey", config_, other, again, silent, {});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().text(), HasSubstr("another search"));
    const auto resumed = tuneSurvey(scratch_ / "survey", config_, options, again, silent, {});
    ASSERT_TRUE(resumed) << resumed.error().text();
    EXPECT_EQ(bytesOf(scratch_ / "cut.json"), bytesOf(scratch_ / "whole.json"));
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "kept"));
}

TEST_F(TuneSurvey, NeverReplacesAFileThatHoldsNoParameters) {
    const std::string project = bytesOf(scratch_ / "survey/survey.json");
    const auto refused = run("survey/survey.json", small());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    EXPECT_EQ(bytesOf(scratch_ / "survey/survey.json"), project);
    ASSERT_TRUE(run("params.json", small()));
    EXPECT_TRUE(run("params.json", small()));
}

TEST_F(TuneSurvey, ADamagedSectionIsRefused) {
    ASSERT_TRUE(run("params.json", small()));
    const json good = json::parse(bytesOf(scratch_ / "params.json"));
    for (const char* key : {"marks", "seed", "decision", "loss_after"}) {
        for (const bool removed : {true, false}) {
            json bad = good;
            if (removed) {
                bad["tuning"].erase(key);
            } else {
                bad["tuning"][key] = json::object({{"a", 1}});
            }
            test::writeBytes(scratch_ / "bad.json", bad.dump());
            PipelineConfig config;
            const auto done = applyConfigFile(config, scratch_ / "bad.json");
            ASSERT_FALSE(done) << key << removed;
            EXPECT_EQ(done.error().kind, ErrorKind::BadData);
            EXPECT_THAT(done.error().text(), HasSubstr("tuning")) << key;
        }
    }
    test::writeBytes(scratch_ / "bad.json", R"({"tunings": {"seed": 1}})");
    PipelineConfig config;
    EXPECT_FALSE(applyConfigFile(config, scratch_ / "bad.json"));
}

// A mark that the values were tuned on cannot show how good they are; another survey's mark of its name can.
TEST(Process, MarksThatWereTunedOnCertifyNothing) {
    const SimulatedSurvey survey = simulated();
    PipelineConfig config = aukf();
    config.tuning = TuningRecord{.survey = "here", .marks = {survey.survey.marks[0], survey.survey.marks[1]}};
    config.tuning->marks[1].enu_m.x() += 0.5;
    const auto used = [&](const PipelineConfig& with) {
        SilentProgress silent;
        const auto products = process(survey.survey, with, silent, {});
        EXPECT_TRUE(products) << products.error().text();
        std::set<std::pair<std::string, bool>> names;
        for (const Residual& residual : products->report.residuals) {
            if (!residual.used_by_estimator) continue;
            names.insert({residual.mark, residual.stage == Stage::BeforeFusion});
        }
        return names;
    };
    const std::string first = survey.survey.marks[0].name;
    EXPECT_THAT(used(config), ElementsAre(std::pair(first, false)));
    config.tuning->in_use = false;
    EXPECT_TRUE(used(config).empty());
    config.tuning.reset();
    EXPECT_TRUE(used(config).empty());
}

TEST(TunedWhereBetter, TakesTheTunedValuesOnlyWhereTheyHoldOutBetter) {
    const Survey survey = simulated(3, 0).survey;
    SilentProgress silent;
    const auto problem = tunableProblem(survey, aukf(), false, {});
    ASSERT_TRUE(problem);
    // Filters that are far too stiff or far too loose: the first is easily improved on all runs.
    for (const double noise : {10.0, 1e-8}) {
        PipelineConfig config = aukf();
        for (const char* axis : {"e", "n", "u"}) {
            ASSERT_TRUE(applySetting(
                config, "fusion.aukf.noise.position_" + std::string(axis) + "_m2=" + std::to_string(noise)));
        }
        const auto outcome = tune(*tunableProblem(survey, config, false, {}), config, small(), silent, {});
        ASSERT_TRUE(outcome);
        const auto chosen = tunedWhereBetter(survey, config, small(), silent, {});
        ASSERT_TRUE(chosen);
        ASSERT_TRUE(chosen->tuning);
        EXPECT_EQ(chosen->tuning->in_use, outcome->holds_out_better);
        PipelineConfig values = *chosen;
        values.tuning.reset();
        EXPECT_EQ(toJson(values), toJson(outcome->holds_out_better ? outcome->tuned : config));
    }
}

}  // namespace
}  // namespace terrawalk
