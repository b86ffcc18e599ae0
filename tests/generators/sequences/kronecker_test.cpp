// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "support/exact.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::kronecker_test {
namespace {

using Whole = boost::multiprecision::cpp_int;

/// Oracle: g with g^d (1 + g) = 1 to 300 bits, by bisection; then its powers.
std::vector<Fraction> golden_powers(unsigned d) {
    constexpr unsigned bits = 300;
    Whole low = 0;
    Whole high = Whole(1) << bits;
    while (high - low > 1) {
        const Whole g = (low + high) / 2;
        Whole value = (Whole(1) << bits) + g;
        for (unsigned k = 0; k < d; ++k) value = (value * g) >> bits;
        ((value >> bits) > 0 ? high : low) = g;
    }
    std::vector<Fraction> powers;
    Whole power = low;
    for (unsigned k = 0; k < d; ++k, power = (power * low) >> bits)
        powers.emplace_back(power, Whole(1) << bits);
    return powers;
}

/// frac(x), truncated to 53 bits.
double first_bits(const Fraction& x) {
    const Whole scaled = (numerator(x) << 53) / denominator(x);
    return std::ldexp(static_cast<double>(static_cast<std::int64_t>(scaled % (Whole(1) << 53))),
                      -53);
}

constexpr std::uint64_t last = (std::uint64_t{1} << 53) - 1;

}  // namespace

// Published in Roberts' article: phi_1 = 1.61803398874989..., phi_2 = 1.32471795724474...
TEST(Kronecker, FirstPointsOfR1AndR2) {
    const PointSet r1 = make("kronecker", points(3, 1));
    EXPECT_EQ(r1[0][0], 0);
    EXPECT_NEAR(r1[1][0], 0.61803398874989, 1e-14);
    EXPECT_NEAR(r1[2][0], 0.23606797749979, 1e-14);
    const PointSet r2 = make("kronecker", points(2, 2));
    EXPECT_NEAR(r2[1][0], 1 / 1.32471795724474, 1e-14);
    EXPECT_NEAR(r2[1][1], 1 / (1.32471795724474 * 1.32471795724474), 1e-14);
}

TEST(Kronecker, IsExactAtAnyIndexInAnyDimension) {
    for (const unsigned d : {1U, 2U, 3U, 20U, 100U}) {
        const auto alpha = golden_powers(d);
        for (const std::uint64_t first : {std::uint64_t{0}, std::uint64_t{1} << 31, last - 999}) {
            const PointSet set = make("kronecker", points(1000, d, first), {{"offset", "0.5"}});
            for (std::size_t i = 0; i < 1000; i += i < 5 ? 1 : 199)
                for (std::size_t k = 0; k < d; ++k)
                    ASSERT_EQ(set[i][k], first_bits(alpha[k] * Whole(first + i) + Fraction(1, 2)))
                        << first + i << ", " << k << " of " << d;
        }
    }
}

TEST(Kronecker, GivenVectorsAreTheDoublesTheyReadAs) {
    const std::vector<double> alpha{0.41421356237309503, -2.6457513110645907, 3.25, 1e-30};
    const PointSet set = make("kronecker", {.count = 500, .start = last - 499},
                              {{"alpha", "0.41421356237309503,-2.6457513110645907,3.25,1e-30"}});
    ASSERT_EQ(set.dimension(), 4U);
    for (std::size_t i = 0; i < 500; ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            const Whole index = last - 499 + i;
            Fraction x = exactly(alpha[k]) * index;
            if (x < 0) x += Whole(1) << 60;
            EXPECT_EQ(set[i][k], first_bits(x)) << i << ", " << k;
        }
}

TEST(Kronecker, SquareRootsOfPrimesAreThoseOfAHundredBits) {
    const std::uint64_t first = std::uint64_t{1} << 31;
    const PointSet set = make("kronecker", points(3, 1000, first), {{"alpha", "square-roots"}});
    for (const auto& [k, p] : {std::pair{0, 2}, {1, 3}, {2, 5}, {99, 541}, {999, 7919}}) {
        const Whole root = sqrt(Whole(p) << 400);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(set[i][static_cast<std::size_t>(k)],
                      first_bits(Fraction(root * Whole(first + i), Whole(1) << 200)))
                << p;
    }
}

