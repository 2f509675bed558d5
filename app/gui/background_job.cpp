#include "app/gui/background_job.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <utility>

namespace terrawalk::gui {

namespace {

/// Takes reports from any thread to the window's, a few each second.
class QueuedProgress final : public Progress {
  public:
    QueuedProgress(BackgroundJob& job, Mailbox& mailbox) : job_(job), mailbox_(mailbox) {}

    void report(double fraction, std::string_view step) override {
        const std::lock_guard lock(mutex_);
        furthest_ = std::max(furthest_, std::clamp(fraction, 0.0, 1.0));
        const Clock::time_point now = Clock::now();
        if (now - last_told_ < std::chrono::milliseconds(60)) return;
        last_told_ = now;
        const double elapsed_s = std::chrono::duration<double>(now - start_).count();
        // Below a second or a twentieth of the work the estimate is a guess, and a wrong one.
        const bool known = elapsed_s > 1.0 && furthest_ > 0.05;
        const double left_s = known ? elapsed_s * (1.0 - furthest_) / furthest_ : -1.0;
        const QString text = QString::fromUtf8(step.data(), static_cast<qsizetype>(step.size()));
        mailbox_.post(
            [job = &job_, f = furthest_, text, left_s] { Q_EMIT job->progressed(f, text, left_s); });
    }

    void message(Severity severity, std::string_view text) override {
        const QString copy = QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
        mailbox_.post([job = &job_, severity, copy] { Q_EMIT job->told(severity, copy); });
    }

  private:
    using Clock = std::chrono::steady_clock;
    BackgroundJob& job_;
    Mailbox& mailbox_;
    std::mutex mutex_;
    const Clock::time_point start_ = Clock::now();
    Clock::time_point last_told_{};
    double furthest_ = 0.0;
};

}  // namespace

BackgroundJob::BackgroundJob(QObject* parent) : QObject(parent) {}

BackgroundJob::~BackgroundJob() {
    thread_.request_stop();
}

void BackgroundJob::start(Work work) {
    if (running_) return;
    running_ = true;
    Q_EMIT runningChanged(true);
    thread_ = std::jthread([this, work = std::move(work)](const std::stop_token& stop) {
        QueuedProgress progress(*this, mailbox_);
        Delivery delivery;
        try {
            delivery = work(progress, stop);
        } catch (const std::exception& problem) {
            progress.message(Severity::Warning, problem.what());
        }
        // Outcomes are large: shared, so that the queue copies none of them.
        const auto outcome = std::make_shared<const Delivery>(std::move(delivery));
        mailbox_.post([this, outcome] { finish(*outcome); });
    });
}

void BackgroundJob::cancel() {
    thread_.request_stop();
}

void BackgroundJob::finish(const Delivery& delivery) {
    running_ = false;
    if (delivery) delivery();
    if (!running_) Q_EMIT runningChanged(false);
}

}  // namespace terrawalk::gui
