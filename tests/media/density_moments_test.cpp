// SPDX-License-Identifier: MIT
#include "media/density_moments.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"

namespace stipple::testing::density_moments_test {
namespace {

/// Oracle: the cell is cut into pieces along the pixels around it, and their moments are added.
CellMoments by_pieces(const VoronoiCell& cell, Vec2 site, std::size_t width, std::size_t height,
                      const std::vector<double>& values, Vec2 sides) {
    const auto w = static_cast<int>(width);
    const auto h = static_cast<int>(height);
    CellMoments sum;
    for (int i = -2 * w; i < 3 * w; ++i)
        for (int j = -2 * h; j < 3 * h; ++j) {
            VoronoiCell piece = cell;
            piece.cut({-1, 0}, site.x - i * sides.x / w, 0);
            piece.cut({1, 0}, (i + 1) * sides.x / w - site.x, 0);
            piece.cut({0, -1}, site.y - j * sides.y / h, 0);
            piece.cut({0, 1}, (j + 1) * sides.y / h - site.y, 0);
            const auto at = static_cast<std::size_t>((j + 2 * h) % h * w + (i + 2 * w) % w);
            const CellMoments part = piece.moments();
            sum.mass += values[at] * part.mass;
            sum.first.x += values[at] * part.first.x;
            sum.first.y += values[at] * part.first.y;
            sum.second += values[at] * part.second;
        }
    return sum;
}

}  // namespace

TEST(DensityMoments, AreThoseOfTheCellCutIntoPixels) {
    for (const Vec2 sides : {Vec2{1, 1}, Vec2{3, 0.5}})
        for (const auto& [w, h] :
             {std::pair<std::size_t, std::size_t>{1, 1}, {5, 3}, {1, 9}, {8, 8}})
            for (const std::size_t n : {1U, 2U, 12U, 60U}) {
                std::vector<double> values(w * h);
                Rng(1).fill(0, values);
                values[0] = 0;
                std::vector<double> rows(2 * n);
                Rng(n).fill(1, rows);
                for (std::size_t k = 0; k < 2 * n; ++k) rows[k] *= k % 2 ? sides.y : sides.x;
                const PeriodicVoronoi sites(sides, true, rows);
                const DensityMoments moments(w, h, values, sides);
                VoronoiCell cell;
                for (std::size_t i = 0; i < n; ++i) {
                    sites.cut_cell(i, cell);
                    const CellMoments found = moments(cell, sites[i]);
                    const CellMoments oracle = by_pieces(cell, sites[i], w, h, values, sides);
                    ASSERT_NEAR(found.mass, oracle.mass, 1e-14) << w << " x " << h << ", " << n;
                    ASSERT_NEAR(found.first.x, oracle.first.x, 1e-13);
                    ASSERT_NEAR(found.first.y, oracle.first.y, 1e-13);
                    ASSERT_NEAR(found.second, oracle.second, 1e-12);
                }
            }
}

// Across pixels of 1, 2, 4 along the diagonal of a 3 x 3 grid, and one more beyond it.
TEST(DensityMoments, AlongALineByHand) {
    const DensityMoments moments(3, 3, std::vector<double>{1, 0, 0, 0, 2, 0, 0, 0, 4}, {1, 1});
    EXPECT_NEAR(moments.along({0.5, 0}, {0.5, 1}), 2.0 / 3, 1e-15);
    EXPECT_NEAR(moments.along({-1, 0.5}, {2, 0.5}), 2, 1e-15);
    EXPECT_NEAR(moments.along({0.9, 0.95}, {0.7, 0.95}), 0.8, 1e-15);
}

}  // namespace stipple::testing::density_moments_test
