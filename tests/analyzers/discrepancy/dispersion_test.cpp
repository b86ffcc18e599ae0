// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "math/discrepancy/empty_rectangle.hpp"
#include "math/discrepancy/extreme/search.hpp"
#include "support/exact.hpp"
#include "support/lattices.hpp"
#include "support/units.hpp"

namespace stipple::testing::dispersion_test {

using namespace stipple::discrepancy;

namespace {

Report report_of(const PointSet& p, bool torus, const Settings& more = {}) {
    Settings settings{{"torus", torus ? "true" : "false"}};
    settings.insert(settings.end(), more.begin(), more.end());
    return analyze("dispersion", p, settings);
}

double value_of(const PointSet& p, bool torus = false) {
    const Report report = report_of(p, torus);
    EXPECT_TRUE(std::get<bool>(*report.find("exact")));
    EXPECT_EQ(report.number("lower"), report.number("value"));
    EXPECT_EQ(report.number("upper"), report.number("value"));
    return report.number("value");
}

/// Result of branch and bound alone, without a starting box.
double by_search(const PointSet& p, bool torus) {
    const BoxGrid grid = box_grid(p, torus ? Family::torus : Family::cube, {}, Measure::emptiness);
    const auto found = extreme::search(grid, WorstBox(grid), {}, {});
    EXPECT_EQ(found.ending, Ending::complete);
    return found.worst.value();
}

/// Whether x is in (a, b), or on the torus in (a, 1 + b) if b <= a.
bool is_between(double x, double a, double b, bool torus) {
    if (!torus) return x > a && x < b;
    if (x == 1) x = 0;
    return a < b ? x > a && x < b : x > a || x < b;
}

std::vector<double> ends_of(const PointSet& p, std::size_t axis, bool torus) {
    std::vector<double> ends;
    if (!torus) ends = {0, 1};
    for (std::size_t i = 0; i < p.count(); ++i)
        ends.push_back(torus && p[i][axis] == 1 ? 0 : p[i][axis]);
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
}

/// Oracle: all boxes between coordinates of points, axis after axis, each time with the points
/// still inside; in exact fractions. Slow, and too plain to be wrong.
Fraction largest_from(const PointSet& p, std::size_t axis, const Fraction& volume,
                      const std::vector<std::size_t>& inside, bool torus) {
    if (axis == p.dimension()) return inside.empty() ? volume : Fraction(0);
    Fraction largest = 0;
    const std::vector<double> ends = ends_of(p, axis, torus);
    for (const double a : ends)
        for (const double b : ends) {
            if (!torus && b <= a) continue;
            std::vector<std::size_t> rest;
            for (const std::size_t i : inside)
                if (is_between(p[i][axis], a, b, torus)) rest.push_back(i);
            const Fraction length = exactly(b) - exactly(a) + (b <= a ? 1 : 0);
            const Fraction whole = volume * length;
            largest = std::max(largest, largest_from(p, axis + 1, whole, rest, torus));
        }
    return largest;
}

Fraction by_definition(const PointSet& p, bool torus) {
    std::vector<std::size_t> all(p.count());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return largest_from(p, 0, 1, all, torus);
}

/// Expects the reported box to be empty and to have the reported volume.
void expect_box_holds(const PointSet& p, const Report& report, bool torus) {
    const auto lower = report.curve("box.lower_corner");
    const auto upper = report.curve("box.upper_corner");
    Fraction volume = 1;
    for (std::size_t k = 0; k < lower.size(); ++k) {
        EXPECT_TRUE(torus || lower[k] < upper[k]);
        volume *= exactly(upper[k]) - exactly(lower[k]) + (upper[k] <= lower[k] ? 1 : 0);
    }
    EXPECT_TRUE(is_nearest_double(report.number("lower"), volume));
    for (std::size_t i = 0; i < p.count(); ++i) {
        bool inside = true;
        for (std::size_t k = 0; k < lower.size(); ++k)
            inside = inside && is_between(p[i][k], lower[k], upper[k], torus);
        EXPECT_FALSE(inside) << "point " << i;
    }
}

std::string text_of(const PointSet& p) {
    std::string text;
    for (std::size_t i = 0; i < p.count(); ++i) text += fmt::format("({})", fmt::join(p[i], ","));
    return text;
}

PointSet grid(std::size_t k, std::size_t d, double offset) {
    PointSet p(static_cast<std::size_t>(std::llround(std::pow(k, d))), d);
    for (std::size_t i = 0; i < p.count(); ++i) {
        std::size_t rest = i;
        for (std::size_t j = 0; j < d; ++j, rest /= k)
            p[i][j] = (static_cast<double>(rest % k) + offset) / static_cast<double>(k);
    }
    return p;
}

/// Lattice (i / n, {i m / n}).
PointSet lattice(std::size_t n, std::size_t m) {
    PointSet p(n, 2);
    for (std::size_t i = 0; i < n; ++i) {
        p[i][0] = static_cast<double>(i) / static_cast<double>(n);
        p[i][1] = static_cast<double>(i * m % n) / static_cast<double>(n);
    }
    return p;
}

}  // namespace

TEST(Dispersion, KnownByHand) {
    EXPECT_EQ(value_of(points_of({{.5}})), .5);
    EXPECT_EQ(value_of(points_of({{.5}}), true), 1);
    EXPECT_EQ(value_of(points_of({{.25}, {.5}})), .5);
    EXPECT_EQ(value_of(points_of({{.25}, {.5}}), true), .75);
    EXPECT_EQ(value_of(points_of({{.5, .25}})), .75);
    EXPECT_EQ(value_of(points_of({{.5, .25}}), true), 1);
    EXPECT_EQ(value_of(points_of({{.25, .25}, {.75, .75}})), .5625);  // from (1/4, 0) to (1, 3/4)
    // The torus without two lines, one through each point.
    EXPECT_EQ(value_of(points_of({{.25, .25}, {.75, .75}}), true), 1);
    EXPECT_EQ(value_of(points_of({{0, 0}, {.5, .5}, {0, .5}, {.5, 0}}), true), .5);
    EXPECT_EQ(value_of(points_of({{.5, .25, .5}})), .75);
    EXPECT_EQ(value_of(points_of({{.5, .25, .5}}), true), 1);
}

// Points on the faces of the cube block nothing, and points on a line block only that line.
TEST(Dispersion, TakesBoxesToBeOpen) {
    EXPECT_EQ(value_of(points_of({{0, 0}, {0, .5}, {1, 1}, {.3, 1}, {.7, 0}, {1, .2}})), 1);
    EXPECT_EQ(value_of(points_of({{0}, {1}})), 1);
    EXPECT_EQ(value_of(points_of({{0, 0}, {.5, 1}}), true), 1);  // 1 equals 0 on the torus
    EXPECT_EQ(value_of(points_of({{0, .5}, {.5, .5}, {.75, .5}})), .5);
    EXPECT_EQ(value_of(points_of({{0, .5}, {.5, .5}, {.75, .5}}), true), 1);
    EXPECT_EQ(value_of(points_of({{.25, .1}, {.25, .5}, {.25, .9}, {.25, .5}})), .75);
}

// With ties, duplicates, points on 0 and 1, and single points.
TEST(Dispersion, IsTheDefinitions) {
    constexpr std::size_t most[] = {0, 20, 9, 4};
    for (std::size_t d = 1; d <= 3; ++d)
        for (const std::uint64_t steps : {2, 4, 3, 10, 1000})
            for (std::uint64_t seed = 1; seed <= 8; ++seed)
                for (const bool torus : {false, true}) {
                    const std::size_t n = 1 + Rng(seed).below(d + steps, most[d]);
                    const PointSet p = on_lattice(n, d, steps, seed);
                    const Report report = report_of(p, torus);
                    EXPECT_TRUE(is_nearest_double(report.number("value"), by_definition(p, torus)))
                        << (torus ? "torus " : "cube ") << text_of(p);
                    EXPECT_EQ(by_search(p, torus), report.number("value")) << text_of(p);
                    expect_box_holds(p, report, torus);
                }
}

// Two methods that share only the comparison of boxes.
TEST(Dispersion, RectanglesAndBranchAndBoundAgree) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
        for (const bool torus : {false, true}) {
            const PointSet random = make("random", points(80 * seed, 2), {}, {.seed = seed});
            EXPECT_EQ(value_of(random, torus), by_search(random, torus)) << "seed " << seed;
            const PointSet tied = on_lattice(50 * seed, 2, 16 * seed, seed);
            EXPECT_EQ(value_of(tied, torus), by_search(tied, torus)) << "seed " << seed;
            const PointSet even = make("halton", points(100 * seed, 2));
            EXPECT_EQ(value_of(even, torus), by_search(even, torus)) << "n " << even.count();
        }
}

