#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "survey/elevation_grid.hpp"
#include "survey/relief_image.hpp"

namespace terrawalk {

struct ReliefOptions {
    double sun_azimuth_rad = 5.497787;  ///< clockwise from north: 315 degrees, north-west
    double sun_altitude_rad = 0.785398;
    double exaggeration = 1.0;
};

using Colour = std::array<std::uint8_t, 3>;

/// Colour of a share 0..1 of the height range, interpolated between the anchors of the ramp.
[[nodiscard]] Colour rampColour(const std::vector<Colour>& ramp, double share);

/// Heights as colours of a ramp, shaded by a sun. The slope is Horn's (1981), from the eight neighbours; a
/// missing neighbour counts as the cell itself. Pure; safe from any thread.
[[nodiscard]] ReliefImage shadedRelief(const ElevationGrid& heights, const std::vector<Colour>& ramp,
                                       const ReliefOptions& options = {});

/// The ramp itself as a picture of one row, from low to high.
[[nodiscard]] ReliefImage rampImage(const std::vector<Colour>& ramp);

}  // namespace terrawalk
