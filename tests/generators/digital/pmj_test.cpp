// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/nets.hpp"
#include "support/sequences.hpp"
#include "support/strata.hpp"

namespace stipple::testing::pmj_test {
namespace {

/// Oracle for 2 * 4^k points: two per square, in opposite quarters.
bool is_chequered(const PointSet& set, std::uint64_t side) {
    std::vector<std::vector<std::array<std::uint64_t, 2>>> squares(side * side);
    for (std::size_t i = 0; i < set.count(); ++i) {
        const std::uint64_t x = stratum_of(set[i][0], 2 * side);
        const std::uint64_t y = stratum_of(set[i][1], 2 * side);
        squares[x / 2 * side + y / 2].push_back({x, y});
    }
    return std::ranges::all_of(squares, [](const auto& in) {
        return in.size() == 2 && in[0][0] != in[1][0] && in[0][1] != in[1][1];
    });
}

/// Promise of the header for the first 2^m points.
bool is_progressive(const PointSet& set, std::size_t m) {
    const std::uint64_t side = std::uint64_t{1} << (m / 2);
    return is_latin(set) && (m % 2 == 0 ? is_balanced(set, side, {0, 1}) : is_chequered(set, side));
}

}  // namespace

TEST(Pmj, EveryPrefixOfAPowerOfTwoIsMultiJittered) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const PointSet set = make("pmj", points(2048, 2), {}, {.seed = seed});
        for (std::size_t m = 0; m <= 11; ++m)
            EXPECT_TRUE(is_progressive(part_of(set, 0, std::size_t{1} << m, {0, 1}), m))
                << "2^" << m << ", seed " << seed;
    }
    EXPECT_FALSE(is_progressive(make("jittered", points(64, 2)), 6));
    EXPECT_FALSE(is_progressive(make("latin-hypercube", points(64, 2)), 6));
    EXPECT_FALSE(is_progressive(make("latin-hypercube", points(32, 2)), 5));
}

TEST(Pmj, SoIsEveryAlignedStretchHoweverFarOut) {
    const auto sequence = sequence_of("pmj", points(std::uint64_t{1} << 53, 2));
    for (const std::uint64_t block : {1ULL, 5ULL, (1ULL << 43) - 1})
        for (const std::size_t m : {9, 10})
            EXPECT_TRUE(is_progressive(stretch(*sequence, 2, block << m, std::size_t{1} << m), m));
}

// Other elementary intervals contain one point only by chance. Each further condition on a matrix
// holds with probability of about one half, so 256 points, with six of them, satisfy all for few of
// 40 seeds.
TEST(Pmj, IsNotPmj02) {
    int nets = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed)
        nets += is_net(make("pmj", points(256, 2), {}, {.seed = seed}), 2, 0);
    EXPECT_LT(nets, 20);
}

TEST(Pmj, SeedsGiveDifferentMatrices) {
    std::vector<std::size_t> t;
    for (std::uint64_t seed = 1; seed <= 40; ++seed)
        t.push_back(exact_t(make("pmj", points(1024, 2), {}, {.seed = seed}), 2));
    std::ranges::sort(t);
    EXPECT_NE(t.front(), t.back());
}

// Means over 2000 seeds, within 5 standard deviations: false alarm 4 * 6e-7.
TEST(Pmj, EachPointIsUniformOverSeeds) {
    for (const std::uint64_t i : {0, 37}) {
        double x = 0;
        double y = 0;
        for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
            const PointSet set = make("pmj", points(1, 2, i), {}, {.seed = seed});
            x += set[0][0] - 0.5;
            y += set[0][1] - 0.5;
        }
        EXPECT_LT(std::abs(x), 5 * std::sqrt(2000 / 12.)) << i;
        EXPECT_LT(std::abs(y), 5 * std::sqrt(2000 / 12.)) << i;
    }
}

TEST(Pmj, AnyStretchIsThatOfTheWhole) { EXPECT_TRUE(stretches_agree("pmj", points(700, 2))); }

}  // namespace stipple::testing::pmj_test
