#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "survey/ground_point.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

struct GroundPointOptions {
    /// Range finder, 1 sigma. Paper 000, Table 2 (TFmini) states 6 cm up to 6 m and 1 % beyond; the figure is
    /// taken as it stands for one sigma, which is on the safe side if the maker means a limit.
    double sigma_range_near_m = 0.06;
    double sigma_range_far_share = 0.01;
    double range_near_m = 6.0;  ///< up to here the near figure holds

    double least_range_m = 0.1;
    double greatest_range_m = 12.0;
    /// Counts. The TFmini's trusted band; a log without strengths is not checked.
    double least_strength = 20.0;
    double greatest_strength = 2000.0;
    double greatest_tilt_rad = kPi / 6.0;  ///< between the ray and the vertical
    double greatest_sigma_m = 50.0;        ///< of the array's position, east or north, whichever is larger
    double greatest_sigma_u_m = 5.0;       ///< of the array's height

    /// How many robust sigmas a point may stand off its neighbours along the track; 0: no check.
    double spike_sigma = 5.0;
    double spike_window_m = 1.5;  ///< path before and after the point in which neighbours count
    double spike_window_s = 3.0;  ///< and time
    double spike_floor_m = 0.06;  ///< least robust sigma: smooth ground must not make the check sharp
};

/// Takes the array's trajectory and its slant ranges to points on the ground, one for each epoch of the log:
///
///     ground = position + R_enu_body (range lever arm - range z)
///
/// Sigmas are of first order in position (its 3x3 covariance), range, roll, pitch and heading, which are
/// taken as independent of one another: a tilt moves the far end of the ray sideways and, through an inclined
/// ray or a lever arm, up or down; a heading error turns what the ray and the lever arm reach sideways.
///
/// Each point that is not used says why, the first reason in the order of GroundPointState. An epoch without
/// a range has a position and sigmas that are not finite; a position that is not finite is PositionUnsure.
///
/// Spikes: among the points that are good so far, the neighbours before a point and those after it (at most
/// 15 on each side, within path and time) each give a straight line (Theil-Sen) and the spread about it
/// (1.4826 MAD, not below the floor). A point is a spike when it stands off to the same side of both lines by
/// more than `spike_sigma` spreads: a hand in front of the finder does, the foot, the face and the edge of a
/// terrace riser do not. Where one side has fewer than five neighbours the other decides; where both sides
/// have fewer, the point stays. What is as narrow as a hand, such as a bund less than half a window wide,
/// cannot be told from one; and a hand less than a window away from a riser may stay.
///
/// Pure; safe from any thread; linear in the number of epochs.
/// After a stop request the points are incomplete, to be thrown away.
/// @param run_index   goes into the points
/// @param trajectory  one epoch for each epoch of the run's log
[[nodiscard]] std::vector<GroundPoint> groundPoints(const Run& run, std::uint32_t run_index,
                                                    const Trajectory& trajectory,
                                                    const GroundPointOptions& options,
                                                    std::stop_token stop = {});

}  // namespace terrawalk
