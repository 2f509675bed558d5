#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fusion/simulation_options.hpp"

namespace terrawalk {

/// A simulated survey that an experiment is to make.
struct PlannedSurvey {
    FaultLevel faults = FaultLevel::None;
    bool ties = true;  ///< to control stops and to ZERO at the end
    std::uint64_t seed = 0;
};

/// Every level of faults, with and without ties, `surveys` seeds each: groups that lie one behind the other.
[[nodiscard]] inline std::vector<PlannedSurvey> plannedSurveys(std::uint64_t first_seed,
                                                               std::uint64_t surveys) {
    std::vector<PlannedSurvey> plan;
    for (const auto& [level, text] : kFaultLevelNames) {
        for (const bool ties : {true, false}) {
            for (std::uint64_t k = 0; k < surveys; ++k) plan.push_back({level, ties, first_seed + k});
        }
    }
    return plan;
}

[[nodiscard]] inline std::string tiesText(bool ties) {
    return ties ? "with ties" : "without ties";
}

}  // namespace terrawalk
