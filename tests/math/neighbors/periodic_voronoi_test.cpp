// SPDX-License-Identifier: MIT
#include "math/neighbors/periodic_voronoi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/polygon/voronoi.hpp>
#include <map>
#include <numeric>

#include "core/rng.hpp"

namespace stipple::testing::periodic_voronoi_test {
namespace {

using Rows = std::vector<double>;

/// Random points in [0, sides), on a lattice with `levels` steps per side.
Rows random_rows(std::size_t n, Vec2 sides, std::uint64_t seed, double levels = 0x1p30) {
    Rows rows(2 * n);
    Rng(seed).fill(0, rows);
    for (std::size_t k = 0; k < rows.size(); ++k)
        rows[k] = std::floor(rows[k] * levels) / levels * (k % 2 ? sides.y : sides.x);
    return rows;
}

std::vector<CellCorner> cell_of(const PeriodicVoronoi& sites, std::size_t i) {
    VoronoiCell cell;
    sites.cut_cell(i, cell);
    return {cell.corners().begin(), cell.corners().end()};
}

double mass_of(const PeriodicVoronoi& sites, std::size_t i) {
    VoronoiCell cell;
    sites.cut_cell(i, cell);
    return cell.moments().mass;
}

/// Length of the edges between a site and each of its neighbours; walls count as the site itself.
using Edges = std::map<std::pair<std::size_t, std::size_t>, double>;

Edges edges_of(const PeriodicVoronoi& sites) {
    Edges edges;
    for (std::size_t i = 0; i < sites.count(); ++i) {
        const auto corners = cell_of(sites, i);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const auto& [from, neighbor, site] = corners[k];
            const Vec2 to = corners[(k + 1) % corners.size()].at;
            edges[{i, site == CellCorner::wall ? i : site}] +=
                std::hypot(to.x - from.x, to.y - from.y);
        }
    }
    return edges;
}

/// Oracle: Boost's sweep over the sites and copies around them, shifted (torus) or mirrored (walls,
/// which are then edges between a site and its image). Coordinates are integers.
Edges edges_by_sweep(const Rows& rows, int side, bool torus) {
    std::vector<boost::polygon::point_data<int>> points;
    for (const int tx : {0, -1, 1})
        for (const int ty : {0, -1, 1})
            for (std::size_t i = 0; i < rows.size(); i += 2) {
                const auto copy = [&](int x, int turn) {
                    return torus || turn == 0 ? x + turn * side : (turn < 0 ? -x : 2 * side - x);
                };
                points.emplace_back(copy(static_cast<int>(rows[i]), tx),
                                    copy(static_cast<int>(rows[i + 1]), ty));
            }
    boost::polygon::voronoi_diagram<double> diagram;
    boost::polygon::construct_voronoi(points.begin(), points.end(), &diagram);
    const std::size_t n = rows.size() / 2;
    Edges edges;
    for (const auto& edge : diagram.edges()) {
        const std::size_t i = edge.cell()->source_index();
        if (i >= n || !edge.is_finite()) continue;
        const double length = std::hypot(edge.vertex1()->x() - edge.vertex0()->x(),
                                         edge.vertex1()->y() - edge.vertex0()->y());
        edges[{i, edge.twin()->cell()->source_index() % n}] += length;
    }
    return edges;
}

void expect_same_edges(const Edges& found, const Edges& oracle, double tolerance) {
    Edges all = found;
    all.insert(oracle.begin(), oracle.end());
    for (const auto& [pair, length] : all) {
        const auto length_in = [&, &wanted = pair](const Edges& edges) {
            const auto at = edges.find(wanted);
            return at == edges.end() ? 0 : at->second;
        };
        ASSERT_NEAR(length_in(found), length_in(oracle), tolerance)
            << "between " << pair.first << " and " << pair.second;
    }
}

/// Oracle: the smallest |x - x_i|^2 - w_i over all copies.
double power(const Rows& rows, const Rows& weights, std::size_t i, Vec2 at, Vec2 sides,
             bool torus) {
    double least = std::numeric_limits<double>::infinity();
    for (int tx = torus ? -2 : 0; tx <= (torus ? 2 : 0); ++tx)
        for (int ty = torus ? -2 : 0; ty <= (torus ? 2 : 0); ++ty) {
            const double dx = rows[2 * i] + tx * sides.x - at.x;
            const double dy = rows[2 * i + 1] + ty * sides.y - at.y;
            least = std::min(least, dx * dx + dy * dy - weights[i]);
        }
    return least;
}

double least_power(const Rows& rows, const Rows& weights, Vec2 at, Vec2 sides, bool torus) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < weights.size(); ++i)
        least = std::min(least, power(rows, weights, i, at, sides, torus));
    return least;
}

}  // namespace

