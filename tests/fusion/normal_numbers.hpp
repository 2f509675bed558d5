#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "survey/frames.hpp"

namespace terrawalk {

/// Standard normal numbers by Box and Muller, the same with every standard library.
class NormalNumbers {
  public:
    explicit NormalNumbers(std::uint64_t seed) : engine_(seed) {}
    double operator()() {
        const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
        return radius * std::cos(2.0 * kPi * uniform());
    }
    /// [0, 1)
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

  private:
    std::mt19937_64 engine_;
};

}  // namespace terrawalk
