#pragma once

#include <string>
#include <vector>

#include "survey/survey.hpp"

namespace terrawalk {

/// For how long the array is taken to stand still where the project names no times.
struct StandOptions {
    double start_s = 2.5;   ///< first seconds of a run with a start mark
    double target_s = 1.6;  ///< last seconds of a run with a target mark
    /// Whether the targets of fixed-point runs hold the estimator too. Then they certify nothing; without,
    /// they show what such a run is walked for, how far off it ends.
    bool tie_fixed_targets = true;
};

enum class StandPlace { Start, Stop, Target };

/// A stretch of a run during which the array stood over a known mark.
struct MarkStand {
    StandPlace place = StandPlace::Start;
    ControlMark mark;
    double from_s = 0.0;
    double to_s = 0.0;
    /// Whether the estimator may be tied to it: never to a check mark, and to the target of a fixed-point run
    /// only where the options say so.
    bool may_tie = false;
};

/// All stands of a run, in time order. Marks that the survey lacks are left out (the reader refuses them).
[[nodiscard]] std::vector<MarkStand> markStands(const Survey& survey, const Run& run,
                                                const StandOptions& options);

}  // namespace terrawalk
