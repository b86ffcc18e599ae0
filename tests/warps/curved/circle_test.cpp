// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::circle_test {
namespace {

constexpr double pi = std::numbers::pi;
using Point = std::vector<double>;

/// Mean of cos 4 theta over the points of a unit circle.
double mean_of_cos_4_theta(const PointSet& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.count(); ++i)
        sum += std::cos(4 * std::atan2(image[i][1], image[i][0]));
    return sum / static_cast<double>(image.count());
}

}  // namespace

TEST(Circle, PointsByHand) {
    const auto circle = mapping("circle");
    EXPECT_EQ(circle->cube_dimension(), 1U);
    EXPECT_EQ(image_of(*circle, {0}), (Point{1, 0}));
    EXPECT_EQ(image_of(*circle, {0.25}), (Point{0, 1}));
    EXPECT_EQ(image_of(*circle, {0.625}), (Point{-std::sqrt(0.5), -std::sqrt(0.5)}));
    EXPECT_EQ(image_of(*circle, {1}), (Point{1, 0}));
    EXPECT_EQ(image_of(*mapping("circle:radius=2,center=[10,20]"), {0.75}), (Point{10, 18}));
    const auto square = mapping("circle:method=square-normalize");
    EXPECT_EQ(square->cube_dimension(), 2U);
    EXPECT_EQ(image_of(*square, {0.75, 0.5}), (Point{1, 0}));
    const Point p = image_of(*square, {0.875, 0});  // the direction of (3/4, -1)
    EXPECT_DOUBLE_EQ(p[0], 0.6);
    EXPECT_DOUBLE_EQ(p[1], -0.8);
}

TEST(Circle, RoundTripOverTheWholeInterval) {
    expect_round_trip(*mapping("circle"), 1e-15);
    expect_round_trip(*mapping("circle:radius=1e-3,center=[5,-7]"), 1e-14);
    expect_round_trip(*mapping("circle:radius=1e150"), 1e135);
    expect_round_trip(*mapping("circle:radius=1e-150"), 1e-165);
    const PointSet cube = telling_points(1);
    for (std::size_t i = 0; i < cube.count(); ++i) {
        const double xi = cube[i][0];
        const Point back = inverse_of(*mapping("circle"), image_of(*mapping("circle"), {xi}));
        EXPECT_NEAR(back[0], xi == 1 ? 0 : xi, 1e-15);
    }
}

TEST(Circle, SquareNormalizeDropsTheCentreAlone) {
    const auto square = mapping("circle:method=square-normalize");
    EXPECT_TRUE(square->drops());
    EXPECT_FALSE(mapping("circle")->drops());
    const Point cube = {0.5, 0.5, 0.5, std::nextafter(0.5, 1), 0, 0};
    Point image(6);
    std::vector<std::uint8_t> keep(3, 7);
    square->forward(cube, image, keep);
    EXPECT_EQ(keep, (std::vector<std::uint8_t>{0, 1, 1}));
    for (const double x : image) EXPECT_TRUE(std::isfinite(x));
    EXPECT_EQ(
        error_of([&] {
            inverse_of(*square, {1, 0});
        }),
        "usage: --inverse: method square-normalize maps 2 coordinates to 1; it has no inverse");
}

TEST(Circle, DensityByHandAndByStretch) {
    expect_density_is_one_over_stretch(*mapping("circle:radius=3,center=[1,2]"));
    EXPECT_DOUBLE_EQ(mapping("circle:radius=3")->density(Point{0, 3}), 1 / (6 * pi));
    EXPECT_EQ(mapping("circle:radius=3")->density(Point{0, 2}), 0);
    const auto square = mapping("circle:radius=2,method=square-normalize");
    EXPECT_DOUBLE_EQ(square->density(Point{2, 0}), 1 / 16.);
    EXPECT_DOUBLE_EQ(square->density(Point{-std::sqrt(2), std::sqrt(2)}), 1 / 8.);
    EXPECT_EQ(square->density(Point{1, 0}), 0);
}

// The integral of the biased density over the circle, by the trapezoid rule at 2^16 angles, whose
// error at the four kinks is below 1e-8.
TEST(Circle, BiasedDensityIntegratesToOne) {
    const auto square = mapping("circle:method=square-normalize");
    double sum = 0;
    for (int i = 0; i < 65536; ++i) {
        const double theta = 2 * pi * i / 65536;
        sum += square->density(Point{std::cos(theta), std::sin(theta)});
    }
    EXPECT_NEAR(sum * 2 * pi / 65536, 1, 1e-8);
}

// E cos 4 theta = 3 - pi for the biased method, 0 for the other: the standard error of 1e5 points
// is below 2.3e-3; 5 of them, false alarm 6e-7 each.
TEST(Circle, SquareNormalizeIsBiasedToTheDiagonals) {
    const auto right = warped(*mapping("circle"), make("random", points(100'000, 1)));
    EXPECT_NEAR(mean_of_cos_4_theta(right), 0, 0.0115);
    const auto wrong =
        warped(*mapping("circle:method=square-normalize"), make("random", points(100'000, 2)));
    EXPECT_NEAR(mean_of_cos_4_theta(wrong), 3 - pi, 0.0115);
}

// False alarm 1e-5.
TEST(Circle, ChiSquareAcceptsAnglesAndRejectsTheSquare) {
    EXPECT_GT(p_of_random(*mapping("circle:radius=2,center=[3,4]"), 100'000), 1e-5);
    EXPECT_LT(p_of_random(*mapping("circle:method=square-normalize"), 100'000), 1e-100);
}

TEST(Circle, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("circle:method=square-normalize")->domain()->spec(), "circle");
    const DomainPtr circle = mapping("circle:radius=2,center=[1,0]")->domain();
    EXPECT_EQ(circle->spec(), "circle:radius=2,center=[1,0]");
    EXPECT_EQ(mapping(circle->spec())->domain()->spec(), circle->spec());
    EXPECT_DOUBLE_EQ(circle->measure(), 4 * pi);
    EXPECT_EQ(circle->bounding_box(), (Box{{-1, -2}, {3, 2}}));
    EXPECT_TRUE(circle->contains(Point{3, 0}));
    EXPECT_FALSE(circle->contains(Point{3 + 1e-13, 0}));
    EXPECT_FALSE(circle->contains(Point{std::nan(""), 0}));
    EXPECT_EQ(error_of([&] {
                  inverse_of(*mapping("circle"), {0.5, 0});
              }),
              "input: the point (0.5, 0) is outside the domain circle");
}

TEST(Circle, RefusesOptionsOutOfRange) {
    EXPECT_EQ(error_of([] { mapping("circle:center=[1,2,3]"); }),
              "usage: --center: expected 2 numbers, x,y; 3 given");
    EXPECT_EQ(error_of([] { mapping("circle:center=[0,1e30]"); }),
              "usage: --center: 1e+30 is so far from 0 that a radius of 1 is lost in rounding");
    EXPECT_NE(error_of([] { mapping("circle:radius=0"); }), "");
}

}  // namespace stipple::testing::circle_test
