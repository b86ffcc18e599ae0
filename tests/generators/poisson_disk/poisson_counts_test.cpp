// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/poisson_counts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"

namespace stipple::testing::poisson_counts_test {
using namespace stipple::poisson_disk;

// Compares 200 000 numbers of each mean with Poisson probabilities: the chi-square statistic of
// cells with an expectation above 10 exceeds its mean by 6 standard deviations, sqrt(2 dof) each,
// with a probability of about 1e-8. Means above 16 are drawn in portions.
TEST(PoissonCounts, NumbersArePoisson) {
    constexpr std::size_t draws = 200'000;
    for (const double to_a_part : {0.01, 0.3, 5.0})
        for (const std::size_t parts : {1, 8, 64}) {
            const PoissonCounts counts(to_a_part, 64);
            const double mean = to_a_part * static_cast<double>(parts);
            EXPECT_EQ(counts.mean(parts), mean);
            std::vector<double> seen(1000);
            for (std::uint64_t i = 0; i < draws; ++i) {
                SplitMix64 mixer(Rng(3).bits(i));
                const std::uint64_t k = counts.draw(parts, mixer);
                ASSERT_LT(k, seen.size());
                ++seen[k];
            }
            double statistic = 0;
            double freedom = -1;
            for (std::size_t k = 0; k < seen.size(); ++k) {
                const auto n = static_cast<double>(k);
                const double expected =
                    draws * std::exp(n * std::log(mean) - mean - std::lgamma(n + 1));
                if (expected < 10) continue;
                statistic += (seen[k] - expected) * (seen[k] - expected) / expected;
                ++freedom;
            }
            EXPECT_LT(statistic, freedom + 6 * std::sqrt(2 * freedom)) << mean;
        }
}

TEST(PoissonCounts, NoDartsFallOnNothing) {
    const PoissonCounts counts(100, 64);
    SplitMix64 mixer(1);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(counts.draw(0, mixer), 0);
}

}  // namespace stipple::testing::poisson_counts_test
