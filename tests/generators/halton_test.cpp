// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "math/primes.hpp"
#include "math/radical_inverse.hpp"
#include "support/exact.hpp"
#include "support/sequences.hpp"

using namespace stipple;
using namespace stipple::testing;

// Radical inverses of 0..5 in bases 2 and 3, worked by hand.
TEST(Halton, FirstPointsByHand) {
    EXPECT_EQ(make("halton", points(6, 2)), points_of({{0, 0},
                                                       {1. / 2, 1. / 3},
                                                       {1. / 4, 2. / 3},
                                                       {3. / 4, 1. / 9},
                                                       {1. / 8, 4. / 9},
                                                       {5. / 8, 7. / 9}}));
    EXPECT_EQ(make("halton", points(5, 1, 1)),
              points_of({{1. / 2}, {1. / 4}, {3. / 4}, {1. / 8}, {5. / 8}}));
}

// The theorem that makes it low-discrepancy, for aligned and unaligned blocks alike. Boxes by exact
// arithmetic: floor(x b^m) is wrong where k / 3^m rounds to just under the edge it lies on.
TEST(Halton, EveryBlockMeetsEachElementaryBoxOnce) {
    for (const std::uint64_t start : {0, 1, 1000, 777777})
        for (const auto& [nx, ny] : {std::pair{8, 9}, {32, 27}, {1, 81}, {64, 1}}) {
            const auto block = static_cast<std::size_t>(nx * ny);
            const PointSet set = make("halton", points(block, 2, start));
            std::set<std::pair<int, int>> boxes;
            for (std::size_t i = 0; i < block; ++i) {
                const double nudge = 1e-9;
                boxes.emplace(static_cast<int>(set[i][0] * nx + nudge),
                              static_cast<int>(set[i][1] * ny + nudge));
            }
            EXPECT_EQ(boxes.size(), block)
                << "start " << start << ", " << nx << " x " << ny << " boxes";
        }
}

TEST(Halton, CoordinatesAreRadicalInversesInTheFirstPrimes) {
    const std::uint64_t far = (std::uint64_t{1} << 53) - 40;
    for (const std::uint64_t start : {std::uint64_t{0}, std::uint64_t{123'456'789}, far}) {
        const PointSet set = make("halton", points(40, 1000, start));
        for (std::size_t i = 0; i < 40; ++i)
            for (std::size_t k = 0; k < 1000; ++k)
                ASSERT_EQ(set[i][k], radical_inverse(start + i, primes[k])) << i << ", " << k;
    }
}

TEST(Halton, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("halton", points(50, 3)));
    EXPECT_TRUE(stretches_agree("halton", points(5000, 2)));
}

TEST(Halton, ThreadsChangeNothing) {
    EXPECT_EQ(make("halton", points(30000, 5), {}, {.threads = 1}),
              make("halton", points(30000, 5), {}, {.threads = 5}));
}

TEST(Halton, RefusesWhatIsBeyondItsTables) {
    EXPECT_EQ(error_of([] { make("halton", points(1, 1001)); }),
              "usage: --dimension: 1001 is outside [1, 1000], what halton can make");
    const std::uint64_t end = std::uint64_t{1} << 53;
    EXPECT_EQ(error_of([&] { make("halton", points(1, 1, end - 1)); }), "");
    EXPECT_EQ(error_of([&] { make("halton", points(2, 1, end - 1)); }).substr(0, 14),
              "usage: --start");
}
