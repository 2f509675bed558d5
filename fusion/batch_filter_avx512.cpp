// Compiled for AVX-512; called only where the machine has it.

#include "fusion/batch_filter_kernels.hpp"
#include "fusion/batch_filter_lanes.hpp"

namespace terrawalk {

namespace {
typedef double EightLanes __attribute__((vector_size(8 * sizeof(double))));
}

void filterAvx512(const BatchRun& run, const BatchCandidate* candidates, std::size_t count,
                  double* target_sum, double* track) {
    lanes::filterRun<EightLanes>(run, candidates, count, target_sum, track);
}

}  // namespace terrawalk
