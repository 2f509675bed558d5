#pragma once

#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "fusion/crossovers.hpp"
#include "fusion/fusion_options.hpp"
#include "fusion/run_start.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

struct JointSolution {
    std::vector<Trajectory> trajectories;  ///< in the order of the runs
    std::vector<Crossover> crossovers;     ///< with the misfits that are left
    AdjustmentSummary summary;
};

/// One sparse least-squares adjustment of all runs: track, GNSS, barometer, heading and flow errors, held
/// together by ties to known marks and by crossovers, pairs of passes over the same ground.
///
///     GNSS   z = p + g + d + noise       g: Gauss-Markov, begun anew where the fix code changes;
///                                        d: in plan and without RTK, of the run, most of it of the day
///     baro   h = u + b + w + noise       b: random walk, w: Gauss-Markov (gusts)
///     flow   p(t2) - p(t1) = sum R(yaw - psi - A sin yaw - B cos yaw) f dt / scale
///            scale: constant in a run; Gauss-Markov beside, where residuals show that it wanders
///     gyro   change of the compass error from the turn that the gyro saw
///     accel  second differences of p, averaged over a stride, from the specific force and its bias
///     ground the ground below the walk climbs little from one second to the next
///     pair   heights of two passes agree; the slope turns plan errors into height
///
/// Corrections to the filter's track are linear between knots. Outliers are down-weighted (Huber, Cauchy),
/// noise sigmas are scaled by variance components. Covariances come from the selected inverse.
/// Errors: BadData when the rows do not determine the track; Cancelled. Pure; the result does not depend on
/// the number of threads. Source: sections 3 and 6 of the project's estimation notes; Koch 1999.
[[nodiscard]] Result<JointSolution> adjustJointly(const Survey& survey, std::span<const RunStart> starts,
                                                  const FusionOptions& options, Progress& progress,
                                                  std::stop_token stop);

}  // namespace terrawalk
