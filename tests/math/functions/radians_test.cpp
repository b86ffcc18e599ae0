// SPDX-License-Identifier: MIT
#include "math/functions/radians.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/rng.hpp"

namespace stipple::testing::radians_test {
namespace {

using Real = boost::multiprecision::cpp_bin_float_50;

double error(double found, const Real& truth) {
    return abs(Real(found) - truth).convert_to<double>();
}

}  // namespace

// Each whole turn adds rounding errors.
TEST(Radians, SineAndCosineOfAnyAngle) {
    const Rng rng(1);
    for (std::uint64_t i = 0; i < 2000; ++i)
        for (const double size : {1e-3, 1.0, 30.0, 1e5}) {
            const double angle = size * (2 * rng.uniform(i) - 1);
            const auto [c, s] = cos_sin_radians(angle);
            const double allowed = (1 + std::abs(angle)) * 0x1p-52;
            EXPECT_LE(error(c, cos(Real(angle))), allowed) << angle;
            EXPECT_LE(error(s, sin(Real(angle))), allowed) << angle;
        }
}

// Sine and cosine to 1500 bits; near multiples of pi / 2 most of them cancel.
TEST(Radians, PreciseSineAndCosineOfHugeAnglesAndNextToQuarters) {
    using Wide = boost::multiprecision::number<
        boost::multiprecision::cpp_bin_float<1500, boost::multiprecision::digit_base_2>>;
    const auto check = [](double found, const Wide& truth) {
        const double near = truth.convert_to<double>();
        const double unit = std::nextafter(std::abs(near), 2) - std::abs(near);
        EXPECT_LE(abs(Wide(found) - truth).convert_to<double>(), 2 * unit) << near;
    };
    std::vector<double> angles = {0x1.921fb54442d18p+0,
                                  0x1.921fb54442d18p+1,
                                  1e22,
                                  -1e15,
                                  0.1,
                                  6381956970095103 * 0x1p797,
                                  std::numeric_limits<double>::max()};
    const Rng rng(4);
    for (std::uint64_t i = 0; i < 300; ++i)
        angles.push_back(std::ldexp(1 + rng.uniform(i), static_cast<int>(i * 3) - 20));
    for (int k = 1; k < 100; ++k) angles.push_back(k * std::numbers::pi / 2);
    for (const double angle : angles) {
        const auto [c, s] = precise_cos_sin(angle);
        check(c, cos(Wide(angle)));
        check(s, sin(Wide(angle)));
    }
    EXPECT_EQ(precise_cos_sin(0).cos, 1);
    EXPECT_EQ(precise_cos_sin(0).sin, 0);
    EXPECT_EQ(precise_cos_sin(1e-300).sin, 1e-300);
}

TEST(Radians, ArcsAreWithinTheirError) {
    const Rng rng(2);
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const double x = i < 3 ? 0.5 * static_cast<double>(i) : rng.uniform(i);
        EXPECT_LE(error(arc_sine(x), asin(Real(x))), 1e-15) << x;
        EXPECT_LE(error(arc_cosine(x), acos(Real(x))), 1e-15) << x;
        EXPECT_LE(error(arc_cosine(-x), acos(Real(-x))), 1e-15) << x;
    }
}

TEST(Radians, SignedAngleIsThatOfAtan2) {
    const Rng rng(3);
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const double x = 2 * rng.uniform(2 * i) - 1;
        const double y = 2 * rng.uniform(2 * i + 1) - 1;
        EXPECT_LE(error(signed_angle(y, x), atan2(Real(y), Real(x))), 1e-15) << y << " " << x;
    }
    EXPECT_EQ(signed_angle(0, 1), 0);
    EXPECT_EQ(signed_angle(1e-200, 1), 1e-200);
    EXPECT_EQ(signed_angle(0, -1), std::numbers::pi);
    EXPECT_EQ(signed_angle(1, 0), std::numbers::pi / 2);
    EXPECT_EQ(signed_angle(-1, 0), -std::numbers::pi / 2);
}

}  // namespace stipple::testing::radians_test
