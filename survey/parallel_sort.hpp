#pragma once

#include <vector>

#ifdef __SANITIZE_THREAD__
#include <algorithm>
#else
#include <tbb/parallel_sort.h>
#endif

namespace terrawalk {

/// Sorts by `less` on all of oneTBB's threads; not stable. For the thread sanitizer on one: what orders the
/// threads of oneTBB's sort is out of its sight.
template <class T, class Less>
void parallelSort(std::vector<T>& items, const Less& less) {
#ifdef __SANITIZE_THREAD__
    std::sort(items.begin(), items.end(), less);
#else
    tbb::parallel_sort(items.begin(), items.end(), less);
#endif
}

}  // namespace terrawalk
