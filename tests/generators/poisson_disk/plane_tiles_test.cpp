// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/plane_tiles.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/rng.hpp"

namespace stipple::testing::plane_tiles_test {
namespace {

BoxSpace space_of_cells(double columns, double rows, bool torus) {
    return {{{0, 0}, {columns - 0.5, rows - 0.5}}, torus};
}

constexpr double radius = 1.4142135623730951;  // cells of side 1, or a little less

}  // namespace

TEST(PlaneTiles, ShareTheCells) {
    for (const double columns : {5, 63, 64, 65, 66, 127, 129, 300})
        for (const double rows : {6, 64, 65, 130}) {
            const DiskGrid<2> grid(space_of_cells(columns, rows, true), radius, radius);
            std::vector<int> owners(grid.cell_count);
            for (std::size_t t = 0; t < grid.tile_count; ++t) {
                const auto [first, last] = plane_tile(grid, t);
                for (std::size_t k = 0; k < 2; ++k) {
                    EXPECT_LE(last[k] - first[k], DiskGrid<2>::tile_side);
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

// Every tile gets the points of its cells and, as those of others, all that are two cells from
// them; it then covers what a grid that is one whole covers, and hits what is too near.
TEST(PlaneTiles, CoverAndHitWhatOneWholeDoes) {
    for (const bool torus : {true, false})
        for (const auto& [columns, rows] : {std::pair{5, 7}, {64, 65}, {130, 12}}) {
            const DiskGrid<2> grid(space_of_cells(columns, rows, torus), radius, radius);
            const DiskStamps<2> stamps(grid);
            DiskCovers<2> whole(grid);
            const Rng rng(static_cast<std::uint64_t>(columns));
            std::vector<std::array<double, 2>> places;
            std::set<std::array<std::uint32_t, 2>> taken;
            for (std::uint64_t i = 0; i < grid.cell_count / 4; ++i) {
                const std::array<double, 2> p{rng.uniform(2 * i) * grid.cells[0],
                                              rng.uniform(2 * i + 1) * grid.cells[1]};
                const DiskGrid<2>::Index cell{static_cast<std::uint32_t>(p[0]),
                                              static_cast<std::uint32_t>(p[1])};
                if (!taken.insert(cell).second) continue;
                places.push_back(p);
                whole.add(cell,
                          {static_cast<float>((p[0] - cell[0]) * grid.scales[0]),
                           static_cast<float>((p[1] - cell[1]) * grid.scales[1])},
                          false);
            }
            for (std::size_t t = 0; t < grid.tile_count; ++t) {
                const auto [first, last] = plane_tile(grid, t);
                const std::size_t needed = DiskSpots::needed(last[1] - first[1]);
                std::vector<Spot> spots(needed);
                std::vector<PartBits> covered(needed);
                std::vector<std::uint16_t> indices(needed);
                PlaneTile tile(grid, t, {spots.data(), covered.data(), indices.data()});
                for (const auto& p : places)
                    for (int image = 0; image < (torus ? 9 : 1); ++image) {
                        const std::array<double, 2> at{grid.low[0] + p[0] * grid.widths[0],
                                                       grid.low[1] + p[1] * grid.widths[1]};
                        const int around[2] = {image % 3 == 2 ? -1 : image % 3,
                                               image / 3 == 2 ? -1 : image / 3};
                        std::array<double, 2> place;
                        int cell[2];
                        bool own = true;
                        for (std::size_t k = 0; k < 2; ++k) {
                            place[k] = p[k] - first[k] + around[k] * double{1} * grid.cells[k];
                            cell[k] = static_cast<int>(std::floor(place[k]));
                            own = own && cell[k] >= 0 && cell[k] < tile.size(k);
                        }
                        const Spot spot = tile.spots().spot_of(place[0], place[1]);
                        const std::array<float, 2> off{
                            static_cast<float>((p[0] - std::floor(p[0])) * grid.scales[0]),
                            static_cast<float>((p[1] - std::floor(p[1])) * grid.scales[1])};
                        const auto* stamp = stamps.about(off);
                        if (own)
                            tile.add(cell[0], cell[1], spot, at, stamp);
                        else
                            tile.add_beyond(cell[0], cell[1], spot, at, stamp);
                    }
                for (int y = 0; y < tile.size(1); ++y)
                    for (int x = 0; x < tile.size(0); ++x) {
                        const DiskGrid<2>::Index cell{first[0] + static_cast<std::uint32_t>(x),
                                                      first[1] + static_cast<std::uint32_t>(y)};
                        ASSERT_EQ(*tile.covered(PlaneTile::spot_number(x, y)),
                                  *whole.row(grid.spot_of(cell)))
                            << x << ", " << y << " of tile " << t;
                        const std::array<double, 2> at{
                            grid.low[0] + (cell[0] + 0.3) * grid.widths[0],
                            grid.low[1] + (cell[1] + 0.8) * grid.widths[1]};
                        bool near = false;
                        for (const auto& p : places) {
                            const std::array<double, 2> q{grid.low[0] + p[0] * grid.widths[0],
                                                          grid.low[1] + p[1] * grid.widths[1]};
                            near = near || tile.too_near(at.data(), q.data());
                        }
                        EXPECT_EQ(tile.hits(x, y, at.data()), near);
                    }
            }
        }
}

TEST(PlaneTiles, UndecidedDartsAreFoundByTheirCells) {
    const Rng rng(5);
    std::vector<Undecided> darts;
    for (std::uint64_t i = 0; i < 300; ++i)
        darts.push_back({{0, 0},
                         static_cast<std::uint32_t>(rng.bits(2 * i)),
                         static_cast<std::uint32_t>(rng.bits(2 * i + 1)),
                         static_cast<std::uint32_t>(i)});
    UndecidedDarts sorted;
    EXPECT_FALSE(sorted.of(3));
    sorted.renew(3, darts);
    EXPECT_TRUE(sorted.of(3));
    EXPECT_EQ(sorted.all().size(), darts.size());
    for (const auto& [low, high] : {std::pair{std::array{0, 0}, std::array{63, 63}},
                                    {{-9, 5}, {3, 9}},
                                    {{60, 62}, {99, 65}}}) {
        std::set<std::uint32_t> found;
        sorted.for_some(low, high, [&](const Undecided& u) {
            EXPECT_TRUE(found.insert(u.time).second);
            return true;
        });
        for (const Undecided& u : darts)
            if (u.column() >= low[0] && u.column() <= high[0] && u.row() >= low[1] &&
                u.row() <= high[1]) {
                EXPECT_TRUE(found.contains(u.time));
            }
    }
    int none = 0;
    sorted.for_some({64, 0}, {70, 63}, [&](const Undecided&) { return ++none > 0; });
    EXPECT_EQ(none, 0);
}

}  // namespace stipple::testing::plane_tiles_test
