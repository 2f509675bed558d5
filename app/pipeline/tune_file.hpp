#pragma once

#include <filesystem>
#include <string>

#include "app/pipeline/tune.hpp"
#include "survey/survey_report.hpp"

namespace terrawalk {

/// What the report says of a tuning.
[[nodiscard]] TuningRecord tuningRecord(const TuneOutcome& outcome, const std::string& survey_name);

/// The tuned values as a configuration file: every parameter that is tuned or differs from its default, and
/// the section "tuning", which tells how they came about. The same outcome gives the same bytes.
///
///     format   "terrawalk-config 1"
///     fusion   {...}
///     tuning   program, survey, method, optimiser, seed, population, iterations, evaluations, loss,
///              loss_before, loss_after, left_out_before, left_out_after (null where no part could be left
///              out), holds_out_better, in_use, decision, warnings, marks: [{name, enu_m}], then:
///              optimiser_requested, restarts, search_notes,
///              evaluations_spent  {search, left_out, profile}
///              before, after      {component: loss ..., sum, and in m: rmse, rmse of each component}
///              left_out           {groups, evaluations_each, population, before, after, gain,
///              gain_standard_error} parameters         [{name, settings: [{key, before, after}], lower,
///              upper, on_bound: "lower",
///                                 "upper" or null, flat_from, flat_to, flat_share, identified,
///                                 left_out_least, left_out_greatest}]
///              parts              [{name, mark, before, after, left_out}]
///              convergence        [[evaluations, best loss]]
[[nodiscard]] std::string tuneFileText(const TuneOutcome& outcome, const std::string& survey_name);

/// For a person at a terminal, and for a program: the section "tuning" as far as a report has it, and `file`.
[[nodiscard]] std::string toText(const TuneOutcome& outcome);
[[nodiscard]] std::string toJson(const TuneOutcome& outcome, const std::string& survey_name,
                                 const std::filesystem::path& file);

}  // namespace terrawalk
