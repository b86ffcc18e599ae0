// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "core/rng.hpp"
#include "math/discrepancy/coordinate_ascent.hpp"
#include "math/discrepancy/extreme/search.hpp"
#include "support/exact.hpp"
#include "support/lattices.hpp"
#include "support/units.hpp"

namespace stipple::testing::extreme_discrepancy_test {

using namespace stipple::discrepancy;

namespace {

Report report_of(const PointSet& p, const char* kind, const Settings& more = {}) {
    Settings settings{{"kind", kind}};
    settings.insert(settings.end(), more.begin(), more.end());
    return analyze("star-discrepancy", p, settings);
}

double value_of(const PointSet& p, const char* kind) {
    const Report report = report_of(p, kind);
    EXPECT_TRUE(std::get<bool>(*report.find("exact")));
    EXPECT_EQ(report.number("lower"), report.number("value"));
    EXPECT_EQ(report.number("upper"), report.number("value"));
    return report.number("value");
}

/// Result of branch and bound alone: a good start would hide errors of the search.
double by_search(const PointSet& p, const char* kind) {
    const auto family = std::string(kind) == "extreme" ? Family::cube : Family::torus;
    const BoxGrid grid = box_grid(p, family, {});
    const auto found = extreme::search(grid, WorstBox(grid), {}, {});
    EXPECT_EQ(found.ending, Ending::complete);
    return found.worst.value();
}

__extension__ using Wide = __int128;

/// An interval on an axis: length times 2^places, and the points in it as bits.
struct Arc {
    Wide length;
    std::uint32_t inside;
};

/// All intervals on one axis, found by comparing all points with all pairs of ends.
std::vector<Arc> arcs_of(const PointSet& p, std::size_t axis, bool closed, bool torus, int places) {
    std::vector<Wide> x;
    for (std::size_t i = 0; i < p.count(); ++i)
        x.push_back(torus && p[i][axis] == 1 ? 0
                                             : static_cast<Wide>(std::ldexp(p[i][axis], places)));
    std::vector<Wide> ends = x;
    const Wide one = Wide{1} << places;
    if (!torus) ends.insert(ends.end(), {0, one});
    std::vector<Arc> arcs;
    for (const Wide a : ends)
        for (const Wide b : ends) {
            const bool wraps = closed ? b < a : b <= a;
            if (wraps && !torus) continue;
            Arc arc{b - a + (wraps ? one : 0), 0};
            for (std::size_t i = 0; i < x.size(); ++i) {
                const bool after = closed ? x[i] >= a : x[i] > a;
                const bool until = closed ? x[i] <= b : x[i] < b;
                if (wraps ? after || until : after && until) arc.inside |= 1U << i;
            }
            arcs.push_back(arc);
        }
    return arcs;
}

Wide worst_from(const std::vector<std::vector<Arc>>& axes, std::size_t k, Wide volume,
                std::uint32_t inside, Wide one, bool closed) {
    if (k == axes.size()) {
        const Wide share = one * std::popcount(inside);
        return closed ? share - volume : volume - share;
    }
    Wide worst = 0;
    for (const Arc& arc : axes[k])
        worst = std::max(
            worst, worst_from(axes, k + 1, volume * arc.length, inside & arc.inside, one, closed));
    return worst;
}

/// Oracle: all boxes, in integers; for up to 32 points with coordinates that are multiples of
/// 2^-places, n 2^(d places) < 2^127. Too plain to be wrong.
Fraction by_definition(const PointSet& p, const char* kind, int places) {
    const bool torus = std::string(kind) == "periodic";
    const auto d = static_cast<int>(p.dimension());
    const auto n = static_cast<Wide>(p.count());
    Wide worst = 0;
    for (const bool closed : {false, true}) {
        std::vector<std::vector<Arc>> axes;
        for (std::size_t k = 0; k < p.dimension(); ++k)
            axes.push_back(arcs_of(p, k, closed, torus, places));
        worst = std::max(worst, worst_from(axes, 0, n, 0xffffffffU >> (32 - p.count()),
                                           Wide{1} << (d * places), closed));
    }
    using boost::multiprecision::cpp_int;
    cpp_int above = static_cast<std::uint64_t>(worst >> 64);
    above <<= 64;
    above += static_cast<std::uint64_t>(worst & ~std::uint64_t{0});
    cpp_int below = p.count();
    below <<= static_cast<unsigned>(d * places);
    return Fraction(above, below);
}

bool is_between(double x, double lower, double upper, bool closed) {
    const bool wraps = closed ? upper < lower : upper <= lower;
    const bool after = closed ? x >= lower : x > lower;
    const bool until = closed ? x <= upper : x < upper;
    return wraps ? after || until : after && until;
}

/// Recounts the worst box from the report: the value must be the nearest double.
void expect_box_holds(const PointSet& p, const Report& report, bool torus) {
    const auto lower = report.curve("worst_box.lower_corner");
    const auto upper = report.curve("worst_box.corner");
    const bool closed = std::get<bool>(*report.find("worst_box.closed"));
    Fraction volume = 1;
    for (std::size_t k = 0; k < lower.size(); ++k) {
        const bool wraps = closed ? upper[k] < lower[k] : upper[k] <= lower[k];
        EXPECT_TRUE(torus || !wraps);
        volume *= exactly(upper[k]) - exactly(lower[k]) + (wraps ? 1 : 0);
    }
    std::int64_t inside = 0;
    for (std::size_t i = 0; i < p.count(); ++i) {
        bool in = true;
        for (std::size_t k = 0; k < lower.size(); ++k) {
            const double x = torus && p[i][k] == 1 ? 0 : p[i][k];
            in = in && is_between(x, lower[k], upper[k], closed);
        }
        inside += in;
    }
    EXPECT_EQ(report.number("worst_box.points"), static_cast<double>(inside));
    EXPECT_TRUE(is_nearest_double(report.number("worst_box.volume"), volume));
    const Fraction share(inside, static_cast<std::int64_t>(p.count()));
    const Fraction worth = closed ? Fraction(share - volume) : Fraction(volume - share);
    EXPECT_TRUE(is_nearest_double(report.number("lower"), worth));
}

std::string text_of(const PointSet& p) {
    std::string text;
    for (std::size_t i = 0; i < p.count(); ++i) text += fmt::format("({})", fmt::join(p[i], ","));
    return text;
}

/// The points shifted on the torus by multiples of 1/steps.
PointSet shifted(const PointSet& p, std::uint64_t steps, std::uint64_t seed) {
    PointSet q(p.count(), p.dimension());
    for (std::size_t k = 0; k < p.dimension(); ++k) {
        const auto by = static_cast<double>(Rng(seed, 3).below(k, steps));
        for (std::size_t i = 0; i < p.count(); ++i) {
            const double x = p[i][k] + by / static_cast<double>(steps);
            q[i][k] = x - std::floor(x);
        }
    }
    return q;
}

PointSet centred_grid(std::size_t k, std::size_t d) {
    PointSet p(static_cast<std::size_t>(std::llround(std::pow(k, d))), d);
    for (std::size_t i = 0; i < p.count(); ++i) {
        std::size_t rest = i;
        for (std::size_t j = 0; j < d; ++j, rest /= k)
            p[i][j] = (static_cast<double>(rest % k) + .5) / static_cast<double>(k);
    }
    return p;
}

constexpr const char* kinds[] = {"extreme", "periodic"};

}  // namespace

TEST(ExtremeDiscrepancy, KnownByHand) {
    for (const char* kind : kinds) {
        EXPECT_EQ(value_of(points_of({{.5, .5}}), kind), 1);  // the point itself
        EXPECT_EQ(value_of(points_of({{0, 1}}), kind), 1);
        EXPECT_EQ(value_of(points_of({{.3, .6}, {.3, .6}, {.3, .6}}), kind), 1);
        EXPECT_EQ(value_of(points_of({{.25}, {.75}}), kind), 1. / 2);
        EXPECT_EQ(value_of(points_of({{0}, {1}}), kind), 1);
    }
    const PointSet p = points_of({{.125, .5}, {.25, .5}});
    EXPECT_EQ(value_of(p, "extreme"), 1);  // the closed line between them
    const PointSet q = points_of({{.25, .25}, {.25, .75}, {.5, .25}, {.5, .75}});
    EXPECT_EQ(value_of(q, "extreme"), 1 - 1. / 8);  // the closed box around all of them
}

TEST(ExtremeDiscrepancy, ReportsOpenBoxesThatWrap) {
    // The torus without two lines, one through each point, is empty.
    const PointSet p = points_of({{0, .5}, {.5, .25}});
    const Report report = report_of(p, "periodic");
    expect_box_holds(p, report, true);
    EXPECT_EQ(report.number("value"), 1);
    EXPECT_FALSE(std::get<bool>(*report.find("worst_box.closed")));
    EXPECT_EQ(report.curve("worst_box.lower_corner"), report.curve("worst_box.corner"));
    // Closed interval from 3/4 over 0 to 1/8: three of four points in 3/8 of the circle.
    const Report arc = report_of(points_of({{.75}, {0}, {.125}, {.5}}), "periodic");
    EXPECT_EQ(arc.number("value"), 3. / 8);
    expect_box_holds(points_of({{.75}, {0}, {.125}, {.5}}), arc, true);
}

// Exact to the last bit, with ties, duplicates, points on 0 and 1, and single points; also for
// coordinates that are not dyadic, so that boxes are nearly equal.
TEST(ExtremeDiscrepancy, IsTheDefinitionsToTheLastBit) {
    constexpr std::size_t most[] = {0, 24, 9, 4};
    for (std::size_t d = 1; d <= 3; ++d)
        for (const std::uint64_t steps : {2, 4, 16, 1024, 3, 10})
            for (std::uint64_t seed = 1; seed <= 6; ++seed) {
                if (d == 3 && steps % 2 != 0) continue;
                const std::uint64_t used = d == 3 && steps == 10 ? 64 : steps;
                const std::size_t n = 1 + Rng(seed).below(d + steps, most[d]);
                const PointSet p = on_lattice(n, d, used, seed);
                for (const char* kind : kinds) {
                    const Report report = report_of(p, kind);
                    const Fraction expected = by_definition(p, kind, d == 3 ? 16 : 56);
                    ASSERT_TRUE(is_nearest_double(report.number("value"), expected))
                        << kind << " " << text_of(p);
                    EXPECT_EQ(by_search(p, kind), report.number("value")) << kind << text_of(p);
                    expect_box_holds(p, report, kind == kinds[1]);
                }
            }
}

TEST(ExtremeDiscrepancy, IsTheDefinitionsForLargerSets) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed)
        for (const std::uint64_t steps : {16, 4096}) {
            const PointSet p = on_lattice(20, 2, steps, seed);
            for (const char* kind : kinds) {
                const Fraction expected = by_definition(p, kind, 12);
                EXPECT_TRUE(is_nearest_double(value_of(p, kind), expected)) << text_of(p);
                EXPECT_TRUE(is_nearest_double(by_search(p, kind), expected)) << text_of(p);
            }
        }
}

