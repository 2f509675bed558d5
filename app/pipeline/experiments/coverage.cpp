// How often the standard errors of DEM and volume hold the truth on simulated surveys.

#include "app/pipeline/dem_coverage.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/pipeline/accuracy_measure.hpp"
#include "app/pipeline/experiments/experiments.hpp"
#include "app/pipeline/experiments/planned_surveys.hpp"

namespace terrawalk {

namespace {

struct Trial : PlannedSurvey {
    Result<DemCoverage> coverage = cancelled();
};

double withinShare(const SigmaCoverage& c) {
    return static_cast<double>(c.within) / static_cast<double>(c.n);
}

double volumeRatio(const DemCoverage& c) {
    return c.volume_error_m3 / c.volume_sigma_m3;
}

void measure(Trial& trial, const std::stop_token& stop) {
    SilentProgress silent;
    const auto simulated = simulateSurvey(
        accuracySimulation(trial.seed, trial.faults, GnssMode::Single, trial.ties), silent, stop);
    if (!simulated) {
        trial.coverage = tl::unexpected(simulated.error());
        return;
    }
    trial.coverage = measureDemCoverage(*simulated, {}, trial.seed, silent, stop);
}

}  // namespace

Result<ExperimentReport> runCoverage(const ExperimentOptions& options, Progress& progress,
                                     std::stop_token stop) {
    const std::uint64_t surveys = options.quick ? 2 : 8;
    const std::uint64_t first_seed = 100 * options.seed + 1;
    std::vector<Trial> trials;
    for (const PlannedSurvey& planned : plannedSurveys(first_seed, surveys)) {
        trials.push_back({planned, cancelled()});
    }
    const auto work = [&](Trial& trial) {
        measure(trial, stop);
    };
    if (auto done = workOnTrials(trials, work, progress, stop); !done) return tl::unexpected(done.error());

    ExperimentReport report{.title = "Standard errors of DEM and volume against the true ground"};
    report.data.columns = {"faults",
                           "marks",
                           "seed",
                           "RMS error [m]",
                           "mean sigma [m]",
                           "within 1.96 sigma",
                           "N",
                           "volume error [m3]",
                           "volume sigma [m3]",
                           "range of errors [m]"};
    report.summary.columns = {"faults",   "marks",  "within 1.96 sigma", "N", "volumes within 1.96 sigma",
                              "volume N", "surveys"};
    for (std::size_t first = 0; first < trials.size(); first += surveys) {
        const std::string level(name(trials[first].faults));
        const std::string ties = tiesText(trials[first].ties);
        PlotSeries dots{.name = "DEM", .look = SeriesLook::Points};
        double within = 0.0, square = 0.0, good = 0.0;
        SigmaCoverage volumes;
        for (std::size_t i = first; i < first + surveys; ++i) {
            const Trial& trial = trials[i];
            if (!trial.coverage) {
                report.notes.push_back(leftOutOfMeans(fmt::format("{}, {}, seed {}", level, ties, trial.seed),
                                                      trial.coverage.error()));
                continue;
            }
            const DemCoverage& c = *trial.coverage;
            report.data.rows.push_back({level, ties, static_cast<double>(trial.seed), c.rms_error_m,
                                        c.mean_sigma_m, withinShare(c.heights), c.heights.mean_square,
                                        c.volume_error_m3, c.volume_sigma_m3, c.error_range_m});
            dots.points.emplace_back(static_cast<double>(trial.seed), withinShare(c.heights));
            within += withinShare(c.heights);
            square += c.heights.mean_square;
            volumes.add(volumeRatio(c), 1.0);
            good += 1.0;
        }
        if (good > 0.0) {
            report.summary.rows.push_back(
                {level, ties, within / good, square / good, withinShare(volumes), volumes.mean_square, good});
        }
        PlotPanel panel{.title = fmt::format("faults {}, {}", level, ties),
                        .x = {.label = "seed",
                              .whole_numbers = true,
                              .range = std::pair{static_cast<double>(first_seed) - 0.5,
                                                 static_cast<double>(first_seed + surveys) - 0.5}},
                        .y = {.label = "share within 1.96 sigma", .range = std::pair{0.5, 1.0}}};
        panel.series.push_back(std::move(dots));
        report.plot.panels.push_back(std::move(panel));
    }
    report.plot.columns = 2;
    const std::vector<std::string> notes{
        fmt::format(
            "seeds {} to {}, GNSS single point, default configuration, 500 cells of each DEM drawn by "
            "lot against the true ground",
            first_seed, first_seed + surveys - 1),
        "N: mean of squared error over predicted variance, 1 for honest sigmas; 0.95 should lie within 1.96 "
        "sigma",
        "volume: above the DEM's mean height; errors hang together over the range that is predicted with "
        "them",
    };
    report.notes.insert(report.notes.begin(), notes.begin(), notes.end());
    return report;
}

}  // namespace terrawalk
