// SPDX-License-Identifier: MIT
#include "math/functions/logarithm.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"
#include "support/ulps.hpp"

namespace stipple::testing::real_power_test {

using stipple::testing::ulps;

TEST(RealPower, IsWithinTwoUnitsInTheLastPlace) {
    const Rng rng(1);
    double worst = 0;
    for (std::uint64_t i = 0; i < 10'000; ++i) {
        const double u = rng.uniform(2 * i);
        const double v = rng.uniform(2 * i + 1);
        for (const double x : {u, 0.5 + u, std::exp(1400 * u - 700), 1 + 1e-12 * u}) {
            const double steepest = 700 / std::abs(std::log(x));
            for (const double y : {v, 1 / (1 + 20 * v), -2 * v, (2 * v - 1) * steepest}) {
                const long double expected =
                    std::pow(static_cast<long double>(x), static_cast<long double>(y));
                if (x != 1 && expected > 1e-306L && expected < 1e307L)
                    worst = std::max(worst, ulps(real_power(x, y), expected));
            }
        }
    }
    EXPECT_LE(worst, 2);
    EXPECT_GT(worst, 0.5);
}

TEST(RealPower, KnowsItsEnds) {
    EXPECT_EQ(real_power(0, 0.5), 0);
    EXPECT_EQ(real_power(0, 0), 1);
    EXPECT_EQ(real_power(0, -1), INFINITY);
    EXPECT_EQ(real_power(5, 0), 1);
    EXPECT_EQ(real_power(1, 1e300), 1);
    EXPECT_EQ(real_power(1, -1e300), 1);
    EXPECT_EQ(real_power(0.5, 1e300), 0);
    EXPECT_EQ(real_power(2, 1e300), INFINITY);
    EXPECT_EQ(real_power(1e-300, 2), 0);
    EXPECT_EQ(real_power(5e-324, 1), 0) << "below exp(-708)";
    EXPECT_DOUBLE_EQ(real_power(5e-324, 0.5), 2.2227587494850775e-162);
}

// Squares, roots and reciprocals that are exact, and 10^0.3 = 1.99526 23149 68879 60135.
TEST(RealPower, GivesKnownValues) {
    EXPECT_EQ(real_power(3, 2), 9);
    EXPECT_EQ(real_power(6.25, 0.5), 2.5);
    EXPECT_EQ(real_power(0.125, -1), 8);
    EXPECT_DOUBLE_EQ(real_power(10, 0.3), 1.99526231496887960135);
}

}  // namespace stipple::testing::real_power_test