TEST(PeriodicVoronoi, CellsAreThoseOfASweep) {
    const int side = 1 << 20;
    for (const bool torus : {true, false})
        for (const std::size_t n : {2U, 3U, 4U, 5U, 17U, 300U, 3000U})
            // Coarse ones have points on circles and lines.
            for (const double levels : {0x1p20, 64.0, 5.0}) {
                Rows rows = random_rows(n, {1, 1}, n + 7, levels);
                for (double& x : rows) x = std::floor(x * side);
                std::vector<std::pair<double, double>> places;
                for (std::size_t i = 0; i < n; ++i)
                    places.emplace_back(rows[2 * i], rows[2 * i + 1]);
                std::ranges::sort(places);
                places.erase(std::unique(places.begin(), places.end()), places.end());
                if (!torus)  // the mirror image of a site on a wall is the site
                    std::erase_if(places, [](auto p) { return p.first == 0 || p.second == 0; });
                rows.clear();
                for (const auto& [x, y] : places) rows.insert(rows.end(), {x, y});
                if (rows.empty()) continue;
                SCOPED_TRACE(::testing::Message() << n << " sites of " << levels << " levels"
                                                  << (torus ? ", torus" : ", walls"));
                const PeriodicVoronoi sites({double{side}, double{side}}, torus, rows);
                expect_same_edges(edges_of(sites), edges_by_sweep(rows, side, torus), 1e-5);
            }
}

TEST(PeriodicVoronoi, OneSiteHasTheWholeTorusAroundIt) {
    const auto corners = cell_of(PeriodicVoronoi({2, 1}, true, Rows{0.25, 0.5}), 0);
    ASSERT_EQ(corners.size(), 4U);
    EXPECT_EQ(corners[0].at.x, -1);
    EXPECT_EQ(corners[0].at.y, -0.5);
    for (const CellCorner& corner : corners) EXPECT_EQ(corner.site, 0U);
    EXPECT_EQ(corners[1].neighbor.x, 2);
    EXPECT_EQ(cell_of(PeriodicVoronoi({2, 1}, false, Rows{0.25, 0.5}), 0)[0].at.x, -0.25);
}

// Two sites half a side apart share two edges, each a quarter of a side away.
TEST(PeriodicVoronoi, TwoSitesMeetOnBothSidesOfTheTorus) {
    const auto corners = cell_of(PeriodicVoronoi({1, 1}, true, Rows{0, 0.5, 0.5, 0.5}), 0);
    ASSERT_EQ(corners.size(), 4U);
    for (const CellCorner& corner : corners) {
        EXPECT_EQ(std::abs(corner.at.x), 0.25);
        EXPECT_EQ(std::abs(corner.at.y), 0.5);
        EXPECT_EQ(corner.site, corner.neighbor.x == 0 ? 0U : 1U);
    }
}

TEST(PeriodicVoronoi, LatticesHaveSquareCells) {
    for (const bool torus : {true, false}) {
        Rows rows;
        for (int i = 0; i < 64; ++i)
            rows.insert(rows.end(), {(i % 8 + 0.5) / 8, (i / 8 + 0.5) / 8});  // NOLINT
        const PeriodicVoronoi sites({1, 1}, torus, rows);
        for (std::size_t i = 0; i < 64; ++i) EXPECT_NEAR(mass_of(sites, i), 1.0 / 64, 1e-17);
    }
}

TEST(PeriodicVoronoi, TheFirstOfSitesInOnePlaceHasTheCell) {
    for (const bool torus : {true, false}) {
        const PeriodicVoronoi sites({1, 1}, torus,
                                    Rows{0.5, 0.5, 0.25, 0.5, 0.5, 0.5, 0.25, 0.5, 0.5, 0.5});
        EXPECT_EQ(mass_of(sites, 0) + mass_of(sites, 1), 1);
        for (const std::size_t i : {2U, 3U, 4U}) EXPECT_EQ(mass_of(sites, i), 0);
    }
    // On the torus 0 and 1 are the same position.
    EXPECT_EQ(mass_of(PeriodicVoronoi({1, 1}, true, Rows{0, 0, 1, 0, 0, 1, 1, 1}), 3), 0);
}

