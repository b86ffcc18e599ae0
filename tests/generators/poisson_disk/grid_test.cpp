// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace stipple::testing::grid_test {
using namespace stipple::poisson_disk;

TEST(DiskGrid, TilesOfAboutTheSameSizeShareTheCells) {
    const double radius = std::sqrt(2.0);  // cells of side 1, or a little less
    for (const double columns : {1, 5, 63, 64, 65, 66, 127, 129, 300})
        for (const double rows : {6, 64, 65, 130}) {
            const BoxSpace space{{{0, 0}, {columns - 0.5, rows - 0.5}}, true};
            const poisson_disk::Grid<2> grid(space, radius, radius, 64);
            std::vector<int> owners(grid.cell_count);
            for (std::size_t t = 0; t < grid.tile_count; ++t) {
                const auto [first, last] = grid.tile(t);
                for (std::size_t k = 0; k < 2; ++k) {
                    EXPECT_LE(last[k] - first[k], 64U);
                    EXPECT_GE(last[k] - first[k], std::min(grid.cells[k], 32U));
                }
                for (std::size_t y = first[1]; y < last[1]; ++y)
                    for (std::size_t x = first[0]; x < last[0]; ++x)
                        ++owners[y * grid.cells[0] + x];
            }
            EXPECT_TRUE(std::ranges::all_of(owners, [](int n) { return n == 1; }))
                << columns << " x " << rows;
        }
}

}  // namespace stipple::testing::grid_test
