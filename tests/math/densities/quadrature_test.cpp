// SPDX-License-Identifier: MIT
#include "math/densities/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stipple::testing::quadrature_test {
namespace {

/// Expects an integral to be correct within its stated error, which must be small.
void expect_integral(const Estimate& found, double right, double most) {
    EXPECT_NEAR(found.value, right, found.error + 1e-14 * std::abs(right));
    EXPECT_LE(found.error, most);
}

}  // namespace

// By hand; jumps at 1/9 and 1/3 are missed by rules with few points.
TEST(Quadrature, IntervalsByHand) {
    expect_integral(integrate_interval([](double x) { return x * x; }, 0, 3), 9, 1e-9);
    expect_integral(integrate_interval([](double x) { return std::sqrt(x); }, 0, 1), 2 / 3.0, 1e-9);
    expect_integral(integrate_interval([](double x) { return std::exp(-x * x); }, -9, 9),
                    std::sqrt(M_PI), 1e-9);
    for (const double jump : {1 / 9.0, 1 / 3.0, 0.3344, 0.5, 0.9989, 1 - 1e-7})
        expect_integral(integrate_interval([&](double x) { return x < jump ? 1 : 3.0; }, 0, 1),
                        3 - 2 * jump, 1e-8);
    EXPECT_EQ(integrate_interval([](double) { return 1; }, 2, 2).value, 0);
    EXPECT_EQ(integrate_interval([](double) { return 0; }, 0, 1).error, 0);
}

TEST(Quadrature, BoxesByHand) {
    const auto disk = [](std::span<const double> p) { return p[0] * p[0] + p[1] * p[1] < 1; };
    expect_integral(integrate_box(disk, {{-1, -1}, {1, 1}}, {1e-7, 100}), M_PI, 1e-5);
    const auto product = [](std::span<const double> p) { return p[0] * p[1] * p[2]; };
    expect_integral(integrate_box(product, {{0, 0, 0}, {1, 2, 3}}), 4.5, 1e-9);
}

// If the tolerance cannot be reached, the stated error exceeds it.
TEST(Quadrature, TellsWhatItDidNotReach) {
    const Estimate pole =
        integrate_interval([](double x) { return 1 / (std::abs(x - 0.37) + 1e-12); }, 0, 1,
                           {.tolerance = 1e-12, .most = 20});
    EXPECT_GT(pole.error, 0.01);
    // The outer integral is simple; only the inner one cannot be computed accurately.
    const auto inner = [](std::span<const double> p) {
        return 1 / (std::abs(p[1] - 0.37) + 1e-12);
    };
    EXPECT_GT(integrate_box(inner, {{0, 0}, {1, 1}}, {.tolerance = 1e-12, .most = 20}).error, 0.01);
}

}  // namespace stipple::testing::quadrature_test
