#pragma once

#include <cstddef>

#include "fusion/batch_filter.hpp"

namespace terrawalk {

// The kernels behind filterBatch(), each in a unit of its own; parameters as there.
void filterScalar(const BatchRun& run, const BatchCandidate* candidates, std::size_t count,
                  double* target_sum, double* track);
void filterBaseline(const BatchRun& run, const BatchCandidate* candidates, std::size_t count,
                    double* target_sum, double* track);
#ifdef __x86_64__
void filterAvx2(const BatchRun& run, const BatchCandidate* candidates, std::size_t count, double* target_sum,
                double* track);
void filterAvx512(const BatchRun& run, const BatchCandidate* candidates, std::size_t count,
                  double* target_sum, double* track);
#endif

}  // namespace terrawalk
