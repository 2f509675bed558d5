#include "fusion/drift_filter.hpp"

#include <fmt/format.h>

#include <array>

#include "fusion/drift_model.hpp"
#include "fusion/flow_screen.hpp"
#include "fusion/gnss_jumps.hpp"
#include "fusion/rts_smoother.hpp"
#include "fusion/run_filter.hpp"

namespace terrawalk {

namespace {

struct PackedDrift {
    DriftVector mean;
    PackedTriangle<kDriftStates> covariance;
};

PackedDrift packed(const DriftEstimate& state) {
    return {state.mean, packedTriangle<kDriftStates>(state.covariance)};
}

DriftEstimate unpacked(const PackedDrift& state) {
    return {state.mean, unpackedTriangle<kDriftStates>(state.covariance)};
}

void smooth(std::vector<PackedDrift>& filtered, const DriftModel& model, std::stop_token stop) {
    DriftEstimate next = unpacked(filtered.back());
    for (std::size_t k = filtered.size() - 1; k-- > 0;) {
        if (k % 256 == 0 && stop.stop_requested()) return;
        const DriftEstimate here = unpacked(filtered[k]);
        const DriftTransition step = model.transitionInto(k + 1);
        stepBack<kDriftStates>(here.mean, here.covariance, step.F, step.Q, next.mean, next.covariance);
        filtered[k] = packed(next);
    }
}

TrajectoryEpoch trajectoryEpoch(const DriftEstimate& state, double time_s, const EpochAttitude& attitude) {
    constexpr std::array<int, 6> kOrder{kEast, kNorth, kUp, kVelocityEast, kVelocityNorth, kVelocityUp};
    TrajectoryEpoch epoch;
    epoch.time_s = time_s;
    epoch.position_enu_m = state.mean.segment<3>(kEast);
    epoch.velocity_enu_mps << state.mean[kVelocityEast], state.mean[kVelocityNorth], state.mean[kVelocityUp];
    epoch.covariance = state.covariance(kOrder, kOrder);
    epoch.attitude = attitude.attitude;
    epoch.sigma_tilt_rad = attitude.sigma_tilt_rad;
    epoch.sigma_heading_rad = attitude.sigma_heading_rad;
    return epoch;
}

// Accelerometer and yaw row have no place among the states.
FusionOptions readingOptions(FusionOptions options) {
    options.accelerometer.use = false;
    options.yaw_row.use = false;
    return options;
}

}  // namespace

Result<DriftFilterResult> filterWithDrifts(const Survey& survey, const Run& run, const FusionOptions& options,
                                           const std::vector<EpochAttitude>& attitudes,
                                           const RunReference& reference, Progress& progress,
                                           std::stop_token stop) {
    const LocalFrame frame = survey.frame();
    const FusionOptions reading_options = readingOptions(options);
    const FlowRejections flow = flowRejections(run.log, attitudes, options.flow);
    const ReadingContext context{run.log, reading_options, frame, attitudes, reference, flow};
    DriftModel model(context);
    RunFilter filter(context, run, model);
    const std::size_t n = run.log.size();
    DriftFilterResult result;
    std::vector<PackedDrift> estimates;
    estimates.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (i % 512 == 0) {
            if (stop.stop_requested()) return cancelled();
            progress.report(0.5 * static_cast<double>(i) / static_cast<double>(n), "fusing " + run.id);
        }
        if (auto error = filter.step(i)) return tl::unexpected<Error>(std::move(*error));
        estimates.push_back(packed(model.state()));
        result.gnss_gated.push_back(filter.gated(Sensor::GnssPosition));
    }
    if (options.smooth) {
        progress.report(0.5, "smoothing " + run.id);
        smooth(estimates, model, stop);
        if (stop.stop_requested()) return cancelled();
    }
    result.fused.trajectory.run_id = run.id;
    result.fused.trajectory.epochs.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        const TrajectoryEpoch epoch =
            trajectoryEpoch(unpacked(estimates[i]), run.log.time_s[i], attitudes[i]);
        if (!epoch.position_enu_m.allFinite() || !epoch.covariance.allFinite()) {
            return badData(fmt::format("run {}: the smoother failed at {:.2f} s", run.id, run.log.time_s[i]),
                           run.log.file);
        }
        result.fused.trajectory.epochs.push_back(epoch);
    }
    result.fused.sensors = filter.sensors();
    result.fused.innovations = filter.innovations();
    filter.note(result.fused.notes.details);
    result.gnss_jump_m = model.gnssJumpSizes();
    if (std::string note = gnssJumpsNote(run.log, result.gnss_jump_m); !note.empty()) {
        result.fused.notes.details.push_back(std::move(note));
    }
    return result;
}

}  // namespace terrawalk
