// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/plane/plane_tile.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"

namespace stipple::testing::coverage_table_test {
using namespace stipple::poisson_disk;

// Compares every bit with the farthest corner of its sub-cell: sub-cells with a bit set are
// covered; the others are not, or by less than the table's resolution.
TEST(CoverageTable, BitsAreCoveredAndWhatIsWellCoveredHasItsBit) {
    for (const auto& [columns, rows] : {std::pair{9.5, 9.5}, {9.1, 30.9}, {200.5, 300.5}}) {
        const BoxSpace space{{{0, 0}, {columns, rows}}, true};
        const poisson_disk::Grid<2> grid(space, std::sqrt(2.0), std::sqrt(2.0), 64);
        const CoverageTable table(grid);
        const Rng rng(static_cast<std::uint64_t>(rows));
        std::size_t set = 0;
        for (std::uint64_t i = 0; i < 100; ++i) {
            const std::array<std::uint32_t, 2> digits{
                static_cast<std::uint32_t>(rng.bits(2 * i)),
                static_cast<std::uint32_t>(rng.bits(2 * i + 1))};
            const CoverageTable::Row* mask = table.about(digits);
            for (std::size_t cell = 0; cell < 25; ++cell)
                for (std::size_t bit = 0; bit < 64; ++bit) {
                    double squared = 0;
                    for (std::size_t k = 0; k < 2; ++k) {
                        const double step = static_cast<double>(k == 0 ? cell % 5 : cell / 5) - 2;
                        const double low =
                            step + static_cast<double>(k == 0 ? bit % 8 : bit / 8) / 8;
                        const double off = low - digits[k] * 0x1p-32;
                        const double far =
                            std::max(std::abs(off), std::abs(off + 0.125)) * grid.scales[k];
                        squared += far * far;
                    }
                    const bool covered = (mask[cell / 5][cell % 5] >> bit & 1) != 0;
                    set += covered ? 1 : 0;
                    EXPECT_TRUE(covered ? squared < 1 : std::sqrt(squared) > 1 - 0.25)
                        << "cell " << cell << ", bit " << bit << ", " << squared;
                }
        }
        EXPECT_GT(set, 100U * 64 * 3);
    }
}

}  // namespace stipple::testing::coverage_table_test
