#pragma once

// Source of the kernels of batch_filter.hpp, included by the units that compile it for one instruction set
// each. Everything is a template over the vector type V, so that no two units define the same function;
// nothing from the standard library is called, for the same reason.

#include <cstddef>

#include "fusion/batch_filter.hpp"

namespace terrawalk::lanes {

template <class V>
struct Lanes {
    static constexpr int kCount = static_cast<int>(sizeof(V) / sizeof(double));
    static double get(const V& v, int i) { return v[i]; }
    static void set(V& v, int i, double x) { v[i] = x; }
};
template <>
struct Lanes<double> {
    static constexpr int kCount = 1;
    static double get(const double& v, int) { return v; }
    static void set(double& v, int, double x) { v = x; }
};

template <class V>
inline V broadcast(double x) {
    V v{};
    for (int i = 0; i < Lanes<V>::kCount; ++i) Lanes<V>::set(v, i, x);
    return v;
}

template <class V>
inline V squareRoot(V x) {
    V root{};
    for (int i = 0; i < Lanes<V>::kCount; ++i) Lanes<V>::set(root, i, __builtin_sqrt(Lanes<V>::get(x, i)));
    return root;
}

/// atan2 of each lane, within 2 ulp, without branches. Odd in y. Zero for two zeros.
/// Source: polynomial of fdlibm's s_atan.c (Sun Microsystems 1993) for |t| <= 7/16, reduced by pi/4.
template <class V>
inline V arcTangent(V y, V x) {
    constexpr double kTanPi8 = 0.41421356237309503;
    constexpr double kPi4Low = 3.06161699786838301793e-17;
    constexpr double kPi4 = 7.85398163397448278999e-01;
    constexpr double kTiny = 1e-300;
    const V zero{};
    const V ax = x < zero ? -x : x;
    const V ay = y < zero ? -y : y;
    const auto steep = ay > ax;
    const V low = steep ? ax : ay;
    const V high = steep ? ay : ax;
    const auto upper = low > kTanPi8 * high;
    const V numerator = upper ? low - high : low;
    const V sum = upper ? low + high : high;
    const V tiny = broadcast<V>(kTiny);
    const V t = numerator / (tiny > sum ? tiny : sum);
    const V z = t * t;
    const V w = z * z;
    const V odd = z * (3.33333333333329318027e-01 +
                       w * (1.42857142725034663711e-01 +
                            w * (9.09088713343650656196e-02 +
                                 w * (6.66107313738753120669e-02 +
                                      w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
    const V even = w * (-1.99999999998764832476e-01 +
                        w * (-1.11111104054623557880e-01 +
                             w * (-7.69187620504482999495e-02 +
                                  w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
    const V base = upper ? broadcast<V>(kPi4) : zero;
    const V base_low = upper ? broadcast<V>(kPi4Low) : zero;
    V angle = base - ((t * (odd + even) - base_low) - t);
    angle = steep ? 2.0 * kPi4 - (angle - 2.0 * kPi4Low) : angle;
    angle = x < zero ? 4.0 * kPi4 - (angle - 4.0 * kPi4Low) : angle;
    return y < zero ? -angle : angle;
}

/// Wraps to [-pi, pi].
template <class V>
inline V wrapped(V angle) {
    constexpr double kTwoPi = 6.28318530717958647692;
    constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to a whole number
    const V turns = (angle * (1.0 / kTwoPi) + kRound) - kRound;
    return angle - kTwoPi * turns;
}

/// Mean and lower triangle of the covariance of N states.
template <class V, int N>
struct Gaussian {
    V x[N];
    V P[N * (N + 1) / 2];

    V& at(int i, int j) { return i >= j ? P[i * (i + 1) / 2 + j] : P[j * (j + 1) / 2 + i]; }
};

/// x + K nu, P - K (P H')' with K = P H' / S.
template <class V, int N>
inline void apply(Gaussian<V, N>& state, const V* PH, V inverse_variance, V innovation) {
    V K[N];
#pragma GCC unroll 6
    for (int i = 0; i < N; ++i) K[i] = PH[i] * inverse_variance;
#pragma GCC unroll 6
    for (int i = 0; i < N; ++i) {
        state.x[i] += K[i] * innovation;
#pragma GCC unroll 6
        for (int j = 0; j <= i; ++j) state.at(i, j) -= K[i] * PH[j];
    }
}

/// One row that measures state k by itself.
template <int K, class V, int N>
inline void update(Gaussian<V, N>& state, double z, double variance) {
    V PH[N];
#pragma GCC unroll 6
    for (int i = 0; i < N; ++i) PH[i] = state.at(i, K);
    apply(state, PH, 1.0 / (PH[K] + variance), z - state.x[K]);
}

/// Rows of F of one axis applied to rows v, p, a of B (three numbers of a column): B := F B.
template <class V>
inline void advance(double dt, double half_dt2, V& v, V& p, const V& a) {
    p += dt * v + half_dt2 * a;
    v += dt * a;
}

/// Constant acceleration: F x and F P F' + Q for the axis whose states are v, p, a.
template <class V, int N>
inline void advanceAxis(Gaussian<V, N>& s, int v, int p, int a, double dt, double half_dt2) {
    advance(dt, half_dt2, s.x[v], s.x[p], s.x[a]);
    const V Tpv = s.at(p, v) + (dt * s.at(v, v) + half_dt2 * s.at(a, v));
    const V Tpp = s.at(p, p) + (dt * s.at(v, p) + half_dt2 * s.at(a, p));
    const V Tpa = s.at(p, a) + (dt * s.at(v, a) + half_dt2 * s.at(a, a));
    const V Tvv = s.at(v, v) + dt * s.at(a, v);
    const V Tva = s.at(v, a) + dt * s.at(a, a);
    s.at(p, p) = Tpp + (dt * Tpv + half_dt2 * Tpa);
    s.at(p, v) = Tpv + dt * Tpa;
    s.at(p, a) = Tpa;
    s.at(v, v) = Tvv + dt * Tva;
    s.at(v, a) = Tva;
}

/// States of e (even) and n (odd); v stands first (see StateBlock).
enum Plan : int { kVe, kVn, kPe, kPn, kAe, kAn };
/// States of u.
enum Height : int { kVu, kPu, kAu };

template <class V>
inline void predict(Gaussian<V, 6>& plan, Gaussian<V, 3>& height, const V* noise, const BatchEpoch& epoch) {
    const double dt = epoch.dt_s;
    const double half_dt2 = 0.5 * dt * dt;
    advanceAxis(plan, kVe, kPe, kAe, dt, half_dt2);
    advanceAxis(plan, kVn, kPn, kAn, dt, half_dt2);
    // Between the axes: columns by the motion of e, rows by that of n. No list of indices to loop over: its
    // begin() would be a function that units share.
    for (int n = kVn; n <= kAn; n += 2)
        advance(dt, half_dt2, plan.at(kVe, n), plan.at(kPe, n), plan.at(kAe, n));
    for (int e = kVe; e <= kAe; e += 2)
        advance(dt, half_dt2, plan.at(e, kVn), plan.at(e, kPn), plan.at(e, kAn));
    advanceAxis(height, kVu, kPu, kAu, dt, half_dt2);
    for (int block = 0; block < 3; ++block) {
        plan.at(2 * block, 2 * block) += epoch.noise_share * noise[3 * block];
        plan.at(2 * block + 1, 2 * block + 1) += epoch.noise_share * noise[3 * block + 1];
        height.at(block, block) += epoch.noise_share * noise[3 * block + 2];
    }
}

template <class V>
struct Spread {
    V root, weight, centre_weight;
};

/// The yaw row, paper 000, eq 4, as the linear row that the unscented transform (or the derivative) makes of
/// it.
template <class V, bool kJacobian>
inline void updateYaw(Gaussian<V, 6>& s, const Spread<V>& spread, const BatchEpoch& epoch, double slowest2) {
    constexpr int kYaw = 5;
    const V zero{};
    const V ve = s.x[kVe];
    const V vn = s.x[kVn];
    const V speed2 = ve * ve + vn * vn;
    V ge, gn, noise, mean_shift;
    if constexpr (kJacobian) {
        ge = -vn / speed2;
        gn = ve / speed2;
        noise = broadcast<V>(epoch.variance[kYaw]);
        mean_shift = zero;
    } else {
        // L of the velocities alone: the other Cholesky columns do not move them.
        const V l11 = squareRoot(s.at(kVe, kVe));
        const V l21 = s.at(kVn, kVe) / l11;
        const V l22 = squareRoot(s.at(kVn, kVn) - l21 * l21);
        const V se = spread.root * l11;
        const V sn = spread.root * l21;
        const V tn = spread.root * l22;
        // Angle between v and v + s: atan2(v x s, v . (v + s)); between v and v - s its mirror image.
        const V cross1 = ve * sn - vn * se;
        const V dot1 = ve * se + vn * sn;
        const V cross2 = ve * tn;
        const V dot2 = vn * tn;
        const V above1 = arcTangent<V>(cross1, speed2 + dot1);
        const V below1 = arcTangent<V>(cross1, speed2 - dot1);
        const V above2 = arcTangent<V>(cross2, speed2 + dot2);
        const V below2 = arcTangent<V>(cross2, speed2 - dot2);
        const V bend1 = above1 - below1;
        const V bend2 = above2 - below2;
        mean_shift = spread.weight * (bend1 + bend2);
        const V omega = 0.5 * spread.weight * (bend1 * bend1 + bend2 * bend2) +
                        spread.centre_weight * mean_shift * mean_shift;
        noise = epoch.variance[kYaw] + omega;
        // g = L^-T d, d the cross-covariance in the columns of L
        gn = 0.5 * (above2 + below2) / tn;
        ge = (0.5 * (above1 + below1) - sn * gn) / se;
    }
    // Angle from the course to the measured yaw.
    const V residual =
        arcTangent<V>(epoch.sin_yaw * ve - epoch.cos_yaw * vn, epoch.cos_yaw * ve + epoch.sin_yaw * vn);
    const V innovation = wrapped<V>(residual - mean_shift);
    V PH[6];
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) PH[i] = ge * s.at(i, kVe) + gn * s.at(i, kVn);
    const V inverse = 1.0 / (ge * PH[kVe] + gn * PH[kVn] + noise);
    // At rest the course has no meaning: such a lane keeps its state.
    const auto moving = speed2 >= broadcast<V>(slowest2);
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) PH[i] = moving ? PH[i] : zero;
    apply<V, 6>(s, PH, moving ? inverse : zero, moving ? innovation : zero);
}

template <class V>
inline void updateLinear(Gaussian<V, 6>& plan, Gaussian<V, 3>& height, const BatchEpoch& epoch) {
    const auto has = [&](unsigned row) {
        return (epoch.present >> row & 1U) != 0;
    };
    const double* z = epoch.z;
    const double* r = epoch.variance;
    if (has(0)) update<kPe>(plan, z[0], r[0]);
    if (has(1)) update<kPn>(plan, z[1], r[1]);
    if (has(2)) update<kPu>(height, z[2], r[2]);
    if (has(3)) update<kVe>(plan, z[3], r[3]);
    if (has(4)) update<kVn>(plan, z[4], r[4]);
    if (has(6)) update<kAe>(plan, z[6], r[6]);
    if (has(7)) update<kAn>(plan, z[7], r[7]);
    if (has(8)) update<kAu>(height, z[8], r[8]);
}

template <class V>
inline void put(double* out, std::size_t count, V e, V n, V u) {
    for (std::size_t lane = 0; lane < count; ++lane) {
        const int i = static_cast<int>(lane);
        out[3 * lane + 0] = Lanes<V>::get(e, i);
        out[3 * lane + 1] = Lanes<V>::get(n, i);
        out[3 * lane + 2] = Lanes<V>::get(u, i);
    }
}

template <class V, bool kJacobian>
void filterRun(const BatchRun& run, const BatchCandidate* candidates, std::size_t count, double* target_sum,
               double* track) {
    V noise[9];
    Spread<V> spread;
    for (int lane = 0; lane < Lanes<V>::kCount; ++lane) {
        // Lanes without a candidate repeat the last one.
        const std::size_t last = count - 1;
        const std::size_t own = static_cast<std::size_t>(lane);
        const BatchCandidate& candidate = candidates[own < last ? own : last];
        for (int i = 0; i < 9; ++i) Lanes<V>::set(noise[i], lane, candidate.noise[i]);
        Lanes<V>::set(spread.root, lane, candidate.root_spread);
        Lanes<V>::set(spread.weight, lane, candidate.weight);
        Lanes<V>::set(spread.centre_weight, lane, candidate.centre_weight);
    }
    Gaussian<V, 6> plan{};
    Gaussian<V, 3> height{};
    for (int block = 0; block < 3; ++block) {
        for (int axis = 0; axis < 2; ++axis) {
            const int i = 2 * block + axis;
            plan.x[i] = broadcast<V>(run.start_mean[3 * block + axis]);
            plan.at(i, i) = broadcast<V>(run.start_variance[3 * block + axis]);
        }
        height.x[block] = broadcast<V>(run.start_mean[3 * block + 2]);
        height.at(block, block) = broadcast<V>(run.start_variance[3 * block + 2]);
    }
    const double slowest2 = run.slowest_mps * run.slowest_mps;
    V sum_e{}, sum_n{}, sum_u{};
    for (std::size_t k = 0; k < run.epoch_count; ++k) {
        const BatchEpoch& epoch = run.epochs[k];
        predict(plan, height, noise, epoch);
        // Linearised at the prediction, so before the other rows.
        if ((epoch.present >> 5 & 1U) != 0) updateYaw<V, kJacobian>(plan, spread, epoch, slowest2);
        updateLinear(plan, height, epoch);
        if (epoch.at_target != 0) {
            sum_e += plan.x[kPe];
            sum_n += plan.x[kPn];
            sum_u += height.x[kPu];
        }
        if (track != nullptr) put(track + 3 * count * k, count, plan.x[kPe], plan.x[kPn], height.x[kPu]);
    }
    put(target_sum, count, sum_e, sum_n, sum_u);
}

template <class V>
void filterRun(const BatchRun& run, const BatchCandidate* candidates, std::size_t count, double* target_sum,
               double* track) {
    if (run.jacobian) {
        filterRun<V, true>(run, candidates, count, target_sum, track);
    } else {
        filterRun<V, false>(run, candidates, count, target_sum, track);
    }
}

}  // namespace terrawalk::lanes
