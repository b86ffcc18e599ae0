// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::torus_surface_test {
namespace {

constexpr double pi = std::numbers::pi;
using Point = std::vector<double>;

}  // namespace

TEST(TorusSurface, PointsByHand) {
    const auto torus = mapping("torus-surface:major-radius=3,minor-radius=1");
    EXPECT_EQ(image_of(*torus, {0, 0}), (Point{4, 0, 0}));
    EXPECT_EQ(image_of(*torus, {0.5, 0.25}), (Point{0, 2, 0}));
    EXPECT_EQ(image_of(*torus, {1, 0.5}), (Point{-4, 0, 0}));
    // theta = pi / 2: (3 pi / 2 + 1) / (6 pi) of the area is before it.
    const Point top = image_of(*torus, {0.25 + 1 / (6 * pi), 0});
    EXPECT_NEAR(top[0], 3, 1e-15);
    EXPECT_NEAR(top[2], 1, 1e-15);
    const Point bottom = image_of(*torus, {0.75 - 1 / (6 * pi), 0});
    EXPECT_NEAR(bottom[0], 3, 2e-15);
    EXPECT_NEAR(bottom[2], -1, 1e-15);
    const Point lying =
        image_of(*mapping("torus-surface:major-radius=3,center=[1,2,3],axis=[5,0,0]"), {0.5, 0});
    EXPECT_NEAR(lying[0], 1, 1e-15);
    EXPECT_NEAR(std::hypot(lying[1] - 2, lying[2] - 3), 2.6, 1e-15);
}

TEST(TorusSurface, RoundTripOverTheWholeSquare) {
    expect_round_trip(*mapping("torus-surface"), 1e-14);
    expect_round_trip(*mapping("torus-surface:minor-radius=1e-6"), 1e-14);
    expect_round_trip(*mapping("torus-surface:minor-radius=0.999999"), 1e-14);
    expect_round_trip(*mapping("torus-surface:minor-radius=1"), 2e-14);
    expect_round_trip(*mapping("torus-surface:center=[5,-7,3],axis=[1,2,-3]"), 8e-14);
    expect_round_trip(*mapping("torus-surface:major-radius=1e150,minor-radius=1e149"), 1e136);
    expect_round_trip(*mapping("torus-surface:major-radius=1e-149,minor-radius=1e-150"), 1e-163);
}

TEST(TorusSurface, UnitCoordinatesComeBack) {
    const PointSet cube = telling_points();
    for (const char* spec : {"torus-surface", "torus-surface:minor-radius=0.99,axis=[1,2,3]"}) {
        const auto map = mapping(spec);
        for (std::size_t i = 0; i < cube.count(); ++i) {
            const Point xi(cube[i].begin(), cube[i].end());
            const Point back = inverse_of(*map, image_of(*map, xi));
            // Both ends of a full turn are the same position.
            for (std::size_t k = 0; k < 2; ++k)
                EXPECT_NEAR(std::remainder(back[k] - xi[k], 1), 0, 1e-13) << spec << " " << xi[k];
        }
    }
}

// The definition: the point's angle satisfies the equation.
TEST(TorusSurface, SolvesItsEquation) {
    for (const double r : {1e-3, 0.4, 0.999, 1.0}) {
        const auto map = mapping("torus-surface:minor-radius=" + std::to_string(r));
        for (double u = 0.001; u < 0.5; u += 0.00731) {
            const Point p = image_of(*map, {u, 0});
            const double theta = std::atan2(p[2], p[0] - 1);
            EXPECT_NEAR((theta + r * std::sin(theta)) / (2 * pi), u, 2e-13 / r) << r;
        }
    }
}

