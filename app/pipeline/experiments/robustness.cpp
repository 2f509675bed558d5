// What the estimator bears: simulated surveys of a good day, one kind of disturbance at a time.

#include <fmt/format.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/pipeline/accuracy_measure.hpp"
#include "app/pipeline/experiments/experiments.hpp"
#include "app/pipeline/experiments/planned_surveys.hpp"
#include "fusion/disturbance.hpp"

namespace terrawalk {

namespace {

constexpr std::array kMeasures{
    AccuracyColumn{"H [m]", &AccuracyMeasures::mean_horizontal_error_m},
    AccuracyColumn{"CK/floor", &AccuracyMeasures::check_point_ratio},
    AccuracyColumn{"S/floor", &AccuracyMeasures::surface_ratio},
    AccuracyColumn{"N up", &AccuracyMeasures::normalized_height_error},
    AccuracyColumn{"N plan", &AccuracyMeasures::normalized_horizontal_error},
    AccuracyColumn{"within 1.96 sigma up", &AccuracyMeasures::height_coverage},
};

struct Trial {
    std::optional<Disturbance> disturbance;
    bool ties = true;
    std::uint64_t seed = 0;
    Result<AccuracyMeasures> measured = AccuracyMeasures{};
};

std::string label(const std::optional<Disturbance>& disturbance) {
    return disturbance ? std::string(name(*disturbance)) : "none";
}

/// Trials of one disturbance, with ties or without, lie side by side.
std::vector<Trial> plannedTrials(std::uint64_t first_seed, std::uint64_t surveys) {
    std::vector<std::optional<Disturbance>> disturbances{std::nullopt};
    for (const auto& [disturbance, text] : kDisturbanceNames) disturbances.emplace_back(disturbance);
    std::vector<Trial> trials;
    for (const bool ties : {true, false}) {
        for (const auto& disturbance : disturbances) {
            for (std::uint64_t k = 0; k < surveys; ++k) {
                trials.push_back({.disturbance = disturbance, .ties = ties, .seed = first_seed + k});
            }
        }
    }
    return trials;
}

void measure(Trial& trial, const std::stop_token& stop) {
    SilentProgress silent;
    SimulationOptions options =
        accuracySimulation(trial.seed, FaultLevel::Mild, GnssMode::Single, trial.ties);
    if (trial.disturbance) options.disturbances.push_back(*trial.disturbance);
    const auto simulated = simulateSurvey(options, silent, stop);
    if (simulated) {
        trial.measured = measureAccuracy(*simulated, PipelineConfig{}, trial.seed, silent, stop);
    } else {
        trial.measured = tl::unexpected(simulated.error());
    }
}

void addGroup(std::span<const Trial> trials, ExperimentReport& report, PlotPanel& panel) {
    const std::string disturbance = label(trials.front().disturbance);
    const std::string ties = tiesText(trials.front().ties);
    PlotSample sample{.name = disturbance};
    std::array<double, kMeasures.size()> sums{};
    double good = 0.0;
    for (const Trial& trial : trials) {
        if (!trial.measured) {
            report.notes.push_back(leftOutOfMeans(
                fmt::format("{}, {}, seed {}", disturbance, ties, trial.seed), trial.measured.error()));
            continue;
        }
        std::vector<Cell> row{disturbance, ties, static_cast<double>(trial.seed)};
        for (std::size_t m = 0; m < kMeasures.size(); ++m) {
            const double value = (*trial.measured).*kMeasures[m].value;
            row.emplace_back(value);
            sums[m] += value;
        }
        good += 1.0;
        report.data.rows.push_back(std::move(row));
        sample.values.push_back(trial.measured->check_point_ratio);
    }
    if (good == 0.0) return;
    panel.samples.push_back(std::move(sample));
    std::vector<Cell> row{disturbance, ties};
    for (const double sum : sums) row.emplace_back(sum / good);
    row.emplace_back(good);
    report.summary.rows.push_back(std::move(row));
}

}  // namespace

Result<ExperimentReport> runRobustness(const ExperimentOptions& options, Progress& progress,
                                       std::stop_token stop) {
    const std::uint64_t surveys = options.quick ? 1 : 8;
    const std::uint64_t first_seed = 100 * options.seed + 1;
    std::vector<Trial> trials = plannedTrials(first_seed, surveys);
    const auto work = [&](Trial& trial) {
        measure(trial, stop);
    };
    if (auto done = workOnTrials(trials, work, progress, stop); !done) return tl::unexpected(done.error());

    ExperimentReport report{.title = "Errors that no level of faults has"};
    report.summary.columns = {"disturbance", "marks"};
    report.data.columns = {"disturbance", "marks", "seed"};
    for (const AccuracyColumn& column : kMeasures) {
        report.summary.columns.emplace_back(column.name);
        report.data.columns.emplace_back(column.name);
    }
    report.summary.columns.emplace_back("surveys");
    for (std::size_t first = 0; first < trials.size(); first += surveys) {
        const auto group = std::span<const Trial>(trials).subspan(first, surveys);
        const std::string ties = tiesText(group.front().ties);
        if (report.plot.panels.empty() || report.plot.panels.back().title != ties) {
            report.plot.panels.push_back(
                {.title = ties, .y = {.label = "check point error over floor", .logarithmic = true}});
        }
        addGroup(group, report, report.plot.panels.back());
    }
    const std::vector<std::string> notes{
        fmt::format("seeds {} to {}, faults mild, GNSS single point; one disturbance at a time", first_seed,
                    first_seed + surveys - 1),
        "H: mean horizontal error of the array on the area walk",
        "CK: mean absolute height error at 500 random check points by the nearest ground sample, as in paper "
        "000; S: by the triangulated surface; floor: the same with the true trajectory and the same ranges",
        "N: mean of squared error over predicted variance, 1 for honest sigmas; 0.95 of the heights should "
        "lie within 1.96 sigma",
    };
    report.notes.insert(report.notes.begin(), notes.begin(), notes.end());
    return report;
}

}  // namespace terrawalk
