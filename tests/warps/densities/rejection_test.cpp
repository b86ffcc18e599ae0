// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/chain.hpp"
#include "support/warping.hpp"

namespace stipple::testing::rejection_test {

TEST(Rejection, KeepsWhatIsBelowTheFormulaByHand) {
    const auto map = mapping("rejection:density=x,bound=2,bounds=0..2");
    EXPECT_EQ(map->cube_dimension(), 2U);
    EXPECT_TRUE(map->drops());
    std::vector<double> image(4);
    std::vector<std::uint8_t> keep(4, 7);
    map->forward(std::vector{0.5, 0.49, 0.5, 0.5, 0.25, 0.24, 0.0, 0.0}, image, keep);
    EXPECT_EQ(image, (std::vector{1.0, 1.0, 0.5, 0.0}));
    EXPECT_EQ(keep, (std::vector<std::uint8_t>{1, 0, 1, 0}));
}

// The efficiency is pi / 4 in 2-D. In 3-D, 0.1 <= |v| <= 1: (pi / 6) (1 - 0.001) = 0.5230752.
// 400 000 points: 5 standard deviations are 0.0033 and 0.004; false alarm 1e-6 each.
TEST(Rejection, EfficiencyIsTheIntegralOverTheBound) {
    const auto disk = mapping("rejection:density=[x*x+y*y<1?3:0],bound=3,bounds=[-1..1,-1..1]");
    const PointSet kept = warped(*disk, make("random", points(400'000, 3)));
    EXPECT_NEAR(static_cast<double>(kept.count()) / 4e5, M_PI / 4, 0.0033);
    const auto shell = mapping(
        "rejection:density=[x*x+y*y+z*z<=1 && x*x+y*y+z*z>=0.01],bounds=[-1..1,-1..1,-1..1]");
    const PointSet in_shell = warped(*shell, make("random", points(400'000, 4)));
    EXPECT_NEAR(static_cast<double>(in_shell.count()) / 4e5, 0.5230752, 0.004);
}

// f = x + y has mean 7/12; for 100 000 kept points, 5 standard errors are 0.0044.
TEST(Rejection, PointsFollowTheFormula) {
    const auto map = mapping("rejection:density=x+y,bound=2");
    const PointSet kept = warped(*map, make("random", points(100'000, 3)));
    double x = 0;
    double y = 0;
    for (std::size_t i = 0; i < kept.count(); ++i) {
        x += kept[i][0] / static_cast<double>(kept.count());
        y += kept[i][1] / static_cast<double>(kept.count());
    }
    EXPECT_NEAR(x, 7 / 12.0, 0.0062);
    EXPECT_NEAR(y, 7 / 12.0, 0.0062);
    EXPECT_NEAR(map->density(std::vector{0.5, 0.25}), 0.75, 1e-12);
    EXPECT_NEAR(map->domain()->probability({{0, 0}, {0.5, 0.5}}).value, 1 / 8.0, 1e-9);
}

TEST(Rejection, DensityOfWhatIsNarrowIsOverItsIntegral) {
    const double area = M_PI * 1e-4;
    const auto disk =
        mapping("rejection:density=[(x-0.31)^2+(y-0.7)^2<1e-4?1:0.001],bounds=[0..1,0..1]");
    EXPECT_NEAR(disk->density(std::vector{0.31, 0.7}), 1 / (area + 0.001 * (1 - area)), 0.05);
    const auto bump = mapping("rejection:density=[abs(x-0.31)<1e-4?1:0.001],bounds=0..1");
    EXPECT_NEAR(bump->density(std::vector{0.31}), 1 / (2e-4 + 0.001 * (1 - 2e-4)), 1e-3);
}

TEST(Rejection, NamesThePlaceWhereTheBoundIsBroken) {
    const auto map = mapping("rejection:density=x+y,bound=1");
    std::vector<double> image(2);
    std::vector<std::uint8_t> keep(1);
    EXPECT_EQ(error_of([&] {
                  map->forward(std::vector{0.75, 0.5, 0.1}, image, keep);
              }),
              "usage: --bound: the density is 1.25 at (0.75, 0.5), above the bound 1");
}

TEST(Rejection, RefusesBadOptionsAndHasNoWayBack) {
    EXPECT_EQ(error_of([] { mapping("rejection"); }),
              "usage: --density: no formula given; expected one such as 'exp(-x*x - y*y)'");
    EXPECT_EQ(error_of([] { mapping("rejection:density=x,bound=0"); }),
              "usage: --bound: 0 is outside (0, inf)");
    EXPECT_EQ(error_of([] { mapping("rejection:density=x,bounds=[0..1,0..1,0..1,0..1]"); }),
              "usage: --bounds: 4 ranges; expected at most 3");
    std::vector<double> image(2);
    std::vector<std::uint8_t> keep(1);
    EXPECT_EQ(
        error_of([&] {
            mapping("rejection:density=x-1")->forward(std::vector{0.0, 0.0, 0.0}, image, keep);
        }),
        "usage: --density: x-1 is -1 at (0, 0); a density must be finite and not below 0");
    EXPECT_NE(error_of([] { inverse_of(*mapping("rejection:density=x"), {0, 0}); }), "");
}

TEST(Rejection, DomainIsTheLawNotTheMethod) {
    const DomainPtr domain =
        mapping("rejection:density=[x + y],bound=7,bounds=[0..2,0..1]")->domain();
    EXPECT_EQ(domain->spec(), "rejection:density=x+y,bounds=[0..2,0..1]");
    EXPECT_EQ(parse_domain(domain->spec(), 2)->spec(), domain->spec());
    EXPECT_FALSE(domain->even());
}

}  // namespace stipple::testing::rejection_test
