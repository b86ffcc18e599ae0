// SPDX-License-Identifier: MIT
//
// Loops over blocks on all cores. The blocks depend on the count alone, so that sums taken block by
// block, and then in the order of the blocks, are the same for any number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "stipple/run.hpp"

namespace stipple {

/// A stretch [first, last) of a loop, the `index`-th of its blocks.
struct Block {
    std::uint64_t first;
    std::uint64_t last;
    std::size_t index;
};

/// Number of blocks that for_each_block makes.
constexpr std::size_t block_count(std::uint64_t count, std::uint64_t size) {
    return static_cast<std::size_t>(count / size + (count % size != 0));
}

/// Calls body(block) for consecutive blocks of `size` that cover [0, count), on run.threads
/// threads; reports progress, and stops early when asked to.
/// @throws what body throws; Error(cancelled).
void for_each_block(const RunContext& run, std::uint64_t count, std::uint64_t size,
                    const std::function<void(const Block&)>& body);

/// The run without reports of progress.
RunContext silent(RunContext run);

/// The run that goes on when a stop is requested.
RunContext unstopped(RunContext run);

/// The run for work that takes one core about so many seconds: as it is, or of one thread, where to
/// wake others takes longer than they would save.
RunContext worth_threads(const RunContext& run, double seconds);

/// Runs `work` in an arena of run.threads threads: what oneTBB does inside stays within them.
void within_threads(const RunContext& run, const std::function<void()>& work);

}  // namespace stipple
