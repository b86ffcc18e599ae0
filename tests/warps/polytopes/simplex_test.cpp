// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "support/warping.hpp"

namespace stipple::testing::simplex_test {
namespace {

/// The map for a given number of coordinates.
std::unique_ptr<Mapping> simplex_of(std::string_view text, std::size_t given) {
    const Spec spec = parse_spec(text);
    const Warp& warp = find_warp(spec.name);
    return warp.make(spec.values(warp.options), given, {});
}

}  // namespace

// In the plane P(X1 > x) = (1 - x)^2, and x2 is uniform on the remaining interval.
TEST(Simplex, NumbersByHand) {
    EXPECT_EQ(image_of("simplex", {0, 0.5}), (std::vector{0.0, 0.5}));
    const auto p = image_of("simplex", {0.75, 0.5});
    EXPECT_DOUBLE_EQ(p[0], 0.5);
    EXPECT_DOUBLE_EQ(p[1], 0.25);
    EXPECT_DOUBLE_EQ(image_of("simplex:bound=6", {0.75, 0.5})[1], 1.5);
    // In space: 1 - (1 - 7/8)^(1/3) = 1/2, then 1/2 (1 - (1 - 3/4)^(1/2)) = 1/4, then half of 1/4.
    const auto q = image_of(*simplex_of("simplex", 3), {0.875, 0.75, 0.5});
    EXPECT_NEAR(q[0], 0.5, 1e-16);
    EXPECT_NEAR(q[1], 0.25, 1e-16);
    EXPECT_NEAR(q[2], 0.125, 1e-16);
    EXPECT_EQ(image_of(*simplex_of("simplex:bound=3", 1), {0.25}), (std::vector{0.75}));
}

TEST(Simplex, TinyCoordinatesKeepTheirDigits) {
    EXPECT_DOUBLE_EQ(image_of("simplex", {1e-300, 1e-300})[0], 0.5e-300);
    EXPECT_DOUBLE_EQ(image_of("simplex", {1e-300, 1e-300})[1], 1e-300);
}

TEST(Simplex, BothWaysInAnyDimension) {
    for (const std::size_t d : {1U, 2U, 3U}) {
        expect_round_trip(*simplex_of("simplex:bound=5", d), 1e-13);
        expect_density_is_one_over_stretch(*simplex_of("simplex", d));
    }
    const auto map = simplex_of("simplex", 40);
    const PointSet cube = make("random", points(1000, 40));
    const PointSet image = warped(*map, cube);
    std::vector<double> back(cube.flat().size());
    map->inverse(image.flat(), back);
    for (std::size_t i = 0; i < back.size(); ++i) EXPECT_NEAR(back[i], cube.flat()[i], 1e-11);
}

TEST(Simplex, VolumeIsOneOverTheFactorial) {
    EXPECT_DOUBLE_EQ(simplex_of("simplex", 10)->domain()->measure(), 1 / 3628800.0);
    EXPECT_DOUBLE_EQ(simplex_of("simplex:bound=2", 3)->domain()->measure(), 8 / 6.0);
    const DomainPtr domain = mapping("simplex:bound=2")->domain();
    EXPECT_TRUE(domain->contains(std::vector{0.5, 1.5}));
    EXPECT_FALSE(domain->contains(std::vector{0.5, 1.5001}));
    EXPECT_FALSE(domain->contains(std::vector{-1e-300, 1.0}));
    EXPECT_FALSE(domain->contains(std::vector{NAN, 1.0}));
    EXPECT_EQ(domain->spec(), "simplex:bound=2");
}

// In three dimensions: mean 1/4, variance 3/80, covariance -1/80, skewness of the beta distribution
// (1, 3).
TEST(Simplex, MomentsByHandAndBySumming) {
    const auto map = simplex_of("simplex", 3);
    const auto m = *map->domain()->moments();
    EXPECT_DOUBLE_EQ(m.mean[2], 0.25);
    EXPECT_DOUBLE_EQ(m.covariance[0], 3 / 80.0);
    EXPECT_DOUBLE_EQ(m.covariance[1], -1 / 80.0);
    EXPECT_DOUBLE_EQ(m.skewness[1], 4 * std::sqrt(5) / (6 * std::sqrt(3)));
    // A hundred thousand Sobol' points integrate smooth functions to about 1e-5.
    const PointSet x = warped(*map, make("sobol", points(1 << 17, 3)));
    double last = 0, both = 0, square = 0;
    for (std::size_t i = 0; i < x.count(); ++i) {
        last += x[i][2] / 0x1p17;
        both += x[i][0] * x[i][2] / 0x1p17;
        square += x[i][1] * x[i][1] / 0x1p17;
    }
    EXPECT_NEAR(last, 0.25, 2e-5);
    EXPECT_NEAR(both, 1 / 20.0, 2e-5);
    EXPECT_NEAR(square, 1 / 10.0, 2e-5);
}

// Gaps of sorted uniform numbers are uniform on the simplex, too: an independent method. False
// alarm 1e-4 each.
TEST(Simplex, GapsOfSortedNumbersFollowIt) {
    const DomainPtr domain = simplex_of("simplex", 3)->domain();
    PointSet gaps = make("random", points(50'000, 3));
    for (std::size_t i = 0; i < gaps.count(); ++i) {
        std::ranges::sort(gaps[i]);
        for (std::size_t k = 2; k > 0; --k) gaps[i][k] -= gaps[i][k - 1];
    }
    gaps.domain = domain;
    EXPECT_GT(measure("chi-square", "p_value", gaps), 1e-4);
    for (double& x : gaps.flat()) x *= 0.99;
    EXPECT_LT(measure("chi-square", "p_value", gaps), 1e-4);
}

TEST(Simplex, RefusesWhatHasNoVolume) {
    EXPECT_EQ(error_of([] { simplex_of("simplex", 400); }),
              "usage: --bound: in 400 dimensions the volume is 0; expected [1e-300, 1e+300]");
    EXPECT_EQ(error_of([] { mapping("simplex:bound=0"); }),
              "usage: --bound: 0 is outside [1e-150, 1e+150]");
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping("simplex"), {0.7, 0.7});
              }),
              "input: the point (0.7, 0.7) is outside the domain simplex");
}

}  // namespace stipple::testing::simplex_test
