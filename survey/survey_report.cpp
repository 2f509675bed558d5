#include "survey/survey_report.hpp"

namespace terrawalk {

std::string_view name(Stage stage) {
    switch (stage) {
        case Stage::BeforeFusion:
            return "before fusion";
        case Stage::Fused:
            return "fused";
        case Stage::Surface:
            return "surface";
    }
    return "";
}

std::string_view name(Quantity quantity) {
    switch (quantity) {
        case Quantity::ArrayPosition:
            return "position on mark";
        case Quantity::NearestSample:
            return "nearest ground point";
        case Quantity::SurfaceHeight:
            return "surface height";
    }
    return "";
}

std::vector<CountedReason> leftOutByReason(const std::vector<GroundPoint>& points) {
    std::array<std::size_t, kGroundPointStateCount> counts{};
    for (const GroundPoint& point : points) ++counts[static_cast<std::size_t>(point.state)];
    std::vector<CountedReason> reasons;
    for (std::size_t state = 0; state < kGroundPointStateCount; ++state) {
        const auto reason = static_cast<GroundPointState>(state);
        if (reason == GroundPointState::Used || counts[state] == 0) continue;
        reasons.push_back({std::string(name(reason)), counts[state]});
    }
    return reasons;
}

std::string_view name(GroundCover cover) {
    switch (cover) {
        case GroundCover::Unknown:
            return "";
        case GroundCover::Open:
            return "open";
        case GroundCover::Vegetated:
            return "vegetated";
    }
    return {};
}

}  // namespace terrawalk