// The ascents alone find most worst boxes; boxes that the search excludes must not depend on them.
TEST(ExtremeDiscrepancy, SearchFindsFromNothingWhatItFindsFromAGoodStart) {
    for (const char* kind : kinds) {
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const PointSet random = make("random", points(150, 2), {}, {.seed = seed});
            EXPECT_EQ(value_of(random, kind), by_search(random, kind)) << "seed " << seed;
            const PointSet tied = on_lattice(80, 2, 16 * seed, seed);
            EXPECT_EQ(value_of(tied, kind), by_search(tied, kind)) << "seed " << seed;
            const PointSet near_tied = on_lattice(40, 2, 10 * seed, seed);
            EXPECT_EQ(value_of(near_tied, kind), by_search(near_tied, kind)) << "seed " << seed;
            const PointSet solid = make("random", points(12, 3), {}, {.seed = seed});
            EXPECT_EQ(value_of(solid, kind), by_search(solid, kind)) << "seed " << seed;
        }
        for (const char* even : {"halton", "hammersley"})
            EXPECT_EQ(value_of(make(even, points(128, 2)), kind),
                      by_search(make(even, points(128, 2)), kind));
    }
}

// A box is a signed sum of 2^d boxes at the origin, and every box of the cube is one of the torus.
TEST(ExtremeDiscrepancy, LiesBetweenTheStarDiscrepancyAndThePeriodicOne) {
    for (std::size_t d = 1; d <= 3; ++d)
        for (const std::uint64_t steps : {4, 64, 1 << 20})
            for (std::uint64_t seed = 1; seed <= 4; ++seed) {
                const PointSet p = on_lattice(d == 3 ? 10 : 40, d, steps, seed);
                const double star = value_of(p, "star");
                const double extreme = value_of(p, "extreme");
                const auto n = static_cast<double>(p.count());
                EXPECT_LE(star, extreme) << text_of(p);
                EXPECT_LE(extreme, std::ldexp(star, static_cast<int>(d))) << text_of(p);
                EXPECT_LE(extreme, value_of(p, "periodic")) << text_of(p);
                EXPECT_GE(extreme, 1 / n) << text_of(p);
            }
}

