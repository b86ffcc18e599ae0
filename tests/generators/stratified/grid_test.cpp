// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "support/exact.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::grid_test {

TEST(Grid, CentersAndCornersByHand) {
    EXPECT_EQ(make("grid", points(4, 2)),
              points_of({{0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}));
    EXPECT_EQ(make("grid", points(4, 2), {{"cell", "corner"}}),
              points_of({{0, 0}, {0.5, 0}, {0, 0.5}, {0.5, 0.5}}));
    EXPECT_EQ(make("grid", points(1, 5)), points_of({{0.5, 0.5, 0.5, 0.5, 0.5}}));
    EXPECT_EQ(make("grid", points(3, 1), {{"cell", "corner"}}),
              points_of({{0}, {1. / 3}, {2. / 3}}));
}

TEST(Grid, ShapeGivesCountAndDimension) {
    const PointSet set = make("grid", {}, {{"shape", "3x2"}});
    EXPECT_EQ(set, points_of({{1. / 6, 0.25},
                              {3. / 6, 0.25},
                              {5. / 6, 0.25},
                              {1. / 6, 0.75},
                              {3. / 6, 0.75},
                              {5. / 6, 0.75}}));
    EXPECT_EQ(make("grid", points(6, 2), {{"shape", "3x2"}}), set);
    EXPECT_EQ(make("grid", {}, {{"shape", "7"}}).dimension(), 1);
}

TEST(Grid, EveryCoordinateIsCorrectlyRounded) {
    const PointSet centers = make("grid", {}, {{"shape", "49x103x2"}});
    const PointSet corners = make("grid", {}, {{"shape", "49x103x2"}, {"cell", "corner"}});
    for (std::size_t i = 0; i < centers.count(); ++i) {
        const std::size_t cell[] = {i % 49, i / 49 % 103, i / (49 * 103)};
        const std::size_t sides[] = {49, 103, 2};
        for (std::size_t k = 0; k < 3; ++k) {
            const Fraction corner(cell[k], sides[k]);
            ASSERT_TRUE(is_nearest_double(corners[i][k], corner)) << i << ", " << k;
            ASSERT_TRUE(is_nearest_double(centers[i][k], corner + Fraction(1, 2 * sides[k])))
                << i << ", " << k;
        }
    }
}

TEST(Grid, StaysBelowOneAtTheLargestCounts) {
    for (const std::uint64_t n : {(std::uint64_t{1} << 53) - 1, std::uint64_t{1} << 53})
        for (const char* cell : {"center", "corner"}) {
            const auto sequence = sequence_of("grid", points(n, 1), {{"cell", cell}});
            const PointSet end = stretch(*sequence, 1, n - 3, 3);
            for (std::size_t i = 0; i < 3; ++i) {
                EXPECT_LT(end[i][0], 1) << n << " " << cell;
                EXPECT_GE(end[i][0], 1 - 4 * 0x1p-53) << n << " " << cell;
            }
        }
}

TEST(Grid, DefaultCountIsTheNearestTo1024) {
    EXPECT_EQ(make("grid", {}).count(), 1024);
    EXPECT_EQ(make("grid", {.dimension = 1}).count(), 1024);
    EXPECT_EQ(make("grid", {.dimension = 3}).count(), 1000);
    EXPECT_EQ(make("grid", {.dimension = 5}).count(), 1024);
}

TEST(Grid, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("grid", points(64, 3)));
    EXPECT_TRUE(stretches_agree("grid", points(60, 3), {{"shape", "3x4x5"}, {"cell", "corner"}}));
    EXPECT_TRUE(stretches_agree("grid", points(60, 2), {{"shape", "1x60"}}));
}

TEST(Grid, ThreadsChangeNothing) {
    EXPECT_EQ(make("grid", points(40'000, 2), {}, {.threads = 1}),
              make("grid", points(40'000, 2), {}, {.threads = 5}));
}

TEST(Grid, RefusesWhatItCannotMakeAndSaysWhatItCan) {
    const auto refusal = [](const Request& request, const Settings& settings) {
        return error_of([&] { make("grid", request, settings); });
    };
    EXPECT_EQ(refusal(points(1000, 2), {}),
              "usage: --count: 1000 is not k^2, as grid needs; 961 and 1024 are the nearest");
    EXPECT_EQ(refusal(points(1000, 60), {}),
              "usage: --count: 1000 is not k^60, as grid needs; 1 is the nearest");
    EXPECT_EQ(refusal(points(1000, 2), {{"shape", "40x26"}}),
              "usage: --count: 1000 contradicts --shape 40x26, which has 1040 points");
    EXPECT_EQ(refusal({.dimension = 3}, {{"shape", "40x25"}}),
              "usage: --dimension: 3 contradicts --shape 40x25, which has 2 directions");
    EXPECT_EQ(refusal({}, {{"shape", "4294967296x4294967296"}}),
              "usage: --shape: 4294967296x4294967296 has more than 2^64 points");
    EXPECT_NE(refusal({}, {{"shape", "4294967296x2097153"}}), "");
    EXPECT_NE(refusal({}, {{"shape", "40x0"}}), "");
    EXPECT_NE(refusal({}, {{"cell", "edge"}}), "");
    EXPECT_NE(refusal(points(4, 2, 1), {}), "");
}

}  // namespace stipple::testing::grid_test
