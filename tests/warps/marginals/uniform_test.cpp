// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::uniform_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

TEST(UniformWarp, NumbersByHand) {
    EXPECT_EQ(image_of("uniform", {0.25, 0.5}), (std::vector{0.25, 0.5}));
    EXPECT_EQ(image_of("uniform:low=[-1,10],high=[3,20]", {0.25, 0.5}), (std::vector{0.0, 15.0}));
    EXPECT_EQ(image_of("uniform:low=-3,high=0", {0, 1}), (std::vector{-3.0, 0.0}));
}

TEST(UniformWarp, BothWaysAndItsDomain) {
    const auto map = mapping("uniform:low=[-1,10],high=[3,20]");
    expect_round_trip(*map, 1e-14);
    EXPECT_EQ(map->domain()->measure(), 40);
    EXPECT_EQ(map->density(std::vector{0.0, 12.0}), 1 / 40.0);
    EXPECT_EQ(map->density(std::vector{4.0, 12.0}), 0);
    EXPECT_EQ(map->domain()->spec(), "uniform:low=[-1,10],high=[3,20]");
    EXPECT_EQ(map->domain()->bounding_box(), (Box{{-1, 10}, {3, 20}}));
    EXPECT_EQ(map->domain()->cube_axes()[1], "probability below x of x2");
}

TEST(UniformWarp, RefusesEndsOutOfOrder) {
    EXPECT_EQ(refusal("uniform:low=2"), "usage: --low: 2 is not below --high, 1");
    EXPECT_EQ(refusal("uniform:low=[0,1,2],high=[4,5]"),
              "usage: --high: 2 numbers for 3 coordinates; expected one for all, or one for each");
    EXPECT_EQ(refusal("uniform:high=1e200"), "usage: --high: 1e+200 is outside [-1e+150, 1e+150]");
}

}  // namespace stipple::testing::uniform_test
