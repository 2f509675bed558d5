#pragma once

#include <array>
#include <stop_token>
#include <string_view>
#include <utility>

#include "mapping/shaded_relief.hpp"
#include "survey/elevation_grid.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

enum class Derivative {
    Hillshade,         ///< 1 in shadow to 255 facing the sun
    Slope,             ///< degrees or percent
    Aspect,            ///< degrees clockwise from north of the way down; none where level
    Curvature,         ///< minus the sum of both second derivatives, 1/unit
    ProfileCurvature,  ///< minus the second derivative along the slope, 1/unit; none where level
    PlanCurvature,     ///< minus the second derivative across the slope, 1/unit; none where level
    Roughness,         ///< greatest less least height of the nine cells, in the DEM's unit
};
inline constexpr std::array<std::pair<Derivative, std::string_view>, 7> kDerivatives{
    {{Derivative::Hillshade, "hillshade"},
     {Derivative::Slope, "slope"},
     {Derivative::Aspect, "aspect"},
     {Derivative::Curvature, "curvature"},
     {Derivative::ProfileCurvature, "profile_curvature"},
     {Derivative::PlanCurvature, "plan_curvature"},
     {Derivative::Roughness, "roughness"}}};

enum class SlopeUnit { Degrees, Percent };
inline constexpr std::array<std::pair<SlopeUnit, std::string_view>, 2> kSlopeUnits{
    {{SlopeUnit::Degrees, "degrees"}, {SlopeUnit::Percent, "percent"}}};
[[nodiscard]] constexpr std::string_view name(SlopeUnit unit) {
    return kSlopeUnits[static_cast<std::size_t>(unit)].second;
}

struct DerivativeOptions {
    SlopeUnit slope_unit = SlopeUnit::Degrees;
    ReliefOptions sun;  ///< for the hillshade
};

/// One property of the ground at each cell, from the cell and its eight neighbours; none where one of the
/// nine has no height. Convex ground (a ridge, the edge of a terrace) has positive curvature. Slope, aspect
/// and hillshade: Horn 1981, "Hill shading and the reflectance map". Curvature: Zevenbergen and Thorne 1987,
/// "Quantitative analysis of land surface topography", from the quadratic terms of their surface. Roughness:
/// Wilson et al. 2007. Heights and cells in one unit. The same bytes with any number of threads. Errors:
/// Cancelled.
[[nodiscard]] Result<ElevationGrid> derivativeOf(const ElevationGrid& heights, Derivative derivative,
                                                 const DerivativeOptions& options, Progress& progress,
                                                 std::stop_token stop);

}  // namespace terrawalk
