// SPDX-License-Identifier: MIT
#include "math/functions/trigonometry.hpp"

#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <vector>

namespace stipple::testing::trigonometry_test {
namespace {

using Real = boost::multiprecision::cpp_bin_float_50;
const Real two_pi = boost::math::constants::two_pi<Real>();

/// Distance of x from the true value in units in the last place of the true value.
double ulps(double x, const Real& truth) {
    const double near = std::abs(truth.convert_to<double>());
    const double unit = std::nextafter(near, std::numeric_limits<double>::infinity()) - near;
    return (abs(Real(x) - truth) / unit).convert_to<double>();
}

/// Random angles, all multiples of 1/16 and their neighbours, and very small angles.
std::vector<double> angles() {
    std::vector<double> list;
    const Rng rng(3);
    for (std::uint64_t i = 0; i < 4000; ++i) list.push_back(rng.uniform(i));
    for (int k = 0; k <= 16; ++k) {
        const double u = k / 16.0;
        if (k > 0) list.push_back(std::nextafter(u, 0));
        if (k < 16) list.push_back(u);
        if (k < 16) list.push_back(std::nextafter(u, 1));
    }
    for (const double u : {1e-3, 1e-8, 1e-17, 1e-100, 1e-300, 0x1p-53, one_minus_ulp})
        list.push_back(u);
    return list;
}

}  // namespace

TEST(Trigonometry, SineAndCosineAreWithinOneUnitInTheLastPlace) {
    for (const double u : angles()) {
        const auto [c, s] = cos_sin_turns(u);
        // Reduced here, so that the oracle is precise near the zeros.
        const int quarter = static_cast<int>(std::floor(4 * u + 0.5));
        const Real t = two_pi * (Real(u) - Real(quarter) / 4);
        const Real cs[] = {cos(t), -sin(t), -cos(t), sin(t)};
        EXPECT_LE(ulps(c, cs[quarter % 4]), 1.0) << std::hexfloat << u;
        EXPECT_LE(ulps(s, cs[(quarter + 3) % 4]), 1.0) << std::hexfloat << u;
    }
}

TEST(Trigonometry, WholeEighthsAreExact) {
    const double half_root = std::sqrt(0.5);
    const double expected[8][2] = {
        {1, 0},  {half_root, half_root},   {0, 1},  {-half_root, half_root},
        {-1, 0}, {-half_root, -half_root}, {0, -1}, {half_root, -half_root}};
    for (int k = 0; k < 8; ++k) {
        const auto [c, s] = cos_sin_turns(k / 8.0);
        EXPECT_EQ(c, expected[k][0]) << k << "/8";
        EXPECT_EQ(s, expected[k][1]) << k << "/8";
        EXPECT_FALSE(c == 0 && std::signbit(c)) << k << "/8";
        EXPECT_FALSE(s == 0 && std::signbit(s)) << k << "/8";
        EXPECT_EQ(turns_of(expected[k][0], expected[k][1]), k / 8.0);
    }
}

TEST(Trigonometry, SymmetriesHoldToTheLastBit) {
    for (int i = 0; i <= 1000; ++i) {
        const double u = i * 0x1p-13;  // in [0, 1/8), and 1/4 - u, 1/2 - u, 1 - u are exact
        const auto [c, s] = cos_sin_turns(u);
        EXPECT_EQ(cos_sin_turns(0.25 - u).cos, s) << u;
        EXPECT_EQ(cos_sin_turns(0.25 - u).sin, c) << u;
        EXPECT_EQ(cos_sin_turns(0.5 - u).cos, -c) << u;
        EXPECT_EQ(cos_sin_turns(0.5 + u).sin, -s) << u;
        EXPECT_EQ(cos_sin_turns(1 - u).cos, c) << u;
        EXPECT_EQ(cos_sin_turns(1 - u).sin, -s) << u;
    }
}

TEST(Trigonometry, AngleOfAVectorIsWithinTwoToTheMinus53) {
    const Rng rng(4);
    for (std::uint64_t i = 0; i < 8000; ++i) {
        // All directions, with very different lengths and coordinates.
        const double x = (2 * rng.uniform(3 * i) - 1) * std::ldexp(1, static_cast<int>(i % 40));
        const double y = (2 * rng.uniform(3 * i + 1) - 1) * std::ldexp(1, static_cast<int>(i % 23));
        Real truth = atan2(Real(y), Real(x)) / two_pi;
        if (truth < 0) truth += 1;
        const double angle = turns_of(x, y);
        EXPECT_LE(abs(Real(angle) - truth), Real(0x1p-53)) << x << ", " << y;
        if (truth < 0.125) {
            EXPECT_LE(ulps(angle, truth), 2.0) << x << ", " << y;
        }
        EXPECT_GE(angle, 0);
        EXPECT_LT(angle, 1);
    }
}

TEST(Trigonometry, AngleGoesBackFromSineAndCosine) {
    for (const double u : angles()) {
        const auto [c, s] = cos_sin_turns(u);
        EXPECT_NEAR(turns_of(c, s), u, 3e-16) << std::hexfloat << u;
        if (u > 0 && u < 0.1) {
            EXPECT_NEAR(turns_of(c, s) / u, 1, 1e-15) << std::hexfloat << u;
        }
    }
}

TEST(Trigonometry, AngleAtTheEdgesOfItsArguments) {
    EXPECT_EQ(turns_of(0, 0), 0);
    EXPECT_EQ(turns_of(-0.0, -0.0), 0);
    EXPECT_EQ(turns_of(1, -0.0), 0);
    EXPECT_EQ(turns_of(-1, -0.0), 0.5);
    EXPECT_EQ(turns_of(-1, 0.0), 0.5);
    EXPECT_EQ(turns_of(0, 5e-324), 0.25);
    EXPECT_EQ(turns_of(0, -1e300), 0.75);
    EXPECT_EQ(turns_of(1, -1e-300), one_minus_ulp) << "a whole turn is no angle";
    EXPECT_EQ(turns_of(1e300, -5e-324), one_minus_ulp);
    EXPECT_EQ(turns_of(3e-320, 3e-320), 0.125);
}

// A change of any bit would change points: these are the bits of the first build, and the tests
// above compare them with true values.
TEST(Trigonometry, BitsStayTheSame) {
    std::uint64_t sum = 0;
    const Rng rng(5);
    for (std::uint64_t i = 0; i < 10000; ++i) {
        const auto [c, s] = cos_sin_turns(rng.uniform(i));
        const double angle = turns_of(c, rng.uniform(i + 1) - 0.5);
        for (const double x : {c, s, angle}) sum = sum * 31 + std::bit_cast<std::uint64_t>(x);
    }
    EXPECT_EQ(sum, 10738784635086853442U);
}

}  // namespace stipple::testing::trigonometry_test
