// SPDX-License-Identifier: MIT
#include "core/parallel.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <mutex>
#include <optional>

namespace stipple {

RunContext worth_threads(const RunContext& run, double seconds) {
    // Seconds to wake the threads on a busy machine; on an idle one, it takes a quarter of that.
    constexpr double waking = 1e-3;
    RunContext fit = run;
    if (seconds < 2 * waking) fit.threads = 1;
    return fit;
}

RunContext silent(RunContext run) {
    run.progress = {};
    return run;
}

RunContext unwarned(RunContext run) {
    run.warn = {};
    return run;
}

RunContext unstopped(RunContext run) {
    run.stop = {};
    return run;
}

namespace {

/// Raises oneTBB's limit on threads, by default the number of cores, to `threads`. The program has
/// a single global_control object, because oneTBB applies the smallest limit of all of them.
void allow(unsigned threads) {
    static std::mutex mutex;
    static std::optional<tbb::global_control> bound;
    static std::size_t allowed =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    const std::lock_guard lock(mutex);
    if (threads <= allowed) return;
    bound.emplace(tbb::global_control::max_allowed_parallelism, allowed = threads);
}

}  // namespace

void within_threads(const RunContext& run, const std::function<void()>& work) {
    const unsigned threads = run.thread_count();
    if (threads == 1) return work();  // without oneTBB, which hangs in a forked process
    allow(threads);
    tbb::task_arena arena(static_cast<int>(threads));
    arena.execute(work);
}

void for_each_block(const RunContext& run, std::uint64_t count, std::uint64_t size,
                    const std::function<void(const Block&)>& body) {
    const std::size_t blocks = block_count(count, size);
    const auto block_at = [&](std::size_t b) {
        const std::uint64_t first = b * size;
        return Block{first, first + std::min(size, count - first), b};
    };
    if (blocks <= 1 || run.thread_count() == 1) {
        for (std::size_t b = 0; b < blocks; ++b) {
            run.check_stop();
            body(block_at(b));
            run.tick(b + 1, blocks);
        }
        return;
    }
    std::mutex reporting;
    std::size_t done = 0;
    RunContext needed = run;
    needed.threads = static_cast<unsigned>(std::min<std::size_t>(run.thread_count(), blocks));
    within_threads(needed, [&] {
        tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
            run.check_stop();
            body(block_at(b));
            if (!run.progress) return;
            const std::lock_guard lock(reporting);
            run.tick(++done, blocks);
        });
    });
}

}  // namespace stipple
