#pragma once

#include <cstdint>
#include <stdexcept>
#include <utility>

#include "fusion/simulation.hpp"
#include "survey/progress.hpp"

namespace terrawalk {

/// A field of 15 m by 15 m with two fixed-point runs: simulated, and quick to work on.
inline SimulationOptions smallField(std::uint64_t seed = 11) {
    SimulationOptions options;
    options.seed = seed;
    options.area_east_m = 15.0;
    options.area_north_m = 15.0;
    options.line_spacing_m = 2.0;
    options.fixed_point_runs = 2;
    options.fixed_point_epochs = 120;
    options.area_epochs = 1200;
    options.control_stops = 2;
    options.check_points = 12;
    return options;
}

/// A simulated survey; throws when there is none.
inline SimulatedSurvey simulatedSurvey(const SimulationOptions& options) {
    SilentProgress silent;
    auto made = simulateSurvey(options, silent, {});
    if (!made) throw std::runtime_error(made.error().text());
    return std::move(*made);
}

}  // namespace terrawalk
