// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "math/digital/binary_scramble.hpp"
#include "support/nets.hpp"
#include "support/scrambling.hpp"

namespace stipple::testing::matrix_test {

// By the definition, column by column: the image of x + y is the image of x plus that of y plus the
// shift, digit by digit, and the image of a single digit is its column.
TEST(MatrixScramble, IsTheProductWithItsMatrixAndAShift) {
    const auto columns = binary_matrix(5, 0);
    const std::uint64_t shift = binary_shift(5, 0);
    for (const double x : {0.0, 0.5, 0x1p-53, 0.1, 0.7, 1 - 0x1p-53}) {
        std::uint64_t expected = shift;
        for (std::size_t j = 0; j < 64; ++j)
            if (unit_to_fraction(x) >> (63 - j) & 1) expected ^= columns[j];
        EXPECT_EQ(scrambled(points_of({{x}}), "matrix", 5)[0][0], fraction_to_unit(expected)) << x;
    }
}

TEST(MatrixScramble, KeepsTheNetProperty) {
    const PointSet plain = make("hammersley", points(256, 2));
    for (const std::uint64_t seed : {1, 2, 3})
        EXPECT_TRUE(is_net(scrambled(plain, "matrix", seed), 2, 0));
    const PointSet base_three = part_of(make("halton", points(243, 2)), 0, 243, {1});
    EXPECT_TRUE(is_net(scrambled(base_three, "matrix:base=3"), 3, 0));
}

TEST(MatrixScramble, NeedsAPrimeBase) {
    EXPECT_EQ(error_of([] { scrambled(points_of({{0.5}}), "matrix:base=4"); }),
              "usage: --base: 4 is not a prime, as this scramble needs");
}

}  // namespace stipple::testing::matrix_test
