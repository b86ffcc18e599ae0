// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::weibull_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

TEST(WeibullWarp, NumbersByHand) {
    EXPECT_DOUBLE_EQ(image_of("weibull", {0.5, 0.75})[0], std::sqrt(std::numbers::ln2));
    EXPECT_DOUBLE_EQ(image_of("weibull:shape=0.5,scale=3", {0.75, 0})[0],
                     3 * std::pow(2 * std::numbers::ln2, 2));
    EXPECT_DOUBLE_EQ(image_of("weibull:scale=7", {1 - 1 / std::numbers::e, 0})[0], 7);
}

TEST(WeibullWarp, BothWaysAndDensity) {
    for (const char* spec : {"weibull", "weibull:shape=[0.7,20],scale=[2,0.1]"}) {
        expect_round_trip(*mapping(spec), 1e-11);
        expect_density_is_one_over_stretch(*mapping(spec), 2e-6);
    }
}

// Shape 2 is Rayleigh's distribution: mean sqrt(pi) / 2, variance 1 - pi / 4.
TEST(WeibullWarp, MomentsOfRayleighs) {
    const auto m = *mapping("weibull")->domain()->moments();
    EXPECT_NEAR(m.mean[0], std::sqrt(std::numbers::pi) / 2, 1e-10);
    EXPECT_NEAR(m.covariance[0], 1 - std::numbers::pi / 4, 1e-10);
    EXPECT_NEAR(m.skewness[0], 0.63111, 1e-5);
}

TEST(WeibullWarp, RefusesShapesOutOfRange) {
    EXPECT_EQ(refusal("weibull:shape=0"), "usage: --shape: 0 is outside [0.05, 1000]");
}

}  // namespace stipple::testing::weibull_test
