// SPDX-License-Identifier: MIT
#include "math/functions/incomplete_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/functions/portable_double.hpp"

namespace stipple::testing::incomplete_functions_test {
namespace {

void expect_near_relative(double value, double expected, double tolerance) {
    EXPECT_NEAR(value / expected, 1, tolerance) << value << " for " << expected;
}

}  // namespace

// Gamma(1/2)^2 = pi, Gamma(n) = (n-1)!, Gamma(x + 1/2) / Gamma(x) at 1/2: 1 / sqrt(pi).
TEST(IncompleteFunctions, GammaAtKnownPlaces) {
    expect_near_relative(log_gamma(0.5), 0.5 * std::log(std::numbers::pi), 1e-15);
    expect_near_relative(log_gamma(11), std::log(3628800.0), 1e-15);
    expect_near_relative(gamma_ratio(0.5, 0.5), 1 / std::sqrt(std::numbers::pi), 1e-15);
    expect_near_relative(gamma_ratio(1e6, 1), 1e6, 1e-14);
}

// P(1, x) = 1 - exp(-x);  Q(3, x) = exp(-x) (1 + x + x^2 / 2);  its density x^2 exp(-x) / 2.
TEST(IncompleteFunctions, GammaOfWholeNumbersByHand) {
    for (const double x : {1e-12, 0.1, 1.0, 5.0, 30.0, 600.0}) {
        expect_near_relative(gamma_below(1, x), -std::expm1(-x), 4e-16);
        expect_near_relative(gamma_above(3, x), std::exp(-x) * (1 + x + x * x / 2), 1e-13);
        expect_near_relative(gamma_density(3, x), std::exp(-x) * x * x / 2, 1e-13);
    }
}

// I_x(1, b) = 1 - (1-x)^b;  I_x(2, 2) = x^2 (3 - 2 x);  I_x(1/2, 1/2) = (2 / pi) asin(sqrt(x)).
TEST(IncompleteFunctions, BetaByHand) {
    for (const double x : {1e-12, 0.1, 0.5, 0.9}) {
        expect_near_relative(beta_below(1, 7, x), -std::expm1(7 * std::log1p(-x)), 1e-14);
        expect_near_relative(beta_below(2, 2, x), x * x * (3 - 2 * x), 1e-15);
        expect_near_relative(beta_above(2, 2, x), (1 - x) * (1 - x) * (1 + 2 * x), 1e-14);
        expect_near_relative(beta_density(2, 2, x), 6 * x * (1 - x), 1e-15);
        expect_near_relative(beta_below(0.5, 0.5, x),
                             2 / std::numbers::pi * std::asin(std::sqrt(x)), 1e-14);
    }
}

TEST(IncompleteFunctions, QuantilesInvertFromBothTails) {
    for (const double p : {1e-300, 1e-20, 0.1, 0.5, 0.9}) {
        for (const double a : {0.5, 1.0, 2.5, 40.0, 3000.0}) {
            const double x = gamma_quantile(a, p);
            if (x > 1e-300) expect_near_relative(gamma_below(a, x), p, 1e-11);
            expect_near_relative(gamma_above(a, gamma_upper_quantile(a, p)), p, 1e-11);
            const auto [y, rest] = beta_quantile(a, 3, p);
            EXPECT_NEAR(y + rest, 1, 3e-16);
            if (y > 1e-300) expect_near_relative(beta_below(a, 3, y), p, 1e-11);
        }
    }
}

// Both parts of 1: sin(pi p / 2)^2 and its complement, even if close to 1.
TEST(IncompleteFunctions, BetaQuantilesKeepTheDigitsOfBothParts) {
    const auto [y, rest] = beta_quantile(0.5, 0.5, 1 - 0x1p-40);
    EXPECT_EQ(y, 1);
    expect_near_relative(rest, std::pow(std::numbers::pi / 2 * 0x1p-40, 2), 1e-13);
}

// By continued fractions to 60 digits (mpmath), for the double x: its rounding alone would change
// probabilities by relative errors up to 1e-12.
TEST(IncompleteFunctions, LargeParametersKeepTheirDigits) {
    struct Case {
        double a, b, x, below, above;
    };
    for (const auto& [a, b, x, below, above] :
         {Case{10, 1e6, 1e-5, 0.54208217098508464, 0.45791782901491536},
          {10, 1e6, 6e-4, 1, 6.2412702457524237e-242},
          {515, 515, 0.3, 3.1187199815383358e-41, 1},
          {1e5, 1e5, 0.49, 1.8571347290404196e-19, 1},
          {0.05, 1e6, 1e-9, 0.72717921181701621, 0.27282078818298379},
          {1e6, 0.05, 0.9999, 2.3710795456083779e-47, 1},
          {3000, 300, 0.85, 1.5993328298851402e-24, 1}}) {
        expect_near_relative(beta_below(a, b, x), below, 3e-14);
        expect_near_relative(beta_above(a, b, x), above, 3e-14);
    }
    EXPECT_EQ(beta_below(1e6, 1e6, 0.48), 0);  // 2.6e-698
    expect_near_relative(gamma_above(1e5, 112176), 1.0975951485640748e-300, 3e-14);
    expect_near_relative(gamma_below(1e5, 90000), 1.9782570322356405e-235, 3e-14);
    expect_near_relative(gamma_below(1e6, 963408), 9.7545090485935119e-301, 3e-14);
    expect_near_relative(gamma_above(1e6, 1021424), 1.0049740974398115e-100, 3e-14);
    expect_near_relative(gamma_above(1e6, 1000100), 0.46004117156827642, 3e-14);
}

// For all of these B(a, b) is far below the smallest double.
TEST(IncompleteFunctions, BetaQuantilesOfLargeParameters) {
    struct Case {
        double a, b, p, x;
    };
    for (const auto& [a, b, p, x] : {Case{515, 515, 0.25, 0.48949044864362393},
                                     {515, 515, 0.75, 0.51050955135637607},
                                     {515, 515, 1e-300, 0.070949241535224748},
                                     {300, 3000, 0.5, 0.090826448309160031},
                                     {1e4, 200, 0.25, 0.97948408874593217},
                                     {1e4, 200, 1e-100, 0.93612155198087039},
                                     {1e6, 1e6, 1e-20, 0.496725302964574}}) {
        expect_near_relative(beta_quantile(a, b, p).x, x, 2e-15);
        if (p > 0.1) expect_near_relative(beta_quantile(b, a, 1 - p).rest, x, 2e-15);
    }
    EXPECT_EQ(beta_quantile(515, 515, 0).x, 0);
    EXPECT_EQ(beta_quantile(515, 515, 1).x, 1);
}

TEST(PortableDouble, FunctionsAreThoseOfTheProject) {
    for (const double x : {0.3, 1.0, 7.5, 200.0}) {
        EXPECT_EQ(exp(PortableDouble(x)).value, exponential(x));
        EXPECT_EQ(log(PortableDouble(x)).value, logarithm(x));
        EXPECT_EQ(pow(PortableDouble(x), PortableDouble(1.5)).value, real_power(x, 1.5));
        EXPECT_NEAR(sin(PortableDouble(x)).value, std::sin(x), 1e-13);
        EXPECT_NEAR(cos(PortableDouble(x)).value, std::cos(x), 1e-13);
    }
    for (const double x : {0.0, 1e-9, 0.3, 0.999, 1.0}) {
        EXPECT_NEAR(asin(PortableDouble(x)).value, std::asin(x), 1e-15);
        EXPECT_NEAR(acos(PortableDouble(x)).value, std::acos(x), 1e-15);
    }
    EXPECT_EQ(exp(PortableDouble(800)).value, INFINITY);
    EXPECT_EQ(log(PortableDouble(0)).value, -INFINITY);
}

}  // namespace stipple::testing::incomplete_functions_test
