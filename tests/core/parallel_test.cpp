// SPDX-License-Identifier: MIT
#include "core/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "support/units.hpp"

namespace stipple::testing::parallel_test {

TEST(Parallel, BlocksCoverAllOnceForAnyNumberOfThreads) {
    for (const unsigned threads : {1U, 2U, 5U})
        for (const std::uint64_t count : {0, 1, 7, 8, 9, 1000}) {
            std::vector<std::atomic<int>> visits(count);
            std::vector<std::uint64_t> firsts(block_count(count, 8), count);
            for_each_block({.threads = threads}, count, 8, [&](const Block& block) {
                firsts.at(block.index) = block.first;
                EXPECT_LE(block.last - block.first, 8);
                for (std::uint64_t i = block.first; i < block.last; ++i) ++visits[i];
            });
            for (const auto& visit : visits) EXPECT_EQ(visit, 1) << count << ", " << threads;
            for (std::size_t b = 0; b < firsts.size(); ++b) EXPECT_EQ(firsts[b], 8 * b);
        }
}

TEST(Parallel, ErrorsOfBlocksComeOut) {
    for (const unsigned threads : {1U, 3U})
        EXPECT_EQ(error_of([&] {
                      for_each_block({.threads = threads}, 100, 1, [](const Block& block) {
                          if (block.index == 60) fail(ErrorKind::input, "sixty");
                      });
                  }),
                  "input: sixty");
}

TEST(Parallel, SilentRunsReportNothingAndUnstoppedOnesGoOn) {
    double shown = -1;
    std::stop_source stop;
    const RunContext run{
        .threads = 2, .progress = [&](double done) { shown = done; }, .stop = stop.get_token()};
    for_each_block(silent(run), 10, 1, [](const Block&) {});
    EXPECT_EQ(shown, -1);
    for_each_block(run, 10, 1, [](const Block&) {});
    EXPECT_EQ(shown, 1);
    stop.request_stop();
    std::atomic<int> blocks = 0;
    for_each_block(unstopped(run), 10, 1, [&](const Block&) { ++blocks; });
    EXPECT_EQ(blocks, 10);
    EXPECT_EQ(error_of([&] { for_each_block(silent(run), 10, 1, [](const Block&) {}); }),
              "cancelled: interrupted");
}

TEST(Parallel, OnlyLongWorkIsWorthThreads) {
    constexpr std::uint64_t memory = 9 << 20;
    const RunContext run{.threads = 8, .max_memory = memory};
    EXPECT_EQ(worth_threads(run, 1).thread_count(), 8);
    EXPECT_EQ(worth_threads(run, 1e-4).thread_count(), 1);
    EXPECT_EQ(worth_threads(run, 1e-4).max_memory, memory);
}

TEST(Parallel, EachThreadTakesAMebibyte) {
    EXPECT_EQ((RunContext{.threads = 8, .max_memory = 3 << 20}.thread_count()), 3);
    EXPECT_EQ((RunContext{.threads = 8, .max_memory = 9}.thread_count()), 1);
}

}  // namespace stipple::testing::parallel_test
