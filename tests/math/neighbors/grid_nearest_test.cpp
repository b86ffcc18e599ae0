// SPDX-License-Identifier: MIT
#include "math/neighbors/grid_nearest.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/units.hpp"

namespace stipple::testing::grid_nearest_test {
namespace {

Box unit_box(std::size_t d) { return {std::vector<double>(d, 0.0), std::vector<double>(d, 1.0)}; }

/// Oracle: a tree. Returns whether the grid accepted the points.
bool as_by_tree(const PointSet& set, const Box& box, bool torus) {
    std::vector<double> sides;
    for (std::size_t k = 0; k < box.dimension() && torus; ++k) sides.push_back(box.extent(k));
    const auto found = all_nearest_by_grid(set.flat(), box, torus, {});
    const auto expected = KdTree(set.flat(), set.dimension(), sides, {}).all_nearest({});
    EXPECT_TRUE(!found || *found == expected)
        << set.count() << " points, " << set.dimension() << "-D" << (torus ? ", torus" : "");
    return found.has_value();
}

/// Random points; points on a lattice with ties, copies and both faces; half of the points in a
/// thousandth of the box.
std::vector<PointSet> sets_of(std::size_t n, std::size_t d) {
    const PointSet even = make("random", points(n, d));
    PointSet ties = even;
    PointSet uneven = even;
    const double steps = std::ceil(std::pow(static_cast<double>(n), 1 / static_cast<double>(d)));
    for (double& x : ties.flat()) x = std::floor(x * (steps + 1)) / steps;
    for (std::size_t i = 0; i < n; i += 2)
        for (double& x : uneven[i]) x *= 0.3;
    return {even, ties, uneven};
}

}  // namespace

TEST(GridNearest, FindsWhatATreeFinds) {
    for (const std::size_t d : {1, 2, 3})
        for (const std::size_t n : {2, 3, 10, 5000})
            for (const PointSet& set : sets_of(n, d)) {
                as_by_tree(set, unit_box(d), true);
                as_by_tree(set, bounding_box(set.flat(), d), false);
            }
}

TEST(GridNearest, TakesEvenPoints) {
    for (const std::size_t d : {1, 2, 3})
        for (const char* name : {"random", "halton"})
            EXPECT_TRUE(as_by_tree(make(name, points(10'000, d)), unit_box(d), true)) << d;
}

TEST(GridNearest, HoldsInLongAndFlatBoxes) {
    PointSet set = make("random", points(3000, 3));
    const Box box{{-1, 10, 0}, {1000, 10.5, 3}};
    scale_into(box, set.flat());
    EXPECT_TRUE(as_by_tree(set, box, true));
    for (std::size_t i = 0; i < set.count(); ++i) set[i][1] = 0.25;
    EXPECT_TRUE(as_by_tree(set, bounding_box(set.flat(), 3), false));
}

// All points in one of 10^4 cells, or at one position: a grid would compare all pairs.
TEST(GridNearest, LeavesCrowdsToATree) {
    PointSet set = make("random", points(20'000, 2));
    for (double& x : set.flat()) x = 0.5 + 0.001 * x;
    EXPECT_FALSE(as_by_tree(set, unit_box(2), true));
    PointSet one = make("random", points(100, 2));
    for (double& x : one.flat()) x = 0.5;
    EXPECT_FALSE(as_by_tree(one, bounding_box(one.flat(), 2), false));
    EXPECT_FALSE(as_by_tree(make("random", points(100, 4)), unit_box(4), true));
}

TEST(GridNearest, NeverDependsOnThreads) {
    const PointSet set = make("random", points(20'000, 2));
    EXPECT_EQ(all_nearest_by_grid(set.flat(), unit_box(2), true, {.threads = 1}),
              all_nearest_by_grid(set.flat(), unit_box(2), true, {.threads = 8}));
}

}  // namespace stipple::testing::grid_nearest_test
