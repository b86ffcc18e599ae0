// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "support/designs.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::morris_test {
namespace {

/// The only coordinate in which two runs differ.
std::size_t moved(std::span<const double> a, std::span<const double> b) {
    std::size_t at = a.size();
    for (std::size_t k = 0; k < a.size(); ++k) {
        if (a[k] == b[k]) continue;
        EXPECT_EQ(at, a.size()) << "two coordinates differ";
        at = k;
    }
    return at;
}

}  // namespace

// Each factor moves once per trajectory, by p/2 levels: delta = p / (2 (p - 1)) of the range, or
// 1/2 with --middles.
TEST(Morris, EveryFactorMovesOnceByDelta) {
    for (const int p : {2, 4, 6, 10})
        for (const bool middles : {false, true})
            for (const std::size_t k : {1, 2, 5}) {
                const PointSet set = make("morris", {.dimension = k},
                                          {{"levels", std::to_string(p)},
                                           {"trajectories", "50"},
                                           {"middles", middles ? "true" : "false"}});
                ASSERT_EQ(set.count(), 50 * (k + 1));
                const double delta = middles ? 0.5 : p / (2. * (p - 1));
                for (std::size_t t = 0; t < 50; ++t) {
                    std::set<std::size_t> factors;
                    for (std::size_t j = 1; j <= k; ++j) {
                        const auto before = set[t * (k + 1) + j - 1];
                        const auto after = set[t * (k + 1) + j];
                        const std::size_t at = moved(before, after);
                        ASSERT_LT(at, k);
                        EXPECT_NEAR(std::abs(after[at] - before[at]), delta, 2.3e-16);
                        factors.insert(at);
                    }
                    EXPECT_EQ(factors.size(), k);
                }
            }
}

// Morris 1991, section 3: each input takes values of {0, 1/(p-1), 2/(p-1), ..., 1}.
TEST(Morris, LevelsGoFromEndToEnd) {
    const PointSet set = make("morris", points(3000, 2), {{"levels", "6"}});
    std::map<double, int> seen;
    for (const double x : set.flat()) ++seen[x];
    ASSERT_EQ(seen.size(), 6U);
    double level = 0;
    for (const auto& [x, times] : seen) EXPECT_NEAR(x, level++ / 5, 1.2e-16);
}

// Effects of 7 sin(x)^2, x = pi (2 u - 1), by hand: u = 0, 1/3, 2/3, 1 give 0, 21/4, 21/4, 0, so
// every step of 2/3 changes it by 21/4. A step of 1/2 would change nothing.
TEST(Morris, SeesWhatHasHalfTheRangeAsItsPeriod) {
    const PointSet set = make("morris", {.dimension = 1});
    const auto f = [](double u) {
        return 7 * std::pow(std::sin(std::numbers::pi * (2 * u - 1)), 2);
    };
    for (std::size_t t = 0; t < set.count(); t += 2)
        EXPECT_NEAR(std::abs((f(set[t + 1][0]) - f(set[t][0])) / (set[t + 1][0] - set[t][0])),
                    7.875, 1e-12);
}

TEST(Morris, LevelsMayBeTheMiddlesOfEqualCells) {
    const PointSet set = make("morris", points(3000, 2), {{"levels", "6"}, {"middles", "true"}});
    for (const double x : set.flat()) {
        const double level = std::floor(x * 6);
        EXPECT_EQ(x, (2 * level + 1) / 12);
    }
}

// Start levels, directions and orders of factors are equally likely. With p = 4, k = 2 there are
// 2^2 lower levels, 2^2 directions and 2 orders: 32 kinds of trajectories, chi-square with 31
// degrees of freedom; 95 is exceeded with probability 2e-8.
TEST(Morris, AllTrajectoriesAreEquallyLikely) {
    const std::size_t r = 32000;
    const PointSet set = make("morris", points(3 * r, 2));
    std::map<std::vector<double>, double> counts;
    for (std::size_t t = 0; t < r; ++t) {
        const auto flat = set.flat().subspan(6 * t, 6);
        counts[std::vector<double>(flat.begin(), flat.end())] += 1;
    }
    EXPECT_EQ(counts.size(), 32U);
    double statistic = 0;
    for (const auto& [trajectory, count] : counts)
        statistic += (count - 1000) * (count - 1000) / 1000;
    EXPECT_LT(statistic, 95);
}

TEST(Morris, RadialStarsReplaceOneCoordinateEach) {
    const std::size_t k = 3;
    const PointSet set = make("morris", points(400, k), {{"radial", "true"}}, {.seed = 5});
    const PointSet base = make("sobol:scramble=owen", points(104, 2 * k), {}, {.seed = 5});
    for (std::size_t t = 0; t < 100; ++t)
        for (std::size_t j = 0; j <= k; ++j)
            for (std::size_t i = 0; i < k; ++i)
                EXPECT_EQ(set[t * 4 + j][i], j == i + 1 ? base[t + 4][k + i] : base[t][i]);
}

TEST(Morris, MoreTrajectoriesKeepThoseThatThereAre) {
    EXPECT_TRUE(std::ranges::equal(make("morris", points(40, 3)).flat(),
                                   make("morris", points(4000, 3)).flat().first(120)));
    EXPECT_TRUE(stretches_agree("morris", points(1000, 4)));
    EXPECT_TRUE(stretches_agree("morris", points(1000, 4), {{"radial", "true"}}));
    EXPECT_EQ(make("morris", {.dimension = 4}).count(), 50U);
}

TEST(Morris, RefusesOddLevelsAndParts) {
    const auto error = [](const Request& request, const Settings& settings) {
        return error_of([&] { make("morris", request, settings); });
    };
    EXPECT_EQ(error({}, {{"levels", "5"}}),
              "usage: --levels: 5 is odd; steps of half the levels need an even number");
    EXPECT_EQ(
        error(points(10, 3), {}),
        "usage: --count: 10 is not a multiple of 4, as morris needs; 8 and 12 are the nearest");
    EXPECT_EQ(
        error(points(10, 3), {{"trajectories", "3"}}),
        "usage: --count: 10 contradicts --trajectories 3, which has 12 runs; leave --count out");
    EXPECT_EQ(error({}, {{"radial", "true"}, {"levels", "6"}}),
              "usage: --levels: the points of --radial have no levels");
    EXPECT_EQ(error({}, {{"radial", "true"}, {"middles", "true"}}),
              "usage: --middles: the points of --radial have no levels");
}

}  // namespace stipple::testing::morris_test
