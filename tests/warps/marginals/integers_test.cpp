// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::integers_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

TEST(IntegersWarp, ADieByHand) {
    EXPECT_EQ(image_of("integers", {0, 0.5}), (std::vector{1.0, 4.0}));
    EXPECT_EQ(image_of("integers", {one_minus_ulp, 1}), (std::vector{6.0, 6.0}));
    EXPECT_EQ(image_of("integers:low=[-3,7],high=[-1,7]", {0.5, 0.9}), (std::vector{-2.0, 7.0}));
}

TEST(IntegersWarp, StrataGiveEachNumberAsOften) {
    const PointSet grid = warped(*mapping("integers:high=4"), make("grid", points(64, 2)));
    std::vector<int> counts(17);
    for (std::size_t i = 0; i < grid.count(); ++i)
        ++counts[static_cast<std::size_t>(4 * grid[i][0] + grid[i][1] - 5)];
    for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(counts[k], 4);
}

TEST(IntegersWarp, BothWaysAndItsDomain) {
    const auto map = mapping("integers");
    expect_round_trip(*map, 0);
    expect_round_trip(*mapping("integers:low=-1e15,high=1e15"), 0.5);
    EXPECT_EQ(map->domain()->measure(), 36);
    EXPECT_EQ(map->density(std::vector{2.0, 6.0}), 1 / 36.0);
    EXPECT_FALSE(map->domain()->contains(std::vector{2.5, 6.0}));
    EXPECT_DOUBLE_EQ(inverse_of(*map, {1, 4})[1], 3.5 / 6);
    const auto m = *map->domain()->moments();
    EXPECT_EQ(m.mean[0], 3.5);
    EXPECT_DOUBLE_EQ(m.covariance[0], 35 / 12.0);
}

TEST(IntegersWarp, RefusesWhatIsNoRange) {
    EXPECT_EQ(refusal("integers:low=9"), "usage: --low: 9 is above --high, 6");
    EXPECT_EQ(refusal("integers:low=0.5"), "usage: --low: 0.5 is not a whole number");
}

}  // namespace stipple::testing::integers_test
