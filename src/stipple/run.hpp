// SPDX-License-Identifier: MIT
//
// Execution context of a computation: threads, progress, cancellation, memory limit. Computations
// get nothing else from their environment, and none of these fields changes a result.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <stop_token>
#include <string>
#include <string_view>

namespace stipple {

struct RunContext {
    /// Threads to use, 0 for all cores.
    unsigned threads = 0;

    /// Called with the fraction done, in [0, 1], never falling; by one thread at a time.
    std::function<void(double)> progress = {};

    /// Called before `progress`, by one thread at a time, with a short status text. It is
    /// shown instead of the time left, which cannot be estimated for such work.
    std::function<void(const std::string&)> note = {};

    /// Called with a sentence that the user should see; by one thread at a time.
    std::function<void(const std::string&)> warn = {};

    std::stop_token stop = {};

    /// If true, a search may return its best result so far when a stop is requested, instead of
    /// throwing.
    bool keeps_best = false;

    /// Clock: seconds since a fixed moment. Empty if no clock is available.
    std::function<double()> seconds = {};

    /// Memory limit, in bytes.
    std::uint64_t max_memory = std::numeric_limits<std::uint64_t>::max();

    /// Bytes already in use that count towards max_memory, such as the points; empty: 0.
    std::function<std::uint64_t()> memory_in_use = {};

    /// Number of threads to use, at least 1: `threads`, or fewer if memory or the system allow no
    /// more.
    [[nodiscard]] unsigned thread_count() const;

    /// Whether a stop was requested and the best result so far is acceptable.
    [[nodiscard]] bool best_is_wanted() const { return keeps_best && stop.stop_requested(); }

    /// @throws Error(cancelled) once a stop was requested.
    void check_stop() const;

    /// Reports progress and checks for a stop; call it every few milliseconds from one thread.
    void tick(std::uint64_t done, std::uint64_t total) const;

    /// As above, with a status text, for example the best bound so far.
    void tick(std::uint64_t done, std::uint64_t total, const std::string& words) const;

    /// A copy of this context whose progress never falls, even if several stages each report from
    /// 0.
    [[nodiscard]] RunContext rising() const;

    /// A copy of this context for one stage: its progress 0..1 is mapped to from..to of the whole.
    [[nodiscard]] RunContext stage(double from, double to) const;

    /// Bytes of max_memory that are not in use.
    [[nodiscard]] std::uint64_t memory_left() const;

    /// A copy of this context for one of several workers that share the memory left.
    [[nodiscard]] RunContext share_of_memory(std::uint64_t workers) const;

    /// Calls `warn`, if set, with the sentence.
    void notify(const std::string& sentence) const;

    /// @throws Error(limit) naming `what` if `bytes` and the memory in use together exceed
    /// max_memory.
    void need_memory(double bytes, std::string_view what) const;
};

}  // namespace stipple
