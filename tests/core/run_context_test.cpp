// SPDX-License-Identifier: MIT
#include "stipple/run.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/units.hpp"

namespace stipple::testing::run_context_test {

// Stages follow each other; progress beyond a stage's end is clamped.
TEST(RunContext, StageIsAPartOfTheProgress) {
    std::vector<double> seen;
    RunContext run;
    run.progress = [&](double done) { seen.push_back(done); };
    run.stage(0, 0.25).tick(1, 2);
    run.stage(0.25, 1).tick(0, 3);
    run.stage(0.25, 1).tick(3, 3);
    EXPECT_EQ(seen, (std::vector<double>{0.125, 0.25, 1}));
    RunContext{}.stage(0, 1).tick(1, 1);  // without a progress function
}

// Words accompany their progress, and are ignored without a function for them.
TEST(RunContext, TicksWithWordsForWhereItStands) {
    std::vector<std::string> seen;
    RunContext run;
    run.note = [&](const std::string& words) { seen.push_back(words); };
    run.tick(1, 2, "nobody sees this");
    run.progress = [&](double done) { seen.push_back(done < 1 ? "part" : "all"); };
    run.stage(0, 0.5).tick(1, 1, "between 1 and 2");
    run.tick(1, 1);
    EXPECT_EQ(seen, (std::vector<std::string>{"between 1 and 2", "part", "all"}));
}

// Memory in use counts towards the limit, and workers share the rest.
TEST(RunContext, MemoryInUseCountsTowardsTheLimit) {
    RunContext run{.max_memory = 1000, .memory_in_use = [] { return std::uint64_t{600}; }};
    EXPECT_EQ(error_of([&] { run.need_memory(400, "it"); }), "");
    EXPECT_EQ(error_of([&] { run.need_memory(401, "it"); }),
              "limit: it needs 401 bytes of memory besides that in use; the limit is 1000 bytes | "
              "raise the limit with --max-memory");
    EXPECT_EQ(error_of([&] { run.need_memory(1001, "it"); }),
              "limit: it needs 1001 bytes of memory; the limit is 1000 bytes | raise the limit "
              "with --max-memory");
    const RunContext share = run.share_of_memory(4);
    EXPECT_EQ(error_of([&] { share.need_memory(100, "it"); }), "");
    EXPECT_NE(error_of([&] { share.need_memory(101, "it"); }), "");
    EXPECT_EQ(error_of([&] { run.share_of_memory(1).need_memory(400, "it"); }), "");
    EXPECT_NE(error_of([&] { run.share_of_memory(1).need_memory(401, "it"); }), "");
}

}  // namespace stipple::testing::run_context_test
