// SPDX-License-Identifier: MIT
#include "generators/stratified/latin_hypercube_search/search.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "generators/stratified/latin_hypercube_search/annealing.hpp"
#include "generators/stratified/latin_hypercube_search/support.hpp"
#include "support/units.hpp"

namespace stipple::testing::latin_search_test {
namespace {

using latin_hypercube_search::best_design;
using latin_hypercube_search::Exchanges;
using latin_hypercube_search::Search;

Design found(Kind kind, const Design& start, double trials, const Rules& rules = {},
             std::uint64_t seed = 1) {
    return best_design({{.kind = kind}, rules, start, seed, trials}, "", {}).design;
}

/// Minimum over all designs of two coordinates.
double least_of_all(Kind kind, std::size_t n) {
    std::vector<Level> y(n);
    std::iota(y.begin(), y.end(), Level{0});
    double least = 1e300;
    do least = std::min(least, value_of(kind, design_of({y})));
    while (std::ranges::next_permutation(y).found);
    return least;
}

}  // namespace

TEST(LatinSearch, FindsTheBestOfAllPermutations) {
    for (const Kind kind : all_kinds)
        for (const std::size_t n : {2, 3, 4, 5, 6, 7}) {
            const Design design = found(kind, random_design(n, 2, n), 20'000);
            EXPECT_TRUE(is_latin(design));
            const double least = least_of_all(kind, n);
            EXPECT_NEAR(value_of(kind, design), least, 1e-12 * std::abs(least))
                << static_cast<int>(kind) << " " << n;
        }
}

// Three coordinates: all pairs of permutations.
TEST(LatinSearch, TriesAllDesignsOfFewPoints) {
    for (const Kind kind : all_kinds)
        for (const std::size_t n : {1, 2, 3, 4}) {
            std::vector<Level> y(n);
            std::iota(y.begin(), y.end(), Level{0});
            double least = 1e300;
            do {
                std::vector<Level> z(n);
                std::iota(z.begin(), z.end(), Level{0});
                do least = std::min(least, value_of(kind, design_of({y, z})));
                while (std::ranges::next_permutation(z).found);
            } while (std::ranges::next_permutation(y).found);
            const auto result =
                best_design({{.kind = kind}, {}, random_design(n, 3, n), 1, 1000}, "", {});
            EXPECT_TRUE(result.optimal);
            if (n == 1) continue;  // there is no pair
            EXPECT_NEAR(value_of(kind, result.design), least, 1e-12 * std::abs(least))
                << static_cast<int>(kind) << " " << n;
        }
    EXPECT_FALSE(best_design({{}, {}, random_design(5, 3, 1), 1, 1000}, "", {}).optimal);
    EXPECT_FALSE(latin_hypercube_search::designs_to_try(random_design(12, 2, 1)) < 1e300);
    EXPECT_TRUE(best_design({{}, {}, random_design(500, 1, 1), 1, 1}, "", {}).optimal);
}

TEST(LatinSearch, IsNeverWorseWithMoreTrials) {
    for (const Kind kind : all_kinds)
        for (const std::uint64_t seed : {1, 2}) {
            double least = 1e300;
            for (const double trials : {10., 2'000., 4'000., 9'000., 20'000.}) {
                const double value =
                    value_of(kind, found(kind, random_design(9, 3, seed), trials, {}, seed));
                EXPECT_LE(value, least * (least < 0 ? 1 - 1e-12 : 1 + 1e-12))
                    << static_cast<int>(kind) << " " << trials;
                least = std::min(least, value);
            }
        }
}

/// Largest minimum squared distance of n points in the plane: row by row, over all designs.
int largest_by_exhaustion(int n) {
    std::vector<int> y;
    std::vector<bool> used(static_cast<std::size_t>(n));
    const std::function<bool(int)> complete = [&](int square) {
        const int i = static_cast<int>(y.size());
        if (i == n) return true;
        for (int v = 0; v < n; ++v) {
            bool far = !used[static_cast<std::size_t>(v)];
            for (int j = 0; j < i && far; ++j) {
                const int up = v - y[static_cast<std::size_t>(j)];
                far = (i - j) * (i - j) + up * up >= square;
            }
            if (!far) continue;
            y.push_back(v);
            used[static_cast<std::size_t>(v)] = true;
            const bool whole = complete(square);
            if (whole) return true;
            y.pop_back();
            used[static_cast<std::size_t>(v)] = false;
        }
        return false;
    };
    int square = 0;
    do {
        ++square;
        y.clear();
        used.assign(used.size(), false);
    } while (complete(square));
    return square - 1;
}

TEST(LatinSearch, FindsTheLargestDistancesOfThePlane) {
    const int squares[] = {2, 2, 5, 5, 5, 8, 8, 10, 10, 10, 13, 13};
    for (int n = 2; n <= 13; ++n) {
        EXPECT_EQ(largest_by_exhaustion(n), squares[n - 2]) << n;
        const Design start = random_design(static_cast<std::size_t>(n), 2, 1);
        EXPECT_EQ(-value_of(Kind::maximin, found(Kind::maximin, start, 2'000'000)), squares[n - 2])
            << n;
    }
}

TEST(LatinSearch, IsFarBetterThanRandomByEveryCriterion) {
    for (const Kind kind : all_kinds) {
        double least = 1e300;
        for (std::uint64_t key = 0; key < 200; ++key)
            least = std::min(least, value_of(kind, random_design(24, 4, key)));
        const double value = value_of(kind, found(kind, random_design(24, 4, 0), 200'000));
        EXPECT_LT(value, least) << static_cast<int>(kind);
        EXPECT_LT(value, kind == Kind::maximin ? 1.5 * least : 1.0 * least);
    }
}

TEST(LatinSearch, IsAFunctionOfTheSearchForAnyThreads) {
    for (const Kind kind : all_kinds) {
        Search search{{.kind = kind}, {}, random_design(20, 3, 1), 3, 50'000};
        const Design one = best_design(search, "", {.threads = 1}).design;
        EXPECT_EQ(one, best_design(search, "", {.threads = 3}).design);
        search.seed = 4;
        EXPECT_NE(one, best_design(search, "", {.threads = 3}).design);
    }
}

TEST(LatinSearch, KeepsFixedRows) {
    const Design start = random_design(18, 3, 2);
    for (const Kind kind : all_kinds) {
        const Design design = found(kind, start, 30'000, {.fixed = 7});
        EXPECT_TRUE(is_latin(design));
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_TRUE(std::ranges::equal(design.along(k).first(7), start.along(k).first(7)));
        EXPECT_LE(value_of(kind, design), value_of(kind, start));
    }
}

TEST(LatinSearch, GivesNewPointsLevelsOfSpareRowsWhereTheyAreBetter) {
    Design start(2, 4, 2);  // the first point is in the corner; the other may be in three strata
    for (std::size_t k = 0; k < 2; ++k)
        std::ranges::copy(std::vector<Level>{0, 1, 2, 3}, start.along(k).begin());
    const Design design = found(Kind::maximin, start, 1000, {.fixed = 1});
    EXPECT_EQ(design.along(0)[1], 3);
    EXPECT_EQ(design.along(1)[1], 3);
}

// Constraint: the sum of two levels is below n. Half of all rows are infeasible at first.
TEST(LatinSearch, KeepsRowsFeasible) {
    const auto below = [](std::size_t, std::span<const Level> row) {
        return std::abs(row[0] - row[1]) < 10;
    };
    for (const Kind kind : {Kind::maximin, Kind::centered_l2}) {
        const Design design = found(kind, random_design(20, 3, 3), 50'000, {.feasible = below});
        EXPECT_TRUE(is_latin(design));
        for (std::size_t i = 0; i < 20; ++i)
            EXPECT_LT(std::abs(design.along(0)[i] - design.along(1)[i]), 10) << i;
    }
    EXPECT_EQ(
        error_of([] {
            found(Kind::maximin, random_design(5, 2, 1), 1000,
                  {.feasible = [](std::size_t, std::span<const Level> row) { return row[0] > 0; }});
        }),
        "limit: latin-hypercube: no feasible design was found; 1 of 5 points violate the "
        "constraints");
}

// Eight points, two coordinates with two categories each: each of the four cells should have two
// points.
TEST(LatinSearch, SpreadsCategories) {
    const Design design = found(Kind::maxpro, random_design(8, 2, 1), 50'000,
                                {.axes = {even_parts(8, 2), even_parts(8, 2)}});
    std::map<std::pair<Level, Level>, int> cells;
    for (std::size_t i = 0; i < 8; ++i) ++cells[{design.along(0)[i] / 4, design.along(1)[i] / 4}];
    EXPECT_EQ(cells.size(), 4U);
    for (const auto& [cell, count] : cells) EXPECT_EQ(count, 2);
}

TEST(LatinSearch, ExchangesReachWhatTheGroupsAllow) {
    const Rules rules{.groups = {4, 8, 12}, .coarse = 3};  // slices of four points
    Design design(12, 12, 1);
    for (std::size_t i = 0; i < 12; ++i)
        design.along(0)[i] = static_cast<Level>(3 * (i % 4) + i / 4);
    Exchanges exchanges(design, rules);
    SplitMix64 draws(1);
    std::map<std::pair<std::size_t, Level>, int> seen;
    for (int i = 0; i < 500; ++i) {
        exchanges.shuffle(draws, 1);
        const auto levels = exchanges.design().along(0);
        for (std::size_t s = 0; s < 3; ++s) {
            int coarse = 0;
            for (std::size_t j = 4 * s; j < 4 * s + 4; ++j) coarse |= 1 << (levels[j] / 3);
            ASSERT_EQ(coarse, 15) << "slice " << s;
        }
        ASSERT_TRUE(is_latin(exchanges.design()));
        for (std::size_t j = 0; j < 12; ++j) ++seen[{j, levels[j]}];
    }
    EXPECT_EQ(seen.size(), 144U);
}

TEST(LatinSearch, LatticeStartsAreLatinAndHaveNeighboursFarApart) {
    SplitMix64 draws(1);
    double best = 0;
    for (int i = 0; i < 30; ++i)
        for (const std::size_t d : {2, 3, 4}) {
            const Design design = latin_hypercube_search::lattice_start(60, d, draws);
            EXPECT_TRUE(is_latin(design));
            if (d == 2) best = std::max(best, -value_of(Kind::maximin, design));
        }
    EXPECT_GT(best, 45);
}

}  // namespace stipple::testing::latin_search_test
