#pragma once

#include <array>

#include "survey/array_log.hpp"

namespace terrawalk {

/// All that the GNSS receiver gives.
inline constexpr std::array kGnssChannels{Channel::Latitude,
                                          Channel::Longitude,
                                          Channel::EllipsoidalHeight,
                                          Channel::Fix,
                                          Channel::GnssHorizontalAccuracy,
                                          Channel::GnssVerticalAccuracy,
                                          Channel::GnssVelocityEast,
                                          Channel::GnssVelocityNorth,
                                          Channel::GnssVelocityUp};

}  // namespace terrawalk
