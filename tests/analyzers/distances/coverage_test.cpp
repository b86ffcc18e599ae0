// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "analyzers/distances/empty_ball.hpp"
#include "pipeline/chain.hpp"
#include "support/units.hpp"

namespace stipple::testing::coverage_test {
namespace {

constexpr const char* unit = "coverage";

using Place = std::vector<double>;

double distance_to_set(const PointSet& p, const Place& x, const Place& sides) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < p.count(); ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            double gap = std::abs(p[i][k] - x[k]);
            if (!sides.empty()) gap = std::min(gap, sides[k] - gap);
            sum += gap * gap;
        }
        least = std::min(least, std::sqrt(sum));
    }
    return least;
}

/// Intersections of pairs of lines a x + b y = c in the closed box.
std::vector<Place> meetings(const std::vector<std::array<double, 3>>& lines, const Box& box) {
    std::vector<Place> places;
    for (const auto& [a, b, c] : lines)
        for (const auto& [e, f, g] : lines) {
            const double determinant = a * f - b * e;
            if (std::abs(determinant) < 1e-12) continue;
            const Place x{(c * f - b * g) / determinant, (a * g - c * e) / determinant};
            if (x[0] >= box.low[0] - 1e-9 && x[0] <= box.high[0] + 1e-9 &&
                x[1] >= box.low[1] - 1e-9 && x[1] <= box.high[1] + 1e-9)
                places.push_back(x);
        }
    return places;
}

/// Oracle for the plane: the maximum is at an intersection of two bisectors or walls; tries all of
/// them. O(n^5).
double by_definition(const PointSet& p, const Box& box, bool torus) {
    std::vector<Place> copies;
    for (std::size_t i = 0; i < p.count(); ++i)
        for (int u = torus ? -1 : 0; u <= (torus ? 1 : 0); ++u)
            for (int v = torus ? -1 : 0; v <= (torus ? 1 : 0); ++v)
                copies.push_back({p[i][0] + u * box.extent(0), p[i][1] + v * box.extent(1)});
    std::vector<std::array<double, 3>> lines;
    for (std::size_t i = 0; i < copies.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const double a = copies[i][0] - copies[j][0];
            const double b = copies[i][1] - copies[j][1];
            lines.push_back(
                {a, b,
                 (a * (copies[i][0] + copies[j][0]) + b * (copies[i][1] + copies[j][1])) / 2});
        }
    if (!torus)
        for (const double share : {0.0, 1.0}) {
            lines.push_back({1, 0, box.low[0] + share * box.extent(0)});
            lines.push_back({0, 1, box.low[1] + share * box.extent(1)});
        }
    double best = 0;
    const Place sides = torus ? Place{box.extent(0), box.extent(1)} : Place{};
    for (Place x : meetings(lines, box)) {
        for (std::size_t k = 0; k < 2; ++k) x[k] = std::clamp(x[k], box.low[k], box.high[k]);
        best = std::max(best, distance_to_set(p, x, sides));
    }
    return best;
}

Box cube(std::size_t d) { return {Place(d, 0.0), Place(d, 1.0)}; }

Settings with(bool torus) { return {{"metric", torus ? "torus" : "euclidean"}}; }

/// Expects the reported ball to be empty, and to be the largest.
void expect_radius(const PointSet& set, bool torus, double expected, double tolerance = 1e-12) {
    const Report report = analyze(unit, set, with(torus));
    EXPECT_NEAR(report.number("radius"), expected, tolerance * expected);
    const Box box = set.domain->bounding_box();
    Place sides;
    for (std::size_t k = 0; k < box.dimension() && torus; ++k) sides.push_back(box.extent(k));
    EXPECT_NEAR(distance_to_set(set, report.curve("center"), sides), report.number("radius"),
                1e-15 + 1e-14 * expected);
    EXPECT_TRUE(set.domain->contains(report.curve("center")));
    EXPECT_EQ(report.number("lower"), report.number("radius"));
    EXPECT_GE(report.number("upper"), expected * (1 - tolerance));
    EXPECT_LE(report.number("upper"), report.number("radius") * (1 + 1e-6));
    EXPECT_EQ(report.text("metric"), torus ? "torus" : "euclidean");
}

/// m^d grid points, shifted by (shift, ..., shift) / m.
PointSet grid(std::size_t m, std::size_t d, double shift) {
    std::vector<double> rows;
    const auto count = static_cast<std::size_t>(std::pow(m, d) + 0.5);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0, rest = i; k < d; ++k, rest /= m)
            rows.push_back((static_cast<double>(rest % m) + shift) / static_cast<double>(m));
    return {std::move(rows), d};
}

}  // namespace

