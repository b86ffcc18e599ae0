// SPDX-License-Identifier: MIT
#include "generators/optimized/planar_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace stipple::testing::planar_order_test {
namespace {

/// By the definition, over all boxes with corners at coordinates.
double star_discrepancy(const std::vector<double>& rows) {
    const std::size_t n = rows.size() / 2;
    std::vector<double> x{1}, y{1};
    for (std::size_t i = 0; i < n; ++i) {
        x.push_back(rows[2 * i]);
        y.push_back(rows[2 * i + 1]);
    }
    double largest = 0;
    for (const double a : x)
        for (const double b : y) {
            std::size_t open = 0, closed = 0;
            for (std::size_t i = 0; i < n; ++i) {
                open += static_cast<std::size_t>(rows[2 * i] < a && rows[2 * i + 1] < b);
                closed += static_cast<std::size_t>(rows[2 * i] <= a && rows[2 * i + 1] <= b);
            }
            largest = std::max({largest, a * b - static_cast<double>(open) / static_cast<double>(n),
                                static_cast<double>(closed) / static_cast<double>(n) - a * b});
        }
    return largest;
}

PlanarOrder::Ranks shuffled(std::size_t n, SplitMix64& draws) {
    PlanarOrder::Ranks ranks(n);
    std::iota(ranks.begin(), ranks.end(), 0U);
    for (std::size_t i = n; i > 1; --i) std::swap(ranks[i - 1], ranks[draws.below(i)]);
    return ranks;
}

}  // namespace

// The minimum over all orders is the minimum over all sets: 0.6180, 0.3660, 0.2847, 0.2500, 0.2000,
// 0.1667 for 1, ..., 6 points (B. E. White, Numer. Math. 27 (1977) 157-164).
TEST(PlanarOrder, TheBestOfAllOrdersIsTheOptimum) {
    const double known[] = {0.6180, 0.3660, 0.2847, 0.2500, 0.2000, 0.1667};
    for (std::size_t n = 1; n <= 6; ++n) {
        PlanarOrder::Ranks ranks(n);
        std::iota(ranks.begin(), ranks.end(), 0U);
        double least = 1;
        do {
            PlanarOrder order(ranks, {});
            least = std::min(least, order.level() / static_cast<double>(n));
            EXPECT_NEAR(star_discrepancy(order.points()), order.level() / static_cast<double>(n),
                        1e-12);
        } while (std::ranges::next_permutation(ranks).found);
        EXPECT_NEAR(least, known[n - 1], 5e-5) << n;
    }
}

TEST(PlanarOrder, PointsHaveTheDiscrepancyThatItSays) {
    SplitMix64 draws(7);
    for (const std::size_t n : {2, 9, 17, 40, 100}) {
        PlanarOrder order(shuffled(n, draws), {});
        const auto rows = order.points();
        ASSERT_EQ(rows.size(), 2 * n);
        for (std::size_t i = 2; i < rows.size(); i += 2) EXPECT_LE(rows[i - 2], rows[i]);
        for (const double x : rows) EXPECT_TRUE(x >= 0 && x < 1);
        EXPECT_NEAR(star_discrepancy(rows) * static_cast<double>(n), order.level(), 1e-10) << n;
    }
}

// The level after a swap equals that of solving the new order from scratch; a rejected swap changes
// nothing.
TEST(PlanarOrder, SwapsGiveTheLevelOfTheNewOrder) {
    SplitMix64 draws(11);
    for (const std::size_t n : {3, 8, 30}) {
        PlanarOrder order(shuffled(n, draws), {});
        std::size_t made = 0;
        for (int t = 0; t < 400; ++t) {
            const auto before = order.ranks();
            const double level = order.level();
            const bool critical = t % 3 == 0;
            const auto swap = critical
                                  ? order.critical_swap(draws)
                                  : PlanarOrder::Swap{draws.below(2) == 0, 1 + draws.below(n - 1)};
            if (!swap) continue;
            const double limit = level * (t % 2 == 0 ? 1.2 : 1 + 1e-12);
            if (order.attempt(*swap, limit, critical)) {
                ++made;
                EXPECT_LE(order.level(), limit);
                EXPECT_NE(order.ranks(), before);
            } else {
                EXPECT_EQ(order.ranks(), before);
                EXPECT_EQ(order.level(), level);
            }
            ASSERT_NEAR(order.level(), PlanarOrder(order.ranks(), {}).level(), 1e-10)
                << n << ' ' << t;
        }
        EXPECT_GT(made, 20U) << n;
    }
}

}  // namespace stipple::testing::planar_order_test
