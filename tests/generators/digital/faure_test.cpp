// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "math/functions/powers.hpp"
#include "support/exact.hpp"
#include "support/nets.hpp"
#include "support/scrambling.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::faure_test {
namespace {

/// Oracle: Faure's construction. For each further coordinate, the digits are multiplied once more
/// by Pascal's triangle of binomial coefficients, then mirrored at the radix point.
std::vector<Fraction> by_recipe(std::uint64_t index, std::uint64_t base, std::size_t dimension) {
    std::vector<std::uint64_t> digits;
    for (; index > 0; index /= base) digits.push_back(index % base);
    std::vector<Fraction> point;
    for (std::size_t k = 0; k < dimension; ++k) {
        Fraction x = 0;
        Fraction weight(1, base);
        for (const std::uint64_t digit : digits) {
            x += weight * digit;
            weight /= base;
        }
        point.push_back(x);
        for (std::size_t r = 0; r < digits.size(); ++r) {
            std::uint64_t sum = 0;
            std::uint64_t binomial = 1;
            for (std::size_t j = r; j < digits.size(); ++j) {
                sum = (sum + binomial % base * digits[j]) % base;
                binomial = binomial * (j + 1) / (j + 1 - r);
            }
            digits[r] = sum;  // not used by later rows
        }
    }
    return point;
}

}  // namespace

// By hand: in base 3, index 3 has the digits (0, 1), index 5 the digits (2, 1).
TEST(Faure, FirstPointsByHand) {
    EXPECT_EQ(make("faure", points(9, 3)), points_of({{0, 0, 0},
                                                      {3. / 9, 3. / 9, 3. / 9},
                                                      {6. / 9, 6. / 9, 6. / 9},
                                                      {1. / 9, 4. / 9, 7. / 9},
                                                      {4. / 9, 7. / 9, 1. / 9},
                                                      {7. / 9, 1. / 9, 4. / 9},
                                                      {2. / 9, 8. / 9, 5. / 9},
                                                      {5. / 9, 2. / 9, 8. / 9},
                                                      {8. / 9, 5. / 9, 2. / 9}}));
    EXPECT_EQ(make("faure", points(8, 2)), points_of({{0, 0},
                                                      {0.5, 0.5},
                                                      {0.25, 0.75},
                                                      {0.75, 0.25},
                                                      {0.125, 0.625},
                                                      {0.625, 0.125},
                                                      {0.375, 0.375},
                                                      {0.875, 0.875}}));
}

TEST(Faure, IsFauresRecipeInEveryDigit) {
    using Case = std::pair<std::size_t, std::uint64_t>;
    for (const auto& [d, b] : {Case{1, 2}, {2, 2}, {3, 3}, {4, 5}, {7, 7}, {8, 11}, {24, 29}}) {
        for (const std::uint64_t start : {0ULL, 12'345ULL, 1'000'000'007ULL}) {
            const PointSet set = make("faure", points(60, d, start));
            for (std::size_t i = 0; i < 60; ++i) {
                const auto point = by_recipe(start + i, b, d);
                for (std::size_t k = 0; k < d; ++k)
                    ASSERT_TRUE(is_nearest_double(set[i][k], point[k]))
                        << d << " dimensions, index " << start + i << ", coordinate " << k;
            }
        }
    }
}

// The theorem: any aligned block of b^m points is a (0, m, d)-net in base b.
TEST(Faure, EveryAlignedBlockIsANetOfQualityZero) {
    struct Case {
        std::size_t dimension;
        std::uint64_t base;
        std::size_t largest_m;
        const char* option;
    };
    for (const auto& [d, base, largest_m, option] : {Case{1, 2, 8, ""},
                                                     {2, 2, 8, ""},
                                                     {3, 3, 6, ""},
                                                     {2, 3, 6, "3"},
                                                     {4, 5, 4, ""},
                                                     {5, 5, 4, ""},
                                                     {3, 7, 3, "7"},
                                                     {7, 7, 3, ""},
                                                     {8, 11, 3, ""},
                                                     {13, 13, 2, ""}}) {
        Settings settings;
        if (*option != 0) settings.emplace_back("base", option);
        for (std::size_t m = 0; m <= largest_m; ++m)
            for (const std::uint64_t block : {0, 1, 2, 77, 1'000'003}) {
                const std::uint64_t count = whole_power(base, m);
                const PointSet set = make("faure", points(count, d, block * count), settings);
                ASSERT_TRUE(is_net(set, base, 0))
                    << d << " dimensions, base " << base << ", m = " << m << ", block " << block;
            }
    }
}

