// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::cone_test {
namespace {

constexpr double pi = std::numbers::pi;
using Point = std::vector<double>;

}  // namespace

TEST(Cone, PointsByHand) {
    const auto cone = mapping("cone:half-angle=60");  // cos theta = 1 - xi0 / 2
    EXPECT_EQ(image_of(*cone, {0, 0.7}), (Point{0, 0, 1}));
    const Point rim = image_of(*cone, {1, 0.25});
    EXPECT_NEAR(rim[0], 0, 1e-16);
    EXPECT_NEAR(rim[1], std::sqrt(0.75), 2e-16);
    EXPECT_NEAR(rim[2], 0.5, 2e-16);
    EXPECT_EQ(image_of(*mapping("cone:half-angle=180"), {1, 0}), (Point{0, 0, -1}));
    EXPECT_EQ(image_of(*mapping("cone:half-angle=90"), {1, 0}), (Point{1, 0, 0}));
    const Point ahead = image_of(*mapping("cone:axis=[3,0,4]"), {0, 0});
    EXPECT_NEAR(ahead[0], 0.6, 2e-16);
    EXPECT_NEAR(ahead[2], 0.8, 2e-16);
}

// sin(theta) = 2 sin(alpha/2) sqrt(xi0) for thin cones; 1 - cos(alpha) would be 0.
TEST(Cone, ThinConesKeepTheirDigits) {
    for (const double degrees : {1e-6, 1e-9, 1e-100}) {
        const auto cone = mapping(fmt::format("cone:half-angle={}", degrees));
        const double alpha = degrees * pi / 180;
        EXPECT_NEAR(cone->domain()->measure() / (pi * alpha * alpha), 1, 1e-15);
        const Point p = image_of(*cone, {0.25, 0});
        EXPECT_NEAR(p[0] / (alpha / 2), 1, 1e-15) << degrees;
        EXPECT_NEAR(inverse_of(*cone, p)[0], 0.25, 1e-15) << degrees;
        EXPECT_TRUE(cone->domain()->contains(Point{alpha, 0, 1}));
        EXPECT_FALSE(cone->domain()->contains(Point{alpha * (1 + 1e-14), 0, 1}));
    }
}

