#include "fusion/aukf_trajectory.hpp"

#include "fusion/filter_family.hpp"
#include "fusion/positioning_model.hpp"
#include "fusion/sensor_ledger.hpp"

namespace terrawalk {

namespace {

// What the filter did with the rows of each sensor in one epoch.
void count(const RowSensors& sensors, RowSet offered, RowSet used, SensorLedger& ledger) {
    for (std::size_t row = 0; row < kRowCount; ++row) {
        // A sensor's rows follow one another; the first that is offered speaks for all.
        if ((offered & rowBit(row)) == 0) continue;
        RowSet own = 0;
        const Sensor sensor = sensors[row];
        for (; row < kRowCount && sensors[row] == sensor; ++row) own = static_cast<RowSet>(own | rowBit(row));
        --row;
        if ((used & own) != 0) {
            ledger.use(sensor, false);
        } else {
            ledger.reject(sensor, sensor == Sensor::Heading ? "too slow" : "beyond the greatest noise");
        }
    }
}

TrajectoryEpoch trajectoryEpoch(const StateEstimate& state, double time_s, const EpochAttitude& attitude) {
    constexpr int p = offset(StateBlock::Position);
    constexpr int v = offset(StateBlock::Velocity);
    TrajectoryEpoch epoch;
    epoch.time_s = time_s;
    epoch.position_enu_m = state.block(StateBlock::Position);
    epoch.velocity_enu_mps = state.block(StateBlock::Velocity);
    epoch.covariance.topLeftCorner<3, 3>() = state.covariance.block<3, 3>(p, p);
    epoch.covariance.topRightCorner<3, 3>() = state.covariance.block<3, 3>(p, v);
    epoch.covariance.bottomLeftCorner<3, 3>() = state.covariance.block<3, 3>(v, p);
    epoch.covariance.bottomRightCorner<3, 3>() = state.covariance.block<3, 3>(v, v);
    epoch.attitude = attitude.attitude;
    epoch.sigma_tilt_rad = attitude.sigma_tilt_rad;
    epoch.sigma_heading_rad = attitude.sigma_heading_rad;
    return epoch;
}

}  // namespace

Result<FusedRun> aukfTrajectory(const Survey& survey, const Run& run, const FusionOptions& options,
                                const std::vector<EpochAttitude>& attitudes, const RunReference& reference,
                                Progress& progress, std::stop_token stop) {
    progress.report(0.0, "fusing " + run.id);
    SensorLedger ledger;
    const MeasuredRun measured = measuredRun(survey, run, options, attitudes, reference, ledger);
    auto filtered = filterRun(measured, options.aukf, stop);
    if (!filtered) {
        if (filtered.error().kind == ErrorKind::BadData) filtered.error().file = run.log.file;
        return tl::unexpected<Error>(std::move(filtered.error()));
    }
    FusedRun fused;
    fused.trajectory.run_id = run.id;
    fused.trajectory.epochs.reserve(run.log.size());
    for (std::size_t i = 0; i < run.log.size(); ++i) {
        fused.trajectory.epochs.push_back(
            trajectoryEpoch(filtered->states[i], run.log.time_s[i], attitudes[i]));
        count(measured.sensors, measured.epochs[i].present, filtered->used[i], ledger);
    }
    fused.sensors = ledger.uses();
    fused.consistency = std::move(filtered->consistency);
    if (!reference.starts_on_mark) {
        fused.notes.limitations.emplace_back(
            "the paper's method starts on a known mark; this run names none");
    }
    return fused;
}

}  // namespace terrawalk
