#include "fusion/unscented_kalman_filter.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "fusion/unscented_transform.hpp"
#include "survey/frames.hpp"

namespace terrawalk {

namespace {

Matrix9d symmetric(const Matrix9d& P) {
    return 0.5 * (P + P.transpose());
}

double course(const Eigen::Vector2d& velocity) {
    return std::atan2(velocity.y(), velocity.x());
}

}  // namespace

double innovation(const StateEstimate& state, const LinearRow& row) {
    return row.value - row.direction.dot(state.block(row.block));
}

double predictedVariance(const StateEstimate& state, const LinearRow& row) {
    return row.direction.dot(state.blockCovariance(row.block) * row.direction);
}

Vector9d gain(const StateEstimate& state, const LinearRow& row) {
    const Vector9d PH = state.covariance.middleCols<3>(offset(row.block)) * row.direction;
    return PH / (predictedVariance(state, row) + row.variance);
}

StateEstimate predicted(const StateEstimate& state, const Transition& transition) {
    const Matrix9d FP = transition.F * state.covariance;
    const Matrix9d P = FP * transition.F.transpose() + transition.Q;
    return {transition.F * state.mean, symmetric(P)};
}

StateEstimate updated(const StateEstimate& state, const LinearRow& row) {
    const int at = offset(row.block);
    const Vector9d PH = state.covariance.middleCols<3>(at) * row.direction;
    const Vector9d K = gain(state, row);

    // (I - K H) P (I - K H)' + K R K'
    const Matrix9d A = state.covariance - K * PH.transpose();
    const Vector9d AH = A.middleCols<3>(at) * row.direction;
    const Matrix9d P = A - AH * K.transpose() + row.variance * K * K.transpose();
    return {state.mean + K * innovation(state, row), symmetric(P)};
}

LinearRow linearised(const StateEstimate& state, const YawRow& row, const UnscentedOptions& options) {
    static_assert(offset(StateBlock::Velocity) == 0,
                  "the leading Cholesky columns must be those of the velocity");
    const Eigen::Vector2d velocity = state.mean.head<2>();
    const double centre_rad = course(velocity);
    const auto transformed = statisticallyLinearised<2>(
        state.covariance.topLeftCorner<2, 2>(), sigmaPointSpread(options, 9), options,
        [&](const Eigen::Vector2d& step) { return wrapAngle(course(velocity + step) - centre_rad); });

    LinearRow linear;
    linear.block = StateBlock::Velocity;
    linear.direction << transformed.gradient, 0.0;
    linear.value =
        transformed.gradient.dot(velocity) + wrapAngle(row.yaw_rad - centre_rad - transformed.shift);
    linear.variance = row.variance + transformed.omega;
    return linear;
}

StateEstimate referencePredicted(const StateEstimate& state, const Transition& transition,
                                 const UnscentedOptions& options) {
    const TransformedMoments moments = unscentedTransform(
        state.mean, state.covariance,
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return transition.F * x; }, options);
    const Matrix9d P = moments.covariance + transition.Q;
    return {moments.mean, symmetric(P)};
}

StateEstimate referenceUpdated(const StateEstimate& state, std::span<const LinearRow> rows,
                               const std::optional<YawRow>& yaw, const UnscentedOptions& options) {
    const auto linear_rows = static_cast<Eigen::Index>(rows.size());
    const Eigen::Index m = linear_rows + (yaw ? 1 : 0);
    if (m == 0) return state;
    Eigen::VectorXd z(m);
    Eigen::VectorXd R(m);
    for (Eigen::Index i = 0; i < linear_rows; ++i) {
        z[i] = rows[static_cast<std::size_t>(i)].value;
        R[i] = rows[static_cast<std::size_t>(i)].variance;
    }
    if (yaw) {
        z[m - 1] = yaw->yaw_rad;
        R[m - 1] = yaw->variance;
    }
    const auto h = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        Eigen::VectorXd y(m);
        for (Eigen::Index i = 0; i < linear_rows; ++i) {
            const LinearRow& row = rows[static_cast<std::size_t>(i)];
            y[i] = row.direction.dot(x.segment<3>(offset(row.block)));
        }
        if (yaw) y[m - 1] = course(x.head<2>());
        return y;
    };
    const auto difference = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) -> Eigen::VectorXd {
        Eigen::VectorXd d = a - b;
        if (yaw) d[m - 1] = wrapAngle(d[m - 1]);
        return d;
    };
    const TransformedMoments moments =
        unscentedTransform(state.mean, state.covariance, h, difference, options);
    Eigen::MatrixXd S = moments.covariance;
    S.diagonal() += R;
    const Eigen::MatrixXd gain = S.ldlt().solve(moments.cross_covariance.transpose()).transpose();
    const Matrix9d P = state.covariance - gain * S * gain.transpose();
    return {state.mean + gain * difference(z, moments.mean), symmetric(P)};
}

}  // namespace terrawalk
