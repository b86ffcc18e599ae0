// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "math/combinatorics/primes.hpp"
#include "math/digital/base_scramble.hpp"
#include "math/digital/digit_permutations.hpp"
#include "math/digital/radical_inverse.hpp"
#include "support/exact.hpp"
#include "support/nets.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::halton_test {

// Radical inverses of 0..5 in bases 2 and 3, by hand.
TEST(Halton, FirstPointsByHand) {
    EXPECT_EQ(make("halton", points(6, 2)), points_of({{0, 0},
                                                       {1. / 2, 1. / 3},
                                                       {1. / 4, 2. / 3},
                                                       {3. / 4, 1. / 9},
                                                       {1. / 8, 4. / 9},
                                                       {5. / 8, 7. / 9}}));
    EXPECT_EQ(make("halton", points(5, 1, 1)),
              points_of({{1. / 2}, {1. / 4}, {3. / 4}, {1. / 8}, {5. / 8}}));
}

// The theorem that makes it a low-discrepancy sequence, for aligned and unaligned blocks. Boxes by
// exact arithmetic: floor(x b^m) is wrong if k / 3^m is rounded to just below its edge.
TEST(Halton, EveryBlockMeetsEachElementaryBoxOnce) {
    for (const std::uint64_t start : {0, 1, 1000, 777777})
        for (const auto& [nx, ny] : {std::pair{8, 9}, {32, 27}, {1, 81}, {64, 1}}) {
            const auto block = static_cast<std::size_t>(nx * ny);
            const PointSet set = make("halton", points(block, 2, start));
            std::set<std::pair<int, int>> boxes;
            for (std::size_t i = 0; i < block; ++i) {
                const double nudge = 1e-9;
                boxes.emplace(static_cast<int>(set[i][0] * nx + nudge),
                              static_cast<int>(set[i][1] * ny + nudge));
            }
            EXPECT_EQ(boxes.size(), block)
                << "start " << start << ", " << nx << " x " << ny << " boxes";
        }
}

TEST(Halton, CoordinatesAreRadicalInversesInTheFirstPrimes) {
    const std::uint64_t far = (std::uint64_t{1} << 53) - 40;
    const std::vector<RadicalInverse> inverses(primes.begin(), primes.end());
    for (const std::uint64_t start : {std::uint64_t{0}, std::uint64_t{123'456'789}, far}) {
        const PointSet set = make("halton", points(40, 1000, start));
        for (std::size_t i = 0; i < 40; ++i)
            for (std::size_t k = 0; k < 1000; ++k)
                ASSERT_EQ(set[i][k], inverses[k].of(start + i)) << i << ", " << k;
    }
}

// The same for permuted and leaped sequences.
TEST(Halton, EveryBlockMeetsEachElementaryBoxOnceWhateverIsPermutedOrLeaptOver) {
    for (const char* scramble : {"none", "faure", "reverse", "permutation", "owen"})
        for (const char* leap : {"1", "7", "409"})
            for (const auto& [start, seed] : {std::pair{0U, 1U}, {12345U, 2U}, {999'999'999U, 3U}})
                for (const auto& [nx, ny, nz] : {std::tuple{8U, 9U, 5U}, {1U, 27U, 25U}}) {
                    const std::size_t block = nx * ny * nz;
                    const PointSet set =
                        make("halton", points(block, 3, start),
                             {{"scramble", scramble}, {"leap", leap}}, {.seed = seed});
                    std::set<std::vector<std::uint64_t>> boxes;
                    for (std::size_t i = 0; i < block; ++i)
                        boxes.insert({cell_of(set[i][0], nx), cell_of(set[i][1], ny),
                                      cell_of(set[i][2], nz)});
                    EXPECT_EQ(boxes.size(), block) << scramble << ", leap " << leap << ", seed "
                                                   << seed << ", start " << start;
                }
}

TEST(Halton, LeapTakesEveryLthPoint) {
    for (const char* scramble : {"none", "faure", "reverse", "permutation", "owen"}) {
        const PointSet all = make("halton", points(410, 4), {{"scramble", scramble}});
        const PointSet leapt =
            make("halton", points(32, 4, 5), {{"scramble", scramble}, {"leap", "11"}});
        for (std::size_t i = 0; i < 32; ++i)
            EXPECT_TRUE(std::ranges::equal(leapt[i], all[(5 + i) * 11])) << scramble << " " << i;
    }
}

// Points 1 to 4 in base 5 have the digits 3, 2, 1, 4 under Faure's permutation; 5 has (0, 3).
TEST(Halton, FaurePermutationsByHand) {
    const PointSet set = make("halton", points(6, 3), {{"scramble", "faure"}});
    EXPECT_EQ(part_of(set, 0, 6, {2}),
              points_of({{0}, {3. / 5}, {2. / 5}, {1. / 5}, {4. / 5}, {3. / 25}}));
    EXPECT_EQ(part_of(set, 0, 6, {0, 1}), make("halton", points(6, 2)));
}

// In base 3 digits 1 and 2 are exchanged, in base 5 the digits 1 to 4 become 4 to 1.
TEST(Halton, ReversedDigitsByHand) {
    const PointSet set = make("halton", points(6, 3), {{"scramble", "reverse"}});
    EXPECT_EQ(set, points_of({{0, 0, 0},
                              {1. / 2, 2. / 3, 4. / 5},
                              {1. / 4, 1. / 3, 3. / 5},
                              {3. / 4, 2. / 9, 2. / 5},
                              {1. / 8, 8. / 9, 1. / 5},
                              {5. / 8, 5. / 9, 4. / 25}}));
}

