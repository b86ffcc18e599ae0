// SPDX-License-Identifier: MIT
#include "generators/disk_bits.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/rng.hpp"

using namespace stipple;

namespace {

template <std::size_t D>
using Index = typename DiskGrid<D>::Index;

template <std::size_t D>
DiskGrid<D> grid_of(const std::vector<double>& high) {
    const BoxSpace space{{std::vector<double>(high.size(), 0.0), high}, true};
    return {space, 0.1, 0.1};
}

/// Calls visit for every cell, counted from `margin` before the first to as many behind the last.
template <std::size_t D, class Visit>
void for_cells(const DiskGrid<D>& grid, std::uint32_t margin, const Visit& visit) {
    Index<D> cell{};
    while (true) {
        visit(cell);
        std::size_t k = 0;
        for (; k < D && ++cell[k] == grid.cells[k] + 2 * margin; ++k) cell[k] = 0;
        if (k == D) return;
    }
}

template <std::size_t D>
void expect_right_bits(const DiskGrid<D>& grid, bool shared) {
    CellBits<D> bits(grid);
    std::set<Index<D>> plain;
    const Rng rng(D);
    std::uint64_t n = 0;
    for_cells<D>(grid, 2, [&](const Index<D>& counted) {
        if (rng.uniform(n++) < 0.8) return;
        bits.set(counted, shared);
        plain.insert(counted);
    });
    for_cells<D>(grid, 0, [&](const Index<D>& cell) {
        Index<D> middle = cell;
        for (std::uint32_t& x : middle) x += 2;
        EXPECT_EQ(bits.has(cell), plain.contains(middle));
        EXPECT_EQ(bits.has_meanwhile(cell), plain.contains(middle));
        for (std::size_t z = 0; z < CellBits<D>::layers; ++z)
            for (std::size_t bit = 0; bit < 64; ++bit) {
                std::array<std::size_t, 3> step{bit % 8, bit / 8, z};
                Index<D> there;
                for (std::size_t k = 0; k < D; ++k)
                    there[k] = cell[k] + static_cast<std::uint32_t>(step[k]);
                const bool about = step[0] < 5 && step[1] < 5;
                EXPECT_EQ((bits.layer(bits.about(cell), z) >> bit & 1) != 0,
                          about && plain.contains(there))
                    << "layer " << z << ", bit " << bit;
            }
    });
    bits.clear();
    for_cells<D>(grid, 0, [&](const Index<D>& cell) { EXPECT_FALSE(bits.has(cell)); });
}

}  // namespace

TEST(CellBits, KnowTheCellsAboutEachCell) {
    for (const bool shared : {true, false}) {
        expect_right_bits(grid_of<2>({1, 1}), shared);
        expect_right_bits(grid_of<2>({0.05, 1.7}), shared);
        expect_right_bits(grid_of<2>({0.8, 0.05}), shared);
        expect_right_bits(grid_of<3>({0.5, 0.4, 0.3}), shared);
        expect_right_bits(grid_of<3>({0.05, 0.3, 0.05}), shared);
    }
}
