#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk::test {

inline ProgramOutcome terrawalk(std::vector<std::string> arguments,
                                const std::function<void(pid_t)>& meanwhile = {}) {
    arguments.insert(arguments.begin(), TERRAWALK_PROGRAM);
    return runProgram(arguments, meanwhile);
}

inline std::filesystem::path quickPlot() {
    return std::filesystem::path(TERRAWALK_SOURCE_DIR) / "sample_surveys" / "quick_plot";
}

}  // namespace terrawalk::test
