#pragma once

#include <string>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "fusion/sensor_readings.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// Finds what a run is measured against: its ties to known marks, the height at which its barometer reads
/// zero and how surely, where and how surely the run begins. In order of preference, the start is
/// - a known start mark,
/// - GNSS over the first still seconds, or its first fix,
/// - the origin, said in a note;
/// and the barometer is zeroed
/// - while the array stood on a mark,
/// - by its reading nearest to a mark or by the median GNSS height, whichever is surer,
/// - on the ground below the first seconds, which becomes height 0 of the survey.
///
/// Marks of role check are never used. Adds a note for everything that was missing and what stands in for it.
/// Errors: BadData when nothing in the log tells a position. Pure; safe from any thread.
[[nodiscard]] Result<RunReference> runReference(const Survey& survey, const Run& run,
                                                const FusionOptions& options,
                                                const std::vector<EpochAttitude>& attitudes, RunNotes& notes);

}  // namespace terrawalk
