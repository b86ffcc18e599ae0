// SPDX-License-Identifier: MIT
#include "math/functions/logarithm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/rng.hpp"
#include "support/ulps.hpp"

namespace stipple::testing::logarithm_test {

using stipple::testing::ulps;

TEST(Logarithm, IsWithinOneUnitInTheLastPlace) {
    const Rng rng(1);
    double worst = 0;
    for (std::uint64_t i = 0; i < 40'000; ++i) {
        const double u = rng.uniform(2 * i);
        const double narrow = std::ldexp(u - 0.5, -static_cast<int>(50 * rng.uniform(2 * i + 1)));
        for (const double x : {0.5 + u, std::exp(1400 * u - 700), 1 + narrow, 1e-308 * u})
            if (x != 1 && x > 0)
                worst = std::max(worst, ulps(logarithm(x), std::log(static_cast<long double>(x))));
    }
    EXPECT_LE(worst, 1);
    // No rounding is perfect; 0.5 would mean that the oracle is the same code.
    EXPECT_GT(worst, 0.5);
}

TEST(Logarithm, KnowsItsEnds) {
    EXPECT_EQ(logarithm(1), 0);
    EXPECT_FALSE(std::signbit(logarithm(1)));
    EXPECT_EQ(logarithm(std::nextafter(1, 2)), 0x1p-52 - 0x1p-105);
    EXPECT_EQ(logarithm(std::nextafter(1, 0)), -0x1p-53);
    EXPECT_DOUBLE_EQ(logarithm(5e-324), -744.4400719213812);
    EXPECT_DOUBLE_EQ(logarithm(std::numeric_limits<double>::max()), 709.782712893384);
}

// From tables: ln 2 = 0.69314 71805 59945 30942, ln 10 = 2.30258 50929 94045 68402.
TEST(Logarithm, GivesPrintedValues) {
    EXPECT_DOUBLE_EQ(logarithm(2), 0.69314718055994530942);
    EXPECT_DOUBLE_EQ(logarithm(10), 2.30258509299404568402);
    EXPECT_DOUBLE_EQ(logarithm(0x1p-54), -54 * 0.69314718055994530942);
}

TEST(LogOnePlus, IsWithinOneUnitInTheLastPlace) {
    const Rng rng(2);
    double worst = 0;
    for (std::uint64_t i = 0; i < 40'000; ++i) {
        const double u = rng.uniform(2 * i);
        const double narrow = std::ldexp(u - 0.5, -static_cast<int>(900 * rng.uniform(2 * i + 1)));
        for (const double x : {-u, u, narrow, std::exp(700 * u), u - one_minus_ulp})
            worst = std::max(worst, ulps(log_1p(x), std::log1p(static_cast<long double>(x))));
    }
    EXPECT_LE(worst, 1);
    EXPECT_GT(worst, 0.5);
}

TEST(LogOnePlus, KnowsItsEnds) {
    EXPECT_EQ(log_1p(0), 0);
    EXPECT_EQ(log_1p(-1e-300), -1e-300);
    EXPECT_EQ(log_1p(5e-324), 5e-324);
    EXPECT_EQ(log_1p(-one_minus_ulp), logarithm(0x1p-53));
    EXPECT_EQ(log_1p(1e300), logarithm(1e300));
}

// The oracle is accurate to about 2^-63.
TEST(LogarithmParts, AddUpToSixtyTwoBits) {
    const Rng rng(3);
    for (std::uint64_t i = 0; i < 40'000; ++i) {
        const double u = rng.uniform(i);
        for (const double x : {0.5 + u, std::exp(1400 * u - 700), 1 + 1e-9 * u}) {
            const auto [high, low] = logarithm_parts(x);
            const long double expected = std::log(static_cast<long double>(x));
            const long double off = (high - expected) + low;
            ASSERT_LE(std::abs(off), 0x1p-62L * std::abs(expected)) << x;
            ASSERT_EQ(high + low, high) << x;
        }
    }
    EXPECT_EQ(logarithm_parts(1).high, 0);
    EXPECT_EQ(logarithm_parts(1).low, 0);
}

}  // namespace stipple::testing::logarithm_test
