// SPDX-License-Identifier: MIT
#include "math/exponential.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"

using namespace stipple;

namespace {

/// Distance in units in the last place of `expected`.
double ulps(double value, long double expected) {
    const auto near = static_cast<double>(expected);
    const double ulp = std::nextafter(near, INFINITY) - near;
    return static_cast<double>(std::abs(static_cast<long double>(value) - expected) / ulp);
}

}  // namespace

TEST(Exponential, IsWithinOneUnitInTheLastPlace) {
    const Rng rng(1);
    double worst = 0;
    for (std::uint64_t i = 0; i < 200'000; ++i) {
        const double u = rng.uniform(i);
        for (const double x : {-u, -40 * u, -708 * u, 709 * u, u * u * u * 1e-6})
            worst = std::max(worst, ulps(exponential(x), std::exp(static_cast<long double>(x))));
    }
    EXPECT_LE(worst, 1);
    EXPECT_GT(worst, 0.5);  // no rounding is perfect: the oracle is not the same code
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

// Printed: e = 2.71828 18284 59045 23536, e^-10 = 4.53999 29762 48485 15e-5.
TEST(Exponential, GivesPrintedValues) {
    EXPECT_DOUBLE_EQ(exponential(1), 2.71828182845904523536);
    EXPECT_DOUBLE_EQ(exponential(-10), 4.5399929762484851536e-5);
}
