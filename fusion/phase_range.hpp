#pragma once

#include "survey/frames.hpp"

namespace terrawalk {

inline constexpr double kSpeedOfLight_mps = 299792458.0;

/// Range [m] of a time-of-flight finder from the phase by which its modulated wave comes back late:
/// D = c / 2 * phase / (2 pi f). Source: paper 000, eq 1.
/// @param phase_rad     phase difference, any whole turns included
/// @param frequency_hz  of the modulation, > 0
[[nodiscard]] constexpr double rangeFromPhase(double phase_rad, double frequency_hz) {
    return 0.5 * kSpeedOfLight_mps * phase_rad / (2.0 * kPi * frequency_hz);
}

/// The range at which the phase has gone once round and the finder starts again at zero: c / (2 f).
[[nodiscard]] constexpr double unambiguousRange(double frequency_hz) {
    return 0.5 * kSpeedOfLight_mps / frequency_hz;
}

}  // namespace terrawalk
