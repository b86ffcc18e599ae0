// SPDX-License-Identifier: MIT
#include "generators/blue_noise/relaxation/equal_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"

namespace stipple::testing::equal_cells_test {
namespace {

std::vector<double> random_rows(std::size_t n, Vec2 sides, std::uint64_t seed) {
    std::vector<double> rows(2 * n);
    Rng(seed).fill(0, rows);
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k] *= k % 2 ? sides.y : sides.x;
    return rows;
}

std::vector<double> rescue_for(std::size_t n) {
    std::vector<double> rows(2 * n);
    Rng(99).fill(0, rows);
    for (double& x : rows) x /= 2;
    return rows;
}

/// Oracle: mass of a site's rectangle (on the torus), or of the whole one, cut by all sites and
/// their copies, in any order.
double mass_by_all(const EqualCells& cells, std::size_t i, const Planar& planar,
                   const std::optional<DensityMoments>& density) {
    const auto [a, b] = planar.sides;
    const Vec2 at = cells[i];
    const Vec2 low = planar.torus ? Vec2{-a / 2, -b / 2} : Vec2{-at.x, -at.y};
    VoronoiCell cell;
    cell.start({CellCorner{{low.x, low.y}, {}}, CellCorner{{low.x + a, low.y}, {}},
                CellCorner{{low.x + a, low.y + b}, {}}, CellCorner{{low.x, low.y + b}, {}}});
    const int turns = planar.torus ? 2 : 0;
    for (std::size_t j = 0; j < cells.count(); ++j)
        for (int tx = -turns; tx <= turns; ++tx)
            for (int ty = -turns; ty <= turns; ++ty) {
                if (j == i) continue;
                const Vec2 d{cells[j].x + tx * a - at.x, cells[j].y + ty * b - at.y};
                const double lead = cells.weights()[i] - cells.weights()[j];
                cell.cut(d, (d.x * d.x + d.y * d.y + lead) / 2, 0);
            }
    return (density ? (*density)(cell, at) : cell.moments()).mass;
}

}  // namespace

TEST(EqualCells, EveryCellHasItsShareByItsDefinition) {
    const Vec2 sides{2, 0.5};
    const std::vector<double> values{1, 20, 0.1, 3, 5, 0.01};
    const double mean = (1 + 20 + 0.1 + 3 + 5 + 0.01) / 6;
    std::vector<double> scaled;
    for (const double value : values) scaled.push_back(value / mean);
    for (const bool torus : {true, false})
        for (const bool dense : {false, true})
            for (const std::size_t n : {1U, 2U, 3U, 5U, 60U}) {
                const Planar planar{.low = {0, 0}, .sides = sides, .torus = torus};
                std::optional<DensityMoments> density;
                if (dense) density.emplace(3, 2, scaled, sides);
                EqualCells cells(planar, density, random_rows(n, sides, n), {});
                SCOPED_TRACE(::testing::Message() << n << (torus ? ", torus" : ", walls") << dense);
                EXPECT_LE(cells.equalize(1e-10, rescue_for(n)), 1e-10);
                const double share = 1 / static_cast<double>(n);
                for (std::size_t i = 0; i < n; ++i)
                    EXPECT_NEAR(mass_by_all(cells, i, planar, density), share, 2e-10 * share);
            }
}

// Two sites a quarter apart on a torus of side 1: by symmetry each cell is half of it, and weights
// are equal. Between walls, with sites at 1/8 and 3/8, the border must be at 1/2: w_1 - w_0 = |1/2
// - 3/8|^2 - |1/2 - 1/8|^2 = -1/8.
TEST(EqualCells, WeightsByHand) {
    const std::optional<DensityMoments> even;
    for (const bool torus : {true, false}) {
        EqualCells cells({.low = {0, 0}, .sides = {1, 1}, .torus = torus}, even,
                         {0.125, 0.5, 0.375, 0.5}, {});
        cells.equalize(1e-12, rescue_for(2));
        EXPECT_NEAR(cells.weights()[1] - cells.weights()[0], torus ? 0 : -0.125, 1e-12);
    }
}

// Alternates weights and centroids; both lower the cost of transport.
TEST(EqualCells, TheCostNeverRises) {
    const std::optional<DensityMoments> even;
    for (const bool torus : {true, false}) {
        EqualCells cells({.low = {0, 0}, .sides = {1, 1}, .torus = torus}, even,
                         random_rows(150, {1, 1}, 4), {});
        double last = 1e9;
        for (int step = 0; step < 40; ++step) {
            cells.equalize(1e-10, rescue_for(150));
            double energy = 0;
            for (const CellMoments& cell : cells.moments()) energy += cell.second;
            EXPECT_LE(energy, last * (1 + 1e-9)) << step;
            last = energy;
            cells.move_to_centroids();
        }
        EXPECT_LT(150 * last, 0.18);  // hexagons: 0.1604
    }
}

TEST(EqualCells, SitesInOnePlaceAreRescued) {
    const std::optional<DensityMoments> even;
    EqualCells cells({.low = {0, 0}, .sides = {1, 1}, .torus = true}, even,
                     {0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 0.2, 0.7}, {});
    EXPECT_LE(cells.equalize(1e-9, rescue_for(4)), 1e-9);
    for (const CellMoments& cell : cells.moments()) EXPECT_NEAR(cell.mass, 0.25, 1e-9);
    EXPECT_EQ(cells[0].x, 0.9);
}

}  // namespace stipple::testing::equal_cells_test
