// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/pending_darts.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/rng.hpp"

namespace stipple::testing::pending_darts_test {
using namespace stipple::poisson_disk;

namespace {

/// Darts in random cells, searched from several cells, also outside the tile.
template <std::size_t D, unsigned side_bits, unsigned block_bits>
void expect_found_by_their_cells(int reach) {
    using Pending = PendingDarts<D, side_bits, block_bits>;
    const Rng rng(D);
    std::vector<PendingDart<D>> darts;
    for (std::uint32_t i = 0; i < 3000; ++i)
        darts.push_back({{}, i, static_cast<std::uint16_t>(rng.below(i, power(Pending::side, D)))});
    Pending sorted;
    EXPECT_FALSE(sorted.of(3));
    sorted.renew(3, darts);
    EXPECT_TRUE(sorted.of(3));
    EXPECT_EQ(sorted.all().size(), darts.size());
    for (std::uint64_t i = 0; i < 40; ++i) {
        TileCell<D> low;
        TileCell<D> high;
        for (std::size_t k = 0; k < D; ++k) {
            const auto middle =
                static_cast<int>(rng.below(5000 + D * i + k, Pending::side + 8)) - 4;
            low[k] = middle - reach;
            high[k] = middle + reach;
        }
        std::set<std::uint32_t> found;
        EXPECT_FALSE(sorted.any(low, high, [&](const PendingDart<D>& d) {
            EXPECT_TRUE(found.insert(d.time).second);
            return false;
        }));
        for (const PendingDart<D>& d : darts) {
            const auto cell = Pending::cell_at(d.place);
            EXPECT_EQ(Pending::place_of(cell), d.place);
            bool in = true;
            for (std::size_t k = 0; k < D; ++k) in = in && cell[k] >= low[k] && cell[k] <= high[k];
            if (in) {
                EXPECT_TRUE(found.contains(d.time)) << D << "-D, " << i;
            }
        }
        EXPECT_LT(found.size(), darts.size());
    }
}

}  // namespace

TEST(PendingDarts, AreFoundByTheirCells) {
    expect_found_by_their_cells<2, 6, 2>(2);
    expect_found_by_their_cells<3, 5, 1>(2);
    expect_found_by_their_cells<4, 3, 1>(1);
}

TEST(PendingDarts, TheSearchEndsWithWhatItLooksFor) {
    PendingDarts<2, 6, 2> sorted;
    sorted.renew(1, std::vector<PendingDart<2>>(9));
    int seen = 0;
    EXPECT_TRUE(sorted.any({0, 0}, {9, 9}, [&](const auto&) { return ++seen == 4; }));
    EXPECT_EQ(seen, 4);
    EXPECT_FALSE(sorted.any({64, 0}, {70, 63}, [&](const auto&) { return true; }));
}

TEST(PendingDarts, TheEarlierOneComesFirst) {
    const PendingDart<2> first{{0.5, 0.1}, 1, 0};
    EXPECT_TRUE(first.before({{0.1, 0.1}, 2, 0}));
    EXPECT_FALSE(first.before({{0.1, 0.1}, 1, 0}));  // equal times are ordered by coordinates
    EXPECT_FALSE(first.before(first));
}

}  // namespace stipple::testing::pending_darts_test
