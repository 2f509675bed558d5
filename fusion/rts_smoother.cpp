#include "fusion/rts_smoother.hpp"

#include <Eigen/Cholesky>

namespace terrawalk {

PackedEstimate packed(const StateEstimate& state) {
    PackedEstimate out;
    out.mean = state.mean;
    std::size_t k = 0;
    for (int column = 0; column < 9; ++column) {
        for (int row = column; row < 9; ++row) out.covariance[k++] = state.covariance(row, column);
    }
    return out;
}

StateEstimate unpacked(const PackedEstimate& packed_state) {
    StateEstimate out;
    out.mean = packed_state.mean;
    std::size_t k = 0;
    for (int column = 0; column < 9; ++column) {
        for (int row = column; row < 9; ++row) {
            out.covariance(row, column) = out.covariance(column, row) = packed_state.covariance[k++];
        }
    }
    return out;
}

Transition transitionInto(std::size_t epoch, std::span<const double> time_s, const ProcessOptions& options,
                          std::span<const Inflation> inflations) {
    Transition step = transition(options, time_s[epoch] - time_s[epoch - 1]);
    for (const Inflation& inflation : inflations) {
        if (inflation.epoch != epoch) continue;
        const int at = offset(inflation.block);
        step.Q.block<3, 3>(at, at).diagonal() += inflation.variance;
    }
    return step;
}

std::vector<PackedEstimate> smoothed(std::vector<PackedEstimate> filtered, std::span<const double> time_s,
                                     const ProcessOptions& options, std::span<const Inflation> inflations,
                                     std::stop_token stop) {
    if (filtered.empty()) return filtered;
    StateEstimate next = unpacked(filtered.back());
    Vector9d next_response = filtered.back().height_response;
    for (std::size_t k = filtered.size() - 1; k-- > 0;) {
        if (k % 256 == 0 && stop.stop_requested()) break;
        const StateEstimate here = unpacked(filtered[k]);
        const Transition step = transitionInto(k + 1, time_s, options, inflations);
        const StateEstimate prediction = predicted(here, step);
        const Matrix9d FP = step.F * here.covariance;
        const Matrix9d G = prediction.covariance.ldlt().solve(FP).transpose();
        const Matrix9d I_GF = Matrix9d::Identity() - G * step.F;
        const Matrix9d P =
            I_GF * here.covariance * I_GF.transpose() + G * (next.covariance + step.Q) * G.transpose();
        next.mean = here.mean + G * (next.mean - prediction.mean);
        next.covariance = 0.5 * (P + P.transpose());
        const Vector9d& response = filtered[k].height_response;
        next_response = (response + G * (next_response - step.F * response)).eval();
        filtered[k] = packed(next);
        filtered[k].height_response = next_response;
    }
    return filtered;
}

}  // namespace terrawalk
