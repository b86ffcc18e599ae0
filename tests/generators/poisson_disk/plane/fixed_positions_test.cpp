// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/plane/plane_tile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"

namespace stipple::testing::fixed_positions_test {
using namespace stipple::poisson_disk;

namespace {

constexpr std::size_t rows = 12;
using Place = std::array<double, 2>;  // in cells, relative to the first of the tile

/// Positions in a tile, some of whose cells have a point.
struct Field {
    Field(const Place& origin, const Place& cell, double share, std::uint64_t seed)
        : room(FixedPositions::needed(rows)), sides(cell) {
        for (std::size_t k = 0; k < 2; ++k) in_units[k] = cell[k] * units_per_radius;
        const Place from{origin[0] * in_units[0], origin[1] * in_units[1]};
        positions = FixedPositions(from, in_units, rows, room.data());
        const Rng rng(seed);
        std::uint64_t i = 0;
        for (std::size_t y = 0; y < rows + 4; ++y)
            for (std::size_t x = 0; x < FixedPositions::stride; ++x, i += 3) {
                if (rng.uniform(i) >= share) continue;
                const Place p{static_cast<double>(x) - 2 + rng.uniform(i + 1),
                              static_cast<double>(y) - 2 + rng.uniform(i + 2)};
                positions.put(FixedPositions::number(x, y), positions.position_of(p[0], p[1]));
                points.push_back(p);
            }
    }

    /// Distance of two positions, in radii.
    [[nodiscard]] double distance(const Place& p, const Place& q) const {
        return std::hypot((p[0] - q[0]) * sides[0], (p[1] - q[1]) * sides[1]);
    }
    [[nodiscard]] double nearest(const Place& p) const {
        double least = INFINITY;
        for (const Place& q : points) least = std::min(least, distance(p, q));
        return least;
    }

    std::vector<FixedPosition> room;
    Place sides;
    Place in_units{};
    FixedPositions positions;
    std::vector<Place> points;
};

std::int32_t squared(double radii, double more) {
    const double units = radii * units_per_radius + more;
    return static_cast<std::int32_t>(units * units);
}

}  // namespace

// A disk that covers a position has its centre in one of the 25 cells around it. Certain answers
// must be right, and uncertain ones only occur within a thousandth of the rim.
TEST(FixedPositions, TellWhetherAPlaceIsHit) {
    for (const Place& cell : {Place{0.7071, 0.7071}, Place{0.501, 0.66}, Place{0.7, 0.55}})
        for (const double share : {0.02, 0.1, 1.0}) {
            const Field field({1728, 64}, cell, share, 1);
            const Rng rng(7);
            int counts[3] = {0, 0, 0};
            for (std::uint64_t i = 0; i < 4000; ++i) {
                const Place p{64 * rng.uniform(2 * i), rows * rng.uniform(2 * i + 1)};
                const std::size_t first = FixedPositions::number(static_cast<std::size_t>(p[0]),
                                                                 static_cast<std::size_t>(p[1]));
                const Hit hit = field.positions.hit(first, field.positions.position_of(p[0], p[1]),
                                                    squared(1, -position_slack),
                                                    squared(1, position_slack) + 1);
                const double nearest = field.nearest(p);
                ++counts[static_cast<int>(hit)];
                if (hit == Hit::yes) {
                    EXPECT_LT(nearest, 1);
                } else if (hit == Hit::no) {
                    EXPECT_GE(nearest, 1);
                } else {
                    EXPECT_NEAR(nearest, 1, 1e-3);
                }
            }
            EXPECT_LT(counts[static_cast<int>(Hit::unsure)], 40);
        }
}

TEST(FixedPositions, FindThoseThatAreNear) {
    const Field field({64, 0}, {0.7, 0.6}, 0.5, 3);
    const Rng rng(9);
    for (std::uint64_t i = 0; i < 500; ++i) {
        const Place p{64 * rng.uniform(2 * i), rows * rng.uniform(2 * i + 1)};
        const auto x = static_cast<std::size_t>(p[0]);
        const auto y = static_cast<std::size_t>(p[1]);
        const double reach = 1.4;
        int least = 0;
        int most = 0;
        for (const Place& q : field.points) {
            const bool about = std::abs(std::floor(q[0]) - static_cast<double>(x)) <= 2 &&
                               std::abs(std::floor(q[1]) - static_cast<double>(y)) <= 2;
            least += about && field.distance(p, q) < reach - 1e-3;
            most += about && field.distance(p, q) < reach + 1e-3;
        }
        int found = 0;
        field.positions.for_near(FixedPositions::number(x, y),
                                 field.positions.position_of(p[0], p[1]), squared(reach, 0),
                                 [&](FixedPosition) { ++found; });
        EXPECT_GE(found, least);
        EXPECT_LE(found, most);
    }
}

}  // namespace stipple::testing::fixed_positions_test
