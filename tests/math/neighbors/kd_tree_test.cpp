// SPDX-License-Identifier: MIT
#include "math/neighbors/kd_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/units.hpp"

namespace stipple::testing::kd_tree_test {
namespace {

using Doubles = std::vector<double>;

/// Oracle: the formula.
double squared_distance(const double* p, const double* q, std::size_t d, const Doubles& sides) {
    double sum = 0;
    for (std::size_t k = 0; k < d; ++k) {
        double gap = std::abs(p[k] - q[k]);
        if (!sides.empty()) gap = std::min(gap, sides[k] - gap);
        sum += gap * gap;
    }
    return sum;
}

/// Oracle: all points except one, sorted by distance, ties by index.
std::vector<Neighbor> all_by_distance(const Doubles& rows, const double* place, std::size_t d,
                                      const Doubles& sides, std::size_t except) {
    std::vector<Neighbor> all;
    for (std::size_t i = 0; i < rows.size() / d; ++i)
        if (i != except) all.push_back({squared_distance(place, &rows[i * d], d, sides), i});
    std::ranges::sort(all);
    return all;
}

Doubles random_rows(std::size_t n, std::size_t d, std::uint64_t seed) {
    const PointSet set = make("random", points(n, d), {}, {.seed = seed});
    return {set.flat().begin(), set.flat().end()};
}

/// Difficult sets for trees: clusters, copies, lines, grids with many equal distances.
std::vector<Doubles> hard_sets(std::size_t n, std::size_t d) {
    const Doubles even = random_rows(n, d, d);
    Doubles clustered = even;
    Doubles copies = even;
    Doubles line = even;
    Doubles grid = even;
    const Doubles one(n * d, 0.25);
    for (std::size_t i = 0; i < n * d; ++i) {
        clustered[i] = i / d % 3 == 0 ? even[i] : even[i / d % 3 + i % d] + 1e-7 * even[i];
        clustered[i] = std::min(clustered[i], 1.0);
        copies[i] = even[(i / d % 7) * d + i % d];
        line[i] = i % d == 0 ? even[i] : 0.5;
        grid[i] = std::floor(even[i] * 5) / 4;  // 0 and 1 are the same position on the torus
    }
    return {even, clustered, copies, line, grid, one};
}

class KdTrees : public ::testing::TestWithParam<std::tuple<std::size_t, std::size_t, bool>> {
  protected:
    const std::size_t d = std::get<0>(GetParam());
    const std::size_t n = std::get<1>(GetParam());
    const Doubles sides = std::get<2>(GetParam()) ? Doubles(d, 1.0) : Doubles();
};

TEST_P(KdTrees, FindWhatComparingAllPointsFinds) {
    for (const Doubles& rows : hard_sets(std::max<std::size_t>(n, 10), d)) {
        const std::size_t count = n;
        const Doubles some(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(count * d));
        const KdTree tree(some, d, sides, {});
        const auto nearest = tree.all_nearest({});
        ASSERT_EQ(nearest.size(), count);
        for (std::size_t i = 0; i < count; i += 1 + count / 40) {
            const std::span<const double> place(&some[i * d], d);
            const auto all = all_by_distance(some, place.data(), d, sides, i);
            const Neighbor none{std::numeric_limits<double>::infinity(), KdTree::none};
            EXPECT_EQ(nearest[i], all.empty() ? none : all[0]) << i;
            const auto five = tree.nearest_several(place, 5);
            const auto near = all_by_distance(some, place.data(), d, sides, KdTree::none);
            EXPECT_TRUE(
                std::ranges::equal(five, std::span(near).first(std::min<std::size_t>(5, count))))
                << i;
        }
    }
}

TEST_P(KdTrees, CountWhatIsNearerThanADistance) {
    for (const Doubles& rows : hard_sets(std::max<std::size_t>(n, 10), d)) {
        const Doubles some(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(n * d));
        const KdTree tree(some, d, sides, {});
        for (const Doubles& place : {random_rows(1, d, 99), Doubles(d, 0.0), Doubles(d, 1.0)}) {
            const auto all = all_by_distance(some, place.data(), d, sides, KdTree::none);
            EXPECT_EQ(tree.nearest(place), all[0]);
            for (const double squared : {0.0, all[0].squared, all[n / 2].squared, 1e9}) {
                const auto at = std::ranges::lower_bound(all, squared, {}, &Neighbor::squared);
                EXPECT_EQ(tree.count_nearer(place, squared),
                          static_cast<std::size_t>(at - all.begin()));
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, KdTrees,
                         ::testing::Combine(::testing::Values(1, 2, 3, 4, 5, 10),
                                            ::testing::Values(1, 2, 9, 100, 1000),
                                            ::testing::Bool()));

}  // namespace

// The nearest point is across the right face, at the left one.
TEST(KdTree, WrapsByHand) {
    const KdTree tree(Doubles{0.5, 1, 9.5, 3, 5, 2}, 2, {10, 4}, {});
    EXPECT_EQ(tree.nearest_several(Doubles{0.5, 1}, 2)[1], (Neighbor{1 + 4, 1}));
    const KdTree plain(Doubles{0.5, 1, 9.5, 3, 5, 2}, 2, {}, {});
    EXPECT_EQ(plain.nearest_several(Doubles{0.5, 1}, 2)[1], (Neighbor{4.5 * 4.5 + 1, 2}));
}

TEST(KdTree, HandlesBoxesOfAnyProportions) {
    Doubles rows = random_rows(500, 3, 1);
    const Doubles sides{1e-3, 7, 100};
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = rows[i] * sides[i % 3] - 50;
    const KdTree tree(rows, 3, sides, {});
    const auto nearest = tree.all_nearest({});
    for (std::size_t i = 0; i < 500; ++i)
        EXPECT_EQ(nearest[i], all_by_distance(rows, &rows[3 * i], 3, sides, i)[0]) << i;
}

TEST(KdTree, IsTheSameForAnyNumberOfThreads) {
    const Doubles rows = random_rows(100'000, 2, 7);
    const auto build = [&](unsigned threads) {
        const KdTree tree(rows, 2, {1, 1}, {.threads = threads});
        auto found = tree.all_nearest({.threads = threads});
        for (std::size_t rank = 0; rank < tree.count(); ++rank)
            found.push_back({tree.row(rank)[0], tree.index(rank)});
        return found;
    };
    EXPECT_EQ(build(1), build(5));
}

TEST(KdTree, OfNoPointsFindsNone) {
    const KdTree tree(Doubles{}, 2, {}, {});
    EXPECT_EQ(tree.nearest(Doubles{0, 0}).index, KdTree::none);
    EXPECT_TRUE(tree.nearest_several(Doubles{0, 0}, 3).empty());
    EXPECT_EQ(tree.count_nearer(Doubles{0, 0}, 1), 0U);
}

TEST(KdTree, RefusesWhatNeedsMoreMemoryThanAllowed) {
    EXPECT_TRUE(error_of([] {
                    KdTree(Doubles(2000), 2, {}, {.max_memory = 1000});
                }).starts_with("limit: a search tree needs "));
}

}  // namespace stipple::testing::kd_tree_test
