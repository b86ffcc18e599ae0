// SPDX-License-Identifier: MIT
#include "math/combinatorics/combinations.hpp"

#include <gtest/gtest.h>

namespace stipple::testing::combinations_test {

TEST(Combinations, BinomialsByHand) {
    EXPECT_EQ(binomial(5, 0), 1);
    EXPECT_EQ(binomial(5, 2), 10);
    EXPECT_EQ(binomial(5, 6), 0);
    EXPECT_EQ(binomial(52, 5), 2'598'960);
    EXPECT_EQ(binomial(67, 33), 14'226'520'737'620'288'370U);  // the largest C(n, n/2) that fits
    EXPECT_EQ(binomial(68, 34), ~std::uint64_t{0});
    EXPECT_EQ(binomial(1'000'000, 500'000), ~std::uint64_t{0});
}

TEST(Combinations, ByTheLargestThenTheNextOne) {
    const std::vector<Combination> pairs = {{0, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 3}, {2, 3}};
    for (std::size_t i = 0; i < pairs.size(); ++i) EXPECT_EQ(combination(i, 2), pairs[i]);
}

TEST(Combinations, NumbersLeadThereAndBack) {
    for (const std::size_t size : {1, 2, 3, 5}) {
        Combination walked = combination(0, size);
        for (std::uint64_t number = 0; number < 300; ++number) {
            EXPECT_EQ(combination(number, size), walked) << number;
            EXPECT_EQ(combination_number(walked), number);
            next_combination(walked);
        }
    }
}

}  // namespace stipple::testing::combinations_test
