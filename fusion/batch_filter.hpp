#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace terrawalk {

// The filter of paper 000 for many candidates at once, one candidate in each lane of a vector register.
//
// What 19 sigma points do for linear rows and motion, F P F' + Q and H P H' do exactly, so only the yaw row
// goes through the unscented transform. It ties e to n and never to u: the nine states fall apart into six
// for e and n (21 covariances) and three for u (6), with the very result of the full matrices. Every lane
// does the same IEEE operations in the same order on every instruction set, so results agree to the bit.
//
// Plain data and no Eigen: these types are shared by units that are compiled for different instruction sets.

/// One epoch as the kernels read it; rows and their order as in MeasurementRow.
struct BatchEpoch {
    double dt_s = 0.0;
    double noise_share = 0.0;     ///< of the step noise: dt over the nominal interval
    std::uint32_t present = 0;    ///< RowSet
    std::uint32_t at_target = 0;  ///< 1: the position enters the mean over the stand at the target
    double z[9] = {};             ///< of the yaw row: not read, see below
    double variance[9] = {};
    double cos_yaw = 1.0;
    double sin_yaw = 0.0;
};

struct BatchRun {
    double start_mean[9] = {};      ///< order as in StateBlock
    double start_variance[9] = {};  ///< diagonal
    const BatchEpoch* epochs = nullptr;
    std::size_t epoch_count = 0;
    double slowest_mps = 0.3;  ///< below this predicted speed the yaw row is left out
    bool jacobian = false;     ///< EKF: the yaw row by its derivative instead of the unscented transform
};

/// A candidate as the kernels read it.
struct BatchCandidate {
    double noise[9] = {};        ///< diagonal of Q for the nominal interval, order as in StateBlock
    double root_spread = 1.0;    ///< sqrt(n + lambda) = alpha sqrt(n + kappa)
    double weight = 0.5;         ///< 1 / (2 (n + lambda))
    double centre_weight = 0.0;  ///< beta - alpha^2
};

enum class InstructionSet {
    Scalar,    ///< one candidate at a time, the compiler's choice of instructions
    Baseline,  ///< two lanes: what every machine of the architecture has (SSE2 on x86-64)
    Avx2,      ///< four lanes
    Avx512,    ///< eight lanes
};
[[nodiscard]] std::string_view name(InstructionSet set);
/// Whether this machine and this build have it.
[[nodiscard]] bool available(InstructionSet set);
/// The widest that is available.
[[nodiscard]] InstructionSet widestInstructionSet();
[[nodiscard]] std::size_t laneCount(InstructionSet set);
inline constexpr std::size_t kMostLanes = 8;

/// Takes up to laneCount(set) candidates through one run.
/// @param candidates  `count` of them
/// @param target_sum  count x 3: sum of the positions (e, n, u) over the epochs at the target [m]; not finite
///                    where the filter diverged
/// @param track       epoch_count x count x 3 positions, or null
/// `set` must be available. Pure; safe from any thread.
void filterBatch(InstructionSet set, const BatchRun& run, const BatchCandidate* candidates, std::size_t count,
                 double* target_sum, double* track);

}  // namespace terrawalk