// Deep holes of grids: the centre of a cell, at sqrt(d) / 2 of its side; with walls, and points
// starting at the origin, the far corner of the cube, at sqrt(d) of it.
TEST(Coverage, OfGridsIsHalfTheirDiagonal) {
    for (const auto& [m, d] : {std::pair<std::size_t, std::size_t>{1, 1},
                               {7, 1},
                               {1, 2},
                               {2, 2},
                               {10, 2},
                               {1, 3},
                               {4, 3},
                               {2, 4}}) {
        SCOPED_TRACE(::testing::Message() << m << "^" << d);
        const double diagonal = std::sqrt(static_cast<double>(d)) / static_cast<double>(m);
        const double tolerance = d > 2 ? 1e-6 : 1e-12;
        expect_radius(grid(m, d, 0), true, diagonal / 2, tolerance);
        expect_radius(grid(m, d, 0.5), true, diagonal / 2, tolerance);
        expect_radius(grid(m, d, 0.5), false, diagonal / 2, tolerance);
        expect_radius(grid(m, d, 0), false, diagonal, tolerance);
    }
}

// Conway and Sloane, chapter 4: the covering radii of D3 (fcc) and its dual (bcc), with minimal
// vectors sqrt 2 and sqrt 3 / 2, are 1 and sqrt 5 / 4; that of D4 is 1.
TEST(Coverage, OfLatticesAsPrinted) {
    const double h = 0.5;
    expect_radius(points_of({{0, 0, 0}, {0, h, h}, {h, 0, h}, {h, h, 0}}), true, 0.5, 1e-6);
    expect_radius(points_of({{0, 0, 0}, {h, h, h}}), true, std::sqrt(5.0) / 4, 1e-6);
    expect_radius(points_of({{0, 0, 0, 0}, {h, h, h, h}}), true, std::sqrt(0.5), 1e-6);
}

TEST(Coverage, InOneDimensionIsHalfTheWidestGap) {
    const PointSet set = points_of({{0.9}, {0.2}, {0.3}, {0.3}});
    expect_radius(set, true, 0.3);
    expect_radius(set, false, 0.3);
    expect_radius(points_of({{0.6}, {0.7}}), true, 0.45);
    expect_radius(points_of({{0.6}, {0.7}}), false, 0.6);
    expect_radius(points_of({{0.2}}), false, 0.8);
    expect_radius(points_of({{0.2}}), true, 0.5);
    expect_radius(points_of({{0}, {1}}), true, 0.5);
}

TEST(Coverage, OfThePlaneIsWhereBisectorsMeet) {
    for (const std::uint64_t n : {1, 2, 3, 4, 5, 6})
        for (const std::uint64_t seed : {1, 2, 3})
            for (const bool torus : {true, false}) {
                SCOPED_TRACE(::testing::Message() << n << " points, seed " << seed);
                if (torus && n > 4) continue;  // the oracle is slow
                PointSet set = make("random", points(n, 2), {}, {.seed = seed});
                expect_radius(set, torus, by_definition(set, cube(2), torus));
                for (double& x : set.flat()) x = std::floor(4 * x) / 4;  // ties, duplicates, 0
                set[0][0] = 1;
                expect_radius(set, torus, by_definition(set, cube(2), torus));
                for (std::size_t i = 0; i < n; ++i) set[i][1] = 0.3;  // collinear
                expect_radius(set, torus, by_definition(set, cube(2), torus));
                for (std::size_t i = 0; i < n; ++i)  // a cluster
                    for (std::size_t k = 0; k < 2; ++k)
                        set[i][k] = 0.4 + 1e-6 * make("random", points(n, 2))[i][k];
                expect_radius(set, torus, by_definition(set, cube(2), torus), 1e-9);
            }
}

TEST(Coverage, HoldsInTheBoxThatThePointsLiveOn) {
    const Box box{{-3, 10}, {-1, 10.5}};
    for (const bool torus : {true, false}) {
        PointSet set = make("random", points(4, 2));
        scale_into(box, set.flat());
        set.domain = box_domain(box);
        expect_radius(set, torus, by_definition(set, box, torus));
    }
    PointSet line = points_of({{11}, {12}});
    line.domain = box_domain({{10}, {14}});
    expect_radius(line, true, 1.5);
    expect_radius(line, false, 2);
}

// Voronoi cells and branch and bound, which share only the search tree.
TEST(Coverage, TwoMethodsAgreeInThePlane) {
    for (const bool torus : {true, false})
        for (const char* generator : {"random", "halton", "poisson-disk", "hexagonal"}) {
            const PointSet set = make(generator, points(500, 2));
            const analyzers::Distances distances{.torus = torus, .box = cube(2)};
            const auto cells = analyzers::planar_empty_ball(set, distances, {});
            const auto boxes =
                analyzers::bounded_empty_ball(set, distances, {.tolerance = 1e-9}, {});
            EXPECT_LE(boxes.radius, cells.radius * (1 + 1e-12)) << generator << torus;
            EXPECT_GE(boxes.upper, cells.radius * (1 - 1e-12)) << generator << torus;
            EXPECT_LE(boxes.upper, boxes.radius * (1 + 1e-9)) << generator << torus;
        }
}

