// SPDX-License-Identifier: MIT
//
// A thread that runs all calls made by one Python thread, so that thread-local resources of the
// library (memory, TBB's thread slot) are reused by the next call.
#pragma once

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace stipple::python {

class Worker {
  public:
    Worker() : thread_([this] { serve(); }) {}
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker() {
        begin({});
        thread_.join();
    }

    /// Starts work() on the thread. @param work must not throw; empty: ends the thread
    void begin(std::function<void()> work) {
        const std::lock_guard lock(mutex_);
        work_ = std::move(work);
        waits_ = true;
        changed_.notify_all();
    }

    /// Waits up to `time`; returns whether the work is done.
    bool done_within(std::chrono::milliseconds time) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, time, [&] { return !waits_; });
    }

    /// False in a forked child, which has no such thread and must not join it.
    [[nodiscard]] bool alive() const { return process_ == getpid(); }

  private:
    void serve() {
        std::unique_lock lock(mutex_);
        for (;;) {
            changed_.wait(lock, [&] { return waits_; });
            if (!work_) return;
            lock.unlock();
            work_();
            lock.lock();
            waits_ = false;
            changed_.notify_all();
        }
    }

    const pid_t process_ = getpid();
    std::mutex mutex_;
    std::condition_variable changed_;
    std::function<void()> work_;
    bool waits_ = false;
    std::thread thread_;
};

/// Borrows the worker of this Python thread, or starts another one if it is busy: a progress
/// function may call the library while a call is running.
class HiredWorker {
  public:
    HiredWorker() : worker_(std::move(idle())) {
        if (!worker_ || !worker_->alive()) worker_ = Owned(new Worker);
    }
    HiredWorker(const HiredWorker&) = delete;
    HiredWorker& operator=(const HiredWorker&) = delete;
    ~HiredWorker() { idle() = std::move(worker_); }

    Worker* operator->() { return worker_.get(); }

  private:
    struct Dismiss {
        void operator()(Worker* worker) const {
            if (worker->alive()) delete worker;
        }
    };
    using Owned = std::unique_ptr<Worker, Dismiss>;

    static Owned& idle() {
        thread_local Owned worker;
        return worker;
    }

    Owned worker_;
};

}  // namespace stipple::python
