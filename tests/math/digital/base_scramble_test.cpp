// SPDX-License-Identifier: MIT
#include "math/digital/base_scramble.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "core/rng.hpp"
#include "math/digital/radical_inverse.hpp"

namespace stipple::testing::base_scramble_test {
namespace {

/// Digits 1 to m of x in [0, 1), as an integer.
std::uint64_t leading(double x, std::uint32_t base, int m) {
    return static_cast<std::uint64_t>(x * std::pow(base, m));
}

std::uint64_t power(std::uint64_t base, int m) { return m == 0 ? 1 : base * power(base, m - 1); }

/// Chi-square of counts with equal expectations.
double chi_square(const std::map<std::vector<std::uint64_t>, int>& counts, std::size_t cells,
                  double total) {
    const double expected = total / static_cast<double>(cells);
    double sum = static_cast<double>(cells - counts.size()) * expected;
    for (const auto& [cell, count] : counts)
        sum += (count - expected) * (count - expected) / expected;
    return sum;
}

}  // namespace

TEST(MirroredDigits, FindTheIndexOfARadicalInverse) {
    for (const std::uint32_t base : {2U, 3U, 5U, 7U, 97U, 541U, 7919U, 65536U}) {
        const std::uint64_t most = power(base, static_cast<int>(digits_of(base)));
        EXPECT_LE(most, std::uint64_t{1} << 50);
        const RadicalInverse inverse(base);
        for (std::uint64_t k = 0; k < 2000; ++k)
            for (const std::uint64_t q : {k, most - 1 - k, Rng(base).below(k, most)})
                EXPECT_EQ(reversed_digits(inverse.of(q), base), q) << "base " << base;
        EXPECT_EQ(reversed_digits(1.0, base), most - 1);
    }
}

// Nesting: the first m digits of the image depend one-to-one on the first m digits only.
TEST(BaseOwen, PermutesThePrefixesOfEveryLength) {
    for (const std::uint32_t base : {2U, 3U, 5U, 11U})
        for (int m = 1; power(base, m) < 20'000; ++m) {
            const BaseOwen scramble(6, 3, base);
            const std::uint64_t count = power(base, m);
            std::set<std::uint64_t> images;
            for (std::uint64_t q = 0; q < count; ++q) {
                const std::uint64_t image = leading(scramble.of(q), base, m);
                images.insert(image);
                for (const std::uint64_t rest : {1, 2, 77})
                    EXPECT_EQ(leading(scramble.of(q + rest * count), base, m), image)
                        << "base " << base << ", " << m << " digits of " << q;
            }
            EXPECT_EQ(images.size(), count);
        }
}

TEST(BaseOwen, FillsWhatItGivesOneByOne) {
    for (const std::uint32_t base : {2U, 3U, 5U, 31U, 71U, 1021U, 1031U, 7919U})
        for (const std::uint64_t first :
             {std::uint64_t{0}, std::uint64_t{1000}, std::uint64_t{123'456'789},
              (std::uint64_t{1} << 53) - 1500}) {
            const BaseOwen scramble(7, 2, base);
            std::vector<double> rows(3000, -1);
            scramble.fill(first, 1500, rows.data() + 1, 2);
            for (std::size_t i = 0; i<1500; i += base> 1000 ? 50 : 1) {
                EXPECT_EQ(rows[2 * i + 1], scramble.of(first + i)) << base << ", " << first + i;
                EXPECT_EQ(rows[2 * i], -1);
            }
        }
}

TEST(BaseOwen, StaysBelowOneAtTheLastIndex) {
    for (const std::uint32_t base : {2U, 3U, 7U, 1021U, 7919U})
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            const double x = BaseOwen(seed, 0, base).of((std::uint64_t{1} << 53) - 1);
            EXPECT_TRUE(x >= 0 && x < 1) << x;
        }
}

// Images of five digits in base 7919 exceed 64 bits.
TEST(BaseOwen, PermutesTheFirstDigitAtTheLastIndices) {
    for (const std::uint32_t base : {3U, 1021U, 2749U, 7919U}) {
        const std::uint64_t first = ((std::uint64_t{1} << 53) / base - 2) * base;
        std::vector<double> images(base);
        BaseOwen(7, 2, base).fill(first, base, images.data(), 1);
        std::set<std::uint64_t> digits;
        for (const double x : images) digits.insert(leading(x, base, 1));
        EXPECT_EQ(digits.size(), base);
    }
}

