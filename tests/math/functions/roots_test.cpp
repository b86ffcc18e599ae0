// SPDX-License-Identifier: MIT
#include "math/functions/roots.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/rng.hpp"
#include "support/ulps.hpp"

namespace stipple::testing::roots_test {

using stipple::testing::ulps;

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

TEST(CubeRoot, IsWithinOneUnitInTheLastPlace) {
    const Rng rng(3);
    double worst = 0;
    for (std::uint64_t i = 0; i < 40'000; ++i) {
        const double u = rng.uniform(i);
        for (const double x : {u, -u, std::exp(1400 * u - 700), 1 + 7 * u, 1e-307 * u})
            worst = std::max(worst, ulps(std::abs(cube_root(x)),
                                         std::cbrt(static_cast<long double>(std::abs(x)))));
    }
    EXPECT_LE(worst, 1);
    EXPECT_GT(worst, 0.5);
}

TEST(CubeRoot, OfCubesIsExactAndKeepsTheSign) {
    for (double k = 1; k < 200'000; k += 7) {
        ASSERT_EQ(cube_root(k * k * k), k);
        ASSERT_EQ(cube_root(-k * k * k), -k);
    }
    EXPECT_EQ(cube_root(0x1p-1074), 0x1p-358);
    EXPECT_EQ(cube_root(-0x1p-1023), -0x1p-341);
    EXPECT_EQ(cube_root(0x1p1023), 0x1p341);
    EXPECT_EQ(cube_root(0), 0);
    EXPECT_FALSE(std::signbit(cube_root(0)));
    EXPECT_DOUBLE_EQ(cube_root(std::numeric_limits<double>::max()), 5.643803094122362e102);
}

TEST(Roots, RoughCubeRootsAreWithinTheirPromise) {
    for (double x = 1e-300; x < 1e300; x *= 1.0301)
        ASSERT_NEAR(rough_cube_root(x) / cube_root(x), 1, 2e-7) << x;
}

}  // namespace stipple::testing::roots_test
