#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "fusion/sensor_readings.hpp"
#include "survey/array_log.hpp"

namespace terrawalk {

/// What keeps the optical flow of each epoch of a log from being used, by any method: nothing where the log
/// has no reading, empty where the reading may be used.
///
/// With `FlowOptions::screen` two kinds are left out that the quality code does not tell. "zero amid motion":
/// a module that sees nothing says that nothing moves. Such a stretch borders on walking, and the
/// accelerometer shakes as it does in a walk; where it tells nothing, both sides of the stretch walk and it
/// is short. "far from its neighbours": by Hampel's test over a second to either side.
/// @param attitudes  one for each epoch
[[nodiscard]] FlowRejections flowRejections(const ArrayLog& log, const std::vector<EpochAttitude>& attitudes,
                                            const FlowOptions& options);

}  // namespace terrawalk
