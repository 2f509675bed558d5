#include "survey/mark_stands.hpp"

#include <algorithm>

namespace terrawalk {

std::vector<MarkStand> markStands(const Survey& survey, const Run& run, const StandOptions& options) {
    std::vector<MarkStand> stands;
    if (run.log.size() == 0) return stands;
    const double first_s = run.log.time_s.front();
    const double last_s = run.log.time_s.back();
    const auto add = [&](StandPlace place, const std::string& point, double from_s, double to_s) {
        const auto mark = survey.findMark(point);
        if (!mark) return;
        const bool measured_here =
            place == StandPlace::Target && run.kind == RunKind::FixedPoint && !options.tie_fixed_targets;
        stands.push_back({place, *mark, from_s, to_s, mark->role == MarkRole::Control && !measured_here});
    };
    if (run.start) add(StandPlace::Start, *run.start, first_s, std::min(first_s + options.start_s, last_s));
    for (const Stop& stop : run.stops) add(StandPlace::Stop, stop.point, stop.from_s, stop.to_s);
    if (run.target)
        add(StandPlace::Target, *run.target, std::max(last_s - options.target_s, first_s), last_s);
    std::stable_sort(stands.begin(), stands.end(),
                     [](const MarkStand& a, const MarkStand& b) { return a.from_s < b.from_s; });
    return stands;
}

}  // namespace terrawalk
