#include "fusion/process_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace terrawalk {

namespace {

// How one axis moves in t seconds: velocity and position gained from one unit of acceleration, and what is
// left of it.
struct AxisMotion {
    double velocity_s;
    double position_s2;
    double remaining;
};

AxisMotion axisMotion(double tau_s, double t_s) {
    if (tau_s <= 0.0) return {t_s, 0.5 * t_s * t_s, 1.0};
    const double x = t_s / tau_s;
    const double velocity = -tau_s * std::expm1(-x);
    // t - velocity cancels for small x; the series does not.
    const double position = x < 1e-3 ? t_s * t_s * (0.5 - x / 6.0 + x * x / 24.0) : tau_s * (t_s - velocity);
    return {velocity, position, std::exp(-x)};
}

Matrix9d motionMatrix(double tau_s, double t_s) {
    const AxisMotion motion = axisMotion(tau_s, t_s);
    Matrix9d F = Matrix9d::Identity();
    for (int axis = 0; axis < 3; ++axis) {
        const int v = offset(StateBlock::Velocity) + axis;
        const int p = offset(StateBlock::Position) + axis;
        const int a = offset(StateBlock::Acceleration) + axis;
        F(p, v) = t_s;
        F(p, a) = motion.position_s2;
        F(v, a) = motion.velocity_s;
        F(a, a) = motion.remaining;
    }
    return F;
}

Vector9d densities(const ProcessNoiseOptions& noise) {
    Vector9d q;
    q << noise.velocity_e_m2ps3, noise.velocity_n_m2ps3, noise.velocity_u_m2ps3,  //
        noise.position_e_m2ps, noise.position_n_m2ps, noise.position_u_m2ps,      //
        noise.acceleration_e_m2ps5, noise.acceleration_n_m2ps5, noise.acceleration_u_m2ps5;
    return q;
}

Matrix9d stepNoise(const Vector9d& q, double tau_s, double dt_s) {
    // Nodes and weights of the four-point Gauss-Legendre rule on [0, 1].
    constexpr std::array<double, 4> kNodes{0.069431844202973712, 0.33000947820757187, 0.66999052179242813,
                                           0.93056815579702629};
    constexpr std::array<double, 4> kWeights{0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                             0.17392742256872693};
    Matrix9d Q = Matrix9d::Zero();
    for (std::size_t node = 0; node < kNodes.size(); ++node) {
        const AxisMotion motion = axisMotion(tau_s, kNodes[node] * dt_s);
        const double t = kNodes[node] * dt_s;
        const double weight = kWeights[node] * dt_s;
        for (int axis = 0; axis < 3; ++axis) {
            const int v = offset(StateBlock::Velocity) + axis;
            const int p = offset(StateBlock::Position) + axis;
            const int a = offset(StateBlock::Acceleration) + axis;
            const Eigen::Vector3d from_velocity(1.0, t, 0.0);
            const Eigen::Vector3d from_acceleration(motion.velocity_s, motion.position_s2, motion.remaining);
            const Eigen::Matrix3d added = weight * (q[v] * from_velocity * from_velocity.transpose() +
                                                    q[a] * from_acceleration * from_acceleration.transpose());
            const std::array<int, 3> index{v, p, a};
            for (int row = 0; row < 3; ++row) {
                for (int column = 0; column < 3; ++column) {
                    Q(index[static_cast<std::size_t>(row)], index[static_cast<std::size_t>(column)]) +=
                        added(row, column);
                }
            }
            Q(p, p) += weight * q[p];
        }
    }
    return Q;
}

}  // namespace

Transition transition(const ProcessOptions& options, double dt_s) {
    const double tau_s = options.acceleration_time_constant_s;
    // Within half a time constant the quadrature is exact to rounding.
    const double longest_s =
        tau_s > 0.0 ? std::min(options.longest_step_s, 0.5 * tau_s) : options.longest_step_s;
    const auto steps = static_cast<int>(std::clamp(std::ceil(dt_s / longest_s), 1.0, 1e5));
    const double step_s = dt_s / steps;
    const Matrix9d F_step = motionMatrix(tau_s, step_s);
    const Matrix9d Q_step = stepNoise(densities(options.noise), tau_s, step_s);
    Transition whole{F_step, Q_step};
    for (int step = 1; step < steps; ++step) {
        const Matrix9d Q = F_step * whole.Q * F_step.transpose() + Q_step;
        whole.Q = 0.5 * (Q + Q.transpose());
    }
    if (steps > 1) whole.F = motionMatrix(tau_s, dt_s);
    return whole;
}

}  // namespace terrawalk
