// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/sensitivity/models.hpp"

namespace stipple::testing::rank_indices_test {

using namespace sensitivity;

namespace {

const Settings by_rank = {{"method", "rank"}};

double first(const PointSet& table, const std::string& key) {
    return measure("sensitivity", key + ".first", table, by_rank);
}

}  // namespace

// Outputs 1, 4, 2, 5 in the order of x, with mean 3 and variance 5/2: two windows, whose products
// about the mean are -2 and -2, each counted in both orders.
TEST(RankIndices, ByHand) {
    const PointSet table = points_of({{0.9, 5}, {0.1, 1}, {0.7, 2}, {0.2, 4}});
    EXPECT_NEAR(first(table, "y.x"), 2 * (-2 - 2) / 4. / 2.5, 1e-15);
}

// Oracle: all pairs of different runs in each window, listed: windows of three or more of ten runs.
TEST(RankIndices, EqualInputsStayInOneWindow) {
    Rows rows = {{0, 1}, {0, 5}, {1, 2}, {1, 4}, {1, 0}, {2, 3}, {3, 3}, {3, 7}, {3, 1}, {4, 4}};
    const std::vector<std::pair<std::size_t, std::size_t>> windows = {{0, 5}, {5, 10}};
    double sum = 0;
    for (const auto& [begin, end] : windows)
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t j = begin; j < end; ++j)
                if (i != j) sum += (rows[i][1] - 3) * (rows[j][1] - 3) / 4;
    double squares = 0;
    for (const auto& row : rows) squares += (row[1] - 3) * (row[1] - 3);
    EXPECT_NEAR(first(points_of(rows), "y.x"), sum / squares, 1e-14);
    std::ranges::reverse(rows);
    EXPECT_NEAR(first(points_of(rows), "y.x"), sum / squares, 1e-14);
    // A constant input is one window: minus one run's fraction.
    for (auto& row : rows) row[0] = 7;
    EXPECT_NEAR(first(points_of(rows), "y.x"), -1. / 9, 1e-14);
}

// A factor with three levels of equal size: variance of the level means.
TEST(RankIndices, OfAFewLevelsAreAnalysisOfVariance) {
    const Rng rng(3);
    Rows rows;
    for (std::size_t i = 0; i < 3000; ++i) {
        const auto level = static_cast<double>(i % 3);
        rows.push_back({level, level + std::sqrt(12) * rng.uniform(i)});
    }
    EXPECT_NEAR(first(points_of(rows), "y.x"), (2. / 3) / (2. / 3 + 1), 0.03);
}

TEST(RankIndices, FindsKnownIndicesOfModerateSamples) {
    const auto three = points_in(make("sobol", points(4096, 3)));
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string key = "x4.x" + std::to_string(i + 1);
        EXPECT_NEAR(first(with_outputs(three, ishigami), key), ishigami_first[i], 0.03);
        EXPECT_NEAR(first(with_outputs(three, linear), key),
                    std::pow(3. - static_cast<double>(i), 2) / 14, 0.03);
    }
    const auto four = with_outputs(points_in(make("sobol", points(4096, 4))), g_function);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(first(four, "x5.x" + std::to_string(i + 1)), g_first(i), 0.04);
}

// If intervals hold with probability 0.95 or more, fewer than 178 of 200 has a probability below
// 1e-4.
TEST(RankIndices, IntervalsHoldTheIndexAsOftenAsTheySay) {
    for (const auto& [n, most] : {std::pair<std::size_t, double>{50, 1.0}, {1000, 0.13}}) {
        std::vector<int> held(3);
        double width = 0;
        for (std::uint64_t seed = 1; seed <= 200; ++seed) {
            const auto rows = points_in(make("random", points(n, 3), {}, {.seed = seed}));
            const Report report = analyze("sensitivity", with_outputs(rows, ishigami), by_rank);
            for (std::size_t i = 0; i < 3; ++i) {
                const std::string key = "x4.x" + std::to_string(i + 1) + ".first";
                const double low = report.number(key + "_low");
                const double high = report.number(key + "_high");
                held[i] += low <= ishigami_first[i] && ishigami_first[i] <= high;
                width += (high - low) / 600;
            }
        }
        for (const int count : held) EXPECT_GE(count, 178) << n;
        EXPECT_LT(width, most) << n;
    }
}

// The only input that matters has index 1, which windows alone would underestimate; levels have
// windows without this error.
TEST(RankIndices, IntervalsCountWhatWindowsHide) {
    int held = 0;
    double width = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        Rows rows = points_in(make("random", points(200, 2), {}, {.seed = seed}));
        const Report whole = analyze(
            "sensitivity", with_outputs(rows, [](auto u) { return std::exp(5 * u[0]); }), by_rank);
        held += whole.number("z.x.first_low") <= 1 && whole.number("z.x.first_high") >= 1;
        for (auto& row : rows) row[0] = std::floor(2 * row[0]);
        const Report level =
            analyze("sensitivity", with_outputs(rows, [](auto u) { return u[0]; }), by_rank);
        EXPECT_NEAR(level.number("z.x.first"), 1, 1e-12);
        width = std::max(width, level.number("z.x.first_high") - level.number("z.x.first_low"));
    }
    EXPECT_EQ(held, 50);
    EXPECT_LT(width, 1e-6);
}

TEST(RankIndices, FewRunsHaveNoIntervals) {
    const auto report_of = [](std::size_t n) {
        return analyze("sensitivity", with_outputs(points_in(make("random", points(n, 3))), linear),
                       by_rank);
    };
    EXPECT_EQ(report_of(19).text("x4.no_intervals"), "19 runs; intervals need 20");
    EXPECT_EQ(report_of(19).find("x4.x1.first_low"), nullptr);
    EXPECT_NE(report_of(20).find("x4.x1.first_low"), nullptr);
}

// Neighbours of Sobol' points in one coordinate are related in the others: statistics of single
// neighbours give -0.6 to 0.4 here. Windows avoid that.
TEST(RankIndices, HoldOnLowDiscrepancyPoints) {
    for (const char* generator : {"sobol", "halton", "rank1-lattice"}) {
        const auto rows = points_in(make(generator, points(1024, 4)));
        const PointSet table = with_outputs(rows, [](auto u) { return u[3]; });
        for (const char* key : {"x5.x1", "x5.x2", "x5.x3"})
            EXPECT_NEAR(first(table, key), 0, 0.01) << generator << ' ' << key;
        EXPECT_NEAR(first(table, "x5.x4"), 1, 0.01) << generator;
    }
}

TEST(RankIndices, LeavesOutFailedRuns) {
    const auto rows = points_in(make("random", points(100, 3)));
    PointSet some = with_outputs(rows, ishigami);
    some[7][3] = std::nan("");
    Rows kept = rows;
    kept.erase(kept.begin() + 7);
    EXPECT_EQ(first(some, "x4.x1"), first(with_outputs(kept, ishigami), "x4.x1"));
}

}  // namespace stipple::testing::rank_indices_test
