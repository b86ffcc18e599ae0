// SPDX-License-Identifier: MIT
#include "core/run_context.hpp"

#include <gtest/gtest.h>

#include <vector>

using namespace stipple;

// Stages lie one behind the other, and what goes beyond its own end stays at it.
TEST(RunContext, StageIsAPartOfTheProgress) {
    std::vector<double> seen;
    RunContext run;
    run.progress = [&](double done) { seen.push_back(done); };
    run.stage(0, 0.25).tick(1, 2);
    run.stage(0.25, 1).tick(0, 3);
    run.stage(0.25, 1).tick(3, 3);
    EXPECT_EQ(seen, (std::vector<double>{0.125, 0.25, 1}));
    RunContext{}.stage(0, 1).tick(1, 1);  // nobody listens
}
