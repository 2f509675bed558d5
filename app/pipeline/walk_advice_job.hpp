#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "mapping/weak_regions.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// Where another walk would help most. Lengths in the unit of the raster.
struct WalkAdviceRequest {
    std::filesystem::path uncertainty;  ///< raster of one sigma of the heights
    std::filesystem::path output = "walk_again.gpkg";
    double target_sigma = 0.0;  ///< that the ground should be known to; 0: twice the raster's median
    std::optional<double>
        least_area;  ///< smaller pieces are left out; by the size of the field where not given
};

struct WalkAdviceOutcome {
    WalkAdviceRequest request;
    std::string unit;
    double target_sigma = 0.0;
    double median_sigma = 0.0;
    double least_area = 0.0;  ///< 25 m2, and no more than a hundredth of what is known, unless it was given
    double area_above = 0.0;  ///< above the target, small pieces too
    double area_known = 0.0;
    std::vector<WeakRegion> regions;  ///< best first
};

/// Writes the regions as polygons with rank, area, mean and greatest sigma, and gain. Errors: BadData for a
/// raster without values; Usage for a target or an area below zero; System; Cancelled.
[[nodiscard]] Result<WalkAdviceOutcome> adviseWalk(const WalkAdviceRequest& request, Progress& progress,
                                                   std::stop_token stop);

[[nodiscard]] std::string toText(const WalkAdviceOutcome& outcome);
[[nodiscard]] std::string toJson(const WalkAdviceOutcome& outcome);

}  // namespace terrawalk
