#include "fusion/adjustment_groups.hpp"

#include <array>
#include <string>
#include <utility>

namespace terrawalk {

std::vector<RowGroup> adjustmentGroups(bool robust) {
    std::vector<RowGroup> groups(kGroupCount);
    const auto set = [&](std::size_t g, std::string name, Loss loss, double tuning, bool adapt,
                         double least = 0.2, double greatest = 5.0) {
        groups[g] = {
            std::move(name), robust ? loss : Loss::Square, tuning, false, adapt, least, greatest, 20.0, 1.0};
    };
    set(kPrior, "prior", Loss::Square, 3.0, false);
    set(kTieH, "mark ties, plan", Loss::Square, 3.0, false);
    set(kTieV, "mark ties, height", Loss::Huber, 3.0, false);
    static const std::array<std::string, kFixClassCount> kFixes{"single", "RTK float", "RTK fixed"};
    // A fixed position does not drift by more than its sigma; what seems to is the sway of the walk.
    for (std::size_t f = 0; f < kFixClassCount; ++f) {
        set(kGnssH + f, "GNSS noise, plan, " + kFixes[f], Loss::Cauchy, 3.0, true, 0.5);
        set(kGnssV + f, "GNSS noise, height, " + kFixes[f], Loss::Cauchy, 3.0, true);
        set(kGnssWalkH + f, "GNSS drift, plan, " + kFixes[f], Loss::Cauchy, 2.0, true, 0.3,
            f == kFixedClass ? 1.0 : 3.0);
        set(kGnssWalkV + f, "GNSS drift, height, " + kFixes[f], Loss::Cauchy, 2.0, true, 0.3, 3.0);
    }
    set(kGnssBias, "GNSS bias of a run", Loss::Square, 3.0, true, 0.2, 6.0);
    set(kDoppler, "GNSS velocity", Loss::Cauchy, 3.0, true);
    set(kBarometer, "barometer noise", Loss::Huber, 2.0, true);
    set(kBarometerDrift, "barometer drift", Loss::Square, 3.0, true, 0.1, 6.0);
    set(kGust, "barometer gusts", Loss::Square, 3.0, true, 0.1, 6.0);
    set(kFlow, "optical flow", Loss::Huber, 3.0, true, 0.3, 6.0);
    set(kBridge, "optical flow bridged", Loss::Square, 2.0, false);
    set(kFlowScale, "optical flow scale", Loss::Square, 3.0, true, 0.2, 3.0);
    set(kCompass, "compass drift", Loss::Cauchy, 3.0, true, 0.2, 6.0);
    set(kGyro, "gyro", Loss::Huber, 3.0, true, 0.2, 20.0);
    set(kHeading, "compass noise", Loss::Cauchy, 3.0, true, 0.2, 10.0);
    set(kWalk, "walk", Loss::Square, 2.0, false);
    set(kClimb, "ground climb", Loss::Cauchy, 2.0, true, 0.5, 4.0);
    groups[kClimb].by_median = true;
    set(kRoughness, "ground roughness", Loss::Huber, 2.0, true, 0.2, 6.0);
    set(kBlindClimb, "climb", Loss::Huber, 2.0, false);
    set(kAccelerationH, "accelerometer, plan", Loss::Huber, 3.0, true, 0.2, 50.0);
    set(kAccelerationV, "accelerometer, height", Loss::Huber, 3.0, true, 0.2, 50.0);
    set(kAccelerationBias, "accelerometer bias", Loss::Square, 3.0, false);
    set(kPair, "crossovers", Loss::Cauchy, 3.0, true, 0.5, 5.0);
    set(kMarkPass, "passes over marks", Loss::Cauchy, 3.0, true, 0.5, 5.0);
    return groups;
}

}  // namespace terrawalk
