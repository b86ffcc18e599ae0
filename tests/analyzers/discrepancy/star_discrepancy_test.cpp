// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <functional>
#include <numeric>
#include <thread>

#include "core/rng.hpp"
#include "math/discrepancy/coordinate_ascent.hpp"
#include "math/discrepancy/star/search.hpp"
#include "math/discrepancy/star/strips.hpp"
#include "support/lattices.hpp"
#include "support/units.hpp"

namespace stipple::testing::star_discrepancy_test {

using namespace stipple::discrepancy;
using boost::multiprecision::cpp_rational;
using ::testing::HasSubstr;

namespace {

Report star_report(const PointSet& points) { return analyze("star-discrepancy", points); }

double star_of(const PointSet& points) { return star_report(points).number("value"); }

double half_open_star_of(const PointSet& points) {
    return analyze("star-discrepancy", points, {{"boxes", "half-open"}}).number("value");
}

/// Result of branch and bound alone: a good start would hide errors of the search.
double by_search(const PointSet& points) {
    const BoxGrid grid = box_grid(points, Family::anchored, {});
    return star::search(grid, WorstBox(grid), {}, {}).worst.value();
}

/// Radical inverse, rounded once.
double phi(std::uint64_t i, std::uint64_t base) {
    std::uint64_t above = 0;
    std::uint64_t below = 1;
    for (; i > 0; i /= base, below *= base) above = above * base + i % base;
    return static_cast<double>(above) / static_cast<double>(below);
}

PointSet halton(std::size_t n, std::size_t d, std::size_t start = 1) {
    constexpr std::uint64_t primes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29};
    PointSet p(n, d);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < d; ++k) p[i][k] = phi(start + i, primes[k]);
    return p;
}

/// (i/n, phi_2(i)), i = 0 .. n - 1.
PointSet hammersley(std::size_t n) {
    PointSet p(n, 2);
    for (std::size_t i = 0; i < n; ++i) {
        p[i][0] = static_cast<double>(i) / static_cast<double>(n);
        p[i][1] = phi(i, 2);
    }
    return p;
}

/// k^d points, with coordinates (index + offset) / k.
PointSet grid(std::size_t k, std::size_t d, double offset) {
    std::size_t n = 1;
    for (std::size_t j = 0; j < d; ++j) n *= k;
    PointSet p(n, d);
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t rest = i;
        for (std::size_t j = 0; j < d; ++j, rest /= k)
            p[i][j] = (static_cast<double>(rest % k) + offset) / static_cast<double>(k);
    }
    return p;
}

/// Calls visit(corner) for all corners whose coordinates are those of points or 1.
void each_corner(const PointSet& p, const std::function<void(const std::vector<double>&)>& visit) {
    std::vector<std::vector<double>> values(p.dimension(), {1.0});
    for (std::size_t i = 0; i < p.count(); ++i)
        for (std::size_t k = 0; k < p.dimension(); ++k) values[k].push_back(p[i][k]);
    for (auto& axis : values) {
        std::ranges::sort(axis);
        axis.erase(std::unique(axis.begin(), axis.end()), axis.end());
    }
    std::vector<double> corner(p.dimension());
    const std::function<void(std::size_t)> go = [&](std::size_t k) {
        if (k == p.dimension()) return visit(corner);
        for (const double x : values[k]) {
            corner[k] = x;
            go(k + 1);
        }
    };
    go(0);
}

std::int64_t points_in(const PointSet& p, const std::vector<double>& corner, bool closed) {
    std::int64_t inside = 0;
    for (std::size_t i = 0; i < p.count(); ++i) {
        bool in = true;
        for (std::size_t k = 0; k < p.dimension(); ++k)
            in = in && (closed ? p[i][k] <= corner[k] : p[i][k] < corner[k]);
        inside += in;
    }
    return inside;
}

/// Oracle: the definition, corner by corner, in integers; for coordinates that are multiples of
/// 1/steps. Exact if steps is a power of two and n * steps^d < 2^53. Slow, and too plain to be
/// wrong.
double by_definition(const PointSet& p, std::int64_t steps) {
    std::int64_t cells = 1;
    for (std::size_t k = 0; k < p.dimension(); ++k) cells *= steps;
    const auto n = static_cast<std::int64_t>(p.count());
    std::int64_t worst = 0;
    each_corner(p, [&](const std::vector<double>& corner) {
        std::int64_t volume = 1;
        for (const double x : corner) volume *= std::llround(x * static_cast<double>(steps));
        worst = std::max({worst, n * volume - cells * points_in(p, corner, false),
                          cells * points_in(p, corner, true) - n * volume});
    });
    return static_cast<double>(worst) / static_cast<double>(n * cells);
}

/// Oracle: the same for half-open boxes only. A box may end just beyond a corner, and then contains
/// the points on its faces; but never beyond 1.
double by_half_open_definition(const PointSet& p, std::int64_t steps) {
    const auto d = p.dimension();
    const auto n = static_cast<std::int64_t>(p.count());
    cpp_rational worst = 0;
    each_corner(p, [&](const std::vector<double>& corner) {
        cpp_rational volume = 1;
        for (const double x : corner)
            volume *= cpp_rational(std::llround(x * static_cast<double>(steps)), steps);
        for (unsigned behind = 0; behind < 1U << d; ++behind) {
            std::int64_t inside = 0;
            for (std::size_t i = 0; i < p.count(); ++i) {
                bool in = true;
                for (std::size_t k = 0; k < d; ++k) {
                    const bool face = (behind >> k & 1U) != 0 && corner[k] < 1;
                    in = in && (p[i][k] < corner[k] || (face && p[i][k] == corner[k]));
                }
                inside += in;
            }
            worst = std::max<cpp_rational>(worst, abs(volume - cpp_rational(inside, n)));
        }
    });
    return static_cast<double>(worst);
}

/// Oracle in three dimensions: level by level along the last axis, with a table of the numbers of
/// points below the level in every box of the first two axes. O(n^3).
double by_levels(const PointSet& p) {
    const BoxGrid grid = box_grid(p, Family::anchored, {});
    const auto& xs = grid.values[0];
    const auto& ys = grid.values[1];
    const auto& zs = grid.values[2];
    const std::size_t columns = ys.size() + 1;
    // Entry [a, j] counts the points below the a-th and j-th coordinate.
    std::vector<int> below((xs.size() + 1) * columns);
    std::vector<std::vector<std::size_t>> at(zs.size());
    for (std::size_t i = 0; i < p.count(); ++i) at[grid.ranks[2][i]].push_back(i);
    const double share = 1 / static_cast<double>(p.count());
    double worst = 0;
    const auto look = [&](double z, int sign, std::size_t shift) {
        for (std::size_t a = 0; a < xs.size(); ++a)
            for (std::size_t j = 0; j < ys.size(); ++j)
                worst = std::max(worst, sign * (z * xs[a] * ys[j] -
                                                below[(a + shift) * columns + j + shift] * share));
    };
    for (std::size_t level = 0; level < zs.size(); ++level) {
        look(zs[level], 1, 0);
        for (const std::size_t i : at[level])
            for (std::size_t a = grid.ranks[0][i] + 1; a <= xs.size(); ++a)
                for (std::size_t j = grid.ranks[1][i] + 1; j < columns; ++j)
                    ++below[a * columns + j];
        look(zs[level], -1, 1);
    }
    return worst;
}

/// Recounts the worst box and computes its discrepancy in rational numbers: the value must be the
/// nearest double.
void expect_box_holds(const PointSet& p, const Report& report) {
    const auto corner = report.curve("worst_box.corner");
    const bool closed = std::get<bool>(*report.find("worst_box.closed"));
    const std::int64_t inside = points_in(p, corner, closed);
    EXPECT_EQ(report.number("worst_box.points"), static_cast<double>(inside));

    cpp_rational volume = 1;
    for (const double x : corner) volume *= cpp_rational(x);
    const cpp_rational share(inside, static_cast<std::int64_t>(p.count()));
    const cpp_rational exact = closed ? cpp_rational(share - volume) : cpp_rational(volume - share);
    const auto expect_nearest = [](double value, const cpp_rational& truth) {
        const cpp_rational error = abs(cpp_rational(value) - truth);
        EXPECT_LE(error, abs(cpp_rational(std::nextafter(value, 2)) - truth));
        EXPECT_LE(error, abs(cpp_rational(std::nextafter(value, -1)) - truth));
    };
    expect_nearest(report.number("lower"), exact);
    expect_nearest(report.number("worst_box.volume"), volume);
}

