// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "support/units.hpp"

using namespace stipple;
using namespace stipple::testing;

namespace {

const std::string name = "tiled";
const Settings small{{"tile-points", "64"}, {"iterations", "100"}};

double smallest_distance(const PointSet& set) {
    double least = 1;
    for (std::size_t i = 0; i < set.count(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const double x = std::abs(set[i][0] - set[j][0]);
            const double y = std::abs(set[i][1] - set[j][1]);
            least = std::min(least, std::hypot(std::min(x, 1 - x), std::min(y, 1 - y)));
        }
    return least;
}

/// How often each place of the tile is taken, in units of 2^-28.
std::map<std::pair<double, double>, std::size_t> places(const PointSet& set, double side) {
    std::map<std::pair<double, double>, std::size_t> found;
    for (std::size_t i = 0; i < set.count(); ++i) {
        const auto inside = [&](double x) {
            const double t = std::round(x * side * 0x1p28) / 0x1p28;
            return t - std::floor(t);
        };
        ++found[{inside(set[i][0]), inside(set[i][1])}];
    }
    return found;
}

}  // namespace

// 64 in a tile at most: 1000 points need 4 x 4 tiles of 63, eight of which lack one point.
TEST(Tiled, RepeatsOneTileAndThinsItsLastPoint) {
    const PointSet set = make(name, points(1000, 2), small);
    const auto found = places(set, 4);
    EXPECT_EQ(found.size(), 63U);
    std::map<std::size_t, std::size_t> times;
    for (const auto& [place, count] : found) ++times[count];
    EXPECT_EQ(times, (std::map<std::size_t, std::size_t>{{16, 62}, {8, 1}}));
}

TEST(Tiled, EveryTileHasAsManyPointsUpToOne) {
    for (const std::uint64_t n : {65, 257, 1000, 1023, 1024, 1025, 5000}) {
        const auto side = static_cast<std::size_t>(std::ceil(std::sqrt((n + 63) / 64)));
        std::vector<std::uint64_t> found(side * side);
        const PointSet set = make(name, points(n, 2), small);
        for (std::size_t i = 0; i < n; ++i)
            ++found[static_cast<std::size_t>(set[i][1] * static_cast<double>(side)) * side +
                    static_cast<std::size_t>(set[i][0] * static_cast<double>(side))];
        const auto [least, most] = std::ranges::minmax(found);
        EXPECT_LE(most - least, 1U) << n;
        EXPECT_LE(most, 64U) << n;
    }
}

TEST(Tiled, KeepsTheTilesDistanceAcrossItsSeams) {
    const PointSet tile = make(name, points(64, 2), small);
    const double least = smallest_distance(tile);
    EXPECT_GT(least, 0.5 / 8);
    const PointSet set = make(name, points(64 * 25, 2), small);
    EXPECT_NEAR(smallest_distance(set), least / 5, 1e-9);
    EXPECT_GE(smallest_distance(make(name, points(64 * 25 - 24, 2), small)), 0.5 / 40);
}

// Ranks: the first half of the tile is spread better than a random half of it.
TEST(Tiled, EveryRankIsWellSpread) {
    const PointSet tile = make(name, points(1024, 2), {{"iterations", "100"}});
    for (const std::size_t n : {4U, 16U, 64U, 256U, 512U}) {
        const auto first = tile.flat().first(2 * n);
        const double spacing = 1 / std::sqrt(static_cast<double>(n));
        EXPECT_GT(smallest_distance(PointSet({first.begin(), first.end()}, 2)), 0.5 * spacing) << n;
    }
}

// The last rank's points are spread over the tiles: each half of the square has its share.
TEST(Tiled, HolesAreSpreadOverTheSquare) {
    const std::uint64_t n = 64 * 400 - 200;
    const PointSet set = make(name, points(n, 2), small);
    std::size_t below = 0;
    for (std::size_t i = 0; i < n; ++i) below += set[i][1] < 0.5;
    EXPECT_NEAR(static_cast<double>(below), static_cast<double>(n) / 2, 1);
}

TEST(Tiled, FewPointsAreOneTile) {
    for (const std::uint64_t n : {1, 2, 3, 63})
        EXPECT_EQ(make(name, points(n, 2), small).count(), n);
    EXPECT_NE(make(name, points(63, 2), small, {.seed = 2}), make(name, points(63, 2), small));
}

TEST(Tiled, ManyPointsStayBelowOne) {
    const Generator& unit = find_generator(name);
    Values options = unit.options.defaults();
    unit.options.set(options, "tile-points", "16");
    const std::uint64_t n = (std::uint64_t{1} << 53) - 1;
    const auto sequence = unit.sequence(plan_for(unit, points(n, 2), options), options, {});
    std::vector<double> rows(2000);
    for (const std::uint64_t first : {std::uint64_t{0}, n / 2, n - 1000}) {
        sequence->fill(first, rows);
        for (const double x : rows) EXPECT_TRUE(x >= 0 && x < 1) << x;
    }
}
