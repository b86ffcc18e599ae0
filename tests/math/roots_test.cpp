// SPDX-License-Identifier: MIT
#include "math/roots.hpp"

#include <gtest/gtest.h>

#include <limits>

using namespace stipple;

TEST(Roots, OfPowersAreTheirBases) {
    for (const std::size_t d : {1, 2, 3, 4, 5, 6, 10})
        for (const double base : {1.0, 2.0, 3.0, 0.5, 10.0, 1.0 / 1024}) {
            double power = 1;
            for (std::size_t i = 0; i < d; ++i) power *= base;
            EXPECT_NEAR(nth_root(power, d) / base, 1, 1e-15) << base << "^" << d;
        }
}

TEST(Roots, AgreeWithTheLibrarysPow) {
    for (const std::size_t d : {2, 3, 4, 5, 6, 7, 64})
        for (double x = 1e-300; x < 1e300; x *= 1.7e3)
            EXPECT_NEAR(nth_root(x, d) / std::pow(x, 1 / static_cast<double>(d)), 1, 1e-13)
                << x << ", " << d;
    EXPECT_GT(nth_root(std::numeric_limits<double>::denorm_min(), 3), 0);
}
