#pragma once

#include <cstddef>
#include <vector>

#include "fusion/sensor_readings.hpp"
#include "fusion/sparse_least_squares.hpp"

namespace terrawalk {

/// Rows of the joint adjustment by the cause of their noise.
enum AdjustmentGroup : std::size_t {
    kPrior,
    kTieH,
    kTieV,
    kGnssH,  // of each class of fix
    kGnssV = kGnssH + kFixClassCount,
    kGnssWalkH = kGnssV + kFixClassCount,
    kGnssWalkV = kGnssWalkH + kFixClassCount,
    kGnssBias = kGnssWalkV + kFixClassCount,
    kDoppler,
    kBarometer,
    kBarometerDrift,
    kGust,
    kFlow,
    kBridge,
    kFlowScale,
    kCompass,
    kGyro,
    kHeading,
    kWalk,
    kClimb,
    kRoughness,
    kBlindClimb,
    kAccelerationH,
    kAccelerationV,
    kAccelerationBias,
    kPair,
    kMarkPass,
    kGroupCount,
};

/// What the adjustment holds of each of them, in the order of AdjustmentGroup. Pure.
/// @param robust  false: every residual counts by its square, as long as the track is far from its place
[[nodiscard]] std::vector<RowGroup> adjustmentGroups(bool robust);

}  // namespace terrawalk
