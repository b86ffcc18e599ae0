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

// Outputs 1, 4, 2, 5 in the order of x, of mean 3 and variance 5/2: products of neighbors about the
// mean, cyclic, are -2 - 1 - 2 - 4.
TEST(RankIndices, ByHand) {
    const PointSet table = points_of({{0.9, 5}, {0.1, 1}, {0.7, 2}, {0.2, 4}});
    EXPECT_NEAR(first(table, "y.x"), -9. / 4 / 2.5, 1e-15);
}

// Oracle: the mean over all orders of the rows, of which only equal inputs move.
TEST(RankIndices, EqualInputsCountWithAllTheirOrders) {
    const std::vector<std::vector<std::vector<double>>> cases = {
        {{0, 1}, {0, 5}, {0, 2}, {1, 4}, {1, 0}, {2, 3}},
        {{0, 1}, {1, 5}, {1, 2}, {1, 4}, {2, 0}, {2, 3}},
        {{1, 1}, {1, 5}, {1, 2}, {1, 4}, {1, 0}, {1, 3}}};
    for (const auto& rows : cases) {
        std::vector<std::size_t> order = {0, 1, 2, 3, 4, 5};
        double sum = 0;
        double orders = 0;
        do {
            bool sorted = true;
            double products = 0;
            for (std::size_t j = 0; j < 6; ++j) {
                sorted = sorted && (j == 5 || rows[order[j]][0] <= rows[order[j + 1]][0]);
                products += (rows[order[j]][1] - 2.5) * (rows[order[(j + 1) % 6]][1] - 2.5);
            }
            if (!sorted) continue;
            sum += products;
            ++orders;
        } while (std::ranges::next_permutation(order).found);
        EXPECT_NEAR(first(points_of(rows), "y.x"), sum / orders / 17.5, 1e-14);
        const std::vector<std::vector<double>> reversed(rows.rbegin(), rows.rend());
        EXPECT_NEAR(first(points_of(reversed), "y.x"), sum / orders / 17.5, 1e-14);
    }
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
    const auto three = rows_of(make("sobol", points(4096, 3)));
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string key = "x4.x" + std::to_string(i + 1);
        EXPECT_NEAR(first(with_outputs(three, ishigami), key), ishigami_first[i], 0.03);
        EXPECT_NEAR(first(with_outputs(three, linear), key),
                    std::pow(3. - static_cast<double>(i), 2) / 14, 0.03);
    }
    const auto four = with_outputs(rows_of(make("sobol", points(4096, 4))), g_function);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(first(four, "x5.x" + std::to_string(i + 1)), g_first(i), 0.04);
}

// Of 200 sets 190 are expected; below 178 is a chance of 1e-4 if intervals hold with probability
// 0.95, and 199 one of 5e-4. Intervals of 70 % of the width would hold 166 times.
TEST(RankIndices, IntervalsHoldTheIndexAsOftenAsTheySay) {
    std::vector<int> held(3);
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const auto rows = rows_of(make("random", points(1000, 3), {}, {.seed = seed}));
        const Report report = analyze("sensitivity", with_outputs(rows, ishigami), by_rank);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::string key = "x4.x" + std::to_string(i + 1) + ".first";
            held[i] += report.number(key + "_low") <= ishigami_first[i] &&
                       ishigami_first[i] <= report.number(key + "_high");
        }
    }
    for (const int count : held) {
        EXPECT_GE(count, 178);
        EXPECT_LE(count, 198);
    }
}

TEST(RankIndices, LeavesOutFailedRuns) {
    const auto rows = rows_of(make("random", points(100, 3)));
    PointSet some = with_outputs(rows, ishigami);
    some[7][3] = std::nan("");
    Rows kept = rows;
    kept.erase(kept.begin() + 7);
    EXPECT_EQ(first(some, "x4.x1"), first(with_outputs(kept, ishigami), "x4.x1"));
}

}  // namespace stipple::testing::rank_indices_test
