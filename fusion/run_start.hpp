#pragma once

#include <vector>

#include "fusion/run_reference.hpp"
#include "fusion/sensor_readings.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// A run as the filter leaves it to the adjustment.
struct RunStart {
    const Run* run = nullptr;
    std::vector<EpochAttitude> attitudes;  ///< one for each epoch
    RunReference reference;
    Trajectory trajectory;            ///< of the filter, smoothed
    std::vector<bool> gnss_gated;     ///< epochs whose GNSS position the filter rejected; may be empty
    std::vector<double> gnss_jump_m;  ///< of each epoch, see gnssJumps; may be empty
};

}  // namespace terrawalk
