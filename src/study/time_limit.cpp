// SPDX-License-Identifier: MIT
#include "study/time_limit.hpp"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "core/error.hpp"

namespace stipple {
namespace {

/// Looks at the clock beside the work, and passes on a stop that was asked for.
class Watch {
  public:
    Watch(const RunContext& run, double limit)
        : run_(run), end_(run.seconds() + limit), thread_([this] { look(); }) {}
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    ~Watch() {
        {
            const std::lock_guard lock(mutex_);
            done_ = true;
        }
        wake_.notify_one();
        thread_.join();
    }

    [[nodiscard]] std::stop_token stop() const { return stop_.get_token(); }
    [[nodiscard]] bool over() const { return over_; }

  private:
    void look() {
        constexpr auto pause = std::chrono::milliseconds(10);
        std::unique_lock lock(mutex_);
        while (!wake_.wait_for(lock, pause, [this] { return done_; })) {
            over_ = over_ || run_.seconds() >= end_;
            if (over_ || run_.stop.stop_requested()) stop_.request_stop();
        }
    }

    const RunContext& run_;
    double end_;
    std::stop_source stop_;
    std::atomic<bool> over_ = false;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool done_ = false;
    std::thread thread_;  // last: it uses all the others
};

}  // namespace

bool over_time(const RunContext& run, std::optional<double> seconds,
               const std::function<void(const RunContext&)>& work) {
    if (!seconds || !run.seconds) {
        work(run);
        return false;
    }
    const Watch watch(run, *seconds);
    RunContext limited = run;
    limited.stop = watch.stop();
    try {
        work(limited);
    } catch (const Error& e) {
        if (e.kind() != ErrorKind::cancelled || !watch.over()) throw;
    }
    run.check_stop();
    return watch.over();
}

}  // namespace stipple
