#pragma once

#include <span>
#include <vector>

#include "fusion/batch_filter.hpp"
#include "fusion/fusion_options.hpp"
#include "fusion/positioning_model.hpp"

namespace terrawalk {

// From the model to the plain data of the batch kernels. Pure; safe from any thread.

/// `at_target` is left at 0.
[[nodiscard]] std::vector<BatchEpoch> batchEpochs(const MeasuredRun& run, const AukfOptions& options);

/// Refers to `epochs`, which must outlive it. Kernels exist for Ukf, Ckf and Ekf.
[[nodiscard]] BatchRun batchRun(const MeasuredRun& run, std::span<const BatchEpoch> epochs,
                                const AukfOptions& options);
[[nodiscard]] BatchCandidate batchCandidate(const AukfOptions& options);

}  // namespace terrawalk
