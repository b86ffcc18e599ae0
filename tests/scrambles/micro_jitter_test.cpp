// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "support/nets.hpp"
#include "support/scrambling.hpp"

namespace stipple::testing::micro_jitter_test {

TEST(MicroJitter, KeepsEveryIntervalOfTheSet) {
    for (const std::uint64_t n : {1, 7, 49, 97, 256, 1000}) {
        const PointSet plain = make("hammersley", points(n, 1));  // i / n, rounded
        const PointSet moved = scrambled(plain, "micro-jitter", 2);
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_EQ(cell_of(moved[i][0], n), i);
            EXPECT_NE(moved[i][0], plain[i][0]);
        }
    }
}

TEST(MicroJitter, DoesNotMoveACoordinateJustBelowAnEdgeAcrossIt) {
    const double edge = 5. / 6;
    const double below = std::nextafter(edge, 0);  // 6 times it rounds to 5
    const PointSet moved = scrambled(points_of({{below}, {edge}}), "micro-jitter:cells=6");
    EXPECT_LT(moved[0][0], edge);
    EXPECT_GE(moved[1][0], edge);
}

TEST(MicroJitter, KeepsTheNetProperty) {
    const PointSet plain = make("hammersley", points(256, 2));
    for (const std::uint64_t seed : {1, 2, 3})
        EXPECT_TRUE(is_net(scrambled(plain, "micro-jitter", seed), 2, 0));
}

TEST(MicroJitter, CellsAreAsManyAsAskedFor) {
    const PointSet moved = scrambled(points_of({{0.0}, {0.5}, {0.99}}), "micro-jitter:cells=2");
    EXPECT_LT(moved[0][0], 0.5);
    EXPECT_GE(moved[1][0], 0.5);
    EXPECT_NE(moved[1][0], moved[2][0]);
    EXPECT_GE(moved[2][0], 0.5);
}

// Random numbers depend on a point's index: a part of a set moves as within the whole.
TEST(MicroJitter, GoesOnWhereAStretchBegins) {
    const PointSet plain = make("halton", points(100, 2));
    const PointSet whole = scrambled(plain, "micro-jitter:cells=100");
    const PointSet tail =
        scrambled(make("halton", points(40, 2, 60)), "micro-jitter:cells=100", 1, 60);
    for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(tail[i][0], whole[60 + i][0]);
}

// Random numbers are numbered by 64 bits, of which a coordinate takes 20.
TEST(MicroJitter, DoesNotRepeatItself) {
    const PointSet plain = points_of({{0.5, 0.5}});
    const std::string spec = "micro-jitter:cells=1";
    const std::uint64_t far = std::uint64_t{1} << 44;
    EXPECT_NE(scrambled(plain, spec, 1, far)[0][0], scrambled(plain, spec, 1, 0)[0][0]);
    EXPECT_NE(scrambled(plain, spec, 1, 2 * far)[0][0], scrambled(plain, spec, 1, far)[0][0]);
}

}  // namespace stipple::testing::micro_jitter_test
