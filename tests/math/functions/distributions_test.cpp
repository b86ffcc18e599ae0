// SPDX-License-Identifier: MIT
#include "math/functions/distributions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace stipple::testing::distributions_test {

// With two degrees of freedom chi-square is exponential, with one the square of a normal variable.
TEST(Distributions, ChiSquareInClosedForm) {
    for (const double x : {0.1, 1.0, 7.0, 300.0}) {
        EXPECT_NEAR(chi_square_above(x, 2), std::exp(-x / 2), 1e-14 * std::exp(-x / 2));
        EXPECT_NEAR(chi_square_below(x, 2), -std::expm1(-x / 2), 1e-15);
        EXPECT_NEAR(chi_square_above(x, 1), std::erfc(std::sqrt(x / 2)),
                    1e-13 * std::erfc(std::sqrt(x / 2)));
    }
}

// With one degree of freedom Student's t is Cauchy's; with two, x / sqrt(2 + x^2) is 1 - 2 times
// the upper tail.
TEST(Distributions, StudentInClosedForm) {
    for (const double above : {0.3, 0.025, 1e-4}) {
        EXPECT_NEAR(student_quantile(above, 1) * std::tan(std::numbers::pi * above), 1, 1e-12);
        const double share = 1 - 2 * above;
        const double wanted = share * std::sqrt(2 / (1 - share * share));
        EXPECT_NEAR(student_quantile(above, 2) / wanted, 1, 1e-11);
    }
}

// Expected values from mpmath with 40 digits.
TEST(Distributions, TailsOfStudent) {
    struct Case {
        double t, freedom, above;
    };
    for (const auto [t, freedom, above] :
         {Case{0, 3, 0.5}, Case{1e-9, 1, 0.49999999968169011},
          Case{0.5, 6.648522216017736, 0.31659712314414611}, Case{3, 1, 0.10241638234956673},
          Case{40, 5, 9.2059810858864772e-8}, Case{1e8, 2.5, 7.1933971908317207e-21},
          Case{12, 1e6, 1.7858425623825449e-33}, Case{0.7, 3e6, 0.24196367936314236},
          Case{1e150, 1, 3.1830988618379068e-151}})
        EXPECT_NEAR(student_above(t, freedom) / above, 1, 1e-11) << t << ' ' << freedom;
}

// (Z + m)^2 is above q^2 with probability P(Z > q - m) + P(Z < -q - m).
TEST(Distributions, NoncentralityHasThePower) {
    for (const double level : {0.05, 0.0005}) {
        const double m = std::sqrt(detectable_noncentrality(1, 2 * level));
        double q = 1;
        while (std::erfc(q / std::numbers::sqrt2) > level) q += 1e-5;
        const double power =
            (std::erfc((q - m) / std::numbers::sqrt2) + std::erfc((q + m) / std::numbers::sqrt2)) /
            2;
        EXPECT_NEAR(power, 0.9, 1e-5);
    }
}

TEST(Distributions, FactorialsByTheirFactors) {
    double sum = 0;
    EXPECT_EQ(log_factorial(0), 0);
    for (int n = 1; n < 1000; ++n) {
        sum += std::log(n);
        EXPECT_NEAR(log_factorial(n), sum, 1e-14 + 1e-13 * sum) << n;
    }
}

TEST(Distributions, StudentIsSymmetric) {
    EXPECT_EQ(student_quantile(0.75, 9), -student_quantile(0.25, 9));
    EXPECT_NEAR(student_quantile(0.025, 10), 2.228138852, 5e-10);  // in every table
    EXPECT_NEAR(student_quantile(0.5, 3), 0, 1e-15);
}

}  // namespace stipple::testing::distributions_test
