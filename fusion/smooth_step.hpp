#pragma once

#include <algorithm>

namespace terrawalk {

/// 0 below 0, 1 above 1, and between them a rise that is twice continuously differentiable.
[[nodiscard]] inline double smoothStep(double x) {
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * t * (t * (6.0 * t - 15.0) + 10.0);
}

}  // namespace terrawalk
