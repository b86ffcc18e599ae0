// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::binomial_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

// Two coins: 1/4, 1/2, 1/4.
TEST(BinomialWarp, NumbersByHand) {
    const auto map = mapping("binomial:trials=2");
    EXPECT_EQ(image_of(*map, {0, 0.25}), (std::vector{0.0, 1.0}));
    EXPECT_EQ(image_of(*map, {std::nextafter(0.75, 0), 0.75}), (std::vector{1.0, 2.0}));
    EXPECT_EQ(image_of("binomial:trials=[1,3],probability=[0.3,0.9]", {0.69, 0.002}),
              (std::vector{0.0, 1.0}));
    EXPECT_EQ(map->domain()->measure(), 9);
}

TEST(BinomialWarp, BothWaysAndItsMoments) {
    expect_round_trip(*mapping("binomial"), 0);
    expect_round_trip(*mapping("binomial:trials=1000,probability=0.001"), 0);
    const auto m = *mapping("binomial:trials=20,probability=0.1")->domain()->moments();
    EXPECT_NEAR(m.mean[0], 2, 1e-14);
    EXPECT_NEAR(m.covariance[0], 1.8, 1e-14);
    EXPECT_NEAR(m.skewness[0], 0.8 / std::sqrt(1.8), 1e-14);
}

TEST(BinomialWarp, RefusesWhatIsNoProbability) {
    EXPECT_EQ(refusal("binomial:probability=1.5").substr(0, 43),
              "usage: --probability: 1.5 is outside [1e-12");
    EXPECT_EQ(refusal("binomial:trials=1.5"), "usage: --trials: 1.5 is not a whole number");
}

}  // namespace stipple::testing::binomial_test
