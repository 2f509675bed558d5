#pragma once

#include <cstdint>
#include <vector>

#include "survey/ground_point.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// Takes the array's trajectory and its slant ranges to points on the ground, one for each epoch:
/// ground = position + R_enu_body (lever arm - range z). Sigmas propagate position, range, tilt and heading.
/// Pure; safe from any thread.
struct GroundPointOptions {
    double sigma_range_near_m = 0.06;      ///< up to 6 m (paper 000, Table 2)
    double sigma_range_far_share = 0.01;   ///< of the range, beyond 6 m
    double least_range_m = 0.1;
    double greatest_range_m = 12.0;
    double least_strength = 20.0;
    double greatest_strength = 2000.0;
    double greatest_tilt_rad = 0.5236;
    double greatest_sigma_m = 50.0;        ///< horizontal sigma of the position
    double spike_sigma = 5.0;              ///< off the median of the neighbours along the track; 0: off
};
[[nodiscard]] std::vector<GroundPoint> groundPoints(const Run& run, std::uint32_t run_index,
                                                    const Trajectory& trajectory,
                                                    const GroundPointOptions& options);

}  // namespace terrawalk
