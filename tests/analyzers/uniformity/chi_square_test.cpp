// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stop_token>

#include "pipeline/chain.hpp"
#include "support/pictures.hpp"
#include "support/steps.hpp"
#include "support/warping.hpp"

namespace stipple::testing::chi_square_test {
namespace {

/// Oracle: radical inverse of i in base b.
double radical_inverse(std::size_t i, std::size_t b) {
    double value = 0;
    double digit = 1;
    for (; i > 0; i /= b) value += static_cast<double>(i % b) * (digit /= static_cast<double>(b));
    return value;
}

PointSet halton(std::size_t first, std::size_t last) {
    std::vector<double> flat;
    for (std::size_t i = first; i <= last; ++i)
        flat.insert(flat.end(), {radical_inverse(i, 2), radical_inverse(i, 3)});
    return {std::move(flat), 2};
}

PointSet uniform(std::size_t n, std::uint64_t seed, std::size_t d = 2) {
    return make("random", points(n, d), {}, {.seed = seed});
}

/// One random point in each of m x m strata.
PointSet jittered(std::size_t m, std::uint64_t seed) {
    PointSet set = uniform(m * m, seed);
    for (std::size_t i = 0; i < set.count(); ++i) {
        set[i][0] = (static_cast<double>(i % m) + set[i][0]) / static_cast<double>(m);
        set[i][1] = (static_cast<double>(i / m) + set[i][1]) / static_cast<double>(m);
    }
    return set;
}

double p_value(const PointSet& points, const Settings& settings = {}) {
    return measure("chi-square", "p_value", points, settings);
}

std::string verdict(const PointSet& points, const Settings& settings = {}) {
    return analyze("chi-square", points, settings).text("verdict");
}

/// The points with another domain.
PointSet on(DomainPtr domain, PointSet points) {
    points.domain = std::move(domain);
    return points;
}

/// counts[i] points at the centre of cell i.
PointSet in_cells(const std::vector<int>& counts, DomainPtr domain) {
    std::vector<double> flat;
    for (std::size_t c = 0; c < counts.size(); ++c)
        for (int i = 0; i < counts[c]; ++i)
            flat.push_back((static_cast<double>(c) + 0.5) / static_cast<double>(counts.size()));
    return on(std::move(domain), PointSet(std::move(flat), 1));
}

/// Oracle: the statistic for groups of `size` cells of an a x b grid, by the definition.
double statistic_by_definition(const PointSet& points, int a, int b, int size) {
    std::map<int, double> observed, expected;
    const int groups = a * b / size;
    const auto group = [&](int cell) { return std::min(cell / size, groups - 1); };
    for (int c = 0; c < a * b; ++c)
        expected[group(c)] += static_cast<double>(points.count()) / (a * b);
    for (std::size_t i = 0; i < points.count(); ++i) {
        const int x = std::min(a - 1, static_cast<int>(std::floor(points[i][0] * a)));
        const int y = std::min(b - 1, static_cast<int>(std::floor(points[i][1] * b)));
        observed[group(x * b + y)] += 1;
    }
    double sum = 0;
    for (const auto& [g, e] : expected) sum += (observed[g] - e) * (observed[g] - e) / e;
    return sum;
}

}  // namespace

// Known values: Halton sets on grids that nearly match their strata; chi-square tails by mpmath.
TEST(ChiSquare, HaltonValuesAndTinyTails) {
    const Report thousand = analyze("chi-square", halton(1, 1000), {{"cells", "10x10"}});
    EXPECT_NEAR(thousand.number("statistic"), 20.0, 1e-12);
    EXPECT_EQ(thousand.number("degrees_of_freedom"), 99);
    EXPECT_NEAR(thousand.number("p_lower") / 4.16758081828653774e-19, 1, 1e-10);
    EXPECT_NEAR(thousand.number("p_value") / 8.33516163657307548e-19, 1, 1e-10);
    EXPECT_EQ(thousand.number("p_upper"), 1);
    EXPECT_EQ(thousand.text("verdict"), "stratified");

    const Report more = analyze("chi-square", halton(1, 4096), {{"cells", "16"}});
    EXPECT_EQ(more.number("statistic"), 11.125);
    EXPECT_EQ(more.number("degrees_of_freedom"), 255);
    EXPECT_NEAR(more.number("p_lower") / 1.23949820842251157e-122, 1, 1e-9);
}

TEST(ChiSquare, JitterOnItsOwnStrataIsZero) {
    const Report report = analyze("chi-square", jittered(10, 1), {{"cells", "10x5"}});
    EXPECT_EQ(report.number("statistic"), 0);
    // Fifteen groups of 6 points and one of 10 have these counts with a chance of
    const double chance = std::exp(std::lgamma(101) - 15 * std::lgamma(7) - std::lgamma(11) +
                                   90 * std::log(0.06) + 10 * std::log(0.1));
    EXPECT_NEAR(report.number("p_lower"), chance, 1e-7 * chance);
    EXPECT_EQ(report.number("p_upper"), 1);
    EXPECT_EQ(report.text("verdict"), "stratified");
    EXPECT_EQ(report.number("pooled_cells"), 50) << "2 points each";
}

// Two cells, counts 6 and 14: (16 + 16) / 10 = 3.2 with one degree of freedom, with upper tail
// erfc(sqrt(1.6)).
TEST(ChiSquare, TwoCellsByHand) {
    std::vector<double> flat(6, 0.25);
    flat.resize(20, 0.75);
    const Report report = analyze("chi-square", PointSet(flat, 1), {{"cells", "2"}});
    EXPECT_DOUBLE_EQ(report.number("statistic"), 3.2);
    EXPECT_EQ(report.number("degrees_of_freedom"), 1);
    EXPECT_NEAR(report.number("p_upper"), std::erfc(std::sqrt(1.6)), 1e-15);
    // All counts except 0 to 5 and 15 to 20 of 20.
    EXPECT_NEAR(report.number("p_lower"), 1 - 2 * 21700.0 / (1 << 20), 1e-14);
    EXPECT_EQ(report.text("p_method"), "exact");
    EXPECT_NEAR(report.number("p_value"), 2 * std::erfc(std::sqrt(1.6)), 1e-15);
    EXPECT_EQ(report.text("verdict"), "uniform");
}

TEST(ChiSquare, EdgesBelongToTheCellAboveAndOneToTheLast) {
    // Five points on each of 0, 1/4, 1/2, 3/4 fill the four cells evenly; those on 1 belong to the
    // last.
    std::vector<double> flat;
    for (const double x : {0.0, 0.25, 0.5, 0.75})
        for (int i = 0; i < 5; ++i) flat.push_back(x);
    EXPECT_EQ(measure("chi-square", "statistic", PointSet(flat, 1), {{"cells", "4"}}), 0);
    for (int i = 0; i < 4; ++i) flat.push_back(1);  // 5 5 5 9 of 6 each: (1 + 1 + 1 + 9) / 6
    EXPECT_DOUBLE_EQ(measure("chi-square", "statistic", PointSet(flat, 1), {{"cells", "4"}}), 2);
}

TEST(ChiSquare, AgreesWithTheDefinitionPooledAndNot) {
    const struct {
        std::size_t n;
        int a, b, size;
    } cases[] = {{1000, 7, 11, 1}, {200, 5, 8, 1},    {199, 5, 8, 2}, {100, 10, 10, 5},
                 {100, 7, 11, 4},  {1000, 37, 41, 8}, {37, 1, 9, 2},  {5000, 3, 1, 1}};
    for (const auto& [n, a, b, size] : cases) {
        const PointSet set = uniform(n, n);
        const Report report =
            analyze("chi-square", set, {{"cells", std::to_string(a) + "x" + std::to_string(b)}});
        EXPECT_NEAR(report.number("statistic"), statistic_by_definition(set, a, b, size), 1e-9)
            << n;
        EXPECT_EQ(report.number("degrees_of_freedom"), a * b / size - 1) << n;
        EXPECT_EQ(report.number("cells"), a * b) << n;
        EXPECT_EQ(report.number("pooled_cells"), size > 1 ? a * b : 0) << n;
    }
}

TEST(ChiSquare, DefaultGridIsOfOddPrimesAndNeverPooled) {
    const auto grid_of = [](std::size_t n, std::size_t d) {
        const Report report = analyze("chi-square", uniform(n, 1, d));
        EXPECT_EQ(report.number("pooled_cells"), 0) << n;
        EXPECT_LE(5 * report.number("cells"), static_cast<double>(n));
        return std::get<Report::Integers>(*report.find("grid"));
    };
    using Grid = Report::Integers;
    EXPECT_EQ(grid_of(15, 1), (Grid{3}));
    EXPECT_EQ(grid_of(20, 2), (Grid{3, 1}));
    EXPECT_EQ(grid_of(45, 2), (Grid{3, 3}));
    EXPECT_EQ(grid_of(1024, 1), (Grid{31}));
    EXPECT_EQ(grid_of(1024, 2), (Grid{5, 7}));
    EXPECT_EQ(grid_of(100'000, 2), (Grid{13, 17}));
    EXPECT_EQ(grid_of(1000, 5), (Grid{3, 3, 3, 1, 1}));
    EXPECT_EQ(grid_of(20'000, 3), (Grid{5, 5, 5}));
    for (std::size_t n = 15; n < 200; ++n)
        for (const std::size_t d : {1U, 2U, 3U}) grid_of(n, d);
}

// 200 seeds at level 0.01: if p-values are right, the number of false alarms is binomial(200,
// 0.01), above 10 with probability 6e-6.
TEST(ChiSquare, FalseAlarmsAreAsManyAsTheLevelSays) {
    int alarms = 0;
    int low = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Report report = analyze("chi-square", uniform(2000, seed), {{"level", "0.01"}});
        alarms += report.text("verdict") != "uniform";
        low += report.number("p_value") < 0.5;
    }
    EXPECT_LE(alarms, 10);
    EXPECT_NEAR(low, 100, 33);  // 4.7 standard deviations: 3e-6
}

// False alarm: 5 seeds x 5e-6. Power: a density 1 + t(1 - 2x) has noncentrality n t^2 / 3 = 300 at
// t = 0.03, n = 1e6, against a threshold about 160 above the mean of 528.
TEST(ChiSquare, AcceptsUniformRejectsThreePercentTilt) {
    const double level = 5e-6;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        PointSet points = uniform(1'000'000, seed);
        EXPECT_GT(p_value(points), level) << "seed " << seed;

        for (std::size_t i = 0; i < points.count(); ++i) points[i][0] *= 0.97 + 0.03 * points[i][0];
        EXPECT_LT(p_value(points), level) << "blind, seed " << seed;
        EXPECT_EQ(verdict(points), "non-uniform");
    }
}

// Eight warps x 3 seeds at level 1e-6: false alarm 3e-5.
TEST(ChiSquare, AcceptsWarpsThatAreRight) {
    for (const char* spec :
         {"disk", "disk:method=concentric", "disk:method=rejection", "disk:radius=2,center=[1,0]",
          "triangle", "triangle:vertices=[0,0 2,0 0.3,1e-2]", "triangle:vertices=[5,1 -1,1 0,7]",
          "triangle:vertices=[1,0,0 0,2,0 0,0,3]"})
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            const PointSet image = warped(*mapping(spec), uniform(50'000, seed));
            EXPECT_EQ(verdict(image, {{"level", "1e-6"}}), "uniform") << spec << " seed " << seed;
        }
}

TEST(ChiSquare, RejectsWarpsThatAreWrong) {
    const Settings strict = {{"level", "1e-6"}};
    const PointSet cube = uniform(20'000, 1);
    const DomainPtr disk = mapping("disk")->domain();
    const DomainPtr triangle = mapping("triangle")->domain();
    EXPECT_EQ(verdict(warped(*mapping("disk:method=naive"), cube), strict), "non-uniform");

    // A triangle without the square root: (u, v) -> (u v, u - u v), density 1 / (x + y).
    PointSet wrong = cube;
    for (std::size_t i = 0; i < cube.count(); ++i) {
        wrong[i][0] = cube[i][0] * cube[i][1];
        wrong[i][1] = cube[i][0] - wrong[i][0];
    }
    EXPECT_EQ(verdict(on(triangle, wrong), strict), "non-uniform") << "no square root";

    // A disk without a sliver.
    const PointSet round = warped(*mapping("disk"), cube);
    std::vector<double> flat;
    for (std::size_t i = 0; i < round.count(); ++i)
        if (round[i][0] < 0.9) flat.insert(flat.end(), round[i].begin(), round[i].end());
    EXPECT_EQ(verdict(on(disk, PointSet(flat, 2)), strict), "non-uniform") << "truncated";

    // Swapping the unit coordinates is right; taking the square root of the other one is wrong.
    PointSet swapped = cube;
    for (std::size_t i = 0; i < cube.count(); ++i) std::swap(swapped[i][0], swapped[i][1]);
    EXPECT_EQ(verdict(warped(*mapping("disk"), swapped), strict), "uniform") << "symmetric";
    for (std::size_t i = 0; i < cube.count(); ++i) {
        const double r = cube[i][0], angle = 6.283185307179586 * std::sqrt(cube[i][1]);
        wrong[i][0] = r * std::cos(angle);
        wrong[i][1] = r * std::sin(angle);
    }
    EXPECT_EQ(verdict(on(disk, wrong), strict), "non-uniform") << "root at the wrong one";
}

TEST(ChiSquare, SeesStrataThroughEveryWarp) {
    for (const char* spec :
         {"disk", "disk:method=concentric", "triangle", "triangle:vertices=[1,0,0 0,2,0 0,0,3]"})
        EXPECT_EQ(verdict(warped(*mapping(spec), jittered(200, 1))), "stratified") << spec;
    EXPECT_EQ(verdict(halton(1, 1000)), "stratified");
    EXPECT_EQ(verdict(jittered(64, 3)), "stratified");
}

TEST(ChiSquare, ProductDomainsHaveTheAxesOfTheirFactors) {
    const DomainPtr domain =
        product_domain({{unit_cube(1), {0}}, {mapping("disk")->domain(), {1, 2}}});
    const PointSet cube = uniform(30'000, 1, 3);
    PointSet right(cube.count(), 3), wrong(cube.count(), 3);
    for (std::size_t i = 0; i < cube.count(); ++i)
        for (const auto& [spec, out] : {std::pair{"disk", &right}, {"disk:method=naive", &wrong}}) {
            const auto map = mapping(spec);
            (*out)[i][0] = cube[i][0];
            map->forward(cube[i].subspan(1), (*out)[i].subspan(1), {});
        }
    EXPECT_EQ(verdict(on(domain, right)), "uniform");
    EXPECT_EQ(verdict(on(domain, wrong)), "non-uniform");
}

TEST(ChiSquare, ExpectationsThatDoNotHoldAreSaid) {
    const auto unmet = [](const PointSet& points, const char* wanted) {
        return analyze("chi-square", points, {{"expect", wanted}, {"cells", "2"}}).unmet();
    };
    std::vector<double> flat(6, 0.25);
    flat.resize(20, 0.75);
    const PointSet some(flat, 1);
    EXPECT_EQ(unmet(some, "uniform"), std::vector<std::string>{});
    EXPECT_EQ(unmet(some, "stratified"),
              std::vector<std::string>{"expected stratified, found uniform (p = 0.147)"});
    const PointSet even = in_cells({20, 20, 20, 20, 20}, unit_cube(1));
    const auto of_even = [&](const char* wanted) {
        return analyze("chi-square", even, {{"expect", wanted}, {"cells", "5"}}).unmet();
    };
    EXPECT_EQ(of_even("stratified"), std::vector<std::string>{});
    EXPECT_EQ(of_even("uniform"),
              std::vector<std::string>{"expected uniform, found stratified (p = 0.000278)"});
    const PointSet clumped(std::vector<double>(30, 0.5), 1);
    EXPECT_EQ(unmet(clumped, "uniform").size(), 1U);
    EXPECT_TRUE(analyze("chi-square", clumped).unmet().empty());
}

TEST(ChiSquare, LevelDecidesTheVerdict) {
    std::vector<double> flat(6, 0.25);
    flat.resize(20, 0.75);  // p = 0.147
    const PointSet some(flat, 1);
    EXPECT_EQ(verdict(some, {{"cells", "2"}, {"level", "0.14"}}), "uniform");
    EXPECT_EQ(verdict(some, {{"cells", "2"}, {"level", "0.15"}}), "non-uniform");
}

// Cells with probabilities (1 +- e) / 4, where e is the smallest detectable effect, are detected in
// about 90 of 100 sets: 270 of 300 with standard deviation 5.2; 6 of these are 31. Half the effect
// is detected rarely.
TEST(ChiSquare, SmallestDetectableEffectIsFoundNineTimesOfTen) {
    const std::size_t n = 2000;
    const Settings settings = {{"cells", "4"}, {"level", "0.01"}};
    const double effect =
        measure("chi-square", "smallest_detectable_effect", uniform(n, 1, 1), settings);
    const auto found = [&](double e) {
        int count = 0;
        for (std::uint64_t seed = 1; seed <= 300; ++seed) {
            PointSet points = uniform(n, seed, 1);
            // The lower half of each half has probability (1 + e) / 2.
            for (double& x : points.flat()) {
                const double half = x < 0.5 ? 0 : 0.5;
                const double u = 2 * (x - half), a = (1 + e) / 2;
                x = half + 0.5 * (u < a ? 0.5 * u / a : 0.5 + 0.5 * (u - a) / (1 - a));
            }
            count += verdict(points, settings) == "non-uniform";
        }
        return count;
    };
    EXPECT_NEAR(found(effect), 270, 31);
    EXPECT_LT(found(effect / 2), 150);
}

TEST(ChiSquare, ThreadsDoNotChangeAnything) {
    const PointSet image = warped(*mapping("disk"), uniform(100'000, 1));
    const Analyzer& unit = find_analyzer("chi-square");
    const Report one = analyze(unit, image, unit.options.defaults(), {.threads = 1});
    for (const unsigned threads : {2U, 7U})
        EXPECT_EQ(analyze(unit, image, unit.options.defaults(), {.threads = threads}), one);
}

TEST(ChiSquare, ManySetsAreJudgedTogether) {
    const Analyzer& unit = find_analyzer("chi-square");
    Report mean;
    mean.add("statistic", 30.0)
        .add("degrees_of_freedom", 20.0)
        .add("smallest_detectable_effect", 0.1)
        .add("statistic_error", 0.0)
        .add("impossible_points", 0.0);
    unit.refine(mean, 10, unit.options.defaults());
    Report set;
    set.add("p_lower", 0.9);
    unit.combine(mean, std::vector<Report>(10, set), unit.options.defaults());
    EXPECT_NEAR(mean.number("p_upper"), 5.924540335484e-6, 1e-15);  // 300 at 200 degrees
    EXPECT_EQ(mean.text("verdict"), "non-uniform");
    EXPECT_LT(mean.number("smallest_detectable_effect"), 0.1);
    EXPECT_GT(mean.number("smallest_detectable_effect"), 0.1 / std::sqrt(10));
}

TEST(ChiSquare, RefusesPointsOutsideTheirDomain) {
    PointSet points = uniform(100, 1);
    for (std::size_t i = 0; i < 100; ++i) points[i][0] *= 0.5, points[i][1] *= 0.5;
    points[7][0] = 1.5;
    points[7][1] = 0.25;
    points[90][1] = std::nan("");
    EXPECT_EQ(error_of([&] { analyze("chi-square", on(mapping("disk")->domain(), points)); }),
              "input: 2 of 100 points are outside the domain disk; the first is point 7: (1.5, "
              "0.25) | --domain names the domain of the points");
    EXPECT_NE(error_of([&] { analyze("chi-square", points); }).find("domain unit-cube"),
              std::string::npos);
    EXPECT_EQ(
        error_of([&] { analyze("chi-square", on(mapping("disk")->domain(), uniform(50, 1, 3))); }),
        "input: points of the domain disk have dimension 2; these have 3");
}

TEST(ChiSquare, RefusesTooFewPointsAndSaysHowMany) {
    const auto error = [](std::size_t n, std::size_t d, const Settings& settings = {}) {
        return error_of([&] { analyze("chi-square", uniform(n, 1, d), settings); });
    };
    EXPECT_EQ(
        error(14, 2),
        "input: chi-square needs at least 15 points for its smallest grid, 3 cells; these are 14");
    EXPECT_NE(error(1, 1), "");
    EXPECT_EQ(error(15, 1), "");
    EXPECT_EQ(error(12, 1, {{"cells", "5"}}),
              "input: chi-square needs at least 13 points for 5 cells; these are 12");
    EXPECT_EQ(error(13, 1, {{"cells", "5"}}), "");
    EXPECT_EQ(error(10, 2, {{"cells", "2x1"}}), "");
    EXPECT_EQ(error(9, 2, {{"cells", "1x2"}}),
              "input: chi-square needs at least 10 points for 2 cells; these are 9");
    EXPECT_EQ(error(100, 2, {{"cells", "1"}}),
              "usage: --cells: the number of cells, 1, is outside [2, 100000000]");
    EXPECT_EQ(error(100, 2, {{"cells", "2x3x5"}}),
              "usage: --cells: 3 numbers for 2 axes; expected one for all, or one for each");
    EXPECT_NE(error(100, 20, {{"cells", "10"}}), "");
    EXPECT_NE(error(100, 2, {{"level", "0"}}), "");
    EXPECT_NE(error(100, 2, {{"level", "0.6"}}), "");
    EXPECT_NE(error(100, 2, {{"expect", "random"}}), "");
}

TEST(ChiSquare, HonoursLimitsStopsAndProgress) {
    const PointSet set = uniform(100'000, 1);
    const Analyzer& unit = find_analyzer("chi-square");
    Values options = unit.options.defaults();
    std::stop_source stop;
    stop.request_stop();
    EXPECT_EQ(error_of([&] { analyze(unit, set, options, {.stop = stop.get_token()}); }),
              "cancelled: interrupted");
    double seen = 0;
    analyze(unit, set, options, {.progress = [&](double done) { seen = done; }});
    EXPECT_EQ(seen, 1);
    unit.options.set(options, "cells", "1000x1000");
    EXPECT_NE(error_of([&] { analyze(unit, set, options, {.max_memory = 1'000'000}); }), "");
}

// Expectations 5, 10, 15, 70: no pooling; 3 5 22 70 give 4/5 + 25/10 + 49/15 + 0.
TEST(ChiSquare, UnequalCellsByHand) {
    const auto domain = std::make_shared<Steps>(std::vector<double>{0.05, 0.1, 0.15, 0.7});
    const Report report = analyze("chi-square", in_cells({3, 5, 22, 70}, domain), {{"cells", "4"}});
    EXPECT_NEAR(report.number("statistic"), 0.8 + 2.5 + 49.0 / 15, 1e-12);
    EXPECT_EQ(report.number("degrees_of_freedom"), 3);
    EXPECT_EQ(report.number("pooled_cells"), 0);
    EXPECT_EQ(report.number("mass_error"), 0);
}

// Expectations 70, 1, 4, 3, 22: sorted 1 3 4 22 70; 1 + 3 + 4 are the first group, with counts 2 +
// 0 + 9, and nothing remains. With 70, 22, 2, 3, 3 the first group is 2 + 3.
TEST(ChiSquare, PoolsTheLeastProbableCellsFirst) {
    const auto steps = [](std::vector<double> masses) {
        return std::make_shared<Steps>(std::move(masses));
    };
    const Report three =
        analyze("chi-square", in_cells({60, 2, 9, 0, 29}, steps({0.70, 0.01, 0.04, 0.03, 0.22})),
                {{"cells", "5"}});
    EXPECT_NEAR(three.number("statistic"), 9.0 / 8 + 49.0 / 22 + 100.0 / 70, 1e-12);
    EXPECT_EQ(three.number("degrees_of_freedom"), 2);
    EXPECT_EQ(three.number("pooled_cells"), 3);
    // The cells 3 and 22 become one group, because 3 alone is too small.
    const Report two = analyze(
        "chi-square", in_cells({60, 7, 4, 29}, steps({0.7, 0.02, 0.06, 0.22})), {{"cells", "4"}});
    EXPECT_NEAR(two.number("statistic"), 9.0 / 8 + 49.0 / 22 + 100.0 / 70, 1e-12);
    // 2.7 + 2.85 and 3 + 3.15 are groups; the remaining 3.3 is added to the last one.
    const Report left =
        analyze("chi-square", in_cells({5, 3, 1, 2, 4}, steps({0.18, 0.19, 0.2, 0.21, 0.22})),
                {{"cells", "5"}});
    EXPECT_EQ(left.number("degrees_of_freedom"), 1);
    EXPECT_NEAR(left.number("statistic"), 2.45 * 2.45 * (1 / 5.55 + 1 / 9.45), 1e-12);
    EXPECT_EQ(left.number("pooled_cells"), 5);
    EXPECT_EQ(error_of([&] {
                  analyze("chi-square", in_cells({1, 1, 0, 3}, steps({0.7, 0.02, 0.06, 0.22})),
                          {{"cells", "4"}});
              }),
              "input: chi-square needs two groups of cells that expect 5 points each; 5 points on "
              "4 cells give 1 | use more points, or other --cells");
}

TEST(ChiSquare, OnePointWhereNoneCanBeIsEnough) {
    const auto domain = std::make_shared<Steps>(std::vector<double>{0.5, 0.25, 0, 0.25});
    const Settings settings = {{"cells", "4"}, {"level", "1e-9"}};
    const Report fine = analyze("chi-square", in_cells({50, 25, 0, 25}, domain), settings);
    EXPECT_EQ(fine.number("impossible_points"), 0);
    EXPECT_EQ(fine.number("degrees_of_freedom"), 2);
    const Report hit = analyze("chi-square", in_cells({50, 24, 1, 25}, domain), settings);
    EXPECT_EQ(hit.number("impossible_points"), 1);
    EXPECT_EQ(hit.number("p_value"), 0);
    EXPECT_EQ(hit.text("verdict"), "non-uniform");
    // The same for many sets, one of which contains such a point.
    const Analyzer& unit = find_analyzer("chi-square");
    Report mean = fine;
    mean.add("impossible_points", 0.01);
    unit.combine(mean, std::vector<Report>(100, fine), unit.options.defaults());
    EXPECT_EQ(mean.text("verdict"), "non-uniform");
}

// For any edges of cells, gaps are known from the domain. Points on the edge of a gap are not in
// it.
TEST(ChiSquare, OnePointInAGapIsEnough) {
    for (const std::string spec :
         {"table-1d:rows=[0,1 1,1 1.0000001,0 2,0 2.0000001,1 3,1]",
          "table-1d:rows=[0,1 1,0 2,1 3,1],interpolation=constant",
          "expression-1d:density=[max(0,abs(x-1.5)-0.5)],range=[0,3],breaks=[1,2]"}) {
        const Spec warp = parse_spec(spec);
        const WarpChain chain({&warp, 1}, 1);
        const PointSet cube = uniform(2000, 3, 1);
        PointSet points = on(chain.domain(),
                             PointSet(chain.forward({cube.flat().begin(), cube.flat().end()}), 1));
        points[0][0] = 1;
        points[1][0] = 2;
        points[2][0] = std::nextafter(1.0, 2);
        points[3][0] = static_cast<double>(std::nextafter(2.0f, 0.0f));
        EXPECT_EQ(analyze("chi-square", points).number("impossible_points"), 0) << spec;
        EXPECT_EQ(verdict(points), "uniform") << spec;
        points[4][0] = 1.5;
        EXPECT_EQ(analyze("chi-square", points).number("impossible_points"), 1) << spec;
        EXPECT_EQ(verdict(points), "non-uniform") << spec;
    }
}

// A bright square in the middle of 3 x 3 pixels: points beyond its edges by rounding are not in a
// gap.
TEST(ChiSquare, PointsOnTheEdgesOfPixelsAreInNoGap) {
    const TemporaryFile file(
        npy_of<double>("<f8", "(3, 3)", std::vector<double>{0, 0, 0, 0, 1, 0, 0, 0, 0}));
    const auto map = mapping("image:file=" + file.path());
    PointSet points = warped(*map, uniform(900, 5));
    points.domain = map->domain();
    const double low = std::nextafter(1 / 3.0, 0) - 1e-9;
    const double high = 2 / 3.0 + 1e-9;
    points[0][0] = points[4][0] = points[5][0] = low;
    points[1][0] = points[6][0] = points[7][0] = high;
    points[2][1] = points[4][1] = points[6][1] = low;
    points[3][1] = points[5][1] = points[7][1] = high;
    EXPECT_EQ(analyze("chi-square", points).number("impossible_points"), 0);
    for (const std::size_t i : {0, 1, 2, 3}) {
        PointSet far = points;
        far[i][i / 2] += i % 2 == 0 ? -1e-3 : 1e-3;
        EXPECT_EQ(analyze("chi-square", far).number("impossible_points"), 1) << i;
    }
}

// False alarm: 20 seeds at level 1e-6. The shifted grid wraps around, where the density is
// discontinuous.
TEST(ChiSquare, UnevenDomainsAreTestedLikeEvenOnes) {
    const auto domain =
        std::make_shared<Steps>(std::vector<double>{0.4, 0.3, 0, 0.1, 0.15, 0.05}, 2);
    const Settings settings = {{"level", "1e-6"}, {"shifted", "true"}};
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        PointSet points = uniform(20'000, seed);
        PointSet swapped = points;
        for (std::size_t i = 0; i < points.count(); ++i) {
            points[i][0] = domain->place(points[i][0]);
            swapped[i][1] = domain->place(swapped[i][1]);
        }
        const Report right = analyze("chi-square", on(domain, points), settings);
        EXPECT_EQ(right.text("verdict"), "uniform") << seed;
        EXPECT_EQ(right.number("impossible_points"), 0);
        EXPECT_EQ(right.number("shifted.impossible_points"), 0);
        EXPECT_EQ(verdict(on(domain, swapped), settings), "non-uniform") << seed;
    }
}

TEST(ChiSquare, MassesThatContradictEachOtherAreRefused) {
    const auto error = [](double claimed, double off) {
        const auto domain = std::make_shared<Steps>(std::vector<double>{0.5, 0.5}, 1, claimed, off);
        return error_of([&] {
            analyze("chi-square", in_cells({55, 45}, domain), {{"cells", "2"}});
        });
    };
    EXPECT_EQ(error(0, 0), "");
    EXPECT_EQ(error(1e-4, 1e-4), "");
    EXPECT_EQ(error(1e-6, 1e-4),
              "limit: steps: the probabilities of its 2 cells sum to 1.0001; expected 1 within "
              "their error 2e-06");
    EXPECT_NE(error(std::nan(""), 0), "");
    EXPECT_NE(error(0, -3), "") << "negative";
}

// Two cells with probability 1/2 within e, a statistic X^2 of 100 points: its root changes by at
// most D = sqrt(2 (100 e)^2 / 50) = 20 e, and r = 2 e.
TEST(ChiSquare, AVerdictThatErrorsOfMassesCouldTurnIsRefused) {
    const auto judged = [&](std::vector<int> counts, double error) {
        const auto domain = std::make_shared<Steps>(std::vector<double>{0.5, 0.5}, 1, error);
        return analyze("chi-square", in_cells(counts, domain), {{"cells", "2"}});
    };
    const Report even = judged({50, 50}, 1e-6);
    EXPECT_EQ(even.number("mass_error"), 2e-6);
    EXPECT_NEAR(even.number("statistic_error"), 400e-12, 1e-14);
    EXPECT_NEAR(even.number("p_lower"), 0.0795892374, 1e-10) << "C(100, 50) / 2^100";
    EXPECT_EQ(even.text("verdict"), "uniform");
    const Report odd = judged({60, 40}, 1e-3);  // X = 2, D = 0.02, r = 0.002
    EXPECT_NEAR(odd.number("statistic_error"), 2.02 * 2.02 / 0.998 - 4, 1e-12);
    EXPECT_EQ(odd.text("verdict"), "uniform");
    // X = 4, with p = 6e-5; at 0.06 it may be 2.8 / sqrt(1.12), with p = 8e-3.
    EXPECT_EQ(judged({70, 30}, 0.001).text("verdict"), "non-uniform");
    EXPECT_TRUE(
        error_of([&] {
            judged({70, 30}, 0.06);
        })
            .starts_with("limit: chi-square cannot decide: the cells' probabilities have a total "
                         "error of 0.12, and the statistic an error of "));
    EXPECT_NE(error_of([&] { judged({50, 50}, 0.3); }), "") << "may be 0 or 90";
    EXPECT_NE(error_of([&] { judged({50, 50}, 0.6); }), "") << "may be anything";
}

// Oracle: the points themselves, shifted by half a cell.
TEST(ChiSquare, ShiftedGridIsTheGridOfShiftedPoints) {
    const PointSet points = uniform(3000, 4);
    PointSet moved = points;
    for (std::size_t i = 0; i < points.count(); ++i)
        for (const auto& [k, m] : {std::pair<std::size_t, double>{0, 5}, {1, 7}})
            moved[i][k] = std::fmod(points[i][k] + 0.5 / m, 1);
    const Report both = analyze("chi-square", points, {{"cells", "5x7"}, {"shifted", "true"}});
    const Report other = analyze("chi-square", moved, {{"cells", "5x7"}});
    EXPECT_NEAR(both.number("shifted.statistic"), other.number("statistic"), 1e-9);
    const double least = std::min(both.number("p_value"), both.number("shifted.p_value"));
    EXPECT_NEAR(both.number("combined_p_value"), 1 - (1 - least) * (1 - least), 1e-12);
}

// Points at the same positions within all cells: undetected by the plain grid, detected by the
// shifted one.
TEST(ChiSquare, ShiftedGridSeesWhatCellsHide) {
    std::vector<double> flat;
    for (int i = 0; i < 100; ++i)  // 0.19 and 0.21 share a cell only in the shifted grid
        flat.insert(flat.end(), {0.19, 0.21, 0.59, 0.61, 0.85});
    const PointSet points(flat, 1);
    EXPECT_EQ(verdict(points, {{"cells", "5"}}), "stratified");
    const Report report = analyze("chi-square", points, {{"cells", "5"}, {"shifted", "true"}});
    EXPECT_EQ(report.text("verdict"), "non-uniform");
    EXPECT_LT(report.number("shifted.p_upper"), 1e-10);
}

// 15 points, 5 in each of 3 cells: 15! / (5!^3 3^15); of 16 points, any of three cells has 6.
TEST(ChiSquare, EvenCountsInFewCellsAreNotRare) {
    const Report even = analyze("chi-square", in_cells({5, 5, 5}, unit_cube(1)));
    EXPECT_EQ(even.number("statistic"), 0);
    EXPECT_NEAR(even.number("p_lower"), 0.05273963, 1e-8);
    EXPECT_EQ(even.text("verdict"), "uniform");
    EXPECT_NEAR(measure("chi-square", "p_lower", in_cells({5, 6, 5}, unit_cube(1))), 0.14063900,
                1e-6);
    int alarms = 0;  // of 2000 sets at level 0.001; above 10 with probability 1e-5
    for (std::uint64_t seed = 1; seed <= 2000; ++seed)
        alarms += verdict(uniform(15, seed, 1)) != "uniform";
    EXPECT_LE(alarms, 10);
}

namespace {

/// `counts` points at each outcome of a discrete distribution.
PointSet outcomes(const DomainPtr& law, const std::vector<std::uint64_t>& counts) {
    std::vector<double> flat;
    for (std::size_t i = 0; i < counts.size(); ++i)
        flat.insert(flat.end(), counts[i], static_cast<double>(i));
    return on(law, PointSet(std::move(flat), 1));
}

/// Probability of these counts.
double multinomial(const std::vector<double>& p, const std::vector<std::uint64_t>& counts) {
    double n = 0;
    double log = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto c = static_cast<double>(counts[i]);
        n += c;
        log += c * std::log(p[i]) - std::lgamma(c + 1);
    }
    return std::exp(log + std::lgamma(n + 1));
}

/// Oracle: probability that n independent outcomes are called stratified, over all counts up to
/// `reach` from their expectation, the last being determined by the others.
double false_strata(const std::vector<double>& p, std::uint64_t n, double level, int reach) {
    std::vector<std::string> words;
    for (const double x : p) words.push_back(fmt::format("{}", x));
    const DomainPtr law = parse_domain(
        fmt::format("discrete:probabilities=[{}],normalize=true", fmt::join(words, " ")), 1);
    double chance = 0;
    std::vector<std::uint64_t> counts(p.size());
    const auto look = [&](const auto& again, std::size_t i, std::uint64_t left) -> void {
        if (i + 1 == p.size()) {
            counts[i] = left;
            if (verdict(outcomes(law, counts), {{"level", fmt::format("{}", level)}}) ==
                "stratified")
                chance += multinomial(p, counts);
            return;
        }
        const auto middle = static_cast<int>(std::floor(static_cast<double>(n) * p[i]));
        for (int c = std::max(middle - reach, 0); c <= middle + reach + 1; ++c) {
            counts[i] = static_cast<std::uint64_t>(c);
            if (counts[i] <= left) again(again, i + 1, left - counts[i]);
        }
    };
    look(look, 0, n);
    return chance;
}

}  // namespace

// Counts are integers: a statistic of 0 has a positive probability, large for few groups.
TEST(ChiSquare, RandomOutcomesAreNotCalledStratified) {
    for (const auto& [p, n, reach] :
         {std::tuple<std::vector<double>, std::uint64_t, int>{{0.999, 0.001}, 5000, 8},
          {{0.001, 0.999}, 5500, 8},
          {{0.5, 0.5}, 20, 8},
          {{0.5, 0.5}, 1024, 40},
          {{0.3, 0.7}, 1030, 40},
          {{1. / 3, 1. / 3, 1. / 3}, 60, 6},
          {{1. / 3, 1. / 3, 1. / 3}, 1024, 12},
          {{0.005, 0.4975, 0.4975}, 1000, 12},
          {{0.25, 0.25, 0.25, 0.25}, 22, 4}})
        for (const double level : {0.05, 0.01, 0.001})
            EXPECT_LE(false_strata(p, n, level, reach), level)
                << n << " points, " << p.size() << " outcomes, the first " << p[0];
}

// Even counts that are improbable are detected: 125 points at each of 8 outcomes, (2 pi
// 1000)^(-7/2) 8^4 = 2e-10; 2^22 points in two equal parts, (pi 2^21)^(-1/2) = 0.00039.
TEST(ChiSquare, EvenOutcomesAreCalledStratified) {
    const DomainPtr eight =
        parse_domain("discrete:probabilities=[.125 .125 .125 .125 .125 .125 .125 .125]", 1);
    const Report report =
        analyze("chi-square", outcomes(eight, std::vector<std::uint64_t>(8, 125)));
    EXPECT_EQ(report.text("verdict"), "stratified");
    EXPECT_NEAR(report.number("p_lower"),
                multinomial(std::vector<double>(8, 0.125), std::vector<std::uint64_t>(8, 125)),
                1e-16);
    const PointSet halves = outcomes(parse_domain("discrete", 1), {1u << 21, 1u << 21});
    EXPECT_NEAR(measure("chi-square", "p_lower", halves), 0.00038960, 1e-8);
    EXPECT_EQ(verdict(halves), "stratified");
}

// Tails by the formulas, for sets with p_upper 0.1, 0.001, 0.9 and p_lower 0.9, 0.999, 0.1.
TEST(ChiSquare, SetsAreCombinedAsAsked) {
    const Analyzer& unit = find_analyzer("chi-square");
    std::vector<Report> sets(3);
    const double upper[] = {0.1, 0.001, 0.9};
    for (std::size_t i = 0; i < 3; ++i)
        sets[i].add("p_upper", upper[i]).add("p_lower", 1 - upper[i]).add("statistic_error", 0.0);
    const auto combined = [&](const char* how) {
        Values options = unit.options.defaults();
        unit.options.set(options, "combine", how);
        Report mean;
        mean.add("p_value", 0.5);
        unit.combine(mean, sets, options);
        return mean;
    };
    EXPECT_NEAR(combined("sidak").number("p_upper"), 1 - std::pow(0.999, 3), 1e-15);
    sets[0].add("p_lower", 0.0);
    EXPECT_FALSE(std::signbit(combined("sidak").number("p_lower")));  // not -0
    sets[0].add("p_lower", 1 - upper[0]);
    EXPECT_NEAR(combined("sidak").number("p_lower"), 1 - std::pow(0.9, 3), 1e-15);
    EXPECT_NEAR(combined("sidak").number("p_value"), 2 * (1 - std::pow(0.999, 3)), 1e-15);
    // P(chi2_6 > x) = exp(-x/2) (1 + x/2 + x^2/8), x/2 = -ln(0.1 * 0.001 * 0.9)
    const double h = -std::log(0.1 * 0.001 * 0.9);
    EXPECT_NEAR(combined("fisher").number("p_upper"), std::exp(-h) * (1 + h + h * h / 2), 1e-14);
}

// Three sets with statistic 0 are not less probable than the product of their probabilities.
TEST(ChiSquare, SummedSetsHaveALowerTailToo) {
    const Analyzer& unit = find_analyzer("chi-square");
    const auto sum = [&](double statistic, double p_lower) {
        Report set;
        set.add("p_lower", p_lower);
        Report mean;
        mean.add("statistic", statistic)
            .add("degrees_of_freedom", 1.0)
            .add("statistic_error", 0.0)
            .add("impossible_points", 0.0);
        unit.combine(mean, std::vector<Report>(3, set), unit.options.defaults());
        return mean;
    };
    EXPECT_NEAR(sum(0, 0.2).number("p_lower"), 0.008, 1e-15);
    EXPECT_EQ(sum(0, 0.2).text("verdict"), "uniform");
    EXPECT_EQ(sum(0, 0.01).text("verdict"), "stratified");
    EXPECT_NEAR(sum(1, 0.1).number("p_lower"), 0.60837482, 1e-8) << "P(chi2_3 <= 3)";
}

namespace {

/// Report on points that arrive in blocks, with an unknown number.
Report streamed(const PointSet& points, const Settings& settings = {}, unsigned threads = 2) {
    const Analyzer& unit = find_analyzer("chi-square");
    Values options = unit.options.defaults();
    for (const auto& [name, text] : settings) unit.options.set(options, name, text);
    std::size_t at = 0;
    const auto next = [&](std::span<double> rows) {
        const auto rest = points.flat().subspan(at);
        const std::size_t size = std::min(rest.size(), rows.size());
        std::ranges::copy(rest.first(size), rows.begin());
        at += size;
        return size / points.dimension();
    };
    const Found found = analyze(unit, {points.domain}, next, options, {.threads = threads});
    EXPECT_EQ(found.count, points.count());
    return found.report;
}

}  // namespace

TEST(ChiSquare, StreamsGiveWhatSetsGive) {
    const std::size_t million = std::size_t{1} << 20;
    for (const std::size_t n : {20UL, 5000UL, 300'000UL, million - 1, million, million + 1})
        EXPECT_EQ(streamed(uniform(n, n)), analyze("chi-square", uniform(n, n))) << n;
    EXPECT_EQ(streamed(uniform(100'000, 1), {}, 1), streamed(uniform(100'000, 1), {}, 7));
    const PointSet wide = uniform(150'000, 1, 9);
    const Settings both = {{"shifted", "true"}};
    EXPECT_EQ(streamed(wide, both), analyze("chi-square", wide, both));
    EXPECT_EQ(streamed(wide, {{"cells", "2"}}), analyze("chi-square", wide, {{"cells", "2"}}));
    const PointSet disk = warped(*mapping("disk"), uniform(5000, 1));
    EXPECT_EQ(streamed(disk), analyze("chi-square", disk));
    PointSet off = disk;
    off[4999][0] = 3;
    EXPECT_EQ(error_of([&] { streamed(off); }), error_of([&] { analyze("chi-square", off); }));
    EXPECT_EQ(error_of([&] { streamed(PointSet(0, 2)); }),
              "input: chi-square needs at least one point; the set is empty");
}

TEST(ChiSquare, GridOfLargeSetsStopsAtPowersOfSixteen) {
    using Grid = Report::Integers;
    const auto grid_of = [](std::size_t n) {
        return std::get<Grid>(*analyze("chi-square", uniform(n, 1, 1)).find("grid"));
    };
    const std::size_t million = std::size_t{1} << 20;
    EXPECT_EQ(grid_of(million), grid_of(3 * million));
    EXPECT_EQ(grid_of(million), Grid{509});
    EXPECT_NE(grid_of(million), grid_of(million / 2));
}

}  // namespace stipple::testing::chi_square_test
