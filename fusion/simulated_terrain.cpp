#include "fusion/simulated_terrain.hpp"

#include <cmath>

#include "fusion/random_numbers.hpp"
#include "fusion/smooth_step.hpp"

namespace terrawalk {
namespace {

constexpr double kTerraceDepth_m = 6.0;
constexpr double kTerraceDrop_m = 1.0;
constexpr double kTerraceDropSpread_m = 0.08;  // of each level, either way
constexpr double kRiserDepth_m = 0.9;          // horizontally: steepest about 60 degrees
constexpr double kTreadSlope = 0.02;
constexpr double kTerraceBend_m = 2.5;

constexpr double kRampSlopeEast = 0.10;
constexpr double kRampSlopeNorth = 0.05;

double latticeValue(std::int64_t i, std::int64_t j, std::uint64_t seed) {
    return 2.0 *
               unitInterval(scramble({seed, static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(j)})) -
           1.0;
}

double interpolate(double from, double to, double weight) {
    return from + (to - from) * weight;
}

// A bump 1 high that falls to a quarter at distance 1; cheap, and the same on every machine.
double bump(double distance) {
    const double d = 1.0 + distance * distance;
    return 1.0 / (d * d);
}

}  // namespace

double valueNoise(double x, double y, std::uint64_t seed) {
    const double x0 = std::floor(x);
    const double y0 = std::floor(y);
    const auto i = static_cast<std::int64_t>(x0);
    const auto j = static_cast<std::int64_t>(y0);
    const double wx = smoothStep(x - x0);
    const double wy = smoothStep(y - y0);
    const double south = interpolate(latticeValue(i, j, seed), latticeValue(i + 1, j, seed), wx);
    const double north = interpolate(latticeValue(i, j + 1, seed), latticeValue(i + 1, j + 1, seed), wx);
    return interpolate(south, north, wy);
}

TerrainModel::TerrainModel(SimulatedTerrain kind, std::uint64_t seed)
    : kind_(kind), seed_(scramble({seed, 1})) {
    zero_m_ = shape_m(0.0, 0.0);
}

double TerrainModel::slope(double e_m, double n_m) const {
    constexpr double kReach_m = 0.3;
    const double east = height_m(e_m + kReach_m, n_m) - height_m(e_m - kReach_m, n_m);
    const double north = height_m(e_m, n_m + kReach_m) - height_m(e_m, n_m - kReach_m);
    return std::sqrt(east * east + north * north) / (2.0 * kReach_m);
}

double TerrainModel::shape_m(double e_m, double n_m) const {
    switch (kind_) {
        case SimulatedTerrain::TerracedOrchard:
            return terraces_m(e_m, n_m) + roughness_m(e_m, n_m);
        case SimulatedTerrain::Gully: {
            const double bed_e_m = 8.0 + 5.0 * valueNoise(n_m / 15.0, 0.0, seed_);
            return 0.06 * n_m - 2.5 * bump((e_m - bed_e_m) / 3.5) + roughness_m(e_m, n_m);
        }
        case SimulatedTerrain::Plain:
            return 0.005 * e_m + 0.15 * valueNoise(e_m / 18.0, n_m / 18.0, scramble({seed_, 2})) +
                   roughness_m(e_m, n_m);
        case SimulatedTerrain::Ridge: {
            const double crest_n_m = 20.0 + 0.2 * e_m;
            return 4.0 * bump((n_m - crest_n_m) / 14.0) + roughness_m(e_m, n_m);
        }
        case SimulatedTerrain::Ramp:
            return kRampSlopeEast * e_m + kRampSlopeNorth * n_m;
    }
    return 0.0;
}

double TerrainModel::terraces_m(double e_m, double n_m) const {
    // The terraces climb to the north and follow a slope that bends; half a tread lies on either side of
    // ZERO.
    const double bend_m = kTerraceBend_m * (valueNoise(e_m / 25.0, 0.0, seed_) - valueNoise(0.0, 0.0, seed_));
    const double along_m = n_m + bend_m + 0.5 * (kTerraceDepth_m - kRiserDepth_m);
    const double step = std::floor(along_m / kTerraceDepth_m);
    const auto level_m = [&](double k) {
        return (kTerraceDrop_m - kTreadSlope * kTerraceDepth_m) * k +
               kTerraceDropSpread_m * latticeValue(static_cast<std::int64_t>(k), 0, scramble({seed_, 3}));
    };
    const double into_m = along_m - step * kTerraceDepth_m;
    const double climbed = smoothStep((into_m - (kTerraceDepth_m - kRiserDepth_m)) / kRiserDepth_m);
    return kTreadSlope * along_m + interpolate(level_m(step), level_m(step + 1.0), climbed);
}

double TerrainModel::roughness_m(double e_m, double n_m) const {
    return 0.06 * valueNoise(e_m / 5.0, n_m / 5.0, scramble({seed_, 4})) +
           0.02 * valueNoise(e_m / 0.9, n_m / 0.9, scramble({seed_, 5}));
}

}  // namespace terrawalk
