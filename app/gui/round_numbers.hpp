#pragma once

#include <QString>
#include <cmath>

namespace terrawalk::gui {

/// The greatest of 1, 2, 5 times a power of ten that is not above a number above zero.
[[nodiscard]] inline double roundBelow(double number) {
    const double power = std::pow(10.0, std::floor(std::log10(number) + 1e-12));
    const double share = number / power;
    return power * (share >= 5.0 ? 5.0 : share >= 2.0 ? 2.0 : 1.0);
}

/// A length as a person writes it: no more than centimetres, and no zeros that say nothing.
[[nodiscard]] inline QString shortLength(double metres) {
    if (metres >= 1000.0) return QString::number(metres / 1000.0, 'g', 4) + " km";
    if (metres >= 1.0) return QString::number(metres, 'g', 4) + " m";
    return QString::number(metres * 100.0, 'g', 3) + " cm";
}

}  // namespace terrawalk::gui
