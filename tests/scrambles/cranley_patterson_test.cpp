// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "support/scrambling.hpp"

namespace stipple::testing::cranley_patterson_test {

TEST(CranleyPatterson, AddsOneVectorToAllModuloOne) {
    const PointSet plain = make("halton", points(500, 3));
    const PointSet moved = scrambled(plain, "cranley-patterson", 4);
    for (std::size_t i = 0; i < plain.count(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const double turns = moved[i][k] - plain[i][k] - moved[0][k];  // plain[0] is the origin
            EXPECT_NEAR(turns, std::round(turns), 1e-15);
        }
}

TEST(CranleyPatterson, TakesOneForZero) {
    const PointSet moved = scrambled(points_of({{0, 0}, {1, 1}}), "cranley-patterson");
    EXPECT_NEAR(moved[0][0], moved[1][0], 1e-15);
    EXPECT_NEAR(moved[0][1], moved[1][1], 1e-15);
}

TEST(CranleyPatterson, AddsAGivenVector) {
    const PointSet plain = points_of({{0, 0.5}, {0.75, 1}});
    const auto shifted = [&](const char* by) {
        return scrambled(plain, std::string("cranley-patterson:shift=[") + by + "]", 4);
    };
    EXPECT_EQ(shifted("0.25,0.25"), points_of({{0.25, 0.75}, {0, 0.25}}));
    EXPECT_EQ(shifted("2.25,-1.75"), shifted("0.25,0.25"));
    EXPECT_EQ(shifted("0,1/2"), points_of({{0, 0}, {0.75, 0.5}}));
    EXPECT_EQ(error_of([&] { shifted("0.5"); }), "usage: --shift: 1 numbers for 2 coordinates");
    const PointSet nearly_a_turn = shifted("-1e-300,0");
    for (const double x : nearly_a_turn.flat()) EXPECT_LT(x, 1);
    EXPECT_LT(shifted("0,-1e-300")[1][1], 1) << "of 1";
}

TEST(CranleyPatterson, GoesByItsOtherNames) {
    EXPECT_EQ(scramble_named("rotation"), scramble_named("cranley-patterson"));
    EXPECT_EQ(scramble_named("rotations"), nullptr);
}

}  // namespace stipple::testing::cranley_patterson_test