// Between two neighbouring planes of a grid is a slab one cell thick, at the faces half a cell.
TEST(Dispersion, OfGridsHasAClosedForm) {
    for (const auto& [k, d] : {std::pair{4, 1}, {4, 2}, {32, 2}, {7, 2}, {4, 3}, {3, 4}})
        for (const double offset : {0., .5})
            for (const bool torus : {false, true}) {
                const PointSet p =
                    grid(static_cast<std::size_t>(k), static_cast<std::size_t>(d), offset);
                EXPECT_NEAR(value_of(p, torus), 1. / k, 1e-15) << k << "^" << d;
            }
}

// A maximal empty box of the lattice (i, m i mod n) / n has a point on each of its sides; values by
// the definition.
TEST(Dispersion, OfFibonacciLatticesIsTheDefinitions) {
    for (const auto& [n, m] : {std::pair{5, 3}, {8, 5}, {13, 8}})
        for (const bool torus : {false, true}) {
            const PointSet p = lattice(static_cast<std::size_t>(n), static_cast<std::size_t>(m));
            EXPECT_TRUE(is_nearest_double(value_of(p, torus), by_definition(p, torus))) << n;
        }
}

// The largest empty box on the torus moves with the points.
TEST(Dispersion, OnTheTorusDoesNotChangeWithAShift) {
    for (std::size_t d = 1; d <= 3; ++d)
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const PointSet p = on_lattice(d == 3 ? 12 : 300, d, 1024, seed);
            PointSet q = p;
            for (double& x : q.flat()) x = x + .375 - std::floor(x + .375);
            EXPECT_EQ(value_of(q, true), value_of(p, true)) << "d " << d << ", seed " << seed;
            EXPECT_LE(value_of(p), value_of(p, true));
        }
}

