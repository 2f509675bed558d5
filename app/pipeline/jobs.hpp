#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "app/pipeline/config.hpp"
#include "app/pipeline/inspect.hpp"
#include "app/pipeline/process.hpp"
#include "app/pipeline/tune.hpp"
#include "fusion/simulation.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

// Jobs from files to files: what a front end starts when its user presses a button. Each takes a Progress
// over the whole job and returns `Cancelled` soon after a stop was requested; nothing half-written stays
// behind.

/// Reads the survey of a project file, or of the survey.json in a folder, and makes the edits. Errors: as
/// readSurvey() and withEdits().
[[nodiscard]] Result<Survey> openSurvey(const std::filesystem::path& project_file_or_folder,
                                        Progress& progress, std::stop_token stop,
                                        const SurveyEdits& edits = {});

/// Reads, processes, and writes the products into `output`. The returned products are those that were
/// written.
/// @param tuning  tune the configured method on the survey's own marks first, and use the tuned values where
///                they do better on marks left out
[[nodiscard]] Result<Products> processSurvey(const std::filesystem::path& project_file_or_folder,
                                             const PipelineConfig& config, const Provenance& provenance,
                                             const std::filesystem::path& output, Progress& progress,
                                             std::stop_token stop,
                                             const std::optional<TuneOptions>& tuning = {});

/// Writes products that process() made of this survey into `output`: the same files as processSurvey(), byte
/// for byte. Errors: Usage for a folder that holds something else, or the survey itself; System; Cancelled.
[[nodiscard]] Result<void> saveProducts(const Survey& survey, const Products& products,
                                        const Provenance& provenance, const std::filesystem::path& output,
                                        Progress& progress, std::stop_token stop);

/// Writes a simulated survey with its truth: survey.json, control.csv, logs/, truth/ and manifest.json.
[[nodiscard]] Result<void> simulateSurveyFolder(const SimulationOptions& options,
                                                const std::filesystem::path& output, Progress& progress,
                                                std::stop_token stop);

/// Looks into a project file, a folder with one, or a single log.
[[nodiscard]] Result<std::vector<LogSummary>> inspectFiles(const std::filesystem::path& path,
                                                           Progress& progress, std::stop_token stop);

}  // namespace terrawalk
