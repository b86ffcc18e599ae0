// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/geometry/ball_volume.hpp"

namespace stipple::testing::ball_volume_test {

// The volumes of the first three have the bits of their usual formulas, on which reports rely.
TEST(BallVolume, IsThatOfTheUsualFormulas) {
    EXPECT_EQ(unit_ball_volume(1), 2);
    EXPECT_EQ(unit_ball_volume(2), std::numbers::pi);
    EXPECT_EQ(unit_ball_volume(3), 4. / 3 * std::numbers::pi);
    for (int d = 1; d <= 100; ++d) {
        const double other = std::pow(std::numbers::pi, d / 2.0) / std::tgamma(d / 2.0 + 1);
        EXPECT_NEAR(unit_ball_volume(static_cast<std::size_t>(d)) / other, 1, 1e-13) << d;
    }
}

}  // namespace stipple::testing::ball_volume_test
