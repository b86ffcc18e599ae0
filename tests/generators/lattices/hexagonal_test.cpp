// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "math/geometry/torus_packing.hpp"
#include "support/exact.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::hexagonal_test {
namespace {

using Pair = std::pair<std::int64_t, std::int64_t>;

/// The points as integer multiples of 1/n; checks that they are the nearest doubles.
std::set<Pair> numerators(const PointSet& set) {
    const auto n = static_cast<std::int64_t>(set.count());
    std::set<Pair> out;
    for (std::size_t i = 0; i < set.count(); ++i) {
        const auto whole = [&](double x) {
            const auto k = static_cast<std::int64_t>(std::llround(x * static_cast<double>(n)));
            EXPECT_TRUE(is_nearest_double(x, Fraction(k, n))) << n;
            return k;
        };
        out.emplace(whole(set[i][0]), whole(set[i][1]));
    }
    return out;
}

/// Squared distance from the origin on the torus, in units of 1/n.
std::int64_t squared(Pair p, std::int64_t n) {
    const std::int64_t x = std::min(p.first, n - p.first);
    const std::int64_t y = std::min(p.second, n - p.second);
    return x * x + y * y;
}

/// Oracle: the best of all lattices of n points, tried row by row with every shift.
std::int64_t best_by_definition(std::int64_t n) {
    std::int64_t best = 0;
    for (std::int64_t in_row = 1; in_row <= n; ++in_row) {
        if (n % in_row != 0) continue;
        const std::int64_t gap = n / in_row;
        for (std::int64_t shift = 0; shift < gap; ++shift) {
            std::int64_t least = n * n;  // distance to its own image
            for (std::int64_t row = 0; row < gap; ++row) {
                const std::int64_t start = row * shift % gap;
                for (std::int64_t x = start; x < n; x += gap)
                    if (x != 0 || row != 0) least = std::min(least, squared({x, row * in_row}, n));
            }
            best = std::max(best, least);
        }
    }
    return best;
}

/// Minimum distance relative to a perfect hexagonal lattice.
double relative(std::uint64_t n) {
    return std::sqrt(static_cast<double>(densest_torus_packing(n).shortest) * std::sqrt(3.) / 2 /
                     static_cast<double>(n));
}

}  // namespace

TEST(Hexagonal, KeepsTheLargestDistanceOfAllLattices) {
    for (std::int64_t n = 1; n <= 120; ++n) {
        const auto lattice =
            numerators(make("hexagonal", points(static_cast<std::uint64_t>(n), 2)));
        ASSERT_EQ(lattice.size(), static_cast<std::size_t>(n));
        std::int64_t least = n * n;
        for (const Pair& p : lattice)
            if (p != Pair{0, 0}) least = std::min(least, squared(p, n));
        EXPECT_EQ(least, best_by_definition(n)) << n;
        EXPECT_EQ(least, static_cast<std::int64_t>(
                             densest_torus_packing(static_cast<std::uint64_t>(n)).shortest));
    }
}

/// Oracle: largest minimum distance of all lattices of n points in a box of this width and height
/// 1, tried row by row with every shift.
double best_in_box(std::int64_t n, double width) {
    double best = 0;
    for (std::int64_t in_row = 1; in_row <= n; ++in_row) {
        if (n % in_row != 0) continue;
        const std::int64_t gap = n / in_row;
        for (std::int64_t shift = 0; shift < gap; ++shift) {
            double least = std::min(width, 1.0);  // distance to its own image
            for (std::int64_t row = 0; row < gap; ++row)
                for (std::int64_t x = row * shift % gap; x < n; x += gap)
                    if (x != 0 || row != 0) {
                        const std::int64_t y = row * in_row;
                        least = std::min(least,
                                         std::hypot(width * static_cast<double>(std::min(x, n - x)),
                                                    static_cast<double>(std::min(y, n - y))) /
                                             static_cast<double>(n));
                    }
            best = std::max(best, least);
        }
    }
    return best;
}

// In a box the distance is optimal for its sides, not for a scaled square.
TEST(Hexagonal, KeepsTheLargestDistanceInABox) {
    for (const double width : {2.0, 0.3, 8.0, 1.0 / 17, 1.7320508075688772})
        for (std::uint64_t n = 1; n <= 60; ++n) {
            Request request = points(n, 2);
            request.bounds = Box{{5, -1}, {5 + width, 0}};
            const PointSet set = make("hexagonal", request);
            double least = std::min(width, 1.0);
            for (std::size_t i = 1; i < set.count(); ++i) {
                const double x = set[i][0] - set[0][0];
                const double y = set[i][1] - set[0][1];
                least = std::min(least, std::hypot(std::min(x, width - x), std::min(y, 1 - y)));
            }
            EXPECT_NEAR(least, best_in_box(static_cast<std::int64_t>(n), width), 1e-12)
                << n << " in " << width;
        }
}

TEST(Hexagonal, IsClosedUnderAddition) {
    for (const std::uint64_t n : {1, 2, 7, 30, 97, 400, 1000}) {
        const auto lattice = numerators(make("hexagonal", points(n, 2)));
        const auto m = static_cast<std::int64_t>(n);
        ASSERT_EQ(lattice.size(), n);
        EXPECT_TRUE(lattice.contains({0, 0}));
        for (const Pair& p : lattice)
            for (std::size_t j = 0; j < std::min<std::size_t>(n, 40); ++j) {
                const Pair& q = *std::next(lattice.begin(), static_cast<std::ptrdiff_t>(j));
                EXPECT_TRUE(lattice.contains({(p.first + q.first) % m, (p.second + q.second) % m}));
            }
    }
}

// As stated in the header: the ratio approaches 1 with more points.
TEST(Hexagonal, IsNearlyPerfect) {
    for (std::uint64_t n = 1; n < 40'000; n += n < 3000 ? 1 : 37) {
        EXPECT_LE(relative(n), 1);
        EXPECT_GT(relative(n), 1 - 2.1 / std::sqrt(static_cast<double>(n))) << n;
    }
    for (const std::uint64_t n : {1'000'003ULL, 1ULL << 30, 999'999'999'989ULL, 1ULL << 40})
        EXPECT_GT(relative(n), 1 - 2.1 / std::sqrt(static_cast<double>(n))) << n;
}

TEST(Hexagonal, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("hexagonal", points(53, 2)));
    EXPECT_TRUE(stretches_agree("hexagonal", points(120, 2)));
}

}  // namespace stipple::testing::hexagonal_test
