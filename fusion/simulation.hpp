#pragma once

#include <functional>
#include <stop_token>
#include <vector>

#include "fusion/simulation_options.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// A survey that never took place, with the truth that no real one has. Simulated, and named so.
struct SimulatedSurvey {
    Survey survey;
    std::vector<Trajectory> truth;  ///< for each run, one epoch for each row of its log; covariance is zero
    std::function<double(double e_m, double n_m)>
        terrain_height_m;  ///< local ENU, defined everywhere; 0 at ZERO
};

/// Makes a survey with truth. Errors: Usage when the options ask for what cannot be walked; Cancelled.
/// Pure: its random numbers come from the seed alone, so the same options give the same survey. Between
/// machines, the last digits can differ as far as their sin, pow and log do. Safe from any thread.
[[nodiscard]] Result<SimulatedSurvey> simulateSurvey(const SimulationOptions& options, Progress& progress,
                                                     std::stop_token stop);

}  // namespace terrawalk
