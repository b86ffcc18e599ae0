// SPDX-License-Identifier: MIT
#include "math/digital/digit_permutations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "math/combinatorics/primes.hpp"

namespace stipple::testing::digit_permutations_test {
namespace {

constexpr std::uint64_t last = (std::uint64_t{1} << 53) - 1;

/// Digit `position` after the radix point, from 0. Reliable for points inside their interval.
std::uint64_t digit_of(double x, std::uint64_t base, int position) {
    const double shifted = x * std::pow(static_cast<double>(base), position + 1);
    return static_cast<std::uint64_t>(shifted) % base;
}

}  // namespace

// As published by Faure, and by the rule for the rest.
TEST(FaurePermutation, FirstBases) {
    using Images = std::vector<std::uint32_t>;
    EXPECT_EQ(faure_permutation(2), (Images{0, 1}));
    EXPECT_EQ(faure_permutation(3), (Images{0, 1, 2}));
    EXPECT_EQ(faure_permutation(4), (Images{0, 2, 1, 3}));
    EXPECT_EQ(faure_permutation(5), (Images{0, 3, 2, 1, 4}));
    EXPECT_EQ(faure_permutation(6), (Images{0, 2, 4, 1, 3, 5}));
    EXPECT_EQ(faure_permutation(7), (Images{0, 2, 5, 3, 1, 4, 6}));
    EXPECT_EQ(faure_permutation(8), (Images{0, 4, 2, 6, 1, 5, 3, 7}));
}

TEST(FaurePermutation, IsAPermutationThatKeepsZeroAndIsItsOwnMirrorImage) {
    for (const std::uint32_t b : {2U, 31U, 97U, 1021U, 7919U, 65536U}) {
        const auto images = faure_permutation(b);
        ASSERT_EQ(images.size(), b);
        EXPECT_EQ(images[0], 0U);
        std::vector<bool> seen(b);
        for (std::uint32_t a = 0; a < b; ++a) {
            ASSERT_FALSE(seen[images[a]]);
            seen[images[a]] = true;
            ASSERT_EQ(images[a] + images[b - 1 - a], b - 1) << b;
        }
    }
}

// Digits of points are permuted with one permutation per position, independent of other digits.
TEST(PermutedInverse, PermutesTheDigitsOfEachPosition) {
    for (const std::uint32_t b : {2U, 3U, 5U, 10U, 37U}) {
        const PermutedInverse inverse(b, Rng(7, b));
        const int positions = static_cast<int>(std::log(1e9) / std::log(b));
        const Rng indices(1, b);
        for (int j = 0; j < positions; ++j) {
            std::map<std::uint64_t, std::set<std::uint64_t>> images;
            for (std::uint64_t t = 0; t < 400; ++t) {
                const std::uint64_t i = indices.bits(t) >> (11 + t % 53);
                std::uint64_t digit = i;
                for (int k = 0; k < j; ++k) digit /= b;
                images[digit % b].insert(digit_of(inverse.of(i), b, j));
            }
            std::set<std::uint64_t> all;
            for (const auto& [digit, image] : images) {
                ASSERT_EQ(image.size(), 1U) << "base " << b << ", position " << j;
                all.insert(*image.begin());
            }
            EXPECT_EQ(all.size(), images.size()) << "base " << b << ", position " << j;
        }
    }
}

// Random permutations also move the infinitely many leading zeros of an index: all bits of the
// first point depend on the seed.
TEST(PermutedInverse, LeadingZerosArePermutedWithoutEnd) {
    for (const std::uint32_t b : {2U, 3U, 7919U}) {
        double sum = 0;
        std::set<std::uint64_t> ends;
        for (std::uint64_t seed = 0; seed < 400; ++seed) {
            const double x = PermutedInverse(b, Rng(seed, 0)).of(0);
            sum += x;
            ends.insert(static_cast<std::uint64_t>(std::ldexp(x, 49)) % 1024);
        }
        EXPECT_NEAR(sum / 400, 0.5, 5 * std::sqrt(1. / 12 / 400)) << b;  // false alarm: 6e-7
        EXPECT_GT(ends.size(), 280U) << b;  // expected: 331 with standard deviation 8
    }
}

TEST(PermutedInverse, EveryPermutationIsAsLikely) {
    std::map<std::vector<std::uint64_t>, int> seen;
    for (std::uint64_t seed = 0; seed < 6000; ++seed) {
        const PermutedInverse inverse(3, Rng(seed, 0));
        ++seen[{digit_of(inverse.of(0), 3, 0), digit_of(inverse.of(1), 3, 0),
                digit_of(inverse.of(0), 3, 1), digit_of(inverse.of(3), 3, 1)}];
    }
    ASSERT_EQ(seen.size(), 36U);
    double chi = 0;
    for (const auto& [images, count] : seen) chi += (count - 6000. / 36) * (count - 6000. / 36);
    EXPECT_LT(chi / (6000. / 36), 84);  // 35 degrees of freedom: false alarm 7e-6
}

TEST(PermutedInverse, FillGivesTheNumbersOneByOneAllBelowOne) {
    for (const std::uint32_t b : {2U, 3U, 31U, 37U, 1021U, 1031U, 7919U, 65536U}) {
        const PermutedInverse inverse(b, Rng(3, 1));
        for (const std::uint64_t first :
             {std::uint64_t{0}, std::uint64_t{1023}, last / b - 1500, last / 2, last - 2999}) {
            std::vector<double> out(2 * 3000, -1);
            inverse.fill(first, 3000, out.data(), 2);
            for (std::size_t j = 0; j < 3000; ++j) {
                ASSERT_EQ(out[2 * j], inverse.of(first + j)) << b << ", index " << first + j;
                ASSERT_TRUE(out[2 * j] >= 0 && out[2 * j] < 1);
                ASSERT_EQ(out[2 * j + 1], -1);
            }
        }
    }
}

}  // namespace stipple::testing::digit_permutations_test
