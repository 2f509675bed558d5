// Compiled for AVX2; called only where the machine has it.

#include "fusion/batch_filter_kernels.hpp"
#include "fusion/batch_filter_lanes.hpp"

namespace terrawalk {

namespace {
typedef double FourLanes __attribute__((vector_size(4 * sizeof(double))));
}

void filterAvx2(const BatchRun& run, const BatchCandidate* candidates, std::size_t count, double* target_sum,
                double* track) {
    lanes::filterRun<FourLanes>(run, candidates, count, target_sum, track);
}

}  // namespace terrawalk
