#pragma once

#include <cstdint>
#include <vector>

#include "survey/elevation_grid.hpp"

namespace terrawalk {

/// Ground that is known too badly, in one piece.
struct WeakRegion {
    std::int32_t label = 0;
    std::size_t cells = 0;
    double area = 0.0;
    double mean_sigma = 0.0;
    double greatest_sigma = 0.0;
    /// Integral of the variance above the target over the region, unit^4: what a walk that reaches the target
    /// would take away. Regions are ranked by it.
    double gain = 0.0;
};

struct WeakRegions {
    std::vector<std::int32_t> labels;  ///< for each cell the region's, 0 for none
    std::vector<WeakRegion> regions;   ///< greatest gain first, labels 1, 2, ... in that order
};

struct WeakRegionOptions {
    double target_sigma = 0.0;  ///< that the ground should be known to
    double least_area = 0.0;    ///< smaller pieces are not worth a walk
};

/// Where another walk would help most: pieces of cells that hang together by their sides and whose sigma is
/// above the target. Pure.
[[nodiscard]] WeakRegions weakRegions(const ElevationGrid& sigmas, const WeakRegionOptions& options);

}  // namespace terrawalk
