#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "fusion/process_model.hpp"

namespace terrawalk {

/// The nine states and their covariance; order as in StateBlock, local ENU, SI.
struct StateEstimate {
    Vector9d mean = Vector9d::Zero();
    Matrix9d covariance = Matrix9d::Identity();

    [[nodiscard]] Eigen::Vector3d block(StateBlock b) const { return mean.segment<3>(offset(b)); }
    [[nodiscard]] Eigen::Matrix3d blockCovariance(StateBlock b) const {
        return covariance.block<3, 3>(offset(b), offset(b));
    }
    [[nodiscard]] bool finite() const { return mean.allFinite() && covariance.allFinite(); }
};

/// One scalar measurement: value = direction . block + noise. `direction` need not be of unit length.
struct LinearRow {
    StateBlock block = StateBlock::Position;
    Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
    double value = 0.0;
    double variance = 1.0;
};

/// The yaw row of paper 000, eq 4: yaw = atan2(v_n, v_e) + noise.
struct YawRow {
    double yaw_rad = 0.0;
    double variance = 1.0;
};

/// value - direction . mean
[[nodiscard]] double innovation(const StateEstimate& state, const LinearRow& row);
/// Variance of direction . block as the state has it, without measurement noise.
[[nodiscard]] double predictedVariance(const StateEstimate& state, const LinearRow& row);

/// Kalman gain of one scalar row.
[[nodiscard]] Vector9d gain(const StateEstimate& state, const LinearRow& row);

/// F x, F P F' + Q. What 19 sigma points of the posterior give for a linear f, without their rounding.
/// Source: paper 000, eqs 5-6, and not once more by 10-12.
[[nodiscard]] StateEstimate predicted(const StateEstimate& state, const Transition& transition);

/// The state after one scalar row; S holds the row's variance (paper 000, eq 16, lacks it). Joseph's form,
/// made symmetric: positive definite for any gain that rounding leaves. Rows with independent noise may
/// follow one another in any order. Source: Bierman 1977.
[[nodiscard]] StateEstimate updated(const StateEstimate& state, const LinearRow& row);

/// The yaw row as the linear row that the unscented transform of `state` makes of it: gradient g = L^-T d,
/// noise R + Omega. Followed by updated() it gives the same as the transform over all sigma points. With
/// velocity first only two of the nine columns move the yaw, so four function values are needed. The
/// innovation is wrapped. Linearise at the prediction, before other rows of the epoch. The velocity must not
/// be zero.
[[nodiscard]] LinearRow linearised(const StateEstimate& state, const YawRow& row,
                                   const UnscentedOptions& options);

/// The full form, 19 sigma points and all rows of an epoch at once, as the reference for the functions above.
[[nodiscard]] StateEstimate referencePredicted(const StateEstimate& state, const Transition& transition,
                                               const UnscentedOptions& options);
[[nodiscard]] StateEstimate referenceUpdated(const StateEstimate& state, std::span<const LinearRow> rows,
                                             const std::optional<YawRow>& yaw,
                                             const UnscentedOptions& options);

}  // namespace terrawalk