TEST(Cone, RefusesConesThinnerThanTheRounding) {
    EXPECT_EQ(error_of([] { mapping("cone:half-angle=1e-11,axis=[1,2,3]"); }),
              "usage: --half-angle: 1e-11 is below 1e-10, the minimum for an axis other than a "
              "coordinate axis");
    EXPECT_GT(p_of_random(*mapping("cone:half-angle=1e-10,axis=[1,2,3]"), 100'000), 1e-5);
    EXPECT_GT(p_of_random(*mapping("cone:half-angle=1e-100,axis=[0,0,-2]"), 100'000), 1e-5);
}

TEST(Cone, RoundTripOverTheWholeSquare) {
    for (const std::string alpha :
         {"30", "1e-10", "1e-6", "89.999999", "90", "150", "179.9999999", "180"})
        for (const std::string axis : {"0,0,1", "0,0,-1", "1,2,-3", "1e-9,0,-1"}) {
            SCOPED_TRACE(alpha + " about " + axis);
            expect_round_trip(*mapping("cone:half-angle=" + alpha + ",axis=[" + axis + "]"), 2e-15);
        }
}

TEST(Cone, UnitCoordinatesComeBackAboutZ) {
    const PointSet cube = telling_points();
    for (const std::string alpha : {"30", "1e-12", "90", "179"}) {
        const auto map = mapping("cone:half-angle=" + alpha);
        for (std::size_t i = 0; i < cube.count(); ++i) {
            const Point xi(cube[i].begin(), cube[i].end());
            const Point image = image_of(*map, xi);
            const Point back = inverse_of(*map, image);
            EXPECT_NEAR(back[0], xi[0], 1e-14) << alpha << " " << xi[1];
            if (xi[1] < 1 && xi[0] > 1e-250) {
                EXPECT_NEAR(back[1], xi[1], 1e-14) << alpha << " " << xi[0];
            }
        }
    }
}

TEST(Cone, DensityIsOneOverTheSolidAngle) {
    expect_density_is_one_over_stretch(*mapping("cone"));
    expect_density_is_one_over_stretch(*mapping("cone:half-angle=150,axis=[1,2,-3]"));
    const auto cone = mapping("cone:half-angle=60");
    EXPECT_NEAR(cone->domain()->measure(), pi, 1e-15);
    EXPECT_NEAR(cone->density(Point{0, 0, 1}), 1 / pi, 1e-15);
    EXPECT_EQ(cone->density(Point{1, 0, 0}), 0);
    EXPECT_EQ(cone->density(Point{0, 0, 0.5}), 0);
}

// False alarm 1e-5 for each right set. Wrong: 1 % more angle is 2 % more solid angle, as large a
// tilt of the height as xi0^1.01.
TEST(Cone, ChiSquareAcceptsItAndRejectsATilt) {
    EXPECT_GT(p_of_random(*mapping("cone:half-angle=1e-3"), 100'000), 1e-5);
    EXPECT_GT(p_of_random(*mapping("cone:half-angle=120,axis=[1,1,1]"), 100'000), 1e-5);
    PointSet tilted = make("random", points(1'000'000, 2));
    for (std::size_t i = 0; i < tilted.count(); ++i) tilted[i][0] = std::pow(tilted[i][0], 1.02);
    EXPECT_LT(measure("chi-square", "p_value", warped(*mapping("cone"), tilted)), 1e-5);
}

// The mean direction is cos^2(alpha/2) times the axis: 3/4 for 60 degrees; standard error of 1e5
// points 5e-4; 5 of them, false alarm 6e-7.
TEST(Cone, MeanDirection) {
    const PointSet image =
        warped(*mapping("cone:half-angle=60,axis=[2,0,0]"), make("random", points(100'000, 2)));
    double sum = 0;
    for (std::size_t i = 0; i < image.count(); ++i) sum += image[i][0];
    EXPECT_NEAR(sum / 1e5, 0.75, 2.5e-3);
}

TEST(Cone, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("cone")->domain()->spec(), "cone");
    const DomainPtr cone = mapping("cone:axis=[1,0,0],half-angle=60")->domain();
    EXPECT_EQ(cone->spec(), "cone:half-angle=60,axis=[1,0,0]");
    EXPECT_EQ(mapping(cone->spec())->domain()->spec(), cone->spec());
    const Box box = cone->bounding_box();
    EXPECT_NEAR(box.low[0], 0.5, 1e-15);
    EXPECT_EQ(box.high[0], 1);
    EXPECT_NEAR(box.low[1], -std::sqrt(0.75), 1e-15);
    EXPECT_NEAR(box.high[2], std::sqrt(0.75), 1e-15);
    EXPECT_FALSE(cone->contains(Point{0.4999, 0, std::sqrt(1 - 0.4999 * 0.4999)}));
    EXPECT_TRUE(cone->contains(Point{0.5001, 0, std::sqrt(1 - 0.5001 * 0.5001)}));
    EXPECT_FALSE(cone->contains(Point{std::nan(""), 0, 0}));
    EXPECT_EQ(error_of([&] {
                  inverse_of(*mapping("cone"), {0, 0, -1});
              }),
              "input: the point (0, 0, -1) is outside the domain cone");
}

TEST(Cone, RefusesOptionsOutOfRange) {
    EXPECT_EQ(error_of([] { mapping("cone:half-angle=181"); }),
              "usage: --half-angle: 181 is outside [1e-150, 180]");
    EXPECT_EQ(error_of([] { mapping("cone:axis=[0,0,0]"); }),
              "usage: --axis: 0,0,0 has no direction");
    EXPECT_EQ(error_of([] { mapping("cone:axis=[0,1]"); }),
              "usage: --axis: expected 3 numbers, x,y,z; 2 given");
}

}  // namespace stipple::testing::cone_test
