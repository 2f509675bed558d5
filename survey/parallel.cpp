#include "survey/parallel.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace terrawalk {

int threadCount() {
    const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return std::max(1, std::min(tbb::this_task_arena::max_concurrency(), static_cast<int>(allowed)));
}

namespace detail {

void eachPart(std::size_t count, std::size_t grain, void (*part)(void*, std::size_t, std::size_t),
              void* body) {
    using Range = tbb::blocked_range<std::size_t>;
    const auto each = [=](const Range& range) {
        part(body, range.begin(), range.end());
    };
    if (grain == 0) {
        tbb::parallel_for(Range(0, count), each);
    } else {
        tbb::parallel_for(Range(0, count, grain), each, tbb::simple_partitioner{});
    }
}

void isolate(void (*call)(void*), void* body) {
    tbb::this_task_arena::isolate([=] { call(body); });
}

}  // namespace detail

}  // namespace terrawalk
