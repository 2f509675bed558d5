#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

enum class SimulatedTerrain { TerracedOrchard, Gully, Plain, Ridge, Ramp };
enum class FaultLevel { None, Mild, Severe };

struct SimulationOptions {
    std::uint64_t seed = 1;
    SimulatedTerrain terrain = SimulatedTerrain::TerracedOrchard;
    FaultLevel faults = FaultLevel::Mild;
};

/// A survey that never took place, with the truth that no real one has. Simulated, and named so.
struct SimulatedSurvey {
    Survey survey;
    std::vector<Trajectory> truth;  ///< for each run; covariance is zero
    std::function<double(double e_m, double n_m)> terrain_height_m;
};

/// Pure but for its random numbers, which come from the seed alone: the same options give the same survey on every
/// machine.
[[nodiscard]] Result<SimulatedSurvey> simulateSurvey(const SimulationOptions& options, Progress& progress,
                                                     std::stop_token stop);

}  // namespace terrawalk
