// SPDX-License-Identifier: MIT
#include "math/arithmetic/double_double.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"

namespace stipple::testing::running_sums_test {

TEST(RunningSums, OfTenthsAreTheNearestDoubles) {
    const std::vector<double> tenths(1000, 0.1);
    const auto sums = running_sums(tenths);
    for (std::size_t i = 0; i < sums.size(); ++i)
        ASSERT_EQ(sums[i], static_cast<double>(static_cast<long double>(0.1) *
                                               static_cast<long double>(i + 1)));
}

TEST(RunningSums, RiseAndStandStillAtZeros) {
    const Rng rng(1);
    std::vector<double> numbers(10'000);
    rng.fill(0, numbers);
    for (std::size_t i = 0; i < numbers.size(); i += 3) numbers[i] = 0;
    for (std::size_t i = 1; i < numbers.size(); i += 5) numbers[i] *= 1e-17;
    const auto sums = running_sums(numbers);
    for (std::size_t i = 1; i < sums.size(); ++i) {
        ASSERT_GE(sums[i], sums[i - 1]);
        if (numbers[i] == 0) {
            ASSERT_EQ(sums[i], sums[i - 1]);
        }
    }
    EXPECT_EQ(running_sums(std::vector{0.0, 1.0, 1e-30, 0.0, 2.0}).back(), 3);
}

}  // namespace stipple::testing::running_sums_test
