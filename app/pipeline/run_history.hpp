#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/pipeline/config.hpp"
#include "app/pipeline/process.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// What makes one value of a figure better than another.
enum class Better { Less, NearerZero, Neither };

/// A number by which runs of one survey are compared.
struct FigureKind {
    std::string_view key;    ///< in files, e.g. "height_rmse_m"
    std::string_view label;  ///< e.g. "Height RMSE"
    std::string_view unit;   ///< empty for a count
    int decimals = 3;
    Better better = Better::Less;
};
/// In the order in which they are shown. Errors are those at the headline group's marks.
inline constexpr std::array<FigureKind, 9> kFigureKinds{
    {{"height_rmse_m", "Height RMSE", "m", 3, Better::Less},
     {"height_error95_m", "Height, 95 %", "m", 3, Better::Less},
     {"height_mean_m", "Height bias", "m", 3, Better::NearerZero},
     {"plan_rmse_m", "Plan RMSE", "m", 3, Better::Less},
     {"crossover_misfit_m", "Crossovers", "m", 3, Better::Less},
     {"sigma_median_m", "Median σ", "m", 3, Better::Neither},
     {"area_m2", "Area", "m²", 0, Better::Neither},
     {"ground_points", "Points", "", 0, Better::Neither},
     {"cell_m", "Cell size", "m", 2, Better::Neither}}};

/// By key; what a run cannot tell is left out.
using RunFigures = std::map<std::string, double, std::less<>>;
[[nodiscard]] RunFigures runFigures(const SurveyReport& report);

/// One figure in two runs.
struct FigureChange {
    FigureKind kind;
    double before = 0.0;
    double now = 0.0;
    double change = 0.0;  ///< of the values as they are shown, so that the three add up
    /// > 0 better, < 0 worse, 0 neither, at the decimals that are shown.
    int verdict = 0;
};
/// Of the figures that both runs have; of those that are neither good nor bad only what changed. Pure.
[[nodiscard]] std::vector<FigureChange> figureChanges(const RunFigures& before, const RunFigures& now);

/// A finished run of the pipeline, without its products.
struct PastRun {
    std::string finished;  ///< UTC, ISO 8601 with milliseconds
    std::string program;   ///< name and version
    PipelineConfig config;
    RunFigures figures;
};
inline constexpr std::size_t kPastRuns = 10;

struct RunHistory {
    std::vector<PastRun> runs;  ///< the oldest first
    std::size_t left_out = 0;   ///< runs that this version cannot read, with settings of another one perhaps
};
/// The runs of a survey; none where there is no file. Errors: BadData for a file that is something else.
[[nodiscard]] Result<RunHistory> readRunHistory(const std::filesystem::path& file);
/// Writes the last `kPastRuns` of them: of each the settings that are not defaults. The file is replaced in
/// one step. Errors: System.
[[nodiscard]] Result<void> writeRunHistory(const std::vector<PastRun>& runs,
                                           const std::filesystem::path& file);

}  // namespace terrawalk
