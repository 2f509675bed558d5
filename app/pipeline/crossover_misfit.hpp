#pragma once

#include <cstddef>

#include "app/pipeline/ground_track.hpp"

namespace terrawalk {

/// How well ground heights agree with one another where the track comes back, which needs no truth.
struct CrossoverMisfit {
    double rms_m = 0.0;     ///< NaN of none
    double median_m = 0.0;  ///< of the absolute misfits
    std::size_t crossovers = 0;
};

/// Height differences between passes more than 20 s apart that come within half a metre of each other, each
/// after a fit of one plane to the ground about it. Only used ground points count. Where the track is far off
/// in plan it meets other ground than it should, and that counts as well. Pure.
[[nodiscard]] CrossoverMisfit crossoverMisfit(const GroundTrack& track);

}  // namespace terrawalk
