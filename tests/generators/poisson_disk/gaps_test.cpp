// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/gaps.hpp"

#include <gtest/gtest.h>

#include <bit>

namespace stipple::testing::gaps_test {
using namespace stipple::poisson_disk;

namespace {

template <std::size_t D>
SubcellBits random_bits(std::uint64_t seed, double chance) {
    const Rng rng(seed);
    SubcellBits bits = 0;
    for (std::size_t i = 0; i < all_subcells<D>; ++i)
        if (rng.uniform(i) < chance) bits |= SubcellBits{1} << i;
    return bits;
}

/// Lowest corner of sub-cell i of a gap, in the units of gaps.
template <std::size_t D>
std::array<double, D> corner_of(const Gap<D>& gap, std::size_t i) {
    std::array<double, D> low;
    for (std::size_t k = 0; k < D; ++k, i /= subcells<D>)
        low[k] = gap.corner[k] + static_cast<double>(i % subcells<D>) * gap.subcell_side();
    return low;
}

/// Whether [low, low + side) is in the gap.
template <std::size_t D>
bool holds(const Gap<D>& gap, const std::array<double, D>& low, double side) {
    bool inside = true;
    for (std::size_t k = 0; k < D; ++k)
        inside = inside && low[k] >= gap.corner[k] && low[k] + side <= gap.corner[k] + gap.side();
    return inside;
}

/// Each open sub-cell is in exactly one of the new gaps, each of which is within the old gap and
/// has an open sub-cell.
template <std::size_t D>
void expect_nothing_lost(std::uint64_t seed, double chance, bool may_split) {
    Gap<D> gap{.corner = {}, .place = 7, .level = 3};
    gap.corner.fill(0.625);
    const auto side = gap.subcell_side();
    const SubcellBits open = random_bits<D>(seed, chance);
    if (open == 0) return;
    std::vector<Gap<D>> left;
    narrow(gap, open, may_split, left);
    std::vector<int> within(left.size());
    for (std::size_t i = 0; i < all_subcells<D>; ++i) {
        if ((open >> i & 1) == 0) continue;
        int found = 0;
        for (std::size_t g = 0; g < left.size(); ++g)
            if (holds(left[g], corner_of(gap, i), side)) ++found, ++within[g];
        EXPECT_EQ(found, 1) << D << "-D, seed " << seed << ", sub-cell " << i;
    }
    for (std::size_t g = 0; g < left.size(); ++g) {
        EXPECT_GT(within[g], 0) << "seed " << seed;
        EXPECT_EQ(left[g].place, 7);
        EXPECT_TRUE(holds(gap, left[g].corner, left[g].side()));
    }
}

}  // namespace

TEST(Gaps, TheNthBitIsFound) {
    const Rng rng(4);
    for (std::uint64_t i = 0; i < 300; ++i) {
        const SubcellBits bits = i % 2 == 0
                                     ? rng.bits(3 * i) & rng.bits(3 * i + 1) & rng.bits(3 * i + 2)
                                     : SubcellBits{1} << rng.below(i, 64);
        std::size_t n = 0;
        for (std::size_t b = 0; b < 64; ++b)
            if ((bits >> b & 1) != 0) {
                ASSERT_EQ(nth_bit(bits, n++), b);
            }
    }
    EXPECT_EQ(nth_bit(~SubcellBits{0}, 63), 63U);
}

TEST(Gaps, NarrowingLosesNothingAndKeepsNothingCovered) {
    for (std::uint64_t seed = 0; seed < 200; ++seed)
        for (const double chance : {0.01, 0.03, 0.2, 1.0})
            for (const bool may_split : {false, true}) {
                expect_nothing_lost<2>(seed, chance, may_split);
                expect_nothing_lost<3>(seed, chance, may_split);
                expect_nothing_lost<4>(seed, chance, may_split);
                expect_nothing_lost<5>(seed, chance, may_split);
                expect_nothing_lost<6>(seed, chance, may_split);
            }
}

// 8 x 8 sub-cells, open at x = 5, 6 and y = 6: contained in a gap of a quarter of the side.
TEST(Gaps, NarrowToTheOpenSubcellsInThePlane) {
    std::vector<Gap<2>> left;
    narrow<2>(Gap<2>{{0, 0}, 0, 0}, SubcellBits{0b0110'0000} << 48, false, left);
    ASSERT_EQ(left.size(), 1);
    EXPECT_EQ(left[0].level, 2);
    EXPECT_EQ(left[0].corner, (std::array<double, 2>{5. / 8, 6. / 8}));
}

TEST(Gaps, NarrowToTheOpenSubcellsInSpace) {
    const Gap<3> gap{{0.5, 0, 0}, 0, 1};
    std::vector<Gap<3>> left;
    narrow(gap, SubcellBits{1} << 63, false, left);  // the last sub-cell
    narrow(gap, SubcellBits{3} << 22, false, left);  // x 2 and 3, y 1, z 1
    ASSERT_EQ(left.size(), 2);
    EXPECT_EQ(left[0].level, 3);
    EXPECT_EQ(left[0].corner, (std::array<double, 3>{7. / 8, 3. / 8, 3. / 8}));
    EXPECT_EQ(left[1].level, 2);
    EXPECT_EQ(left[1].corner, (std::array<double, 3>{6. / 8, 1. / 8, 1. / 8}));
}

TEST(Gaps, AreSplitOnlyWhereTheyMayBe) {
    const SubcellBits ends = 0b1000'0001;
    std::vector<Gap<2>> left;
    narrow<2>(Gap<2>{{0, 0}, 0, 0}, ends, false, left);
    ASSERT_EQ(left.size(), 1);
    EXPECT_EQ(left[0].level, 0);
    left.clear();
    narrow<2>(Gap<2>{{0, 0}, 0, 0}, ends, true, left);
    ASSERT_EQ(left.size(), 2);
    EXPECT_EQ(left[0].corner, (std::array<double, 2>{0, 0}));
    EXPECT_EQ(left[1].corner, (std::array<double, 2>{0.5, 0}));
    EXPECT_EQ(left[1].level, 1);
    std::vector<Gap<3>> eight;
    narrow<3>({{0, 0, 0}, 0, 1}, ~SubcellBits{0}, true, eight);
    EXPECT_EQ(eight.size(), 8);
}

TEST(Gaps, PlacesAreInOpenSubcells) {
    const Gap<2> gap{{0.25, 0.5}, 3, 2};
    const SubcellBits open = random_bits<2>(5, 0.2);
    SplitMix64 mixer = stream_of(9, gap);
    for (int i = 0; i < 300; ++i) {
        const auto place = place_in(gap, open, std::size_t(std::popcount(open)), mixer);
        const auto x = static_cast<unsigned>((place[0] - 0.25) * 32);
        const auto y = static_cast<unsigned>((place[1] - 0.5) * 32);
        EXPECT_TRUE((open >> (x + 8 * y) & 1) != 0) << place[0] << ", " << place[1];
    }
}

}  // namespace stipple::testing::gaps_test
