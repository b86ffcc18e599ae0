// SPDX-License-Identifier: MIT
#include "stipple/points.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace stipple::testing::rows_test {

TEST(Rows, FreshRoomsTakeAsManyNumbersAsAskedForOnSmallAndLargePages) {
    for (const std::size_t count : {0U, 1U, 1000U, (1U << 19) - 1, 1U << 19, 1'234'567U}) {
        Rows rows = Rows::unwritten(count, 1);
        ASSERT_EQ(rows.numbers().size(), count);
        std::ranges::fill(rows.numbers(), 0.5);
        EXPECT_EQ(std::ranges::count(rows.numbers(), 0.5), static_cast<std::ptrdiff_t>(count));
    }
}

TEST(Rows, CopiesAreTheirOwnAndMovesLeaveNothing) {
    for (const bool fresh : {false, true}) {
        Rows rows = fresh ? Rows::unwritten(3, 1) : Rows(std::vector<double>(3));
        std::ranges::fill(rows.numbers(), 1.0);
        Rows copy = rows;
        copy.numbers()[0] = 2;
        EXPECT_EQ(rows.numbers()[0], 1);
        const double* const at = rows.numbers().data();
        Rows moved = std::move(rows);
        EXPECT_EQ(moved.numbers().data(), at);
        EXPECT_EQ(moved.numbers().size(), 3U);
        copy = std::move(moved);
        EXPECT_EQ(copy.numbers()[0], 1);
        EXPECT_EQ(copy.numbers().size(), 3U);
        copy = Rows();
        EXPECT_TRUE(copy.numbers().empty());
    }
}

}  // namespace stipple::testing::rows_test
