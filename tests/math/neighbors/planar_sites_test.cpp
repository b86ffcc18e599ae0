// SPDX-License-Identifier: MIT
//
// Cells of crowded and degenerate sets by the triangulation, compared with cells cut by all sites
// and their copies.
#include "math/neighbors/planar_sites.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/rng.hpp"

namespace stipple::testing::planar_sites_test {
namespace {

using Rows = std::vector<double>;

/// One row for each of the numbers (i + 1/2) / n.
template <class Place>
Rows rows_of(std::size_t n, const Place& place) {
    Rows rows;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 at = place((static_cast<double>(i) + 0.5) / static_cast<double>(n), i);
        rows.insert(rows.end(), {at.x, at.y});
    }
    return rows;
}

Vec2 on_circle(double t) {
    const double angle = 2 * std::numbers::pi * t;
    return {0.5 + 0.4 * std::cos(angle), 0.5 + 0.4 * std::sin(angle)};
}

std::vector<Rows> arrangements(std::size_t n) {
    const Rng rng(7);
    std::uint64_t drawn = 0;
    const auto random = [&] { return rng.uniform(drawn++); };
    const auto circle = [](double t, std::size_t) { return on_circle(t); };
    const auto hub = [](double t, std::size_t i) { return i == 0 ? Vec2{0.5, 0.5} : on_circle(t); };
    const auto diagonal = [](double t, std::size_t) { return Vec2{t, t}; };
    const auto wall = [](double t, std::size_t i) { return i < 2 ? Vec2{1, t} : Vec2{t, 0}; };
    const auto cross = [](double t, std::size_t i) { return i % 2 ? Vec2{t, .5} : Vec2{.5, t}; };
    const auto cluster = [&](double, std::size_t i) {
        return i < 3 ? Vec2{random(), random()} : Vec2{.25 + 1e-9 * random(), .5 + 1e-9 * random()};
    };
    const auto spread = [&](double t, std::size_t) {
        const double size = std::exp2(-40 * random());
        return Vec2{0.5 + size * (on_circle(37 * t).x - 0.5),
                    0.5 + size * (on_circle(37 * t).y - 0.5)};
    };
    return {rows_of(n, circle), rows_of(n, hub),     rows_of(n, diagonal), rows_of(n, wall),
            rows_of(n, cross),  rows_of(n, cluster), rows_of(n, spread)};
}

/// Cell of site i, cut by all others and their copies, the nearest first.
VoronoiCell plain_cell(const PlanarSites& sites, std::size_t i) {
    VoronoiCell cell;
    const Vec2 at = sites.at(i);
    PeriodicVoronoi::start(sites.sides, sites.torus, at, static_cast<std::uint32_t>(i), cell);
    std::vector<std::pair<double, Vec2>> others;
    const int turns = sites.torus ? 1 : 0;
    for (int right = -turns; right <= turns; ++right)
        for (int up = -turns; up <= turns; ++up)
            for (std::size_t j = 0; j < sites.count(); ++j) {
                const Vec2 seen{(sites.at(j).x - at.x) + right * sites.sides.x,
                                (sites.at(j).y - at.y) + up * sites.sides.y};
                if (seen.x != 0 || seen.y != 0)
                    others.push_back({seen.x * seen.x + seen.y * seen.y, seen});
            }
    std::ranges::sort(others, {}, [](const auto& other) { return other.first; });
    for (const auto& [squared, seen] : others) cell.cut(seen, squared / 2, 0);
    return cell;
}

void expect_cells_of(const Rows& rows, bool torus) {
    const Box box{{0, 0}, {1, 1}};
    PlanarSites sites = planar_sites(rows, box, torus, {});
    sites.occupancy = 2 * crowded_cell;
    const PlanarCells cells(sites, {});
    double area = 0;
    for (std::size_t i = 0; i < sites.count(); ++i) {
        VoronoiCell cell;
        cells.cut(i, cell);
        const VoronoiCell plain = plain_cell(sites, i);
        EXPECT_NEAR(cell.moments().mass, plain.moments().mass, 1e-12) << i;
        EXPECT_NEAR(cell.moments().second, plain.moments().second, 1e-12) << i;
        EXPECT_NEAR(std::sqrt(cell.squared_reach()), std::sqrt(plain.squared_reach()), 1e-7) << i;
        area += cell.moments().mass;
    }
    EXPECT_NEAR(area, 1, 1e-9);
}

}  // namespace

TEST(PlanarCells, OfDegenerateSetsAreThoseThatAllSitesCut) {
    for (const bool torus : {false, true})
        for (const std::size_t n : {1, 2, 3, 4, 61}) {
            const auto sets = arrangements(n);
            for (std::size_t k = 0; k < sets.size(); ++k) {
                SCOPED_TRACE(::testing::Message()
                             << "set " << k << " of " << n << ", torus " << torus);
                expect_cells_of(sets[k], torus);
            }
        }
}

// A lattice: all cells are equal, and all corners are on circles through four points.
TEST(PlanarCells, OfALatticeAreSquares) {
    const auto lattice = [](double, std::size_t i) {
        return Vec2{static_cast<double>(i % 16) / 16, static_cast<double>(i / 16) / 16};
    };
    PlanarSites sites = planar_sites(rows_of(256, lattice), Box{{0, 0}, {1, 1}}, true, {});
    sites.occupancy = 2 * crowded_cell;
    const PlanarCells cells(sites, {});
    for (std::size_t i = 0; i < sites.count(); ++i) {
        VoronoiCell cell;
        cells.cut(i, cell);
        EXPECT_DOUBLE_EQ(cell.moments().mass, 1.0 / 256);
        EXPECT_DOUBLE_EQ(cell.squared_reach(), 2.0 / 1024);
    }
}

}  // namespace stipple::testing::planar_sites_test
