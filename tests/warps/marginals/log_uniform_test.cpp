// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::log_uniform_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

TEST(LogUniformWarp, NumbersByHand) {
    const auto p = image_of("log-uniform:low=0.01,high=100", {0.5, 0.75});
    EXPECT_DOUBLE_EQ(p[0], 1);
    EXPECT_DOUBLE_EQ(p[1], 10);
    EXPECT_EQ(image_of("log-uniform:low=3,high=7", {0, 1}), (std::vector{3.0, 7.0}));
}

TEST(LogUniformWarp, BothWaysAndDensity) {
    expect_round_trip(*mapping("log-uniform:low=[1e-3,2],high=[1e3,2.001]"), 1e-11);
    expect_density_is_one_over_stretch(*mapping("log-uniform:low=2,high=5"));
    EXPECT_DOUBLE_EQ(mapping("log-uniform")->density(std::vector{2.0, 2.0}),
                     std::pow(0.5 / std::log(10), 2));
}

// E x = (b - a) / log(b / a), E x^2 = (b^2 - a^2) / (2 log(b / a)).
TEST(LogUniformWarp, MomentsByHand) {
    const auto m = *mapping("log-uniform:low=1,high=100")->domain()->moments();
    const double mean = 99 / std::log(100);
    EXPECT_NEAR(m.mean[0], mean, 1e-8);
    EXPECT_NEAR(m.covariance[0], 9999 / (2 * std::log(100)) - mean * mean, 1e-6);
}

TEST(LogUniformWarp, RefusesWhatIsNotAbove0) {
    EXPECT_EQ(refusal("log-uniform:low=0"), "usage: --low: 0 is outside [1e-150, 1e+150]");
    EXPECT_EQ(refusal("log-uniform:low=10"), "usage: --low: 10 is not below --high, 10");
}

}  // namespace stipple::testing::log_uniform_test
