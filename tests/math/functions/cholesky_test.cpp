// SPDX-License-Identifier: MIT
#include "math/functions/cholesky.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"

namespace stipple::testing::cholesky_test {

// By hand: [4 2; 2 10] = [2 0; 1 3] [2 1; 0 3].
TEST(Cholesky, FactorByHand) {
    const auto found = cholesky(std::vector{4.0, 2.0, 2.0, 10.0}, 2);
    EXPECT_EQ(found.failed, 0U);
    EXPECT_EQ(found.factor, (std::vector{2.0, 0.0, 1.0, 3.0}));
    EXPECT_EQ(found.minor, 36);
}

TEST(Cholesky, NamesTheFirstMinorThatIsNotPositive) {
    const auto indefinite = cholesky(std::vector{1.0, 2.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.0}, 3);
    EXPECT_EQ(indefinite.failed, 2U);
    EXPECT_EQ(indefinite.minor, -3);
    EXPECT_EQ(cholesky(std::vector{0.0}, 1).failed, 1U);
    EXPECT_EQ(cholesky(std::vector{1.0, 1.0, 1.0, 1.0}, 2).failed, 2U) << "singular";
    EXPECT_EQ(cholesky(std::vector{double{NAN}}, 1).failed, 1U);
}

TEST(Cholesky, TimesItsTransposeIsTheMatrix) {
    const std::size_t d = 6;
    const Rng rng(1);
    std::vector<double> a(d * d);
    for (std::size_t i = 0; i < d; ++i)
        for (std::size_t j = 0; j < d; ++j)
            for (std::size_t k = 0; k < d; ++k)
                a[i * d + j] += rng.uniform(i * d + k) * rng.uniform(j * d + k);
    const auto l = cholesky(a, d).factor;
    for (std::size_t i = 0; i < d; ++i)
        for (std::size_t j = 0; j < d; ++j) {
            double sum = 0;
            for (std::size_t k = 0; k < d; ++k) sum += l[i * d + k] * l[j * d + k];
            EXPECT_NEAR(sum, a[i * d + j], 1e-14);
            EXPECT_EQ(j > i ? l[i * d + j] : 0, 0);
        }
}

}  // namespace stipple::testing::cholesky_test
