// SPDX-License-Identifier: MIT
#include "core/zeros.hpp"

#include <gtest/gtest.h>

#include <algorithm>

using namespace stipple;

TEST(Zeros, AreAsManyAsAskedForOnSmallAndLargePages) {
    for (const std::size_t count : {0U, 1U, 1000U, (1U << 19) - 1, 1U << 19, 1'234'567U}) {
        const std::vector<double> numbers = zeros(count);
        EXPECT_EQ(numbers.size(), count);
        EXPECT_TRUE(std::ranges::all_of(numbers, [](double x) { return x == 0; })) << count;
    }
}
