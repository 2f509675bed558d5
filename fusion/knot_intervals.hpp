#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "fusion/run_model.hpp"

namespace terrawalk {

/// Calls f(epoch, from_s, to_s) for the share that each epoch has in each knot interval: an epoch stands
/// for the time to halfway to its neighbours, but no longer than a usual step.
template <class Usable, class Take, class Done>
void overIntervals(const RunModel& run, Usable usable, Take take_part, Done done) {
    const std::vector<double>& times = run.log->time_s;
    std::size_t i = 0;
    for (std::size_t k = 0; k + 1 < run.correction.knots(); ++k) {
        const double from_s = run.correction.time(k);
        const double to_s = run.correction.time(k + 1);
        while (i > 0 && epochEnd(times, i - 1) > from_s) --i;
        for (; i < times.size() && epochBegin(times, i) < to_s; ++i) {
            const double begin_s = std::max(epochBegin(times, i), from_s);
            const double end_s = std::min(epochEnd(times, i), to_s);
            if (end_s > begin_s && usable(i)) take_part(i, begin_s, end_s);
        }
        done(k, to_s - from_s);
    }
}

}  // namespace terrawalk
