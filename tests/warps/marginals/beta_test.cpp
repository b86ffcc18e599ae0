// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::beta_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

// I_x(1, b) = 1 - (1-x)^b; I_x(a, 1) = x^a; I_x(2, 2) = 1/2 at 1/2; I_x(1/2, 1/2) = 1/4 at
// sin(pi / 8)^2.
TEST(BetaWarp, NumbersByHand) {
    EXPECT_NEAR(image_of("beta:a=1,b=3", {0.488, 0})[0], 0.2, 1e-15);
    EXPECT_NEAR(image_of("beta:a=3,b=1", {0.008, 0})[0], 0.2, 1e-15);
    EXPECT_EQ(image_of("beta", {0.5, 1}), (std::vector{0.5, 1.0}));
    EXPECT_NEAR(image_of("beta:a=0.5,b=0.5,low=-1,high=3", {0.25, 0})[0],
                -1 + 4 * std::pow(std::sin(std::numbers::pi / 8), 2), 1e-15);
}

TEST(BetaWarp, BothWaysAndDensity) {
    for (const char* spec : {"beta", "beta:a=0.5,b=0.5", "beta:a=[5,40],b=[1.5,200],low=-2"}) {
        expect_round_trip(*mapping(spec), 1e-13);
        expect_density_is_one_over_stretch(*mapping(spec));
    }
}

// If the density is infinite at an end, no point is at that end.
TEST(BetaWarp, PointsHaveADensity) {
    const auto map = mapping("beta:a=0.1,b=0.1");
    for (const double u : {1e-300, 1e-20, 1e-9, 0.5, one_minus_ulp}) {
        const auto x = image_of(*map, {u, u});
        EXPECT_TRUE(x[0] > 0 && x[0] < 1);
        EXPECT_TRUE(u < 1e-12 || std::isfinite(map->density(x)));
    }
}

// Mean a / (a + b), variance a b / ((a + b)^2 (a + b + 1)); the skewness for (1, 3) is 4 sqrt(5) /
// (6 sqrt(3)).
TEST(BetaWarp, MomentsByHand) {
    const auto m = *mapping("beta:a=1,b=3,high=4")->domain()->moments();
    EXPECT_DOUBLE_EQ(m.mean[0], 1);
    EXPECT_DOUBLE_EQ(m.covariance[0], 16 * 3 / 80.0);
    EXPECT_DOUBLE_EQ(m.skewness[0], 4 * std::sqrt(5) / (6 * std::sqrt(3)));
}

TEST(BetaWarp, RefusesShapesOutOfRange) {
    EXPECT_EQ(refusal("beta:a=0"), "usage: --a: 0 is outside [0.05, 1000000]");
    EXPECT_EQ(refusal("beta:low=2"), "usage: --low: 2 is not below --high, 1");
}

}  // namespace stipple::testing::beta_test
