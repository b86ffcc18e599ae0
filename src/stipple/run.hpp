// SPDX-License-Identifier: MIT
//
// Execution context of a computation: threads, progress, cancellation, memory limit. Nothing else of
// the world outside reaches it, and none of this changes a result.
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

    /// Called with the fraction done, in [0, 1] and rising; from one thread at a time.
    std::function<void(double)> progress = {};

    /// Called before `progress` with a few words to show in place of the time left, which such
    /// progress does not tell; from one thread at a time.
    std::function<void(const std::string&)> note = {};

    /// Called with a sentence that the user should see; from one thread at a time.
    std::function<void(const std::string&)> warn = {};

    std::stop_token stop = {};

    /// Once a stop is requested, a search may end with the best that it has, in place of nothing.
    bool keeps_best = false;

    /// Seconds that have passed since some moment; empty where nobody keeps time.
    std::function<double()> seconds = {};

    /// Bytes that a computation may plan to use.
    std::uint64_t max_memory = std::numeric_limits<std::uint64_t>::max();

    /// Bytes that are in use and count towards max_memory, such as the points; empty: none do.
    std::function<std::uint64_t()> memory_in_use = {};

    /// Number of threads meant by `threads`, at least 1.
    [[nodiscard]] unsigned thread_count() const;

    /// Whether a stop was requested and the best so far will do.
    [[nodiscard]] bool best_is_wanted() const { return keeps_best && stop.stop_requested(); }

    /// @throws Error(cancelled) once a stop was requested.
    void check_stop() const;

    /// Reports progress and checks for a stop; call it every few milliseconds from one thread.
    void tick(std::uint64_t done, std::uint64_t total) const;

    /// The same, with words for where the run stands, such as what is certain so far.
    void tick(std::uint64_t done, std::uint64_t total, const std::string& words) const;

    /// This run, its progress never falling: stages may each report from 0 on.
    [[nodiscard]] RunContext rising() const;

    /// The part of a run whose progress is what lies between two fractions of the whole.
    [[nodiscard]] RunContext stage(double from, double to) const;

    /// Bytes of max_memory that are not in use.
    [[nodiscard]] std::uint64_t memory_left() const;

    /// This run for one of several workers that share what is left of the memory.
    [[nodiscard]] RunContext share_of_memory(std::uint64_t workers) const;

    /// Gives the user a sentence, if anybody listens.
    void notify(const std::string& sentence) const;

    /// @throws Error(limit) naming `what` when it would need more than max_memory, together with
    /// what is in use.
    void need_memory(double bytes, std::string_view what) const;
};

}  // namespace stipple
