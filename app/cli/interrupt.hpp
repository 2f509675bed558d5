#pragma once

#include <stop_token>
#include <thread>

namespace terrawalk {

/// Turns Ctrl-C (SIGINT), SIGTERM and SIGHUP into a stop request. To be made before any other thread, since
/// it blocks the signals for this thread and its children and waits for them in a thread of its own. A second
/// signal ends the program at once.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

  private:
    std::stop_source stop_;
    std::jthread waiter_;
};

}  // namespace terrawalk
