#include "fusion/batch_filter_input.hpp"

#include <algorithm>
#include <cmath>

#include "fusion/filter_family.hpp"
#include "fusion/unscented_transform.hpp"

namespace terrawalk {

std::vector<BatchEpoch> batchEpochs(const MeasuredRun& run, const AukfOptions& options) {
    std::vector<BatchEpoch> epochs;
    epochs.reserve(run.epochs.size());
    for (const MeasurementEpoch& measured : run.epochs) {
        BatchEpoch epoch;
        epoch.dt_s = measured.dt_s;
        epoch.noise_share = measured.dt_s / options.nominal_interval_s;
        epoch.present = measured.present;
        std::copy(measured.z.begin(), measured.z.end(), epoch.z);
        std::copy(measured.variance.begin(), measured.variance.end(), epoch.variance);
        const double yaw_rad = measured.z[static_cast<std::size_t>(MeasurementRow::Yaw)];
        epoch.cos_yaw = std::cos(yaw_rad);
        epoch.sin_yaw = std::sin(yaw_rad);
        epochs.push_back(epoch);
    }
    return epochs;
}

BatchRun batchRun(const MeasuredRun& run, std::span<const BatchEpoch> epochs, const AukfOptions& options) {
    BatchRun batch;
    for (int i = 0; i < 9; ++i) {
        batch.start_mean[i] = run.start.mean[i];
        batch.start_variance[i] = run.start.covariance(i, i);
    }
    batch.epochs = epochs.data();
    batch.epoch_count = epochs.size();
    batch.slowest_mps = options.yaw_row.slowest_mps;
    batch.jacobian = options.filter == FilterKind::Ekf;
    return batch;
}

BatchCandidate batchCandidate(const AukfOptions& options) {
    BatchCandidate candidate;
    const Vector9d q = stepNoiseDiagonal(options, options.nominal_interval_s);
    std::copy(q.begin(), q.end(), candidate.noise);
    const UnscentedOptions unscented = sigmaPointOptions(options);
    const double spread = sigmaPointSpread(unscented, 9);
    candidate.root_spread = std::sqrt(spread);
    candidate.weight = 0.5 / spread;
    candidate.centre_weight = unscented.beta - unscented.alpha * unscented.alpha;
    return candidate;
}

}  // namespace terrawalk
