#include "fusion/fuse_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "fusion/aukf_trajectory.hpp"
#include "fusion/drift_filter.hpp"
#include "fusion/flow_screen.hpp"
#include "fusion/raw_trajectory.hpp"
#include "fusion/rts_smoother.hpp"
#include "fusion/run_filter.hpp"
#include "fusion/run_reference.hpp"
#include "fusion/sensor_readings.hpp"

namespace terrawalk {

namespace {

double squared(double x) {
    return x * x;
}

// The nine states of the filter of paper 000, for RunFilter.
class NineStates final : public FilterModel {
  public:
    NineStates(const ReadingContext& context) : context_(context) {
        const RunReference& reference = context.reference;
        const InitialOptions& initial = context.options.initial;
        state_.covariance.setZero();
        state_.mean.segment<3>(offset(StateBlock::Position)) = reference.start_enu_m;
        state_.covariance.diagonal().segment<3>(offset(StateBlock::Position)) =
            reference.start_sigma_m.array().square();
        state_.covariance.diagonal()
            .segment<3>(offset(StateBlock::Velocity))
            .setConstant(squared(initial.velocity_sigma_mps));
        state_.covariance.diagonal()
            .segment<3>(offset(StateBlock::Acceleration))
            .setConstant(squared(initial.acceleration_sigma_mps2));
    }

    const StateEstimate& state() const { return state_; }
    const std::vector<Inflation>& inflations() const { return inflations_; }
    const Vector9d& heightResponse() const { return height_response_; }

    void predict(std::size_t epoch) override {
        const double dt_s = context_.log.time_s[epoch] - context_.log.time_s[epoch - 1];
        const Transition step = transition(context_.options.process, dt_s);
        state_ = predicted(state_, step);
        height_response_ = (step.F * height_response_).eval();
    }
    StateEstimate prediction() const override { return state_; }
    Eigen::Matrix3d positionCovariance() const override {
        return state_.blockCovariance(StateBlock::Position);
    }
    bool finite() const override { return state_.finite(); }

    RowTest test(std::size_t, const Reading& reading, std::size_t r) const override {
        const LinearRow& row = reading.rows[r].row;
        return {innovation(state_, row),
                std::sqrt(predictedVariance(state_, row) + reading.rows[r].gate_variance)};
    }
    void update(std::size_t, const Reading& reading, std::size_t r, double excess) override {
        LinearRow row = reading.rows[r].row;
        row.variance *= excess;
        take(row, reading.sensor == Sensor::Barometer);
    }
    void assume(const LinearRow& row) override { take(row, false); }
    // Where nothing measures height it stays near that of the start, by an assumption that errs lastingly.
    void holdHeight() override {
        take({StateBlock::Position, Eigen::Vector3d::UnitZ(), context_.reference.start_enu_m.z(),
              context_.reference.height_reference_variance_m2},
             true);
    }
    // The filter's own variance grows by the square of what it is off.
    void readmit(std::size_t epoch, const Reading& reading) override {
        Inflation inflation{epoch, reading.rows[0].row.block, Eigen::Vector3d::Zero()};
        for (std::size_t r = 0; r < reading.row_count; ++r) {
            const LinearRow& row = reading.rows[r].row;
            inflation.variance += squared(innovation(state_, row)) * row.direction.array().square().matrix();
        }
        const int at = offset(inflation.block);
        state_.covariance.block<3, 3>(at, at).diagonal() += inflation.variance;
        inflations_.push_back(inflation);
    }

  private:
    // `from_height_reference`: the row's value moves with what heights are measured from.
    void take(const LinearRow& row, bool from_height_reference) {
        const double moved = from_height_reference ? row.direction.z() : 0.0;
        height_response_ +=
            gain(state_, row) * (moved - row.direction.dot(height_response_.segment<3>(offset(row.block))));
        state_ = updated(state_, row);
    }

