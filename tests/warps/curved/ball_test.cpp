// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::ball_test {
namespace {

constexpr double pi = std::numbers::pi;
using Point = std::vector<double>;

}  // namespace

TEST(Ball, PointsByHand) {
    const auto ball = mapping("ball");
    EXPECT_EQ(image_of(*ball, {0, 0.3, 0.3}), (Point{0, 0, 0}));
    EXPECT_EQ(image_of(*ball, {0.125, 0, 0}), (Point{0, 0, 0.5}));
    EXPECT_EQ(image_of(*ball, {0.125, 0.5, 0.25}), (Point{0, 0.5, 0}));
    EXPECT_EQ(image_of(*ball, {1, 1, 0}), (Point{0, 0, -1}));
    EXPECT_EQ(image_of(*mapping("ball:radius=4,center=[10,20,30]"), {0.125, 0.5, 0.5}),
              (Point{8, 20, 30}));
}

TEST(Ball, RoundTripOverTheWholeCube) {
    expect_round_trip(*mapping("ball"), 1e-15);
    expect_round_trip(*mapping("ball:radius=1e-3,center=[5,-7,3]"), 1e-14);
    expect_round_trip(*mapping("ball:radius=1e90"), 1e75);
    expect_round_trip(*mapping("ball:radius=1e-90"), 1e-105);
}

TEST(Ball, UnitCoordinatesComeBackAroundTheOrigin) {
    const PointSet cube = telling_points(3);
    const auto ball = mapping("ball:radius=0.3");
    for (std::size_t i = 0; i < cube.count(); ++i) {
        const Point xi(cube[i].begin(), cube[i].end());
        const Point image = image_of(*ball, xi);
        const Point back = inverse_of(*ball, image);
        ASSERT_NEAR(back[0], xi[0], 1e-14);
        if (xi[0] < 1e-250) continue;
        ASSERT_NEAR(back[1], xi[1], 1e-14) << xi[0];
        if (xi[2] < 1 && xi[1] > 1e-250 && xi[1] < 1) {
            ASSERT_NEAR(back[2], xi[2], 1e-14) << xi[0] << " " << xi[1];
        }
    }
    EXPECT_EQ(inverse_of(*ball, {0, 0, 0}), (Point{0, 0.5, 0})) << "all directions meet there";
}

TEST(Ball, DensityIsOneOverTheVolume) {
    expect_density_is_one_over_stretch(*mapping("ball:radius=2,center=[1,2,3]"));
    const auto ball = mapping("ball:radius=2");
    EXPECT_DOUBLE_EQ(ball->domain()->measure(), 32 * pi / 3);
    EXPECT_DOUBLE_EQ(ball->density(Point{1, 1, 1}), 3 / (32 * pi));
    EXPECT_EQ(ball->density(Point{2, 1, 0}), 0);
}

// False alarm 1e-5. Wrong: the exponent 1/3 increased by 3 %.
TEST(Ball, ChiSquareAcceptsItAndRejectsWrongRadii) {
    EXPECT_GT(p_of_random(*mapping("ball:radius=2,center=[1,2,3]"), 200'000), 1e-5);
    PointSet cube = make("random", points(1'000'000, 3));
    for (std::size_t i = 0; i < cube.count(); ++i) cube[i][0] = std::pow(cube[i][0], 1.03);
    EXPECT_LT(measure("chi-square", "p_value", warped(*mapping("ball"), cube)), 1e-5);
}

// E r^2 = 3/5; its standard error at 1e5 points is 8.3e-4; 5 of them, false alarm 6e-7.
TEST(Ball, MeanSquare) {
    const PointSet image = warped(*mapping("ball"), make("random", points(100'000, 3)));
    double sum = 0;
    for (const double x : image.flat()) sum += x * x;
    EXPECT_NEAR(sum / 1e5, 0.6, 4.2e-3);
}

TEST(Ball, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("ball")->domain()->spec(), "ball");
    const DomainPtr ball = mapping("ball:radius=2,center=[1,0,0]")->domain();
    EXPECT_EQ(ball->spec(), "ball:radius=2,center=[1,0,0]");
    EXPECT_EQ(mapping(ball->spec())->domain()->spec(), ball->spec());
    EXPECT_EQ(ball->bounding_box(), (Box{{-1, -2, -2}, {3, 2, 2}}));
    EXPECT_TRUE(ball->contains(Point{3, 0, 0}));
    EXPECT_FALSE(ball->contains(Point{3 + 1e-13, 0, 0}));
    EXPECT_FALSE(ball->contains(Point{std::nan(""), 0, 0}));
    Point cube(3);
    ball->to_cube(Point{1, 1, 0}, cube);
    EXPECT_EQ(cube, (Point{0.125, 0.5, 0.25}));
    EXPECT_EQ(error_of([&] {
                  inverse_of(*mapping("ball"), {1, 1, 0});
              }),
              "input: the point (1, 1, 0) is outside the domain ball");
}

TEST(Ball, RefusesOptionsOutOfRange) {
    EXPECT_EQ(error_of([] { mapping("ball:radius=0"); }),
              "usage: --radius: 0 is outside [1e-90, 1e+90]");
    EXPECT_EQ(error_of([] { mapping("ball:center=[0,0]"); }),
              "usage: --center: expected 3 numbers, x,y,z; 2 given");
}

}  // namespace stipple::testing::ball_test
