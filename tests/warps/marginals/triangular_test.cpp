// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::triangular_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

// From 0 to 2 with the mode at 1/2: F(1/2) = 1/4, F(x) = x^2 below, 1 - (2 - x)^2 / 3 beyond.
TEST(TriangularWarp, NumbersByHand) {
    const char* const spec = "triangular:high=2";
    EXPECT_EQ(image_of(spec, {0.25, 0.0625}), (std::vector{0.5, 0.25}));
    EXPECT_EQ(image_of(spec, {0, 1}), (std::vector{0.0, 2.0}));
    EXPECT_DOUBLE_EQ(image_of(spec, {0.5, 0})[0], 2 - std::sqrt(1.5));
    EXPECT_DOUBLE_EQ(mapping(spec)->density(std::vector{0.5, 1.25}), 1 * 0.5);
}

TEST(TriangularWarp, IsTheTentWhereTheModeIsInTheMiddle) {
    const auto tent = mapping("tent");
    const auto map = mapping("triangular:low=-1,mode=0,high=1");
    const PointSet cube = telling_points();
    for (std::size_t i = 0; i < cube.count(); ++i) {
        const auto a = image_of(*tent, {cube[i][0], cube[i][1]});
        const auto b = image_of(*map, {cube[i][0], cube[i][1]});
        ASSERT_NEAR(a[0], b[0], 1e-15);
        ASSERT_NEAR(a[1], b[1], 1e-15);
    }
}

TEST(TriangularWarp, BothWaysAndDensity) {
    for (const char* spec : {"triangular", "triangular:mode=0", "triangular:mode=1",
                             "triangular:low=[-5,0],mode=[-4.5,0.5],high=[7,1]"}) {
        expect_round_trip(*mapping(spec), 1e-13);
        expect_density_is_one_over_stretch(*mapping(spec));
    }
}

TEST(TriangularWarp, RefusesAModeOutside) {
    EXPECT_EQ(refusal("triangular:mode=2"), "usage: --mode: 2 is outside [0, 1]");
    EXPECT_EQ(refusal("triangular:low=1"), "usage: --low: 1 is not below --high, 1");
}

}  // namespace stipple::testing::triangular_test
