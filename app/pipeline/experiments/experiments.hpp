#pragma once

#include "app/pipeline/experiment.hpp"

namespace terrawalk {

// The experiments, one file each. To add one: its file, its line here, its line in `experiments()`.

[[nodiscard]] Result<ExperimentReport> runFig7(const ExperimentOptions& options, Progress& progress,
                                               std::stop_token stop);
[[nodiscard]] Result<ExperimentReport> runFig8(const ExperimentOptions& options, Progress& progress,
                                               std::stop_token stop);
[[nodiscard]] Result<ExperimentReport> runFig10(const ExperimentOptions& options, Progress& progress,
                                                std::stop_token stop);
[[nodiscard]] Result<ExperimentReport> runFig11(const ExperimentOptions& options, Progress& progress,
                                                std::stop_token stop);
[[nodiscard]] Result<ExperimentReport> runFig12(const ExperimentOptions& options, Progress& progress,
                                                std::stop_token stop);
[[nodiscard]] Result<ExperimentReport> runFig13(const ExperimentOptions& options, Progress& progress,
                                                std::stop_token stop);
[[nodiscard]] Result<ExperimentReport> runFig14(const ExperimentOptions& options, Progress& progress,
                                                std::stop_token stop);
[[nodiscard]] Result<ExperimentReport> runFig15(const ExperimentOptions& options, Progress& progress,
                                                std::stop_token stop);

[[nodiscard]] Result<ExperimentReport> runAccuracy(const ExperimentOptions& options, Progress& progress,
                                                   std::stop_token stop);
[[nodiscard]] Result<ExperimentReport> runRobustness(const ExperimentOptions& options, Progress& progress,
                                                     std::stop_token stop);
[[nodiscard]] Result<ExperimentReport> runCoverage(const ExperimentOptions& options, Progress& progress,
                                                   std::stop_token stop);
[[nodiscard]] Result<ExperimentReport> runOutage(const ExperimentOptions& options, Progress& progress,
                                                 std::stop_token stop);

}  // namespace terrawalk
