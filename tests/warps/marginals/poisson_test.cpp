// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::poisson_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

// p(0) = exp(-1) = p(1), p(2) = half of it.
TEST(PoissonWarp, NumbersByHand) {
    const auto map = mapping("poisson:mean=1");
    const double p = 1 / std::numbers::e;
    EXPECT_EQ(image_of(*map, {0, p - 1e-15}), (std::vector{0.0, 0.0}));
    EXPECT_EQ(image_of(*map, {p + 1e-15, 2 * p - 1e-15}), (std::vector{1.0, 1.0}));
    EXPECT_EQ(image_of(*map, {2 * p + 1e-15, 2.5 * p - 1e-15}), (std::vector{2.0, 2.0}));
    EXPECT_DOUBLE_EQ(map->density(std::vector{0.0, 2.0}), p * p / 2);
    EXPECT_EQ(map->density(std::vector{0.5, 2.0}), 0);
}

// P(X > 17) = 6e-17 for mean 1, so P(X <= 17) is 1 - 2^-53 as a double, from which 18 is the
// outcome.
TEST(PoissonWarp, TheLastNumberBelow1) {
    EXPECT_EQ(image_of("poisson:mean=1", {one_minus_ulp, 1}), (std::vector{18.0, 18.0}));
}

TEST(PoissonWarp, BothWaysAndItsMoments) {
    expect_round_trip(*mapping("poisson"), 0);
    expect_round_trip(*mapping("poisson:mean=[0.01,1e5]"), 0);
    const auto m = *mapping("poisson:mean=2")->domain()->moments();
    EXPECT_NEAR(m.mean[0], 2, 1e-14);
    EXPECT_NEAR(m.covariance[0], 2, 1e-14);
    EXPECT_NEAR(m.skewness[0], 1 / std::sqrt(2), 1e-14);
}

// Probabilities of cells of the domain's cube sum to 1, and are sums over whole outcomes.
TEST(PoissonWarp, CellsHoldWholeOutcomes) {
    const DomainPtr domain = mapping("poisson:mean=[1,1]")->domain();
    double sum = 0;
    for (int k = 0; k < 8; ++k)
        sum += domain->probability({{k / 8.0, 0}, {(k + 1) / 8.0, 1}}).value;
    EXPECT_NEAR(sum, 1, 1e-15);
    EXPECT_DOUBLE_EQ(domain->probability({{0, 0}, {0.25, 1}}).value, 1 / std::numbers::e);
}

TEST(PoissonWarp, RefusesMeansOutOfRange) {
    EXPECT_EQ(refusal("poisson:mean=0"), "usage: --mean: 0 is outside [1e-12, 100000000]");
}

}  // namespace stipple::testing::poisson_test
