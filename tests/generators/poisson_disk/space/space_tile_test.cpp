// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/space/space_tile.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/rng.hpp"

namespace stipple::testing::space_tile_test {
using namespace stipple::poisson_disk;

namespace {

/// One tile of 16 or of 32 cells along each direction, with points in some of them and in its halo.
struct Scene {
    BoxSpace space;
    poisson_disk::Grid<3> grid{space, 1, 1, space_side};
    SpaceRules rules{grid};
    SpaceTile tile{rules, 0};
    std::vector<std::array<double, 3>> places;  ///< positions of the points, in cells

    Scene(std::uint64_t seed, double side) : space{{{0, 0, 0}, {side, side, side}}, true} {
        const Rng rng(seed);
        std::set<TileCell<3>> taken;
        for (std::uint64_t i = 0; i < (side < 10 ? 1500 : 9000); ++i) {
            TileCell<3> cell;
            Addition<3> a{{}, {}, true};
            std::array<double, 3> place;
            bool near = true;
            for (std::size_t k = 0; k < 3; ++k) {
                place[k] = (tile.size(k) + 4) * rng.uniform(3 * i + k) - 2;
                cell[k] = a.cell[k] = static_cast<int>(std::floor(place[k]));
                const int all = static_cast<int>(grid.cells[k]);
                const int in_box = (cell[k] + all) % all;
                a.at[k] = (place[k] - cell[k] + in_box) * grid.widths[k];
                a.own = a.own && cell[k] >= 0 && cell[k] < tile.size(k);
                near = near && cell[k] < tile.size(k) + 2;
            }
            if (!near || !taken.insert(cell).second) continue;
            if (a.own) tile.points().insert(tile.points().end(), a.at.begin(), a.at.end());
            tile.take({&a, 1});
            places.push_back(place);
        }
    }

    [[nodiscard]] double distance(const std::array<double, 3>& a,
                                  const std::array<double, 3>& b) const {
        double squared = 0;
        for (std::size_t k = 0; k < 3; ++k)
            squared += (a[k] - b[k]) * (a[k] - b[k]) * grid.scales[k] * grid.scales[k];
        return std::sqrt(squared);
    }

    [[nodiscard]] double nearest(const std::array<double, 3>& place) const {
        double least = 1e9;
        for (const auto& p : places) least = std::min(least, distance(p, place));
        return least;
    }
};

}  // namespace

TEST(SpaceTile, TellWhatPointsCoverInTheTileAndBeyondItsFaces) {
    for (const double side : {9.0, 18.0}) {
        const Scene scene(1, side);
        EXPECT_EQ(scene.tile.size(2), side < 10 ? 16 : 32);
        const Rng rng(2);
        std::array<int, 2> counts{};
        for (std::uint64_t i = 0; i < (side < 10 ? 20'000 : 3'000); ++i) {
            std::array<double, 3> place;
            TileCell<3> cell;
            std::size_t subcell = 0;
            for (std::size_t k = 3; k-- > 0;) {
                place[k] = rng.uniform(3 * i + k) * scene.tile.size(k);
                cell[k] = static_cast<int>(place[k]);
                subcell = subcell * 4 + static_cast<std::size_t>((place[k] - cell[k]) * 4);
            }
            SpaceRules::Quad off{};
            for (std::size_t k = 0; k < 3; ++k)
                off[k] = static_cast<float>((place[k] - cell[k]) * scene.grid.scales[k]);
            const double nearest = scene.nearest(place);
            if (std::abs(nearest - 1) > 1e-5) {
                EXPECT_EQ(scene.tile.hit(cell, subcell, off), nearest < 1 ? Hit::yes : Hit::no)
                    << i;
            }
            if ((subcells_of(scene.tile.lines(), cell) >> subcell & 1) != 0) {
                EXPECT_LT(nearest, 1) << i;
            }
            NearDisks<3, float> near;
            scene.tile.gather(cell, SubcellBits{1} << subcell, near);
            const std::array<float, 3> at{off[0], off[1], off[2]};
            EXPECT_EQ((hits<3, float>(near, at, float_slack)), scene.tile.hit(cell, subcell, off))
                << i;
            ++counts[nearest < 1 ? 1 : 0];
        }
        EXPECT_GT(counts[0], 15);
        EXPECT_GT(counts[1], 1'500);
    }
}

TEST(SpaceTile, KnowTheirPointsToTheLastDigit) {
    const Scene scene(3, 9);
    const TileCell<3> cell{5, 0, scene.tile.size(2) - 1};
    std::size_t found = 0;
    scene.tile.for_about(cell, [&](const poisson_disk::Grid<3>::Point& p, const TileCell<3>& at) {
        ++found;
        bool known = false;
        for (const auto& place : scene.places) {
            bool same = true;
            for (std::size_t k = 0; k < 3; ++k) {
                const double all = scene.grid.cells[k];
                const double along = place[k] < 0      ? place[k] + all
                                     : place[k] >= all ? place[k] - all
                                                       : place[k];
                same = same && std::abs(along * scene.grid.widths[k] - p[k]) < 1e-12 &&
                       static_cast<int>(std::floor(place[k])) == at[k];
            }
            known = known || same;
        }
        EXPECT_TRUE(known);
        return true;
    });
    std::size_t expected = 0;
    for (const auto& place : scene.places) {
        bool about = true;
        for (std::size_t k = 0; k < 3; ++k)
            about = about && std::abs(static_cast<int>(std::floor(place[k])) - cell[k]) <= 2;
        expected += about ? 1 : 0;
    }
    EXPECT_EQ(found, expected);
    EXPECT_GT(found, 5);
}

}  // namespace stipple::testing::space_tile_test
