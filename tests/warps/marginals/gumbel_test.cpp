// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::gumbel_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

TEST(GumbelWarp, NumbersByHand) {
    EXPECT_DOUBLE_EQ(image_of("gumbel", {0.5, 0.5})[0], -std::log(std::numbers::ln2));
    EXPECT_NEAR(image_of("gumbel:location=5,scale=2", {1 / std::numbers::e, 0})[0], 5, 1e-15);
    EXPECT_DOUBLE_EQ(image_of("gumbel", {1e-300, 0})[0], -std::log(300 * std::log(10)));
}

TEST(GumbelWarp, BothWaysAndDensity) {
    for (const char* spec : {"gumbel", "gumbel:location=[-3,10],scale=[2,0.1]"}) {
        expect_round_trip(*mapping(spec), 1e-11);
        expect_density_is_one_over_stretch(*mapping(spec), 2e-6);
    }
    const auto m = *mapping("gumbel:location=1,scale=2")->domain()->moments();
    EXPECT_DOUBLE_EQ(m.mean[0], 1 + 2 * std::numbers::egamma);
    EXPECT_DOUBLE_EQ(m.covariance[0], 4 * std::numbers::pi * std::numbers::pi / 6);
}

// 0 is replaced by 2^-54 and 1 by 1 - 2^-55, with a note.
TEST(GumbelWarp, EndlessTailsEndWhereRandomNumbersDo) {
    const auto map = mapping("gumbel");
    const auto ends = image_of(*map, {0, 1});
    EXPECT_DOUBLE_EQ(ends[0], -std::log(54 * std::numbers::ln2));
    EXPECT_DOUBLE_EQ(ends[1], 55 * std::numbers::ln2);
    EXPECT_TRUE(map->infinite(std::vector{0.0, 0.5}));
    EXPECT_TRUE(map->infinite(std::vector{0.5, 1.0}));
    EXPECT_FALSE(map->infinite(std::vector{0.5, 0.5}));
}

TEST(GumbelWarp, RefusesAScaleOf0) {
    EXPECT_EQ(refusal("gumbel:scale=0"), "usage: --scale: 0 is outside [1e-100, 1e+100]");
}

}  // namespace stipple::testing::gumbel_test
