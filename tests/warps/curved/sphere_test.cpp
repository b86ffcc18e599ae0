// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::sphere_test {
namespace {

constexpr double pi = std::numbers::pi;
using Point = std::vector<double>;

}  // namespace

TEST(Sphere, PointsByHand) {
    const double h = std::sqrt(0.75);
    EXPECT_EQ(image_of("sphere", {0, 0.3}), (Point{0, 0, 1}));
    EXPECT_EQ(image_of("sphere", {1, 0.3}), (Point{0, 0, -1}));
    EXPECT_EQ(image_of("sphere", {0.5, 0}), (Point{1, 0, 0}));
    EXPECT_EQ(image_of("sphere", {0.5, 0.25}), (Point{0, 1, 0}));
    EXPECT_EQ(image_of("sphere", {0.25, 0.5}), (Point{-h, 0, 0.5}));
    EXPECT_EQ(image_of("sphere:radius=2,center=[10,20,30]", {0.5, 0.75}), (Point{10, 18, 30}));
    EXPECT_EQ(image_of("sphere:method=naive-lat-long", {0.5, 0.25}), (Point{0, 1, 0}));
    EXPECT_EQ(image_of("sphere:method=naive-lat-long", {0.25, 0}),
              (Point{std::sqrt(0.5), 0, std::sqrt(0.5)}));
    EXPECT_EQ(image_of("sphere:method=rejection", {0.5, 0.5, 0.75}), (Point{0, 0, 1}));
    EXPECT_EQ(image_of("sphere:method=rejection", {0.75, 1, 0.5}),
              (Point{std::sqrt(0.2), 2 * std::sqrt(0.2), 0}));
}

TEST(Sphere, NextToThePolesTheAngleIsKept) {
    const Point p = image_of("sphere", {1e-30, 0.25});  // sin(angle) = 2 sqrt(xi0)
    EXPECT_DOUBLE_EQ(p[1], 2e-15);
    EXPECT_DOUBLE_EQ(inverse_of(*mapping("sphere"), p)[0], 1e-30);
}

TEST(Sphere, RoundTripOverTheWholeSquare) {
    for (const std::string method : {"z", "naive-lat-long"}) {
        SCOPED_TRACE(method);
        expect_round_trip(*mapping("sphere:method=" + method), 1e-14);
        expect_round_trip(*mapping("sphere:radius=1e-3,center=[5,-7,3],method=" + method), 1e-13);
        expect_round_trip(*mapping("sphere:radius=1e150,method=" + method), 1e136);
        expect_round_trip(*mapping("sphere:radius=1e-150,method=" + method), 1e-164);
    }
}

TEST(Sphere, UnitCoordinatesComeBackAroundTheOrigin) {
    const PointSet cube = telling_points();
    for (const std::string method : {"z", "naive-lat-long"})
        for (const std::string size : {"1", "0.3", "1e9"}) {
            const auto map = mapping("sphere:method=" + method + ",radius=" + size);
            for (std::size_t i = 0; i < cube.count(); ++i) {
                const Point xi(cube[i].begin(), cube[i].end());
                const Point image = image_of(*map, xi);
                const Point back = inverse_of(*map, image);
                EXPECT_NEAR(back[0], xi[0], 1e-14) << method << " " << xi[1];
                if (image[0] == 0 && image[1] == 0) {
                    EXPECT_EQ(back[1], 0) << "all longitudes meet in the poles";
                } else if (xi[1] < 1 && xi[0] > 1e-290) {  // below, r^2 is denormal
                    EXPECT_NEAR(back[1], xi[1], 1e-14) << method << " " << xi[0];
                }
            }
        }
}

TEST(Sphere, RejectionKeepsTheShellAndMarksTheRest) {
    const auto map = mapping("sphere:method=rejection");
    EXPECT_EQ(map->cube_dimension(), 3U);
    EXPECT_TRUE(map->drops());

    const std::vector<Point> rows = {
        {0.5, 0.5, 0.5}, {0.5, 0.5, 1}, {0, 0, 0}, {0.5, 0.54, 0.5}, {0.5, 0.56, 0.5}};
    Point flat;
    for (const Point& row : rows) flat.insert(flat.end(), row.begin(), row.end());
    Point image(15);
    std::vector<std::uint8_t> keep(5, 7);
    map->forward(flat, image, keep);
    EXPECT_EQ(keep, (std::vector<std::uint8_t>{0, 1, 0, 0, 1}));
    for (const double x : image) EXPECT_TRUE(std::isfinite(x)) << "also of what is dropped";
    mapping("sphere:method=rejection,inner=0")->forward(flat, image, keep);
    EXPECT_EQ(keep, (std::vector<std::uint8_t>{0, 1, 0, 1, 1})) << "the centre has no direction";
    EXPECT_FALSE(mapping("sphere")->drops());
}

