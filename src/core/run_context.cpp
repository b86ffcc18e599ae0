// SPDX-License-Identifier: MIT
#include "stipple/run.hpp"

#include <algorithm>
#include <atomic>
#include <latch>
#include <memory>
#include <semaphore>
#include <system_error>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

/// Starts a thread that waits for `leave`. Returns once the thread has allocated memory, because
/// the allocator reserves address space for each thread that allocates.
void start_one(std::vector<std::thread>& started, std::latch& leave) {
    std::binary_semaphore allocated(0);
    started.emplace_back([&] {
        ::operator delete(::operator new(64, std::nothrow));
        allocated.release();
        leave.wait();
    });
    allocated.acquire();
}

/// Number of threads that can run, at most `wanted` and including this one; tested by starting them
/// all. If limits of address space or processes allow fewer, returns half of the number that
/// started, so that memory is left for the work.
unsigned startable(unsigned wanted) {
    std::latch leave(1);
    std::vector<std::thread> started;
    started.reserve(wanted - 1);
    try {
        while (started.size() + 1 < wanted) start_one(started, leave);
    } catch (const std::system_error&) {
        wanted = static_cast<unsigned>(1 + started.size() / 2);
    }
    leave.count_down();
    for (std::thread& thread : started) thread.join();
    return wanted;
}

/// Limits the number of threads to those that can start: with more, oneTBB would abort the program.
unsigned limited_by_system(unsigned wanted) {
    static std::atomic<unsigned> tried = 1;
    static std::atomic<unsigned> most = 1;
    if (wanted > tried.load()) {
        most = startable(wanted);
        tried = wanted;
    }
    return std::min(wanted, most.load());
}

}  // namespace

unsigned RunContext::thread_count() const {
    static const unsigned cores =
        std::max(1U, std::thread::hardware_concurrency());   // cached, since the call reads a file
    constexpr std::uint64_t bytes = std::uint64_t{1} << 20;  // stack and heap of one thread
    const auto fit = std::clamp<std::uint64_t>(max_memory / bytes, 1, ~0U);
    return limited_by_system(
        static_cast<unsigned>(std::min<std::uint64_t>(threads != 0 ? threads : cores, fit)));
}

void RunContext::check_stop() const {
    if (stop.stop_requested()) fail(ErrorKind::cancelled, "interrupted");
}

void RunContext::tick(std::uint64_t done, std::uint64_t total) const {
    check_stop();
    if (progress && total > 0)
        progress(std::min(1.0, static_cast<double>(done) / static_cast<double>(total)));
}

void RunContext::tick(std::uint64_t done, std::uint64_t total, const std::string& words) const {
    if (progress && note) note(words);
    tick(done, total);
}

RunContext RunContext::rising() const {
    RunContext steady = *this;
    if (progress)
        steady.progress = [report = progress, shown = std::make_shared<double>(0)](double done) {
            if (done > *shown) report(*shown = done);
        };
    return steady;
}

RunContext RunContext::stage(double from, double to) const {
    RunContext part = *this;
    if (progress)
        part.progress = [report = progress, from, to](double done) {
            report(std::min(to, from + (to - from) * done));
        };
    return part;
}

void RunContext::notify(const std::string& sentence) const {
    if (warn) warn(sentence);
}

std::uint64_t RunContext::memory_left() const {
    return max_memory - (memory_in_use ? std::min(memory_in_use(), max_memory) : 0);
}

RunContext RunContext::share_of_memory(std::uint64_t workers) const {
    RunContext share = *this;
    if (workers < 2) return share;
    share.max_memory = memory_left() / workers;
    share.memory_in_use = {};
    return share;
}

void RunContext::need_memory(double bytes, std::string_view what) const {
    if (bytes <= static_cast<double>(memory_left())) return;
    const auto limit = static_cast<double>(max_memory);
    const char* beside = bytes > limit ? "" : " besides that in use";
    fail_with_hint(ErrorKind::limit, "raise the limit with --max-memory",
                   "{} needs {} of memory{}; the limit is {}", what, format_bytes(bytes), beside,
                   format_bytes(limit));
}

}  // namespace stipple
