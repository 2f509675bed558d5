#pragma once

#include <fmt/format.h>

#include <atomic>
#include <cstdint>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "app/pipeline/accuracy_measure.hpp"
#include "fusion/simulation_options.hpp"
#include "survey/parallel.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

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

/// A column of a table of accuracy.
struct AccuracyColumn {
    std::string_view name;
    double AccuracyMeasures::*value;
};

/// `work(trial)` for all trials, side by side. Errors: Cancelled.
template <class Trial, class Work>
[[nodiscard]] Result<void> workOnTrials(std::vector<Trial>& trials, const Work& work, Progress& progress,
                                        const std::stop_token& stop) {
    std::atomic<std::size_t> done = 0;
    parallelFor(trials.size(), [&](std::size_t i) {
        if (stop.stop_requested()) return;
        work(trials[i]);
        progress.report(static_cast<double>(++done) / static_cast<double>(trials.size()),
                        "simulated surveys");
    });
    if (stop.stop_requested()) return cancelled();
    return {};
}

/// What stands in the notes of a trial that failed.
[[nodiscard]] inline std::string leftOutOfMeans(const std::string& trial, const Error& error) {
    return fmt::format("{}: {}; left out of the means", trial, error.text());
}

[[nodiscard]] inline std::string tiesText(bool ties) {
    return ties ? "with ties" : "without ties";
}

}  // namespace terrawalk
