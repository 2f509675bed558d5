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

/// A run after fusion, with what it was measured against.
struct RunFusion {
    FusedRun fused;
    std::vector<EpochAttitude> attitudes;  ///< one for each epoch
    RunReference reference;
    /// Epochs whose GNSS position the filter with error states dropped; empty for the other methods.
    std::vector<bool> gnss_gated;
    std::vector<double> gnss_jump_m;  ///< of each epoch, see gnssJumps; empty likewise
};

/// Takes one run's log to a trajectory in local ENU, one epoch for each row of the log.
/// Marks of role check are never used. Errors: BadData when nothing in the log tells a position, or when the
/// filter diverges; Cancelled. Pure; safe from any thread. `Terrawalk` gives its first stage, the filter with
/// error states; the adjustment needs all runs.
[[nodiscard]] Result<RunFusion> fuseRunInFull(const Survey& survey, const Run& run,
                                              const FusionOptions& options, Progress& progress,
                                              std::stop_token stop);

/// The same, the trajectory and its notes alone.
[[nodiscard]] Result<FusedRun> fuseRun(const Survey& survey, const Run& run, const FusionOptions& options,
                                       Progress& progress, std::stop_token stop);

}  // namespace terrawalk
