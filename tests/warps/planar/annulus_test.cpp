// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/planar.hpp"

namespace stipple::testing::annulus_test {

TEST(Annulus, PointsByHand) {
    EXPECT_EQ(image_of("annulus", {0, 0}), (std::vector{0.5, 0.0}));
    EXPECT_EQ(image_of("annulus", {0, 0.25}), (std::vector{0.0, 0.5}));
    EXPECT_EQ(image_of("annulus", {1, 0.5}), (std::vector{-1.0, 0.0}));
    // r^2 = 9 + 0.4375 (25 - 9) = 16
    EXPECT_EQ(image_of("annulus:inner=3,radius=5,center=[10,20]", {0.4375, 0.75}),
              (std::vector{10.0, 16.0}));
}

TEST(Annulus, WithoutAHoleIsThePolarDisk) {
    const PointSet cube = telling_points();
    for (const std::string place : {"radius=1", "radius=3,center=[5,-7]"}) {
        const PointSet ring = warped(*mapping("annulus:inner=0," + place), cube);
        EXPECT_TRUE(
            std::ranges::equal(ring.flat(), warped(*mapping("disk:" + place), cube).flat()));
    }
}

TEST(Annulus, RoundTripOverTheWholeSquare) {
    for (const std::string inner : {"0", "1e-9", "0.5", "0.999999"}) {
        expect_round_trip(*mapping("annulus:inner=" + inner), 1e-14);
        expect_round_trip(*mapping("annulus:radius=2,center=[5,-7],inner=" + inner), 14e-14);
    }
    expect_round_trip(*mapping("annulus:inner=1e149,radius=1e150"), 1e136);
    expect_round_trip(*mapping("annulus:inner=5e-151,radius=1e-150"), 1e-164);
    expect_unit_coordinates_back(*mapping("annulus"), 1e-14);
    expect_unit_coordinates_back(*mapping("annulus:inner=0.999"), 1e-11);
}

TEST(Annulus, StandsHostilePoints) {
    expect_stands_hostile_points(*mapping("annulus"), 1e-14);
    expect_stands_hostile_points(*mapping("annulus:inner=0"), 1e-14);
}

TEST(Annulus, DensityIsOneOverTheArea) {
    const auto map = mapping("annulus:inner=1,radius=2,center=[1,0]");
    EXPECT_DOUBLE_EQ(map->domain()->measure(), 3 * std::numbers::pi);
    EXPECT_DOUBLE_EQ(map->density(std::vector{2.5, 0.0}), 1 / (3 * std::numbers::pi));
    EXPECT_EQ(map->density(std::vector{1.5, 0.0}), 0) << "in the hole";
    EXPECT_EQ(map->density(std::vector{3.1, 0.0}), 0);
    for (const char* spec : {"annulus", "annulus:inner=3,radius=5,center=[10,20]"}) {
        expect_density_is_one_over_jacobian(*mapping(spec));
        expect_measure_is_share_of_box(*mapping(spec)->domain());
    }
}

TEST(Annulus, IsUniformByArea) {
    expect_chi_square_can_tell(*mapping("annulus:inner=0.8"));
    // Variance (R^2 + q^2) / 4 along each axis; standard errors below 4e-3 and 1e-2; 5 of them.
    const PlaneMoments m = plane_moments(*mapping("annulus:inner=1,radius=2"));
    EXPECT_NEAR(m.x, 0, 0.018);
    EXPECT_NEAR(m.y, 0, 0.018);
    EXPECT_NEAR(m.xx, 1.25, 0.02);
    EXPECT_NEAR(m.yy, 1.25, 0.02);
    EXPECT_NEAR(m.xy, 0, 0.015);
}

TEST(Annulus, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("annulus")->domain()->spec(), "annulus");
    const DomainPtr ring = mapping("annulus:center=[1,0],radius=2,inner=1")->domain();
    EXPECT_EQ(ring->spec(), "annulus:inner=1,radius=2,center=[1,0]");
    EXPECT_EQ(mapping(ring->spec())->domain()->spec(), ring->spec());
    EXPECT_TRUE(ring->contains(std::vector{3.0, 0.0}));
    EXPECT_TRUE(ring->contains(std::vector{2.0, 0.0}));
    EXPECT_FALSE(ring->contains(std::vector{2.0 - 1e-13, 0.0}));
    EXPECT_FALSE(ring->contains(std::vector{3.0 + 1e-13, 0.0}));
    EXPECT_FALSE(ring->contains(std::vector{NAN, 0.0}));
    EXPECT_FALSE(ring->contains(std::vector{1e300, 1e300}));
    EXPECT_EQ(ring->bounding_box(), (Box{{-1, -2}, {3, 2}}));
    std::vector<double> cube(2);
    ring->to_cube(std::vector{1.0, -std::sqrt(2.5)}, cube);
    EXPECT_NEAR(cube[0], 0.5, 1e-15);
    EXPECT_EQ(cube[1], 0.75);
}

TEST(Annulus, RefusesWhatIsNoAnnulus) {
    const auto error = [](std::string_view spec) { return error_of([&] { mapping(spec); }); };
    EXPECT_EQ(error("annulus:inner=2"),
              "usage: --inner: 2 is not below --radius 1, or too close to it");
    EXPECT_NE(error("annulus:inner=1"), "");
    EXPECT_EQ(error("annulus:inner=-1"), "usage: --inner: -1 is outside [0, 1e+150]");
    EXPECT_EQ(error("annulus:center=[1]"), "usage: --center: expected 2 numbers, x,y; 1 given");
    EXPECT_EQ(error("annulus:center=[0,1e30]"),
              "usage: --center: 1e+30 is so far from 0 that a ring of 0.5 is lost in rounding");
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping("annulus"), {0.25, 0});
              }),
              "input: the point (0.25, 0) is outside the domain annulus");
}

}  // namespace stipple::testing::annulus_test
