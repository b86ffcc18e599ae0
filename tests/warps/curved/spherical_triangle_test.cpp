// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/planar.hpp"

namespace stipple::testing::spherical_triangle_test {
namespace {

constexpr double pi = std::numbers::pi;
using Point = std::vector<double>;

void expect_near(const Point& p, const Point& q, double tolerance) {
    for (std::size_t k = 0; k < p.size(); ++k) EXPECT_NEAR(p[k], q[k], tolerance) << k;
}

/// Girard: the sum of the angles minus pi, each angle being between the planes of two edges.
double area_by_girard(const std::vector<std::vector<long double>>& v) {
    const auto cross = [](const auto& a, const auto& b) {
        return std::vector<long double>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                        a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const auto& a, const auto& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    long double sum = -std::numbers::pi_v<long double>;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto one = cross(v[k], v[(k + 1) % 3]);
        const auto other = cross(v[k], v[(k + 2) % 3]);
        sum += std::acos(dot(one, other) / std::sqrt(dot(one, one) * dot(other, other)));
    }
    return static_cast<double>(sum);
}

const char* const shapes[] = {
    "spherical-triangle",
    "spherical-triangle:vertices=[0,0,1 0,1,0 1,0,0]",
    "spherical-triangle:vertices=[1,0.1,0 -0.5,2,0.3 0.2,-1,3]",
    "spherical-triangle:vertices=[1,2,3 1.001,2,3 1,2.001,3]",
};

}  // namespace

// The octant: q = pi xi0 / 2, since area is proportional to longitude from b = y to the arc zx.
TEST(SphericalTriangle, OctantByHand) {
    const auto octant = mapping("spherical-triangle");
    expect_near(image_of(*octant, {0, 1}), {1, 0, 0}, 1e-16);
    expect_near(image_of(*octant, {1, 1}), {0, 0, 1}, 2e-16);
    expect_near(image_of(*octant, {0.3, 0}), {0, 1, 0}, 0);
    const double h = std::sqrt(0.5);
    expect_near(image_of(*octant, {0.5, 1}), {h, 0, h}, 2e-16);
    // 1 - y = xi1, on the meridian at 30 degrees.
    expect_near(image_of(*octant, {1. / 3, 0.5}), {0.75, 0.5, h * h * std::sqrt(0.75)}, 3e-16);
    EXPECT_DOUBLE_EQ(octant->domain()->measure(), pi / 2);
}

TEST(SphericalTriangle, EdgesAndCornersAreWhereTheStrataSay) {
    const auto map = mapping("spherical-triangle:vertices=[1,0.1,0 -0.5,2,0.3 0.2,-1,3]");
    const auto unit = [](Point v) {
        const double size = std::hypot(v[0], v[1], v[2]);
        for (double& x : v) x /= size;
        return v;
    };
    expect_near(image_of(*map, {0, 1}), unit({1, 0.1, 0}), 1e-15);
    expect_near(image_of(*map, {0.7, 0}), unit({-0.5, 2, 0.3}), 1e-15);
    expect_near(image_of(*map, {1, 1}), unit({0.2, -1, 3}), 1e-15);
}

TEST(SphericalTriangle, AreaIsGirards) {
    EXPECT_NEAR(mapping(shapes[2])->domain()->measure(),
                area_by_girard({{1, 0.1L, 0}, {-0.5L, 2, 0.3L}, {0.2L, -1, 3}}), 1e-15);
    // Nearly a hemisphere, and more than an octant.
    EXPECT_NEAR(
        mapping("spherical-triangle:vertices=[1,0,0.01 -1,2,0 -1,-2,0]")->domain()->measure(),
        area_by_girard({{1, 0, 0.01L}, {-1, 2, 0}, {-1, -2, 0}}), 1e-14);
}

// A triangle with legs of 1e-9 at x has the plane's area, 5e-19; cosines would give 0.
TEST(SphericalTriangle, TinyTrianglesKeepTheirDigits) {
    const auto map = mapping("spherical-triangle:vertices=[1,0,0 1,1e-9,0 1,0,1e-9]");
    EXPECT_NEAR(map->domain()->measure() / 5e-19, 1, 1e-15);
    const Point p = image_of(*map, {0.25, 0.25});  // in the plane: half way from b to a + (c - a)/4
    EXPECT_NEAR(p[1], 0.5e-9, 1e-24);
    EXPECT_NEAR(p[2], 0.125e-9, 1e-24);
    expect_near(inverse_of(*map, p), {0.25, 0.25}, 1e-14);
}

TEST(SphericalTriangle, RoundTripOverTheWholeSquare) {
    for (const char* spec : shapes) {
        SCOPED_TRACE(spec);
        expect_round_trip(*mapping(spec), 2e-15);
    }
    expect_round_trip(*mapping("spherical-triangle:vertices=[1,0,0 0,1,0 1,1,1e-6]"), 2e-15);
    expect_round_trip(*mapping("spherical-triangle:vertices=[1,0,0 1,1,1e-6 0,1,0]"), 2e-15);
    expect_round_trip(*mapping("spherical-triangle:vertices=[1,0,0 -0.99,0.1,0 0.1,-1,-0.1]"),
                      1e-12);
}

// Corners that are nearly collinear, very close together, or nearly opposite.
TEST(SphericalTriangle, KeepsItsPointsOnTheRim) {
    for (const char* vertices :
         {"2,-3,4 -9,-9,-9 -7,-7,-6",
          "-2.0744450134764927,0.44853540041231293,0.2525897870052396 "
          "0.9565666532561078,0.24586647114440302,-0.1566202932107067 "
          "0.9565666532547824,0.24586647114485297,-0.15662029321151222",
          "-7e52,0,-5.7e43 -1,-1,-1 0.8603096525744408,0.7985092938047497,0.7985092938047307"}) {
        const auto map = mapping("spherical-triangle:vertices=[" + std::string(vertices) + "]");
        for (const PointSet& cube : {telling_points(), hostile_points(20'000, 2)})
            for (std::size_t i = 0; i < cube.count(); ++i) {
                const Point w = image_of(*map, {cube[i][0], cube[i][1]});
                ASSERT_EQ(map->density(w), 1 / map->domain()->measure())
                    << vertices << ": " << cube[i][0] << ", " << cube[i][1];
            }
    }
}

TEST(SphericalTriangle, ComesBackToACornerBesideAShortEdge) {
    const auto map =
        mapping("spherical-triangle:vertices=[0.1,0.2,0.9 0.1000000001,0.2,0.9 0.5,-0.4,0.3]");
    const Point corner = image_of(*map, {one_minus_ulp, one_minus_ulp});
    const Point back = inverse_of(*map, corner);
    expect_near(image_of(*map, back), corner, 1e-14);
    EXPECT_NEAR(back[1], 1, 1e-14);
}

TEST(SphericalTriangle, UnitCoordinatesComeBack) {
    const PointSet cube = telling_points();
    for (std::size_t shape = 0; shape < 3; ++shape) {
        const auto map = mapping(shapes[shape]);
        for (std::size_t i = 0; i < cube.count(); ++i) {
            const Point xi(cube[i].begin(), cube[i].end());
            const Point back = inverse_of(*map, image_of(*map, xi));
            EXPECT_NEAR(back[1], xi[1], 2e-14) << shapes[shape] << " " << xi[0];
            if (xi[1] > 1e-4) {  // all xi0 meet at b
                EXPECT_NEAR(back[0], xi[0], 1e-13) << shapes[shape] << " " << xi[1];
            }
        }
    }
}

TEST(SphericalTriangle, DensityIsOneOverTheArea) {
    for (const char* spec : {shapes[0], shapes[1], shapes[2]})
        expect_density_is_one_over_stretch(*mapping(spec));
    EXPECT_EQ(mapping(shapes[0])->density(Point{-1, 0, 0}), 0);
    EXPECT_EQ(mapping(shapes[0])->density(Point{0.1, 0.1, 0.1}), 0);
}

/// Random directions on the sphere, inside and outside the triangle.
TEST(SphericalTriangle, ContainsTheShareOfTheSphereThatItsAreaIs) {
    const auto map = mapping(shapes[2]);
    const PointSet sphere = warped(*mapping("sphere"), make("random", points(200'000, 2)));
    double inside = 0;
    for (std::size_t i = 0; i < sphere.count(); ++i) inside += map->domain()->contains(sphere[i]);
    // 5 standard errors of 2e5 points are 5.6e-3: false alarm 6e-7.
    EXPECT_NEAR(inside / 2e5, map->domain()->measure() / (4 * pi), 5.6e-3);
}

// False alarm 1e-5 for each right one; cells and strata start from different corners. Wrong: xi0 as
// an angle along the edge, which is right only for the octant, and projected points of the plane
// triangle.
TEST(SphericalTriangle, ChiSquareAcceptsItAndRejectsProjectedPoints) {
    for (const char* spec : shapes) EXPECT_GT(p_of_random(*mapping(spec), 50'000), 1e-5) << spec;
    PointSet flat = warped(*mapping("triangle:vertices=[1,0,0 0,1,0 0,0,1]"),
                           make("random", points(50'000, 2)));
    for (std::size_t i = 0; i < flat.count(); ++i) {
        const double size = std::hypot(flat[i][0], flat[i][1], flat[i][2]);
        for (double& x : flat[i]) x /= size;
    }
    flat.domain = mapping("spherical-triangle")->domain();
    EXPECT_LT(measure("chi-square", "p_value", flat), 1e-100);
}

TEST(SphericalTriangle, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("spherical-triangle")->domain()->spec(), "spherical-triangle");
    const DomainPtr domain = mapping(shapes[1])->domain();
    EXPECT_EQ(domain->spec(), "spherical-triangle:vertices=[0,0,1 0,1,0 1,0,0]");
    EXPECT_EQ(mapping(domain->spec())->domain()->spec(), domain->spec());
    EXPECT_EQ(domain->bounding_box(), (Box{{0, 0, 0}, {1, 1, 1}}));
    // The edge between (1,0,1) and (-1,0,1) rises to z = 1; the third corner is at y = 1.
    const Box box =
        mapping("spherical-triangle:vertices=[1,0,1 -1,0,1 0,1,0]")->domain()->bounding_box();
    EXPECT_NEAR(box.high[2], 1, 1e-15);
    EXPECT_NEAR(box.low[2], 0, 1e-15);
    EXPECT_NEAR(box.low[0], -std::sqrt(0.5), 1e-15);
    EXPECT_FALSE(domain->contains(Point{std::nan(""), 0, 0}));
    EXPECT_FALSE(domain->contains(Point{1, -1e-14, 0}));
    EXPECT_EQ(error_of([&] {
                  inverse_of(*mapping("spherical-triangle"), {0, 0, -1});
              }),
              "input: the point (0, 0, -1) is outside the domain spherical-triangle");
}

TEST(SphericalTriangle, RefusesWhatIsNoTriangle) {
    const auto error = [](const std::string& v) {
        return error_of([&] { mapping("spherical-triangle:vertices=[" + v + "]"); });
    };
    EXPECT_EQ(error("1,0 0,1 1,1"),
              "usage: --vertices: 3 points of dimension 2; expected 3 directions x,y,z");
    EXPECT_NE(error("1,0,0 0,1,0"), "");
    EXPECT_EQ(error("1,0,0 0,0,0 0,1,0"), "usage: --vertices: 0,0,0 has no direction");
    EXPECT_EQ(error("1,0,0 -2,0,0 0,1,0"),
              "usage: --vertices: two of 1,0,0 -2,0,0 0,1,0 are opposite, so that no unique arc "
              "joins them");
    EXPECT_EQ(
        error("1,0,0 0,1,0 1,1,0"),
        "usage: --vertices: 1,0,0 0,1,0 1,1,0 lie on one great circle; they span no triangle");
    EXPECT_NE(error("1,2,3 2,4,6 0,1,0"), "") << "two are one direction";
    EXPECT_NE(error("1,2,3 1,2,3 1,2,3"), "");
}

}  // namespace stipple::testing::spherical_triangle_test
