#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "app/pipeline/config.hpp"
#include "app/pipeline/experiment.hpp"
#include "app/pipeline/process.hpp"
#include "fusion/fusion_options.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// A method as it is compared.
struct ComparedMethod {
    std::string name;  ///< as in kFusionMethodNames; the paper's method once for each filter: "aukf ekf"
    FusionOptions fusion;
};

/// Every method that there is, each with the parameters of `options`.
[[nodiscard]] std::vector<ComparedMethod> comparedMethods(const FusionOptions& options);

/// n errors and one measure of them.
struct MeasuredError {
    std::size_t n = 0;
    double error_m = 0.0;  ///< without meaning when n is 0
};

/// What came of one method.
struct MethodOutcome {
    std::string name;
    std::string failure;    ///< why there is no result, or no surface; empty when all went well
    double fusion_s = 0.0;  ///< wall time of fusion alone
    // RMSE of the array while it stood on marks that the method was not tied to there.
    MeasuredError target_horizontal, target_vertical;  ///< ends of fixed-point runs
    MeasuredError stop_horizontal, stop_vertical;      ///< other stands
    // Check marks that every method reaches.
    MeasuredError check_surface;  ///< RMSE of the surface's height
    MeasuredError check_nearest;  ///< mean absolute height error of the nearest ground sample, paper 000
    // RMSE of the array against the truth, over all epochs; only where the survey has its truth.
    MeasuredError area_horizontal, area_vertical;
    MeasuredError fixed_horizontal, fixed_vertical;  ///< fixed-point runs
    /// Mean of d' P^-1 d over 3, d the error of the position against the truth: 1 for honest sigmas.
    MeasuredError nees;
    std::vector<SensorConsistency> consistency;  ///< over all runs; empty where the method does not tell
};

struct MethodComparison {
    std::string survey_name;
    bool has_truth = false;
    std::vector<MethodOutcome> outcomes;  ///< in the order of comparedMethods()
};

/// The true trajectories that the simulator writes beside a survey: truth/<run>.csv. Nothing for runs
/// without. Errors: as readTrajectoryCsv().
[[nodiscard]] Result<std::vector<std::optional<Trajectory>>> readTruth(const Survey& survey);

/// Runs all methods over a survey and measures them in the same way. A method that fails says why and stops
/// none of the others. Surfaces are made as process() makes them, but in local ENU. Errors: Cancelled.
/// @param truth  one for each run of the survey; epochs are matched by their times
/// Pure but for the times.
[[nodiscard]] Result<MethodComparison> compareMethods(const Survey& survey,
                                                      const std::vector<std::optional<Trajectory>>& truth,
                                                      const PipelineConfig& config, Progress& progress,
                                                      std::stop_token stop);

/// One row for each method; `errorTable` what it makes wrong, `consistencyTable` how well it knows, and how
/// long it takes.
[[nodiscard]] ExperimentTable errorTable(const MethodComparison& comparison);
[[nodiscard]] ExperimentTable consistencyTable(const MethodComparison& comparison);
/// Both side by side, with the numbers of comparisons: the CSV file.
[[nodiscard]] ExperimentTable fullTable(const MethodComparison& comparison);

[[nodiscard]] std::string toText(const MethodComparison& comparison);
[[nodiscard]] std::string toJson(const MethodComparison& comparison, const std::filesystem::path& output);

/// Reads a survey with its truth, compares, and writes comparison.csv, comparison.txt and manifest.json into
/// `output` unless that is empty. Errors: as readSurvey(), readTruth(), OutputFolder.
[[nodiscard]] Result<MethodComparison> compareSurvey(const std::filesystem::path& project_file_or_folder,
                                                     const PipelineConfig& config,
                                                     const Provenance& provenance,
                                                     const std::filesystem::path& output, Progress& progress,
                                                     std::stop_token stop);

}  // namespace terrawalk
