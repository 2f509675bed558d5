#include <algorithm>
#include <array>
#include <cmath>

#include "fusion/adjustment_groups.hpp"
#include "fusion/knot_intervals.hpp"
#include "fusion/sensor_rows.hpp"
#include "fusion/squared.hpp"

namespace terrawalk {

// The compass error wanders; what the gyro saw of the turns tells how.
void SensorRows::addHeading(const RunModel& run) {
    if (!run.has_heading) return;
    const LastingErrorOptions& lasting = options_.lasting;
    addGaussMarkov(run.psi, 0, radians(lasting.heading_sigma_deg), lasting.heading_correlation_s, kCompass);
    system_.addRow(kPrior, {{run.gyro_bias.unknown, 1.0}}, -run.gyro_bias.value,
                   radians(lasting.gyro_bias_sigma_dps));
    system_.addRow(kPrior, {{run.gyro_scale.unknown, 1.0}}, -run.gyro_scale.value, lasting.gyro_scale_sigma);
    if (run.has_gyro) addGyro(run);
}

void SensorRows::addGyro(const RunModel& run) {
    const double walk = radians(options_.lasting.gyro_walk_deg_per_sqrt_s);
    std::vector<double> doubt_rad2(run.turn.knots(), 0.0);
    std::vector<double> turned_rad(run.turn.knots(), 0.0);
    for (std::size_t i = 0; i < run.size(); ++i) {
        const std::size_t k = std::min(run.turn_at[i].knot + 1, run.turn.knots() - 1);
        doubt_rad2[k] += run.base_doubt_rad2[i];
        turned_rad[k] += run.gyro_turn_rad[i];
    }
    system_.addRow(kPrior, {{run.turn.unknown(0), 1.0}}, -run.turn.knotValue(0), 1.0);
    for (std::size_t k = 1; k < run.turn.knots(); ++k) {
        const double dt = run.turn.time(k) - run.turn.time(k - 1);
        system_.addRow(kGyro,
                       {{run.turn.unknown(k), 1.0},
                        {run.turn.unknown(k - 1), -1.0},
                        {run.gyro_bias.unknown, -dt},
                        {run.gyro_scale.unknown, -turned_rad[k]}},
                       run.turn.knotValue(k - 1) - run.turn.knotValue(k) + run.gyro_bias.value * dt +
                           run.gyro_scale.value * turned_rad[k],
                       std::sqrt(squared(walk) * dt + doubt_rad2[k]));
    }
    addCompass(run);
}

// Compass against summed gyro, one row for the mean over each knot interval.
void SensorRows::addCompass(const RunModel& run) {
    constexpr double kSteady_rad = radians(0.15);  // of the mean: what does not average out
    const auto lag_rad = [&](std::size_t first, std::size_t last) {
        const double over_s = run.time(last) - run.time(first);
        const double turned_rad = run.base_yaw_rad[last] - run.base_yaw_rad[first];
        return over_s > 0.0 ? options_.attitude.heading_lag_s * turned_rad / over_s : 0.0;
    };
    const double white = compassNoise_rad(options_.attitude);
    std::array<double, 2> turn{}, psi{};
    double n = 0.0, sine = 0.0, cosine = 0.0, residual = 0.0;
    std::size_t psi_first = 0;
    std::size_t first = 0;
    std::size_t last = 0;
    std::size_t turn_interval = 0;
    for (std::size_t i = 0; i <= run.size(); ++i) {
        const std::size_t interval = i == run.size() ? run.turn.knots() : run.turn_at[i].knot;
        if (n > 0.0 && interval != turn_interval) {
            row_.clear();
            for (std::size_t j = 0; j < 2; ++j) {
                if (turn[j] != 0.0) row_.add(run.turn.unknown(turn_interval + j), -turn[j] / n);
                if (psi[j] != 0.0) row_.add(run.psi.unknown(psi_first + j), psi[j] / n);
            }
            row_.add(run.iron.sin.unknown, sine / n);
            row_.add(shared_.iron.sin.unknown, sine / n);
            row_.add(run.iron.cos.unknown, cosine / n);
            row_.add(shared_.iron.cos.unknown, cosine / n);
            system_.addRow(kHeading, row_.all(), residual / n,
                           std::hypot(white / std::sqrt(n), kSteady_rad, lag_rad(first, last)));
            turn = psi = {};
            n = sine = cosine = residual = 0.0;
        }
        if (i == run.size()) break;
        turn_interval = interval;
        if (!present(run.log->value(Channel::Heading, i))) continue;
        if (n == 0.0) {
            psi_first = run.psi_at[i].knot;
            first = i;
        }
        last = i;
        const double yaw = run.yaw_rad[i];
        turn[0] += 1.0 - run.turn_at[i].fraction;
        turn[1] += run.turn_at[i].fraction;
        psi[0] += 1.0 - run.psi_at[i].fraction;
        psi[1] += run.psi_at[i].fraction;
        sine += std::sin(yaw);
        cosine += std::cos(yaw);
        residual += wrapAngle(yaw - trueYaw(run, shared_.iron, i) - run.psi.value(run.psi_at[i]) -
                              (shared_.iron.sin.value + run.iron.sin.value) * std::sin(yaw) -
                              (shared_.iron.cos.value + run.iron.cos.value) * std::cos(yaw));
        n += 1.0;
    }
}

// Adds to the row what errors of the heading at a time do to a reading: `change` for each radian.
void SensorRows::turnedBy(const RunModel& run, double time_s, double change) {
    if (run.has_gyro) {
        run.turn.addTo(row_, run.turn.locate(time_s), -change);
        return;
    }
    run.psi.addTo(row_, run.psi.locate(time_s), -change);
    const auto& times = run.log->time_s;
    const auto next = std::lower_bound(times.begin(), times.end() - 1, time_s);
    const double yaw = run.yaw_rad[static_cast<std::size_t>(next - times.begin())];
    row_.add(run.iron.sin.unknown, -change * std::sin(yaw));
    row_.add(run.iron.cos.unknown, -change * std::cos(yaw));
    row_.add(shared_.iron.sin.unknown, -change * std::sin(yaw));
    row_.add(shared_.iron.cos.unknown, -change * std::cos(yaw));
}

}  // namespace terrawalk
