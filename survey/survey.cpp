#include "survey/survey.hpp"

#include <algorithm>

namespace terrawalk {

std::optional<ControlMark> Survey::findMark(std::string_view mark_name) const {
    if (mark_name == kZeroMark) return ControlMark{.name = std::string(kZeroMark)};
    const auto found = std::find_if(marks.begin(), marks.end(),
                                    [&](const ControlMark& mark) { return mark.name == mark_name; });
    if (found == marks.end()) return std::nullopt;
    return *found;
}

std::string_view name(MarkRole role) {
    return role == MarkRole::Control ? "control" : "check";
}

std::string_view name(RunKind kind) {
    return kind == RunKind::FixedPoint ? "fixed-point" : "area";
}

}  // namespace terrawalk
