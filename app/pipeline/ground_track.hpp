#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <vector>

#include "app/pipeline/config.hpp"
#include "survey/ground_point.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// One way from the logs to the ground: with fusion, with the sensors as they are, or with the truth of a
/// simulation.
struct GroundTrack {
    std::optional<AdjustmentSummary> adjustment;
    std::vector<FusedRun> runs;            ///< one for each run of the survey, in its order
    std::vector<GroundPoint> points;       ///< run by run; local ENU
    std::vector<std::size_t> first_point;  ///< of each run, and the end
};

/// Ground points below given trajectories, one run after the other. Works on as many threads as TBB allows;
/// the result does not depend on their number. Errors: Cancelled.
/// @param runs  one for each run of the survey, each with one epoch for each epoch of its log
[[nodiscard]] Result<GroundTrack> groundBelow(const Survey& survey, std::vector<FusedRun> runs,
                                              const GroundPointOptions& ground, std::stop_token stop);

/// Fuses the survey and takes its ground points. Errors: as fuseSurvey(); Cancelled.
[[nodiscard]] Result<GroundTrack> trackGround(const Survey& survey, const FusionOptions& fusion,
                                              const GroundPointOptions& ground, Progress& progress,
                                              std::stop_token stop);

/// Those of one run, from all points in the order of `track`. Pure.
[[nodiscard]] std::vector<GroundPoint> pointsOfRun(const std::vector<GroundPoint>& points,
                                                   const GroundTrack& track, std::size_t run);

/// All points, used ones of runs that were not asked for as RunLeftOut. Pure.
[[nodiscard]] std::vector<GroundPoint> ofChosenRuns(const Survey& survey, std::vector<GroundPoint> points,
                                                    const SurfaceOptions& options);

/// The points that shall carry the surface: of the runs that were asked for, cleaned, one in each cell. What
/// is left out goes before cells are thinned, so that it stands for no cell. Errors: as cleanGroundPoints().
[[nodiscard]] Result<std::vector<GroundPoint>> surfacePoints(const Survey& survey,
                                                             std::vector<GroundPoint> points,
                                                             const SurfaceOptions& options,
                                                             Progress& progress, std::stop_token stop);

}  // namespace terrawalk