std::string text_of(const PointSet& p) {
    std::string text;
    for (std::size_t i = 0; i < p.count(); ++i) text += fmt::format("({})", fmt::join(p[i], ","));
    return text;
}

}  // namespace

TEST(StarDiscrepancy, KnownByHand) {
    EXPECT_EQ(star_of(points_of({{.5, .5}})), 3. / 4);
    EXPECT_EQ(star_of(points_of({{0, 0}})), 1);
    EXPECT_EQ(star_of(points_of({{1, 1}})), 1);
    EXPECT_EQ(star_of(points_of({{.5, .5}, {.5, .5}})), 3. / 4);
    EXPECT_EQ(star_of(points_of({{.25}})), 3. / 4);
    EXPECT_EQ(star_of(points_of({{.25}, {.75}})), 1. / 4);
    EXPECT_EQ(star_of(points_of({{.5, .5, .5}})), 7. / 8);
    EXPECT_EQ(star_of(points_of({{0, 0, 0, 0, 0}})), 1);
    EXPECT_EQ(star_of(points_of({{1, 1, 1, 1, 1}})), 1);
}

// Computed in exact rationals by an independent program; the coordinates are rounded to doubles.
TEST(StarDiscrepancy, KnownOfHundredPoints) {
    EXPECT_NEAR(star_of(halton(100, 2)), 6511. / 129600, 2e-16);
    EXPECT_NEAR(star_of(hammersley(100)), 121. / 3200, 2e-16);
    EXPECT_NEAR(star_of(grid(10, 2, 0)), 19. / 100, 2e-16);
    EXPECT_NEAR(star_of(grid(10, 2, 0.5)), 39. / 400, 2e-16);
}

// The closed box to the last points contains all points: 1 - (1 - 1/k)^d; points at the centres of
// their cells have half the margin.
TEST(StarDiscrepancy, OfGridsHasAClosedForm) {
    for (const auto& [k, d] :
         {std::pair{7, 1}, {1, 2}, {8, 2}, {33, 2}, {5, 3}, {8, 3}, {4, 4}, {3, 5}}) {
        const auto size = static_cast<std::size_t>(k);
        const auto dim = static_cast<std::size_t>(d);
        EXPECT_NEAR(star_of(grid(size, dim, 0)), 1 - std::pow(1 - 1. / k, d), 1e-15)
            << k << "^" << d;
        EXPECT_NEAR(star_of(grid(size, dim, 0.5)), 1 - std::pow(1 - .5 / k, d), 1e-15)
            << k << "^" << d;
    }
}

// Halton and Zaremba (1969): n D* = m/3 + 13/9 - (-1)^m 4/(9 2^m) for n = 2^m points (i/n,
// phi_2(i)). The formula does not hold for m = 1: the points (0,0), (1/2,1/2) have 3/4, by hand.
TEST(StarDiscrepancy, OfHammersleyInBaseTwoHasAClosedForm) {
    EXPECT_EQ(star_of(hammersley(2)), 3. / 4);
    for (int m = 2; m <= 15; ++m) {
        const double n = std::ldexp(1, m);
        const double sign = m % 2 == 0 ? 1 : -1;
        const double expected = (m / 3. + 13. / 9 - sign * 4 / (9 * n)) / n;
        EXPECT_NEAR(star_of(hammersley(static_cast<std::size_t>(n))), expected, 1e-15) << "m " << m;
    }
}

// Points at 1 are detected only by open boxes, points at 0 only by closed ones, and (0, 1) is only
// in boxes that end at 1 and are closed there.
TEST(StarDiscrepancy, CountsOpenAndClosedBoxes) {
    EXPECT_EQ(star_of(points_of({{1, 1}, {1, 1}, {1, 1}})), 1);
    EXPECT_EQ(star_of(points_of({{0, 0}, {0, 0}, {0, 0}})), 1);
    EXPECT_EQ(star_of(points_of({{0, 1}, {0, .5}})), 1);  // half-open boxes alone give 1/2
    EXPECT_EQ(star_of(points_of({{0, 1, 0}, {0, .5, 0}})), 1);
    EXPECT_EQ(star_of(points_of({{1}, {.5}})), 1. / 2);
    const Report open = star_report(points_of({{.75, .5}, {.75, 1}}));
    EXPECT_EQ(open.number("value"), 3. / 4);  // no point to the left of 3/4
    EXPECT_FALSE(std::get<bool>(*open.find("worst_box.closed")));
    EXPECT_EQ(open.curve("worst_box.corner"), (std::vector<double>{.75, 1}));
    EXPECT_EQ(open.number("worst_box.points"), 0);
    EXPECT_EQ(open.number("worst_box.volume"), .75);
    const Report closed = star_report(points_of({{.25, .5}, {.25, .25}}));
    EXPECT_EQ(closed.number("value"), 7. / 8);
    EXPECT_TRUE(std::get<bool>(*closed.find("worst_box.closed")));
    EXPECT_EQ(closed.curve("worst_box.corner"), (std::vector<double>{.25, .5}));
    EXPECT_EQ(closed.number("worst_box.points"), 2);
    EXPECT_EQ(closed.number("worst_box.volume"), .125);
}

TEST(StarDiscrepancy, OfHalfOpenBoxesLeavesOutWhatLiesAtOne) {
    const PointSet edge = points_of({{0, 1}, {0, .5}});
    EXPECT_EQ(star_of(edge), 1);
    EXPECT_EQ(half_open_star_of(edge), 1. / 2);
    EXPECT_EQ(half_open_star_of(points_of({{0, 1, 0}, {0, .5, 0}})), 1. / 2);
    EXPECT_EQ(half_open_star_of(points_of({{0, 1}})), 1);  // contains no point
    EXPECT_EQ(half_open_star_of(points_of({{.25}, {1}})), 1. / 2);
    EXPECT_EQ(half_open_star_of(halton(100, 2)), star_of(halton(100, 2)));
}

// Values equal the definition on sets with many points at 1, in every dimension and by every
// method; on most of them the two conventions differ, so that the wrong one fails.
TEST(StarDiscrepancy, OfHalfOpenBoxesIsTheDefinitions) {
    constexpr std::size_t most[] = {0, 20, 9, 6, 4, 3};
    int different = 0;
    for (std::size_t d = 1; d <= 5; ++d)
        for (const std::int64_t steps : {2, 4, 64})
            for (std::uint64_t seed = 1; seed <= 8; ++seed) {
                const std::size_t n = 1 + Rng(seed).below(d, most[d]);
                PointSet p = on_lattice(n, d, static_cast<std::uint64_t>(steps), seed);
                p[0][d - 1] = 1;
                const double expected = by_half_open_definition(p, steps);
                EXPECT_EQ(half_open_star_of(p), expected) << text_of(p);
                const BoxGrid moved = box_grid(p, Family::half_open, {});
                const auto found = star::search(moved, WorstBox(moved), {}, {});
                EXPECT_EQ(found.worst.value(), expected) << text_of(p);
                different += expected != star_of(p);
            }
    EXPECT_GE(different, 20);
}

// Exact to the last bit, with ties, duplicates, points on 0 and 1, and single points.
TEST(StarDiscrepancy, IsTheDefinitionsToTheLastBit) {
    constexpr std::size_t most[] = {0, 60, 30, 18, 9, 6, 5, 4, 4};
    for (std::size_t d = 1; d <= 8; ++d)
        for (const std::int64_t steps : {2, 8, d > 5 ? 32 : 256})
            for (std::uint64_t seed = 1; seed <= 12; ++seed) {
                const std::size_t n = 1 + Rng(seed).below(d, most[d]);
                const PointSet p = on_lattice(n, d, static_cast<std::uint64_t>(steps), seed);
                const double expected = by_definition(p, steps);
                const Report report = star_report(p);
                ASSERT_EQ(report.number("value"), expected) << text_of(p);
                EXPECT_EQ(by_search(p), expected) << text_of(p);
                expect_box_holds(p, report);
            }
}

