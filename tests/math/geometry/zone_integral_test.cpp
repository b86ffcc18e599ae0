// SPDX-License-Identifier: MIT
#include "math/geometry/zone_integral.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stipple::testing::zone_integral_test {
namespace {

constexpr double pi = std::numbers::pi;

/// Density 1 inside the circles.
SphereDensity within(const SphereShape& shape) {
    return [&shape](const Vector3& v) {
        for (const auto& [n, h] : shape.circles)
            if (dot(n, v) < h) return 0.0;
        return 1.0;
    };
}

void expect_integral(const Estimate& found, double value) {
    EXPECT_NEAR(found.value, value, 1e-9);
    EXPECT_LT(found.error, 1e-8);
}

}  // namespace

// Area 2 pi (1 - h) for any axis, and for caps with or without a pole.
TEST(ZoneIntegral, CapsHaveTheirArea) {
    for (const Vector3& axis :
         {Vector3{0, 0, 1}, Vector3{1, 0, 0}, Vector3{1, -2, 3}, Vector3{-1, 1e-9, -0.5}})
        for (const double h : {-0.9, 0.0, 0.3, 0.999}) {
            const SphereShape cap{.circles = {{normalized(axis), h}}};
            expect_integral(integrate_zone(within(cap), {}, cap), 2 * pi * (1 - h));
        }
}

TEST(ZoneIntegral, ZonesWithoutCirclesAreExact) {
    const SphereShape none;
    const Estimate zone = integrate_zone(within(none), {-0.25, 0.5, 0.125, 0.375}, none);
    EXPECT_DOUBLE_EQ(zone.value, 0.75 * pi / 2);
    EXPECT_EQ(zone.error, 0);
}

// An octant, and its parts below and above z = 1/2 and 45 degrees.
TEST(ZoneIntegral, CornersBetweenCirclesAreFound) {
    const SphereShape octant{.circles = {{{1, 0, 0}, 0}, {{0, 1, 0}, 0}, {{0, 0, 1}, 0}}};
    expect_integral(integrate_zone(within(octant), {}, octant), pi / 2);
    expect_integral(integrate_zone(within(octant), {0.5, 1, 0, 0.125}, octant), pi / 8);
    // A triangle with three right angles and one corner in the direction (1, 1, 1).
    const Vector3 a = normalized({1, 1, 1});
    const Vector3 b = normalized({1, -1, 0});
    const SphereShape turned{.circles = {{a, 0}, {b, 0}, {cross(a, b), 0}}};
    expect_integral(integrate_zone(within(turned), {}, turned), pi / 2);
}

// The integral of n . v over its hemisphere is pi; over the half with x > 0, for n = z, half of
// that.
TEST(ZoneIntegral, DensitiesThatAreNotLevel) {
    for (const Vector3& axis : {Vector3{0, 0, 1}, Vector3{1, 2, 2}, Vector3{0, 1, 0}}) {
        const Vector3 n = normalized(axis);
        const SphereShape shape{.circles = {{n, 0}}, .level = false};
        const auto f = [&](const Vector3& v) { return std::max(dot(n, v), 0.0); };
        expect_integral(integrate_zone(f, {}, shape), pi);
    }
    const SphereShape up{.circles = {{{0, 0, 1}, 0}}, .level = false};
    const auto height = [](const Vector3& v) { return std::max(v[2], 0.0); };
    expect_integral(integrate_zone(height, {-1, 1, 0.25, 0.75}, up), pi / 2);
}

}  // namespace stipple::testing::zone_integral_test
