#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "fusion/sensor_readings.hpp"

namespace terrawalk {

/// A GNSS position of a run. Only positions with the same kind of fix are compared.
struct GnssReading {
    double time_s = 0.0;
    Eigen::Vector2d en_m = Eigen::Vector2d::Zero();  ///< local east and north
    double white_m = 0.0;                            ///< sigma of its white noise, per axis
    GnssFixClass fix_class = kSingleClass;
};

/// Stretches whose positions stand off from those around them: a wrong fix, a reflected signal.
///
/// A jump is a step between successive positions that no walker makes: it differs from the median of the
/// steps around it by more than noise and gait explain. Most come back by a step against their direction,
/// which may be smaller; one that does not must be twice as large to count. Jumps part levels, and that of
/// the most readings with one kind of fix is right: errors come and go, and the truth stays where it is.
/// Where a receiver is wrong in the same way for most of the time, the wrong level is doubted; no method that
/// sees positions alone knows better. Positions without an RTK fix drift by as much as they jump: there a
/// stretch of more than a minute is believed. Single readings that stand off are no stretch, robust rows deal
/// with them; they are passed over, so that their steps are no jumps.
/// @param readings  of one run, ordered by time
/// @return for each reading zero, or by how much [m] its level is off
[[nodiscard]] std::vector<double> gnssJumps(std::span<const GnssReading> readings);

/// The same for each epoch of a log; zero where an epoch has no position that may be used.
[[nodiscard]] std::vector<double> gnssJumps(const ReadingContext& context);

/// Says how many stretches stand off, for how long, and by how much; nothing when there are none.
[[nodiscard]] std::string gnssJumpsNote(const ArrayLog& log, std::span<const double> jump_m);

}  // namespace terrawalk