// As above, with enough points that the search has to shrink and split its cells.
TEST(StarDiscrepancy, IsTheDefinitionsForLargerSets) {
    for (const auto& [n, d] : {std::pair{120, 2}, {36, 3}, {16, 4}})
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const PointSet p =
                on_lattice(static_cast<std::size_t>(n), static_cast<std::size_t>(d), 256, seed);
            const double expected = by_definition(p, 256);
            EXPECT_EQ(star_of(p), expected) << text_of(p);
            EXPECT_EQ(by_search(p), expected) << text_of(p);
        }
}

TEST(StarDiscrepancy, ReportsItsBoxAndBounds) {
    for (const auto& p : {halton(50, 1), halton(50, 2), halton(50, 3), halton(30, 4),
                          make("random", points(40, 2)), make("random", points(40, 3))}) {
        const Report report = star_report(p);
        expect_box_holds(p, report);
        EXPECT_EQ(report.number("lower"), report.number("value"));
        EXPECT_EQ(report.number("upper"), report.number("value"));
        EXPECT_TRUE(std::get<bool>(*report.find("exact")));
    }
    EXPECT_EQ(star_report(halton(9, 1)).text("method"), "sweep-1d");
    EXPECT_EQ(star_report(halton(9, 2)).text("method"), "sweep-2d");
    EXPECT_EQ(star_report(halton(9, 3)).text("method"), "branch-and-bound");
}

// Two boxes that differ by 2^-52, far below the rounding of sums of doubles, and closer to 1.
TEST(StarDiscrepancy, ComparesBoxesWithoutRounding) {
    const double tiny = 0x1p-300;
    const PointSet p = points_of({{tiny, tiny}, {tiny / 2, tiny}, {tiny, tiny / 4}});
    const Report report = star_report(p);
    EXPECT_EQ(report.number("value"), 1);
    EXPECT_EQ(report.number("worst_box.volume"), tiny * tiny);
    // Open box up to one half: 0.5 - 2^-54 and 0.5 - 2^-54 + tiny round to the same double.
    const double half = 0.5 - 0x1p-54;
    const PointSet q = points_of({{half, 1}, {1, half}});
    EXPECT_EQ(star_report(q).number("value"), by_search(q));
    expect_box_holds(q, star_report(q));
}

// The ascents alone find most worst boxes; boxes that the search excludes must not depend on them.
// The sets include some that fail if the ends of a cell are judged by another cell's bound.
TEST(StarDiscrepancy, SearchFindsFromNothingWhatItFindsFromAGoodStart) {
    for (const auto& [n, d] :
         {std::pair{150, 3}, {64, 4}, {100, 4}, {16, 6}, {16, 7}, {64, 8}, {25, 12}})
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const auto dim = static_cast<std::size_t>(d);
            const PointSet p =
                make("random", points(static_cast<std::uint64_t>(n), dim), {}, {.seed = seed});
            EXPECT_EQ(star_of(p), by_search(p)) << "n " << n << ", d " << d << ", seed " << seed;
        }
}

// Sets whose coordinates are difficult to group: many on one line, large gaps, two points at every
// coordinate, all on a diagonal, and coordinates 2^-50 apart. The sweep distinguishes coordinates
// only by groups.
TEST(StarDiscrepancy, SweepAndSearchAgreeOnUnevenSets) {
    const auto bent = [](std::size_t n, const auto& bend) {
        PointSet p = make("random", points(n, 2), {}, {.seed = n});
        for (std::size_t i = 0; i < n; ++i) bend(i, p[i]);
        return p;
    };
    using Point = std::span<double>;
    const PointSet sets[] = {
        bent(500, [](std::size_t i, Point x) { x[0] = i % 3 == 0 ? x[0] : 0.25; }),
        bent(501, [](std::size_t i, Point x) { x[1] = i % 3 == 0 ? x[1] : 1; }),
        bent(502, [](std::size_t i, Point x) { x[i % 2] *= 0.01; }),
        bent(503, [](std::size_t, Point x) { x[0] = x[0] < 0.5 ? x[0] * 0.1 : 1 - x[1] * 0.1; }),
        bent(504, [](std::size_t, Point x) { x[1] = x[0]; }),
        bent(505, [](std::size_t, Point x) { x[1] = 1 - x[0]; }),
        bent(506, [](std::size_t i, Point x) { x[0] = 0.5 + 0x1p-50 * static_cast<double>(i); }),
        bent(507, [](std::size_t, Point x) { x[0] *= x[0] * x[0] * x[0], x[1] = 1 - x[0] * x[1]; }),
        bent(508, [](std::size_t, Point x) { x[0] = 0, x[1] = 1; }),
        on_lattice(3000, 2, 16, 1),
        on_lattice(1000, 2, 1024, 2),
    };
    for (const PointSet& p : sets) {
        EXPECT_EQ(star_of(p), by_search(p)) << "of " << p.count();
        expect_box_holds(p, star_report(p));
    }
}

// The sweep may be split into strips anywhere, and needs no good starting box, as for large sets.
TEST(StarDiscrepancy, SweepsFromAnyStripFindTheSame) {
    for (const PointSet& p : {make("random", points(700, 2)), halton(400, 2),
                              on_lattice(600, 2, 32, 1), on_lattice(300, 2, 4096, 2)}) {
        const BoxGrid corners = box_grid(p, Family::anchored, {});
        const star::Plane plane = star::plane(corners, {});
        const std::size_t strips = plane.strips.count();
        ASSERT_GT(strips, 20U);
        const double value = by_search(p);
        for (std::size_t cut = 0; cut <= strips; cut += 1 + strips / 12) {
            WorstBox worst(corners);
            for (const auto side : {Side::open, Side::closed})
                for (const star::StripRange range : {star::StripRange{0, cut}, {cut, strips}}) {
                    WorstBox part(corners);
                    if (range.first < range.last)
                        star::sweep_strips(plane, side, range, part, {}, [](std::uint64_t) {});
                    worst.offer(part);
                }
            EXPECT_EQ(worst.value(), value) << "cut at " << cut;
        }
    }
}

TEST(StarDiscrepancy, SweepAndSearchAgree) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const PointSet random = make("random", points(20 * seed, 2), {}, {.seed = seed});
        EXPECT_EQ(star_of(random), by_search(random)) << "seed " << seed;
        const PointSet line = make("random", points(20 * seed, 1), {}, {.seed = seed});
        EXPECT_EQ(star_of(line), by_search(line)) << "seed " << seed;
        const PointSet tied = on_lattice(300, 2, 16 * seed, seed);
        EXPECT_EQ(star_of(tied), by_search(tied)) << "seed " << seed;
    }
    for (const std::size_t n : {777, 3000})
        EXPECT_EQ(star_of(halton(n, 2)), by_search(halton(n, 2))) << n;
}

TEST(StarDiscrepancy, InThreeDimensionsIsThatOfPlainLevels) {
    for (const PointSet& p : {halton(350, 3), make("random", points(300, 3)),
                              on_lattice(1000, 3, 64, 3), on_lattice(4000, 3, 16, 4)})
        EXPECT_NEAR(star_of(p), by_levels(p), 1e-14) << p.count();
}

TEST(StarDiscrepancy, DoesNotDependOnTheOrderOfTheAxes) {
    for (std::size_t d = 2; d <= 5; ++d) {
        const PointSet p = make("random", points(60, d), {}, {.seed = d});
        const double value = star_of(p);
        std::vector<std::size_t> axes(d);
        std::iota(axes.begin(), axes.end(), std::size_t{0});
        for (std::size_t turn = 1; turn < d; ++turn) {
            std::rotate(axes.begin(), axes.begin() + 1, axes.end());
            PointSet q(p.count(), d);
            for (std::size_t i = 0; i < p.count(); ++i)
                for (std::size_t k = 0; k < d; ++k) q[i][k] = p[i][axes[k]];
            EXPECT_EQ(star_of(q), value) << "d " << d << ", turned by " << turn;
        }
    }
}

