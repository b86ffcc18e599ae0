// SPDX-License-Identifier: MIT
#include "math/digital/binary_scramble.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/rng.hpp"

namespace stipple::testing::binary_scramble_test {
namespace {

std::uint64_t owen(std::uint64_t seed, std::uint64_t x) {
    BinaryOwen(seed, 0).apply({&x, 1});
    return x;
}

/// Flip of the digit after `prefix`, which is `length` digits at the top of a word.
int flip_behind(std::uint64_t seed, std::uint64_t prefix, int length) {
    return static_cast<int>(((owen(seed, prefix) ^ prefix) >> (63 - length)) & 1);
}

/// Nodes of the tree of digits: near the root, inside and across groups of five, and deep.
std::vector<std::pair<std::uint64_t, int>> nodes() {
    std::vector<std::pair<std::uint64_t, int>> out;
    for (int length = 0; length < 7; ++length)
        for (std::uint64_t k = 0; k < std::uint64_t{1} << length; ++k)
            out.emplace_back(length == 0 ? 0 : k << (64 - length), length);
    for (const int length : {29, 30, 31, 35, 40, 51, 52})
        for (std::uint64_t k = 0; k < 4; ++k) out.emplace_back(Rng(77).bits(k), length);
    for (const int length : {30, 40, 52}) out.emplace_back(0, length);
    for (auto& [prefix, length] : out)
        if (length > 0) prefix &= ~std::uint64_t{0} << (64 - length);
    return out;
}

using Flip = std::function<int(std::uint64_t seed, std::uint64_t prefix, int length)>;

/// Largest imbalance over all nodes and pairs of nodes, in standard deviations.
double worst_imbalance(const Flip& flip, std::size_t seeds) {
    const auto tree = nodes();
    std::vector<std::vector<int>> sign(tree.size(), std::vector<int>(seeds));
    for (std::size_t a = 0; a < tree.size(); ++a)
        for (std::size_t s = 0; s < seeds; ++s)
            sign[a][s] = 1 - 2 * flip(s, tree[a].first, tree[a].second);
    int worst = 0;
    for (std::size_t a = 0; a < tree.size(); ++a) {
        int alone = 0;
        for (const int x : sign[a]) alone += x;
        worst = std::max(worst, std::abs(alone));
        for (std::size_t b = 0; b < a; ++b) {
            int both = 0;
            for (std::size_t s = 0; s < seeds; ++s) both += sign[a][s] * sign[b][s];
            worst = std::max(worst, std::abs(both));
        }
    }
    return worst / std::sqrt(static_cast<double>(seeds));
}

/// Variance, over scrambles, of the mean of x over the 8 points of a net in one dimension.
double variance_of_mean(const std::function<double(std::uint64_t seed, std::uint64_t x)>& scramble,
                        std::size_t seeds) {
    double sum = 0;
    double square = 0;
    for (std::size_t seed = 0; seed < seeds; ++seed) {
        double mean = 0;
        for (std::uint64_t k = 0; k < 8; ++k) mean += scramble(seed, k << 61) / 8;
        sum += mean - 0.5;
        square += (mean - 0.5) * (mean - 0.5);
    }
    const auto n = static_cast<double>(seeds);
    return square / n - sum / n * sum / n;
}

}  // namespace

// Nesting: the first m digits of the image depend one-to-one on the first m digits only.
TEST(BinaryOwen, PermutesThePrefixesOfEveryLength) {
    for (const std::uint64_t seed : {1, 2, 3})
        for (const int m : {1, 2, 5, 6, 11, 13}) {
            std::set<std::uint64_t> images;
            for (std::uint64_t k = 0; k < std::uint64_t{1} << m; ++k) {
                const std::uint64_t prefix = k << (64 - m);
                const std::uint64_t rest = Rng(seed, 9).bits(k) >> m;
                const std::uint64_t image = owen(seed, prefix) >> (64 - m);
                EXPECT_EQ(owen(seed, prefix | rest) >> (64 - m), image);
                images.insert(image);
            }
            EXPECT_EQ(images.size(), std::size_t{1} << m);
        }
}

TEST(BinaryOwen, KeepsPrefixesApartFarDown) {
    for (const int m : {29, 30, 31, 32, 52, 53}) {
        const std::uint64_t last = std::uint64_t{1} << (64 - m);
        for (std::uint64_t k = 0; k < 100; ++k) {
            const std::uint64_t x = Rng(5).bits(k) & (0 - last);
            const std::uint64_t difference = owen(8, x) ^ owen(8, x ^ last);
            EXPECT_EQ(difference >> (64 - m), 1U) << "digit " << m;
        }
    }
}

// 155 nodes, 12 000 sums of 4000 signs: false alarm 2.5e-5 at 6 standard deviations.
TEST(BinaryOwen, FlipsAreFairAndPairwiseIndependent) {
    EXPECT_LT(worst_imbalance(flip_behind, 4000), 6);
}

TEST(BinaryOwen, TheTestOfFlipsSeesADigitalShift) {
    const auto shift = [](std::uint64_t seed, std::uint64_t, int length) {
        return static_cast<int>((binary_shift(seed, 0) >> (63 - length)) & 1);
    };
    EXPECT_GT(worst_imbalance(shift, 4000), 20);
}

// The images of n points are independently uniform in separate intervals: the mean of x has
// variance 1 / (12 n^3). 20 000 scrambles; the standard error is about 1 %.
TEST(BinaryOwen, VarianceOfTheMeanIsThatOfIndependentStrata) {
    const auto scramble = [](std::uint64_t seed, std::uint64_t x) {
        return fraction_to_unit(owen(seed, x));
    };
    EXPECT_NEAR(variance_of_mean(scramble, 20'000) * 12 * 512, 1, 0.06);
    const auto shift = [](std::uint64_t seed, std::uint64_t x) {
        return fraction_to_unit(x ^ binary_shift(seed, 0));
    };
    // One shift for all points: n times as large.
    EXPECT_GT(variance_of_mean(shift, 20'000) * 12 * 512, 4);
}

TEST(BinaryOwen, CoordinatesAndSeedsDiffer) {
    std::set<std::uint64_t> images;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        for (std::size_t k = 0; k < 20; ++k) {
            std::uint64_t x = 0;
            BinaryOwen(seed, k).apply({&x, 1});
            images.insert(x);
        }
    EXPECT_EQ(images.size(), 400U);
}

TEST(BinaryOwen, GivesTheSameInPiecesOfAnySize) {
    std::vector<std::uint64_t> whole(1000);
    for (std::size_t i = 0; i < whole.size(); ++i) whole[i] = Rng(3).bits(i);
    auto pieces = whole;
    const BinaryOwen scramble(4, 1);
    scramble.apply(whole);
    for (std::size_t i = 0; i < pieces.size(); i += 7)
        scramble.apply(std::span(pieces).subspan(i, std::min<std::size_t>(7, pieces.size() - i)));
    EXPECT_EQ(pieces, whole);
}

TEST(BinaryMatrix, IsLowerTriangularWithOnesOnTheDiagonal) {
    const auto columns = binary_matrix(3, 2);
    std::uint64_t below = 0;
    for (std::size_t j = 0; j < 64; ++j) {
        EXPECT_EQ(columns[j] >> (63 - j), 1U) << j;
        below |= columns[j] & ~(std::uint64_t{1} << (63 - j));
    }
    EXPECT_GT(below, 0U);
    EXPECT_NE(columns, binary_matrix(3, 1));
    EXPECT_NE(columns, binary_matrix(4, 2));
}

// 20 x 20 matrices: 64 entries of row 40, 6 standard deviations.
TEST(BinaryMatrix, EntriesAreFair) {
    int ones = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const auto columns = binary_matrix(seed, 0);
        for (std::size_t j = 0; j < 40; ++j) ones += static_cast<int>(columns[j] >> 23 & 1);
    }
    EXPECT_NEAR(ones, 8000, 6 * std::sqrt(16'000 / 4.0));
}

TEST(UnitFractions, HoldEveryDoubleOfFiftyThreeDigits) {
    for (const double x : {0.0, 0.5, 0.1, 0x1p-53, 1 - 0x1p-53})
        EXPECT_EQ(fraction_to_unit(unit_to_fraction(x)), std::floor(x * 0x1p53) * 0x1p-53);
    EXPECT_EQ(fraction_to_unit(unit_to_fraction(1.0)), 1 - 0x1p-53);
    EXPECT_EQ(unit_to_fraction(0.75), std::uint64_t{3} << 62);
}

}  // namespace stipple::testing::binary_scramble_test
