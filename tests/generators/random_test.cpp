// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "support/units.hpp"

using namespace stipple;
using namespace stipple::testing;

TEST(Random, AnyStartGivesTheSamePoints) {
    const PointSet whole = make("random", points(50, 3));
    const PointSet tail = make("random", points(30, 3, 20));
    EXPECT_TRUE(std::ranges::equal(tail.flat(), whole.flat().subspan(20 * 3)));
}