// n points leave n + 1 slabs; adding a point never enlarges the box.
TEST(Dispersion, FallsWithThePointsButNotBelowThatOfSlabs) {
    for (std::size_t d = 1; d <= 3; ++d) {
        double before = 1;
        for (std::size_t n = 1; n <= (d == 3 ? 15U : 80U); ++n) {
            const double value = value_of(make("halton", points(n, d)));
            EXPECT_LE(value, before);
            EXPECT_GE(value * static_cast<double>(n + 1), 1 - 1e-12);
            before = value;
        }
    }
}

TEST(Dispersion, IsTheSameForAnyNumberOfThreadsAndOrderOfPoints) {
    const PointSet p = make("random", points(14, 3));
    const Report one = analyze("dispersion", p, {}, {.threads = 1});
    EXPECT_EQ(one, analyze("dispersion", p, {}, {.threads = 2}));
    EXPECT_EQ(one, analyze("dispersion", p, {}, {.threads = 7}));
    PointSet q = make("random", points(3000, 2));
    const double value = value_of(q);
    for (std::size_t i = 0; i < q.count(); ++i) {
        std::swap(q[i][0], q[i][1]);
        if (i % 2 == 1) std::ranges::swap_ranges(q[i], q[i / 2]);
    }
    EXPECT_EQ(value_of(q), value);
}

