// Accuracy on simulated surveys against their truth, by level of faults, with and without ties.

#include "app/pipeline/accuracy_measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "app/pipeline/config.hpp"
#include "app/pipeline/experiments/experiments.hpp"
#include "app/pipeline/experiments/planned_surveys.hpp"

namespace terrawalk {

namespace {

constexpr std::array kMeasures{
    AccuracyColumn{"H [m]", &AccuracyMeasures::mean_horizontal_error_m},
    AccuracyColumn{"Z [m]", &AccuracyMeasures::mean_height_error_m},
    AccuracyColumn{"CK [m]", &AccuracyMeasures::check_point_error_m},
    AccuracyColumn{"CK floor [m]", &AccuracyMeasures::check_point_floor_m},
    AccuracyColumn{"CK/floor", &AccuracyMeasures::check_point_ratio},
    AccuracyColumn{"S [m]", &AccuracyMeasures::surface_error_m},
    AccuracyColumn{"S floor [m]", &AccuracyMeasures::surface_floor_m},
    AccuracyColumn{"S/floor", &AccuracyMeasures::surface_ratio},
    AccuracyColumn{"N up", &AccuracyMeasures::normalized_height_error},
    AccuracyColumn{"N plan", &AccuracyMeasures::normalized_horizontal_error},
    AccuracyColumn{"within 1.96 sigma up", &AccuracyMeasures::height_coverage},
    AccuracyColumn{"end H RMS [m]", &AccuracyMeasures::rms_end_horizontal_m},
    AccuracyColumn{"end Z RMS [m]", &AccuracyMeasures::rms_end_height_m},
};

struct Method {
    std::string name;
    PipelineConfig config;
};

/// The sensors as they are, the plain filter, and what the program does when nothing is asked.
Result<std::vector<Method>> methods() {
    std::vector<std::string> names{"raw", "ukf"};
    for (const ParameterInfo& parameter : describeParameters()) {
        const bool other = std::find(names.begin(), names.end(), parameter.default_value) == names.end();
        if (parameter.key == "fusion.method" && other) names.push_back(parameter.default_value);
    }
    std::vector<Method> list;
    for (const std::string& name : names) {
        Method method{name, {}};
        if (auto set = applySetting(method.config, "fusion.method=" + name); !set) {
            return tl::unexpected(set.error());
        }
        list.push_back(std::move(method));
    }
    return list;
}

/// One simulated survey and what each method made of it.
struct Trial : PlannedSurvey {
    std::vector<Result<AccuracyMeasures>> measured;
};

void measure(Trial& trial, const std::vector<Method>& methods, const std::stop_token& stop) {
    SilentProgress silent;
    const auto simulated = simulateSurvey(
        accuracySimulation(trial.seed, trial.faults, GnssMode::Single, trial.ties), silent, stop);
    for (const Method& method : methods) {
        if (simulated) {
            trial.measured.push_back(measureAccuracy(*simulated, method.config, trial.seed, silent, stop));
        } else {
            trial.measured.emplace_back(tl::unexpected(simulated.error()));
        }
    }
}

/// The rows of one method in the trials of one level, and their line in the summary.
void addGroup(std::span<const Trial> trials, std::size_t m, const std::string& method,
              ExperimentReport& report, PlotPanel& panel) {
    const std::string level(name(trials.front().faults));
    const std::string ties = tiesText(trials.front().ties);
    PlotSeries dots{.name = method, .look = SeriesLook::Points, .colour = static_cast<int>(m)};
    std::vector<AccuracyMeasures> good;
    for (const Trial& trial : trials) {
        const Result<AccuracyMeasures>& measured = trial.measured[m];
        if (!measured) {
            report.notes.push_back(leftOutOfMeans(
                fmt::format("{}, {}, seed {}, {}", level, ties, trial.seed, method), measured.error()));
            continue;
        }
        good.push_back(*measured);
        std::vector<Cell> row{level, ties, method, static_cast<double>(trial.seed)};
        for (const AccuracyColumn& column : kMeasures) row.emplace_back((*measured).*column.value);
        report.data.rows.push_back(std::move(row));
        dots.points.emplace_back(static_cast<double>(trial.seed), measured->check_point_ratio);
    }
    panel.series.push_back(std::move(dots));
    if (good.empty()) return;
    std::vector<Cell> row{level, ties, method};
    for (const AccuracyColumn& column : kMeasures) {
        double sum = 0.0;
        for (const AccuracyMeasures& one : good) sum += one.*column.value;
        row.emplace_back(sum / static_cast<double>(good.size()));
    }
    const auto [least, greatest] = std::minmax_element(
        good.begin(), good.end(), [](const AccuracyMeasures& a, const AccuracyMeasures& b) {
            return a.check_point_ratio < b.check_point_ratio;
        });
    row.emplace_back(fmt::format("{:.2f} to {:.2f}", least->check_point_ratio, greatest->check_point_ratio));
    row.emplace_back(static_cast<double>(good.size()));
    report.summary.rows.push_back(std::move(row));
}

/// One range for all panels, so that they can be compared at a glance.
void shareHeightAxis(Plot& plot) {
    std::vector<double> ratios;
    for (const PlotPanel& panel : plot.panels) {
        for (const PlotSeries& series : panel.series) {
            for (const auto& [seed, ratio] : series.points) ratios.push_back(ratio);
        }
    }
    if (ratios.empty()) return;
    const auto [least, greatest] = std::minmax_element(ratios.begin(), ratios.end());
    for (PlotPanel& panel : plot.panels) panel.y.range = std::pair{0.95 * *least, 1.05 * *greatest};
}

}  // namespace

Result<ExperimentReport> runAccuracy(const ExperimentOptions& options, Progress& progress,
                                     std::stop_token stop) {
    const auto compared = methods();
    if (!compared) return tl::unexpected(compared.error());
    const std::uint64_t surveys = options.quick ? 2 : 8;
    const std::uint64_t first_seed = 100 * options.seed + 1;
    std::vector<Trial> trials;
    for (const PlannedSurvey& planned : plannedSurveys(first_seed, surveys)) trials.push_back({planned, {}});
    const auto work = [&](Trial& trial) {
        measure(trial, *compared, stop);
    };
    if (auto done = workOnTrials(trials, work, progress, stop); !done) return tl::unexpected(done.error());

    ExperimentReport report{.title = "Accuracy on simulated surveys against their truth"};
    report.summary.columns = {"faults", "marks", "method"};
    report.data.columns = {"faults", "marks", "method", "seed"};
    for (const AccuracyColumn& column : kMeasures) {
        report.summary.columns.emplace_back(column.name);
        report.data.columns.emplace_back(column.name);
    }
    report.summary.columns.insert(report.summary.columns.end(), {"CK/floor, range", "surveys"});
    report.plot.columns = 2;
    for (std::size_t first = 0; first < trials.size(); first += surveys) {
        const auto group = std::span<const Trial>(trials).subspan(first, surveys);
        PlotPanel panel{
            .title = fmt::format("faults {}, {}", name(group.front().faults), tiesText(group.front().ties)),
            .x = {.label = "seed",
                  .whole_numbers = true,
                  .range = std::pair{static_cast<double>(first_seed) - 0.5,
                                     static_cast<double>(first_seed + surveys) - 0.5}},
            .y = {.label = "check point error over floor", .logarithmic = true}};
        for (std::size_t m = 0; m < compared->size(); ++m) {
            addGroup(group, m, (*compared)[m].name, report, panel);
        }
        report.plot.panels.push_back(std::move(panel));
    }
    shareHeightAxis(report.plot);
    const std::vector<std::string> notes{
        fmt::format("seeds {} to {}, {} epochs of area walk and {} fixed-point runs each, GNSS single point",
                    first_seed, first_seed + surveys - 1, SimulationOptions{}.area_epochs,
                    SimulationOptions{}.fixed_point_runs),
        "H, Z: mean horizontal and absolute height error of the array on the area walk; end H, end Z: at "
        "the targets of the fixed-point runs, over the last still seconds",
        "CK: mean absolute height error at 500 random check points by the nearest ground sample, as in paper "
        "000; S: by the triangulated surface; floor: the same with the true trajectory",
        "N: mean of squared error over predicted variance, 1 for honest sigmas; 0.95 of the heights should "
        "lie within 1.96 sigma",
        "without ties: no control stops and no end on ZERO; the start is known in both",
    };
    report.notes.insert(report.notes.begin(), notes.begin(), notes.end());
    return report;
}

}  // namespace terrawalk
