#include <algorithm>
#include <array>
#include <cmath>

#include "fusion/adjustment_groups.hpp"
#include "fusion/knot_intervals.hpp"
#include "fusion/sensor_rows.hpp"
#include "fusion/squared.hpp"

namespace terrawalk {

namespace {

std::size_t ofClass(AdjustmentGroup first, GnssFixClass fix_class) {
    return std::size_t{first} + fix_class;
}

}  // namespace

// Weak where ties or GNSS tell more: it only keeps the system regular.
void SensorRows::addStart(const RunModel& run) {
    const RunReference& reference = run.start->reference;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<Eigen::Index>(axis);
        const double sigma = std::max(reference.start_sigma_m[a], 0.01);
        system_.addRow(kPrior, {{run.correction.unknown(0, axis), 1.0}},
                       reference.start_enu_m[a] - run.track_m[0][a], sigma);
    }
}

void SensorRows::addTies(const RunModel& run) {
    for (const MarkTie& tie : run.start->reference.ties) {
        for (std::size_t axis = 0; axis < (tie.has_height ? 3U : 2U); ++axis) {
            const auto a = static_cast<Eigen::Index>(axis);
            row_.clear();
            position(run, tie.epoch, axis, 1.0);
            system_.addRow(axis == 2 ? kTieV : kTieH, row_.all(),
                           tie.array_enu_m[a] - run.track_m[tie.epoch][a], std::sqrt(tie.variance_m2[a]));
        }
    }
}

void SensorRows::addGnss(const RunModel& run) {
    for (const GnssEpoch& gnss : run.gnss) {
        const GnssSegment& segment = run.segments[gnss.segment];
        const KnotChain::Place place = segment.error.locate(run.time(gnss.epoch));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis);
            if (!present(gnss.enu_m[a])) continue;
            row_.clear();
            position(run, gnss.epoch, axis, 1.0);
            segment.error.addTo(row_, place, 1.0, axis);
            double bias_m = 0.0;
            if (axis < 2 && gnss.fix_class == kSingleClass) {
                row_.add(run.gnss_bias[axis].unknown, 1.0);
                bias_m = run.gnss_bias[axis].value;
            }
            system_.addRow(
                ofClass(axis == 2 ? kGnssV : kGnssH, segment.fix_class), row_.all(),
                gnss.enu_m[a] - run.track_m[gnss.epoch][a] - segment.error.value(place, axis) - bias_m,
                axis == 2 ? gnss.white_up_m : gnss.white_m);
        }
    }
    if (run.has_single) addGnssBias(run);
    for (const GnssSegment& segment : run.segments) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            addGaussMarkov(segment.error, axis, axis == 2 ? segment.sigma_up_m : segment.sigma_m,
                           options_.lasting.gnss_correlation_s,
                           ofClass(axis == 2 ? kGnssWalkV : kGnssWalkH, segment.fix_class));
        }
    }
}

// What a receiver without RTK errs by for hours: all runs share most of it.
void SensorRows::addGnssBias(const RunModel& run) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const SingleUnknown& day = shared_.gnss_bias[axis];
        const SingleUnknown& own = run.gnss_bias[axis];
        system_.addRow(kGnssBias, {{own.unknown, 1.0}, {day.unknown, -1.0}}, day.value - own.value,
                       options_.lasting.gnss_bias_run_sigma_m);
    }
}

// A stationary first-order Gauss-Markov process; the first knot carries its variance.
void SensorRows::addGaussMarkov(const KnotChain& chain, std::size_t part, double sigma, double correlation_s,
                                std::size_t group) {
    system_.addRow(kPrior, {{chain.unknown(0, part), 1.0}}, -chain.knotValue(0, part), sigma);
    for (std::size_t k = 1; k < chain.knots(); ++k) {
        const double keep = std::exp(-(chain.time(k) - chain.time(k - 1)) / correlation_s);
        system_.addRow(group, {{chain.unknown(k, part), 1.0}, {chain.unknown(k - 1, part), -keep}},
                       keep * chain.knotValue(k - 1, part) - chain.knotValue(k, part),
                       sigma * std::sqrt(1.0 - keep * keep));
    }
}

void SensorRows::addDoppler(const RunModel& run) {
    if (!options_.gnss.use_velocity || !run.log->has(Channel::GnssVelocityEast)) return;
    static constexpr std::array<Channel, 3> kAxes{Channel::GnssVelocityEast, Channel::GnssVelocityNorth,
                                                  Channel::GnssVelocityUp};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<Eigen::Index>(axis);
        const double sigma =
            axis == 2 ? options_.gnss.velocity_sigma_up_mps : options_.gnss.velocity_sigma_mps;
        double residual = 0.0;
        double covered_s = 0.0;
        double variance = 0.0;
        overIntervals(
            run,
            [&](std::size_t i) {
                return present(run.log->value(kAxes[axis], i)) && dopplerRejection(*run.log, i) == "";
            },
            [&](std::size_t i, double from_s, double to_s) {
                const double dt = to_s - from_s;
                residual +=
                    dt * run.log->value(kAxes[axis], i) - (trackAt(run, to_s) - trackAt(run, from_s))[a];
                covered_s += dt;
                // Errors that last for `velocity_correlation_s`.
                variance += squared(dt * sigma) * std::max(1.0, 2.0 * options_.gnss.velocity_correlation_s /
                                                                    std::max(dt, 0.02) / 5.0);
            },
            [&](std::size_t k, double dt) {
                if (covered_s > 0.0) {
                    const double share = covered_s / dt;
                    system_.addRow(kDoppler,
                                   {{run.correction.unknown(k + 1, axis), share},
                                    {run.correction.unknown(k, axis), -share}},
                                   residual, std::max(std::sqrt(variance), 0.01));
                }
                residual = covered_s = variance = 0.0;
            });
    }
}

}  // namespace terrawalk
