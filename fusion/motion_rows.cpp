#include <algorithm>
#include <array>
#include <cmath>

#include "fusion/adjustment_groups.hpp"
#include "fusion/position_bends.hpp"
#include "fusion/sensor_rows.hpp"
#include "fusion/squared.hpp"

namespace terrawalk {

namespace {

constexpr double kBlindBend_m = 0.5;            // of a sigma that tells nothing
constexpr double kYawDoubt_rad = radians(0.5);  // by which the yaw errs within a bend

}  // namespace

// Nobody turns on the spot of a second: the horizontal velocity is a random walk.
void SensorRows::addWalk(const RunModel& run) {
    for (std::size_t k = 1; k + 1 < run.correction.knots(); ++k) {
        const double dt0 = run.correction.time(k) - run.correction.time(k - 1);
        const double dt1 = run.correction.time(k + 1) - run.correction.time(k);
        const Eigen::Vector3d before = trackAt(run, run.correction.time(k - 1));
        const Eigen::Vector3d here = trackAt(run, run.correction.time(k));
        const Eigen::Vector3d after = trackAt(run, run.correction.time(k + 1));
        const Eigen::Vector3d change = (after - here) / dt1 - (here - before) / dt0;
        const double sigma = options_.joint.walk_mps_per_sqrt_s * std::sqrt((dt0 + dt1) / 3.0);
        for (std::size_t axis = 0; axis < 2; ++axis) {
            system_.addRow(kWalk,
                           {{run.correction.unknown(k + 1, axis), 1.0 / dt1},
                            {run.correction.unknown(k, axis), -1.0 / dt1 - 1.0 / dt0},
                            {run.correction.unknown(k - 1, axis), 1.0 / dt0}},
                           -change[static_cast<Eigen::Index>(axis)], sigma);
        }
    }
}

// Yaw at the even steps of the accelerations, linear between epochs.
std::vector<double> SensorRows::yawOfSteps(const RunModel& run) const {
    const LevelAcceleration& series = *run.acceleration;
    std::vector<double> yaw(series.size());
    std::size_t i = 0;
    for (std::size_t j = 0; j < series.size(); ++j) {
        while (i + 2 < run.size() && run.time(i + 1) <= series.time(j)) ++i;
        const double f =
            std::clamp((series.time(j) - run.time(i)) / (run.time(i + 1) - run.time(i)), 0.0, 1.0);
        const double here = trueYaw(run, shared_.iron, i);
        yaw[j] = here + f * wrapAngle(trueYaw(run, shared_.iron, i + 1) - here);
    }
    return yaw;
}

// Bends of the track averaged over a stride; what is linear between knots bends at them alone, and the
// average takes the share `b` of each bend to either side.
void SensorRows::addAcceleration(const RunModel& run) {
    if (!run.acceleration) return;
    const JointOptions& o = options_.joint;
    std::vector<double> knots(run.correction.knots());
    std::vector<Eigen::Vector3d> track_m(knots.size());
    for (std::size_t k = 0; k < knots.size(); ++k) {
        knots[k] = run.correction.time(k);
        track_m[k] = strideAverage(run.log->time_s, run.track_m, knots[k]);
    }
    const double b = kStrideAverage_s / (6.0 * o.knot_s);
    const std::array<double, 5> kernel{b, 1.0 - 4.0 * b, -2.0 + 6.0 * b, 1.0 - 4.0 * b, b};
    for (const PositionBend& bend : positionBends(*run.acceleration, yawOfSteps(run), knots, o.knot_s)) {
        const std::size_t k = bend.knot;
        const Eigen::Vector3d bent_m = track_m[k - 1] - 2.0 * track_m[k] + track_m[k + 1];
        if (!bent_m.allFinite() || bend.filled_sigma_m > kBlindBend_m) continue;
        const KnotChain::Place at = run.force_bias.locate(knots[k]);
        Eigen::Vector3d bias_mps2;
        for (std::size_t part = 0; part < 3; ++part) {
            bias_mps2[static_cast<Eigen::Index>(part)] = run.force_bias.value(at, part);
        }
        const Eigen::Vector3d residual_m = bend.bend_m - bend.by_bias_s2 * bias_mps2 - bent_m;
        const double noise_m2 =
            squared(o.acceleration_noise_mps2 * bend.sigma_per_noise_s2) + squared(bend.filled_sigma_m);
        const double turned_m2 = bend.bend_m.head<2>().squaredNorm() * squared(kYawDoubt_rad);
        for (std::size_t axis = run.has_heading ? 0 : 2; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis);
            row_.clear();
            for (std::size_t j = 0; j < kernel.size(); ++j) {
                // Beyond the ends the correction goes on as it is.
                const std::size_t knot = std::clamp<std::size_t>(k + j, 2, knots.size() + 1) - 2;
                row_.add(run.correction.unknown(knot, axis), kernel[j]);
            }
            for (std::size_t part = 0; part < 3; ++part) {
                run.force_bias.addTo(row_, at, bend.by_bias_s2(a, static_cast<Eigen::Index>(part)), part);
            }
            if (axis < 2) turnedBy(run, knots[k], axis == 0 ? bend.bend_m.y() : -bend.bend_m.x());
            system_.addRow(axis == 2 ? kAccelerationV : kAccelerationH, row_.all(), residual_m[a],
                           std::sqrt(noise_m2 + (axis == 2 ? 0.0 : turned_m2)));
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // A tilt that is off lets gravity into the level axes, and the error of the tilt wanders.
        addGaussMarkov(run.force_bias, axis, options_.lasting.acceleration_bias_sigma_mps2,
                       axis == 2 ? options_.lasting.acceleration_bias_correlation_s
                                 : options_.lasting.tilt_correlation_s,
                       kAccelerationBias);
    }
}

}  // namespace terrawalk
