// SPDX-License-Identifier: MIT
#include "math/digital/gf2.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace stipple::testing::gf2_test {
namespace {

/// Oracle: the product without reduction.
std::uint64_t times(std::uint64_t a, std::uint64_t b) {
    std::uint64_t sum = 0;
    for (int j = 0; j < 32; ++j)
        if ((b >> j & 1) != 0) sum ^= a << j;
    return sum;
}

}  // namespace

// By hand: (x + 1)^2 = x^2 + 1; x^4 = x^2 + x and 1/x = x^2 + 1 modulo x^3 + x + 1.
TEST(Gf2, CalculatesByHand) {
    EXPECT_EQ(gf2::degree(0), -1);
    EXPECT_EQ(gf2::degree(11), 3);
    EXPECT_EQ(gf2::remainder(5, 3), 0U);
    EXPECT_EQ(gf2::remainder(16, 11), 6U);
    EXPECT_EQ(gf2::product(2, 5, 11), 1U);
    EXPECT_EQ(gf2::power(2, 4, 11), 6U);
    EXPECT_EQ(gf2::common_divisor(5, 6), 3U);
}

TEST(Gf2, IrreduciblesAreThoseThatAreNoProducts) {
    std::set<std::uint64_t> products;
    for (std::uint64_t a = 2; a < 1 << 9; ++a)
        for (std::uint64_t b = 2; b <= a; ++b) products.insert(times(a, b));
    for (std::uint64_t p = 2; p < 1 << 10; ++p)
        EXPECT_EQ(gf2::is_irreducible(p), !products.contains(p)) << p;
}

// Known: x, x^2 + x + 1, x^3 + x + 1, x^4 + x + 1, x^5 + x^2 + 1, x^6 + x + 1, x^7 + x + 1,
// x^8 + x^4 + x^3 + x + 1 (that of AES).
TEST(Gf2, FindsTheSmallestIrreducibles) {
    const std::vector<std::uint64_t> known = {2, 7, 11, 19, 37, 67, 131, 283};
    for (std::size_t m = 1; m <= known.size(); ++m)
        EXPECT_EQ(gf2::smallest_irreducible(static_cast<int>(m)), known[m - 1]);
    for (int m = 9; m <= 52; ++m) EXPECT_EQ(gf2::degree(gf2::smallest_irreducible(m)), m);
}

// 283 is irreducible, but x has only order 51; x + 1 is a generator (used by AES's tables).
TEST(Gf2, UnitsAreAllPowersOfOne) {
    EXPECT_FALSE(gf2::is_generator(2, 283));
    EXPECT_TRUE(gf2::is_generator(3, 283));
    for (int m = 1; m <= 12; ++m) {
        const auto p = static_cast<std::uint32_t>(gf2::smallest_irreducible(m));
        auto units = gf2::units(p);
        std::ranges::sort(units);
        ASSERT_EQ(units.size(), (std::size_t{1} << m) - 1) << m;
        for (std::size_t j = 0; j < units.size(); ++j) ASSERT_EQ(units[j], j + 1) << m;
    }
}

}  // namespace stipple::testing::gf2_test
