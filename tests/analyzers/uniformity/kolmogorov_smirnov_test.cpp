// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>

#include "analyzers/uniformity/kolmogorov.hpp"
#include "pipeline/domains.hpp"
#include "support/steps.hpp"
#include "support/warping.hpp"

namespace stipple::testing::kolmogorov_smirnov_test {

using analyzers::kolmogorov_exact;
using analyzers::kolmogorov_expansion;
using analyzers::kolmogorov_tails;
using analyzers::smirnov_upper;

namespace {

/// Oracle: Massey's count of the ways in which n points fall into n cells of [0, 1] such that the
/// number up to the end of the m-th always differs from m by less than k: P(D_n <= k / n).
double massey(int n, int k) {
    std::vector<double> ways(static_cast<std::size_t>(2 * k - 1), 0.0);
    ways[static_cast<std::size_t>(k - 1)] = 1;
    for (int m = 0; m < n; ++m) {
        std::vector<double> next(ways.size(), 0.0);
        for (std::size_t from = 0; from < ways.size(); ++from) {
            // Poisson weights, so that the result has the factor n! / n^n.
            double weight = std::exp(-1.0);
            std::size_t points = from == 0 ? 1 : 0;
            for (; points + from < ways.size() + 1; ++points) {
                weight = std::exp(-1.0 - std::lgamma(static_cast<double>(points) + 1));
                next[from + points - 1] += ways[from] * weight;
            }
        }
        ways = next;
    }
    const double total = std::exp(n * std::log(n) - n - std::lgamma(n + 1.0));
    return ways[static_cast<std::size_t>(k - 1)] / total;
}

Report::Curve curve(const char* key, const PointSet& points) {
    return analyze("kolmogorov-smirnov", points).curve(key);
}

}  // namespace

TEST(Kolmogorov, PublishedValue) {  // Marsaglia, Tsang, Wang 2003
    EXPECT_NEAR(kolmogorov_exact(10, 0.274, {}), 0.6284796154565043, 1e-14);
}

TEST(Kolmogorov, ClosedFormsAtBothEnds) {
    for (const std::uint64_t n : {1U, 2U, 3U, 7U, 20U, 100U}) {
        const auto m = static_cast<double>(n);
        EXPECT_EQ(kolmogorov_exact(n, 0.5 / m, {}), 0);
        EXPECT_EQ(kolmogorov_exact(n, 1, {}), 1);
        for (const double share : {0.1, 0.5, 0.9}) {
            const double near = (0.5 + 0.5 * share) / m;  // n! (2 d - 1/n)^n up to d = 1/n
            const double low = std::exp(std::lgamma(m + 1) + m * std::log(share / m));
            EXPECT_NEAR(kolmogorov_exact(n, near, {}) / low, 1, 1e-10) << n;
            const double far = 1 - share / m;  // 1 - 2 (1 - d)^n from d = 1 - 1/n on, n > 1
            if (n == 1) continue;
            const double high = 2 * std::pow(share / m, m);
            EXPECT_NEAR(kolmogorov_exact(n, far, {}), 1 - high, 1e-12) << n;
            EXPECT_NEAR(2 * smirnov_upper(n, far) / high, 1, 1e-10) << n;
        }
    }
    EXPECT_NEAR(kolmogorov_exact(1, 0.7, {}), 0.4, 1e-15);
}

TEST(Kolmogorov, AgreesWithCountingCellByCell) {
    for (const int n : {2, 5, 10, 50, 200})
        for (int k = 1; k <= std::min(n - 1, 40); k += 1 + k / 4)
            EXPECT_NEAR(
                kolmogorov_exact(static_cast<std::uint64_t>(n), double(k) / n, {}) / massey(n, k),
                1, 1e-9)
                << n << ", " << k;
}

TEST(Kolmogorov, OneSidedIsPlainForFewPoints) {
    EXPECT_NEAR(smirnov_upper(1, 0.3), 0.7, 1e-15);
    // Two points, integrated by hand: for x < 1/2 the probability is (1 - x)^2 + 2 x (1/2 - x).
    for (const double x : {0.1, 0.25, 0.4})
        EXPECT_NEAR(smirnov_upper(2, x), (1 - x) * (1 - x) + 2 * x * (0.5 - x), 1e-14) << x;
}

// The two methods agree where one is replaced by the other, and the expansion is as accurate as
// promised.
TEST(Kolmogorov, WaysOfWorkingItOutAgree) {
    for (const std::uint64_t n : {100U, 1000U, 3000U}) {
        const double x = std::sqrt(4 / static_cast<double>(n));
        EXPECT_NEAR(2 * smirnov_upper(n, x) / (1 - kolmogorov_exact(n, x, {})), 1, 1e-8) << n;
    }
    for (const double z : {0.3, 0.5, 0.8, 1.2}) {
        const double x = z / 100;
        EXPECT_NEAR(kolmogorov_expansion(10'000, x), kolmogorov_exact(10'000, x, {}), 1e-9) << z;
        // With a quarter of the points the error is 16 times as large: terms up to n^(-3/2) are
        // right.
        const double few = kolmogorov_expansion(400, z / 20) - kolmogorov_exact(400, z / 20, {});
        EXPECT_LT(std::abs(few), 1e-6) << z;
    }
    const double x = 2.5e-3;  // n x^2 = 6.25 at 10^6
    EXPECT_NEAR(smirnov_upper(1'000'001, x) / smirnov_upper(1'000'000, x), 1, 1e-4);
}

TEST(KolmogorovSmirnov, VanDerCorputOfFivePointsIsAQuarter) {
    const PointSet points = make("van-der-corput", {5, 1, 1});
    EXPECT_DOUBLE_EQ(curve("statistic", points)[0], 0.25);
}

TEST(KolmogorovSmirnov, IsTheStarDiscrepancyOfTheUnitInterval) {
    for (const char* generator : {"random", "jittered", "van-der-corput", "sobol"})
        for (const std::uint64_t n : {1U, 2U, 5U, 16U, 100U, 1024U}) {
            const PointSet points = make(generator, {n, 1});
            EXPECT_NEAR(curve("statistic", points)[0], measure("star-discrepancy", "value", points),
                        1e-15)
                << generator << " " << n;
        }
    for (const auto& flat : {std::vector<double>{0, 0, 0}, {1, 1}, {0, 1}, {0.5}, {0.25, 0.25, 1}})
        EXPECT_NEAR(curve("statistic", PointSet(flat, 1))[0],
                    measure("star-discrepancy", "value", PointSet(flat, 1)), 1e-15);
}

// Counted in cells, the statistic is below the exact one by at most the stated error; on dyadic
// lattices, without points inside of cells, by the effect of one cell.
TEST(KolmogorovSmirnov, CountsManyPointsWithinTheErrorThatItTells) {
    for (const char* generator : {"random", "sobol"})
        for (const std::uint64_t n : {16U, 1000U, 20'000U}) {
            const PointSet points = make(generator, {n, 3});
            const Report exact = analyze("kolmogorov-smirnov", points);
            const Report counted = analyze("kolmogorov-smirnov", points, {{"exact-points", "10"}});
            for (std::size_t k = 0; k < 3; ++k) {
                const double is = exact.curve("statistic")[k];
                const double error = counted.curve("statistic_error")[k];
                EXPECT_EQ(exact.curve("statistic_error")[k], 0);
                EXPECT_GT(error, 0);
                // One cell's width, and the points in the fullest cell, a few more than expected.
                const double cells = 4096;
                EXPECT_LE(error, 2 / cells + 20 / static_cast<double>(n)) << generator << n;
                EXPECT_LE(counted.curve("statistic")[k], is);
                EXPECT_GE(counted.curve("statistic")[k] + error, is - 1e-15);
            }
        }
    const PointSet edges(std::vector<double>{0, 1, 1, 0.5}, 1);
    const Report counted = analyze("kolmogorov-smirnov", edges, {{"exact-points", "1"}});
    EXPECT_DOUBLE_EQ(counted.curve("statistic")[0] + counted.curve("statistic_error")[0], 0.5);
}

TEST(KolmogorovSmirnov, BothTailsAreFound) {
    const Report even = analyze("kolmogorov-smirnov", make("jittered", {1024, 2}));
    EXPECT_EQ(even.text("verdict"), "stratified");
    const Report very = analyze("kolmogorov-smirnov", make("van-der-corput", {4096, 1}));
    EXPECT_LT(very.curve("p_lower")[0], 1e-100);
    EXPECT_EQ(very.curve("p_upper")[0], 1);

    PointSet tilted = make("random", {20'000, 2});
    for (std::size_t i = 0; i < tilted.count(); ++i) tilted[i][1] *= 0.97 + 0.03 * tilted[i][1];
    const Report wrong = analyze("kolmogorov-smirnov", tilted, {{"level", "0.05"}});
    EXPECT_EQ(wrong.text("verdict"), "non-uniform");
    EXPECT_GT(wrong.curve("p_value")[0], 0.05);
    EXPECT_LT(wrong.curve("p_value")[1], 0.02);
    EXPECT_EQ(analyze("kolmogorov-smirnov", tilted, {{"expect", "stratified"}}).unmet().size(), 1U);
}

// 200 sets at level 0.01: above 10 false alarms with probability 6e-6.
TEST(KolmogorovSmirnov, FalseAlarmsAreAsManyAsTheLevelSays) {
    int alarms = 0, low = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Report report = analyze(
            "kolmogorov-smirnov", make("random", {50, 3}, {}, {.seed = seed}), {{"level", "0.01"}});
        alarms += report.text("verdict") != "uniform";
        low += report.number("combined_p_value") < 0.5;
    }
    EXPECT_LE(alarms, 10);
    EXPECT_NEAR(low, 100, 33);
}

TEST(KolmogorovSmirnov, TakesEveryEvenDomainAndNamesPointsOutside) {
    const PointSet cube = make("random", {5000, 2});
    EXPECT_EQ(analyze("kolmogorov-smirnov", warped(*mapping("disk"), cube)).text("verdict"),
              "uniform");
    EXPECT_EQ(
        analyze("kolmogorov-smirnov", warped(*mapping("disk:method=naive"), cube)).text("verdict"),
        "non-uniform");
    PointSet off = warped(*mapping("disk"), cube);
    off[3][0] = 2;
    EXPECT_NE(error_of([&] {
                  analyze("kolmogorov-smirnov", off);
              }).find("1 of 5000 points are outside the domain disk; the first is point 3"),
              std::string::npos);
}

// 200 sets of outcomes at level 0.01: above 10 false alarms with probability 6e-6. A wrong
// probability of an outcome is detected.
TEST(KolmogorovSmirnov, OutcomesAreSpreadEvenly) {
    const auto map = mapping("binomial:trials=4,probability=0.3");
    const auto other = mapping("binomial:trials=4,probability=0.35");
    int alarms = 0, low = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const PointSet points = warped(*map, make("random", {50, 2}, {}, {.seed = seed}));
        const Report report = analyze("kolmogorov-smirnov", points, {{"level", "0.01"}});
        alarms += report.text("verdict") != "uniform";
        low += report.number("combined_p_value") < 0.5;
    }
    EXPECT_LE(alarms, 10);
    EXPECT_NEAR(low, 100, 33);
    PointSet wrong = warped(*other, make("random", {5000, 2}));
    wrong.domain = map->domain();
    EXPECT_EQ(analyze("kolmogorov-smirnov", wrong).text("verdict"), "non-uniform");
    // With a single outcome of probability 1, the random numbers that spread outcomes are tested.
    const auto sure = mapping("integers:low=3,high=3");
    EXPECT_EQ(
        analyze("kolmogorov-smirnov", warped(*sure, make("random", {1000, 2}))).text("verdict"),
        "uniform");
}

TEST(KolmogorovSmirnov, OutcomesOfAColumnAreSpreadAlikeBesideOthers) {
    const PointSet two =
        warped(*mapping("binomial:trials=4,probability=0.3"), make("random", {50, 2}));
    PointSet one(50, 1);
    for (std::size_t i = 0; i < 50; ++i) one[i][0] = two[i][0];
    one.domain = parse_domain("binomial:trials=4,probability=0.3", 1);
    EXPECT_EQ(analyze("kolmogorov-smirnov", one).curve("statistic")[0],
              analyze("kolmogorov-smirnov", two).curve("statistic")[0]);
}

TEST(KolmogorovSmirnov, NeedsCoordinatesThatPreserveProbability) {
    PointSet set = make("random", {100, 1});
    set.domain = std::make_shared<Steps>(std::vector<double>{0.5, 0.5});
    for (const char* analyzer : {"kolmogorov-smirnov", "serial"})
        EXPECT_EQ(error_of([&] { analyze(analyzer, set); }),
                  std::string("input: ") + analyzer +
                      " needs coordinates that preserve probability; steps does not have them | "
                      "chi-square accepts every domain");
}

TEST(KolmogorovSmirnov, SeveralSetsBecomeOneTest) {
    const Analyzer& unit = find_analyzer("kolmogorov-smirnov");
    std::vector<Report> sets(3);
    sets[0].add("combined_p_upper", 0.5).add("combined_p_lower", 0.5);
    sets[1].add("combined_p_upper", 0.0001).add("combined_p_lower", 1.0);
    sets[2].add("combined_p_upper", 0.9).add("combined_p_lower", 0.1);
    Report mean;
    unit.combine(mean, sets, unit.options.defaults());
    EXPECT_NEAR(mean.number("combined_p_upper"), 1 - std::pow(0.9999, 3), 1e-15);
    EXPECT_NEAR(mean.number("combined_p_lower"), 1 - std::pow(0.9, 3), 1e-15);
    EXPECT_EQ(mean.text("verdict"), "non-uniform");
}

// Points at the ends of cells: counted in these cells, D is less by up to their width.
TEST(KolmogorovSmirnov, TailsOfCountedPointsAllowForTheError) {
    PointSet set = make("random", points(200'000, 1), {}, {.seed = 3});
    for (double& x : set.flat()) x = (std::floor(x * 4096) + 0.9999) / 4096;
    const Report kept = analyze("kolmogorov-smirnov", set);
    const Report counted = analyze("kolmogorov-smirnov", set, {{"exact-points", "1"}});
    EXPECT_LT(counted.curve("statistic")[0], kept.curve("statistic")[0]);
    for (const char* tail : {"p_lower", "p_upper"})
        EXPECT_GE(counted.curve(tail)[0], kept.curve(tail)[0]) << tail;
}

}  // namespace stipple::testing::kolmogorov_smirnov_test
