#include "app/cli/terminal_progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "survey/result.hpp"

namespace terrawalk {

namespace {

std::string timeLeft(double seconds) {
    const auto s = static_cast<long>(seconds + 0.5);
    if (s < 60) return fmt::format("{} s left", s);
    if (s < 3600) return fmt::format("{} min {:02} s left", s / 60, s % 60);
    return fmt::format("{} h {:02} min left", s / 3600, s / 60 % 60);
}

}  // namespace

TerminalProgress::TerminalProgress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}

TerminalProgress::~TerminalProgress() {
    clear();
}

void TerminalProgress::report(double fraction, std::string_view step) {
    if (quiet_ || !terminal_) return;
    const std::lock_guard lock(mutex_);
    furthest_ = std::max(furthest_, std::clamp(fraction, 0.0, 1.0));
    const Clock::time_point now = Clock::now();
    if (drawn_ && now - last_drawn_ < std::chrono::milliseconds(80)) return;
    last_drawn_ = now;
    const double elapsed_s = std::chrono::duration<double>(now - start_).count();
    std::string line = fmt::format("\r\033[K[{:3.0f} %] {}", 100.0 * furthest_, printable(step));
    // Below a second or a twentieth of the work the estimate is a guess, and a wrong one.
    if (elapsed_s > 1.0 && furthest_ > 0.05 && furthest_ < 1.0) {
        line += ", " + timeLeft(elapsed_s * (1.0 - furthest_) / furthest_);
    }
    std::fputs(line.c_str(), stderr);
    drawn_ = true;
}

void TerminalProgress::message(Severity severity, std::string_view text) {
    if (quiet_) return;
    const std::lock_guard lock(mutex_);
    clearLocked();
    std::fputs(
        fmt::format("{}{}\n", severity == Severity::Warning ? "warning: " : "", printable(text)).c_str(),
        stderr);
}

void TerminalProgress::clear() {
    const std::lock_guard lock(mutex_);
    clearLocked();
}

void TerminalProgress::clearLocked() {
    if (drawn_) std::fputs("\r\033[K", stderr);
    drawn_ = false;
}

}  // namespace terrawalk
