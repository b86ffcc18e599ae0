// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/plane/plane_tile.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/rng.hpp"

namespace stipple::testing::plane_tile_test {
using namespace stipple::poisson_disk;

namespace {

constexpr double radius = 1.4142135623730951;  // cells of side 1, or a little less

/// Points in a quarter of the cells of a box, and the part of the box that they cover, computed as
/// a whole.
struct Scene {
    BoxSpace space;
    poisson_disk::Grid<2> grid{space, radius, radius, plane_side};
    PlaneRules rules{grid};
    std::vector<std::array<double, 2>> points;
    std::vector<std::array<std::uint32_t, 2>> cells;  ///< cell of each point
    std::vector<SubcellBits> covered = std::vector<SubcellBits>(grid.cell_count);

    Scene(double columns, double rows, bool torus)
        : space{{{0, 0}, {columns - 0.5, rows - 0.5}}, torus} {
        const Rng rng(static_cast<std::uint64_t>(columns));
        std::set<std::array<std::uint32_t, 2>> taken;
        for (std::uint64_t i = 0; i < grid.cell_count / 4; ++i) {
            const std::array<double, 2> place{rng.uniform(2 * i) * grid.cells[0],
                                              rng.uniform(2 * i + 1) * grid.cells[1]};
            const std::array<std::uint32_t, 2> cell{static_cast<std::uint32_t>(place[0]),
                                                    static_cast<std::uint32_t>(place[1])};
            if (!taken.insert(cell).second) continue;
            points.push_back({place[0] * grid.widths[0], place[1] * grid.widths[1]});
            cells.push_back(cell);
            cover(cell, rules.table.about({digits(place[0]), digits(place[1])}));
        }
    }

    static std::uint32_t digits(double place) {
        return static_cast<std::uint32_t>((place - std::floor(place)) * 0x1p32);
    }

    void cover(const std::array<std::uint32_t, 2>& cell, const CoverageTable::Row* mask) {
        const auto columns = static_cast<int>(grid.cells[0]);
        const auto rows = static_cast<int>(grid.cells[1]);
        for (int y = -2; y <= 2; ++y)
            for (int x = -2; x <= 2; ++x) {
                const int there[2] = {static_cast<int>(cell[0]) + x, static_cast<int>(cell[1]) + y};
                const bool inside =
                    there[0] >= 0 && there[0] < columns && there[1] >= 0 && there[1] < rows;
                if (!inside && !space.torus) continue;
                const int at = (there[1] + rows) % rows * columns + (there[0] + columns) % columns;
                covered[static_cast<std::size_t>(at)] |=
                    mask[y + 2][static_cast<std::size_t>(x + 2)];
            }
    }

    /// Points that a tile needs, including periodic images on the torus.
    [[nodiscard]] std::vector<Addition<2>> additions(PlaneTile& tile) const {
        std::vector<Addition<2>> all;
        for (std::size_t i = 0; i < points.size(); ++i)
            for (int image = 0; image < (space.torus ? 9 : 1); ++image) {
                const int around[2] = {image % 3 == 2 ? -1 : image % 3,
                                       image / 3 == 2 ? -1 : image / 3};
                Addition<2> a{points[i], {}, true};
                bool near = true;
                for (std::size_t k = 0; k < 2; ++k) {
                    a.cell[k] = static_cast<int>(cells[i][k]) - static_cast<int>(tile.first()[k]) +
                                around[k] * static_cast<int>(grid.cells[k]);
                    a.own = a.own && a.cell[k] >= 0 && a.cell[k] < tile.size(k);
                    near = near && a.cell[k] >= -2 && a.cell[k] < tile.size(k) + 2;
                }
                if (near) all.push_back(a);
                if (a.own)
                    tile.points().insert(tile.points().end(), points[i].begin(), points[i].end());
            }
        return all;
    }
};

}  // namespace

// Every tile receives the points in its cells and all points within two cells of them; then it
// covers the same as the box as a whole, and detects the same conflicts.
TEST(PlaneTile, CoversAndHitsWhatOneWholeDoes) {
    for (const bool torus : {true, false})
        for (const auto& [columns, rows] : {std::pair{5, 7}, {64, 65}, {130, 12}}) {
            const Scene scene(columns, rows, torus);
            const poisson_disk::Grid<2>& grid = scene.grid;
            for (std::size_t t = 0; t < grid.tile_count; ++t) {
                const auto [first, last] = grid.tile(t);
                const std::size_t needed = FixedPositions::needed(last[1] - first[1]);
                std::vector<FixedPosition> positions(needed);
                std::vector<SubcellBits> covered(needed);
                std::vector<std::uint16_t> indices(needed);
                PlaneTile tile(scene.rules, t, {positions.data(), covered.data(), indices.data()});
                tile.take(scene.additions(tile));
                for (int y = 0; y < tile.size(1); ++y)
                    for (int x = 0; x < tile.size(0); ++x) {
                        const std::size_t number = PlaneTile::number_of({x, y});
                        const auto column = first[0] + static_cast<std::uint32_t>(x);
                        const auto row = first[1] + static_cast<std::uint32_t>(y);
                        // Points are stored with few digits, so a point near the edge of a table
                        // entry may be assigned to the next one.
                        const SubcellBits whole =
                            scene.covered[std::size_t{row} * grid.cells[0] + column];
                        ASSERT_EQ(*tile.covered(number), whole) << x << ", " << y << " of " << t;
                        const std::array<double, 2> at{(column + 0.3) * grid.widths[0],
                                                       (row + 0.8) * grid.widths[1]};
                        const bool near = std::ranges::any_of(
                            scene.points, [&](const auto& p) { return grid.too_near(at, p); });
                        EXPECT_EQ(hits_point(tile, grid, TileCell<2>{x, y}, at), near);
                    }
            }
        }
}

}  // namespace stipple::testing::plane_tile_test
