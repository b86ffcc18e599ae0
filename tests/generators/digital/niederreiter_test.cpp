// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "support/nets.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::niederreiter_test {
namespace {

/// Degrees of x, 1 + x, 1 + x + x^2, two of degree 3, three of degree 4, six of degree 5.
constexpr std::size_t degrees[] = {1, 1, 2, 3, 3, 4, 4, 4, 5, 5};

std::size_t bound(std::size_t dimension) {
    std::size_t t = 0;
    for (std::size_t k = 0; k < dimension; ++k) t += degrees[k] - 1;
    return t;
}

}  // namespace

// Points 2, 3 and 6 are the expected values in the tests of the GNU Scientific Library
// (qrng/test.c) for its version of Algorithm 738; the others by hand from v = 1 1 0 1 1 0 ... of 1
// + x + x^2 and v = 0 0 1 1 1 1 0 ... of its square.
TEST(Niederreiter, FirstPointsAsPublished) {
    EXPECT_EQ(make("niederreiter", points(7, 3), {{"order", "gray"}}),
              points_of({{0, 0, 0},
                         {0.5, 0.5, 0.75},
                         {0.75, 0.25, 0.3125},
                         {0.25, 0.75, 0.5625},
                         {0.375, 0.375, 0.875},
                         {0.875, 0.875, 0.125},
                         {0.625, 0.125, 0.6875}}));
    const PointSet natural = make("niederreiter", points(4, 3));
    EXPECT_EQ(natural[2][2], 0.5625);
    EXPECT_EQ(natural[3][2], 0.3125);
}

// The theorem. All 53 digits matter here, because columns extend below the diagonal.
TEST(Niederreiter, EveryAlignedBlockIsANet) {
    for (const char* order : {"natural", "gray"})
        for (const char* scramble : {"none", "digital-shift", "matrix", "owen"})
            for (const std::size_t d : {1U, 2U, 3U, 4U})
                for (const std::size_t m : {1U, 5U, 8U}) {
                    const std::uint64_t n = std::uint64_t{1} << m;
                    for (const std::uint64_t block :
                         {std::uint64_t{0}, std::uint64_t{3}, std::uint64_t{87'654'321},
                          (std::uint64_t{1} << (52 - m)) - 1}) {
                        const PointSet set = make("niederreiter", points(n, d, block * n),
                                                  {{"order", order}, {"scramble", scramble}});
                        EXPECT_TRUE(is_net(set, 2, std::min(bound(d), m)))
                            << order << ", " << scramble << ", d = " << d << ", m = " << m
                            << ", block " << block;
                    }
                }
}

// Polynomials are irreducible and distinct: each coordinate, and each pair, satisfies its own
// bound.
TEST(Niederreiter, ProjectionsKeepTheirBound) {
    const std::size_t d = std::size(degrees);
    const std::size_t n = 1024;
    const PointSet set = make("niederreiter", points(n, d));
    for (std::size_t a = 0; a < d; ++a) {
        EXPECT_LE(exact_t(part_of(set, 0, n, {a}), 2), degrees[a] - 1) << a;
        for (std::size_t b = a + 1; b < d; ++b)
            EXPECT_LE(exact_t(part_of(set, 0, n, {a, b}), 2), degrees[a] + degrees[b] - 2)
                << a << ", " << b;
    }
}

TEST(Niederreiter, FirstCoordinateIsTheRadicalInverse) {
    EXPECT_EQ(make("niederreiter", points(1000, 1)), make("halton", points(1000, 1)));
}

TEST(Niederreiter, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("niederreiter", points(5000, 3)));
    EXPECT_TRUE(stretches_agree("niederreiter", points(300, 40), {{"scramble", "owen"}}));
}

TEST(Niederreiter, MakesAllItsDimensionsAndNoMore) {
    const PointSet set = make("niederreiter", points(256, 1000));
    for (const double x : set.flat()) ASSERT_TRUE(x >= 0 && x < 1);
    EXPECT_EQ(error_of([] { make("niederreiter", points(1, 1001)); }),
              "usage: --dimension: 1001 is outside [1, 1000], the range of niederreiter");
}

// Over GF(3): x, x + 1, x + 2, then three polynomials of degree 2; over GF(5) five of degree 1.
TEST(Niederreiter, IsANetInOtherPrimeBases) {
    constexpr std::size_t degrees_three[] = {1, 1, 1, 2, 2, 2};
    for (const char* scramble : {"none", "digital-shift", "matrix", "owen"})
        for (std::size_t d = 1; d <= 5; ++d) {
            std::size_t t = 0;
            for (std::size_t k = 0; k < d; ++k) t += degrees_three[k] - 1;
            for (const std::uint64_t block : {0U, 5U, 12'345U}) {
                const PointSet set = make("niederreiter", points(243, d, block * 243),
                                          {{"base", "3"}, {"scramble", scramble}});
                EXPECT_TRUE(is_net(set, 3, t)) << scramble << ", d = " << d << ", block " << block;
            }
        }
    EXPECT_TRUE(is_net(make("niederreiter", points(625, 5), {{"base", "5"}}), 5, 0));
    EXPECT_FALSE(is_net(make("niederreiter", points(625, 6), {{"base", "5"}}), 5, 0));
}

// With only linear polynomials x - c, the entries are binomials times powers of c, like Faure's:
// v_r of (x - c)^(Q+1) from Q zeros and a one is C(r, Q) c^(r-Q).
TEST(Niederreiter, EqualsFaureInTheSameBaseUpToTheOrderOfCoordinates) {
    const PointSet own = make("niederreiter", points(500, 5), {{"base", "5"}});
    const PointSet faure = make("faure", points(500, 5), {{"base", "5"}});
    for (std::size_t i = 0; i < 500; ++i)
        for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(own[i][k], faure[i][(5 - k) % 5]) << i;
}

TEST(Niederreiter, RefusesWhatItsBaseDoesNotAllow) {
    const auto error = [](const Settings& settings, std::uint64_t count) {
        return error_of([&] { make("niederreiter", points(count, 2), settings); });
    };
    EXPECT_EQ(error({{"base", "6"}}, 10), "usage: --base: 6 is not a prime, 2 divides it");
    EXPECT_EQ(error({{"base", "3"}, {"order", "gray"}}, 10),
              "usage: --order: gray is for base 2; the base here is 3");
    EXPECT_EQ(error({{"base", "65521"}}, std::uint64_t{1} << 52).substr(0, 27),
              "usage: --start 0 and 450359");
}

}  // namespace stipple::testing::niederreiter_test