TEST(Halton, FaureCoordinatesAreCorrectlyRounded) {
    const std::uint64_t far = (std::uint64_t{1} << 53) - 3;
    for (const std::uint64_t start : {std::uint64_t{0}, std::uint64_t{123'456'789}, far}) {
        const PointSet set = make("halton", points(3, 1000, start), {{"scramble", "faure"}});
        for (std::size_t k = 0; k < 1000; k += k < 20 ? 1 : 61) {
            const auto images = faure_permutation(primes[k]);
            for (std::size_t i = 0; i < 3; ++i) {
                Fraction exact = 0;
                Fraction weight(1, primes[k]);
                for (std::uint64_t rest = start + i; rest > 0; rest /= primes[k]) {
                    exact += weight * images[rest % primes[k]];
                    weight /= primes[k];
                }
                ASSERT_TRUE(is_nearest_double(set[i][k], exact)) << start + i << ", " << k;
            }
        }
    }
}

TEST(Halton, OwenIsTheScrambleOfTheSameSeedAndCoordinate) {
    const PointSet set = make("halton", points(500, 4, 77), {{"scramble", "owen"}}, {.seed = 8});
    for (std::size_t k = 0; k < 4; ++k) {
        const BaseOwen owen(8, k, primes[k]);
        for (std::size_t i = 0; i < 500; ++i) EXPECT_EQ(set[i][k], owen.of(77 + i));
    }
}

// Kolmogorov-Smirnov statistic over 3000 seeds, for 2 points in 3 coordinates under 2 scrambles:
// false alarm 12 x 2 exp(-2 x 2.6^2) = 3e-5. Faure's permutations do not depend on the seed and
// must fail.
TEST(Halton, RandomPermutationsMakeEachPointUniform) {
    const auto images = [](const char* scramble, std::uint64_t index) {
        std::vector<std::vector<double>> x(3);
        for (std::uint64_t seed = 0; seed < 3000; ++seed) {
            const PointSet set =
                make("halton", points(1, 3, index), {{"scramble", scramble}}, {.seed = seed});
            for (std::size_t k = 0; k < 3; ++k) x[k].push_back(set[0][k]);
        }
        return x;
    };
    const auto distance = [](std::vector<double> x) {
        std::ranges::sort(x);
        double worst = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            worst = std::max({worst, x[i] - static_cast<double>(i) / 3000,
                              static_cast<double>(i + 1) / 3000 - x[i]});
        return worst * std::sqrt(3000.);
    };
    for (const char* scramble : {"permutation", "owen"})
        for (const std::uint64_t index : {0U, 1'000'003U})
            for (const auto& x : images(scramble, index))
                EXPECT_LT(distance(x), 2.6) << scramble << ", point " << index;
    EXPECT_GT(distance(images("faure", 3)[0]), 2.6);
}

TEST(Halton, UsesTheSeedWhereDigitsAreRandom) {
    for (const auto& [scramble, seeded] : {std::pair{"none", false},
                                           {"faure", false},
                                           {"reverse", false},
                                           {"permutation", true},
                                           {"owen", true}}) {
        const Settings settings{{"scramble", scramble}};
        EXPECT_EQ(make("halton", points(20, 2), settings, {.seed = 1}) !=
                      make("halton", points(20, 2), settings, {.seed = 2}),
                  seeded)
            << scramble;
    }
}

TEST(Halton, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("halton", points(50, 3)));
    EXPECT_TRUE(stretches_agree("halton", points(5000, 2)));
    for (const char* scramble : {"faure", "reverse", "permutation", "owen"}) {
        EXPECT_TRUE(stretches_agree("halton", points(2000, 13), {{"scramble", scramble}}));
        EXPECT_TRUE(
            stretches_agree("halton", points(300, 2), {{"scramble", scramble}, {"leap", "31"}}));
    }
}

TEST(Halton, RefusesLeapsThatMissPartOfTheCube) {
    EXPECT_EQ(error_of([] {
                  make("halton", points(9, 3), {{"leap", "35"}});
              }),
              "usage: --leap: 35 is a multiple of 5, the base of coordinate 3, which would not "
              "fill [0, 1) | choose a prime that is not among the bases");
    EXPECT_EQ(make("halton", points(9, 2), {{"leap", "35"}}).count(), 9U);
    EXPECT_EQ(error_of([] {
                  make("halton", points(100, 1, 90'071'992'547'410), {{"leap", "99"}});
              }),
              "");
    EXPECT_EQ(error_of([] {
                  make("halton", points(100, 1, 90'071'992'547'410), {{"leap", "101"}});
              }),
              "usage: --leap: 100 points from 90071992547410 on, at steps of 101, go beyond index "
              "9007199254740991");
    EXPECT_TRUE(error_of([] { make("halton", {}, {{"leap", "0"}}); }).starts_with("usage: --leap"));
}

TEST(Halton, ThreadsChangeNothing) {
    EXPECT_EQ(make("halton", points(30000, 5), {}, {.threads = 1}),
              make("halton", points(30000, 5), {}, {.threads = 5}));
}

TEST(Halton, RefusesWhatIsBeyondItsTables) {
    EXPECT_EQ(error_of([] { make("halton", points(1, 1001)); }),
              "usage: --dimension: 1001 is outside [1, 1000], the range of halton");
    const std::uint64_t end = std::uint64_t{1} << 53;
    EXPECT_EQ(error_of([&] { make("halton", points(1, 1, end - 1)); }), "");
    EXPECT_EQ(error_of([&] { make("halton", points(2, 1, end - 1)); }).substr(0, 14),
              "usage: --start");
}

}  // namespace stipple::testing::halton_test
