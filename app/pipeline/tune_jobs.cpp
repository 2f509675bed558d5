#include "app/pipeline/tune_jobs.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/pipeline/jobs.hpp"
#include "app/pipeline/tune_checkpoint.hpp"
#include "app/pipeline/tune_file.hpp"
#include "app/pipeline/version.hpp"
#include "io/output_folder.hpp"
#include "io/replacing_file.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

/// Said at once, not after the work.
Result<void> checkedOutput(const fs::path& file) {
    std::error_code error;
    if (fs::exists(file, error)) {
        std::ifstream stream(file, std::ios::binary);
        const auto document = nlohmann::json::parse(stream, nullptr, false);
        if (!document.is_object() || document.value("format", nlohmann::json()) != "terrawalk-config 1") {
            return usageError(fmt::format("{} exists and holds no parameters", file.string()),
                              "choose another file for the output");
        }
    }
    const auto writable = ReplacingFile::create(file);
    if (!writable) return tl::unexpected(writable.error());
    return {};
}

TuneIdentity identityOf(const Survey& survey, const TunableProblem& problem, const TuneOptions& options) {
    return {.program = programVersion(),
            .survey = surveyFingerprint(survey),
            .configuration = problem.fingerprint,
            .search = fmt::format(
                "method {}, {} parameters, optimiser {}, population {}, {} iterations, {} starts, seed {}",
                problem.method, problem.parameters.size(), name(options.optimiser), options.population,
                options.iterations, options.restarts, options.seed)};
}

Result<TuneOutcome> tuneRecorded(const TunableProblem& problem, const PipelineConfig& config,
                                 const TuneOptions& options, TuneCheckpoint& checkpoint, Progress& progress,
                                 const std::stop_token& stop) {
    const TuneRecording recording{
        .resume_from = &checkpoint.read(),
        .on_search = [&](std::size_t search,
                         std::uint64_t fingerprint) { checkpoint.onSearch(search, fingerprint); },
        .on_losses =
            [&](std::size_t search, std::size_t island, std::span<const double> losses) {
                checkpoint.onLosses(search, island, losses);
            }};
    auto outcome = tune(problem, config, options, progress, stop, recording);
    if (outcome) return outcome;
    Error error = outcome.error();
    if (error.kind == ErrorKind::BadData && error.file.empty()) error.file = checkpoint.file();
    if (error.kind == ErrorKind::Cancelled && !checkpoint.isEmpty()) {
        if (auto written = checkpoint.write(); !written) return tl::unexpected(written.error());
        error.message = fmt::format("cancelled; the work so far is in {}", checkpoint.file().string());
        error.cure = "continue with the same command and --resume";
    }
    return tl::unexpected(error);
}

}  // namespace

fs::path TuneFiles::checkpointFile() const {
    return checkpoint.empty() ? fs::path(output.string() + ".checkpoint") : checkpoint;
}

Result<TunedSurvey> tuneSurvey(const fs::path& path, const PipelineConfig& config, const TuneOptions& options,
                               const TuneFiles& files, Progress& progress, std::stop_token stop) {
    if (auto good = checkedOutput(files.output); !good) return tl::unexpected(good.error());
    PartialProgress reading(progress, 0.0, 0.02);
    const auto survey = openSurvey(path, reading, stop, config.edits);
    if (!survey) return tl::unexpected(survey.error());
    const auto problem = tunableProblem(*survey, config, options.hyperparameters, stop);
    if (!problem) return tl::unexpected(problem.error());
    const TuneIdentity identity = identityOf(*survey, *problem, usedOptions(*problem, options));
    auto checkpoint = files.resume ? TuneCheckpoint::resume(files.checkpointFile(), identity)
                                   : TuneCheckpoint::begin(files.checkpointFile(), identity);
    if (!checkpoint) return tl::unexpected(checkpoint.error());
    PartialProgress tuning(progress, 0.02, 1.0);
    auto outcome = tuneRecorded(*problem, config, options, *checkpoint, tuning, stop);
    if (!outcome) return tl::unexpected(outcome.error());
    if (auto written = writeTextFile(tuneFileText(*outcome, survey->name), files.output); !written) {
        return tl::unexpected(written.error());
    }
    checkpoint->remove();
    return TunedSurvey{survey->name, std::move(*outcome)};
}

Result<TunedConfig> tunedWithTrace(const Survey& survey, PipelineConfig config, const TuneOptions& options,
                                   Progress& progress, std::stop_token stop) {
    const auto problem = tunableProblem(survey, config, options.hyperparameters, stop);
    if (!problem) return tl::unexpected(problem.error());
    auto outcome = tune(*problem, config, options, progress, stop);
    if (!outcome) return tl::unexpected(outcome.error());
    TuneTrace trace = traceOf(*outcome);
    const double loss = totalLoss(outcome->after);
    TuningRecord record = tuningRecord(*outcome, survey.name);
    record.in_use = outcome->holds_out_better;
    if (record.in_use) config = std::move(outcome->tuned);
    config.tuning = std::move(record);
    return TunedConfig{std::move(config), loss, std::move(trace)};
}

Result<PipelineConfig> tunedWhereBetter(const Survey& survey, PipelineConfig config,
                                        const TuneOptions& options, Progress& progress,
                                        std::stop_token stop) {
    auto tuned = tunedWithTrace(survey, std::move(config), options, progress, std::move(stop));
    if (!tuned) return tl::unexpected(tuned.error());
    return std::move(tuned->config);
}

}  // namespace terrawalk
