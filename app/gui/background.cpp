#include "app/gui/background.hpp"

#include <QCoreApplication>
#include <QPointer>
#include <QRunnable>
#include <QThreadPool>
#include <atomic>

namespace terrawalk::gui {

namespace {

/// Puts what the window did before it started a task before the task, as the pool does out of the thread
/// sanitizer's sight.
std::atomic<std::size_t> tasks_started{0};

class Task final : public QRunnable {
  public:
    explicit Task(std::function<void()> work) : work_(std::move(work)) {}
    void run() override {
        static_cast<void>(tasks_started.load(std::memory_order_acquire));
        work_();
    }

  private:
    std::function<void()> work_;
};

struct Beside : QObject {
    using QObject::QObject;
    Mailbox mailbox;
    QThreadPool pool;  // goes first, and waits for its tasks, which write to the mailbox
};

Beside& beside() {
    static QPointer<Beside> one;
    if (!one) {
        one = new Beside(QCoreApplication::instance());
        QObject::connect(QCoreApplication::instance(), &QCoreApplication::aboutToQuit, one,
                         [] { one->pool.waitForDone(); });
    }
    return *one;
}

}  // namespace

Mailbox::Mailbox(QObject* parent) : QObject(parent) {
    connect(this, &Mailbox::posted, this, &Mailbox::deliver, Qt::QueuedConnection);
}

void Mailbox::post(Letter letter) {
    {
        const std::lock_guard lock(mutex_);
        letters_.push_back(std::move(letter));
    }
    Q_EMIT posted();
}

void Mailbox::deliver() {
    Letter letter;
    {
        const std::lock_guard lock(mutex_);
        letter = std::move(letters_.front());
        letters_.pop_front();
    }
    letter();
}

void runBeside(std::function<void()> work) {
    auto* const task = new Task(std::move(work));
    tasks_started.fetch_add(1, std::memory_order_release);
    beside().pool.start(task);
}

Mailbox& windowMailbox() {
    return beside().mailbox;
}

}  // namespace terrawalk::gui
