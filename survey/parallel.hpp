#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>

namespace terrawalk {

namespace detail {

/// Calls `part(body, begin, end)` for parts of [0, count) on oneTBB's threads. With a grain each part is at
/// most as long; with 0 oneTBB chooses.
void eachPart(std::size_t count, std::size_t grain, void (*part)(void*, std::size_t, std::size_t),
              void* body);

void isolate(void (*call)(void*), void* body);

/// Puts what was before a loop before its parts, and the parts before what comes after it. oneTBB does so
/// too, but its library is not instrumented, and the thread sanitizer sees only this. Parts stay without an
/// order among each other, so that a race between two of them is reported.
class LoopOrder {
  public:
    LoopOrder() { begun_.store(true, std::memory_order_release); }
    LoopOrder(const LoopOrder&) = delete;
    LoopOrder& operator=(const LoopOrder&) = delete;
    ~LoopOrder() { static_cast<void>(ended_.load(std::memory_order_acquire)); }

    class Part {
      public:
        explicit Part(LoopOrder& order) : order_(order) {
            static_cast<void>(order_.begun_.load(std::memory_order_acquire));
        }
        Part(const Part&) = delete;
        Part& operator=(const Part&) = delete;
        ~Part() { order_.ended_.fetch_add(1, std::memory_order_release); }

      private:
        LoopOrder& order_;
    };

  private:
    std::atomic<bool> begun_{false};
    std::atomic<std::size_t> ended_{0};
};

template <class Body>
struct OrderedLoop {
    const Body& body;
    LoopOrder order;  // last, as it puts what stands above before the parts
};

template <class Body>
void orderedParts(std::size_t count, std::size_t grain, const Body& body) {
    OrderedLoop<Body> ordered{body, {}};
    const auto part = [](void* what, std::size_t begin, std::size_t end) {
        auto& loop = *static_cast<OrderedLoop<Body>*>(what);
        const LoopOrder::Part of_loop(loop.order);
        loop.body(begin, end);
    };
    eachPart(count, grain, part, &ordered);
}

}  // namespace detail

// The one way to oneTBB's loops. A body that throws ends its loop with that exception.

/// `body(i)` for each i in [0, count), on all of oneTBB's threads.
template <class Body>
void parallelFor(std::size_t count, const Body& body) {
    const auto part = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    };
    detail::orderedParts(count, 0, part);
}

/// `body(begin, end)` for parts of [0, count), each of at most `grain`, whatever the number of threads.
template <class Body>
void parallelRanges(std::size_t count, std::size_t grain, const Body& body) {
    detail::orderedParts(count, std::max<std::size_t>(1, grain), body);
}

/// As many threads as loops may use here.
[[nodiscard]] int threadCount();

/// Runs `body` here; loops in it do not make this thread begin other work while it waits for them.
template <class Body>
void isolated(const Body& body) {
    detail::isolate([](void* what) { (*static_cast<const Body*>(what))(); }, const_cast<Body*>(&body));
}

}  // namespace terrawalk