TEST(PeriodicDiscrepancy, DoesNotChangeWhenThePointsAreShifted) {
    for (std::size_t d = 1; d <= 3; ++d)
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const PointSet p = on_lattice(d == 3 ? 10 : 60, d, 64, seed);
            EXPECT_EQ(value_of(shifted(p, 64, seed), "periodic"), value_of(p, "periodic"))
                << text_of(p);
        }
}

// sup |g(b) - g(a)| over a < b of g(x) = #{x_i <= x} / n - x is the range of g, which is Kuiper's
// statistic; also on the circle.
TEST(ExtremeDiscrepancy, InOneDimensionIsKuipersStatistic) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const PointSet p = make("random", points(10 * seed, 1), {}, {.seed = seed});
        std::vector<double> x(p.flat().begin(), p.flat().end());
        std::ranges::sort(x);
        const auto n = static_cast<double>(x.size());
        double above = 0;
        double below = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            above = std::max(above, static_cast<double>(i + 1) / n - x[i]);
            below = std::max(below, x[i] - static_cast<double>(i) / n);
        }
        EXPECT_NEAR(value_of(p, "extreme"), above + below, 1e-15);
        EXPECT_EQ(value_of(p, "periodic"), value_of(p, "extreme"));
        const PointSet tied = on_lattice(9, 1, 8, seed);
        EXPECT_EQ(value_of(tied, "periodic"), value_of(tied, "extreme")) << text_of(tied);
    }
    EXPECT_EQ(report_of(points_of({{.5}}), "extreme").text("method"), "sweep-1d");
}

