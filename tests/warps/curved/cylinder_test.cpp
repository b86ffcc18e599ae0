// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::cylinder_test {
namespace {

constexpr double pi = std::numbers::pi;
using Point = std::vector<double>;

}  // namespace

TEST(Cylinder, PointsByHand) {
    const auto side = mapping("cylinder:radius=2,height=4,center=[10,20,30]");
    EXPECT_EQ(image_of(*side, {0, 0}), (Point{12, 20, 28}));
    EXPECT_EQ(image_of(*side, {1, 0.25}), (Point{10, 22, 32}));
    EXPECT_EQ(image_of(*side, {0.75, 0.5}), (Point{8, 20, 31}));
    EXPECT_EQ(image_of(*mapping("cylinder:axis=[0,0,-2]"), {0, 0}), (Point{1, 0, 0.5}));
}

// R = H = 1: each cap has a quarter of the area, the side half.
TEST(Cylinder, CapsAndSideByHand) {
    const auto whole = mapping("cylinder:caps=true");
    EXPECT_EQ(image_of(*whole, {0, 0.3}), (Point{0, 0, -0.5}));
    EXPECT_EQ(image_of(*whole, {0.0625, 0}), (Point{0.5, 0, -0.5}));
    EXPECT_EQ(image_of(*whole, {0.25, 0}), (Point{1, 0, -0.5}));
    EXPECT_EQ(image_of(*whole, {0.5, 0}), (Point{1, 0, 0}));
    EXPECT_EQ(image_of(*whole, {0.75, 0}), (Point{1, 0, 0.5}));
    EXPECT_EQ(image_of(*whole, {0.9375, 0}), (Point{0.5, 0, 0.5}));
    EXPECT_EQ(image_of(*whole, {1, 0}), (Point{0, 0, 0.5}));
}

TEST(Cylinder, RoundTripOverTheWholeSquare) {
    for (const std::string caps : {"", ",caps=true"}) {
        SCOPED_TRACE(caps);
        expect_round_trip(*mapping("cylinder:radius=1" + caps), 1e-15);
        expect_round_trip(*mapping("cylinder:radius=0.1,height=20,axis=[1,2,3]" + caps), 1e-13);
        expect_round_trip(*mapping("cylinder:radius=20,height=0.1,axis=[1,2,3]" + caps), 1e-13);
        expect_round_trip(*mapping("cylinder:radius=0.01,center=[5,-7,3]" + caps), 6e-14);
        expect_round_trip(*mapping("cylinder:radius=1e150,height=1e150" + caps), 1e136);
        expect_round_trip(*mapping("cylinder:radius=1e-150,height=1e-150" + caps), 1e-164);
    }
}

TEST(Cylinder, UnitCoordinatesComeBack) {
    const PointSet cube = telling_points();
    for (const char* spec : {"cylinder:radius=2", "cylinder:radius=2,caps=true"}) {
        const auto map = mapping(spec);
        for (std::size_t i = 0; i < cube.count(); ++i) {
            const Point xi(cube[i].begin(), cube[i].end());
            const Point image = image_of(*map, xi);
            const Point back = inverse_of(*map, image);
            EXPECT_NEAR(back[0], xi[0], 1e-14) << spec << " " << xi[1];
            if (xi[1] < 1 && std::hypot(image[0], image[1]) > 1e-140) {
                EXPECT_NEAR(back[1], xi[1], 1e-14) << spec << " " << xi[0];
            }
        }
    }
}

TEST(Cylinder, DensityIsOneOverTheArea) {
    expect_density_is_one_over_stretch(*mapping("cylinder:radius=2,height=3,axis=[1,2,3]"));
    EXPECT_DOUBLE_EQ(mapping("cylinder:radius=2,height=3")->domain()->measure(), 12 * pi);
    const auto whole = mapping("cylinder:radius=2,height=3,caps=true");
    EXPECT_DOUBLE_EQ(whole->domain()->measure(), 20 * pi);
    EXPECT_DOUBLE_EQ(whole->density(Point{0, 0, 1.5}), 1 / (20 * pi));
    for (const double u : {0.05, 0.13, 0.3, 0.5, 0.65, 0.83, 0.97})
        EXPECT_NEAR(stretch_at(*whole, {u, 0.4}), 20 * pi, 1e-4) << u;
    EXPECT_EQ(mapping("cylinder:radius=2,height=3")->density(Point{0, 0, 1.5}), 0);
}

