#pragma once

#include <vector>

#include "app/pipeline/surface_model.hpp"
#include "io/map_projection.hpp"
#include "mapping/shaded_relief.hpp"
#include "survey/ground_point.hpp"
#include "survey/relief_image.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// The surface as a shaded picture in the local frame, for the map of the report: some 800 pixels on its
/// longer side.
[[nodiscard]] Result<ReliefPicture> reliefPicture(const SurfaceModel& surface,
                                                  const MapProjection& projection,
                                                  const std::vector<GroundPoint>& ground_points);

/// Colours of heights, from the lowest to the highest.
[[nodiscard]] std::vector<Colour> reliefRamp();
/// Colours of a change, from fallen over none, in the middle, to risen.
[[nodiscard]] std::vector<Colour> divergingRamp();
/// Colours of any other quantity, such as a sigma.
[[nodiscard]] std::vector<Colour> sequentialRamp();

}  // namespace terrawalk
