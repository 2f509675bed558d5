#include "app/cli/interrupt.hpp"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

namespace terrawalk {

namespace {

sigset_t handledSignals() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    sigaddset(&set, SIGHUP);  // the terminal was closed
    return set;
}

constexpr timespec kPollInterval{0, 50'000'000};
constexpr int kExitOnSecondSignal = 4;

}  // namespace

Interrupt::Interrupt() {
    const sigset_t set = handledSignals();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    // A file above the permitted size is an error of writing, not a reason to die.
    signal(SIGXFSZ, SIG_IGN);
    waiter_ = std::jthread([this](const std::stop_token& finished) {
        const sigset_t waited = handledSignals();
        while (!finished.stop_requested()) {
            if (sigtimedwait(&waited, nullptr, &kPollInterval) < 0) continue;
            if (stop_.stop_requested()) _exit(kExitOnSecondSignal);
            stop_.request_stop();
        }
    });
}

Interrupt::~Interrupt() = default;

}  // namespace terrawalk
