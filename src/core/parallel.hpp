// SPDX-License-Identifier: MIT
//
// Loops over blocks of indices on all cores. Blocks depend only on the count, so sums computed per
// block and then added in block order are the same for any number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "stipple/run.hpp"

namespace stipple {

/// Indices [first, last) of a loop; `index` counts the blocks from 0.
struct Block {
    std::uint64_t first;
    std::uint64_t last;
    std::size_t index;
};

/// Number of blocks in for_each_block().
constexpr std::size_t block_count(std::uint64_t count, std::uint64_t size) {
    return static_cast<std::size_t>(count / size + (count % size != 0));
}

/// Calls body(block) for consecutive blocks of `size` that cover [0, count), on run.threads
/// threads. Reports progress.
/// @throws Error(cancelled) if a stop is requested, and exceptions of body
void for_each_block(const RunContext& run, std::uint64_t count, std::uint64_t size,
                    const std::function<void(const Block&)>& body);

/// A copy of the context without progress reports.
RunContext silent(RunContext run);

/// A copy of the context without warnings to the user.
RunContext unwarned(RunContext run);

/// A copy of the context that ignores requests to stop.
RunContext unstopped(RunContext run);

/// A copy of the context for work of about `seconds` on one core: limited to one thread if waking
/// others would cost more than they save.
RunContext worth_threads(const RunContext& run, double seconds);

/// Runs `work` in a oneTBB arena of run.threads threads, which limits all parallel code inside.
void within_threads(const RunContext& run, const std::function<void()>& work);

}  // namespace stipple
