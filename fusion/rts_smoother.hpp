#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <stop_token>
#include <vector>

#include "fusion/unscented_kalman_filter.hpp"

namespace terrawalk {

/// A state estimate as it is kept for each epoch: the lower triangle of the covariance, column by column.
struct PackedEstimate {
    Vector9d mean;
    std::array<double, 45> covariance;
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
/// Transitions are made anew from the times, so an epoch costs 63 numbers and no more. The covariance is
///     Ps = (I - G F) P (I - G F)' + G (Ps_next + Q) G',
/// a sum of positive parts. Returns early, with the rest unsmoothed, when `stop` is requested; the caller
/// checks. Pure; safe from any thread. Source: Rauch, Tung and Striebel 1965; for the form, Bierman 1983.
[[nodiscard]] std::vector<PackedEstimate> smoothed(std::vector<PackedEstimate> filtered,
                                                   std::span<const double> time_s,
                                                   const ProcessOptions& options,
                                                   std::span<const Inflation> inflations,
                                                   std::stop_token stop);

}  // namespace terrawalk
