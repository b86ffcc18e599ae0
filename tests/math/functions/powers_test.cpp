// SPDX-License-Identifier: MIT
#include "math/functions/powers.hpp"

#include <gtest/gtest.h>

namespace stipple::testing::powers_test {

constexpr std::uint64_t largest = ~std::uint64_t{0};

TEST(Powers, SaturateWhereTheyDoNotFit) {
    EXPECT_EQ(saturating_power(3, 4), 81U);
    EXPECT_EQ(saturating_power(0, 3), 0U);
    EXPECT_EQ(saturating_power(0, 0), 1U);
    EXPECT_EQ(saturating_power(1, 1'000'000), 1U);
    EXPECT_EQ(saturating_power(2, 63), std::uint64_t{1} << 63);
    EXPECT_EQ(saturating_power(2, 64), largest);
    EXPECT_EQ(saturating_power(largest, 1), largest);
}

TEST(Powers, FloorRootIsTheLargestThatFits) {
    for (const std::uint64_t value : {1ULL, 2ULL, 7ULL, 8ULL, 9ULL, 1023ULL, 1024ULL, 999'999ULL})
        for (const std::size_t exponent : {1, 2, 3, 5, 10}) {
            const std::uint64_t k = floor_root(value, exponent);
            EXPECT_LE(saturating_power(k, exponent), value) << value << " " << exponent;
            EXPECT_GT(saturating_power(k + 1, exponent), value) << value << " " << exponent;
        }
    EXPECT_EQ(floor_root(largest - 1, 1), largest - 1);
    EXPECT_EQ(floor_root(largest, 2), 0xffff'ffffU);
    EXPECT_EQ(floor_root(largest, 64), 1U);
    EXPECT_EQ(floor_root(largest, 63), 2U);
}

TEST(Powers, NearestPowerByHand) {
    EXPECT_EQ(nearest_power(1024, 1), 1024U);
    EXPECT_EQ(nearest_power(1024, 2), 1024U);
    EXPECT_EQ(nearest_power(1024, 3), 1000U);
    EXPECT_EQ(nearest_power(1024, 4), 1296U);
    EXPECT_EQ(nearest_power(1024, 7), 128U);
    EXPECT_EQ(nearest_power(1024, 1000), 1U);
}

TEST(Powers, RoundedRootByHand) {
    EXPECT_EQ(rounded_root(1), 1U);
    EXPECT_EQ(rounded_root(2), 1U);
    EXPECT_EQ(rounded_root(3), 2U);
    EXPECT_EQ(rounded_root(6), 2U);
    EXPECT_EQ(rounded_root(7), 3U);
    EXPECT_EQ(rounded_root(1000), 32U);
    EXPECT_EQ(rounded_root(std::uint64_t{1} << 53), 94906266U);  // sqrt = 94906265.62
}

TEST(Powers, OfRealNumbersByProducts) {
    EXPECT_EQ(whole_power(-1.5, 3), -3.375);
    EXPECT_EQ(whole_power(0, 0), 1);
    EXPECT_EQ(whole_power(2, 1000), 0x1p1000);
}

}  // namespace stipple::testing::powers_test
