// SPDX-License-Identifier: MIT
#include "math/digital/binary_net.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "math/digital/binary_scramble.hpp"

namespace stipple::testing::binary_net_test {
namespace {

BinaryMatrices random_matrices(std::size_t dimension, std::size_t digits) {
    BinaryMatrices matrices{dimension, {}};
    for (std::size_t at = 0; at < dimension * digits; ++at)
        matrices.columns.push_back(Rng(7, digits).bits(at));
    return matrices;
}

/// Oracle: the definition, digit by digit of the index.
std::uint64_t coordinate(const BinaryMatrices& matrices, std::size_t k, std::uint64_t i) {
    std::uint64_t sum = 0;
    for (std::size_t j = 0; j < matrices.digits(); ++j)
        if (i >> j & 1) sum ^= matrices.columns[j * matrices.dimension + k];
    return sum;
}

}  // namespace

// Dimensions below, at and above those for which a row fills the table or the vectors.
TEST(BinaryNet, GivesTheSumsOfTheColumnsAnywhere) {
    for (const std::size_t d : {1U, 2U, 3U, 4U, 5U, 20U, 64U, 65U, 511U, 700U})
        for (const std::size_t digits : {1U, 3U, 20U, 52U}) {
            const BinaryMatrices matrices = random_matrices(d, digits);
            const std::uint64_t end = std::uint64_t{1} << digits;
            std::vector<std::uint64_t> shift(d);
            for (std::size_t k = 0; k < d; ++k) shift[k] = Rng(8).bits(k);
            const BinaryNet plain(matrices);
            const BinaryNet moved(matrices, shift);
            for (const std::uint64_t first : {std::uint64_t{0}, end / 3, end - end / 4 - 1}) {
                const std::size_t n = std::min<std::uint64_t>(end - first, 1 + 5000 / d);
                std::vector<std::uint64_t> fractions(n * d);
                std::vector<double> rows(n * d);
                plain.fill(first, fractions);
                moved.fill(first, rows);
                for (std::size_t i = 0; i < n; ++i)
                    for (std::size_t k = 0; k < d; ++k) {
                        const std::uint64_t x = coordinate(matrices, k, first + i);
                        ASSERT_EQ(fractions[i * d + k], x) << d << ", " << digits << ", " << i;
                        ASSERT_EQ(rows[i * d + k], fraction_to_unit(x ^ shift[k]));
                    }
            }
        }
}

TEST(BinaryNet, GrayOrderTakesPointsByTheGrayCodeOfTheirNumber) {
    const BinaryMatrices matrices = random_matrices(3, 20);
    const BinaryMatrices ordered = in_gray_order(matrices);
    for (std::uint64_t i = 0; i < 1 << 12; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            ASSERT_EQ(coordinate(ordered, k, i), coordinate(matrices, k, i ^ (i >> 1)));
}

// Fractions with all digits, with none, and with those at the boundaries of the conversion.
TEST(BinaryNet, CutsFractionsOffAtFiftyThreeDigits) {
    for (const std::uint64_t x :
         {std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 10, std::uint64_t{1} << 11,
          std::uint64_t{1} << 31, std::uint64_t{1} << 32, std::uint64_t{1} << 63}) {
        const BinaryNet net({1, {0}}, {x});
        double y = -1;
        net.fill(0, std::span(&y, 1));
        EXPECT_EQ(y, fraction_to_unit(x));
        EXPECT_LT(y, 1);
    }
}

}  // namespace stipple::testing::binary_net_test
