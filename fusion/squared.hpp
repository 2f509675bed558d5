#pragma once

namespace terrawalk {

[[nodiscard]] constexpr double squared(double x) {
    return x * x;
}

}  // namespace terrawalk
