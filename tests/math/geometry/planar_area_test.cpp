// SPDX-License-Identifier: MIT
#include "math/geometry/planar_area.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace stipple::testing::planar_area_test {

constexpr double pi = std::numbers::pi;

TEST(PlanarArea, OfThePartOfASquareInADiskByHand) {
    const Polygon square = unit_square();
    EXPECT_NEAR(area_in_disk(square, {0.5, 0.5}, 0.5), pi / 4, 1e-15);    // touches all sides
    EXPECT_NEAR(area_in_disk(square, {0.5, 0.5}, 0.25), pi / 16, 1e-15);  // inside
    EXPECT_NEAR(area_in_disk(square, {0, 0}, 0.5), pi / 16, 1e-15);       // a quarter
    EXPECT_NEAR(area_in_disk(square, {0.5, 0}, 0.5), pi / 8, 1e-15);      // a half
    EXPECT_NEAR(area_in_disk(square, {0.3, 0.6}, 2), 1, 1e-15);           // the whole square
    EXPECT_NEAR(area_in_disk(square, {5, 5}, 1), 0, 1e-15);               // none
    EXPECT_NEAR(area_in_disk(square, {2, 0.5}, 1), 0, 1e-15);             // touches from outside
    // A strip of half-width h = 1/2 of a disk with radius 0.6.
    const double r = 0.6;
    const double cap = r * r * std::acos(0.5 / r) - 0.5 * std::sqrt(r * r - 0.25);
    EXPECT_NEAR(area_in_disk(square, {0.5, 0.5}, r), pi * r * r - 4 * cap, 1e-15);
}

TEST(PlanarArea, OfPartsThatLinesCutOff) {
    const Polygon square = unit_square();
    EXPECT_EQ(signed_area(square), 1);
    EXPECT_EQ(signed_area(clipped(square, {0.25, 0}, {1, 0})), 0.25);
    EXPECT_EQ(signed_area(clipped(square, {0.25, 0}, {-1, 0})), 0.75);
    EXPECT_EQ(signed_area(clipped(square, {0, 0}, {1, -1})), 0.5);  // through two corners
    EXPECT_EQ(signed_area(clipped(square, {1, 1}, {1, 1})), 1);     // touches one
    EXPECT_EQ(signed_area(clipped(square, {0, 0}, {1, 1})), 0);
    EXPECT_EQ(signed_area({}), 0);
}

TEST(PlanarArea, ThatTwoPolygonsShare) {
    const Polygon diamond{{0.5, 0}, {1, 0.5}, {0.5, 1}, {0, 0.5}};
    EXPECT_EQ(shared_area(diamond, unit_square()), 0.5);
    EXPECT_EQ(shared_area(unit_square(), diamond), 0.5);
    EXPECT_EQ(shared_area({diamond.rbegin(), diamond.rend()}, unit_square()), 0.5);
    EXPECT_EQ(shared_area({{2, 2}, {3, 2}, {2, 3}}, unit_square()), 0);
    EXPECT_EQ(shared_area({{0.5, 0.5}, {1.5, 0.5}, {1.5, 1.5}, {0.5, 1.5}}, unit_square()), 0.25);
}

}  // namespace stipple::testing::planar_area_test
