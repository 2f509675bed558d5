#pragma once

#include <stop_token>

#include "fusion/fusion_options.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// Takes one run's log to a trajectory in local ENU, one epoch for each row of the log.
/// Marks of role check are never used. Errors: BadData when nothing in the log tells a position, or when the
/// filter diverges; Cancelled. Pure; safe from any thread.
[[nodiscard]] Result<FusedRun> fuseRun(const Survey& survey, const Run& run, const FusionOptions& options,
                                       Progress& progress, std::stop_token stop);

}  // namespace terrawalk
