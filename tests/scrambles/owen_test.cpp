// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "math/digital/base_scramble.hpp"
#include "math/digital/binary_scramble.hpp"
#include "support/nets.hpp"
#include "support/scrambling.hpp"

namespace stipple::testing::owen_test {
namespace {

/// Owen's gain coefficient at levels (k, l) by its definition: the variance of a function's
/// component at these levels under scrambling, relative to independent points.
/// @param whole the points' first m digits in base 2 as integers; further digits are independent
double gain(const std::vector<std::vector<std::uint64_t>>& whole, std::size_t m, std::size_t k,
            std::size_t l) {
    const auto share = [m](std::uint64_t a, std::uint64_t b, std::size_t digits) {
        return digits > m ? a == b : a >> (m - digits) == b >> (m - digits);
    };
    double sum = 0;
    for (const auto& a : whole)
        for (const auto& b : whole) {
            const double first = 2. * share(a[0], b[0], k + 1) - 1. * share(a[0], b[0], k);
            const double second = 2. * share(a[1], b[1], l + 1) - 1. * share(a[1], b[1], l);
            sum += first * second;
        }
    return sum / static_cast<double>(whole.size());
}

/// Variance of the mean of x y over a scrambled net of 16 points in two dimensions. The component
/// of x at level k has variance 4^-k / 16.
double expected_variance(const PointSet& net) {
    std::vector<std::vector<std::uint64_t>> whole;
    for (std::size_t i = 0; i < net.count(); ++i)
        whole.push_back({cell_of(net[i][0], 16), cell_of(net[i][1], 16)});
    double variance = 0;
    for (std::size_t k = 0; k < 12; ++k) {
        // Components of a single coordinate have the other's mean 1/2 as a factor; the points are
        // in 16 strata.
        if (k >= 4) variance += 2 * std::pow(4., -static_cast<double>(k)) / 64;
        for (std::size_t l = 0; l < 12; ++l)
            variance += gain(whole, 4, k, l) * std::pow(4., -static_cast<double>(k + l)) / 256;
    }
    return variance / 16;
}

}  // namespace

TEST(OwenScramble, IsTheKernelOnTheDigits) {
    const PointSet plain = make("halton", points(300, 2));
    const PointSet moved = scrambled(plain, "owen:base=[2,3]", 6);
    const BaseOwen binary(6, 0, 2);
    const BaseOwen ternary(6, 1, 3);
    for (std::size_t i = 0; i < 300; ++i) {
        EXPECT_EQ(moved[i][0], binary.of(i));
        EXPECT_EQ(moved[i][1], ternary.of(i));
    }
}

TEST(OwenScramble, KeepsTheNetProperty) {
    const PointSet plain = make("hammersley", points(256, 2));
    for (const std::uint64_t seed : {1, 2, 3})
        EXPECT_TRUE(is_net(scrambled(plain, "owen", seed), 2, 0));
    const PointSet base_three = part_of(make("halton", points(243, 2)), 0, 243, {1});
    EXPECT_TRUE(is_net(scrambled(base_three, "owen:base=3"), 3, 0));
    EXPECT_FALSE(is_net(scrambled(base_three, "owen"), 3, 0));
}

TEST(OwenScramble, EqualPointsStayEqualAndOthersDoNotMeet) {
    const PointSet moved =
        scrambled(points_of({{0.25, 0.5}, {0.25, 0.5}, {0.25, 0.5 + 0x1p-53}}), "owen", 2);
    EXPECT_EQ(moved[0][0], moved[1][0]);
    EXPECT_EQ(moved[0][1], moved[1][1]);
    EXPECT_EQ(moved[0][0], moved[2][0]);
    EXPECT_NE(moved[0][1], moved[2][1]);
}

// A. B. Owen, Ann. Statist. 25 (1997) 1541-1562: the variance of a scrambled net's estimate is the
// sum of gains times variances of components. 20 000 scrambles of 16 points: error 1 to 2 %.
TEST(OwenScramble, VarianceOfAMonomialIsTheClosedForm) {
    const PointSet plain = make("hammersley", points(16, 2));
    const double expected = expected_variance(plain);
    const auto relative = [&](const char* spec) {
        double sum = 0;
        double square = 0;
        const int seeds = 20'000;
        for (int seed = 0; seed < seeds; ++seed) {
            const PointSet moved = scrambled(plain, spec, static_cast<std::uint64_t>(seed));
            double mean = 0;
            for (std::size_t i = 0; i < 16; ++i) mean += moved[i][0] * moved[i][1] / 16;
            sum += (mean - 0.25) / seeds;
            square += (mean - 0.25) * (mean - 0.25) / seeds;
        }
        EXPECT_LT(std::abs(sum), 5 * std::sqrt(square / seeds)) << spec;  // unbiased
        return (square - sum * sum) / expected;
    };
    EXPECT_NEAR(relative("owen"), 1, 0.08);
    EXPECT_NEAR(relative("matrix"), 1, 0.08);  // pairs of digits have the same distribution
    EXPECT_GT(relative("digital-shift"), 2);
    EXPECT_GT(relative("cranley-patterson"), 2);
}

}  // namespace stipple::testing::owen_test
