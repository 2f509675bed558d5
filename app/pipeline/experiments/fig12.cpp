// Loss by population and number of iterations of the improved slime mould.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/pipeline/experiments/experiments.hpp"
#include "app/pipeline/experiments/tuner_trials.hpp"
#include "fusion/random_numbers.hpp"

namespace terrawalk {

Result<ExperimentReport> runFig12(const ExperimentOptions& options, Progress& progress,
                                  std::stop_token stop) {
    const std::vector<std::size_t> populations =
        options.quick ? std::vector<std::size_t>{10, 50} : std::vector<std::size_t>{10, 25, 50, 100};
    const std::vector<std::size_t> iterations =
        options.quick ? std::vector<std::size_t>{10, 50} : std::vector<std::size_t>{50, 100, 250, 500, 1000};
    const std::size_t repeats = options.quick ? 2 : 3;
    const auto ground = tuningGround(options.seed, FilterKind::Ukf, stop);
    if (!ground) return tl::unexpected(ground.error());

    ExperimentReport report{.title = "Fig 12: loss by population and iterations of ISMA"};
    report.summary.columns = {"population", "iterations",    "mean loss [m2]", "least",
                              "greatest",   "on other runs", "evaluations",    "paper 000, mean"};
    report.data.columns = {"population", "iterations", "repeat", "loss [m2]", "loss on other runs [m2]"};
    PlotPanel panel{.title = "Mean over the repeats",
                    .x = {.label = "iterations", .logarithmic = true},
                    .y = {.label = "sum of squared distances [m\u00b2]"}};
    std::size_t planned = 0;
    for (const std::size_t n : populations) {
        for (const std::size_t i : iterations) planned += n * i * repeats;
    }
    std::size_t done = 0;
    for (const std::size_t population : populations) {
        PlotSeries series{.name = fmt::format("population {}", population)};
        for (const std::size_t rounds : iterations) {
            std::vector<double> losses;
            std::vector<double> elsewhere;
            // The start of the default form: the good points and their opposites.
            const SearchBudget budget{.dimensions = kAllDimensions,
                                      .population = population,
                                      .evaluations = 2 * population + population * rounds};
            for (std::size_t r = 0; r < repeats; ++r) {
                const auto share = [&](std::size_t work) {
                    return static_cast<double>(work) / static_cast<double>(planned);
                };
                PartialProgress part(progress, share(done), share(done + population * rounds));
                const auto found = searchOnce(ground->training, OptimiserKind::Isma, budget,
                                              scramble({options.seed, r}), part, stop);
                if (!found) return tl::unexpected(found.error());
                if (found->cancelled) return cancelled();
                done += population * rounds;
                losses.push_back(found->best_loss);
                elsewhere.push_back(ground->elsewhere.loss(found->best).total_m2());
                report.data.rows.push_back({static_cast<double>(population), static_cast<double>(rounds),
                                            static_cast<double>(r + 1), losses.back(), elsewhere.back()});
            }
            const SampleSummary summary = summaryOf(losses);
            const bool papers = population == 100 && rounds == 1000;
            report.summary.rows.push_back(
                {static_cast<double>(population), static_cast<double>(rounds), summary.mean, summary.least,
                 summary.greatest, summaryOf(elsewhere).median, static_cast<double>(budget.evaluations),
                 std::string(papers ? "244.1655" : "below 246.5")});
            series.points.emplace_back(static_cast<double>(rounds), summary.mean);
        }
        panel.series.push_back(std::move(series));
    }
    report.plot.panels.push_back(std::move(panel));
    report.notes = {
        fmt::format(
            "{} repeats (the paper: 30), nine process noises and alpha, beta, kappa, the default form "
            "of ISMA; what the paper sums over is not said, so compare how the loss falls, not its "
            "size",
            repeats),
        "from one population and number of iterations to the next the start is the same good points, only "
        "more of them",
        fmt::format("other runs: seed {}, another ground and other errors", options.seed + 1000),
    };
    return report;
}

}  // namespace terrawalk
