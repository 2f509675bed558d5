#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "survey/progress.hpp"

namespace terrawalk {

/// Progress on standard error: one line that is rewritten, with the time left, where that is a terminal; only
/// warnings where it is not. Safe from any thread.
class TerminalProgress final : public Progress {
  public:
    explicit TerminalProgress(bool quiet);
    ~TerminalProgress() override;
    void report(double fraction, std::string_view step) override;
    void message(Severity severity, std::string_view text) override;
    /// Wipes the progress line, so that other output starts on a clean one.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    void clearLocked();

    const bool quiet_;
    const bool terminal_;
    const Clock::time_point start_ = Clock::now();
    Clock::time_point last_drawn_{};
    double furthest_ = 0.0;
    bool drawn_ = false;
    std::mutex mutex_;
};

}  // namespace terrawalk
