// SPDX-License-Identifier: MIT
#include "math/functions/exponential.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"
#include "support/ulps.hpp"

namespace stipple::testing::exponential_test {

using stipple::testing::ulps;

TEST(Exponential, IsWithinOneUnitInTheLastPlace) {
    const Rng rng(1);
    double worst = 0;
    for (std::uint64_t i = 0; i < 40'000; ++i) {
        const double u = rng.uniform(i);
        for (const double x : {-u, -40 * u, -708 * u, 709 * u, u * u * u * 1e-6})
            worst = std::max(worst, ulps(exponential(x), std::exp(static_cast<long double>(x))));
    }
    EXPECT_LE(worst, 1);
    // No rounding is perfect; 0.5 would mean that the oracle is the same code.
    EXPECT_GT(worst, 0.5);
}

TEST(Exponential, KnowsItsEnds) {
    EXPECT_EQ(exponential(0), 1);
    EXPECT_EQ(exponential(-0.0), 1);
    EXPECT_EQ(exponential(-708.5), 0);
    EXPECT_EQ(exponential(-1e300), 0);
    EXPECT_EQ(exponential(-INFINITY), 0);
    EXPECT_GT(exponential(-708), 0);
    EXPECT_TRUE(std::isfinite(exponential(709)));
    EXPECT_EQ(exponential(1e-300), 1);
}

// From tables: e = 2.71828 18284 59045 23536, e^-10 = 4.53999 29762 48485 15e-5.
TEST(Exponential, GivesPrintedValues) {
    EXPECT_DOUBLE_EQ(exponential(1), 2.71828182845904523536);
    EXPECT_DOUBLE_EQ(exponential(-10), 4.5399929762484851536e-5);
}

TEST(ExpMinusOne, IsWithinTwoUnitsInTheLastPlace) {
    const Rng rng(2);
    double worst = 0;
    for (std::uint64_t i = 0; i < 40'000; ++i) {
        const double u = rng.uniform(i);
        for (const double x : {-u, u, -40 * u, 709 * u, 1e-6 * u, -1e-17 * u, 1e-300 * u})
            worst = std::max(worst, ulps(exp_minus_1(x), std::expm1(static_cast<long double>(x))));
    }
    EXPECT_LE(worst, 2);
    EXPECT_GT(worst, 0.5);
}

TEST(ExpMinusOne, KnowsItsEnds) {
    EXPECT_EQ(exp_minus_1(0), 0);
    EXPECT_EQ(exp_minus_1(5e-324), 5e-324);
    EXPECT_EQ(exp_minus_1(-708), -1);
    EXPECT_EQ(exp_minus_1(-1e300), -1);
    EXPECT_TRUE(std::isfinite(exp_minus_1(709)));
}

}  // namespace stipple::testing::exponential_test
