#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "mapping/delaunay_tin.hpp"
#include "mapping/ground_points.hpp"
#include "mapping/height_interpolator.hpp"
#include "mapping/point_cleaning.hpp"
#include "mapping/space_occupancy.hpp"
#include "mapping/terrace_edges.hpp"
#include "survey/result.hpp"
#include "survey/survey_edits.hpp"
#include "survey/survey_report.hpp"

namespace terrawalk {

/// How the surface is made from the ground points.
struct SurfaceOptions {
    double thinning_cell_m = 0.5;  ///< one point stands for each cell of this size; 0: all points
    bool fixed_point_runs = true;  ///< ground points of fixed-point runs count as well
    /// Statistical outliers go by themselves: their measure has no scale of its own, and never did harm.
    PointCleaningOptions cleaning{.statistical = {.use = true}, .radius = {}, .above_ground = {}};
    TinOptions tin;
    std::optional<InterpolationMethod> method =
        InterpolationMethod::Linear;  ///< nothing: by cross-validation
    TerraceEdgeUse terrace_edges = TerraceEdgeUse::Auto;
    bool cross_validate = true;  ///< methods are compared even where one is named
    double cell_m = 0.0;         ///< of the DEM; 0: from the density of the points
    bool map_space = false;      ///< the space above the ground that the laser crossed as well
    SpaceMapOptions space;
    bool multiband = false;  ///< heights and their standard errors in one file as well
};

struct ReportOptions {
    double nearest_sample_limit_m = 3.0;  ///< a mark farther than this from any ground point is not compared
    double vertical_class_m = 0.0;        ///< RMSE_V that the surface is tested for; 0: none
    ReportLanguage language = ReportLanguage::English;
};

/// Everything that decides the result of a run of the pipeline; one value, the same for every front end.
struct PipelineConfig {
    FusionOptions fusion;
    GroundPointOptions ground;
    SurfaceOptions surface;
    ReportOptions report;
    SurveyEdits edits;       ///< already made in the survey that process() gets
    std::uint64_t seed = 1;  ///< of the confidence intervals in the report
    /// How the values came about, where `terrawalk tune` made them: for the report, without effect on the
    /// products.
    std::optional<TuningRecord> tuning;
};

/// One parameter as text, for `terrawalk config describe`.
struct ParameterInfo {
    std::string key;  ///< e.g. "fusion.gnss.sigma_single_m"
    std::string default_value;
    std::string range;  ///< permitted values
    std::string meaning;
};
[[nodiscard]] std::vector<ParameterInfo> describeParameters();

/// Sets one parameter from text, "key=value". Errors: Usage for an unknown key (with the nearest known one),
/// a value of another type or out of range.
[[nodiscard]] Result<void> applySetting(PipelineConfig& config, std::string_view assignment);

/// The value of one parameter as text that `applySetting` takes; empty for an unknown key.
[[nodiscard]] std::string settingText(const PipelineConfig& config, std::string_view key);

/// Overlays a JSON file on the configuration; keys that it lacks keep their value. Errors: BadData with file
/// and, for broken JSON, line; unknown keys are refused. The section "tuning" is carried into
/// `PipelineConfig::tuning`.
[[nodiscard]] Result<void> applyConfigFile(PipelineConfig& config, const std::filesystem::path& file);

/// The whole configuration as JSON text, readable by `applyConfigFile`; exact for every value.
[[nodiscard]] std::string toJson(const PipelineConfig& config);

/// What was asked for beside what was used: `requested` differs where the pipeline had to choose a value.
[[nodiscard]] std::vector<UsedSetting> settingsReport(const PipelineConfig& requested,
                                                      const PipelineConfig& used);

}  // namespace terrawalk