// |k'/(n+1) - k/n| <= 1/(n+1) for k' = k or k + 1, in every box.
TEST(StarDiscrepancy, ChangesLittleWithOnePointMore) {
    for (std::size_t d = 1; d <= 3; ++d) {
        double before = 1;
        for (std::size_t n = 1; n <= 60; ++n) {
            const double value = star_of(halton(n, d, 0));
            EXPECT_LE(std::abs(value - before), 1. / static_cast<double>(n) + 1e-15)
                << "n " << n << ", d " << d;
            EXPECT_GE(value, .5 / static_cast<double>(n)) << "n " << n << ", d " << d;
            before = value;
        }
    }
}

TEST(StarDiscrepancy, IsTheSameForAnyNumberOfThreads) {
    for (const PointSet& p : {make("random", points(3000, 2)), make("random", points(200, 4)),
                              on_lattice(200, 3, 8, 1)}) {
        const Report one = analyze("star-discrepancy", p, {}, {.threads = 1});
        EXPECT_EQ(one, analyze("star-discrepancy", p, {}, {.threads = 2}));
        EXPECT_EQ(one, analyze("star-discrepancy", p, {}, {.threads = 7}));
    }
}

// Exact values are those of complete searches; most of these end early.
TEST(StarDiscrepancy, BoundsHoldTheExactValueWhereverTheyEnd) {
    for (const auto& [n, d] : {std::pair{60, 3}, {40, 5}, {40, 8}})
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            const PointSet p =
                make("random", points(static_cast<std::uint64_t>(n), static_cast<std::size_t>(d)),
                     {}, {.seed = seed});
            const double value = star_of(p);
            const BoxGrid corners = box_grid(p, Family::anchored, {});
            double upper = 1;
            for (std::uint64_t work = 1; work < std::uint64_t{1} << 40; work *= 4) {
                const auto part = star::search(corners, WorstBox(corners), {.work = work}, {});
                EXPECT_LE(part.worst.value(), value) << work;
                EXPECT_GE(part.upper, value) << work;
                upper = std::min(upper, part.upper);
                if (part.ending != Ending::complete) continue;
                EXPECT_EQ(part.worst.value(), value) << work;
                EXPECT_EQ(part.upper, value) << work;
                break;
            }
            EXPECT_EQ(upper, value);
        }
}

// Covers by nearly all corners, and coarse ones; delta is about 1.1 ln(d) d / (d - 1) / side.
TEST(StarDiscrepancy, CoversBoundItFromAboveAndNotByFar) {
    for (std::size_t d = 2; d <= 5; ++d)
        for (std::uint64_t seed = 1; seed <= 6; ++seed) {
            const PointSet p = seed % 2 ? on_lattice(150, d, 8, seed)
                                        : make("random", points(150, d), {}, {.seed = seed});
            const BoxGrid corners = box_grid(p, Family::anchored, {});
            const double value = star_of(p);
            for (const double side : {6, 9, 15, 17}) {
                const auto axes = static_cast<double>(d);
                const auto most = static_cast<std::uint64_t>(std::pow(side, axes) + 0.5);
                const double delta = 1.25 * std::log(axes) * axes / (axes - 1) / (side - 2);
                const double bound = star::cover_bound(corners, most, {});
                EXPECT_GE(bound, value) << d << ' ' << seed << ' ' << side;
                EXPECT_LE(bound, std::min(1.0, value + delta)) << d << ' ' << seed << ' ' << side;
            }
            EXPECT_EQ(star::cover_bound(corners, 20, {}), 1);
        }
    // All points at 0: the closed box up to 0 has the largest possible discrepancy.
    const PointSet zeros = points_of({{0, 0, 0}, {0, 0, 0}});
    EXPECT_EQ(star::cover_bound(box_grid(zeros, Family::anchored, {}), 1 << 15, {}), 1);
}

// Niederreiter's bound for t = 0 is (1 + m) / 2^m in two dimensions, and (1 + m (m + 1) / 2) / 2^m
// in three.
TEST(StarDiscrepancy, NetsBoundItByTheirQuality) {
    const auto bound = [](const PointSet& p, double most = 1) {
        return star::net_bound(box_grid(p, Family::anchored, {}), most, std::uint64_t{1} << 40, {});
    };
    for (std::size_t m = 1; m <= 12; ++m) {
        const std::uint64_t n = std::uint64_t{1} << m;
        const auto count = static_cast<double>(n);
        const auto digits = static_cast<double>(m);
        const PointSet flat = make("sobol", points(n, 2));
        EXPECT_EQ(bound(flat), std::min(1.0, (1 + digits) / count)) << m;
        EXPECT_EQ(bound(flat, (1 + digits) / count), 1) << m;
        EXPECT_GE(bound(flat), star_of(flat)) << m;
        const PointSet net = make("hammersley", points(n, 2));
        EXPECT_EQ(bound(net), std::min(1.0, (1 + digits) / count)) << m;
    }
    const PointSet solid = make("niederreiter", points(1024, 3), {{"scramble", "owen"}});
    EXPECT_LT(bound(solid), 0.2);
    EXPECT_GE(bound(solid), star_of(solid));
    EXPECT_EQ(bound(make("random", points(1024, 3))), 1);
    EXPECT_EQ(bound(make("sobol", points(1023, 3))), 1);
}

// M. Gnewuch, M. Wahlstroem, C. Winzen, SIAM J. Numer. Anal. 50 (2012) 781-807,
// doi:10.1137/110833865 (arXiv:1103.2102), publish exact values of Faure sets, from index 0, to
// four digits; these are five of them.
TEST(StarDiscrepancy, OfFaureSetsIsThePublishedOne) {
    const auto of_faure = [](std::size_t n, std::size_t d) {
        return star_of(make("faure", points(n, d)));
    };
    EXPECT_NEAR(of_faure(343, 7), 0.1298, 0.5e-4);
    EXPECT_NEAR(of_faure(121, 8), 0.1702, 0.5e-4);
    EXPECT_NEAR(of_faure(121, 9), 0.2121, 0.5e-4);
    EXPECT_NEAR(of_faure(121, 10), 0.2574, 0.5e-4);
    EXPECT_NEAR(of_faure(121, 11), 0.3010, 0.5e-4);
}

// The Fibonacci column in the tables of F. Clement, C. Doerr, K. Klamroth, L. Paquete
// (arXiv:2311.17463) and, for n >= 30, T. K. Rusch and others (arXiv:2405.15059), as collected by
// the README of github.com/hockeyguy123/openevolve-star-discrepancy: points (i/n, {i phi}), i = 0
// .. n - 1, phi the golden ratio. Some values are truncated, not rounded. For n = 4 they print
// 0.4910; the value is 3/4 - {phi}/2 = 0.4410, for the box up to (1/2, {phi}).
TEST(StarDiscrepancy, OfFibonacciSetsIsThePublishedOne) {
    const double phi = (1 + std::sqrt(5.0)) / 2;
    const auto of_fibonacci = [phi](std::size_t n) {
        PointSet p(n, 2);
        for (std::size_t i = 0; i < n; ++i) {
            p[i][0] = static_cast<double>(i) / static_cast<double>(n);
            p[i][1] = std::fmod(static_cast<double>(i) * phi, 1);
        }
        return star_of(p);
    };
    const double few[] = {1.0000, 0.6909, 0.5880, 0.4410, 0.3528, 0.3183, 0.2728,
                          0.2553, 0.2270, 0.2042, 0.1857, 0.1702, 0.1571, 0.1459,
                          0.1390, 0.1486, 0.1398, 0.1320, 0.1251, 0.1188};
    for (std::size_t n = 1; n <= std::size(few); ++n)
        EXPECT_NEAR(of_fibonacci(n), few[n - 1], 1e-4) << n;
    EXPECT_NEAR(of_fibonacci(4), 0.75 - (phi - 1) / 2, 1e-15);
    const double many[] = {0.02128, 0.01655, 0.01354, 0.01200, 0.01054, 0.00957, 0.00857, 0.00775,
                           0.00708, 0.00651, 0.00603, 0.00561, 0.00525, 0.00509, 0.00480, 0.00484,
                           0.00459, 0.00436, 0.00416, 0.00398, 0.00381, 0.00365, 0.00351};
    for (std::size_t i = 0; i < std::size(many); ++i)
        EXPECT_NEAR(of_fibonacci(140 + 40 * i), many[i], 1e-5) << 140 + 40 * i;
    const std::pair<std::size_t, double> between[] = {
        {30, 0.07923}, {40, 0.06384}, {50, 0.05307}, {60, 0.04422}, {100, 0.02749}};
    for (const auto& [n, value] : between) EXPECT_NEAR(of_fibonacci(n), value, 1e-5) << n;
}

