// SPDX-License-Identifier: MIT
#include "core/large_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>

using namespace stipple;

TEST(LargeMemory, IsAllZerosAtAnySize) {
    for (const std::size_t count : {0U, 1U, 1000U, (1U << 19) - 1, 1U << 19, (1U << 20) + 513}) {
        std::vector<double> numbers = zeros(count);
        ASSERT_EQ(numbers.size(), count);
        EXPECT_TRUE(std::ranges::all_of(numbers, [](double x) { return x == 0; })) << count;
        std::ranges::fill(numbers, 1.0);
        EXPECT_EQ(std::ranges::count(zeros(count), 0.0), static_cast<std::ptrdiff_t>(count));
    }
}
