#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "fusion/random_numbers.hpp"

namespace terrawalk {

/// Three of them, each of mean 0 and variance 1.
inline Eigen::Vector3d normals(RandomNumbers& random) {
    const double x = random.normal();
    const double y = random.normal();
    const double z = random.normal();
    return {x, y, z};
}

/// First-order Gauss-Markov process of variance 1, in its steady state from the start. One value a step.
class GaussMarkov {
  public:
    GaussMarkov(double correlation_s, double step_s, RandomNumbers random)
        : keep_(std::exp(-step_s / correlation_s)), random_(random), value_(random_.normal()) {}
    double next() {
        const double value = value_;
        value_ = keep_ * value_ + std::sqrt(1.0 - keep_ * keep_) * random_.normal();
        return value;
    }

  private:
    double keep_;
    RandomNumbers random_;
    double value_;
};

/// Something that comes at random times and stays for a while.
class Bursts {
  public:
    struct Length {
        double shortest_s;
        double longest_s;
    };
    Bursts(double per_min, Length length, double step_s, RandomNumbers random)
        : chance_(std::min(1.0, per_min / 60.0 * step_s)),
          length_(length),
          step_s_(step_s),
          random_(random) {}
    /// Whether it is there in the next epoch, and whether it has just begun.
    struct State {
        bool active = false;
        bool begins = false;
    };
    State next() {
        left_s_ -= step_s_;
        if (left_s_ > 0.0) return {true, false};
        if (!random_.chance(chance_)) return {false, false};
        left_s_ = random_.uniform(length_.shortest_s, length_.longest_s);
        return {true, true};
    }

  private:
    double chance_;
    Length length_;
    double step_s_;
    double left_s_ = 0.0;
    RandomNumbers random_;
};

}  // namespace terrawalk