// All 3! 3! pairs of permutations at the root and after a first digit, the same with a node four
// levels down; then all 5!. Chi-square with 35 and 119 degrees of freedom at level 1e-6.
TEST(BaseOwen, PermutationsAreUniformAndIndependent) {
    std::map<std::vector<std::uint64_t>, int> near;
    std::map<std::vector<std::uint64_t>, int> far;
    std::map<std::vector<std::uint64_t>, int> five;
    const int seeds = 14'400;
    for (int seed = 0; seed < seeds; ++seed) {
        const BaseOwen scramble(static_cast<std::uint64_t>(seed), 0, 3);
        std::vector<std::uint64_t> root;
        std::vector<std::uint64_t> below;
        std::vector<std::uint64_t> deep;
        for (std::uint64_t digit = 0; digit < 3; ++digit) {
            root.push_back(leading(scramble.of(digit), 3, 1));
            below.push_back(leading(scramble.of(1 + 3 * digit), 3, 2) % 3);
            deep.push_back(leading(scramble.of(1 + 9 + 81 * digit), 3, 5) % 3);
        }
        auto pair = root;
        pair.insert(pair.end(), below.begin(), below.end());
        ++near[pair];
        below.insert(below.end(), deep.begin(), deep.end());
        ++far[below];
        if (seed % 3 == 0) {
            const BaseOwen wide(static_cast<std::uint64_t>(seed), 1, 5);
            std::vector<std::uint64_t> all;
            for (std::uint64_t digit = 0; digit < 5; ++digit)
                all.push_back(leading(wide.of(2 + 5 * digit), 5, 2) % 5);
            ++five[all];
        }
    }
    EXPECT_LT(chi_square(near, 36, seeds), 91);
    EXPECT_LT(chi_square(far, 36, seeds), 91);
    EXPECT_LT(chi_square(five, 120, seeds / 3), 207);
    near[{0, 0, 0}] += seeds / 20;
    EXPECT_GT(chi_square(near, 36, seeds), 91) << "blind";
}

// n = 9 points in separate strata: variance 1 / (12 n^3), with a standard error of about 1.9 %.
TEST(BaseOwen, VarianceOfTheMeanIsThatOfIndependentStrata) {
    double square = 0;
    const int seeds = 6000;
    for (int seed = 0; seed < seeds; ++seed) {
        const BaseOwen scramble(static_cast<std::uint64_t>(seed), 5, 3);
        double mean = 0;
        for (std::uint64_t q = 0; q < 9; ++q) mean += scramble.of(q) / 9;
        square += (mean - 0.5) * (mean - 0.5) / seeds;
    }
    EXPECT_NEAR(square * 12 * 729, 1, 0.11);
}

TEST(BaseShift, AddsOneDigitToAllModuloTheBase) {
    for (const std::uint32_t base : {3U, 10U, 7919U}) {
        const BaseShift shift(3, 1, base);
        const auto digits = static_cast<int>(digits_of(base));
        for (int m = 1; m <= std::min(digits, 3); ++m) {
            std::set<std::uint64_t> turns;
            for (std::uint64_t k = 0; k < 500; ++k) {
                const std::uint64_t q = Rng(1).below(k, power(base, digits));
                const std::uint64_t own = q / power(base, m - 1) % base;
                // The image is a multiple of b^-K, possibly rounded to below its edge.
                const double half = 0.5 / std::pow(base, digits);
                const std::uint64_t image = leading(shift.of(q) + half, base, m) % base;
                turns.insert((image + base - own) % base);
            }
            EXPECT_EQ(turns.size(), 1U) << "digit " << m << " in base " << base;
        }
    }
}

TEST(BaseMatrix, IsLowerTriangularAndGivesItsProduct) {
    const std::uint32_t base = 5;
    const BaseMatrix matrix(2, 0, base);
    const std::size_t digits = digits_of(base);
    for (std::size_t row = 0; row < digits; ++row) {
        EXPECT_GT(matrix.entry(row, row), 0U);
        for (std::size_t column = row + 1; column < digits; ++column)
            EXPECT_EQ(matrix.entry(row, column), 0U);
    }
    // q = 2 + 3 * 5: the first three digits of the image, computed from the entries.
    const double x = matrix.of(17) + 0.5 / std::pow(base, digits);
    std::uint64_t expected = 0;
    for (std::size_t row = 0; row < 3; ++row)
        expected =
            expected * base +
            (matrix.shift()[row] + 2 * matrix.entry(row, 0) + 3 * matrix.entry(row, 1)) % base;
    EXPECT_EQ(leading(x, base, 3), expected);
}

TEST(BaseMatrix, PermutesThePrefixesOfEveryLength) {
    for (const std::uint32_t base : {2U, 3U, 7U}) {
        const BaseMatrix matrix(11, 4, base);
        const double half = 0.5 / std::pow(base, digits_of(base));
        for (int m = 1; power(base, m) < 3000; ++m) {
            std::set<std::uint64_t> images;
            for (std::uint64_t q = 0; q < power(base, m); ++q)
                images.insert(leading(matrix.of(q) + half, base, m));
            EXPECT_EQ(images.size(), power(base, m));
        }
    }
}

}  // namespace stipple::testing::base_scramble_test
