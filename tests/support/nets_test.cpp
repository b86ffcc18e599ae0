// SPDX-License-Identifier: MIT
//
// Tests of the checkers that other tests use.
#include "support/nets.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/units.hpp"

namespace stipple::testing::nets_test {

// 1/3 and 2/3 in base 3 are rounded down, which x * 3 does not reveal.
TEST(Nets, CellsAreExactAtTheirEdges) {
    for (const std::uint64_t parts : {3U, 9U, 729U, 5U, 125U, 7U, 49U, 1U << 20})
        for (std::uint64_t k = 0; k < parts; k += 1 + parts / 300) {
            const double edge = static_cast<double>(k) / static_cast<double>(parts);
            EXPECT_EQ(cell_of(edge, parts), k);
            EXPECT_EQ(cell_of(std::max(0.0, std::nextafter(edge, -1.0)), parts),
                      k == 0 ? 0 : k - 1);
        }
}

TEST(Nets, TellsTheExactT) {
    // Hammersley's four points; then the diagonal, whose quarters are balanced in one direction
    // only.
    EXPECT_EQ(exact_t(points_of({{0, 0}, {0.25, 0.5}, {0.5, 0.25}, {0.75, 0.75}}), 2), 0U);
    EXPECT_EQ(exact_t(points_of({{0, 0}, {0.25, 0.25}, {0.5, 0.5}, {0.75, 0.75}}), 2), 1U);
    EXPECT_EQ(exact_t(points_of({{0, 0}, {0.25, 0}, {0.5, 0}, {0.75, 0}}), 2), 2U);
    EXPECT_EQ(exact_t(points_of({{0, 0}, {1. / 3, 1. / 3}, {2. / 3, 2. / 3}}), 3), 0U);
    EXPECT_FALSE(is_net(points_of({{0, 0}, {0.5, 0.5}, {0.75, 0.75}}), 2, 0));
    EXPECT_FALSE(is_net(points_of({{0, 0}, {0.5, 0.5}}), 2, 2));
}

}  // namespace stipple::testing::nets_test
