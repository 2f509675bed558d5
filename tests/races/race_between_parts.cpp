#include <thread>

#include "survey/parallel.hpp"

// Two parts of a loop count in the same variable.
int main() {
    int count = 0;
    terrawalk::parallelRanges(64, 1, [&](std::size_t, std::size_t) {
        ++count;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
    return count > 0 ? 0 : 1;
}
