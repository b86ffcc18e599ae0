// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::gamma_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

TEST(GammaWarp, OfShape1IsExponential) {
    const auto a = mapping("gamma:shape=1,scale=0.5");
    const auto b = mapping("exponential:rate=2");
    for (const double u : {1e-300, 1e-9, 0.1, 0.5, 0.999, one_minus_ulp})
        EXPECT_NEAR(image_of(*a, {u, u})[0] / image_of(*b, {u, u})[0], 1, 1e-14) << u;
    EXPECT_EQ(image_of(*a, {0, 0})[0], 0);
}

// Half the square of a normal variable: P(1/2, x) = erf(sqrt(x)).
TEST(GammaWarp, OfShapeOneHalfIsTheSquareOfTheNormal) {
    const auto map = mapping("gamma:shape=0.5,scale=2");
    for (const double u : {0.01, 0.5, 0.99}) {
        const double z = image_of("normal", {0.5 + u / 2, 0.5})[0];
        EXPECT_NEAR(image_of(*map, {u, u})[0] / (z * z), 1, 1e-14);
    }
}

TEST(GammaWarp, BothWaysAndDensity) {
    for (const char* spec : {"gamma", "gamma:shape=[0.3,50],scale=[2,0.1]"}) {
        expect_round_trip(*mapping(spec), 1e-12);
        expect_density_is_one_over_stretch(*mapping(spec), 2e-6);
    }
    const auto m = *mapping("gamma:shape=4,scale=3")->domain()->moments();
    EXPECT_EQ(m.mean[0], 12);
    EXPECT_EQ(m.covariance[0], 36);
    EXPECT_EQ(m.skewness[0], 1);
}

TEST(GammaWarp, RefusesShapesOutOfRange) {
    EXPECT_EQ(refusal("gamma:shape=[1,0]"), "usage: --shape: 0 is outside [0.05, 1000000]");
    EXPECT_EQ(refusal("gamma:scale=-1"), "usage: --scale: -1 is outside [1e-100, 1e+100]");
}

}  // namespace stipple::testing::gamma_test
