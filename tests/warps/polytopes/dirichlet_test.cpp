// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/warping.hpp"

namespace stipple::testing::dirichlet_test {
namespace {

/// The map for a given number of coordinates.
std::unique_ptr<Mapping> dirichlet_of(std::string_view text, std::size_t given) {
    const Spec spec = parse_spec(text);
    const Warp& warp = find_warp(spec.name);
    return warp.make(spec.values(warp.options), given, {});
}

}  // namespace

// With all alpha 1 it is uniform: P(X1 > x) = (1 - x)^2.
TEST(Dirichlet, NumbersByHand) {
    const auto p = image_of("dirichlet", {0.75, 0.5});
    ASSERT_EQ(p.size(), 3U);
    EXPECT_NEAR(p[0], 0.5, 1e-15);
    EXPECT_NEAR(p[1], 0.25, 1e-15);
    EXPECT_NEAR(p[2], 0.25, 1e-15);
    // Two coordinates have the beta distribution (2, 2), with quantile 1/4 at 5/32.
    const auto q = image_of("dirichlet:alpha=[2,2]", {5 / 32.0});
    EXPECT_NEAR(q[0], 0.25, 1e-15);
    EXPECT_NEAR(q[1], 0.75, 1e-15);
}

TEST(Dirichlet, IsTheSimplexWithWhatIsLeftOver) {
    const auto simplex = mapping("simplex");
    const auto map = mapping("dirichlet");
    const PointSet cube = make("random", points(1000, 2));
    const PointSet a = warped(*simplex, cube);
    const PointSet b = warped(*map, cube);
    for (std::size_t i = 0; i < a.count(); ++i)
        for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(a[i][k], b[i][k], 1e-14);
}

TEST(Dirichlet, BothWaysInAnyDimension) {
    for (const char* spec :
         {"dirichlet:alpha=[2,3]", "dirichlet:alpha=[0.5,1,4]", "dirichlet:alpha=[30,0.2,5,1]"}) {
        const auto map = dirichlet_of(spec, 1);
        expect_round_trip(*map, 1e-12);
        const PointSet image = warped(*map, make("random", points(1000, map->cube_dimension())));
        for (std::size_t i = 0; i < image.count(); ++i)
            EXPECT_NEAR(std::accumulate(image[i].begin(), image[i].end(), 0.0), 1, 1e-15);
    }
    EXPECT_EQ(dirichlet_of("dirichlet:alpha=3", 5)->domain()->dimension(), 6U);
}

// Density with respect to area: 2 / sqrt(3) in the uniform triangle of three coordinates, with area
// sqrt(3) / 2; with alpha = (2, 2): 6 x y / sqrt(2).
TEST(Dirichlet, DensityIsOneOverTheStretch) {
    EXPECT_DOUBLE_EQ(mapping("dirichlet")->domain()->measure(), std::sqrt(3) / 2);
    EXPECT_NEAR(mapping("dirichlet")->density(std::vector{0.2, 0.3, 0.5}), 2 / std::sqrt(3), 1e-14);
    EXPECT_NEAR(dirichlet_of("dirichlet:alpha=2", 1)->density(std::vector{0.25, 0.75}),
                6 * 0.1875 / std::sqrt(2), 1e-14);
    expect_density_is_one_over_stretch(*mapping("dirichlet:alpha=[2,3,4]"));
    expect_density_is_one_over_stretch(*dirichlet_of("dirichlet:alpha=[1,2,1.5,4]", 3), 1e-5);
}

// alpha = (1, 2, 3): means 1/6, 1/3, 1/2, variance of the first 5 / 252, covariance with the second
// -2 / 252.
TEST(Dirichlet, MomentsByHandAndBySumming) {
    const auto map = mapping("dirichlet:alpha=[1,2,3]");
    const auto m = *map->domain()->moments();
    EXPECT_DOUBLE_EQ(m.mean[1], 1 / 3.0);
    EXPECT_DOUBLE_EQ(m.covariance[0], 5 / 252.0);
    EXPECT_DOUBLE_EQ(m.covariance[1], -2 / 252.0);
    const PointSet x = warped(*map, make("sobol", points(1 << 15, 2)));
    double last = 0, both = 0;
    for (std::size_t i = 0; i < x.count(); ++i) {
        last += x[i][2] / 0x1p15;
        both += x[i][0] * x[i][1] / 0x1p15;
    }
    EXPECT_NEAR(last, 0.5, 1e-4);
    EXPECT_NEAR(both, 1 / 18.0 - 2 / 252.0, 1e-4);
}

TEST(Dirichlet, DomainIsTheSurfaceWhereCoordinatesSumTo1) {
    const DomainPtr domain = mapping("dirichlet")->domain();
    EXPECT_TRUE(domain->contains(std::vector{0.25, 0.25, 0.5}));
    EXPECT_FALSE(domain->contains(std::vector{0.25, 0.25, 0.5001}));
    EXPECT_FALSE(domain->contains(std::vector{-0.25, 0.75, 0.5}));
    EXPECT_EQ(domain->cube_dimension(), 2U);
    EXPECT_EQ(mapping("dirichlet:alpha=[1,2,3]")->domain()->spec(), "dirichlet:alpha=[1,2,3]");
}

TEST(Dirichlet, RefusesParametersOutOfRange) {
    const auto refusal = [](std::string_view spec) { return error_of([&] { mapping(spec); }); };
    EXPECT_EQ(refusal("dirichlet:alpha=[1,0]"), "usage: --alpha: 0 is outside [0.1, 1e6]");
    EXPECT_EQ(refusal("dirichlet:alpha=[6e5,6e5]"), "usage: --alpha: the sum is above 1e6");
    EXPECT_EQ(error_of([] { dirichlet_of("dirichlet", 200); }),
              "usage: --alpha: 201 coordinates; expected 2 to 150");
}

}  // namespace stipple::testing::dirichlet_test
