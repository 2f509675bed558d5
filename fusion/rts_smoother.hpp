#pragma once

#include <Eigen/Cholesky>
#include <array>
#include <cstddef>
#include <span>
#include <stop_token>
#include <vector>

#include "fusion/unscented_kalman_filter.hpp"

namespace terrawalk {

/// Lower triangle of a symmetric matrix, column by column.
template <int N>
using PackedTriangle = std::array<double, N*(N + 1) / 2>;

template <int N>
[[nodiscard]] PackedTriangle<N> packedTriangle(const Eigen::Matrix<double, N, N>& symmetric) {
    PackedTriangle<N> out;
    std::size_t k = 0;
    for (int column = 0; column < N; ++column) {
        for (int row = column; row < N; ++row) out[k++] = symmetric(row, column);
    }
    return out;
}

template <int N>
[[nodiscard]] Eigen::Matrix<double, N, N> unpackedTriangle(const PackedTriangle<N>& packed) {
    Eigen::Matrix<double, N, N> out;
    std::size_t k = 0;
    for (int column = 0; column < N; ++column) {
        for (int row = column; row < N; ++row) out(row, column) = out(column, row) = packed[k++];
    }
    return out;
}

/// One step of the Rauch-Tung-Striebel pass: takes the smoothed mean x and covariance P of the next epoch to
/// those of this one, whose filtered estimate is (mean, covariance). Gives the gain G. F may be singular; the
/// predicted covariance F P F' + Q must not be.
///     Ps = (I - G F) P (I - G F)' + G (Ps_next + Q) G',
/// a sum of positive parts. Source: Rauch, Tung and Striebel 1965; for the form, Bierman 1983.
template <int N>
Eigen::Matrix<double, N, N> stepBack(const Eigen::Matrix<double, N, 1>& mean,
                                     const Eigen::Matrix<double, N, N>& covariance,
                                     const Eigen::Matrix<double, N, N>& F,
                                     const Eigen::Matrix<double, N, N>& Q, Eigen::Matrix<double, N, 1>& x,
                                     Eigen::Matrix<double, N, N>& P) {
    using Matrix = Eigen::Matrix<double, N, N>;
    const Matrix FP = F * covariance;
    const Matrix sum = FP * F.transpose() + Q;
    const Matrix predicted = 0.5 * (sum + sum.transpose());
    const Matrix G = predicted.ldlt().solve(FP).transpose();
    const Matrix I_GF = Matrix::Identity() - G * F;
    const Matrix smooth = I_GF * covariance * I_GF.transpose() + G * (P + Q) * G.transpose();
    x = mean + G * (x - F * mean);
    P = 0.5 * (smooth + smooth.transpose());
    return G;
}

/// A state estimate as it is kept for each epoch: the lower triangle of the covariance, column by column.
struct PackedEstimate {
    Vector9d mean;
    PackedTriangle<9> covariance;
    /// By how much the mean moves for each metre by which the height reference (zero of the barometer, or an
    /// assumed height) moves. That error lasts, so it belongs to no state and to no white noise; the
    /// smoother treats it as it treats the mean. Source: Schmidt 1966, the consider filter.
    Vector9d height_response = Vector9d::Zero();
};

[[nodiscard]] PackedEstimate packed(const StateEstimate& state);
[[nodiscard]] StateEstimate unpacked(const PackedEstimate& packed_state);

/// Variance that the filter added to one block just before the updates of an epoch, when it let a sensor in
/// again.
struct Inflation {
    std::size_t epoch = 0;
    StateBlock block = StateBlock::Position;
    Eigen::Vector3d variance = Eigen::Vector3d::Zero();
};

/// Transition from the epoch before `epoch` into it, inflations included.
[[nodiscard]] Transition transitionInto(std::size_t epoch, std::span<const double> time_s,
                                        const ProcessOptions& options, std::span<const Inflation> inflations);

/// Rauch-Tung-Striebel pass over the filtered epochs, last to first; the vector is reused for the answer.
/// Transitions are made anew from the times, so an epoch costs 63 numbers and no more. Returns early, with
/// the rest unsmoothed, when `stop` is requested; the caller checks. Pure; safe from any thread.
[[nodiscard]] std::vector<PackedEstimate> smoothed(std::vector<PackedEstimate> filtered,
                                                   std::span<const double> time_s,
                                                   const ProcessOptions& options,
                                                   std::span<const Inflation> inflations,
                                                   std::stop_token stop);

}  // namespace terrawalk
