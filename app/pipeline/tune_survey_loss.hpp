#pragma once

#include <stop_token>

#include "app/pipeline/tune_problem.hpp"

namespace terrawalk {

/// The tunable problem of a method that fuses a survey run by run or as a whole; see tunableProblem(). Each
/// evaluation fuses the survey once or twice, so a search is given few of them.
[[nodiscard]] Result<TunableProblem> surveyProblem(const Survey& survey, const PipelineConfig& config,
                                                   const std::stop_token& stop);

}  // namespace terrawalk
