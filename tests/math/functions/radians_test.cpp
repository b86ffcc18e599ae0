// SPDX-License-Identifier: MIT
#include "math/functions/radians.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <numbers>

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
