// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::exponential_test {

TEST(ExponentialWarp, NumbersByHand) {
    const auto map = mapping("exponential");
    EXPECT_EQ(image_of(*map, {0, 0}), (std::vector{0.0, 0.0}));
    EXPECT_FALSE(std::signbit(image_of(*map, {0, 0})[0]));
    const auto p = image_of(*map, {0.5, 0.75});
    EXPECT_DOUBLE_EQ(p[0], std::numbers::ln2);
    EXPECT_DOUBLE_EQ(p[1], 2 * std::numbers::ln2);
    const auto ends = image_of(*mapping("exponential:rate=[2,4]"), {one_minus_ulp, 1});
    EXPECT_DOUBLE_EQ(ends[0], 53 * std::numbers::ln2 / 2);
    EXPECT_DOUBLE_EQ(ends[1], 55 * std::numbers::ln2 / 4) << "xi = 1 counts as 1 - 2^-55";
}

TEST(ExponentialWarp, RoundTripOverTheWholeSquare) {
    expect_round_trip(*mapping("exponential"), 4e-14);
    expect_round_trip(*mapping("exponential:rate=[1e-3,1e9]"), 4e-11);
}

TEST(ExponentialWarp, UnitCoordinatesComeBackAlsoTinyOnes) {
    const auto map = mapping("exponential:rate=3");
    const PointSet cube = telling_points();
    for (std::size_t i = 0; i < cube.count(); ++i) {
        const auto back = inverse_of(*map, image_of(*map, {cube[i][0], cube[i][1]}));
        if (cube[i][0] < 1 && cube[i][0] > 1e-307) {
            ASSERT_NEAR(back[0] / cube[i][0], 1, 1e-14) << cube[i][0];
        }
    }
}

TEST(ExponentialWarp, DensityIsOneOverTheStretch) {
    expect_density_is_one_over_stretch(*mapping("exponential:rate=[2,0.5]"));
    const auto map = mapping("exponential:rate=2");
    EXPECT_DOUBLE_EQ(map->density(std::vector{0.0, 0.0}), 4);
    EXPECT_DOUBLE_EQ(map->density(std::vector{1.0, 0.5}), 4 * std::exp(-3));
    EXPECT_EQ(map->density(std::vector{-0.1, 0.5}), 0);
}

// Mean and standard deviation are 1 / rate. 1e5 points: 5 standard errors are 0.008 and, for the
// second moment 2 / rate^2, 0.018: false alarm 1e-6 each.
TEST(ExponentialWarp, MomentsAreRight) {
    const PointSet x = warped(*mapping("exponential:rate=2"), make("random", points(50'000, 2)));
    double first = 0, second = 0;
    for (const double v : x.flat()) {
        first += v / 1e5;
        second += v * v / 1e5;
    }
    EXPECT_NEAR(first, 0.5, 0.008);
    EXPECT_NEAR(second, 0.5, 0.018);
}

// False alarm 1e-4 each.
TEST(ExponentialWarp, ChiSquareAcceptsItAndRejectsAWrongRate) {
    const auto map = mapping("exponential:rate=2");
    EXPECT_GT(p_of_random(*map, 100'000), 1e-4);
    PointSet wrong = warped(*map, make("random", points(100'000, 2)));
    for (double& x : wrong.flat()) x *= 1.06;
    EXPECT_LT(measure("chi-square", "p_upper", wrong), 1e-4);
}

TEST(ExponentialWarp, DomainSaysWhatItIs) {
    const DomainPtr law = mapping("exponential:rate=[2,4]")->domain();
    EXPECT_EQ(law->spec(), "exponential:rate=[2,4]");
    EXPECT_EQ(law->measure(), std::numeric_limits<double>::infinity());
    EXPECT_FALSE(law->contains(std::vector{1.0, -1e-9}));
    EXPECT_FALSE(law->contains(std::vector{1.0, double{INFINITY}}));
    EXPECT_FALSE(law->contains(std::vector{1.0, double{NAN}}));
    EXPECT_EQ(law->bounding_box(), (Box{{0, 0}, {5, 2.5}}));
}

TEST(ExponentialWarp, RefusesRatesOutOfRange) {
    EXPECT_EQ(error_of([] { mapping("exponential:rate=0"); }),
              "usage: --rate: 0 is outside [1e-150, 1e+150]");
    EXPECT_EQ(error_of([] { mapping("exponential:rate=[1,-2]"); }),
              "usage: --rate: -2 is outside [1e-150, 1e+150]");
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping("exponential"), {-1, 2});
              }),
              "input: the point (-1, 2) is outside the domain exponential");
}

}  // namespace stipple::testing::exponential_test
