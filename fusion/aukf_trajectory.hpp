#pragma once

#include <stop_token>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "fusion/run_reference.hpp"
#include "fusion/sensor_readings.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// The method of paper 000 with the filter that the options name: the known start mark, forward only, no
/// gate, no smoother, no tie to a later mark. Sigmas are those of the filter's own covariance. Errors:
/// BadData when the filter diverges; Cancelled.
[[nodiscard]] Result<FusedRun> aukfTrajectory(const Survey& survey, const Run& run,
                                              const FusionOptions& options,
                                              const std::vector<EpochAttitude>& attitudes,
                                              const RunReference& reference, Progress& progress,
                                              std::stop_token stop);

}  // namespace terrawalk
