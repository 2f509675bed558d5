// The whole job on the shipped sample, as a process: wall seconds and peak memory. Run as: bench_process
// [repeats]

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

int main(int argc, char** argv) {
    using namespace terrawalk::test;
    const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 7;
    const std::string sample = TERRAWALK_SOURCE_DIR "/sample_surveys/mango_orchard";
    fmt::print("terrawalk process sample_surveys/mango_orchard, {} repeats\n", repeats);
    fmt::print("{:<10}{:>10}{:>10}{:>10}{:>16}\n", "threads", "min s", "median s", "max s", "peak memory MB");
    for (const char* threads : {"1", "2"}) {
        std::vector<double> seconds;
        long peak_kib = 0;
        for (int i = 0; i < repeats; ++i) {
            const TemporaryFolder folder;
            const auto outcome = runProgram({TERRAWALK_PROGRAM, "process", sample, "-o",
                                             (folder / "out").string(), "--quiet", "--threads", threads});
            if (outcome.exit_code != 0) {
                fmt::print(stderr, "{}", outcome.err);
                return 1;
            }
            seconds.push_back(outcome.seconds);
            peak_kib = std::max(peak_kib, outcome.peak_memory_kib);
        }
        std::sort(seconds.begin(), seconds.end());
        fmt::print("{:<10}{:>10.3f}{:>10.3f}{:>10.3f}{:>16.0f}\n", threads, seconds.front(),
                   seconds[seconds.size() / 2], seconds.back(), static_cast<double>(peak_kib) / 1024.0);
    }
    return 0;
}
