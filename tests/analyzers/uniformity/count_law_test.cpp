// SPDX-License-Identifier: MIT
#include "analyzers/uniformity/pearson.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace stipple::analyzers {
namespace {

/// Visits all counts of n points in groups of these probabilities, with the statistic and
/// probability of each.
void for_all_counts(std::size_t n, const std::vector<double>& p,
                    const std::function<void(double statistic, double chance)>& take) {
    const std::function<void(std::size_t, std::size_t, double, double)> go =
        [&](std::size_t k, std::size_t left, double statistic, double chance) {
            const bool last = k + 1 == p.size();
            for (std::size_t c = last ? left : 0; c <= left; ++c) {
                const double expected = static_cast<double>(n) * p[k];
                const double off = static_cast<double>(c) - expected;
                double ways = chance;
                for (std::size_t i = 1; i <= c; ++i)
                    ways *= p[k] * static_cast<double>(left - c + i) / static_cast<double>(i);
                const double x = statistic + off * off / expected;
                last ? take(x, ways) : go(k + 1, left - c, x, ways);
            }
        };
    go(0, n, 0, 1);
}

double chance_below(double statistic, std::size_t n, const std::vector<double>& p) {
    double sum = 0;
    for_all_counts(n, p, [&](double x, double chance) {
        if (x <= statistic * (1 + 1e-12) + 1e-12) sum += chance;
    });
    return sum;
}

TEST(CountLaw, EqualGroupsAreThoseOfAllCounts) {
    for (const std::size_t groups : {2, 3, 4, 5, 6})
        for (const std::size_t n : {6, 7, 14, 20}) {
            const std::vector<double> p(groups, 1.0 / static_cast<double>(groups));
            for (const double e : {0.0, 0.2, 1.0, 3.0, 7.5, 30.0}) {
                const double right = chance_below(e, n, p);
                const auto found = exact_lower_tail(e, n, groups);
                ASSERT_TRUE(found);
                EXPECT_NEAR(*found, right, 1e-12 + 1e-11 * right)
                    << n << " points, " << groups << " groups, statistic " << e;
            }
        }
}

// Different statistics are distinguished, although they are rounded differently than the sum.
TEST(CountLaw, CountsInEqualStatistics) {
    const std::vector<double> p(3, 1.0 / 3);
    for_all_counts(17, p, [&](double x, double) {
        EXPECT_NEAR(*exact_lower_tail(x, 17, 3), chance_below(x, 17, p), 1e-12) << x;
    });
}

TEST(CountLaw, UnequalGroupsAreThoseOfAllCounts) {
    for (const auto& p : {std::vector<double>{0.3, 0.7},
                          {0.001, 0.999},
                          {0.5, 0.2, 0.3},
                          {0.1, 0.4, 0.3, 0.2},
                          {0.3, 0.1, 0.25, 0.15, 0.2}})
        for (const std::size_t n : {6, 15, 19}) {
            std::vector<double> expected;
            for (const double one : p) expected.push_back(one * static_cast<double>(n));
            for_all_counts(n, p, [&, seen = 0](double x, double) mutable {
                if (seen++ % 97 != 0 || x > 20) return;
                EXPECT_NEAR(*exact_lower_tail(x, n, expected), chance_below(x, n, p), 1e-11) << x;
            });
        }
}

// 101 points in 5 cells with the statistic 0.1386, 90 in 3 with 0.0667: the chi-square distribution
// gives 0.00231 and 0.0328.
TEST(CountLaw, ValuesAboveTheSmallestStatistic) {
    EXPECT_NEAR(*exact_lower_tail(0.13861386, 101, 5), 0.00448, 5e-6);
    EXPECT_NEAR(*exact_lower_tail(0.06666667, 90, 3), 0.0621, 5e-5);
    const std::vector<double> thirds(3, 30);
    EXPECT_NEAR(*exact_lower_tail(0.06666667, 90, thirds), 0.0621, 5e-5);
}

// Two equal parts of 2^40 points: (pi n / 2)^(-1/2) with relative error 1 / (4 n); the normal
// distribution farther out.
TEST(CountLaw, ManyPointsAreCountedToo) {
    const double n = 0x1p40;
    const double even = std::sqrt(2 / (M_PI * n));
    EXPECT_NEAR(*exact_lower_tail(0, std::uint64_t{1} << 40, 2) / even, 1, 1e-11);
    const std::vector<double> halves(2, n / 2);
    EXPECT_NEAR(*exact_lower_tail(0, std::uint64_t{1} << 40, halves) / even, 1, 1e-8);
    // Up to 1000 more points on either side.
    EXPECT_NEAR(*exact_lower_tail(4e6 / n, std::uint64_t{1} << 40, halves) / (2001 * even), 1,
                1e-6);
}

// The probabilities of all counts sum to 1; too many counts are not enumerated; 11 points in 10
// cells never have the statistic 0.
TEST(CountLaw, SumsToOneAndIsNoneWhereCountsAreTooMany) {
    EXPECT_NEAR(*exact_lower_tail(9 * 45.0, 10, 10), 1, 1e-12);
    EXPECT_FALSE(exact_lower_tail(100, 1'000'000, 100));
    EXPECT_FALSE(exact_lower_tail(100, 1'000'000, std::vector<double>(8, 125'000)));
    EXPECT_EQ(*exact_lower_tail(0, 11, 10), 0);
}

}  // namespace
}  // namespace stipple::analyzers
