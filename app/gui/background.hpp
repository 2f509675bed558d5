#pragma once

#include <QObject>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace terrawalk::gui {

/// Calls functions that any thread hands over, in the thread that it lives in. Qt's own queue would order the
/// two threads as well, but its library is not instrumented: the mutex is what the thread sanitizer sees.
class Mailbox : public QObject {
    Q_OBJECT
  public:
    using Letter = std::function<void()>;
    explicit Mailbox(QObject* parent = nullptr);
    void post(Letter letter);

  Q_SIGNALS:
    void posted();

  private:
    void deliver();
    std::mutex mutex_;
    std::deque<Letter> letters_;
};

/// Runs the work where pictures are made beside the window. Not in Qt's own pool: its painter fills large
/// areas there and waits for them, behind whatever else stands in the line. From the window's thread.
void runBeside(std::function<void()> work);

/// The window's, for what runs beside it.
[[nodiscard]] Mailbox& windowMailbox();

/// Values that are made beside the window, one at a time, and taken there. From the window's thread.
template <class T>
class Background {
  public:
    explicit Background(std::function<void(T)> take) : take_(std::move(take)) {}
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;
    ~Background() {
        wait();
        drop();
    }

    /// What was asked for before is not taken any more.
    void start(std::function<T()> make) {
        drop();
        task_ = std::make_shared<Task>();
        runBeside([this, task = task_, make = std::move(make), mailbox = &windowMailbox()] {
            try {
                task->made.emplace(make());
            } catch (const std::exception&) {
                // No value, and the view stays as it is.
            }
            mailbox->post([this, task] {
                if (task->wanted && task->made) take_(std::move(*task->made));
            });
            const std::lock_guard lock(task->mutex);
            task->over = true;
            task->ended.notify_all();
        });
    }
    void drop() {
        if (task_) task_->wanted = false;
        task_.reset();
    }
    [[nodiscard]] bool running() const {
        if (!task_) return false;
        const std::lock_guard lock(task_->mutex);
        return !task_->over;
    }
    void wait() const {
        if (!task_) return;
        std::unique_lock lock(task_->mutex);
        task_->ended.wait(lock, [this] { return task_->over; });
    }

  private:
    struct Task {
        std::optional<T> made;
        bool wanted = true;  ///< the window's thread alone asks
        std::mutex mutex;
        std::condition_variable ended;
        bool over = false;
    };
    std::function<void(T)> take_;
    std::shared_ptr<Task> task_;
};

}  // namespace terrawalk::gui
