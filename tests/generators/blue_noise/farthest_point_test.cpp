// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "core/text.hpp"
#include "support/pictures.hpp"
#include "support/spacing.hpp"
#include "support/units.hpp"

namespace stipple::testing::farthest_point_test {
namespace {

using Place = std::array<double, 2>;

double distance(const Place& p, const Place& q) {
    double sum = 0;
    for (std::size_t k = 0; k < 2; ++k) {
        const double d = std::abs(p[k] - q[k]);
        sum += std::min(d, 1 - d) * std::min(d, 1 - d);
    }
    return std::sqrt(sum);
}

std::vector<Place> places_of(const PointSet& set) {
    std::vector<Place> places;
    for (std::size_t i = 0; i < set.count(); ++i) places.push_back({set[i][0], set[i][1]});
    return places;
}

double clearance(const Place& at, const std::vector<Place>& others) {
    double least = 1;
    for (const Place& other : others) least = std::min(least, distance(at, other));
    return least;
}

std::vector<Place> without(const std::vector<Place>& places, std::size_t i) {
    std::vector<Place> others = places;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    return others;
}

/// Distances to nearest neighbours relative to the densest packing: minimum and mean.
struct Spread {
    double least = 9;
    double mean = 0;
};
Spread spread_of(const PointSet& set) {
    const auto places = places_of(set);
    const auto n = static_cast<double>(places.size());
    const double hexagons = std::sqrt(2 / (std::sqrt(3.0) * n));
    Spread spread;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double relative = clearance(places[i], without(places, i)) / hexagons;
        spread.least = std::min(spread.least, relative);
        spread.mean += relative / n;
    }
    return spread;
}

/// Oracle: the largest circle without points, among those through all triples of points and their
/// copies.
double largest_gap(const std::vector<Place>& places) {
    std::vector<Place> copies;
    for (const auto& [x, y] : places)
        for (const double tx : {-1.0, 0.0, 1.0})
            for (const double ty : {-1.0, 0.0, 1.0}) copies.push_back({x + tx, y + ty});
    double largest = 0;
    for (const Place& a : places)
        for (std::size_t j = 0; j < copies.size(); ++j)
            for (std::size_t k = 0; k < j; ++k) {
                const double bx = copies[j][0] - a[0];
                const double by = copies[j][1] - a[1];
                const double cx = copies[k][0] - a[0];
                const double cy = copies[k][1] - a[1];
                const double twice = 2 * (bx * cy - by * cx);
                if (std::abs(twice) < 1e-9) continue;
                const double bb = bx * bx + by * by;
                const double cc = cx * cx + cy * cy;
                Place at = {a[0] + (cy * bb - by * cc) / twice, a[1] + (bx * cc - cx * bb) / twice};
                for (double& x : at) x -= std::floor(x);
                largest = std::max(largest, clearance(at, places));
            }
    return largest;
}

std::string text_of(const PointSet& set) {
    std::string text;
    for (std::size_t i = 0; i < set.count(); ++i)
        text += format_number(set[i][0]) + ' ' + format_number(set[i][1]) + '\n';
    return text;
}

}  // namespace

// Two points have the largest possible distance on the torus.
TEST(FarthestPoint, TwoPointsAreHalfADiagonalApart) {
    const auto places = places_of(make("farthest-point", points(2, 2), {{"iterations", "1"}}));
    EXPECT_NEAR(distance(places[0], places[1]), std::sqrt(0.5), 1e-15);
    Request wide = points(2, 2);
    wide.bounds = Box{{-1, 5}, {1, 6}};
    const PointSet set = make("farthest-point", wide);
    EXPECT_NEAR(std::abs(set[0][0] - set[1][0]), 1, 1e-15);
    EXPECT_NEAR(std::abs(set[0][1] - set[1][1]), 0.5, 1e-15);
}

TEST(FarthestPoint, TheLeastDistanceNeverFalls) {
    for (const std::uint64_t n : {3, 4, 5, 30, 200})
        for (const char* initial : {"random", "jittered"}) {
            double last = 0;
            for (const int steps : {0, 1, 2, 3, 5, 13, 34}) {
                const PointSet set =
                    make("farthest-point", points(n, 2),
                         {{"iterations", std::to_string(steps)}, {"initial", initial}});
                const double now = spread_of(set).least;
                EXPECT_GE(now, last * (1 - 1e-12)) << n << " points, " << steps << " iterations";
                last = now;
            }
        }
}

// A point moved to the farthest position has a distance equal to the largest gap, computed by the
// oracle.
TEST(FarthestPoint, AtTheEndEveryPointIsWhereItsGapIsLargest) {
    for (const std::uint64_t n : {3, 4, 7, 12}) {
        const auto places =
            places_of(make("farthest-point", points(n, 2), {{"iterations", "2000"}}));
        for (std::size_t i = 0; i < n; ++i) {
            const auto others = without(places, i);
            EXPECT_NEAR(clearance(places[i], others), largest_gap(others), 2e-3) << n;
        }
    }
}

// Relative to the hexagonal lattice; the paper's sets have a minimum distance of 0.93, too.
TEST(FarthestPoint, LeastDistanceIsNearThatOfHexagons) {
    for (const std::uint64_t seed : {1}) {
        const Spread spread =
            spread_of(make("farthest-point", points(1024, 2), {}, {.seed = seed}));
        EXPECT_GT(spread.least, 0.92) << seed;
        EXPECT_LT(spread.mean, 0.96) << "crystals, seed " << seed;
    }
}

