// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <map>
#include <set>

#include "math/functions/powers.hpp"
#include "support/sequences.hpp"
#include "support/strata.hpp"

namespace stipple::testing::multi_jittered_test {
namespace {

/// The strips of width 1/n that contain point i.
std::pair<std::uint64_t, std::uint64_t> strips(const PointSet& set, std::size_t i) {
    return {stratum_of(set[i][0], set.count()), stratum_of(set[i][1], set.count())};
}

/// Whether for some shift of the torus along x, columns of floor(n/a) or one more strips contain
/// one point of every full row, and at most one of the last row.
bool has_full_rows(const PointSet& set, std::uint64_t columns) {
    const std::size_t n = set.count();
    std::map<std::uint64_t, std::vector<std::uint64_t>> rows;
    for (std::size_t i = 0; i < n; ++i) {
        const auto [x, y] = strips(set, i);
        rows[y / columns].push_back(x);
    }
    // Column by column, in the order of a full row: the c-th points of all rows are near each
    // other, within two columns' width on the torus.
    const std::uint64_t width = n / columns + 1;
    for (auto& [row, xs] : rows) {
        if (xs.size() != (row < n / columns ? columns : n % columns)) return false;
        std::ranges::sort(xs);
        for (std::size_t c = 0; c + 1 < xs.size(); ++c)
            if (xs.size() == columns && xs[c + 1] - xs[c] > 2 * width) return false;
    }
    return true;
}

}  // namespace

TEST(MultiJittered, EveryStripHoldsOnePointForAnyCount) {
    for (std::uint64_t n = 1; n <= 150; ++n)
        EXPECT_TRUE(is_latin(make("multi-jittered", points(n, 2), {}, {.seed = n}))) << n;
    for (const std::uint64_t n : {997, 1000, 1024, 1369, 3001})
        for (const char* centered : {"false", "true"})
            EXPECT_TRUE(is_latin(make("multi-jittered", points(n, 2), {{"centered", centered}})))
                << n;
}

TEST(MultiJittered, EveryCellOfTheGridHoldsOnePoint) {
    for (const auto& [a, b] :
         {std::pair<std::uint64_t, std::uint64_t>{4, 4}, {5, 7}, {1, 9}, {9, 1}, {25, 40}}) {
        const PointSet set =
            make("multi-jittered", {}, {{"shape", std::to_string(a) + "x" + std::to_string(b)}});
        ASSERT_EQ(set.count(), a * b);
        EXPECT_TRUE(is_latin(set));
        std::set<std::pair<std::uint64_t, std::uint64_t>> cells;
        for (std::size_t i = 0; i < set.count(); ++i)
            cells.emplace(stratum_of(set[i][0], a), stratum_of(set[i][1], b));
        EXPECT_EQ(cells.size(), a * b) << a << " x " << b;
    }
    EXPECT_TRUE(is_balanced(make("multi-jittered", points(900, 2)), 30, {0, 1}));
    EXPECT_FALSE(is_balanced(make("latin-hypercube", points(900, 2)), 30, {0, 1}));
}

TEST(MultiJittered, OtherCountsHaveFullRowsAndOneMore) {
    for (const std::uint64_t n : {7, 13, 97, 997, 1009}) {
        const std::uint64_t columns = floor_root(n, 2);
        EXPECT_TRUE(has_full_rows(make("multi-jittered", points(n, 2)), columns)) << n;
    }
    EXPECT_FALSE(has_full_rows(make("latin-hypercube", points(997, 2)), 31));
}

// In cell order without a shift the columns are known: point i of a full row is in column i mod a.
// With a shift, points of a column are within its width of each other.
TEST(MultiJittered, ColumnsOfOtherCountsHoldTheirPoints) {
    for (const std::uint64_t n : {97, 997}) {
        const std::uint64_t a = floor_root(n, 2);
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            const PointSet set =
                make("multi-jittered", points(n, 2), {{"order", "cells"}}, {.seed = seed});
            for (std::uint64_t c = 0; c < a; ++c) {
                std::set<std::uint64_t> distances;
                const std::uint64_t from = strips(set, c).first;
                for (std::uint64_t i = c; i < n / a * a; i += a)
                    distances.insert((strips(set, i).first + n / 2 - from + n) % n);
                EXPECT_LE(*distances.rbegin() - *distances.begin(), n / a) << n << " " << c;
            }
        }
    }
}

// Points of sets of 5, 6 and 7 over many seeds, in cells of a 5 x 6 grid that is not theirs:
// chi-square with 29 degrees of freedom, reduced rather than increased by the dependence within a
// set. False alarm below 3e-6.
TEST(MultiJittered, IsUniformForCountsThatAreNoGrid) {
    for (const std::uint64_t n : {5, 7, 11}) {
        std::vector<double> held(30);
        constexpr std::uint64_t seeds = 6000;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            const PointSet set = make("multi-jittered", points(n, 2), {}, {.seed = seed});
            for (std::size_t i = 0; i < n; ++i)
                ++held[static_cast<std::size_t>(set[i][0] * 5) * 6 +
                       static_cast<std::size_t>(set[i][1] * 6)];
        }
        const double expected = static_cast<double>(seeds * n) / 30;
        double statistic = 0;
        for (const double h : held) statistic += (h - expected) * (h - expected) / expected;
        EXPECT_GT(
            boost::math::cdf(boost::math::complement(boost::math::chi_squared(29), statistic)),
            1e-6)
            << n;
    }
}

TEST(MultiJittered, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("multi-jittered", points(53, 2)));
    EXPECT_TRUE(stretches_agree("multi-jittered", points(120, 2), {{"order", "cells"}}));
}

TEST(MultiJittered, ReachesToTheLargestCounts) {
    for (const std::uint64_t n : {(std::uint64_t{1} << 53) - 111, std::uint64_t{1} << 53}) {
        const auto sequence = sequence_of("multi-jittered", points(n, 2));
        for (const std::uint64_t first : {std::uint64_t{0}, n - 50}) {
            const PointSet part = stretch(*sequence, 2, first, 50);
            for (const double x : part.flat()) EXPECT_TRUE(x >= 0 && x < 1);
        }
    }
}

TEST(MultiJittered, RefusesContradictions) {
    EXPECT_EQ(error_of([] {
                  make("multi-jittered", points(10, 2), {{"shape", "3x4"}});
              }),
              "usage: --count: 10 contradicts --shape 3x4, which has 12 cells");
    EXPECT_EQ(error_of([] {
                  make("multi-jittered", {}, {{"shape", "3x4x5"}});
              }),
              "usage: --shape: 3x4x5 has 3 sides; expected two, columns x rows");
    EXPECT_NE(error_of([] { make("multi-jittered", points(10, 3)); }), "");
}

}  // namespace stipple::testing::multi_jittered_test
