#pragma once

#include <stop_token>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "fusion/positioning_model.hpp"
#include "survey/result.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// One run through one of the filters.
struct FilteredRun {
    std::vector<StateEstimate> states;  ///< after each epoch's measurements
    std::vector<RowSet> used;           ///< rows that each epoch's update took
    /// Innovations squared in units of their own covariance, per sensor; see SensorConsistency.
    std::vector<SensorConsistency> consistency;
};

/// The sigma points that a filter draws: the options' own, or those of the cubature rule, which is the
/// unscented transform with alpha = 1, beta = 0, kappa = 0: its centre point has no weight.
[[nodiscard]] UnscentedOptions sigmaPointOptions(const AukfOptions& options);

/// Takes measurements through the filter that the options name: forward only, no gate, no smoother. Each
/// epoch is one prediction (Q once) and one update with the rows that are present; S holds R. The yaw row is
/// left out while the predicted speed is below its threshold. Full matrices, all sigma points: the reference
/// for the kernels of fusion/batch_filter.hpp.
///
/// - Ekf: Jacobian of the yaw row.
/// - Ukf, Ckf: 19 sigma points (18 with weight), drawn anew for the measurement; source: paper 000, eqs 7-20,
///   mended as the estimate of the whole says (weights that sum to one, Cholesky columns, R in S, one
///   prediction).
/// - SquareRootUkf: the same with Cholesky factors instead of covariances (van der Merwe and Wan 2001).
/// - AdaptiveUkf: rows one after another, each with its own measurement noise, which follows the innovations:
///   rho = nu^2 - H P H' held between R_min and R_max; source: paper 004, eqs 26-29, with (28)'s minus sign
///   and (29)'s middle branch put right. The yaw row comes first, linearised by the unscented transform.
///
/// Errors: BadData when the state or its covariance is no longer finite; Cancelled. Pure; safe from any
/// thread.
[[nodiscard]] Result<FilteredRun> filterRun(const MeasuredRun& run, const AukfOptions& options,
                                            std::stop_token stop = {});

}  // namespace terrawalk