// The expected fraction of points kept is (pi / 6) 0.999 = 0.5230752; for 500 000 points the
// standard deviation is 353 points; 5 of them, false alarm 6e-7.
TEST(Sphere, RejectionKeepsAShareOf05230752) {
    const PointSet kept =
        warped(*mapping("sphere:method=rejection"), make("random", points(500'000, 3)));
    EXPECT_NEAR(static_cast<double>(kept.count()), 500'000 * 0.5230752, 1766);
}

TEST(Sphere, RejectionHasNoWayBack) {
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping("sphere:method=rejection"), {0, 0, 1});
              }),
              "usage: --inverse: method rejection maps 3 coordinates to 2; it has no inverse");
}

TEST(Sphere, InverseRefusesPointsOffTheSphereAndNamesThem) {
    const auto map = mapping("sphere:radius=2,center=[1,0,0]");
    EXPECT_EQ(inverse_of(*map, {3, 0, 0}), (Point{0.5, 0}));
    EXPECT_EQ(error_of([&] {
                  inverse_of(*map, {1, 0, 0.5});
              }),
              "input: the point (1, 0, 0.5) is outside the domain sphere:radius=2,center=[1,0,0]");
    EXPECT_NE(error_of([&] { inverse_of(*map, {std::nan(""), 0, 0}); }), "");
    EXPECT_NE(error_of([&] { inverse_of(*map, {1e308, 0, 0}); }), "");
}

TEST(Sphere, DensityIsOneOverTheStretch) {
    expect_density_is_one_over_stretch(*mapping("sphere:radius=2,center=[1,2,3]"));
    expect_density_is_one_over_stretch(
        *mapping("sphere:radius=2,center=[1,2,3],method=naive-lat-long"));
    EXPECT_DOUBLE_EQ(mapping("sphere:radius=2")->density(Point{0, 0, 2}), 1 / (16 * pi));
    EXPECT_EQ(mapping("sphere:radius=2")->density(Point{0, 0, 1}), 0);
    const auto naive = mapping("sphere:method=naive-lat-long");
    EXPECT_EQ(naive->density(Point{0, 0, 1}), std::numeric_limits<double>::infinity());
    EXPECT_DOUBLE_EQ(naive->density(Point{1, 0, 0}), 1 / (2 * pi * pi));
}

// E z^2 is 1/3 for points uniform by area, 1/2 for the naive method; the standard errors of 1e5
// points are 9.4e-4 and 1.1e-3; 5 of them, false alarm 6e-7 each.
TEST(Sphere, NaiveIsBiasedTheOthersAreNot) {
    for (const std::string method : {"z", "rejection", "naive-lat-long"}) {
        const auto map = mapping("sphere:method=" + method);
        const PointSet image = warped(*map, make("random", points(200'000, map->cube_dimension())));
        double zz = 0;
        for (std::size_t i = 0; i < image.count(); ++i) zz += image[i][2] * image[i][2];
        zz /= static_cast<double>(image.count());
        EXPECT_NEAR(zz, method == "naive-lat-long" ? 1. / 2 : 1. / 3, 5.6e-3) << method;
    }
}

// False alarm 1e-5 for each of 2 sets.
TEST(Sphere, ChiSquareAcceptsTheRightMethodsAndRejectsTheNaiveOne) {
    EXPECT_GT(p_of_random(*mapping("sphere:radius=2,center=[1,2,3]"), 100'000), 1e-5);
    EXPECT_GT(p_of_random(*mapping("sphere:method=rejection"), 200'000), 1e-5);
    EXPECT_LT(p_of_random(*mapping("sphere:method=naive-lat-long"), 100'000), 1e-100);
}

TEST(Sphere, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("sphere:method=rejection,inner=0.5")->domain()->spec(), "sphere");
    const DomainPtr sphere = mapping("sphere:method=rejection,radius=2,center=[1,0,0]")->domain();
    EXPECT_EQ(sphere->spec(), "sphere:radius=2,center=[1,0,0]");
    EXPECT_EQ(mapping(sphere->spec())->domain()->spec(), sphere->spec());
    EXPECT_DOUBLE_EQ(sphere->measure(), 16 * pi);
    EXPECT_EQ(sphere->bounding_box(), (Box{{-1, -2, -2}, {3, 2, 2}}));
    EXPECT_TRUE(sphere->contains(Point{3, 0, 0}));
    EXPECT_FALSE(sphere->contains(Point{3 + 1e-13, 0, 0}));
    EXPECT_FALSE(sphere->contains(Point{3 - 1e-13, 0, 0}));
    EXPECT_FALSE(sphere->contains(Point{1, 0, 0}));
    Point cube(2);
    sphere->to_cube(Point{1, 2, 0}, cube);
    EXPECT_EQ(cube, (Point{0.5, 0.25}));
}

TEST(Sphere, RefusesOptionsOutOfRange) {
    EXPECT_NE(error_of([] { mapping("sphere:radius=0"); }), "");
    EXPECT_NE(error_of([] { mapping("sphere:inner=1"); }), "");
    EXPECT_EQ(error_of([] { mapping("sphere:center=[1,2]"); }),
              "usage: --center: expected 3 numbers, x,y,z; 2 given");
    EXPECT_EQ(error_of([] { mapping("sphere:center=[0,1e30,0]"); }),
              "usage: --center: 1e+30 is so far from 0 that a radius of 1 is lost in rounding");
}

}  // namespace stipple::testing::sphere_test
