#pragma once

#include <sys/types.h>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace terrawalk::test {

struct ProgramOutcome {
    int exit_code = -1;  ///< -1 when a signal ended it
    int signal = 0;
    std::string out;
    std::string err;
    double seconds = 0.0;
    double cpu_seconds = 0.0;  ///< user and system, of all its threads
    long peak_memory_kib = 0;
};

/// Runs a program to its end, with its output caught. DISPLAY and WAYLAND_DISPLAY are unset.
/// @param meanwhile  called with the process's id right after the start, e.g. to send it a signal
[[nodiscard]] ProgramOutcome runProgram(const std::vector<std::string>& command,
                                        const std::function<void(pid_t)>& meanwhile = {});

}  // namespace terrawalk::test
