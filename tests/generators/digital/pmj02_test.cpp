// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "support/nets.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::pmj02_test {

TEST(Pmj02, EveryPrefixOfAPowerOfTwoMeetsAllElementaryIntervals) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const PointSet set = make("pmj02", points(4096, 2), {}, {.seed = seed});
        for (std::size_t n = 1; n <= 4096; n *= 2)
            EXPECT_TRUE(is_net(part_of(set, 0, n, {0, 1}), 2, 0)) << n << ", seed " << seed;
    }
    EXPECT_FALSE(is_net(make("pmj", points(256, 2)), 2, 0));
}

TEST(Pmj02, SoDoesEveryAlignedStretchHoweverFarOut) {
    const auto sequence = sequence_of("pmj02", points(std::uint64_t{1} << 53, 2));
    for (const std::uint64_t block : {3ULL, 77ULL, (1ULL << 43) - 1})
        EXPECT_TRUE(is_net(stretch(*sequence, 2, block << 10, 1024), 2, 0)) << block;
    EXPECT_FALSE(is_net(stretch(*sequence, 2, 1000, 1024), 2, 0));
}

TEST(Pmj02, HoldsForAMillionPoints) {
    EXPECT_TRUE(is_net(make("pmj02", points(1 << 20, 2), {}, {.seed = 8}), 2, 0));
}

// Means over 4000 seeds of a point's coordinates and of their product are within 5 standard
// deviations of 1/2 and 1/4: false alarm 6 * 6e-7.
TEST(Pmj02, EachPointIsUniformOverSeeds) {
    for (const std::uint64_t i : {0, 1, 1000}) {
        double x = 0;
        double y = 0;
        double xy = 0;
        for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
            const PointSet set = make("pmj02", points(1, 2, i), {}, {.seed = seed});
            x += set[0][0];
            y += set[0][1];
            xy += (set[0][0] - 0.5) * (set[0][1] - 0.5);
        }
        EXPECT_LT(std::abs(x / 4000 - 0.5), 5 * std::sqrt(1 / 12. / 4000)) << i;
        EXPECT_LT(std::abs(y / 4000 - 0.5), 5 * std::sqrt(1 / 12. / 4000)) << i;
        EXPECT_LT(std::abs(xy / 4000), 5 / 12. / std::sqrt(4000)) << i;
    }
}

// With the same seed, as in studies. Over 4000 seeds, the correlation of two independent uniform
// numbers has the standard deviation 1 / sqrt(4000): false alarm 6e-7 at 5 of them.
TEST(Pmj02, IsIndependentOfScrambledSobolPoints) {
    constexpr int seeds = 4000;
    double covariance = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const PointSet one = make("pmj02", points(4, 2), {}, {.seed = seed});
        const PointSet other = make("sobol", points(4, 2), {{"scramble", "owen"}}, {.seed = seed});
        EXPECT_FALSE(std::ranges::equal(one.flat(), other.flat()));
        covariance += 12 * (one[0][0] - 0.5) * (other[0][0] - 0.5) / seeds;
        const auto last = make("pmj02", points(4, 2), {}, {.seed = seed + 1});
        EXPECT_FALSE(std::ranges::equal(one.flat(), last.flat()));
    }
    EXPECT_LT(std::abs(covariance), 5 / std::sqrt(seeds));
}

TEST(Pmj02, AnyStretchIsThatOfTheWhole) { EXPECT_TRUE(stretches_agree("pmj02", points(700, 2))); }

TEST(Pmj02, IsOfThePlane) {
    EXPECT_EQ(error_of([] { make("pmj02", points(16, 3)); }),
              "usage: --dimension: 3 is outside [2, 2], the range of pmj02");
}

}  // namespace stipple::testing::pmj02_test
