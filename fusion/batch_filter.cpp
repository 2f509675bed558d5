#include "fusion/batch_filter.hpp"

#include <array>

#include "fusion/batch_filter_kernels.hpp"

namespace terrawalk {

std::string_view name(InstructionSet set) {
    static constexpr std::array<std::string_view, 4> kNames{"scalar", "baseline", "AVX2", "AVX-512"};
    return kNames[static_cast<std::size_t>(set)];
}

bool available(InstructionSet set) {
    switch (set) {
        case InstructionSet::Scalar:
        case InstructionSet::Baseline:
            return true;
#ifdef __x86_64__
        case InstructionSet::Avx2:
            return __builtin_cpu_supports("avx2") != 0;
        case InstructionSet::Avx512:
            return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
                   __builtin_cpu_supports("avx512vl") != 0;
#else
        case InstructionSet::Avx2:
        case InstructionSet::Avx512:
            return false;
#endif
    }
    return false;
}

InstructionSet widestInstructionSet() {
    static const InstructionSet kWidest = available(InstructionSet::Avx512) ? InstructionSet::Avx512
                                          : available(InstructionSet::Avx2) ? InstructionSet::Avx2
                                                                            : InstructionSet::Baseline;
    return kWidest;
}

std::size_t laneCount(InstructionSet set) {
    static constexpr std::array<std::size_t, 4> kLanes{1, 2, 4, 8};
    return kLanes[static_cast<std::size_t>(set)];
}

void filterBatch(InstructionSet set, const BatchRun& run, const BatchCandidate* candidates, std::size_t count,
                 double* target_sum, double* track) {
    switch (set) {
        case InstructionSet::Scalar:
            return filterScalar(run, candidates, count, target_sum, track);
#ifdef __x86_64__
        case InstructionSet::Avx2:
            return filterAvx2(run, candidates, count, target_sum, track);
        case InstructionSet::Avx512:
            return filterAvx512(run, candidates, count, target_sum, track);
#endif
        default:
            return filterBaseline(run, candidates, count, target_sum, track);
    }
}

}  // namespace terrawalk
