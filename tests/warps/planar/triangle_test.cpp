// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "support/planar.hpp"

namespace stipple::testing::triangle_test {
namespace {

const char* in_space = "triangle:vertices=[1,0,0 0,2,0 0,0,3]";

const char* low_distortion = "triangle:method=low-distortion";
const char* low_in_space = "triangle:method=low-distortion,vertices=[1,0,0 0,2,0 0,0,3]";

}  // namespace

TEST(Triangle, PointsByHand) {
    EXPECT_EQ(image_of("triangle", {0, 0.7}), (std::vector{0.0, 0.0}));
    EXPECT_EQ(image_of("triangle", {0.25, 0}), (std::vector{0.0, 0.5}));
    EXPECT_EQ(image_of("triangle", {0.25, 0.25}), (std::vector{0.125, 0.375}));
    EXPECT_EQ(image_of("triangle:vertices=[1,1 5,1 1,9]", {0.25, 0.5}), (std::vector{2.0, 3.0}));
    EXPECT_EQ(image_of(in_space, {0.25, 0.5}), (std::vector{0.5, 0.5, 0.75}));
}

TEST(Triangle, CornersAreTheVertices) {
    const double last = one_minus_ulp;
    EXPECT_EQ(image_of("triangle:vertices=[3,4 7,4 3,6]", {0, 0}), (std::vector{3.0, 4.0}));
    const auto v1 = image_of("triangle:vertices=[3,4 7,4 3,6]", {last, last});
    EXPECT_NEAR(v1[0], 7, 2e-15);
    EXPECT_NEAR(v1[1], 4, 2e-15);
    const auto v2 = image_of("triangle:vertices=[3,4 7,4 3,6]", {last, 0});
    EXPECT_NEAR(v2[0], 3, 2e-15);
    EXPECT_NEAR(v2[1], 6, 2e-15);
}

// The corners of the square are mapped to v0, v1, the midpoint of v1 v2, and v2; halves of the
// square to halves of the triangle.
TEST(Triangle, LowDistortionPointsByHand) {
    EXPECT_EQ(image_of(low_distortion, {0, 0}), (std::vector{0.0, 0.0}));
    EXPECT_EQ(image_of(low_distortion, {1, 0}), (std::vector{1.0, 0.0}));
    EXPECT_EQ(image_of(low_distortion, {0, 1}), (std::vector{0.0, 1.0}));
    EXPECT_EQ(image_of(low_distortion, {1, 1}), (std::vector{0.5, 0.5}));
    EXPECT_EQ(image_of(low_distortion, {0.75, 0.5}), (std::vector{0.5, 0.25}));
    EXPECT_EQ(image_of(low_distortion, {0.25, 0.5}), (std::vector{0.125, 0.375}));
    EXPECT_EQ(image_of(low_distortion, {0.5, 0.5}), (std::vector{0.25, 0.25}));
    EXPECT_EQ(image_of(low_in_space, {0.75, 0.5}), (std::vector{0.25, 1.0, 0.75}));
}

// On the right triangle, distances grow at most by the larger singular value of the linear map (1
// -1/2; 0 1/2), 1.1441.
TEST(Triangle, LowDistortionKeepsNeighbours) {
    const auto map = mapping(low_distortion);
    const PointSet cube = make("random", points(2000, 2));
    const PointSet image = warped(*map, cube);
    for (std::size_t i = 1; i < cube.count(); ++i) {
        const double before = std::hypot(cube[i][0] - cube[i - 1][0], cube[i][1] - cube[i - 1][1]);
        const double after =
            std::hypot(image[i][0] - image[i - 1][0], image[i][1] - image[i - 1][1]);
        EXPECT_LE(after, 1.1442 * before) << i;
    }
}

TEST(Triangle, LowDistortionRoundTrip) {
    expect_round_trip(*mapping(low_distortion), 1e-15);
    expect_round_trip(*mapping(low_in_space), 3e-14);
    const std::string low = low_distortion;
    expect_round_trip(*mapping(low + ",vertices=[100,100 101,100 100.5,101]"), 100e-14);
    expect_round_trip(*mapping(low + ",vertices=[0,0 1,0 0.3,1e-3]"), 1e-11);  // flat
    expect_unit_coordinates_back(*mapping(low_distortion), 1e-15);
    expect_unit_coordinates_back(*mapping(low_in_space), 1e-14);
}

TEST(Triangle, StandsHostilePoints) {
    for (const char* spec : {"triangle", low_distortion})
        expect_stands_hostile_points(*mapping(spec), 1e-14);
    for (const char* spec : {in_space, low_in_space})
        expect_stands_hostile_points(*mapping(spec), 3e-14);
}

TEST(Triangle, BothMethodsAreUniformByArea) {
    for (const char* spec : {"triangle", in_space, low_distortion, low_in_space}) {
        expect_density_is_one_over_jacobian(*mapping(spec));
        expect_chi_square_can_tell(*mapping(spec));
    }
    expect_measure_is_share_of_box(*mapping("triangle:vertices=[0,0 3,1 1,4]")->domain());
}

TEST(Triangle, RoundTripOverTheWholeSquare) {
    expect_round_trip(*mapping("triangle"), 1e-14);
    expect_round_trip(*mapping("triangle:vertices=[0,0 0,1 1,0]"), 1e-14);  // the other orientation
    expect_round_trip(*mapping("triangle:vertices=[-1,-1 1,-1 0,1]"), 1e-14);
    expect_round_trip(*mapping("triangle:vertices=[100,100 101,100 100.5,101]"), 100e-14);
    expect_round_trip(*mapping(in_space), 3e-14);
    expect_round_trip(*mapping("triangle:vertices=[0,0,5 1,0,5 0,1,6]"), 5e-14);
    expect_round_trip(*mapping("triangle:vertices=[0,0 1,0 0.3,1e-3]"), 1e-11);  // flat
    expect_round_trip(*mapping("triangle:vertices=[0,0 1e140,0 0,1e140]"), 1e126);
    expect_round_trip(*mapping("triangle:vertices=[0,0 1e-130,0 0,1e-130]"), 1e-144);
}

TEST(Triangle, UnitCoordinatesComeBack) {
    const PointSet cube = telling_points();
    for (const char* spec : {"triangle", "triangle:vertices=[0,0,0 2,0,0 0,0,2]"}) {
        const auto map = mapping(spec);
        PointSet image(cube.count(), map->domain()->dimension()), back(cube.count(), 2);
        map->forward(cube.flat(), image.flat(), {});
        map->inverse(image.flat(), back.flat());
        for (std::size_t i = 0; i < cube.count(); ++i) {
            EXPECT_NEAR(back[i][0], cube[i][0], 1e-14) << spec << " " << cube[i][1];
            const double expected = cube[i][0] == 0 ? 0 : cube[i][1];  // all xi1 meet at v0
            EXPECT_NEAR(back[i][1], expected, 1e-14) << spec << " " << cube[i][0];
        }
    }
}

TEST(Triangle, InverseRefusesPointsOutsideAndNamesThem) {
    const auto map = mapping("triangle");
    EXPECT_EQ(inverse_of(*map, {0, 0}), (std::vector{0.0, 0.0}));
    EXPECT_EQ(inverse_of(*map, {1, 0}), (std::vector{1.0, 1.0}));
    EXPECT_EQ(inverse_of(*map, {0, 1}), (std::vector{1.0, 0.0}));
    for (const auto& p : {std::vector{0.75, 0.5}, {-1e-9, 0.5}, {0.5, -1e-9}, {NAN, 0}})
        EXPECT_NE(error_of([&] { inverse_of(*map, p); }), "") << p[0];
    EXPECT_EQ(error_of([&] {
                  inverse_of(*map, {0.75, 0.5});
              }),
              "input: the point (0.75, 0.5) is outside the domain triangle");
    const auto space = mapping(in_space);
    EXPECT_NO_THROW(inverse_of(*space, {0.5, 0.5, 0.75}));
    EXPECT_EQ(error_of([&] {
                  inverse_of(*space, {0.5, 0.5, 0.7501});
              }),
              "input: the point (0.5, 0.5, 0.7501) is outside the domain "
              "triangle:vertices=[1,0,0 0,2,0 0,0,3]")
        << "off the plane";
}

TEST(Triangle, DensityIsOneOverTheArea) {
    EXPECT_DOUBLE_EQ(mapping("triangle")->density(std::vector{0.2, 0.3}), 2);
    EXPECT_EQ(mapping("triangle")->density(std::vector{0.8, 0.3}), 0);
    const auto map = mapping(in_space);  // half of |(-1,2,0) x (-1,0,3)| = |(6,3,2)| / 2 = 7/2
    EXPECT_DOUBLE_EQ(map->domain()->measure(), 3.5);
    EXPECT_DOUBLE_EQ(map->density(std::vector{0.5, 0.5, 0.75}), 1 / 3.5);
    // A sliver whose corners are rounded doubles, by exact fractions.
    const auto sliver = mapping("triangle:vertices=[0.1,0.1 1.1,1.3 0.6,0.7000000001]");
    EXPECT_DOUBLE_EQ(sliver->density(std::vector{0.6, 0.70000000005}), 19999995569.635998);
}

// Moments of the uniform density on the right triangle: mean 1/3, variance 1/18, covariance -1/36.
// Standard errors at n = 1e5 are below 7.5e-4 and 3e-4; 5 of them: false alarm 1e-6 each.
TEST(Triangle, MomentsAreThoseOfTheUniformDensity) {
    const PointSet image = warped(*mapping("triangle"), make("random", points(100'000, 2)));
    double x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < image.count(); ++i) {
        const double a = image[i][0] - 1. / 3, b = image[i][1] - 1. / 3;
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
    }
    const auto n = static_cast<double>(image.count());
    EXPECT_NEAR(x / n, 0, 3.75e-3);
    EXPECT_NEAR(y / n, 0, 3.75e-3);
    EXPECT_NEAR(xx / n, 1. / 18, 1.5e-3);
    EXPECT_NEAR(xy / n, -1. / 36, 1.5e-3);
}

TEST(Triangle, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("triangle")->domain()->spec(), "triangle");
    EXPECT_EQ(mapping(low_distortion)->domain()->spec(), "triangle");
    const DomainPtr domain = mapping("triangle:vertices=[0,0 2,0 0,1]")->domain();
    EXPECT_EQ(domain->spec(), "triangle:vertices=[0,0 2,0 0,1]");
    EXPECT_EQ(mapping(domain->spec())->domain()->spec(), domain->spec());
    EXPECT_EQ(mapping(in_space)->domain()->spec(), in_space);
    EXPECT_EQ(mapping(in_space)->domain()->dimension(), 3U);
    EXPECT_EQ(mapping(in_space)->domain()->cube_dimension(), 2U);
    EXPECT_EQ(domain->measure(), 1);
    EXPECT_EQ(domain->cube_axes().size(), 2U);
    for (const auto& p : {std::vector{0.0, 0.0}, {2.0, 0.0}, {0.0, 1.0}, {1.0, 0.5}, {1.0, 0.0}})
        EXPECT_TRUE(domain->contains(p)) << p[0];
    for (const auto& p : {std::vector{1.0, 0.5 + 1e-13}, {-1e-13, 0.5}, {1.0, -1e-13}, {NAN, 0.1}})
        EXPECT_FALSE(domain->contains(p)) << p[0];
}

// The part of the triangle with to_cube below (a, b) has area a b; its corners by hand.
TEST(Triangle, CubeOfTheDomainIsAreaFromV1) {
    const DomainPtr domain = mapping("triangle")->domain();
    std::vector<double> cube(2);
    domain->to_cube(std::vector{0.5, 0.25}, cube);  // lambda = 1/4, 1/2, 1/4
    EXPECT_EQ(cube, (std::vector{0.25, 0.5}));
    domain->to_cube(std::vector{1.0, 0.0}, cube);
    EXPECT_EQ(cube, (std::vector{0.0, 0.0}));
    domain->to_cube(std::vector{0.0, 1.0}, cube);
    EXPECT_EQ(cube, (std::vector{1.0, 1.0}));
    domain->to_cube(std::vector{0.0, 0.0}, cube);
    EXPECT_EQ(cube, (std::vector{1.0, 0.0}));
}

TEST(Triangle, RefusesWhatIsNoTriangle) {
    const auto error = [](std::string_view spec) { return error_of([&] { mapping(spec); }); };
    EXPECT_EQ(error("triangle:vertices=[0,0 1,1 2,2]"),
              "usage: --vertices: the area of the triangle 0,0 1,1 2,2 is 0 or lost in rounding");
    EXPECT_NE(error("triangle:vertices=[0.1,0.1 0.2,0.2 0.3,0.3]"), "") << "flat but for rounding";
    EXPECT_NE(error("triangle:vertices=[1,1 1,1 1,1]"), "");
    EXPECT_NE(error("triangle:vertices=[0,0 0,0 1,0]"), "");
    EXPECT_NE(error("triangle:vertices=[1e9,1e9 1000000001e0,1e9 1e9,1000000000.00001]"), "");
    EXPECT_EQ(error("triangle:vertices=[0,0 1,0]"),
              "usage: --vertices: 2 points of dimension 2; expected 3 points of dimension 2 or 3");
    EXPECT_NE(error("triangle:vertices=[0,0 1,0 1,1 0,1]"), "");
    EXPECT_NE(error("triangle:vertices=[0 1 2]"), "");
    EXPECT_NE(error("triangle:vertices=[0,0,0,0 1,0,0,0 0,1,0,0]"), "");
    EXPECT_NE(error("triangle:vertices=[0,0 1,0 0,1,2]"), "");
    EXPECT_NE(error("triangle:vertices=[0,0 1e200,0 0,1]"), "");
}

}  // namespace stipple::testing::triangle_test
