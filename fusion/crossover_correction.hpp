#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "fusion/run_start.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

struct CrossoverCorrection {
    std::vector<std::vector<Eigen::Vector3d>> tracks_m;  ///< of each run, at each epoch; local ENU
    std::size_t crossovers = 0;
    double misfit_before_m = 0.0;  ///< RMS of the heights' differences
    double misfit_after_m = 0.0;
};

/// The quick second stage: the filter's tracks are bent, as little as may be, until passes over the same
/// ground agree. It takes tenths of a second where the joint adjustment takes seconds, and its answer lies
/// between those of the filter and of the adjustment: the plan stays as it was. It has no sigmas of its own:
/// those of a second stage are far too small, so the filter's stay.
///
///     pair    du_A - g.dp_A - du_B + g.dp_B = -misfit
///     change  a correction wanders little from one second to the next
///     whole   and is no larger than the filter's sigma, whose error lasts for minutes
///
/// Corrections are linear between knots of some seconds, sought anew in five robust rounds. Nothing when
/// there is no solution, or after a stop request. Pure. Source: section 3 of the project's estimation notes.
[[nodiscard]] std::optional<CrossoverCorrection> correctByCrossovers(const Survey& survey,
                                                                     std::span<const RunStart> starts,
                                                                     const FusionOptions& options,
                                                                     const std::stop_token& stop);

}  // namespace terrawalk
