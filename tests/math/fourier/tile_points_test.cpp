// SPDX-License-Identifier: MIT
#include "math/fourier/tile_points.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace stipple::testing::tile_points_test {
namespace {

using Numbers = std::vector<double>;

Numbers points_of(const TilePoints& points, std::size_t tile) {
    Numbers found;
    points.visit(tile, [&](std::span<const double> rows) {
        EXPECT_FALSE(rows.empty());
        found.insert(found.end(), rows.begin(), rows.end());
    });
    return found;
}

/// Row i contains i, i + 1/4, i + 1/2, i + 3/4, truncated to the numbers per row; its tile is i^2
/// mod 5, so tiles 2 and 3 are empty and the others fill several blocks.
struct Given {
    Numbers rows;
    std::vector<std::uint32_t> tile_of;
    std::vector<Numbers> wanted = std::vector<Numbers>(5);

    Given(std::size_t count, std::size_t numbers) {
        for (std::size_t i = 0; i < count; ++i) {
            tile_of.push_back(static_cast<std::uint32_t>(i * i % 5));
            for (std::size_t k = 0; k < numbers; ++k) {
                rows.push_back(static_cast<double>(i) + 0.25 * static_cast<double>(k));
                wanted[tile_of.back()].push_back(rows.back());
            }
        }
    }
};

}  // namespace

// Blocks hold 32 points: counts below, at, and above multiples of it, in every non-empty tile.
TEST(TilePoints, KeepEachTilesPointsInTheirOrder) {
    for (std::size_t numbers = 1; numbers <= 4; ++numbers)
        for (const std::size_t count : {0U, 1U, 5U, 159U, 160U, 161U, 165U, 1000U}) {
            const Given given(count, numbers);
            TilePoints points(5, numbers, count);
            const std::size_t half = count / 2;
            points.add(given.rows.data(), given.tile_of.data(), half);
            points.add(given.rows.data() + half * numbers, given.tile_of.data() + half,
                       count - half);
            for (std::size_t t = 0; t < 5; ++t)
                EXPECT_EQ(points_of(points, t), given.wanted[t]) << count << " points, tile " << t;
        }
}

// Fills the capacity with points of one tile, then with one in each, repeatedly.
TEST(TilePoints, HaveRoomForTheirCapacityWhereverThePointsAre) {
    constexpr std::size_t count = 100;
    TilePoints points(count, 1, count);
    Numbers rows(count);
    std::iota(rows.begin(), rows.end(), 0.0);
    std::vector<std::uint32_t> one(count, 7);
    std::vector<std::uint32_t> each(count);
    std::iota(each.begin(), each.end(), 0U);
    for (int round = 0; round < 3; ++round) {
        points.add(rows.data(), one.data(), count);
        EXPECT_EQ(points_of(points, 7), rows);
        EXPECT_TRUE(points_of(points, 8).empty());
        points.clear();
        points.add(rows.data(), each.data(), count);
        for (std::size_t t = 0; t < count; ++t) EXPECT_EQ(points_of(points, t), Numbers{rows[t]});
        points.clear();
        EXPECT_TRUE(points_of(points, 7).empty());
    }
}

}  // namespace stipple::testing::tile_points_test
