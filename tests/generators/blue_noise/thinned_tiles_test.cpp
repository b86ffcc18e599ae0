// SPDX-License-Identifier: MIT
#include "generators/blue_noise/thinned_tiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/rng.hpp"

namespace stipple::testing::thinned_tiles_test {
namespace {

using Place = std::pair<double, double>;
using Map = std::shared_ptr<const DensityMap>;

std::vector<Vec2> random_tile(std::size_t n) {
    std::vector<Vec2> tile(n);
    for (std::size_t i = 0; i < n; ++i)
        tile[i] = {Rng(4).uniform(2 * i), Rng(4).uniform(2 * i + 1)};
    return tile;
}

/// Ten columns and eight rows of random densities, some of them 0.
Map random_map() {
    std::vector<double> values(80);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = i % 7 == 0 ? 0 : std::pow(Rng(9).uniform(i), 3);
    return std::make_shared<DensityMap>(10, 8, values);
}

std::vector<Place> filled(Sequence& sequence, std::size_t count, std::size_t piece) {
    std::vector<double> rows(2 * count);
    for (std::size_t i = 0; i < count; i += piece)
        sequence.fill(i, std::span(rows).subspan(2 * i, 2 * std::min(piece, count - i)));
    std::vector<Place> places;
    for (std::size_t i = 0; i < count; ++i) places.emplace_back(rows[2 * i], rows[2 * i + 1]);
    return places;
}

/// Oracle: all points of all tiles, sorted by their scores; u by its formula.
std::vector<Place> by_definition(const std::vector<Vec2>& tile, const Tiling& tiling,
                                 const DensityMap& map, std::size_t count, std::uint64_t seed) {
    const double p = 1.32471795724474602596;
    std::vector<std::pair<double, Place>> scored;
    for (std::uint64_t j = 0; j < tiling.rows; ++j)
        for (std::uint64_t i = 0; i < tiling.columns; ++i) {
            double u = static_cast<double>(i) / p + static_cast<double>(j) / (p * p) +
                       Rng(seed, 1).uniform(0);
            u -= std::floor(u);
            for (std::size_t rank = 0; rank < tile.size(); ++rank) {
                const Place at{
                    (static_cast<double>(i) + tile[rank].x) / static_cast<double>(tiling.columns),
                    (static_cast<double>(j) + tile[rank].y) / static_cast<double>(tiling.rows)};
                const double density = map.at(at.first, at.second);
                if (density > 0) scored.emplace_back((static_cast<double>(rank) + u) / density, at);
            }
        }
    std::ranges::sort(scored);
    std::vector<Place> kept;
    for (std::size_t i = 0; i < std::min(count, scored.size()); ++i)
        kept.push_back(scored[i].second);
    return kept;
}

std::vector<Place> sorted(std::vector<Place> places) {
    std::ranges::sort(places);
    return places;
}

}  // namespace

TEST(ThinnedTiles, KeepsTheLowestScoresOfAll) {
    const Map map = random_map();
    const auto tile = random_tile(50);
    for (const Tiling tiling : {Tiling{1, 1}, Tiling{3, 2}, Tiling{1, 30}, Tiling{40, 31}})
        for (const double part : {0.0, 0.01, 0.2, 0.7}) {
            const auto count =
                1 + static_cast<std::size_t>(part * 50 * static_cast<double>(tiling.tiles()));
            const auto sequence = thinned_tiles(tile, tiling, map, count, 6, {});
            ASSERT_TRUE(sequence);
            EXPECT_EQ(sorted(filled(*sequence, count, count)),
                      sorted(by_definition(tile, tiling, *map, count, 6)))
                << tiling.columns << " x " << tiling.rows << " tiles, " << count;
        }
}

TEST(ThinnedTiles, TakesEveryPointWithADensityAndNoMore) {
    const Map map = random_map();
    const auto tile = random_tile(30);
    const Tiling tiling{4, 5};
    const std::size_t all = by_definition(tile, tiling, *map, 30 * 20, 1).size();
    ASSERT_LT(all, 30U * 20U);
    EXPECT_TRUE(thinned_tiles(tile, tiling, map, all, 1, {}));
    EXPECT_FALSE(thinned_tiles(tile, tiling, map, all + 1, 1, {}));
}

// Densities in random order, spread over the range of double.
TEST(ThinnedTiles, TakesAnyContrast) {
    const auto map =
        std::make_shared<DensityMap>(3, 2, std::vector<double>{1e-300, 1, 0, 1e-9, 4e-320, 1e-100});
    const auto tile = random_tile(40);
    const Tiling tiling{6, 6};
    for (const std::size_t count : {1U, 200U, 300U, 700U, 900U}) {
        const auto sequence = thinned_tiles(tile, tiling, map, count, 2, {});
        ASSERT_TRUE(sequence);
        EXPECT_EQ(sorted(filled(*sequence, count, count)),
                  sorted(by_definition(tile, tiling, *map, count, 2)))
            << count;
    }
}

// If the density repeats, points of different tiles have equal scores; these are ordered by tile.
TEST(ThinnedTiles, EqualScoresStandByTile) {
    const std::vector<Vec2> tile(9, Vec2{0.5, 0.5});
    const auto map = std::make_shared<DensityMap>(1, 1, std::vector<double>{1});
    const auto sequence = thinned_tiles(tile, {1, 1}, map, 4, 1, {});
    ASSERT_TRUE(sequence);
    EXPECT_EQ(filled(*sequence, 4, 4), std::vector<Place>(4, Place{0.5, 0.5}));
}

TEST(ThinnedTiles, AreTheSameInAnyPiecesAndForAnyThreads) {
    const Map map = random_map();
    const auto tile = random_tile(500);
    const auto one = thinned_tiles(tile, {30, 20}, map, 20'000, 3, {.threads = 1});
    const auto three = thinned_tiles(tile, {30, 20}, map, 20'000, 3, {.threads = 3});
    const auto whole = filled(*one, 20'000, 20'000);
    EXPECT_EQ(whole, filled(*three, 20'000, 20'000));
    EXPECT_EQ(whole, filled(*one, 20'000, 777));
    EXPECT_NE(whole, filled(*thinned_tiles(tile, {30, 20}, map, 20'000, 4, {}), 20'000, 20'000));
}

}  // namespace stipple::testing::thinned_tiles_test