TEST(FarthestPoint, PointsInOnePlacePart) {
    const TemporaryFile file("0.5 0.5\n0.5 0.5\n0.5 0.5\n0 0\n1 0\n0 1\n1 1\n");
    const PointSet set = make("farthest-point", {}, {{"from", file.path()}, {"iterations", "0"}});
    ASSERT_EQ(set.count(), 7U);
    EXPECT_GT(spread_of(set).least, 0.5);
    for (const double x : set.flat()) EXPECT_TRUE(x >= 0 && x < 1);
}

// The hexagonal lattice is optimal: no point moves, and the run ends immediately.
TEST(FarthestPoint, HexagonsStay) {
    PointSet lattice(120, 2);  // 10 x 12, nearly regular
    for (std::size_t i = 0; i < 120; ++i) {
        lattice[i][0] = (static_cast<double>(i % 10) + (i / 10 % 2 ? 0.5 : 0)) / 10;
        lattice[i][1] = static_cast<double>(i / 10) / 12;
    }
    const TemporaryFile file(text_of(lattice));
    const PointSet set =
        make("farthest-point", {}, {{"from", file.path()}, {"iterations", "1000000"}});
    EXPECT_NEAR(spread_of(set).least, spread_of(lattice).least, 0.01);
}

TEST(FarthestPoint, WorksForFewPointsInAnyBox) {
    for (const std::uint64_t n : {1, 2, 3, 4, 5, 17}) {
        Request request = points(n, 2);
        request.bounds = Box{{10, -3}, {10.5, 4}};
        const PointSet set = make("farthest-point", request);
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_TRUE(set[i][0] >= 10 && set[i][0] < 10.5);
            EXPECT_TRUE(set[i][1] >= -3 && set[i][1] < 4);
        }
    }
}

// The largest possible distances of 2 and 3 points in a square: a diagonal, and an equilateral
// triangle with a corner of the square. In a long box they are at its ends and in the middle.
TEST(FarthestPoint, FewPointsBetweenWallsAreAsFarApartAsCanBe) {
    const Settings walls{{"iterations", "500"}};
    const Space square{{{0, 0}, {1, 1}}, false};
    const double two = smallest_distance(make_in("farthest-point", square, 2, walls), square);
    EXPECT_NEAR(two, std::sqrt(2.0), 1e-12);
    const double three = smallest_distance(make_in("farthest-point", square, 3, walls), square);
    EXPECT_NEAR(three, std::sqrt(6.0) - std::sqrt(2.0), 1e-6);
    const Space wide{{{-3, 7}, {3, 7.001}}, false};
    EXPECT_NEAR(smallest_distance(make_in("farthest-point", wide, 3, walls), wide), 3, 1e-6);
}

TEST(FarthestPoint, TheLeastDistanceNeverFallsInAnySpace) {
    for (const Space& space : some_spaces()) {
        if (space.box.dimension() != 2 || space.box.extent(0) > 1000 * space.box.extent(1))
            continue;
        for (const std::uint64_t n : {2, 3, 40}) {
            double last = 0;
            for (const char* steps : {"0", "1", "2", "5", "30"}) {
                const PointSet set = make_in("farthest-point", space, n, {{"iterations", steps}});
                expect_inside(set, space);
                const double now = smallest_distance(set, space);
                EXPECT_GE(now, last * (1 - 1e-9)) << space.name() << ", " << steps;
                last = now;
            }
        }
    }
}

// Oracle: no position of a fine grid is farther from the other points than a point is.
TEST(FarthestPoint, BetweenWallsEveryPointIsWhereItsGapIsLargest) {
    const Space space{{{2, -1}, {4, 0}}, false};
    for (const std::uint64_t n : {4, 7, 12}) {
        const PointSet set = make_in("farthest-point", space, n, {{"iterations", "2000"}});
        for (std::size_t i = 0; i < n; ++i) {
            const auto clear = [&](std::span<const double> at) {
                double least = 9;
                for (std::size_t j = 0; j < n; ++j)
                    if (j != i) least = std::min(least, distance(at, set[j], space));
                return least;
            };
            const double own = clear(set[i]);
            for (int x = 0; x <= 40; ++x)
                for (int y = 0; y <= 20; ++y)
                    EXPECT_LE(clear(std::array{2 + x / 20.0, -1 + y / 20.0}), own + 2e-3) << n;
        }
    }
}

// Hexagonal lattice of n points that fills the box and half a distance around it, d^2 sqrt(3) / 2
// each.
TEST(FarthestPoint, KeepsItsDistanceInAnyBox) {
    for (const bool torus : {true, false}) {
        const Space space{{{0, 0}, {5, 0.7}}, torus};
        const std::uint64_t n = 150;
        const PointSet set = make_in("farthest-point", space, n);
        const double least = smallest_distance(set, space);
        const double rim = torus ? 0 : least;
        EXPECT_GT(static_cast<double>(n) * least * least * std::sqrt(3.0) / 2,
                  0.8 * (5 + rim) * (0.7 + rim));
    }
}

TEST(FarthestPoint, RefusesWallsOnATorus) {
    EXPECT_EQ(error_of([] {
                  make("farthest-point", points(9, 2), {{"torus", "true"}, {"bounded", "true"}});
              }),
              "usage: --torus contradicts --bounded; give one of them");
}

// Four points at the corners of a square are optimal; moving one would be detected.
TEST(FarthestPoint, BetweenWallsARunEndsWhereNoPointMoves) {
    const TemporaryFile file("0 0\n1 0\n0 1\n1 1\n");
    int ticks = 0;
    const RunContext run{.progress = [&](double) { ++ticks; }};
    const PointSet set =
        make("farthest-point", {},
             {{"from", file.path()}, {"iterations", "100000"}, {"bounded", "true"}}, run);
    EXPECT_NEAR(smallest_distance(set, {{{0, 0}, {1, 1}}, false}), 1, 1e-15);
    EXPECT_LT(ticks, 10);
}

}  // namespace stipple::testing::farthest_point_test
