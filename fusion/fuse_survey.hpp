#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

struct FusedSurvey {
    std::vector<FusedRun> runs;  ///< one for each run of the survey, in its order
    std::optional<AdjustmentSummary> adjustment;  ///< of method terrawalk, where it had a solution
};

/// Takes all runs of a survey to trajectories by the method that the options name. Works on as many threads
/// as TBB allows; the result does not depend on their number. Marks of role check are never used.
/// Errors: as fuseRun(); the first run that fails, in the order of the survey, tells why.
[[nodiscard]] Result<FusedSurvey> fuseSurvey(const Survey& survey, const FusionOptions& options,
                                             Progress& progress, std::stop_token stop);

}  // namespace terrawalk
