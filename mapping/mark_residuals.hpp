#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "survey/ground_point.hpp"
#include "survey/mark_stands.hpp"
#include "survey/survey.hpp"
#include "survey/survey_report.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// Comparisons with marks, and those that could not be made. All differences are product - mark, local ENU
/// [m]. Every function here is pure and safe from any thread.
struct MarkResiduals {
    std::vector<Residual> residuals;
    std::vector<MissingResidual> missing;
};

/// Names of the marks to which the estimator is tied somewhere in the survey. Give the later functions an
/// empty set for products that no estimator made (before fusion, raw).
[[nodiscard]] std::set<std::string> tiedMarks(const Survey& survey, const StandOptions& options);

/// The array while it stood on a mark: in plan its own position, for it is the array that is held over a mark
/// and not the spot that a tilted laser hits; in height the ground that the range finder saw. Each axis is
/// the median over the epochs of the stand, so that single bad ranges do no harm. Counts every epoch with a
/// sound range, thinned or not, unsure of its position or not: to leave unsure positions out would hide the
/// worst errors. The sigma is the median of the epochs' sigmas, undivided because errors within a second or
/// two are one error, with the mark's own. A start mark to which the estimator may be tied is left out:
/// heights are counted from there in every method.
/// @param trajectory  of this run
/// @param points  those of this run, any order
/// @param tied    whether the estimator was tied to the stands that allow it
[[nodiscard]] MarkResiduals positionResiduals(const Run& run, const std::vector<MarkStand>& stands,
                                              const Trajectory& trajectory,
                                              const std::vector<GroundPoint>& points, Stage stage, bool tied);

struct SurfaceHeight {
    double height_m = kMissing;  ///< in the frame of the place's u
    double sigma_m = kMissing;   ///< missing where none is predicted
    double slope = kMissing;     ///< rise over run; missing where it is not known
};
/// The surface at a place, local ENU [m]; nothing where there is none.
using SurfaceHeightAt = std::function<std::optional<SurfaceHeight>(const Eigen::Vector3d& place_enu_m)>;

struct NearestSampleOptions {
    double greatest_distance_m = 3.0;  ///< in plan; farther points say nothing of a mark
};
/// Height of the sound ground point (used or thinned) nearest to each mark in plan, the measure of paper 000.
/// Holds the ground's slope between point and mark, so it is no smaller than the slope times the distance. Of
/// points equally near the first in (run, epoch) counts. One pass over the points: milliseconds for a
/// million.
///
///     sigma^2 = sigma_point^2 + (slope sigma_plan)^2 + (surface at the point - surface at the mark)^2 +
///               sigma_mark^2
///
/// as the ground between both is no error of the point, but part of the difference all the same. Missing
/// where there is no surface at one of them, or none at all.
/// @param points  of any runs; `run` is an index into survey.runs
/// @param surface_height  the best that is known of the ground, with its slopes; empty: nothing is
[[nodiscard]] MarkResiduals nearestSampleResiduals(const Survey& survey,
                                                   const std::vector<GroundPoint>& points, Stage stage,
                                                   const std::set<std::string>& tied_marks,
                                                   const NearestSampleOptions& options = {},
                                                   const SurfaceHeightAt& surface_height = {});

/// Open when none of at least three hits of the range finder within 1 m of the mark is on something that
/// stands on the ground, vegetated when one is. Call for points that were cleaned with AboveGroundOptions;
/// without, no hit says anything.
[[nodiscard]] GroundCover coverAt(const ControlMark& mark, const std::vector<GroundPoint>& cleaned);

/// Height of the surface at each mark. The sigma is that of the surface and of the mark.
[[nodiscard]] MarkResiduals surfaceResiduals(const std::vector<ControlMark>& marks,
                                             const SurfaceHeightAt& surface_height, Stage stage,
                                             const std::set<std::string>& tied_marks);

}  // namespace terrawalk
