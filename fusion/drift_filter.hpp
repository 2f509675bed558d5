#pragma once

#include <stop_token>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "fusion/sensor_readings.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// A run after the filter with error states.
struct DriftFilterResult {
    FusedRun fused;
    std::vector<bool> gnss_gated;     ///< of each epoch: its GNSS position was dropped, being beyond the gate
    std::vector<double> gnss_jump_m;  ///< of each epoch, see gnssJumps
};

/// Adaptive unscented Kalman filter with states for the errors that last (barometer drift and gusts, compass
/// and hard iron, flow scale, GNSS), and a Rauch-Tung-Striebel pass:
///
///     GNSS   z = p + g          g: Gauss-Markov, begun anew where the fix code changes
///     baro   h = u + bb + bw    bb: random walk, bw: Gauss-Markov
///     flow   f = s Rz(-(yaw - psi - A sin yaw - B cos yaw)) v, by the unscented transform
///
/// Local ENU, SI. All rows but the flow are linear and taken exactly, one by one. Huber weights, gates,
/// re-admission and the watch over divergence are those of RunFilter. The noise of each sensor follows its
/// innovations within bounds.
/// Errors: BadData when the filter diverges; Cancelled. Pure; safe from any thread.
/// Source: section 3 of the project's estimation notes; Julier and Uhlmann 2004; Mehra 1972 for the noise.
[[nodiscard]] Result<DriftFilterResult> filterWithDrifts(const Survey& survey, const Run& run,
                                                         const FusionOptions& options,
                                                         const std::vector<EpochAttitude>& attitudes,
                                                         const RunReference& reference, Progress& progress,
                                                         std::stop_token stop);

}  // namespace terrawalk