// A closed box with m_j of the k coordinates on axis j has an excess of prod m_j/k - prod (m_j -
// 1)/k, which grows with each m_j. So the box around all points is the worst.
TEST(ExtremeDiscrepancy, OfGridsHasAClosedForm) {
    for (const auto& [k, d] : {std::pair{8, 1}, {7, 1}, {4, 2}, {16, 2}, {7, 2}, {4, 3}}) {
        const PointSet p = centred_grid(static_cast<std::size_t>(k), static_cast<std::size_t>(d));
        const double expected = 1 - std::pow(1 - 1. / k, d);
        for (const char* kind : kinds)
            EXPECT_NEAR(value_of(p, kind), expected, 1e-15) << kind << " " << k << "^" << d;
    }
}

TEST(ExtremeDiscrepancy, DoesNotDependOnTheOrderOfTheAxesNorOnReflections) {
    const PointSet p = on_lattice(50, 2, 256, 5);
    PointSet q(p.count(), 2);
    for (std::size_t i = 0; i < p.count(); ++i) {
        q[i][0] = 1 - p[i][1];
        q[i][1] = p[i][0];
    }
    for (const char* kind : kinds) EXPECT_EQ(value_of(p, kind), value_of(q, kind)) << kind;
}

TEST(ExtremeDiscrepancy, IsTheSameForAnyNumberOfThreads) {
    for (const char* kind : kinds)
        for (const PointSet& p : {make("halton", points(200, 2)), make("random", points(12, 3))}) {
            const Report one = analyze("star-discrepancy", p, {{"kind", kind}}, {.threads = 1});
            EXPECT_EQ(one, analyze("star-discrepancy", p, {{"kind", kind}}, {.threads = 2}));
            EXPECT_EQ(one, analyze("star-discrepancy", p, {{"kind", kind}}, {.threads = 7}));
        }
}

