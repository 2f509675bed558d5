#include "fusion/rts_smoother.hpp"

namespace terrawalk {

PackedEstimate packed(const StateEstimate& state) {
    return {state.mean, packedTriangle<9>(state.covariance)};
}

StateEstimate unpacked(const PackedEstimate& packed_state) {
    return {packed_state.mean, unpackedTriangle<9>(packed_state.covariance)};
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
        const Matrix9d G =
            stepBack<9>(here.mean, here.covariance, step.F, step.Q, next.mean, next.covariance);
        const Vector9d& response = filtered[k].height_response;
        next_response = (response + G * (next_response - step.F * response)).eval();
        filtered[k] = packed(next);
        filtered[k].height_response = next_response;
    }
    return filtered;
}

}  // namespace terrawalk
