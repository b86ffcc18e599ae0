// SPDX-License-Identifier: MIT
#include "math/neighbors/spaced_points.hpp"

#include <gtest/gtest.h>

namespace stipple::testing::spaced_points_test {

TEST(SpacedPoints, DistanceByHand) {
    const double p[] = {0.125, 0.5};
    const double q[] = {0.875, 1.0};
    EXPECT_EQ((squared_distance<2>(p, q, {1, 2}, false)), 0.75 * 0.75 + 0.25);
    EXPECT_EQ((squared_distance<2>(p, q, {1, 2}, true)), 0.25 * 0.25 + 0.25);
    EXPECT_EQ((squared_distance<2>(p, p, {1, 2}, true)), 0);
}

TEST(SpacedPoints, CellsHaveADiagonalBelowTheRadius) {
    for (const double radius : {0.1, 0.3, 1.0, 2.5, 1e-3}) {
        const std::vector<double> cells = cells_along({{0, 0, 0}, {1, 2, 0.3}}, radius);
        const double x = 1 / cells[0];
        const double y = 2 / cells[1];
        const double z = 0.3 / cells[2];
        EXPECT_LT(x * x + y * y + z * z, radius * radius);
    }
    EXPECT_EQ(cells_along({{0, 0, 0}, {2.8868, 2.8868, 2.8868}}, 1),
              (std::vector<double>{6, 6, 6}));
}

}  // namespace stipple::testing::spaced_points_test