// Output of Thiemard's program of 2001 for these points, published by J. Burkardt.
TEST(StarDiscrepancy, IsBetweenThePrintedBoundsOfTenHaltonPoints) {
    const double value = star_of(halton(10, 2, 0));
    EXPECT_GE(value, 0.2666665);
    EXPECT_LE(value, 0.2674435);
}

// Few points, compared with brute force in integers, also with ties and points on 0 and 1.
TEST(StarDiscrepancy, BoundsHoldTheDefinitionsValue) {
    for (std::size_t d = 2; d <= 6; ++d)
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            const PointSet p = on_lattice(6, d, 8, seed);
            const double value = by_definition(p, 8);
            for (const char* work : {"1", "1000", "100000000"}) {
                const Report report =
                    analyze("star-discrepancy", p, {{"method", "bounds"}, {"max-work", work}});
                EXPECT_LE(report.number("lower"), value) << text_of(p);
                EXPECT_GE(report.number("upper"), value) << text_of(p);
                const bool near = report.number("upper") <= 1.1 * report.number("lower");
                ASSERT_EQ(report.find("value") != nullptr, near) << text_of(p);
                if (near) {
                    EXPECT_EQ(report.number("value"), report.number("lower"));
                }
                const bool exact = report.number("upper") == report.number("lower");
                EXPECT_EQ(std::get<bool>(*report.find("exact")), exact);
                if (exact) {
                    EXPECT_EQ(report.number("value"), value) << text_of(p);
                }
            }
        }
}

TEST(StarDiscrepancy, ToleranceIsHonouredAndNotOvershotByFar) {
    const PointSet p = halton(100, 9);
    const double value = star_of(p);
    for (const double tolerance : {1.0, 0.5, 0.1, 0.0}) {
        const Report report =
            analyze("star-discrepancy", p,
                    {{"method", "bounds"}, {"tolerance", fmt::format("{}", tolerance)}});
        const double lower = report.number("lower");
        EXPECT_LE(lower, value);
        EXPECT_GE(report.number("upper"), value);
        EXPECT_LE(report.number("upper") - lower, tolerance * lower);
        EXPECT_EQ(std::get<bool>(*report.find("exact")), tolerance == 0);
    }
    const Report usual = analyze("star-discrepancy", p, {{"method", "bounds"}});
    EXPECT_LE(usual.number("upper"), 1.1 * usual.number("lower"));
    EXPECT_GT(usual.number("upper"), usual.number("lower"));
    const Report automatic = analyze("star-discrepancy", p, {{"tolerance", "0.5"}});
    EXPECT_GT(automatic.number("upper"), automatic.number("lower"));
}

TEST(StarDiscrepancy, ExactOrNothingExceptWhatIsCertain) {
    const PointSet p = halton(150, 10);
    const double value = star_of(p);
    const BoxGrid corners = box_grid(p, Family::anchored, {});
    const SearchResult part = star::find_worst(corners, {.work = 20'000'000}, {});
    EXPECT_EQ(part.ending, Ending::work);
    EXPECT_LE(part.worst.value(), value);
    EXPECT_GE(part.upper, value);
    EXPECT_LT(part.upper, 0.7);
    const Settings few = {{"max-work", "20000000"}};
    const std::string message = error_of([&] {
        analyze("star-discrepancy", p, {{"method", "exact"}, {"max-work", "20000000"}});
    });
    EXPECT_EQ(
        message,
        fmt::format(
            "limit: the star discrepancy of 150 points in 10 dimensions takes more than 20000000 "
            "comparisons (--max-work); so far it is proven to be between {} and {} | a larger "
            "--max-work, or fewer points, may give the exact value; --method bounds accepts bounds",
            part.worst.value(), part.upper));
    std::vector<std::string> told;
    RunContext run;
    run.warn = [&](const std::string& sentence) { told.push_back(sentence); };
    const Report bounds = analyze("star-discrepancy", p, few, run);
    EXPECT_FALSE(std::get<bool>(*bounds.find("exact")));
    EXPECT_EQ(bounds.find("value"), nullptr);
    EXPECT_EQ(bounds.number("lower"), part.worst.value());
    EXPECT_EQ(bounds.number("upper"), part.upper);
    expect_box_holds(p, bounds);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0],
              fmt::format("the star discrepancy is not known exactly; it is between {} and {}",
                          part.worst.value(), part.upper));
    told.clear();
    analyze("star-discrepancy", p,
            {{"max-work", "20000000"}, {"method", "bounds"}, {"tolerance", "0.001"}}, run);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_THAT(told[0], HasSubstr(" (--tolerance 0.001 was not reached)"));
}

// A clock that advances by a hundredth of a second whenever it is read.
TEST(StarDiscrepancy, EndsAtTheTimeLimitWithBounds) {
    for (const auto& p : {halton(3000, 2), halton(300, 6)}) {
        std::atomic<int> looks = 0;
        RunContext run{.threads = 1};
        run.seconds = [&] { return 0.01 * static_cast<double>(++looks); };
        const Report report = analyze("star-discrepancy", p, {{"time-limit", "0.05"}}, run);
        EXPECT_LE(looks, 200);
        EXPECT_FALSE(std::get<bool>(*report.find("exact")));
        EXPECT_LT(report.number("lower"), report.number("upper"));
        expect_box_holds(p, report);
        const double value = star_of(p);
        EXPECT_LE(report.number("lower"), value);
        EXPECT_GE(report.number("upper"), value);
        looks = 0;
        EXPECT_EQ(
            error_of([&] {
                analyze("star-discrepancy", p, {{"time-limit", "0.05"}, {"method", "exact"}}, run);
            }).substr(0, 30),
            "limit: the star discrepancy of");
        looks = 0;
        const Report enough = analyze("star-discrepancy", p, {{"time-limit", "1e6"}}, run);
        EXPECT_EQ(enough.number("value"), value);
        EXPECT_TRUE(std::get<bool>(*enough.find("exact")));
    }
}

TEST(StarDiscrepancy, MethodsAgreeInTheSquareAndOnTheLine) {
    for (const auto& p : {halton(500, 2), on_lattice(200, 2, 16, 3), halton(500, 1)}) {
        const Report searched =
            analyze("star-discrepancy", p, {{"method", "bounds"}, {"tolerance", "0"}});
        EXPECT_EQ(searched.number("value"), star_of(p));
        EXPECT_TRUE(std::get<bool>(*searched.find("exact")));
        const Report exact = analyze("star-discrepancy", p, {{"method", "exact"}});
        EXPECT_EQ(exact, star_report(p));
    }
}

TEST(StarDiscrepancy, BoundsAreTheSameForAnyNumberOfThreads) {
    const PointSet p = halton(150, 10);
    const Settings settings = {{"max-work", "20000000"}};
    const Report one = analyze("star-discrepancy", p, settings, {.threads = 1});
    EXPECT_FALSE(std::get<bool>(*one.find("exact")));
    EXPECT_EQ(one, analyze("star-discrepancy", p, settings, {.threads = 3}));
}

