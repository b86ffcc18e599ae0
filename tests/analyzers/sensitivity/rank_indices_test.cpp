// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analyzers/sensitivity/models.hpp"

namespace stipple::testing::rank_indices_test {

using namespace sensitivity;

namespace {

const Settings by_rank = {{"method", "rank"}};

double first(const PointSet& table, const std::string& key) {
    return measure("sensitivity", key + ".first", table, by_rank);
}

}  // namespace

// Outputs 1, 4, 2, 5 in the order of x, of mean 3 and variance 5/2: two windows, with the products
// -2 and -2 about the mean, each for a run and the other.
TEST(RankIndices, ByHand) {
    const PointSet table = points_of({{0.9, 5}, {0.1, 1}, {0.7, 2}, {0.2, 4}});
    EXPECT_NEAR(first(table, "y.x"), 2 * (-2 - 2) / 4. / 2.5, 1e-15);
}

// Oracle: all pairs of different runs of each window, written down: windows of three or more of ten.
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
    // An input that never changes is one window: minus the share of a run.
    for (auto& row : rows) row[0] = 7;
    EXPECT_NEAR(first(points_of(rows), "y.x"), -1. / 9, 1e-14);
}

// A factor of three levels of equal size: the variance of the means of the levels.
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

// Of 200 sets 190 are expected; below 178 is a chance of 1e-4 if intervals hold with probability
// 0.95. Intervals of 70 % of the width would hold 166 times. Their width is 4 standard errors of
// 0.022, 0.031 and 0.012.
TEST(RankIndices, IntervalsHoldTheIndexAsOftenAsTheySay) {
    std::vector<int> held(3);
    double width = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const auto rows = points_in(make("random", points(1000, 3), {}, {.seed = seed}));
        const Report report = analyze("sensitivity", with_outputs(rows, ishigami), by_rank);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::string key = "x4.x" + std::to_string(i + 1) + ".first";
            const double low = report.number(key + "_low");
            const double high = report.number(key + "_high");
            held[i] += low <= ishigami_first[i] && ishigami_first[i] <= high;
            width += (high - low) / 600;
        }
    }
    for (const int count : held) EXPECT_GE(count, 178);
    EXPECT_LT(width, 0.1);
}

// Neighbors in one coordinate of Sobol' points are related in the others: statistics of single
// neighbors give -0.6 to 0.4 here. Windows do not.
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