TEST(TorusSurface, DensityIsOneOverTheStretch) {
    expect_density_is_one_over_stretch(*mapping("torus-surface"));
    expect_density_is_one_over_stretch(
        *mapping("torus-surface:major-radius=3,minor-radius=2.9,center=[1,2,3],axis=[1,1,0]"),
        1e-4);
    const auto torus = mapping("torus-surface:major-radius=3,minor-radius=1");
    EXPECT_DOUBLE_EQ(torus->domain()->measure(), 12 * pi * pi);
    EXPECT_DOUBLE_EQ(torus->density(Point{2, 0, 0}), 1 / (12 * pi * pi));
    EXPECT_EQ(torus->density(Point{2.1, 0, 0}), 0);
}

// E cos theta = r / (2 R) = 0.2; standard error of 1e5 points below 2.2e-3; 5 of them, false alarm
// 6e-7. Uniform angles have mean 0.
TEST(TorusSurface, MeanOfTheTubesAngle) {
    const PointSet image = warped(*mapping("torus-surface"), make("random", points(100'000, 2)));
    double sum = 0;
    for (std::size_t i = 0; i < image.count(); ++i)
        sum += (std::hypot(image[i][0], image[i][1]) - 1) / 0.4;
    EXPECT_NEAR(sum / 1e5, 0.2, 0.011);
}

// False alarm 1e-5 each.
TEST(TorusSurface, ChiSquareAcceptsItAndRejectsUniformAngles) {
    EXPECT_GT(p_of_random(*mapping("torus-surface:axis=[1,2,3],center=[1,1,1]"), 100'000), 1e-5);
    EXPECT_GT(p_of_random(*mapping("torus-surface:minor-radius=1"), 100'000), 1e-5);
    PointSet angles = make("random", points(100'000, 2));
    std::vector<double> flat;
    for (std::size_t i = 0; i < angles.count(); ++i) {
        const double theta = 2 * pi * angles[i][0], phi = 2 * pi * angles[i][1];
        const double ring = 1 + 0.4 * std::cos(theta);
        flat.insert(flat.end(),
                    {ring * std::cos(phi), ring * std::sin(phi), 0.4 * std::sin(theta)});
    }
    PointSet wrong(std::move(flat), 3);
    wrong.domain = mapping("torus-surface")->domain();
    EXPECT_LT(measure("chi-square", "p_value", wrong), 1e-100);
}

TEST(TorusSurface, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("torus-surface")->domain()->spec(), "torus-surface");
    const DomainPtr torus = mapping("torus-surface:minor-radius=0.5,axis=[1,0,0]")->domain();
    EXPECT_EQ(torus->spec(), "torus-surface:minor-radius=0.5,axis=[1,0,0]");
    EXPECT_EQ(mapping(torus->spec())->domain()->spec(), torus->spec());
    EXPECT_EQ(torus->bounding_box(), (Box{{-0.5, -1.5, -1.5}, {0.5, 1.5, 1.5}}));
    EXPECT_FALSE(torus->contains(Point{0, 0, 1}));
    EXPECT_FALSE(torus->contains(Point{0, 0, std::nan("")}));
    EXPECT_TRUE(torus->contains(Point{0.5, 0, 1}));
    EXPECT_FALSE(torus->contains(Point{0.5 + 1e-13, 0, 1}));
    EXPECT_EQ(error_of([&] {
                  inverse_of(*mapping("torus-surface"), {0, 0, 0});
              }),
              "input: the point (0, 0, 0) is outside the domain torus-surface");
}

TEST(TorusSurface, RefusesOptionsOutOfRange) {
    EXPECT_EQ(error_of([] { mapping("torus-surface:minor-radius=1.5"); }),
              "usage: --minor-radius: 1.5 is above the major radius 1; the surface would intersect "
              "itself");
    EXPECT_EQ(error_of([] { mapping("torus-surface:axis=[0,0,0]"); }),
              "usage: --axis: 0,0,0 has no direction");
    EXPECT_NE(error_of([] { mapping("torus-surface:minor-radius=0"); }), "");
}

}  // namespace stipple::testing::torus_surface_test