TEST(StarDiscrepancy, RefusesLimitsThatMakeNoSense) {
    const PointSet p = halton(5, 3);
    const auto refusal = [&](const char* name, const char* value) {
        return error_of([&] { analyze("star-discrepancy", p, {{name, value}}); });
    };
    EXPECT_THAT(refusal("time-limit", "0"), HasSubstr("usage: --time-limit: 0 is outside"));
    EXPECT_THAT(refusal("time-limit", "-1"), HasSubstr("usage: --time-limit: -1 is outside"));
    EXPECT_THAT(refusal("tolerance", "-0.1"), HasSubstr("usage: --tolerance: -0.1 is outside"));
    EXPECT_THAT(refusal("method", "approximate"), HasSubstr("not one of auto, exact, bounds"));
    EXPECT_EQ(error_of([&] {
                  analyze("star-discrepancy", p, {{"method", "exact"}, {"tolerance", "0.1"}});
              }),
              "usage: --tolerance cannot be combined with --method exact");
    EXPECT_EQ(error_of([&] {
                  analyze("star-discrepancy", p, {{"kind", "extreme"}, {"boxes", "half-open"}});
              }),
              "usage: --boxes applies to --kind star only");
}

TEST(StarDiscrepancy, BoundsHoldWhereNoSearchGetsThrough) {
    const PointSet q = make("random", points(50, 60));
    const Report report = analyze("star-discrepancy", q, {{"max-work", "5000000"}});
    EXPECT_LE(report.number("lower"), report.number("upper"));
    EXPECT_LE(report.number("upper"), 1);
    EXPECT_GT(report.number("lower"), 0.5);
    expect_box_holds(q, report);
}