TEST(Dispersion, BoundsWhatItHasNoTimeFor) {
    const PointSet p = make("random", points(200, 4));
    const Report report = report_of(p, false, {{"max-work", "100000"}});
    EXPECT_FALSE(std::get<bool>(*report.find("exact")));
    EXPECT_LT(report.number("lower"), report.number("upper"));
    EXPECT_EQ(report.find("value"), nullptr);
    EXPECT_EQ(report.text("method"), "branch-and-bound");
    EXPECT_EQ(report_of(make("random", points(9, 1)), false).text("method"), "sweep-1d");
    EXPECT_EQ(report_of(make("random", points(9, 2)), false).text("method"), "maximal-rectangles");
    expect_box_holds(p, report, false);
    // Some slab across the whole cube contains no point.
    const PointSet many = make("random", points(40, 100));
    for (const bool torus : {false, true})
        EXPECT_GE(report_of(many, torus, {{"max-work", "1"}}).number("lower"), 1. / 41);
    const PointSet small = make("random", points(20, 3));
    const double value = value_of(small);
    for (const char* work : {"1", "1000", "100000"}) {
        const Report part = report_of(small, false, {{"max-work", work}});
        EXPECT_LE(part.number("lower"), value);
        EXPECT_GE(part.number("upper"), value);
    }
}

// The search for rectangles ends early, too, by a stop request or a time limit.
TEST(Dispersion, SaysWhatIsCertainWhenThereIsNoTime) {
    const PointSet p = make("random", points(5000, 2));
    for (const bool torus : {false, true}) {
        const double value = value_of(p, torus);
        std::stop_source source;
        RunContext run{.stop = source.get_token()};
        run.progress = [&](double) { source.request_stop(); };
        const Settings settings{{"torus", torus ? "true" : "false"}};
        const Report stopped = analyze("dispersion", p, settings, run);
        int looks = 0;
        run = {.seconds = [&] { return 1.0 * ++looks; }};
        const Report late = analyze(
            "dispersion", p, {{"torus", torus ? "true" : "false"}, {"time-limit", "1"}}, run);
        for (const Report& report : {stopped, late}) {
            EXPECT_FALSE(std::get<bool>(*report.find("exact")));
            EXPECT_GE(report.number("lower"), 1. / 5001);
            EXPECT_LE(report.number("lower"), value);
            EXPECT_GE(report.number("upper"), value);
            EXPECT_LT(report.number("upper"), 0.5);
            expect_box_holds(p, report, torus);
        }
    }
}

TEST(Dispersion, RefusesWhatItCannotTake) {
    RunContext run;
    EXPECT_NE(error_of([&] { value_of(points_of({{.5, -1}})); }), "");
    run = {.max_memory = 1000};
    EXPECT_EQ(error_of([&] {
                  analyze("dispersion", make("random", points(300, 2)), {}, run);
              }).substr(0, 50),
              "limit: the search for the largest empty box needs ");
}

// Boxes cannot be averaged, but the mean of one set keeps its box.
TEST(Dispersion, TheMeanOfOneSetHasItsBox) {
    const Analyzer& dispersion = find_analyzer("dispersion");
    for (const std::size_t sets : {1, 2}) {
        Report mean = analyze("dispersion", points_of({{0.5, 0.5}}), {}, {});
        dispersion.refine(mean, sets, dispersion.options.defaults());
        EXPECT_EQ(mean.find("box.lower_corner") != nullptr, sets == 1);
    }
}

}  // namespace stipple::testing::dispersion_test
