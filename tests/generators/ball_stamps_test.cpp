// SPDX-License-Identifier: MIT
#include "generators/ball_stamps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"

using namespace stipple;

namespace {

/// Distance from a place to the farthest corner of a part of a cell.
double farthest(const std::array<double, 3>& from, const std::array<int, 3>& cell, std::size_t part,
                const std::array<double, 3>& scales) {
    double squared = 0;
    for (std::size_t k = 0; k < 3; ++k, part /= 4) {
        const double low = (cell[k] + 0.25 * static_cast<double>(part % 4)) * scales[k];
        const double high = low + 0.25 * scales[k];
        const double far = std::max(std::abs(from[k] - low), std::abs(high - from[k]));
        squared += far * far;
    }
    return std::sqrt(squared);
}

}  // namespace

// What is set is covered by the ball itself; what is covered by a ball smaller by the play of the
// table, half a diagonal of a place to each side, is set. The boxes make cells of 0.50 to 0.57 r,
// tables of 4 and of 8 places.
TEST(BallStamps, TellWhatABallCoversOfTheCellsAboutIt) {
    for (const double side : {3.0, 4.1, 28.0}) {
        const BoxSpace space{{{0, 0, 0}, {side, side + 1, side + 2}}, true};
        const DiskGrid<3> grid(space, 1, 1);
        const BallStamps stamps(grid);
        const double play = 0.577 / (side < 20 ? 4 : 8) * std::sqrt(3.0);
        const Rng rng(7);
        std::size_t set = 0;
        for (std::uint64_t i = 0; i < 300; ++i) {
            std::array<double, 3> at;
            std::array<float, 3> off;
            for (std::size_t k = 0; k < 3; ++k) {
                at[k] = rng.uniform(3 * i + k) * grid.scales[k];
                off[k] = static_cast<float>(at[k]);
            }
            const PartBits* stamp = stamps.about(off);
            for (std::size_t r = 0; r < BallStamps::rows.size(); ++r) {
                const BallStamps::Row& row = BallStamps::rows[r];
                const int steps = r < BallStamps::long_rows ? 2 : 1;
                for (int x = -steps; x <= steps; ++x)
                    for (std::size_t part = 0; part < 64; ++part) {
                        const double far = farthest(at, {x, row.y, row.z}, part, grid.scales);
                        const PartBits word =
                            stamp[row.first + static_cast<std::size_t>(x + steps)];
                        const bool covered = (word >> part & 1) != 0;
                        set += covered ? 1 : 0;
                        if (covered) {
                            EXPECT_LT(far, 1) << i << ", row " << r << ", " << x << ", " << part;
                        }
                        if (far < 1 - play - 1e-4) {
                            EXPECT_TRUE(covered) << i << ", row " << r << ", " << x << ", " << part;
                        }
                    }
                if (steps == 1) {
                    EXPECT_EQ(stamp[row.first + 3], 0);
                }
            }
        }
        // Of a ball, less a shell as thick as a part is wide: 0.6 of the volume at least.
        EXPECT_GT(static_cast<double>(set) / 300, side < 20 ? 300 : 600) << side;
    }
}

// Cells two steps away along two directions are covered in no part, where cells are cubes.
TEST(BallStamps, LeaveOutNothingThatIsCovered) {
    const std::array<double, 3> scales{0.577, 0.577, 0.577};
    for (const std::array<int, 3>& cell :
         {std::array{0, 2, 2}, {0, -2, 2}, {2, 2, 0}, {2, 0, -2}, {-2, 2, 1}})
        for (std::size_t part = 0; part < 64; ++part)
            for (const double x : {0.0, 0.577})
                for (const double y : {0.0, 0.577})
                    for (const double z : {0.0, 0.577})
                        EXPECT_GT(farthest({x, y, z}, cell, part, scales), 1);
}
