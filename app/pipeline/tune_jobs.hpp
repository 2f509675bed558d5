#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

#include "app/pipeline/tune.hpp"
#include "app/pipeline/tune_trace.hpp"

namespace terrawalk {

struct TuneFiles {
    std::filesystem::path output = "params.json";  ///< replaced only if it holds parameters already
    std::filesystem::path checkpoint;              ///< empty: `output` with ".checkpoint" at its end
    bool resume = false;                           ///< go on from the checkpoint

    [[nodiscard]] std::filesystem::path checkpointFile() const;
};

/// A finished tuning, and the name of the survey it was made on.
struct TunedSurvey {
    std::string survey;
    TuneOutcome outcome;
};

/// Reads a survey, tunes the configured method on it and writes the parameters. A cancelled tuning leaves its
/// checkpoint and says so; a finished one removes it.
/// Errors: as tunableProblem() and tune(); Usage for an output that is something else, and for a checkpoint
/// that would be overwritten; BadData for one that cannot be resumed from; System.
[[nodiscard]] Result<TunedSurvey> tuneSurvey(const std::filesystem::path& project_file_or_folder,
                                             const PipelineConfig& config, const TuneOptions& options,
                                             const TuneFiles& files, Progress& progress,
                                             std::stop_token stop);

/// A configuration after a search, and how that went.
struct TunedConfig {
    PipelineConfig config;
    double loss = 0.0;  ///< least that was found
    TuneTrace trace;
};
/// As tunedWhereBetter().
[[nodiscard]] Result<TunedConfig> tunedWithTrace(const Survey& survey, PipelineConfig config,
                                                 const TuneOptions& options, Progress& progress,
                                                 std::stop_token stop);

/// The configuration with tuned values where these hold out better than those that it has, and as it is where
/// they do not; `tuning` tells which, and why.
[[nodiscard]] Result<PipelineConfig> tunedWhereBetter(const Survey& survey, PipelineConfig config,
                                                      const TuneOptions& options, Progress& progress,
                                                      std::stop_token stop);

}  // namespace terrawalk
