#pragma once

#include <cstddef>
#include <span>

#include "survey/result.hpp"

namespace terrawalk {

/// Height in the International Standard Atmosphere at which this pressure [Pa] stands, troposphere, metres
/// above the level of 101325 Pa. Missing (NaN) unless the pressure is positive. Source: ICAO Doc 7488, ISO
/// 2533.
[[nodiscard]] double isaHeight(double pressure_pa);

/// Its inverse [Pa], for heights below 11 km.
[[nodiscard]] double isaPressure(double height_m);

/// A pressure read where the height is known.
struct PressureAtHeight {
    double pressure_pa = 0.0;
    double height_m = 0.0;  ///< of the sensor, any frame
};

/// height = offset_m + scale * isaHeight(pressure)
struct PressureHeightFit {
    double scale = 1.0;
    double offset_m = 0.0;
    double rmse_m = 0.0;  ///< of the readings about the fit
    std::size_t n = 0;

    [[nodiscard]] double height(double pressure_pa) const {
        return offset_m + scale * isaHeight(pressure_pa);
    }
};

/// Least-squares line through readings at marks of known height: the scale holds the day's temperature (about
/// +0.35 % for each degree above the standard), the offset its weather. Section 2.2.1 of paper 000 names the
/// method and gives no form. Errors: BadData with fewer than two readings, a pressure that is none, or all
/// pressures alike. Pure; safe from any thread.
[[nodiscard]] Result<PressureHeightFit> fitPressureToHeight(std::span<const PressureAtHeight> readings);

}  // namespace terrawalk
