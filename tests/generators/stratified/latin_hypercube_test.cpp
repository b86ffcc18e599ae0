// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/rng.hpp"
#include "support/sequences.hpp"
#include "support/strata.hpp"

namespace stipple::testing::latin_hypercube_test {
namespace {

double correlation(const PointSet& set, std::size_t a, std::size_t b) {
    double sum = 0;
    for (std::size_t i = 0; i < set.count(); ++i) sum += (set[i][a] - 0.5) * (set[i][b] - 0.5);
    return 12 * sum / static_cast<double>(set.count());
}

}  // namespace

TEST(LatinHypercube, EachStratumHoldsOnePoint) {
    for (const std::uint64_t n : {1, 2, 3, 49, 64, 65, 97, 1000, 1024, 3001})
        for (const char* centered : {"false", "true"})
            EXPECT_TRUE(is_latin(make("latin-hypercube", points(n, 3), {{"centered", centered}})))
                << n;
    EXPECT_FALSE(is_latin(make("random", points(49, 3))));
}

TEST(LatinHypercube, CenteredPointsAreTheMiddlesOfTheirStrata) {
    const PointSet set = make("latin-hypercube", points(250, 2), {{"centered", "true"}});
    for (const double x : set.flat())
        EXPECT_EQ(x, (2 * static_cast<double>(stratum_of(x, 250)) + 1) / 500);
}

TEST(LatinHypercube, StrengthTwoFillsEachSquareOfEachPairOnce) {
    for (const std::uint64_t p : {2, 3, 5, 7, 11}) {
        const PointSet set =
            make("latin-hypercube", points(p * p, p + 1), {{"strength", "2"}}, {.seed = p});
        EXPECT_TRUE(has_strength(set, p, 2)) << p;
        EXPECT_TRUE(is_latin(set)) << p;
    }
    const PointSet centered =
        make("latin-hypercube", points(49, 8), {{"strength", "2"}, {"centered", "true"}});
    EXPECT_TRUE(has_strength(centered, 7, 2) && is_latin(centered));
    for (const double x : centered.flat())
        EXPECT_EQ(x, (2 * static_cast<double>(stratum_of(x, 49)) + 1) / 98);
    EXPECT_FALSE(has_strength(make("latin-hypercube", points(49, 8)), 7, 2));
}

// All six permutations of three strata against each other; a chi-square with 5 degrees of freedom
// is above 36 with a chance of 1e-6.
TEST(LatinHypercube, EveryPermutationIsEquallyLikely) {
    std::map<std::vector<std::uint64_t>, double> seen;
    for (std::uint64_t seed = 0; seed < 6000; ++seed) {
        const PointSet set = make("latin-hypercube", points(3, 2), {}, {.seed = seed});
        std::vector<std::uint64_t> y(3);
        for (std::size_t i = 0; i < 3; ++i) y[stratum_of(set[i][0], 3)] = stratum_of(set[i][1], 3);
        ++seen[y];
    }
    ASSERT_EQ(seen.size(), 6U);
    double statistic = 0;
    for (const auto& [y, count] : seen) statistic += (count - 1000) * (count - 1000) / 1000;
    EXPECT_LT(statistic, 36);
}

// Coordinates are independent: n^(1/2) times their correlation is nearly normal. 45 pairs
// within 5.5 standard deviations: false alarm 2e-6. One permutation for all coordinates would give
// 141.
TEST(LatinHypercube, CoordinatesAreNotCorrelated) {
    const PointSet set = make("latin-hypercube", points(20'000, 10), {}, {.seed = 4});
    for (std::size_t a = 0; a < 10; ++a)
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_LT(std::abs(correlation(set, a, b)) * std::sqrt(2e4), 5.5) << a << " " << b;
    EXPECT_NEAR(correlation(set, 3, 3), 1, 1e-3);
}

TEST(LatinHypercube, ReachesToTheLargestCounts) {
    for (const std::uint64_t n : {(std::uint64_t{1} << 53) - 1, std::uint64_t{1} << 53})
        for (const char* centered : {"false", "true"}) {
            const auto sequence =
                sequence_of("latin-hypercube", points(n, 2), {{"centered", centered}});
            for (const std::uint64_t first : {std::uint64_t{0}, n - 300}) {
                const PointSet part = stretch(*sequence, 2, first, 300);
                for (const double x : part.flat()) EXPECT_TRUE(x >= 0 && x < 1);
            }
        }
}

TEST(LatinHypercube, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("latin-hypercube", points(53, 2)));
    EXPECT_TRUE(stretches_agree("latin-hypercube", points(3000, 3)));
    EXPECT_TRUE(stretches_agree("latin-hypercube", points(200, 100), {{"centered", "true"}}));
    EXPECT_TRUE(stretches_agree("latin-hypercube", points(121, 4), {{"strength", "2"}}));
}

TEST(LatinHypercube, RefusesWhatStrengthTwoCannotBe) {
    const auto strong = [](std::uint64_t n, std::size_t d) {
        return error_of([=] { make("latin-hypercube", points(n, d), {{"strength", "2"}}); });
    };
    EXPECT_EQ(strong(100, 2),
              "usage: --count: 100 is not p^2 for a prime p, as latin-hypercube of strength 2 "
              "needs; 49 and 121 are the nearest");
    EXPECT_EQ(strong(1, 2),
              "usage: --count: 1 is not p^2 for a prime p, as latin-hypercube of strength 2 needs; "
              "4 is the least");
    EXPECT_EQ(strong(49, 9),
              "usage: --dimension: 9 is outside [1, 8], what 49 points of strength 2 have; 121 "
              "points are the fewest for it");
    EXPECT_EQ(strong(49, 8), "");
    EXPECT_EQ(make("latin-hypercube", {.dimension = 2}, {{"strength", "2"}}).count(), 961U);
    EXPECT_EQ(make("latin-hypercube", {.dimension = 50}, {{"strength", "2"}}).count(), 2809U);
}

}  // namespace stipple::testing::latin_hypercube_test
