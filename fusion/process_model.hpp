#pragma once

#include <Eigen/Core>

#include "fusion/fusion_options.hpp"

namespace terrawalk {

using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

/// First index of the three components e, n, u in the state.
/// Paper 000, eq 2, lists position first. Velocity stands first here because the unscented transform depends
/// on the order of the Cholesky factor: with velocity in front, the yaw row sees the spread of the velocity
/// alone and is not bent by the (much larger) uncertainty of the position.
enum class StateBlock : int { Velocity = 0, Position = 3, Acceleration = 6 };

[[nodiscard]] constexpr int offset(StateBlock block) {
    return static_cast<int>(block);
}

/// x(t + dt) = F x(t) + w, w ~ (0, Q).
struct Transition {
    Matrix9d F;
    Matrix9d Q;
};

/// Transition over any step dt_s > 0 of dp = v dt + w_p, dv = a dt + w_v, da = -a / tau dt + w_a: constant
/// acceleration as in paper 000, eq 5, when tau is infinite, Singer's manoeuvre model otherwise. Q is the
/// integral of the spectral densities through the model (four-point Gauss-Legendre in each step, exact for
/// infinite tau), not a constant for each epoch, so late, missing and irregular epochs need no special case.
/// Pure; safe from any thread. Source: Singer 1970; Van Loan 1978.
[[nodiscard]] Transition transition(const ProcessOptions& options, double dt_s);

}  // namespace terrawalk