TEST(StarDiscrepancy, SaysWhatIsCertainWhenAskedToStop) {
    const auto stopped = [](const PointSet& p, const char* kind) {
        std::stop_source source;
        int reports = 0;
        RunContext run{.stop = source.get_token()};
        run.progress = [&](double) {
            ++reports;
            source.request_stop();
        };
        const Report report = analyze("star-discrepancy", p, {{"kind", kind}}, run);
        EXPECT_EQ(reports, 1);
        return report;
    };
    for (const auto& p : {make("random", points(100'000, 2)), halton(1000, 6)}) {
        const Report report = stopped(p, "star");
        EXPECT_FALSE(std::get<bool>(*report.find("exact")));
        EXPECT_GT(report.number("lower"), 0);
        EXPECT_LT(report.number("lower"), report.number("upper"));
        expect_box_holds(p, report);
    }
    for (const char* kind : {"extreme", "periodic"}) {
        const Report report = stopped(halton(300, 4), kind);
        EXPECT_FALSE(std::get<bool>(*report.find("exact")));
        EXPECT_GT(report.number("lower"), 0);
        EXPECT_LT(report.number("lower"), report.number("upper"));
    }
}

// Also if stopped before anything was computed.
TEST(StarDiscrepancy, SaysSomethingCertainWhenStoppedAtOnce) {
    std::stop_source source;
    const RunContext run{.threads = 1, .stop = source.get_token()};
    const PointSet p = halton(500, 5);
    const BoxGrid corners = box_grid(p, Family::anchored, run);
    source.request_stop();
    const SearchResult found = star::find_worst(corners, {}, run);
    EXPECT_EQ(found.ending, Ending::stopped);
    EXPECT_LT(found.upper, 0.7);
    EXPECT_GE(found.upper, star_of(p));
    EXPECT_LE(found.worst.value(), star_of(p));
    EXPECT_GE(found.worst.value(), 0.5 / 500);
    EXPECT_EQ(WorstBox(corners).corner(&Interval::upper), std::vector<double>(5, 1.0));
    EXPECT_EQ(WorstBox(corners).points(), 500U);
    const Report table = analyze("star-discrepancy", p, {{"every", "100"}}, run);
    for (std::size_t row = 0; row < 5; ++row) {
        EXPECT_GE(table.curve("prefixes.lower")[row], 0.001);
        EXPECT_TRUE(std::isnan(table.curve("prefixes.value")[row]));
        EXPECT_LE(table.curve("prefixes.upper")[row], 1);
    }
}

// Quick bounds are valid: with ties, with points on 0 and 1, for either kind of boxes.
TEST(StarDiscrepancy, QuickBoundsHold) {
    for (const std::size_t d : {1, 2, 3, 5, 6})
        for (const std::size_t n : {1, 2, 9, 60})
            for (const std::uint64_t steps : {2, 5, 1000}) {
                const PointSet p = on_lattice(n, d, steps, n);
                for (const auto family : {Family::anchored, Family::half_open}) {
                    const BoxGrid grid = box_grid(p, family, {});
                    const SearchResult exact = star::find_worst(grid, {}, {});
                    WorstBox found(grid);
                    star::offer_axis_boxes(grid, found);
                    EXPECT_LE(found.value(), exact.worst.value()) << n << " " << d << " " << steps;
                    EXPECT_GE(found.value(), 0.5 / static_cast<double>(n));
                    EXPECT_GE(star::quick_bound(grid, {}), exact.worst.value())
                        << n << " " << d << " " << steps;
                }
            }
    const PointSet many = make("random", points(100'000, 20));
    EXPECT_LT(star::quick_bound(box_grid(many, Family::anchored, {}), {}), 0.85);
    EXPECT_LT(star::quick_bound(box_grid(halton(100'000, 5), Family::anchored, {}), {}), 0.3);
}

TEST(StarDiscrepancy, BoundsFromSingleAxesByHand) {
    // Each axis has discrepancy 1/10: (1 - 1/3)^3, and all three for open boxes.
    PointSet five(5, 3);
    for (std::size_t i = 0; i < 5; ++i)
        for (double& x : five[i]) x = (static_cast<double>(i) + 0.5) / 5;
    const BoxGrid grid = box_grid(five, Family::anchored, {});
    EXPECT_NEAR(star::axis_bound(grid, 1), 8 / 27. + 0.3, 1e-12);
    // Bound for closed boxes on which the axes have none: (1 - 1/3) 3^(-1/2).
    EXPECT_NEAR(star::axis_bound(grid, 0), 2 / (3 * std::sqrt(3)), 1e-12);
}

// On a diagonal, a closed box has as many points as one of its sides. If no point is in the upper
// part of more than one axis, an open box lacks as many points as all of its sides together.
TEST(StarDiscrepancy, BoundsFromSingleAxesAreReached) {
    constexpr std::size_t n = 60;
    PointSet diagonal(n, 3);
    PointSet apart(n, 2);
    for (std::size_t i = 0; i < n; ++i) {
        for (double& x : diagonal[i]) x = (static_cast<double>(i) + 0.5) / n;
        apart[i][i % 2] = (static_cast<double>(i / 2) + 0.5) / n;
        apart[i][1 - i % 2] = 0.5 + apart[i][i % 2];
    }
    for (const PointSet& p : {diagonal, apart}) {
        const double bound = star::axis_bound(box_grid(p, Family::anchored, {}), 1);
        EXPECT_GE(bound, star_of(p));
        EXPECT_LE(bound, star_of(p) + 1.5 / n);
    }
}

// Also if the search has no time.
TEST(StarDiscrepancy, OfOtherKindsHasBoundsInFiveDimensions) {
    for (const char* kind : {"extreme", "periodic"}) {
        const Report report =
            analyze("star-discrepancy", halton(2000, 5), {{"kind", kind}, {"max-work", "100000"}});
        EXPECT_GT(report.number("lower"), 0);
        EXPECT_LT(report.number("upper"), 0.6) << kind;
    }
}

TEST(StarDiscrepancy, TellsItsProgress) {
    for (const PointSet& p : {halton(20'000, 1), halton(20'000, 2), halton(300, 4)}) {
        std::vector<double> seen;
        RunContext run;
        run.progress = [&](double done) { seen.push_back(done); };
        analyze("star-discrepancy", p, {}, run);
        EXPECT_TRUE(std::ranges::is_sorted(seen));
        EXPECT_EQ(seen.back(), 1);
    }
}

TEST(StarDiscrepancy, RefusesPointsOutsideTheCubeAndTooLittleMemory) {
    EXPECT_NE(error_of([] { star_of(points_of({{.5, 1.5}})); }), "");
    EXPECT_NE(error_of([] { star_of(points_of({{.5, std::nan("")}})); }), "");
    RunContext run;
    run.max_memory = 1000;
    EXPECT_EQ(
        error_of([&] { analyze("star-discrepancy", halton(1000, 2), {}, run); }),
        "limit: the star discrepancy of 1000 points in 2 dimensions needs 54.7 KiB of memory; the "
        "limit is 1000 bytes | 17 points would fit; or raise the limit with --max-memory");
    EXPECT_THAT(error_of([&] { analyze("star-discrepancy", halton(1000, 5), {}, run); }),
                HasSubstr("points would fit"));
}

TEST(StarDiscrepancy, TellsThatOfEveryPrefix) {
    const PointSet whole = halton(100, 2);
    const auto first = [&whole](std::size_t n) {
        const auto rows = whole.flat().first(2 * n);
        return PointSet(std::vector<double>(rows.begin(), rows.end()), 2);
    };
    const Report some = analyze("star-discrepancy", whole, {{"prefixes", "1,7,50,100"}});
    EXPECT_EQ(std::get<Report::Integers>(*some.find("prefixes.count")),
              (Report::Integers{1, 7, 50, 100}));
    const std::size_t sizes[] = {1, 7, 50, 100};
    for (std::size_t row = 0; row < 4; ++row) {
        const double value = star_of(first(sizes[row]));
        EXPECT_EQ(some.curve("prefixes.value")[row], value) << sizes[row];
        EXPECT_EQ(some.curve("prefixes.lower")[row], value) << sizes[row];
        EXPECT_EQ(some.curve("prefixes.upper")[row], value) << sizes[row];
    }
    EXPECT_EQ(std::get<Report::Integers>(*some.find("prefixes.exact")),
              (Report::Integers{1, 1, 1, 1}));
    EXPECT_EQ(analyze("star-discrepancy", whole, {{"prefixes", "2^0,7,50,1e2"}}), some);
    EXPECT_EQ(some.find("value"), nullptr);
    const Report steps = analyze("star-discrepancy", whole, {{"every", "30"}});
    EXPECT_EQ(std::get<Report::Integers>(*steps.find("prefixes.count")),
              (Report::Integers{30, 60, 90}));
    EXPECT_EQ(steps.curve("prefixes.value")[1], star_of(first(60)));
    const Report open = analyze("star-discrepancy", points_of({{0, 1}, {0, .5}}),
                                {{"every", "1"}, {"boxes", "half-open"}});
    EXPECT_EQ(open.curve("prefixes.value"), (Report::Curve{1, .5}));
}

TEST(StarDiscrepancy, TellsThatOfEveryProjectionAndTheWorst) {
    const PointSet p = halton(64, 4);
    const auto flat = [&p](std::size_t j, std::size_t k) {
        PointSet q(p.count(), 2);
        for (std::size_t i = 0; i < p.count(); ++i) q[i][0] = p[i][j], q[i][1] = p[i][k];
        return q;
    };
    const Report report = analyze("star-discrepancy", p, {{"projections", "2"}});
    const auto column = [&report](const char* name) {
        return std::get<Report::Integers>(*report.find(name));
    };
    EXPECT_EQ(column("projections.axis_1"), (Report::Integers{1, 1, 2, 1, 2, 3}));
    EXPECT_EQ(column("projections.axis_2"), (Report::Integers{2, 3, 3, 4, 4, 4}));
    const auto value = report.curve("projections.value");
    EXPECT_EQ(value[0], star_of(flat(0, 1)));
    EXPECT_EQ(value[2], star_of(flat(1, 2)));
    EXPECT_EQ(value[5], star_of(flat(2, 3)));
    EXPECT_EQ(report.number("projections.largest.value"), std::ranges::max(value));
    const auto marks = column("projections.is_worst");
    EXPECT_EQ(std::ranges::count(marks, 1), 1);
    const auto worst = static_cast<std::size_t>(std::ranges::find(marks, 1) - marks.begin());
    EXPECT_EQ(value[worst], std::ranges::max(value));
    EXPECT_EQ(column("projections.worst"), (Report::Integers{column("projections.axis_1")[worst],
                                                             column("projections.axis_2")[worst]}));
    EXPECT_EQ(analyze("star-discrepancy", p, {{"projections", "4"}}).curve("projections.value"),
              Report::Curve{star_of(p)});
}

TEST(StarDiscrepancy, TablesAreTheSameForAnyNumberOfThreads) {
    const Settings settings = {{"every", "13"}, {"projections", "2"}};
    const PointSet p = halton(100, 3);
    const Report one = analyze("star-discrepancy", p, settings, {.threads = 1});
    EXPECT_EQ(one, analyze("star-discrepancy", p, settings, {.threads = 2}));
    EXPECT_EQ(one, analyze("star-discrepancy", p, settings, {.threads = 5}));
    std::vector<double> seen;
    RunContext run{.threads = 2};
    run.progress = [&](double done) { seen.push_back(done); };
    analyze("star-discrepancy", p, settings, run);
    EXPECT_TRUE(std::ranges::is_sorted(seen));
    EXPECT_EQ(seen.back(), 1);
}

// If prefixes are measured one after the other, each row has the bounds known for it.
TEST(StarDiscrepancy, TablesOfPrefixesTellTheGap) {
    std::vector<std::string> words;
    std::vector<double> seen;
    RunContext run{.threads = 1};
    run.progress = [&](double done) { seen.push_back(done); };
    run.note = [&](const std::string& note) { words.push_back(note); };
    analyze("star-discrepancy", halton(160, 8), {{"prefixes", "140,160"}}, run);
    const auto said = [&](const std::string& about) {
        return std::ranges::any_of(words, [&](const auto& w) { return w.starts_with(about); });
    };
    EXPECT_TRUE(said("140 points: between 0."));
    EXPECT_TRUE(said("160 points: between 0."));
    EXPECT_TRUE(std::ranges::is_sorted(seen));
    EXPECT_TRUE(std::ranges::any_of(seen, [](double done) { return done > 0.5 && done < 1; }));
    EXPECT_EQ(seen.back(), 1);
}

// A table has the limits of a single set; values that are not computed have valid bounds.
TEST(StarDiscrepancy, LimitsAreForAllRowsOfATable) {
    const PointSet p = halton(160, 8);
    const auto rows = [&p](const Settings& settings, const RunContext& run = {}) {
        return analyze("star-discrepancy", p, settings, run);
    };
    const Report exact = rows({{"every", "20"}});
    std::vector<std::string> told;
    RunContext run{.threads = 1};
    run.warn = [&](const std::string& sentence) { told.push_back(sentence); };
    const Report part = rows({{"every", "20"}, {"max-work", "4000000"}}, run);
    std::size_t open = 0;
    for (std::size_t row = 0; row < 8; ++row) {
        const double value = exact.curve("prefixes.value")[row];
        EXPECT_LE(part.curve("prefixes.lower")[row], value) << row;
        EXPECT_GE(part.curve("prefixes.upper")[row], value) << row;
        const bool between = part.curve("prefixes.lower")[row] < part.curve("prefixes.upper")[row];
        EXPECT_EQ(std::get<Report::Integers>(*part.find("prefixes.exact"))[row], between ? 0 : 1);
        EXPECT_EQ(std::isnan(part.curve("prefixes.value")[row]), between);
        open += between ? 1U : 0U;
    }
    EXPECT_GT(open, 0U);
    EXPECT_LT(open, 8U);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_THAT(told[0],
                HasSubstr(fmt::format("{} of 8 discrepancies are not known exactly", open)));
    EXPECT_THAT(told[0], HasSubstr("the first, that of the first "));
    const Report again = rows({{"every", "20"}, {"max-work", "4000000"}}, {.threads = 3});
    for (const char* key : {"prefixes.lower", "prefixes.upper"})
        EXPECT_EQ(part.curve(key), again.curve(key));
    // A clock that advances by a hundredth of a second whenever it is read.
    std::atomic<int> looks = 0;
    run.seconds = [&] { return 0.01 * static_cast<double>(++looks); };
    const Report timed = rows({{"projections", "6"}, {"time-limit", "2"}}, run);
    EXPECT_LE(looks, 5000);
    EXPECT_EQ(told.size(), 2U);
    EXPECT_THAT(told[1], HasSubstr("the first, that of the projection to axes 1, 2, 3, 4, 5, "));
    EXPECT_FALSE(std::get<bool>(*timed.find("projections.worst_is_certain")));
    EXPECT_EQ(timed.find("projections.largest.value"), nullptr);
    // After the time limit, a row reads the clock a few times; the first row is measured.
    looks = 0;
    const Report late = rows({{"projections", "3"}, {"time-limit", "1e-9"}}, run);
    EXPECT_LE(looks, 56 * 8 + 100);
    EXPECT_LT(late.curve("projections.upper")[0], 1);
    EXPECT_EQ(late.curve("projections.lower")[55], 0.5 / 160);
    EXPECT_EQ(late.curve("projections.upper")[55], 1);
}

// The discrepancies of n points and of the first n - 1 differ by at most 1/n.
TEST(StarDiscrepancy, BoundsOfPrefixesHoldForTheirNeighbours) {
    const PointSet p = halton(60, 7);
    const Report part = analyze("star-discrepancy", p, {{"every", "1"}, {"max-work", "2000000"}});
    const Report exact = analyze("star-discrepancy", p, {{"every", "1"}});
    const auto& lower = part.curve("prefixes.lower");
    const auto& upper = part.curve("prefixes.upper");
    std::size_t open = 0;
    for (std::size_t row = 0; row < 60; ++row) {
        EXPECT_LE(lower[row], exact.curve("prefixes.value")[row]) << row;
        EXPECT_GE(upper[row], exact.curve("prefixes.value")[row]) << row;
        open += lower[row] < upper[row] ? 1U : 0U;
        const double value = part.curve("prefixes.value")[row];
        EXPECT_TRUE(lower[row] < upper[row] ? std::isnan(value) : value == lower[row]) << row;
        if (row == 0) continue;
        const double step = 1 / static_cast<double>(row + 1) + 0x1p-49;
        EXPECT_LE(std::abs(upper[row] - upper[row - 1]), step) << row;
        EXPECT_LE(std::abs(lower[row] - lower[row - 1]), step) << row;
    }
    EXPECT_GT(open, 5U);
}

TEST(StarDiscrepancy, OtherKindsEndAtLimitsWithBounds) {
    const PointSet p = halton(60, 3);
    for (const char* kind : {"extreme", "periodic"}) {
        const double value =
            analyze("star-discrepancy", p, {{"kind", kind}, {"method", "exact"}}).number("value");
        const auto with = [&](const char* name, const char* limit, const RunContext& run = {}) {
            return analyze("star-discrepancy", p, {{"kind", kind}, {name, limit}}, run);
        };
        std::atomic<int> looks = 0;
        RunContext run{.threads = 1};
        run.seconds = [&] { return 0.01 * static_cast<double>(++looks); };
        for (const Report& report : {with("time-limit", "0.05", run), with("max-work", "2000"),
                                     with("tolerance", "0.3"), with("method", "bounds")}) {
            EXPECT_LE(report.number("lower"), value);
            EXPECT_GE(report.number("upper"), value);
            EXPECT_GT(report.number("lower"), 0);
        }
        EXPECT_THAT(error_of([&] {
                        analyze("star-discrepancy", p,
                                {{"kind", kind}, {"method", "exact"}, {"max-work", "2000"}});
                    }),
                    HasSubstr(fmt::format("limit: the {} discrepancy of 60 points in 3 dimensions "
                                          "takes more than 2000 comparisons (--max-work)",
                                          kind)));
    }
}

// The first ascents count towards the limits, and a time limit interrupts them, also in many
// dimensions.
TEST(StarDiscrepancy, LimitsHoldForTheFirstAscents) {
    const PointSet p = make("random", points(20, 500));
    const BoxGrid corners = box_grid(p, Family::anchored, {});
    const std::uint64_t all = ascend(corners, {}, {}).work;
    for (const std::uint64_t most : {1UL, 100'000UL, 3'000'000UL}) {
        const Ascent part = ascend(corners, {.work = most}, {});
        EXPECT_LE(part.work, most / 4 + 2 * (20 * 500 + 61 + 42)) << most;
        EXPECT_LT(part.work, all);
    }
    std::atomic<int> looks = 0;
    RunContext run{.threads = 1};
    run.seconds = [&] { return 0.01 * static_cast<double>(++looks); };
    const Report report = analyze("star-discrepancy", p, {{"time-limit", "0.05"}}, run);
    EXPECT_LE(looks, 200);
    EXPECT_GE(report.number("upper"), report.number("lower"));
    expect_box_holds(p, report);
}

TEST(StarDiscrepancy, MeansHaveNoWorstBox) {
    const Analyzer& analyzer = find_analyzer("star-discrepancy");
    const Values options = analyzer.options.defaults();
    Report mean = star_report(halton(20, 3));
    analyzer.refine(mean, 1, options);
    EXPECT_NE(mean.find("worst_box"), nullptr);
    analyzer.refine(mean, 2, options);
    EXPECT_EQ(mean.find("worst_box"), nullptr);
    EXPECT_NE(mean.find("value"), nullptr);
    Report table = analyze("star-discrepancy", halton(20, 3), {{"projections", "2"}});
    analyzer.refine(table, 2, options);
    EXPECT_EQ(table.find("projections.worst_is_certain"), nullptr);
    EXPECT_NE(table.find("projections.value"), nullptr);
}

// The worst of the means may not be the worst of any set.
TEST(StarDiscrepancy, MeansOfProjectionsHaveTheirOwnWorst) {
    const Analyzer& analyzer = find_analyzer("star-discrepancy");
    Report mean = analyze("star-discrepancy", halton(20, 3), {{"projections", "2"}});
    auto& lower = std::get<Report::Curve>(*mean.find("projections.lower"));
    lower = {0.1, 0.3, 0.2};  // of axes 1 and 2, 1 and 3, 2 and 3
    analyzer.refine(mean, 2, analyzer.options.defaults());
    EXPECT_EQ(std::get<Report::Integers>(*mean.find("projections.worst")),
              (Report::Integers{1, 3}));
    EXPECT_EQ(std::get<Report::Integers>(*mean.find("projections.is_worst")),
              (Report::Integers{0, 1, 0}));
}

TEST(StarDiscrepancy, RefusesTablesThatTheSetDoesNotHave) {
    const PointSet p = halton(50, 2);
    const auto error = [&p](const Settings& settings) {
        return error_of([&] { analyze("star-discrepancy", p, settings); });
    };
    EXPECT_EQ(error({{"prefixes", "16,64"}}),
              "input: --prefixes: 64 is above the number of points, 50");
    EXPECT_EQ(error({{"prefixes", "16,8"}}),
              "usage: --prefixes: 8 comes after 16; expected increasing numbers");
    EXPECT_EQ(error({{"prefixes", "8,8"}}),
              "usage: --prefixes: 8 is given twice; expected increasing numbers");
    EXPECT_EQ(error({{"prefixes", "0,8"}}),
              "usage: --prefixes: 0 is not a number of points; expected 1, 2, ...");
    EXPECT_EQ(error({{"prefixes", "1.5"}}),
              "usage: --prefixes: 1.5 is not a number of points; expected 1, 2, ...");
    EXPECT_NE(error({{"prefixes", "sixteen"}}).find("--prefixes"), std::string::npos);
    EXPECT_NE(error({{"prefixes", "8,,9"}}).find("--prefixes"), std::string::npos);
    EXPECT_NE(error({{"every", "0"}}).find("--every"), std::string::npos);
    EXPECT_EQ(error({{"every", "51"}}), "input: --every: 51 is above the number of points, 50");
    EXPECT_EQ(error({{"every", "5"}, {"prefixes", "5"}}),
              "usage: --prefixes and --every cannot be combined; give one of them");
    EXPECT_EQ(error({{"projections", "3"}}),
              "input: --projections: 3 is above the number of coordinates, 2");
    EXPECT_NE(error({{"projections", "0"}}).find("--projections"), std::string::npos);
    EXPECT_NE(error({{"boxes", "open"}}).find("--boxes"), std::string::npos);
}

}  // namespace stipple::testing::star_discrepancy_test
