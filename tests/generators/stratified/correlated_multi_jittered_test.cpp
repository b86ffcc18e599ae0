// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "math/functions/powers.hpp"
#include "support/sequences.hpp"
#include "support/strata.hpp"

namespace stipple::testing::correlated_multi_jittered_test {
namespace {

constexpr const char* name = "correlated-multi-jittered";

double smallest_distance(const PointSet& set) {
    double least = 2;
    for (std::size_t i = 0; i < set.count(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            least = std::min(least, std::hypot(set[i][0] - set[j][0], set[i][1] - set[j][1]));
    return least;
}

}  // namespace

TEST(CorrelatedMultiJittered, GridsHaveOnePointInEachCellAndStrip) {
    for (const std::uint64_t n : {1, 4, 9, 64, 900}) {
        const PointSet set = make(name, points(n, 2));
        EXPECT_TRUE(is_latin(set)) << n;
        EXPECT_TRUE(is_balanced(set, floor_root(n, 2), {0, 1})) << n;
    }
    EXPECT_TRUE(is_latin(make(name, points(1000, 2))));
    EXPECT_TRUE(is_latin(make(name, {}, {{"shape", "5x31"}})));
}

// Any n: each strip along y has a point; each of the m r strips along x at most one.
TEST(CorrelatedMultiJittered, AnyCountIsMadeExactly) {
    for (std::uint64_t n = 1; n <= 200; ++n) {
        const PointSet set = make(name, points(n, 2), {}, {.seed = n});
        ASSERT_EQ(set.count(), n);
        std::set<std::uint64_t> y;
        for (std::size_t i = 0; i < n; ++i) y.insert(stratum_of(set[i][1], n));
        EXPECT_EQ(y.size(), n);
    }
    for (const std::uint64_t n : {7, 97, 997}) {
        const std::uint64_t m = floor_root(n, 2);
        const std::uint64_t r = (n + m - 1) / m;
        const PointSet set = make(name, points(n, 2), {{"centered", "true"}});
        std::set<std::uint64_t> x;
        std::set<std::pair<std::uint64_t, std::uint64_t>> cells;
        for (std::size_t i = 0; i < n; ++i) {
            x.insert(stratum_of(set[i][0], m * r));
            cells.emplace(stratum_of(set[i][0], m), stratum_of(set[i][1], n) / m);
        }
        EXPECT_EQ(x.size(), n);
        EXPECT_EQ(cells.size(), n);
    }
}

// Strips of neighbouring rows have the same order in all columns: points of a row, centred in their
// strips, have the same position in their columns.
TEST(CorrelatedMultiJittered, ColumnsAreOrderedAlike) {
    const auto distinct = [](const char* generator) {
        const PointSet set =
            make(generator, points(100, 2), {{"centered", "true"}, {"order", "cells"}});
        std::set<std::uint64_t> places;
        for (std::size_t i = 0; i < 10; ++i) places.insert(stratum_of(set[i][0], 100) % 10);
        return places.size();
    };
    EXPECT_EQ(distinct(name), 1U);
    EXPECT_GT(distinct("multi-jittered"), 1U);
}

// This order keeps points apart: over 50 seeds the mean of the minimum distance is larger by more
// than half (for centred sets; a wide margin, without statistics).
TEST(CorrelatedMultiJittered, PointsKeepFartherApart) {
    const auto mean = [](const char* generator) {
        double sum = 0;
        for (std::uint64_t seed = 1; seed <= 50; ++seed)
            sum += smallest_distance(
                make(generator, points(256, 2), {{"centered", "true"}}, {.seed = seed}));
        return sum / 50;
    };
    EXPECT_GT(mean(name), 1.5 * mean("multi-jittered"));
}

TEST(CorrelatedMultiJittered, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree(name, points(53, 2)));
    EXPECT_TRUE(stretches_agree(name, points(120, 2), {{"order", "cells"}}));
}

TEST(CorrelatedMultiJittered, ReachesToTheLargestCounts) {
    for (const std::uint64_t n : {(std::uint64_t{1} << 52) - 111, std::uint64_t{1} << 52}) {
        const auto sequence = sequence_of(name, points(n, 2));
        for (const std::uint64_t first : {std::uint64_t{0}, n - 50}) {
            const PointSet part = stretch(*sequence, 2, first, 50);
            for (const double x : part.flat()) EXPECT_TRUE(x >= 0 && x < 1);
        }
    }
}

}  // namespace stipple::testing::correlated_multi_jittered_test
