// SPDX-License-Identifier: MIT
#include "math/neighbors/minimum_spanning_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"

namespace stipple::testing::minimum_spanning_tree_test {
namespace {

using Rows = std::vector<double>;

/// Points in [0, 1)^d with `levels` possible values per coordinate; the first `near` are in a small
/// box.
Rows random_rows(std::size_t n, std::size_t d, std::uint64_t seed, double levels = 0x1p40,
                 std::size_t near = 0) {
    Rows rows(n * d);
    Rng(seed).fill(0, rows);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        rows[k] = std::floor(rows[k] * levels) / levels;
        if (k < near * d) rows[k] = 0.3 + 1e-6 * rows[k];
    }
    return rows;
}

/// Oracle: adds all possible edges in ascending order if they join two components.
Rows by_definition(const Rows& rows, std::size_t d, const Rows& sides,
                   Norm norm = Norm::euclidean) {
    struct Pair {
        double squared;
        std::size_t i, j;
    };
    const std::size_t n = rows.size() / d;
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            double sum = 0;
            double all = 0;
            double largest = 0;
            for (std::size_t k = 0; k < d; ++k) {
                double gap = std::abs(rows[i * d + k] - rows[j * d + k]);
                if (!sides.empty()) gap = std::min(gap, sides[k] - gap);
                sum += gap * gap;
                all += gap;
                largest = std::max(largest, gap);
            }
            if (norm == Norm::manhattan) sum = all * all;
            if (norm == Norm::chebyshev) sum = largest * largest;
            pairs.push_back({sum, i, j});
        }
    std::ranges::stable_sort(pairs, {}, &Pair::squared);
    std::vector<std::size_t> part(n);
    for (std::size_t i = 0; i < n; ++i) part[i] = i;
    Rows tree;
    for (const Pair& pair : pairs) {
        if (part[pair.i] == part[pair.j]) continue;
        std::ranges::replace(part, std::size_t{part[pair.i]}, std::size_t{part[pair.j]});
        tree.push_back(pair.squared);
    }
    return tree;
}

}  // namespace

TEST(MinimumSpanningTree, EveryWayFindsTheLengthsOfTheDefinition) {
    for (const std::size_t d : {1U, 2U, 3U, 5U, 12U})
        for (const bool torus : {true, false})
            for (const std::size_t n : {1U, 2U, 3U, 40U, 160U})
                for (const double levels : {0x1p40, 5.0}) {  // 5 gives ties and duplicates
                    const Rows rows = random_rows(n, d, 10 * n + d, levels);
                    const Rows sides = torus ? Rows(d, 1.0) : Rows();
                    for (const Norm norm : {Norm::manhattan, Norm::chebyshev}) {
                        const Rows lengths = by_definition(rows, d, sides, norm);
                        ASSERT_EQ(near_spanning_tree(rows, d, sides, {}, norm), lengths) << d << n;
                        ASSERT_EQ(plain_spanning_tree(rows, d, sides, {}, norm), lengths) << d << n;
                    }
                    const Rows oracle = by_definition(rows, d, sides);
                    ASSERT_EQ(near_spanning_tree(rows, d, sides, {}), oracle) << d << torus << n;
                    ASSERT_EQ(plain_spanning_tree(rows, d, sides, {}), oracle) << d << torus << n;
                    ASSERT_EQ(minimum_spanning_tree(rows, d, sides, {}), oracle) << d;
                }
}

TEST(MinimumSpanningTree, CrowdsAndLinesAreJoinedToo) {
    Rows line;
    Rows slope;
    for (const double x : random_rows(500, 1, 4)) {
        line.insert(line.end(), {x, 0.25});
        slope.insert(slope.end(), {x, 1 - x});
    }
    Rows far = line;  // with a constant coordinate, so large that sums with it are rounded away
    for (std::size_t k = 1; k < far.size(); k += 2) far[k] = 1e18;
    const Rows rows[] = {line, slope, random_rows(700, 2, 5, 0x1p40, 600), far};
    for (std::size_t at = 0; at < 4; ++at)
        for (const bool torus : {true, false}) {
            if (at == 3 && torus) continue;
            const Rows sides = torus ? Rows(2, 1.0) : Rows();
            EXPECT_EQ(near_spanning_tree(rows[at], 2, sides, {}), by_definition(rows[at], 2, sides))
                << at << torus;
        }
}

// Two clusters, far apart: most points have no point of the other cluster nearby.
TEST(MinimumSpanningTree, BothWaysAgreeOnManyPoints) {
    for (const std::size_t near : {0U, 3'000U}) {
        const Rows rows = random_rows(6'000, 2, 8, 0x1p40, near);
        for (const bool torus : {true, false}) {
            const Rows sides = torus ? Rows(2, 1.0) : Rows();
            const Rows one = near_spanning_tree(rows, 2, sides, {.threads = 1});
            EXPECT_EQ(plain_spanning_tree(rows, 2, sides, {}), one) << near << torus;
            EXPECT_EQ(near_spanning_tree(rows, 2, sides, {.threads = 5}), one) << near << torus;
        }
    }
}

}  // namespace stipple::testing::minimum_spanning_tree_test
