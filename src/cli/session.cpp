// SPDX-License-Identifier: MIT
#include "cli/session.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <utility>

#include "cli/parsing/requests.hpp"
#include "core/bytes/file_bytes.hpp"
#include "core/error.hpp"
#include "core/machine/memory.hpp"
#include "core/text.hpp"

#ifdef __GLIBC_PREREQ
#if __GLIBC_PREREQ(2, 33)
#include <malloc.h>
#define STIPPLE_MALLINFO
#endif
#endif

namespace stipple::cli {
namespace {

/// Bytes that the program and its libraries have allocated and not freed; 0 if the system's
/// allocator does not report them.
std::uint64_t allocated_bytes() {
#ifdef STIPPLE_MALLINFO
    const auto heap = ::mallinfo2();
    return heap.uordblks + heap.hblkhd;  // small blocks of all arenas + large blocks
#else
    return 0;
#endif
}

std::stop_source& interrupts() {
    // Never destroyed, since signals may arrive after the destruction of statics.
    static auto* const source = new std::stop_source;
    return *source;
}

pthread_t main_thread;  // NOLINT: read by the signal handler

/// Time of the first signal in milliseconds; 0 before it.
volatile std::sig_atomic_t interrupted_at = 0;

/// 1 while a signal that another thread has handled is on its way to the main thread.
volatile std::sig_atomic_t woken = 0;

std::sig_atomic_t milliseconds() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<std::sig_atomic_t>(
        (now.tv_sec * 1000 + now.tv_nsec / 1'000'000) % 1'000'000'000 + 1);
}

/// Requests a stop; lock-free, because this stop source has no callbacks. A second signal ends the
/// program, except within 200 ms: then it is the same signal, sent to both the process and its
/// group.
extern "C" void on_interrupt(int signal) {
    const bool in_main = pthread_equal(pthread_self(), main_thread) != 0;
    if (in_main && woken != 0) {
        woken = 0;
        return;
    }
    constexpr std::sig_atomic_t at_once = 200;
    if (interrupted_at == 0) {
        interrupted_at = milliseconds();
    } else if (std::abs(milliseconds() - interrupted_at) > at_once) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);  // delivered when the handler returns
    }
    interrupts().request_stop();
    if (in_main) return;
    woken = 1;
    pthread_kill(main_thread, signal);
}

std::string duration(double seconds) {
    if (seconds < 60) return fmt::format("{:.0f} s", seconds);
    if (seconds < 3600) return fmt::format("{:.0f} min", seconds / 60);
    if (seconds < 172'800) return fmt::format("{:.1f} h", seconds / 3600);
    if (seconds < 3e8) return fmt::format("{:.0f} days", seconds / 86'400);
    return fmt::format("{:.0f} years", seconds / 31'557'600);
}

}  // namespace

ProgressBar::ProgressBar(ProgressMode mode)
    : wanted_(mode == ProgressMode::always ||
              (mode == ProgressMode::automatic && isatty(STDERR_FILENO) == 1)),
      patience_(mode == ProgressMode::always ? std::chrono::milliseconds(0)
                                             : std::chrono::milliseconds(500)) {}

void ProgressBar::show(double fraction) {
    if (!wanted_) return;
    const std::string words = std::exchange(words_, {});
    const auto now = Clock::now();
    const bool last = fraction >= 1;
    if (now - start_ < patience_ || (!last && now - shown_ < std::chrono::milliseconds(100)))
        return;
    shown_ = now;
    visible_ = true;
    constexpr int width = 30;
    const int filled = static_cast<int>(fraction * width);
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const std::string left = !words.empty() ? words
                             : fraction > 0
                                 ? duration(elapsed * (1 - fraction) / fraction) + " left"
                                 : "";
    say(fmt::format("\r[{:#<{}}{:{}}] {:3.0f} %  {}\033[K", "", filled, "", width - filled,
                    100 * fraction, printable(left)));
}

void ProgressBar::clear() {
    if (!visible_) return;
    say("\r\033[K");
    visible_ = false;
}

Session::Session(const Request& request)
    : quiet_(request.quiet), bar_(request.quiet ? ProgressMode::never : request.progress) {
    run_.threads = request.threads;
    run_.max_memory = request.max_memory.value_or(default_memory_limit());
    limit_whole_files(run_.max_memory / 3);  // leaves twice the file's bytes for processing it
    run_.memory_in_use = [before = allocated_bytes()] {
        const std::uint64_t now = allocated_bytes();
        return now - std::min(before, now);
    };
    run_.stop = interrupts().get_token();
    run_.seconds = [start = std::chrono::steady_clock::now()] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    run_.progress = [this](double fraction) { bar_.show(fraction); };
    run_.note = [this](const std::string& words) { bar_.note(words); };
    run_.warn = [this](const std::string& sentence) { warn(sentence); };
}

void Session::warn(const std::string& sentence) { tell("note: " + sentence); }

void Session::tell(const std::string& sentence) {
    constexpr std::size_t most_at_once = 100;
    if (quiet_) return;
    warnings_.push_back(sentence);
    if (warnings_.size() == most_at_once) tell_warnings();
}

void Session::tell_warnings() {
    if (!warnings_.empty()) bar_.clear();
    for (const std::string& sentence : std::exchange(warnings_, {})) say_line(sentence);
}

void say_line(std::string_view sentence) {
    say(fmt::format("stipple: {}\n", printable(cut_short(sentence))));
}

void say(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

void request_stop() { interrupts().request_stop(); }

void catch_interrupts() {
    main_thread = pthread_self();
    interrupts();
    struct sigaction action = {};
    action.sa_handler = on_interrupt;
    action.sa_flags = 0;  // without SA_RESTART, so that blocked reads and writes return
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    struct sigaction before = {};
    sigaction(SIGHUP, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // unless run by nohup
    // Writes to a closed pipe or beyond a file size limit return errors instead.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace stipple::cli