// The bounds are compared with the largest distance from positions of a fine grid.
TEST(Coverage, BoundsHoldInSpace) {
    for (const std::size_t d : {3, 4, 5})
        for (const bool torus : {true, false}) {
            const PointSet set = make("random", points(d == 5 ? 20 : 50, d));
            const Report report = analyze(unit, set, with(torus));
            const Place sides = torus ? Place(d, 1.0) : Place();
            const PointSet probes = make("random", points(20'000, d), {}, {.seed = 7});
            double seen = 0;
            for (std::size_t i = 0; i < probes.count(); ++i)
                seen = std::max(seen,
                                distance_to_set(set, {probes[i].begin(), probes[i].end()}, sides));
            EXPECT_LE(seen, report.number("upper")) << d << torus;
            EXPECT_GT(seen, 0.85 * report.number("radius")) << d << torus;
            EXPECT_NEAR(distance_to_set(set, report.curve("center"), sides),
                        report.number("radius"), 1e-15);
            EXPECT_LE(report.number("upper"), (1 + 1e-6) * report.number("radius"));
            EXPECT_FALSE(std::get<bool>(*report.find("exact")));
        }
}

TEST(Coverage, AWideToleranceIsKept) {
    const PointSet set = make("random", points(100, 3));
    const Report fine = analyze(unit, set);
    const Report rough = analyze(unit, set, {{"tolerance", "0.1"}});
    EXPECT_LE(rough.number("radius"), fine.number("upper"));
    EXPECT_GE(rough.number("upper"), fine.number("radius"));
    EXPECT_LE(rough.number("upper"), 1.1 * rough.number("radius"));
}

TEST(Coverage, ManyCopiesAndClustersTakeNoLongerThanEvenPoints) {
    PointSet set = make("random", points(100'000, 2));
    for (double& x : set.flat()) x = 0.25;
    expect_radius(set, true, std::sqrt(0.5));
    expect_radius(set, false, 0.75 * std::sqrt(2.0));
    set = make("random", points(20'000, 2));
    for (double& x : set.flat()) x = 0.25 + 1e-7 * x;
    expect_radius(set, true, std::sqrt(0.5), 1e-6);
    set = make("random", points(20'000, 2));
    for (std::size_t i = 0; i < set.count(); ++i) set[i][1] = 0.5;
    EXPECT_NEAR(measure(unit, "radius", set), 0.5, 1e-4);
}

TEST(Coverage, MeshRatioIsCoveringOverPackingRadius) {
    EXPECT_NEAR(measure(unit, "mesh_ratio", grid(10, 2, 0)), std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(measure(unit, "mesh_ratio", points_of({{0.5, 0.5}})), std::sqrt(2.0), 1e-12);
    EXPECT_EQ(analyze(unit, points_of({{0.5, 0.5}, {0.5, 0.5}})).find("mesh_ratio"), nullptr);
    EXPECT_EQ(analyze(unit, points_of({{0.5, 0.5}}), with(false)).find("mesh_ratio"), nullptr);
}

TEST(Coverage, GivesUpAfterSoManyBoxes) {
    EXPECT_TRUE(
        error_of([] {
            analyze(unit, make("random", points(300, 6)), {{"max-boxes", "10000"}});
        })
            .starts_with(
                "limit: the search for the largest empty ball of 300 points in 6 dimensions "
                "exceeds 10000 boxes (--max-boxes); certain so far: its radius is at least 0."));
}

TEST(Coverage, RefusesDomainsThatAreNoBox) {
    PointSet set = points_of({{0, 0}});
    set.domain = parse_domain("disk", 2);
    EXPECT_EQ(
        error_of([&] { analyze(unit, set); }),
        "input: coverage requires points of the unit cube or a box; the domain is disk | 'stipple "
        "warp NAME --inverse' takes points back to the unit cube");
    EXPECT_EQ(error_of([&] {
                  analyze(unit, points_of({{0, 2}}), with(false));
              }),
              "input: 1 of 1 points are outside the domain unit-cube; the first is point 0: (0, 2) "
              "| --domain 'box:bounds=[lo..hi,...]' names another box");
}

// Coordinates near 2^40 are multiples of 2^-12, which centres of balls need not be.
TEST(Coverage, InABoxFarFromZeroIsThatOfTheBoxAtZero) {
    for (const std::size_t d : {2U, 3U}) {
        PointSet near = make("random", points(9, d));
        for (double& x : near.flat()) x = std::floor(x * 4096) / 4096;
        PointSet far = near;
        for (double& x : far.flat()) x += 0x1p40;
        far.domain =
            box_domain({std::vector<double>(d, 0x1p40), std::vector<double>(d, 0x1p40 + 1)});
        for (const char* metric : {"torus", "euclidean"}) {
            const Settings settings = {{"metric", metric}, {"tolerance", "1e-10"}};
            const Report one = analyze(unit, near, settings);
            const Report other = analyze(unit, far, settings);
            EXPECT_EQ(one.number("lower"), other.number("lower")) << d << metric;
            EXPECT_EQ(one.number("upper"), other.number("upper")) << d << metric;
        }
    }
}

}  // namespace stipple::testing::coverage_test
