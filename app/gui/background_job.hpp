#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <stop_token>
#include <thread>

#include "app/gui/background.hpp"
#include "survey/progress.hpp"

namespace terrawalk::gui {

/// Runs one piece of work at a time beside the window. Lives in the window's thread; all signals come there.
class BackgroundJob : public QObject {
    Q_OBJECT
  public:
    /// What the window's thread does with the outcome.
    using Delivery = std::function<void()>;
    /// Runs in a thread of its own; must return soon after a stop was requested.
    using Work = std::function<Delivery(Progress&, std::stop_token)>;

    explicit BackgroundJob(QObject* parent = nullptr);
    /// Stops what runs, and waits for it.
    ~BackgroundJob() override;

    /// Does nothing while another piece of work runs.
    void start(Work work);
    void cancel();
    [[nodiscard]] bool running() const { return running_; }

  Q_SIGNALS:
    void runningChanged(bool running);
    /// @param seconds_left  below zero while nobody can tell
    void progressed(double fraction, const QString& step, double seconds_left);
    void told(terrawalk::Severity severity, const QString& text);

  private:
    void finish(const Delivery& delivery);
    Mailbox mailbox_;
    std::jthread thread_;  // ends before the mailbox that it writes to
    bool running_ = false;
};

}  // namespace terrawalk::gui
