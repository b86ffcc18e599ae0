// SPDX-License-Identifier: MIT
#include "math/functions/normal_distribution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/rng.hpp"
#include "support/ulps.hpp"

namespace stipple::testing::normal_distribution_test {

using stipple::testing::ulps;

// The oracle is the C library's erfc for long double, which is independent and more precise.
TEST(NormalDistribution, IsWithinEightUnitsInTheLastPlace) {
    const Rng rng(1);
    double worst = 0;
    for (std::uint64_t i = 0; i < 40'000; ++i) {
        const double u = rng.uniform(i);
        for (const double z : {-u, u, -7 * u, 7 * u, -37.5 * u, -1e-9 * u, -0.66 - 0.01 * u}) {
            const long double right = std::erfc(-static_cast<long double>(z) / std::sqrt(2.0L)) / 2;
            worst = std::max(worst, ulps(normal_distribution(z), right));
        }
    }
    EXPECT_LE(worst, 8);
    // No rounding is perfect; 0.5 would mean that the oracle is the same code.
    EXPECT_GT(worst, 0.5);
}

// From tables: Phi(1), Phi(-1.96), Phi(-3), Phi(-6).
TEST(NormalDistribution, ErrorFunctionIsWithinFourUnitsInTheLastPlace) {
    for (double x = -7; x <= 7; x += 1 / 512.0) {
        const auto right = static_cast<double>(std::erf(static_cast<long double>(x)));
        EXPECT_NEAR(error_function(x), right, 4 * 0x1p-53 * std::abs(right)) << x;
    }
    EXPECT_EQ(error_function(0), 0);
    EXPECT_EQ(error_function(1e-300), 1e-300 * 2 * std::numbers::inv_sqrtpi);
    EXPECT_EQ(error_function(-40), -1);
}

TEST(NormalDistribution, GivesPrintedValues) {
    EXPECT_DOUBLE_EQ(normal_distribution(1), 0.84134474606854294859);
    EXPECT_DOUBLE_EQ(normal_distribution(-1.96), 0.02499789514822044);
    EXPECT_DOUBLE_EQ(normal_distribution(-3), 0.00134989803163009452665);
    EXPECT_NEAR(normal_distribution(-6) / 9.8658764503769814070e-10, 1, 1e-15);
}

TEST(NormalDistribution, KnowsItsEndsAndItsMiddle) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(normal_distribution(0), 0.5);
    EXPECT_EQ(normal_distribution(-infinity), 0);
    EXPECT_EQ(normal_distribution(infinity), 1);
    EXPECT_EQ(normal_distribution(-1e300), 0);
    EXPECT_EQ(normal_distribution(1e300), 1);
    EXPECT_GT(normal_distribution(-37.5), 0);
}

TEST(NormalDistribution, RisesAndIsTheQuantilesInverse) {
    double before = 0;
    for (double z = -38; z < 9; z += 0x1p-9) {
        const double p = normal_distribution(z);
        EXPECT_GE(p, before) << z;
        before = p;
    }
    for (const double p : {1e-300, 1e-20, 0.01, 0.25, 0.5, 0.7, 0.999})
        EXPECT_NEAR(normal_distribution(normal_quantile(p)) / p, 1, 1e-12) << p;
}

}  // namespace stipple::testing::normal_distribution_test