TEST(Faure, ScrambledPointsAreItsPointsScrambledAndStillANet) {
    using Case = std::tuple<std::size_t, std::uint32_t, std::size_t>;
    for (const char* scramble : {"digital-shift", "matrix", "owen"})
        for (const auto& [d, base, m] : {Case{1, 2, 7}, {2, 2, 8}, {3, 3, 5}, {5, 5, 3}, {7, 7, 3}})
            for (const std::uint64_t seed : {1, 17}) {
                const std::uint64_t n = whole_power(base, m);
                const PointSet set =
                    make("faure", points(n, d, 2 * n), {{"scramble", scramble}}, {.seed = seed});
                EXPECT_EQ(set, scrambled(make("faure", points(n, d, 2 * n)),
                                         scramble + (":base=" + std::to_string(base)), seed))
                    << scramble << " in base " << base;
                EXPECT_TRUE(is_net(set, base, 0)) << scramble << " in base " << base;
            }
    const Settings owen = {{"scramble", "owen"}};
    EXPECT_NE(make("faure", points(9, 3), owen, {.seed = 1}),
              make("faure", points(9, 3), owen, {.seed = 2}));
    EXPECT_TRUE(stretches_agree("faure", points(500, 3), owen));
    EXPECT_TRUE(stretches_agree("faure", points(500, 3), {{"scramble", "matrix"}}));
}

// Low digits are scrambled in whole blocks; tests whole blocks, blocks cut at either end, and short
// ranges.
TEST(Faure, NestedScramblingIsThatOfItsPointsInStretchesOfAnySize) {
    for (const auto& [d, base] :
         {std::pair<std::size_t, std::uint32_t>{3, 3}, {6, 7}, {20, 23}, {2, 1009}, {2, 1031}})
        for (const auto& [start, count] : {std::pair<std::uint64_t, std::uint64_t>{0, 3500},
                                           {700, 1500},
                                           {1'000'000'000'000, 2200}}) {
            const Settings settings = {{"base", std::to_string(base)}};
            const PointSet plain = make("faure", points(count, d, start), settings);
            const PointSet set = make("faure", points(count, d, start),
                                      {settings[0], {"scramble", "owen"}}, {.seed = 3});
            EXPECT_EQ(set, scrambled(plain, "owen:base=" + std::to_string(base), 3))
                << base << " from " << start;
        }
}

TEST(Faure, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("faure", points(50, 3)));
    EXPECT_TRUE(stretches_agree("faure", points(5000, 2)));
    EXPECT_TRUE(stretches_agree("faure", points(3000, 4), {{"base", "1009"}}));
}

TEST(Faure, ThreadsChangeNothing) {
    EXPECT_EQ(make("faure", points(30000, 5), {}, {.threads = 1}),
              make("faure", points(30000, 5), {}, {.threads = 5}));
}

TEST(Faure, ReachesItsLastIndexAndDimension) {
    const std::uint64_t end = saturating_power(3, 31);
    const PointSet last = make("faure", points(1, 3, end - 1));
    EXPECT_TRUE(is_nearest_double(last[0][0], Fraction(end - 1, end)));
    EXPECT_EQ(make("faure", points(2, 65521))[1][65520], 1. / 65521);
    EXPECT_EQ(error_of([&] { make("faure", points(2, 3, end - 1)); }),
              "usage: --start 617673396283946 and 2 points go beyond index 617673396283946, the "
              "last of faure in base 3");
    EXPECT_EQ(error_of([] { make("faure", points(1, 65522)); }),
              "usage: --dimension: 65522 is outside [1, 65521], the range of faure");
}

TEST(Faure, RefusesBasesThatAreNoPrimesOrTooSmall) {
    EXPECT_EQ(error_of([] {
                  make("faure", points(1, 3), {{"base", "9"}});
              }),
              "usage: --base: 9 is not a prime, 3 divides it");
    EXPECT_EQ(error_of([] {
                  make("faure", points(1, 3), {{"base", "2"}});
              }),
              "usage: --base: 2 is below the dimension 3; expected a prime not below it");
    EXPECT_EQ(error_of([] {
                  make("faure", points(1, 3), {{"base", "1"}});
              }),
              "usage: --base: 1 is outside [2, 65521]");
}

// In base 3; two nets of 9 points are as good as one.
TEST(Faure, SaysWhereARequestMissesTheNets) {
    const auto said = [](std::uint64_t count, std::uint64_t start) {
        std::string sentence;
        RunContext run;
        run.warn = [&](const std::string& text) { sentence += text; };
        make("faure", points(count, 3, start), {}, run);
        return sentence;
    };
    EXPECT_EQ(said(10, 0), "10 points do not form a net; take a multiple of a power of 3: 9 or 18");
    EXPECT_EQ(said(18, 0), "");
    EXPECT_EQ(said(2, 1), "");
    EXPECT_EQ(said(18, 9), "");
    EXPECT_EQ(said(9, 1),
              "9 points from index 1 on do not form a net; start at a multiple of 9: 0 or 9");
}

}  // namespace stipple::testing::faure_test
