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
/// left out while the predicted speed is below its threshold. Full matrices and all sigma points: the
/// reference for the kernels of fusion/batch_filter.hpp.
///
/// - Ekf: Jacobian of the yaw row.
/// - Ukf: 19 sigma points, drawn anew for the measurement. Source: paper 000, eqs 7-20, with what its print
///   lacks: weights that sum to one, columns of a Cholesky factor, R in S, the inverse of S in the gain, one
///   prediction for each step instead of two. Sums as in unscentedTransform().
/// - Ckf: the same with the points of the cubature rule (Arasaratnam and Haykin 2009).
/// - SquareRootUkf: the Ukf with Cholesky factors instead of covariances (van der Merwe and Wan 2001).
/// - AdaptiveUkf: rows one after another, each with its own measurement noise, which follows the innovations:
///   rho = nu^2 - H P H' held between R_min and R_max. Source: paper 004, eqs 26-29, with the minus sign that
///   (28) lacks and rho itself between the bounds of (29). The yaw row comes first, linearised by the
///   unscented transform. Its NIS are of each row by itself, after the rows before it.
///
/// Errors: BadData when the state or its covariance is no longer finite; Cancelled. Pure; safe from any
/// thread.
[[nodiscard]] Result<FilteredRun> filterRun(const MeasuredRun& run, const AukfOptions& options,
                                            std::stop_token stop = {});

}  // namespace terrawalk
