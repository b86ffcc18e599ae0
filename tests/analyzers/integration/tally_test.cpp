// SPDX-License-Identifier: MIT
#include "analyzers/integration/tally.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Tally, DeviationsWhoseSquaresLeaveFloat64) {
    for (const double unit : {0x1p-900, 0x1p-500, 0x1p500, 0x1p900}) {
        const Tally tally = of({1 * unit, 2 * unit, 6 * unit});
        EXPECT_DOUBLE_EQ(tally.deviation() / unit, std::sqrt(7.0));
        EXPECT_DOUBLE_EQ(tally.standard_error() / unit, std::sqrt(7.0 / 3));
        EXPECT_DOUBLE_EQ(together(of({unit, 2 * unit}), of({6 * unit})).deviation() / unit,
                         std::sqrt(7.0));
        EXPECT_DOUBLE_EQ(together(of({0, 0}), of({unit, 2 * unit})).deviation() / unit,
                         std::sqrt(11.0 / 12));
        EXPECT_DOUBLE_EQ(of({1, 2, 6, unit < 1 ? unit : 1}).deviation(),
                         of({1, 2, 6, unit < 1 ? 0.0 : 1}).deviation());
        EXPECT_DOUBLE_EQ(of({unit, 1, unit}).deviation(),
                         of({std::max(unit, 0x1p-60), 1, unit}).deviation());
    }
    EXPECT_EQ(of({0, 0, 0}).deviation(), 0);
}

}  // namespace stipple::testing::tally_test