TEST(ExtremeDiscrepancy, BoundsWhatItHasNoTimeFor) {
    const PointSet p = make("random", points(20, 3));
    for (const char* kind : kinds) {
        const double value = value_of(p, kind);
        double before = 1;
        for (const char* work : {"1000", "100000", "2000000"}) {
            const Report report = report_of(p, kind, {{"max-work", work}});
            EXPECT_LE(report.number("lower"), value);
            EXPECT_GE(report.number("upper"), value);
            EXPECT_LE(report.number("upper"), before);
            EXPECT_EQ(report.find("value") != nullptr, std::get<bool>(*report.find("exact")));
            EXPECT_EQ(std::get<bool>(*report.find("exact")),
                      report.number("lower") == report.number("upper"));
            before = report.number("upper");
        }
        const Report part = report_of(make("random", points(200, 5)), kind, {{"max-work", "1000"}});
        EXPECT_FALSE(std::get<bool>(*part.find("exact")));
        EXPECT_LT(part.number("lower"), part.number("upper"));
        expect_box_holds(make("random", points(200, 5)), part, kind == kinds[1]);
        // A single point is a closed box.
        const PointSet many = make("random", points(40, 100));
        EXPECT_GE(report_of(many, kind, {{"max-work", "1"}}).number("lower"), 1. / 40 - 1e-15);
    }
}

// If open cells would fill the memory, they are searched to the end instead, so that the bounds
// remain valid.
TEST(ExtremeDiscrepancy, KeepsItsBoundsWhereCellsFillTheMemory) {
    const PointSet p = make("random", points(60, 12));
    const Settings settings{{"kind", "extreme"}, {"max-work", "100000000"}};
    const Report report =
        analyze("star-discrepancy", p, settings, {.threads = 1, .max_memory = 37 << 10});
    EXPECT_GE(report.number("upper"), report.number("lower"));
    expect_box_holds(p, report, false);
}

// A box is a signed sum of 4 boxes at the origin, on the torus of 8 and the whole cube; almost
// without search, this is the bound. Points at 1 are at 0 on the torus.
TEST(ExtremeDiscrepancy, IsAtMostSomeTimesTheStarDiscrepancy) {
    for (const PointSet& p :
         {make("halton", points(150, 2)), on_lattice(150, 2, 64, 1), on_lattice(200, 2, 16, 2)}) {
        PointSet moved = p;
        for (double& x : moved.flat())
            if (x == 1) x = 0;
        for (const auto& [kind, boxes] : {std::pair{"extreme", 4}, {"periodic", 8}}) {
            const double star = measure("star-discrepancy", "value", boxes == 4 ? p : moved);
            const Report few = report_of(p, kind, {{"max-work", "1"}});
            const double value = report_of(p, kind).number("value");
            EXPECT_LE(few.number("upper"), boxes * star * (1 + 1e-14)) << kind;
            EXPECT_GE(few.number("upper"), value) << kind;
            EXPECT_LE(few.number("lower"), value) << kind;
        }
    }
}

TEST(ExtremeDiscrepancy, StopsWhenAskedAndRefusesWhatItCannotTake) {
    std::stop_source source;
    RunContext run{.stop = source.get_token()};
    run.progress = [&](double) { source.request_stop(); };
    const Settings settings{{"kind", "extreme"}};
    const PointSet p = make("random", points(300, 4));
    const Report stopped = analyze("star-discrepancy", p, settings, run);
    EXPECT_LT(stopped.number("lower"), stopped.number("upper"));
    expect_box_holds(p, stopped, false);
    EXPECT_EQ(error_of([&] { report_of(points_of({{.5}}), "wide"); }),
              "usage: --kind: 'wide' is not one of star, extreme, periodic");
    EXPECT_NE(error_of([&] { report_of(points_of({{.5, 1.5}}), "extreme"); }), "");
    run = {.max_memory = 1000};
    EXPECT_EQ(error_of([&] {
                  analyze("star-discrepancy", make("random", points(300, 2)), settings, run);
              }).substr(0, 40),
              "limit: the search for the worst box need");
}

}  // namespace stipple::testing::extreme_discrepancy_test
