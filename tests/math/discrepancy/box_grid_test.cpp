// SPDX-License-Identifier: MIT
#include "math/discrepancy/box_grid.hpp"

#include <gtest/gtest.h>

namespace stipple::testing::box_grid_test {

using namespace stipple::discrepancy;

// By the definition, rank by rank: above the lower end and below the upper one; if the interval
// wraps around, either of these.
TEST(BoxGrid, RanksBetweenTwoEndsAreTheDefinitions) {
    for (const Side side : {Side::open, Side::closed})
        for (const bool wraps : {false, true})
            for (std::uint32_t lower = 0; lower < 5; ++lower)
                for (std::uint32_t upper = 0; upper < 5; ++upper) {
                    const RankSet inside = ranks_between({lower, upper}, side, wraps);
                    for (std::uint32_t rank = 0; rank < 5; ++rank) {
                        const bool open = side == Side::open;
                        const bool above = open ? rank > lower : rank >= lower;
                        const bool below = open ? rank < upper : rank <= upper;
                        EXPECT_EQ(inside.contains(rank), wraps ? above || below : above && below)
                            << rank << " in " << lower << ", " << upper << ", open " << open
                            << ", wraps " << wraps;
                    }
                }
}

// An anchored interval includes 0.
TEST(BoxGrid, AnchoredIntervalsBeginWithTheirLowerFace) {
    const stipple::PointSet points({0, 0.25, 0.5}, 1);
    const BoxGrid grid = box_grid(points, Family::anchored, {});
    EXPECT_EQ(grid.values[0], (std::vector<double>{0, 0.25, 0.5, 1}));
    EXPECT_EQ(grid.length(0, {0, 2}, Side::open), 0.5);
    EXPECT_TRUE(grid.inside({0, 2}, Side::open).contains(0));
    EXPECT_FALSE(grid.inside({0, 2}, Side::open).contains(2));
    EXPECT_TRUE(grid.inside({0, 2}, Side::closed).contains(2));
    EXPECT_FALSE(grid.inside({0, 2}, Side::closed).contains(3));
}

}  // namespace stipple::testing::box_grid_test
