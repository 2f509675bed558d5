#pragma once

#include <cmath>

namespace terrawalk::gui {

/// The greatest of 1, 2, 5 times a power of ten that is not above a number above zero.
[[nodiscard]] inline double roundBelow(double number) {
    const double power = std::pow(10.0, std::floor(std::log10(number) + 1e-12));
    const double share = number / power;
    return power * (share >= 5.0 ? 5.0 : share >= 2.0 ? 2.0 : 1.0);
}

}  // namespace terrawalk::gui