// False alarm 1e-5 for each right set. Wrong: caps with uniform radius.
TEST(Cylinder, ChiSquareAcceptsItAndRejectsNaiveCaps) {
    EXPECT_GT(p_of_random(*mapping("cylinder:radius=3,axis=[1,2,3]"), 100'000), 1e-5);
    const auto whole = mapping("cylinder:radius=3,caps=true,center=[1,2,3]");
    EXPECT_GT(p_of_random(*whole, 100'000), 1e-5);
    PointSet image = warped(*mapping("cylinder:caps=true"), make("random", points(100'000, 2)));
    for (std::size_t i = 0; i < image.count(); ++i) {
        const double r = std::hypot(image[i][0], image[i][1]);
        if (r > 1 - 1e-12) continue;
        image[i][0] *= r;
        image[i][1] *= r;
    }
    EXPECT_LT(measure("chi-square", "p_value", image), 1e-100);
}

// The fraction of points on the caps is R / (R + H) = 3/4; 5 standard errors of 1e5 points are
// 6.9e-3: false alarm 6e-7.
TEST(Cylinder, CapsHaveTheirShare) {
    const PointSet image =
        warped(*mapping("cylinder:radius=3,caps=true"), make("random", points(100'000, 2)));
    double on_caps = 0;
    for (std::size_t i = 0; i < image.count(); ++i) on_caps += std::abs(image[i][2]) == 0.5;
    EXPECT_NEAR(on_caps / 1e5, 0.75, 6.9e-3);
}

TEST(Cylinder, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("cylinder")->domain()->spec(), "cylinder");
    const DomainPtr whole = mapping("cylinder:caps=true,height=3,axis=[1,0,0]")->domain();
    EXPECT_EQ(whole->spec(), "cylinder:height=3,axis=[1,0,0],caps=true");
    EXPECT_EQ(mapping(whole->spec())->domain()->spec(), whole->spec());
    EXPECT_EQ(whole->bounding_box(), (Box{{-1.5, -1, -1}, {1.5, 1, 1}}));
    const DomainPtr side = mapping("cylinder")->domain();
    EXPECT_TRUE(side->contains(Point{1, 0, 0.5}));
    EXPECT_FALSE(side->contains(Point{1, 0, 0.5 + 1e-13}));
    EXPECT_FALSE(side->contains(Point{1 + 1e-13, 0, 0}));
    EXPECT_FALSE(side->contains(Point{0.5, 0, 0.5}));
    EXPECT_FALSE(side->contains(Point{std::nan(""), 0, 0}));
    EXPECT_TRUE(mapping("cylinder:caps=true")->domain()->contains(Point{0.5, 0, 0.5}));
    EXPECT_FALSE(mapping("cylinder:caps=true")->domain()->contains(Point{0.5, 0, 0.4}));
    EXPECT_EQ(error_of([&] {
                  inverse_of(*mapping("cylinder"), {0, 0, 0});
              }),
              "input: the point (0, 0, 0) is outside the domain cylinder");
}

TEST(Cylinder, RefusesOptionsOutOfRange) {
    EXPECT_EQ(error_of([] { mapping("cylinder:height=0"); }),
              "usage: --height: 0 is outside [1e-150, 1e+150]");
    EXPECT_EQ(error_of([] { mapping("cylinder:center=[0,1e30,0]"); }),
              "usage: --center: 1e+30 is so far from 0 that a radius of 1 is lost in rounding");
}

}  // namespace stipple::testing::cylinder_test
