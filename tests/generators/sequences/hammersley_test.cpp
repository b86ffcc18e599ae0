// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "support/exact.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::hammersley_test {

// Worked by hand.
TEST(Hammersley, FirstPointsByHand) {
    EXPECT_EQ(make("hammersley", points(6, 3)), points_of({{0, 0, 0},
                                                           {1. / 6, 1. / 2, 1. / 3},
                                                           {2. / 6, 1. / 4, 2. / 3},
                                                           {3. / 6, 3. / 4, 1. / 9},
                                                           {4. / 6, 1. / 8, 4. / 9},
                                                           {5. / 6, 5. / 8, 7. / 9}}));
    EXPECT_EQ(make("hammersley", points(4, 1)), points_of({{0}, {0.25}, {0.5}, {0.75}}));
    EXPECT_EQ(make("hammersley", points(1, 2)), points_of({{0, 0}}));
}

TEST(Hammersley, SweepIsWhereAndStartsWhereItIsAskedTo) {
    EXPECT_EQ(make("hammersley", points(3, 3), {{"sweep", "last"}}),
              points_of({{0, 0, 0}, {1. / 2, 1. / 3, 1. / 3}, {1. / 4, 2. / 3, 2. / 3}}));
    EXPECT_EQ(make("hammersley", points(3, 2), {{"offset", "half"}}),
              points_of({{1. / 6, 0}, {3. / 6, 1. / 2}, {5. / 6, 1. / 4}}));
    EXPECT_EQ(make("hammersley", points(2, 2), {{"sweep", "last"}, {"offset", "half"}}),
              points_of({{0, 1. / 4}, {1. / 2, 3. / 4}}));
    EXPECT_EQ(make("hammersley", points(2, 1), {{"sweep", "last"}}), points_of({{0}, {.5}}));
}

TEST(Hammersley, HalfOffsetsAreCorrectlyRoundedUpToTheLargestCount) {
    for (const std::uint64_t n : {std::uint64_t{1} << 53, (std::uint64_t{1} << 53) - 1,
                                  std::uint64_t{1} << 52, std::uint64_t{49}}) {
        const auto sequence =
            sequence_of("hammersley", points(n, 2), {{"sweep", "last"}, {"offset", "half"}});
        for (const std::uint64_t first : {std::uint64_t{0}, n / 3, n - 9}) {
            const PointSet set = stretch(*sequence, 2, first, 9);
            for (std::size_t i = 0; i < 9; ++i) {
                const double x = set[i][1];
                ASSERT_LT(x, 1);
                ASSERT_TRUE(x == 1 - 0x1p-53 ||
                            is_nearest_double(x, Fraction(2 * (first + i) + 1, 2 * n)))
                    << first + i << " of " << n;
            }
        }
    }
}

TEST(Hammersley, IsHaltonBehindTheSweep) {
    const PointSet set = make("hammersley", points(1000, 1001));
    const PointSet halton = make("halton", points(1000, 1000));
    for (std::size_t i = 0; i < 1000; ++i) {
        ASSERT_TRUE(is_nearest_double(set[i][0], Fraction(i, 1000)));
        ASSERT_TRUE(std::ranges::equal(set[i].subspan(1), halton[i]));
    }
}

// In two dimensions n = 2^m points are a (0, m, 2)-net in base 2.
TEST(Hammersley, MeetsEachElementaryBoxOnce) {
    const int n = 1024;
    const PointSet set = make("hammersley", points(n, 2));
    for (int nx = 1; nx <= n; nx *= 2) {
        std::set<std::pair<int, int>> boxes;
        for (std::size_t i = 0; i < n; ++i)
            boxes.emplace(static_cast<int>(set[i][0] * nx), static_cast<int>(set[i][1] * (n / nx)));
        EXPECT_EQ(boxes.size(), n) << nx;
    }
}

TEST(Hammersley, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("hammersley", points(50, 3)));
    EXPECT_TRUE(stretches_agree("hammersley", points(3000, 1)));
    EXPECT_TRUE(
        stretches_agree("hammersley", points(3000, 4), {{"sweep", "last"}, {"offset", "half"}}));
}

TEST(Hammersley, StaysBelowOneAtTheLargestCount) {
    const std::uint64_t n = std::uint64_t{1} << 53;
    const auto sequence = sequence_of("hammersley", points(n, 2));
    EXPECT_EQ(stretch(*sequence, 2, n - 1, 1), points_of({{1 - 0x1p-53, 1 - 0x1p-53}}));
}

TEST(Hammersley, RefusesAStart) {
    EXPECT_EQ(error_of([] { make("hammersley", points(5, 2, 1)); }).substr(0, 14),
              "usage: --start");
}

}  // namespace stipple::testing::hammersley_test
