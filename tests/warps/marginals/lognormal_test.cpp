// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::lognormal_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

TEST(LognormalWarp, IsTheExponentialOfTheNormal) {
    const auto normal = mapping("normal:mean=2,deviation=0.5");
    const auto map = mapping("lognormal:mu=2,sigma=0.5");
    for (const double u : {1e-300, 0.01, 0.3, 0.5, 0.99})
        EXPECT_NEAR(std::log(image_of(*map, {u, u})[0]), image_of(*normal, {u, u})[0], 1e-14);
    EXPECT_EQ(image_of("lognormal", {0.5, 0.5}), (std::vector{1.0, 1.0}));
    EXPECT_EQ(image_of(*map, {0, 0})[0], 0);
}

TEST(LognormalWarp, ByItsOwnMeanAndDeviation) {
    const auto m = *mapping("lognormal:mean=[5,1],deviation=[2,0.01]")->domain()->moments();
    EXPECT_NEAR(m.mean[0], 5, 1e-13);
    EXPECT_NEAR(m.covariance[0], 4, 1e-12);
    EXPECT_NEAR(m.covariance[3], 1e-4, 1e-15);
}

TEST(LognormalWarp, BothWaysAndDensity) {
    expect_round_trip(*mapping("lognormal"), 1e-10);
    expect_density_is_one_over_stretch(*mapping("lognormal:mu=[0,1],sigma=[0.3,1]"));
    EXPECT_EQ(mapping("lognormal")->density(std::vector{-1.0, 1.0}), 0);
}

TEST(LognormalWarp, RefusesHalfAPair) {
    EXPECT_EQ(refusal("lognormal:mean=2"), "usage: --mean: --deviation is needed as well");
    EXPECT_EQ(refusal("lognormal:mean=2,deviation=1,sigma=1"),
              "usage: --mean: cannot be combined with --mu or --sigma; give mu and sigma, or mean "
              "and deviation");
}

}  // namespace stipple::testing::lognormal_test
