// For every machine of the architecture: two lanes, and one.

#include "fusion/batch_filter_kernels.hpp"
#include "fusion/batch_filter_lanes.hpp"

namespace terrawalk {

namespace {
typedef double TwoLanes __attribute__((vector_size(2 * sizeof(double))));
}

void filterScalar(const BatchRun& run, const BatchCandidate* candidates, std::size_t count,
                  double* target_sum, double* track) {
    lanes::filterRun<double>(run, candidates, count, target_sum, track);
}

void filterBaseline(const BatchRun& run, const BatchCandidate* candidates, std::size_t count,
                    double* target_sum, double* track) {
    lanes::filterRun<TwoLanes>(run, candidates, count, target_sum, track);
}

}  // namespace terrawalk
