// GNSS masked for a while in the logs of a survey: how far off is the track at the end?

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "app/pipeline/accuracy_measure.hpp"
#include "app/pipeline/config.hpp"
#include "app/pipeline/crossover_misfit.hpp"
#include "app/pipeline/experiments/experiments.hpp"
#include "app/pipeline/jobs.hpp"
#include "app/pipeline/outage_measure.hpp"
#include "mapping/order_statistics.hpp"

namespace terrawalk {

namespace {

struct Subject {
    Survey survey;
    std::optional<std::vector<Trajectory>> truth;
};

/// The area walk of a simulated survey whose receiver tells its velocity.
Result<Subject> simulatedSubject(std::uint64_t seed, Progress& progress, std::stop_token stop) {
    SimulationOptions simulation = accuracySimulation(seed, FaultLevel::Mild, GnssMode::Single, true);
    simulation.doppler_velocity = true;
    auto simulated = simulateSurvey(simulation, progress, std::move(stop));
    if (!simulated) return tl::unexpected(simulated.error());
    Survey survey = std::move(simulated->survey);
    survey.runs = {survey.runs.back()};
    return Subject{std::move(survey), std::vector<Trajectory>{simulated->truth.back()}};
}

Result<Subject> subjectOf(const ExperimentOptions& options, Progress& progress, std::stop_token stop) {
    if (options.survey.empty()) {
        return simulatedSubject(100 * options.seed + 1, progress, std::move(stop));
    }
    auto survey = openSurvey(options.survey, progress, std::move(stop));
    if (!survey) return tl::unexpected(survey.error());
    return Subject{std::move(*survey), std::nullopt};
}

void tabulate(const std::vector<Outage>& outages, const OutageOptions& measured, ExperimentReport& report) {
    report.summary.columns = {"outage [s]",          "method",  "median [m]",
                              "90th percentile [m]", "outages", "given up"};
    report.plot.columns = static_cast<int>(measured.lengths_s.size());
    for (const double length_s : measured.lengths_s) {
        PlotPanel panel{.title = fmt::format("{} s without GNSS", length_s),
                        .y = {.label = "error of the displacement [m]", .logarithmic = true}};
        for (const auto& [method, text] : kOutageMethodNames) {
            const std::vector<double> errors_m = outageErrors(outages, length_s, method);
            if (errors_m.empty()) continue;
            const auto given_up = std::count_if(errors_m.begin(), errors_m.end(),
                                                [](double error_m) { return !std::isfinite(error_m); });
            report.summary.rows.push_back({length_s, std::string(text), quantileOfSorted(errors_m, 0.5),
                                           quantileOfSorted(errors_m, 0.9),
                                           static_cast<double>(errors_m.size()),
                                           static_cast<double>(given_up)});
            panel.samples.push_back(
                {.name = std::string(text), .values = errors_m, .colour = static_cast<int>(method)});
        }
        report.plot.panels.push_back(std::move(panel));
    }
}

/// How well the ground heights of the whole survey agree with one another, with GNSS everywhere.
Result<std::string> agreement(const Survey& survey, FusionMethod method, Progress& progress,
                              const std::stop_token& stop) {
    PipelineConfig config;
    config.fusion.method = method;
    const auto track = trackGround(survey, config.fusion, config.ground, progress, stop);
    if (!track) return tl::unexpected(track.error());
    const CrossoverMisfit misfit = crossoverMisfit(*track);
    return fmt::format("{:.3f} m RMS, {:.3f} m median at {} places", misfit.rms_m, misfit.median_m,
                       misfit.crossovers);
}

}  // namespace

Result<ExperimentReport> runOutage(const ExperimentOptions& options, Progress& progress,
                                   std::stop_token stop) {
    PartialProgress opening(progress, 0.0, 0.1);
    const auto subject = subjectOf(options, opening, stop);
    if (!subject) return tl::unexpected(subject.error());
    OutageOptions measured;
    if (options.quick) measured.every_s = 60.0;
    PartialProgress masking(progress, 0.1, 1.0);
    const auto outages = measureOutages(subject->survey, PipelineConfig{}.fusion, measured,
                                        subject->truth ? &*subject->truth : nullptr, masking, stop);
    if (!outages) return tl::unexpected(outages.error());

    SilentProgress silent;
    const auto raw = agreement(subject->survey, FusionMethod::Raw, silent, stop);
    if (!raw) return tl::unexpected(raw.error());
    const auto fused = agreement(subject->survey, PipelineConfig{}.fusion.method, silent, stop);
    if (!fused) return tl::unexpected(fused.error());

    ExperimentReport report{.title = "GNSS outages: " + subject->survey.name,
                            .simulated = subject->truth.has_value()};
    tabulate(*outages, measured, report);
    report.data.columns = {"run", "start [s]", "outage [s]"};
    for (const auto& [method, text] : kOutageMethodNames)
        report.data.columns.push_back(fmt::format("{}, error [m]", text));
    for (const Outage& outage : *outages) {
        std::vector<Cell> row{subject->survey.runs[outage.run].id, outage.start_s, outage.length_s};
        row.insert(row.end(), outage.error_m.begin(), outage.error_m.end());
        report.data.rows.push_back(std::move(row));
    }
    report.notes = {
        fmt::format("GNSS position and velocity masked for a stretch that begins every {} s, one at a time",
                    measured.every_s),
        "error: horizontal distance between the displacement over the stretch and the reference's",
        subject->truth ? "reference: the truth of the simulation"
                       : "reference: the integral of the receiver's Doppler velocity, itself in error by a "
                         "metre or more; what is below that is no error of the track",
        fmt::format(
            "forward: fusion of a log that ends with the outage; smoothed: of one in which {} s follow; "
            "both from {} s before it, as far as the log has so much",
            measured.following_s, measured.history_s),
        fmt::format("ground heights where the track comes back within 0.5 m after 20 s or more, without an "
                    "outage: raw {}; fused {}",
                    *raw, *fused),
        "last velocity: the Doppler velocity before the outage goes on; flow: turned by the heading and "
        "summed up",
    };
    return report;
}

}  // namespace terrawalk