// Every position belongs to the site with the smallest power distance; the cells fill the box.
TEST(PeriodicVoronoi, PowerCellsBelongToTheNearestSite) {
    for (const bool torus : {true, false})
        for (const Vec2 sides : {Vec2{1, 1}, Vec2{7, 0.5}, Vec2{0.01, 3}})
            for (const std::size_t n : {1U, 2U, 3U, 10U, 200U}) {
                const Rows rows = random_rows(n, sides, n);
                const double area = sides.x * sides.y;
                for (const double spread : {0.0, 0.1, 3.0}) {  // as fractions of a cell's area
                    Rows weights(n);
                    Rng(3).fill(0, weights);
                    for (double& w : weights) w *= spread * area / static_cast<double>(n);
                    PeriodicVoronoi sites(sides, torus, rows);
                    sites.set_weights(weights);
                    double sum = 0;
                    for (std::size_t i = 0; i < n; ++i) {
                        sum += mass_of(sites, i);
                        for (const auto& corner : cell_of(sites, i)) {
                            const Vec2 at{rows[2 * i] + corner.at.x, rows[2 * i + 1] + corner.at.y};
                            ASSERT_NEAR(power(rows, weights, i, at, sides, torus),
                                        least_power(rows, weights, at, sides, torus), 1e-13);
                        }
                    }
                    EXPECT_NEAR(sum, area, 1e-12 * area) << n << ", " << spread;
                }
            }
}

TEST(PeriodicVoronoi, SitesMayMoveComeAndGo) {
    const std::size_t n = 100;
    const Rows first = random_rows(n, {1, 1}, 1);
    const Rows second = random_rows(n, {1, 1}, 2);
    PeriodicVoronoi moved({1, 1}, true, first);
    for (std::size_t i = n; i-- > 0;) {
        if (i % 3 == 0) moved.remove(i);
        const Vec2 to{second[2 * i], second[2 * i + 1]};
        i % 3 == 0 ? moved.insert(i, to) : moved.move(i, to);
    }
    const PeriodicVoronoi built({1, 1}, true, second);
    for (std::size_t i = 0; i < n; ++i) {
        const auto a = cell_of(moved, i);
        const auto b = cell_of(built, i);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t k = 0; k < a.size(); ++k) {
            EXPECT_EQ(a[k].at.x, b[k].at.x);
            EXPECT_EQ(a[k].at.y, b[k].at.y);
            EXPECT_EQ(a[k].site, b[k].site);
        }
    }
}

// Clusters and a grid that does not suit them only affect the time.
TEST(PeriodicVoronoi, ClustersAreCutAsWell) {
    Rows rows = random_rows(400, {1, 1}, 5);
    for (std::size_t k = 0; k < 600; ++k) rows[k] = 0.3 + 1e-4 * rows[k];
    for (const bool uneven : {false, true}) {
        const PeriodicVoronoi sites({1, 1}, true, rows, uneven);
        double sum = 0;
        for (std::size_t i = 0; i < 400; ++i) sum += mass_of(sites, i);
        EXPECT_NEAR(sum, 1, 1e-13);
    }
}

namespace {

/// Centre of the circle through the origin, p and q, which are not collinear.
Vec2 circumcenter(const Vec2& p, const Vec2& q) {
    const double scale = 0.5 / (p.x * q.y - p.y * q.x);
    const double pp = p.x * p.x + p.y * p.y;
    const double qq = q.x * q.x + q.y * q.y;
    return {scale * (q.y * pp - p.y * qq), scale * (p.x * qq - q.x * pp)};
}

}  // namespace

TEST(PeriodicVoronoi, CornersAreCentersOfCirclesThroughThreeSites) {
    const Vec2 center = circumcenter({3, 0}, {0, 4});
    EXPECT_EQ(center.x, 1.5);
    EXPECT_EQ(center.y, 2);
    const PeriodicVoronoi sites({1, 1}, true, random_rows(500, {1, 1}, 9));
    for (std::size_t i = 0; i < 500; ++i) {
        const auto corners = cell_of(sites, i);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const CellCorner& before = corners[(k + corners.size() - 1) % corners.size()];
            const Vec2 exact = circumcenter(before.neighbor, corners[k].neighbor);
            EXPECT_NEAR(corners[k].at.x, exact.x, 1e-12);
            EXPECT_NEAR(corners[k].at.y, exact.y, 1e-12);
        }
    }
}

// Unit square about (1/4, 0), by hand: the mean is at -1/4, the mean square 1/6 + 1/16.
TEST(PeriodicVoronoi, MomentsOfASquareByHand) {
    VoronoiCell cell;
    PeriodicVoronoi({1, 1}, false, Rows{0.75, 0.5}).cut_cell(0, cell);
    const CellMoments moments = cell.moments();
    EXPECT_DOUBLE_EQ(moments.mass, 1);
    EXPECT_DOUBLE_EQ(moments.first.x, -0.25);
    EXPECT_NEAR(moments.first.y, 0, 1e-17);
    EXPECT_DOUBLE_EQ(moments.second, 1.0 / 6 + 1.0 / 16);
    EXPECT_DOUBLE_EQ(cell.squared_reach(), 0.5625 + 0.25);
    EXPECT_EQ(cell.farthest_corner().x, -0.75);
}

}  // namespace stipple::testing::periodic_voronoi_test
