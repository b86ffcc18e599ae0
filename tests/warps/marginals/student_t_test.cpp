// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::student_t_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

// 1 degree of freedom: tan(pi (u - 1/2)). 2 degrees: (2 u - 1) / sqrt(2 u (1 - u)).
TEST(StudentTWarp, NumbersByHand) {
    const auto cauchy = mapping("student-t:degrees=1");
    const auto two = mapping("student-t:degrees=2");
    for (const double u : {0.001, 0.25, 0.4, 0.5, 0.75, 0.99}) {
        const double t = std::tan(std::numbers::pi * (u - 0.5));
        EXPECT_NEAR(image_of(*cauchy, {u, 0.5})[0], t, 1e-13 * std::abs(t)) << u;
        const double s = (2 * u - 1) / std::sqrt(2 * u * (1 - u));
        EXPECT_NEAR(image_of(*two, {u, 0.5})[0], s, 1e-13 * std::abs(s)) << u;
    }
    EXPECT_EQ(image_of("student-t:location=3,scale=2", {0.5, 0.5}), (std::vector{3.0, 3.0}));
}

// From tables: 10 degrees of freedom, 97.5 %: 2.228139.
TEST(StudentTWarp, APrintedQuantile) {
    EXPECT_NEAR(image_of("student-t:degrees=10", {0.975, 0.5})[0], 2.228139, 5e-7);
}

TEST(StudentTWarp, IsSymmetric) {
    const auto map = mapping("student-t");
    for (const double u : {0x1p-50, 0.125, 0.375})
        EXPECT_EQ(image_of(*map, {u, 0.5})[0], -image_of(*map, {1 - u, 0.5})[0]);
}

TEST(StudentTWarp, BothWaysAndDensity) {
    expect_round_trip(*mapping("student-t:degrees=30"), 1e-11);
    expect_density_is_one_over_stretch(*mapping("student-t:degrees=[1,5],location=1,scale=3"),
                                       2e-6);
}

TEST(StudentTWarp, HasMomentsWhereTheyExist) {
    EXPECT_FALSE(std::isfinite(mapping("student-t:degrees=1")->domain()->moments()->mean[0]));
    const auto three = *mapping("student-t:degrees=3")->domain()->moments();
    EXPECT_EQ(three.covariance[0], 3);
    EXPECT_FALSE(std::isfinite(three.skewness[0]));
    const auto m = *mapping("student-t:degrees=4,location=1,scale=3")->domain()->moments();
    EXPECT_EQ(m.mean[0], 1);
    EXPECT_EQ(m.covariance[0], 18);
}

TEST(StudentTWarp, RefusesTooFewDegrees) {
    EXPECT_EQ(refusal("student-t:degrees=0"), "usage: --degrees: 0 is outside [0.5, 1000000]");
}

}  // namespace stipple::testing::student_t_test
