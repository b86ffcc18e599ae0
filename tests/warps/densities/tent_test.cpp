// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "support/planar.hpp"

namespace stipple::testing::tent_test {
namespace {

/// The map for a given number of coordinates.
std::unique_ptr<Mapping> tent_of(std::string_view text, std::size_t given) {
    const Spec spec = parse_spec(text);
    const Warp& warp = find_warp(spec.name);
    return warp.make(spec.values(warp.options), given, {});
}

}  // namespace

// F(x) = (1 + x)^2 / 2 on the left: 1/8 at -1/2, 1/2 at 0, and its mirror image.
TEST(Tent, PointsByHand) {
    EXPECT_EQ(image_of("tent", {0, 1}), (std::vector{-1.0, 1.0}));
    EXPECT_EQ(image_of("tent", {0.5, 0.125}), (std::vector{0.0, -0.5}));
    EXPECT_EQ(image_of("tent", {0.875, 0.125}), (std::vector{0.5, -0.5}));
    EXPECT_EQ(image_of("tent:radius=[2,4],center=[10,20]", {0.875, 0.125}),
              (std::vector{11.0, 18.0}));
    EXPECT_EQ(image_of("tent:radius=2,center=1", {0, 0.5}), (std::vector{-1.0, 1.0}));
}

TEST(Tent, IsSymmetricToTheLastBit) {
    const PointSet cube = telling_points();
    for (const double x : cube.flat()) {
        const double mirrored = 1 - x;
        if (1 - mirrored != x) continue;  // the mirror image is not exact in double
        EXPECT_EQ(image_of("tent", {x, 0})[0], -image_of("tent", {mirrored, 0})[0]) << x;
    }
}

TEST(Tent, NextToTheMiddleNothingIsLost) {
    const double xi = 0.5 + 0x1p-40;  // x = 2^-40 (1 + 2^-41 ...)
    EXPECT_DOUBLE_EQ(image_of("tent", {xi, 0})[0], 0x1p-40 * (1 + 0x1p-41));
}

TEST(Tent, RoundTripOverTheWholeSquare) {
    expect_round_trip(*mapping("tent"), 1e-14);
    expect_round_trip(*mapping("tent:radius=[0.3,2],center=[5,-7]"), 14e-14);
    expect_round_trip(*mapping("tent:radius=1e150"), 1e136);
    expect_round_trip(*mapping("tent:radius=1e-150"), 1e-164);
    expect_unit_coordinates_back(*mapping("tent:radius=0.3"), 1e-14);
    expect_stands_hostile_points(*mapping("tent"), 1e-14);
}

TEST(Tent, TakesAnyNumberOfCoordinates) {
    for (const std::size_t d : {1U, 2U, 3U}) {
        const auto map = tent_of("tent:radius=2", d);
        EXPECT_EQ(map->cube_dimension(), d);
        EXPECT_EQ(map->domain()->dimension(), d);
        EXPECT_EQ(map->domain()->cube_axes().size(), d);
        EXPECT_DOUBLE_EQ(map->domain()->measure(), std::pow(4, d));
        expect_stands_hostile_points(*map, 2e-14, 2000);
        expect_chi_square_can_tell(*map);
    }
}

TEST(Tent, DensityIsTheTent) {
    const auto map = mapping("tent:radius=[2,1],center=[10,0]");
    EXPECT_DOUBLE_EQ(map->density(std::vector{10.0, 0.0}), 0.5);
    EXPECT_DOUBLE_EQ(map->density(std::vector{11.0, -0.5}), 0.125);
    EXPECT_EQ(map->density(std::vector{12.0, 0.0}), 0);
    EXPECT_EQ(map->density(std::vector{12.5, 0.0}), 0);
    expect_density_is_one_over_jacobian(*map);
}

// Moments of the tent: variance r^2 / 6, E|x| = r / 3, no covariance. Five standard errors at n =
// 1e5.
TEST(Tent, MomentsAreThoseOfTheTent) {
    const PlaneMoments m = plane_moments(*mapping("tent:radius=[1,3],center=[0,5]"));
    EXPECT_NEAR(m.x, 0, 0.0065);
    EXPECT_NEAR(m.y, 5, 0.0195);
    EXPECT_NEAR(m.xx, 1. / 6, 0.0032);
    EXPECT_NEAR(m.yy, 9. / 6, 0.029);
    EXPECT_NEAR(m.xy, 0, 0.008);
}

TEST(Tent, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("tent")->domain()->spec(), "tent");
    const DomainPtr domain = mapping("tent:center=[1,0],radius=2")->domain();
    EXPECT_EQ(domain->spec(), "tent:radius=2,center=[1,0]");
    EXPECT_EQ(mapping(domain->spec())->domain()->spec(), domain->spec());
    EXPECT_EQ(domain->bounding_box(), (Box{{-1, -2}, {3, 2}}));
    EXPECT_TRUE(domain->contains(std::vector{3.0, -2.0}));
    EXPECT_FALSE(domain->contains(std::vector{3.0 + 1e-13, 0.0}));
    EXPECT_FALSE(domain->contains(std::vector{NAN, 0.0}));
    std::vector<double> cube(2);
    domain->to_cube(std::vector{0.0, 1.0}, cube);
    EXPECT_EQ(cube, (std::vector{0.125, 0.875}));
}

TEST(Tent, RefusesWhatIsNoTent) {
    const auto error = [](std::string_view spec) { return error_of([&] { mapping(spec); }); };
    EXPECT_EQ(error("tent:radius=0"), "usage: --radius: 0 is outside [1e-150, 1e+150]");
    EXPECT_EQ(
        error("tent:radius=[1,2,3]"),
        "usage: --radius: 3 numbers for 2 coordinates; expected one for all, or one for each");
    EXPECT_EQ(error("tent:center=1e30"),
              "usage: --center: 1e+30 is so far from 0 that a radius of 1 is lost in rounding");
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping("tent"), {1.5, 0});
              }),
              "input: the point (1.5, 0) is outside the domain tent");
}

}  // namespace stipple::testing::tent_test
