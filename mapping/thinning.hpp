#pragma once

#include <vector>

#include "survey/ground_point.hpp"

namespace terrawalk {

/// Thins the used points of all runs together: in each cell of the local ENU frame the point of median height
/// stands for all, as measured, so that plane ground stays plane; the others become Thinned. Of an even
/// number the lower middle one. Equal heights are decided by place and time, so that the surface does not
/// depend on the order of runs. Points that are not used stay as they are. Pure.
/// @param cell_m  side of a cell, its edges at whole multiples; 0: nothing is thinned
[[nodiscard]] std::vector<GroundPoint> thinGroundPoints(std::vector<GroundPoint> points, double cell_m);

}  // namespace terrawalk
