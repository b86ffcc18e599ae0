// SPDX-License-Identifier: MIT
//
// The parts of oneTBB that this program uses, implemented with threads and locks of the standard
// library: Debian's libtbb is not built for the thread sanitizer, which therefore does not see its
// synchronization.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

namespace tbb {

class global_control {
  public:
    enum parameter { max_allowed_parallelism };
    global_control(parameter, std::size_t) {}
    static std::size_t active_value(parameter) { return 1024; }
};

inline thread_local std::size_t arena_threads = 2;

class task_arena {
  public:
    explicit task_arena(int threads) : threads_(static_cast<std::size_t>(threads)) {}

    template <class Work>
    void execute(const Work& work) {
        struct Restore {
            std::size_t threads = arena_threads;
            ~Restore() { arena_threads = threads; }
        } const restore;
        arena_threads = threads_;
        work();
    }

  private:
    std::size_t threads_;
};

/// Calls body(i) for all i on the arena's threads; rethrows the first exception.
template <class Index, class Body>
void parallel_for(Index first, Index last, const Body& body) {
    std::atomic<Index> next = first;
    std::exception_ptr error;
    std::mutex failing;
    const auto work = [&] {
        try {
            for (Index i = next++; i < last; i = next++) body(i);
        } catch (...) {
            const std::lock_guard lock(failing);
            if (!error) error = std::current_exception();
            next = last;
        }
    };
    std::vector<std::thread> threads;
    for (std::size_t t = 1; t < std::min<std::size_t>(arena_threads, last - first); ++t)
        threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
    if (error) std::rethrow_exception(error);
}

template <class First, class Second>
void parallel_invoke(const First& first, const Second& second) {
    static std::atomic<int> running = 0;
    if (running++ > 8) {
        first();
        second();
    } else {
        parallel_for(0, 2, [&](int i) { i == 0 ? first() : second(); });
    }
    --running;
}

template <class T>
class enumerable_thread_specific {
  public:
    template <class... Args>
    explicit enumerable_thread_specific(Args... args)
        : make_([=] { return std::make_unique<T>(args...); }) {}

    T& local() {
        const std::lock_guard lock(mutex_);
        auto& mine = all_[std::this_thread::get_id()];
        if (!mine) mine = make_();
        return *mine;
    }

  private:
    std::function<std::unique_ptr<T>()> make_;
    std::mutex mutex_;
    std::map<std::thread::id, std::unique_ptr<T>> all_;
};

template <class T>
class concurrent_queue {
  public:
    void push(T item) {
        const std::lock_guard lock(mutex_);
        items_.push_back(std::move(item));
        more_.notify_one();
    }
    bool try_pop(T& item) {
        const std::lock_guard lock(mutex_);
        return take(item);
    }
    void pop(T& item) {
        std::unique_lock lock(mutex_);
        more_.wait(lock, [this] { return !items_.empty(); });
        take(item);
    }
    [[nodiscard]] bool empty() const {
        const std::lock_guard lock(mutex_);
        return items_.empty();
    }

  private:
    bool take(T& item) {
        if (items_.empty()) return false;
        item = std::move(items_.front());
        items_.pop_front();
        return true;
    }

    mutable std::mutex mutex_;
    std::condition_variable more_;
    std::deque<T> items_;
};

template <class T>
using concurrent_bounded_queue = concurrent_queue<T>;

}  // namespace tbb
