#pragma once

#include <cstdint>

#include "fusion/simulation_options.hpp"

namespace terrawalk {

/// Smooth random field: twice continuously differentiable, between -1 and 1, and about 1 lattice unit wide.
/// The same on every machine. Pure.
[[nodiscard]] double valueNoise(double x, double y, std::uint64_t seed);

/// The ground of a simulated site. Local ENU, metres; 0 at the zero point. Immutable; safe from any thread.
class TerrainModel {
  public:
    TerrainModel(SimulatedTerrain kind, std::uint64_t seed);
    [[nodiscard]] double height_m(double e_m, double n_m) const { return shape_m(e_m, n_m) - zero_m_; }
    /// Rise over run of the steepest way, from differences over 0.6 m.
    [[nodiscard]] double slope(double e_m, double n_m) const;

  private:
    [[nodiscard]] double shape_m(double e_m, double n_m) const;
    [[nodiscard]] double terraces_m(double e_m, double n_m) const;
    [[nodiscard]] double roughness_m(double e_m, double n_m) const;

    SimulatedTerrain kind_;
    std::uint64_t seed_;
    double zero_m_ = 0.0;
};

}  // namespace terrawalk
