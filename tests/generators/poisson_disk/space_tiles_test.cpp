// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/space_tiles.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/rng.hpp"

namespace stipple::testing::space_tiles_test {
namespace {

/// One tile of 16 or of 32 cells along each direction, with points in some of them and in its halo.
struct Scene {
    BoxSpace space;
    DiskGrid<3> grid{space, 1, 1};
    SpaceRules rules{grid};
    std::vector<std::uint32_t> lines = std::vector<std::uint32_t>(BallLines::room);
    std::vector<std::uint16_t> numbers = std::vector<std::uint16_t>(SpaceTile::halo_cells);
    SpaceTile tile{rules, 0, lines.data(), numbers.data()};
    std::vector<std::array<double, 3>> places;  ///< of the points, in cells

    Scene(std::uint64_t seed, double side) : space{{{0, 0, 0}, {side, side, side}}, true} {
        const Rng rng(seed);
        std::set<SpaceCell> taken;
        for (std::uint64_t i = 0; i < (side < 10 ? 1500 : 9000); ++i) {
            SpaceCell cell;
            SpaceCell own;
            SpaceDart d{};
            std::array<double, 3> place;
            for (std::size_t k = 0; k < 3; ++k) {
                place[k] = (tile.size(k) + 4) * rng.uniform(3 * i + k) - 2;
                cell[k] = static_cast<int>(std::floor(place[k]));
                const int all = static_cast<int>(grid.cells[k]);
                own[k] = (cell[k] + all) % all;
                d.at[k] = (place[k] - cell[k] + own[k]) * grid.widths[k];
            }
            if (cell[0] >= tile.size(0) + 2 || cell[1] >= tile.size(1) + 2 ||
                cell[2] >= tile.size(2) + 2)
                continue;
            if (!taken.insert(cell).second) continue;
            bool is_own = true;
            for (std::size_t k = 0; k < 3; ++k)
                is_own = is_own && cell[k] >= 0 && cell[k] < tile.size(k);
            if (is_own) tile.points().insert(tile.points().end(), d.at.begin(), d.at.end());
            const PlacedBall added = tile.add(cell, own, d, is_own);
            cover_lines(rules.scales, {&added, 1}, tile.lines());
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

TEST(SpaceTiles, TellWhatPointsCoverInTheTileAndBeyondItsFaces) {
    for (const double side : {9.0, 18.0}) {
        const Scene scene(1, side);
        EXPECT_EQ(scene.tile.size(2), side < 10 ? 16 : 32);
        const Rng rng(2);
        std::array<int, 2> counts{};
        for (std::uint64_t i = 0; i < (side < 10 ? 20'000 : 3'000); ++i) {
            std::array<double, 3> place;
            SpaceCell cell;
            std::size_t part = 0;
            for (std::size_t k = 3; k-- > 0;) {
                place[k] = rng.uniform(3 * i + k) * scene.tile.size(k);
                cell[k] = static_cast<int>(place[k]);
                part = part * 4 + static_cast<std::size_t>((place[k] - cell[k]) * 4);
            }
            SpaceRules::Quad off{};
            for (std::size_t k = 0; k < 3; ++k)
                off[k] = static_cast<float>((place[k] - cell[k]) * scene.grid.scales[k]);
            const double nearest = scene.nearest(place);
            if (std::abs(nearest - 1) > 1e-5) {
                EXPECT_EQ(scene.tile.hit(cell, part, off), nearest < 1 ? Hit::yes : Hit::no) << i;
            }
            if (has_part(scene.tile.lines(), cell, part)) {
                EXPECT_LT(nearest, 1) << i;
            }
            NearBalls near;
            scene.tile.gather(cell, PartBits{1} << part, near);
            const std::array<float, 3> from{off[0], off[1], off[2]};
            Hit hit;
            find_hits(near, {&from, 1}, &hit);
            EXPECT_EQ(hit, scene.tile.hit(cell, part, off)) << i;
            ++counts[nearest < 1 ? 1 : 0];
        }
        EXPECT_GT(counts[0], 15);
        EXPECT_GT(counts[1], 1'500);
    }
}

TEST(SpaceTiles, KnowTheirPointsToTheLastDigit) {
    const Scene scene(3, 9);
    const SpaceCell cell{5, 0, scene.tile.size(2) - 1};
    std::size_t found = 0;
    scene.tile.for_about(cell, [&](const double* p, const SpaceCell& steps) {
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
                       static_cast<int>(std::floor(place[k])) == cell[k] + steps[k];
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

TEST(SpaceDarts, AreFoundInRunsOfCubes) {
    const Rng rng(4);
    std::vector<SpaceDart> darts(3000);
    for (std::size_t i = 0; i < darts.size(); ++i)
        darts[i].place = static_cast<std::uint16_t>(rng.below(i, 32'768));
    SpaceDarts sorted;
    EXPECT_FALSE(sorted.of(1));
    sorted.renew(1, darts);
    EXPECT_TRUE(sorted.of(1));
    for (const SpaceCell& middle :
         {SpaceCell{0, 0, 0}, {31, 3, 8}, {-1, 33, 4}, {6, 19, 13}, {34, 0, 0}}) {
        const auto about = [&](const SpaceDart& d) {
            bool near = true;
            for (std::size_t k = 0; k < 3; ++k)
                near = near && std::abs(d.cell()[k] - middle[k]) <= 2;
            return near;
        };
        std::size_t found = 0;
        sorted.for_runs({middle[0] - 2, middle[1] - 2, middle[2] - 2},
                        {middle[0] + 2, middle[1] + 2, middle[2] + 2},
                        [&](std::size_t first, std::size_t last) {
                            for (std::size_t i = first; i < last; ++i)
                                found += about(sorted.all()[i]) ? 1 : 0;
                        });
        EXPECT_EQ(found, static_cast<std::size_t>(std::ranges::count_if(darts, about)));
    }
}

}  // namespace stipple::testing::space_tiles_test
