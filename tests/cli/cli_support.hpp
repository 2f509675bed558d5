#pragma once

#include <signal.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk::test {

inline ProgramOutcome terrawalk(std::vector<std::string> arguments,
                                const std::function<void(pid_t)>& meanwhile = {}) {
    arguments.insert(arguments.begin(), TERRAWALK_PROGRAM);
    return runProgram(arguments, meanwhile);
}

/// Kills programs about the end of their work: later after a hit, earlier after a program that was done
/// before. No share of a time measured once does: load changes the pace of a machine several times over.
class KillNearTheEnd {
  public:
    /// @param whole_s  of a program that was left to its end, about
    explicit KillNearTheEnd(double whole_s) : after_s_(0.9 * whole_s) {}
    /// To be run meanwhile.
    void operator()(pid_t program) const {
        std::this_thread::sleep_for(std::chrono::duration<double>(after_s_));
        kill(program, SIGKILL);
    }
    void learn(const ProgramOutcome& outcome) {
        const bool hit = outcome.signal == SIGKILL;
        hits_ += hit ? 1 : 0;
        after_s_ *= hit ? 1.07 : 0.85;
    }
    [[nodiscard]] std::size_t hits() const { return hits_; }

  private:
    double after_s_;
    std::size_t hits_ = 0;
};

inline std::filesystem::path quickPlot() {
    return std::filesystem::path(TERRAWALK_SOURCE_DIR) / "sample_surveys" / "quick_plot";
}

}  // namespace terrawalk::test