TEST(Kronecker, TakesFormulas) {
    const PointSet set = make("kronecker", points(100, 2), {{"alpha", "sqrt(2),pow(2, 1/2)"}});
    for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(set[i][0], set[i][1]);
    EXPECT_EQ(set[1][0], std::sqrt(2.0) - 1);
    const auto error = [](const char* text) {
        return error_of([&] { make("kronecker", points(4, 1), {{"alpha", text}}); });
    };
    EXPECT_EQ(make("kronecker", points(9, 2), {{"alpha", "e - 2,sqrt(2) / 2"}}).dimension(), 2U);
    EXPECT_EQ(error("1/0"), "usage: --alpha: '1/0' is not a finite number");
    EXPECT_TRUE(error("sqrt(2").starts_with("usage: --alpha: 'sqrt(2'")) << error("sqrt(2");
    EXPECT_TRUE(error("x").starts_with("usage: --alpha: 'x'")) << error("x");
    EXPECT_TRUE(error("0.5,").starts_with("usage: --alpha: ''")) << error("0.5,");
    EXPECT_TRUE(error("roots").starts_with("usage: --alpha: 'roots'"));
    EXPECT_EQ(make("kronecker", points(9, 3), {{"alpha", "richtmyer"}}),
              make("kronecker", points(9, 3), {{"alpha", "square-roots"}}));
}

TEST(Kronecker, SaysWherePointsRepeat) {
    const auto notes = [](std::uint64_t n, const char* alpha) {
        std::vector<std::string> said;
        RunContext run;
        run.warn = [&](const std::string& note) { said.push_back(note); };
        generate("kronecker", {.count = n}, {{"alpha", alpha}}, run);
        return said;
    };
    EXPECT_EQ(notes(9, "0.125,0.5"),
              std::vector<std::string>{
                  "the points repeat after 8, since all of --alpha are multiples of 1/8"});
    EXPECT_TRUE(notes(8, "0.125,0.5").empty());
    EXPECT_EQ(notes(2, "1,-2").size(), 1U);
    EXPECT_TRUE(notes(1 << 20, "0.1,0.5").empty());
    EXPECT_TRUE(notes(1 << 20, "golden").empty());
}

// Three-distance theorem (V. T. Sos 1958 and others): multiples of a number modulo 1 leave gaps of
// at most three lengths, the largest of which is the sum of the others.
TEST(Kronecker, OneDimensionLeavesAtMostThreeGaps) {
    for (const std::uint64_t n : {2U, 10U, 100U, 233U, 1000U})
        for (const Settings& settings : {Settings{}, {{"alpha", "0.2345678"}}}) {
            PointSet set = make("kronecker", points(n, 1), settings);
            std::vector<double> x(set.flat().begin(), set.flat().end());
            std::ranges::sort(x);
            x.push_back(1);
            std::set<std::int64_t> gaps;
            for (std::size_t i = 0; i < n; ++i) gaps.insert(std::llround((x[i + 1] - x[i]) * 1e12));
            EXPECT_LE(gaps.size(), 3U) << n;
        }
}

TEST(Kronecker, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("kronecker", points(5000, 2)));
    EXPECT_TRUE(stretches_agree("kronecker", points(600, 37)));
    EXPECT_TRUE(stretches_agree("kronecker", points(5, 5000)));
}

TEST(Kronecker, RefusesTooFewNumbersAndWrongOffsets) {
    EXPECT_EQ(error_of([] {
                  make("kronecker", points(4, 3), {{"alpha", "0.5,0.25"}});
              }),
              "usage: --alpha: 2 numbers are too few for dimension 3");
    EXPECT_TRUE(error_of([] {
                    make("kronecker", points(4, 3), {{"offset", "1"}});
                }).starts_with("usage: --offset: 1 is outside"));
    const std::uint64_t end = std::uint64_t{1} << 53;
    EXPECT_TRUE(
        error_of([&] { make("kronecker", points(2, 1, end - 1)); }).starts_with("usage: --start"));
}

}  // namespace stipple::testing::kronecker_test
