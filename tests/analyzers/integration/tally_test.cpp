// SPDX-License-Identifier: MIT
#include "analyzers/integration/tally.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace stipple::testing::tally_test {

using stipple::analyzers::Tally;

namespace {

Tally of(std::initializer_list<double> numbers) {
    Tally tally;
    for (const double x : numbers) tally.add(x);
    return tally;
}

Tally together(Tally first, const Tally& second) {
    first.add(second);
    return first;
}

}  // namespace

TEST(Tally, MeanAndVarianceByHand) {
    const Tally tally = of({1, 2, 6});
    EXPECT_EQ(tally.count(), 3);
    EXPECT_EQ(tally.mean(), 3);
    EXPECT_DOUBLE_EQ(tally.variance(), 7);
    EXPECT_DOUBLE_EQ(tally.standard_error(), std::sqrt(7.0 / 3));
}

TEST(Tally, KeepsWhatRoundingWouldLose) {
    EXPECT_EQ(of({1e16, 1, -1e16}).mean(), 1.0 / 3);
    EXPECT_EQ(together(of({1e16, 1}), of({1, -1e16})).mean(), 0.5);
}

TEST(Tally, OfBlocksIsThatOfAll) {
    const Tally blocks = together(of({1, 2}), of({6}));
    EXPECT_EQ(blocks.mean(), 3);
    EXPECT_DOUBLE_EQ(blocks.variance(), 7);
    // All of the variance is between the blocks.
    EXPECT_DOUBLE_EQ(together(of({0, 0}), of({10, 10, 10, 10})).variance(), 80.0 / 3);
    EXPECT_DOUBLE_EQ(together(of({}), of({1, 2, 6})).variance(), 7);
    EXPECT_DOUBLE_EQ(together(of({1, 2, 6}), of({})).variance(), 7);
}

}  // namespace stipple::testing::tally_test
