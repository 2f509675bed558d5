#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace terrawalk::test {

/// Random numbers that are the same with every standard library, unlike std::uniform_real_distribution.
class RandomNumbers {
  public:
    explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }
    double normal() {  // Box and Muller
        const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
        return radius * std::cos(6.283185307179586 * uniform(0.0, 1.0));
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace terrawalk::test
