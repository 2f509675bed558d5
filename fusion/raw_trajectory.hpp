#pragma once

#include <stop_token>

#include "fusion/fusion_options.hpp"
#include "fusion/sensor_readings.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// Sensors as they are, for comparison with fusion: the latest GNSS position held until the next, barometric
/// height zeroed as in the filter (GNSS height where there is no barometer), velocity of the flow or else of
/// GNSS. Without GNSS the flow is summed up from the start. Nothing is rejected but what is no measurement.
/// Sigmas come from the tables of the sensors and grow while a value is held. Errors: Cancelled.
[[nodiscard]] Result<FusedRun> rawTrajectory(const Survey& survey, const Run& run,
                                             const FusionOptions& options,
                                             const std::vector<EpochAttitude>& attitudes,
                                             const RunReference& reference, Progress& progress,
                                             std::stop_token stop);

}  // namespace terrawalk
