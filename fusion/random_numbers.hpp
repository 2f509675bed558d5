#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <random>

namespace terrawalk {

/// Scrambles 64 bits, one to one. Source: Steele, Lea and Flood 2014, SplitMix64.
[[nodiscard]] constexpr std::uint64_t scramble(std::uint64_t bits) {
    bits += 0x9e3779b97f4a7c15ULL;
    bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebULL;
    return bits ^ (bits >> 31U);
}

/// One number from a list of numbers, in which each matters and so does their order.
[[nodiscard]] constexpr std::uint64_t scramble(std::initializer_list<std::uint64_t> key) {
    std::uint64_t bits = 0;
    for (const std::uint64_t part : key) bits = scramble(bits ^ part);
    return bits;
}

/// 0 <= value < 1, from the upper 53 bits.
[[nodiscard]] constexpr double unitInterval(std::uint64_t bits) {
    return static_cast<double>(bits >> 11U) * 0x1.0p-53;
}

/// A counter that is scrambled. Source: Steele, Lea and Flood 2014, SplitMix64.
class SplitMix64 {
  public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
    std::uint64_t operator()() {
        const std::uint64_t bits = scramble(state_);
        state_ += 0x9e3779b97f4a7c15ULL;
        return bits;
    }

  private:
    std::uint64_t state_;
};

/// A stream of random numbers that its key alone decides; streams of different keys are independent.
/// The standard fixes the engine but not its distributions, so these are written out here.
template <class Engine>
class RandomStream {
  public:
    explicit RandomStream(std::initializer_list<std::uint64_t> key) : engine_(scramble(key)) {}

    /// 64 of them, each as likely 0 as 1.
    std::uint64_t bits() { return engine_(); }
    /// 0 <= value < 1.
    double uniform() { return unitInterval(engine_()); }
    /// One of the whole numbers below `n`, which is positive and below 2^32.
    std::size_t index(std::size_t n) { return static_cast<std::size_t>(((bits() >> 32U) * n) >> 32U); }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    bool chance(double probability) { return uniform() < probability; }
    /// Mean 0, variance 1. Source: Marsaglia's polar method.
    double normal() {
        if (has_spare_) {
            has_spare_ = false;
            return spare_;
        }
        double u = 0.0;
        double v = 0.0;
        double s = 0.0;
        do {
            u = uniform(-1.0, 1.0);
            v = uniform(-1.0, 1.0);
            s = u * u + v * v;
        } while (s >= 1.0 || s == 0.0);
        const double factor = std::sqrt(-2.0 * std::log(s) / s);
        spare_ = v * factor;
        has_spare_ = true;
        return u * factor;
    }

  private:
    Engine engine_;
    double spare_ = 0.0;
    bool has_spare_ = false;
};

using RandomNumbers = RandomStream<std::mt19937_64>;
/// For searches, where drawing costs as much as the rest: a third of the time, a period of 2^64.
using QuickRandomNumbers = RandomStream<SplitMix64>;

}  // namespace terrawalk
