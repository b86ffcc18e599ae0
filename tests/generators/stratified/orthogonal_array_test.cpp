// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "math/functions/powers.hpp"
#include "support/sequences.hpp"
#include "support/strata.hpp"

namespace stipple::testing::orthogonal_array_test {
namespace {

constexpr const char* all_substrata[] = {"none", "independent", "correlated"};

}  // namespace

TEST(OrthogonalArray, BoseHasStrengthTwoInAllItsColumns) {
    for (const std::uint64_t p : {2, 3, 5, 7, 11})
        for (const char* substrata : all_substrata) {
            const PointSet set = make("orthogonal-array", points(p * p, p + 1),
                                      {{"construction", "bose"}, {"substrata", substrata}});
            EXPECT_TRUE(has_strength(set, p, 2)) << p << " " << substrata;
            EXPECT_TRUE(substrata == all_substrata[0] || is_latin(set)) << p << " " << substrata;
        }
}

TEST(OrthogonalArray, BushHasTheStrengthAskedForInAllItsColumns) {
    for (const auto& [p, t] : {std::pair<std::uint64_t, std::size_t>{2, 3},
                               {3, 1},
                               {3, 3},
                               {3, 4},
                               {5, 3},
                               {5, 4},
                               {7, 2},
                               {2, 6}})
        for (const char* substrata : all_substrata) {
            const PointSet set = make("orthogonal-array", points(saturating_power(p, t), p + 1),
                                      {{"construction", "bush"},
                                       {"strength", std::to_string(t)},
                                       {"substrata", substrata}});
            EXPECT_TRUE(has_strength(set, p, t)) << p << "^" << t << " " << substrata;
            EXPECT_TRUE(substrata == all_substrata[0] || is_latin(set)) << p << "^" << t;
        }
}

TEST(OrthogonalArray, StrengthIsNoMoreThanItSays) {
    EXPECT_FALSE(
        has_strength(make("orthogonal-array", points(25, 6), {{"construction", "bose"}}), 5, 3));
    EXPECT_FALSE(has_strength(make("latin-hypercube", points(25, 6)), 5, 2));
}

TEST(OrthogonalArray, CmjFillsTheWholeGrid) {
    for (const auto& [s, d] :
         {std::pair<std::uint64_t, std::size_t>{1, 3}, {20, 2}, {6, 3}, {3, 5}, {2, 9}, {50, 1}})
        for (const char* substrata : all_substrata) {
            const PointSet set = make("orthogonal-array", points(saturating_power(s, d), d),
                                      {{"substrata", substrata}});
            EXPECT_TRUE(has_strength(set, s, d)) << s << "^" << d << " " << substrata;
            EXPECT_TRUE(substrata == all_substrata[0] || is_latin(set)) << s << "^" << d;
        }
}

TEST(OrthogonalArray, CenteredPointsAreTheMiddlesOfTheirStrata) {
    for (const auto& [substrata, parts] :
         {std::pair<const char*, std::uint64_t>{"none", 7}, {"correlated", 49}}) {
        const PointSet set =
            make("orthogonal-array", points(49, 8),
                 {{"construction", "bose"}, {"substrata", substrata}, {"centered", "true"}});
        for (const double x : set.flat())
            EXPECT_EQ(x, (2 * static_cast<double>(stratum_of(x, parts)) + 1) /
                             (2 * static_cast<double>(parts)));
    }
}

// In cell order the first coordinate's level changes with every point, the last one's after s
// points.
TEST(OrthogonalArray, OrderIsByCellsOrShuffled) {
    const auto level = [](const PointSet& set, std::size_t i) { return stratum_of(set[i][1], 7); };
    const PointSet cells = make("orthogonal-array", points(49, 2), {{"order", "cells"}});
    const PointSet mixed = make("orthogonal-array", points(49, 2));
    bool differs = false;
    for (std::size_t i = 0; i < 49; ++i) {
        EXPECT_EQ(level(cells, i), level(cells, i / 7 * 7));
        differs |= level(mixed, i) != level(mixed, i / 7 * 7);
    }
    EXPECT_TRUE(differs);
    EXPECT_TRUE(has_strength(cells, 7, 2));
}

TEST(OrthogonalArray, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("orthogonal-array", points(125, 3)));
    EXPECT_TRUE(stretches_agree("orthogonal-array", points(343, 8), {{"construction", "bush"}}));
}

TEST(OrthogonalArray, LargeOnesAreBalancedToo) {
    const std::uint64_t p = 257;
    const PointSet set = make("orthogonal-array", points(p * p, 40),
                              {{"construction", "bose"}, {"substrata", "independent"}});
    EXPECT_TRUE(is_balanced(set, p, {0, 39}));
    EXPECT_TRUE(is_balanced(set, p, {1, 38}));
    EXPECT_TRUE(is_balanced(set, p, {17, 18}));
}

TEST(OrthogonalArray, RefusesWhatNoArrayIs) {
    const auto error = [](std::uint64_t n, std::size_t d, const Settings& settings) {
        return error_of([&] { make("orthogonal-array", points(n, d), settings); });
    };
    EXPECT_EQ(error(100, 3, {{"construction", "bose"}}),
              "usage: --count: 100 is not p^2 for a prime p, as orthogonal-array by bose needs; 49 "
              "and 121 are the nearest");
    EXPECT_EQ(error(343, 9, {{"construction", "bush"}}),
              "usage: --dimension: 9 is outside [1, 8], the range of 343 points at strength 3; it "
              "needs at least 1331 points");
    EXPECT_EQ(error(100, 3, {}),
              "usage: --count: 100 is not k^3, as orthogonal-array by cmj needs; 64 and 125 are "
              "the nearest");
    EXPECT_EQ(error(49, 2, {{"construction", "bose"}, {"strength", "3"}}),
              "usage: --strength: 3 contradicts --construction bose, whose strength is 2");
    EXPECT_EQ(make("orthogonal-array", {.dimension = 5}, {{"construction", "bush"}}).count(),
              1331U);
    EXPECT_EQ(make("orthogonal-array", {.dimension = 3}).count(), 1000U);
}

}  // namespace stipple::testing::orthogonal_array_test
