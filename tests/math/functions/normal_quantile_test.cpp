// SPDX-License-Identifier: MIT
#include "math/functions/normal_distribution.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <vector>

#include "core/rng.hpp"
#include "support/ulps.hpp"

namespace stipple::testing::normal_quantile_test {

using stipple::testing::ulps;

namespace {

const boost::math::normal_distribution<long double> normal;

long double quantile(double p) {
    return boost::math::quantile(normal, static_cast<long double>(p));
}

}  // namespace

TEST(NormalQuantile, IsWithinEightUnitsInTheLastPlace) {
    const Rng rng(1);
    double worst = 0;
    for (std::uint64_t i = 0; i < 5'000; ++i) {
        const double u = rng.uniform(i);
        for (const double p : {u, std::exp(-37 * u), std::exp(-690 * u), 1 - std::exp(-36 * u),
                               0.5 + 1e-9 * (u - 0.5), 0.075 + 1e-9 * u, 0.925 + 1e-9 * u})
            if (p > 0 && p < 1 && p != 0.5)
                worst = std::max(worst, ulps(normal_quantile(p), quantile(p)));
    }
    EXPECT_LE(worst, 8);
    EXPECT_GT(worst, 0.5);
}

TEST(NormalQuantile, JoinsItsPiecesWithoutASeam) {
    for (const double seam : {0.075, std::exp(-25.0), 0.5, 0.925, 1 - std::exp(-25.0)})
        for (int step = -50; step <= 50; ++step) {
            const double p = seam * (1 + step * 0x1p-50);
            const double off = p == 0.5 ? 0 : ulps(normal_quantile(p), quantile(p));
            EXPECT_LE(off, 8) << p;
        }
}

TEST(NormalQuantile, IsOddAndRises) {
    EXPECT_EQ(normal_quantile(0.5), 0);
    double last = -INFINITY;
    for (int k = 1; k < 4096; ++k) {
        const double p = k / 4096.0;
        EXPECT_EQ(normal_quantile(p), -normal_quantile(1 - p)) << p;
        EXPECT_GT(normal_quantile(p), last) << p;
        last = normal_quantile(p);
    }
}

// From tables: Phi(1.95996398454005423552) = 0.975, Phi(-3.09023230616781354152) = 0.001.
TEST(NormalQuantile, GivesPrintedValues) {
    EXPECT_NEAR(normal_quantile(0.975), 1.95996398454005423552, 2e-15);
    EXPECT_NEAR(normal_quantile(0.001), -3.09023230616781354152, 4e-15);
    EXPECT_NEAR(normal_quantile(0x1p-54), -8.2924, 0.1);
}

TEST(NormalQuantile, BoundedIsTheSameButForTheEnds) {
    for (const double p : {0x1p-54, 0x1p-53, 1e-5, 0.3, 0.5, 0.97, 1 - 0x1p-53})
        EXPECT_EQ(bounded_normal_quantile(p), normal_quantile(p)) << p;
    EXPECT_EQ(bounded_normal_quantile(0), normal_quantile(0x1p-54));
    for (const auto& [p, x] : {std::pair{0x1p-60, -8.77332116902755}, {1e-300, -37.0470962993612}})
        EXPECT_NEAR(bounded_normal_quantile(p), x, 1e-13) << p << ", by SciPy's ndtri";
    EXPECT_EQ(bounded_normal_quantile(5e-324), bounded_normal_quantile(1e-300));
    EXPECT_EQ(bounded_normal_quantile(1), -normal_quantile(0x1p-55));
}

// Blocks with and without far tails, and an incomplete last block.
TEST(NormalQuantile, OfManyNumbersAreThoseOfEach) {
    for (const double far : {0.25, 0x1p-60, 1e-11, 1.4e-11, 0.0, 1.0}) {
        std::vector<double> p(1000);
        Rng(4).fill(0, p);
        p[700] = far;
        std::vector<double> x = p;
        bounded_normal_quantiles(x);
        for (std::size_t i = 0; i < p.size(); ++i)
            ASSERT_EQ(x[i], bounded_normal_quantile(p[i])) << p[i];
    }
}

}  // namespace stipple::testing::normal_quantile_test
