#include <algorithm>
#include <cmath>

#include "fusion/adjustment_groups.hpp"
#include "fusion/barometer.hpp"
#include "fusion/sensor_rows.hpp"
#include "fusion/squared.hpp"

namespace terrawalk {

namespace {

constexpr double kLooseZero_m = 10.0;

// Whether anything but the zero of the barometer tells the height of a run.
bool heightIsTold(const RunModel& run) {
    for (const MarkTie& tie : run.start->reference.ties) {
        if (tie.has_height) return true;
    }
    return std::any_of(run.gnss.begin(), run.gnss.end(),
                       [](const GnssEpoch& g) { return present(g.enu_m.z()); });
}

}  // namespace

void SensorRows::addBarometer(const RunModel& run) {
    if (!run.has_barometer) return;
    const BarometerOptions& o = options_.barometer;
    for (std::size_t i = 0; i < run.size(); ++i) {
        if (barometerRejection(*run.log, i) != "") continue;
        const double up_m =
            run.start->reference.barometricUp(run.log->value(Channel::Pressure, i), o.scale, run.track_m[i]);
        const KnotChain::Place drift = run.drift.locate(run.time(i));
        const KnotChain::Place gust = run.gust.locate(run.time(i));
        row_.clear();
        position(run, i, 2, 1.0);
        run.drift.addTo(row_, drift, 1.0);
        run.gust.addTo(row_, gust, 1.0);
        system_.addRow(kBarometer, row_.all(),
                       up_m - run.track_m[i].z() - run.drift.value(drift) - run.gust.value(gust), o.sigma_m);
    }
    addGaussMarkov(run.gust, 0, o.gust_sigma_m, o.gust_correlation_s, kGust);
    const double zero_sigma_m =
        heightIsTold(run) ? kLooseZero_m : std::sqrt(run.start->reference.height_reference_variance_m2);
    system_.addRow(kPrior, {{run.drift.unknown(0), 1.0}}, -run.drift.knotValue(0),
                   std::max(zero_sigma_m, 0.01));
    for (std::size_t k = 1; k < run.drift.knots(); ++k) {
        const double dt = run.drift.time(k) - run.drift.time(k - 1);
        system_.addRow(kBarometerDrift, {{run.drift.unknown(k), 1.0}, {run.drift.unknown(k - 1), -1.0}},
                       run.drift.knotValue(k - 1) - run.drift.knotValue(k),
                       o.drift_m_per_sqrt_min * std::sqrt(dt / 60.0));
    }
}

// Height above ground about a knot.
double SensorRows::aboveGround(const RunModel& run, double time_s) {
    constexpr double kReach_s = 0.81;
    const std::vector<double>& times = run.log->time_s;
    scratch_.clear();
    for (auto it = std::lower_bound(times.begin(), times.end(), time_s - kReach_s);
         it != times.end() && *it <= time_s + kReach_s; ++it) {
        const double above = run.above_ground_m[static_cast<std::size_t>(it - times.begin())];
        if (present(above)) scratch_.push_back(above);
    }
    return heightThroughGrass(scratch_);
}

// The ground below the walk lies about a level that wanders little, but for steps such as a terrace edge:
// a level with noise. Where no range was measured the array itself climbs little.
void SensorRows::addClimb(RunModel& run) {
    const JointOptions& o = options_.joint;
    for (std::size_t k = 0; k < run.level.knots(); ++k) {
        const double above = aboveGround(run, run.level.time(k));
        const double up = trackAt(run, run.level.time(k)).z();
        if (present(above) && !run.level_known[k]) run.level.setKnotValue(k, up - above);
        run.level_known[k] = present(above);
        if (run.level_known[k]) {
            system_.addRow(kRoughness, {{run.correction.unknown(k, 2), 1.0}, {run.level.unknown(k), -1.0}},
                           run.level.knotValue(k) + above - up, o.ground_roughness_m);
        } else {
            system_.addRow(kPrior, {{run.level.unknown(k), 1.0}}, 0.0, 1e3);
        }
        if (k == 0) continue;
        const double dt = run.level.time(k) - run.level.time(k - 1);
        const Eigen::Vector3d step = trackAt(run, run.level.time(k)) - trackAt(run, run.level.time(k - 1));
        if (run.level_known[k] && run.level_known[k - 1]) {
            const double sigma =
                std::sqrt(squared(o.ground_climb_m_per_sqrt_m) * step.head<2>().norm() + squared(0.005));
            system_.addRow(kClimb, {{run.level.unknown(k), 1.0}, {run.level.unknown(k - 1), -1.0}},
                           run.level.knotValue(k - 1) - run.level.knotValue(k), sigma);
        } else {
            system_.addRow(kBlindClimb,
                           {{run.correction.unknown(k, 2), 1.0}, {run.correction.unknown(k - 1, 2), -1.0}},
                           -step.z(), o.blind_climb_m_per_sqrt_s * std::sqrt(dt));
        }
    }
}

}  // namespace terrawalk