    const ReadingContext& context_;
    StateEstimate state_;
    std::vector<Inflation> inflations_;
    Vector9d height_response_ = Vector9d::Zero();
};

TrajectoryEpoch trajectoryEpoch(const PackedEstimate& estimate, double height_reference_variance_m2,
                                double time_s, const EpochAttitude& attitude) {
    StateEstimate state = unpacked(estimate);
    const Vector9d lasting = std::sqrt(height_reference_variance_m2) * estimate.height_response;
    state.covariance += lasting * lasting.transpose();
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

Result<FusedRun> filteredRun(const Survey& survey, const Run& run, const FusionOptions& options,
                             const std::vector<EpochAttitude>& attitudes, const RunReference& reference,
                             Progress& progress, std::stop_token stop) {
    const LocalFrame frame = survey.frame();
    const FlowRejections flow = flowRejections(run.log, attitudes, options.flow);
    const ReadingContext context{run.log, options, frame, attitudes, reference, flow};
    NineStates model(context);
    RunFilter filter(context, run, model);
    const std::size_t n = run.log.size();
    std::vector<PackedEstimate> estimates;
    estimates.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (i % 512 == 0) {
            if (stop.stop_requested()) return cancelled();
            progress.report(0.7 * static_cast<double>(i) / static_cast<double>(n), "fusing " + run.id);
        }
        if (auto error = filter.step(i)) return tl::unexpected<Error>(std::move(*error));
        estimates.push_back(packed(model.state()));
        estimates.back().height_response = model.heightResponse();
    }
    if (options.smooth) {
        progress.report(0.7, "smoothing " + run.id);
        estimates = smoothed(std::move(estimates), run.log.time_s, options.process, model.inflations(), stop);
        if (stop.stop_requested()) return cancelled();
    }
    FusedRun fused;
    fused.trajectory.run_id = run.id;
    fused.trajectory.epochs.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (!unpacked(estimates[i]).finite()) {
            return badData(fmt::format("run {}: the smoother failed at {:.2f} s", run.id, run.log.time_s[i]),
                           run.log.file);
        }
        fused.trajectory.epochs.push_back(trajectoryEpoch(
            estimates[i], reference.height_reference_variance_m2, run.log.time_s[i], attitudes[i]));
    }
    fused.sensors = filter.sensors();
    fused.innovations = filter.innovations();
    filter.note(fused.notes.details);
    return fused;
}

Result<FusedRun> fusedBy(const Survey& survey, const Run& run, const FusionOptions& options, RunFusion& whole,
                         Progress& progress, std::stop_token stop) {
    switch (options.method) {
        case FusionMethod::Raw:
            return rawTrajectory(survey, run, options, whole.attitudes, whole.reference, progress, stop);
        case FusionMethod::Terrawalk: {
            auto filtered =
                filterWithDrifts(survey, run, options, whole.attitudes, whole.reference, progress, stop);
            if (!filtered) return tl::unexpected<Error>(filtered.error());
            whole.gnss_gated = std::move(filtered->gnss_gated);
            whole.gnss_jump_m = std::move(filtered->gnss_jump_m);
            return std::move(filtered->fused);
        }
        case FusionMethod::Aukf:
            return aukfTrajectory(survey, run, options, whole.attitudes, whole.reference, progress, stop);
        case FusionMethod::Ukf:
            break;
    }
    return filteredRun(survey, run, options, whole.attitudes, whole.reference, progress, stop);
}

}  // namespace

Result<RunFusion> fuseRunInFull(const Survey& survey, const Run& run, const FusionOptions& options,
                                Progress& progress, std::stop_token stop) {
    if (run.log.size() == 0)
        return badData(fmt::format("run {}: the log has no epochs", run.id), run.log.file);
    RunFusion whole;
    RunNotes notes;
    whole.attitudes = epochAttitudes(run.log, options.attitude, notes);
    auto reference = runReference(survey, run, options, whole.attitudes, notes);
    if (!reference) return tl::unexpected<Error>(reference.error());
    whole.reference = std::move(*reference);
    auto fused = fusedBy(survey, run, options, whole, progress, stop);
    if (!fused) return tl::unexpected<Error>(fused.error());
    whole.fused = std::move(*fused);
    notes.details.insert(notes.details.end(), whole.fused.notes.details.begin(),
                         whole.fused.notes.details.end());
    notes.limitations.insert(notes.limitations.end(), whole.fused.notes.limitations.begin(),
                             whole.fused.notes.limitations.end());
    whole.fused.notes = std::move(notes);
    progress.report(1.0, "fused " + run.id);
    return whole;
}

Result<FusedRun> fuseRun(const Survey& survey, const Run& run, const FusionOptions& options,
                         Progress& progress, std::stop_token stop) {
    auto whole = fuseRunInFull(survey, run, options, progress, stop);
    if (!whole) return tl::unexpected<Error>(whole.error());
    return std::move(whole->fused);
}

}  // namespace terrawalk
