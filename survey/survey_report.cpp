#include "survey/survey_report.hpp"

#include <fmt/format.h>

#include <algorithm>

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

std::string inWords(const VariogramSummary& v, std::string_view unit) {
    const std::string exponent = v.exponent ? fmt::format(" {:.2g}", *v.exponent) : "";
    return fmt::format(
        "{}{}, nugget {:.3g} {}\u00b2, sill {:.3g} {}\u00b2 at {:.3g} {}, from {} pairs of points", v.model,
        exponent, v.nugget_m2, unit, v.sill_m2, unit, v.range_m, unit, v.pairs);
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

std::vector<std::pair<std::string, std::string>> inWords(const OccupancySummary& o) {
    const auto share = [&](std::size_t n) {
        return 100.0 * static_cast<double>(n) / static_cast<double>(std::max<std::size_t>(1, o.ground_cells));
    };
    return {
        {"Rays", fmt::format("{}; {} ground points left out, {} of them below the ground", o.rays, o.left_out,
                             o.below_ground)},
        {"Space",
         fmt::format("{:.1f} m3 free, {:.1f} m3 occupied, in voxels of {:g} m about {:.0f} {:.0f} "
                     "{:.0f}",
                     o.free_m3, o.occupied_m3, o.voxel_m, o.origin_m.x(), o.origin_m.y(), o.origin_m.z())},
        {"Free",
         fmt::format("right above the ground in {} of {} cells ({:.1f} %), there to {:.2f} m "
                     "(median)",
                     o.cells_known_free, o.ground_cells, share(o.cells_known_free), o.median_free_height_m)},
        {"Obstacles", fmt::format("above the ground in {} cells ({:.1f} %)", o.cells_with_obstacle,
                                  share(o.cells_with_obstacle))}};
}

}  // namespace terrawalk
