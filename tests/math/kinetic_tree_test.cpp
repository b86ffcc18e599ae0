// SPDX-License-Identifier: MIT
#include "math/kinetic_tree.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/rng.hpp"

using namespace stipple;

namespace {

/// Oracle: all lines, one by one.
struct PlainLines {
    std::vector<double> slopes;
    std::vector<std::int32_t> counts;
    double n;
    bool late;

    [[nodiscard]] double value(std::size_t j, double x) const {
        const double share = counts[j] / n;
        return late ? x * slopes[j] - share : share - x * slopes[j];
    }
    [[nodiscard]] double highest(double x) const {
        double most = -10;
        for (std::size_t j = 0; j < slopes.size(); ++j) most = std::max(most, value(j, x));
        return most;
    }
    [[nodiscard]] std::set<std::size_t> above(double level, double x) const {
        std::set<std::size_t> lines;
        for (std::size_t j = 0; j < slopes.size(); ++j)
            if (value(j, x) >= level) lines.insert(j);
        return lines;
    }
};

/// Runs the same random additions and moves on both, with some times and slopes in common.
template <SteepWins steep>
void expect_as_plain(std::size_t lines, std::uint64_t seed) {
    const Rng rng(seed, lines);
    PlainLines plain{{}, std::vector<std::int32_t>(lines), 0, steep == SteepWins::late};
    for (std::size_t j = 0; j < lines; ++j)
        plain.slopes.push_back(static_cast<double>(j + rng.below(j, 2)) / 2 /
                               static_cast<double>(lines));
    plain.slopes.erase(std::unique(plain.slopes.begin(), plain.slopes.end()), plain.slopes.end());
    plain.counts.resize(plain.slopes.size());
    constexpr std::uint64_t steps = 300;
    plain.n = steps;
    KineticTree<steep> tree(plain.slopes, plain.n, {});
    double x = 0;
    for (std::uint64_t step = 0; step < steps; ++step) {
        const std::size_t first = rng.below(1000 + step, plain.slopes.size() + 1);
        tree.add_from(first, x);
        for (std::size_t j = first; j < plain.slopes.size(); ++j) ++plain.counts[j];
        x = std::min(1.0, x + static_cast<double>(rng.below(2000 + step, 3)) / steps);
        tree.advance(x);
        const double highest = plain.highest(x);
        ASSERT_NEAR(tree.highest(x), highest, tree.tolerance) << "step " << step;
        std::set<std::size_t> seen;
        tree.visit_above([&] { return highest - .01; }, x,
                         [&](std::size_t j, std::int32_t count) {
                             seen.insert(j);
                             EXPECT_EQ(count, plain.counts[j]);
                         });
        for (const std::size_t j : plain.above(highest - .01, x))
            EXPECT_TRUE(seen.contains(j)) << "line " << j << ", step " << step;
    }
}

}  // namespace

TEST(KineticTree, KnowsTheHighestLineAtAllTimes) {
    for (const std::size_t lines : {1, 2, 3, 8, 50, 257})
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            expect_as_plain<SteepWins::late>(lines, seed);
            expect_as_plain<SteepWins::early>(lines, seed);
        }
}
